// SPDX-License-Identifier: Apache-2.0
/* Finds what drawings read, by generating each of them alone. */
#include "render/bake.h"

#include <stdlib.h>
#include <string.h>

/* ---- Semantics ---- */

static bool begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

/* The needs of the pixel stage for a stream. */
static unsigned need_of_stream(const char *semantic)
{
    static const char *const frames[] = {"normal:", "tangent:", "bitangent:", NULL};
    char name[SCENE_MAX_NAME];
    if (strcmp(semantic, "texcoord:0") == 0
        || scene_is_texcoord(scene_name(semantic, semantic, name)))
        return BAKE_VARIES;
    for (size_t i = 0; frames[i]; ++i)
        if (begins(semantic, frames[i]))
            return BAKE_VARIES | BAKE_FRAME;
    return BAKE_VARIES | (begins(semantic, "view") ? BAKE_VIEW : BAKE_GEOMETRY);
}

static unsigned need_of_uniform(const char *semantic)
{
    static const char *const fixed[] = {"frame",    "time",        "alphaThreshold",
                                        "slabUnit", "layerSample", NULL};
    if (args_is_one_of(semantic, fixed) || begins(semantic, "worldMatrix"))
        return 0;
    bool is_space = begins(semantic, "world") && !begins(semantic, "worldView");
    return is_space ? 0 : begins(semantic, "geomprop") ? BAKE_GEOMETRY : BAKE_VIEW;
}

static unsigned need_of(const mxg_variable *variable)
{
    if (!(variable->stages & (1u << MXG_STAGE_PIXEL)))
        return 0;
    switch (variable->block) {
    case MXG_BLOCK_PRIVATE_UNIFORMS: return need_of_uniform(variable->semantic);
    case MXG_BLOCK_LIGHT_DATA: return BAKE_VIEW;
    case MXG_BLOCK_TEXTURES: return BAKE_VARIES | (*variable->semantic ? BAKE_VIEW : 0u);
    case MXG_BLOCK_VERTEX_DATA: return need_of_stream(variable->semantic);
    default: return 0;
    }
}

/* ---- Textures ---- */

static void read_texture(struct baking *baking, const mxg_result *result, uint32_t index,
                         uint32_t tile, struct bake_drawing *drawing)
{
    char name[4096], reason[256];
    uint32_t side = 0;
    int32_t frame = (int32_t)baking->options.frame;
    mxg_variable variable = {sizeof variable};
    if (mxg_result_variable(result, index, &variable) != MXG_OK
        || !mxg_result_texture_file(result, index, tile, frame, name, sizeof name))
        return;
    char *path = cli_beside(variable.origin, name);
    outputs_read(&baking->files, &baking->cli.report, path);
    if (image_find_size(path, &side, reason, sizeof reason) && side > drawing->largest)
        drawing->largest = side;
    free(path);
}

static void read_textures(struct baking *baking, const mxg_result *result, uint32_t index,
                          const mxg_variable *variable, struct bake_drawing *drawing)
{
    for (uint32_t i = 0; i < variable->num_tiles; ++i) {
        mxg_tile tile = {sizeof tile};
        read_texture(baking, result, index, i, drawing);
        if (mxg_result_tile(result, index, i, &tile) == MXG_OK && tile.u >= 0 && tile.v >= 0)
            bake_tiles_add(&drawing->tiles, (struct bake_tile){tile.u, tile.v});
    }
    drawing->tiles.is_set |= variable->num_tiles && !baking->has_plain_tile;
    if (!variable->num_tiles)
        read_texture(baking, result, index, 0, drawing);
}

/* ---- Drawings ---- */

mxg_result *bake_generate(struct baking *baking, const char *path, bool tells)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_result *result = NULL;
    desc.target = "vulkan";
    desc.element = path;
    desc.options = baking->cli.options;
    desc.without_source = true;
    mxg_status status = mxg_generate(baking->cli.context, baking->document, &desc, &result);
    if (result && tells)
        report_list(&baking->cli.report, mxg_result_diagnostics(result));
    if (status != MXG_OK && tells)
        report_status(&baking->cli.report, status);
    if (status == MXG_OK)
        return result;
    mxg_result_destroy(result);
    return NULL;
}

static unsigned needs_of(const mxg_result *result)
{
    unsigned needs = 0;
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_variable variable = {sizeof variable};
        mxg_result_variable(result, i, &variable);
        needs |= need_of(&variable);
    }
    return needs;
}

/* True if what an element gives needs one of these. */
static bool needs_any(struct baking *baking, mxg_element element, unsigned needs)
{
    char *path = bake_path(baking->document, element);
    mxg_result *result = bake_generate(baking, path, false);
    bool has = result && (needs_of(result) & needs);
    mxg_result_destroy(result);
    free(path);
    return has;
}

/* The node farthest from the drawing that still needs one of these. */
static mxg_element find_culprit(struct baking *baking, mxg_element node, unsigned needs)
{
    enum { MAX_STEPS = 1000 };
    for (int step = 0; step < MAX_STEPS; ++step) {
        mxg_element child = bake_element(baking->document, node).first_child, found = 0;
        while (child && !found) {
            struct bake_end end = bake_follow(baking->document, child);
            found = end.node && needs_any(baking, end.node, needs) ? end.node : 0;
            child = bake_element(baking->document, child).next;
        }
        if (!found)
            return node;
        node = found;
    }
    return node;
}

static bool fail_for(struct baking *baking, const struct bake_drawing *drawing, unsigned needs,
                     const char *id, const char *reason)
{
    mxg_element culprit = find_culprit(baking, drawing->source, needs);
    char *port = bake_path(baking->document, drawing->port),
         *path = bake_path(baking->document, culprit), *place = bake_place(baking, culprit);
    report_error(&baking->cli.report, id, "'%s' (%s), which '%s' reads, %s", path, place, port,
                 reason);
    free(place);
    free(port);
    free(path);
    return false;
}

/* The components of a type that an image or a value of an AOV can have; 0: of none. */
uint32_t bake_channels(const char *type)
{
    static const struct {
        const char *type;
        uint32_t channels;
    } rows[] = {{"float", 1},   {"integer", 1}, {"boolean", 1}, {"vector2", 2},
                {"vector3", 3}, {"color3", 3},  {"vector4", 4}, {"color4", 4}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i)
        if (strcmp(type, rows[i].type) == 0)
            return rows[i].channels;
    return 0;
}

static bool find_needs(struct baking *baking, struct bake_drawing *drawing)
{
    mxg_result *result = bake_generate(baking, drawing->path, true);
    if (!result)
        return false;
    drawing->needs = needs_of(result);
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_variable variable = {sizeof variable};
        mxg_result_variable(result, i, &variable);
        if (variable.block == MXG_BLOCK_TEXTURES)
            read_textures(baking, result, i, &variable, drawing);
    }
    if (!drawing->tiles.num)
        bake_tiles_add(&drawing->tiles, (struct bake_tile){0, 0});
    mxg_result_destroy(result);
    return true;
}

const struct bake_tiles *bake_tiles_of(const struct baking *baking,
                                       const struct bake_drawing *drawing)
{
    bool is_on_mesh = baking->surface.objects && drawing->needs;
    return is_on_mesh ? &baking->surface.tiles : &drawing->tiles;
}

bool bake_find_needs(struct baking *baking, struct bake_drawing *drawing)
{
    if (!find_needs(baking, drawing))
        return false;
    unsigned missing = baking->surface.objects ? 0u
                       : drawing->is_direction ? (unsigned)BAKE_GEOMETRY
                                               : (unsigned)BAKE_GEOMETRY | BAKE_FRAME;
    if (drawing->needs & BAKE_VIEW)
        return fail_for(baking, drawing, BAKE_VIEW, "bake-view",
                        "depends on the view, the light or what lies around, so no "
                        "image can have it");
    if (drawing->needs & missing)
        return fail_for(baking, drawing, missing, "bake-mesh",
                        "reads the geometry of a surface: say which with --mesh");
    if (!bake_channels(drawing->type) || (aovs_is_whole(drawing->type) && drawing->needs)) {
        char *place = bake_place(baking, drawing->port);
        report_error(&baking->cli.report, "bake-type",
                     "'%s' (%s) varies, and no image has values of the type '%s'", drawing->path,
                     place, drawing->type);
        free(place);
        return false;
    }
    if (drawing->is_direction) /* the frame of the surface is part of what is drawn */
        drawing->needs |= BAKE_VARIES;
    return true;
}
