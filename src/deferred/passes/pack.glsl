// The end of a payload function: the closure of a hit and its light in 16 words, which the host hands on with its ray.

uint mx_payload_words[MX_PAYLOAD_WORDS];

// Takes the closure; its light is not 0. Returns how many there are.
int mx_store_closure(int before, vec3 diffuse_albedo, vec3 f0, vec3 f90, float roughness, float anisotropy, vec3 normal, vec3 tangent,
                      float second_roughness, float second_roughness_weight, float fuzz_amount, vec3 fuzz_color, float fuzz_roughness,
                      vec3 free_path, float phase_anisotropy, float is_thick, vec3 steady, vec3 color, vec3 decay, float spreads)
{
    vec3 light = steady + color;
    if (max(light.x, max(light.y, light.z)) <= 0.0)
        return before;
    uint word = mx_cut_normal(normal, 16u);
    MxClosure c = MxClosure(diffuse_albedo, f0, f90, roughness, anisotropy, normal, tangent, second_roughness, second_roughness_weight,
                            fuzz_amount, fuzz_color, fuzz_roughness, free_path, phase_anisotropy, is_thick, steady, color, decay, spreads);
    MxRecord r = mx_pack(c, mx_uncut_normal(word, 16u));
    mx_payload_words = uint[MX_PAYLOAD_WORDS](r.core | mx_class_of(r.core >> 20u) << 28u, r.body, r.weights[0], r.weights[1], r.medium,
                                              r.lobes, r.fuzz, r.anisotropy, word, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    return before + 1;
}

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

// finished: the result of mx_finish_payload.
uint mx_payload_word(int finished, int index)
{
    return mx_payload_words[index];
}
