// SPDX-License-Identifier: Apache-2.0
// Ramps and flat patterns.

#include "adjustment.glsl"

// A step as wide as a pixel.
float mx_smooth_edge(float edge, float x)
{
    float width = length(vec2(dFdx(x), dFdy(x))) * 0.70710678;
    return mx_smoothstep(x, edge - width, edge + width);
}

vec4 mx_ramp_gradient(float x, float interval1, float interval2, vec4 color1, vec4 color2, int interpolation,
                      vec4 prev_color, int interval_num, int num_intervals)
{
    if (interval_num >= num_intervals || x <= interval1)
        return prev_color;
    if (interpolation == 2)
        return x < interval2 ? color1 : color2;
    float t = x < interval2 ? (x - interval1) / (interval2 - interval1) : 1.0;
    return mix(color1, color2, interpolation == 1 ? t * t * (3.0 - 2.0 * t) : t);
}

// Types: 0 along u, 1 by the angle about the middle, 2 by the distance from it, 3 by the greater of the two distances.
float mx_ramp_position(vec2 texcoord, int type)
{
    vec2 p = texcoord - 0.5;
    if (type == 1)
        return atan(p.x, p.y) / 6.2831853 + 0.5;
    if (type == 2)
        return length(p) * 1.414; // about 1 in the corners
    if (type == 3)
        return 2.0 * max(abs(p.x), abs(p.y));
    return texcoord.x;
}

vec4 mx_ramp(vec2 texcoord, int type, int interpolation, int num_intervals,
             float interval1, vec4 color1, float interval2, vec4 color2, float interval3, vec4 color3,
             float interval4, vec4 color4, float interval5, vec4 color5, float interval6, vec4 color6,
             float interval7, vec4 color7, float interval8, vec4 color8, float interval9, vec4 color9,
             float interval10, vec4 color10)
{
    float x = mx_ramp_position(texcoord, type);
    vec4 c = mx_ramp_gradient(x, interval1, interval2, color1, color2, interpolation, color1, 1, num_intervals);
    c = mx_ramp_gradient(x, interval2, interval3, color2, color3, interpolation, c, 2, num_intervals);
    c = mx_ramp_gradient(x, interval3, interval4, color3, color4, interpolation, c, 3, num_intervals);
    c = mx_ramp_gradient(x, interval4, interval5, color4, color5, interpolation, c, 4, num_intervals);
    c = mx_ramp_gradient(x, interval5, interval6, color5, color6, interpolation, c, 5, num_intervals);
    c = mx_ramp_gradient(x, interval6, interval7, color6, color7, interpolation, c, 6, num_intervals);
    c = mx_ramp_gradient(x, interval7, interval8, color7, color8, interpolation, c, 7, num_intervals);
    c = mx_ramp_gradient(x, interval8, interval9, color8, color9, interpolation, c, 8, num_intervals);
    return mx_ramp_gradient(x, interval9, interval10, color9, color10, interpolation, c, 9, num_intervals);
}

float mx_checker(vec2 p)
{
    vec2 cell = floor(p);
    return mod(cell.x + cell.y, 2.0);
}

// 1 on a line of this radius between two points, 0 beside it.
float mx_line(vec2 p, float radius, vec2 point1, vec2 point2)
{
    vec2 along = point2 - point1;
    vec2 from = p - point1;
    float nearest = clamp(dot(from, along) / max(dot(along, along), 1e-20), 0.0, 1.0);
    return distance(from, along * nearest) > radius ? 0.0 : 1.0;
}

float mx_circle(vec2 p, float radius)
{
    return dot(p, p) > radius * radius ? 0.0 : 1.0;
}

// Four circles about the middles of the sides of a square that is as wide as the radius.
float mx_cloverleaf(vec2 p, float radius)
{
    vec2 q = 2.0 * abs(p);
    float reach = abs(radius);
    return max(mx_circle(q - vec2(reach, 0.0), reach), mx_circle(q - vec2(0.0, reach), reach));
}

// A regular hexagon, its radius being that of the inscribed circle: symmetry folds the plane to one half of one side.
float mx_hexagon(vec2 p, float radius)
{
    const vec2 side = vec2(-0.866025, 0.5);

    vec2 q = abs(vec2(p.y, p.x));
    q -= 2.0 * side * min(dot(side, q), 0.0);
    vec2 mirrored = vec2(-side.x, side.y);
    q -= 2.0 * mirrored * min(dot(mirrored, q), 0.0);
    float reach = 0.57735 * radius;
    q -= vec2(clamp(q.x, -reach, reach), radius);
    return q.x + q.y > 0.0 ? 0.0 : 1.0;
}

// Tilings

// Positions relative to the three nearest shapes of rows that are shifted by half a tile in turn.
void mx_stagger(vec2 p, float row_height, out vec2 left, out vec2 right, out vec2 above)
{
    float shift = mod(p.y, 2.0 * row_height) > row_height ? 0.5 : 0.0;
    float x = fract(p.x + shift);
    float y = mod(p.y, row_height);
    left = vec2(x, y);
    right = vec2(1.0 - x, y);
    above = vec2(x - 0.5, row_height - y);
}

const float MX_CLOSE_PACKING = 0.866025; // sqrt(3)/2: rows of circles that touch

float mx_tiledcircles(vec2 p, float size, bool staggered)
{
    if (!staggered)
        return mx_circle(2.0 * fract(p) - 1.0, size);
    vec2 a, b, c;
    mx_stagger(p, MX_CLOSE_PACKING, a, b, c);
    return max(max(mx_circle(a, 0.5 * size), mx_circle(b, 0.5 * size)), mx_circle(c, 0.5 * size));
}

float mx_tiledcloverleafs(vec2 p, float size, bool staggered)
{
    if (!staggered)
        return mx_cloverleaf(2.0 * fract(p) - 1.0, size);
    vec2 a, b, c;
    mx_stagger(p, 0.5, a, b, c);
    return max(max(mx_cloverleaf(a, 0.5 * size), mx_cloverleaf(b, 0.5 * size)), mx_cloverleaf(c, 0.5 * size));
}

float mx_tiledhexagons(vec2 p, float size, bool staggered)
{
    if (!staggered)
        return mx_hexagon(2.0 * fract(p) - 1.0, size);
    vec2 a, b, c;
    mx_stagger(p, MX_CLOSE_PACKING, a, b, c);
    return max(max(mx_hexagon(a, 0.5 * size), mx_hexagon(b, 0.5 * size)), mx_hexagon(c, 0.5 * size));
}

// The position in a tile, from -1 to 1.
vec2 mx_tile(vec2 p, bool staggered)
{
    float shift = staggered && mod(p.y, 2.0) > 1.0 ? 0.5 : 0.0;
    return 2.0 * fract(vec2(p.x + shift, p.y)) - 1.0;
}

float mx_grid(vec2 p, float thickness, bool staggered)
{
    vec2 q = abs(mx_tile(p, staggered));
    return max(q.x, q.y) > 1.0 - thickness ? 1.0 : 0.0;
}

float mx_crosshatch(vec2 p, float thickness, bool staggered)
{
    vec2 q = mx_tile(p, staggered);
    return max(mx_line(q, thickness, vec2(1.0, 1.0), vec2(-1.0, -1.0)),
               mx_line(q, thickness, vec2(-1.0, 1.0), vec2(1.0, -1.0)));
}
