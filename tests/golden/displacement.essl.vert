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
out vec3 vd_positionWorld;
out vec3 vd_normalWorld;
out vec3 vd_tangentWorld;
out vec2 vd_texcoord_0;

// 1 on a line of this radius between two points, 0 beside it.
// Here radius = 0.1, point1 = vec2(0.25), point2 = vec2(0.75).
float mx_line(const vec2 p)
{
    vec2 from = p - vec2(0.25);
    return distance(from, vec2(0.5) * clamp(dot(from, vec2(0.5)) / 0.5, 0.0, 1.0)) > 0.1 ? 0.0 : 1.0;
}

void main()
{
    vd_normalWorld = normalize((u_worldInverseTransposeMatrix * vec4(i_normal, 0.0)).xyz);
    vd_texcoord_0 = i_texcoord_0;
    vd_tangentWorld = normalize((u_worldMatrix * vec4(i_tangent, 0.0)).xyz);
    vd_positionWorld = (u_worldMatrix * vec4(i_position, 1.0)).xyz;
    vec3 Ng = normalize(vd_normalWorld);
    float both = textureLod(height_file, vd_texcoord_0, 0.0).x * mx_line(vd_texcoord_0);
    vec3 displacement = normalize(vd_tangentWorld) * 0.1 + Ng * both;
    gl_Position = u_viewProjectionMatrix
        * vec4(mix(displacement, Ng * (both * 0.5), clamp(D_mix, 0.0, 1.0)) + vd_positionWorld, 1.0);
}
