// Holes · surfacematerial · mxgen 0.1 · msl · complete · 0 closures · 0 textures
// Metal Shading Language 2.3
#include <metal_stdlib>
using namespace metal;

struct PrivateUniforms {
    float4x4 u_worldMatrix;
    float4x4 u_viewProjectionMatrix;
    float u_alphaThreshold;
};
struct VertexInputs {
    float3 i_position [[attribute(0)]];
    float i_geomprop_torn [[attribute(1)]];
};
struct VertexData {
    float4 pos [[position, invariant]];
    float geomprop_torn [[user(geomprop_torn)]];
};

struct GlobalContext {
    constant PrivateUniforms& u_prv;
    VertexInputs vi;
    VertexData vd;

void VertexMain()
{
    vd.geomprop_torn = vi.i_geomprop_torn;
    vd.pos = u_prv.u_viewProjectionMatrix * (u_prv.u_worldMatrix * float4(vi.i_position, 1.0));
}
};

vertex VertexData VertexMain(
    VertexInputs vi [[stage_in]],
    constant PrivateUniforms& u_prv [[buffer(2)]])
{
    GlobalContext context = {u_prv, vi, {}};
    context.VertexMain();
    return context.vd;
}
