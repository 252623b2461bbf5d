#version 450
// layered · surface · mxgen 0.1 · glsl · reduced · 1 closure · 0 textures

struct mx_GgxLobe {
    vec3 N;
    float cosine;
    vec3 x;
    vec2 alpha;
    float masking;
};
uniform vec3 u_viewPosition = vec3(0.0);
uniform int u_numActiveLightSources = 0;
struct LightData {
    int type;
    vec3 direction;
    vec3 color;
    float intensity;
};
uniform LightData u_lightData[1];
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
} vd;
out vec4 out1;

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
float mx_bicubic(const mat4 m, const float x, const float y)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, y, y * y, y * y * y));
}

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
// Here a = 0.05.
vec2 mx_ggx_albedo_fit(const float c)
{
    float x = clamp(1.0 - c - 0.05 * mx_bicubic(mat4(-0.2174, 5.3819, -3.911, 0.2674, -9.7298, 3.9904, 3.8225, -0.0277,
        36.4897, -72.9122, 58.0878, -20.917, -31.4763, 79.0768, -73.9706, 26.5429), 0.05 / (0.05 + c), 0.05), 0.0, 1.0);
    float u = 0.05 / (0.05 + 0.6 * c);
    return vec2(min(1.0017 - u * u * mx_bicubic(mat4(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238, 8.7382,
        4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.206, -83.1538, 52.7528), u, 0.05 * c), 1.0),
        x * x * x * x * x);
}

// Unpolarised reflectance of an interface with the permittivity re + i im, with c for the cosine and u + iv for the
// index times the cosine behind (Born and Wolf 1999, "Principles of Optics", section 14.4):
//     F = (P + P Q) / 2,  P = (a - g) / (a + g),  Q = (b - g s) / (b + g s)
//     a = |u + iv|^2 + c^2,  g = 2uc,  s = 1 - c^2,  b = |u + iv|^2 c^2 + s^2
float mx_fresnel_conductor(const float cosine, const float re, const float im)
{
    float c2 = cosine * cosine;
    float s = 1.0 - c2;
    float t = re - s;
    float norm = sqrt(t * t + im * im);
    float g = cosine * sqrt(max(2.0 * (norm + t), 0.0));
    float b = norm * c2 + s * s;
    float a = norm + c2;
    return (a - g) * b / ((a + g) * (b + g * s));
}

// Unpolarised reflectance of a conductor with the permittivity re + i im of each channel.
// Here re = vec3(-11.690287, -5.326475, -1.2477709), im = vec3(1.253184, 1.975332, 4.86042).
vec3 mx_fresnel_conductor(const float cosine)
{
    vec3 color = vec3(0.0);
    for (int i = 0; i < 3; ++i)
        color[i] = mx_fresnel_conductor(cosine, vec3(-11.690287, -5.326475, -1.2477709)[i],
            vec3(1.253184, 1.975332, 4.86042)[i]);
    return color;
}

// The square of the length of the facet's normal H after the roughness divided its parts along the surface, times the
// product of the roughness along x and y; cos_h is its part along N.
// Here is_round = true, is_wide = true.
float mx_ggx_stretched(const mx_GgxLobe lobe, const float cos_h, const float square)
{
    return square - (1.0 - lobe.alpha.x * lobe.alpha.y) * (cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = true, is_wide = true.
float mx_ggx_light(const mx_GgxLobe lobe, const vec3 V, const vec3 L)
{
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = mx_ggx_stretched(lobe, lobe.cosine + dot(lobe.N, L), square);
    return area / 6.2831855 * square * square * cos_l
        / (e * e * (lobe.cosine * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * lobe.masking));
}

void main()
{
    vec3 color = vec3(0.0);
    // lights
    vec3 N = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    float cosine = max(abs(dot(N, V)), 1e-8);
    vec3 metal_factor = ((1.0 / mx_ggx_albedo_fit(cosine).x - 1.0) * vec3(0.94687766, 0.78681135, 0.40318817)
        + vec3(1.0)) * 0.15;
    float ggx_masking = sqrt(cosine * cosine * 0.9975 + 0.0025);
    mx_GgxLobe metal_ggx_lobe = mx_GgxLobe(faceforward(N, -V, N), cosine, vec3(0.0), vec2(0.05), ggx_masking);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 1) - 1; i >= 0; --i) {
        // metal
        float light_intensity = u_lightData[i].intensity;
        vec3 fresnel = mx_fresnel_conductor(sqrt(clamp(dot(-u_lightData[i].direction, V) * 0.5 + 0.500001, 0.0, 1.0)));
        vec3 metal_response = metal_factor * (fresnel * mx_ggx_light(metal_ggx_lobe, V, -u_lightData[i].direction));
        color += u_lightData[i].color * ((u_lightData[i].type == 1 ? light_intensity : 0.0) * metal_response);
    }
    out1 = vec4(color, 1.0);
}
