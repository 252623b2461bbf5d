// SPDX-License-Identifier: Apache-2.0
#include "render/aovs.h"

#include "program/cli.h"
#include "program/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PREFIX "aov:"
#define MATTE "matte."

/* ---- The list ---- */

static bool is_aov(const mxg_variable *variable)
{
    return variable->block == MXG_BLOCK_OUTPUTS
           && strncmp(variable->semantic, PREFIX, strlen(PREFIX)) == 0;
}

static bool has(const struct aovs *aovs, const char *name)
{
    for (size_t i = 0; i < aovs->len; ++i)
        if (strcmp(aovs->items[i].name, name) == 0)
            return true;
    return false;
}

void aovs_add(struct aovs *aovs, const mxg_result *result)
{
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_variable variable = {sizeof variable};
        mxg_result_variable(result, i, &variable);
        const char *name = variable.semantic + strlen(PREFIX);
        if (!is_aov(&variable) || has(aovs, name))
            continue;
        struct picture_aov *items = memory_alloc((aovs->len + 1) * sizeof *items);
        if (aovs->len)
            memcpy(items, aovs->items, aovs->len * sizeof *items);
        free(aovs->items);
        aovs->items = items;
        items[aovs->len++] = (struct picture_aov){.name = cli_format("%s", name),
                                                  .type = cli_format("%s", variable.document_type)};
    }
}

bool aovs_is_whole(const char *type)
{
    return strcmp(type, "integer") == 0 || strcmp(type, "boolean") == 0;
}

bool aovs_has_alpha(const struct picture_aov *aov)
{
    return !aovs_is_whole(aov->type) && strcmp(aov->type, "color4") != 0
           && strcmp(aov->type, "vector4") != 0;
}

bool aovs_is_scattered(const struct picture_aov *aov)
{
    return strcmp(aov->type, "BSDF") == 0;
}

bool aovs_find(const struct picture_aov *aov, const mxg_result *result, enum aovs_output which,
               mxg_variable *out)
{
    static const char *const prefixes[] = {PREFIX, "aov_weight:", "aov_response:", "aov_light:"};
    const char *prefix = prefixes[which];
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        *out = (mxg_variable){sizeof *out};
        mxg_result_variable(result, i, out);
        if (out->block == MXG_BLOCK_OUTPUTS && strncmp(out->semantic, prefix, strlen(prefix)) == 0
            && strcmp(out->semantic + strlen(prefix), aov->name) == 0)
            return true;
    }
    return false;
}

size_t aovs_num(const struct aovs *aovs)
{
    return aovs ? aovs->len : 0;
}

size_t aovs_num_scattered(const struct aovs *aovs)
{
    size_t count = 0;
    for (size_t i = 0; i < aovs_num(aovs); ++i)
        count += aovs_is_scattered(&aovs->items[i]);
    return count;
}

size_t aovs_stride(const struct aovs *aovs)
{
    return aovs_num(aovs) + AOVS_SCATTERED * aovs_num_scattered(aovs);
}

void aovs_list(const struct aovs *aovs, size_t first, size_t count, mxg_options *options)
{
    mxg_options_set(options, "aovs", "none");
    for (size_t i = first; i < first + count; ++i) {
        char *item = cli_format("%s=%s", aovs->items[i].name, aovs->items[i].type);
        mxg_options_set(options, "aovs", item);
        free(item);
    }
}

void aovs_finish(struct aovs *aovs)
{
    for (size_t i = 0; i < aovs->len; ++i) {
        free(aovs->items[i].name);
        free(aovs->items[i].type);
        free(aovs->items[i].pixels);
    }
    free(aovs->items);
    *aovs = (struct aovs){0};
}

/* ---- Channels ---- */

/* The letters of a type's channels; "" has one channel of the AOV's own name. */
static const char *channels_of(const char *type)
{
    static const struct {
        const char *type, *channels;
    } rows[] = {{"color3", "RGB"},   {"color4", "RGBA"}, {"vector2", "XY"}, {"vector3", "XYZ"},
                {"vector4", "XYZW"}, {"BSDF", "RGB"},    {"EDF", "RGB"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i)
        if (strcmp(rows[i].type, type) == 0)
            return rows[i].channels;
    return "";
}

struct image_plane *aovs_planes(const struct aovs *aovs, uint32_t *out_count)
{
    struct image_plane *planes = memory_alloc((4 * aovs->len + 1) * sizeof *planes);
    *out_count = 0;
    for (size_t i = 0; i < aovs->len; ++i) {
        const struct picture_aov *aov = &aovs->items[i];
        const char *channels = channels_of(aov->type);
        size_t count = *channels ? strlen(channels) : 1;
        for (size_t c = 0; aov->pixels && c < count; ++c)
            planes[(*out_count)++] =
                (struct image_plane){*channels ? cli_format("%s.%c", aov->name, channels[c])
                                               : cli_format("%s", aov->name),
                                     aov->pixels + c, 4};
    }
    return planes;
}

void aovs_finish_planes(struct image_plane *planes, uint32_t count)
{
    for (uint32_t i = 0; i < count; ++i)
        free((void *)(uintptr_t)planes[i].name);
    free(planes);
}

/* ---- Slots ---- */

/* A bright colour; those of consecutive numbers differ, by the golden ratio. */
static void slot_color(size_t number, double out[3])
{
    double hue = fmod((double)number * 0.61803398875, 1.0);
    for (size_t c = 0; c < 3; ++c) {
        double ramp = fabs(fmod(hue * 6 + 4.0 * (double)(3 - c) / 2.0, 6.0) - 3) - 1;
        out[c] = 0.1 + 0.8 * fmin(fmax(ramp, 0.0), 1.0);
    }
}

static int compare_names(const void *a, const void *b)
{
    const struct picture_aov *const *x = a, *const *y = b;
    return strcmp((*x)->name, (*y)->name);
}

/* The mattes of slots, without those of vertical layers, by name. */
static const struct picture_aov **find_mattes(const struct aovs *aovs, size_t *out_count)
{
    const struct picture_aov **mattes = memory_alloc((aovs->len + 1) * sizeof *mattes);
    *out_count = 0;
    for (size_t i = 0; i < aovs->len; ++i) {
        const char *name = aovs->items[i].name;
        if (strncmp(name, MATTE, strlen(MATTE)) == 0 && !strchr(name, '|') && aovs->items[i].pixels)
            mattes[(*out_count)++] = &aovs->items[i];
    }
    qsort(mattes, *out_count, sizeof *mattes, compare_names);
    return mattes;
}

void aovs_show(const struct aovs *aovs, bool blends, struct image *picture,
               void (*legend)(void *user_data, const char *slot, const unsigned char color[3]),
               void *user_data)
{
    size_t count, pixels = (size_t)picture->width * picture->height;
    const struct picture_aov **mattes = find_mattes(aovs, &count);
    float *pixel = picture->pixels;
    for (size_t i = 0; legend && i < count; ++i) {
        double color[3];
        unsigned char bytes[3];
        slot_color(i, color);
        for (size_t c = 0; c < 3; ++c)
            bytes[c] = (unsigned char)(255 * pow(color[c], 1 / 2.2) + 0.5);
        legend(user_data, mattes[i]->name + strlen(MATTE), bytes);
    }
    for (size_t p = 0; p < pixels; ++p, pixel += 4) {
        size_t greatest = 0;
        double sum[3] = {0}, color[3] = {0};
        for (size_t i = 0; i < count; ++i) {
            slot_color(i, color);
            for (size_t c = 0; c < 3; ++c)
                sum[c] += (double)mattes[i]->pixels[4 * p] * color[c];
            greatest = mattes[i]->pixels[4 * p] > mattes[greatest]->pixels[4 * p] ? i : greatest;
        }
        slot_color(greatest, color);
        for (size_t c = 0; c < 3; ++c)
            pixel[c] = (float)(blends ? sum[c] : color[c] * (double)pixel[3]);
    }
    free(mattes);
}
