#version 450
// Flat · surfacematerial · mxgen 0.1 · glsl · reduced · 0 closures · 0 textures

uniform mat4 u_worldMatrix = mat4(1.0);
uniform mat4 u_worldInverseTransposeMatrix = mat4(1.0);
uniform mat4 u_viewProjectionMatrix = mat4(1.0);
in vec3 i_position;
in vec3 i_normal;
in vec3 i_tangent;

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
    vec3 normalWorld = normalize((u_worldInverseTransposeMatrix * vec4(i_normal, 0.0)).xyz);
    displacementshader lift1;
    lift(0.5, lift1);
    vec3 offset = lift1.offset * lift1.scale;
    vec3 tangentWorld = normalize((u_worldMatrix * vec4(i_tangent, 0.0)).xyz);
    vec3 displacement = normalWorld * offset.z
        + (tangentWorld * offset.x + offset.y * cross(normalWorld, tangentWorld));
    gl_Position = u_viewProjectionMatrix * vec4((u_worldMatrix * vec4(i_position, 1.0)).xyz + displacement, 1.0);
}
