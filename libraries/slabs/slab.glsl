// SPDX-License-Identifier: Apache-2.0
// The lobes of a slab that pbrlib lacks: its medium, and light of its own. See docs/slabs.md.

#include "../pbrlib/shaders/diffuse.glsl"
#include "../pbrlib/shaders/ggx_sampling.glsl"
#include "glint.glsl"

uniform sampler2D u_tints; // the tables of stored closures
uniform float u_layerSample; // in OSL a number for each point

// ---- diffuse reflection of an opaque medium --------------------------------------------------------------------------
// Chan 2018, "Material Advances in Call of Duty: WWII", divided by its directional albedo, which is 0.31 to 1.12.

// Gloss of Chan's diffuse lobe for a roughness, 0 to 1 (Chan 2018, "Material Advances in Call of Duty: WWII").
float mx_chan_gloss(float roughness)
{
    float square = clamp(roughness * roughness, 1e-3, 1.0);
    return clamp(log2(2.0 / (square * square) - 1.0) / 18.0, 0.0, 1.0);
}

// x^5.
float mx_power5(float x)
{
    return x * x * x * x * x;
}

// Share of the smooth surface in Chan's lobe of gloss g.
float mx_chan_smoothness(float g)
{
    return clamp(2.2 * g - 0.5, 0.0, 1.0);
}

// Height and fall of the bump of light that a rough surface of gloss g sends back.
vec2 mx_chan_bump(float g)
{
    return vec2((34.5 * g - 59.0) * g + 24.5, max(73.2 * g - 21.2, 8.9));
}

// Part of the light that a smooth surface lets in or out at the cosine c.
float mx_chan_even(float c)
{
    return 1.0 - 0.75 * mx_power5(1.0 - c);
}

// 1 / (pi times the directional albedo) of Chan's lobe of gloss g at the cosine c, within 0.0012.
//
// The program fits/chan.c makes the constants.
float mx_chan_share(float c, float g)
{
    const mat4 FIT = mat4(0.7111, 0.0005, 0.4749, 0.0263, 0.1526, 0.0031, 1.0260, -0.7185, 0.1026, -0.0048, -2.2232, 0.3473,
                          -0.0538, 0.0016, 2.0696, -0.4921);
    vec4 fit = FIT * vec4(1.0, c, c * c, c * c * c);
    vec2 bump = mx_chan_bump(g);
    float plain = mix(fit.x, 27.0 / 28.0 * mx_chan_even(c), mx_chan_smoothness(g)); // even: exactly, the mean of (1 - x)^5 is 1/21
    return 1.0 / (MX_PI * (plain + bump.x * exp2((8.9 - bump.y) * fit.z) * fit.y / (fit.w + c)));
}

// Chan's diffuse lobe of gloss g, times its directional albedo, for a light whose half vector has the cosine cos_d
// to V; `even` is the part that a smooth surface lets out to the viewer.
float mx_chan_lobe(float g, float cos_v, float cos_l, float cos_d, float even)
{
    vec2 bump = mx_chan_bump(g);
    float cos_h = min((cos_l + cos_v) / (2.0 * cos_d), 1.0); // V + L is 2 cos_d long
    float rough = cos_d + mx_power5(1.0 - cos_d);
    return max(mix(rough, even * mx_chan_even(cos_l), mx_chan_smoothness(g)) + bump.x * cos_d * exp2(-bump.y * sqrt(cos_h)), 0.0);
}

// Chan's diffuse lobe over its directional albedo, times the cosine of L, for the albedo 1.
float mx_chan(float g, vec3 N, vec3 V, vec3 L)
{
    float cos_v = mx_view_cosine(N, V);
    float cos_l = mx_facing_cosine(N, V, L);
    return mx_chan_lobe(g, cos_v, cos_l, mx_half_cosine(V, L), mx_chan_even(cos_v)) * cos_l * mx_chan_share(cos_v, g);
}

// The direction around which Chan's lobe of gloss g receives light: the normal, bent to the viewer as far as the
// mean direction of the lobe.
//
// Within 0.023 radians by the program fits/chan.c. A smooth surface does not bend it.
vec3 mx_chan_axis(float g, vec3 N, vec3 V)
{
    float s = mx_chan_smoothness(g);
    float c = mx_view_cosine(N, V);
    float bend = (0.4353 + c * (-0.7155 + 0.5624 * c)) * ((1.0 - 1.0850 * g) * (1.0 - 1.1414 * s * s));
    return mx_facing(N, V) + bend * V;
}

// ---- media -----------------------------------------------------------------------------------------------------------

// Ways through a medium are multiples of its thickness. Every medium has the index 1.5.
const float MX_MEAN_WAY = 1.1458980; // over cosine-weighted directions: 4.5 - 1.5 sqrt(5)

const float MX_CLEAR_PATH = 1e6; // of a clear medium, by which src/slabs/recognise.c knows matter that is an interface only
const float MX_MOST_ANISOTROPIC = 0.95; // of phase functions: beyond, all light would go straight on

// How far light goes through a medium of index 1.5, over the thickness, on its way to or from V.
float mx_way(vec3 N, vec3 V)
{
    float c = dot(N, V);
    return 1.5 * inversesqrt(1.25 + c * c);
}

// The number s of a medium that reflects `color` at infinite thickness: the albedo of one scattering is 1 - s^2
// (Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks").
vec3 mx_medium_loss(vec3 color)
{
    vec3 c = clamp(color, 0.0, 1.0);
    vec3 s = clamp(4.09712 + 4.20863 * c - sqrt(9.59217 + c * (41.6808 + 17.7126 * c)), 0.0, 1.0);
    return mix(s, vec3(1.0), step(c, vec3(0.0))); // exactly: no albedo, no scattering
}

// Optical depth, along the normal, of the medium that scatters evenly and stands for one with the phase anisotropy
// g, by similarity.
vec3 mx_medium_depth(vec3 loss, vec3 mean_free_path, float g, float thickness)
{
    float forward = clamp(g, -MX_MOST_ANISOTROPIC, MX_MOST_ANISOTROPIC);
    return max(thickness, 0.0) / max(mean_free_path, 1e-6) * (1.0 - forward) / (1.0 - forward * loss * loss);
}

// Light that the layer of a medium reflects and lets through (`transmitted`), with all orders of scattering, on a
// way: a is the albedo of one scattering, t the optical depth (after Kubelka and Munk 1931).
//
// Coefficients by the program fits/medium.c, which follows light at random; within 0.0053. Nothing is lost where
// the albedo is 1.
vec3 mx_medium_layer(vec3 a, vec3 t, float way, out vec3 transmitted)
{
    vec3 u = t / (1.0 + t);
    float x = way - 1.0;
    vec3 s = 0.5 * a * way * (1.0 + u * (-1.0290 + u * (0.5422 - 0.3924 * a) + a * (0.7451 + 0.3145 * a) + x * (1.1669 - 1.3629 * a)));
    vec3 k = (1.0 - a) * way
           * (1.0 + a * u * (0.6040 + u * (-0.1979 - 0.4865 * a) + a * (1.3930 - 0.5447 * a) + x * (0.2436 - 2.0559 * a)
                             + a * a * a * a * (-0.0215 + 0.5896 * u)));
    vec3 g = sqrt(k * (k + 2.0 * s));
    vec3 e = exp(-g * t);
    vec3 ways = mix((1.0 - e * e) / max(g, 1e-6), 2.0 * t * (1.0 - g * t), step(g * t, vec3(1e-3))); // by its series where g is near 0
    vec3 below = (k + s) * ways + 1.0 + e * e;
    transmitted = 2.0 * e / below;
    return s * ways / below;
}

bool mx_is_black(vec3 color)
{
    return max(color.x, max(color.y, color.z)) <= 0.0;
}

// Light that the layer of a medium lets through on a way.
//
// A medium without scattering has only absorption (Beer, Lambert).
vec3 mx_medium_through(vec3 color, vec3 mean_free_path, float g, float thickness, float way)
{
    vec3 loss = mx_medium_loss(color);
    vec3 depth = mx_medium_depth(loss, mean_free_path, g, thickness);
    if (mx_is_black(color))
        return exp(-depth * way);
    vec3 through;
    mx_medium_layer(1.0 - loss * loss, depth, way, through);
    return through;
}

// Light that the layer of a medium reflects on a way.
vec3 mx_medium_reflected(vec3 color, vec3 mean_free_path, float g, float thickness, float way)
{
    if (mx_is_black(color))
        return vec3(0.0);
    vec3 ignored;
    vec3 loss = mx_medium_loss(color);
    return mx_medium_layer(1.0 - loss * loss, mx_medium_depth(loss, mean_free_path, g, thickness), way, ignored);
}

// Scattering coefficient of a medium over a length, for light that walks through it at random; 0 where it is
// opaque.
//
// g by similarity, see mx_medium_depth.
vec3 mx_medium_scattering(vec3 color, vec3 mean_free_path, float g, float length)
{
    if (mx_is_black(mean_free_path) || mx_is_black(color))
        return vec3(0.0);
    vec3 loss = mx_medium_loss(color);
    return max(length, 0.0) / max(mean_free_path, 1e-6) * (1.0 - loss * loss) / (1.0 - clamp(g, -MX_MOST_ANISOTROPIC, MX_MOST_ANISOTROPIC) * loss * loss);
}

// Absorption coefficient of a medium over a length, for light that walks through it at random; 0 where it is
// opaque.
vec3 mx_medium_absorption(vec3 color, vec3 mean_free_path, float g, float length)
{
    if (mx_is_black(mean_free_path))
        return vec3(0.0);
    return max(length, 0.0) / max(mean_free_path, 1e-6) - mx_medium_scattering(color, mean_free_path, g, length);
}

// ---- values of the lobes ---------------------------------------------------------------------------------------------

// Reflectance at grazing angles: the hue of f90 with the brightness 1. The interface fades out where f0 falls below
// 0.02, less than any matter reflects.
vec3 mx_slab_grazing(vec3 f0, vec3 f90)
{
    vec3 hue = max(f90, 0.0) / max(max(f90.x, max(f90.y, f90.z)), MX_EPSILON);
    return hue * clamp(50.0 * max(f0.x, max(f0.y, f0.z)), 0.0, 1.0);
}

// Mean free path of a medium that lets `transmittance` through a thickness (Beer, Lambert): 0 lets nothing through,
// and nearly 1 nearly all.
vec3 mx_slab_mean_free_path(vec3 transmittance, float thickness)
{
    vec3 through = clamp(transmittance, 0.0, 0.99999);
    return mix(-thickness / log(max(through, 1e-30)), vec3(0.0), step(through, vec3(0.0)));
}

// A body whose medium scatters is seen through nowhere.
float mx_slab_is_thick(vec3 color, vec3 mean_free_path, float is_body)
{
    return mx_is_black(mean_free_path) || mx_is_black(color) ? 0.0 : is_body;
}

// Light goes into a body that is not opaque, where a path tracer follows it.
float mx_slab_is_entered(vec3 mean_free_path, float walks)
{
    return mx_is_black(mean_free_path) ? 0.0 : walks;
}

float mx_slab_is_lit(vec3 emission)
{
    return mx_is_black(emission) ? 0.0 : 1.0;
}

// ---- helpers ---------------------------------------------------------------------------------------------------------

float mx_slab_haze_alpha(float roughness, float extent)
{
    return clamp(roughness * roughness * (1.0 + extent), 0.0, 1.0);
}

// Barla, Pacanowski and Vangorp 2018, "A Composite BRDF Model for Hazy Gloss": the brightness of f0 with haze, and the share of the wide lobe.
// The peak keeps the brightness of f0; p is the peak of the wide lobe over that of the other.
vec2 mx_slab_haze(vec3 f0, float roughness, float haziness, float extent)
{
    float core = max(f0.x, max(f0.y, f0.z));
    float ratio = roughness * roughness / max(mx_slab_haze_alpha(roughness, extent), MX_EPSILON);
    float p = ratio * ratio;
    float k = haziness * (core > p ? (1.0 - core) / max(1.0 - p, MX_EPSILON) : core / max(p, MX_EPSILON));
    float whole = core + (1.0 - p) * k;
    return vec2(whole, k / max(whole, MX_EPSILON));
}

vec3 mx_slab_haze_f0(vec3 f0, float roughness, float haziness, float extent)
{
    float core = max(f0.x, max(f0.y, f0.z));
    return f0 * (mx_slab_haze(f0, roughness, haziness, extent).x / max(core, MX_EPSILON));
}

vec3 mx_slab_film_at(vec3 f0, float thickness, float ior, float cosine)
{
    float rise = mx_power5(1.0 - cosine);
    vec3 reflected = mx_fresnel(cosine, "schlick", f0, vec3(0.0), vec3(1.0), 5.0, thickness, ior);
    return clamp((reflected - rise) / max(1.0 - rise, 0.001), 0.0, 1.0);
}

// ---- slab_medium_bsdf ------------------------------------------------------------------------------------------------

// Reciprocal, with the albedo of the viewer's way.
vec3 mx_slab_thin_light(vec3 color, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 N, vec3 V, vec3 L)
{
    return mx_medium_reflected(color, mean_free_path, phase_anisotropy, thickness, mx_way(N, V))
         / max(mx_medium_reflected(color, mean_free_path, phase_anisotropy, thickness, MX_MEAN_WAY), MX_EPSILON)
         * (mx_medium_reflected(color, mean_free_path, phase_anisotropy, thickness, mx_way(N, L)) * mx_cosine_pdf(mx_facing(N, V), L));
}

vec3 mx_slab_medium_bsdf_eval(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                              vec3 N, vec3 V, vec3 L)
{
    if (mx_is_black(mean_free_path))
        return color * mx_chan(mx_chan_gloss(roughness), N, V, L);
    if (mx_is_black(color))
        return vec3(0.0);
    return mx_slab_thin_light(color, mean_free_path, phase_anisotropy, thickness, N, V, L);
}

vec3 mx_slab_medium_bsdf_albedo(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                vec3 N, vec3 V)
{
    return mx_is_black(mean_free_path) ? color : mx_medium_reflected(color, mean_free_path, phase_anisotropy, thickness, mx_way(N, V));
}

// The closure of a renderer is Oren and Nayar's with the colour c of the albedo. With the light that bounces between facets its mean albedo is
// c e / (1 - c (1 - e)), where e is that of one bounce (Portsmouth, Kutz and Hill 2024, "EON: A Practical Energy-Preserving Rough Diffuse BRDF").
vec3 mx_slab_medium_bsdf_tint(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                              vec3 N, vec3 V)
{
    float e = mx_fujii_mean(roughness);
    vec3 albedo = mx_slab_medium_bsdf_albedo(color, roughness, mean_free_path, phase_anisotropy, thickness, below, N, V);
    return (1.0 - albedo * (1.0 - e)) / e;
}

void mx_slab_medium_bsdf_sample(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                vec3 N, vec3 V, vec3 xi, out vec3 L, out vec3 weight, out float pdf)
{
    L = mx_any_frame(mx_facing(N, V)) * mx_sample_cosine(xi.xy);
    pdf = mx_cosine_pdf(mx_facing(N, V), L);
    weight = mx_slab_medium_bsdf_eval(color, roughness, mean_free_path, phase_anisotropy, thickness, below, N, V, L) / max(pdf, MX_EPSILON);
}

float mx_slab_medium_bsdf_pdf(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                              vec3 N, vec3 V, vec3 L)
{
    return mx_cosine_pdf(mx_facing(N, V), L);
}

vec3 mx_slab_medium_bsdf_environment(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                     vec3 N, vec3 V, int sample_index)
{
    if (option_path == 1 && option_environment == 2) // only here `sample_index` matters: a raster adds the light once
    {
        if (mx_is_black(color))
            return vec3(0.0);
        vec3 L, weight;
        float pdf;
        mx_slab_medium_bsdf_sample(color, roughness, mean_free_path, phase_anisotropy, thickness, below, N, V,
                                   mx_lobe_random(sample_index), L, weight, pdf);
        return mx_lobe_light(L, weight, pdf);
    }
    vec3 light = mx_slab_medium_bsdf_albedo(color, roughness, mean_free_path, phase_anisotropy, thickness, below, N, V)
               * mx_environment_irradiance(mx_is_black(mean_free_path) ? mx_chan_axis(mx_chan_gloss(roughness), N, V) : mx_facing(N, V));
    return mx_is_black(color) ? vec3(0.0) : light; // without a branch, which would stand in the loop over samples
}

// Of light to the viewer, with what bounces between the medium and what lies below: 1 / (1 - below R).
vec3 mx_slab_medium_bsdf_throughput(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                    vec3 N, vec3 V)
{
    if (mx_is_black(mean_free_path))
        return vec3(0.0);
    vec3 reflected = mx_medium_reflected(color, mean_free_path, phase_anisotropy, thickness, MX_MEAN_WAY);
    return mx_medium_through(color, mean_free_path, phase_anisotropy, thickness, mx_way(N, V)) / (1.0 - min(below * reflected, 0.999));
}

// Of light that comes in: its power with the exponent x is what a way x lets through, exact in the mean over cosine-weighted directions.
vec3 mx_slab_medium_bsdf_transmittance(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                       vec3 N)
{
    if (mx_is_black(mean_free_path))
        return vec3(1.0);
    if (mx_is_black(color))
        return mx_medium_through(color, mean_free_path, phase_anisotropy, thickness, 1.0);
    return pow(mx_medium_through(color, mean_free_path, phase_anisotropy, thickness, MX_MEAN_WAY), vec3(1.0 / MX_MEAN_WAY));
}

float mx_slab_medium_bsdf_way(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                              vec3 N, vec3 V)
{
    return MX_MEAN_WAY;
}

// Coefficients over the thickness, for light that walks through the medium at random; 0 where it is opaque.
vec3 mx_slab_medium_bsdf_scattering(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                    vec3 N)
{
    return mx_medium_scattering(color, mean_free_path, phase_anisotropy, thickness);
}

vec3 mx_slab_medium_bsdf_absorption(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                    vec3 N)
{
    return mx_medium_absorption(color, mean_free_path, phase_anisotropy, thickness);
}

float mx_slab_medium_bsdf_anisotropy(vec3 color, float roughness, vec3 mean_free_path, float phase_anisotropy, float thickness, vec3 below,
                                     vec3 N)
{
    return clamp(phase_anisotropy, -MX_MOST_ANISOTROPIC, MX_MOST_ANISOTROPIC);
}

// ---- slab_body_bsdf --------------------------------------------------------------------------------------------------
// Where light goes into the mesh of a body. It changes nothing at the surface; a path tracer takes what is behind it from here.

vec3 mx_slab_body_bsdf_throughput(vec3 color, vec3 mean_free_path, float phase_anisotropy, float unit, vec3 V)
{
    return vec3(1.0);
}

// Coefficients over a unit of the world.
vec3 mx_slab_body_bsdf_scattering(vec3 color, vec3 mean_free_path, float phase_anisotropy, float unit)
{
    return mx_medium_scattering(color, mean_free_path, phase_anisotropy, unit);
}

vec3 mx_slab_body_bsdf_absorption(vec3 color, vec3 mean_free_path, float phase_anisotropy, float unit)
{
    return mx_medium_absorption(color, mean_free_path, phase_anisotropy, unit);
}

float mx_slab_body_bsdf_anisotropy(vec3 color, vec3 mean_free_path, float phase_anisotropy, float unit)
{
    return clamp(phase_anisotropy, -MX_MOST_ANISOTROPIC, MX_MOST_ANISOTROPIC);
}

// ---- slab_reflection_bsdf --------------------------------------------------------------------------------------------
// GGX with Schlick's curve, as generalized_schlick_bsdf. What it does not reflect goes through channel by channel, so that nothing is gained.
// Glints change what a direction gets, not the mean, so albedo, environment of rasters, samples and their densities are those of countless
// facets. What a tint takes is lost.

// Without a footprint nobody knows which facets a pixel sees.
float mx_slab_glints(float glint_density, vec2 glint_uv, vec4 glint_footprint, vec2 roughness, vec3 N, vec3 X, vec3 V, vec3 L)
{
    if (glint_density <= 0.0 || dot(glint_footprint, glint_footprint) <= 0.0)
        return 1.0;
    vec3 Nf = mx_facing(N, V);
    vec3 H = V + L;
    vec3 x = mx_tangent(Nf, X);
    vec2 slope = vec2(dot(H, x), dot(H, cross(Nf, x))) / (max(dot(H, Nf), MX_EPSILON) * mx_ggx_alpha(roughness));
    return mx_glints(clamp(slope, -1e4, 1e4), glint_density, glint_uv, glint_footprint);
}

// Tables of stored closures: squares in one texture, one above the other.
vec3 mx_slab_stored_tint(float index, vec2 at)
{
    vec2 size = vec2(textureSize(u_tints, 0));
    return textureLod(u_tints, vec2(at.x, (index + at.y) * size.x / size.y), 0.0).xyz;
}

// The tint of light from L: the table's colour at the cosines of view and light.
vec3 mx_slab_tint(sampler2D specular_lut, float specular_lut_weight, float specular_lut_index, float cos_v, float cos_l)
{
    if (specular_lut_weight <= 0.0)
        return vec3(1.0);
    vec2 size = vec2(option_stored == 1 ? textureSize(u_tints, 0).xx : textureSize(specular_lut, 0));
    vec2 edge = 0.5 / size; // 0 and 1 are the centres of the outer texels, which do not repeat
    vec2 at = mix(edge, 1.0 - edge, clamp(vec2(cos_v, cos_l), 0.0, 1.0));
    vec3 tint = option_stored == 1 ? mx_slab_stored_tint(specular_lut_index, at) : textureLod(specular_lut, at, 0.0).xyz;
    return mix(vec3(1.0), clamp(tint, 0.0, 1.0), specular_lut_weight);
}

vec3 mx_slab_reflection_bsdf_eval(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                  float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V, vec3 L)
{
    return mx_ggx_eval(roughness, mx_ggx_oval(roughness), N, X, V, L, "schlick", max(f0, 0.0), vec3(0.0), f90, 5.0, 0.0, 1.5)
         * mx_slab_tint(specular_lut, specular_lut_weight, specular_lut_index, mx_view_cosine(N, V), abs(dot(N, L)))
         * mx_slab_glints(glint_density, glint_uv, glint_footprint, roughness, N, X, V, L);
}

// Axes of an interface.
mat3 mx_slab_frame(vec3 N, vec3 X, vec3 V)
{
    vec3 Nf = mx_facing(N, V);
    vec3 x = mx_tangent(Nf, X);
    return mat3(x, cross(Nf, x), Nf);
}

// ---- one facet for each point ----
// A closure of a renderer does not know the light. Where the light matters it has the normal of one facet, and the tint of the direction that
// the facet mirrors. The renderer takes many points in a pixel; the mean over their facets is the lobe. The facet is one of the glints, or
// where they are countless, one by how much of it the viewer sees.

// Of the roughness, that such a facet has itself: with less, small lights need more points; with more, directions share their tints.
const float MX_SLAB_FACET_ROUGHNESS = 0.0625;

bool mx_slab_has_facets(float glint_density, vec4 glint_footprint)
{
    return glint_density > 0.0 && mx_glint_has_facets(glint_density, glint_footprint);
}

// Its normal in the frame. Without a tint there are glints only.
vec3 mx_slab_facet_normal(vec2 alpha, float glint_density, vec2 glint_uv, vec4 glint_footprint, float specular_lut_weight, vec3 v)
{
    if (specular_lut_weight <= 0.0 || mx_slab_has_facets(glint_density, glint_footprint))
        return mx_glint_facet(alpha, glint_density, glint_uv);
    return mx_ggx_visible(alpha, v, mx_glint_random(uvec3(uint(u_layerSample * 16777216.0), 0u, 0u)).xy);
}

// The normal, and the facet's share of the roughness.
vec4 mx_slab_facet(vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, float specular_lut_weight, vec3 N, vec3 X, vec3 V)
{
    bool is_glint = mx_slab_has_facets(glint_density, glint_footprint);
    if (!is_glint && specular_lut_weight <= 0.0)
        return vec4(N, 1.0);
    mat3 frame = mx_slab_frame(N, X, V);
    return vec4(frame * mx_slab_facet_normal(mx_ggx_alpha(roughness), glint_density, glint_uv, glint_footprint, specular_lut_weight,
                                             mx_ggx_local(frame, V)),
                is_glint ? 0.5 * MX_GLINT_STEP : MX_SLAB_FACET_ROUGHNESS);
}

// What it sends of the light l that it mirrors to v, over Fresnel's factor, so that the mean is the lobe. Glints are as many as their share of
// the plane (Walter et al. 2007, equation 41). A visible normal weighs G2 / G1. The last factor undoes the blur by the facet's roughness: half a
// variance, 0.007 in squares of alpha without the far tail, times the Laplacian of 1 / (1 + q)^2, GGX over slopes; the lobe is within 1 %.
float mx_slab_facet_weight(vec2 alpha, bool is_glint, vec3 m, vec3 v, vec3 l)
{
    float weight = 4.0 * mx_ggx_smith_visibility(v, l, alpha);
    vec2 slope = m.xy / (alpha * m.z);
    float q = dot(slope, slope);
    return is_glint ? weight * dot(m, v) / m.z
                    : weight / mx_ggx_masked(v, alpha) * (1.0 + 0.028 * (1.0 - 2.0 * q) / ((1.0 + q) * (1.0 + q)));
}

// The same with compensation, and the cosine of the light.
vec4 mx_slab_facet_light(vec3 f0, vec3 f90, vec2 roughness, bool by_direction, float glint_density, vec2 glint_uv, vec4 glint_footprint,
                         float specular_lut_weight, vec3 N, vec3 X, vec3 V)
{
    bool is_glint = mx_slab_has_facets(glint_density, glint_footprint);
    if (!is_glint && specular_lut_weight <= 0.0)
        return vec4(1.0);
    vec2 alpha = mx_ggx_alpha(roughness);
    vec3 v = mx_ggx_local(mx_slab_frame(N, X, V), V);
    vec3 m = mx_slab_facet_normal(alpha, glint_density, glint_uv, glint_footprint, specular_lut_weight, v);
    vec3 l = reflect(-v, m);
    if (l.z <= 0.0 || dot(m, v) <= 0.0)
        return vec4(0.0);
    vec2 albedo = by_direction ? mx_ggx_albedo_like(mx_ggx_round_like(alpha, v)) : mx_ggx_albedo(roughness, v.z);
    return vec4(mx_slab_facet_weight(alpha, is_glint, m, v, l) * mx_ggx_compensation(albedo, "schlick", f0, vec3(0.0), f90, 0.0, 1.5), l.z);
}

// This and the tint call others for the parts that a slab may lack, so that the compiler leaves these out.
vec4 mx_slab_reflection_bsdf_facet(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                   float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V)
{
    return mx_slab_facet(roughness, glint_density, glint_uv, glint_footprint, specular_lut_weight, N, X, V);
}

// What the closure reflects is multiplied by the tint.
vec3 mx_slab_reflection_bsdf_tint(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                  float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V)
{
    vec4 light = mx_slab_facet_light(max(f0, 0.0), f90, roughness, mx_ggx_oval(roughness), glint_density, glint_uv, glint_footprint,
                                     specular_lut_weight, N, X, V);
    return light.xyz * mx_slab_tint(specular_lut, specular_lut_weight, specular_lut_index, mx_view_cosine(N, V), light.w);
}

// A raster tints all of its environment as at the mirror of the view.
vec3 mx_slab_reflection_bsdf_environment(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                         float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V, int sample_index, vec2 sample_turn)
{
    return mx_ggx_environment(roughness, mx_ggx_oval(roughness), N, X, V, sample_index, sample_turn, "schlick", max(f0, 0.0), vec3(0.0), f90, 5.0, 0.0, 1.5)
         * mx_slab_tint(specular_lut, specular_lut_weight, specular_lut_index, mx_view_cosine(N, V), mx_view_cosine(N, V));
}

vec3 mx_slab_reflection_bsdf_albedo(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                    float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V)
{
    return mx_ggx_reflectance(roughness, mx_ggx_oval(roughness), N, X, V, "schlick", max(f0, 0.0), vec3(0.0), f90, 5.0, 0.0, 1.5)
         * mx_slab_tint(specular_lut, specular_lut_weight, specular_lut_index, mx_view_cosine(N, V), mx_view_cosine(N, V));
}

vec3 mx_slab_reflection_bsdf_throughput(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                        float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V)
{
    return max(1.0 - mx_ggx_reflectance(roughness, mx_ggx_oval(roughness), N, X, V, "schlick", max(f0, 0.0), vec3(0.0), f90, 5.0, 0.0, 1.5), 0.0);
}

// In a function of its own, so that the one below stays short enough to become part of the shader, where its texture is known.
vec3 mx_slab_sampled_tint(sampler2D specular_lut, float specular_lut_weight, float specular_lut_index, vec3 N, vec3 V, vec3 L)
{
    return mx_slab_tint(specular_lut, specular_lut_weight, specular_lut_index, mx_view_cosine(N, V), abs(dot(N, L)));
}

void mx_slab_reflection_bsdf_sample(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                    float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V, vec3 xi, out vec3 L, out vec3 weight, out float pdf)
{
    mx_ggx_scatter(roughness, mx_ggx_oval(roughness), N, X, V, xi, 1.5, MX_REFLECTS, "schlick", max(f0, 0.0), vec3(0.0), f90, 5.0, 0.0, 1.5, L, weight, pdf);
    weight *= mx_slab_sampled_tint(specular_lut, specular_lut_weight, specular_lut_index, N, V, L)
            * mx_slab_glints(glint_density, glint_uv, glint_footprint, roughness, N, X, V, L);
}

float mx_slab_reflection_bsdf_pdf(vec3 f0, vec3 f90, vec2 roughness, float glint_density, vec2 glint_uv, vec4 glint_footprint, sampler2D specular_lut,
                                  float specular_lut_weight, float specular_lut_index, vec3 N, vec3 X, vec3 V, vec3 L)
{
    return mx_ggx_pdf(roughness, N, X, V, L, 1.5, MX_REFLECTS, "schlick", max(f0, 0.0), vec3(0.0), f90, 5.0, 0.0, 1.5);
}

// ---- slab_emission_bsdf ----------------------------------------------------------------------------------------------

vec3 mx_slab_emission_bsdf_emission(vec3 color, vec3 V)
{
    return max(color, 0.0);
}

vec3 mx_slab_emission_bsdf_throughput(vec3 color, vec3 V)
{
    return vec3(1.0);
}

// ---- slab_mark_bsdf --------------------------------------------------------------------------------------------------
// Lies on a slab and changes nothing: its weight is that of the slab. The deferred pipeline stores its inputs (docs/deferred.md).

vec3 mx_slab_mark_bsdf_throughput(vec3 diffuse_albedo, vec3 f0, vec3 f90, float roughness, float anisotropy, vec3 normal, vec3 tangent,
                                  float second_roughness, float second_roughness_weight, float fuzz_amount, vec3 fuzz_color,
                                  float fuzz_roughness, vec3 free_path, float phase_anisotropy, float is_thick, float glint_density,
                                  vec2 glint_uv, sampler2D specular_lut, float specular_lut_weight, float blur)
{
    return vec3(1.0);
}

float mx_slab_mark_bsdf_way(vec3 diffuse_albedo, vec3 f0, vec3 f90, float roughness, float anisotropy, vec3 normal, vec3 tangent,
                            float second_roughness, float second_roughness_weight, float fuzz_amount, vec3 fuzz_color,
                            float fuzz_roughness, vec3 free_path, float phase_anisotropy, float is_thick, float glint_density,
                            vec2 glint_uv, sampler2D specular_lut, float specular_lut_weight, float blur)
{
    return MX_MEAN_WAY;
}

// The mean free path over the thickness. Of a body: the radius of its scattered light, for shaders that do not spread it over that of the surface.
vec3 mx_slab_free_path(vec3 mean_free_path, float thickness, float is_thick, vec3 N, vec3 P)
{
    if (is_thick > 0.0)
        return (option_sss == 1 ? 1.0 : mx_curvature(N, P)) * max(mean_free_path, 0.1);
    return mean_free_path / max(thickness, 1e-6);
}
