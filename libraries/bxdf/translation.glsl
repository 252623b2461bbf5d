// SPDX-License-Identifier: Apache-2.0

#include "../pbrlib/shaders/optics.glsl"

// KHR_materials_anisotropy stretches alpha.y to mix(alpha.y, 1, strength^2) along the tangent.
float mx_gltf_anisotropy(vec2 alpha)
{
    return alpha.y < 1.0 ? sqrt((alpha.x - alpha.y) / (1.0 - alpha.y)) : 0.0;
}

// OpenPBR Surface specification, "Coat darkening": light bounces below the coat until (1 - F0) / n^2 of it escapes.
vec3 mx_coat_darkening(vec3 base_color, float metalness, float specular, float subsurface, vec3 subsurface_color,
                       float weight, float ior)
{
    vec3 albedo = mix(mix(base_color, subsurface_color, subsurface), base_color * specular, metalness);
    float escape = 4.0 / (ior * (ior + 1.0) * (ior + 1.0));
    return mix(vec3(1.0), escape / (1.0 - albedo * (1.0 - escape)), weight);
}
