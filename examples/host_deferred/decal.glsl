// SPDX-License-Identifier: Apache-2.0
// The stage that throws a decal onto what is stored: it follows the source of a payload (docs/deferred.md, "Decals"). Its box is the column
// between y -1 and 1 above a rectangle of the ground.

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 1, binding = BINDING_word2, r32ui) uniform readonly uimage2D stored_top;
layout(set = 1, binding = BINDING_depth) uniform sampler2D stored_depth;
layout(set = 1, binding = BINDING_payloads, std430) buffer Payloads { uint payload_words[]; };
layout(set = 1, binding = BINDING_frame, std140) uniform Frame { mat4 to_world; uvec2 size; };
layout(set = 2, binding = 0, rgba16f) uniform image2D light_of_surfaces;

const vec2 MIDDLE = vec2(0.0, 5.0), EXTENT = vec2(15.0, 15.0);

vec3 normal_of(uint word)
{
    vec2 p = vec2(word & 0xfffu, word >> 12u & 0xfffu) / 4095.0 * 2.0 - 1.0;
    vec3 normal = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float fold = max(-normal.z, 0.0);
    return normalize(vec3(p - vec2(p.x < 0.0 ? -fold : fold, p.y < 0.0 ? -fold : fold), normal.z));
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(size.x) || pixel.y >= int(size.y))
        return;
    vec4 place = to_world * vec4(vec2(pixel) + 0.5, texelFetch(stored_depth, pixel, 0).x, 1.0);
    vec3 P = place.xyz / place.w;
    vec2 uv = (P.xz - MIDDLE) / EXTENT + 0.5;
    uint words[16];
    for (int i = 0; i < 16; i++)
        words[i] = 0u;
    if (uv == clamp(uv, 0.0, 1.0) && abs(P.y) < 1.0)
    {
        Surface s = surface(normal_of(imageLoad(stored_top, pixel).x), uv);
        words = uint[16](s.word_0, s.word_1, s.word_2, s.word_3, s.word_4, s.word_5, s.word_6, s.word_7, s.word_8, s.word_9, s.word_10,
                         s.word_11, s.word_12, s.word_13, s.word_14, s.word_15);
        vec2 red_green = unpackHalf2x16(s.word_9), blue_opacity = unpackHalf2x16(s.word_10);
        vec3 below = imageLoad(light_of_surfaces, pixel).xyz;
        imageStore(light_of_surfaces, pixel, vec4(vec3(red_green, blue_opacity.x) + (1.0 - blue_opacity.y) * below, 1.0));
    }
    int first = 16 * (pixel.y * int(size.x) + pixel.x);
    for (int i = 0; i < 16; i++)
        payload_words[first + i] = words[i];
}
