#version 450
// Unlit · surfacematerial · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

uniform float SR_unlit_emission = 1.0;
uniform float SR_unlit_transmission = 0.25;
uniform vec3 SR_unlit_transmission_color = vec3(1.0);
uniform float fade = 0.5;
uniform float u_alphaThreshold = 0.001;
in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

void main()
{
    // opacity
    float clamped_fade = clamp(fade, 0.0, 1.0);
    float opacity = clamped_fade * (1.0 - dot(SR_unlit_transmission * SR_unlit_transmission_color, vec3(0.33333334)));
    if (opacity < u_alphaThreshold)
        discard;
    out1 = vec4(vec3(vd.texcoord_0, 0.0) * (SR_unlit_emission * clamped_fade), opacity);
}
