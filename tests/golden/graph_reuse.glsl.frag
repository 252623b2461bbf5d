#version 450
// out · output · mxgen 0.1 · glsl · reduced · 0 closures · 0 textures

in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

void main()
{
    // NG/first/a
    float distance_ = length(vd.texcoord_0);
    // NG/first/b
    float gap = abs(distance_ - 0.75);
    // NG/first
    float nearest = min(abs(distance_ - 0.25), gap);
    out1 = vec4(nearest, nearest, min(abs(distance_ - 0.5), gap), 1.0);
}
