// Holes · surfacematerial · mxgen 0.1 · msl · complete · 0 closures · 0 textures
// Metal Shading Language 2.3
#include <metal_stdlib>
using namespace metal;

struct PrivateUniforms {
    float4x4 u_worldMatrix;
    float4x4 u_viewProjectionMatrix;
    float u_alphaThreshold;
};
struct VertexData {
    float4 pos [[position]];
    float geomprop_torn [[user(geomprop_torn)]];
};

struct GlobalContext {
    constant PrivateUniforms& u_prv;
    VertexData vd;

void FragmentMain()
{
    if (vd.geomprop_torn < u_prv.u_alphaThreshold)
        discard_fragment();
}
};

fragment void FragmentMain(
    VertexData vd [[stage_in]],
    constant PrivateUniforms& u_prv [[buffer(0)]])
{
    GlobalContext context = {u_prv, vd};
    context.FragmentMain();
}
