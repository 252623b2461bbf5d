// SPDX-License-Identifier: Apache-2.0
// Maps of tones, from linear light in the primaries of Rec. 709 to linear values of a display. develop.js calls them.

import { PLAIN } from "../develop.js";

// Names are those of the specification (github.com/KhronosGroup/ToneMapping, PBR_Neutral/README.md).
const NEUTRAL = `
vec3 tone(vec3 linear)
{
    const float F90 = 0.04, Ks = 0.8 - F90, Kd = 0.15;
    float x = min(linear.r, min(linear.g, linear.b));
    vec3 c = linear - (x <= 2.0 * F90 ? x - x * x / (4.0 * F90) : F90);
    float p = max(c.r, max(c.g, c.b));
    if (p <= Ks)
        return c;
    float pn = 1.0 - (1.0 - Ks) * (1.0 - Ks) / (p + 1.0 - 2.0 * Ks);
    return mix(vec3(pn), c * pn / p, 1.0 / (Kd * (p - pn) + 1.0));
}`;

// AgX by Troy Sobotka (github.com/sobotka/AgX): 16.5 stops around 0.18, a sigmoid with a slope of 2 at its pivot, and powers of 3 below and 3.25
// above. The primaries are those of Blender 4, insets of Rec. 2020 (its configuration of OpenColorIO; github.com/google/filament/pull/7236).
// Changes of primaries are of ITU-R BT.2087. A matrix has its columns one after the other.
const AGX = `
vec3 tone(vec3 linear)
{
    const mat3 toWide = mat3(0.6274, 0.0691, 0.0164, 0.3293, 0.9195, 0.0880, 0.0433, 0.0113, 0.8956);
    const mat3 toInset = mat3(0.856627153315983, 0.137318972929847, 0.11189821299995, 0.0951212405381588, 0.761241990602591, 0.0767994186031903,
        0.0482516061458583, 0.101439036467562, 0.811302368396859);
    const mat3 fromInset = mat3(1.12710058, -0.14132976, -0.14132976, -0.11060664, 1.15782370, -0.11060664, -0.01649394, -0.01649394, 1.25193641);
    const mat3 fromWide = mat3(1.6605, -0.1246, -0.0182, -0.5876, 1.1329, -0.1006, -0.0728, -0.0083, 1.1187);
    const float pivot = 10.0 / 16.5;
    vec3 stops = log2(max(toInset * (toWide * linear), 1e-10) / 0.18), x = clamp((stops + 10.0) / 16.5, 0.0, 1.0) - pivot;
    vec3 side = step(0.0, x), power = mix(vec3(3.0), vec3(3.25), side), room = mix(vec3(pivot), vec3(1.0 - pivot), side);
    vec3 bend = (pow(4.0 * room, power) - 1.0) / pow(room, power);
    vec3 encoded = 0.5 + 2.0 * x * pow(1.0 + bend * pow(abs(x), power), -1.0 / power);
    return fromWide * pow(max(fromInset * encoded, 0.0), vec3(2.2));
}`;

export const TONES = { "None": PLAIN, "Khronos Neutral": NEUTRAL, "AgX": AGX };
