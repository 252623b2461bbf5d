#include "lib/$fileTransformUv"

void picture($texSamplerSignature, vec3 missing, vec2 texcoord, int uaddressmode, vec2 uv_scale, vec2 uv_offset, out vec3 result)
{
    vec2 uv = mx_transform_uv(texcoord, uv_scale, uv_offset);
    result = uaddressmode == 2 ? texture($texSamplerSampler2D, uv).rgb : missing + $vd.$normalWorld * $viewPosition;
}
