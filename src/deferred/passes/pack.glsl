// The end of a payload function: the closure of a hit and its light in 16 words, which the host hands on with its ray.

uint mx_payload_words[MX_PAYLOAD_WORDS];

// There is one closure. A payload has no room for its tint and its glints, which are their mean.
void mx_keep(MxClosure c)
{
    uint word = mx_cut_normal(c.normal, 16u);
    c.tint_weight = 0.0;
    c.glint_density = 0.0;
    MxRecord r = mx_pack(c, mx_uncut_normal(word, 16u));
    mx_payload_words = uint[MX_PAYLOAD_WORDS](r.core | (mx_class_of(r.core >> 20u) << 28u), r.body, r.weights[0], r.weights[1], r.medium,
                                              r.lobes, r.fuzz, r.anisotropy, word, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
}

// Adds emission and opacity to the words. Without a closure all others are 0.
int mx_finish_payload(int stored, vec3 emission, float alpha)
{
    const float most = 65504.0; // of a half
    if (stored == 0)
        for (int i = 0; i < MX_PAYLOAD_WORDS; ++i)
            mx_payload_words[i] = 0u;
    mx_payload_words[9] = packHalf2x16(clamp(emission.xy, 0.0, most));
    mx_payload_words[10] = packHalf2x16(clamp(vec2(emission.z, alpha), 0.0, most));
    return stored;
}

// A word, after mx_finish_payload, whose result is `finished`.
uint mx_payload_word(int finished, int index)
{
    return mx_payload_words[index];
}
