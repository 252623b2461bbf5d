#version 300 es
// Moved · surfacematerial · mxgen 0.1 · essl · complete · 0 closures · 1 texture
precision highp float;
precision highp int;
precision highp sampler2D;

uniform float D_mix;
uniform mat4 u_worldMatrix;
uniform mat4 u_worldInverseTransposeMatrix;
uniform mat4 u_viewProjectionMatrix;
uniform sampler2D height_file;
in vec3 i_position;
in vec3 i_normal;
in vec3 i_tangent;
in vec2 i_texcoord_0;

// 1 on a line of this radius between two points, 0 beside it.
// Here radius = 0.1, point1 = vec2(0.25), point2 = vec2(0.75).
float mx_line(const vec2 p)
{
    vec2 from = p - vec2(0.25);
    return distance(from, vec2(0.5) * clamp(dot(from, vec2(0.5)) / 0.5, 0.0, 1.0)) > 0.1 ? 0.0 : 1.0;
}

void main()
{
    vec3 normalWorld = normalize((u_worldInverseTransposeMatrix * vec4(i_normal, 0.0)).xyz);
    float both = textureLod(height_file, i_texcoord_0, 0.0).x * mx_line(i_texcoord_0);
    vec3 displacement = normalize((u_worldMatrix * vec4(i_tangent, 0.0)).xyz) * 0.1 + normalWorld * both;
    vec3 D_blend = mix(displacement, normalWorld * (both * 0.5), clamp(D_mix, 0.0, 1.0));
    gl_Position = u_viewProjectionMatrix * vec4((u_worldMatrix * vec4(i_position, 1.0)).xyz + D_blend, 1.0);
}
