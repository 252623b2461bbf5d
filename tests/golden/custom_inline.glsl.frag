#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

void main()
{
    // NG
    vec3 c = vec3(atan(vd.texcoord_0.y, vd.texcoord_0.x), length(vd.texcoord_0), 0.0);
    out1 = vec4(mix(c, c * vec3(1.0, 0.9, 0.7), 0.25), 1.0);
}
