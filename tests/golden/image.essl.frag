#version 300 es
// out · output · mxgen 0.1 · essl · complete · 0 closures · 3 textures
precision highp float;
precision highp int;
precision highp sampler2D;

uniform sampler2D NG_file;
uniform sampler2D framed_file;
uniform sampler2D tiled_file;
in vec2 vd_texcoord_0;
out vec4 out1;

void main()
{
    // NG
    vec3 base = texture(NG_file, vd_texcoord_0).xyz;
    vec3 base_2 = mix(base / vec3(12.92), pow(max((base + vec3(0.055)) / vec3(1.055), 0.0), vec3(2.4)), step(0.04045, base));
    vec3 tiled = texture(tiled_file, vd_texcoord_0 * vec2(4.0, 2.0)).xyz;
    vec3 tiled_2 = mix(tiled / vec3(12.92), pow(max((tiled + vec3(0.055)) / vec3(1.055), 0.0), vec3(2.4)), step(0.04045, tiled));
    out1 = vec4(base_2 * texture(framed_file, vd_texcoord_0).xyz + tiled_2, 1.0);
}
