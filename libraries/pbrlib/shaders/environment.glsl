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
