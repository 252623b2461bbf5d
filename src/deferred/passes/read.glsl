// The closures of a pixel, from the top down.

struct MxReader
{
    ivec2 pixel;
    uint class_, num_closures, next; // number of the closure that comes next
    uint core, body, top;            // words 0 to 2
    uint at;                         // words of the image that were read
    vec3 normals[3];                 // of the top, and the last two with words of their own
};

// Reads the next word behind the targets.
uint mx_get(inout MxReader reader)
{
    return imageLoad(mx_words, ivec3(reader.pixel, int(reader.at++))).x;
}

#if MX_STORAGE == 2
// Reads a number that is stored whole.
void mx_get(inout MxReader reader, out float value)
{
    value = uintBitsToFloat(mx_get(reader));
}

// Reads two numbers that are stored whole.
void mx_get(inout MxReader reader, out vec2 value)
{
    value.x = uintBitsToFloat(mx_get(reader));
    value.y = uintBitsToFloat(mx_get(reader));
}

// Reads three numbers that are stored whole.
void mx_get(inout MxReader reader, out vec3 value)
{
    value.x = uintBitsToFloat(mx_get(reader));
    value.y = uintBitsToFloat(mx_get(reader));
    value.z = uintBitsToFloat(mx_get(reader));
}

MxClosure mx_get_whole(inout MxReader reader);
#endif

// Begins to read the closures of a pixel, from the top down.
MxReader mx_open(ivec2 pixel)
{
    MxReader reader;
    reader.pixel = pixel;
    reader.core = imageLoad(mx_word0, pixel).x;
    reader.body = imageLoad(mx_word1, pixel).x;
    reader.top = imageLoad(mx_word2, pixel).x;
    reader.class_ = mx_class(reader.core);
    reader.num_closures = reader.class_ == MX_EMPTY ? 0u : (reader.body >> 28u) + 1u;
    reader.next = 0u;
    reader.at = 0u;
    reader.normals = vec3[3](mx_top_normal(reader.top), vec3(0.0), vec3(0.0));
    return reader;
}

// The next closure; there is one.
MxClosure mx_next(inout MxReader reader)
{
#if MX_STORAGE == 2
    MxClosure c = mx_get_whole(reader);
    if (reader.next++ == 0u)
        reader.normals[0] = c.normal;
    return c;
#else
    MxRecord r = MxRecord(reader.core, reader.body, uint[2](0u, 0u), 0u, 0u, 0u, 0u, 0u, uint[4](0u, 0u, 0u, 0u), 0u);
    bool is_top = reader.next == 0u, is_last = ++reader.next == reader.num_closures;
    if (!is_last) {
        r.core = mx_get(reader);
        r.body = ((r.core >> 20u) & MX_IS_SMOOTH) != 0u ? 0u : mx_get(reader);
    }
    uint has = mx_features(r.core);
    if ((has & MX_HAS_WEIGHTS) != 0u) {
        r.weights[0] = mx_get(reader);
        r.weights[1] = mx_get(reader);
    }
    if ((has & MX_HAS_MEDIUM) != 0u)
        r.medium = mx_get(reader);
    if ((has & MX_HAS_LOBES) != 0u)
        r.lobes = mx_get(reader);
    if ((has & MX_HAS_FUZZ) != 0u)
        r.fuzz = mx_get(reader);
    if ((has & MX_HAS_ANISOTROPY) != 0u)
        r.anisotropy = mx_get(reader);
    if ((has & MX_HAS_TINT) != 0u)
        r.tint = mx_get(reader);
    if ((has & MX_HAS_GLINTS) != 0u)
        for (int i = 0; i < 4; ++i)
            r.glints[i] = mx_get(reader);
    uint number = (has >> MX_NORMAL_SHIFT) & 3u;
    if (number == 1u) {
        reader.normals[2] = reader.normals[1];
        reader.normals[1] = mx_uncut_normal(mx_get(reader), 16u);
    }
    vec3 normal = reader.normals[number > 1u ? number - 1u : number];
    return mx_unpack(r, normal, is_top ? mx_top_roughness(reader.top) : mx_uncut(r.body, 20u, 8u));
#endif
}
@
@// The closure on top of a pixel, for reflections and denoisers. False: nothing is stored.
@bool mx_read_top(ivec2 pixel, out MxClosure top)
@{
@    MxReader reader = mx_open(pixel);
@    bool is_there = reader.num_closures > 0u;
@    if (is_there)
@        top = mx_next(reader);
@    return is_there;
@}
