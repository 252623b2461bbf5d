#version 450
// Edge · surfacematerial · mxgen 0.1 · vulkan · reduced · 0 closures · 1 texture

struct mx_HexTile {
    vec2 uv;
    vec2 dx;
    vec2 dy;
    float rotation;
};
struct mx_HexTiles {
    mx_HexTile a;
    mx_HexTile b;
    mx_HexTile c;
    vec3 barycentric;
};
layout(set = 0, binding = 0, std140) uniform PrivateUniforms {
    int u_numActiveLightSources;
};
struct LightData {
    int type;
    vec3 direction;
    vec3 color;
    float intensity;
    vec3 position;
    float decay_rate;
    float inner_angle;
    float outer_angle;
};
layout(set = 0, binding = 2, std140) uniform LightData_block { LightData u_lightData[3]; };
layout(set = 0, binding = 3) uniform sampler2D tiles_file;
struct VertexData {
    vec3 positionWorld;
    vec4 random;
    vec2 texcoord_0;
    vec2 dx_texcoord_0;
    vec2 dy_texcoord_0;
};
VertexData vd;
vec4 out1;
vec4 out2;
vec4 out3;
vec4 out4;
vec4 out5;
vec4 out6;
vec4 out7;

// The corners of the triangle around a point, in lattice coordinates. Returns its barycentric coordinates.
vec3 mx_hextile_corners(const vec2 coord, out vec2 corner1, out vec2 corner2, out vec2 corner3)
{
    vec2 p = coord * 3.4641016;
    vec2 skewed = vec2(p.x - 0.57735026 * p.y, 1.1547005 * p.y);
    vec2 base = floor(skewed);
    vec2 f = skewed - base;
    float rest = 1.0 - f.x - f.y;
    float upper = rest <= 0.0 ? 1.0 : 0.0;
    float side = 2.0 * upper - 1.0;
    corner1 = base + upper;
    corner2 = base + vec2(upper, 1.0 - upper);
    corner3 = base + vec2(1.0 - upper, upper);
    return vec3(-rest * side, upper - f.y * side, upper - f.x * side);
}

// Dave Hoskins, "Hash without Sine", 2014.
vec2 mx_hextile_random(const vec2 corner)
{
    vec3 q = fract((corner.xyx + vec3(0.12345)) * vec3(0.1031, 0.103, 0.0973));
    q += dot(q, q.yzx + vec3(33.33));
    return fract((q.xx + q.yz) * q.zy);
}

// The vector v turned clockwise by an angle in radians.
vec2 mx_rotate2d(const vec2 v, const float angle)
{
    float s = sin(angle);
    float c = cos(angle);
    return vec2(c * v.x + s * v.y, c * v.y - s * v.x);
}

// How much each of three tiles counts, by its distance and its importance. A falloff of 0.5 changes nothing.
// Here falloff = 0.5.
vec3 mx_hextile_weights(const vec3 barycentric, const vec3 importance)
{
    vec3 w = importance * pow(barycentric, vec3(7.0));
    w /= w.x + w.y + w.z;
    return w;
}

// Bright parts of tiles prevail by `contrast`. Without `has_alpha` the fourth channel is 0.
// Here falloff = 0.5, contrast = 0.5, lumacoeffs = vec3(0.2722287, 0.6740818, 0.0536895), has_alpha = false.
vec4 mx_hextiledimage(sampler2D file, const mx_HexTiles tiles)
{
    vec3 lumacoeffs = vec3(0.2722287, 0.6740818, 0.0536895);
    vec4 c1 = textureGrad(file, tiles.a.uv, tiles.a.dx, tiles.a.dy);
    vec4 c2 = textureGrad(file, tiles.b.uv, tiles.b.dx, tiles.b.dy);
    vec4 c3 = textureGrad(file, tiles.c.uv, tiles.c.dx, tiles.c.dy);
    vec3 w = mx_hextile_weights(tiles.barycentric,
        mix(vec3(1.0), vec3(dot(c1.xyz, lumacoeffs), dot(c2.xyz, lumacoeffs), dot(c3.xyz, lumacoeffs)), vec3(0.5)));
    return vec4(w.x * c1.xyz + w.y * c2.xyz + w.z * c3.xyz, 0.0);
}

void scatter()
{
    float pick = 0.0;
    vec3 L = vec3(0.0);
    float inside = 0.0;
    vec3 weight = vec3(0.0);
    float density = 0.0;
    vec3 medium = vec3(1.0);
    vec2 tiles_corner1, tiles_corner2, tiles_corner3;
    vec3 tiles = mx_hextile_corners(vd.texcoord_0, tiles_corner1, tiles_corner2, tiles_corner3);
    vec2 tiles_random = mx_hextile_random(tiles_corner1);
    vec2 tiles_center = vec2(tiles_corner1.x + tiles_corner1.y * 0.5, tiles_corner1.y / 1.1547005) / vec2(3.4641016);
    float tiles_angle = radians(tiles_random.x * 360.0);
    float tiles_size = mix(0.5, 2.0, tiles_random.y);
    vec2 tiles_sum = tiles_random + (tiles_center
        + mx_rotate2d(vd.texcoord_0 - tiles_center, -tiles_angle) / tiles_size);
    vec2 uv_sum = vd.texcoord_0 + vd.dx_texcoord_0;
    vec2 tiles_difference = uv_sum - vd.texcoord_0;
    vec2 tiles_ratio = mx_rotate2d(tiles_difference, -tiles_angle) / tiles_size;
    vec2 uv_sum_2 = vd.texcoord_0 + vd.dy_texcoord_0;
    vec2 tiles_difference_2 = uv_sum_2 - vd.texcoord_0;
    vec2 tiles_ratio_2 = mx_rotate2d(tiles_difference_2, -tiles_angle) / tiles_size;
    mx_HexTile tiles_hex_tile = mx_HexTile(tiles_sum, tiles_ratio, tiles_ratio_2, tiles_angle);
    vec2 tiles_random_2 = mx_hextile_random(tiles_corner2);
    vec2 tiles_center_2 = vec2(tiles_corner2.x + tiles_corner2.y * 0.5, tiles_corner2.y / 1.1547005) / vec2(3.4641016);
    float tiles_angle_2 = radians(tiles_random_2.x * 360.0);
    float tiles_size_2 = mix(0.5, 2.0, tiles_random_2.y);
    vec2 tiles_sum_2 = tiles_random_2 + (tiles_center_2
        + mx_rotate2d(vd.texcoord_0 - tiles_center_2, -tiles_angle_2) / tiles_size_2);
    vec2 tiles_ratio_3 = mx_rotate2d(tiles_difference, -tiles_angle_2) / tiles_size_2;
    vec2 tiles_ratio_4 = mx_rotate2d(tiles_difference_2, -tiles_angle_2) / tiles_size_2;
    mx_HexTile tiles_hex_tile_2 = mx_HexTile(tiles_sum_2, tiles_ratio_3, tiles_ratio_4, tiles_angle_2);
    vec2 tiles_random_3 = mx_hextile_random(tiles_corner3);
    vec2 tiles_center_3 = vec2(tiles_corner3.x + tiles_corner3.y * 0.5, tiles_corner3.y / 1.1547005) / vec2(3.4641016);
    float tiles_angle_3 = radians(tiles_random_3.x * 360.0);
    float tiles_size_3 = mix(0.5, 2.0, tiles_random_3.y);
    vec2 tiles_sum_3 = tiles_random_3 + (tiles_center_3
        + mx_rotate2d(vd.texcoord_0 - tiles_center_3, -tiles_angle_3) / tiles_size_3);
    vec2 tiles_ratio_5 = mx_rotate2d(tiles_difference, -tiles_angle_3) / tiles_size_3;
    vec2 tiles_ratio_6 = mx_rotate2d(tiles_difference_2, -tiles_angle_3) / tiles_size_3;
    mx_HexTile tiles_hex_tile_3 = mx_HexTile(tiles_sum_3, tiles_ratio_5, tiles_ratio_6, tiles_angle_3);
    vec3 tiles_2 = mx_hextiledimage(tiles_file,
        mx_HexTiles(tiles_hex_tile, tiles_hex_tile_2, tiles_hex_tile_3, tiles)).xyz;
    float width = length(vec2(uv_sum.x - vd.texcoord_0.x, uv_sum_2.x - vd.texcoord_0.x)) * 0.70710677;
    bool edge_is_below = 0.5 - width < width + 0.5;
    float edge_transition = smoothstep(0.5 - width, width + 0.5, vd.texcoord_0.x);
    float smooth_edge = edge_is_below ? edge_transition : step(width + 0.5, vd.texcoord_0.x);
    out1 = vec4(mix(vec3(1.0, 0.0, 0.0), tiles_2, smooth_edge), 1.0);
    out2 = vec4(L, inside);
    out3 = vec4(weight, density);
    out4 = vec4(medium, 0.0);
    out5 = vec4(0.0);
    float chance = fract(vd.random.w * 4096.0);
    float brightness_sum = 0.0;
    vec3 light = vec3(0.0);
    vec3 light_L = vec3(0.0);
    float light_distance = 0.0;
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        vec3 L_2;
        float intensity;
        float away;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L_2 = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
            away = 1e30;
        } else {
            vec3 d = u_lightData[i].position - vd.positionWorld;
            vec3 to_light = normalize(d);
            L_2 = to_light;
            float magnitude_d = length(d);
            float falloff = u_lightData[i].intensity / pow(magnitude_d + 1.0, u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
                away = magnitude_d;
            } else {
                float edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light)) * falloff
                    : 0.0;
                away = magnitude_d;
            }
        }
    }
    out6 = vec4(light_L, light_distance);
    out7 = vec4(light * brightness_sum, 0.0);
}
