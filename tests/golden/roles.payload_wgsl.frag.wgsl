// Cup · surfacematerial · mxgen 0.1 · wgsl · reduced · 1 closure · 0 textures

struct VertexData {
    normalWorld: vec3f,
}
var<private> vd: VertexData;
struct Surface {
    word_0: u32,
    word_1: u32,
    word_2: u32,
    word_3: u32,
    word_4: u32,
    word_5: u32,
    word_6: u32,
    word_7: u32,
    word_8: u32,
    word_9: u32,
    word_10: u32,
    word_11: u32,
    word_12: u32,
    word_13: u32,
    word_14: u32,
    word_15: u32,
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

fn wgsl_with_xy_vec3f(v: vec3f, parts: vec2f) -> vec3f
{
    return vec3f(parts.x, parts.y, v.z);
}

var<private> mx_payload_words: array<u32, 16>;

// The class of a pixel by its first word.
fn mx_class(first: u32) -> u32
{
    return select(first >> 28u, 4u, ((first >> 20u) & 1024u) != 0u);
}

// The features of a closure.
fn mx_features(core: u32) -> u32
{
    return (core >> 20u) & select(255u, 1023u, ((core >> 20u) & 1024u) != 0u);
}

// Interleaved gradient noise of a pixel, from 0 to below 1 (Jimenez 2014, "Next Generation Post Processing in Call of
// Duty: Advanced Warfare").
fn mx_gradient_noise(pixel: vec2f) -> f32
{
    return fract(52.982918 * fract(dot(pixel, vec2f(0.06711056, 0.00583715))));
}

// The nearest of the numbers from 0 to 1 that so many bits have, alike in all channels.
fn mx_cut(value: f32, bits: u32, channel: u32) -> u32
{
    return u32(clamp(value, 0.0, 1.0) * f32((1u << bits) - 1u) + 0.5);
}

// A colour in 7, 7 and 6 bits.
fn mx_cut_color(color: vec3f) -> u32
{
    return mx_cut(color.x, 7u, 0u) | (mx_cut(color.y, 7u, 1u) << 7u) | (mx_cut(color.z, 6u, 2u) << 14u);
}

// A number from 0 to 1 from its bits of a word.
fn mx_uncut(word: u32, shift: u32, bits: u32) -> f32
{
    return f32((word >> shift) & ((1u << bits) - 1u)) / f32((1u << bits) - 1u);
}

// A colour from its 20 bits.
fn mx_uncut_color(word: u32) -> vec3f
{
    return vec3f(mx_uncut(word, 0u, 7u), mx_uncut(word, 7u, 7u), mx_uncut(word, 14u, 6u));
}

// A number from -1 to 1 in so many bits. 0 has none of them.
fn mx_cut_signed(value: f32, bits: u32) -> u32
{
    let most: f32 = f32((1u << (bits - 1u)) - 1u);
    return u32(i32(round(clamp(value, -1.0, 1.0) * most))) & ((1u << bits) - 1u);
}

// A number from -1 to 1 from its bits of a word.
fn mx_uncut_signed(word: u32, shift: u32, bits: u32) -> f32
{
    let most: f32 = f32((1u << (bits - 1u)) - 1u);
    return f32(i32(word << (32u - bits - shift)) >> u32(i32(32u - bits))) / most;
}

// A colour in the encoding of IEC 61966-2-1.
fn mx_srgb(linear: vec3f) -> vec3f
{
    let c: vec3f = clamp(linear, vec3f(0.0), vec3f(1.0));
    return select(1.055 * pow(c, vec3f(0.41666666)) - 0.055, 12.92 * c, c < vec3f(0.0031308));
}

// A colour from its encoding of IEC 61966-2-1.
fn mx_linear(srgb: vec3f) -> vec3f
{
    return select(pow((srgb + 0.055) / 1.055, vec3f(2.4)), srgb / 12.92, srgb < vec3f(0.04045));
}

// The place of a direction in the octahedral square (Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors").
fn mx_octahedral(n: vec3f) -> vec2f
{
    let p: vec2f = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    let folded: vec2f = (1.0 - abs(p.yx)) * vec2f(select(1.0, -1.0, p.x < 0.0), select(1.0, -1.0, p.y < 0.0));
    return select(p, folded, n.z < 0.0) * 0.5 + 0.5;
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

// A direction in so many bits for each axis of the octahedral square.
fn mx_cut_normal(normal: vec3f, bits: u32) -> u32
{
    let p: vec2u = vec2u(round(mx_octahedral(normal) * f32((1u << bits) - 1u)));
    return p.x | (p.y << bits);
}

// A direction from its bits.
fn mx_uncut_normal(word: u32, bits: u32) -> vec3f
{
    return mx_of_octahedral(vec2f(mx_uncut(word, 0u, bits), mx_uncut(word, bits, bits)));
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

// The third word of a pixel: normal and roughness of the closure on top.
fn mx_top(normal: vec3f, roughness: f32) -> u32
{
    return mx_cut_normal(normal, 12u) | (mx_cut(roughness, 8u, 3u) << 24u);
}

// The normal of the closure on top.
fn mx_top_normal(word: u32) -> vec3f
{
    return mx_uncut_normal((word & 16777215u), 12u);
}

// The roughness of the closure on top.
fn mx_top_roughness(word: u32) -> f32
{
    return mx_uncut(word, 24u, 8u);
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

// The word of fuzz: amount, colour and roughness. 0 without fuzz.
fn mx_fuzz_word(c: MxClosure) -> u32
{
    let amount: u32 = mx_cut(c.fuzz_amount, 6u, 9u);
    return select(amount | (mx_cut_color(mx_srgb(c.fuzz_color)) << 6u) | (mx_cut(c.fuzz_roughness, 6u, 10u) << 26u), 0u,
        amount == 0u);
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

// The three bits of a blur: 0 for none, else its logarithm, in seven steps up to a half.
fn mx_blur_bits(blur: f32) -> u32
{
    let steps: f32 = clamp(log2(max(blur, 1e-12)) + 8.0, 0.0, 7.0);
    return mx_cut(steps / 7.0, 3u, 12u);
}

// The blur from its three bits.
fn mx_blur_of(bits: u32) -> f32
{
    return select(exp2(f32(bits) - 8.0), 0.0, bits == 0u);
}

// The class of a pixel or ray with one closure that has these features.
fn mx_class_of(has: u32) -> u32
{
    if ((has & 1024u) != 0u) {
        return 4u;
    }
    return u32(select(select(1, 2, has != 0u), 3, (has & 17u) != 0u));
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

// A closure from its words, with the normal and roughness that other words have.
fn mx_unpack(r: MxRecord, normal: vec3f, roughness: f32) -> MxClosure
{
    var c: MxClosure;
    let root: vec3f = mx_uncut_color(r.core);
    c.f0 = root * root;
    c.diffuse_albedo = mx_linear(mx_uncut_color(r.body));
    c.normal = normal;
    c.f90 = 1.0 - vec3f(mx_uncut(r.lobes, 14u, 6u), mx_uncut(r.lobes, 20u, 6u), mx_uncut(r.lobes, 26u, 6u));
    c.second_roughness = mx_uncut(r.lobes, 0u, 8u);
    c.second_roughness_weight = mx_uncut(r.lobes, 8u, 6u);
    c.fuzz_amount = mx_uncut(r.fuzz, 0u, 6u);
    c.fuzz_color = mx_linear(mx_uncut_color(r.fuzz >> 6u));
    c.fuzz_roughness = mx_uncut(r.fuzz, 26u, 6u);
    let part: vec3f = mx_uncut_color(r.medium);
    c.free_path = part / max(1.0 - part, vec3f(1e-6));
    c.phase_anisotropy = mx_uncut_signed(r.medium, 20u, 6u);
    c.is_thick = f32((r.medium >> 26u) & 1u);
    c.anisotropy = mx_uncut_signed(r.anisotropy, 16u, 16u);
    var x: vec3f;
    var y: vec3f;
    mx_across(normal, &x, &y);
    let has_glints: bool = r.glints[2] != 0u;
    let turn: f32 = select(f32(r.anisotropy & 65535u) / 65536.0 * 3.1415927,
        f32(r.glints[3] & 4095u) / 4096.0 * 6.2831855, has_glints);
    c.roughness = select(roughness, mx_uncut(r.glints[3], 12u, 12u), has_glints);
    let rest: vec2i = vec2i(i32(r.glints[3] << 4u) >> u32(28), i32(r.glints[3]) >> u32(28));
    if (has_glints) {
        c.normal = mx_of_octahedral(mx_octahedral(normal) + vec2f(rest) / 65520.0);
    }
    c.glint_density = mx_uncut(r.glints[2], 20u, 12u) * 32.0;
    c.glint_uv = vec2f(bitcast<f32>(r.glints[0]), bitcast<f32>(r.glints[1]));
    c.glint_extent = exp2(vec2f(mx_uncut(r.glints[2], 0u, 10u), mx_uncut(r.glints[2], 10u, 10u)) * 32.0 - 24.0);
    c.tint_index = f32(r.tint & 65535u);
    c.tint_weight = mx_uncut(r.tint, 16u, 8u);
    c.tangent = cos(turn) * x + sin(turn) * y;
    c.steady = 1.0 - mx_uncut_color(r.weights[0]);
    c.color = mx_uncut_color(((r.weights[0] >> 20u) | (r.weights[1] << 12u)));
    c.decay = mx_uncut_color(r.weights[1] >> 8u);
    c.spreads = f32((r.weights[1] >> 28u) & 1u);
    c.blur = mx_blur_of(r.weights[1] >> 29u);
    return c;
}

// There is one closure. A payload has no room for its tint and its glints, which are their mean.
fn mx_keep(c_in: MxClosure)
{
    var c: MxClosure = c_in;
    let word: u32 = mx_cut_normal(c.normal, 16u);
    c.tint_weight = 0.0;
    c.glint_density = 0.0;
    let r: MxRecord = mx_pack(c, mx_uncut_normal(word, 16u));
    mx_payload_words = array<u32, 16>((r.core | (mx_class_of(r.core >> 20u) << 28u)), r.body, r.weights[0],
        r.weights[1], r.medium, r.lobes, r.fuzz, r.anisotropy, word, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
}

fn packHalf2x16(v: vec2f) -> u32
{
    return pack2x16float(v);
}

// Adds emission and opacity to the words. Without a closure all others are 0.
fn mx_finish_payload(stored: i32, emission: vec3f, alpha: f32) -> i32
{
    let most: f32 = 65504.0;
    if (stored == 0) {
        for (var i: i32 = 0; i < 16; i++) {
            mx_payload_words[i] = 0u;
        }
    }
    mx_payload_words[9] = packHalf2x16(clamp(emission.xy, vec2f(0.0), vec2f(most)));
    mx_payload_words[10] = packHalf2x16(clamp(vec2f(emission.z, alpha), vec2f(0.0), vec2f(most)));
    return stored;
}

// A word, after mx_finish_payload, whose result is `finished`.
fn mx_payload_word(finished: i32, index: i32) -> u32
{
    return mx_payload_words[index];
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

fn surface(normalWorld: vec3f) -> Surface
{
    vd.normalWorld = normalWorld;
    var result: Surface;
    var stored: i32 = 0;
    stored = mx_store_closure(stored, vec3f(0.8, 0.8, 0.7), vec3f(0.04), vec3f(1.0), 0.3, 0.0,
        normalize(vd.normalWorld), vec3f(0.0), 0.5, 0.0, 0.0, vec3f(1.0), 0.3, vec3f(0.0), 0.0, 0.0, 0.0, vec2f(0.0),
        vec2f(0.0), 0.0, 0.0, 0.0, vec3f(1.0), vec3f(0.0), vec3f(0.0), 0.0);
    stored = mx_finish_payload(stored, vec3f(0.0), 1.0);
    result.word_0 = mx_payload_word(stored, 0);
    result.word_1 = mx_payload_word(stored, 1);
    result.word_2 = mx_payload_word(stored, 2);
    result.word_3 = mx_payload_word(stored, 3);
    result.word_4 = mx_payload_word(stored, 4);
    result.word_5 = mx_payload_word(stored, 5);
    result.word_6 = mx_payload_word(stored, 6);
    result.word_7 = mx_payload_word(stored, 7);
    result.word_8 = mx_payload_word(stored, 8);
    result.word_9 = mx_payload_word(stored, 9);
    result.word_10 = mx_payload_word(stored, 10);
    result.word_11 = mx_payload_word(stored, 11);
    result.word_12 = mx_payload_word(stored, 12);
    result.word_13 = mx_payload_word(stored, 13);
    result.word_14 = mx_payload_word(stored, 14);
    result.word_15 = mx_payload_word(stored, 15);
    return result;
}
