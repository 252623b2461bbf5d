// SPDX-License-Identifier: Apache-2.0
// GGX microfacet lobe, the one kernel of all dielectric, conductor and Schlick closures. Roughness is that along X and
// Y, already squared. Masking and albedo of anisotropic lobes are those of both directions with `by_direction`, else of the geometric mean.
// See fresnel.glsl for the parameters of interfaces.
//
// Functions with a parameter `distribution` have facets by Beckmann, too, where it is not "ggx": see beckmann.glsl.

#include "beckmann.glsl"
#include "environment.glsl"
#include "fresnel.glsl"
#include "sampling.glsl"

// GGX distribution of normals, at a normal that the roughness stretched to e; `area` is the product of the
// roughness along x and y (Burley 2012, appendix B.2, equation 13).
float mx_ggx_distribution(vec3 e, float area)
{
    return 1.0 / (MX_PI * area * dot(e, e) * dot(e, e));
}

// cos (1 + 2 Lambda) of a direction for GGX; `area` is the product of the roughness along x and y (Heitz 2014,
// "Understanding the Masking-Shadowing Function", equation 72).
float mx_ggx_masking(float cosine, float area)
{
    return sqrt(area + (1.0 - area) * (cosine * cosine));
}

// Ways in which an interface sends light: a sum of these.
const int MX_REFLECTS = 1;
const int MX_REFRACTS = 2;

// The ways in which the interface sends light.
int mx_ggx_mode(string scatter_mode)
{
    return scatter_mode == "R" ? MX_REFLECTS : scatter_mode == "T" ? MX_REFRACTS : MX_REFLECTS + MX_REFRACTS;
}

// True if the compiler knows that a lobe has one roughness. Such a lobe needs no tangents.
bool mx_ggx_round(vec2 roughness)
{
    return mx_known(roughness.x == roughness.y);
}

// True for all others: their masking and albedo follow the direction.
bool mx_ggx_oval(vec2 roughness)
{
    return !mx_known(roughness.x == roughness.y);
}

// True if the compiler knows that the lobe is a mirror.
bool mx_ggx_smooth(vec2 roughness)
{
    return mx_known(max(roughness.x, roughness.y) <= MX_SMOOTH);
}

// True if masking and albedo follow the direction.
//
// Below the best quality a raster does without for closures of MaterialX, as MaterialX does: the mean masks otherwise than
// the axes do, and an anisotropic lobe loses or gains a tenth of the energy.
bool mx_ggx_by_direction(vec2 roughness)
{
    return (option_path == 1 || option_quality == 2) && mx_ggx_oval(roughness);
}

// Roughness that the formulas can bear.
vec2 mx_ggx_alpha(vec2 roughness)
{
    return clamp(roughness, MX_EPSILON, 1.0);
}

// The direction V in a frame, never below the horizon.
vec3 mx_ggx_local(mat3 frame, vec3 V)
{
    return max(V * frame, vec3(-1.0, -1.0, MX_EPSILON));
}

// The lobe as lights see it: five numbers beside the normal and its cosine.
struct mx_GgxLobe {
    vec3 N;        // faces the viewer
    float cosine;  // of the viewer
    vec3 x;        // unit tangent, unless the lobe is round
    vec2 alpha;    // roughness along x and across
    float masking; // of the viewer
};

// The GGX lobe of a surface as lights see it; roughness is that along X and across, squared.
mx_GgxLobe mx_ggx_lobe(vec2 roughness, bool is_round, vec3 N, vec3 X, vec3 V)
{
    vec2 alpha = mx_ggx_alpha(roughness);
    float cosine = mx_view_cosine(N, V);
    return mx_GgxLobe(mx_facing(N, V), cosine, is_round ? vec3(0.0) : mx_tangent(N, X), alpha, mx_ggx_masking(cosine, alpha.x * alpha.y));
}

// Height-correlated masking and shadowing G2 over 2 cos_v cos_l (Heitz 2014, equation 99); `masking` is that of the
// viewer.
//
// Half is left of the divisor of the reflection model.
float mx_ggx_visibility(float cos_v, float masking, float area, float cos_l)
{
    return 1.0 / (cos_v * mx_ggx_masking(cos_l, area) + cos_l * masking);
}

const int option_albedo = 0; // 0 by a fit, 1 from the host's table

uniform sampler2D u_albedoTable;

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
//
// The program fits/ggx.c makes the constants. x is too small by 0.001 at most, and too large by 0.004, relatively. Quotients of a and c
// follow what happens where light grazes the facets.
vec2 mx_ggx_albedo_fit(float a, float c)
{
    const mat4 LOST = mat4(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238, 8.7382,
                           4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.2060, -83.1538, 52.7528);
    const mat4 COSINE = mat4(-0.2174, 5.3819, -3.9110, 0.2674, -9.7298, 3.9904, 3.8225, -0.0277,
                             36.4897, -72.9122, 58.0878, -20.9170, -31.4763, 79.0768, -73.9706, 26.5429);
    float x = clamp(1.0 - c - a * mx_bicubic(COSINE, a / (a + c), a), 0.0, 1.0);
    float u = a / (a + 0.6 * c);
    return vec2(min(1.0017 - u * u * mx_bicubic(LOST, u, a * c), 1.0), x * x * x * x * x);
}

// The light that a white GGX lobe reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5 over it (y).
//
// The table holds what scales the reflectance facing the viewer, and that at grazing angles: c to the right, the
// mean of alpha downwards.
vec2 mx_ggx_albedo(vec2 roughness, float c)
{
    vec2 alpha = mx_ggx_alpha(roughness);
    float a = sqrt(alpha.x * alpha.y);
    if (option_albedo == 1)
    {
        vec2 scales = textureLod(u_albedoTable, vec2(c, a), 0.0).xy;
        float sum = clamp(scales.x + scales.y, MX_EPSILON, 1.0);
        return vec2(sum, scales.y / sum);
    }
    return mx_ggx_albedo_fit(a, c);
}

// The round lobe that stands for an anisotropic one towards v, a direction in its frame: its roughness (x), its
// cosine of v (y), and how far facets face v more than those of the round lobe (z).
//
// Divided by the roughness, visible normals are those of a unit sphere (Heitz 2018), so both lobes have the same
// ones where v, times the roughness, has one cosine in both. What remains is the roughness, by fits/ggx.c: the
// albedo is within 0.0054, relatively, and within 0.005 where the cosine of v is above 0.1.
vec3 mx_ggx_round_like(vec2 alpha, vec3 v)
{
    vec2 slope = v.xy * alpha;
    float square = dot(slope, slope) + v.z * v.z;
    float m = 0.5 * (alpha.x + alpha.y);
    float shape = 0.5 * (alpha.x - alpha.y) / m;
    float d = shape * shape;
    float w = shape * (slope.x * slope.x - slope.y * slope.y) / square;
    float z = v.z * inversesqrt(square);
    float by_shape = 2.2948 + z * (0.4077 - z * 0.9768 - m * 1.2426) + m * (-0.3067 - m * 0.1914)
                   + d * (-1.3213 + z * 0.8393 + m * 0.5168 - w * 0.4015 + d * 0.1179);
    float by_turn = -1.1070 + z * (-2.1285 + z * (0.2635 - z * 1.0931) + m * 3.7599) + m * (1.5833 - m * 1.2029)
                  + d * (0.9877 + z * 0.4531 - m * 0.6085) + w * (-0.6818 - z * 1.0142 + m * 0.6407 + d * 0.6879 - w * 0.1762);
    float a = m * sqrt(max(1.0 + d * by_shape + w * by_turn, 0.05));
    float stretch = sqrt(v.z * v.z + dot(slope, slope) / (a * a));
    return vec3(a, v.z / stretch, stretch);
}

// The albedo (x), and the mean of (1 - cos)^5 (y) where all cosines are as many times greater.
vec2 mx_ggx_facing_more(vec2 albedo, float times)
{
    float x = clamp(1.0 - (1.0 - pow(albedo.y, 0.2)) * times, 0.0, 1.0);
    return vec2(albedo.x, x * x * x * x * x);
}

// The albedo of an anisotropic lobe from the round one that stands for it (mx_ggx_round_like).
vec2 mx_ggx_albedo_like(vec3 round_lobe)
{
    return mx_ggx_facing_more(mx_ggx_albedo(round_lobe.xx, round_lobe.y), round_lobe.z);
}

// The light that a white lobe of Beckmann's facets reflects to v (x), and the mean of (1 - cos)^5 over it (y).
vec2 mx_beckmann_albedo_towards(vec2 roughness, vec3 v)
{
    vec2 alpha = mx_ggx_alpha(roughness);
    if (mx_ggx_round(roughness))
        return mx_beckmann_albedo(alpha.x, v.z);
    vec3 round_lobe = mx_beckmann_round_like(alpha, v);
    return mx_ggx_facing_more(mx_beckmann_albedo(round_lobe.x, round_lobe.y), round_lobe.z);
}

// The light that a white lobe of Beckmann's facets reflects to the viewer V (x), and the mean of (1 - cos)^5 over it (y).
vec2 mx_beckmann_albedo_of(vec2 roughness, vec3 N, vec3 X, vec3 V)
{
    if (mx_ggx_round(roughness))
        return mx_beckmann_albedo_towards(roughness, vec3(0.0, 0.0, mx_view_cosine(N, V)));
    return mx_beckmann_albedo_towards(roughness, mx_ggx_local(mx_frame(mx_facing(N, V), X), V));
}

// The light that a white GGX lobe reflects to the viewer V (x), and the mean of (1 - cos)^5 over it (y).
vec2 mx_ggx_albedo_of(vec2 roughness, string distribution, bool by_direction, vec3 N, vec3 X, vec3 V)
{
    if (distribution != "ggx")
        return mx_beckmann_albedo_of(roughness, N, X, V);
    return by_direction ? mx_ggx_albedo_like(mx_ggx_round_like(mx_ggx_alpha(roughness), mx_ggx_local(mx_frame(mx_facing(N, V), X), V)))
                        : mx_ggx_albedo(roughness, mx_view_cosine(N, V));
}

// Factor that gives back the light of multiple scattering (Turquin 2019, equations 14 and 16).
vec3 mx_ggx_compensation(vec2 albedo, string model, vec3 n, vec3 k, vec3 f90, float film, float film_ior)
{
    // 1/21: the hemispherical mean of Schlick's curve with exponent 5
    vec3 mean_fresnel = mix(mx_fresnel_facing(model, n, k, film, film_ior), f90, 1.0 / 21.0);
    float lost = 1.0 / albedo.x - 1.0;
    return 1.0 + mean_fresnel * lost;
}

// Part of the light that the lobe reflects to V.
//
// A raster has Schlick's curve for every interface, under which a film changes the compensation only; a path tracer
// takes the interface as it is at the lobe's mean angle.
vec3 mx_ggx_reflectance(vec2 roughness, string distribution, bool by_direction, vec3 N, vec3 X, vec3 V, string model, vec3 n, vec3 k, vec3 f90, float exponent,
                        float film, float film_ior)
{
    vec2 albedo = mx_ggx_albedo_of(roughness, distribution, by_direction, N, X, V);
    vec3 f = option_path == 0
        ? mix(mx_fresnel_f0(model, n, k), f90, albedo.y)
        : mx_fresnel(max(1.0 - pow(albedo.y, 0.2), MX_EPSILON), model, n, k, f90, exponent, film, film_ior);
    vec3 single = f * albedo.x;
    return single * mx_ggx_compensation(albedo, model, n, k, f90, film, film_ior);
}

// ---- lights ---------------------------------------------------------------------------------------------------------

// Cosine between V and the normal of the facet that reflects L to it, never 0.
float mx_half_cosine(vec3 V, vec3 L)
{
    return sqrt(clamp(0.500001 + 0.5 * dot(V, L), 0.0, 1.0));
}

// True if the compiler knows that a lobe is wide: where it is narrow, 1 - cos^2 of the small angles in it has lost its bits.
bool mx_ggx_wide(vec2 roughness)
{
    return mx_known(min(roughness.x, roughness.y) >= 0.03);
}

// The square of the length of the facet's normal H after the roughness divided its parts along the surface, times
// the product of the roughness along x and y; cos_h is its part along N.
//
// `square` is that of H. The part along the surface follows from it, unless the lobe is narrow; then from vectors,
// which serve all lobes of one normal.
float mx_ggx_stretched(mx_GgxLobe lobe, bool is_round, bool is_wide, vec3 H, float cos_h, float square)
{
    float area = lobe.alpha.x * lobe.alpha.y;
    vec3 slope = H - cos_h * lobe.N;
    if (is_round)
        return is_wide ? square - (1.0 - area) * (cos_h * cos_h) : dot(slope, slope) + area * (cos_h * cos_h);
    float along = dot(H, lobe.x);
    if (is_wide)
        return area * dot(vec3(along * along, square - along * along - cos_h * cos_h, cos_h * cos_h),
                          vec3(1.0 / (lobe.alpha * lobe.alpha), 1.0));
    vec2 parts = vec2(along, dot(cross(H, lobe.N), lobe.x)) / lobe.alpha;
    return area * (dot(parts, parts) + cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one
// divisor.
//
// The facet's normal V + L has any length.
float mx_ggx_light(mx_GgxLobe lobe, bool is_round, bool is_wide, vec3 V, vec3 L)
{
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), MX_EPSILON);
    float cos_h = lobe.cosine + dot(lobe.N, L);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = mx_ggx_stretched(lobe, is_round, is_wide, V + L, cos_h, square);
    return area / (2.0 * MX_PI) * square * square * cos_l / (e * e * (lobe.cosine * mx_ggx_masking(cos_l, area) + cos_l * lobe.masking));
}

// ---- masking by direction -------------------------------------------------------------------------------------------

// cos (1 + 2 Lambda) of the direction v, with the roughness as it is in this direction (Heitz 2014, equation 80).
float mx_ggx_smith(string distribution, vec3 v, vec2 alpha)
{
    if (distribution != "ggx")
        return mx_beckmann_smith(v, alpha);
    return length(vec3(v.xy * alpha, v.z));
}

// Masking and shadowing of the directions v and l over 4 cos_v, each with the roughness in its direction (Heitz
// 2014, equations 80 and 99).
float mx_ggx_smith_visibility(string distribution, vec3 v, vec3 l, vec2 alpha)
{
    return 0.5 * l.z / (v.z * mx_ggx_smith(distribution, l, alpha) + l.z * mx_ggx_smith(distribution, v, alpha));
}

// Beckmann's distribution at a normal H of any length.
float mx_beckmann_facets(vec3 H, mat3 frame, vec2 alpha)
{
    return mx_beckmann_distribution(normalize(H) * frame, alpha);
}

// The lobe of the facets from L to V, without Fresnel's factor, with masking by direction.
float mx_ggx_smith_lobe(vec2 roughness, string distribution, mat3 frame, vec3 V, vec3 L)
{
    vec2 alpha = mx_ggx_alpha(roughness);
    return (distribution == "ggx" ? mx_ggx_distribution(normalize(V + L) * frame / vec3(alpha, 1.0), alpha.x * alpha.y)
                                  : mx_beckmann_facets(V + L, frame, alpha))
         * mx_ggx_smith_visibility(distribution, mx_ggx_local(frame, V), mx_ggx_local(frame, L), alpha);
}

// The GGX lobe of an interface: what it reflects from the light L to V, times the cosine of L.
vec3 mx_ggx_eval(vec2 roughness, string distribution, bool by_direction, vec3 N, vec3 X, vec3 V, vec3 L, string model, vec3 n, vec3 k, vec3 f90, float exponent,
                 float film, float film_ior)
{
    return mx_ggx_compensation(mx_ggx_albedo_of(roughness, distribution, by_direction, N, X, V), model, n, k, f90, film, film_ior)
         * mx_fresnel(mx_half_cosine(V, L), model, n, k, f90, exponent, film, film_ior)
         * (option_path == 1 || by_direction || distribution != "ggx"
                ? mx_ggx_smith_lobe(roughness, distribution, mx_frame(mx_facing(N, V), X), V, L)
                : mx_ggx_light(mx_ggx_lobe(roughness, mx_ggx_round(roughness), N, X, V), mx_ggx_round(roughness), mx_ggx_wide(roughness), V, L));
}

// ---- environment ----------------------------------------------------------------------------------------------------
// Below, refract_ior > 0 looks through a solid sphere of that index instead of reflecting.

// Direction of the ray -v after it entered a solid sphere of index `ior` at the normal h, and left it again: the way
// is the same from both ends, so a mirror across the ray inside turns one end into the other.
vec3 mx_refract_sphere(vec3 v, vec3 h, float ior)
{
    return reflect(v, refract(-v, h, 1.0 / ior));
}

// Light that the lobe reflects, from a map whose levels of detail are filtered for rising roughness; with
// refract_ior > 0 light through a solid sphere of that index.
//
// A rough lobe looks between the mirror's direction and the normal (Lagarde and de Rousiers 2014, "Moving Frostbite to
// Physically Based Rendering", on image based lights). The levels of the roughest have two rows of texels; nearly as wide
// as diffuse lobes, they take the irradiance instead.
vec3 mx_ggx_prefiltered(vec2 roughness, string distribution, bool by_direction, vec3 N, vec3 X, vec3 V, float refract_ior, string model, vec3 n, vec3 k, vec3 f90,
                        float exponent, float film, float film_ior)
{
    vec3 h = mx_facing(N, V);
    vec2 alpha = mx_ggx_alpha(roughness);
    vec2 albedo = mx_ggx_albedo_of(roughness, distribution, by_direction, N, X, V);
    vec3 f = mix(mx_fresnel_facing(model, n, k, film, film_ior), f90, albedo.y) * albedo.x;
    float a = sqrt(alpha.x * alpha.y);
    if (film > 0.0) // keep the change of colour with the angle where the lobe is sharp
        f = mix(mx_fresnel(mx_view_cosine(N, V), model, n, k, f90, exponent, film, film_ior), f, sqrt(a));
    if (option_host_environment == 1)
        return refract_ior > 0.0 ? (1.0 - f) * mxg_radiance(positionWorld, mx_refract_sphere(V, h, refract_ior), sqrt(a))
                                 : f * mxg_radiance(positionWorld, reflect(-V, h), sqrt(a));
    float lod = (a < 0.25 ? sqrt(a) : 0.5 * a + 0.375) * float(u_envRadianceMips - 1);
    if (refract_ior > 0.0)
        return (1.0 - f) * mx_environment_radiance(mx_refract_sphere(V, h, refract_ior), lod);
    vec3 ray = mix(h, reflect(-V, h), (1.0 - a) * (sqrt(1.0 - a) + a));
    return f * mix(mx_environment_radiance(ray, lod), mx_environment_irradiance(h), smoothstep(0.5, 0.9, a));
}

// A normal of those visible from v, at any length (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with
// Spherical Caps"): v is stretched by the roughness and has the length `reach`, `around` is (cos, sin) of the turn
// around z, and `depth` how far the normal lies below the top of the cap, v.z + reach at most.
//
// Times the roughness it is one of the rough surface.
vec3 mx_ggx_cap(vec2 around, float depth, vec3 v, float reach)
{
    return v + vec3(sqrt(depth * (2.0 * reach - depth)) * around, reach - depth);
}

// The lobe as samples of the environment see it. Lobes that agree in it share their samples.
struct mx_GgxSamples {
    mat3 to_map;   // from the frame into the environment's picture
    vec3 stretch;  // roughness along x and y, 1
    float area;    // product of both
    vec3 v;        // direction to the viewer, in the frame
    float masking; // of v
    float reach;   // length of v times `stretch`: radius of the cap of visible normals
    float step;    // between the depths of samples
    float texels;  // of the environment's picture, for one where the density is that of a smooth surface
    float weight;  // of one, times the environment's intensity
};

// The GGX lobe of a surface as samples of the environment see it.
//
// The frame of a round lobe has V above its x. Where V is N, another tiny vector chooses x.
mx_GgxSamples mx_ggx_samples(vec2 roughness, bool is_round, int count, vec3 N, vec3 X, vec3 V)
{
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, is_round, N, X, V);
    vec3 x = is_round ? normalize(V - lobe.cosine * lobe.N + 1e-6 * lobe.N.yzx) : lobe.x;
    mat3 frame = mat3(x, cross(lobe.N, x), lobe.N);
    vec2 side = is_round ? vec2(sqrt(max(1.0 - lobe.cosine * lobe.cosine, 0.0)), 0.0) : (V * frame).xy;
    vec3 v = vec3(side, lobe.cosine);
    vec3 stretch = vec3(lobe.alpha, 1.0);
    float reach = is_round ? lobe.masking : length(v * stretch);
    float area = stretch.x * stretch.y;
    float share = 1.0 / float(count);
    float weight = share * (v.z + lobe.masking);
    return mx_GgxSamples(mx_map_frame(frame), stretch, area, v, lobe.masking, reach, share * (v.z + reach), mx_map_texels(area * (v.z + lobe.masking) * mx_sample_part(count)),
                         u_envLightIntensity * weight);
}

// The lobe of Beckmann's facets as samples of the environment see it.
//
// Its `reach` is the masking of v, and `step` the area that v sees of the facets, by sample.
mx_GgxSamples mx_beckmann_samples(vec2 roughness, int count, vec3 N, vec3 X, vec3 V)
{
    mat3 frame = mx_ggx_oval(roughness) ? mx_frame(mx_facing(N, V), X) : mx_any_frame(mx_facing(N, V));
    vec2 alpha = mx_ggx_alpha(roughness);
    vec3 v = mx_ggx_local(frame, V);
    float masking = mx_beckmann_smith(v, alpha);
    float area = alpha.x * alpha.y;
    float weight = (v.z + masking) / float(count);
    return mx_GgxSamples(mx_map_frame(frame), vec3(alpha, 1.0), area, v, masking, masking, weight, mx_map_texels(area * (v.z + masking) * mx_sample_part(count)),
                         u_envLightIntensity * weight);
}

// A facet by its normal.
struct mx_GgxFacet {
    vec3 h;       // of any length
    float cosine; // of v, times that length
    float mirror; // h times this is v and its mirror image together
    float texels; // of the environment's picture
};

// The facet of sample i. Samples are spherical Fibonacci points (Marques et al. 2013): each is the golden angle
// further around than the one before, by its `turn`.
//
// Their density follows from `mirror`, since twice the product of v and h is the square of the normal before
// `stretch`.
mx_GgxFacet mx_ggx_facet(mx_GgxSamples s, int i, vec2 turn)
{
    vec3 cap = mx_ggx_cap(turn, (float(i) + 0.5) * s.step, s.v * s.stretch, s.reach);
    vec3 h = cap * s.stretch;
    float cosine = dot(s.v, h);
    float mirror = 2.0 * cosine / dot(h, h);
    return mx_GgxFacet(h, cosine, mirror, mirror * mirror * s.texels);
}

// The facet of sample i of Beckmann's. The density of a normal follows from its slopes before `stretch`.
mx_GgxFacet mx_beckmann_facet(mx_GgxSamples s, int i, vec2 turn)
{
    float around = fract(atan(turn.y, turn.x) / (2.0 * MX_PI) + 1.0);
    vec3 h = mx_beckmann_visible(s.stretch.xy, s.v, vec2((float(i) + 0.5) * s.step / (s.v.z + s.masking), around));
    vec2 slope = h.xy / s.stretch.xy;
    float square = dot(h, h);
    float cosine = dot(s.v, h);
    return mx_GgxFacet(h, cosine, 2.0 * cosine / square, exp(dot(slope, slope)) / (square * square) * s.texels);
}

// The light of a sample: the weight stands beside the light, so that it scales Fresnel's factor, which may be one number.
struct mx_GgxLight {
    vec3 color;
    float weight;
    float cosine; // at the facet
};

// The light that the facet of sample i reflects.
//
// A visible normal weighs G2 / G1.
mx_GgxLight mx_ggx_reflected(mx_GgxSamples s, int i, vec2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    vec3 l = facet.mirror * facet.h - s.v;
    float cos_l = max(l.z, MX_EPSILON);
    return mx_GgxLight(mx_filtered_light(s.to_map * l, facet.texels),
                       s.weight * cos_l * mx_ggx_visibility(s.v.z, s.masking, s.area, cos_l),
                       sqrt(clamp(0.5 * (facet.mirror * facet.cosine), MX_EPSILON, 1.0)));
}

// The light that the facet of sample i reflects, with masking by direction.
//
// The masking of v is the reach of its cap.
mx_GgxLight mx_ggx_reflected_by_direction(mx_GgxSamples s, string distribution, int i, vec2 turn)
{
    mx_GgxFacet facet = distribution == "ggx" ? mx_ggx_facet(s, i, turn) : mx_beckmann_facet(s, i, turn);
    vec3 l = facet.mirror * facet.h - s.v;
    float cos_l = max(l.z, MX_EPSILON);
    return mx_GgxLight(mx_filtered_light(s.to_map * l, facet.texels),
                       u_envLightIntensity * s.step * cos_l / (s.v.z * mx_ggx_smith(distribution, l, s.stretch.xy) + cos_l * s.reach),
                       sqrt(clamp(0.5 * (facet.mirror * facet.cosine), MX_EPSILON, 1.0)));
}

// The light that a smooth surface mirrors.
mx_GgxLight mx_mirrored(vec3 N, vec3 V)
{
    return mx_GgxLight(mx_environment_radiance(reflect(-V, mx_facing(N, V)), 0.0), 1.0, mx_view_cosine(N, V));
}

// The light that comes through a smooth solid sphere of index `ior`.
mx_GgxLight mx_transmitted(float ior, vec3 N, vec3 V)
{
    return mx_GgxLight(mx_environment_radiance(mx_refract_sphere(V, mx_facing(N, V), ior), 0.0), 1.0, mx_view_cosine(N, V));
}

// The light that comes to the facet of sample i through a solid sphere of index `ior` behind it.
//
// A visible normal weighs 1 / G1.
mx_GgxLight mx_ggx_transmitted(mx_GgxSamples s, string distribution, float ior, int i, vec2 turn)
{
    mx_GgxFacet facet = distribution == "ggx" ? mx_ggx_facet(s, i, turn) : mx_beckmann_facet(s, i, turn);
    vec3 h = normalize(facet.h);
    return mx_GgxLight(mx_filtered_light(s.to_map * mx_refract_sphere(s.v, h, ior), facet.texels), s.weight * 0.5 / s.v.z,
                       clamp(dot(s.v, h), MX_EPSILON, 1.0));
}

// The light that comes to the facet of sample i through a solid sphere of index `ior` behind it, after the first
// way and one turn in the sphere.
//
// With `--role path`: wherever light meets the other side of the sphere as much is reflected as on its way
// in, f, since the angle is the same. What leaves at first and after one turn, 1 : f, stands for all. A raster lets
// all leave at once, as MaterialX does.
vec3 mx_ggx_solid(mx_GgxSamples s, string distribution, float ior, int mode, int i, vec2 turn, string model, vec3 n, vec3 k, vec3 f90, float exponent, float film,
                  float film_ior)
{
    mx_GgxLight light = mx_ggx_transmitted(s, distribution, ior, i, turn);
    mx_GgxFacet facet = distribution == "ggx" ? mx_ggx_facet(s, i, turn) : mx_beckmann_facet(s, i, turn);
    vec3 h = normalize(facet.h);
    vec3 inside = refract(-s.v, h, 1.0 / ior);
    vec3 turned = reflect(-s.v, normalize(inside * dot(inside, h) - 0.5 * h)); // the way is its own mirror image where it turns
    vec3 f = mx_fresnel(light.cosine, model, n, k, f90, exponent, film, film_ior);
    return (mode == MX_REFRACTS ? vec3(1.0) : 1.0 - f)
         * light.weight * mix(light.color, mx_filtered_light(s.to_map * turned, facet.texels), f / (1.0 + f));
}

// Sample i of the light of the environment that the lobe reflects.
//
// A choice that all samples make alike stands here, where the compiler sees it.
vec3 mx_ggx_environment(vec2 roughness, string distribution, bool by_direction, vec3 N, vec3 X, vec3 V, int i, vec2 turn, string model, vec3 n, vec3 k, vec3 f90,
                        float exponent, float film, float film_ior)
{
    if (option_environment == 0)
        return vec3(0.0);
    vec3 scale = mx_ggx_compensation(mx_ggx_albedo_of(roughness, distribution, by_direction, N, X, V), model, n, k, f90, film, film_ior);
    if (option_environment == 1)
        return scale * mx_ggx_prefiltered(roughness, distribution, by_direction, N, X, V, 0.0, model, n, k, f90, exponent, film, film_ior);
    int count = mx_sample_count(mx_ggx_alpha(roughness));
    mx_GgxLight light = mx_ggx_smooth(roughness) ? mx_mirrored(N, V)
                      : distribution != "ggx" ? mx_ggx_reflected_by_direction(mx_beckmann_samples(roughness, count, N, X, V), distribution, i, turn)
                      : by_direction ? mx_ggx_reflected_by_direction(mx_ggx_samples(roughness, false, count, N, X, V), distribution, i, turn)
                                     : mx_ggx_reflected(mx_ggx_samples(roughness, mx_ggx_round(roughness), count, N, X, V), i, turn);
    return i < count ? scale * (film > 0.0 ? mx_fresnel_film(light.cosine, model, n, k, f90, exponent, film, film_ior)
                                           : mx_fresnel_bare(light.cosine, model, n, k, f90, exponent))
                           * light.weight * light.color
                     : vec3(0.0);
}

// Sample i of the light of the environment that the lobe refracts.
vec3 mx_ggx_refraction(vec2 roughness, string distribution, vec3 N, vec3 X, vec3 V, int i, vec2 turn, float ior, int mode, string model, vec3 n, vec3 k, vec3 f90,
                       float exponent, float film, float film_ior)
{
    if (option_environment == 0)
        return vec3(0.0);
    if (option_environment == 1)
        return mx_ggx_prefiltered(roughness, distribution, mx_ggx_by_direction(roughness), N, X, V, ior, model, n, k, f90, exponent, film, film_ior);
    int count = mx_sample_count(mx_ggx_alpha(roughness));
    mx_GgxSamples samples = distribution == "ggx" ? mx_ggx_samples(roughness, mx_ggx_round(roughness), count, N, X, V)
                                                  : mx_beckmann_samples(roughness, count, N, X, V);
    if (option_path == 1)
        return i < count ? mx_ggx_solid(samples, distribution, ior, mode, i, turn, model, n, k, f90, exponent, film, film_ior) : vec3(0.0);
    mx_GgxLight light = mx_ggx_smooth(roughness) ? mx_transmitted(ior, N, V) : mx_ggx_transmitted(samples, distribution, ior, i, turn);
    return i < count ? (1.0 - (film > 0.0 ? mx_fresnel_film(light.cosine, model, n, k, f90, exponent, film, film_ior)
                                          : mx_fresnel_bare(light.cosine, model, n, k, f90, exponent)))
                           * light.weight * light.color
                     : vec3(0.0);
}
