#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 3 textures

uniform sampler2D NG_file;
uniform sampler2D framed_file;
uniform sampler2D tiled_file;
in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

void main()
{
    // NG
    vec3 base = texture(NG_file, vd.texcoord_0).xyz;
    vec4 framed = texture(framed_file, vd.texcoord_0);
    vec3 framed_2 = (vd.texcoord_0.x < 0.0 || vd.texcoord_0.x > 1.0 ? vec4(1.0, 0.0, 1.0, 1.0) : framed).xyz;
    vec3 masked = mix(base / vec3(12.92), pow(max((base + vec3(0.055)) / vec3(1.055), 0.0), vec3(2.4)), step(0.04045, base)) * framed_2;
    vec3 tiled = texture(tiled_file, vd.texcoord_0 * vec2(4.0, 2.0)).xyz;
    out1 = vec4(masked + mix(tiled / vec3(12.92), pow(max((tiled + vec3(0.055)) / vec3(1.055), 0.0), vec3(2.4)), step(0.04045, tiled)), 1.0);
}
