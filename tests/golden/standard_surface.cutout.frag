#version 450
// Leaf · surfacematerial · mxgen 0.1 · glsl · reduced · 1 closure · 1 texture

uniform float u_alphaThreshold = 0.001;
uniform sampler2D mask_file;
in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

void main()
{
    // opacity
    // SR_leaf
    float opacity = clamp(dot(texture(mask_file, vd.texcoord_0).xyz, vec3(0.2722287, 0.6740818, 0.0536895)), 0.0, 1.0);
    if (opacity < u_alphaThreshold)
        discard;
    out1 = vec4(opacity);
}
