#version 450
// out · output · mxgen 0.1 · glsl · reduced · 0 closures · 0 textures

in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

float fold(const float p0)
{
    return abs(abs(p0 * 2.0 - 1.0) * 2.0 - 1.0);
}

void main()
{
    // six/left/left/left/right/right
    float right = abs(abs(abs(abs(abs(abs(abs(vd.texcoord_0.x * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0;
    // six/left/left/right/right/right
    float left = abs(abs(abs(abs(abs(abs(abs(abs(right - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0);
    // six/left/right/left/right/right
    float left_2 = abs(abs(abs(abs(abs(abs(abs(left * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0;
    // six/left/right/right/right/left
    float right_2 = abs(abs(abs(abs(abs(abs(abs(abs(left_2 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0);
    // six/right/right/right/right
    float right_3 = fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(abs(abs(right_2 * 2.0 - 1.0) * 2.0 - 1.0)))))))))))))))));
    out1 = vec4(right_3, right_3, right_3, 1.0);
}
