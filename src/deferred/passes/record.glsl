// The storage of closures (docs/deferred.md): how values become bits, for those who write and those who read. MX_STORAGE: 0 rounds with
// dither, 1 rounds, 2 keeps whole floats. MX_BLUR: 1 where rough interfaces blur what lies below.

// Features that a closure has beside f0, albedo and roughness: one word each, two for weights. Bits 20 to 27 of its
// first word.
const uint MX_HAS_WEIGHTS = 1u, MX_HAS_MEDIUM = 2u, MX_HAS_LOBES = 4u, MX_HAS_FUZZ = 8u, MX_HAS_ANISOTROPY = 16u;
const uint MX_IS_SMOOTH = 32u;  // the closure on top, without a diffuse albedo: it has one word less
const uint MX_NORMAL_SHIFT = 6; // 0: the normal of the top, 1: in a word of its own, 2: the last such word, 3: the one before it

// A tint has one word more, glints have four. Bits 28 to 30 of the first word, where bit 30 is set; else bits 28 and 29
// of word 0 are the class.
const uint MX_HAS_TINT = 256u, MX_HAS_GLINTS = 512u, MX_IS_SPECIAL = 1024u;

// The words of a closure.
struct MxRecord
{
    uint core, body, weights[2], medium, lobes, fuzz, anisotropy, tint, glints[4], normal;
};

// The class of a pixel by its first word.
uint mx_class(uint first)
{
    return ((first >> 20u) & MX_IS_SPECIAL) != 0u ? uint(MX_SPECIAL) : first >> 28u;
}

// The features of a closure.
uint mx_features(uint core)
{
    return (core >> 20u) & (((core >> 20u) & MX_IS_SPECIAL) != 0u ? 0x3ffu : 0xffu);
}

// ---- numbers of few bits ---------------------------------------------------------------------------------------------

// Interleaved gradient noise of a pixel, from 0 to below 1 (Jimenez 2014, "Next Generation Post Processing in Call of
// Duty: Advanced Warfare").
float mx_gradient_noise(vec2 pixel)
{
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

#if MX_STORAGE == 0
// The noise of the pixel, from 0 to 7 eighths: what is added before a number is cut off.
uint mx_noise = 4u;

// Chooses the noise of a pixel, before its numbers are cut.
void mx_start_noise(vec2 pixel)
{
    mx_noise = uint(8.0 * mx_gradient_noise(pixel));
}

// The noise of a channel. Channels differ by 5 eighths, near the golden ratio.
uint mx_noise_of(uint channel)
{
    return (mx_noise + 5u * channel) & 7u;
}

// A number from 0 to 1 in eighths of the steps of its bits. Noise has no middle, so its mean is right half an eighth
// further.
uint mx_eighths(float value, uint bits)
{
    return uint(clamp(value, 0.0, 1.0) * 8.0 * float((1u << bits) - 1u) + 0.5);
}

// A number from 0 to 1 in so many bits. Each channel has noise of its own.
uint mx_cut(float value, uint bits, uint channel)
{
    return (mx_eighths(value, bits) + mx_noise_of(channel)) >> 3u;
}

// A colour in 7, 7 and 6 bits. Ten bits hold the eighths of a channel, so that one addition dithers all three.
uint mx_cut_color(vec3 color)
{
    uint eighths = mx_eighths(color.x, 7u) | (mx_eighths(color.y, 7u) << 10u) | (mx_eighths(color.z, 6u) << 20u);
    eighths += mx_noise_of(0u) | (mx_noise_of(1u) << 10u) | (mx_noise_of(2u) << 20u);
    return ((eighths >> 3u) & 0x7fu) | (((eighths >> 13u) & 0x7fu) << 7u) | (((eighths >> 23u) & 0x3fu) << 14u);
}
#else
// The nearest of the numbers from 0 to 1 that so many bits have, alike in all channels.
uint mx_cut(float value, uint bits, uint channel)
{
    return uint(clamp(value, 0.0, 1.0) * float((1u << bits) - 1u) + 0.5);
}

// A colour in 7, 7 and 6 bits.
uint mx_cut_color(vec3 color)
{
    return mx_cut(color.x, 7u, 0u) | (mx_cut(color.y, 7u, 1u) << 7u) | (mx_cut(color.z, 6u, 2u) << 14u);
}
#endif

// A number from 0 to 1 from its bits of a word.
float mx_uncut(uint word, uint shift, uint bits)
{
    return float((word >> shift) & ((1u << bits) - 1u)) / float((1u << bits) - 1u);
}

// A colour from its 20 bits.
vec3 mx_uncut_color(uint word)
{
    return vec3(mx_uncut(word, 0u, 7u), mx_uncut(word, 7u, 7u), mx_uncut(word, 14u, 6u));
}

// A number from -1 to 1 in so many bits. 0 has none of them.
uint mx_cut_signed(float value, uint bits)
{
    float most = float((1u << (bits - 1u)) - 1u);
    return uint(int(round(clamp(value, -1.0, 1.0) * most))) & ((1u << bits) - 1u);
}

// A number from -1 to 1 from its bits of a word.
float mx_uncut_signed(uint word, uint shift, uint bits)
{
    float most = float((1u << (bits - 1u)) - 1u);
    return float(int(word << (32u - bits - shift)) >> int(32u - bits)) / most;
}

// A colour in the encoding of IEC 61966-2-1.
vec3 mx_srgb(vec3 linear)
{
    vec3 c = clamp(linear, 0.0, 1.0);
    return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThan(c, vec3(0.0031308)));
}

// A colour from its encoding of IEC 61966-2-1.
vec3 mx_linear(vec3 srgb)
{
    return mix(pow((srgb + 0.055) / 1.055, vec3(2.4)), srgb / 12.92, lessThan(srgb, vec3(0.04045)));
}

// The place of a direction in the octahedral square (Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors").
vec2 mx_octahedral(vec3 n)
{
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    return (n.z < 0.0 ? folded : p) * 0.5 + 0.5;
}

// A direction from its place in the octahedral square.
vec3 mx_of_octahedral(vec2 square)
{
    vec2 p = square * 2.0 - 1.0;
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float fold = max(-n.z, 0.0);
    n.xy += vec2(n.x < 0.0 ? fold : -fold, n.y < 0.0 ? fold : -fold);
    return normalize(n);
}

// A direction in so many bits for each axis of the octahedral square.
uint mx_cut_normal(vec3 normal, uint bits)
{
    uvec2 p = uvec2(round(mx_octahedral(normal) * float((1u << bits) - 1u)));
    return p.x | (p.y << bits);
}

// A direction from its bits.
vec3 mx_uncut_normal(uint word, uint bits)
{
    return mx_of_octahedral(vec2(mx_uncut(word, 0u, bits), mx_uncut(word, bits, bits)));
}

// Two axes across a normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
void mx_across(vec3 n, out vec3 x, out vec3 y)
{
    float side = n.z < 0.0 ? -1.0 : 1.0, a = -1.0 / (side + n.z), b = n.x * n.y * a;
    x = vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    y = vec3(b, side + n.y * n.y * a, -n.y);
}

// ---- words -----------------------------------------------------------------------------------------------------------

// The third word of a pixel: normal and roughness of the closure on top.
uint mx_top(vec3 normal, float roughness)
{
    return mx_cut_normal(normal, 12u) | (mx_cut(roughness, 8u, 3u) << 24u);
}

// The normal of the closure on top.
vec3 mx_top_normal(uint word)
{
    return mx_uncut_normal(word & 0xffffffu, 12u);
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
         | (c.is_thick > 0.0 ? 1u << 26u : 0u);
}

// The word of the lobes: the second roughness with its weight, and the hue of f90.
uint mx_lobes_word(MxClosure c)
{
    uint weight = mx_cut(c.second_roughness_weight, 6u, 4u);
    uint roughness = weight == 0u ? 0u : mx_cut(c.second_roughness, 8u, 5u);
    vec3 hue = max(c.f90, 0.0) / max(max(c.f90.x, max(c.f90.y, c.f90.z)), 1e-6);
    return roughness | (weight << 8u) | (mx_cut(1.0 - hue.x, 6u, 6u) << 14u) | (mx_cut(1.0 - hue.y, 6u, 7u) << 20u)
         | (mx_cut(1.0 - hue.z, 6u, 8u) << 26u);
}

// The word of fuzz: amount, colour and roughness. 0 without fuzz.
uint mx_fuzz_word(MxClosure c)
{
    uint amount = mx_cut(c.fuzz_amount, 6u, 9u);
    return amount == 0u ? 0u : amount | (mx_cut_color(mx_srgb(c.fuzz_color)) << 6u) | (mx_cut(c.fuzz_roughness, 6u, 10u) << 26u);
}

// The word of the anisotropy: amount and tangent, as an angle from the first axis across the normal, below half a
// turn: both its directions are one.
uint mx_anisotropy_word(MxClosure c, vec3 normal)
{
    uint amount = mx_cut_signed(c.anisotropy, 16u);
    vec3 x, y;
    mx_across(normal, x, y);
    float turn = atan(dot(c.tangent, y), dot(c.tangent, x)) / 3.14159265;
    return amount == 0u ? 0u : (uint(round(fract(turn) * 65536.0)) & 0xffffu) | (amount << 16u);
}

// The word of a tint: the number of its table, and how much it tints.
uint mx_tint_word(MxClosure c)
{
    uint weight = mx_cut(c.tint_weight, 8u, 11u);
    return weight == 0u ? 0u : (uint(c.tint_index) & 0xffffu) | (weight << 16u);
}

// The words of glints. Facets need exact places and slopes, so they are not dithered: coordinates; logarithms of the
// extents and of the number; whole turn of the tangent, roughness, what 12 bits of the normal leave, in sixteenths of
// their steps.
uint[4] mx_glint_words(MxClosure c, vec3 normal)
{
    vec2 extent = clamp((log2(max(c.glint_extent, 1e-12)) + 24.0) / 32.0, 0.0, 1.0); // from 2^-24 to 2^8
    vec3 x, y;
    mx_across(normal, x, y);
    float turn = atan(dot(c.tangent, y), dot(c.tangent, x)) / 6.2831853;
    ivec2 rest = ivec2(round(clamp((mx_octahedral(c.normal) - mx_octahedral(normal)) * 65520.0, -8.0, 7.0))) & 15;
    return uint[4](floatBitsToUint(c.glint_uv.x), floatBitsToUint(c.glint_uv.y),
                   uint(round(extent.x * 1023.0)) | (uint(round(extent.y * 1023.0)) << 10u)
                 | (max(uint(round(clamp(c.glint_density / 32.0, 0.0, 1.0) * 4095.0)), 1u) << 20u),
                   (uint(round(fract(turn) * 4096.0)) & 0xfffu) | (uint(round(clamp(c.roughness, 0.0, 1.0) * 4095.0)) << 12u)
                 | (uint(rest.x) << 24u) | (uint(rest.y) << 28u));
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
    if ((has & MX_IS_SPECIAL) != 0u)
        return uint(MX_SPECIAL);
    return (has & (MX_HAS_ANISOTROPY | MX_HAS_WEIGHTS)) != 0u ? MX_COMPLEX : has != 0u ? MX_SINGLE : MX_SIMPLE;
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
MxRecord mx_pack(MxClosure c, vec3 stored_normal)
{
    MxRecord r;
    uint steady = mx_cut_color(1.0 - c.steady), color = mx_cut_color(c.color), decay = color == 0u ? 0u : mx_cut_color(c.decay);
    r.weights[0] = steady | (color << 20u);
    r.weights[1] = (color >> 12u) | (decay << 8u) | (decay != 0u && c.spreads > 0.0 ? 1u << 28u : 0u);
#if MX_BLUR == 1
    r.weights[1] |= mx_blur_bits(c.blur) << 29u;
#endif
    r.medium = mx_medium_word(c);
    r.lobes = mx_lobes_word(c);
    r.fuzz = mx_fuzz_word(c);
    r.anisotropy = mx_anisotropy_word(c, stored_normal);
    r.tint = mx_tint_word(c);
    r.normal = 0u;
    bool has_glints = c.glint_density > 0.0 && max(c.glint_extent.x, c.glint_extent.y) > 0.0;
    r.glints = uint[4](0u, 0u, 0u, 0u);
    if (has_glints)
        r.glints = mx_glint_words(c, stored_normal);
    uint has = ((r.weights[0] | r.weights[1]) != 0u ? MX_HAS_WEIGHTS : 0u) | (r.medium != 0u ? MX_HAS_MEDIUM : 0u)
             | (r.lobes != 0u ? MX_HAS_LOBES : 0u) | (r.fuzz != 0u ? MX_HAS_FUZZ : 0u)
             | (r.anisotropy != 0u ? MX_HAS_ANISOTROPY : 0u) | (r.tint != 0u ? MX_HAS_TINT | MX_IS_SPECIAL : 0u)
             | (has_glints ? MX_HAS_GLINTS | MX_IS_SPECIAL : 0u);
    r.core = mx_core(c) | (has << 20u);
    r.body = mx_body(c);
    return r;
}

// A closure from its words, with the normal and roughness that other words have.
MxClosure mx_unpack(MxRecord r, vec3 normal, float roughness)
{
    MxClosure c;
    vec3 root = mx_uncut_color(r.core);
    c.f0 = root * root;
    c.diffuse_albedo = mx_linear(mx_uncut_color(r.body));
    c.normal = normal;
    c.f90 = 1.0 - vec3(mx_uncut(r.lobes, 14u, 6u), mx_uncut(r.lobes, 20u, 6u), mx_uncut(r.lobes, 26u, 6u));
    c.second_roughness = mx_uncut(r.lobes, 0u, 8u);
    c.second_roughness_weight = mx_uncut(r.lobes, 8u, 6u);
    c.fuzz_amount = mx_uncut(r.fuzz, 0u, 6u);
    c.fuzz_color = mx_linear(mx_uncut_color(r.fuzz >> 6u));
    c.fuzz_roughness = mx_uncut(r.fuzz, 26u, 6u);
    vec3 part = mx_uncut_color(r.medium);
    c.free_path = part / max(1.0 - part, 1e-6);
    c.phase_anisotropy = mx_uncut_signed(r.medium, 20u, 6u);
    c.is_thick = float((r.medium >> 26u) & 1u);
    c.anisotropy = mx_uncut_signed(r.anisotropy, 16u, 16u);
    vec3 x, y;
    mx_across(normal, x, y);
    bool has_glints = r.glints[2] != 0u;
    float turn = has_glints ? float(r.glints[3] & 0xfffu) / 4096.0 * 6.2831853 : float(r.anisotropy & 0xffffu) / 65536.0 * 3.14159265;
    c.roughness = has_glints ? mx_uncut(r.glints[3], 12u, 12u) : roughness;
    ivec2 rest = ivec2(int(r.glints[3] << 4u) >> 28, int(r.glints[3]) >> 28);
    if (has_glints)
        c.normal = mx_of_octahedral(mx_octahedral(normal) + vec2(rest) / 65520.0);
    c.glint_density = mx_uncut(r.glints[2], 20u, 12u) * 32.0;
    c.glint_uv = vec2(uintBitsToFloat(r.glints[0]), uintBitsToFloat(r.glints[1]));
    c.glint_extent = exp2(vec2(mx_uncut(r.glints[2], 0u, 10u), mx_uncut(r.glints[2], 10u, 10u)) * 32.0 - 24.0);
    c.tint_index = float(r.tint & 0xffffu);
    c.tint_weight = mx_uncut(r.tint, 16u, 8u);
    c.tangent = cos(turn) * x + sin(turn) * y;
    c.steady = 1.0 - mx_uncut_color(r.weights[0]);
    c.color = mx_uncut_color((r.weights[0] >> 20u) | (r.weights[1] << 12u));
    c.decay = mx_uncut_color(r.weights[1] >> 8u);
    c.spreads = float((r.weights[1] >> 28u) & 1u);
    c.blur = mx_blur_of(r.weights[1] >> 29u);
    return c;
}
