// SPDX-License-Identifier: Apache-2.0
// Latitude-longitude environment maps.

#include "frame.glsl"

const int option_environment = 2; // 0 none, 1 prefiltered, 2 importance sampling

uniform mat4 u_envMatrix;
uniform sampler2D u_envRadiance;
uniform sampler2D u_envIrradiance;
uniform float u_envLightIntensity;
uniform int u_envRadianceMips;
uniform int u_envRadianceSamples;

vec2 mx_latlong(vec3 direction)
{
    vec3 d = normalize((u_envMatrix * vec4(direction, 0.0)).xyz);
    return vec2(atan(d.x, -d.z), -2.0 * asin(d.y)) * (0.5 / MX_PI) + 0.5;
}

vec3 mx_environment_radiance(vec3 direction, float lod)
{
    return textureLod(u_envRadiance, mx_latlong(direction), lod).rgb * u_envLightIntensity;
}

// Cosine-weighted average of the light around N.
vec3 mx_environment_irradiance(vec3 N)
{
    if (option_environment == 0)
        return vec3(0.0);
    return textureLod(u_envIrradiance, mx_latlong(N), 0.0).rgb * u_envLightIntensity;
}

// ---- lobes by their own samples -------------------------------------------------------------------------------------
// What `--integrator path` adds to a raster: where an average over the hemisphere stands in for a lobe otherwise, directions
// are drawn by its `_sample`, as a path tracer draws them.

// Numbers for sample i: a lattice in three dimensions (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom
// Sequences": powers of the inverse of the plastic number).
vec3 mx_lobe_random(int i)
{
    float n = float(i) + 1.0;
    return vec3((n - 0.5) / float(u_envRadianceSamples), fract(n * 0.75487767), fract(n * 0.56984029));
}

// A sample's part of what the lobe reflects; filtered as in mx_ggx_sample.
vec3 mx_lobe_light(vec3 L, vec3 weight, float pdf)
{
    float count = float(u_envRadianceSamples);
    float solid = max(length(L.xz) * pdf * count, MX_EPSILON);
    return weight / count * mx_environment_radiance(L, max(float(u_envRadianceMips) - 2.5 - 0.5 * log2(solid), 0.0));
}
