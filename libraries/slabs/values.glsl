// SPDX-License-Identifier: Apache-2.0
// Values that the graph of a slab's lobes computes of the slab and its place.

#include "../pbrlib/shaders/diffuse.glsl"
#include "medium.glsl"

// Reflectance at grazing angles: the hue of f90 with the brightness 1. The interface fades out where f0 falls below
// 0.02, less than any matter reflects.
vec3 mx_slab_grazing(vec3 f0, vec3 f90)
{
    vec3 hue = max(f90, 0.0) / max(max(f90.x, max(f90.y, f90.z)), MX_EPSILON);
    return hue * clamp(50.0 * max(f0.x, max(f0.y, f0.z)), 0.0, 1.0);
}

// 0 for an interface that is known to reflect nothing, which has no lobe; else 1.
float mx_slab_reflects(vec3 f0)
{
    return mx_known(max(f0.x, max(f0.y, f0.z)) <= 0.0) ? 0.0 : 1.0;
}

// A body whose medium scatters is seen through nowhere.
float mx_slab_is_thick(vec3 color, vec3 mean_free_path, float is_body, float scatters)
{
    bool is_clear = scatters == 0.0 && mx_is_black(color);
    return mx_is_black(mean_free_path) || is_clear ? 0.0 : is_body;
}

// Light goes into a body that is not opaque, where a path tracer follows it.
float mx_slab_is_entered(vec3 mean_free_path, float walks)
{
    return mx_is_black(mean_free_path) ? 0.0 : walks;
}

// 1 for matter with light of its own.
float mx_slab_is_lit(vec3 emission)
{
    return mx_is_black(emission) ? 0.0 : 1.0;
}

// The mean free path over the thickness. Of a body: the radius of its scattered light, for shaders that do not spread it over that of the surface.
vec3 mx_slab_free_path(vec3 mean_free_path, float thickness, float is_thick, vec3 N, vec3 P)
{
    if (is_thick > 0.0)
        return (option_sss == 1 ? 1.0 : mx_curvature(N, P)) * max(mean_free_path, 0.1);
    return mean_free_path / max(thickness, 1e-6);
}
