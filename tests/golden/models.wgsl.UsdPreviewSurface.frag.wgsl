// UsdPreviewSurface · surfacematerial · mxgen 0.1 · wgsl · complete · 6 closures · 0 textures

struct mx_GgxLobe {
    N: vec3f,
    cosine: f32,
    x: vec3f,
    alpha: vec2f,
    masking: f32,
}
struct mx_GgxLight {
    color: vec3f,
    weight: f32,
    cosine: f32,
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
struct PublicUniforms {
    SR_UsdPreviewSurface_diffuseColor: vec3f,
    SR_UsdPreviewSurface_emissiveColor: vec3f,
    SR_UsdPreviewSurface_useSpecularWorkflow: i32,
    SR_UsdPreviewSurface_specularColor: vec3f,
    SR_UsdPreviewSurface_metallic: f32,
    SR_UsdPreviewSurface_roughness: f32,
    SR_UsdPreviewSurface_clearcoat: f32,
    SR_UsdPreviewSurface_clearcoatRoughness: f32,
    SR_UsdPreviewSurface_opacity: f32,
    SR_UsdPreviewSurface_opacityMode: i32,
    SR_UsdPreviewSurface_opacityThreshold: f32,
    SR_UsdPreviewSurface_ior: f32,
    SR_UsdPreviewSurface_normal: vec3f,
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
    @location(3) bitangentWorld: vec3f,
}

fn wgsl_mat3x3f_of_mat4x4f(m: mat4x4f) -> mat3x3f
{
    return mat3x3f(m[0].xyz, m[1].xyz, m[2].xyz);
}

// A texel of zeros is a missing map, and means the normal itself.
// Here scale = vec2f(1.0).
fn mx_normalmap(texel: vec3f, normal: vec3f, tangent: vec3f, bitangent: vec3f) -> vec3f
{
    let n: vec3f = select(texel * 2.0 - 1.0, vec3f(0.0, 0.0, 1.0), dot(texel, texel) == 0.0);
    return normalize(tangent * n.x + bitangent * n.y + normal * n.z);
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

// Schlick's curve from f0 to f90 at a cosine, less `bend` times cos (1 - cos)^6.
// Here bend = vec3f(0.0), exponent = 5.0.
fn mx_fresnel_schlick(cosine: f32, f0: vec3f, f90: vec3f) -> vec3f
{
    let x: f32 = 1.0 - cosine;
    return mix(f0, f90, x * x * x * x * x);
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

// The light that comes through a smooth solid sphere of index `ior`.
fn mx_transmitted(ior: f32, N: vec3f, V: vec3f) -> mx_GgxLight
{
    return mx_GgxLight(textureSampleLevel(u_envRadiance, u_envRadiance_sampler,
        mx_map_point(normalize(wgsl_mat3x3f_of_mat4x4f(u_prv.u_envMatrix)
        * reflect(V, refract(-V, faceForward(N, -V, N), 1.0 / ior)))), 0.0).xyz * u_prv.u_envLightIntensity, 1.0,
        max(abs(dot(N, V)), 1e-8));
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

// The number of samples, from 1, that a lobe takes; roughness is that along two directions, squared.
fn mx_sample_count(roughness: vec2f) -> i32
{
    let wide: f32 = max(roughness.x, roughness.y);
    var share: f32 = 0.5 * min(4.0 * sqrt(wide), 1.0);
    share = min(share * wide / min(roughness.x, roughness.y), 1.0);
    return max(i32(ceil(share * f32(u_prv.u_envRadianceSamples))), 1);
}

// cos (1 + 2 Lambda) of a direction for GGX; `area` is the product of the roughness along x and y (Heitz 2014,
// "Understanding the Masking-Shadowing Function", equation 72).
fn mx_ggx_masking(cosine: f32, area: f32) -> f32
{
    return sqrt(area + (1.0 - area) * (cosine * cosine));
}

// The GGX lobe of a surface as lights see it; roughness is that along X and across, squared.
// Here is_round = true.
fn mx_ggx_lobe(roughness: vec2f, N: vec3f, V: vec3f) -> mx_GgxLobe
{
    let alpha: vec2f = clamp(roughness, vec2f(1e-8), vec2f(1.0));
    let cosine: f32 = max(abs(dot(N, V)), 1e-8);
    return mx_GgxLobe(faceForward(N, -V, N), cosine, vec3f(0.0), alpha, mx_ggx_masking(cosine, alpha.x * alpha.y));
}

// The GGX lobe of a surface as samples of the environment see it.
// Here is_round = true.
fn mx_ggx_samples(roughness: vec2f, count: i32, N: vec3f, V: vec3f) -> mx_GgxSamples
{
    let lobe: mx_GgxLobe = mx_ggx_lobe(roughness, N, V);
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

@fragment
fn main(vd: VertexData) -> @location(0) vec4f
{
    var out1: vec4f;
    var color: vec3f = u_pub.SR_UsdPreviewSurface_emissiveColor;
    // lights
    // SR_UsdPreviewSurface
    let shading_normal: vec3f = mx_normalmap(u_pub.SR_UsdPreviewSurface_normal * 0.5 + vec3f(0.5),
        normalize(vd.normalWorld), normalize(vd.tangentWorld), normalize(vd.bitangentWorld));
    let V: vec3f = normalize(u_prv.u_viewPosition - vd.positionWorld);
    let facing: vec3f = faceForward(shading_normal, -V, shading_normal);
    let diffuseColor: vec3f = u_pub.SR_UsdPreviewSurface_diffuseColor;
    let coating_weight: f32 = clamp(u_pub.SR_UsdPreviewSurface_clearcoat, 0.0, 1.0);
    let ior: f32 = u_pub.SR_UsdPreviewSurface_ior;
    let amplitude: f32 = (1.0 - ior) / (ior + 1.0);
    let coating_fresnel_f0: f32 = max(amplitude * amplitude, 0.0);
    let coat_roughness: f32 = clamp(u_pub.SR_UsdPreviewSurface_clearcoatRoughness
        * u_pub.SR_UsdPreviewSurface_clearcoatRoughness, 1e-8, 1.0);
    let cos_v: f32 = max(abs(dot(shading_normal, V)), 1e-8);
    let coating_albedo: vec2f = mx_ggx_albedo_fit(coat_roughness, cos_v);
    let coating_scale: f32 = mix(coating_fresnel_f0, 1.0, 0.04761905) * (1.0 / coating_albedo.x - 1.0) + 1.0;
    let coating_throughput: f32 = 1.0 - coating_weight
        * (mix(coating_fresnel_f0, 1.0, coating_albedo.y) * coating_albedo.x * coating_scale);
    let is_equal_useSpecularWorkflow: bool = u_pub.SR_UsdPreviewSurface_useSpecularWorkflow == 1;
    let grazing_metallic: vec3f = mix(vec3f(1.0), diffuseColor, u_pub.SR_UsdPreviewSurface_metallic);
    let reflection_fresnel_f0: vec3f = max(select(mix(amplitude * amplitude * grazing_metallic, grazing_metallic,
        u_pub.SR_UsdPreviewSurface_metallic), u_pub.SR_UsdPreviewSurface_specularColor, is_equal_useSpecularWorkflow),
        vec3f(0.0));
    let f90: vec3f = max(select(grazing_metallic, vec3f(1.0), is_equal_useSpecularWorkflow), vec3f(0.0));
    let specular_roughness: f32 = clamp(u_pub.SR_UsdPreviewSurface_roughness * u_pub.SR_UsdPreviewSurface_roughness,
        1e-8, 1.0);
    let albedo: vec2f = mx_ggx_albedo_fit(specular_roughness, cos_v);
    let lost: f32 = 1.0 / albedo.x - 1.0;
    let reflection_scale: vec3f = mix(reflection_fresnel_f0, f90, 0.04761905) * lost + vec3f(1.0);
    let body_weight: f32 = coating_throughput
        * (1.0 - dot(mix(reflection_fresnel_f0, f90, albedo.y) * albedo.x * reflection_scale, vec3f(0.33333334)));
    let metal_weight: f32 = select(u_pub.SR_UsdPreviewSurface_metallic, 0.0, is_equal_useSpecularWorkflow);
    let opaque_transparent: f32 = select(u_pub.SR_UsdPreviewSurface_opacity, 1.0,
        u_pub.SR_UsdPreviewSurface_opacityThreshold > 0.0);
    let clamped_opaque_weight: f32 = clamp(select(select(0.0, 1.0, 2 > u_pub.SR_UsdPreviewSurface_opacityMode),
        opaque_transparent, 1 > u_pub.SR_UsdPreviewSurface_opacityMode), 0.0, 1.0);
    let substrate_metal_weight: f32 = clamp(metal_weight, 0.0, 1.0);
    let diffuse_weight: f32 = clamp(1.0 - metal_weight, 0.0, 1.0)
        * (clamped_opaque_weight * (1.0 - substrate_metal_weight));
    let diffuse_factor: vec3f = diffuseColor * (body_weight * diffuse_weight * 0.31830987);
    let coating_ggx_masking: f32 = sqrt(coat_roughness * coat_roughness
        + (1.0 - coat_roughness * coat_roughness) * (cos_v * cos_v));
    let coating_ggx_lobe: mx_GgxLobe = mx_GgxLobe(facing, cos_v, vec3f(0.0), vec2f(coat_roughness),
        coating_ggx_masking);
    var metal_ior: vec3f;
    var metal_extinction: vec3f;
    mx_artistic_ior(diffuseColor, diffuseColor, &metal_ior, &metal_extinction);
    let re: vec3f = metal_ior * metal_ior - metal_extinction * metal_extinction;
    let im: vec3f = metal_extinction * (metal_ior * 2.0);
    let metal_factor: vec3f = (lost * mix(mx_fresnel_conductor_2(1.0, re, im), vec3f(1.0), 0.04761905) + vec3f(1.0))
        * (substrate_metal_weight * coating_throughput);
    let ggx_masking: f32 = sqrt(specular_roughness * specular_roughness
        + cos_v * cos_v * (1.0 - specular_roughness * specular_roughness));
    let ggx_lobe: mx_GgxLobe = mx_GgxLobe(facing, cos_v, vec3f(0.0), vec2f(specular_roughness), ggx_masking);
    let reflection_visible: bool = 1.0 - substrate_metal_weight > 0.0;
    let reflection_factor: vec3f = reflection_scale * (coating_throughput * (1.0 - substrate_metal_weight));
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
        color += light_color * (intensity * (max(dot(L, facing), 1e-8) * diffuse_factor));
        // coating
        let half_cosine: f32 = sqrt(clamp(dot(V, L) * 0.5 + 0.500001, 0.0, 1.0));
        if (coating_weight > 0.0) {
            let coating_product: f32 = mx_ggx_light(coating_ggx_lobe, V, L) * (coating_weight * coating_scale);
            color += light_color * (intensity
                * (mx_fresnel_schlick(half_cosine, vec3f(coating_fresnel_f0), vec3f(1.0)) * coating_product));
        }
        // metal
        let ggx_light: f32 = mx_ggx_light(ggx_lobe, V, L);
        if (substrate_metal_weight > 0.0) {
            color += light_color * (intensity
                * (metal_factor * (mx_fresnel_conductor_2(half_cosine, re, im) * ggx_light)));
        }
        // reflection
        if (reflection_visible) {
            color += light_color * (intensity
                * (reflection_factor * (ggx_light * mx_fresnel_schlick(half_cosine, reflection_fresnel_f0, f90))));
        }
    }
    // environment: diffuse
    if (diffuse_weight > 0.0) {
        let diffuse_product: vec3f = diffuseColor
            * textureSampleLevel(u_envIrradiance, u_envIrradiance_sampler,
            mx_map_point(normalize(wgsl_mat3x3f_of_mat4x4f(u_prv.u_envMatrix) * facing)), 0.0).xyz;
        color += diffuse_product * (body_weight * diffuse_weight * u_prv.u_envLightIntensity);
    }
    // environment: refraction
    let refraction_weight: f32 = (1.0 - substrate_metal_weight) * (1.0 - clamped_opaque_weight);
    if (refraction_weight > 0.0) {
        let refraction_light: mx_GgxLight = mx_transmitted(ior, shading_normal, V);
        color += refraction_light.color * (refraction_light.weight
            * (1.0 - mx_fresnel_permittivity(refraction_light.cosine, ior * ior)) * (body_weight * refraction_weight));
    }
    // environment: coating
    if (coating_weight > 0.0) {
        var turn: vec2f = vec2f(1.0, 0.0);
        let coating_count: i32 = mx_sample_count(vec2f(coat_roughness));
        let coating_ggx_samples: mx_GgxSamples = mx_ggx_samples(vec2f(coat_roughness), coating_count, shading_normal,
            V);
        for (var i: i32 = 0; i < coating_count; i++) {
            let coating_light: mx_GgxLight = mx_ggx_reflected(coating_ggx_samples, i, turn);
            let fresnel_bare: vec3f = mx_fresnel_schlick(coating_light.cosine, vec3f(coating_fresnel_f0), vec3f(1.0));
            color += coating_light.color * (fresnel_bare * (coating_weight * coating_scale * coating_light.weight));
            turn = vec2f(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // environment: metal, reflection
    if (substrate_metal_weight > 0.0 || reflection_visible) {
        var turn: vec2f = vec2f(1.0, 0.0);
        let count: i32 = mx_sample_count(vec2f(specular_roughness));
        let ggx_samples: mx_GgxSamples = mx_ggx_samples(vec2f(specular_roughness), count, shading_normal, V);
        for (var i: i32 = 0; i < count; i++) {
            let light: mx_GgxLight = mx_ggx_reflected(ggx_samples, i, turn);
            if (substrate_metal_weight > 0.0) {
                color += metal_factor * (light.color * (light.weight * mx_fresnel_conductor_2(light.cosine, re, im)));
            }
            if (reflection_visible) {
                color += reflection_factor
                    * (light.color * (light.weight * mx_fresnel_schlick(light.cosine, reflection_fresnel_f0, f90)));
            }
            turn = vec2f(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // opacity
    let mask: f32 = select(0.0, 1.0, u_pub.SR_UsdPreviewSurface_opacity >= u_pub.SR_UsdPreviewSurface_opacityThreshold);
    let coverage_choice: f32 = select(0.0,
        select(u_pub.SR_UsdPreviewSurface_opacity, mask, u_pub.SR_UsdPreviewSurface_opacityThreshold > 0.0),
        2 > u_pub.SR_UsdPreviewSurface_opacityMode);
    let opacity: f32 = clamp(select(coverage_choice, mask, 1 > u_pub.SR_UsdPreviewSurface_opacityMode), 0.0, 1.0);
    if (opacity < u_prv.u_alphaThreshold) {
        discard;
    }
    out1 = vec4f(opacity * color, opacity);
    return out1;
}
