// The end of a material pass: it writes the closures of a pixel, from the top down. Words 0 to 2 are outputs, the
// others layers of an image. MX_WORDS: the most words of a pixel. Without an image there is one closure at most,
// without features.

%layout(early_fragment_tests) in; // where there is an image, the depth pass ran before: one fragment of a pixel writes
%layout(location = 1) out uint mx_word0;
%layout(location = 2) out uint mx_word1;
%layout(location = 3) out uint mx_word2;
%
@uint mx_word0;
@uint mx_word1;
@uint mx_word2;
@vec2 mx_place; // the middle of the pixel, for noise
@
#if MX_WORDS > 3
MxRecord mx_pending;            // the last closure, which is written when the next one or the end comes
vec3 mx_normals[3];             // of the top, and the last two with words of their own
uint mx_num_closures = 0u, mx_num_words = 0u;
bool mx_is_special = false;     // a closure has glints or a tint
#if MX_STORAGE == 2
MxClosure mx_whole;
#endif

// Writes the next word behind the targets.
void mx_put(uint word)
{
%    imageStore(mx_words, ivec3(ivec2(gl_FragCoord.xy), int(mx_num_words++)), uvec4(word));
@    mx_put_at(mx_num_words++, word);
}

// Writes a whole number.
void mx_put(float value)
{
    mx_put(floatBitsToUint(value));
}

// Writes two whole numbers.
void mx_put(vec2 value)
{
    mx_put(value.x);
    mx_put(value.y);
}

// Writes three whole numbers.
void mx_put(vec3 value)
{
    mx_put(value.x);
    mx_put(value.y);
    mx_put(value.z);
}

// Writes the words that follow the first two of a closure.
void mx_put_features(MxRecord r)
{
    uint has = mx_features(r.core);
    if ((has & MX_HAS_WEIGHTS) != 0u) {
        mx_put(r.weights[0]);
        mx_put(r.weights[1]);
    }
    if ((has & MX_HAS_MEDIUM) != 0u)
        mx_put(r.medium);
    if ((has & MX_HAS_LOBES) != 0u)
        mx_put(r.lobes);
    if ((has & MX_HAS_FUZZ) != 0u)
        mx_put(r.fuzz);
    if ((has & MX_HAS_ANISOTROPY) != 0u)
        mx_put(r.anisotropy);
    if ((has & MX_HAS_TINT) != 0u)
        mx_put(r.tint);
    if ((has & MX_HAS_GLINTS) != 0u)
        for (int i = 0; i < 4; ++i)
            mx_put(r.glints[i]);
    if (((has >> MX_NORMAL_SHIFT) & 3u) == 1u)
        mx_put(r.normal);
}

#if MX_STORAGE == 2
void mx_put_whole(MxClosure c);
#endif

// Writes the pending closure, below which another one lies.
void mx_flush()
{
#if MX_STORAGE == 2
    mx_put_whole(mx_whole);
#else
    bool is_smooth = mx_num_closures == 1u && (mx_pending.body & 0xfffffu) == 0u;
    mx_put(mx_pending.core | (is_smooth ? MX_IS_SMOOTH << 20u : 0u));
    if (!is_smooth)
        mx_put(mx_pending.body);
    mx_put_features(mx_pending);
#endif
}

// The number of a normal, and its word where it needs one.
uint mx_number_normal(vec3 normal, inout uint word)
{
    for (uint i = 0u; i < 3u; ++i)
        if (normal == mx_normals[i])
            return i == 0u ? 0u : i + 1u;
    mx_normals[2] = mx_normals[1];
    mx_normals[1] = normal;
    word = mx_cut_normal(normal, 16u);
    return 1u;
}

// The last closure of all keeps its words in `mx_pending`.
void mx_keep(MxClosure c)
{
    if (mx_num_closures == 0u) {
#if MX_STORAGE == 0
%        mx_start_noise(gl_FragCoord.xy);
@        mx_start_noise(mx_place);
#endif
        mx_normals = vec3[3](c.normal, vec3(0.0), vec3(0.0));
        mx_word2 = mx_top(c.normal, c.roughness);
    } else {
        mx_flush();
    }
    uint normal_word = 0u, number = mx_number_normal(c.normal, normal_word);
    mx_pending = mx_pack(c, number == 0u ? mx_top_normal(mx_word2) : mx_uncut_normal(mx_cut_normal(c.normal, 16u), 16u));
    mx_pending.normal = normal_word;
    mx_pending.core |= number << (20u + MX_NORMAL_SHIFT);
    mx_is_special = mx_is_special || mx_class(mx_pending.core) == MX_SPECIAL;
#if MX_STORAGE == 2
    mx_whole = c;
#endif
    ++mx_num_closures;
}

// Writes the last closure, and the words of the targets, from the number of closures that are stored.
int mx_finish_closures(int stored)
{
    mx_word0 = 0u;
    mx_word1 = 0u;
    if (stored == 0)
        return 0;
    uint class_ = mx_is_special ? MX_SPECIAL : stored > 1 ? MX_COMPLEX : mx_class_of(mx_features(mx_pending.core));
#if MX_STORAGE == 2
    mx_put_whole(mx_whole);
#else
    mx_put_features(mx_pending);
#endif
    mx_word0 = mx_pending.core | (class_ << 28u);
    mx_word1 = mx_pending.body | (uint(stored - 1) << 28u);
    return stored;
}
#else
// The one closure needs no more words than the targets have.
void mx_keep(MxClosure c)
{
#if MX_STORAGE == 0
%    mx_start_noise(gl_FragCoord.xy);
@    mx_start_noise(mx_place);
#endif
    mx_word0 = mx_core(c) | (MX_SIMPLE << 28u);
    mx_word1 = mx_body(c);
    mx_word2 = mx_top(c.normal, c.roughness);
}

// A surface without a slab stores that there is none.
int mx_finish_closures(int stored)
{
    if (stored == 0) {
        mx_word0 = 0u;
        mx_word1 = 0u;
    }
    return stored;
}
#endif
