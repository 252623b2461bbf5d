#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 1 texture

uniform vec3 u_viewPosition = vec3(0.0);
uniform sampler2D p_file;
in VertexData {
    vec3 normalWorld;
    vec2 texcoord_0;
} vd;
out vec4 out1;

const float M_PI = 3.1415926535897932;
#define mx_mod mod
vec2 mx_transform_uv(vec2 uv, vec2 scale, vec2 offset)
{
    return uv * scale + offset;
}


void picture(sampler2D tex_sampler, vec3 missing, vec2 texcoord, int uaddressmode, vec2 uv_scale, vec2 uv_offset, out vec3 result)
{
    vec2 uv = mx_transform_uv(texcoord, uv_scale, uv_offset);
    result = uaddressmode == 2 ? texture(tex_sampler, uv).rgb : missing + vd.normalWorld * u_viewPosition;
}

void main()
{
    // NG
    vec3 p;
    picture(p_file, vec3(0.0), vd.texcoord_0, 2, vec2(1.0), vec2(0.0), p);
    out1 = vec4(p * ((mx_mod(unpackHalf2x16(packHalf2x16(vd.texcoord_0)).x, M_PI))
        * (unpackHalf2x16(packHalf2x16(vd.texcoord_0)).y)), 1.0);
}
