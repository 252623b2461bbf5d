// SPDX-License-Identifier: Apache-2.0

// Distance to the closest joint along one axis, in bricks; joints are at whole numbers.
float joint_distance(float x)
{
    return min(fract(x), 1.0 - fract(x));
}

void bricks(vec2 texcoord, float columns, float rows, float mortar, out float mask, out float id)
{
    float row = floor(texcoord.y * rows);
    vec2 p = vec2(texcoord.x * columns + 0.5 * mod(row, 2.0), texcoord.y * rows);
    // Joints have the same width in both directions.
    vec2 width = 0.5 * mortar * vec2(columns / rows, 1.0);
    vec2 inside = step(width, vec2(joint_distance(p.x), joint_distance(p.y)));
    mask = inside.x * inside.y;
    id = fract(sin(dot(floor(p), vec2(12.9898, 78.233))) * 43758.547);
}
