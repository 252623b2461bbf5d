// standard_surface · surfacematerial · mxgen 0.1 · wgsl · complete · 9 closures · 0 textures

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
    SR_standard_surface_base: f32,
    SR_standard_surface_base_color: vec3f,
    SR_standard_surface_diffuse_roughness: f32,
    SR_standard_surface_metalness: f32,
    SR_standard_surface_specular: f32,
    SR_standard_surface_specular_color: vec3f,
    SR_standard_surface_specular_roughness: f32,
    SR_standard_surface_specular_IOR: f32,
    SR_standard_surface_specular_anisotropy: f32,
    SR_standard_surface_specular_rotation: f32,
    SR_standard_surface_transmission: f32,
    SR_standard_surface_transmission_color: vec3f,
    SR_standard_surface_transmission_extra_roughness: f32,
    SR_standard_surface_subsurface: f32,
    SR_standard_surface_subsurface_color: vec3f,
    SR_standard_surface_subsurface_radius: vec3f,
    SR_standard_surface_subsurface_scale: f32,
    SR_standard_surface_sheen: f32,
    SR_standard_surface_sheen_color: vec3f,
    SR_standard_surface_sheen_roughness: f32,
    SR_standard_surface_coat: f32,
    SR_standard_surface_coat_color: vec3f,
    SR_standard_surface_coat_roughness: f32,
    SR_standard_surface_coat_anisotropy: f32,
    SR_standard_surface_coat_rotation: f32,
    SR_standard_surface_coat_IOR: f32,
    SR_standard_surface_coat_affect_color: f32,
    SR_standard_surface_coat_affect_roughness: f32,
    SR_standard_surface_thin_film_thickness: f32,
    SR_standard_surface_thin_film_IOR: f32,
    SR_standard_surface_emission: f32,
    SR_standard_surface_emission_color: vec3f,
    SR_standard_surface_opacity: vec3f,
    SR_standard_surface_thin_walled: u32,
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

// Reflectance of a dielectric that faces the viewer.
fn mx_fresnel_dielectric_facing(ior: f32) -> f32
{
    let r: f32 = (1.0 - ior) / (1.0 + ior);
    return r * r;
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
fn mx_film_index_facing(re: vec3f, im: vec3f, film: f32, film_ior: f32) -> vec3f
{
    let ior: f32 = max(film_ior, 1.0);
    let a: f32 = (1.0 - ior) / (1.0 + ior);
    let d: f32 = 0.012566372 * ior * film;
    var xyz: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < 4; i++) {
        let channel: i32 = max(i - 1, 0);
        xyz[channel] += mx_film_light(a,
            mx_film_amplitude(vec2f(1.0, 0.0),
            mx_fresnel_refract(1.0, re[channel] / (ior * ior), im[channel] / (ior * ior))), d, i);
    }
    return clamp(mat3x3f(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * xyz, vec3f(0.0), vec3f(1.0));
}

// Reflectance, facing the viewer, of an interface.
// Here model = "dielectric", k = vec3f(0.0).
fn mx_fresnel_facing(n: vec3f, film: f32, film_ior: f32) -> vec3f
{
    if (film > 0.0) {
        return mx_film_index_facing(n * n, vec3f(0.0), film, film_ior);
    }
    return vec3f(mx_fresnel_dielectric_facing(n.x));
}

// Squared roughness along X and across: the aspect ratio stretches one axis and shrinks the other (Burley 2012, section
// 5.4).
fn mx_roughness_anisotropy(roughness: f32, anisotropy: f32) -> vec2f
{
    let squared: f32 = clamp(roughness * roughness, 1e-8, 1.0);
    let aspect: f32 = sqrt(1.0 - clamp(anisotropy, 0.0, 0.98));
    return vec2f(min(squared / aspect, 1.0), squared * aspect);
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

// Index and extinction of a conductor with this reflectivity facing the viewer, and this colour at the edge
// (Gulbrandsen 2014, "Artist Friendly Metallic Fresnel").
fn mx_artistic_ior(reflectivity: vec3f, edge_color: vec3f, ior: ptr<function, vec3f>, extinction: ptr<function, vec3f>)
{
    let s: vec3f = sqrt(clamp(reflectivity, vec3f(0.0), vec3f(0.99)));
    let greatest: vec3f = (1.0 + s) / (1.0 - s);
    (*ior) = mix(greatest, (1.0 - s * s) / (1.0 + s * s), edge_color);
    (*extinction) = sqrt(max((greatest - (*ior)) * ((*ior) - 1.0 / greatest), vec3f(0.0)));
}

// Unpolarised reflectance of an interface with the permittivity re + i im, with c for the cosine and u + iv for the
// index times the cosine behind (Born and Wolf 1999, "Principles of Optics", section 14.4):
//     F = (P + P Q) / 2,  P = (a - g) / (a + g),  Q = (b - g s) / (b + g s)
//     a = |u + iv|^2 + c^2,  g = 2uc,  s = 1 - c^2,  b = |u + iv|^2 c^2 + s^2
fn mx_fresnel_conductor(cosine: f32, re: f32, im: f32) -> f32
{
    let c2: f32 = cosine * cosine;
    let s: f32 = 1.0 - c2;
    let t: f32 = re - s;
    let norm: f32 = sqrt(t * t + im * im);
    let g: f32 = cosine * sqrt(max(2.0 * (norm + t), 0.0));
    let b: f32 = norm * c2 + s * s;
    let a: f32 = norm + c2;
    return (a - g) * b / ((a + g) * (b + g * s));
}

// Unpolarised reflectance of a conductor with the permittivity re + i im of each channel.
fn mx_fresnel_conductor_2(cosine: f32, re: vec3f, im: vec3f) -> vec3f
{
    var color: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < 3; i++) {
        color[i] = mx_fresnel_conductor(cosine, re[i], im[i]);
    }
    return color;
}

// Reflectance, facing the viewer, of an interface.
// Here model = "conductor".
fn mx_fresnel_facing_2(n: vec3f, k: vec3f, film: f32, film_ior: f32) -> vec3f
{
    if (film > 0.0) {
        return mx_film_index_facing(n, k, film, film_ior);
    }
    return mx_fresnel_conductor_2(1.0, n, k);
}

// Amplitudes of a film's own interface, of perpendicular and parallel light; `inside` is the cosine in the film.
fn mx_film_amplitudes(cosine: f32, inside: f32, ior: f32) -> vec2f
{
    let x: vec2f = vec2f(cosine, ior * cosine);
    let u: vec2f = vec2f(ior * inside, inside);
    return (x - u) / (x + u);
}

// Reflectance of a film on an interface with the permittivity re + i im.
fn mx_film_index(cosine: f32, re: vec3f, im: vec3f, film: f32, film_ior: f32) -> vec3f
{
    let ior: f32 = max(film_ior, 1.0);
    let c: f32 = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    let a: vec2f = mx_film_amplitudes(cosine, c, ior);
    let d: f32 = 0.012566372 * ior * c * film;
    var xyz: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < 4; i++) {
        let channel: i32 = max(i - 1, 0);
        let below: vec2f = vec2f(re[channel], im[channel]) / (ior * ior);
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
// Here model = "conductor", f90 = vec3f(1.0), exponent = 0.0.
fn mx_fresnel(cosine: f32, n: vec3f, k: vec3f, film: f32, film_ior: f32) -> vec3f
{
    if (film > 0.0) {
        return mx_film_index(cosine, n, k, film, film_ior);
    }
    return mx_fresnel_conductor_2(cosine, n, k);
}

// Reflectance of an interface at a cosine.
// Here model = "dielectric", k = vec3f(0.0), f90 = vec3f(1.0), exponent = 0.0.
fn mx_fresnel_2(cosine: f32, n: vec3f, film: f32, film_ior: f32) -> vec3f
{
    if (film > 0.0) {
        return mx_film_index(cosine, n * n, vec3f(0.0), film, film_ior);
    }
    return vec3f(mx_fresnel_permittivity(cosine, n.x * n.x));
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

@fragment
fn main(vd: VertexData) -> @location(0) vec4f
{
    var out1: vec4f;
    // SR_standard_surface
    let coat_weight: f32 = clamp(u_pub.SR_standard_surface_coat, 0.0, 1.0);
    let coat_IOR: f32 = u_pub.SR_standard_surface_coat_IOR;
    let coat_front: f32 = coat_IOR * 4.0 / ((coat_IOR + 1.0) * (coat_IOR + 1.0));
    let N: vec3f = normalize(vd.normalWorld);
    let V: vec3f = normalize(u_prv.u_viewPosition - vd.positionWorld);
    let absolute: f32 = abs(dot(N, V));
    var color: vec3f = u_pub.SR_standard_surface_emission
        * (u_pub.SR_standard_surface_emission_color
        * (1.0 - coat_weight + u_pub.SR_standard_surface_coat_color
        * (coat_weight * (coat_front * (1.0 - pow(1.0 - min(absolute, 1.0), 5.0))))));
    // lights
    let vector_coat_gamma: vec3f = vec3f(u_pub.SR_standard_surface_coat_affect_color * coat_weight + 1.0);
    let specular_IOR: f32 = u_pub.SR_standard_surface_specular_IOR;
    let thin_film_thickness: f32 = u_pub.SR_standard_surface_thin_film_thickness;
    let thin_film_IOR: f32 = u_pub.SR_standard_surface_thin_film_IOR;
    let coat_blur: f32 = u_pub.SR_standard_surface_coat_roughness
        * (u_pub.SR_standard_surface_coat * u_pub.SR_standard_surface_coat_affect_roughness);
    let roughness: vec2f = mx_roughness_anisotropy(mix(u_pub.SR_standard_surface_specular_roughness, 1.0, coat_blur),
        u_pub.SR_standard_surface_specular_anisotropy);
    let alpha: vec2f = clamp(roughness, vec2f(1e-8), vec2f(1.0));
    let cos_v: f32 = max(absolute, 1e-8);
    let albedo: vec2f = mx_ggx_albedo_fit(sqrt(alpha.x * alpha.y), cos_v);
    let lost: f32 = 1.0 / albedo.x - 1.0;
    let reflection_scale: vec3f = mix(mx_fresnel_facing(vec3f(specular_IOR), thin_film_thickness, thin_film_IOR),
        vec3f(1.0), 0.04761905) * lost + vec3f(1.0);
    let reflection_weight: f32 = clamp(u_pub.SR_standard_surface_specular, 0.0, 1.0);
    let reflection_r: f32 = (1.0 - specular_IOR) / (specular_IOR + 1.0);
    let clamped_coat_tint: vec3f = clamp(mix(vec3f(1.0), u_pub.SR_standard_surface_coat_color,
        u_pub.SR_standard_surface_coat), vec3f(0.0), vec3f(1.0));
    let coating_r: f32 = (1.0 - coat_IOR) / (coat_IOR + 1.0);
    let coat_lobe: vec2f = mx_roughness_anisotropy(u_pub.SR_standard_surface_coat_roughness,
        u_pub.SR_standard_surface_coat_anisotropy);
    let coating_alpha: vec2f = clamp(coat_lobe, vec2f(1e-8), vec2f(1.0));
    let coating_albedo: vec2f = mx_ggx_albedo_fit(sqrt(coating_alpha.x * coating_alpha.y), cos_v);
    let coating_scale: f32 = mix(coating_r * coating_r, 1.0, 0.04761905) * (1.0 / coating_albedo.x - 1.0) + 1.0;
    let coating_throughput: f32 = 1.0 - coat_weight
        * (mix(coating_r * coating_r, 1.0, coating_albedo.y) * coating_albedo.x * coating_scale);
    let body_weight: vec3f = (vec3f(1.0)
        - reflection_scale * (reflection_weight * (mix(reflection_r * reflection_r, 1.0, albedo.y) * albedo.x)))
        * (clamped_coat_tint * coating_throughput);
    let fuzz_weight: f32 = clamp(u_pub.SR_standard_surface_sheen, 0.0, 1.0);
    let sheen_albedo: f32 = clamp(mx_bicubic(mat4x4f(3.7341, -15.9587, 23.621, -11.0989, -8.2265, 35.1081, -49.7137,
        23.2945, 4.0691, -17.882, 25.6639, -12.0167, -0.5833, 2.6552, -3.9393, 1.8999), 1.0 / (cos_v + 1.0),
        1.0 / (u_pub.SR_standard_surface_sheen_roughness + 0.2)), 0.0, 1.0);
    let fuzz_throughput: f32 = 1.0 - fuzz_weight * sheen_albedo;
    let metal_weight: f32 = clamp(u_pub.SR_standard_surface_metalness, 0.0, 1.0);
    let clamped_transmission: f32 = clamp(u_pub.SR_standard_surface_transmission, 0.0, 1.0);
    let opaque_weight: f32 = (1.0 - metal_weight) * (1.0 - clamped_transmission);
    let clamped_subsurface: f32 = clamp(u_pub.SR_standard_surface_subsurface, 0.0, 1.0);
    let diffuse_weight: vec3f = body_weight
        * (fuzz_throughput * (clamp(u_pub.SR_standard_surface_base, 0.0, 1.0)
        * (opaque_weight * (1.0 - clamped_subsurface))));
    let diffuse_product: vec3f = pow(max(u_pub.SR_standard_surface_base_color, vec3f(0.0)), vector_coat_gamma)
        * diffuse_weight;
    let Nf: vec3f = faceForward(N, -V, N);
    let r2: f32 = u_pub.SR_standard_surface_diffuse_roughness * u_pub.SR_standard_surface_diffuse_roughness;
    let ab: vec2f = r2 * vec2f(-0.5, 0.45) / (r2 + vec2f(0.33, 0.09)) + vec2f(1.0, 0.0);
    let s: f32 = 1.0 / max(u_pub.SR_standard_surface_sheen_roughness, 0.005);
    let fuzz_factor: vec3f = u_pub.SR_standard_surface_sheen_color * (body_weight * (fuzz_weight * opaque_weight));
    let scatter_color: vec3f = pow(max(u_pub.SR_standard_surface_subsurface_color, vec3f(0.0)), vector_coat_gamma);
    let thin: f32 = f32(u_pub.SR_standard_surface_thin_walled != 0u);
    let translucent_weight: f32 = thin * (clamped_subsurface * opaque_weight);
    let translucent_factor: vec3f = scatter_color * (body_weight * (fuzz_throughput * translucent_weight));
    let tangent_direction: vec3f = normalize(vd.tangentWorld);
    let coat_tangent: vec3f = mx_rotate3d(tangent_direction, radians(u_pub.SR_standard_surface_coat_rotation * 360.0),
        N);
    let coating_lobe: mx_GgxLobe = mx_ggx_lobe(coat_lobe, N, coat_tangent, V);
    var metal_ior: vec3f;
    var metal_extinction: vec3f;
    mx_artistic_ior(u_pub.SR_standard_surface_base * u_pub.SR_standard_surface_base_color,
        u_pub.SR_standard_surface_specular * u_pub.SR_standard_surface_specular_color, &metal_ior, &metal_extinction);
    let re: vec3f = metal_ior * metal_ior - metal_extinction * metal_extinction;
    let im: vec3f = metal_extinction * (metal_ior * 2.0);
    let metal_scale: vec3f = lost * mix(mx_fresnel_facing_2(re, im, thin_film_thickness, thin_film_IOR), vec3f(1.0),
        0.04761905) + vec3f(1.0);
    let metal_factor: vec3f = metal_scale * (clamped_coat_tint * (metal_weight * coating_throughput));
    let specular_tangent: vec3f = mx_rotate3d(tangent_direction,
        radians(u_pub.SR_standard_surface_specular_rotation * 360.0), N);
    let lobe: mx_GgxLobe = mx_ggx_lobe(roughness, N, specular_tangent, V);
    let reflection_weight_2: f32 = reflection_weight * (1.0 - metal_weight);
    let reflection_factor: vec3f = clamped_coat_tint * (coating_throughput * reflection_weight_2)
        * (reflection_scale * max(u_pub.SR_standard_surface_specular_color, vec3f(0.0)));
    let scatter_weight: f32 = clamped_subsurface * opaque_weight * (1.0 - thin);
    let scatter_radius: vec3f = u_pub.SR_standard_surface_subsurface_radius
        * u_pub.SR_standard_surface_subsurface_scale;
    let curvature: f32 = max(length(fwidth(Nf)) / max(length(fwidth(vd.positionWorld)), 1e-20), 0.01);
    let scatter_factor: vec3f = scatter_color * (body_weight * (fuzz_throughput * scatter_weight));
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
        // fuzz, translucent, diffuse
        let light_color: vec3f = u_lightData[i].color;
        let cos_l: f32 = dot(L, Nf);
        let cos_l_2: f32 = max(cos_l, 1e-8);
        let v_dot_l: f32 = dot(V, L);
        let diffuse_response: vec3f = diffuse_product * 0.31830987
            * (cos_l_2 * (ab.x + ab.y * max(v_dot_l - cos_v * cos_l_2, 0.0) / max(cos_l_2, cos_v)));
        let scaled_along: f32 = (cos_v + cos_l) * (cos_v + cos_l);
        let fuzz_product: f32 = cos_l_2 * ((s + 2.0)
            * pow(clamp(1.0 - scaled_along / max(v_dot_l * 2.0 + 2.0, 1e-8), 0.0, 1.0), s * 0.5) / 6.2831855);
        let fuzz_response: vec3f = fuzz_product / ((cos_v + cos_l_2 - cos_v * cos_l_2) * 4.0) * fuzz_factor;
        color += light_color * (intensity
            * (diffuse_response + (fuzz_response + max(-cos_l, 0.0) / 3.1415927 * translucent_factor)));
        // coating
        let half_cosine: f32 = sqrt(clamp(v_dot_l * 0.5 + 0.500001, 0.0, 1.0));
        if (coat_weight > 0.0) {
            let coating_product: f32 = mx_fresnel_permittivity(half_cosine, coat_IOR * coat_IOR)
                * (coat_weight * coating_scale);
            color += light_color * (intensity * (mx_ggx_light(coating_lobe, V, L) * coating_product));
        }
        // metal
        let ggx_light: f32 = mx_ggx_light(lobe, V, L);
        if (metal_weight > 0.0) {
            color += light_color * (intensity
                * (metal_factor * (mx_fresnel(half_cosine, re, im, thin_film_thickness, thin_film_IOR) * ggx_light)));
        }
        // reflection
        if (reflection_weight_2 > 0.0) {
            color += light_color * (intensity
                * (reflection_factor * (ggx_light
                * mx_fresnel_2(half_cosine, vec3f(specular_IOR), thin_film_thickness, thin_film_IOR))));
        }
        // scatter
        if (scatter_weight > 0.0) {
            color += light_color * (intensity
                * (mx_subsurface_light_2(scatter_radius, curvature, cos_l) * scatter_factor));
        }
    }
    // environment: fuzz, scatter, diffuse
    let part: vec3f = textureSampleLevel(u_envIrradiance, u_envIrradiance_sampler,
        mx_map_point(normalize(wgsl_mat3x3f_of_mat4x4f(u_prv.u_envMatrix) * Nf)), 0.0).xyz;
    let fit: vec2f = u_pub.SR_standard_surface_diffuse_roughness
        * (cos_v * vec2f(-0.7632, -0.4993) - vec2f(0.4297, 0.6076)
        + u_pub.SR_standard_surface_diffuse_roughness * vec2f(1.4385, 2.0315)) + vec2f(1.0);
    let diffuse_response: vec3f = diffuse_product * part * (u_prv.u_envLightIntensity * clamp(fit.x / fit.y, 0.0, 1.0));
    let fuzz_response: vec3f = fuzz_factor * part * (sheen_albedo * u_prv.u_envLightIntensity);
    color += diffuse_response + (fuzz_response + u_prv.u_envLightIntensity * (scatter_factor * part));
    // environment: translucent
    if (translucent_weight > 0.0) {
        color += u_prv.u_envLightIntensity
            * (translucent_factor * textureSampleLevel(u_envIrradiance, u_envIrradiance_sampler,
            mx_map_point(normalize(wgsl_mat3x3f_of_mat4x4f(u_prv.u_envMatrix) * -Nf)), 0.0).xyz);
    }
    // environment: coating
    if (coat_weight > 0.0) {
        var turn: vec2f = vec2f(1.0, 0.0);
        let coating_count: i32 = mx_sample_count(coating_alpha);
        let coating_ggx_samples: mx_GgxSamples = mx_ggx_samples(coat_lobe, coating_count, N, coat_tangent, V);
        for (var i: i32 = 0; i < coating_count; i++) {
            let coating_light: mx_GgxLight = mx_ggx_reflected(coating_ggx_samples, i, turn);
            let fresnel_bare: f32 = mx_fresnel_permittivity(coating_light.cosine, coat_IOR * coat_IOR);
            color += coating_light.color * (fresnel_bare * (coat_weight * coating_scale * coating_light.weight));
            turn = vec2f(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // environment: metal, reflection
    let scaled_specular_IOR: f32 = specular_IOR * specular_IOR;
    if (metal_weight > 0.0 || reflection_weight_2 > 0.0) {
        let count: i32 = mx_sample_count(alpha);
        let ggx_samples: mx_GgxSamples = mx_ggx_samples(roughness, count, N, specular_tangent, V);
        if (thin_film_thickness > 0.0) {
            var turn: vec2f = vec2f(1.0, 0.0);
            for (var i: i32 = 0; i < count; i++) {
                let light: mx_GgxLight = mx_ggx_reflected(ggx_samples, i, turn);
                if (metal_weight > 0.0) {
                    color += metal_factor
                        * (light.color * (light.weight
                        * mx_film_index(light.cosine, re, im, thin_film_thickness, thin_film_IOR)));
                }
                if (reflection_weight_2 > 0.0) {
                    color += reflection_factor
                        * (light.color * (light.weight
                        * mx_film_index(light.cosine, vec3f(scaled_specular_IOR), vec3f(0.0), thin_film_thickness,
                        thin_film_IOR)));
                }
                turn = vec2f(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        } else {
            var turn: vec2f = vec2f(1.0, 0.0);
            for (var i: i32 = 0; i < count; i++) {
                let light: mx_GgxLight = mx_ggx_reflected(ggx_samples, i, turn);
                if (metal_weight > 0.0) {
                    color += metal_factor
                        * (light.color * (light.weight * mx_fresnel_conductor_2(light.cosine, re, im)));
                }
                if (reflection_weight_2 > 0.0) {
                    color += reflection_factor
                        * (light.color * (light.weight * mx_fresnel_permittivity(light.cosine, scaled_specular_IOR)));
                }
                turn = vec2f(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        }
    }
    // environment: refraction
    let refraction_weight: f32 = clamped_transmission * (1.0 - metal_weight);
    if (refraction_weight > 0.0) {
        var turn: vec2f = vec2f(1.0, 0.0);
        let transmission_blurred: f32 = mix(clamp(u_pub.SR_standard_surface_specular_roughness
            + u_pub.SR_standard_surface_transmission_extra_roughness, 0.0, 1.0), 1.0, coat_blur);
        let transmission_roughness: vec2f = mx_roughness_anisotropy(transmission_blurred,
            u_pub.SR_standard_surface_specular_anisotropy);
        let refraction_count: i32 = mx_sample_count(clamp(transmission_roughness, vec2f(1e-8), vec2f(1.0)));
        let tint: vec3f = max(u_pub.SR_standard_surface_transmission_color, vec3f(0.0));
        let refraction_factor: vec3f = tint * select(vec3f(1.0), tint, u_prv.u_refractionTwoSided != 0u)
            * (body_weight * refraction_weight);
        let samples: mx_GgxSamples = mx_ggx_samples(transmission_roughness, refraction_count, N, specular_tangent, V);
        for (var i: i32 = 0; i < refraction_count; i++) {
            let refraction_light: mx_GgxLight = mx_ggx_transmitted(samples, specular_IOR, i, turn);
            color += refraction_factor * (refraction_light.color
                * (refraction_light.weight
                * (1.0 - mx_fresnel_permittivity(refraction_light.cosine, scaled_specular_IOR))));
            turn = vec2f(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // opacity
    let opacity: f32 = clamp(dot(u_pub.SR_standard_surface_opacity, vec3f(0.2722287, 0.6740818, 0.0536895)), 0.0, 1.0);
    if (opacity < u_prv.u_alphaThreshold) {
        discard;
    }
    out1 = vec4f(opacity * color, opacity);
    return out1;
}
