#version 450
// Flat · surfacematerial · mxgen 0.1 · glsl · reduced · 0 closures · 0 textures

uniform float u_alphaThreshold = 0.001;
out vec4 out1;

struct surfaceshader { vec3 color; vec3 transparency; };
struct displacementshader { vec3 offset; float scale; };
void flat_shader(vec3 color, vec3 opacity, out surfaceshader result)
{
    result.color = color * opacity;
    result.transparency = vec3(1.0) - opacity;
}

void lift(float height, out displacementshader result)
{
    result.offset = vec3(0.0, height, 0.0);
    result.scale = 2.0;
}

void main()
{
    // opacity
    surfaceshader flat1;
    flat_shader(vec3(0.25, 0.5, 0.75), vec3(0.5), flat1);
    float opacity = 1.0 - dot(flat1.transparency, vec3(0.33333334));
    if (opacity < u_alphaThreshold)
        discard;
    out1 = vec4(flat1.color, opacity);
}
