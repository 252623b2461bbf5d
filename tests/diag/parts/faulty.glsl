// SPDX-License-Identifier: Apache-2.0
#define HALF 0.5
const float half_again = HALF * 0.5;
const float now = dFdx(HALF); // expect-error: lang-not-constant

float twice(float x) { return 2.0 * x; }
vec3 twice(vec3 x) { return 2.0 * x; }
float either(float x, int y) { return x + float(y); }
float either(int x, float y) { return float(x) + y; }

vec3 tint(vec3 color)
{
    color.x = twice(color.xy).x;          // expect-error: lang-no-function 15
    // expect-note@6: lang-candidate 7 expect-note@7: lang-candidate 6
    color.y = either(1, 2);               // expect-error: lang-ambiguous 15
    // expect-note@8: lang-candidate 7 expect-note@9: lang-candidate 7
    half_again = 2.0;                     // expect-error: lang-not-assignable 5
    switch (int(color.x)) { default: }    // expect-error: lang-unsupported 5
    return vec4(color, 1.0);              // expect-error: lang-type 12
}
