// wet_metal · slab_surface · mxgen 0.1 · msl · reduced · 1 closure · 0 textures

#include <metal_stdlib>
using namespace metal;

struct VertexData {
    float3 normalWorld;
};
struct Surface {
    uint word_0;
    uint word_1;
    uint word_2;
    uint word_3;
    uint word_4;
    uint word_5;
    uint word_6;
    uint word_7;
    uint word_8;
    uint word_9;
    uint word_10;
    uint word_11;
    uint word_12;
    uint word_13;
    uint word_14;
    uint word_15;
};
#ifndef MXG_36953b01bde97658
#define MXG_36953b01bde97658
struct MxClosure {
    float3 diffuse_albedo;
    float3 f0;
    float3 f90;
    float roughness;
    float anisotropy;
    float3 normal;
    float3 tangent;
    float second_roughness;
    float second_roughness_weight;
    float fuzz_amount;
    float3 fuzz_color;
    float fuzz_roughness;
    float3 free_path;
    float phase_anisotropy;
    float is_thick;
    float glint_density;
    float2 glint_uv;
    float2 glint_extent;
    float tint_index;
    float tint_weight;
    float blur;
    float3 steady;
    float3 color;
    float3 decay;
    float spreads;
};
struct MxRecord {
    uint core;
    uint body;
    array<uint, 2> weights;
    uint medium;
    uint lobes;
    uint fuzz;
    uint anisotropy;
    uint tint;
    array<uint, 4> glints;
    uint normal;
};
#endif

struct GlobalContext {
    VertexData vd;

array<uint, 16> mx_payload_words;

// The class of a pixel by its first word.
uint mx_class(uint first)
{
    return ((first >> 20u) & 1024u) != 0u ? 4u : first >> 28u;
}

// The features of a closure.
uint mx_features(uint core)
{
    return (core >> 20u) & (((core >> 20u) & 1024u) != 0u ? 1023u : 255u);
}

// Interleaved gradient noise of a pixel, from 0 to below 1 (Jimenez 2014, "Next Generation Post Processing in Call of
// Duty: Advanced Warfare").
float mx_gradient_noise(float2 pixel)
{
    return fract(52.982918 * fract(dot(pixel, float2(0.06711056, 0.00583715))));
}

// The nearest of the numbers from 0 to 1 that so many bits have, alike in all channels.
uint mx_cut(float value, uint bits, uint channel)
{
    return uint(clamp(value, 0.0, 1.0) * float((1u << bits) - 1u) + 0.5);
}

// A colour in 7, 7 and 6 bits.
uint mx_cut_color(float3 color)
{
    return mx_cut(color.x, 7u, 0u) | (mx_cut(color.y, 7u, 1u) << 7u) | (mx_cut(color.z, 6u, 2u) << 14u);
}

// A number from 0 to 1 from its bits of a word.
float mx_uncut(uint word, uint shift, uint bits)
{
    return float((word >> shift) & ((1u << bits) - 1u)) / float((1u << bits) - 1u);
}

// A colour from its 20 bits.
float3 mx_uncut_color(uint word)
{
    return float3(mx_uncut(word, 0u, 7u), mx_uncut(word, 7u, 7u), mx_uncut(word, 14u, 6u));
}

// A number from -1 to 1 in so many bits. 0 has none of them.
uint mx_cut_signed(float value, uint bits)
{
    float most = float((1u << (bits - 1u)) - 1u);
    return uint(int(rint(clamp(value, -1.0, 1.0) * most))) & ((1u << bits) - 1u);
}

// A number from -1 to 1 from its bits of a word.
float mx_uncut_signed(uint word, uint shift, uint bits)
{
    float most = float((1u << (bits - 1u)) - 1u);
    return float(int(word << (32u - bits - shift)) >> int(32u - bits)) / most;
}

// A colour in the encoding of IEC 61966-2-1.
float3 mx_srgb(float3 linear)
{
    float3 c = clamp(linear, 0.0, 1.0);
    return select(1.055 * pow(c, float3(0.41666666)) - 0.055, 12.92 * c, c < float3(0.0031308));
}

// A colour from its encoding of IEC 61966-2-1.
float3 mx_linear(float3 srgb)
{
    return select(pow((srgb + 0.055) / 1.055, float3(2.4)), srgb / 12.92, srgb < float3(0.04045));
}

// The place of a direction in the octahedral square (Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors").
float2 mx_octahedral(float3 n)
{
    float2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    float2 folded = (1.0 - abs(p.yx)) * float2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    return (n.z < 0.0 ? folded : p) * 0.5 + 0.5;
}

// A direction from its place in the octahedral square.
float3 mx_of_octahedral(float2 square)
{
    float2 p = square * 2.0 - 1.0;
    float3 n = float3(p, 1.0 - abs(p.x) - abs(p.y));
    float fold = max(-n.z, 0.0);
    n.xy += float2(n.x < 0.0 ? fold : -fold, n.y < 0.0 ? fold : -fold);
    return normalize(n);
}

// A direction in so many bits for each axis of the octahedral square.
uint mx_cut_normal(float3 normal, uint bits)
{
    uint2 p = uint2(rint(mx_octahedral(normal) * float((1u << bits) - 1u)));
    return p.x | (p.y << bits);
}

// A direction from its bits.
float3 mx_uncut_normal(uint word, uint bits)
{
    return mx_of_octahedral(float2(mx_uncut(word, 0u, bits), mx_uncut(word, bits, bits)));
}

// Two axes across a normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
void mx_across(float3 n, thread float3& x, thread float3& y)
{
    float side = n.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (side + n.z);
    float b = n.x * n.y * a;
    x = float3(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    y = float3(b, side + n.y * n.y * a, -n.y);
}

// The third word of a pixel: normal and roughness of the closure on top.
uint mx_top(float3 normal, float roughness)
{
    return mx_cut_normal(normal, 12u) | (mx_cut(roughness, 8u, 3u) << 24u);
}

// The normal of the closure on top.
float3 mx_top_normal(uint word)
{
    return mx_uncut_normal(word & 16777215u, 12u);
}

// The roughness of the closure on top.
float mx_top_roughness(uint word)
{
    return mx_uncut(word, 24u, 8u);
}

// The word of a medium: free path, anisotropy of its phase function, and whether it is a body. 0 for opaque matter.
uint mx_medium_word(MxClosure c)
{
    if (max(c.free_path.x, max(c.free_path.y, c.free_path.z)) <= 0.0
        || max(c.diffuse_albedo.x, max(c.diffuse_albedo.y, c.diffuse_albedo.z)) <= 0.0)
        return 0u;
    return max(mx_cut_color(c.free_path / (1.0 + c.free_path)), 1u) | (mx_cut_signed(c.phase_anisotropy, 6u) << 20u)
        | (c.is_thick > 0.0 ? 67108864u : 0u);
}

// The word of the lobes: the second roughness with its weight, and the hue of f90.
uint mx_lobes_word(MxClosure c)
{
    uint weight = mx_cut(c.second_roughness_weight, 6u, 4u);
    uint roughness = weight == 0u ? 0u : mx_cut(c.second_roughness, 8u, 5u);
    float3 hue = max(c.f90, 0.0) / max(max(c.f90.x, max(c.f90.y, c.f90.z)), 1e-6);
    return roughness | (weight << 8u) | (mx_cut(1.0 - hue.x, 6u, 6u) << 14u) | (mx_cut(1.0 - hue.y, 6u, 7u) << 20u)
        | (mx_cut(1.0 - hue.z, 6u, 8u) << 26u);
}

// The word of fuzz: amount, colour and roughness. 0 without fuzz.
uint mx_fuzz_word(MxClosure c)
{
    uint amount = mx_cut(c.fuzz_amount, 6u, 9u);
    return amount == 0u ? 0u : amount | (mx_cut_color(mx_srgb(c.fuzz_color)) << 6u)
        | (mx_cut(c.fuzz_roughness, 6u, 10u) << 26u);
}

// The word of the anisotropy: amount and tangent, as an angle from the first axis across the normal, below half a turn:
// both its directions are one.
uint mx_anisotropy_word(MxClosure c, float3 normal)
{
    uint amount = mx_cut_signed(c.anisotropy, 16u);
    float3 x;
    float3 y;
    mx_across(normal, x, y);
    float turn = atan2(dot(c.tangent, y), dot(c.tangent, x)) / 3.1415927;
    return amount == 0u ? 0u : (uint(rint(fract(turn) * 65536.0)) & 65535u) | (amount << 16u);
}

// The word of a tint: the number of its table, and how much it tints.
uint mx_tint_word(MxClosure c)
{
    uint weight = mx_cut(c.tint_weight, 8u, 11u);
    return weight == 0u ? 0u : (uint(c.tint_index) & 65535u) | (weight << 16u);
}

// The words of glints. Facets need exact places and slopes, so they are not dithered: coordinates; logarithms of the
// extents and of the number; whole turn of the tangent, roughness, what 12 bits of the normal leave, in sixteenths of
// their steps.
array<uint, 4> mx_glint_words(MxClosure c, float3 normal)
{
    float2 extent = clamp((log2(max(c.glint_extent, 1e-12)) + 24.0) / 32.0, 0.0, 1.0);
    float3 x;
    float3 y;
    mx_across(normal, x, y);
    float turn = atan2(dot(c.tangent, y), dot(c.tangent, x)) / 6.2831855;
    int2 rest = int2(rint(clamp((mx_octahedral(c.normal) - mx_octahedral(normal)) * 65520.0, -8.0, 7.0))) & 15;
    return array<uint, 4>{as_type<uint>(c.glint_uv.x), as_type<uint>(c.glint_uv.y),
        uint(rint(extent.x * 1023.0)) | (uint(rint(extent.y * 1023.0)) << 10u)
        | (max(uint(rint(clamp(c.glint_density / 32.0, 0.0, 1.0) * 4095.0)), 1u) << 20u),
        (uint(rint(fract(turn) * 4096.0)) & 4095u) | (uint(rint(clamp(c.roughness, 0.0, 1.0) * 4095.0)) << 12u)
        | (uint(rest.x) << 24u) | (uint(rest.y) << 28u)};
}

// The three bits of a blur: 0 for none, else its logarithm, in seven steps up to a half.
uint mx_blur_bits(float blur)
{
    float steps = clamp(log2(max(blur, 1e-12)) + 8.0, 0.0, 7.0);
    return mx_cut(steps / 7.0, 3u, 12u);
}

// The blur from its three bits.
float mx_blur_of(uint bits)
{
    return bits == 0u ? 0.0 : exp2(float(bits) - 8.0);
}

// The class of a pixel or ray with one closure that has these features.
uint mx_class_of(uint has)
{
    if ((has & 1024u) != 0u)
        return 4u;
    return uint((has & 17u) != 0u ? 3 : has != 0u ? 2 : 1);
}

// The first word of a closure, without its features: the roots of f0.
uint mx_core(MxClosure c)
{
    return mx_cut_color(sqrt(clamp(c.f0, 0.0, 1.0)));
}

// The second word of a closure: diffuse albedo and roughness.
uint mx_body(MxClosure c)
{
    return mx_cut_color(mx_srgb(c.diffuse_albedo)) | (mx_cut(c.roughness, 8u, 3u) << 20u);
}

// All words of a closure but its normal, which the caller chooses. stored_normal: as it will be read.
MxRecord mx_pack(MxClosure c, float3 stored_normal)
{
    MxRecord r;
    uint steady = mx_cut_color(1.0 - c.steady);
    uint color = mx_cut_color(c.color);
    uint decay = color == 0u ? 0u : mx_cut_color(c.decay);
    r.weights[0] = steady | (color << 20u);
    r.weights[1] = (color >> 12u) | (decay << 8u) | (decay != 0u && c.spreads > 0.0 ? 268435456u : 0u);
    r.medium = mx_medium_word(c);
    r.lobes = mx_lobes_word(c);
    r.fuzz = mx_fuzz_word(c);
    r.anisotropy = mx_anisotropy_word(c, stored_normal);
    r.tint = mx_tint_word(c);
    r.normal = 0u;
    bool has_glints = c.glint_density > 0.0 && max(c.glint_extent.x, c.glint_extent.y) > 0.0;
    r.glints = array<uint, 4>{0u, 0u, 0u, 0u};
    if (has_glints)
        r.glints = mx_glint_words(c, stored_normal);
    uint has = ((r.weights[0] | r.weights[1]) != 0u ? 1u : 0u) | (r.medium != 0u ? 2u : 0u) | (r.lobes != 0u ? 4u : 0u)
        | (r.fuzz != 0u ? 8u : 0u) | (r.anisotropy != 0u ? 16u : 0u) | (r.tint != 0u ? 1280u : 0u)
        | (has_glints ? 1536u : 0u);
    r.core = mx_core(c) | (has << 20u);
    r.body = mx_body(c);
    return r;
}

// A closure from its words, with the normal and roughness that other words have.
MxClosure mx_unpack(MxRecord r, float3 normal, float roughness)
{
    MxClosure c;
    float3 root = mx_uncut_color(r.core);
    c.f0 = root * root;
    c.diffuse_albedo = mx_linear(mx_uncut_color(r.body));
    c.normal = normal;
    c.f90 = 1.0 - float3(mx_uncut(r.lobes, 14u, 6u), mx_uncut(r.lobes, 20u, 6u), mx_uncut(r.lobes, 26u, 6u));
    c.second_roughness = mx_uncut(r.lobes, 0u, 8u);
    c.second_roughness_weight = mx_uncut(r.lobes, 8u, 6u);
    c.fuzz_amount = mx_uncut(r.fuzz, 0u, 6u);
    c.fuzz_color = mx_linear(mx_uncut_color(r.fuzz >> 6u));
    c.fuzz_roughness = mx_uncut(r.fuzz, 26u, 6u);
    float3 part = mx_uncut_color(r.medium);
    c.free_path = part / max(1.0 - part, 1e-6);
    c.phase_anisotropy = mx_uncut_signed(r.medium, 20u, 6u);
    c.is_thick = float((r.medium >> 26u) & 1u);
    c.anisotropy = mx_uncut_signed(r.anisotropy, 16u, 16u);
    float3 x;
    float3 y;
    mx_across(normal, x, y);
    bool has_glints = r.glints[2] != 0u;
    float turn = has_glints ? float(r.glints[3] & 4095u) / 4096.0 * 6.2831855
        : float(r.anisotropy & 65535u) / 65536.0 * 3.1415927;
    c.roughness = has_glints ? mx_uncut(r.glints[3], 12u, 12u) : roughness;
    int2 rest = int2(int(r.glints[3] << 4u) >> 28, int(r.glints[3]) >> 28);
    if (has_glints)
        c.normal = mx_of_octahedral(mx_octahedral(normal) + float2(rest) / 65520.0);
    c.glint_density = mx_uncut(r.glints[2], 20u, 12u) * 32.0;
    c.glint_uv = float2(as_type<float>(r.glints[0]), as_type<float>(r.glints[1]));
    c.glint_extent = exp2(float2(mx_uncut(r.glints[2], 0u, 10u), mx_uncut(r.glints[2], 10u, 10u)) * 32.0 - 24.0);
    c.tint_index = float(r.tint & 65535u);
    c.tint_weight = mx_uncut(r.tint, 16u, 8u);
    c.tangent = cos(turn) * x + sin(turn) * y;
    c.steady = 1.0 - mx_uncut_color(r.weights[0]);
    c.color = mx_uncut_color((r.weights[0] >> 20u) | (r.weights[1] << 12u));
    c.decay = mx_uncut_color(r.weights[1] >> 8u);
    c.spreads = float((r.weights[1] >> 28u) & 1u);
    c.blur = mx_blur_of(r.weights[1] >> 29u);
    return c;
}

// There is one closure. A payload has no room for its tint and its glints, which are their mean.
void mx_keep(MxClosure c)
{
    uint word = mx_cut_normal(c.normal, 16u);
    c.tint_weight = 0.0;
    c.glint_density = 0.0;
    MxRecord r = mx_pack(c, mx_uncut_normal(word, 16u));
    mx_payload_words = array<uint, 16>{r.core | (mx_class_of(r.core >> 20u) << 28u), r.body, r.weights[0], r.weights[1],
        r.medium, r.lobes, r.fuzz, r.anisotropy, word, 0u, 0u, 0u, 0u, 0u, 0u, 0u};
}

uint packHalf2x16(float2 v)
{
    return as_type<uint>(half2(v));
}

// Adds emission and opacity to the words. Without a closure all others are 0.
int mx_finish_payload(int stored, float3 emission, float alpha)
{
    float most = 65504.0;
    if (stored == 0) {
        for (int i = 0; i < 16; ++i)
            mx_payload_words[i] = 0u;
    }
    mx_payload_words[9] = packHalf2x16(clamp(emission.xy, 0.0, most));
    mx_payload_words[10] = packHalf2x16(clamp(float2(emission.z, alpha), 0.0, most));
    return stored;
}

// A word, after mx_finish_payload, whose result is `finished`.
uint mx_payload_word(int finished, int index)
{
    return mx_payload_words[index];
}

// Keeps a slab unless nothing of it is seen. Returns how many closures there are.
int mx_store(int before, MxClosure c)
{
    float3 light = c.steady + c.color;
    if (max(light.x, max(light.y, light.z)) <= 0.0)
        return before;
    mx_keep(c);
    return before + 1;
}

// A material calls it for each slab, from the top down.
int mx_store_closure(int before, float3 diffuse_albedo, float3 f0, float3 f90, float roughness, float anisotropy,
    float3 normal, float3 tangent, float second_roughness, float second_roughness_weight, float fuzz_amount,
    float3 fuzz_color, float fuzz_roughness, float3 free_path, float phase_anisotropy, float is_thick,
    float glint_density, float2 glint_uv, float2 glint_extent, float tint_index, float tint_weight, float blur,
    float3 steady, float3 color, float3 decay, float spreads)
{
    MxClosure c;
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

Surface surface(float3 normalWorld)
{
    vd.normalWorld = normalWorld;
    Surface result;
    int stored = 0;
    stored = mx_store_closure(stored, float3(0.6579555, 0.3332806, 0.17180733),
        float3(0.5916348, 0.4240101, 0.24454294), float3(1.0), 0.5423652, 0.0, normalize(vd.normalWorld), float3(0.0),
        0.1, 0.04761195, 0.0, float3(1.0), 0.5423652, float3(0.0), 0.0, 0.0, 0.0, float2(0.0), float2(0.0), 0.0, 0.0,
        0.0, float3(1.0), float3(0.0), float3(0.0), 0.0);
    stored = mx_finish_payload(stored, float3(0.0, 0.09642637, 0.0), 1.0);
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
};
