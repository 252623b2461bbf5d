// ---- a surface over others -------------------------------------------------------------------------------------------

#undef mx_word0
#undef mx_word1
#undef mx_word2

const uint MX_MOST_CLOSURES = 16u;

MxClosure mx_closures[MX_MOST_CLOSURES]; // of the pixel at hand, from the top down
uint mx_count;

// Packs them. Returns how many words they take behind the targets.
uint mx_write_all()
{
    mx_num_closures = 0u;
    mx_num_words = 0u;
    mx_is_special = false;
    for (uint i = 0u; i < mx_count; ++i)
        mx_keep(mx_closures[i]);
    mx_finish_closures(int(mx_count));
    return mx_num_words;
}

// One closure in place of two: their parameters, by the share of light that each sends on.
MxClosure mx_blend(MxClosure a, MxClosure b)
{
    float of_a = dot(a.steady + a.color, vec3(1.0)), of_b = dot(b.steady + b.color, vec3(1.0));
    float share = of_b / max(of_a + of_b, 1e-6);
    MxClosure c = a;
    c.diffuse_albedo = mix(a.diffuse_albedo, b.diffuse_albedo, share);
    c.f0 = mix(a.f0, b.f0, share);
    c.f90 = mix(a.f90, b.f90, share);
    c.roughness = mix(a.roughness, b.roughness, share);
    c.anisotropy = mix(a.anisotropy, b.anisotropy, share);
    c.normal = normalize(mix(a.normal, b.normal, share) + 1e-6 * a.normal);
    c.tangent = share < 0.5 ? a.tangent : b.tangent;
    c.second_roughness = mix(a.second_roughness, b.second_roughness, share);
    c.second_roughness_weight = mix(a.second_roughness_weight, b.second_roughness_weight, share);
    c.fuzz_amount = mix(a.fuzz_amount, b.fuzz_amount, share);
    c.fuzz_color = mix(a.fuzz_color, b.fuzz_color, share);
    c.fuzz_roughness = mix(a.fuzz_roughness, b.fuzz_roughness, share);
    c.free_path = mix(a.free_path, b.free_path, share);
    c.phase_anisotropy = mix(a.phase_anisotropy, b.phase_anisotropy, share);
    c.is_thick = share < 0.5 ? a.is_thick : b.is_thick;
    c.steady = min(a.steady + b.steady, 1.0);
    c.color = min(a.color + b.color, 1.0);
    c.decay = mix(a.decay, b.decay, share);
    return c;
}

// The closure of a payload; its weights have the opacity.
MxClosure mx_open_over(MxPayload p)
{
    MxRecord r = MxRecord(p.words[0], p.words[1], uint[2](p.words[2], p.words[3]), p.words[4], p.words[5], p.words[6], p.words[7],
                          0u, uint[4](0u, 0u, 0u, 0u), p.words[8]);
    return mx_unpack(r, mx_uncut_normal(p.words[8], 16u), mx_uncut(r.body, 20u, 8u));
}

// Adds the closures of the pixel, less what the surface above hides. The last place is blended where there are too many.
void mx_add_below(ivec2 pixel, float shown)
{
    MxReader reader = mx_open(pixel);
    while (reader.next < reader.num_closures) {
        MxClosure c = mx_next(reader);
        c.steady *= shown;
        c.color *= shown;
        vec3 light = c.steady + c.color;
        if (max(light.x, max(light.y, light.z)) <= 0.0)
            continue;
        if (mx_count == MX_MOST_CLOSURES)
            mx_closures[mx_count - 1u] = mx_blend(mx_closures[mx_count - 1u], c);
        else
            mx_closures[mx_count++] = c;
    }
}

// Blends the two on top until the image has room for all.
void mx_fit()
{
    uint room = uint(imageSize(mx_words).z);
    mx_is_dry = true;
    while (mx_write_all() > room && mx_count > 1u) {
        mx_closures[0] = mx_blend(mx_closures[0], mx_closures[1]);
        for (uint i = 2u; i < mx_count; ++i)
            mx_closures[i - 1u] = mx_closures[i];
        --mx_count;
    }
    mx_is_dry = false;
}

// Stores the surface of a payload over what the pixel stores, as much as it covers. Nothing is stored where nothing was.
void mx_store_over(ivec2 pixel, MxPayload payload)
{
    float opacity = unpackHalf2x16(payload.words[10]).y;
    if (mx_class(imageLoad(mx_word0, pixel).x) == MX_EMPTY)
        return;
    mx_over = pixel;
    mx_place = vec2(pixel) + 0.5;
    mx_count = 0u;
    if (mx_class(payload.words[0]) != MX_EMPTY)
        mx_closures[mx_count++] = mx_open_over(payload);
    mx_add_below(pixel, 1.0 - opacity);
    mx_fit();
    mx_write_all();
    imageStore(mx_word0, pixel, uvec4(mx_packed0));
    imageStore(mx_word1, pixel, uvec4(mx_packed1));
    imageStore(mx_word2, pixel, uvec4(mx_packed2));
}

// Stores a surface over those of a pixel, where there is one.
void mx_run(uvec2 group, uvec2 place)
{
    ivec2 pixel = mx_pixel_in(group, place);
    if (mx_is_outside(pixel))
        return;
    MxPayload payload = mx_payload_at(uint(pixel.y) * mx_size.x + uint(pixel.x));
    if (mx_class(payload.words[0]) != MX_EMPTY || payload.words[10] != 0u)
        mx_store_over(pixel, payload);
}
