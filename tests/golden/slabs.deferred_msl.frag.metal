// wet_metal · slab_surface · mxgen 0.1 · msl · reduced · 3 closures · 0 textures
// Metal Shading Language 2.3
#include <metal_stdlib>
using namespace metal;

struct PrivateUniforms {
    float4x4 u_worldMatrix;
    float4x4 u_worldInverseTransposeMatrix;
    float4x4 u_viewProjectionMatrix;
    float3 u_viewPosition;
};
struct VertexData {
    float4 pos [[position]];
    float3 positionWorld [[user(positionWorld)]];
    float3 normalWorld [[user(normalWorld)]];
};
struct PixelOutputs {
    float4 out1 [[color(0)]];
    uint word0 [[color(1)]];
    uint word1 [[color(2)]];
    uint word2 [[color(3)]];
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

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
float mx_bicubic(float4x4 m, float x, float y)
{
    return dot(float4(1.0, x, x * x, x * x * x), m * float4(1.0, y, y * y, y * y * y));
}

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
float2 mx_ggx_albedo_fit(float a, float c)
{
    float x = clamp(1.0 - c - a * mx_bicubic(float4x4(-0.2174, 5.3819, -3.911, 0.2674, -9.7298, 3.9904, 3.8225, -0.0277,
        36.4897, -72.9122, 58.0878, -20.917, -31.4763, 79.0768, -73.9706, 26.5429), a / (a + c), a), 0.0, 1.0);
    float u = a / (a + 0.6 * c);
    return float2(min(1.0017 - u * u * mx_bicubic(float4x4(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238,
        8.7382, 4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.206, -83.1538, 52.7528), u, a * c), 1.0),
        x * x * x * x * x);
}

// Light that the layer of a medium reflects and lets through (`transmitted`), with all orders of scattering, on a way:
// a is the albedo of one scattering, t the optical depth (after Kubelka and Munk 1931).
// Here a = float3(0.990589, 0.99790716, 0.99950534), t = float3(0.2).
float3 mx_medium_layer(float way, thread float3& transmitted)
{
    float x = way - 1.0;
    float3 s = float3(0.49529448, 0.49895358, 0.49975267) * way
        * (1.0 + 0.16666666 * (float3(0.043278337, 0.052829146, 0.054919362)
        + x * float3(-0.18317366, -0.19314766, -0.19532585)));
    float3 k = float3(0.009411037, 0.0020928383, 0.000494659) * way
        * (1.0 + float3(0.16509815, 0.16631785, 0.16658421)
        * (float3(1.3360909, 1.3377652, 1.3381231) + x * float3(-1.792952, -1.8079973, -1.8112832)
        + float3(0.0739174, 0.07612604, 0.07661489)));
    float3 g = sqrt(k * (k + 2.0 * s));
    float3 e = exp(-g * 0.2);
    float3 ways = mix((1.0 - e * e) / max(g, 1e-6), 0.4 * (1.0 - g * 0.2), step(g * 0.2, float3(0.001)));
    float3 below = (k + s) * ways + 1.0 + e * e;
    transmitted = 2.0 * e / below;
    return s * ways / below;
}

struct GlobalContext {
    constant PrivateUniforms& u_prv;
    texture2d_array<uint, access::write> mx_words;
    VertexData vd;
    PixelOutputs out;

uint mx_noise = 4u;
uint mx_num_words = 0u;
uint mx_num_closures = 0u;
MxRecord mx_pending;
array<float3, 3> mx_normals;
uint mx_word2;
bool mx_is_special = false;
uint mx_word0;
uint mx_word1;

// Interleaved gradient noise of a pixel, from 0 to below 1 (Jimenez 2014, "Next Generation Post Processing in Call of
// Duty: Advanced Warfare").
float mx_gradient_noise(float2 pixel)
{
    return fract(52.982918 * fract(dot(pixel, float2(0.06711056, 0.00583715))));
}

// Chooses the noise of a pixel, before its numbers are cut.
void mx_start_noise(float2 pixel)
{
    mx_noise = uint(8.0 * mx_gradient_noise(pixel));
}

// The place of a direction in the octahedral square (Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors").
float2 mx_octahedral(float3 n)
{
    float2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    float2 folded = (1.0 - abs(p.yx)) * float2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    return (n.z < 0.0 ? folded : p) * 0.5 + 0.5;
}

// A direction in so many bits for each axis of the octahedral square.
uint mx_cut_normal(float3 normal, uint bits)
{
    uint2 p = uint2(rint(mx_octahedral(normal) * float((1u << bits) - 1u)));
    return p.x | (p.y << bits);
}

// A number from 0 to 1 in eighths of the steps of its bits. Noise has no middle, so its mean is right half an eighth
// further.
uint mx_eighths(float value, uint bits)
{
    return uint(clamp(value, 0.0, 1.0) * 8.0 * float((1u << bits) - 1u) + 0.5);
}

// The noise of a channel. Channels differ by 5 eighths, near the golden ratio.
uint mx_noise_of(uint channel)
{
    return (mx_noise + 5u * channel) & 7u;
}

// A number from 0 to 1 in so many bits. Each channel has noise of its own.
uint mx_cut(float value, uint bits, uint channel)
{
    return (mx_eighths(value, bits) + mx_noise_of(channel)) >> 3u;
}

// The third word of a pixel: normal and roughness of the closure on top.
uint mx_top(float3 normal, float roughness)
{
    return mx_cut_normal(normal, 12u) | (mx_cut(roughness, 8u, 3u) << 24u);
}

void mx_words_store(int3 at, uint4 value)
{
    mx_words.write(value, uint2(at.xy), uint(at.z));
}

// Writes the next word behind the targets.
void mx_put(uint word)
{
    uint kept = mx_num_words;
    mx_num_words += 1u;
    mx_words_store(int3(int2(vd.pos.xy), int(kept)), uint4(word));
}

// The features of a closure.
uint mx_features(uint core)
{
    return (core >> 20u) & (((core >> 20u) & 1024u) != 0u ? 1023u : 255u);
}

// Writes the words that follow the first two of a closure.
void mx_put_features(MxRecord r)
{
    uint has = mx_features(r.core);
    if ((has & 1u) != 0u) {
        mx_put(r.weights[0]);
        mx_put(r.weights[1]);
    }
    if ((has & 2u) != 0u)
        mx_put(r.medium);
    if ((has & 4u) != 0u)
        mx_put(r.lobes);
    if ((has & 8u) != 0u)
        mx_put(r.fuzz);
    if ((has & 16u) != 0u)
        mx_put(r.anisotropy);
    if ((has & 256u) != 0u)
        mx_put(r.tint);
    if ((has & 512u) != 0u) {
        for (int i = 0; i < 4; ++i)
            mx_put(r.glints[i]);
    }
    if (((has >> 6u) & 3u) == 1u)
        mx_put(r.normal);
}

// Writes the pending closure, below which another one lies.
void mx_flush()
{
    bool is_smooth = mx_num_closures == 1u && (mx_pending.body & 1048575u) == 0u;
    mx_put(mx_pending.core | (is_smooth ? 33554432u : 0u));
    if (!is_smooth)
        mx_put(mx_pending.body);
    mx_put_features(mx_pending);
}

// The number of a normal, and its word where it needs one.
uint mx_number_normal(float3 normal, thread uint& word)
{
    for (uint i = 0u; i < 3u; i += 1u) {
        if (all(normal == mx_normals[i]))
            return i == 0u ? 0u : i + 1u;
    }
    mx_normals[2] = mx_normals[1];
    mx_normals[1] = normal;
    word = mx_cut_normal(normal, 16u);
    return 1u;
}

// A colour in 7, 7 and 6 bits. Ten bits hold the eighths of a channel, so that one addition dithers all three.
uint mx_cut_color(float3 color)
{
    uint eighths = mx_eighths(color.x, 7u) | (mx_eighths(color.y, 7u) << 10u) | (mx_eighths(color.z, 6u) << 20u);
    eighths += mx_noise_of(0u) | (mx_noise_of(1u) << 10u) | (mx_noise_of(2u) << 20u);
    return ((eighths >> 3u) & 127u) | (((eighths >> 13u) & 127u) << 7u) | (((eighths >> 23u) & 63u) << 14u);
}

// A number from -1 to 1 in so many bits. 0 has none of them.
uint mx_cut_signed(float value, uint bits)
{
    float most = float((1u << (bits - 1u)) - 1u);
    return uint(int(rint(clamp(value, -1.0, 1.0) * most))) & ((1u << bits) - 1u);
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

// A colour in the encoding of IEC 61966-2-1.
float3 mx_srgb(float3 linear)
{
    float3 c = clamp(linear, 0.0, 1.0);
    return select(1.055 * pow(c, float3(0.41666666)) - 0.055, 12.92 * c, c < float3(0.0031308));
}

// The word of fuzz: amount, colour and roughness. 0 without fuzz.
uint mx_fuzz_word(MxClosure c)
{
    uint amount = mx_cut(c.fuzz_amount, 6u, 9u);
    return amount == 0u ? 0u : amount | (mx_cut_color(mx_srgb(c.fuzz_color)) << 6u)
        | (mx_cut(c.fuzz_roughness, 6u, 10u) << 26u);
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

// A direction from its place in the octahedral square.
float3 mx_of_octahedral(float2 square)
{
    float2 p = square * 2.0 - 1.0;
    float3 n = float3(p, 1.0 - abs(p.x) - abs(p.y));
    float fold = max(-n.z, 0.0);
    n.xy += float2(n.x < 0.0 ? fold : -fold, n.y < 0.0 ? fold : -fold);
    return normalize(n);
}

// A number from 0 to 1 from its bits of a word.
float mx_uncut(uint word, uint shift, uint bits)
{
    return float((word >> shift) & ((1u << bits) - 1u)) / float((1u << bits) - 1u);
}

// A direction from its bits.
float3 mx_uncut_normal(uint word, uint bits)
{
    return mx_of_octahedral(float2(mx_uncut(word, 0u, bits), mx_uncut(word, bits, bits)));
}

// The normal of the closure on top.
float3 mx_top_normal(uint word)
{
    return mx_uncut_normal(word & 16777215u, 12u);
}

// The class of a pixel by its first word.
uint mx_class(uint first)
{
    return ((first >> 20u) & 1024u) != 0u ? 4u : first >> 28u;
}

// The last closure of all keeps its words in `mx_pending`.
void mx_keep(MxClosure c)
{
    if (mx_num_closures == 0u) {
        mx_start_noise(vd.pos.xy);
        mx_normals = array<float3, 3>{c.normal, float3(0.0), float3(0.0)};
        mx_word2 = mx_top(c.normal, c.roughness);
    } else {
        mx_flush();
    }
    uint normal_word = 0u;
    uint number = mx_number_normal(c.normal, normal_word);
    mx_pending = mx_pack(c, number == 0u ? mx_top_normal(mx_word2)
        : mx_uncut_normal(mx_cut_normal(c.normal, 16u), 16u));
    mx_pending.normal = normal_word;
    mx_pending.core |= number << 26u;
    mx_is_special = mx_is_special || mx_class(mx_pending.core) == 4u;
    mx_num_closures += 1u;
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

// The class of a pixel or ray with one closure that has these features.
uint mx_class_of(uint has)
{
    if ((has & 1024u) != 0u)
        return 4u;
    return uint((has & 17u) != 0u ? 3 : has != 0u ? 2 : 1);
}

// Writes the last closure, and the words of the targets, from the number of closures that are stored.
int mx_finish_closures(int stored)
{
    mx_word0 = 0u;
    mx_word1 = 0u;
    if (stored == 0)
        return 0;
    uint class_ = mx_is_special ? 4u : stored > 1 ? 3u : mx_class_of(mx_features(mx_pending.core));
    mx_put_features(mx_pending);
    mx_word0 = mx_pending.core | (class_ << 28u);
    mx_word1 = mx_pending.body | (uint(stored - 1) << 28u);
    return stored;
}

// A word of the targets, after the closures.
uint mx_stored_word(int finished, int index)
{
    return index == 0 ? mx_word0 : index == 1 ? mx_word1 : mx_word2;
}

void FragmentMain()
{
    int stored = 0;
    float3 N = normalize(vd.normalWorld);
    stored = mx_store_closure(stored, float3(0.0), float3(0.04), float3(1.0), 0.1, 0.0, N, float3(0.0), 0.5, 0.0, 0.0,
        float3(1.0), 0.1, float3(19.999998, 30.0, 39.999996), 0.0, 0.0, 0.0, float2(0.0), float2(0.0), 0.0, 0.0, 0.0,
        float3(0.5), float3(0.0), float3(0.0), 0.0);
    // metal
    float c = dot(N, normalize(u_prv.u_viewPosition - vd.positionWorld));
    float view_cosine = max(abs(c), 1e-8);
    // coat
    float2 coat_reflection_albedo = mx_ggx_albedo_fit(0.01, view_cosine);
    float coat_reflection_ggx_compensation = (1.0 / coat_reflection_albedo.x - 1.0) * 0.08571428 + 1.0;
    float coat_reflection_throughput = max(1.0
        - mix(0.04, 1.0, coat_reflection_albedo.y) * coat_reflection_albedo.x * coat_reflection_ggx_compensation, 0.0);
    // milk
    float way = rsqrt(c * c + 1.25) * 1.5;
    float3 coat_medium_throughput = exp(way * float3(-0.05, -0.033333335, -0.025));
    float3 drops_throughput = mix(float3(1.0), coat_reflection_throughput * coat_medium_throughput, 0.5);
    float3 coat_medium_throughput_2 = coat_medium_throughput * float3(0.9512294, 0.967216, 0.9753099);
    float3 drops_throughput_2 = mix(float3(1.0), coat_reflection_throughput * coat_medium_throughput_2, 0.5);
    float3 drops_throughput_3 = mix(float3(1.0),
        coat_reflection_throughput * (coat_medium_throughput_2 * float3(0.9512294, 0.967216, 0.9753099)), 0.5);
    float3 milk_mark_decay = clamp((drops_throughput_2 - drops_throughput_3)
        / max(drops_throughput - drops_throughput_2, 1e-6), 0.0, 0.999);
    float3 decaying = (drops_throughput - drops_throughput_2) / (float3(1.0) - milk_mark_decay);
    stored = mx_store_closure(stored, float3(0.8, 0.9, 0.95), float3(0.04), float3(1.0), 0.5007194, 0.0, N, float3(0.0),
        0.5, 0.0, 0.0, float3(1.0), 0.5007194, float3(5.0), 0.0, 0.0, 0.0, float2(0.0), float2(0.0), 0.0, 0.0, 0.0,
        drops_throughput - decaying, decaying, milk_mark_decay, 0.0);
    float2 milk_reflection_albedo = mx_ggx_albedo_fit(0.25071993, view_cosine);
    float milk_reflection_ggx_compensation = (1.0 / milk_reflection_albedo.x - 1.0) * 0.08571428 + 1.0;
    float milk_reflection_throughput = max(1.0
        - mix(0.04, 1.0, milk_reflection_albedo.y) * milk_reflection_albedo.x * milk_reflection_ggx_compensation, 0.0);
    float3 milk_medium_transmitted;
    float3 milk_medium = mx_medium_layer(way, milk_medium_transmitted);
    float2 metal_reflection_albedo = mx_ggx_albedo_fit(0.29886922, view_cosine);
    float3 metal_reflection_ggx_compensation = (1.0 / metal_reflection_albedo.x - 1.0)
        * float3(0.6821221, 0.48832548, 0.27722293) + float3(1.0);
    float3 slab_reflection_bsdf_albedo = mix(float3(0.66622823, 0.46274176, 0.24108408), float3(1.0),
        metal_reflection_albedo.y) * metal_reflection_albedo.x * metal_reflection_ggx_compensation;
    float3 milk_medium_throughput = milk_medium_transmitted
        / (float3(1.0) - min((slab_reflection_bsdf_albedo
        + max(float3(1.0) - slab_reflection_bsdf_albedo, 0.0) * float3(0.700394, 0.2554791, 0.0776317))
        * float3(0.10193972, 0.102937125, 0.103155464), 0.999));
    float3 milky_metal_weight = milk_reflection_throughput * milk_medium_throughput * drops_throughput;
    float3 milk_medium_throughput_2 = milk_medium_throughput * float3(0.9081714, 0.9090508, 0.9092436);
    float3 milky_metal_weight_2 = milk_reflection_throughput * milk_medium_throughput_2 * drops_throughput_2;
    float3 difference = milky_metal_weight_2
        - milk_reflection_throughput * (milk_medium_throughput_2 * float3(0.9081714, 0.9090508, 0.9092436))
        * drops_throughput_3;
    float3 metal_mark_decay = clamp(difference / max(milky_metal_weight - milky_metal_weight_2, 1e-6), 0.0, 0.999);
    float3 decaying_2 = (milky_metal_weight - milky_metal_weight_2) / (float3(1.0) - metal_mark_decay);
    stored = mx_store_closure(stored, float3(0.700394, 0.2554791, 0.0776317),
        float3(0.66622823, 0.46274176, 0.24108408), float3(1.0), 0.54668933, 0.0, N, float3(0.0), 0.5, 0.0, 0.0,
        float3(1.0), 0.54668933, float3(0.0), 0.0, 0.0, 0.0, float2(0.0), float2(0.0), 0.0, 0.0, 0.0,
        milky_metal_weight - decaying_2, decaying_2, metal_mark_decay, 0.0);
    stored = mx_finish_closures(stored);
    out.out1 = float4((decaying + (drops_throughput - decaying)) * float3(0.0, 0.1, 0.0), 1.0);
    out.word0 = mx_stored_word(stored, 0);
    out.word1 = mx_stored_word(stored, 1);
    out.word2 = mx_stored_word(stored, 2);
}
};

[[early_fragment_tests]]
fragment PixelOutputs FragmentMain(
    VertexData vd [[stage_in]],
    constant PrivateUniforms& u_prv [[buffer(0)]],
    texture2d_array<uint, access::write> mx_words [[texture(16)]])
{
    GlobalContext context = {u_prv, mx_words, vd, {}};
    context.FragmentMain();
    return context.out;
}
