// SPDX-License-Identifier: Apache-2.0

// Squared roughness along X and across (OpenPBR Surface specification, "Microfacet model").
vec2 mx_open_pbr_anisotropy(float roughness, float anisotropy)
{
    float aspect = 1.0 - anisotropy;
    return roughness * roughness * sqrt(2.0 / (1.0 + aspect * aspect)) * vec2(1.0, aspect);
}

// Roughness of a lobe that is seen through a rough coat (OpenPBR Surface specification, "Roughening").
float mx_open_pbr_blurred(float roughness, float coat_roughness)
{
    return pow(min(2.0 * pow(coat_roughness, 4.0) + pow(roughness, 4.0), 1.0), 0.25);
}

// Index of refraction of a dielectric that reflects `amplitude` squared of the light facing it.
float mx_open_pbr_ior(float amplitude)
{
    return (1.0 + amplitude) / (1.0 - amplitude);
}

// Coefficients per unit of length of a medium that leaves `color` of the light after `depth`
// (OpenPBR Surface specification 1.2, "Translucent base").
void mx_open_pbr_medium(vec3 color, float depth, vec3 albedo, out vec3 absorption, out vec3 scattering)
{
    vec3 extinction = depth > 0.0 ? -log(max(color, vec3(0.000001))) / depth : vec3(0.0);
    scattering = extinction * albedo;
    absorption = extinction - scattering;
}

// Share of light that goes through a smooth interface facing it.
float mx_open_pbr_transmittance(float ior)
{
    return 4.0 * ior / ((ior + 1.0) * (ior + 1.0));
}

// Factor of what lies below a coat: the coat's colour, and what bounces below it, of which the share K stays inside:
//     coat_color mix(1, (1 - K) / (1 - K E coat_color), coat_darkening), E the albedo of the base
// (OpenPBR Surface specification 1.2, "Darkening").
vec3 mx_open_pbr_coat_darkening(vec3 base_color, float base_metalness, float specular_weight, float subsurface_weight,
                                vec3 subsurface_color, vec3 coat_color, float coat_ior, float coat_darkening)
{
    vec3 dielectric = mix(base_color, subsurface_color, subsurface_weight);
    vec3 albedo = mix(dielectric, base_color * min(specular_weight, 1.0), base_metalness);
    float kept = max(1.0 - mx_open_pbr_transmittance(coat_ior) / (coat_ior * coat_ior), 0.0);
    vec3 darkening = vec3(1.0 - kept) / (vec3(1.0) - kept * albedo * coat_color);
    return coat_color * mix(vec3(1.0), darkening, coat_darkening);
}
