// SPDX-License-Identifier: Apache-2.0
// Weights of closures, and light between them. The compiler calls these functions (src/closure).

// Mean of the channels.
float mx_mean(vec3 light)
{
    return dot(light, vec3(1.0 / 3.0));
}

// Mean of three colours.
vec3 mx_mean(vec3 a, vec3 b, vec3 c)
{
    return (a + (b + c)) * (1.0 / 3.0);
}

// Mean of light that a fit may bring below 0.
float mx_brightness(vec3 light)
{
    return max(mx_mean(light), 0.0);
}

// Value of a table of eight numbers at x, with straight lines between them from x = 0 to 1.
float mx_between(float x, float a, float b, float c, float d, float e, float f, float g, float h)
{
    vec3 near = clamp(x * 7.0 - vec3(0.0, 1.0, 2.0), 0.0, 1.0), far = clamp(x * 7.0 - vec3(3.0, 4.0, 5.0), 0.0, 1.0);
    return a + dot(near, vec3(b - a, c - b, d - c)) + dot(far, vec3(e - d, f - e, g - f)) + clamp(x * 7.0 - 6.0, 0.0, 1.0) * (h - g);
}

// ---- throughput ------------------------------------------------------------------------------------------------------

// Light after ways through media, of which each lets the decay through.
vec3 mx_decayed(vec3 light, vec3 decay, float ways)
{
    return light * pow(decay, vec3(ways));
}

// Light that passes a closure which is there with a weight.
vec3 mx_weighted_throughput(vec3 throughput, float weight)
{
    return 1.0 - (1.0 - throughput) * weight;
}

// Light that passes a closure which is there with a weight.
vec3 mx_weighted_throughput(vec3 throughput, vec3 weight)
{
    return 1.0 - (1.0 - throughput) * weight;
}

// Light that passes two closures whose responses add up.
vec3 mx_added_throughput(vec3 a, vec3 b)
{
    return max(a + b - 1.0, 0.0);
}

// ---- ways through media ----------------------------------------------------------------------------------------------
// A weight of light on a way x is A + B decay^x. Media have the index 1.5.

// How far light from L goes through a medium of the index 1.5, over its thickness, by Snell's law.
float mx_closure_way(vec3 N, vec3 L)
{
    float cosine = dot(N, L);
    return 1.5 * inversesqrt(1.25 + cosine * cosine);
}

// Decay of a weight that is known for the ways 0, 1 and 2.
//
// Where media hardly absorb, the limit keeps the quotient near the slope.
vec3 mx_decay(vec3 at_rest, vec3 once, vec3 twice)
{
    return clamp((once - twice) / max(at_rest - once, 1e-6), 0.0, 0.999);
}

// Part of a weight that decays on the way.
vec3 mx_decaying(vec3 at_rest, vec3 once, vec3 decay)
{
    return (at_rest - once) / (1.0 - decay);
}

// ---- homogeneous media -----------------------------------------------------------------------------------------------

// Light that goes through a unit of length (Beer, Lambert).
vec3 mx_transmittance(vec3 absorption)
{
    return exp(-absorption);
}

// Absorption of a medium with that transmittance.
vec3 mx_absorption(vec3 transmittance)
{
    return -log(max(transmittance, 1e-6));
}

// Coefficient of a medium with that mean free path.
vec3 mx_extinction(vec3 mean_free_path)
{
    return 1.0 / max(mean_free_path, 1e-5);
}

// Albedo of one scattering in a medium whose surface has a colour (Chiang, Kutz and Burley 2016, "Practical and Controllable Subsurface
// Scattering for Production Path Tracing", equation 1).
vec3 mx_scattering_albedo(vec3 color)
{
    return 1.0 - exp(color * (-5.09406 + color * (2.61188 - 4.31805 * color)));
}

// True if light meets anything.
bool mx_is_medium(vec3 extinction)
{
    return dot(extinction, vec3(1.0)) > 0.0;
}

// Thickness of a ball of a diameter behind a point of its front; 0 behind its back.
float mx_volume_depth(float diameter, vec3 N, vec3 V)
{
    return diameter * max(dot(N, V), 0.0);
}

// Function of the host (docs/hosts.md): the way through a body from P in the direction D.
float mxg_thickness(vec3 P, vec3 D);

// Way of the view through a body, behind a point of its front; 0 behind its back.
float mx_volume_way(float way, vec3 N, vec3 V)
{
    return dot(N, V) > 0.0 ? way : 0.0;
}

// Part of the background that a medium takes away.
vec3 mx_volume_lost(vec3 optical_depth)
{
    return 1.0 - exp(-optical_depth);
}

// Effective length of a way through a medium: the integral of its transmittance over the depth.
//
// With optical_depth = t depth the transmittance is exp(-t x), and lost = 1 - exp(-optical_depth). Below 0.001 the quotient is 1 within 0.05 %,
// and rounding would lose the difference from 1.
vec3 mx_volume_path(float depth, vec3 optical_depth, vec3 lost)
{
    return mix(vec3(1.0), lost / max(optical_depth, 1e-3), step(vec3(1e-3), optical_depth)) * depth;
}

// ---- lights ----------------------------------------------------------------------------------------------------------

// Scale of emitted light by its exposure in stops.
float mx_exposed(float intensity, float exposure)
{
    return intensity * exp2(exposure);
}

// Share of a cone whose axis is the normal in the light that its plane emits: sin^2 of half the angle across it.
float mx_cone_share(float angle)
{
    float sine = sin(angle * 0.5);
    return sine * sine;
}

// Place in a table of an emission by the angle to the normal, up to the number `last` of its entries.
float mx_profile_place(vec3 N, vec3 from_viewer, float entries_per_degree, float last)
{
    float cosine = clamp(-dot(normalize(N), from_viewer), -1.0, 1.0);
    return min(degrees(acos(cosine)) * entries_per_degree, last);
}

// Light of an emitter at a distance: emitted intensity 2^exposure / distance^2.
vec3 mx_light_of_emitter(vec3 emitted, float intensity, float exposure, float way)
{
    return emitted * (intensity * exp2(exposure) / (way * way));
}

// ---- paths -----------------------------------------------------------------------------------------------------------

// Share of the samples for a closure with this albedo. Dark closures have some, too.
float mx_sampled_share(float albedo)
{
    return albedo * 0.9 + 0.1;
}

// Share of the samples for a closure with this albedo. Dark closures have some, too.
vec3 mx_sampled_share(vec3 albedo)
{
    return albedo * 0.9 + 0.1;
}

// Light from a direction that the host and the path may sample, by the balance heuristic (Veach and Guibas 1995).
//
// The path samples it with `density`, the host with one over `solid_angle`.
vec3 mx_balanced(vec3 light, float density, float solid_angle)
{
    float both = 1.0 + density * solid_angle;
    return light / both;
}

// True if L is on the side of N that V sees.
bool mx_is_in_front(vec3 N, vec3 V, vec3 L)
{
    return dot(N, V) * dot(N, L) > 0.0;
}

// A number from 0 to below 1 for a point in a frame: pcg3d (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering"). Its 24 bits are
// exact.
float mx_layer_number(vec3 point, float frame)
{
    uint x = floatBitsToUint(point.x) * 1664525u + 1013904223u;
    uint y = floatBitsToUint(point.y) * 1664525u + 1013904223u;
    uint z = (floatBitsToUint(point.z) ^ floatBitsToUint(frame)) * 1664525u + 1013904223u;
    x += y * z;
    y += z * x;
    z += x * y;
    x ^= x >> 16;
    y ^= y >> 16;
    z ^= z >> 16;
    return float((x + y * z) >> 8) * (1.0 / 16777216.0);
}

// A random number of its own, 0 to below 1, of one that made a choice: below the chance, or not.
float mx_rest_of_number(float number, float chance)
{
    return min(number < chance ? number / chance : (number - chance) / (1.0 - chance), 0.9999999);
}

// Scale of what is there in a part of the area, for samples that meet it always.
float mx_scale_of_coverage(float alpha)
{
    return 1.0 / max(alpha, 1e-6);
}

// Share of what is hidden of what lies behind.
float mx_hidden(vec3 through)
{
    return 1.0 - clamp(mx_mean(through), 0.0, 1.0);
}

// The number from 0 to 1 after a choice that it made: a part of `sum`, below the chosen amount or not.
float mx_rest_of_choice(float point, float chosen, float sum)
{
    return point < chosen ? point / chosen : (point - chosen) / (sum - chosen);
}

// ---- normals of layers -----------------------------------------------------------------------------------------------

// Normal below a layer with a normal and a presence.
vec3 mx_normal_under(vec3 N, vec3 normal, float presence)
{
    return normalize(mix(N, normal, presence));
}

// Normal that a layer bends.
vec3 mx_normal_bent(vec3 N, vec3 bend)
{
    return normalize(N + bend);
}

// Normal that a layer bends where it is present.
vec3 mx_normal_bent(vec3 N, vec3 bend, float presence)
{
    return normalize(N + bend * presence);
}

// ---- samples and output ----------------------------------------------------------------------------------------------

// Direction in a circle after a turn by the golden angle. The new y comes first, so that a GPU changes `turn` in its place.
vec2 mx_next_turn(vec2 turn)
{
    return vec2(-turn.y, turn.x) * 0.67549029 - turn * 0.73736888;
}

// Light in the encoding of sRGB (IEC 61966-2-1).
vec3 mx_srgb_encoded(vec3 color)
{
    vec3 curve = pow(max(color, 0.0), vec3(1.0 / 2.4)) * 1.055 - 0.055;
    return mix(color * 12.92, curve, step(0.0031308, color));
}
