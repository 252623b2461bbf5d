#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

void main()
{
    // NG/shade
    float unit = (vd.texcoord_0.y + 1.0) * 0.5;
    out1 = vec4(sign(unit) * abs(unit) * 4.0 * vec3(0.8, 0.4, 0.1), 1.0);
}
