// SPDX-License-Identifier: Apache-2.0
// Latitude-longitude environment maps.

#include "frame.glsl"

const int option_environment = 2; // 0 none, 1 prefiltered, 2 importance sampling

// Over how much of the map a sample is a mean: a power of two of its texels, 2^-7.3 of them being the solid angle that the sample stands for.
// Filters overlap, so that few samples leave no pattern: wide ones (0) have five times the angle, nearly as MaterialX's, narrow ones (1) twice.
const int option_sample_filter = 0;

uniform mat4 u_envMatrix;
uniform sampler2D u_envRadiance;
uniform sampler2D u_envIrradiance;
uniform float u_envLightIntensity;
uniform int u_envRadianceMips;
uniform int u_envRadianceSamples;

// Where the light from a direction of the world lies in the environment's picture.
vec2 mx_latlong(vec3 direction)
{
    vec3 d = normalize((u_envMatrix * vec4(direction, 0.0)).xyz);
    return vec2(atan(d.x, -d.z), -2.0 * asin(clamp(d.y, -1.0, 1.0))) * (0.5 / MX_PI) + 0.5;
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

// Light of a direction, filtered over the solid angle of a sample (Krivanek and Colbert 2008; the mip level is equation 13 of GPU Gems 3,
// section 20.4).
vec3 mx_filtered_light(vec3 L, float level)
{
    return textureLod(u_envRadiance, mx_latlong(L), max(0.25 * log2(level * level / dot(L.xz, L.xz)), 0.0)).rgb;
}

// ---- lobes by their own samples: with `--integrator path`, where an average over the hemisphere stands in for them otherwise

// Numbers for sample i: powers of the plastic number (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences").
vec3 mx_lobe_random(int i)
{
    return vec3((float(i) + 0.5) / float(u_envRadianceSamples), fract((float(i) + 1.0) * vec2(0.75487767, 0.56984029)));
}

// A sample's part of what the lobe reflects.
vec3 mx_lobe_light(vec3 L, vec3 weight, float pdf)
{
    float count = float(u_envRadianceSamples);
    float level = exp2(2.0 * float(u_envRadianceMips) - 5.0 - 1.3 * float(option_sample_filter)) / max(pdf * count, MX_EPSILON);
    return weight * (u_envLightIntensity / count) * mx_filtered_light(L, level);
}
