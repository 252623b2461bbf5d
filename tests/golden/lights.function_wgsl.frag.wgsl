// M · surfacematerial · mxgen 0.1 · wgsl · reduced · 1 closure · 0 textures

struct PrivateUniforms {
    u_viewPosition: vec3f,
}
@group(0) @binding(0) var<uniform> u_prv: PrivateUniforms;
struct Surface {
    color: vec3f,
    alpha: f32,
}

fn surface(positionWorld: vec3f, normalWorld: vec3f) -> Surface
{
    var result: Surface;
    var color: vec3f = vec3f(0.0);
    // lights
    let N: vec3f = normalize(normalWorld);
    let facing: vec3f = faceForward(N, -normalize(u_prv.u_viewPosition - positionWorld), N);
    // from the last light, so that drivers do not unroll the loop
    for (var i: i32 = mxg_light_count() - 1; i >= 0; i--) {
        // bsdf
        var light_L: vec3f;
        var light_radiance: vec3f;
        mxg_light(i, positionWorld, &light_L, &light_radiance);
        color += light_radiance * (max(dot(light_L, facing), 1e-8) * 0.31830987 * 0.8);
    }
    result.color = color;
    result.alpha = 1.0;
    return result;
}
