// SPDX-License-Identifier: Apache-2.0
// A slab (docs/slabs.md) as inputs of OpenPBR. A model has one colour B for metal and for what is diffuse, and a dielectric with a reflectance d.
// With the share u of the dielectric, the slab reflects as much as the model where
//
//     albedo = u B,   f0 = u d + (1 - u) B
//
// so d u^2 - (albedo + f0) u + albedo = 0 and B = albedo + f0 - d u. Brightest channels choose u; the colours of both sums stay.

#include "../slabs/blend.glsl"
#include "../slabs/medium.glsl"
#include "translation.glsl"

// The largest reflectance of a dielectric; what reflects more is partly metal.
const float MX_SLAB_DIELECTRIC = 0.2;

// Thicknesses of a coat that light goes through, in and out, on mean ways (docs/slabs.md).
const float MX_SLAB_WAYS = 2.0 * 1.1458980;

// Share of the dielectric, by an albedo and a reflectance.
float mx_slab_share(float albedo, float f0)
{
    float sum = albedo + f0;
    return 2.0 * albedo / max(sum + sqrt(max(sum * sum - 4.0 * MX_SLAB_DIELECTRIC * albedo, 0.0)), 0.000001);
}
float mx_slab_dielectric(vec3 albedo, vec3 f0)
{
    return mx_brightest(f0) > MX_SLAB_DIELECTRIC ? mx_slab_share(mx_brightest(albedo), mx_brightest(f0)) : 1.0;
}

/* UsdPreviewSurface has any f0 above its diffuse colour. The share is that of their means; with it, each channel of the colour reflects
   as much facing the viewer: u d + (1 - u d) B = f0 + (1 - f0) diffuse. A dielectric has a tint in place of d. */
float mx_preview_dielectric(vec3 diffuse, vec3 f0)
{
    float below = dot(diffuse * (1.0 - f0), vec3(1.0 / 3.0)) / (1.0 - MX_SLAB_DIELECTRIC);
    return mx_brightest(f0) > MX_SLAB_DIELECTRIC ? min(mx_slab_share(below, dot(f0, vec3(1.0 / 3.0))), 1.0) : 1.0;
}
vec3 mx_preview_base_color(vec3 diffuse, vec3 f0)
{
    float d = MX_SLAB_DIELECTRIC * mx_preview_dielectric(diffuse, f0);
    vec3 tinted = diffuse * ((1.0 - f0) / max(1.0 - mx_brightest(f0), 0.0001));
    return clamp(mx_brightest(f0) > MX_SLAB_DIELECTRIC ? (f0 + (1.0 - f0) * diffuse - d) / (1.0 - d) : tinted, 0.0, 1.0);
}

// Colour of what is below the interface where no light is refracted.
vec3 mx_slab_base_color(vec3 albedo, vec3 f0, float transmission)
{
    vec3 both = clamp(albedo + f0 - MX_SLAB_DIELECTRIC * mx_slab_dielectric(albedo, f0), 0.0, 1.0);
    vec3 color = mx_brightest(f0) > MX_SLAB_DIELECTRIC ? both : albedo;
    return transmission > 0.0 ? clamp(color / max(1.0 - transmission, 0.001), 0.0, 1.0) : color;
}

// Index of the dielectric.
float mx_slab_ior(vec3 f0)
{
    float f = mx_brightest(f0);
    return f > 0.0 ? mx_ior_of_reflectance(min(f, MX_SLAB_DIELECTRIC)) : 1.5;
}

// Tint of the dielectric; metal has none.
vec3 mx_slab_specular_color(vec3 f0)
{
    float f = mx_brightest(f0);
    return f > 0.0 && f <= MX_SLAB_DIELECTRIC ? f0 / max(f, 0.000001) : vec3(1.0);
}

// Squared roughness along X and across, the wider one first.
vec2 mx_slab_alpha(float roughness, float anisotropy)
{
    float a = abs(anisotropy);
    return roughness * roughness * vec2(1.0 + a, 1.0 - a);
}

// Share of light that the surface refracts, of light that its interface lets in. Matter without an albedo is clear where light goes into it.
float mx_slab_transmission(vec3 albedo, vec3 f0, vec3 mean_free_path, vec3 transmits)
{
    float clear = mx_brightest(albedo) == 0.0 && mx_brightest(mean_free_path) > 0.0 ? 1.0 : 0.0;
    float inside = 1.0 - min(mx_brightest(f0), MX_SLAB_DIELECTRIC);
    return max(clear, clamp(mx_brightest(transmits) / inside, 0.0, 1.0));
}

// Colour of refracted light, with what is left of it after the depth below.
vec3 mx_slab_transmission_color(vec3 mean_free_path, vec3 transmits, vec3 extinction)
{
    float brightest = mx_brightest(transmits);
    float longest = mx_brightest(mean_free_path);
    vec3 left = longest > 0.0 && longest < MX_CLEAR_PATH ? exp(-longest / max(mean_free_path, 0.000001)) : vec3(1.0);
    return brightest > 0.0 ? transmits / max(brightest, 0.000001) * exp(-extinction) : left;
}

// Depth at which the medium has the colour of refracted light; 0: the interface has it.
float mx_slab_transmission_depth(vec3 mean_free_path, vec3 transmits, vec3 extinction)
{
    float longest = mx_brightest(mean_free_path);
    float of_slab = longest < MX_CLEAR_PATH ? longest : 0.0;
    float of_volume = mx_brightest(extinction) > 0.0 ? 1.0 : 0.0;
    return mx_brightest(transmits) > 0.0 ? of_volume : of_slab;
}
