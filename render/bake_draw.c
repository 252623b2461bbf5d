// SPDX-License-Identifier: Apache-2.0
/*
 * Draws what the plan draws: AOVs of a surface in a copy of the document, and the surface lies flat
 * in a picture. Large images are drawn in pieces.
 */
#include "render/bake.h"

#include "program/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MAX_SIDE = 1024,                  /* of a piece, in samples */
    MAX_CHUNK = DRAW_MAX_OUTPUTS - 1, /* drawings that are drawn together */
    SIZE = 1024                       /* without textures */
};
#define MATERIAL "mxgen_bake_material"

/* ---- The document that is drawn ---- */

/* Where the values of a drawing come from in an edit: an element with an output. */
struct source {
    mxg_element element;
    const char *output;
};

/* An output of the nodegraph around a node makes its value visible at the top. */
static struct source lift(mxg_edit *edit, const mxg_document *document,
                          const struct bake_drawing *drawing, const char *name)
{
    struct source source = {drawing->source, *drawing->output ? drawing->output : NULL};
    mxg_element graph = bake_element(document, drawing->source).parent;
    if (strcmp(bake_element(document, graph).category, "nodegraph") != 0)
        return source;
    mxg_element output = mxg_edit_add_element(edit, graph, "output", name, drawing->type);
    mxg_edit_connect_input(edit, output, NULL, source.element, source.output);
    return (struct source){graph, name};
}

static mxg_element add_node(mxg_edit *edit, const char *category, const char *stem,
                            const char *suffix, const char *type)
{
    char *name = cli_format("%s_%s", stem, suffix);
    mxg_element node = mxg_edit_add_element(edit, 0, category, name, type);
    free(name);
    return node;
}

/* Makes a normal map of a direction: its parts along the frame, from 0 to 1. */
static struct source encode(mxg_edit *edit, struct source direction, const char *name)
{
    static const char *const axes[] = {"tangent", "bitangent", "normal"}, *const inputs[] = {
                                                                              "in1", "in2", "in3"};
    mxg_element unit = add_node(edit, "normalize", name, "unit", "vector3"),
                parts = add_node(edit, "combine3", name, "parts", "vector3"),
                half = add_node(edit, "multiply", name, "half", "vector3"),
                shifted = add_node(edit, "add", name, "shifted", "vector3");
    mxg_edit_connect_input(edit, unit, "in", direction.element, direction.output);
    for (size_t i = 0; i < 3; ++i) {
        mxg_element axis = add_node(edit, axes[i], name, axes[i], "vector3"),
                    part = add_node(edit, "dotproduct", name, inputs[i], "float");
        mxg_edit_set_value(edit, axis, "space", "string", "world");
        mxg_edit_connect_input(edit, part, "in1", unit, NULL);
        mxg_edit_connect_input(edit, part, "in2", axis, NULL);
        mxg_edit_connect_input(edit, parts, inputs[i], part, NULL);
    }
    mxg_edit_connect_input(edit, half, "in1", parts, NULL);
    mxg_edit_set_value(edit, half, "in2", "float", "0.5");
    mxg_edit_connect_input(edit, shifted, "in1", half, NULL);
    mxg_edit_set_value(edit, shifted, "in2", "float", "0.5");
    return (struct source){shifted, NULL};
}

static char *name_of(size_t drawing)
{
    return cli_format("mxgen_bake_%zu", drawing);
}

static void add_aov(mxg_edit *edit, const struct baking *baking, size_t index)
{
    const struct bake_drawing *drawing = &baking->plan.drawings[index];
    char *name = name_of(index);
    struct source source = lift(edit, baking->document, drawing, name);
    if (drawing->is_direction)
        source = encode(edit, source, name);
    mxg_element aov = mxg_edit_add_element(edit, 0, "aov", name, drawing->type);
    mxg_edit_set_value(edit, aov, "name", "string", name);
    mxg_edit_connect_input(edit, aov, "value", source.element, source.output);
    free(name);
}

/* The document with an AOV for each drawing of one surface. NULL after reporting an error. */
static mxg_document *make_document(struct baking *baking)
{
    struct cli *cli = &baking->cli;
    mxg_edit *edit = NULL;
    mxg_document *document = NULL;
    char reason[256] = "";
    mxg_status status = mxg_edit_create(cli->context, cli->library, baking->document, NULL, &edit);
    if (status == MXG_OK) {
        mxg_element surface =
            mxg_edit_add_element(edit, 0, "surface_unlit", "mxgen_bake_surface", "surfaceshader");
        mxg_element material =
            mxg_edit_add_element(edit, 0, "surfacematerial", MATERIAL, "material");
        mxg_edit_connect_input(edit, material, "surfaceshader", surface, NULL);
        for (size_t i = 0; i < baking->plan.num_drawings; ++i)
            add_aov(edit, baking, i);
        mxg_edit_error(edit, reason, sizeof reason);
        if (!*reason)
            status = mxg_edit_commit(edit, &document);
    }
    mxg_edit_destroy(edit);
    if (*reason)
        report_error(&cli->report, "render-failed", "cannot bake '%s': %s", baking->path, reason);
    if (status == MXG_OK && document)
        return document;
    if (document)
        report_list(&cli->report, mxg_document_diagnostics(document));
    report_status(&cli->report, status);
    mxg_document_destroy(document);
    return NULL;
}

/* ---- Pieces ---- */

/* Drawings that are drawn together, with a spool for each tile of each. */
struct chunk {
    struct baking *baking;
    size_t drawings[MAX_CHUNK];
    size_t num;
    uint32_t size, piece; /* sides of an image, and of what is drawn at once, in texels */
    bool varies;          /* over the surface: with its mesh, if there is one */
    const struct bake_tiles *tiles;
    struct spool *spools; /* of the tiles of the first drawing, then of the next one */
    uint64_t num_bad;     /* texels that were NaN or infinite */
    size_t bad;           /* a drawing that has some */
};

/* The mean of the samples of a texel that the surface covers; empty if there is none. */
static void take_texel(const struct picture_aov *aov, size_t at, float coverage, uint32_t channels,
                       float *out, uint64_t *num_bad)
{
    bool is_bad = false;
    for (uint32_t c = 0; c < channels; ++c) {
        float value = aov->pixels[4 * at + c];
        out[c] = coverage > 0 ? aovs_is_whole(aov->type) ? value : value / coverage : NAN;
        is_bad |= coverage > 0 && !isfinite(out[c]);
    }
    *num_bad += is_bad;
    for (uint32_t c = 0; is_bad && c < channels; ++c)
        out[c] = 0;
}

static const char *take_piece(struct chunk *chunk, const struct image *picture, uint32_t tile,
                              uint32_t x, uint32_t y)
{
    const float *pixels = picture->pixels;
    uint32_t width = chunk->size - x < chunk->piece ? chunk->size - x : chunk->piece,
             height = chunk->size - y < chunk->piece ? chunk->size - y : chunk->piece;
    float *row = memory_alloc(4 * sizeof *row * width);
    const char *reason = NULL;
    for (size_t i = 0; i < chunk->num; ++i) {
        struct spool *spool = &chunk->spools[i * chunk->tiles->num + tile];
        const struct picture_aov *aov = &chunk->baking->painter.aovs.items[i];
        uint64_t before = chunk->num_bad;
        for (uint32_t r = 0; !reason && r < height; ++r) {
            for (uint32_t k = 0; k < width; ++k) {
                size_t at = (size_t)r * chunk->piece + k;
                take_texel(aov, at, pixels[4 * at + 3], spool->channels,
                           row + (size_t)k * spool->channels, &chunk->num_bad);
            }
            reason = spool_put(spool, x, y + r, width, row);
        }
        chunk->bad = chunk->num_bad > before ? chunk->drawings[i] : chunk->bad;
    }
    free(row);
    return reason;
}

static bool draw_piece(struct chunk *chunk, struct painting *painting, uint32_t tile, uint32_t x,
                       uint32_t y)
{
    struct baking *baking = chunk->baking;
    struct painter *painter = &baking->painter;
    struct image picture;
    painter->scene.projection =
        bake_surface_view(chunk->tiles->items[tile], chunk->size, x, y, chunk->piece, chunk->piece);
    painting_aim(painting);
    bool good = painting_draw(painting, &picture);
    const char *reason = good ? take_piece(chunk, &picture, tile, x, y) : NULL;
    if (reason)
        report_error(&baking->cli.report, "output-failed", "cannot write to '%s': %s",
                     baking->options.output, reason);
    image_finish(&picture);
    for (size_t i = 0; i < painter->aovs.len; ++i) {
        free(painter->aovs.items[i].pixels);
        painter->aovs.items[i].pixels = NULL;
    }
    return good && !reason;
}

static bool draw_pieces(struct chunk *chunk, struct painting *painting)
{
    bool good = true;
    for (uint32_t t = 0; t < chunk->tiles->num; ++t)
        for (uint32_t y = 0; good && y < chunk->size; y += chunk->piece)
            for (uint32_t x = 0; good && x < chunk->size; x += chunk->piece)
                good = draw_piece(chunk, painting, t, x, y);
    if (good && chunk->num_bad)
        report_error(
            &chunk->baking->cli.report, "bad-pixels", "'%s': %llu texels are NaN or infinite",
            chunk->baking->plan.drawings[chunk->bad].path, (unsigned long long)chunk->num_bad);
    return good && !chunk->num_bad;
}

/* ---- Chunks ---- */

static bool open_spools(struct chunk *chunk)
{
    struct baking *baking = chunk->baking;
    const char *reason = NULL;
    chunk->spools = memory_alloc((chunk->num * chunk->tiles->num + 1) * sizeof *chunk->spools);
    for (size_t i = 0; !reason && i < chunk->num * chunk->tiles->num; ++i) {
        const struct bake_drawing *drawing =
            &baking->plan.drawings[chunk->drawings[i / chunk->tiles->num]];
        reason = spool_open(&chunk->spools[i], baking->options.output, chunk->size, chunk->size,
                            bake_channels(drawing->type));
    }
    if (reason)
        report_error(&baking->cli.report, "output-failed", "cannot write to '%s': %s",
                     baking->options.output, reason);
    return !reason;
}

static void list_aovs(struct chunk *chunk)
{
    struct painter *painter = &chunk->baking->painter;
    aovs_finish(&painter->aovs);
    painter->aovs.items = memory_alloc(chunk->num * sizeof *painter->aovs.items);
    for (size_t i = 0; i < chunk->num; ++i)
        painter->aovs.items[painter->aovs.len++] = (struct picture_aov){
            .name = name_of(chunk->drawings[i]),
            .type = cli_format("%s", chunk->baking->plan.drawings[chunk->drawings[i]].type)};
    painter->first_aov = 0;
    painter->num_aovs = chunk->num;
    aovs_list(&painter->aovs, 0, chunk->num, chunk->baking->cli.options);
}

static bool draw_chunk(struct chunk *chunk, const mxg_document *document)
{
    struct baking *baking = chunk->baking;
    struct painter *painter = &baking->painter;
    bool has_mesh = baking->surface.objects && chunk->varies;
    const struct subject subject = {.document = document,
                                    .path = baking->path,
                                    .element = MATERIAL,
                                    .objects = has_mesh ? baking->surface.objects : NULL,
                                    .num_objects = has_mesh ? baking->surface.num_objects : 0};
    struct painting painting = {0};
    uint32_t most = MAX_SIDE / (uint32_t)baking->options.samples;
    chunk->piece = chunk->size < most ? chunk->size : most;
    painter->width = painter->height = chunk->piece;
    painter->oversampling = chunk->varies ? (unsigned)baking->options.samples : 1;
    bake_surface_cover(&baking->surface, chunk->tiles);
    list_aovs(chunk);
    bool good = open_spools(chunk) && painting_open(painter, &subject, 1, &painting)
                && draw_pieces(chunk, &painting);
    painting_close(&painting);
    for (size_t i = 0; good && i < chunk->num; ++i)
        good = bake_finish_drawing(baking, &baking->plan.drawings[chunk->drawings[i]],
                                   &chunk->spools[i * chunk->tiles->num], chunk->tiles->num);
    for (size_t i = 0; i < chunk->num * chunk->tiles->num; ++i)
        spool_close(&chunk->spools[i]);
    free(chunk->spools);
    return good;
}

static uint32_t size_of(const struct baking *baking, const struct bake_drawing *drawing)
{
    uint32_t asked = bake_asked_size(baking, drawing);
    return !drawing->needs        ? 1
           : baking->options.size ? (uint32_t)baking->options.size
           : asked                ? asked
           : drawing->largest     ? drawing->largest
                                  : SIZE;
}

/* True if two drawings can be drawn together. */
static bool are_alike(const struct baking *baking, const struct bake_drawing *a,
                      const struct bake_drawing *b)
{
    return !a->needs == !b->needs && size_of(baking, a) == size_of(baking, b)
           && bake_tiles_are_equal(bake_tiles_of(baking, a), bake_tiles_of(baking, b));
}

/* Draws those that are like one. */
static bool draw_all_like(struct baking *baking, const mxg_document *document,
                          const struct bake_drawing *drawing)
{
    bool good = true;
    for (size_t next = 0; good && next < baking->plan.num_drawings;) {
        struct chunk chunk = {.baking = baking,
                              .size = size_of(baking, drawing),
                              .varies = drawing->needs != 0,
                              .tiles = bake_tiles_of(baking, drawing)};
        for (; next < baking->plan.num_drawings && chunk.num < MAX_CHUNK; ++next)
            if (are_alike(baking, &baking->plan.drawings[next], drawing))
                chunk.drawings[chunk.num++] = next;
        good = !chunk.num || draw_chunk(&chunk, document);
    }
    return good;
}

/* True if no drawing before this one is like it. */
static bool is_first_of_kind(const struct baking *baking, size_t index)
{
    const struct bake_drawing *drawings = baking->plan.drawings;
    for (size_t i = 0; i < index; ++i)
        if (are_alike(baking, &drawings[i], &drawings[index]))
            return false;
    return true;
}

bool bake_draw(struct baking *baking)
{
    mxg_document *document = baking->plan.num_drawings ? make_document(baking) : NULL;
    bool good = document || !baking->plan.num_drawings;
    for (size_t i = 0; good && i < baking->plan.num_drawings; ++i)
        if (is_first_of_kind(baking, i))
            good = draw_all_like(baking, document, &baking->plan.drawings[i]);
    mxg_document_destroy(document);
    return good;
}
