// SPDX-License-Identifier: Apache-2.0
// Range and color adjustments.

// A smooth step from 0 at `low` to 1 at `high`; where low >= high, a sharp one at `high`.
float mx_smoothstep(float x, float low, float high)
{
    return low < high ? smoothstep(low, high, x) : step(high, x);
}

vec2 mx_smoothstep(vec2 x, vec2 low, vec2 high)
{
    return vec2(mx_smoothstep(x.x, low.x, high.x), mx_smoothstep(x.y, low.y, high.y));
}

vec3 mx_smoothstep(vec3 x, vec3 low, vec3 high)
{
    return vec3(mx_smoothstep(x.xy, low.xy, high.xy), mx_smoothstep(x.z, low.z, high.z));
}

vec4 mx_smoothstep(vec4 x, vec4 low, vec4 high)
{
    return vec4(mx_smoothstep(x.xy, low.xy, high.xy), mx_smoothstep(x.zw, low.zw, high.zw));
}

// The hexcone model of A. R. Smith, "Color Gamut Transform Pairs", SIGGRAPH 1978.
vec3 mx_rgbtohsv(vec3 rgb)
{
    float value = max(rgb.r, max(rgb.g, rgb.b));
    float chroma = value - min(rgb.r, min(rgb.g, rgb.b));
    if (value <= 0.0 || chroma <= 0.0)
        return vec3(0.0, 0.0, value);

    float sextant;
    if (rgb.r == value)
        sextant = (rgb.g - rgb.b) / chroma;
    else if (rgb.g == value)
        sextant = 2.0 + (rgb.b - rgb.r) / chroma;
    else
        sextant = 4.0 + (rgb.r - rgb.g) / chroma;
    return vec3(fract(sextant / 6.0), chroma / value, value);
}

// Each primary is a trapezoid over the hue; the three differ by thirds of a turn.
vec3 mx_hsvtorgb(vec3 hsv)
{
    vec3 k = mod(vec3(5.0, 3.0, 1.0) + fract(hsv.x) * 6.0, 6.0);
    return hsv.z - hsv.z * max(hsv.y, 0.0) * clamp(min(k, 4.0 - k), 0.0, 1.0);
}

vec3 mx_hsvadjust(vec3 rgb, vec3 amount)
{
    vec3 hsv = mx_rgbtohsv(rgb);
    return mx_hsvtorgb(vec3(hsv.x + amount.x, hsv.y * amount.y, hsv.z * amount.z));
}

vec3 mx_colorcorrect(vec3 rgb, float hue, float saturation, float gamma, float lift, float gain,
                     float contrast, float pivot, float exposure)
{
    const vec3 luma = vec3(0.2722287, 0.6740818, 0.0536895); // of ACEScg

    vec3 c = mx_hsvadjust(rgb, vec3(hue, 1.0, 1.0));
    c = mix(vec3(dot(c, luma)), c, saturation);
    c = sign(c) * pow(abs(c), vec3(1.0 / gamma));
    c = (c * (1.0 - lift) + lift) * gain;
    c = (c - pivot) * contrast + pivot;
    return c * exp2(exposure);
}
