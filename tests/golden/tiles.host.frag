#version 450
// out · output · mxgen 0.1 · glsl · reduced · 0 closures · 5 textures

uniform sampler2D stone_filex;
uniform sampler2D stone_filey;
uniform sampler2D stone_filez;
uniform sampler2D wall_file;
uniform sampler2D rust_file;
in VertexData {
    vec3 positionObject;
    vec3 normalObject;
    vec2 texcoord_0;
} vd;
out vec4 out1;

// IEC 61966-2-1
vec3 mx_srgb_texture_to_lin_rec709(const vec3 color)
{
    return mix(color / vec3(12.92), pow(max((color + vec3(0.055)) / vec3(1.055), vec3(0.0)), vec3(2.4)),
        step(0.04045, color));
}

// The textures along three axes, mixed by the direction of the normal.
// Here upaxis = 2, blend = 1.0, filtertype = "linear".
vec4 mx_triplanar(sampler2D filex, sampler2D filey, sampler2D filez, const vec3 position, const vec3 normal)
{
    vec3 weight = abs(normalize(normal));
    weight /= dot(weight, vec3(1.0));
    weight /= dot(weight, vec3(1.0));
    return texture(filex, position.yz) * weight.x + texture(filey, position.xz) * weight.y
        + texture(filez, position.xy) * weight.z;
}

// Cubic B-spline filtering by four linear lookups: Christian Sigg and Markus Hadwiger, "Fast Third-Order Texture
// Filtering", GPU Gems 2, 2005, chapter 20. Each lookup stands for two texels of a row and two of a column, between
// which it lies by the ratio of their weights.
vec4 mx_sample_cubic(sampler2D file, const vec2 uv)
{
    vec2 size = vec2(textureSize(file, 0));
    vec2 texel = uv * size - vec2(0.5);
    vec2 f = fract(texel);
    vec2 g = vec2(1.0) - f;
    vec2 w1 = vec2(0.6666667) - f * f * (vec2(1.0) - 0.5 * f);
    vec2 w2 = vec2(0.6666667) - g * g * (vec2(1.0) - 0.5 * g);
    vec2 w3 = f * f * f / vec2(6.0);
    vec2 low = (floor(texel) - vec2(0.5) + w1 / (g * g * g / vec2(6.0) + w1)) / size;
    vec2 high = (floor(texel) + vec2(1.5) + w3 / (w2 + w3)) / size;
    vec2 t = w2 + w3;
    vec2 dx = dFdx(uv);
    vec2 dy = dFdy(uv);
    return mix(mix(textureGrad(file, low, dx, dy), textureGrad(file, vec2(high.x, low.y), dx, dy), t.x),
        mix(textureGrad(file, vec2(low.x, high.y), dx, dy), textureGrad(file, high, dx, dy), t.x), t.y);
}

void main()
{
    // NG
    vec3 wall = mx_srgb_texture_to_lin_rec709(texture(wall_file, vd.texcoord_0).xyz);
    vec3 stone = mx_triplanar(stone_filex, stone_filey, stone_filez, vd.positionObject, normalize(vd.normalObject)).xyz;
    out1 = vec4(mix(wall, stone, mx_sample_cubic(rust_file, vd.texcoord_0).x), 1.0);
}
