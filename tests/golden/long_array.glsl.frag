#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

uniform float u_time = 0.0;
out vec4 out1;

// SPDX-License-Identifier: Apache-2.0 Notes of a scale, more than a constructor of a vector or matrix takes.
float scale(const float x)
{
    float notes[20] = float[20](0.0, 2.0, 4.0, 5.0, 7.0, 9.0, 11.0, 12.0, 14.0, 16.0, 17.0, 19.0, 21.0, 23.0, 24.0,
        26.0, 28.0, 29.0, 31.0, 33.0);
    return notes[int(clamp(x, 0.0, 19.0))];
}

void main()
{
    // NG
    float s = scale(u_time);
    out1 = vec4(s, s, s, 1.0);
}
