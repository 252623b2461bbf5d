// open_pbr_surface · surfacematerial · mxgen 0.1 · wgsl · complete · 13 closures · 0 textures

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
    SR_open_pbr_surface_base_weight: f32,
    SR_open_pbr_surface_base_color: vec3f,
    SR_open_pbr_surface_base_diffuse_roughness: f32,
    SR_open_pbr_surface_base_metalness: f32,
    SR_open_pbr_surface_specular_weight: f32,
    SR_open_pbr_surface_specular_color: vec3f,
    SR_open_pbr_surface_specular_roughness: f32,
    SR_open_pbr_surface_specular_ior: f32,
    SR_open_pbr_surface_specular_roughness_anisotropy: f32,
    SR_open_pbr_surface_transmission_weight: f32,
    SR_open_pbr_surface_transmission_color: vec3f,
    SR_open_pbr_surface_transmission_depth: f32,
    SR_open_pbr_surface_transmission_scatter: vec3f,
    SR_open_pbr_surface_subsurface_weight: f32,
    SR_open_pbr_surface_subsurface_color: vec3f,
    SR_open_pbr_surface_subsurface_radius: f32,
    SR_open_pbr_surface_subsurface_radius_scale: vec3f,
    SR_open_pbr_surface_subsurface_scatter_anisotropy: f32,
    SR_open_pbr_surface_fuzz_weight: f32,
    SR_open_pbr_surface_fuzz_color: vec3f,
    SR_open_pbr_surface_fuzz_roughness: f32,
    SR_open_pbr_surface_coat_weight: f32,
    SR_open_pbr_surface_coat_color: vec3f,
    SR_open_pbr_surface_coat_roughness: f32,
    SR_open_pbr_surface_coat_roughness_anisotropy: f32,
    SR_open_pbr_surface_coat_ior: f32,
    SR_open_pbr_surface_coat_darkening: f32,
    SR_open_pbr_surface_thin_film_weight: f32,
    SR_open_pbr_surface_thin_film_thickness: f32,
    SR_open_pbr_surface_thin_film_ior: f32,
    SR_open_pbr_surface_emission_luminance: f32,
    SR_open_pbr_surface_emission_color: vec3f,
    SR_open_pbr_surface_geometry_opacity: f32,
    SR_open_pbr_surface_geometry_thin_walled: u32,
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

// The numbers a and b of the linear transform that makes the sheen lobe of roughness r, at the cosine c of the viewer,
// of a clamped cosine (Zeltner, Burley and Chiang 2022):
//     M^-1 = [a 0 b; 0 a 0; 0 0 1] in the plane of V and N
fn mx_sheen_transform(c: f32, r: f32) -> vec2f
{
    return vec2f((2.58126 * c + 0.813703 * r) * r / (1.0 + 0.310327 * c * c + 2.60994 * c * r),
        sqrt(1.0 - c) * (r - 1.0) * r * r * r / (0.0000254053 + 1.71228 * c - 1.71506 * c * r + 1.34174 * r * r));
}

// The direction w in the tangent space around N, whose x lies along the unit tangent `x`.
fn mx_enter_frame(w: vec3f, N: vec3f, x: vec3f) -> vec3f
{
    return vec3f(dot(w, x), dot(w, cross(N, x)), dot(w, N));
}

// The unit tangent along X at the normal N.
fn mx_tangent(N: vec3f, X: vec3f) -> vec3f
{
    return normalize(X - dot(X, N) * N);
}

// The sheen lobe of roughness r from L to V, where V has the cosine c (Zeltner, Burley and Chiang 2022).
fn mx_sheen_zeltner(N: vec3f, V: vec3f, L: vec3f, c: f32, r: f32) -> f32
{
    let m: vec2f = mx_sheen_transform(c, r);
    let l: vec3f = mx_enter_frame(L, N, mx_tangent(N, V + 0.00001 * N.yzx));
    let w: vec3f = vec3f(m.x * l.x + m.y * l.z, m.x * l.y, l.z);
    let scale: f32 = m.x / dot(w, w);
    return max(w.z, 0.0) / 3.1415927 * scale * scale;
}

// Squared roughness along X and across (OpenPBR Surface specification, "Microfacet model").
fn mx_open_pbr_anisotropy(roughness: f32, anisotropy: f32) -> vec2f
{
    let aspect: f32 = 1.0 - anisotropy;
    return roughness * roughness * sqrt(2.0 / (1.0 + aspect * aspect)) * vec2f(1.0, aspect);
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
fn mx_ggx_stretched(lobe: mx_GgxLobe, H: vec3f, cos_h: f32) -> f32
{
    let parts: vec2f = vec2f(dot(H, lobe.x), dot(cross(H, lobe.N), lobe.x)) / lobe.alpha;
    return lobe.alpha.x * lobe.alpha.y * (dot(parts, parts) + cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = false, is_wide = false.
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

// Roughness of a lobe that is seen through a rough coat (OpenPBR Surface specification, "Roughening").
fn mx_open_pbr_blurred(roughness: f32, coat_roughness: f32) -> f32
{
    return pow(min(2.0 * pow(coat_roughness, 4.0) + pow(roughness, 4.0), 1.0), 0.25);
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
// Here model = "schlick".
fn mx_fresnel_facing(n: vec3f, film: f32, film_ior: f32) -> vec3f
{
    if (film > 0.0) {
        return mx_film_schlick_facing(n, film, film_ior);
    }
    return n;
}

// Factor of what lies below a coat: the coat's colour, and what bounces below it, of which the share K stays inside:
//     coat_color mix(1, (1 - K) / (1 - K E coat_color), coat_darkening), E the albedo of the base
// (OpenPBR Surface specification 1.2, "Darkening").
// Here coat_color = vec3f(1.0).
fn mx_open_pbr_coat_darkening(base_color: vec3f, base_metalness: f32, specular_weight: f32, subsurface_weight: f32,
    subsurface_color: vec3f, coat_ior: f32, coat_darkening: f32) -> vec3f
{
    let kept: f32 = max(1.0 - 4.0 * coat_ior / ((coat_ior + 1.0) * (coat_ior + 1.0)) / (coat_ior * coat_ior), 0.0);
    return mix(vec3f(1.0), vec3f(1.0 - kept)
        / (vec3f(1.0) - kept * mix(mix(base_color, subsurface_color, subsurface_weight),
        base_color * min(specular_weight, 1.0), base_metalness)), coat_darkening);
}

// Schlick's curve from f0 to f90 at a cosine, less `bend` times cos (1 - cos)^6.
// Here f90 = vec3f(1.0), exponent = 5.0.
fn mx_fresnel_schlick(cosine: f32, f0: vec3f, bend: vec3f) -> vec3f
{
    let x: f32 = 1.0 - cosine;
    let x3: f32 = x * x * x;
    return mix(f0, vec3f(1.0), x3 * x * x) - bend * (cosine * x3 * x3);
}

// Amplitudes of a film's own interface, of perpendicular and parallel light; `inside` is the cosine in the film.
fn mx_film_amplitudes(cosine: f32, inside: f32, ior: f32) -> vec2f
{
    let x: vec2f = vec2f(cosine, ior * cosine);
    let u: vec2f = vec2f(ior * inside, inside);
    return (x - u) / (x + u);
}

// Reflectance of a film on an interface with Schlick's curve.
// Here f90 = vec3f(1.0), exponent = 5.0.
fn mx_film_schlick(cosine: f32, f0: vec3f, bend: vec3f, film: f32, film_ior: f32) -> vec3f
{
    let ior: f32 = max(film_ior, 1.0);
    let c: f32 = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    let a: vec2f = mx_film_amplitudes(cosine, c, ior);
    let d: f32 = 0.012566372 * ior * c * film;
    let r: vec3f = mx_film_turned(f0, mx_fresnel_schlick(c, f0, bend), ior);
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
// Here model = "schlick", f90 = vec3f(1.0), exponent = 5.0.
fn mx_fresnel(cosine: f32, n: vec3f, k: vec3f, film: f32, film_ior: f32) -> vec3f
{
    if (film > 0.0) {
        return mx_film_schlick(cosine, n, k, film, film_ior);
    }
    return mx_fresnel_schlick(cosine, n, k);
}

// Reflectance of a dielectric that faces the viewer.
fn mx_fresnel_dielectric_facing(ior: f32) -> f32
{
    let r: f32 = (1.0 - ior) / (1.0 + ior);
    return r * r;
}

// Complex amplitude (x - u) / (x + u) of an interface in one polarisation: u is the index times the cosine behind it; x
// is the cosine for perpendicular light, and the permittivity times the cosine for parallel light.
fn mx_film_amplitude(x: vec2f, u: vec2f) -> vec2f
{
    return vec2f(dot(x, x) - dot(u, u), 2.0 * (x.y * u.x - x.x * u.y)) / dot(x + u, x + u);
}

// The index times the cosine behind an interface, u + iv, from the cosine in front of it and the permittivity:
//     (u + iv)^2 = re + i im - sin^2
fn mx_fresnel_refract(cosine: f32, re: f32, im: f32) -> vec2f
{
    let t: f32 = re + (cosine * cosine - 1.0);
    let norm: f32 = sqrt(t * t + im * im);
    return sqrt(max(0.5 * vec2f(norm + t, norm - t), vec2f(0.0)));
}

// Reflectance, facing the viewer, of a film on an interface with the permittivity re + i im.
// Here im = vec3f(0.0).
fn mx_film_index_facing(re: vec3f, film: f32, film_ior: f32) -> vec3f
{
    let ior: f32 = max(film_ior, 1.0);
    let a: f32 = (1.0 - ior) / (1.0 + ior);
    let d: f32 = 0.012566372 * ior * film;
    var xyz: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < 4; i++) {
        let channel: i32 = max(i - 1, 0);
        xyz[channel] += mx_film_light(a,
            mx_film_amplitude(vec2f(1.0, 0.0), mx_fresnel_refract(1.0, re[channel] / (ior * ior), 0.0)), d, i);
    }
    return clamp(mat3x3f(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * xyz, vec3f(0.0), vec3f(1.0));
}

// Reflectance, facing the viewer, of an interface.
// Here model = "dielectric", k = vec3f(0.0).
fn mx_fresnel_facing_2(n: vec3f, film: f32, film_ior: f32) -> vec3f
{
    if (film > 0.0) {
        return mx_film_index_facing(n * n, film, film_ior);
    }
    return vec3f(mx_fresnel_dielectric_facing(n.x));
}

// Reflectance of a film on an interface with the permittivity re + i im.
// Here im = vec3f(0.0).
fn mx_film_index(cosine: f32, re: vec3f, film: f32, film_ior: f32) -> vec3f
{
    let ior: f32 = max(film_ior, 1.0);
    let c: f32 = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    let a: vec2f = mx_film_amplitudes(cosine, c, ior);
    let d: f32 = 0.012566372 * ior * c * film;
    var xyz: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < 4; i++) {
        let channel: i32 = max(i - 1, 0);
        let below: vec2f = vec2f(re[channel], 0.0) / (ior * ior);
        let u: vec2f = mx_fresnel_refract(c, below.x, below.y);
        var x: vec2f = vec2f(c, 0.0);
        for (var p: i32 = 0; p < 2; p++) {
            xyz[channel] += mx_film_light(a[p], mx_film_amplitude(x, u), d, i);
            x = c * below;
        }
    }
    return clamp(mat3x3f(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * (0.5 * xyz), vec3f(0.0), vec3f(1.0));
}

// Reflectance of an interface at a cosine.
// Here model = "dielectric", k = vec3f(0.0), f90 = vec3f(1.0), exponent = 0.0.
fn mx_fresnel_2(cosine: f32, n: vec3f, film: f32, film_ior: f32) -> vec3f
{
    if (film > 0.0) {
        return mx_film_index(cosine, n * n, film, film_ior);
    }
    return vec3f(mx_fresnel_permittivity(cosine, n.x * n.x));
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

// The GGX lobe of a surface as samples of the environment see it.
// Here is_round = false.
fn mx_ggx_samples(roughness: vec2f, count: i32, N: vec3f, X: vec3f, V: vec3f) -> mx_GgxSamples
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

// The light that comes to the facet of sample i through a solid sphere of index `ior` behind it.
fn mx_ggx_transmitted(s: mx_GgxSamples, ior: f32, i: i32, turn: vec2f) -> mx_GgxLight
{
    let facet: mx_GgxFacet = mx_ggx_facet(s, i, turn);
    let h: vec3f = normalize(facet.h);
    return mx_GgxLight(mx_filtered_light(s.to_map * reflect(s.v, refract(-s.v, h, 1.0 / ior)), facet.texels),
        s.weight * 0.5 / s.v.z, clamp(dot(s.v, h), 1e-8, 1.0));
}

// Light that arrives at a point of a circle of this curvature by subsurface scattering, where the cosine of the light
// is cos_l: Burley's normalised diffusion (Christensen 2015) around the circle (after Penner 2011, "Pre-integrated skin
// shading").
fn mx_subsurface_light(radius: f32, curvature: f32, cos_l: f32) -> f32
{
    let x: f32 = curvature * max(radius, 0.1);
    let bend: vec3f = (vec3f(0.1573, 0.0104, 0.1632)
        + x * (vec3f(0.662, 0.1732, 0.6079) + x * vec3f(0.6075, 0.4138, 0.8133)))
        / (6.2831855 * (0.1602 + x * (0.6652 + x)));
    return bend.x * cos_l + sqrt(bend.y * bend.y + (bend.z * bend.z - bend.y * bend.y) * (cos_l * cos_l));
}

// Light that arrives by subsurface scattering, with a radius for each channel.
fn mx_subsurface_light_2(radius: vec3f, curvature: f32, cos_l: f32) -> vec3f
{
    var light: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < 3; i++) {
        light[i] = mx_subsurface_light(radius[i], curvature, cos_l);
    }
    return light;
}

// Directional albedo of Fujii's lobe of roughness r (Fujii 2012, "A tiny improvement of Oren-Nayar reflectance model").
fn mx_fujii_albedo(cosine: f32, r: f32) -> f32
{
    let sine: f32 = sqrt(max(1.0 - cosine * cosine, 0.0));
    let g: f32 = sine * (acos(min(cosine, 1.0)) - sine * cosine)
        + 0.6666667 * (sine / cosine * (1.0 - sine * sine * sine) - sine);
    return (1.0 + r * g / 3.1415927) / (1.0 + 0.28779334 * r);
}

// Albedo of the light that Fujii's lobe scatters more than once, relative to `color`; `mean` is the mean albedo of the
// lobe.
fn mx_fujii_multiple(color: vec3f, mean: f32) -> vec3f
{
    return color * mean / (1.0 - color * max(1.0 - mean, 0.0));
}

@fragment
fn main(vd: VertexData) -> @location(0) vec4f
{
    var out1: vec4f;
    let coat_weight: f32 = u_pub.SR_open_pbr_surface_coat_weight;
    let coating_weight: f32 = clamp(coat_weight, 0.0, 1.0);
    let coat_ior: f32 = u_pub.SR_open_pbr_surface_coat_ior;
    let coat_transmittance: f32 = coat_ior * 4.0 / ((coat_ior + 1.0) * (coat_ior + 1.0));
    let N: vec3f = normalize(vd.normalWorld);
    let V: vec3f = normalize(u_prv.u_viewPosition - vd.positionWorld);
    let absolute: f32 = abs(dot(N, V));
    var color: vec3f = u_pub.SR_open_pbr_surface_emission_luminance
        * (u_pub.SR_open_pbr_surface_emission_color
        * (1.0 - coating_weight + u_pub.SR_open_pbr_surface_coat_color
        * (coating_weight * (coat_transmittance * (1.0 - pow(1.0 - min(absolute, 1.0), 5.0))))));
    // lights: fuzz, coating, metal_film, metal_bare, reflection_film, reflection_bare
    let fuzz_weight: f32 = clamp(u_pub.SR_open_pbr_surface_fuzz_weight, 0.0, 1.0);
    let Nf: vec3f = faceForward(N, -V, N);
    let cos_v: f32 = max(absolute, 1e-8);
    let limited_cos_v: f32 = min(cos_v, 1.0);
    let fuzz_r: f32 = clamp(u_pub.SR_open_pbr_surface_fuzz_roughness, 0.01, 1.0);
    let width: f32 = fuzz_r * (fuzz_r * 1.58491 + 0.0206607) / (fuzz_r * (fuzz_r + 1.32227) + 0.0379424);
    let x: f32 = (cos_v - fuzz_r * (fuzz_r * (fuzz_r * (1.7932 - fuzz_r * (fuzz_r * 0.95943)) - 1.14885) - 0.193854)
        / (fuzz_r + 0.046391)) / width;
    let fuzz_ratio: f32 = exp(x * (x * -0.5)) / (width * 2.5066283);
    let fuzz_product: f32 = fuzz_r * (fuzz_r * (fuzz_r * 0.119681 - 0.0207818) + 0.000654023);
    let fuzz_product_2: f32 = fuzz_weight
        * max(fuzz_ratio + fuzz_product / (fuzz_r * (fuzz_r - 1.92021) + 1.26264), 0.0);
    let fuzz_factor: vec3f = u_pub.SR_open_pbr_surface_fuzz_color * fuzz_product_2;
    let coat_lobe: vec2f = mx_open_pbr_anisotropy(u_pub.SR_open_pbr_surface_coat_roughness,
        u_pub.SR_open_pbr_surface_coat_roughness_anisotropy);
    let X: vec3f = normalize(vd.tangentWorld);
    let coating_lobe: mx_GgxLobe = mx_ggx_lobe(coat_lobe, N, X, V);
    let coating_r: f32 = (1.0 - coat_ior) / (coat_ior + 1.0);
    let coating_alpha: vec2f = clamp(coat_lobe, vec2f(1e-8), vec2f(1.0));
    let coating_albedo: vec2f = mx_ggx_albedo_fit(sqrt(coating_alpha.x * coating_alpha.y), cos_v);
    let coating_scale: f32 = mix(coating_r * coating_r, 1.0, 0.04761905) * (1.0 / coating_albedo.x - 1.0) + 1.0;
    let coating_factor: f32 = coating_scale * (coating_weight * (1.0 - fuzz_product_2));
    let clamped_specular_weight: f32 = clamp(u_pub.SR_open_pbr_surface_specular_weight, 0.0, 1.0);
    let clamped_thin_film_weight: f32 = clamp(u_pub.SR_open_pbr_surface_thin_film_weight, 0.0, 1.0);
    let metal_weight: f32 = clamp(u_pub.SR_open_pbr_surface_base_metalness, 0.0, 1.0);
    let metal_film_weight: f32 = clamped_specular_weight * (clamped_thin_film_weight * metal_weight);
    let roughness: vec2f = mx_open_pbr_anisotropy(mix(u_pub.SR_open_pbr_surface_specular_roughness,
        mx_open_pbr_blurred(u_pub.SR_open_pbr_surface_specular_roughness, u_pub.SR_open_pbr_surface_coat_roughness),
        coat_weight), u_pub.SR_open_pbr_surface_specular_roughness_anisotropy);
    let alpha: vec2f = clamp(roughness, vec2f(1e-8), vec2f(1.0));
    let albedo: vec2f = mx_ggx_albedo_fit(sqrt(alpha.x * alpha.y), cos_v);
    let lost: f32 = 1.0 / albedo.x - 1.0;
    let fresnel_facing: vec3f = max(u_pub.SR_open_pbr_surface_base_weight * u_pub.SR_open_pbr_surface_base_color,
        vec3f(0.0));
    let film_thickness: f32 = u_pub.SR_open_pbr_surface_thin_film_thickness * 1000.0;
    let thin_film_ior: f32 = u_pub.SR_open_pbr_surface_thin_film_ior;
    let clamped_darkened: vec3f = clamp(mx_open_pbr_coat_darkening(u_pub.SR_open_pbr_surface_base_color,
        u_pub.SR_open_pbr_surface_base_metalness, u_pub.SR_open_pbr_surface_specular_weight,
        u_pub.SR_open_pbr_surface_subsurface_weight, u_pub.SR_open_pbr_surface_subsurface_color, coat_ior,
        coat_weight * u_pub.SR_open_pbr_surface_coat_darkening), vec3f(0.0), vec3f(1.0));
    let coated_weight: f32 = (1.0 - fuzz_product_2)
        * (1.0 - coating_weight * (mix(coating_r * coating_r, 1.0, coating_albedo.y) * coating_albedo.x
        * coating_scale));
    let substrate_weight: vec3f = clamped_darkened
        * (clamp(mix(vec3f(1.0), u_pub.SR_open_pbr_surface_coat_color, coat_weight), vec3f(0.0), vec3f(1.0))
        * coated_weight);
    let metal_film_factor: vec3f = (lost
        * mix(mx_fresnel_facing(fresnel_facing, film_thickness, thin_film_ior), vec3f(1.0), 0.04761905) + vec3f(1.0))
        * (substrate_weight * metal_film_weight);
    let limited_specular_color: vec3f = max(u_pub.SR_open_pbr_surface_specular_color, vec3f(0.0));
    let schlick_bend: vec3f = mix(fresnel_facing, vec3f(1.0), 0.4626644) * (vec3f(1.0) - limited_specular_color)
        * 17.651384;
    let lobe: mx_GgxLobe = mx_ggx_lobe(roughness, N, X, V);
    let metal_bare_weight: f32 = clamped_specular_weight * (metal_weight * (1.0 - clamped_thin_film_weight));
    let metal_bare_factor: vec3f = (lost * mix(fresnel_facing, vec3f(1.0), 0.04761905) + vec3f(1.0))
        * (substrate_weight * metal_bare_weight);
    let reflection_film_weight: f32 = clamped_thin_film_weight * (1.0 - metal_weight);
    let ior_relative: f32 = mix(u_pub.SR_open_pbr_surface_specular_ior,
        max(u_pub.SR_open_pbr_surface_specular_ior / coat_ior, coat_ior / u_pub.SR_open_pbr_surface_specular_ior),
        coat_weight);
    let amplitude: f32 = clamp((ior_relative - 1.0) / (ior_relative + 1.0)
        * sqrt(u_pub.SR_open_pbr_surface_specular_weight), -0.999995, 0.999995);
    let ior: f32 = (amplitude + 1.0) / (1.0 - amplitude);
    let reflection_film_scale: vec3f = mix(mx_fresnel_facing_2(vec3f(ior), film_thickness, thin_film_ior), vec3f(1.0),
        0.04761905) * lost + vec3f(1.0);
    let reflection_film_factor: vec3f = substrate_weight * reflection_film_weight
        * (reflection_film_scale * limited_specular_color);
    let reflection_bare_weight: f32 = (1.0 - metal_weight) * (1.0 - clamped_thin_film_weight);
    let r: f32 = (1.0 - ior) / (ior + 1.0);
    let reflection_bare_scale: f32 = lost * mix(r * r, 1.0, 0.04761905) + 1.0;
    let reflection_bare_factor: vec3f = reflection_bare_scale
        * (limited_specular_color * (substrate_weight * reflection_bare_weight));
    let scaled_ior: f32 = ior * ior;
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
                let spot_light_edge: f32 = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = select(0.0, smoothstep(spot_light_edge, u_lightData[i].inner_angle,
                    -dot(u_lightData[i].direction, to_light)) * falloff, light_type_ == 3);
            }
        }
        // fuzz
        let light_color: vec3f = u_lightData[i].color;
        if (fuzz_weight > 0.0) {
            color += light_color * (intensity * (mx_sheen_zeltner(Nf, V, L, limited_cos_v, fuzz_r) * fuzz_factor));
        }
        // coating
        let half_cosine: f32 = sqrt(clamp(dot(V, L) * 0.5 + 0.500001, 0.0, 1.0));
        if (coating_weight > 0.0) {
            let coating_product: f32 = mx_fresnel_permittivity(half_cosine, coat_ior * coat_ior) * coating_factor;
            color += light_color * (intensity * (mx_ggx_light(coating_lobe, V, L) * coating_product));
        }
        // metal_film
        let ggx_light: f32 = mx_ggx_light(lobe, V, L);
        if (metal_film_weight > 0.0) {
            color += light_color * (intensity
                * (metal_film_factor * (mx_fresnel(half_cosine, fresnel_facing, schlick_bend, film_thickness,
                thin_film_ior) * ggx_light)));
        }
        // metal_bare
        if (metal_bare_weight > 0.0) {
            color += light_color * (intensity
                * (metal_bare_factor * (ggx_light * mx_fresnel_schlick(half_cosine, fresnel_facing, schlick_bend))));
        }
        // reflection_film
        if (reflection_film_weight > 0.0) {
            color += light_color * (intensity
                * (reflection_film_factor
                * (ggx_light * mx_fresnel_2(half_cosine, vec3f(ior), film_thickness, thin_film_ior))));
        }
        // reflection_bare
        if (reflection_bare_weight > 0.0) {
            color += light_color * (intensity
                * (reflection_bare_factor * (ggx_light * mx_fresnel_permittivity(half_cosine, scaled_ior))));
        }
    }
    // environment: fuzz
    let part: vec3f = textureSampleLevel(u_envIrradiance, u_envIrradiance_sampler,
        mx_map_point(normalize(wgsl_mat3x3f_of_mat4x4f(u_prv.u_envMatrix) * Nf)), 0.0).xyz;
    let envLightIntensity: f32 = u_prv.u_envLightIntensity;
    if (fuzz_weight > 0.0) {
        color += u_pub.SR_open_pbr_surface_fuzz_color * part * (fuzz_product_2 * envLightIntensity);
    }
    // environment: coating
    if (coating_weight > 0.0) {
        var turn: vec2f = vec2f(1.0, 0.0);
        let coating_count: i32 = mx_sample_count(coating_alpha);
        let coating_ggx_samples: mx_GgxSamples = mx_ggx_samples(coat_lobe, coating_count, N, X, V);
        for (var i: i32 = 0; i < coating_count; i++) {
            let coating_light: mx_GgxLight = mx_ggx_reflected(coating_ggx_samples, i, turn);
            color += coating_light.color
                * (mx_fresnel_permittivity(coating_light.cosine, coat_ior * coat_ior)
                * (coating_factor * coating_light.weight));
            turn = vec2f(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // environment: metal_film, metal_bare, reflection_film, reflection_bare
    let count: i32 = mx_sample_count(alpha);
    let samples: mx_GgxSamples = mx_ggx_samples(roughness, count, N, X, V);
    if (reflection_bare_weight > 0.0 || reflection_film_weight > 0.0 || metal_film_weight > 0.0
        || metal_bare_weight > 0.0) {
        if (film_thickness > 0.0) {
            var turn: vec2f = vec2f(1.0, 0.0);
            for (var i: i32 = 0; i < count; i++) {
                let light: mx_GgxLight = mx_ggx_reflected(samples, i, turn);
                if (metal_film_weight > 0.0) {
                    color += metal_film_factor
                        * (light.color * (light.weight
                        * mx_film_schlick(light.cosine, fresnel_facing, schlick_bend, film_thickness, thin_film_ior)));
                }
                if (metal_bare_weight > 0.0) {
                    color += metal_bare_factor
                        * (light.color * (light.weight
                        * mx_fresnel_schlick(light.cosine, fresnel_facing, schlick_bend)));
                }
                if (reflection_film_weight > 0.0) {
                    color += reflection_film_factor
                        * (light.color * (light.weight
                        * mx_film_index(light.cosine, vec3f(scaled_ior), film_thickness, thin_film_ior)));
                }
                if (reflection_bare_weight > 0.0) {
                    color += reflection_bare_factor
                        * (light.color * (light.weight * mx_fresnel_permittivity(light.cosine, scaled_ior)));
                }
                turn = vec2f(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        } else {
            var turn: vec2f = vec2f(1.0, 0.0);
            for (var i: i32 = 0; i < count; i++) {
                let light: mx_GgxLight = mx_ggx_reflected(samples, i, turn);
                let product: vec3f = light.color
                    * (light.weight * mx_fresnel_schlick(light.cosine, fresnel_facing, schlick_bend));
                color += metal_bare_factor * product + metal_film_factor * product;
                let product_2: vec3f = light.color * (light.weight * mx_fresnel_permittivity(light.cosine, scaled_ior));
                if (reflection_film_weight > 0.0) {
                    color += reflection_film_factor * product_2;
                }
                if (reflection_bare_weight > 0.0) {
                    color += reflection_bare_factor * product_2;
                }
                turn = vec2f(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        }
    }
    // environment: refraction_film, refraction_bare
    let clamped_transmission_weight: f32 = clamp(u_pub.SR_open_pbr_surface_transmission_weight, 0.0, 1.0);
    let filled_weight: f32 = clamped_transmission_weight * (1.0 - metal_weight);
    let refraction_film_visible: bool = clamped_thin_film_weight * filled_weight > 0.0;
    let refraction_bare_weight: f32 = filled_weight * (1.0 - clamped_thin_film_weight);
    let single: f32 = mix(r * r, 1.0, albedo.y) * albedo.x;
    let body_weight: vec3f = mix(vec3f(1.0 - single * reflection_bare_scale),
        vec3f(1.0) - single * reflection_film_scale, clamped_thin_film_weight) * substrate_weight;
    if (refraction_film_visible || refraction_bare_weight > 0.0) {
        let tint: vec3f = max(select(u_pub.SR_open_pbr_surface_transmission_color, vec3f(1.0),
            u_pub.SR_open_pbr_surface_transmission_depth > 0.0), vec3f(0.0));
        let absorbed: vec3f = -(u_pub.SR_open_pbr_surface_transmission_scatter
            + log(u_pub.SR_open_pbr_surface_transmission_color)) / u_pub.SR_open_pbr_surface_transmission_depth;
        let product: vec3f = exp(-select(vec3f(0.0), absorbed - min(min(min(absorbed.x, absorbed.y), absorbed.z), 0.0),
            u_pub.SR_open_pbr_surface_transmission_depth > 0.0)) * tint;
        let product_2: vec3f = select(vec3f(1.0), tint, u_prv.u_refractionTwoSided != 0u) * product;
        let refraction_film_factor: vec3f = body_weight * (clamped_thin_film_weight * filled_weight) * product_2;
        let refraction_bare_factor: vec3f = product_2 * (body_weight * refraction_bare_weight);
        if (film_thickness > 0.0) {
            var turn: vec2f = vec2f(1.0, 0.0);
            for (var i: i32 = 0; i < count; i++) {
                let light: mx_GgxLight = mx_ggx_transmitted(samples, ior, i, turn);
                if (refraction_film_visible) {
                    color += refraction_film_factor
                        * (light.color * (light.weight
                        * (vec3f(1.0) - mx_film_index(light.cosine, vec3f(scaled_ior), film_thickness,
                        thin_film_ior))));
                }
                if (refraction_bare_weight > 0.0) {
                    color += refraction_bare_factor
                        * (light.color * (light.weight * (1.0 - mx_fresnel_permittivity(light.cosine, scaled_ior))));
                }
                turn = vec2f(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        } else {
            var turn: vec2f = vec2f(1.0, 0.0);
            for (var i: i32 = 0; i < count; i++) {
                let light: mx_GgxLight = mx_ggx_transmitted(samples, ior, i, turn);
                let product_3: vec3f = light.color
                    * (light.weight * (1.0 - mx_fresnel_permittivity(light.cosine, scaled_ior)));
                if (refraction_film_visible) {
                    color += refraction_film_factor * product_3;
                }
                if (refraction_bare_weight > 0.0) {
                    color += refraction_bare_factor * product_3;
                }
                turn = vec2f(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        }
    }
    // lights: sheet_front, sheet_back, scatter, diffuse
    let subsurface_positive: vec3f = max(u_pub.SR_open_pbr_surface_subsurface_color, vec3f(0.0));
    let clamped_backward_share: f32 = clamp((1.0 - u_pub.SR_open_pbr_surface_subsurface_scatter_anisotropy) * 0.5, 0.0,
        1.0);
    let thin: f32 = f32(u_pub.SR_open_pbr_surface_geometry_thin_walled != 0u);
    let clamped_subsurface_weight: f32 = clamp(u_pub.SR_open_pbr_surface_subsurface_weight, 0.0, 1.0);
    let opaque_weight: f32 = (1.0 - metal_weight) * (1.0 - clamped_transmission_weight);
    let sheet_weight: f32 = thin * (clamped_subsurface_weight * opaque_weight);
    let sheet_front_product: vec3f = subsurface_positive * (body_weight * (clamped_backward_share * sheet_weight));
    let base_diffuse_roughness: f32 = u_pub.SR_open_pbr_surface_base_diffuse_roughness;
    let ab: vec2f = base_diffuse_roughness * base_diffuse_roughness * vec2f(-0.5, 0.45)
        / (base_diffuse_roughness * base_diffuse_roughness + vec2f(0.33, 0.09)) + vec2f(1.0, 0.0);
    let sheet_back_weight: f32 = sheet_weight * (1.0 - clamped_backward_share);
    let sheet_back_factor: vec3f = subsurface_positive * (body_weight * sheet_back_weight);
    let scatter_weight: f32 = clamped_subsurface_weight * opaque_weight * (1.0 - thin);
    let scatter_factor: vec3f = subsurface_positive * (body_weight * scatter_weight);
    let scatter_radius: vec3f = u_pub.SR_open_pbr_surface_subsurface_radius
        * u_pub.SR_open_pbr_surface_subsurface_radius_scale;
    let curvature: f32 = max(length(fwidth(Nf)) / max(length(fwidth(vd.positionWorld)), 1e-20), 0.01);
    let diffuse_weight: f32 = clamp(u_pub.SR_open_pbr_surface_base_weight, 0.0, 1.0)
        * (opaque_weight * (1.0 - clamped_subsurface_weight));
    let base_positive: vec3f = max(u_pub.SR_open_pbr_surface_base_color, vec3f(0.0));
    let diffuse_product: vec3f = base_positive * (body_weight * diffuse_weight);
    let diffuse_sum: f32 = base_diffuse_roughness * 0.28779334 + 1.0;
    let mean: f32 = (base_diffuse_roughness * 0.0724882 + 1.0) / diffuse_sum;
    let fujii_multiple: vec3f = base_positive * mean / (vec3f(1.0) - base_positive * max(1.0 - mean, 0.0));
    let diffuse_fujii_albedo: f32 = mx_fujii_albedo(cos_v, base_diffuse_roughness);
    let lost_v: f32 = max(1.0 - diffuse_fujii_albedo, 1e-8);
    let diffuse_lost: f32 = max(1.0 - mean, 1e-8);
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
                let spot_light_edge: f32 = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = select(0.0, falloff
                    * smoothstep(spot_light_edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light)),
                    light_type_ == 3);
            }
        }
        // sheet_front, sheet_back
        let light_color: vec3f = u_lightData[i].color;
        let cos_l: f32 = dot(Nf, L);
        let cos_l_2: f32 = max(cos_l, 1e-8);
        let s: f32 = dot(V, L) - cos_v * cos_l_2;
        let greater: f32 = max(cos_l_2, cos_v);
        let sheet_front_response: vec3f = sheet_front_product * 0.31830987
            * (cos_l_2 * (ab.x + ab.y * max(s, 0.0) / greater));
        color += light_color * (intensity
            * (sheet_front_response + sheet_back_factor * (max(-cos_l, 0.0) / 3.1415927)));
        // scatter
        if (scatter_weight > 0.0) {
            color += light_color * (intensity
                * (scatter_factor * mx_subsurface_light_2(scatter_radius, curvature, cos_l)));
        }
        // diffuse
        if (diffuse_weight > 0.0) {
            let diffuse_s: f32 = s / greater;
            let diffuse_product_2: vec3f = fujii_multiple
                * (lost_v * max(1.0 - mx_fujii_albedo(cos_l_2, base_diffuse_roughness), 1e-8) / diffuse_lost);
            color += light_color * (intensity
                * (diffuse_product * 0.31830987
                * (cos_l_2 * ((base_diffuse_roughness * select(s, diffuse_s, s > 0.0) + 1.0) / diffuse_sum
                + diffuse_product_2))));
        }
    }
    // environment: sheet_front, scatter
    let fit: vec2f = base_diffuse_roughness
        * (cos_v * vec2f(-0.7632, -0.4993) - vec2f(0.4297, 0.6076) + base_diffuse_roughness * vec2f(1.4385, 2.0315))
        + vec2f(1.0);
    let sheet_front_response: vec3f = sheet_front_product * part * (envLightIntensity * clamp(fit.x / fit.y, 0.0, 1.0));
    color += sheet_front_response + envLightIntensity * (scatter_factor * part);
    // environment: sheet_back
    if (sheet_back_weight > 0.0) {
        color += envLightIntensity * (sheet_back_factor
            * textureSampleLevel(u_envIrradiance, u_envIrradiance_sampler,
            mx_map_point(normalize(wgsl_mat3x3f_of_mat4x4f(u_prv.u_envMatrix) * -Nf)), 0.0).xyz);
    }
    // environment: diffuse
    if (diffuse_weight > 0.0) {
        color += envLightIntensity * (mix(mx_fujii_multiple(base_positive, mean), vec3f(1.0), diffuse_fujii_albedo)
            * (diffuse_product * part));
    }
    // opacity
    let opacity: f32 = clamp(u_pub.SR_open_pbr_surface_geometry_opacity, 0.0, 1.0);
    if (opacity < u_prv.u_alphaThreshold) {
        discard;
    }
    out1 = vec4f(opacity * color, opacity);
    return out1;
}
