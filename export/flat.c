// SPDX-License-Identifier: Apache-2.0
#include "export/flat.h"

#include "program/memory.h"
#include "render/bake_plan.h"
#include "render/default_tokens.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

const char *const flat_spaces[] = {"", "none", "lin_rec709", "lin_srgb", "srgb_texture", NULL};

float flat_encode_srgb(float linear)
{
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * powf(linear, 1 / 2.4f) - 0.055f;
}

float flat_decode_srgb(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : powf((encoded + 0.055f) / 1.055f, 2.4f);
}

char *flat_place(const struct flat *flat, const char *path)
{
    char *at = cli_format("%s", path), *slash = strrchr(at, '/');
    mxg_element element = mxg_document_find_element(flat->source, 0, at);
    if (!element && slash) {
        *slash = '\0';
        element = mxg_document_find_element(flat->source, 0, at);
    }
    free(at);
    if (!element)
        return cli_format("%s", flat->source_path);
    mxg_element_info info = bake_element(flat->source, element);
    return cli_format("%s:%u:%u", info.file ? info.file : flat->source_path, info.line,
                      info.column);
}

char *flat_input_place(const struct flat *flat, const struct flat_material *material,
                       const char *input)
{
    char *path = cli_format("%s/%s", bake_element(flat->document, material->surface).name, input);
    char *place = flat_place(flat, path);
    free(path);
    return place;
}

void flat_tell_loss(const struct flat *flat, const struct flat_material *material,
                    const char *input, const char *format, ...)
{
    char reason[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    char *place = flat_input_place(flat, material, input);
    report_warning(flat->report, "export-loss", "'%s/%s' (%s) is not in the file as it is: %s",
                   material->name, input, place, reason);
    free(place);
}

size_t flat_find_material(const struct flat *flat, const char *name)
{
    const struct name_entry *entry = name ? names_find(&flat->by_name, name) : NULL;
    return entry ? entry->value : flat->num_materials;
}

const struct flat_input *flat_find(const struct flat_material *material, const char *name)
{
    for (size_t i = 0; i < material->num_inputs; ++i)
        if (strcmp(material->inputs[i].name, name) == 0)
            return &material->inputs[i];
    return NULL;
}

/* ---- Values ---- */

/* False after an error: the colours are in a space that no format here has. */
static bool read_space(const struct flat *flat, mxg_element port, bool *out_srgb)
{
    const char *space = bake_inherited(flat->document, port, "colorspace");
    *out_srgb = space && strcmp(space, "srgb_texture") == 0;
    if (!space || args_is_one_of(space, flat_spaces))
        return true;
    char *path = bake_path(flat->document, port), *place = flat_place(flat, path);
    report_error(flat->report, "export-space",
                 "'%s' (%s) has colors in '%s'; expected lin_rec709 or srgb_texture", path, place,
                 space);
    free(path);
    free(place);
    return false;
}

static bool is_color(const char *type)
{
    return strncmp(type, "color", 5) == 0;
}

static bool read_value(const struct flat *flat, mxg_element port, struct flat_input *out)
{
    mxg_value value = {sizeof value};
    bool is_srgb = false;
    if (mxg_document_value(flat->document, port, &value) != MXG_OK || value.num_values > 4)
        return true;
    if (is_color(value.type) && !read_space(flat, port, &is_srgb))
        return false;
    out->num_values = value.num_values;
    for (unsigned i = 0; i < value.num_values; ++i)
        out->values[i] = is_srgb && i < 3 ? flat_decode_srgb(value.values[i]) : value.values[i];
    return true;
}

/* ---- Images ---- */

static const char *text_of(const struct flat *flat, mxg_element node, const char *input)
{
    mxg_element port = mxg_document_find_element(flat->document, node, input);
    const char *value = port ? bake_attribute(flat->document, port, "value") : NULL;
    return value ? value : "";
}

static enum flat_wrap read_wrap(const struct flat *flat, const struct flat_material *material,
                                const char *input, const char *mode)
{
    if (strcmp(mode, "constant") == 0)
        flat_tell_loss(flat, material, input,
                       "around its image is a color, for which the texels at the border stand");
    return strcmp(mode, "constant") == 0 || strcmp(mode, "clamp") == 0 ? FLAT_CLAMP
           : strcmp(mode, "mirror") == 0                               ? FLAT_MIRROR
                                                                       : FLAT_REPEAT;
}

/* Numbers of an input of two; others where it has no value. */
static void read_pair(const struct flat *flat, mxg_element node, const char *input,
                      double otherwise, double out[2])
{
    mxg_value value = {sizeof value};
    mxg_element port = node ? mxg_document_find_element(flat->document, node, input) : 0;
    bool is_set =
        port && mxg_document_value(flat->document, port, &value) == MXG_OK && value.num_values == 2;
    for (size_t i = 0; i < 2; ++i)
        out[i] = is_set ? (double)value.values[i] : otherwise;
}

bool flat_is_unplaced(const struct flat_image *image)
{
    return image->scale[0] == 1 && image->scale[1] == 1 && image->offset[0] == 0
           && image->offset[1] == 0;
}

/* (uv * tiling - offset) / size * span */
static void read_tiling(const struct flat *flat, mxg_element node, struct flat_image *out)
{
    double size[2], span[2], offset[2];
    read_pair(flat, node, "realworldimagesize", 1, size);
    read_pair(flat, node, "realworldtilesize", 1, span);
    read_pair(flat, node, "uvtiling", 1, out->scale);
    read_pair(flat, node, "uvoffset", 0, offset);
    for (size_t i = 0; i < 2; ++i) {
        out->scale[i] *= span[i] / size[i];
        out->offset[i] = 0 - offset[i] * span[i] / size[i]; /* not -0 */
    }
}

/* Reads a place2d that does not turn: (uv - pivot) / scale - offset + pivot; TRS moves first. */
static void read_place(const struct flat *flat, mxg_element node, struct flat_image *out)
{
    double size[2], offset[2], pivot[2];
    mxg_value order = {sizeof order};
    mxg_element mode = node ? mxg_document_find_element(flat->document, node, "operationorder") : 0;
    read_pair(flat, node, "scale", 1, size);
    read_pair(flat, node, "offset", 0, offset);
    read_pair(flat, node, "pivot", 0, pivot);
    bool is_trs =
        mode && mxg_document_value(flat->document, mode, &order) == MXG_OK && order.integer == 1;
    for (size_t i = 0; i < 2; ++i) {
        out->scale[i] = 1 / size[i];
        out->offset[i] = is_trs ? pivot[i] - (pivot[i] + offset[i]) / size[i]
                                : pivot[i] - pivot[i] / size[i] - offset[i];
    }
}

/* The path of a file, relative to the document. NULL after an error. The caller frees it. */
static char *file_of(const struct flat *flat, mxg_element node, const char *file)
{
    char *named = default_tokens_replace(flat->source, file);
    bool is_set = bake_is_set(named);
    char *path = is_set ? NULL : bake_file_path(flat->document, flat->path, node, named);
    free(named);
    if (!is_set)
        return path;
    char *name = bake_path(flat->document, node), *place = flat_place(flat, name);
    report_error(flat->report, "export-tiles",
                 "'%s' (%s) are several images, and a texture of this format is one: export onto a "
                 "mesh whose texture coordinates lie between 0 and 1",
                 file, place);
    free(name);
    free(place);
    return NULL;
}

/* An image node without a file is the value of its input `default`. */
static bool read_image(const struct flat *flat, const struct flat_material *material,
                       mxg_element node, struct flat_input *out)
{
    mxg_element port = mxg_document_find_element(flat->document, node, "file"),
                otherwise = mxg_document_find_element(flat->document, node, "default");
    const char *file = text_of(flat, node, "file"), *type = bake_element(flat->document, node).type;
    bool is_srgb = false;
    if (!*file) {
        out->num_values = is_color(type) ? 3 : 1;
        return !otherwise || read_value(flat, otherwise, out);
    }
    if (is_color(type) && !read_space(flat, port, &is_srgb))
        return false;
    out->image = (struct flat_image){
        .path = file_of(flat, node, file),
        .components = type[strlen(type) - 1] >= '2' && type[strlen(type) - 1] <= '4'
                          ? (unsigned)(type[strlen(type) - 1] - '0')
                          : 1,
        .is_srgb = is_srgb,
        .is_closest = strcmp(text_of(flat, node, "filtertype"), "closest") == 0,
        .wrap = {read_wrap(flat, material, out->name, text_of(flat, node, "uaddressmode")),
                 read_wrap(flat, material, out->name, text_of(flat, node, "vaddressmode"))}};
    mxg_element place = mxg_document_find_element(flat->document, node, "texcoord");
    if (strcmp(bake_element(flat->document, node).category, "tiledimage") == 0)
        read_tiling(flat, node, &out->image);
    else
        read_place(flat, place ? bake_follow(flat->document, place).node : 0, &out->image);
    bool is_placed = true;
    for (size_t k = 0; k < 2; ++k)
        is_placed = is_placed && isfinite(out->image.scale[k]) && isfinite(out->image.offset[k]);
    if (!is_placed)
        flat_tell_loss(flat, material, out->name, "its image has no size");
    for (size_t k = 0; k < 2 && !is_placed; ++k) {
        out->image.scale[k] = 1;
        out->image.offset[k] = 0;
    }
    return out->image.path != NULL;
}

/* ---- Inputs ---- */

static bool read_normal_map(const struct flat *flat, const struct flat_material *material,
                            mxg_element node, struct flat_input *out)
{
    static const char *const others[] = {"normal", "tangent", "bitangent", NULL};
    mxg_element in = mxg_document_find_element(flat->document, node, "in"),
                scale = mxg_document_find_element(flat->document, node, "scale");
    struct bake_end map = in ? bake_follow(flat->document, in) : (struct bake_end){.output = ""};
    mxg_value value = {sizeof value};
    for (size_t i = 0; others[i]; ++i)
        if (mxg_document_find_element(flat->document, node, others[i]))
            flat_tell_loss(flat, material, out->name, "its map is in a frame of its own (%s)",
                           others[i]);
    if (scale && mxg_document_value(flat->document, scale, &value) != MXG_OK)
        flat_tell_loss(flat, material, out->name, "the scale of its map varies");
    else if (value.num_values > 1 && value.values[0] != value.values[1])
        flat_tell_loss(flat, material, out->name, "its map has another scale across than along");
    out->scale = value.num_values ? (double)value.values[0] : 1;
    return !map.node || read_image(flat, material, map.node, out);
}

/* *out_set: the input has a value or an image. */
static bool read_input(const struct flat *flat, const struct flat_material *material,
                       mxg_element port, struct flat_input *out, bool *out_set)
{
    struct bake_end end = bake_follow(flat->document, port);
    const char *category = end.node ? bake_element(flat->document, end.node).category : "";
    bool good = true;
    if (end.value)
        good = read_value(flat, end.value, out);
    else if (strcmp(category, "image") == 0 || strcmp(category, "tiledimage") == 0)
        good = read_image(flat, material, end.node, out);
    else if (strcmp(category, "normalmap") == 0)
        good = read_normal_map(flat, material, end.node, out);
    else if (end.node)
        flat_tell_loss(flat, material, out->name, "it is a <%s>", category);
    *out_set = out->image.path || out->num_values;
    return good;
}

static bool read_inputs(const struct flat *flat, struct flat_material *material)
{
    mxg_element child = bake_element(flat->document, material->surface).first_child;
    bool good = true;
    while (good && child) {
        mxg_element_info info = bake_element(flat->document, child);
        struct flat_input input = {.name = info.name, .port = child, .scale = 1};
        bool is_set = false;
        if (strcmp(info.category, "input") == 0)
            good = read_input(flat, material, child, &input, &is_set);
        if (is_set)
            MEMORY_PUSH(material->inputs, material->num_inputs, input);
        child = info.next;
    }
    return good;
}

/* ---- Materials ---- */

static bool has_surface(const struct flat *flat, mxg_element surface)
{
    for (size_t i = 0; i < flat->num_materials; ++i)
        if (flat->materials[i].surface == surface)
            return true;
    return false;
}

static bool add(struct flat *flat, const char *name, mxg_element surface)
{
    bool is_new;
    names_add(&flat->by_name, name, &is_new)->value = flat->num_materials;
    MEMORY_PUSH(flat->materials, flat->num_materials,
                (struct flat_material){.name = name, .surface = surface});
    return read_inputs(flat, &flat->materials[flat->num_materials - 1]);
}

static bool is_model(const struct flat *flat, mxg_element node, const char *model)
{
    return node && strcmp(bake_element(flat->document, node).category, model) == 0;
}

static bool read_material(struct flat *flat, mxg_element node, const char *model)
{
    mxg_element_info info = bake_element(flat->document, node);
    mxg_element port = strcmp(info.type, "material") == 0
                           ? mxg_document_find_element(flat->document, node, "surfaceshader")
                           : 0,
                surface = port ? bake_follow(flat->document, port).node : 0;
    if (!is_model(flat, surface, model))
        return true;
    return add(flat, info.name, surface);
}

bool flat_read(struct flat *flat, const mxg_document *document, const char *model)
{
    const mxg_element first = bake_element(document, 0).first_child;
    bool good = true;
    flat->document = document;
    for (mxg_element node = first; good && node; node = bake_element(document, node).next)
        good = read_material(flat, node, model);
    for (mxg_element node = first; good && node; node = bake_element(document, node).next)
        if (is_model(flat, node, model) && !has_surface(flat, node))
            good = add(flat, bake_element(document, node).name, node);
    if (good && !flat->num_materials)
        report_error(flat->report, "nothing-to-bake", "'%s' has no material", flat->source_path);
    return good && flat->num_materials;
}

void flat_finish(struct flat *flat)
{
    for (size_t i = 0; i < flat->num_materials; ++i) {
        struct flat_material *material = &flat->materials[i];
        for (size_t k = 0; k < material->num_inputs; ++k)
            free(material->inputs[k].image.path);
        free(material->inputs);
    }
    free(flat->materials);
    names_finish(&flat->by_name);
    *flat = (struct flat){0};
}
