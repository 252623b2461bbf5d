// Tile · surfacematerial · mxgen 0.1 · wgsl · reduced · 2 closures · 0 textures

struct PrivateUniforms {
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
    @location(3) viewWorld: vec3f,
    @location(4) random: vec4f,
    @location(5) lightWorld: vec4f,
}
var<private> vd: VertexData;
var<private> out1: vec4f;
var<private> out2: vec4f;
var<private> out3: vec4f;
var<private> out4: vec4f;
var<private> out5: vec4f;
var<private> out6: vec4f;
var<private> out7: vec4f;

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

// Reflectance of a dielectric that faces the viewer.
fn mx_fresnel_dielectric_facing(ior: f32) -> f32
{
    let r: f32 = (1.0 - ior) / (1.0 + ior);
    return r * r;
}

// Factor that gives back the light of multiple scattering (Turquin 2019, equations 14 and 16).
// Here model = "dielectric", k = vec3f(0.0), f90 = vec3f(1.0), film = 0.0, film_ior = 1.5.
fn mx_ggx_compensation(albedo: vec2f, n: vec3f) -> vec3f
{
    return 1.0 + mix(vec3f(mx_fresnel_dielectric_facing(n.x)), vec3f(1.0), 0.04761905) * (1.0 / albedo.x - 1.0);
}

// A normal of those visible from v, at any length (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical
// Caps"): v is stretched by the roughness and has the length `reach`, `around` is (cos, sin) of the turn around z, and
// `depth` how far the normal lies below the top of the cap, v.z + reach at most.
fn mx_ggx_cap(around: vec2f, depth: f32, v: vec3f, reach: f32) -> vec3f
{
    return v + vec3f(sqrt(depth * (2.0 * reach - depth)) * around, reach - depth);
}

// A unit normal of those visible from v, from two random numbers xi.
// Here alpha = vec2f(0.2).
fn mx_ggx_visible(v: vec3f, xi: vec2f) -> vec3f
{
    let stretch: vec3f = vec3f(0.2, 0.2, 1.0);
    let reach: f32 = length(vec3f(v.xy * 0.2, v.z));
    return normalize(mx_ggx_cap(cos(6.2831855 * (xi.x - vec2f(0.0, 0.25))), xi.y * (v.z + reach), v * stretch, reach)
        * stretch);
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

// A direction L that the lobe reflects or refracts light from, by three random numbers xi, with the value over the
// density (`weight`) and the density (`pdf`).
// Here roughness = vec2f(0.2), by_direction = false, mode = 1, model = "dielectric", k = vec3f(0.0), f90 = vec3f(1.0),
// exponent = 0.0, film = 0.0, film_ior = 1.5.
fn mx_ggx_scatter(N: vec3f, X: vec3f, V: vec3f, xi: vec3f, n: vec3f, L: ptr<function, vec3f>, weight: ptr<function,
    vec3f>, pdf: ptr<function, f32>)
{
    let frame: mat3x3f = mx_frame(faceForward(N, -V, N), X);
    let v: vec3f = max(V * frame, vec3f(-1.0, -1.0, 1e-8));
    let h: vec3f = mx_ggx_visible(v, xi.xy);
    let l: vec3f = reflect(-v, h);
    let density: f32 = 2.0 / (v.z + length(vec3f(v.xy * 0.2, v.z)));
    (*L) = frame * l;
    (*weight) = vec3f(0.0);
    (*pdf) = 0.0;
    if (l.z <= 0.0) {
        return;
    }
    (*weight) = vec3f(mx_fresnel_permittivity(clamp(dot(v, h), 1e-8, 1.0), n.x * n.x))
        * (mx_ggx_smith_visibility(v, l) * 4.0 / density) * mx_ggx_compensation(mx_ggx_albedo_fit(v.z), n);
    (*pdf) = 0.25;
    (*pdf) *= density * mx_ggx_distribution(h / vec3f(0.2, 0.2, 1.0));
}

// The lobe of the facets from L to V, without Fresnel's factor, with masking by direction.
// Here roughness = vec2f(0.2).
fn mx_ggx_smith_lobe(frame: mat3x3f, V: vec3f, L: vec3f) -> f32
{
    return mx_ggx_distribution(normalize(V + L) * frame / vec3f(0.2, 0.2, 1.0))
        * mx_ggx_smith_visibility(max(V * frame, vec3f(-1.0, -1.0, 1e-8)), max(L * frame, vec3f(-1.0, -1.0, 1e-8)));
}

// Density of the directions L that mx_ggx_scatter takes.
// Here roughness = vec2f(0.2), mode = 1, model = "dielectric", k = vec3f(0.0), f90 = vec3f(1.0), exponent = 0.0,
// film = 0.0, film_ior = 1.5.
fn mx_ggx_pdf(N: vec3f, X: vec3f, V: vec3f, L: vec3f) -> f32
{
    let frame: mat3x3f = mx_frame(faceForward(N, -V, N), X);
    let v: vec3f = max(V * frame, vec3f(-1.0, -1.0, 1e-8));
    let l: vec3f = L * frame;
    if (l.z <= 0.0) {
        return 0.0;
    }
    let h: vec3f = normalize(v + l);
    if (dot(v, h) <= 0.0) {
        return 0.0;
    }
    return 2.0 / (v.z + length(vec3f(v.xy * 0.2, v.z))) * mx_ggx_distribution(h / vec3f(0.2, 0.2, 1.0)) * 0.25;
}

fn scatter()
{
    let N: vec3f = normalize(vd.normalWorld);
    let n_dot_lobe_view: f32 = dot(N, vd.viewWorld);
    let albedo: vec2f = mx_ggx_albedo_fit(max(abs(n_dot_lobe_view), 1e-8));
    let eta: f32 = select(1.5, 0.6666667, n_dot_lobe_view < 0.0);
    let scaled_eta: f32 = eta * eta;
    let r: f32 = (1.0 - eta) / (eta + 1.0);
    let ggx_compensation: f32 = mix(r * r, 1.0, 0.04761905) * (1.0 / albedo.x - 1.0) + 1.0;
    let dielectric_bsdf_albedo: f32 = mx_fresnel_permittivity(max(1.0 - pow(albedo.y, 0.2), 1e-8), scaled_eta)
        * albedo.x * ggx_compensation;
    let glaze_share: f32 = max((dielectric_bsdf_albedo * 0.9 + 0.1) * 0.8, 0.0);
    let glaze_throughput: f32 = 1.0 - dielectric_bsdf_albedo * 0.8;
    let clay_share: f32 = max(dot(glaze_throughput * vec3f(0.64, 0.37, 0.28), vec3f(0.33333334)), 0.0);
    let shares: f32 = glaze_share + clay_share;
    var pick: f32 = shares * vd.random.w;
    var L: vec3f = vec3f(0.0);
    var inside: f32 = 0.0;
    var weight: vec3f = vec3f(0.0);
    var density: f32 = 0.0;
    var medium: vec3f = vec3f(1.0);
    let X: vec3f = normalize(vd.tangentWorld);
    if (pick >= 0.0 && pick < glaze_share) {
        var glaze_L: vec3f;
        var glaze_weight: vec3f;
        var glaze_pdf: f32;
        mx_ggx_scatter(N, X, vd.viewWorld, vd.random.xyz, vec3f(eta), &glaze_L, &glaze_weight, &glaze_pdf);
        L = glaze_L;
        weight = glaze_weight * (shares / glaze_share * 0.8);
        let is_in_front: bool = n_dot_lobe_view * dot(N, glaze_L) > 0.0;
        inside = select(1.0, 0.0, is_in_front);
        density = select(0.0, glaze_pdf * (glaze_share / shares), is_in_front);
    }
    pick -= glaze_share;
    let facing: vec3f = faceForward(N, -vd.viewWorld, N);
    let clay_constant: vec3f = vec3f(0.6, 0.3, 0.2);
    if (pick >= 0.0 && pick < clay_share) {
        let any_frame: mat3x3f = mx_frame(facing,
            select(vec3f(0.0, 1.0, 0.0), vec3f(1.0, 0.0, 0.0), abs(facing.x) < 0.7));
        let polar: vec2f = sqrt(vd.random.x) * cos((vd.random.y - vec2f(0.0, 0.25)) * 6.2831855);
        let clay_L: vec3f = any_frame * vec3f(polar, sqrt(1.0 - vd.random.x));
        L = clay_L;
        let facing_dot_clay_l: f32 = dot(facing, clay_L);
        let pdf: f32 = max(facing_dot_clay_l, 0.0) / 3.1415927;
        let clay_weight: vec3f = max(facing_dot_clay_l, 1e-8) * 0.31830987 * clay_constant / max(pdf, 1e-8);
        weight = clay_weight * (glaze_throughput * (shares / clay_share));
        density = pdf * (clay_share / shares);
    }
    out1 = vec4f(0.0, 0.0, 0.0, 1.0);
    out2 = vec4f(L, inside);
    out3 = vec4f(weight, density);
    out4 = vec4f(medium, 0.0);
    let glaze_product: f32 = ggx_compensation
        * mx_fresnel_permittivity(sqrt(clamp(dot(vd.viewWorld, vd.lightWorld.xyz) * 0.5 + 0.500001, 0.0, 1.0)),
        scaled_eta);
    let frame: mat3x3f = mx_frame(facing, X);
    let glaze_both: f32 = vd.lightWorld.w * (glaze_share / shares * mx_ggx_pdf(N, X, vd.viewWorld, vd.lightWorld.xyz))
        + 1.0;
    let balanced: vec3f = vec3f(glaze_product * mx_ggx_smith_lobe(frame, vd.viewWorld, vd.lightWorld.xyz) * 0.8
        / glaze_both);
    let glaze_response: vec3f = select(vec3f(0.0), balanced, n_dot_lobe_view * dot(N, vd.lightWorld.xyz) > 0.0);
    let facing_dot_l: f32 = dot(facing, vd.lightWorld.xyz);
    let clay_both: f32 = vd.lightWorld.w * (clay_share / shares * (max(facing_dot_l, 0.0) / 3.1415927)) + 1.0;
    out5 = vec4f(glaze_response + glaze_throughput * (max(facing_dot_l, 1e-8) * 0.31830987) * clay_constant / clay_both,
        0.0);
    var chance: f32 = fract(vd.random.w * 4096.0);
    var brightness_sum: f32 = 0.0;
    var light: vec3f = vec3f(0.0);
    var light_L: vec3f = vec3f(0.0);
    var light_distance: f32 = 0.0;
    // from the last light, so that drivers do not unroll the loop
    for (var i: i32 = min(u_prv.u_numActiveLightSources, 3) - 1; i >= 0; i--) {
        var L_2: vec3f;
        var intensity: f32;
        var away: f32;
        let light_type_: i32 = u_lightData[i].type_;
        if (light_type_ == 1) {
            L_2 = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
            away = 1e30;
        } else {
            let d: vec3f = u_lightData[i].position - vd.positionWorld;
            let to_light: vec3f = normalize(d);
            L_2 = to_light;
            let magnitude_d: f32 = length(d);
            let falloff: f32 = u_lightData[i].intensity / pow(magnitude_d + 1.0, u_lightData[i].decay_rate);
            if (light_type_ == 2) {
                intensity = falloff;
                away = magnitude_d;
            } else {
                let edge: f32 = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = select(0.0, smoothstep(edge, u_lightData[i].inner_angle,
                    -dot(u_lightData[i].direction, to_light)) * falloff, light_type_ == 3);
                away = magnitude_d;
            }
        }
        let glaze_product_2: f32 = ggx_compensation
            * mx_fresnel_permittivity(sqrt(clamp(dot(vd.viewWorld, L_2) * 0.5 + 0.500001, 0.0, 1.0)), scaled_eta);
        let glaze_vector: vec3f = vec3f(glaze_product_2 * mx_ggx_smith_lobe(frame, vd.viewWorld, L_2) * 0.8);
        let clay_product: vec3f = glaze_throughput * (max(dot(facing, L_2), 1e-8) * 0.31830987) * clay_constant;
        let response: vec3f = select(vec3f(0.0), glaze_vector, n_dot_lobe_view * dot(N, L_2) > 0.0) + clay_product;
        let lit: vec3f = u_lightData[i].color * intensity * response;
        let brightness: f32 = max(dot(lit, vec3f(0.33333334)), 0.0);
        brightness_sum += brightness;
        if (brightness_sum * chance < brightness) {
            light_L = L_2;
            light_distance = away;
            light = lit / brightness;
        }
        if (brightness > 0.0) {
            let ratio: f32 = (brightness_sum * chance - brightness) / (brightness_sum - brightness);
            chance = select(ratio, brightness_sum * chance / brightness, brightness_sum * chance < brightness);
        }
    }
    out6 = vec4f(light_L, light_distance);
    out7 = vec4f(brightness_sum * light, 0.0);
}
