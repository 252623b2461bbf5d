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
    float scaled_left = abs(abs(abs(abs(abs(abs(abs(vd.texcoord_0.x * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0)
        * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0;
    // six/left/left/right/right/right
    float left = abs(abs(abs(abs(abs(abs(abs(abs(scaled_left - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0)
        * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0);
    // six/left/right/left/right/right
    float scaled_right = abs(abs(abs(abs(abs(abs(abs(left * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0
        - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0;
    // six/left/right/right/right/left
    float right = abs(abs(abs(abs(abs(abs(abs(abs(scaled_right - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0
        - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0);
    // six/right/right/right/right
    float right_2 = fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(abs(abs(right * 2.0
        - 1.0) * 2.0 - 1.0)))))))))))))))));
    out1 = vec4(right_2, right_2, right_2, 1.0);
}
