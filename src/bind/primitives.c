// SPDX-License-Identifier: Apache-2.0
#include "bind/primitives.h"

#include "base/hash.h"

#include <assert.h>

void scene_init(struct scene *scene, uint32_t max_prims, struct arena *arena)
{
    *scene = (struct scene){.arena = arena, .max_prims = max_prims, .purpose = ""};
    vec_push(arena, &scene->prims, (struct scene_prim){.name = ""});
    vec_push(arena, &scene->kinds, PRIM_DRAWN);
    vec_push(arena, &scene->words, "");
    text_init(&scene->written, arena);
}

static uint32_t child_hash(prim_id parent, const char *name, size_t len)
{
    return hash_pair(parent, hash_bytes(name, len));
}

static prim_id find_hashed(const struct scene *scene, prim_id parent, uint32_t hash,
                           const char *name, size_t len)
{
    for (uint32_t at = hash, found; (found = table_next(&scene->table, hash, &at));) {
        const struct scene_prim *prim = &scene->prims.items[found];
        if (prim->parent == parent && prim->name_len == len && memcmp(prim->name, name, len) == 0)
            return found;
    }
    return 0;
}

prim_id scene_find_child(const struct scene *scene, prim_id parent, const char *name, size_t len)
{
    return find_hashed(scene, parent, child_hash(parent, name, len), name, len);
}

/* Names are short, and a block of an arena is aligned: they share blocks. */
static const char *keep_name(struct scene *scene, const char *name, size_t len)
{
    enum { BLOCK = 1 << 15 };
    if (len > scene->names_left) {
        scene->names_left = len > BLOCK ? len : BLOCK;
        scene->names = arena_alloc(scene->arena, scene->names_left);
    }
    char *kept = memcpy(scene->names, name, len);
    scene->names += len;
    scene->names_left -= len;
    return kept;
}

/* Adds a child, whose name lives as long as the scene. */
static prim_id add_child(struct scene *scene, prim_id parent, uint32_t hash, struct text_word name)
{
    prim_id added = scene->prims.len;
    struct scene_prim prim = {.name = name.bytes,
                              .name_len = (uint32_t)name.len,
                              .parent = parent,
                              .depth = scene->prims.items[parent].depth + 1};
    vec_reserve(scene->arena, &scene->kinds, 1); /* so that both have a primitive or none */
    vec_push(scene->arena, &scene->prims, prim);
    vec_push(scene->arena, &scene->kinds, PRIM_DRAWN);
    struct scene_prim *above = &scene->prims.items[parent];
    if (above->last_child)
        scene->prims.items[above->last_child].next = added;
    else
        above->first_child = added;
    above->last_child = added;
    table_add(&scene->table, scene->arena, hash, added);
    return added;
}

prim_id scene_child(struct scene *scene, prim_id parent, const char *name, size_t len)
{
    uint32_t hash = child_hash(parent, name, len);
    prim_id found = find_hashed(scene, parent, hash, name, len);
    return found ? found : add_child(scene, parent, hash, (struct text_word){name, len});
}

/* Like scene_child, but copies the name. */
static prim_id copied_child(struct scene *scene, prim_id parent, const char *name, size_t len)
{
    uint32_t hash = child_hash(parent, name, len);
    prim_id found = find_hashed(scene, parent, hash, name, len);
    if (found)
        return found;
    struct text_word kept = {keep_name(scene, name, len), len};
    return add_child(scene, parent, hash, kept);
}

prim_id scene_find_below(const struct scene *scene, prim_id prim, const char *path, size_t len)
{
    const char *end = path + len;
    while (path < end) {
        path += *path == '/';
        const char *slash = memchr(path, '/', (size_t)(end - path));
        size_t name = (size_t)((slash ? slash : end) - path);
        prim = scene_find_child(scene, prim, path, name);
        if (!prim)
            return 0;
        path += name;
    }
    return prim;
}

prim_id scene_find(const struct scene *scene, const char *path, size_t len)
{
    return scene_find_below(scene, 0, path, len);
}

prim_id scene_add_below(struct scene *scene, prim_id prim, const char *path, size_t len)
{
    const char *end = path + len;
    while (path < end) {
        const char *slash = memchr(path, '/', (size_t)(end - path));
        size_t name = (size_t)((slash ? slash : end) - path);
        prim = copied_child(scene, prim, path, name);
        path += name + (slash != NULL);
    }
    return prim;
}

const char *scene_keep_word(struct scene *scene, struct text_word word)
{
    uint32_t hash = hash_bytes(word.bytes, word.len);
    if (!word.len)
        return "";
    for (uint32_t at = hash, found; (found = table_next(&scene->words_table, hash, &at));) {
        const char *kept = scene->words.items[found];
        if (strncmp(kept, word.bytes, word.len) == 0 && !kept[word.len])
            return kept;
    }
    const char *kept = arena_strndup(scene->arena, word.bytes, word.len);
    vec_push(scene->arena, &scene->words, kept);
    table_add(&scene->words_table, scene->arena, hash, scene->words.len - 1);
    return kept;
}

/* True if primitives of the type are not drawn. */
static bool is_group_type(struct text_word type)
{
#define WORD(text) \
    { \
        text, sizeof(text) - 1 \
    }
    static const struct text_word groups[] = {
        WORD("Xform"),    WORD("Scope"),         WORD("PointInstancer"), WORD("Camera"),
        WORD("SkelRoot"), WORD("SkelAnimation"), WORD("Skeleton")};
    static const struct text_word light = WORD("Light");
#undef WORD
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        if (type.len == groups[i].len && memcmp(type.bytes, groups[i].bytes, type.len) == 0)
            return true;
    return type.len >= light.len
           && memcmp(type.bytes + type.len - light.len, light.bytes, light.len) == 0;
}

/* 1 + the number of a type that a host gives; 0: it gives none. */
static uint32_t number_of_type(struct scene *scene, struct text_word type)
{
    uint32_t hash = hash_bytes(type.bytes, type.len);
    if (!type.len)
        return 0;
    for (uint32_t at = hash, found; (found = table_next(&scene->host_types_table, hash, &at));) {
        struct text_word known = scene->host_types.items[found - 1].name;
        if (known.len == type.len && memcmp(known.bytes, type.bytes, type.len) == 0)
            return found;
    }
    struct host_type added = {{arena_strndup(scene->arena, type.bytes, type.len), type.len},
                              is_group_type(type)};
    vec_push(scene->arena, &scene->host_types, added);
    table_add(&scene->host_types_table, scene->arena, hash, scene->host_types.len);
    return scene->host_types.len;
}

void scene_set_type(struct scene *scene, prim_id prim, struct text_word type)
{
    uint32_t number = number_of_type(scene, type);
    while (scene->types.len <= prim)
        vec_push(scene->arena, &scene->types, 0);
    scene->types.items[prim] = number;
    scene_find_kind(scene, prim);
}

/* NULL: the host gives none. */
static const struct host_type *host_type_of(const struct scene *scene, prim_id prim)
{
    uint32_t number = prim < scene->types.len ? scene->types.items[prim] : 0;
    return number ? &scene->host_types.items[number - 1] : NULL;
}

struct text_word scene_type(const struct scene *scene, prim_id prim)
{
    const struct host_type *given = host_type_of(scene, prim);
    struct text_word type = given ? given->name : (struct text_word){0};
    for (uint32_t i = scene_source(scene, prim); i && !type.len;
         i = scene->sources.items[i - 1].next)
        type = scene->layer.prims.items[scene->sources.items[i - 1].prim].type;
    return type;
}

static bool is_group(const struct scene *scene, prim_id prim)
{
    const struct host_type *given = host_type_of(scene, prim);
    if (given)
        return given->is_group;
    struct text_word type = scene_type(scene, prim);
    /* USD has types, lists of paths have none */
    return type.len ? is_group_type(type) : scene_source(scene, prim) != 0;
}

void scene_find_kind(struct scene *scene, prim_id prim)
{
    scene->kinds.items[prim] = is_group(scene, prim) ? PRIM_GROUP : PRIM_DRAWN;
}

/* ---- Removal ---- */

/* Takes the children without a name out of a list, and makes their parent PRIM_REMOVED. */
static void sweep_children(struct scene *scene, prim_id parent)
{
    struct scene_prim *prims = scene->prims.items, *above = &prims[parent];
    prim_id child = above->first_child;
    above->first_child = above->last_child = 0;
    for (prim_id next; child; child = next) {
        next = prims[child].next;
        prims[child].next = 0;
        if (!prims[child].name) {
            prims[child].parent = PRIM_REMOVED;
            scene->kinds.items[child] = PRIM_GONE;
            continue;
        }
        if (above->last_child)
            prims[above->last_child].next = child;
        else
            above->first_child = child;
        above->last_child = child;
    }
    if (parent && !above->first_child)
        vec_push(scene->arena, &scene->emptied, parent);
}

/* Forgets what a removed primitive had. */
static void forget(struct scene *scene, prim_id prim)
{
    scene->prims.items[prim] = (struct scene_prim){.name = "", .parent = PRIM_REMOVED};
    scene->kinds.items[prim] = PRIM_GONE;
    scene_unbind_all(scene, prim);
    if (prim < scene->first_source.len)
        scene->first_source.items[prim] = 0;
    if (prim < scene->types.len)
        scene->types.items[prim] = 0;
}

void scene_remove(struct scene *scene, const prim_id *prims, size_t num)
{
    struct scene_prim *items = scene->prims.items;
    prim_id first = PRIM_REMOVED;
    vec_reserve(scene->arena, &scene->emptied, (uint32_t)num);
    scene->last.len = 0;
    for (size_t i = 0; i < num; i++) {
        assert(prims[i] && scene_has(scene, prims[i]));
        items[prims[i]].name = NULL;
        first = prims[i] < first ? prims[i] : first;
    }
    for (size_t i = 0; i < num; i++)
        if (items[prims[i]].parent != PRIM_REMOVED)
            sweep_children(scene, items[prims[i]].parent);
    /* a parent stands before its children */
    for (prim_id prim = first; prim < scene->prims.len; prim++)
        if (!scene_has(scene, prim) || !scene_has(scene, items[prim].parent))
            forget(scene, prim);
}

/* Fills the text from its end, because a primitive knows its parent. */
void scene_path(const struct scene *scene, prim_id prim, struct text *out)
{
    size_t len = 0;
    if (!prim) {
        text_char(out, '/');
        return;
    }
    for (prim_id p = prim; p; p = scene->prims.items[p].parent)
        len += scene->prims.items[p].name_len + 1;
    text_reserve(out, len);
    out->len += len;
    char *end = out->data + out->len;
    for (prim_id p = prim; p; p = scene->prims.items[p].parent) {
        end -= scene->prims.items[p].name_len;
        memcpy(end, scene->prims.items[p].name, scene->prims.items[p].name_len);
        *--end = '/';
    }
}

prim_id scene_next(const struct scene *scene, prim_id prim)
{
    if (scene->prims.items[prim].first_child)
        return scene->prims.items[prim].first_child;
    while (prim && !scene->prims.items[prim].next)
        prim = scene->prims.items[prim].parent;
    return prim ? scene->prims.items[prim].next : 0;
}

/* ---- Lists of paths ---- */

struct list_reader {
    struct scene *scene;
    struct diag_list *diags;
    const char *file;
    uint32_t line;
};

static bool has_empty_name(const char *path, const char *end)
{
    for (; path + 1 < end; path++)
        if (path[0] == '/' && path[1] == '/')
            return true;
    return false;
}

static const char *path_fault(const char *path, const char *end)
{
    if (path == end || *path != '/')
        return "does not begin with '/'";
    return has_empty_name(path, end) ? "has an empty name" : NULL;
}

/* The fault of a path without '/' in front. */
static const char *name_fault(const char *name, const char *end)
{
    if (name == end)
        return "is empty";
    if (*name == '/' || memchr(name, '\0', (size_t)(end - name)))
        return "is no name below a parent";
    return has_empty_name(name, end) ? "has an empty name" : NULL;
}

/* True if `num` levels below a primitive are not too many. */
static bool has_depth(const struct scene *scene, prim_id prim, const char *path, const char *end)
{
    uint32_t depth = scene->prims.items[prim].depth + (prim != 0);
    for (; path < end && depth <= SCENE_MAX_DEPTH; path++)
        depth += *path == '/';
    return depth <= SCENE_MAX_DEPTH;
}

/* Reports a fault of a path below a primitive, or that the scene is full. */
static bool check(const struct scene *scene, prim_id prim, struct text_word path,
                  struct diag_place place, const char *fault, struct diag_list *diags)
{
    if (!fault && !has_depth(scene, prim, path.bytes, path.bytes + path.len))
        fault = "is nested more than 1,000 deep";
    bool is_full = !fault && scene->prims.len > scene->max_prims;
    if (fault)
        diag_add(diags, DIAG_ID_bad_path, place, arena_strndup(diags->arena, path.bytes, path.len),
                 fault);
    else if (is_full)
        diag_add(diags, DIAG_ID_scene_size, place, (unsigned)scene->max_prims);
    return !fault && !is_full;
}

bool scene_check_name(const struct scene *scene, prim_id prim, struct text_word name,
                      struct diag_list *diags)
{
    return check(scene, prim, name, (struct diag_place){0},
                 name_fault(name.bytes, name.bytes + name.len), diags);
}

static bool check_path(const struct scene *scene, const char *path, const char *end,
                       struct diag_place place, struct diag_list *diags)
{
    return check(scene, 0, (struct text_word){path, (size_t)(end - path)}, place,
                 path_fault(path, end), diags);
}

static void add_path(struct scene *scene, const char *path, const char *end)
{
    prim_id prim = 0;
    uint32_t level = 0;
    bool is_shared = true;
    while (path < end && path + 1 < end) {
        const char *name = path + 1, *slash = memchr(name, '/', (size_t)(end - name));
        size_t len = (size_t)((slash ? slash : end) - name);
        if (is_shared && level < scene->last.len) {
            const struct scene_prim *before = &scene->prims.items[scene->last.items[level]];
            is_shared = before->name_len == len && memcmp(before->name, name, len) == 0;
        } else {
            is_shared = false;
        }
        if (!is_shared) {
            scene->last.len = level;
            vec_push(scene->arena, &scene->last, copied_child(scene, prim, name, len));
        }
        prim = scene->last.items[level++];
        path = name + len;
    }
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

static void read_line(struct list_reader *r, const char *begin, const char *end)
{
    const char *text = begin;
    while (text < end && is_blank(*text))
        text++;
    while (text < end && is_blank(end[-1]))
        end--;
    if (text == end || *text == '#')
        return;
    struct diag_place place = {r->file, r->line, (uint32_t)(text - begin) + 1,
                               (uint32_t)(end - text)};
    if (check_path(r->scene, text, end, place, r->diags))
        add_path(r->scene, text, end);
}

void scene_add_path(struct scene *scene, const char *path, size_t len, struct diag_place place,
                    struct diag_list *diags)
{
    if (check_path(scene, path, path + len, place, diags))
        add_path(scene, path, path + len);
}

void scene_read_list(struct scene *scene, const char *file, const char *text, size_t len,
                     struct diag_list *diags)
{
    struct list_reader reader = {.scene = scene, .diags = diags, .file = file};
    for (const char *end = text + len; text < end;) {
        const char *newline = memchr(text, '\n', (size_t)(end - text));
        reader.line++;
        read_line(&reader, text, newline ? newline : end);
        text = newline ? newline + 1 : end;
    }
}
