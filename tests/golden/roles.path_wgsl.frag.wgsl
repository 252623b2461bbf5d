// Tile · surfacematerial · mxgen 0.1 · wgsl · reduced · 2 closures · 0 textures

struct PrivateUniforms {
    u_worldMatrix: mat4x4f,
    u_worldInverseTransposeMatrix: mat4x4f,
    u_viewProjectionMatrix: mat4x4f,
    u_viewPosition: vec3f,
    u_numActiveLightSources: i32,
}
@group(0) @binding(0) var<uniform> u_prv: PrivateUniforms;
struct LightData {
    @align(16) type_: i32,
    direction: vec3f,
    color: vec3f,
    intensity: f32,
    position: vec3f,
    decay_rate: f32,
    inner_angle: f32,
    outer_angle: f32,
}
@group(0) @binding(2) var<uniform> u_lightData: array<LightData, 3>;
struct VertexData {
    @builtin(position) position: vec4f,
    @location(0) positionWorld: vec3f,
    @location(1) normalWorld: vec3f,
    @location(2) tangentWorld: vec3f,
}

// Axes of the tangent space around N with x along X: `w * frame` enters it, `frame * w` leaves it.
fn mx_frame(N: vec3f, X: vec3f) -> mat3x3f
{
    var frame: mat3x3f;
    frame[0] = normalize(X - dot(X, N) * N);
    frame[1] = cross(N, frame[0]);
    frame[2] = N;
    return frame;
}

// GGX distribution of normals, at a normal that the roughness stretched to e; `area` is the product of the roughness
// along x and y (Burley 2012, appendix B.2, equation 13).
// Here area = 0.04.
fn mx_ggx_distribution(e: vec3f) -> f32
{
    return 1.0 / (0.12566371 * dot(e, e) * dot(e, e));
}

// Masking and shadowing of the directions v and l over 4 cos_v, each with the roughness in its direction (Heitz 2014,
// equations 80 and 99).
// Here alpha = vec2f(0.2).
fn mx_ggx_smith_visibility(v: vec3f, l: vec3f) -> f32
{
    return 0.5 * l.z / (v.z * length(vec3f(l.xy * 0.2, l.z)) + l.z * length(vec3f(v.xy * 0.2, v.z)));
}

// The lobe of the facets from L to V, without Fresnel's factor, with masking by direction.
// Here roughness = vec2f(0.2).
fn mx_ggx_smith_lobe(frame: mat3x3f, V: vec3f, L: vec3f) -> f32
{
    return mx_ggx_distribution(normalize(V + L) * frame / vec3f(0.2, 0.2, 1.0))
        * mx_ggx_smith_visibility(max(V * frame, vec3f(-1.0, -1.0, 1e-8)), max(L * frame, vec3f(-1.0, -1.0, 1e-8)));
}

// Unpolarised reflectance of an interface whose squared index is `re`, with c for the cosine in front of it:
//     F = ((c - g)^2 / (c + g)^2) (1 + (cg - s)^2 / (cg + s)^2) / 2
//     s = 1 - c^2,  g^2 = c^2 + 2k,  2k = re - 1
fn mx_fresnel_permittivity(cosine: f32, re: f32) -> f32
{
    let k: f32 = 0.5 * (re - 1.0);
    let c2: f32 = max(cosine * cosine, -2.0 * k);
    let s: f32 = 1.0 - c2;
    let cg2: f32 = c2 * (c2 + 2.0 * k);
    let r: f32 = k / max((1.0 + k) * (c2 + sqrt(cg2)) + k, 1e-8);
    return (cg2 + s * s) * (r * r);
}

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
fn mx_bicubic(m: mat4x4f, x: f32, y: f32) -> f32
{
    return dot(vec4f(1.0, x, x * x, x * x * x), m * vec4f(1.0, y, y * y, y * y * y));
}

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
// Here a = 0.2.
fn mx_ggx_albedo_fit(c: f32) -> vec2f
{
    let x: f32 = clamp(1.0 - c - 0.2 * mx_bicubic(mat4x4f(-0.2174, 5.3819, -3.911, 0.2674, -9.7298, 3.9904, 3.8225,
        -0.0277, 36.4897, -72.9122, 58.0878, -20.917, -31.4763, 79.0768, -73.9706, 26.5429), 0.2 / (0.2 + c), 0.2), 0.0,
        1.0);
    let u: f32 = 0.2 / (0.2 + 0.6 * c);
    return vec2f(min(1.0017 - u * u * mx_bicubic(mat4x4f(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238,
        8.7382, 4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.206, -83.1538, 52.7528), u, 0.2 * c), 1.0),
        x * x * x * x * x);
}

@fragment
fn main(vd: VertexData) -> @location(0) vec4f
{
    var out1: vec4f;
    var color: vec3f = vec3f(0.0);
    // lights
    let N: vec3f = normalize(vd.normalWorld);
    let V: vec3f = normalize(u_prv.u_viewPosition - vd.positionWorld);
    let facing: vec3f = faceForward(N, -V, N);
    let glaze_frame: mat3x3f = mx_frame(facing, normalize(vd.tangentWorld));
    let n_dot_v: f32 = dot(N, V);
    let index_ahead: f32 = select(1.5, 0.6666667, n_dot_v < 0.0);
    let r: f32 = (1.0 - index_ahead) / (index_ahead + 1.0);
    let albedo: vec2f = mx_ggx_albedo_fit(max(abs(n_dot_v), 1e-8));
    let ggx_compensation: f32 = mix(r * r, 1.0, 0.04761905) * (1.0 / albedo.x - 1.0) + 1.0;
    let clay_factor: vec3f = (1.0 - mx_fresnel_permittivity(max(1.0 - pow(albedo.y, 0.2), 1e-8),
        index_ahead * index_ahead) * albedo.x * ggx_compensation * 0.8) * 0.31830987 * vec3f(0.6, 0.3, 0.2);
    // from the last light, so that drivers do not unroll the loop
    for (var i: i32 = min(u_prv.u_numActiveLightSources, 3) - 1; i >= 0; i--) {
        var L: vec3f;
        var intensity: f32;
        let light_type_: i32 = u_lightData[i].type_;
        if (light_type_ == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            let d: vec3f = u_lightData[i].position - vd.positionWorld;
            let to_light: vec3f = normalize(d);
            L = to_light;
            let falloff: f32 = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
            if (light_type_ == 2) {
                intensity = falloff;
            } else {
                let edge: f32 = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = select(0.0, smoothstep(edge, u_lightData[i].inner_angle,
                    -dot(u_lightData[i].direction, to_light)) * falloff, light_type_ == 3);
            }
        }
        // glaze, clay
        let half_cosine: f32 = sqrt(clamp(dot(V, L) * 0.5 + 0.500001, 0.0, 1.0));
        let glaze_product: f32 = mx_fresnel_permittivity(half_cosine, index_ahead * index_ahead)
            * (ggx_compensation * 0.8);
        let glaze_response: f32 = mx_ggx_smith_lobe(glaze_frame, V, L) * glaze_product;
        color += u_lightData[i].color * (intensity * (glaze_response + max(dot(L, facing), 1e-8) * clay_factor));
    }
    out1 = vec4f(color, 1.0);
    return out1;
}
