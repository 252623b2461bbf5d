// gltf_pbr · surfacematerial · mxgen 0.1 · wgsl · complete · 9 closures · 0 textures

struct mx_GgxLobe {
    N: vec3f,
    cosine: f32,
    x: vec3f,
    alpha: vec2f,
    masking: f32,
}
struct mx_GgxSamples {
    to_map: mat3x3f,
    stretch: vec3f,
    area: f32,
    v: vec3f,
    masking: f32,
    reach: f32,
    step: f32,
    texels: f32,
    weight: f32,
}
struct mx_GgxFacet {
    h: vec3f,
    cosine: f32,
    mirror: f32,
    texels: f32,
}
struct mx_GgxLight {
    color: vec3f,
    weight: f32,
    cosine: f32,
}
struct PublicUniforms {
    SR_gltf_pbr_base_color: vec3f,
    SR_gltf_pbr_metallic: f32,
    SR_gltf_pbr_roughness: f32,
    SR_gltf_pbr_transmission: f32,
    SR_gltf_pbr_specular: f32,
    SR_gltf_pbr_specular_color: vec3f,
    SR_gltf_pbr_ior: f32,
    SR_gltf_pbr_alpha: f32,
    SR_gltf_pbr_alpha_mode: i32,
    SR_gltf_pbr_alpha_cutoff: f32,
    SR_gltf_pbr_iridescence: f32,
    SR_gltf_pbr_iridescence_ior: f32,
    SR_gltf_pbr_iridescence_thickness: f32,
    SR_gltf_pbr_sheen_color: vec3f,
    SR_gltf_pbr_sheen_roughness: f32,
    SR_gltf_pbr_clearcoat: f32,
    SR_gltf_pbr_clearcoat_roughness: f32,
    SR_gltf_pbr_emissive: vec3f,
    SR_gltf_pbr_emissive_strength: f32,
    SR_gltf_pbr_anisotropy_strength: f32,
    SR_gltf_pbr_anisotropy_rotation: f32,
}
@group(0) @binding(1) var<uniform> u_pub: PublicUniforms;
struct PrivateUniforms {
    u_worldMatrix: mat4x4f,
    u_worldInverseTransposeMatrix: mat4x4f,
    u_viewProjectionMatrix: mat4x4f,
    u_viewPosition: vec3f,
    u_numActiveLightSources: i32,
    u_envMatrix: mat4x4f,
    u_envRadianceMips: i32,
    u_envRadianceSamples: i32,
    u_envLightIntensity: f32,
    u_alphaThreshold: f32,
    u_refractionTwoSided: u32,
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
@group(0) @binding(3) var u_envRadiance: texture_2d<f32>;
@group(0) @binding(4) var u_envRadiance_sampler: sampler;
@group(0) @binding(5) var u_envIrradiance: texture_2d<f32>;
@group(0) @binding(6) var u_envIrradiance_sampler: sampler;
struct VertexData {
    @builtin(position) position: vec4f,
    @location(0) positionWorld: vec3f,
    @location(1) normalWorld: vec3f,
    @location(2) tangentWorld: vec3f,
}

fn wgsl_mat3x3f_of_mat4x4f(m: mat4x4f) -> mat3x3f
{
    return mat3x3f(m[0].xyz, m[1].xyz, m[2].xyz);
}

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
fn mx_bicubic(m: mat4x4f, x: f32, y: f32) -> f32
{
    return dot(vec4f(1.0, x, x * x, x * x * x), m * vec4f(1.0, y, y * y, y * y * y));
}

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
fn mx_ggx_albedo_fit(a: f32, c: f32) -> vec2f
{
    let x: f32 = clamp(1.0 - c - a * mx_bicubic(mat4x4f(-0.2174, 5.3819, -3.911, 0.2674, -9.7298, 3.9904, 3.8225,
        -0.0277, 36.4897, -72.9122, 58.0878, -20.917, -31.4763, 79.0768, -73.9706, 26.5429), a / (a + c), a), 0.0, 1.0);
    let u: f32 = a / (a + 0.6 * c);
    return vec2f(min(1.0017 - u * u * mx_bicubic(mat4x4f(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238,
        8.7382, 4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.206, -83.1538, 52.7528), u, a * c), 1.0),
        x * x * x * x * x);
}

// Light of one polarisation that interferes in a film, as Gaussian i of the CIE curves sees it: `a` is the amplitude of
// the film's interface, r that of the interface below, and light in the film goes further by d / (2 pi) micrometres.
fn mx_film_light(a: f32, r: vec2f, d: f32, i: i32) -> f32
{
    let gaussian: vec4f = mat4x4f(1.681, 0.846202, -0.0043278, 0.0, 2.2399, 0.153798, -0.0045282, 0.0, 1.7953, 1.0,
        -0.0093046, 0.0, 2.2084, 1.0, -0.0066121, 0.0)[i];
    let decay: f32 = exp(gaussian.z * d * d);
    let d2: f32 = decay * decay;
    let d4: f32 = d2 * d2;
    let r23: f32 = dot(r, r);
    let path: f32 = -a * decay * (r.x * cos(gaussian.x * d) - r.y * sin(gaussian.x * d));
    let square: f32 = a * a * r23 * d2;
    let rest: f32 = (2.0 * path * path - square - d4 * square * path) / (1.0 - 2.0 * d4 * path + d4 * d4 * square);
    let t: f32 = 1.0 - a * a;
    let even: f32 = t * t * r23 / (1.0 - a * a * r23);
    return gaussian.y * (a * a + even + 2.0 * (even - t) * (path + d2 * rest));
}

// Amplitudes of an interface of reflectance f below a film of index `ior`: negative where f0 says that the index behind
// the film is lower.
fn mx_film_turned(f0: vec3f, f: vec3f, ior: f32) -> vec3f
{
    return (1.0 - 2.0 * step(sqrt(clamp(f0, vec3f(0.01), vec3f(0.99))), vec3f((ior - 1.0) / (ior + 1.0))))
        * sqrt(max(0.5 * f, vec3f(0.0)));
}

// Reflectance, facing the viewer, of a film on an interface of colour f0.
fn mx_film_schlick_facing(f0: vec3f, film: f32, film_ior: f32) -> vec3f
{
    let ior: f32 = max(film_ior, 1.0);
    let a: f32 = (1.0 - ior) / (1.0 + ior);
    let d: f32 = 0.012566372 * ior * film;
    let r: vec3f = mx_film_turned(f0, f0, ior);
    var xyz: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < 4; i++) {
        let channel: i32 = max(i - 1, 0);
        xyz[channel] += mx_film_light(a, vec2f(-r[channel], 0.0), d, i);
    }
    return clamp(mat3x3f(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * xyz, vec3f(0.0), vec3f(1.0));
}

// Reflectance, facing the viewer, of an interface.
// Here model = "schlick", k = vec3f(0.0).
fn mx_fresnel_facing(n: vec3f, film: f32, film_ior: f32) -> vec3f
{
    if (film > 0.0) {
        return mx_film_schlick_facing(n, film, film_ior);
    }
    return n;
}

// The square of the length of the facet's normal H after the roughness divided its parts along the surface, times the
// product of the roughness along x and y; cos_h is its part along N.
// Here is_round = true, is_wide = false.
fn mx_ggx_stretched(lobe: mx_GgxLobe, H: vec3f, cos_h: f32) -> f32
{
    let slope: vec3f = H - cos_h * lobe.N;
    return dot(slope, slope) + lobe.alpha.x * lobe.alpha.y * (cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = true, is_wide = false.
fn mx_ggx_light(lobe: mx_GgxLobe, V: vec3f, L: vec3f) -> f32
{
    let area: f32 = lobe.alpha.x * lobe.alpha.y;
    let cos_l: f32 = max(dot(lobe.N, L), 1e-8);
    let square: f32 = 2.0 + 2.0 * dot(V, L);
    let e: f32 = mx_ggx_stretched(lobe, V + L, lobe.cosine + dot(lobe.N, L));
    return area / 6.2831855 * square * square * cos_l
        / (e * e * (lobe.cosine * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * lobe.masking));
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

// Schlick's curve from f0 to f90 at a cosine, less `bend` times cos (1 - cos)^6.
// Here bend = vec3f(0.0), exponent = 5.0.
fn mx_fresnel_schlick(cosine: f32, f0: vec3f, f90: vec3f) -> vec3f
{
    let x: f32 = 1.0 - cosine;
    return mix(f0, f90, x * x * x * x * x);
}

// Amplitudes of a film's own interface, of perpendicular and parallel light; `inside` is the cosine in the film.
fn mx_film_amplitudes(cosine: f32, inside: f32, ior: f32) -> vec2f
{
    let x: vec2f = vec2f(cosine, ior * cosine);
    let u: vec2f = vec2f(ior * inside, inside);
    return (x - u) / (x + u);
}

// Reflectance of a film on an interface with Schlick's curve.
// Here bend = vec3f(0.0), exponent = 5.0.
fn mx_film_schlick(cosine: f32, f0: vec3f, f90: vec3f, film: f32, film_ior: f32) -> vec3f
{
    let ior: f32 = max(film_ior, 1.0);
    let c: f32 = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    let a: vec2f = mx_film_amplitudes(cosine, c, ior);
    let d: f32 = 0.012566372 * ior * c * film;
    let r: vec3f = mx_film_turned(f0, mx_fresnel_schlick(c, f0, f90), ior);
    var xyz: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < 4; i++) {
        let channel: i32 = max(i - 1, 0);
        var below: f32 = r[channel];
        for (var p: i32 = 0; p < 2; p++) {
            below = -below;
            xyz[channel] += mx_film_light(a[p], vec2f(below, 0.0), d, i);
        }
    }
    return clamp(mat3x3f(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * (0.5 * xyz), vec3f(0.0), vec3f(1.0));
}

// Reflectance of an interface at a cosine.
// Here model = "schlick", k = vec3f(0.0), exponent = 5.0.
fn mx_fresnel(cosine: f32, n: vec3f, f90: vec3f, film: f32, film_ior: f32) -> vec3f
{
    if (film > 0.0) {
        return mx_film_schlick(cosine, n, f90, film, film_ior);
    }
    return mx_fresnel_schlick(cosine, n, f90);
}

// The vector v turned clockwise around an axis of unit length, by an angle in radians (Rodrigues' formula).
fn mx_rotate3d(v: vec3f, angle: f32, axis: vec3f) -> vec3f
{
    let c: f32 = cos(angle);
    return v * c + cross(v, axis) * sin(angle) + axis * (dot(axis, v) * (1.0 - c));
}

// cos (1 + 2 Lambda) of a direction for GGX; `area` is the product of the roughness along x and y (Heitz 2014,
// "Understanding the Masking-Shadowing Function", equation 72).
fn mx_ggx_masking(cosine: f32, area: f32) -> f32
{
    return sqrt(area + (1.0 - area) * (cosine * cosine));
}

// The GGX lobe of a surface as lights see it; roughness is that along X and across, squared.
// Here is_round = false.
fn mx_ggx_lobe(roughness: vec2f, N: vec3f, X: vec3f, V: vec3f) -> mx_GgxLobe
{
    let alpha: vec2f = clamp(roughness, vec2f(1e-8), vec2f(1.0));
    let cosine: f32 = max(abs(dot(N, V)), 1e-8);
    return mx_GgxLobe(faceForward(N, -V, N), cosine, normalize(X - dot(X, N) * N), alpha,
        mx_ggx_masking(cosine, alpha.x * alpha.y));
}

// The square of the length of the facet's normal H after the roughness divided its parts along the surface, times the
// product of the roughness along x and y; cos_h is its part along N.
// Here is_round = false, is_wide = false.
fn mx_ggx_stretched_2(lobe: mx_GgxLobe, H: vec3f, cos_h: f32) -> f32
{
    let parts: vec2f = vec2f(dot(H, lobe.x), dot(cross(H, lobe.N), lobe.x)) / lobe.alpha;
    return lobe.alpha.x * lobe.alpha.y * (dot(parts, parts) + cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = false, is_wide = false.
fn mx_ggx_light_2(lobe: mx_GgxLobe, V: vec3f, L: vec3f) -> f32
{
    let area: f32 = lobe.alpha.x * lobe.alpha.y;
    let cos_l: f32 = max(dot(lobe.N, L), 1e-8);
    let square: f32 = 2.0 + 2.0 * dot(V, L);
    let e: f32 = mx_ggx_stretched_2(lobe, V + L, lobe.cosine + dot(lobe.N, L));
    return area / 6.2831855 * square * square * cos_l
        / (e * e * (lobe.cosine * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * lobe.masking));
}

// The angle, over pi, with this sine and cosine; the cosine is not negative. It errs by 2.9e-5 at most.
fn mx_half_turn(sine: f32, cosine: f32) -> f32
{
    return sine * (0.4999709 + cosine * (cosine * (0.2302802 + cosine * (0.0398298 * cosine - 0.1351235)) - 0.3164252));
}

// The square of the distance of the unit direction d from the vertical axis, never 0.
fn mx_map_square(d: vec3f) -> f32
{
    return d.x * d.x + (d.z * d.z + 1e-16);
}

// The point of the latitude-longitude picture for the unit direction d, to a tenth of a texel in 4096.
fn mx_map_point(d: vec3f) -> vec2f
{
    let square: f32 = mx_map_square(d);
    let stretch: f32 = inverseSqrt(square);
    return vec2f(fract(select(0.5, -0.5, d.z > 0.0) * (mx_half_turn(d.x * stretch, abs(d.z) * stretch) + 0.5) + 0.25),
        0.5 - mx_half_turn(d.y, square * stretch));
}

// The number of samples, from 1, that a lobe takes; roughness is that along two directions, squared.
fn mx_sample_count(roughness: vec2f) -> i32
{
    let wide: f32 = max(roughness.x, roughness.y);
    var share: f32 = 0.5 * min(4.0 * sqrt(wide), 1.0);
    share = min(share * wide / min(roughness.x, roughness.y), 1.0);
    return max(i32(ceil(share * f32(u_prv.u_envRadianceSamples))), 1);
}

// The GGX lobe of a surface as lights see it; roughness is that along X and across, squared.
// Here is_round = true.
fn mx_ggx_lobe_2(roughness: vec2f, N: vec3f, V: vec3f) -> mx_GgxLobe
{
    let alpha: vec2f = clamp(roughness, vec2f(1e-8), vec2f(1.0));
    let cosine: f32 = max(abs(dot(N, V)), 1e-8);
    return mx_GgxLobe(faceForward(N, -V, N), cosine, vec3f(0.0), alpha, mx_ggx_masking(cosine, alpha.x * alpha.y));
}

// The GGX lobe of a surface as samples of the environment see it.
// Here is_round = true.
fn mx_ggx_samples(roughness: vec2f, count: i32, N: vec3f, V: vec3f) -> mx_GgxSamples
{
    let lobe: mx_GgxLobe = mx_ggx_lobe_2(roughness, N, V);
    let x: vec3f = normalize(V - lobe.cosine * lobe.N + 1e-6 * lobe.N.yzx);
    let v: vec3f = vec3f(sqrt(max(1.0 - lobe.cosine * lobe.cosine, 0.0)), 0.0, lobe.cosine);
    let stretch: vec3f = vec3f(lobe.alpha, 1.0);
    let reach: f32 = lobe.masking;
    let area: f32 = stretch.x * stretch.y;
    let share: f32 = 1.0 / f32(count);
    return mx_GgxSamples(wgsl_mat3x3f_of_mat4x4f(u_prv.u_envMatrix) * mat3x3f(x, cross(lobe.N, x), lobe.N), stretch,
        area, v, lobe.masking, reach, share * (v.z + reach),
        area * (v.z + lobe.masking) * max(2.0 / f32(count), 4.4 / f32(max(u_prv.u_envRadianceSamples, 1)))
        * exp2(2.0 * f32(u_prv.u_envRadianceMips) - 4.6485),
        u_prv.u_envLightIntensity * (share * (v.z + lobe.masking)));
}

// Light of the environment from the unit direction d of its picture, filtered over as many texels.
fn mx_filtered_light(d: vec3f, texels: f32) -> vec3f
{
    return textureSampleLevel(u_envRadiance, u_envRadiance_sampler, mx_map_point(d),
        0.5 * log2(texels * inverseSqrt(mx_map_square(d)))).xyz;
}

// Height-correlated masking and shadowing G2 over 2 cos_v cos_l (Heitz 2014, equation 99); `masking` is that of the
// viewer.
fn mx_ggx_visibility(cos_v: f32, masking: f32, area: f32, cos_l: f32) -> f32
{
    return 1.0 / (cos_v * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * masking);
}

// A normal of those visible from v, at any length (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical
// Caps"): v is stretched by the roughness and has the length `reach`, `around` is (cos, sin) of the turn around z, and
// `depth` how far the normal lies below the top of the cap, v.z + reach at most.
fn mx_ggx_cap(around: vec2f, depth: f32, v: vec3f, reach: f32) -> vec3f
{
    return v + vec3f(sqrt(depth * (2.0 * reach - depth)) * around, reach - depth);
}

// The facet of sample i. Samples are spherical Fibonacci points (Marques et al. 2013): each is the golden angle further
// around than the one before, by its `turn`.
fn mx_ggx_facet(s: mx_GgxSamples, i: i32, turn: vec2f) -> mx_GgxFacet
{
    let h: vec3f = mx_ggx_cap(turn, (f32(i) + 0.5) * s.step, s.v * s.stretch, s.reach) * s.stretch;
    let cosine: f32 = dot(s.v, h);
    let mirror: f32 = 2.0 * cosine / dot(h, h);
    return mx_GgxFacet(h, cosine, mirror, mirror * mirror * s.texels);
}

// The light that the facet of sample i reflects.
fn mx_ggx_reflected(s: mx_GgxSamples, i: i32, turn: vec2f) -> mx_GgxLight
{
    let facet: mx_GgxFacet = mx_ggx_facet(s, i, turn);
    let l: vec3f = facet.mirror * facet.h - s.v;
    let cos_l: f32 = max(l.z, 1e-8);
    return mx_GgxLight(mx_filtered_light(s.to_map * l, facet.texels),
        s.weight * cos_l * mx_ggx_visibility(s.v.z, s.masking, s.area, cos_l),
        sqrt(clamp(0.5 * (facet.mirror * facet.cosine), 1e-8, 1.0)));
}

// The GGX lobe of a surface as samples of the environment see it.
// Here is_round = false.
fn mx_ggx_samples_2(roughness: vec2f, count: i32, N: vec3f, X: vec3f, V: vec3f) -> mx_GgxSamples
{
    let lobe: mx_GgxLobe = mx_ggx_lobe(roughness, N, X, V);
    let x: vec3f = lobe.x;
    let frame: mat3x3f = mat3x3f(x, cross(lobe.N, x), lobe.N);
    let v: vec3f = vec3f((V * frame).xy, lobe.cosine);
    let stretch: vec3f = vec3f(lobe.alpha, 1.0);
    let reach: f32 = length(v * stretch);
    let area: f32 = stretch.x * stretch.y;
    let share: f32 = 1.0 / f32(count);
    return mx_GgxSamples(wgsl_mat3x3f_of_mat4x4f(u_prv.u_envMatrix) * frame, stretch, area, v, lobe.masking, reach,
        share * (v.z + reach), area * (v.z + lobe.masking)
        * max(2.0 / f32(count), 4.4 / f32(max(u_prv.u_envRadianceSamples, 1)))
        * exp2(2.0 * f32(u_prv.u_envRadianceMips) - 4.6485),
        u_prv.u_envLightIntensity * (share * (v.z + lobe.masking)));
}

// The light that comes to the facet of sample i through a solid sphere of index `ior` behind it.
fn mx_ggx_transmitted(s: mx_GgxSamples, ior: f32, i: i32, turn: vec2f) -> mx_GgxLight
{
    let facet: mx_GgxFacet = mx_ggx_facet(s, i, turn);
    let h: vec3f = normalize(facet.h);
    return mx_GgxLight(mx_filtered_light(s.to_map * reflect(s.v, refract(-s.v, h, 1.0 / ior)), facet.texels),
        s.weight * 0.5 / s.v.z, clamp(dot(s.v, h), 1e-8, 1.0));
}

@fragment
fn main(vd: VertexData) -> @location(0) vec4f
{
    var out1: vec4f;
    var color: vec3f = u_pub.SR_gltf_pbr_emissive * u_pub.SR_gltf_pbr_emissive_strength;
    // lights
    let N: vec3f = normalize(vd.normalWorld);
    let V: vec3f = normalize(u_prv.u_viewPosition - vd.positionWorld);
    // SR_gltf_pbr
    let Nf: vec3f = faceForward(N, -V, N);
    let ior: f32 = u_pub.SR_gltf_pbr_ior;
    let amplitude: f32 = (1.0 - ior) / (ior + 1.0);
    let fresnel_f0: vec3f = max(u_pub.SR_gltf_pbr_specular
        * min(u_pub.SR_gltf_pbr_specular_color * (amplitude * amplitude), vec3f(1.0)), vec3f(0.0));
    let f90: vec3f = vec3f(max(u_pub.SR_gltf_pbr_specular, 0.0));
    let alpha_bitangent: f32 = u_pub.SR_gltf_pbr_roughness * u_pub.SR_gltf_pbr_roughness;
    let specular_roughness: vec2f = clamp(vec2f(mix(alpha_bitangent, 1.0,
        u_pub.SR_gltf_pbr_anisotropy_strength * u_pub.SR_gltf_pbr_anisotropy_strength), alpha_bitangent),
        vec2f(0.00001), vec2f(1.0));
    let alpha: vec2f = clamp(specular_roughness, vec2f(1e-8), vec2f(1.0));
    let cos_v: f32 = max(abs(dot(N, V)), 1e-8);
    let albedo: vec2f = mx_ggx_albedo_fit(sqrt(alpha.x * alpha.y), cos_v);
    let single: vec3f = mix(fresnel_f0, f90, albedo.y) * albedo.x;
    let lost: f32 = 1.0 / albedo.x - 1.0;
    let reflection_scale: vec3f = lost * mix(fresnel_f0, f90, 0.04761905) + vec3f(1.0);
    let reflection_throughput: f32 = 1.0 - dot(single * reflection_scale, vec3f(0.33333334));
    let iridescence_thickness: f32 = u_pub.SR_gltf_pbr_iridescence_thickness;
    let iridescence_ior: f32 = u_pub.SR_gltf_pbr_iridescence_ior;
    let reflection_film_scale: vec3f = mix(mx_fresnel_facing(fresnel_f0, iridescence_thickness, iridescence_ior), f90,
        0.04761905) * lost + vec3f(1.0);
    let clamped_iridescence: f32 = clamp(u_pub.SR_gltf_pbr_iridescence, 0.0, 1.0);
    let coating_weight: f32 = clamp(u_pub.SR_gltf_pbr_clearcoat, 0.0, 1.0);
    let coat_lobe: f32 = clamp(u_pub.SR_gltf_pbr_clearcoat_roughness * u_pub.SR_gltf_pbr_clearcoat_roughness, 1e-8,
        1.0);
    let coating_albedo: vec2f = mx_ggx_albedo_fit(coat_lobe, cos_v);
    let coating_scale: f32 = (1.0 / coating_albedo.x - 1.0) * 0.08571429 + 1.0;
    let coating_throughput: f32 = 1.0 - coating_weight
        * (mix(0.04, 1.0, coating_albedo.y) * coating_albedo.x * coating_scale);
    let sheen_weight: f32 = max(max(u_pub.SR_gltf_pbr_sheen_color.x, u_pub.SR_gltf_pbr_sheen_color.y),
        u_pub.SR_gltf_pbr_sheen_color.z);
    let fuzz_weight: f32 = clamp(sheen_weight, 0.0, 1.0);
    let sheen_rough: f32 = u_pub.SR_gltf_pbr_sheen_roughness * u_pub.SR_gltf_pbr_sheen_roughness;
    let sheen_albedo: f32 = clamp(mx_bicubic(mat4x4f(3.7341, -15.9587, 23.621, -11.0989, -8.2265, 35.1081, -49.7137,
        23.2945, 4.0691, -17.882, 25.6639, -12.0167, -0.5833, 2.6552, -3.9393, 1.8999), 1.0 / (cos_v + 1.0),
        1.0 / (sheen_rough + 0.2)), 0.0, 1.0);
    let substrate_weight: f32 = coating_throughput * (1.0 - fuzz_weight * sheen_albedo);
    let body_weight: f32 = mix(reflection_throughput, 1.0 - dot(single * reflection_film_scale, vec3f(0.33333334)),
        clamped_iridescence) * substrate_weight;
    let metal_weight: f32 = clamp(u_pub.SR_gltf_pbr_metallic, 0.0, 1.0);
    let clamped_transmission: f32 = clamp(u_pub.SR_gltf_pbr_transmission, 0.0, 1.0);
    let diffuse_weight: f32 = (1.0 - metal_weight) * (1.0 - clamped_transmission);
    let diffuse_factor: vec3f = u_pub.SR_gltf_pbr_base_color * (body_weight * diffuse_weight * 0.31830987);
    let ggx_masking: f32 = sqrt(coat_lobe * coat_lobe + (1.0 - coat_lobe * coat_lobe) * (cos_v * cos_v));
    let coating_ggx_lobe: mx_GgxLobe = mx_GgxLobe(Nf, cos_v, vec3f(0.0), vec2f(coat_lobe), ggx_masking);
    let s: f32 = 1.0 / max(sheen_rough, 0.005);
    let fuzz_factor: vec3f = u_pub.SR_gltf_pbr_sheen_color / sheen_weight * (fuzz_weight * coating_throughput);
    let metal_film_visible: bool = clamped_iridescence * metal_weight > 0.0;
    let fresnel_facing: vec3f = max(u_pub.SR_gltf_pbr_base_color, vec3f(0.0));
    let metal_film_scale: vec3f = lost * mix(mx_fresnel_facing(fresnel_facing, iridescence_thickness, iridescence_ior),
        vec3f(1.0), 0.04761905) + vec3f(1.0);
    let metal_film_factor: vec3f = metal_film_scale * (substrate_weight * (clamped_iridescence * metal_weight));
    let specular_tangent: vec3f = mx_rotate3d(normalize(vd.tangentWorld),
        radians(u_pub.SR_gltf_pbr_anisotropy_rotation * -57.29578), N);
    let lobe: mx_GgxLobe = mx_ggx_lobe(specular_roughness, N, specular_tangent, V);
    let metal_bare_weight: f32 = metal_weight * (1.0 - clamped_iridescence);
    let metal_bare_factor: vec3f = (lost * mix(fresnel_facing, vec3f(1.0), 0.04761905) + vec3f(1.0))
        * (substrate_weight * metal_bare_weight);
    let reflection_film_weight: f32 = clamped_iridescence * (1.0 - metal_weight);
    let reflection_film_factor: vec3f = reflection_film_scale * (substrate_weight * reflection_film_weight);
    let reflection_weight: f32 = (1.0 - metal_weight) * (1.0 - clamped_iridescence);
    let reflection_factor: vec3f = reflection_scale * (substrate_weight * reflection_weight);
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
        // diffuse
        let light_color: vec3f = u_lightData[i].color;
        let l_dot_nf: f32 = dot(L, Nf);
        let cos_l: f32 = max(l_dot_nf, 1e-8);
        color += light_color * (intensity * (cos_l * diffuse_factor));
        // coating
        let v_dot_l: f32 = dot(V, L);
        let half_cosine: f32 = sqrt(clamp(v_dot_l * 0.5 + 0.500001, 0.0, 1.0));
        if (coating_weight > 0.0) {
            let coating_product: f32 = mx_fresnel_permittivity(half_cosine, 2.25) * (coating_weight * coating_scale);
            color += light_color * (intensity * (mx_ggx_light(coating_ggx_lobe, V, L) * coating_product));
        }
        // fuzz
        if (fuzz_weight > 0.0) {
            let scaled_along: f32 = (cos_v + l_dot_nf) * (cos_v + l_dot_nf);
            let fuzz_product: f32 = cos_l
                * ((s + 2.0) * pow(clamp(1.0 - scaled_along / max(v_dot_l * 2.0 + 2.0, 1e-8), 0.0, 1.0), s * 0.5)
                / 6.2831855);
            color += light_color * (intensity * (fuzz_product / ((cos_v + cos_l - cos_v * cos_l) * 4.0) * fuzz_factor));
        }
        // metal_film
        let ggx_light: f32 = mx_ggx_light_2(lobe, V, L);
        if (metal_film_visible) {
            color += light_color * (intensity
                * (metal_film_factor * (mx_fresnel(half_cosine, fresnel_facing, vec3f(1.0), iridescence_thickness,
                iridescence_ior) * ggx_light)));
        }
        // metal_bare
        if (metal_bare_weight > 0.0) {
            color += light_color * (intensity
                * (metal_bare_factor * (ggx_light * mx_fresnel_schlick(half_cosine, fresnel_facing, vec3f(1.0)))));
        }
        // reflection_film
        if (reflection_film_weight > 0.0) {
            color += light_color * (intensity
                * (reflection_film_factor
                * (ggx_light * mx_fresnel(half_cosine, fresnel_f0, f90, iridescence_thickness, iridescence_ior))));
        }
        // reflection
        if (reflection_weight > 0.0) {
            color += light_color * (intensity
                * (reflection_factor * (ggx_light * mx_fresnel_schlick(half_cosine, fresnel_f0, f90))));
        }
    }
    // environment: fuzz
    let part: vec3f = textureSampleLevel(u_envIrradiance, u_envIrradiance_sampler,
        mx_map_point(normalize(wgsl_mat3x3f_of_mat4x4f(u_prv.u_envMatrix) * Nf)), 0.0).xyz;
    if (fuzz_weight > 0.0) {
        let fuzz_product: f32 = u_prv.u_envLightIntensity * (sheen_albedo * (fuzz_weight * coating_throughput));
        color += u_pub.SR_gltf_pbr_sheen_color / sheen_weight * part * fuzz_product;
    }
    // environment: diffuse
    if (diffuse_weight > 0.0) {
        color += u_pub.SR_gltf_pbr_base_color * part * (body_weight * diffuse_weight * u_prv.u_envLightIntensity);
    }
    // environment: coating
    if (coating_weight > 0.0) {
        var turn: vec2f = vec2f(1.0, 0.0);
        let coating_count: i32 = mx_sample_count(vec2f(coat_lobe));
        let coating_ggx_samples: mx_GgxSamples = mx_ggx_samples(vec2f(coat_lobe), coating_count, N, V);
        for (var i: i32 = 0; i < coating_count; i++) {
            let coating_light: mx_GgxLight = mx_ggx_reflected(coating_ggx_samples, i, turn);
            color += coating_light.color
                * (mx_fresnel_permittivity(coating_light.cosine, 2.25)
                * (coating_weight * coating_scale * coating_light.weight));
            turn = vec2f(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // environment: metal_film, metal_bare, reflection_film, reflection
    let count: i32 = mx_sample_count(alpha);
    let samples: mx_GgxSamples = mx_ggx_samples_2(specular_roughness, count, N, specular_tangent, V);
    if (reflection_weight > 0.0 || reflection_film_weight > 0.0 || metal_film_visible || metal_bare_weight > 0.0) {
        if (iridescence_thickness > 0.0) {
            var turn: vec2f = vec2f(1.0, 0.0);
            for (var i: i32 = 0; i < count; i++) {
                let light: mx_GgxLight = mx_ggx_reflected(samples, i, turn);
                if (metal_film_visible) {
                    color += metal_film_factor
                        * (light.color * (light.weight
                        * mx_film_schlick(light.cosine, fresnel_facing, vec3f(1.0), iridescence_thickness,
                        iridescence_ior)));
                }
                if (metal_bare_weight > 0.0) {
                    color += metal_bare_factor
                        * (light.color * (light.weight * mx_fresnel_schlick(light.cosine, fresnel_facing, vec3f(1.0))));
                }
                if (reflection_film_weight > 0.0) {
                    color += reflection_film_factor
                        * (light.color * (light.weight
                        * mx_film_schlick(light.cosine, fresnel_f0, f90, iridescence_thickness, iridescence_ior)));
                }
                if (reflection_weight > 0.0) {
                    color += reflection_factor
                        * (light.color * (light.weight * mx_fresnel_schlick(light.cosine, fresnel_f0, f90)));
                }
                turn = vec2f(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        } else {
            var turn: vec2f = vec2f(1.0, 0.0);
            for (var i: i32 = 0; i < count; i++) {
                let light: mx_GgxLight = mx_ggx_reflected(samples, i, turn);
                let product: vec3f = light.color
                    * (light.weight * mx_fresnel_schlick(light.cosine, fresnel_facing, vec3f(1.0)));
                color += metal_bare_factor * product + metal_film_factor * product;
                let product_2: vec3f = light.color * (light.weight * mx_fresnel_schlick(light.cosine, fresnel_f0, f90));
                if (reflection_film_weight > 0.0) {
                    color += reflection_film_factor * product_2;
                }
                if (reflection_weight > 0.0) {
                    color += reflection_factor * product_2;
                }
                turn = vec2f(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        }
    }
    // environment: refraction
    let refraction_weight: f32 = clamped_transmission * (1.0 - metal_weight);
    if (refraction_weight > 0.0) {
        var turn: vec2f = vec2f(1.0, 0.0);
        let refraction_factor: vec3f = fresnel_facing
            * select(vec3f(1.0), fresnel_facing, u_prv.u_refractionTwoSided != 0u) * (body_weight * refraction_weight);
        for (var i: i32 = 0; i < count; i++) {
            let refraction_light: mx_GgxLight = mx_ggx_transmitted(samples, ior, i, turn);
            color += refraction_factor * (refraction_light.color
                * (refraction_light.weight * (1.0 - mx_fresnel_permittivity(refraction_light.cosine, ior * ior))));
            turn = vec2f(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // opacity
    let mask: f32 = select(0.0, 1.0, u_pub.SR_gltf_pbr_alpha >= u_pub.SR_gltf_pbr_alpha_cutoff);
    let opacity: f32 = clamp(select(select(select(0.0, u_pub.SR_gltf_pbr_alpha, 3 > u_pub.SR_gltf_pbr_alpha_mode), mask,
        2 > u_pub.SR_gltf_pbr_alpha_mode), 1.0, 1 > u_pub.SR_gltf_pbr_alpha_mode), 0.0, 1.0);
    if (opacity < u_prv.u_alphaThreshold) {
        discard;
    }
    out1 = vec4f(opacity * color, opacity);
    return out1;
}
