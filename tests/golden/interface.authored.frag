#version 450
// out · output · mxgen 0.1 · glsl · authored · 0 closures · 0 textures

uniform float NG_scale = 4.0;
uniform vec3 NG_tint = vec3(0.8, 0.4, 0.1);
in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

void main()
{
    // NG/shade
    float unit = (vd.texcoord_0.y + 1.0) * 0.5;
    out1 = vec4(NG_scale * (sign(unit) * abs(unit)) * NG_tint, 1.0);
}
