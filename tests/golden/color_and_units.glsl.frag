#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

uniform vec3 NG_paint = vec3(0.5, 0.25, 0.125);
uniform float NG_size = 10.0;
out vec4 out1;

void main()
{
    // NG/scaled
    float scaled = NG_paint.x > 0.04045 ? pow((NG_paint.x + 0.055) / 1.055, 2.4) : NG_paint.x / 12.92;
    float scaled_2 = NG_paint.y > 0.04045 ? pow((NG_paint.y + 0.055) / 1.055, 2.4) : NG_paint.y / 12.92;
    float scaled_3 = NG_paint.z > 0.04045 ? pow((NG_paint.z + 0.055) / 1.055, 2.4) : NG_paint.z / 12.92;
    out1 = vec4(vec3(scaled, scaled_2, scaled_3) * (NG_size * 0.0254) + vec3(0.5), 1.0);
}
