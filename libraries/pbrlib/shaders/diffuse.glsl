// SPDX-License-Identifier: Apache-2.0
// oren_nayar_diffuse_bsdf, burley_diffuse_bsdf, translucent_bsdf and subsurface_bsdf.

#include "environment.glsl"
#include "sampling.glsl"

// Cosine between a direction and the side of the surface that V sees, never 0.
float mx_facing_cosine(vec3 N, vec3 V, vec3 direction)
{
    return max(dot(mx_facing(N, V), direction), MX_EPSILON);
}

// ---- oren_nayar_diffuse_bsdf ----------------------------------------------------------------------------------------

// Energy-preserving Oren-Nayar of OpenPBR: Fujii's lobe (2012) with roughness `r`, and what it loses scattered again.
const float MX_FUJII_A = 0.28779335; // 1/2 - 2 / (3 pi)
const float MX_FUJII_B = 0.07248821; // 2/3 - 28 / (15 pi)

// Directional albedo of Fujii's lobe of roughness r (Fujii 2012, "A tiny improvement of Oren-Nayar reflectance
// model").
float mx_fujii_albedo(float cosine, float r)
{
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    float g = sine * (acos(min(cosine, 1.0)) - sine * cosine)
            + (2.0 / 3.0) * (sine / cosine * (1.0 - sine * sine * sine) - sine);
    return (1.0 + r * g / MX_PI) / (1.0 + MX_FUJII_A * r);
}

// Mean albedo of Fujii's lobe of roughness r.
float mx_fujii_mean(float r)
{
    return (1.0 + MX_FUJII_B * r) / (1.0 + MX_FUJII_A * r);
}

// Albedo of the light that Fujii's lobe scatters more than once, relative to `color`; `mean` is the mean albedo of
// the lobe.
vec3 mx_fujii_multiple(vec3 color, float mean)
{
    return color * mean / (1.0 - color * max(1.0 - mean, 0.0));
}

// Oren and Nayar's rough diffuse lobe, times the cosine of L; with energy_compensation that of OpenPBR, which
// preserves energy.
vec3 mx_oren_nayar_diffuse_bsdf_eval(vec3 color, float roughness, vec3 N, bool energy_compensation, vec3 V, vec3 L)
{
    float cos_l = mx_facing_cosine(N, V, L);
    vec3 lambert = color * (cos_l * (1.0 / MX_PI));
    float cos_v = mx_view_cosine(N, V);
    if (!energy_compensation)
    {
        // Qualitative model of Oren and Nayar 1994, equation 30: A and B
        float r2 = roughness * roughness;
        vec2 ab = vec2(1.0, 0.0) + r2 * vec2(-0.5, 0.45) / (r2 + vec2(0.33, 0.09));
        return lambert * (ab.x + ab.y * max(dot(L, V) - cos_l * cos_v, 0.0) / max(cos_l, cos_v));
    }
    float s = dot(L, V) - cos_l * cos_v;
    if (s > 0.0)
        s /= max(cos_l, cos_v);
    float mean = mx_fujii_mean(roughness);
    float lost_v = max(1.0 - mx_fujii_albedo(cos_v, roughness), MX_EPSILON);
    float lost_l = max(1.0 - mx_fujii_albedo(cos_l, roughness), MX_EPSILON);
    float lost = max(1.0 - mean, MX_EPSILON);
    float single = (1.0 + roughness * s) / (1.0 + MX_FUJII_A * roughness);
    return lambert * (single + mx_fujii_multiple(color, mean) * (lost_v * lost_l / lost));
}

// Directional albedo of Oren and Nayar's lobe towards V.
vec3 mx_oren_nayar_diffuse_bsdf_albedo(vec3 color, float roughness, vec3 N, bool energy_compensation, vec3 V)
{
    float cos_v = mx_view_cosine(N, V);
    if (energy_compensation)
        return color * mix(mx_fujii_multiple(color, mx_fujii_mean(roughness)), vec3(1.0),
                           mx_fujii_albedo(cos_v, roughness));

    // Rational fit to the directional albedo of the qualitative model
    vec2 fit = 1.0 + roughness * (vec2(-0.4297, -0.6076) + vec2(-0.7632, -0.4993) * cos_v
                                  + vec2(1.4385, 2.0315) * roughness);
    return color * clamp(fit.x / fit.y, 0.0, 1.0);
}

void mx_oren_nayar_diffuse_bsdf_sample(vec3 color, float roughness, vec3 N, bool energy_compensation, vec3 V, vec3 xi, out vec3 L,
                                       out vec3 weight, out float pdf)
{
    L = mx_any_frame(mx_facing(N, V)) * mx_sample_cosine(xi.xy);
    pdf = mx_cosine_pdf(mx_facing(N, V), L);
    weight = mx_oren_nayar_diffuse_bsdf_eval(color, roughness, N, energy_compensation, V, L) / max(pdf, MX_EPSILON);
}

float mx_oren_nayar_diffuse_bsdf_pdf(vec3 color, float roughness, vec3 N, bool energy_compensation, vec3 V, vec3 L)
{
    return mx_cosine_pdf(mx_facing(N, V), L);
}

vec3 mx_oren_nayar_diffuse_bsdf_environment(vec3 color, float roughness, vec3 N, bool energy_compensation, vec3 V, int sample_index)
{
    vec3 even = mx_oren_nayar_diffuse_bsdf_albedo(color, roughness, N, energy_compensation, V)
              * mx_environment_irradiance(mx_facing(N, V));
    if (option_path == 0 || option_environment != 2)
        return even;
    if (roughness <= 0.0) // the mean is exact: a single sample brings it
        return sample_index < 1 ? even : vec3(0.0);
    vec3 L, weight;
    float pdf;
    mx_oren_nayar_diffuse_bsdf_sample(color, roughness, N, energy_compensation, V, mx_lobe_random(sample_index), L, weight, pdf);
    return mx_lobe_light(L, weight, pdf);
}

// ---- burley_diffuse_bsdf --------------------------------------------------------------------------------------------

// Directional albedo of a white Burley lobe at the cosine c, by the fit of Stephen Hill.
float mx_burley_albedo(float c, float roughness)
{
    float x = 1.0 - c;
    float smooth_fit = 0.97619 - 0.488095 * (x * x * x * x * x);
    float rough_fit = 1.55754 + c * (-2.02221 + c * (2.56283 - 1.06244 * c));
    return mix(smooth_fit, rough_fit, roughness);
}

// The divisor of the Burley lobe where its albedo is greater than 1.
//
// The model reflects more than there is where it is rough and seen at grazing angles; a path tracer, and a raster of the
// best quality, take that back.
float mx_burley_excess(float albedo)
{
    return option_path == 1 || option_quality == 2 ? max(albedo, 1.0) : 1.0;
}

// Diffuse lobe of Burley 2012, "Physically-Based Shading at Disney", section 5.3, times the cosine of L.
vec3 mx_burley_diffuse_bsdf_eval(vec3 color, float roughness, vec3 N, vec3 V, vec3 L)
{
    float cos_l = mx_facing_cosine(N, V, L);
    float cos_v = mx_view_cosine(N, V);
    vec2 x = 1.0 - vec2(cos_l, cos_v);
    vec2 f = 1.0 + (roughness + roughness * dot(L, V) - 0.5) * (x * x * x * x * x); // cos^2 of half the angle is (1 + cos) / 2
    return color * (f.x * f.y * cos_l / MX_PI / mx_burley_excess(mx_burley_albedo(cos_v, roughness)));
}

vec3 mx_burley_diffuse_bsdf_albedo(vec3 color, float roughness, vec3 N, vec3 V)
{
    float albedo = mx_burley_albedo(mx_view_cosine(N, V), roughness);
    return color * (albedo / mx_burley_excess(albedo));
}

void mx_burley_diffuse_bsdf_sample(vec3 color, float roughness, vec3 N, vec3 V, vec3 xi, out vec3 L, out vec3 weight, out float pdf)
{
    L = mx_any_frame(mx_facing(N, V)) * mx_sample_cosine(xi.xy);
    pdf = mx_cosine_pdf(mx_facing(N, V), L);
    weight = mx_burley_diffuse_bsdf_eval(color, roughness, N, V, L) / max(pdf, MX_EPSILON);
}

float mx_burley_diffuse_bsdf_pdf(vec3 color, float roughness, vec3 N, vec3 V, vec3 L)
{
    return mx_cosine_pdf(mx_facing(N, V), L);
}

vec3 mx_burley_diffuse_bsdf_environment(vec3 color, float roughness, vec3 N, vec3 V, int sample_index)
{
    if (option_path == 1 && option_environment == 2)
    {
        vec3 L, weight;
        float pdf;
        mx_burley_diffuse_bsdf_sample(color, roughness, N, V, mx_lobe_random(sample_index), L, weight, pdf);
        return mx_lobe_light(L, weight, pdf);
    }
    return mx_burley_diffuse_bsdf_albedo(color, roughness, N, V) * mx_environment_irradiance(mx_facing(N, V));
}

// ---- translucent_bsdf -----------------------------------------------------------------------------------------------

// Diffuse light that goes through to the side that is not seen.
vec3 mx_translucent_bsdf_eval(vec3 color, vec3 N, vec3 V, vec3 L)
{
    return color * (max(-dot(mx_facing(N, V), L), 0.0) / MX_PI);
}

vec3 mx_translucent_bsdf_environment(vec3 color, vec3 N, vec3 V)
{
    return color * mx_environment_irradiance(-mx_facing(N, V));
}

vec3 mx_translucent_bsdf_albedo(vec3 color, vec3 N, vec3 V)
{
    return color;
}

void mx_translucent_bsdf_sample(vec3 color, vec3 N, vec3 V, vec3 xi, out vec3 L, out vec3 weight, out float pdf)
{
    L = mx_any_frame(-mx_facing(N, V)) * mx_sample_cosine(xi.xy);
    pdf = mx_cosine_pdf(-mx_facing(N, V), L);
    weight = color;
}

float mx_translucent_bsdf_pdf(vec3 color, vec3 N, vec3 V, vec3 L)
{
    return mx_cosine_pdf(-mx_facing(N, V), L);
}

// ---- subsurface_bsdf ------------------------------------------------------------------------------------------------

// Curvature of the surface with the normal n at the point P: how far both change from one pixel to the next.
//
// A stored radius is that over the circle's, whose curvature is 1. Where neither changes, the surface is nearly flat.
float mx_curvature(vec3 n, vec3 P)
{
    return option_stored == 1 ? 1.0 : max(length(fwidth(n)) / max(length(fwidth(P)), 1e-20), 0.01);
}

// Light that arrives at a point of a circle of this curvature by subsurface scattering, where the cosine of the
// light is cos_l: Burley's normalised diffusion (Christensen 2015) around the circle (after Penner 2011,
// "Pre-integrated skin shading").
//
// It is a hyperbola over the light's cosine; the program fits/subsurface.c makes the constants.
float mx_subsurface_light(float radius, float curvature, float cos_l)
{
    float x = curvature * max(radius, option_stored == 1 ? 1e-6 : 0.1);
    vec3 bend = (vec3(0.1573, 0.0104, 0.1632) + x * (vec3(0.6620, 0.1732, 0.6079) + x * vec3(0.6075, 0.4138, 0.8133)))
              / (2.0 * MX_PI * (0.1602 + x * (0.6652 + x)));
    return bend.x * cos_l + sqrt(bend.y * bend.y + (bend.z * bend.z - bend.y * bend.y) * (cos_l * cos_l));
}

// Light that arrives by subsurface scattering, with a radius for each channel.
//
// Colours have calls, which each light makes anew: the numbers in place of them would take nine registers.
vec3 mx_subsurface_light(vec3 radius, float curvature, float cos_l)
{
    vec3 light = vec3(0.0);
    for (int i = 0; i < 3; ++i)
        light[i] = mx_subsurface_light(radius[i], curvature, cos_l);
    return light;
}

vec3 mx_subsurface_bsdf_eval(vec3 color, vec3 radius, float anisotropy, vec3 N, vec3 V, vec3 L, vec3 P)
{
    vec3 Nf = mx_facing(N, V);
    if (option_path == 1 || option_sss == 1) // no screen derivatives, or spread later: what leaves where it entered
        return color * mx_cosine_pdf(Nf, L);
    if (mx_known(radius.x == radius.y) && mx_known(radius.y == radius.z))
        return color * mx_subsurface_light(radius.x, mx_curvature(Nf, P), dot(Nf, L));
    return color * mx_subsurface_light(radius, mx_curvature(Nf, P), dot(Nf, L));
}

vec3 mx_subsurface_bsdf_environment(vec3 color, vec3 radius, float anisotropy, vec3 N, vec3 V)
{
    return color * mx_environment_irradiance(mx_facing(N, V));
}

vec3 mx_subsurface_bsdf_albedo(vec3 color, vec3 radius, float anisotropy, vec3 N, vec3 V)
{
    return color;
}

void mx_subsurface_bsdf_sample(vec3 color, vec3 radius, float anisotropy, vec3 N, vec3 V, vec3 xi, out vec3 L, out vec3 weight,
                               out float pdf)
{
    L = mx_any_frame(mx_facing(N, V)) * mx_sample_cosine(xi.xy);
    pdf = mx_cosine_pdf(mx_facing(N, V), L);
    weight = color;
}

float mx_subsurface_bsdf_pdf(vec3 color, vec3 radius, float anisotropy, vec3 N, vec3 V, vec3 L)
{
    return mx_cosine_pdf(mx_facing(N, V), L);
}
