#include "lib/common.glsl"

void bulb(LightData light, vec3 position, out lightshader result)
{
    vec3 away = light.position - position;
    result.direction = normalize(away);
    result.intensity = light.color / max(mx_square(length(away)), M_FLOAT_EPS) * shape(1.0);
}
