// SPDX-License-Identifier: Apache-2.0
/* UsdPreviewSurface: values, and a UsdUVTexture for each image. */
#include "export/usd.h"

#include "program/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* An input, whose name both worlds have. */
struct preview_input {
    const char *name, *type;
    unsigned count; /* of its numbers */
    bool is_color;
};

static const struct preview_input inputs[] = {
    {"diffuseColor", "color3f", 3, true},     {"emissiveColor", "color3f", 3, true},
    {"useSpecularWorkflow", "int", 1, false}, {"specularColor", "color3f", 3, true},
    {"metallic", "float", 1, false},          {"roughness", "float", 1, false},
    {"clearcoat", "float", 1, false},         {"clearcoatRoughness", "float", 1, false},
    {"opacity", "float", 1, false},           {"opacityMode", "token", 1, false},
    {"opacityThreshold", "float", 1, false},  {"ior", "float", 1, false},
    {"normal", "normal3f", 3, false},         {"displacement", "float", 1, false},
    {"occlusion", "float", 1, false},
};
enum { NUM_INPUTS = sizeof inputs / sizeof *inputs };

static const struct preview_input *find(const char *name)
{
    for (size_t i = 0; i < NUM_INPUTS; ++i)
        if (strcmp(inputs[i].name, name) == 0)
            return &inputs[i];
    return NULL;
}

/* ---- Textures ---- */

/* A range of numbers that a texture has as those from 0 to 1. */
struct range {
    float low, size;
};

/* From 0 to 1 where the numbers lie there, as UsdUVTexture has it without scale and bias. */
static bool find_range(struct usd *usd, const struct flat_input *input, struct range *out)
{
    float low, high;
    if (!texture_find_range(&usd->writing->cli->report, &input->image, &low, &high))
        return false;
    out->low = low < -1e-6f ? low : 0;
    out->size = high > 1 || out->low < 0 ? high - out->low : 1;
    return true;
}

/* Directions lie between -1 and 1, with 0 at a step of 8 bits: 2 x - 1 of the numbers. */
static bool is_direction(const struct preview_input *row)
{
    return row->count == 3 && !row->is_color;
}

static bool make_file(struct usd *usd, const struct flat_material *material,
                      const struct preview_input *row, const struct flat_input *input,
                      struct range range, const struct usd_file **out)
{
    struct texture texture = {.is_srgb = row->is_color,
                              .is_whole = input->image.components == row->count && range.low == 0
                                          && range.size == 1};
    struct texture_file file = {0};
    for (unsigned c = 0; c < 4; ++c)
        texture.channels[c] = (struct texture_channel){
            .image = c < 3 ? &input->image : NULL,
            .component = row->count == 1 ? 0 : c,
            .low = range.low,
            .range = range.size,
        };
    char *key = texture_key(&texture);
    *out = usd_find_file(usd, key);
    if (!*out && texture_make(&usd->writing->cli->report, &texture, &file)) {
        char *name = cli_format("%s_%s.%s", material->name, row->name, file.ending);
        *out = usd_add_file(usd, key, name, file.data, file.size);
        free(name);
    }
    free(key);
    return *out != NULL;
}

static void put_texture(struct usd *usd, const struct preview_input *row,
                        const struct flat_input *input, struct range range, const char *file,
                        const char *reader)
{
    static const char *const wraps[] = {
        [FLAT_REPEAT] = "repeat", [FLAT_CLAMP] = "clamp", [FLAT_MIRROR] = "mirror"};
    char *asset = usd_asset(file);
    usd_put(usd, "uniform token info:id = \"UsdUVTexture\"");
    usd_put(usd, "asset inputs:file = %s", asset);
    usd_put(usd, "float2 inputs:st.connect = <%s.outputs:result>", reader);
    usd_put(usd, "token inputs:wrapS = \"%s\"", wraps[input->image.wrap[0]]);
    usd_put(usd, "token inputs:wrapT = \"%s\"", wraps[input->image.wrap[1]]);
    usd_put(usd, "token inputs:sourceColorSpace = \"%s\"", row->is_color ? "sRGB" : "raw");
    if (range.size != 1 || range.low != 0) {
        double size = (double)range.size, low = (double)range.low;
        usd_put(usd, "float4 inputs:scale = (%.7g, %.7g, %.7g, 1)", size, size, size);
        usd_put(usd, "float4 inputs:bias = (%.7g, %.7g, %.7g, 0)", low, low, low);
    }
    usd_put(usd, row->count == 1 ? "float outputs:r" : "float3 outputs:rgb");
    free(asset);
}

/* A shader that places an image; NULL: it lies where texture coordinates say. The caller frees the
 * path. */
static char *put_place(struct usd *usd, const struct preview_input *row,
                       const struct flat_image *image, const char *path, const char *reader,
                       struct name_table *names)
{
    if (flat_is_unplaced(image))
        return NULL;
    char *wanted = cli_format("%s_place", row->name), *name = usd_name(names, wanted),
         *whole = cli_format("%s/%s", path, name);
    usd_open(usd, "Shader", name);
    usd_put(usd, "uniform token info:id = \"UsdTransform2d\"");
    usd_put(usd, "float2 inputs:in.connect = <%s.outputs:result>", reader);
    usd_put(usd, "float2 inputs:scale = (%.7g, %.7g)", image->scale[0], image->scale[1]);
    usd_put(usd, "float2 inputs:translation = (%.7g, %.7g)", image->offset[0], image->offset[1]);
    usd_put(usd, "float2 outputs:result");
    usd_close(usd);
    free(wanted);
    free(name);
    return whole;
}

/* The shaders of the images, whose names `textures` gets by input. */
static bool put_textures(struct usd *usd, const struct flat_material *material, const char *path,
                         struct name_table *names, char **textures)
{
    char *reader = NULL;
    bool good = true;
    for (size_t i = 0; good && i < material->num_inputs; ++i) {
        const struct flat_input *input = &material->inputs[i];
        const struct preview_input *row = find(input->name);
        const struct usd_file *file;
        struct range range = {-1, 2};
        if (!row || !input->image.path)
            continue;
        if (!reader) {
            char *name = usd_name(names, "texcoord");
            usd_open(usd, "Shader", name);
            usd_put(usd, "uniform token info:id = \"UsdPrimvarReader_float2\"");
            usd_put(usd, "string inputs:varname = \"st\"");
            usd_put(usd, "float2 outputs:result");
            usd_close(usd);
            reader = cli_format("%s/%s", path, name);
            free(name);
        }
        good = (is_direction(row) || find_range(usd, input, &range))
               && make_file(usd, material, row, input, range, &file);
        if (!good)
            break;
        char *place = put_place(usd, row, &input->image, path, reader, names);
        textures[i] = usd_name(names, row->name);
        usd_open(usd, "Shader", textures[i]);
        put_texture(usd, row, input, range, file->name, place ? place : reader);
        usd_close(usd);
        free(place);
    }
    free(reader);
    return good;
}

/* ---- The surface ---- */

static void put_input(struct usd *usd, const struct flat_material *material, size_t index,
                      const char *path, const char *texture)
{
    const struct flat_input *input = &material->inputs[index];
    const struct preview_input *row = find(input->name);
    if (!row) {
        flat_tell_loss(usd->flat, material, input->name, "USD has nothing like it");
    } else if (texture) {
        usd_put(usd, "%s inputs:%s.connect = <%s/%s.outputs:%s>", row->type, row->name, path,
                texture, row->count == 1 ? "r" : "rgb");
    } else if (strcmp(row->type, "token") == 0) {
        usd_put(usd, "token inputs:%s = \"%s\"", row->name,
                input->values[0] > 0 ? "presence" : "transparent");
    } else {
        fprintf(usd->out, "%*s%s inputs:%s = ", (int)usd->depth * 4, "", row->type, row->name);
        usd_put_numbers(usd, input->values, row->count);
        fputc('\n', usd->out);
    }
}

bool usd_put_preview(struct usd *usd, const struct flat_material *material, const char *path,
                     struct name_table *names)
{
    char **textures = memory_alloc((material->num_inputs + 1) * sizeof *textures);
    bool good = put_textures(usd, material, path, names, textures);
    const bool is_moved = flat_find(material, "displacement") != NULL;
    if (good) {
        char *name = usd_name(names, "preview");
        usd_open(usd, "Shader", name);
        usd_put(usd, "uniform token info:id = \"UsdPreviewSurface\"");
        for (size_t i = 0; i < material->num_inputs; ++i)
            put_input(usd, material, i, path, textures[i]);
        usd_put(usd, "token outputs:surface");
        if (is_moved)
            usd_put(usd, "token outputs:displacement");
        usd_close(usd);
        usd_put(usd, "token outputs:surface.connect = <%s/%s.outputs:surface>", path, name);
        if (is_moved)
            usd_put(usd, "token outputs:displacement.connect = <%s/%s.outputs:displacement>", path,
                    name);
        free(name);
    }
    for (size_t i = 0; i < material->num_inputs; ++i)
        free(textures[i]);
    free(textures);
    return good;
}
