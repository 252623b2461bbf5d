#version 450
// out · output · mxgen 0.1 · vulkan · complete · 0 closures · 0 textures

layout(location = 0) in VertexData {
    vec3 positionWorld;
} vd;
layout(location = 0) out vec4 out1;

void main()
{
    out1 = vec4(vd.positionWorld * 0.5, 1.0);
}
