// SPDX-License-Identifier: Apache-2.0
// A light shader: the inputs of its definition, the shaded point, then unit direction to the light and radiance that arrives.

#define PI 3.14159265

// The light that leaves at an angle from its axis: nothing sideways, a little upwards.
vec3 lantern_emission(vec3 color, float upwards, float cosine)
{
    return color * (max(cosine, 0.0) + upwards * max(-cosine, 0.0)) / PI;
}

void lantern_light(vec3 position, vec3 direction, vec3 color, float power, float upwards, vec3 P, out vec3 to_light,
                   out vec3 radiance)
{
    vec3 path = position - P;
    float squared = max(dot(path, path), 1e-6);
    to_light = path * inversesqrt(squared);
    radiance = lantern_emission(color, upwards, -dot(to_light, direction)) * (power / squared);
}
