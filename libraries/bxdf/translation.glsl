// SPDX-License-Identifier: Apache-2.0

#include "../pbrlib/shaders/optics.glsl"
#include "open_pbr.glsl"

// KHR_materials_anisotropy stretches alpha.y to mix(alpha.y, 1, strength^2) along the tangent.
float mx_gltf_anisotropy(vec2 alpha)
{
    return sqrt(max(alpha.x - alpha.y, 0.0) / max(1.0 - alpha.y, 0.000001));
}

// OpenPBR Surface specification, "Coat darkening": light bounces below the coat until (1 - F0) / n^2 of it escapes.
vec3 mx_coat_darkening(vec3 base_color, float metalness, float specular, float subsurface, vec3 subsurface_color,
                       float weight, float ior)
{
    vec3 albedo = mix(mix(base_color, subsurface_color, subsurface), base_color * specular, metalness);
    float escape = 4.0 / (ior * (ior + 1.0) * (ior + 1.0));
    return mix(vec3(1.0), escape / (1.0 - albedo * (1.0 - escape)), weight);
}

// The part that a coat lets out of the light that shines below it, facing the viewer.
vec3 mx_coat_glow(vec3 coat_color, float ior, float weight)
{
    return mix(vec3(1.0), coat_color * mx_open_pbr_transmittance(ior), weight);
}

// The colour below a coat that saturates it (standard_surface).
vec3 mx_coat_saturated(vec3 color, float amount)
{
    return amount > 0.0 ? pow(clamp(color, 0.0, 1.0), vec3(1.0 + amount)) : color;
}

// The luminance; that of a grey is exact.
float mx_luminance_of(vec3 color)
{
    return dot(color - color.zzz, vec3(0.2722287, 0.6740818, 0.0)) + color.z;
}

float mx_brightest(vec3 color)
{
    return max(max(color.x, color.y), color.z);
}

// The part of UsdPreviewSurface that refracts.
float mx_preview_glass(float opacity, int mode, float threshold)
{
    return threshold > 0.0 || mode == 1 ? 0.0 : 1.0 - opacity;
}

/* gltf_pbr tints refracted light with the base colour, UsdPreviewSurface does not. The base colour for both: as bright as the two together,
   and of a hue between them that is near that of the diffuse light, which is what the eye sees of a tint. It is exact for greys. */
vec3 mx_preview_base(vec3 diffuse, float glass)
{
    vec3 hue = diffuse * (8.0 * (1.0 - glass)) + glass;
    float sum = mx_luminance_of(diffuse) * (1.0 - glass) + glass;
    return glass > 0.0 ? hue * min(sum / mx_luminance_of(hue), 1.0 / mx_brightest(hue)) : diffuse;
}

// The transmission that leaves as much diffuse light below that base colour.
float mx_preview_transmission(vec3 diffuse, float glass)
{
    return glass > 0.0 ? 1.0 - mx_luminance_of(diffuse) * (1.0 - glass) / mx_luminance_of(mx_preview_base(diffuse, glass)) : 0.0;
}

/* A thin sheet of OpenPBR lets the share (1 + g) / 2 of its subsurface light through, one of standard_surface all of it: the colour of
   the diffuse reflection there that has the rest. */
vec3 mx_sheet_color(vec3 base, vec3 scattered, float weight, float anisotropy)
{
    float through = weight * (0.5 + 0.5 * anisotropy);
    float left = max(1.0 - through, 0.0001);
    return base * ((1.0 - weight) / left) + scattered * ((weight - through) / left);
}

// Normal incidence on a dielectric in air (Fresnel).
float mx_reflectance_of_ior(float ior)
{
    float amplitude = (ior - 1.0) / (ior + 1.0);
    return amplitude * amplitude;
}

float mx_ior_of_reflectance(float reflectance)
{
    float amplitude = sqrt(clamp(reflectance, 0.0, 0.98));
    return (1.0 + amplitude) / (1.0 - amplitude);
}

/* The weight of a dielectric's reflection that reflects as much as disney_principled, which reflects 0.08 of its `specular` whatever the
   index is. Above 1 it is the index that has to be larger. */
float mx_principled_weight(float specular, float ior)
{
    return ior == 1.5 ? 2.0 * specular : 0.08 * specular / max(mx_reflectance_of_ior(ior), 0.0001);
}

// The weight of a coat of index `into` that reflects as much as one of index `ior`, at most 1.
float mx_coat_weight(float weight, float ior, float into)
{
    return ior == into ? weight : min(weight * mx_reflectance_of_ior(ior) / max(mx_reflectance_of_ior(into), 0.0001), 1.0);
}

// Light that passes a rough coat blurs the reflections below (OpenPBR Surface specification, "Coat roughening").
float mx_coat_blur(float roughness, float coat_roughness, float weight)
{
    float below = roughness * roughness, coat = coat_roughness * coat_roughness;
    return weight * coat_roughness > 0.0 ? mix(roughness, sqrt(sqrt(min(below * below + 2.0 * coat * coat, 1.0))), weight) : roughness;
}

// The roughness that mx_coat_blur blurs to `roughness`, or 0.
float mx_coat_unblur(float roughness, float coat_roughness, float weight)
{
    float below = roughness * roughness, coat = coat_roughness * coat_roughness;
    return weight * coat_roughness > 0.0 ? mix(roughness, sqrt(sqrt(max(below * below - 2.0 * coat * coat, 0.0))), weight) : roughness;
}

/* OpenPBR's roughness over that of mx_roughness_anisotropy for the same lobe of an anisotropy, which is 1 less the ratio of its two
   squared roughnesses in both. */
float mx_stretch(float anisotropy)
{
    float aspect = 1.0 - min(anisotropy, 0.98);
    return sqrt(sqrt((1.0 + aspect * aspect) / (2.0 * aspect)));
}

// Squared roughness along X and across (KHR_materials_anisotropy).
vec2 mx_gltf_alpha(float roughness, float strength)
{
    float alpha = roughness * roughness;
    return vec2(mix(alpha, 1.0, strength * strength), alpha);
}

// The anisotropy of OpenPBR for squared roughnesses along X and across.
float mx_aspect(vec2 alpha)
{
    return 1.0 - alpha.y / max(alpha.x, 0.00001);
}

// The roughness of mx_roughness_anisotropy for squared roughnesses along X and across.
float mx_lobe_roughness(vec2 alpha)
{
    return sqrt(sqrt(alpha.x * alpha.y));
}

// The inverse of mx_open_pbr_anisotropy.
float mx_open_pbr_roughness(vec2 alpha)
{
    float aspect = alpha.y / max(alpha.x, 0.00001);
    return sqrt(alpha.x * sqrt((1.0 + aspect * aspect) * 0.5));
}

/* OpenPBR's dielectric lies in the index of its coat, the other models' in air: the index that reflects in air as much as `ior` does
   below a coat, and back. */
float mx_ior_below(float ior, float coat_ior, float weight)
{
    return weight > 0.0 ? mix(ior, max(ior / coat_ior, coat_ior / ior), weight) : ior;
}
float mx_ior_above(float ior, float coat_ior, float weight)
{
    return weight > 0.0 ? ior / mix(1.0, 1.0 / coat_ior, weight) : ior;
}
