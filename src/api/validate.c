// SPDX-License-Identifier: Apache-2.0
/* Validates a whole document against its library, and the files that it names. */
#include "api/generation.h"
#include "bind/look.h"

/*
 * ---- Textures: reports missing files, if the host lists folders ----
 */

struct texture_check {
    const struct document *doc;
    struct mxg_context *context;
    const mxg_resolver *resolver;
    struct arena *arena;
    struct diag_list *diags;
    /* the folder of these names: textures of a document often share a folder */
    const char *from, *folder;
    const char *names;
    size_t size;
};

static void list_folder(struct texture_check *c, const char *from, const char *folder)
{
    if (c->folder && strcmp(c->from, from) == 0 && strcmp(c->folder, folder) == 0)
        return;
    c->from = from;
    c->folder = folder;
    c->size = names_list(c->arena, c->resolver->list_folder, c->resolver->user_data, from, folder,
                         &c->names);
}

static bool has_name(const struct texture_check *c, const char *name, size_t len)
{
    for (size_t at = 0; at < c->size; at += strlen(c->names + at) + 1)
        if (strncmp(c->names + at, name, len) == 0 && !c->names[at + len])
            return true;
    return false;
}

enum { FIRST_TILE = 1001, TILE_ROW = 10, NUM_TILES = 1000 };

/* Finds the tiles of a name such as "wood.<UDIM>.png" in the folder. */
static void find_tiles(const struct texture_check *c, const char *pattern, bool is_there[NUM_TILES])
{
    size_t before = (size_t)(strstr(pattern, "<UDIM>") - pattern),
           behind = before + strlen("<UDIM>");
    memset(is_there, 0, NUM_TILES * sizeof *is_there);
    for (size_t at = 0; at < c->size; at += strlen(c->names + at) + 1) {
        const char *name = c->names + at;
        if (strncmp(name, pattern, before) != 0)
            continue;
        int number = 0, digits = 0;
        for (; digits < 4 && name[before + (size_t)digits] >= '0'
               && name[before + (size_t)digits] <= '9';
             digits++)
            number = number * 10 + name[before + (size_t)digits] - '0';
        if (digits == 4 && number >= FIRST_TILE && number < FIRST_TILE + NUM_TILES
            && strcmp(name + before + 4, pattern + behind) == 0)
            is_there[number - FIRST_TILE] = true;
    }
}

/*
 * Reports holes in a row of tiles: a tile is missing if a later tile of the same row exists. Rows
 * may end early.
 */
static void check_tiles(struct texture_check *c, const char *path, const char *pattern,
                        struct diag_place place)
{
    bool is_there[NUM_TILES];
    struct text missing;
    text_init(&missing, c->arena);
    find_tiles(c, pattern, is_there);
    for (int row = 0; row < NUM_TILES; row += TILE_ROW) {
        int last = TILE_ROW - 1;
        while (last > 0 && !is_there[row + last])
            last--;
        for (int u = 0; u < last; u++)
            if (!is_there[row + u])
                text_fmt(&missing, "%s%d", missing.len ? ", " : "", FIRST_TILE + row + u);
    }
    if (missing.len)
        diag_add(c->diags, DIAG_ID_missing_tiles, place, path, text_cstr(&missing));
}

/*
 * Skips names with tokens and frames, whose values are unknown before drawing. Generation reports
 * tiled names without any tile.
 */
static void check_texture(struct texture_check *c, elem_id element)
{
    str_id value = doc_attr_value(c->doc, element, STR_value),
           prefix = doc_inherited_attr(c->doc, element, STR_fileprefix);
    struct text path;
    text_init(&path, c->arena);
    text_str(&path, str_text(c->doc->strings, prefix));
    text_str(&path, str_text(c->doc->strings, value));
    const char *text = text_cstr(&path), *slash = strrchr(text, '/'),
               *name = slash ? slash + 1 : text;
    struct diag_place place = doc_attr_place(c->doc, element, STR_value);
    const char *from = place.file ? place.file : "",
               *fault = stdio_texture_fault(c->context, from, text);
    if (fault)
        diag_add(c->diags, DIAG_ID_texture_refused, place, text, fault);
    if (fault || !*name || strpbrk(text, "[{") || strstr(text, "://"))
        return;
    list_folder(c, from, arena_strndup(c->arena, text, (size_t)(name - text)));
    if (strstr(name, "<UDIM>"))
        check_tiles(c, text, name, place);
    else if (!strchr(text, '<') && !has_name(c, name, strlen(name)))
        diag_add(c->diags, DIAG_ID_missing_texture, place, text);
}

static void check_textures(struct generation *g)
{
    const struct document *doc = &g->document->layer.doc;
    struct texture_check c = {.doc = doc,
                              .context = g->result->object.context,
                              .resolver = &g->result->object.context->resolver,
                              .arena = &g->scratch,
                              .diags = &g->result->object.diagnostics.list};
    for (elem_id e = c.resolver->list_folder ? doc->root : 0; e;
         e = doc_next_in_tree(doc, doc->root, e))
        if (doc_attr_value(doc, e, STR_type) == STR_filename && doc_attr_value(doc, e, STR_value))
            check_texture(&c, e);
}

/* ---- Looks ---- */

/*
 * Messages that have been told, so that a look and those that inherit it say everything once, and
 * nothing where the elements themselves have a fault.
 */
struct told {
    struct table table; /* by place: indices of items + 1 */
    VEC(struct diag) items;
    uint32_t num_elements; /* the first items: of elements */
    struct arena *arena;
};

/* True if nothing of the kind is told of the place so far. */
static bool tell(struct told *told, const struct diag *diag)
{
    uint32_t hash = diag_hash_place(&diag->place);
    for (uint32_t at = hash, found; (found = table_next(&told->table, hash, &at));) {
        const struct diag *known = &told->items.items[found - 1];
        if ((found <= told->num_elements || known->id == diag->id)
            && diag_is_same_place(&known->place, &diag->place))
            return false;
    }
    vec_push(told->arena, &told->items, *diag);
    table_add(&told->table, told->arena, hash, told->items.len);
    return true;
}

/*
 * Slots, patterns and collections, without a scene, and the facts beside a look; 0: facts alone.
 */
static void check_look(struct generation *g, elem_id element, struct told *told)
{
    struct diag_list *diags = &g->result->object.diagnostics.list, found;
    struct bind_look look;
    struct scene scene;
    scene_init(&scene, UINT32_MAX, &g->scratch);
    diag_list_init(&found, diags->arena);
    if (element) {
        look_read(&look, &g->document->layer, element, &scene, &g->scratch, &found);
        look_finish(&look);
    }
    look_check_facts(&g->document->layer, element, &scene, &g->scratch, &found);
    for (uint32_t i = 0; i < found.items.len; i++) {
        const struct diag *d = &found.items.items[i];
        if (tell(told, d))
            diag_repeat(diags, d);
    }
}

/* The look of this layer that a look inherits; 0: none. */
static elem_id parent_of(const struct document *doc, elem_id look)
{
    str_id base = doc_attr_value(doc, look, STR_inherit);
    elem_id parent = base ? doc_top_level(doc, KIND_LOOK, base) : 0;
    return parent >= doc->first_element ? parent : 0;
}

/*
 * A look is read with all that it inherits, so only those that no other look inherits are read; and
 * one of each cycle, in which all are inherited.
 */
static void check_looks(struct generation *g)
{
    enum { INHERITED = 1, DONE = 2 };
    const struct document *doc = &g->document->layer.doc;
    const struct diag_list *diags = &g->result->object.diagnostics.list;
    elem_id begin = doc_element(doc, doc->root)->first_child, zero = doc->first_element;
    uint8_t *states = ARENA_ARRAY(&g->scratch, uint8_t, doc_num_elements(doc));
    struct told told = {.arena = &g->scratch};
    for (uint32_t i = 0; i < diags->items.len; i++)
        tell(&told, &diags->items.items[i]);
    told.num_elements = told.items.len;
    check_look(g, 0, &told);
    for (elem_id e = begin; e; e = doc_element(doc, e)->next) {
        if (doc_element(doc, e)->kind == KIND_LOOKGROUP)
            look_check_group(doc, e, &g->result->object.diagnostics.list);
        elem_id parent = doc_element(doc, e)->kind == KIND_LOOK ? parent_of(doc, e) : 0;
        if (parent)
            states[parent - zero] = INHERITED;
    }
    for (uint8_t skipped = INHERITED | DONE; skipped; skipped = skipped & INHERITED ? DONE : 0)
        for (elem_id e = begin; e; e = doc_element(doc, e)->next) {
            if (doc_element(doc, e)->kind != KIND_LOOK || states[e - zero] & skipped)
                continue;
            check_look(g, e, &told);
            for (elem_id read = e; read && !(states[read - zero] & DONE);
                 read = parent_of(doc, read))
                states[read - zero] |= DONE;
        }
}

static void validate(struct generation *g)
{
    library_validate(&g->document->layer, &g->scratch, &g->result->object.diagnostics.list);
    check_looks(g);
    check_textures(g);
}

mxg_status mxg_validate(mxg_context *context, const mxg_document *document, mxg_result **out_result)
{
    return generation_run(context, document, NULL, validate, NULL, out_result);
}
