// light_simple · pass · mxgen 0.1 · hlsl · 2 closures · 0 textures
// shader model 6.0

struct mx_GgxLobe {
    float3 N;
    float cosine;
    float3 x;
    float2 alpha;
    float masking;
};
struct mx_GgxSamples {
    float3x3 to_map;
    float3 stretch;
    float area;
    float3 v;
    float masking;
    float reach;
    float step;
    float texels;
    float weight;
};
struct mx_GgxFacet {
    float3 h;
    float cosine;
    float mirror;
    float texels;
};
struct mx_GgxLight {
    float3 color;
    float weight;
    float cosine;
};
cbuffer PrivateUniforms : register(b0)
{
    float3 u_viewPosition : packoffset(c0);
    int u_numActiveLightSources : packoffset(c0.w);
    row_major float4x4 u_envMatrix : packoffset(c1);
    int u_envRadianceMips : packoffset(c5);
    int u_envRadianceSamples : packoffset(c5.y);
    float u_envLightIntensity : packoffset(c5.z);
};
struct LightData {
    float3 direction;
    float3 color;
    float3 position;
    int type;
    float intensity;
    float decay_rate;
    float inner_angle;
    float outer_angle;
};
cbuffer LightData_block : register(b2)
{
    LightData u_lightData[3];
};
Texture2D u_envRadiance : register(t3);
SamplerState u_envRadiance_sampler : register(s3);
Texture2D u_envIrradiance : register(t4);
SamplerState u_envIrradiance_sampler : register(s4);
RWTexture2DArray<uint> mx_words : register(u0, space1);
RWTexture2D<uint> mx_word0 : register(u1, space1);
RWTexture2D<uint> mx_word1 : register(u2, space1);
RWTexture2D<uint> mx_word2 : register(u3, space1);
Texture2D mx_depth : register(t4, space1);
Texture2D mx_color : register(t5, space1);
RWTexture2D<float4> mx_lit : register(u6, space1);
ByteAddressBuffer mx_tiles : register(t7, space1);
cbuffer MxFrame : register(b8, space1)
{
    row_major float4x4 mx_to_world;
    uint2 mx_size;
    uint mx_tiles_per_row;
    uint mx_num_tiles;
    uint mx_show;
};
struct VertexData {
    float4 position : SV_Position;
    float3 positionWorld : TEXCOORD0;
    float3 geomprop_diffuse_albedo : TEXCOORD1;
    float3 geomprop_f0 : TEXCOORD2;
    float geomprop_roughness : TEXCOORD3;
    float3 geomprop_normal : TEXCOORD4;
};
static VertexData vd;
static float4 out1;
struct MxReader {
    int2 pixel;
    uint class_;
    uint num_closures;
    uint next;
    uint core;
    uint body;
    uint top;
    uint at;
    float3 normals[3];
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
struct MxRecord {
    uint core;
    uint body;
    uint weights[2];
    uint medium;
    uint lobes;
    uint fuzz;
    uint anisotropy;
    uint tint;
    uint glints[4];
    uint normal;
};

float3 choose(float3 a, float3 b, bool3 c)
{
    return float3(c.x ? b.x : a.x, c.y ? b.y : a.y, c.z ? b.z : a.z);
}

MxRecord make_MxRecord(uint core, uint body, uint weights[2], uint medium, uint lobes, uint fuzz, uint anisotropy,
    uint tint, uint glints[4], uint normal)
{
    MxRecord made;
    made.core = core;
    made.body = body;
    made.weights = weights;
    made.medium = medium;
    made.lobes = lobes;
    made.fuzz = fuzz;
    made.anisotropy = anisotropy;
    made.tint = tint;
    made.glints = glints;
    made.normal = normal;
    return made;
}

typedef uint uint_2[2];
uint_2 make_uint_2(uint e0, uint e1)
{
    uint_2 made;
    made[0] = e0;
    made[1] = e1;
    return made;
}

typedef uint uint_4[4];
uint_4 make_uint_4(uint e0, uint e1, uint e2, uint e3)
{
    uint_4 made;
    made[0] = e0;
    made[1] = e1;
    made[2] = e2;
    made[3] = e3;
    return made;
}

mx_GgxLobe make_mx_GgxLobe(float3 N, float cosine, float3 x, float2 alpha, float masking)
{
    mx_GgxLobe made;
    made.N = N;
    made.cosine = cosine;
    made.x = x;
    made.alpha = alpha;
    made.masking = masking;
    return made;
}

mx_GgxSamples make_mx_GgxSamples(float3x3 to_map, float3 stretch, float area, float3 v, float masking, float reach,
    float step, float texels, float weight)
{
    mx_GgxSamples made;
    made.to_map = to_map;
    made.stretch = stretch;
    made.area = area;
    made.v = v;
    made.masking = masking;
    made.reach = reach;
    made.step = step;
    made.texels = texels;
    made.weight = weight;
    return made;
}

mx_GgxFacet make_mx_GgxFacet(float3 h, float cosine, float mirror, float texels)
{
    mx_GgxFacet made;
    made.h = h;
    made.cosine = cosine;
    made.mirror = mirror;
    made.texels = texels;
    return made;
}

mx_GgxLight make_mx_GgxLight(float3 color, float weight, float cosine)
{
    mx_GgxLight made;
    made.color = color;
    made.weight = weight;
    made.cosine = cosine;
    return made;
}

uint mx_tiles_load(uint at)
{
    return mx_tiles.Load(4 * at);
}

// The tile number i of the list of the pass.
uint mx_tile_at(uint i)
{
    return mx_tiles_load(20u + i);
}

// The pixel of an invocation, in a pass that runs over the tiles of a class.
int2 mx_pixel_of(uint class_, uint group, uint2 place)
{
    uint tile = mx_tile_at(class_ * mx_num_tiles + group);
    return 8 * int2(int(tile % mx_tiles_per_row), int(tile / mx_tiles_per_row)) + int2(place);
}

// True beyond the edge of the picture, where tiles may reach.
bool mx_is_outside(int2 pixel)
{
    return any(pixel >= int2(mx_size));
}

uint4 mx_word0_load(int2 at)
{
    return uint4(mx_word0[at], 0u, 0u, 1u);
}

uint4 mx_word1_load(int2 at)
{
    return uint4(mx_word1[at], 0u, 0u, 1u);
}

uint4 mx_word2_load(int2 at)
{
    return uint4(mx_word2[at], 0u, 0u, 1u);
}

// The class of a pixel by its first word.
uint mx_class(uint first)
{
    return ((first >> 20u) & 1024u) != 0u ? 4u : first >> 28u;
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

// Begins to read the closures of a pixel, from the top down.
MxReader mx_open(int2 pixel)
{
    MxReader reader;
    reader.pixel = pixel;
    reader.core = mx_word0_load(pixel).x;
    reader.body = mx_word1_load(pixel).x;
    reader.top = mx_word2_load(pixel).x;
    reader.class_ = mx_class(reader.core);
    reader.num_closures = reader.class_ == 0u ? 0u : (reader.body >> 28u) + 1u;
    reader.next = 0u;
    reader.at = 0u;
    { float3 made[3] = {mx_top_normal(reader.top), float3(0.0, 0.0, 0.0),
        float3(0.0, 0.0, 0.0)}; reader.normals = made; }
    return reader;
}

float4 mx_depth_fetch(int2 at, int level)
{
    return mx_depth.Load(int3(at, level));
}

float4 mx_color_fetch(int2 at, int level)
{
    return mx_color.Load(int3(at, level));
}

uint4 mx_words_load(int3 at)
{
    return uint4(mx_words[at], 0u, 0u, 1u);
}

// Reads the next word behind the targets.
uint mx_get(inout MxReader reader)
{
    uint kept = reader.at;
    reader.at += 1u;
    return mx_words_load(int3(reader.pixel, int(kept))).x;
}

// The features of a closure.
uint mx_features(uint core)
{
    return (core >> 20u) & (((core >> 20u) & 1024u) != 0u ? 1023u : 255u);
}

// A colour from its 20 bits.
float3 mx_uncut_color(uint word)
{
    return float3(mx_uncut(word, 0u, 7u), mx_uncut(word, 7u, 7u), mx_uncut(word, 14u, 6u));
}

// A colour from its encoding of IEC 61966-2-1.
float3 mx_linear(float3 srgb)
{
    return choose(pow((srgb + 0.055) / 1.055, float3(2.4, 2.4, 2.4)), srgb / 12.92,
        srgb < float3(0.04045, 0.04045, 0.04045));
}

// A number from -1 to 1 from its bits of a word.
float mx_uncut_signed(uint word, uint shift, uint bits)
{
    float most = float((1u << (bits - 1u)) - 1u);
    return float(int(word << (32u - bits - shift)) >> int(32u - bits)) / most;
}

// Two axes across a normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
void mx_across(float3 n, out float3 x, out float3 y)
{
    float side = n.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (side + n.z);
    float b = n.x * n.y * a;
    x = float3(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    y = float3(b, side + n.y * n.y * a, -n.y);
}

// The place of a direction in the octahedral square (Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors").
float2 mx_octahedral(float3 n)
{
    float2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    float2 folded = (1.0 - abs(p.yx)) * float2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    return (n.z < 0.0 ? folded : p) * 0.5 + 0.5;
}

// The blur from its three bits.
float mx_blur_of(uint bits)
{
    return bits == 0u ? 0.0 : exp2(float(bits) - 8.0);
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
    c.glint_uv = float2(asfloat(r.glints[0]), asfloat(r.glints[1]));
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

// The roughness of the closure on top.
float mx_top_roughness(uint word)
{
    return mx_uncut(word, 24u, 8u);
}

// The next closure; there is one.
MxClosure mx_next(inout MxReader reader)
{
    MxRecord r = make_MxRecord(reader.core, reader.body, make_uint_2(0u, 0u), 0u, 0u, 0u, 0u, 0u,
        make_uint_4(0u, 0u, 0u, 0u), 0u);
    bool is_top = reader.next == 0u;
    reader.next += 1u;
    uint kept = reader.next;
    bool is_last = kept == reader.num_closures;
    if (!is_last) {
        r.core = mx_get(reader);
        uint kept_;
        if (((r.core >> 20u) & 32u) != 0u)
            kept_ = 0u;
        else
            kept_ = mx_get(reader);
        r.body = kept_;
    }
    uint has = mx_features(r.core);
    if ((has & 1u) != 0u) {
        r.weights[0] = mx_get(reader);
        r.weights[1] = mx_get(reader);
    }
    if ((has & 2u) != 0u)
        r.medium = mx_get(reader);
    if ((has & 4u) != 0u)
        r.lobes = mx_get(reader);
    if ((has & 8u) != 0u)
        r.fuzz = mx_get(reader);
    if ((has & 16u) != 0u)
        r.anisotropy = mx_get(reader);
    if ((has & 256u) != 0u)
        r.tint = mx_get(reader);
    if ((has & 512u) != 0u) {
        for (int i = 0; i < 4; ++i)
            r.glints[i] = mx_get(reader);
    }
    uint number = (has >> 6u) & 3u;
    if (number == 1u) {
        reader.normals[2] = reader.normals[1];
        reader.normals[1] = mx_uncut_normal(mx_get(reader), 16u);
    }
    float3 normal = reader.normals[number > 1u ? number - 1u : number];
    return mx_unpack(r, normal, is_top ? mx_top_roughness(reader.top) : mx_uncut(r.body, 20u, 8u));
}

// Gives surface() a closure at a point, below a top with this normal and opacity.
void mx_fill(MxClosure closure, float3 point_, float3 top, float open)
{
    vd.positionWorld = point_;
    vd.geomprop_diffuse_albedo = closure.diffuse_albedo;
    vd.geomprop_f0 = closure.f0;
    vd.geomprop_roughness = closure.roughness;
    vd.geomprop_normal = closure.normal;
}

void surface();

void mx_lit_store(int2 at, float4 value)
{
    mx_lit[at] = value;
}

// Lights a pixel of the class.
void mx_run(uint2 group, uint2 place)
{
    int2 pixel = mx_pixel_of(1u, group.x, place);
    if (mx_is_outside(pixel))
        return;
    MxReader reader = mx_open(pixel);
    if (reader.class_ != 1u)
        return;
    float4 point_ = mul(float4(float2(pixel) + 0.5, mx_depth_fetch(pixel, 0).x, 1.0), mx_to_world);
    float4 stored = mx_color_fetch(pixel, 0);
    float4 lit_ = float4(stored.xyz, 1.0);
    while (reader.next < reader.num_closures) {
        MxClosure closure = mx_next(reader);
        mx_fill(closure, point_.xyz / point_.w, reader.normals[0], stored.w);
        surface();
        lit_.xyz += out1.xyz;
        break;
    }
    mx_lit_store(pixel, lit_);
}

// x^5.
float mx_power5(float x)
{
    return x * x * x * x * x;
}

// Height and fall of the bump of light that a rough surface of gloss g sends back.
float2 mx_chan_bump(float g)
{
    return float2((34.5 * g - 59.0) * g + 24.5, max(73.2 * g - 21.2, 8.9));
}

// Chan's diffuse lobe of gloss g, times its directional albedo, for a light whose half vector has the cosine cos_d to
// V; `even` is the part that a smooth surface lets out to the viewer.
float mx_chan_lobe(float g, float cos_v, float cos_l, float cos_d, float even)
{
    float2 bump = mx_chan_bump(g);
    return max(lerp(cos_d + mx_power5(1.0 - cos_d), even * (1.0 - 0.75 * mx_power5(1.0 - cos_l)),
        clamp(2.2 * g - 0.5, 0.0, 1.0)) + bump.x * cos_d
        * exp2(-bump.y * sqrt(min((cos_l + cos_v) / (2.0 * cos_d), 1.0))), 0.0);
}

// 1 / (pi times the directional albedo) of Chan's lobe of gloss g at the cosine c, within 0.0012.
float mx_chan_share(float c, float g)
{
    float4 fit = mul(float4(1.0, c, c * c, c * c * c),
        float4x4(0.711052, 0.000476, 0.474855, 0.02628, 0.152583, 0.003146, 1.026027, -0.718545, 0.102579, -0.004832,
        -2.223248, 0.347306, -0.053764, 0.001611, 2.069558, -0.492125));
    float2 bump = mx_chan_bump(g);
    return 1.0 / (3.1415927 * (lerp(fit.x, 0.96428573 * (1.0 - 0.75 * mx_power5(1.0 - c)),
        clamp(2.2 * g - 0.5, 0.0, 1.0)) + bump.x * exp2((8.9 - bump.y) * fit.z) * fit.y / (fit.w + c)));
}

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
float mx_bicubic(float4x4 m, float x, float y)
{
    return dot(float4(1.0, x, x * x, x * x * x), mul(float4(1.0, y, y * y, y * y * y), m));
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

// Schlick's curve from f0 to f90 at a cosine, less `bend` times cos (1 - cos)^6.
// Here bend = float3(0.0, 0.0, 0.0), exponent = 5.0.
float3 mx_fresnel_schlick(float cosine, float3 f0, float3 f90)
{
    float x = 1.0 - cosine;
    return lerp(f0, f90, x * x * x * x * x);
}

// The square of the length of the facet's normal H after the roughness divided its parts along the surface, times the
// product of the roughness along x and y; cos_h is its part along N.
// Here is_round = true, is_wide = false.
float mx_ggx_stretched(mx_GgxLobe lobe, float3 H, float cos_h)
{
    float3 slope = H - cos_h * lobe.N;
    return dot(slope, slope) + lobe.alpha.x * lobe.alpha.y * (cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = true, is_wide = false.
float mx_ggx_light(mx_GgxLobe lobe, float3 V, float3 L)
{
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = mx_ggx_stretched(lobe, V + L, lobe.cosine + dot(lobe.N, L));
    return area / 6.2831855 * square * square * cos_l
        / (e * e * (lobe.cosine * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * lobe.masking));
}

// The angle, over pi, with this sine and cosine; the cosine is not negative. It errs by 2.9e-5 at most.
float mx_half_turn(float sine, float cosine)
{
    return sine * (0.4999709 + cosine * (cosine * (0.2302802 + cosine * (0.0398298 * cosine - 0.1351235)) - 0.3164252));
}

// The square of the distance of the unit direction d from the vertical axis, never 0.
float mx_map_square(float3 d)
{
    return d.x * d.x + (d.z * d.z + 1e-16);
}

// The point of the latitude-longitude picture for the unit direction d, to a tenth of a texel in 4096.
float2 mx_map_point(float3 d)
{
    float square = mx_map_square(d);
    float stretch = rsqrt(square);
    return float2(frac((d.z > 0.0 ? -0.5 : 0.5) * (mx_half_turn(d.x * stretch, abs(d.z) * stretch) + 0.5) + 0.25),
        0.5 - mx_half_turn(d.y, square * stretch));
}

// The number of samples, from 1, that a lobe takes; roughness is that along two directions, squared.
int mx_sample_count(float2 roughness)
{
    float wide = max(roughness.x, roughness.y);
    float share = 0.5 * min(4.0 * sqrt(wide), 1.0);
    share = min(share * wide / min(roughness.x, roughness.y), 1.0);
    return max(int(ceil(share * float(u_envRadianceSamples))), 1);
}

// cos (1 + 2 Lambda) of a direction for GGX; `area` is the product of the roughness along x and y (Heitz 2014,
// "Understanding the Masking-Shadowing Function", equation 72).
float mx_ggx_masking(float cosine, float area)
{
    return sqrt(area + (1.0 - area) * (cosine * cosine));
}

// The GGX lobe of a surface as lights see it; roughness is that along X and across, squared.
// Here is_round = true.
mx_GgxLobe mx_ggx_lobe(float2 roughness, float3 N, float3 V)
{
    float2 alpha = clamp(roughness, 1e-8, 1.0);
    float cosine = max(abs(dot(N, V)), 1e-8);
    return make_mx_GgxLobe(faceforward(N, -V, N), cosine, float3(0.0, 0.0, 0.0), alpha,
        mx_ggx_masking(cosine, alpha.x * alpha.y));
}

// The GGX lobe of a surface as samples of the environment see it.
// Here is_round = true.
mx_GgxSamples mx_ggx_samples(float2 roughness, int count, float3 N, float3 V)
{
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, N, V);
    float3 x = normalize(V - lobe.cosine * lobe.N + 1e-6 * lobe.N.yzx);
    float3 v = float3(sqrt(max(1.0 - lobe.cosine * lobe.cosine, 0.0)), 0.0, lobe.cosine);
    float3 stretch = float3(lobe.alpha, 1.0);
    float reach = lobe.masking;
    float area = stretch.x * stretch.y;
    float share = 1.0 / float(count);
    return make_mx_GgxSamples(mul(float3x3(x, cross(lobe.N, x), lobe.N), (float3x3)u_envMatrix), stretch, area, v,
        lobe.masking, reach, share * (v.z + reach),
        area * (v.z + lobe.masking) * max(2.0 / float(count), 4.4 / float(max(u_envRadianceSamples, 1)))
        * exp2(2.0 * float(u_envRadianceMips) - 4.6485), u_envLightIntensity * (share * (v.z + lobe.masking)));
}

// Light of the environment from the unit direction d of its picture, filtered over as many texels.
float3 mx_filtered_light(float3 d, float texels)
{
    return u_envRadiance.SampleLevel(u_envRadiance_sampler, mx_map_point(d),
        0.5 * log2(texels * rsqrt(mx_map_square(d)))).xyz;
}

// Height-correlated masking and shadowing G2 over 2 cos_v cos_l (Heitz 2014, equation 99); `masking` is that of the
// viewer.
float mx_ggx_visibility(float cos_v, float masking, float area, float cos_l)
{
    return 1.0 / (cos_v * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * masking);
}

// A normal of those visible from v, at any length (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical
// Caps"): v is stretched by the roughness and has the length `reach`, `around` is (cos, sin) of the turn around z, and
// `depth` how far the normal lies below the top of the cap, v.z + reach at most.
float3 mx_ggx_cap(float2 around, float depth, float3 v, float reach)
{
    return v + float3(sqrt(depth * (2.0 * reach - depth)) * around, reach - depth);
}

// The facet of sample i. Samples are spherical Fibonacci points (Marques et al. 2013): each is the golden angle further
// around than the one before, by its `turn`.
mx_GgxFacet mx_ggx_facet(mx_GgxSamples s, int i, float2 turn)
{
    float3 h = mx_ggx_cap(turn, (float(i) + 0.5) * s.step, s.v * s.stretch, s.reach) * s.stretch;
    float cosine = dot(s.v, h);
    float mirror = 2.0 * cosine / dot(h, h);
    return make_mx_GgxFacet(h, cosine, mirror, mirror * mirror * s.texels);
}

// The light that the facet of sample i reflects.
mx_GgxLight mx_ggx_reflected(mx_GgxSamples s, int i, float2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    float3 l = facet.mirror * facet.h - s.v;
    float cos_l = max(l.z, 1e-8);
    return make_mx_GgxLight(mx_filtered_light(mul(l, s.to_map), facet.texels),
        s.weight * cos_l * mx_ggx_visibility(s.v.z, s.masking, s.area, cos_l),
        sqrt(clamp(0.5 * (facet.mirror * facet.cosine), 1e-8, 1.0)));
}

void surface()
{
    float3 color = float3(0.0, 0.0, 0.0);
    // lights
    float3 V = normalize(u_viewPosition - vd.positionWorld);
    // simple_slab
    float3 facing = faceforward(vd.geomprop_normal, -V, vd.geomprop_normal);
    float alpha = vd.geomprop_roughness * vd.geomprop_roughness;
    float square = clamp(alpha, 0.001, 1.0);
    float chan_gloss = clamp(log2(2.0 / (square * square) - 1.0) / 18.0, 0.0, 1.0);
    float cos_v = max(abs(dot(vd.geomprop_normal, V)), 1e-8);
    float x = 1.0 - cos_v;
    float chan_even = 1.0 - x * (x * (x * (x * x))) * 0.75;
    float3 fresnel_f0 = max(vd.geomprop_f0, 0.0);
    float3 grazing = (float3)clamp(max(vd.geomprop_f0.x, max(vd.geomprop_f0.y, vd.geomprop_f0.z)) * 50.0, 0.0, 1.0);
    float reflection_alpha = clamp(alpha, 1e-8, 1.0);
    float2 albedo = mx_ggx_albedo_fit(reflection_alpha, cos_v);
    float3 reflection_factor = lerp(fresnel_f0, grazing, 0.04761905) * (1.0 / albedo.x - 1.0) + float3(1.0, 1.0, 1.0);
    float3 reflection_throughput = float3(1.0, 1.0, 1.0)
        - (float3(1.0, 1.0, 1.0) - max(float3(1.0, 1.0, 1.0)
        - lerp(fresnel_f0, grazing, albedo.y) * albedo.x * reflection_factor, 0.0));
    float3 medium_factor = mx_chan_share(cos_v, chan_gloss) * (vd.geomprop_diffuse_albedo * reflection_throughput);
    float ggx_masking = sqrt(reflection_alpha * reflection_alpha
        + (1.0 - reflection_alpha * reflection_alpha) * (cos_v * cos_v));
    mx_GgxLobe reflection_ggx_lobe = make_mx_GgxLobe(facing, cos_v, float3(0.0, 0.0, 0.0), (float2)reflection_alpha,
        ggx_masking);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        float3 L;
        float intensity;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            float3 d = u_lightData[i].position - vd.positionWorld;
            float3 to_light = normalize(d);
            L = to_light;
            float falloff = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
            } else {
                float edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light)) * falloff
                    : 0.0;
            }
        }
        // medium
        float cos_l = max(dot(L, facing), 1e-8);
        float half_cosine = sqrt(clamp(dot(V, L) * 0.5 + 0.500001, 0.0, 1.0));
        color += u_lightData[i].color * (intensity
            * (cos_l * mx_chan_lobe(chan_gloss, cos_v, cos_l, half_cosine, chan_even) * medium_factor));
        // reflection
        if (true) {
            float3 fresnel = mx_fresnel_schlick(half_cosine, fresnel_f0, grazing);
            color += u_lightData[i].color
                * (intensity * (reflection_factor * (fresnel * mx_ggx_light(reflection_ggx_lobe, V, L))));
        }
    }
    // environment: medium
    bool is_black = max(vd.geomprop_diffuse_albedo.x, max(vd.geomprop_diffuse_albedo.y, vd.geomprop_diffuse_albedo.z))
        <= 0.0;
    float s = clamp(chan_gloss * 2.2 - 0.5, 0.0, 1.0);
    float medium_product = (1.0 - chan_gloss * 1.085) * (1.0 - s * (s * 1.1414));
    float3 environment_irradiance = u_envIrradiance.SampleLevel(u_envIrradiance_sampler,
        mx_map_point(normalize(mul(facing + V * ((cos_v * (cos_v * 0.5624 - 0.7155) + 0.4353) * medium_product),
        (float3x3)u_envMatrix))), 0.0).xyz * u_envLightIntensity;
    color += reflection_throughput * (is_black ? float3(0.0, 0.0, 0.0)
        : vd.geomprop_diffuse_albedo * environment_irradiance);
    // environment: reflection
    if (true) {
        float2 turn = float2(1.0, 0.0);
        int count = mx_sample_count((float2)reflection_alpha);
        mx_GgxSamples reflection_ggx_samples = mx_ggx_samples((float2)alpha, count, vd.geomprop_normal, V);
        for (int i = 0; i < count; ++i) {
            mx_GgxLight light = mx_ggx_reflected(reflection_ggx_samples, i, turn);
            color += reflection_factor * (light.color
                * (light.weight * mx_fresnel_schlick(light.cosine, fresnel_f0, grazing)));
            turn = float2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    out1 = float4(color, 1.0);
}

[numthreads(8, 8, 1)]
void main(uint3 group : SV_GroupID, uint3 place : SV_GroupThreadID)
{
    mx_run(group.xy, place.xy);
}
