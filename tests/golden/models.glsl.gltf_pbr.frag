#version 450
// gltf_pbr · surfacematerial · mxgen 0.1 · glsl · complete · 9 closures · 0 textures

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
uniform vec3 SR_gltf_pbr_base_color = vec3(1.0);
uniform float SR_gltf_pbr_metallic = 1.0;
uniform float SR_gltf_pbr_roughness = 1.0;
uniform float SR_gltf_pbr_transmission = 0.0;
uniform float SR_gltf_pbr_specular = 1.0;
uniform vec3 SR_gltf_pbr_specular_color = vec3(1.0);
uniform float SR_gltf_pbr_ior = 1.5;
uniform float SR_gltf_pbr_alpha = 1.0;
uniform int SR_gltf_pbr_alpha_mode = 0;
uniform float SR_gltf_pbr_alpha_cutoff = 0.5;
uniform float SR_gltf_pbr_iridescence = 0.0;
uniform float SR_gltf_pbr_iridescence_ior = 1.3;
uniform float SR_gltf_pbr_iridescence_thickness = 100.0;
uniform vec3 SR_gltf_pbr_sheen_color = vec3(0.0);
uniform float SR_gltf_pbr_sheen_roughness = 0.0;
uniform float SR_gltf_pbr_clearcoat = 0.0;
uniform float SR_gltf_pbr_clearcoat_roughness = 0.0;
uniform vec3 SR_gltf_pbr_emissive = vec3(0.0);
uniform float SR_gltf_pbr_emissive_strength = 1.0;
uniform float SR_gltf_pbr_anisotropy_strength = 0.0;
uniform float SR_gltf_pbr_anisotropy_rotation = 0.0;
uniform vec3 u_viewPosition = vec3(0.0);
uniform int u_numActiveLightSources = 0;
uniform mat4 u_envMatrix = mat4(-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
uniform int u_envRadianceMips = 1;
uniform int u_envRadianceSamples = 16;
uniform float u_envLightIntensity = 1.0;
uniform float u_alphaThreshold = 0.001;
uniform bool u_refractionTwoSided = false;
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
uniform LightData u_lightData[3];
uniform sampler2D u_envRadiance;
uniform sampler2D u_envIrradiance;
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 tangentWorld;
} vd;
out vec4 out1;

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

// Amplitudes of an interface of reflectance f below a film of index `ior`: negative where f0 says that the index behind
// the film is lower.
vec3 mx_film_turned(const vec3 f0, const vec3 f, const float ior)
{
    return (vec3(1.0) - 2.0 * step(sqrt(clamp(f0, vec3(0.01), vec3(0.99))), vec3((ior - 1.0) / (ior + 1.0))))
        * sqrt(max(0.5 * f, vec3(0.0)));
}

// Reflectance, facing the viewer, of a film on an interface of colour f0.
vec3 mx_film_schlick_facing(const vec3 f0, const float film, const float film_ior)
{
    float ior = max(film_ior, 1.0);
    float a = (1.0 - ior) / (1.0 + ior);
    float d = 0.012566372 * ior * film;
    vec3 r = mx_film_turned(f0, f0, ior);
    vec3 xyz = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        int channel = max(i - 1, 0);
        xyz[channel] += mx_film_light(a, vec2(-r[channel], 0.0), d, i);
    }
    return clamp(mat3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * xyz, vec3(0.0), vec3(1.0));
}

// Reflectance, facing the viewer, of an interface.
// Here model = "schlick", k = vec3(0.0).
vec3 mx_fresnel_facing(const vec3 n, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_schlick_facing(n, film, film_ior);
    return n;
}

// The square of the length of the facet's normal H after the roughness divided its parts along the surface, times the
// product of the roughness along x and y; cos_h is its part along N.
// Here is_round = true, is_wide = false.
float mx_ggx_stretched(const mx_GgxLobe lobe, const vec3 H, const float cos_h)
{
    vec3 slope = H - cos_h * lobe.N;
    return dot(slope, slope) + lobe.alpha.x * lobe.alpha.y * (cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = true, is_wide = false.
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

// Schlick's curve from f0 to f90 at a cosine, less `bend` times cos (1 - cos)^6.
// Here bend = vec3(0.0), exponent = 5.0.
vec3 mx_fresnel_schlick(const float cosine, const vec3 f0, const vec3 f90)
{
    float x = 1.0 - cosine;
    return mix(f0, f90, x * x * x * x * x);
}

// Amplitudes of a film's own interface, of perpendicular and parallel light; `inside` is the cosine in the film.
vec2 mx_film_amplitudes(const float cosine, const float inside, const float ior)
{
    vec2 x = vec2(cosine, ior * cosine);
    vec2 u = vec2(ior * inside, inside);
    return (x - u) / (x + u);
}

// Reflectance of a film on an interface with Schlick's curve.
// Here bend = vec3(0.0), exponent = 5.0.
vec3 mx_film_schlick(const float cosine, const vec3 f0, const vec3 f90, const float film, const float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.012566372 * ior * c * film;
    vec3 r = mx_film_turned(f0, mx_fresnel_schlick(c, f0, f90), ior);
    vec3 xyz = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        int channel = max(i - 1, 0);
        float below = r[channel];
        for (int p = 0; p < 2; ++p) {
            below = -below;
            xyz[channel] += mx_film_light(a[p], vec2(below, 0.0), d, i);
        }
    }
    return clamp(mat3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * (0.5 * xyz), vec3(0.0), vec3(1.0));
}

// Reflectance of an interface at a cosine.
// Here model = "schlick", k = vec3(0.0), exponent = 5.0.
vec3 mx_fresnel(const float cosine, const vec3 n, const vec3 f90, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_schlick(cosine, n, f90, film, film_ior);
    return mx_fresnel_schlick(cosine, n, f90);
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
float mx_ggx_stretched_2(const mx_GgxLobe lobe, const vec3 H, const float cos_h)
{
    vec2 parts = vec2(dot(H, lobe.x), dot(cross(H, lobe.N), lobe.x)) / lobe.alpha;
    return lobe.alpha.x * lobe.alpha.y * (dot(parts, parts) + cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = false, is_wide = false.
float mx_ggx_light_2(const mx_GgxLobe lobe, const vec3 V, const vec3 L)
{
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = mx_ggx_stretched_2(lobe, V + L, lobe.cosine + dot(lobe.N, L));
    return area / 6.2831855 * square * square * cos_l
        / (e * e * (lobe.cosine * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * lobe.masking));
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

// The GGX lobe of a surface as lights see it; roughness is that along X and across, squared.
// Here is_round = true.
mx_GgxLobe mx_ggx_lobe(const vec2 roughness, const vec3 N, const vec3 V)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    float cosine = max(abs(dot(N, V)), 1e-8);
    return mx_GgxLobe(faceforward(N, -V, N), cosine, vec3(0.0), alpha, mx_ggx_masking(cosine, alpha.x * alpha.y));
}

// The GGX lobe of a surface as samples of the environment see it.
// Here is_round = true.
mx_GgxSamples mx_ggx_samples(const vec2 roughness, const int count, const vec3 N, const vec3 V)
{
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, N, V);
    vec3 x = normalize(V - lobe.cosine * lobe.N + 1e-6 * lobe.N.yzx);
    vec3 v = vec3(sqrt(max(1.0 - lobe.cosine * lobe.cosine, 0.0)), 0.0, lobe.cosine);
    vec3 stretch = vec3(lobe.alpha, 1.0);
    float reach = lobe.masking;
    float area = stretch.x * stretch.y;
    float share = 1.0 / float(count);
    return mx_GgxSamples(mat3(u_envMatrix) * mat3(x, cross(lobe.N, x), lobe.N), stretch, area, v, lobe.masking, reach,
        share * (v.z + reach), area * (v.z + lobe.masking)
        * max(2.0 / float(count), 4.4 / float(max(u_envRadianceSamples, 1)))
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
    vec3 color = SR_gltf_pbr_emissive * SR_gltf_pbr_emissive_strength;
    // lights
    vec3 N = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    // SR_gltf_pbr
    vec3 Nf = faceforward(N, -V, N);
    float amplitude = (1.0 - SR_gltf_pbr_ior) / (SR_gltf_pbr_ior + 1.0);
    vec3 fresnel_f0 = max(SR_gltf_pbr_specular * min(SR_gltf_pbr_specular_color * (amplitude * amplitude), 1.0), 0.0);
    vec3 f90 = vec3(max(SR_gltf_pbr_specular, 0.0));
    float alpha_bitangent = SR_gltf_pbr_roughness * SR_gltf_pbr_roughness;
    vec2 specular_roughness = clamp(vec2(mix(alpha_bitangent, 1.0,
        SR_gltf_pbr_anisotropy_strength * SR_gltf_pbr_anisotropy_strength), alpha_bitangent), 0.00001, 1.0);
    vec2 alpha = clamp(specular_roughness, 1e-8, 1.0);
    float cos_v = max(abs(dot(N, V)), 1e-8);
    vec2 albedo = mx_ggx_albedo_fit(sqrt(alpha.x * alpha.y), cos_v);
    vec3 single = mix(fresnel_f0, f90, albedo.y) * albedo.x;
    float lost = 1.0 / albedo.x - 1.0;
    vec3 reflection_scale = lost * mix(fresnel_f0, f90, 0.04761905) + vec3(1.0);
    float reflection_throughput = 1.0 - dot(single * reflection_scale, vec3(0.33333334));
    vec3 reflection_film_scale = mix(mx_fresnel_facing(fresnel_f0, SR_gltf_pbr_iridescence_thickness,
        SR_gltf_pbr_iridescence_ior), f90, 0.04761905) * lost + vec3(1.0);
    float clamped_iridescence = clamp(SR_gltf_pbr_iridescence, 0.0, 1.0);
    float coating_weight = clamp(SR_gltf_pbr_clearcoat, 0.0, 1.0);
    float coat_lobe = clamp(SR_gltf_pbr_clearcoat_roughness * SR_gltf_pbr_clearcoat_roughness, 1e-8, 1.0);
    vec2 coating_albedo = mx_ggx_albedo_fit(coat_lobe, cos_v);
    float coating_scale = (1.0 / coating_albedo.x - 1.0) * 0.08571429 + 1.0;
    float coating_throughput = 1.0 - coating_weight
        * (mix(0.04, 1.0, coating_albedo.y) * coating_albedo.x * coating_scale);
    float sheen_weight = max(max(SR_gltf_pbr_sheen_color.x, SR_gltf_pbr_sheen_color.y), SR_gltf_pbr_sheen_color.z);
    float fuzz_weight = clamp(sheen_weight, 0.0, 1.0);
    float sheen_rough = SR_gltf_pbr_sheen_roughness * SR_gltf_pbr_sheen_roughness;
    float sheen_albedo = clamp(mx_bicubic(mat4(3.7341, -15.9587, 23.621, -11.0989, -8.2265, 35.1081, -49.7137, 23.2945,
        4.0691, -17.882, 25.6639, -12.0167, -0.5833, 2.6552, -3.9393, 1.8999), 1.0 / (cos_v + 1.0),
        1.0 / (sheen_rough + 0.2)), 0.0, 1.0);
    float substrate_weight = coating_throughput * (1.0 - fuzz_weight * sheen_albedo);
    float body_weight = mix(reflection_throughput, 1.0 - dot(single * reflection_film_scale, vec3(0.33333334)),
        clamped_iridescence) * substrate_weight;
    float metal_weight = clamp(SR_gltf_pbr_metallic, 0.0, 1.0);
    float clamped_transmission = clamp(SR_gltf_pbr_transmission, 0.0, 1.0);
    float diffuse_weight = (1.0 - metal_weight) * (1.0 - clamped_transmission);
    vec3 diffuse_factor = SR_gltf_pbr_base_color * (body_weight * diffuse_weight * 0.31830987);
    float ggx_masking = sqrt(coat_lobe * coat_lobe + (1.0 - coat_lobe * coat_lobe) * (cos_v * cos_v));
    mx_GgxLobe coating_ggx_lobe = mx_GgxLobe(Nf, cos_v, vec3(0.0), vec2(coat_lobe), ggx_masking);
    float s = 1.0 / max(sheen_rough, 0.005);
    vec3 fuzz_factor = SR_gltf_pbr_sheen_color / sheen_weight * (fuzz_weight * coating_throughput);
    bool metal_film_visible = clamped_iridescence * metal_weight > 0.0;
    vec3 fresnel_facing = max(SR_gltf_pbr_base_color, 0.0);
    vec3 metal_film_scale = lost * mix(mx_fresnel_facing(fresnel_facing, SR_gltf_pbr_iridescence_thickness,
        SR_gltf_pbr_iridescence_ior), vec3(1.0), 0.04761905) + vec3(1.0);
    vec3 metal_film_factor = metal_film_scale * (substrate_weight * (clamped_iridescence * metal_weight));
    vec3 specular_tangent = mx_rotate3d(normalize(vd.tangentWorld),
        radians(SR_gltf_pbr_anisotropy_rotation * -57.29578), N);
    mx_GgxLobe lobe = mx_ggx_lobe(specular_roughness, N, specular_tangent, V);
    float metal_bare_weight = metal_weight * (1.0 - clamped_iridescence);
    vec3 metal_bare_factor = (lost * mix(fresnel_facing, vec3(1.0), 0.04761905) + vec3(1.0))
        * (substrate_weight * metal_bare_weight);
    float reflection_film_weight = clamped_iridescence * (1.0 - metal_weight);
    vec3 reflection_film_factor = reflection_film_scale * (substrate_weight * reflection_film_weight);
    float reflection_weight = (1.0 - metal_weight) * (1.0 - clamped_iridescence);
    vec3 reflection_factor = reflection_scale * (substrate_weight * reflection_weight);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        vec3 L;
        float intensity;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            vec3 d = u_lightData[i].position - vd.positionWorld;
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
        // diffuse
        vec3 light_color = u_lightData[i].color;
        float l_dot_nf = dot(L, Nf);
        float cos_l = max(l_dot_nf, 1e-8);
        color += light_color * (intensity * (cos_l * diffuse_factor));
        // coating
        float v_dot_l = dot(V, L);
        float half_cosine = sqrt(clamp(v_dot_l * 0.5 + 0.500001, 0.0, 1.0));
        if (coating_weight > 0.0) {
            float coating_product = mx_fresnel_permittivity(half_cosine, 2.25) * (coating_weight * coating_scale);
            color += light_color * (intensity * (mx_ggx_light(coating_ggx_lobe, V, L) * coating_product));
        }
        // fuzz
        if (fuzz_weight > 0.0) {
            float scaled_along = (cos_v + l_dot_nf) * (cos_v + l_dot_nf);
            float fuzz_product = cos_l * ((s + 2.0)
                * pow(clamp(1.0 - scaled_along / max(v_dot_l * 2.0 + 2.0, 1e-8), 0.0, 1.0), s * 0.5) / 6.2831855);
            color += light_color * (intensity * (fuzz_product / ((cos_v + cos_l - cos_v * cos_l) * 4.0) * fuzz_factor));
        }
        // metal_film
        float ggx_light = mx_ggx_light_2(lobe, V, L);
        if (metal_film_visible)
            color += light_color * (intensity
                * (metal_film_factor * (mx_fresnel(half_cosine, fresnel_facing, vec3(1.0),
                SR_gltf_pbr_iridescence_thickness, SR_gltf_pbr_iridescence_ior) * ggx_light)));
        // metal_bare
        if (metal_bare_weight > 0.0)
            color += light_color * (intensity
                * (metal_bare_factor * (ggx_light * mx_fresnel_schlick(half_cosine, fresnel_facing, vec3(1.0)))));
        // reflection_film
        if (reflection_film_weight > 0.0)
            color += light_color * (intensity
                * (reflection_film_factor
                * (ggx_light * mx_fresnel(half_cosine, fresnel_f0, f90, SR_gltf_pbr_iridescence_thickness,
                SR_gltf_pbr_iridescence_ior))));
        // reflection
        if (reflection_weight > 0.0)
            color += light_color * (intensity
                * (reflection_factor * (ggx_light * mx_fresnel_schlick(half_cosine, fresnel_f0, f90))));
    }
    // environment: fuzz
    vec3 part = textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * Nf)), 0.0).xyz;
    if (fuzz_weight > 0.0) {
        float fuzz_product = u_envLightIntensity * (sheen_albedo * (fuzz_weight * coating_throughput));
        color += SR_gltf_pbr_sheen_color / sheen_weight * part * fuzz_product;
    }
    // environment: diffuse
    if (diffuse_weight > 0.0)
        color += SR_gltf_pbr_base_color * part * (body_weight * diffuse_weight * u_envLightIntensity);
    // environment: coating
    if (coating_weight > 0.0) {
        vec2 turn = vec2(1.0, 0.0);
        int coating_count = mx_sample_count(vec2(coat_lobe));
        mx_GgxSamples coating_ggx_samples = mx_ggx_samples(vec2(coat_lobe), coating_count, N, V);
        for (int i = 0; i < coating_count; ++i) {
            mx_GgxLight coating_light = mx_ggx_reflected(coating_ggx_samples, i, turn);
            color += coating_light.color
                * (mx_fresnel_permittivity(coating_light.cosine, 2.25)
                * (coating_weight * coating_scale * coating_light.weight));
            turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // environment: metal_film, metal_bare, reflection_film, reflection
    int count = mx_sample_count(alpha);
    mx_GgxSamples samples = mx_ggx_samples(specular_roughness, count, N, specular_tangent, V);
    if (reflection_weight > 0.0 || reflection_film_weight > 0.0 || metal_film_visible || metal_bare_weight > 0.0) {
        if (SR_gltf_pbr_iridescence_thickness > 0.0) {
            vec2 turn = vec2(1.0, 0.0);
            for (int i = 0; i < count; ++i) {
                mx_GgxLight light = mx_ggx_reflected(samples, i, turn);
                if (metal_film_visible)
                    color += metal_film_factor
                        * (light.color * (light.weight
                        * mx_film_schlick(light.cosine, fresnel_facing, vec3(1.0), SR_gltf_pbr_iridescence_thickness,
                        SR_gltf_pbr_iridescence_ior)));
                if (metal_bare_weight > 0.0)
                    color += metal_bare_factor
                        * (light.color * (light.weight * mx_fresnel_schlick(light.cosine, fresnel_facing, vec3(1.0))));
                if (reflection_film_weight > 0.0)
                    color += reflection_film_factor
                        * (light.color * (light.weight
                        * mx_film_schlick(light.cosine, fresnel_f0, f90, SR_gltf_pbr_iridescence_thickness,
                        SR_gltf_pbr_iridescence_ior)));
                if (reflection_weight > 0.0)
                    color += reflection_factor
                        * (light.color * (light.weight * mx_fresnel_schlick(light.cosine, fresnel_f0, f90)));
                turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        } else {
            vec2 turn = vec2(1.0, 0.0);
            for (int i = 0; i < count; ++i) {
                mx_GgxLight light = mx_ggx_reflected(samples, i, turn);
                vec3 product = light.color
                    * (light.weight * mx_fresnel_schlick(light.cosine, fresnel_facing, vec3(1.0)));
                color += metal_bare_factor * product + metal_film_factor * product;
                vec3 product_2 = light.color * (light.weight * mx_fresnel_schlick(light.cosine, fresnel_f0, f90));
                if (reflection_film_weight > 0.0)
                    color += reflection_film_factor * product_2;
                if (reflection_weight > 0.0)
                    color += reflection_factor * product_2;
                turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        }
    }
    // environment: refraction
    float refraction_weight = clamped_transmission * (1.0 - metal_weight);
    if (refraction_weight > 0.0) {
        vec2 turn = vec2(1.0, 0.0);
        vec3 refraction_factor = fresnel_facing * (u_refractionTwoSided ? fresnel_facing : vec3(1.0))
            * (body_weight * refraction_weight);
        float scaled_ior = SR_gltf_pbr_ior * SR_gltf_pbr_ior;
        for (int i = 0; i < count; ++i) {
            mx_GgxLight refraction_light = mx_ggx_transmitted(samples, SR_gltf_pbr_ior, i, turn);
            color += refraction_factor * (refraction_light.color
                * (refraction_light.weight * (1.0 - mx_fresnel_permittivity(refraction_light.cosine, scaled_ior))));
            turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // opacity
    float mask = SR_gltf_pbr_alpha >= SR_gltf_pbr_alpha_cutoff ? 1.0 : 0.0;
    float opacity = clamp(1 > SR_gltf_pbr_alpha_mode ? 1.0 : 2 > SR_gltf_pbr_alpha_mode ? mask
        : 3 > SR_gltf_pbr_alpha_mode ? SR_gltf_pbr_alpha : 0.0, 0.0, 1.0);
    if (opacity < u_alphaThreshold)
        discard;
    out1 = vec4(opacity * color, opacity);
}
