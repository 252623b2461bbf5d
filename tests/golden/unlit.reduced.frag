#version 450
// Unlit · surfacematerial · mxgen 0.1 · glsl · reduced · 0 closures · 0 textures

uniform float u_alphaThreshold = 0.001;
in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

void main()
{
    // opacity
    if (0.375 < u_alphaThreshold)
        discard;
    out1 = vec4(vec3(vd.texcoord_0, 0.0) * 0.5, 0.375);
}
