// SPDX-License-Identifier: Apache-2.0
vec3 tint(vec3 color)
{
    float half_tone = 0.5; // expect-note: previous-definition
    float half_tone = 0.25; // expect-error: redefinition
    return color * half_tone;
}
