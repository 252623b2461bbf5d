#version 310 es
// standard_surface · surfacematerial · mxgen 0.1 · essl310 · complete · 9 closures · 0 textures
precision highp float;
precision highp int;
precision highp sampler2D;

struct mx_GgxLobe {
    vec3 N;
    float cosine;
    vec3 x;
    vec2 alpha;
    float masking;
};
struct mx_GgxSamples {
    mat3 to_map;
    vec3 stretch;
    float area;
    vec3 v;
    float masking;
    float reach;
    float step;
    float texels;
    float weight;
};
struct mx_GgxFacet {
    vec3 h;
    float cosine;
    float mirror;
    float texels;
};
struct mx_GgxLight {
    vec3 color;
    float weight;
    float cosine;
};
layout(binding = 1, std140) uniform PublicUniforms {
    float SR_standard_surface_base;
    vec3 SR_standard_surface_base_color;
    float SR_standard_surface_diffuse_roughness;
    float SR_standard_surface_metalness;
    float SR_standard_surface_specular;
    vec3 SR_standard_surface_specular_color;
    float SR_standard_surface_specular_roughness;
    float SR_standard_surface_specular_IOR;
    float SR_standard_surface_specular_anisotropy;
    float SR_standard_surface_specular_rotation;
    float SR_standard_surface_transmission;
    vec3 SR_standard_surface_transmission_color;
    float SR_standard_surface_transmission_extra_roughness;
    float SR_standard_surface_subsurface;
    vec3 SR_standard_surface_subsurface_color;
    vec3 SR_standard_surface_subsurface_radius;
    float SR_standard_surface_subsurface_scale;
    float SR_standard_surface_sheen;
    vec3 SR_standard_surface_sheen_color;
    float SR_standard_surface_sheen_roughness;
    float SR_standard_surface_coat;
    vec3 SR_standard_surface_coat_color;
    float SR_standard_surface_coat_roughness;
    float SR_standard_surface_coat_anisotropy;
    float SR_standard_surface_coat_rotation;
    float SR_standard_surface_coat_IOR;
    float SR_standard_surface_coat_affect_color;
    float SR_standard_surface_coat_affect_roughness;
    float SR_standard_surface_thin_film_thickness;
    float SR_standard_surface_thin_film_IOR;
    float SR_standard_surface_emission;
    vec3 SR_standard_surface_emission_color;
    vec3 SR_standard_surface_opacity;
    bool SR_standard_surface_thin_walled;
};
layout(binding = 0, std140) uniform PrivateUniforms {
    mat4 u_worldMatrix;
    mat4 u_worldInverseTransposeMatrix;
    mat4 u_viewProjectionMatrix;
    vec3 u_viewPosition;
    int u_numActiveLightSources;
    mat4 u_envMatrix;
    int u_envRadianceMips;
    int u_envRadianceSamples;
    float u_envLightIntensity;
    float u_alphaThreshold;
    bool u_refractionTwoSided;
};
struct LightData {
    int type;
    vec3 direction;
    vec3 color;
    float intensity;
    vec3 position;
    float decay_rate;
    float inner_angle;
    float outer_angle;
};
layout(binding = 2, std140) uniform LightData_block { LightData u_lightData[3]; };
layout(binding = 3) uniform sampler2D u_envRadiance;
layout(binding = 4) uniform sampler2D u_envIrradiance;
layout(location = 0) in vec3 vd_positionWorld;
layout(location = 1) in vec3 vd_normalWorld;
layout(location = 2) in vec3 vd_tangentWorld;
layout(location = 0) out vec4 out1;

// Reflectance of a dielectric that faces the viewer.
float mx_fresnel_dielectric_facing(const float ior)
{
    float r = (1.0 - ior) / (1.0 + ior);
    return r * r;
}

// Light of one polarisation that interferes in a film, as Gaussian i of the CIE curves sees it: `a` is the amplitude of
// the film's interface, r that of the interface below, and light in the film goes further by d / (2 pi) micrometres.
float mx_film_light(const float a, const vec2 r, const float d, const int i)
{
    vec4 gaussian = mat4(1.681, 0.846202, -0.0043278, 0.0, 2.2399, 0.153798, -0.0045282, 0.0, 1.7953, 1.0, -0.0093046,
        0.0, 2.2084, 1.0, -0.0066121, 0.0)[i];
    float decay = exp(gaussian.z * d * d);
    float d2 = decay * decay;
    float d4 = d2 * d2;
    float r23 = dot(r, r);
    float path = -a * decay * (r.x * cos(gaussian.x * d) - r.y * sin(gaussian.x * d));
    float square = a * a * r23 * d2;
    float rest = (2.0 * path * path - square - d4 * square * path) / (1.0 - 2.0 * d4 * path + d4 * d4 * square);
    float t = 1.0 - a * a;
    float even = t * t * r23 / (1.0 - a * a * r23);
    return gaussian.y * (a * a + even + 2.0 * (even - t) * (path + d2 * rest));
}

// Complex amplitude (x - u) / (x + u) of an interface in one polarisation: u is the index times the cosine behind it; x
// is the cosine for perpendicular light, and the permittivity times the cosine for parallel light.
vec2 mx_film_amplitude(const vec2 x, const vec2 u)
{
    return vec2(dot(x, x) - dot(u, u), 2.0 * (x.y * u.x - x.x * u.y)) / dot(x + u, x + u);
}

// The index times the cosine behind an interface, u + iv, from the cosine in front of it and the permittivity:
//     (u + iv)^2 = re + i im - sin^2
vec2 mx_fresnel_refract(const float cosine, const float re, const float im)
{
    float t = re + (cosine * cosine - 1.0);
    float norm = sqrt(t * t + im * im);
    return sqrt(max(0.5 * vec2(norm + t, norm - t), vec2(0.0)));
}

// Reflectance, facing the viewer, of a film on an interface with the permittivity re + i im.
vec3 mx_film_index_facing(const vec3 re, const vec3 im, const float film, const float film_ior)
{
    float ior = max(film_ior, 1.0);
    float a = (1.0 - ior) / (1.0 + ior);
    float d = 0.012566372 * ior * film;
    vec3 xyz = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        int channel = max(i - 1, 0);
        xyz[channel] += mx_film_light(a,
            mx_film_amplitude(vec2(1.0, 0.0),
            mx_fresnel_refract(1.0, re[channel] / (ior * ior), im[channel] / (ior * ior))), d, i);
    }
    return clamp(mat3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * xyz, vec3(0.0), vec3(1.0));
}

// Reflectance, facing the viewer, of an interface.
// Here model = "dielectric", k = vec3(0.0).
vec3 mx_fresnel_facing(const vec3 n, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_index_facing(n * n, vec3(0.0), film, film_ior);
    return vec3(mx_fresnel_dielectric_facing(n.x));
}

// Squared roughness along X and across: the aspect ratio stretches one axis and shrinks the other (Burley 2012, section
// 5.4).
vec2 mx_roughness_anisotropy(const float roughness, const float anisotropy)
{
    float squared = clamp(roughness * roughness, 1e-8, 1.0);
    float aspect = sqrt(1.0 - clamp(anisotropy, 0.0, 0.98));
    return vec2(min(squared / aspect, 1.0), squared * aspect);
}

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
float mx_bicubic(const mat4 m, const float x, const float y)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, y, y * y, y * y * y));
}

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
vec2 mx_ggx_albedo_fit(const float a, const float c)
{
    float x = clamp(1.0 - c - a * mx_bicubic(mat4(-0.2174, 5.3819, -3.911, 0.2674, -9.7298, 3.9904, 3.8225, -0.0277,
        36.4897, -72.9122, 58.0878, -20.917, -31.4763, 79.0768, -73.9706, 26.5429), a / (a + c), a), 0.0, 1.0);
    float u = a / (a + 0.6 * c);
    return vec2(min(1.0017 - u * u * mx_bicubic(mat4(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238, 8.7382,
        4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.206, -83.1538, 52.7528), u, a * c), 1.0), x * x * x * x * x);
}

// The vector v turned clockwise around an axis of unit length, by an angle in radians (Rodrigues' formula).
vec3 mx_rotate3d(const vec3 v, const float angle, const vec3 axis)
{
    float c = cos(angle);
    return v * c + cross(v, axis) * sin(angle) + axis * (dot(axis, v) * (1.0 - c));
}

// cos (1 + 2 Lambda) of a direction for GGX; `area` is the product of the roughness along x and y (Heitz 2014,
// "Understanding the Masking-Shadowing Function", equation 72).
float mx_ggx_masking(const float cosine, const float area)
{
    return sqrt(area + (1.0 - area) * (cosine * cosine));
}

// The GGX lobe of a surface as lights see it; roughness is that along X and across, squared.
// Here is_round = false.
mx_GgxLobe mx_ggx_lobe(const vec2 roughness, const vec3 N, const vec3 X, const vec3 V)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    float cosine = max(abs(dot(N, V)), 1e-8);
    return mx_GgxLobe(faceforward(N, -V, N), cosine, normalize(X - dot(X, N) * N), alpha,
        mx_ggx_masking(cosine, alpha.x * alpha.y));
}

// The square of the length of the facet's normal H after the roughness divided its parts along the surface, times the
// product of the roughness along x and y; cos_h is its part along N.
// Here is_round = false, is_wide = false.
float mx_ggx_stretched(const mx_GgxLobe lobe, const vec3 H, const float cos_h)
{
    vec2 parts = vec2(dot(H, lobe.x), dot(cross(H, lobe.N), lobe.x)) / lobe.alpha;
    return lobe.alpha.x * lobe.alpha.y * (dot(parts, parts) + cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = false, is_wide = false.
float mx_ggx_light(const mx_GgxLobe lobe, const vec3 V, const vec3 L)
{
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = mx_ggx_stretched(lobe, V + L, lobe.cosine + dot(lobe.N, L));
    return area / 6.2831855 * square * square * cos_l
        / (e * e * (lobe.cosine * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * lobe.masking));
}

// Unpolarised reflectance of an interface whose squared index is `re`, with c for the cosine in front of it:
//     F = ((c - g)^2 / (c + g)^2) (1 + (cg - s)^2 / (cg + s)^2) / 2
//     s = 1 - c^2,  g^2 = c^2 + 2k,  2k = re - 1
float mx_fresnel_permittivity(const float cosine, const float re)
{
    float k = 0.5 * (re - 1.0);
    float c2 = max(cosine * cosine, -2.0 * k);
    float s = 1.0 - c2;
    float cg2 = c2 * (c2 + 2.0 * k);
    float r = k / max((1.0 + k) * (c2 + sqrt(cg2)) + k, 1e-8);
    return (cg2 + s * s) * (r * r);
}

// Index and extinction of a conductor with this reflectivity facing the viewer, and this colour at the edge
// (Gulbrandsen 2014, "Artist Friendly Metallic Fresnel").
void mx_artistic_ior(const vec3 reflectivity, const vec3 edge_color, out vec3 ior, out vec3 extinction)
{
    vec3 s = sqrt(clamp(reflectivity, vec3(0.0), vec3(0.99)));
    vec3 greatest = (vec3(1.0) + s) / (vec3(1.0) - s);
    ior = mix(greatest, (vec3(1.0) - s * s) / (vec3(1.0) + s * s), edge_color);
    extinction = sqrt(max((greatest - ior) * (ior - vec3(1.0) / greatest), vec3(0.0)));
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
vec3 mx_fresnel_conductor(const float cosine, const vec3 re, const vec3 im)
{
    vec3 color = vec3(0.0);
    for (int i = 0; i < 3; ++i)
        color[i] = mx_fresnel_conductor(cosine, re[i], im[i]);
    return color;
}

// Reflectance, facing the viewer, of an interface.
// Here model = "conductor".
vec3 mx_fresnel_facing(const vec3 n, const vec3 k, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_index_facing(n, k, film, film_ior);
    return mx_fresnel_conductor(1.0, n, k);
}

// Amplitudes of a film's own interface, of perpendicular and parallel light; `inside` is the cosine in the film.
vec2 mx_film_amplitudes(const float cosine, const float inside, const float ior)
{
    vec2 x = vec2(cosine, ior * cosine);
    vec2 u = vec2(ior * inside, inside);
    return (x - u) / (x + u);
}

// Reflectance of a film on an interface with the permittivity re + i im.
vec3 mx_film_index(const float cosine, const vec3 re, const vec3 im, const float film, const float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.012566372 * ior * c * film;
    vec3 xyz = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        int channel = max(i - 1, 0);
        vec2 below = vec2(re[channel], im[channel]) / (ior * ior);
        vec2 u = mx_fresnel_refract(c, below.x, below.y);
        vec2 x = vec2(c, 0.0);
        for (int p = 0; p < 2; ++p) {
            xyz[channel] += mx_film_light(a[p], mx_film_amplitude(x, u), d, i);
            x = c * below;
        }
    }
    return clamp(mat3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * (0.5 * xyz), vec3(0.0), vec3(1.0));
}

// Reflectance of an interface at a cosine.
// Here model = "conductor", f90 = vec3(1.0), exponent = 0.0.
vec3 mx_fresnel(const float cosine, const vec3 n, const vec3 k, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_index(cosine, n, k, film, film_ior);
    return mx_fresnel_conductor(cosine, n, k);
}

// Reflectance of an interface at a cosine.
// Here model = "dielectric", k = vec3(0.0), f90 = vec3(1.0), exponent = 0.0.
vec3 mx_fresnel(const float cosine, const vec3 n, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_index(cosine, n * n, vec3(0.0), film, film_ior);
    return vec3(mx_fresnel_permittivity(cosine, n.x * n.x));
}

// Light that arrives at a point of a circle of this curvature by subsurface scattering, where the cosine of the light
// is cos_l: Burley's normalised diffusion (Christensen 2015) around the circle (after Penner 2011, "Pre-integrated skin
// shading").
float mx_subsurface_light(const float radius, const float curvature, const float cos_l)
{
    float x = curvature * max(radius, 0.1);
    vec3 bend = (vec3(0.1573, 0.0104, 0.1632) + x * (vec3(0.662, 0.1732, 0.6079) + x * vec3(0.6075, 0.4138, 0.8133)))
        / (6.2831855 * (0.1602 + x * (0.6652 + x)));
    return bend.x * cos_l + sqrt(bend.y * bend.y + (bend.z * bend.z - bend.y * bend.y) * (cos_l * cos_l));
}

// Light that arrives by subsurface scattering, with a radius for each channel.
vec3 mx_subsurface_light(const vec3 radius, const float curvature, const float cos_l)
{
    vec3 light = vec3(0.0);
    for (int i = 0; i < 3; ++i)
        light[i] = mx_subsurface_light(radius[i], curvature, cos_l);
    return light;
}

// The angle, over pi, with this sine and cosine; the cosine is not negative. It errs by 2.9e-5 at most.
float mx_half_turn(const float sine, const float cosine)
{
    return sine * (0.4999709 + cosine * (cosine * (0.2302802 + cosine * (0.0398298 * cosine - 0.1351235)) - 0.3164252));
}

// The square of the distance of the unit direction d from the vertical axis, never 0.
float mx_map_square(const vec3 d)
{
    return d.x * d.x + (d.z * d.z + 1e-16);
}

// The point of the latitude-longitude picture for the unit direction d, to a tenth of a texel in 4096.
vec2 mx_map_point(const vec3 d)
{
    float square = mx_map_square(d);
    float stretch = inversesqrt(square);
    return vec2(fract((d.z > 0.0 ? -0.5 : 0.5) * (mx_half_turn(d.x * stretch, abs(d.z) * stretch) + 0.5) + 0.25),
        0.5 - mx_half_turn(d.y, square * stretch));
}

// The number of samples, from 1, that a lobe takes; roughness is that along two directions, squared.
int mx_sample_count(const vec2 roughness)
{
    float wide = max(roughness.x, roughness.y);
    float share = 0.5 * min(4.0 * sqrt(wide), 1.0);
    share = min(share * wide / min(roughness.x, roughness.y), 1.0);
    return max(int(ceil(share * float(u_envRadianceSamples))), 1);
}

// The GGX lobe of a surface as samples of the environment see it.
// Here is_round = false.
mx_GgxSamples mx_ggx_samples(const vec2 roughness, const int count, const vec3 N, const vec3 X, const vec3 V)
{
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, N, X, V);
    vec3 x = lobe.x;
    mat3 frame = mat3(x, cross(lobe.N, x), lobe.N);
    vec3 v = vec3((V * frame).xy, lobe.cosine);
    vec3 stretch = vec3(lobe.alpha, 1.0);
    float reach = length(v * stretch);
    float area = stretch.x * stretch.y;
    float share = 1.0 / float(count);
    return mx_GgxSamples(mat3(u_envMatrix) * frame, stretch, area, v, lobe.masking, reach, share * (v.z + reach),
        area * (v.z + lobe.masking) * max(2.0 / float(count), 4.4 / float(max(u_envRadianceSamples, 1)))
        * exp2(2.0 * float(u_envRadianceMips) - 4.6485), u_envLightIntensity * (share * (v.z + lobe.masking)));
}

// Light of the environment from the unit direction d of its picture, filtered over as many texels.
vec3 mx_filtered_light(const vec3 d, const float texels)
{
    return textureLod(u_envRadiance, mx_map_point(d), 0.5 * log2(texels * inversesqrt(mx_map_square(d)))).xyz;
}

// Height-correlated masking and shadowing G2 over 2 cos_v cos_l (Heitz 2014, equation 99); `masking` is that of the
// viewer.
float mx_ggx_visibility(const float cos_v, const float masking, const float area, const float cos_l)
{
    return 1.0 / (cos_v * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * masking);
}

// A normal of those visible from v, at any length (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical
// Caps"): v is stretched by the roughness and has the length `reach`, `around` is (cos, sin) of the turn around z, and
// `depth` how far the normal lies below the top of the cap, v.z + reach at most.
vec3 mx_ggx_cap(const vec2 around, const float depth, const vec3 v, const float reach)
{
    return v + vec3(sqrt(depth * (2.0 * reach - depth)) * around, reach - depth);
}

// The facet of sample i. Samples are spherical Fibonacci points (Marques et al. 2013): each is the golden angle further
// around than the one before, by its `turn`.
mx_GgxFacet mx_ggx_facet(const mx_GgxSamples s, const int i, const vec2 turn)
{
    vec3 h = mx_ggx_cap(turn, (float(i) + 0.5) * s.step, s.v * s.stretch, s.reach) * s.stretch;
    float cosine = dot(s.v, h);
    float mirror = 2.0 * cosine / dot(h, h);
    return mx_GgxFacet(h, cosine, mirror, mirror * mirror * s.texels);
}

// The light that the facet of sample i reflects.
mx_GgxLight mx_ggx_reflected(const mx_GgxSamples s, const int i, const vec2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    vec3 l = facet.mirror * facet.h - s.v;
    float cos_l = max(l.z, 1e-8);
    return mx_GgxLight(mx_filtered_light(s.to_map * l, facet.texels),
        s.weight * cos_l * mx_ggx_visibility(s.v.z, s.masking, s.area, cos_l),
        sqrt(clamp(0.5 * (facet.mirror * facet.cosine), 1e-8, 1.0)));
}

// The light that comes to the facet of sample i through a solid sphere of index `ior` behind it.
mx_GgxLight mx_ggx_transmitted(const mx_GgxSamples s, const float ior, const int i, const vec2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    vec3 h = normalize(facet.h);
    return mx_GgxLight(mx_filtered_light(s.to_map * reflect(s.v, refract(-s.v, h, 1.0 / ior)), facet.texels),
        s.weight * 0.5 / s.v.z, clamp(dot(s.v, h), 1e-8, 1.0));
}

void main()
{
    // SR_standard_surface
    float coat_weight = clamp(SR_standard_surface_coat, 0.0, 1.0);
    float coat_IOR = SR_standard_surface_coat_IOR;
    float coat_front = coat_IOR * 4.0 / ((coat_IOR + 1.0) * (coat_IOR + 1.0));
    vec3 N = normalize(vd_normalWorld);
    vec3 V = normalize(u_viewPosition - vd_positionWorld);
    float absolute = abs(dot(N, V));
    vec3 color = SR_standard_surface_emission
        * (SR_standard_surface_emission_color
        * (1.0 - coat_weight + SR_standard_surface_coat_color
        * (coat_weight * (coat_front * (1.0 - pow(1.0 - min(absolute, 1.0), 5.0))))));
    // lights
    vec3 vector_coat_gamma = vec3(SR_standard_surface_coat_affect_color * coat_weight + 1.0);
    float specular_IOR = SR_standard_surface_specular_IOR;
    float thin_film_thickness = SR_standard_surface_thin_film_thickness;
    float thin_film_IOR = SR_standard_surface_thin_film_IOR;
    float coat_blur = SR_standard_surface_coat_roughness
        * (SR_standard_surface_coat * SR_standard_surface_coat_affect_roughness);
    vec2 roughness = mx_roughness_anisotropy(mix(SR_standard_surface_specular_roughness, 1.0, coat_blur),
        SR_standard_surface_specular_anisotropy);
    vec2 alpha = clamp(roughness, 1e-8, 1.0);
    float cos_v = max(absolute, 1e-8);
    vec2 albedo = mx_ggx_albedo_fit(sqrt(alpha.x * alpha.y), cos_v);
    float lost = 1.0 / albedo.x - 1.0;
    vec3 reflection_scale = mix(mx_fresnel_facing(vec3(specular_IOR), thin_film_thickness, thin_film_IOR), vec3(1.0),
        0.04761905) * lost + vec3(1.0);
    float reflection_weight = clamp(SR_standard_surface_specular, 0.0, 1.0);
    float reflection_r = (1.0 - specular_IOR) / (specular_IOR + 1.0);
    vec3 clamped_coat_tint = clamp(mix(vec3(1.0), SR_standard_surface_coat_color, SR_standard_surface_coat), 0.0, 1.0);
    float coating_r = (1.0 - coat_IOR) / (coat_IOR + 1.0);
    vec2 coat_lobe = mx_roughness_anisotropy(SR_standard_surface_coat_roughness, SR_standard_surface_coat_anisotropy);
    vec2 coating_alpha = clamp(coat_lobe, 1e-8, 1.0);
    vec2 coating_albedo = mx_ggx_albedo_fit(sqrt(coating_alpha.x * coating_alpha.y), cos_v);
    float coating_scale = mix(coating_r * coating_r, 1.0, 0.04761905) * (1.0 / coating_albedo.x - 1.0) + 1.0;
    float coating_throughput = 1.0 - coat_weight
        * (mix(coating_r * coating_r, 1.0, coating_albedo.y) * coating_albedo.x * coating_scale);
    vec3 body_weight = (vec3(1.0) - reflection_scale
        * (reflection_weight * (mix(reflection_r * reflection_r, 1.0, albedo.y) * albedo.x)))
        * (clamped_coat_tint * coating_throughput);
    float fuzz_weight = clamp(SR_standard_surface_sheen, 0.0, 1.0);
    float sheen_albedo = clamp(mx_bicubic(mat4(3.7341, -15.9587, 23.621, -11.0989, -8.2265, 35.1081, -49.7137, 23.2945,
        4.0691, -17.882, 25.6639, -12.0167, -0.5833, 2.6552, -3.9393, 1.8999), 1.0 / (cos_v + 1.0),
        1.0 / (SR_standard_surface_sheen_roughness + 0.2)), 0.0, 1.0);
    float fuzz_throughput = 1.0 - fuzz_weight * sheen_albedo;
    float metal_weight = clamp(SR_standard_surface_metalness, 0.0, 1.0);
    float clamped_transmission = clamp(SR_standard_surface_transmission, 0.0, 1.0);
    float opaque_weight = (1.0 - metal_weight) * (1.0 - clamped_transmission);
    float clamped_subsurface = clamp(SR_standard_surface_subsurface, 0.0, 1.0);
    vec3 diffuse_weight = body_weight * (fuzz_throughput
        * (clamp(SR_standard_surface_base, 0.0, 1.0) * (opaque_weight * (1.0 - clamped_subsurface))));
    vec3 diffuse_product = pow(max(SR_standard_surface_base_color, 0.0), vector_coat_gamma) * diffuse_weight;
    vec3 Nf = faceforward(N, -V, N);
    float r2 = SR_standard_surface_diffuse_roughness * SR_standard_surface_diffuse_roughness;
    vec2 ab = r2 * vec2(-0.5, 0.45) / (r2 + vec2(0.33, 0.09)) + vec2(1.0, 0.0);
    float s = 1.0 / max(SR_standard_surface_sheen_roughness, 0.005);
    vec3 fuzz_factor = SR_standard_surface_sheen_color * (body_weight * (fuzz_weight * opaque_weight));
    vec3 scatter_color = pow(max(SR_standard_surface_subsurface_color, 0.0), vector_coat_gamma);
    float thin = float(SR_standard_surface_thin_walled);
    float translucent_weight = thin * (clamped_subsurface * opaque_weight);
    vec3 translucent_factor = scatter_color * (body_weight * (fuzz_throughput * translucent_weight));
    vec3 tangent_direction = normalize(vd_tangentWorld);
    vec3 coat_tangent = mx_rotate3d(tangent_direction, radians(SR_standard_surface_coat_rotation * 360.0), N);
    mx_GgxLobe coating_lobe = mx_ggx_lobe(coat_lobe, N, coat_tangent, V);
    vec3 metal_ior, metal_extinction;
    mx_artistic_ior(SR_standard_surface_base * SR_standard_surface_base_color,
        SR_standard_surface_specular * SR_standard_surface_specular_color, metal_ior, metal_extinction);
    vec3 re = metal_ior * metal_ior - metal_extinction * metal_extinction;
    vec3 im = metal_extinction * (metal_ior * 2.0);
    vec3 metal_scale = lost * mix(mx_fresnel_facing(re, im, thin_film_thickness, thin_film_IOR), vec3(1.0), 0.04761905)
        + vec3(1.0);
    vec3 metal_factor = metal_scale * (clamped_coat_tint * (metal_weight * coating_throughput));
    vec3 specular_tangent = mx_rotate3d(tangent_direction, radians(SR_standard_surface_specular_rotation * 360.0), N);
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, N, specular_tangent, V);
    float reflection_weight_2 = reflection_weight * (1.0 - metal_weight);
    vec3 reflection_factor = clamped_coat_tint * (coating_throughput * reflection_weight_2)
        * (reflection_scale * max(SR_standard_surface_specular_color, 0.0));
    float scatter_weight = clamped_subsurface * opaque_weight * (1.0 - thin);
    vec3 scatter_radius = SR_standard_surface_subsurface_radius * SR_standard_surface_subsurface_scale;
    float curvature = max(length(fwidth(Nf)) / max(length(fwidth(vd_positionWorld)), 1e-20), 0.01);
    vec3 scatter_factor = scatter_color * (body_weight * (fuzz_throughput * scatter_weight));
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        vec3 L;
        float intensity;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            vec3 d = u_lightData[i].position - vd_positionWorld;
            vec3 to_light = normalize(d);
            L = to_light;
            float falloff = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
            } else {
                float edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light)) * falloff
                    : 0.0;
            }
        }
        // fuzz, translucent, diffuse
        vec3 light_color = u_lightData[i].color;
        float cos_l = dot(L, Nf);
        float cos_l_2 = max(cos_l, 1e-8);
        float v_dot_l = dot(V, L);
        vec3 diffuse_response = diffuse_product * 0.31830987
            * (cos_l_2 * (ab.x + ab.y * max(v_dot_l - cos_v * cos_l_2, 0.0) / max(cos_l_2, cos_v)));
        float scaled_along = (cos_v + cos_l) * (cos_v + cos_l);
        float fuzz_product = cos_l_2 * ((s + 2.0)
            * pow(clamp(1.0 - scaled_along / max(v_dot_l * 2.0 + 2.0, 1e-8), 0.0, 1.0), s * 0.5) / 6.2831855);
        vec3 fuzz_response = fuzz_product / ((cos_v + cos_l_2 - cos_v * cos_l_2) * 4.0) * fuzz_factor;
        color += light_color * (intensity
            * (diffuse_response + (fuzz_response + max(-cos_l, 0.0) / 3.1415927 * translucent_factor)));
        // coating
        float half_cosine = sqrt(clamp(v_dot_l * 0.5 + 0.500001, 0.0, 1.0));
        if (coat_weight > 0.0) {
            float coating_product = mx_fresnel_permittivity(half_cosine, coat_IOR * coat_IOR)
                * (coat_weight * coating_scale);
            color += light_color * (intensity * (mx_ggx_light(coating_lobe, V, L) * coating_product));
        }
        // metal
        float ggx_light = mx_ggx_light(lobe, V, L);
        if (metal_weight > 0.0)
            color += light_color * (intensity
                * (metal_factor * (mx_fresnel(half_cosine, re, im, thin_film_thickness, thin_film_IOR) * ggx_light)));
        // reflection
        if (reflection_weight_2 > 0.0)
            color += light_color * (intensity
                * (reflection_factor * (ggx_light
                * mx_fresnel(half_cosine, vec3(specular_IOR), thin_film_thickness, thin_film_IOR))));
        // scatter
        if (scatter_weight > 0.0)
            color += light_color * (intensity
                * (mx_subsurface_light(scatter_radius, curvature, cos_l) * scatter_factor));
    }
    // environment: fuzz, scatter, diffuse
    vec3 part = textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * Nf)), 0.0).xyz;
    vec2 fit = SR_standard_surface_diffuse_roughness
        * (cos_v * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076)
        + SR_standard_surface_diffuse_roughness * vec2(1.4385, 2.0315)) + vec2(1.0);
    vec3 diffuse_response = diffuse_product * part * (u_envLightIntensity * clamp(fit.x / fit.y, 0.0, 1.0));
    vec3 fuzz_response = fuzz_factor * part * (sheen_albedo * u_envLightIntensity);
    color += diffuse_response + (fuzz_response + u_envLightIntensity * (scatter_factor * part));
    // environment: translucent
    if (translucent_weight > 0.0)
        color += u_envLightIntensity * (translucent_factor
            * textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * -Nf)), 0.0).xyz);
    // environment: coating
    if (coat_weight > 0.0) {
        vec2 turn = vec2(1.0, 0.0);
        int coating_count = mx_sample_count(coating_alpha);
        mx_GgxSamples coating_ggx_samples = mx_ggx_samples(coat_lobe, coating_count, N, coat_tangent, V);
        for (int i = 0; i < coating_count; ++i) {
            mx_GgxLight coating_light = mx_ggx_reflected(coating_ggx_samples, i, turn);
            float fresnel_bare = mx_fresnel_permittivity(coating_light.cosine, coat_IOR * coat_IOR);
            color += coating_light.color * (fresnel_bare * (coat_weight * coating_scale * coating_light.weight));
            turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // environment: metal, reflection
    float scaled_specular_IOR = specular_IOR * specular_IOR;
    if (metal_weight > 0.0 || reflection_weight_2 > 0.0) {
        int count = mx_sample_count(alpha);
        mx_GgxSamples ggx_samples = mx_ggx_samples(roughness, count, N, specular_tangent, V);
        if (thin_film_thickness > 0.0) {
            vec2 turn = vec2(1.0, 0.0);
            for (int i = 0; i < count; ++i) {
                mx_GgxLight light = mx_ggx_reflected(ggx_samples, i, turn);
                if (metal_weight > 0.0)
                    color += metal_factor
                        * (light.color * (light.weight
                        * mx_film_index(light.cosine, re, im, thin_film_thickness, thin_film_IOR)));
                if (reflection_weight_2 > 0.0)
                    color += reflection_factor
                        * (light.color * (light.weight
                        * mx_film_index(light.cosine, vec3(scaled_specular_IOR), vec3(0.0), thin_film_thickness,
                        thin_film_IOR)));
                turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        } else {
            vec2 turn = vec2(1.0, 0.0);
            for (int i = 0; i < count; ++i) {
                mx_GgxLight light = mx_ggx_reflected(ggx_samples, i, turn);
                if (metal_weight > 0.0)
                    color += metal_factor * (light.color * (light.weight * mx_fresnel_conductor(light.cosine, re, im)));
                if (reflection_weight_2 > 0.0)
                    color += reflection_factor
                        * (light.color * (light.weight * mx_fresnel_permittivity(light.cosine, scaled_specular_IOR)));
                turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        }
    }
    // environment: refraction
    float refraction_weight = clamped_transmission * (1.0 - metal_weight);
    if (refraction_weight > 0.0) {
        vec2 turn = vec2(1.0, 0.0);
        float transmission_blurred = mix(clamp(SR_standard_surface_specular_roughness
            + SR_standard_surface_transmission_extra_roughness, 0.0, 1.0), 1.0, coat_blur);
        vec2 transmission_roughness = mx_roughness_anisotropy(transmission_blurred,
            SR_standard_surface_specular_anisotropy);
        int refraction_count = mx_sample_count(clamp(transmission_roughness, 1e-8, 1.0));
        vec3 tint = max(SR_standard_surface_transmission_color, 0.0);
        vec3 refraction_factor = tint * (u_refractionTwoSided ? tint : vec3(1.0)) * (body_weight * refraction_weight);
        mx_GgxSamples samples = mx_ggx_samples(transmission_roughness, refraction_count, N, specular_tangent, V);
        for (int i = 0; i < refraction_count; ++i) {
            mx_GgxLight refraction_light = mx_ggx_transmitted(samples, specular_IOR, i, turn);
            color += refraction_factor * (refraction_light.color
                * (refraction_light.weight
                * (1.0 - mx_fresnel_permittivity(refraction_light.cosine, scaled_specular_IOR))));
            turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // opacity
    float opacity = clamp(dot(SR_standard_surface_opacity, vec3(0.2722287, 0.6740818, 0.0536895)), 0.0, 1.0);
    if (opacity < u_alphaThreshold)
        discard;
    out1 = vec4(opacity * color, opacity);
}
