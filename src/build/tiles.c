// SPDX-License-Identifier: Apache-2.0
/*
 * Images of several files, one for each unit square of texture coordinates (specification,
 * "Filename Substitutions"):
 *
 *     <UDIM>     1001 + u + 10 v           <UVTILE>     u(1 + u)_v(1 + v)
 *
 * The geometry property 'udimset' or 'uvtileset' lists the tiles; without it, the existing files
 * do.
 */
#include "base/folder_names.h"
#include "build/build_priv.h"
#include "shader/formula.h"

#include <limits.h>
#include <stdlib.h>

enum { MAX_CELLS = 1000 }; /* cells of the rectangle around the tiles: four digits number no more */

static const struct tile_token {
    const char *text;
    str_id property; /* a geometry property; its values apply to any geometry */
} tile_tokens[] = {{"<UDIM>", STR_udimset}, {"<UVTILE>", STR_uvtileset}};

typedef VEC(struct shader_tile) tile_list;

/* ---- Names ---- */

static const char *read_number(const char *p, int32_t *out)
{
    const char *start = p;
    for (*out = 0; *p >= '0' && *p <= '9' && p - start < 6; p++)
        *out = *out * 10 + (*p - '0');
    return p > start ? p : NULL;
}

/* Reads the text for a token at `p`. Returns the end of the text, or NULL if it is no tile. */
static const char *read_tile(const struct tile_token *token, const char *p, struct shader_tile *out)
{
    int32_t u, v;
    if (token->property == STR_udimset) {
        const char *end = read_number(p, &u);
        if (!end || end - p != 4 || u < 1001)
            return NULL;
        *out = (struct shader_tile){.u = (u - 1001) % 10, .v = (u - 1001) / 10};
        return end;
    }
    p = *p == 'u' ? read_number(p + 1, &u) : NULL;
    p = p && p[0] == '_' && p[1] == 'v' ? read_number(p + 2, &v) : NULL;
    if (!p || u < 1 || v < 1)
        return NULL;
    *out = (struct shader_tile){.u = u - 1, .v = v - 1};
    return p;
}

/* True if `name` is the file of a tile. Frame numbers, in braces, match any digits. */
static bool match(const struct tile_token *token, const char *pattern, const char *name,
                  struct shader_tile *out)
{
    size_t len = strlen(token->text);
    bool found = false;
    while (*pattern) {
        struct shader_tile tile;
        if (strncmp(pattern, token->text, len) == 0) {
            name = read_tile(token, name, &tile);
            if (!name || (found && (tile.u != out->u || tile.v != out->v)))
                return false;
            *out = tile;
            found = true;
            pattern += len;
        } else if (*pattern == '{' && strchr(pattern, '}')) {
            int32_t frame;
            pattern = strchr(pattern, '}') + 1;
            name += *name == '-';
            name = read_number(name, &frame);
            if (!name)
                return false;
        } else if (*pattern++ != *name++) {
            return false;
        }
    }
    return found && !*name;
}

static str_id file_of(struct builder *b, const struct tile_token *token, const char *pattern,
                      const struct shader_tile *tile)
{
    struct text name;
    text_init(&name, b->arena);
    for (const char *at; (at = strstr(pattern, token->text)) != NULL;
         pattern = at + strlen(token->text)) {
        text_mem(&name, pattern, (size_t)(at - pattern));
        if (token->property == STR_udimset)
            text_fmt(&name, "%d", 1001 + tile->u + 10 * tile->v);
        else
            text_fmt(&name, "u%d_v%d", 1 + tile->u, 1 + tile->v);
    }
    text_str(&name, pattern);
    return str_intern(b->shader->strings, name.data, name.len);
}

/* ---- Existing tiles ---- */

static int compare_tiles(const void *left, const void *right)
{
    const struct shader_tile *a = left, *b = right;
    return a->v != b->v ? (a->v > b->v) - (a->v < b->v) : (a->u > b->u) - (a->u < b->u);
}

/* Sorts the tiles by row, and drops repeated ones. */
static void sort_tiles(tile_list *tiles)
{
    uint32_t len = 0;
    if (tiles->len)
        qsort(tiles->items, tiles->len, sizeof *tiles->items, compare_tiles);
    for (uint32_t i = 0; i < tiles->len; i++)
        if (!len || compare_tiles(&tiles->items[len - 1], &tiles->items[i]) != 0)
            tiles->items[len++] = tiles->items[i];
    tiles->len = len;
}

static void add_listed(struct builder *b, const struct tile_token *token, elem_id property,
                       tile_list *tiles)
{
    str_id list = doc_attr_value(&b->lib->doc, property, STR_value);
    struct diag_place place = doc_attr_place(&b->lib->doc, property, STR_value);
    for (const char *p = build_text(b, list); *p;) {
        struct shader_tile tile;
        p += strspn(p, ", ");
        const char *end = *p ? read_tile(token, p, &tile) : p;
        if (end && end != p && strchr(", ", *end))
            vec_push(b->arena, tiles, tile);
        else if (*p)
            diag_add(b->diags, DIAG_ID_bad_tile, place,
                     arena_strndup(b->arena, p, strcspn(p, ", ")), token->text);
        p += strcspn(p, ", ");
    }
}

/* The union over all geometry, because a shader does not know the geometry that it is bound to. */
static void find_listed(struct builder *b, const struct tile_token *token, tile_list *tiles)
{
    const struct document *doc = &b->lib->doc;
    for (elem_id info = doc_element(doc, doc->root)->first_child; info;
         info = doc_element(doc, info)->next) {
        if (doc_element(doc, info)->kind != KIND_GEOMINFO)
            continue;
        elem_id property = doc_child_of_kind(doc, info, KIND_GEOMPROP, token->property);
        if (property)
            add_listed(b, token, property, tiles);
    }
}

static void find_files(struct builder *b, const struct tile_token *token, elem_id element,
                       const char *file, tile_list *tiles)
{
    const char *slash = strrchr(file, '/'), *pattern = slash ? slash + 1 : file;
    const struct build_options *o = b->options;
    if (!o->list_folder || !strstr(pattern, token->text))
        return;
    const char *folder = arena_strndup(b->arena, file, (size_t)(pattern - file));
    const char *from = doc_place(&b->lib->doc, element).file;
    const char *names;
    size_t size =
        names_list(b->arena, o->list_folder, o->list_user_data, from ? from : "", folder, &names);
    for (size_t at = 0; at < size; at += strlen(names + at) + 1) {
        struct shader_tile tile;
        if (match(token, pattern, names + at, &tile))
            vec_push(b->arena, tiles, tile);
    }
}

struct cells { /* the rectangle around tiles */
    int32_t u, v, width, height;
};

static struct cells cells_of(const struct shader_tile *tiles, uint32_t n)
{
    assert(n > 0);
    int32_t right = INT32_MIN, bottom = tiles[0].v, top = tiles[n - 1].v, left = INT32_MAX;
    for (uint32_t i = 0; i < n; i++) {
        left = tiles[i].u < left ? tiles[i].u : left;
        right = tiles[i].u > right ? tiles[i].u : right;
    }
    assert(left <= right && bottom <= top);
    return (struct cells){left, bottom, right - left + 1, top - bottom + 1};
}

static bool are_too_many(const tile_list *tiles)
{
    struct cells cells = cells_of(tiles->items, tiles->len);
    return (int64_t)cells.width * cells.height > MAX_CELLS;
}

bool build_find_tiles(struct builder *b, elem_id element, struct shader_variable *texture)
{
    const char *file = build_text(b, texture->file);
    const struct tile_token *token = NULL;
    for (size_t i = 0; strchr(file, '<') && i < sizeof tile_tokens / sizeof *tile_tokens; i++)
        if (strstr(file, tile_tokens[i].text))
            token = &tile_tokens[i];
    if (!token || !b->options->tiles)
        return false;
    tile_list tiles = {0};
    find_listed(b, token, &tiles);
    if (!tiles.len)
        find_files(b, token, element, file, &tiles);
    sort_tiles(&tiles);
    struct diag_place place = doc_attr_place(&b->lib->doc, element, STR_value);
    if (!tiles.len && b->options->list_folder) /* otherwise the host finds them */
        diag_add(b->diags, DIAG_ID_no_tiles, place, file, build_text(b, token->property));
    else if (tiles.len && are_too_many(&tiles))
        diag_add(b->diags, DIAG_ID_too_many_tiles, place, file, MAX_CELLS);
    if (!tiles.len || are_too_many(&tiles))
        return false;
    texture->first_tile = b->shader->interface.tiles.len;
    texture->num_tiles = tiles.len;
    for (uint32_t i = 0; i < tiles.len; i++) {
        tiles.items[i].file = file_of(b, token, file, &tiles.items[i]);
        vec_push(b->shader->arena, &b->shader->interface.tiles, tiles.items[i]);
    }
    assert(texture->first_tile + texture->num_tiles == b->shader->interface.tiles.len);
    return true;
}

/* ---- Layers ---- */

/* The array layer of each cell, -1 for a cell without a tile. */
static ir_ref layer_table(struct builder *b, const struct shader_tile *tiles, uint32_t n,
                          const struct cells *cells, ir_ref cell)
{
    uint32_t length = (uint32_t)(cells->width * cells->height);
    assert(n <= length && length <= MAX_CELLS);
    ir_ref *layers = ARENA_ARRAY(b->arena, ir_ref, length);
    for (uint32_t i = 0; i < length; i++)
        layers[i] = ir_const_float(b->graph, -1.0f);
    for (uint32_t i = 0; i < n; i++)
        layers[(tiles[i].v - cells->v) * cells->width + tiles[i].u - cells->u] =
            ir_const_float(b->graph, (float)i);
    ir_ref table = ir_construct(b->graph, (ir_type_id)ir_add_array(b->graph, IR_TYPE_FLOAT, length),
                                layers, length);
    ir_ref last = ir_const_float(b->graph, (float)(length - 1)),
           first = ir_const_float(b->graph, 0.0f);
    ir_ref index = ir_convert(b->graph, IR_TYPE_INT, ir_op3(b->graph, IR_CLAMP, cell, first, last));
    return ir_build(b->graph, IR_INDEX, IR_TYPE_FLOAT, 0, (ir_ref[]){table, index}, 2);
}

static ir_ref place_of(struct ir_graph *g, int32_t u, int32_t v)
{
    struct ir_value place = {.type = IR_TYPE_VEC2, .w = {{.f = (float)u}, {.f = (float)v}}};
    return ir_const(g, &place);
}

ir_ref build_tile_layer(struct builder *b, const struct shader_variable *texture, ir_ref uv,
                        ir_ref *out_inside)
{
    assert(texture->first_tile + texture->num_tiles <= b->shader->interface.tiles.len);
    struct ir_graph *g = b->graph;
    const struct shader_tile *tiles = b->shader->interface.tiles.items + texture->first_tile;
    struct cells cells = cells_of(tiles, texture->num_tiles);
    ir_ref first = place_of(g, cells.u, cells.v),
           last = place_of(g, cells.width - 1, cells.height - 1),
           columns = ir_const_float(g, (float)cells.width);
    ir_ref whole = ir_op1(g, IR_FLOOR, uv), at = ir_op2(g, IR_SUB, whole, first);
    ir_ref cell = FORMULA(b->shader, "mx_tile_cell", at, columns);
    *out_inside = FORMULA(b->shader, "mx_tile_is_inside", at, last);
    if (texture->num_tiles == (uint32_t)(cells.width * cells.height))
        return cell;
    ir_ref layer = layer_table(b, tiles, texture->num_tiles, &cells, cell);
    *out_inside = ir_op2(g, IR_LAND, *out_inside, ir_op2(g, IR_GE, layer, ir_const_float(g, 0.0f)));
    return layer;
}
