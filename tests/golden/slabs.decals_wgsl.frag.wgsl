// wet_metal · slab_surface · mxgen 0.1 · wgsl · reduced · 3 closures · 0 textures

struct PrivateUniforms {
    u_worldMatrix: mat4x4f,
    u_worldInverseTransposeMatrix: mat4x4f,
    u_viewProjectionMatrix: mat4x4f,
    u_viewPosition: vec3f,
}
@group(0) @binding(0) var<uniform> u_prv: PrivateUniforms;
@group(1) @binding(0) var mx_words: texture_storage_2d_array<r32uint, write>;
@group(1) @binding(4) var mx_depth: texture_2d<f32>;
@group(1) @binding(13) var mx_decal_albedo: texture_2d<f32>;
@group(1) @binding(14) var mx_decal_f0: texture_2d<f32>;
@group(1) @binding(15) var mx_decal_normal: texture_2d<f32>;
@group(1) @binding(16) var mx_decal_roughness: texture_2d<f32>;
struct VertexData {
    @builtin(position) position: vec4f,
    @location(0) positionWorld: vec3f,
    @location(1) normalWorld: vec3f,
}
var<private> vd: VertexData;
struct PixelOutputs {
    @location(0) out1: vec4f,
    @location(1) word0: u32,
    @location(2) word1: u32,
    @location(3) word2: u32,
}
struct MxRecord {
    core: u32,
    body: u32,
    weights: array<u32, 2>,
    medium: u32,
    lobes: u32,
    fuzz: u32,
    anisotropy: u32,
    tint: u32,
    glints: array<u32, 4>,
    normal: u32,
}
struct MxClosure {
    diffuse_albedo: vec3f,
    f0: vec3f,
    f90: vec3f,
    roughness: f32,
    anisotropy: f32,
    normal: vec3f,
    tangent: vec3f,
    second_roughness: f32,
    second_roughness_weight: f32,
    fuzz_amount: f32,
    fuzz_color: vec3f,
    fuzz_roughness: f32,
    free_path: vec3f,
    phase_anisotropy: f32,
    is_thick: f32,
    glint_density: f32,
    glint_uv: vec2f,
    glint_extent: vec2f,
    tint_index: f32,
    tint_weight: f32,
    blur: f32,
    steady: vec3f,
    color: vec3f,
    decay: vec3f,
    spreads: f32,
}

fn wgsl_with_xy_vec3f(v: vec3f, parts: vec2f) -> vec3f
{
    return vec3f(parts.x, parts.y, v.z);
}

var<private> mx_noise: u32 = 4u;
var<private> mx_num_words: u32 = 0u;
var<private> mx_num_closures: u32 = 0u;
var<private> mx_pending: MxRecord;
var<private> mx_normals: array<vec3f, 3>;
var<private> mx_word2: u32;
var<private> mx_is_special: bool = false;
var<private> mx_word0: u32;
var<private> mx_word1: u32;

// Interleaved gradient noise of a pixel, from 0 to below 1 (Jimenez 2014, "Next Generation Post Processing in Call of
// Duty: Advanced Warfare").
fn mx_gradient_noise(pixel: vec2f) -> f32
{
    return fract(52.982918 * fract(dot(pixel, vec2f(0.06711056, 0.00583715))));
}

// Chooses the noise of a pixel, before its numbers are cut.
fn mx_start_noise(pixel: vec2f)
{
    mx_noise = u32(8.0 * mx_gradient_noise(pixel));
}

// The place of a direction in the octahedral square (Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors").
fn mx_octahedral(n: vec3f) -> vec2f
{
    let p: vec2f = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    let folded: vec2f = (1.0 - abs(p.yx)) * vec2f(select(1.0, -1.0, p.x < 0.0), select(1.0, -1.0, p.y < 0.0));
    return select(p, folded, n.z < 0.0) * 0.5 + 0.5;
}

// A direction in so many bits for each axis of the octahedral square.
fn mx_cut_normal(normal: vec3f, bits: u32) -> u32
{
    let p: vec2u = vec2u(round(mx_octahedral(normal) * f32((1u << bits) - 1u)));
    return p.x | (p.y << bits);
}

// A number from 0 to 1 in eighths of the steps of its bits. Noise has no middle, so its mean is right half an eighth
// further.
fn mx_eighths(value: f32, bits: u32) -> u32
{
    return u32(clamp(value, 0.0, 1.0) * 8.0 * f32((1u << bits) - 1u) + 0.5);
}

// The noise of a channel. Channels differ by 5 eighths, near the golden ratio.
fn mx_noise_of(channel: u32) -> u32
{
    return (mx_noise + 5u * channel) & 7u;
}

// A number from 0 to 1 in so many bits. Each channel has noise of its own.
fn mx_cut(value: f32, bits: u32, channel: u32) -> u32
{
    return (mx_eighths(value, bits) + mx_noise_of(channel)) >> 3u;
}

// The third word of a pixel: normal and roughness of the closure on top.
fn mx_top(normal: vec3f, roughness: f32) -> u32
{
    return mx_cut_normal(normal, 12u) | (mx_cut(roughness, 8u, 3u) << 24u);
}

fn mx_words_store(at: vec3i, value: vec4u)
{
    textureStore(mx_words, at.xy, at.z, value);
}

// Writes the next word behind the targets.
fn mx_put(word: u32)
{
    let kept: u32 = mx_num_words;
    mx_num_words += 1u;
    mx_words_store(vec3i(vec2i(vd.position.xy), i32(kept)), vec4u(word));
}

// The features of a closure.
fn mx_features(core: u32) -> u32
{
    return (core >> 20u) & select(255u, 1023u, ((core >> 20u) & 1024u) != 0u);
}

// Writes the words that follow the first two of a closure.
fn mx_put_features(r: MxRecord)
{
    let has: u32 = mx_features(r.core);
    if ((has & 1u) != 0u) {
        mx_put(r.weights[0]);
        mx_put(r.weights[1]);
    }
    if ((has & 2u) != 0u) {
        mx_put(r.medium);
    }
    if ((has & 4u) != 0u) {
        mx_put(r.lobes);
    }
    if ((has & 8u) != 0u) {
        mx_put(r.fuzz);
    }
    if ((has & 16u) != 0u) {
        mx_put(r.anisotropy);
    }
    if ((has & 256u) != 0u) {
        mx_put(r.tint);
    }
    if ((has & 512u) != 0u) {
        for (var i: i32 = 0; i < 4; i++) {
            mx_put(r.glints[i]);
        }
    }
    if (((has >> 6u) & 3u) == 1u) {
        mx_put(r.normal);
    }
}

// Writes the pending closure, below which another one lies.
fn mx_flush()
{
    let is_smooth: bool = mx_num_closures == 1u && (mx_pending.body & 1048575u) == 0u;
    mx_put((mx_pending.core | select(0u, 33554432u, is_smooth)));
    if (!is_smooth) {
        mx_put(mx_pending.body);
    }
    mx_put_features(mx_pending);
}

// The number of a normal, and its word where it needs one.
fn mx_number_normal(normal: vec3f, word: ptr<function, u32>) -> u32
{
    for (var i: u32 = 0u; i < 3u; i += 1u) {
        if (all(normal == mx_normals[i])) {
            return select(i + 1u, 0u, i == 0u);
        }
    }
    mx_normals[2] = mx_normals[1];
    mx_normals[1] = normal;
    (*word) = mx_cut_normal(normal, 16u);
    return 1u;
}

// A colour in 7, 7 and 6 bits. Ten bits hold the eighths of a channel, so that one addition dithers all three.
fn mx_cut_color(color: vec3f) -> u32
{
    var eighths: u32 = mx_eighths(color.x, 7u) | (mx_eighths(color.y, 7u) << 10u) | (mx_eighths(color.z, 6u) << 20u);
    eighths += mx_noise_of(0u) | (mx_noise_of(1u) << 10u) | (mx_noise_of(2u) << 20u);
    return ((eighths >> 3u) & 127u) | (((eighths >> 13u) & 127u) << 7u) | (((eighths >> 23u) & 63u) << 14u);
}

// A number from -1 to 1 in so many bits. 0 has none of them.
fn mx_cut_signed(value: f32, bits: u32) -> u32
{
    let most: f32 = f32((1u << (bits - 1u)) - 1u);
    return u32(i32(round(clamp(value, -1.0, 1.0) * most))) & ((1u << bits) - 1u);
}

// The word of a medium: free path, anisotropy of its phase function, and whether it is a body. 0 for opaque matter.
fn mx_medium_word(c: MxClosure) -> u32
{
    if (max(c.free_path.x, max(c.free_path.y, c.free_path.z)) <= 0.0
        || max(c.diffuse_albedo.x, max(c.diffuse_albedo.y, c.diffuse_albedo.z)) <= 0.0) {
        return 0u;
    }
    return max(mx_cut_color(c.free_path / (1.0 + c.free_path)), 1u) | (mx_cut_signed(c.phase_anisotropy, 6u) << 20u)
        | select(0u, 67108864u, c.is_thick > 0.0);
}

// The word of the lobes: the second roughness with its weight, and the hue of f90.
fn mx_lobes_word(c: MxClosure) -> u32
{
    let weight: u32 = mx_cut(c.second_roughness_weight, 6u, 4u);
    let roughness: u32 = select(mx_cut(c.second_roughness, 8u, 5u), 0u, weight == 0u);
    let hue: vec3f = max(c.f90, vec3f(0.0)) / max(max(c.f90.x, max(c.f90.y, c.f90.z)), 1e-6);
    return roughness | (weight << 8u) | (mx_cut(1.0 - hue.x, 6u, 6u) << 14u) | (mx_cut(1.0 - hue.y, 6u, 7u) << 20u)
        | (mx_cut(1.0 - hue.z, 6u, 8u) << 26u);
}

// A colour in the encoding of IEC 61966-2-1.
fn mx_srgb(linear: vec3f) -> vec3f
{
    let c: vec3f = clamp(linear, vec3f(0.0), vec3f(1.0));
    return select(1.055 * pow(c, vec3f(0.41666666)) - 0.055, 12.92 * c, c < vec3f(0.0031308));
}

// The word of fuzz: amount, colour and roughness. 0 without fuzz.
fn mx_fuzz_word(c: MxClosure) -> u32
{
    let amount: u32 = mx_cut(c.fuzz_amount, 6u, 9u);
    return select(amount | (mx_cut_color(mx_srgb(c.fuzz_color)) << 6u) | (mx_cut(c.fuzz_roughness, 6u, 10u) << 26u), 0u,
        amount == 0u);
}

// Two axes across a normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
fn mx_across(n: vec3f, x: ptr<function, vec3f>, y: ptr<function, vec3f>)
{
    let side: f32 = select(1.0, -1.0, n.z < 0.0);
    let a: f32 = -1.0 / (side + n.z);
    let b: f32 = n.x * n.y * a;
    (*x) = vec3f(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    (*y) = vec3f(b, side + n.y * n.y * a, -n.y);
}

// The word of the anisotropy: amount and tangent, as an angle from the first axis across the normal, below half a turn:
// both its directions are one.
fn mx_anisotropy_word(c: MxClosure, normal: vec3f) -> u32
{
    let amount: u32 = mx_cut_signed(c.anisotropy, 16u);
    var x: vec3f;
    var y: vec3f;
    mx_across(normal, &x, &y);
    let turn: f32 = atan2(dot(c.tangent, y), dot(c.tangent, x)) / 3.1415927;
    return select((u32(round(fract(turn) * 65536.0)) & 65535u) | (amount << 16u), 0u, amount == 0u);
}

// The word of a tint: the number of its table, and how much it tints.
fn mx_tint_word(c: MxClosure) -> u32
{
    let weight: u32 = mx_cut(c.tint_weight, 8u, 11u);
    return select((u32(c.tint_index) & 65535u) | (weight << 16u), 0u, weight == 0u);
}

// The words of glints. Facets need exact places and slopes, so they are not dithered: coordinates; logarithms of the
// extents and of the number; whole turn of the tangent, roughness, what 12 bits of the normal leave, in sixteenths of
// their steps.
fn mx_glint_words(c: MxClosure, normal: vec3f) -> array<u32, 4>
{
    let extent: vec2f = clamp((log2(max(c.glint_extent, vec2f(1e-12))) + 24.0) / 32.0, vec2f(0.0), vec2f(1.0));
    var x: vec3f;
    var y: vec3f;
    mx_across(normal, &x, &y);
    let turn: f32 = atan2(dot(c.tangent, y), dot(c.tangent, x)) / 6.2831855;
    let rest: vec2i = vec2i(round(clamp((mx_octahedral(c.normal) - mx_octahedral(normal)) * 65520.0, vec2f(-8.0),
        vec2f(7.0)))) & vec2i(15);
    return array<u32, 4>(bitcast<u32>(c.glint_uv.x), bitcast<u32>(c.glint_uv.y),
        (u32(round(extent.x * 1023.0)) | (u32(round(extent.y * 1023.0)) << 10u)
        | (max(u32(round(clamp(c.glint_density / 32.0, 0.0, 1.0) * 4095.0)), 1u) << 20u)),
        ((u32(round(fract(turn) * 4096.0)) & 4095u) | (u32(round(clamp(c.roughness, 0.0, 1.0) * 4095.0)) << 12u)
        | (u32(rest.x) << 24u) | (u32(rest.y) << 28u)));
}

// The first word of a closure, without its features: the roots of f0.
fn mx_core(c: MxClosure) -> u32
{
    return mx_cut_color(sqrt(clamp(c.f0, vec3f(0.0), vec3f(1.0))));
}

// The second word of a closure: diffuse albedo and roughness.
fn mx_body(c: MxClosure) -> u32
{
    return mx_cut_color(mx_srgb(c.diffuse_albedo)) | (mx_cut(c.roughness, 8u, 3u) << 20u);
}

// All words of a closure but its normal, which the caller chooses. stored_normal: as it will be read.
fn mx_pack(c: MxClosure, stored_normal: vec3f) -> MxRecord
{
    var r: MxRecord;
    let steady: u32 = mx_cut_color(1.0 - c.steady);
    let color: u32 = mx_cut_color(c.color);
    let decay: u32 = select(mx_cut_color(c.decay), 0u, color == 0u);
    r.weights[0] = steady | (color << 20u);
    r.weights[1] = (color >> 12u) | (decay << 8u) | select(0u, 268435456u, decay != 0u && c.spreads > 0.0);
    r.medium = mx_medium_word(c);
    r.lobes = mx_lobes_word(c);
    r.fuzz = mx_fuzz_word(c);
    r.anisotropy = mx_anisotropy_word(c, stored_normal);
    r.tint = mx_tint_word(c);
    r.normal = 0u;
    let has_glints: bool = c.glint_density > 0.0 && max(c.glint_extent.x, c.glint_extent.y) > 0.0;
    r.glints = array<u32, 4>(0u, 0u, 0u, 0u);
    if (has_glints) {
        r.glints = mx_glint_words(c, stored_normal);
    }
    let has: u32 = select(0u, 1u, (r.weights[0] | r.weights[1]) != 0u) | select(0u, 2u, r.medium != 0u)
        | select(0u, 4u, r.lobes != 0u) | select(0u, 8u, r.fuzz != 0u) | select(0u, 16u, r.anisotropy != 0u)
        | select(0u, 1280u, r.tint != 0u) | select(0u, 1536u, has_glints);
    r.core = mx_core(c) | (has << 20u);
    r.body = mx_body(c);
    return r;
}

// A direction from its place in the octahedral square.
fn mx_of_octahedral(square: vec2f) -> vec3f
{
    let p: vec2f = square * 2.0 - 1.0;
    var n: vec3f = vec3f(p, 1.0 - abs(p.x) - abs(p.y));
    let fold: f32 = max(-n.z, 0.0);
    n = wgsl_with_xy_vec3f(n, n.xy + vec2f(select(-fold, fold, n.x < 0.0), select(-fold, fold, n.y < 0.0)));
    return normalize(n);
}

// A number from 0 to 1 from its bits of a word.
fn mx_uncut(word: u32, shift: u32, bits: u32) -> f32
{
    return f32((word >> shift) & ((1u << bits) - 1u)) / f32((1u << bits) - 1u);
}

// A direction from its bits.
fn mx_uncut_normal(word: u32, bits: u32) -> vec3f
{
    return mx_of_octahedral(vec2f(mx_uncut(word, 0u, bits), mx_uncut(word, bits, bits)));
}

// The normal of the closure on top.
fn mx_top_normal(word: u32) -> vec3f
{
    return mx_uncut_normal((word & 16777215u), 12u);
}

// The class of a pixel by its first word.
fn mx_class(first: u32) -> u32
{
    return select(first >> 28u, 4u, ((first >> 20u) & 1024u) != 0u);
}

// The last closure of all keeps its words in `mx_pending`.
fn mx_keep(c: MxClosure)
{
    if (mx_num_closures == 0u) {
        mx_start_noise(vd.position.xy);
        mx_normals = array<vec3f, 3>(c.normal, vec3f(0.0), vec3f(0.0));
        mx_word2 = mx_top(c.normal, c.roughness);
    } else {
        mx_flush();
    }
    var normal_word: u32 = 0u;
    let number: u32 = mx_number_normal(c.normal, &normal_word);
    mx_pending = mx_pack(c, select(mx_uncut_normal(mx_cut_normal(c.normal, 16u), 16u), mx_top_normal(mx_word2),
        number == 0u));
    mx_pending.normal = normal_word;
    mx_pending.core |= number << 26u;
    mx_is_special = mx_is_special || mx_class(mx_pending.core) == 4u;
    mx_num_closures += 1u;
}

// Keeps a slab unless nothing of it is seen. Returns how many closures there are.
fn mx_store(before: i32, c: MxClosure) -> i32
{
    let light: vec3f = c.steady + c.color;
    if (max(light.x, max(light.y, light.z)) <= 0.0) {
        return before;
    }
    mx_keep(c);
    return before + 1;
}

// A material calls it for each slab, from the top down.
fn mx_store_closure(before: i32, diffuse_albedo: vec3f, f0: vec3f, f90: vec3f, roughness: f32, anisotropy: f32,
    normal: vec3f, tangent: vec3f, second_roughness: f32, second_roughness_weight: f32, fuzz_amount: f32,
    fuzz_color: vec3f, fuzz_roughness: f32, free_path: vec3f, phase_anisotropy: f32, is_thick: f32, glint_density: f32,
    glint_uv: vec2f, glint_extent: vec2f, tint_index: f32, tint_weight: f32, blur: f32, steady: vec3f, color: vec3f,
    decay: vec3f, spreads: f32) -> i32
{
    var c: MxClosure;
    c.diffuse_albedo = diffuse_albedo;
    c.f0 = f0;
    c.f90 = f90;
    c.roughness = roughness;
    c.anisotropy = anisotropy;
    c.normal = normal;
    c.tangent = tangent;
    c.second_roughness = second_roughness;
    c.second_roughness_weight = second_roughness_weight;
    c.fuzz_amount = fuzz_amount;
    c.fuzz_color = fuzz_color;
    c.fuzz_roughness = fuzz_roughness;
    c.free_path = free_path;
    c.phase_anisotropy = phase_anisotropy;
    c.is_thick = is_thick;
    c.glint_density = glint_density;
    c.glint_uv = glint_uv;
    c.glint_extent = glint_extent;
    c.tint_index = tint_index;
    c.tint_weight = tint_weight;
    c.blur = blur;
    c.steady = steady;
    c.color = color;
    c.decay = decay;
    c.spreads = spreads;
    return mx_store(before, c);
}

// The class of a pixel or ray with one closure that has these features.
fn mx_class_of(has: u32) -> u32
{
    if ((has & 1024u) != 0u) {
        return 4u;
    }
    return u32(select(select(1, 2, has != 0u), 3, (has & 17u) != 0u));
}

// Writes the last closure, and the words of the targets, from the number of closures that are stored.
fn mx_finish_closures(stored: i32) -> i32
{
    mx_word0 = 0u;
    mx_word1 = 0u;
    if (stored == 0) {
        return 0;
    }
    let class_: u32 = select(select(mx_class_of(mx_features(mx_pending.core)), 3u, stored > 1), 4u, mx_is_special);
    mx_put_features(mx_pending);
    mx_word0 = mx_pending.core | (class_ << 28u);
    mx_word1 = mx_pending.body | (u32(stored - 1) << 28u);
    return stored;
}

// A word of the targets, after the closures.
fn mx_stored_word(finished: i32, index: i32) -> u32
{
    return select(select(mx_word2, mx_word1, index == 1), mx_word0, index == 0);
}

fn mx_decal_albedo_fetch(at: vec2i, level: i32) -> vec4f
{
    return textureLoad(mx_decal_albedo, at, level);
}

fn mx_decal_f0_fetch(at: vec2i, level: i32) -> vec4f
{
    return textureLoad(mx_decal_f0, at, level);
}

fn mx_decal_normal_fetch(at: vec2i, level: i32) -> vec4f
{
    return textureLoad(mx_decal_normal, at, level);
}

fn mx_decal_roughness_fetch(at: vec2i, level: i32) -> vec4f
{
    return textureLoad(mx_decal_roughness, at, level);
}

// The value that decals put at this pixel, and in w the part of the base that they leave.
fn mx_decal(image: i32) -> vec4f
{
    let pixel: vec2i = vec2i(vd.position.xy);
    if (image == 0) {
        return mx_decal_albedo_fetch(pixel, 0);
    }
    if (image == 1) {
        return mx_decal_f0_fetch(pixel, 0);
    }
    if (image == 2) {
        return mx_decal_normal_fetch(pixel, 0);
    }
    return mx_decal_roughness_fetch(pixel, 0);
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

// Light that the layer of a medium reflects and lets through (`transmitted`), with all orders of scattering, on a way:
// a is the albedo of one scattering, t the optical depth (after Kubelka and Munk 1931).
// Here a = vec3f(0.990589, 0.99790716, 0.99950534), t = vec3f(0.2).
fn mx_medium_layer(way: f32, transmitted: ptr<function, vec3f>) -> vec3f
{
    let x: f32 = way - 1.0;
    let s: vec3f = vec3f(0.49529448, 0.49895358, 0.49975267) * way
        * (1.0 + 0.16666666 * (vec3f(0.043278337, 0.052829146, 0.054919362)
        + x * vec3f(-0.18317366, -0.19314766, -0.19532585)));
    let k: vec3f = vec3f(0.009411037, 0.0020928383, 0.000494659) * way
        * (1.0 + vec3f(0.16509815, 0.16631785, 0.16658421)
        * (vec3f(1.3360909, 1.3377652, 1.3381231) + x * vec3f(-1.792952, -1.8079973, -1.8112832)
        + vec3f(0.0739174, 0.07612604, 0.07661489)));
    let g: vec3f = sqrt(k * (k + 2.0 * s));
    let e: vec3f = exp(-g * 0.2);
    let ways: vec3f = mix((1.0 - e * e) / max(g, vec3f(1e-6)), 0.4 * (1.0 - g * 0.2), step(g * 0.2, vec3f(0.001)));
    let below: vec3f = (k + s) * ways + 1.0 + e * e;
    (*transmitted) = 2.0 * e / below;
    return s * ways / below;
}

@fragment
fn main(vd_in: VertexData) -> PixelOutputs
{
    vd = vd_in;
    if (textureLoad(mx_depth, vec2i(vd.position.xy), 0).x != vd.position.z) {
        discard;
    }
    var out1: vec4f;
    var word0: u32;
    var word1: u32;
    var word2: u32;
    var stored: i32 = 0;
    let N: vec3f = normalize(vd.normalWorld);
    stored = mx_store_closure(stored, vec3f(0.0), vec3f(0.04), vec3f(1.0), 0.1, 0.0, N, vec3f(0.0), 0.5, 0.0, 0.0,
        vec3f(1.0), 0.1, vec3f(19.999998, 30.0, 39.999996), 0.0, 0.0, 0.0, vec2f(0.0), vec2f(0.0), 0.0, 0.0, 0.0,
        vec3f(0.5), vec3f(0.0), vec3f(0.0), 0.0);
    // metal
    let c: f32 = dot(N, normalize(u_prv.u_viewPosition - vd.positionWorld));
    let view_cosine: f32 = max(abs(c), 1e-8);
    // coat
    let coat_reflection_albedo: vec2f = mx_ggx_albedo_fit(0.01, view_cosine);
    let coat_reflection_ggx_compensation: f32 = (1.0 / coat_reflection_albedo.x - 1.0) * 0.08571428 + 1.0;
    let coat_reflection_throughput: f32 = max(1.0
        - mix(0.04, 1.0, coat_reflection_albedo.y) * coat_reflection_albedo.x * coat_reflection_ggx_compensation, 0.0);
    // milk
    let way: f32 = inverseSqrt(c * c + 1.25) * 1.5;
    let coat_medium_throughput: vec3f = exp(way * vec3f(-0.05, -0.033333335, -0.025));
    let drops_throughput: vec3f = mix(vec3f(1.0), coat_reflection_throughput * coat_medium_throughput, 0.5);
    let coat_medium_throughput_2: vec3f = coat_medium_throughput * vec3f(0.9512294, 0.967216, 0.9753099);
    let drops_throughput_2: vec3f = mix(vec3f(1.0), coat_reflection_throughput * coat_medium_throughput_2, 0.5);
    let drops_throughput_3: vec3f = mix(vec3f(1.0),
        coat_reflection_throughput * (coat_medium_throughput_2 * vec3f(0.9512294, 0.967216, 0.9753099)), 0.5);
    let milk_mark_decay: vec3f = clamp((drops_throughput_2 - drops_throughput_3)
        / max(drops_throughput - drops_throughput_2, vec3f(1e-6)), vec3f(0.0), vec3f(0.999));
    let decaying: vec3f = (drops_throughput - drops_throughput_2) / (vec3f(1.0) - milk_mark_decay);
    stored = mx_store_closure(stored, vec3f(0.8, 0.9, 0.95), vec3f(0.04), vec3f(1.0), 0.5007194, 0.0, N, vec3f(0.0),
        0.5, 0.0, 0.0, vec3f(1.0), 0.5007194, vec3f(5.0), 0.0, 0.0, 0.0, vec2f(0.0), vec2f(0.0), 0.0, 0.0, 0.0,
        drops_throughput - decaying, decaying, milk_mark_decay, 0.0);
    let decal: vec4f = mx_decal(0);
    let metal_decal_over: vec3f = decal.w * vec3f(0.700394, 0.2554791, 0.0776317) + decal.xyz;
    let f0_decal: vec4f = mx_decal(1);
    let metal_decal_over_2: vec3f = f0_decal.w * vec3f(0.66622823, 0.46274176, 0.24108408) + f0_decal.xyz;
    let roughness_decal: vec4f = mx_decal(3);
    let metal_decal_over_3: f32 = roughness_decal.w * 0.54668933 + roughness_decal.x;
    let normal_decal: vec4f = mx_decal(2);
    let metal_direction: vec3f = normalize(N * (normal_decal.w + 1e-6) + normal_decal.xyz * 2.0
        - (1.0 - normal_decal.w));
    let decal_normal: vec3f = select(metal_direction, N, normal_decal.w >= 1.0);
    let milk_reflection_albedo: vec2f = mx_ggx_albedo_fit(0.25071993, view_cosine);
    let milk_reflection_ggx_compensation: f32 = (1.0 / milk_reflection_albedo.x - 1.0) * 0.08571428 + 1.0;
    let milk_reflection_throughput: f32 = max(1.0
        - mix(0.04, 1.0, milk_reflection_albedo.y) * milk_reflection_albedo.x * milk_reflection_ggx_compensation, 0.0);
    var milk_medium_transmitted: vec3f;
    let milk_medium: vec3f = mx_medium_layer(way, &milk_medium_transmitted);
    let metal_reflection_albedo: vec2f = mx_ggx_albedo_fit(0.29886922, view_cosine);
    let metal_reflection_ggx_compensation: vec3f = (1.0 / metal_reflection_albedo.x - 1.0)
        * vec3f(0.6821221, 0.48832548, 0.27722293) + vec3f(1.0);
    let slab_reflection_bsdf_albedo: vec3f = mix(vec3f(0.66622823, 0.46274176, 0.24108408), vec3f(1.0),
        metal_reflection_albedo.y) * metal_reflection_albedo.x * metal_reflection_ggx_compensation;
    let milk_medium_throughput: vec3f = milk_medium_transmitted
        / (vec3f(1.0) - min((slab_reflection_bsdf_albedo
        + max(vec3f(1.0) - slab_reflection_bsdf_albedo, vec3f(0.0)) * vec3f(0.700394, 0.2554791, 0.0776317))
        * vec3f(0.10193972, 0.102937125, 0.103155464), vec3f(0.999)));
    let milky_metal_weight: vec3f = milk_reflection_throughput * milk_medium_throughput * drops_throughput;
    let milk_medium_throughput_2: vec3f = milk_medium_throughput * vec3f(0.9081714, 0.9090508, 0.9092436);
    let milky_metal_weight_2: vec3f = milk_reflection_throughput * milk_medium_throughput_2 * drops_throughput_2;
    let difference: vec3f = milky_metal_weight_2
        - milk_reflection_throughput * (milk_medium_throughput_2 * vec3f(0.9081714, 0.9090508, 0.9092436))
        * drops_throughput_3;
    let metal_decay: vec3f = clamp(difference / max(milky_metal_weight - milky_metal_weight_2, vec3f(1e-6)), vec3f(0.0),
        vec3f(0.999));
    let decaying_2: vec3f = (milky_metal_weight - milky_metal_weight_2) / (vec3f(1.0) - metal_decay);
    stored = mx_store_closure(stored, metal_decal_over, metal_decal_over_2, vec3f(1.0), metal_decal_over_3, 0.0,
        decal_normal, vec3f(0.0), 0.5, 0.0, 0.0, vec3f(1.0), 0.54668933, vec3f(0.0), 0.0, 0.0, 0.0, vec2f(0.0),
        vec2f(0.0), 0.0, 0.0, 0.0, milky_metal_weight - decaying_2, decaying_2, metal_decay, 0.0);
    stored = mx_finish_closures(stored);
    out1 = vec4f(decal.w * ((decaying + (drops_throughput - decaying)) * vec3f(0.0, 0.1, 0.0)), 1.0);
    word0 = mx_stored_word(stored, 0);
    word1 = mx_stored_word(stored, 1);
    word2 = mx_stored_word(stored, 2);
    return PixelOutputs(out1, word0, word1, word2);
}
