// SPDX-License-Identifier: Apache-2.0
// Blend and merge operations that have to mind a divisor of zero.

const float MX_ALPHA_EPSILON = 1e-8;

float mx_burn(float fg, float bg)
{
    return abs(fg) < MX_ALPHA_EPSILON ? 0.0 : 1.0 - (1.0 - bg) / fg;
}

vec3 mx_burn(vec3 fg, vec3 bg)
{
    return vec3(mx_burn(fg.r, bg.r), mx_burn(fg.g, bg.g), mx_burn(fg.b, bg.b));
}

vec4 mx_burn(vec4 fg, vec4 bg)
{
    return vec4(mx_burn(fg.rgb, bg.rgb), mx_burn(fg.a, bg.a));
}

float mx_dodge(float fg, float bg)
{
    return abs(1.0 - fg) < MX_ALPHA_EPSILON ? 0.0 : bg / (1.0 - fg);
}

vec3 mx_dodge(vec3 fg, vec3 bg)
{
    return vec3(mx_dodge(fg.r, bg.r), mx_dodge(fg.g, bg.g), mx_dodge(fg.b, bg.b));
}

vec4 mx_dodge(vec4 fg, vec4 bg)
{
    return vec4(mx_dodge(fg.rgb, bg.rgb), mx_dodge(fg.a, bg.a));
}

// Porter and Duff's "over" for layers that avoid each other: bg gives way only where both do not fit.
vec4 mx_disjointover(vec4 fg, vec4 bg)
{
    float coverage = fg.a + bg.a;
    vec3 rgb = fg.rgb + bg.rgb;
    if (coverage > 1.0)
        rgb = abs(bg.a) < MX_ALPHA_EPSILON ? vec3(0.0) : fg.rgb + bg.rgb * ((1.0 - fg.a) / bg.a);
    return vec4(rgb, min(coverage, 1.0));
}
