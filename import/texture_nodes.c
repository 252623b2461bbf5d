// SPDX-License-Identifier: Apache-2.0
/*
 * A texture as nodes: an image placed by KHR_texture_transform, and what takes a channel of it.
 * Each image of a material is read once for each way in which it is read.
 */
#include "import/import.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ALPHA = 3 };

mxg_element import_node(struct import_material *material, const char *category, const char *name,
                        const char *type)
{
    char *free_name = import_name(material->importing, material->graph, name);
    mxg_element node =
        mxg_edit_add_element(material->importing->edit, material->graph, category, free_name, type);
    free(free_name);
    return node;
}

/* ---- The image ---- */

static void set_numbers(struct import_material *material, mxg_element node, const char *input,
                        const char *type, const json_t *array)
{
    float values[2];
    for (size_t i = 0; i < 2; ++i)
        values[i] = (float)json_number_value(json_array_get(array, i));
    if (json_array_size(array) == 2)
        mxg_edit_set_numbers(material->importing->edit, node, input, type, values, 2);
}

/* KHR_texture_transform, whose angle is in radians. */
static void place(struct import_material *material, mxg_element node, const json_t *transform)
{
    const float degrees = 57.29577951f;
    float angle = (float)json_number_value(json_object_get(transform, "rotation")) * degrees;
    set_numbers(material, node, "offset", "vector2", json_object_get(transform, "offset"));
    set_numbers(material, node, "scale", "vector2", json_object_get(transform, "scale"));
    if (angle != 0)
        mxg_edit_set_numbers(material->importing->edit, node, "rotate", "float", &angle, 1);
}

static void set_sampler(struct import_material *material, mxg_element node, const json_t *sampler)
{
    enum { REPEAT = 10497, CLAMP = 33071, MIRROR = 33648, CLOSEST = 9728, LINEAR = 9729 };
    static const char *const members[] = {"wrapS", "wrapT"}, *const inputs[] = {"uaddressmode",
                                                                                "vaddressmode"};
    mxg_edit *edit = material->importing->edit;
    for (int i = 0; i < 2; ++i) {
        uint64_t wrap = json_count_of(sampler, members[i]);
        if (wrap == CLAMP || wrap == MIRROR)
            mxg_edit_set_value(edit, node, inputs[i], "string", wrap == CLAMP ? "clamp" : "mirror");
        else if (wrap != REPEAT && json_object_get(sampler, members[i]))
            import_tell_loss(material->importing, material->name,
                             "'%s' of a sampler must be 10497, 33071 or 33648", members[i]);
    }
    uint64_t filter = json_count_of(sampler, "magFilter");
    if (filter == CLOSEST)
        mxg_edit_set_value(edit, node, "filtertype", "string", "closest");
    else if (filter != LINEAR && json_object_get(sampler, "magFilter"))
        import_tell_loss(material->importing, material->name,
                         "'magFilter' of a sampler must be 9728 or 9729");
}

/* The sampler of a texture; NULL: it has none, which is told if it names one. */
static const json_t *sampler_of(struct import_material *material, const json_t *texture)
{
    const json_t *sampler = gltf_source_item(&material->importing->source, "samplers",
                                             gltf_index_of(texture, "sampler"));
    if (!json_is_object(sampler) && json_object_get(texture, "sampler"))
        import_tell_loss(material->importing, material->name,
                         "the sampler of a texture is not there");
    return sampler;
}

/* Texture coordinates other than the first. */
static void set_texcoord(struct import_material *material, mxg_element node, uint64_t set)
{
    char name[32], number[24];
    mxg_edit *edit = material->importing->edit;
    if (!set || set > IMPORT_MAX_TEXCOORD)
        return;
    snprintf(name, sizeof name, "texcoord_%u", (unsigned)set);
    snprintf(number, sizeof number, "%u", (unsigned)set);
    mxg_element reader = mxg_edit_find_element(edit, material->graph, name);
    if (!reader) {
        reader = import_node(material, "texcoord", name, "vector2");
        mxg_edit_set_value(edit, reader, "index", "integer", number);
    }
    mxg_edit_connect_input(edit, node, "texcoord", reader, NULL);
}

/* "sheen_3": equal for equal readers of one texture. */
static char *reader_name(const struct gltf_input *row, const char *type, const json_t *info)
{
    char *transform = json_dumps(json_object_get(info, "extensions"), JSON_STYLE | JSON_SORT_KEYS);
    unsigned hash = 2166136261u, set = (unsigned)json_count_of(info, "texCoord"); /* FNV-1a */
    for (const char *at = transform ? transform : ""; *at; ++at)
        hash = (hash ^ (unsigned char)*at) * 16777619u;
    char *name =
             cli_format("%s%s_%zu", gltf_images[row->image].name,
                        strcmp(type, "color4") == 0 ? "Alpha" : "", gltf_index_of(info, "index")),
         *whole =
             transform || set ? cli_format("%s_%u_%08x", name, set, hash) : cli_format("%s", name);
    free(transform);
    free(name);
    return whole;
}

/* The image that a texture names in itself; those of extensions are of other kinds. */
static const char *file_of(struct import_material *material, const struct gltf_input *row,
                           const json_t *texture)
{
    size_t index = gltf_index_of(texture, "source");
    if (!json_is_object(texture))
        import_tell_loss(material->importing, material->name, "the texture of '%s' is not there",
                         row->texture);
    else if (index == SIZE_MAX)
        import_tell_loss(material->importing, material->name, "'%s' has no image in PNG or JPEG",
                         row->texture);
    else if (index >= material->importing->num_images)
        import_tell_loss(material->importing, material->name, "the image of '%s' is not there",
                         row->texture);
    return import_image(material->importing, index);
}

static mxg_element make_reader(struct import_material *material, const struct gltf_input *row,
                               const char *category, const char *type, const json_t *info)
{
    struct importing *importing = material->importing;
    mxg_edit *edit = importing->edit;
    char *name = reader_name(row, type, info);
    mxg_element reader = mxg_edit_find_element(edit, material->graph, name);
    const json_t *texture =
        gltf_source_item(&importing->source, "textures", gltf_index_of(info, "index"));
    const char *file = reader ? NULL : file_of(material, row, texture);
    if (file) {
        reader = mxg_edit_add_element(edit, material->graph, category, name, type);
        mxg_edit_set_value(edit, reader, "file", "filename", file);
        if (gltf_images[row->image].is_srgb)
            mxg_edit_set_attribute(edit, mxg_edit_find_element(edit, reader, "file"), "colorspace",
                                   "srgb_texture");
        const json_t *transform =
            json_object_get(json_object_get(info, "extensions"), "KHR_texture_transform");
        const json_t *set = json_object_get(transform, "texCoord");
        place(material, reader, transform);
        set_texcoord(material, reader,
                     set ? json_count_of(transform, "texCoord") : json_count_of(info, "texCoord"));
        set_sampler(material, reader, sampler_of(material, texture));
    }
    free(name);
    return reader;
}

/* ---- Values of the image ---- */

static void set_number(struct import_material *material, mxg_element node, const char *input,
                       double value)
{
    float number = (float)value;
    mxg_edit_set_numbers(material->importing->edit, node, input, "float", &number, 1);
}

/* A node of two numbers, the first of which is a port's. */
static struct import_port apply(struct import_material *material, const char *category,
                                const struct gltf_input *row, struct import_port port,
                                const char *input, double value)
{
    char *name = cli_format("%s_%s", row->name, category);
    mxg_element node = import_node(material, category, name, "float");
    mxg_edit_connect_input(material->importing->edit, node, "in1", port.node, port.output);
    set_number(material, node, input, value);
    free(name);
    return (struct import_port){node, NULL};
}

/*
 * The texel of a colour times its factor. It is a node of its own, because the factor is linear
 * (glTF 2.0, 3.9.2), and a file is converted from sRGB behind the node that reads it.
 */
static struct import_port tint(struct import_material *material, const struct gltf_input *row,
                               struct import_port port, const float factor[3])
{
    mxg_edit *edit = material->importing->edit;
    if (factor[0] == 1 && factor[1] == 1 && factor[2] == 1)
        return port;
    char *name = cli_format("%s_multiply", row->name);
    mxg_element node = import_node(material, "multiply", name, "color3");
    mxg_edit_connect_input(edit, node, "in1", port.node, port.output);
    mxg_edit_set_numbers(edit, node, "in2", "color3", factor, 3);
    free(name);
    return (struct import_port){node, NULL};
}

/* bg + mix (fg - bg), where the texel is `mix` or `fg`. */
static struct import_port blend(struct import_material *material, const struct gltf_input *row,
                                struct import_port port, double bg, const char *other, double value)
{
    mxg_edit *edit = material->importing->edit;
    char *name = cli_format("%s_mix", row->name);
    mxg_element node = import_node(material, "mix", name, "float");
    set_number(material, node, other, value);
    set_number(material, node, "bg", bg);
    mxg_edit_connect_input(edit, node, strcmp(other, "fg") == 0 ? "mix" : "fg", port.node,
                           port.output);
    free(name);
    return (struct import_port){node, NULL};
}

static struct import_port channel(struct import_material *material, const struct gltf_input *row,
                                  mxg_element reader, unsigned which)
{
    char number[8], *name = cli_format("%s_channel", row->name);
    mxg_edit *edit = material->importing->edit;
    mxg_element node = import_node(material, "extract", name, "float");
    snprintf(number, sizeof number, "%u", which);
    mxg_edit_connect_input(edit, node, "in", reader, NULL);
    mxg_edit_set_value(edit, node, "index", "integer", number);
    free(name);
    return (struct import_port){node, NULL};
}

/* The angle of the direction in red and green, and of the factor. */
static struct import_port direction(struct import_material *material, const struct gltf_input *row,
                                    mxg_element reader, double angle)
{
    mxg_edit *edit = material->importing->edit;
    struct import_port parts[2];
    for (unsigned i = 0; i < 2; ++i)
        parts[i] = apply(material, "subtract", row, channel(material, row, reader, i), "in2", 0.5);
    mxg_element turn = import_node(material, "atan2", "anisotropy_angle", "float");
    mxg_edit_connect_input(edit, turn, "iny", parts[1].node, NULL);
    mxg_edit_connect_input(edit, turn, "inx", parts[0].node, NULL);
    struct import_port port = {turn, NULL};
    return angle != 0 ? apply(material, "add", row, port, "in2", angle) : port;
}

static struct import_port map_of_normals(struct import_material *material,
                                         const struct gltf_input *row, mxg_element reader,
                                         const json_t *info)
{
    const json_t *scale = json_object_get(info, "scale");
    mxg_element map = import_node(material, "normalmap", row->name, "vector3");
    mxg_edit_connect_input(material->importing->edit, map, "in", reader, NULL);
    if (scale && json_number_value(scale) != 1)
        set_number(material, map, "scale", json_number_value(scale));
    return (struct import_port){map, NULL};
}

/* A number of the texture, by its own rule. */
static struct import_port number(struct import_material *material, const struct gltf_input *row,
                                 const json_t *info, mxg_element reader, float factor)
{
    const json_t *strength = json_object_get(info, "strength"),
                 *least = json_object_get(
                     json_object_get(json_object_get(material->json, "extensions"), row->object),
                     "iridescenceThicknessMinimum");
    const double thinnest = 100; /* nanometres, without the member */
    if (strcmp(row->name, "anisotropy_rotation") == 0)
        return direction(material, row, reader, (double)factor);
    struct import_port port = channel(material, row, reader, row->channel);
    if (strcmp(row->name, "iridescence_thickness") == 0)
        return blend(material, row, port, least ? json_number_value(least) : thinnest, "fg",
                     (double)factor);
    if (strcmp(row->name, "occlusion") == 0)
        return strength && json_number_value(strength) != 1
                   ? blend(material, row, port, 1, "mix", json_number_value(strength))
                   : port;
    return factor != 1 ? apply(material, "multiply", row, port, "in2", (double)factor) : port;
}

struct import_port import_texture(struct import_material *material, const struct gltf_input *row,
                                  const json_t *info, const float *factor, const float color[4])
{
    bool is_base = row->image == GLTF_BASE, is_srgb = gltf_images[row->image].is_srgb,
         is_color = is_srgb && row->count == 3;
    mxg_element reader = make_reader(material, row, is_base ? "gltf_colorimage" : "gltf_image",
                                     is_base    ? "multioutput"
                                     : is_color ? "color3"
                                     : is_srgb  ? "color4"
                                                : "vector3",
                                     info);
    if (!reader)
        return (struct import_port){0, NULL};
    if (is_base && row->channel == ALPHA) {
        struct import_port alpha = {reader, "outa"};
        return color[ALPHA] == 1
                   ? alpha
                   : apply(material, "multiply", row, alpha, "in2", (double)color[ALPHA]);
    }
    if (is_base)
        return tint(material, row, (struct import_port){reader, "outcolor"}, color);
    if (is_color)
        return tint(material, row, (struct import_port){reader, NULL}, factor);
    return row->count == 3 ? map_of_normals(material, row, reader, info)
                           : number(material, row, info, reader, *factor);
}
