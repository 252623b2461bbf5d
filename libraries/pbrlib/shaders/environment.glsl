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

// Into the environment's picture, which rotates with u_envMatrix, from a frame.
mat3 mx_map_frame(mat3 frame)
{
    return mat3(u_envMatrix) * frame;
}

// The point of the picture for a unit direction in it. The minimax polynomials of atan and acos are within 1.3e-5 of a whole turn, a
// tenth of a texel in 8192; the built-in functions take twice as long.
vec2 mx_map_point(vec3 d)
{
    vec2 a = abs(d.xz);
    float t = min(a.x, a.y) / max(max(a.x, a.y), MX_EPSILON);
    float t2 = t * t;
    float turn = t * (0.1590298 + t2 * (t2 * (0.0232785 - 0.0062048 * t2) - 0.0511165));
    turn = a.x > a.y ? 0.25 - turn : turn;
    turn = d.z > 0.0 ? 0.5 - turn : turn;
    float y = abs(d.y);
    float height = sqrt(max(1.0 - y, 0.0)) * (0.4999879 + y * (y * (0.0244774 - 0.0066502 * y) - 0.0677603));
    return vec2(d.x < 0.0 ? 0.5 - turn : 0.5 + turn, d.y < 0.0 ? 1.0 - height : height);
}

// Where the light from a direction of the world lies in the environment's picture.
vec2 mx_latlong(vec3 direction)
{
    return mx_map_point(normalize((u_envMatrix * vec4(direction, 0.0)).xyz));
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

// Light of a unit direction in the picture, filtered over the solid angle of a sample, in hemispheres (Krivanek and Colbert 2008; the mip
// level is equation 13 of GPU Gems 3, section 20.4).
vec3 mx_filtered_light(vec3 d, float spread)
{
    float level = 0.25 * log2(spread * spread / dot(d.xz, d.xz)) + float(u_envRadianceMips) - 1.17425 - 0.65 * float(option_sample_filter);
    return textureLod(u_envRadiance, mx_map_point(d), max(level, 0.0)).rgb;
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
    float spread = 0.5 / (MX_PI * max(pdf * count, MX_EPSILON));
    return weight * (u_envLightIntensity / count) * mx_filtered_light(normalize(mat3(u_envMatrix) * L), spread);
}
