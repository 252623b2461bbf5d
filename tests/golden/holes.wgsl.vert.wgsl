// Holes · surfacematerial · mxgen 0.1 · wgsl · complete · 0 closures · 0 textures

struct PrivateUniforms {
    u_worldMatrix: mat4x4f,
    u_viewProjectionMatrix: mat4x4f,
    u_alphaThreshold: f32,
}
@group(0) @binding(0) var<uniform> u_prv: PrivateUniforms;
struct VertexData {
    @invariant @builtin(position) position: vec4f,
    @location(0) geomprop_torn: f32,
}

@vertex
fn main(
    @location(0) i_position: vec3f,
    @location(1) i_geomprop_torn: f32) -> VertexData
{
    var vd: VertexData;
    vd.geomprop_torn = i_geomprop_torn;
    vd.position = u_prv.u_viewProjectionMatrix * (u_prv.u_worldMatrix * vec4f(i_position, 1.0));
    return vd;
}
