// SPDX-License-Identifier: Apache-2.0
#define HALF 0.5
const float half_again = HALF * 0.5;

float twice(float x) { return 2.0 * x; }
vec3 twice(vec3 x) { return 2.0 * x; }

float forever(float x)
{
    return forever(x - 1.0); // expect-error: lang-recursion
}

vec3 tint(vec3 color)
{
    color.x = twice(color.xy).x;          // expect-error: lang-no-function
    half_again = 2.0;                     // expect-error: lang-not-assignable
    float sizes[int(color.x)];            // expect-error: lang-not-constant
    switch (int(color.x)) { default: }    // expect-error: lang-unsupported
    return vec4(color, 1.0);              // expect-error: lang-type
}
// candidates of twice expect-note@*: lang-candidate
