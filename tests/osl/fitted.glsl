// SPDX-License-Identifier: Apache-2.0
// BSDFs that OSL has no closure for. They draw directions by the cosine, on the side of V.

const float pi = 3.14159265;

vec3 drawn(vec3 N, vec3 V, vec3 xi)
{
    vec3 n = dot(N, V) < 0.0 ? -N : N;
    vec3 x = normalize(cross(abs(n.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0), n));
    float turn = 2.0 * pi * xi.x, sine = sqrt(xi.y);
    return normalize((x * cos(turn) + cross(n, x) * sin(turn)) * sine + n * sqrt(1.0 - xi.y));
}

// Phong's lobe over diffuse light (Lafortune and Willems 1994, "Using the Modified Phong Reflectance Model").
vec3 phong_eval(vec3 diffuse, vec3 specular, float exponent, vec3 N, vec3 V, vec3 L)
{
    float lobe = pow(max(dot(reflect(-V, N), L), 0.0), exponent) * (exponent + 2.0) / (2.0 * pi);
    return dot(N, V) > 0.0 ? (diffuse / pi + specular * lobe) * max(dot(N, L), 0.0) : vec3(0.0);
}

float phong_pdf(vec3 diffuse, vec3 specular, float exponent, vec3 N, vec3 V, vec3 L)
{
    return max(dot(N, L), 0.0) / pi;
}

void phong_sample(vec3 diffuse, vec3 specular, float exponent, vec3 N, vec3 V, vec3 xi, out vec3 L, out vec3 weight, out float pdf)
{
    L = drawn(N, V, xi);
    pdf = phong_pdf(diffuse, specular, exponent, N, V, L);
    weight = phong_eval(diffuse, specular, exponent, N, V, L) / max(pdf, 1e-6);
}

// Facets that stand up (Ashikhmin and Premoze 2007, "Distribution-based BRDFs"), and what they let through.
vec3 velvet_eval(vec3 color, float spread, vec3 N, vec3 V, vec3 L)
{
    float nl = dot(N, L), nv = dot(N, V), nh = dot(N, normalize(V + L));
    if (nl <= 0.0 || nv <= 0.0)
        return vec3(0.0);
    float slope = nh * nh / max(1.0 - nh * nh, 1e-6);
    float density = (1.0 + 4.0 * exp(-slope / (spread * spread))) / (pi * (1.0 + 4.0 * spread * spread));
    return color * (density * nl / (4.0 * (nl + nv - nl * nv)));
}

vec3 velvet_throughput(vec3 color, float spread, vec3 V)
{
    return vec3(0.25);
}

float velvet_pdf(vec3 color, float spread, vec3 N, vec3 V, vec3 L)
{
    return max(dot(N, L), 0.0) / pi;
}

void velvet_sample(vec3 color, float spread, vec3 N, vec3 V, vec3 xi, out vec3 L, out vec3 weight, out float pdf)
{
    L = drawn(N, V, xi);
    pdf = velvet_pdf(color, spread, N, V, L);
    weight = velvet_eval(color, spread, N, V, L) / max(pdf, 1e-6);
}
