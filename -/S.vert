#version 450
// S · surface · mxgen 0.1 · glsl · reduced · 1 closure · 1 texture

uniform mat4 u_worldMatrix = mat4(1.0);
uniform mat4 u_worldInverseTransposeMatrix = mat4(1.0);
uniform mat4 u_viewProjectionMatrix = mat4(1.0);
in vec3 i_position;
in vec3 i_normal;
in vec2 i_texcoord_0;
out VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec2 texcoord_0;
} vd;

void main()
{
    vd.texcoord_0 = i_texcoord_0;
    vd.normalWorld = normalize((u_worldInverseTransposeMatrix * vec4(i_normal, 0.0)).xyz);
    vec4 positionWorld_product = u_worldMatrix * vec4(i_position, 1.0);
    vd.positionWorld = positionWorld_product.xyz;
    gl_Position = u_viewProjectionMatrix * positionWorld_product;
}
