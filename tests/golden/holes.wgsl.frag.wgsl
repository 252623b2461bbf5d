// Holes · surfacematerial · mxgen 0.1 · wgsl · complete · 0 closures · 0 textures

struct PrivateUniforms {
    u_worldMatrix: mat4x4f,
    u_viewProjectionMatrix: mat4x4f,
    u_alphaThreshold: f32,
}
@group(0) @binding(0) var<uniform> u_prv: PrivateUniforms;
struct VertexData {
    @builtin(position) position: vec4f,
    @location(0) geomprop_torn: f32,
}

@fragment
fn main(vd: VertexData)
{
    if (vd.geomprop_torn < u_prv.u_alphaThreshold) {
        discard;
    }
}
