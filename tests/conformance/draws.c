// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "draws.h"

#include "lines.h"
#include "program/files.h"
#include "program/json_values.h"
#include "rows.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool draws_open(struct draws *draws)
{
    *draws = (struct draws){0};
    draws->path = scratch_make(&draws->scratch)
                      ? lines_path(draws->scratch.path, ".", "draws", ".jsonl")
                      : NULL;
    draws->file = draws->path ? fopen(draws->path, "w") : NULL;
    if (!draws->file)
        puts("there is no room for temporary files");
    return draws->file != NULL;
}

static char *image_path(const struct draws *draws, size_t number)
{
    char name[32];
    snprintf(name, sizeof name, "%zu", number);
    return lines_path(draws->scratch.path, ".", name, ".image");
}

void draws_close(struct draws *draws)
{
    if (draws->file && draws->is_running)
        pclose(draws->file);
    else if (draws->file)
        fclose(draws->file);
    scratch_remove(&draws->scratch);
    free(draws->path);
    free(draws->line);
}

/* ---- Numbers as text ---- */

static json_t *hex(const void *bytes, size_t size)
{
    static const char digits[] = "0123456789abcdef";
    const unsigned char *from = bytes;
    char *text = malloc(2 * size + 1);
    for (size_t i = 0; text && i < size; ++i) {
        text[2 * i] = digits[from[i] >> 4];
        text[2 * i + 1] = digits[from[i] & 15];
    }
    json_t *value = text ? json_stringn(text, 2 * size) : NULL;
    free(text);
    return value;
}

static unsigned digit(char c)
{
    return c <= '9' ? (unsigned)(c - '0') : (unsigned)(c - 'a' + 10);
}

static bool read_hex(const char *text, void *out, size_t size)
{
    unsigned char *bytes = out;
    bool good = strlen(text) == 2 * size && strspn(text, "0123456789abcdef") == 2 * size;
    for (size_t i = 0; good && i < size; ++i)
        bytes[i] = (unsigned char)(digit(text[2 * i]) << 4 | digit(text[2 * i + 1]));
    return good;
}

/* ---- Images ---- */

/* The texel of a level, from those of the level above: the mean of a square. */
static void average(const float *above, uint32_t above_width, uint32_t above_height, uint32_t x,
                    uint32_t y, float out[4])
{
    uint32_t x1 = 2 * x + 1 < above_width ? 2 * x + 1 : above_width - 1,
             y1 = 2 * y + 1 < above_height ? 2 * y + 1 : above_height - 1,
             x0 = 2 * x < above_width ? 2 * x : x1, y0 = 2 * y < above_height ? 2 * y : y1;
    for (uint32_t c = 0; c < 4; ++c)
        out[c] =
            0.25f
            * (above[4 * (y0 * above_width + x0) + c] + above[4 * (y0 * above_width + x1) + c]
               + above[4 * (y1 * above_width + x0) + c] + above[4 * (y1 * above_width + x1) + c]);
}

/* Writes and makes the levels below `texels`, which it frees. */
static void write_levels(FILE *file, float *texels, uint32_t width, uint32_t height,
                         uint32_t num_levels)
{
    for (uint32_t level = 0; texels && level < num_levels; ++level) {
        uint32_t w = image_level_size(width, level), h = image_level_size(height, level),
                 next_w = image_level_size(width, level + 1),
                 next_h = image_level_size(height, level + 1);
        float *next = malloc((size_t)next_w * next_h * 4 * sizeof *next);
        fwrite(texels, 4 * sizeof *texels, (size_t)w * h, file);
        for (uint32_t i = 0; next && i < next_w * next_h; ++i)
            average(texels, w, h, i % next_w, i / next_w, next + (size_t)4 * i);
        free(texels);
        texels = next;
    }
    free(texels);
}

/* The layers of an image without levels of its own, or its levels. */
static bool write_image(struct draws *draws, const struct draw_texture *texture)
{
    const struct image *image = texture->image;
    char *path = image_path(draws, draws->num_files++);
    FILE *file = fopen(path, "wb");
    uint32_t parts = image->layers ? image->layers : image->levels ? image->levels : 1;
    size_t from = 0;
    for (uint32_t part = 0; file && part < parts; ++part) {
        uint32_t level = image->layers ? 0 : part, width = image_level_size(image->width, level),
                 height = image_level_size(image->height, level);
        float *texels = malloc((size_t)width * height * 4 * sizeof *texels);
        for (uint32_t y = 0; texels && y < height; ++y)
            for (uint32_t i = 0; i < 4 * width; ++i)
                texels[4 * (size_t)width * (texture->bottom_first ? height - 1 - y : y) + i] =
                    image_channel(image, from++);
        write_levels(file, texels, width, height,
                     texture->has_mips && !image->levels && !image->layers ? image_num_mips(image)
                                                                           : 1);
    }
    free(path);
    return file && fclose(file) == 0;
}

/* The number of the image's file; images of the scene have one for all draws. */
static bool image_file(struct draws *draws, const struct bind *bind,
                       const struct draw_texture *texture, size_t *out)
{
    size_t i = 0;
    bool is_own =
        texture->image >= bind->images && texture->image < bind->images + bind->num_images;
    *out = draws->num_files;
    if (is_own)
        return write_image(draws, texture);
    while (i < draws->num_images
           && (draws->images[i].image != texture->image
               || draws->images[i].bottom_first != texture->bottom_first
               || draws->images[i].has_mips != texture->has_mips))
        ++i;
    if (i < draws->num_images) {
        *out = draws->images[i].file;
        return true;
    }
    if (i == DRAWS_MAX_IMAGES)
        return false;
    draws->images[draws->num_images++] = (struct draws_image){texture->image, texture->bottom_first,
                                                              texture->has_mips, draws->num_files};
    return write_image(draws, texture);
}

/* ---- Draws ---- */

static const char *attribute_format(VkFormat format)
{
    switch (format) {
    case VK_FORMAT_R32_SFLOAT: return "float32";
    case VK_FORMAT_R32G32_SFLOAT: return "float32x2";
    case VK_FORMAT_R32G32B32_SFLOAT: return "float32x3";
    case VK_FORMAT_R32G32B32A32_SFLOAT: return "float32x4";
    case VK_FORMAT_R32_SINT: return "sint32";
    case VK_FORMAT_R32G32_SINT: return "sint32x2";
    case VK_FORMAT_R32G32B32_SINT: return "sint32x3";
    default: return "sint32x4";
    }
}

/* WebGPU has no border: the edge stands in for it. */
static const char *address_mode(VkSamplerAddressMode mode)
{
    return mode == VK_SAMPLER_ADDRESS_MODE_REPEAT            ? "repeat"
           : mode == VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT ? "mirror-repeat"
                                                             : "clamp-to-edge";
}

static json_t *vertices_of(const struct draw *draw)
{
    const struct draw_object *object = &draw->objects[0];
    size_t stride = (size_t)draw->num_attributes * 16;
    char *bytes = calloc(object->num_vertices, stride ? stride : 1);
    for (uint32_t i = 0; bytes && i < object->num_vertices; ++i)
        for (uint32_t k = 0; k < draw->num_attributes; ++k)
            memcpy(bytes + i * stride + (size_t)k * 16,
                   (const char *)object->attributes[k] + (size_t)i * 16, 16);
    json_t *value = bytes ? hex(bytes, object->num_vertices * stride) : NULL;
    free(bytes);
    return value;
}

/* The grid's last vertices are the centres of its pixels, from the bottom. */
static json_t *points_of(const struct draw *draw, uint32_t width, uint32_t height)
{
    json_t *points = json_array();
    for (uint32_t y = height; y-- > 0;)
        for (uint32_t x = 0; x < width && width * height == ROW_PIXELS; ++x)
            json_array_append_new(
                points, json_integer(draw->objects[0].num_vertices - ROW_PIXELS + y * width + x));
    return points;
}

static json_t *attributes_of(const struct draw *draw)
{
    json_t *list = json_array();
    for (uint32_t i = 0; i < draw->num_attributes; ++i)
        json_array_append_new(list,
                              json_pack("{s:i, s:s}", "location", (int)draw->attributes[i].location,
                                        "format", attribute_format(draw->attributes[i].format)));
    return list;
}

static json_t *blocks_of(const struct draw *draw)
{
    json_t *list = json_array();
    for (uint32_t i = 0; i < draw->num_blocks; ++i) {
        const struct draw_block *block = &draw->blocks[i];
        json_array_append_new(list, json_pack("{s:i, s:i, s:o}", "set", (int)block->set, "binding",
                                              (int)block->binding, "bytes",
                                              hex(draw->objects[0].blocks[i], block->size)));
    }
    return list;
}

/* bind_shader adds textures in the order of the variables. */
static uint32_t sampler_binding(const mxg_result *result, uint32_t texture)
{
    mxg_variable variable = {sizeof variable};
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_result_variable(result, i, &variable);
        if (variable.block == MXG_BLOCK_TEXTURES && texture-- == 0)
            break;
    }
    return variable.sampler_binding;
}

static json_t *texture_of(struct draws *draws, const struct bind *bind, uint32_t index)
{
    const struct draw_texture *texture = &bind->draw.textures[index];
    const struct image *image = texture->image;
    size_t number;
    if (!image_file(draws, bind, texture, &number))
        return NULL;
    char *path = image_path(draws, number);
    uint32_t levels = texture->has_mips && !image->layers ? image_num_mips(image) : 1;
    json_t *value = json_pack("{s:i, s:i, s:i, s:s, s:i, s:i, s:i, s:i, s:s, s:s, s:s}", "set",
                              (int)texture->set, "binding", (int)texture->binding, "samplerBinding",
                              (int)sampler_binding(bind->result, index), "file", path, "width",
                              (int)image->width, "height", (int)image->height, "layers",
                              (int)image->layers, "levels", (int)levels, "u",
                              address_mode(texture->u), "v", address_mode(texture->v), "filter",
                              texture->filter == VK_FILTER_NEAREST ? "nearest" : "linear");
    free(path);
    return value;
}

static json_t *textures_of(struct draws *draws, const struct bind *bind)
{
    json_t *list = json_array();
    for (uint32_t i = 0; i < bind->draw.num_textures; ++i)
        json_array_append_new(list, texture_of(draws, bind, i));
    return json_array_size(list) == bind->draw.num_textures ? list : NULL;
}

bool draws_add(struct draws *draws, const struct bind *bind, const char *group, uint32_t width,
               uint32_t height)
{
    const struct draw *draw = &bind->draw;
    const struct draw_object *object = &draw->objects[0];
    json_t *line =
        json_pack("{s:s, s:i, s:i, s:b, s:s, s:s, s:o, s:o, s:o, s:o, s:o, s:o}", "group", group,
                  "width", (int)width, "height", (int)height, "blend", draw->blend, "vertex",
                  mxg_result_source(bind->result, MXG_STAGE_VERTEX, NULL), "pixel",
                  mxg_result_source(bind->result, MXG_STAGE_PIXEL, NULL), "points",
                  points_of(draw, width, height), "indices",
                  hex(object->indices, object->num_indices * sizeof *object->indices), "vertices",
                  vertices_of(draw), "attributes", attributes_of(draw), "blocks", blocks_of(draw),
                  "textures", textures_of(draws, bind));
    bool good =
        line && json_dumpf(line, draws->file, JSON_STYLE) == 0 && fputc('\n', draws->file) != EOF;
    json_decref(line);
    if (!good)
        printf("%s: the draw cannot be written\n", group);
    return good;
}

/* ---- Answers ---- */

bool draws_run(struct draws *draws, const char *command)
{
    size_t size = strlen(command) + strlen(draws->path) + 4;
    char *text = malloc(size);
    bool good = fclose(draws->file) == 0 && text != NULL;
    draws->file = NULL;
    if (good) {
        snprintf(text, size, "%s '%s'", command, draws->path);
        draws->file = popen(text, "r");
        draws->is_running = draws->file != NULL;
    }
    free(text);
    if (!draws->file)
        printf("'%s' cannot be started\n", command);
    return draws->file != NULL;
}

enum draws_answer draws_next(struct draws *draws, float *out_pixels, size_t num_pixels,
                             const char **out_reason)
{
    static const char *const keys[] = {
        [DRAWS_SKIPPED] = "skip", [DRAWS_FAILED] = "error", [DRAWS_ABSENT] = "absent"};
    json_t *answer = lines_next(draws->file, &draws->line, &draws->room)
                         ? json_loads(draws->line, 0, NULL)
                         : NULL;
    enum draws_answer kind = DRAWS_FAILED;
    *out_reason = "the command gave no answer";
    if (read_hex(json_text_of(answer, "pixels"), out_pixels, num_pixels * 4 * sizeof *out_pixels))
        kind = DRAWS_DRAWN;
    for (size_t i = DRAWS_SKIPPED; i < sizeof keys / sizeof *keys; ++i)
        if (json_object_get(answer, keys[i])) {
            kind = (enum draws_answer)i;
            snprintf(draws->reason, sizeof draws->reason, "%s", json_text_of(answer, keys[i]));
            *out_reason = draws->reason;
        }
    draws->accuracy = json_number_value(json_object_get(answer, "accuracy"));
    json_decref(answer);
    return kind;
}
