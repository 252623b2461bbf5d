// M · surfacematerial · mxgen 0.1 · hlsl · reduced · 1 closure · 0 textures

cbuffer PrivateUniforms : register(b0)
{
    float3 u_viewPosition : packoffset(c0);
};
#ifndef MXG_LIGHTS
#define MXG_LIGHTS
int mxg_light_count();
void mxg_light(int i, float3 P, out float3 L, out float3 radiance);
#endif
struct Surface {
    float3 color;
    float alpha;
};

Surface surface(float3 positionWorld, float3 normalWorld)
{
    Surface result;
    float3 color = float3(0.0, 0.0, 0.0);
    // lights
    float3 N = normalize(normalWorld);
    float3 facing = faceforward(N, -normalize(u_viewPosition - positionWorld), N);
    // from the last light, so that drivers do not unroll the loop
    for (int i = mxg_light_count() - 1; i >= 0; --i) {
        // bsdf
        float3 light_L, light_radiance;
        mxg_light(i, positionWorld, light_L, light_radiance);
        color += light_radiance * (max(dot(light_L, facing), 1e-8) * 0.31830987 * 0.8);
    }
    result.color = color;
    result.alpha = 1.0;
    return result;
}
