// SPDX-License-Identifier: Apache-2.0
// Latitude-longitude environment maps, or functions of the host.

#include "frame.glsl"

const int option_environment = 2; // 0 none, 1 prefiltered, 2 importance sampling

// How many of `u_envRadianceSamples` a lobe takes: a quarter (0), half (1), or all (2), and fewer if it is sharp, except for (2).
// With (2) closures keep energy that MaterialX's rasters lose or gain.
const int option_quality = 1;

const int option_host_environment = 0; // with option_environment 1: functions of the host (docs/hosts.md) have the light
vec3 mxg_irradiance(vec3 P, vec3 N);
vec3 mxg_radiance(vec3 P, vec3 L, float roughness);

in vec3 positionWorld;

uniform mat4 u_envMatrix;
uniform sampler2D u_envRadiance;
uniform sampler2D u_envIrradiance;
uniform float u_envLightIntensity;
uniform int u_envRadianceMips;
uniform int u_envRadianceSamples;

// A frame's axes in the space of the environment's picture.
mat3 mx_map_frame(mat3 frame)
{
    return mat3(u_envMatrix) * frame;
}

// The angle, over pi, with this sine and cosine; the cosine is not negative. It errs by 2.9e-5 at most.
//
// The program fits/turn.c makes the constants.
float mx_half_turn(float sine, float cosine)
{
    return sine * (0.4999709 + cosine * (cosine * (0.2302802 + cosine * (0.0398298 * cosine - 0.1351235)) - 0.3164252));
}

// The square of the distance of the unit direction d from the vertical axis, never 0.
float mx_map_square(vec3 d)
{
    return d.x * d.x + (d.z * d.z + MX_EPSILON * MX_EPSILON);
}

// The point of the latitude-longitude picture for the unit direction d, to a tenth of a texel in 4096.
vec2 mx_map_point(vec3 d)
{
    float square = mx_map_square(d);
    float stretch = inversesqrt(square);
    float around = mx_half_turn(d.x * stretch, abs(d.z) * stretch);
    float side = d.z > 0.0 ? -0.5 : 0.5; // in front the point is -around / 2, behind 1/2 + around / 2
    return vec2(fract(side * (around + 0.5) + 0.25), 0.5 - mx_half_turn(d.y, square * stretch));
}

// The point of the environment's picture for a direction of the world.
vec2 mx_latlong(vec3 direction)
{
    return mx_map_point(normalize(mat3(u_envMatrix) * direction));
}

// Light of the environment from a direction, at a level of detail.
vec3 mx_environment_radiance(vec3 direction, float lod)
{
    return textureLod(u_envRadiance, mx_latlong(direction), lod).rgb * u_envLightIntensity;
}

// Light of the environment on a surface with the normal N, of any length: the mean, weighted by the cosine.
vec3 mx_environment_irradiance(vec3 N)
{
    if (option_environment == 0)
        return vec3(0.0);
    if (option_host_environment == 1)
        return mxg_irradiance(positionWorld, normalize(N));
    return textureLod(u_envIrradiance, mx_latlong(N), 0.0).rgb * u_envLightIntensity;
}

// The texels at the picture's equator that a solid angle of `spread` hemispheres covers (Krivanek and Colbert 2008;
// GPU Gems 3, section 20.4, equation 13).
float mx_map_texels(float spread)
{
    return spread * exp2(2.0 * float(u_envRadianceMips) - 4.6485);
}

// Roughness, squared, up to which a lobe is a mirror for a map.
const float MX_SMOOTH = 2e-4;

// The number of samples, from 1, that a lobe takes; roughness is that along two directions, squared.
//
// With half of them a lobe errs as much as MaterialX's with all. A sharp one does with fewer (docs/benchmarks.md); an
// oval one needs more, because a sample is a mean over a round part of the map.
int mx_sample_count(vec2 roughness)
{
    float wide = max(roughness.x, roughness.y);
    if (mx_known(wide <= MX_SMOOTH))
        return 1;
    if (option_quality == 2)
        return max(u_envRadianceSamples, 1);
    float share = (option_quality == 1 ? 0.5 : 0.25) * min(4.0 * sqrt(wide), 1.0);
    if (!mx_known(roughness.x == roughness.y))
        share = min(share * wide / min(roughness.x, roughness.y), 1.0);
    return max(int(ceil(share * float(u_envRadianceSamples))), 1);
}

// The part of a lobe over which one of `count` samples is a mean: twice what the sample stands for, so that the means leave
// no pattern, and, unless the quality is better, nearly as much as of a sample of MaterialX, whose pictures have that blur.
float mx_sample_part(int count)
{
    float part = 2.0 / float(count);
    return option_quality == 2 ? part : max(part, 4.4 / float(max(u_envRadianceSamples, 1)));
}

// Light of the environment from the unit direction d of its picture, filtered over as many texels.
//
// The level may be negative, where a sampler magnifies. It comes before the point, whose numbers then need no
// registers beside it.
vec3 mx_filtered_light(vec3 d, float texels)
{
    float level = 0.5 * log2(texels * inversesqrt(mx_map_square(d)));
    return textureLod(u_envRadiance, mx_map_point(d), level).rgb;
}

// ---- lobes by their own samples: with `--role path`, where an average over the hemisphere stands in for them otherwise

// Three numbers for sample i: powers of the plastic number (Roberts 2018, "The Unreasonable Effectiveness of
// Quasirandom Sequences").
vec3 mx_lobe_random(int i)
{
    return vec3((float(i) + 0.5) / float(u_envRadianceSamples), fract((float(i) + 1.0) * vec2(0.75487767, 0.56984029)));
}

// The part that a sample of a lobe, in direction L, has of the light that the lobe reflects: `weight` is its value
// over its density `pdf`.
vec3 mx_lobe_light(vec3 L, vec3 weight, float pdf)
{
    float spread = 0.5 * mx_sample_part(u_envRadianceSamples) / (MX_PI * max(pdf, MX_EPSILON));
    return weight * (u_envLightIntensity / float(u_envRadianceSamples)) * mx_filtered_light(normalize(mat3(u_envMatrix) * L), mx_map_texels(spread));
}
