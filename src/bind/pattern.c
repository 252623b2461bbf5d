// SPDX-License-Identifier: Apache-2.0
#include "bind/pattern.h"

#include "base/hash.h"
#include "base/num.h"

#include <assert.h>
#include <stdlib.h>

void pattern_set_init(struct pattern_set *set, struct arena *arena)
{
    *set = (struct pattern_set){.arena = arena};
    glob_set_init(&set->globs, arena);
    vec_push(arena, &set->nodes, (struct pattern_node){0});
    vec_push(arena, &set->edges, (struct pattern_edge){0});
    vec_push(arena, &set->ends, (struct pattern_end){0});
}

void pattern_set_finish(struct pattern_set *set)
{
    glob_set_finish(&set->globs);
}

/* The character behind the name, or behind its last bracket that closes. */
const char *pattern_name_end(const char *text)
{
    unsigned depth = 0;
    bool in_set = false;
    for (; *text && (*text != ',' || depth || in_set); text++) {
        if (in_set)
            in_set = *text != ']';
        else if (*text == '[')
            in_set = true;
        else if (*text == '{')
            depth++;
        else if (*text == '}' && depth)
            depth--;
    }
    return text;
}

/* ---- The trie ---- */

static uint32_t add_node(struct pattern_set *set)
{
    vec_push(set->arena, &set->nodes, (struct pattern_node){0});
    return set->nodes.len - 1;
}

static uint32_t any_below(struct pattern_set *set, uint32_t node)
{
    if (!set->nodes.items[node].any) {
        uint32_t added = add_node(set);
        set->nodes.items[node].any = added;
    }
    return set->nodes.items[node].any;
}

static uint32_t deep_below(struct pattern_set *set, uint32_t node)
{
    if (set->nodes.items[node].is_deep)
        return node;
    if (!set->nodes.items[node].deep) {
        uint32_t added = add_node(set);
        set->nodes.items[added].is_deep = true;
        set->nodes.items[node].deep = added;
    }
    return set->nodes.items[node].deep;
}

static uint32_t name_hash(uint32_t node, uint32_t hash_of_name)
{
    return hash_pair(node, hash_of_name);
}

static uint32_t glob_hash(uint32_t node, uint32_t glob)
{
    return hash_pair(node ^ 0x80000000u, glob);
}

/* The node below a plain name; 0: none. */
static uint32_t find_name(const struct pattern_set *set, uint32_t node, uint32_t hash_of_name,
                          const char *name, size_t len)
{
    uint32_t hash = name_hash(node, hash_of_name);
    for (uint32_t at = hash, found; (found = table_next(&set->table, hash, &at));) {
        const struct pattern_edge *edge = &set->edges.items[found];
        if (edge->from == node && !edge->glob && edge->len == len
            && memcmp(edge->name, name, len) == 0)
            return edge->to;
    }
    return 0;
}

static uint32_t find_glob(const struct pattern_set *set, uint32_t node, uint32_t glob)
{
    uint32_t hash = glob_hash(node, glob);
    for (uint32_t at = hash, found; (found = table_next(&set->table, hash, &at));) {
        const struct pattern_edge *edge = &set->edges.items[found];
        if (edge->from == node && edge->glob == glob + 1)
            return edge->to;
    }
    return 0;
}

static uint32_t add_edge(struct pattern_set *set, uint32_t hash, struct pattern_edge edge)
{
    edge.to = add_node(set);
    vec_push(set->arena, &set->edges, edge);
    table_add(&set->table, set->arena, hash, set->edges.len - 1);
    return edge.to;
}

static uint32_t name_below(struct pattern_set *set, uint32_t node, const char *name, size_t len)
{
    uint32_t hash = hash_bytes(name, len), found = find_name(set, node, hash, name, len);
    if (found)
        return found;
    struct pattern_edge edge = {
        .from = node, .name = arena_strndup(set->arena, name, len), .len = len};
    return add_edge(set, name_hash(node, hash), edge);
}

/* The node below one level of a pattern. */
static const char *add_level(struct pattern_set *set, const char *text, size_t len, uint32_t *node)
{
    uint32_t glob, found;
    if (len == 1 && *text == '*') {
        *node = any_below(set, *node);
        return NULL;
    }
    if (glob_is_plain(text, len)) {
        *node = name_below(set, *node, text, len);
        return NULL;
    }
    const char *fault = glob_add(&set->globs, text, len, &glob);
    if (fault)
        return fault;
    found = find_glob(set, *node, glob);
    *node = found ? found
                  : add_edge(set, glob_hash(*node, glob),
                             (struct pattern_edge){.from = *node, .glob = glob + 1});
    return NULL;
}

/* The length of one level of a pattern; a '/' in brackets is a fault. */
static const char *level_len(const char *text, const char *end, size_t *out_len)
{
    unsigned depth = 0;
    bool in_set = false;
    const char *at = text;
    for (; at < end && (*at != '/' || depth || in_set); at++) {
        if (*at == '/')
            return "has a '/' in brackets";
        if (in_set)
            in_set = *at != ']';
        else if (*at == '[')
            in_set = true;
        else if (*at == '{')
            depth++;
        else if (*at == '}' && depth)
            depth--;
    }
    *out_len = (size_t)(at - text);
    return NULL;
}

static void add_end(struct pattern_set *set, uint32_t node, uint32_t matcher, bool only_leaves)
{
    struct pattern_end end = {matcher, set->nodes.items[node].first_end, only_leaves};
    vec_push(set->arena, &set->ends, end);
    set->nodes.items[node].first_end = set->ends.len - 1;
    set->has_leaf_patterns |= only_leaves;
}

const char *pattern_add(struct pattern_set *set, const char *text, size_t len, uint32_t matcher)
{
    const char *end = text + len;
    bool only_leaves = len >= 3 && memcmp(end - 3, "//*", 3) == 0;
    uint32_t node = 0;
    if (!len)
        return "is empty";
    while (text < end) {
        size_t slashes = 0, level = 0;
        for (; text < end && *text == '/'; text++)
            slashes++;
        if (slashes > 1)
            node = deep_below(set, node);
        const char *fault = level_len(text, end, &level);
        if (!fault && level)
            fault = add_level(set, text, level, &node);
        if (fault)
            return fault;
        text += level;
    }
    add_end(set, node, matcher, only_leaves);
    return NULL;
}

void pattern_add_path(struct pattern_set *set, const char *path, size_t len, uint32_t matcher)
{
    const char *end = path + len;
    uint32_t node = 0;
    while (path < end) {
        path += *path == '/';
        const char *slash = memchr(path, '/', (size_t)(end - path));
        size_t name = (size_t)((slash ? slash : end) - path);
        if (name)
            node = name_below(set, node, path, name);
        path += name;
    }
    add_end(set, node, matcher, false);
}

bool pattern_is_path(const char *text, size_t len)
{
    for (size_t i = 0; i + 1 < len; i++)
        if (text[i] == '/' && text[i + 1] == '/')
            return false;
    return glob_is_plain(text, len);
}

/* ---- The walk ---- */

static void reach(struct pattern_walk *walk, uint32_t node)
{
    while (node && walk->marks.items[node] != walk->epoch) {
        walk->marks.items[node] = walk->epoch;
        vec_push(walk->arena, &walk->active, node);
        /* any number of levels are also none */
        node = walk->set->nodes.items[node].deep;
    }
}

static void begin_level(struct pattern_walk *walk)
{
    walk->epoch++;
    vec_push(walk->arena, &walk->levels, walk->active.len);
}

void pattern_walk_init(struct pattern_walk *walk, struct pattern_set *set, struct arena *arena)
{
    *walk = (struct pattern_walk){.set = set, .arena = arena};
    memset(vec_extend(arena, &walk->marks, set->nodes.len), 0,
           set->nodes.len * sizeof *walk->marks.items);
    begin_level(walk);
    vec_push(arena, &walk->active, 0);
    reach(walk, set->nodes.items[0].deep);
}

void pattern_walk_down(struct pattern_walk *walk, const char *name, size_t len)
{
    struct pattern_set *set = walk->set;
    uint32_t first = vec_last(&walk->levels), last = walk->active.len, num_globs = 0;
    begin_level(walk);
    if (first == last)
        return;
    uint32_t hash = hash_bytes(name, len);
    const uint32_t *globs = glob_match(&set->globs, name, len, &num_globs);
    for (uint32_t i = first; i < last; i++) {
        uint32_t node = walk->active.items[i];
        if (set->nodes.items[node].is_deep)
            reach(walk, node);
        reach(walk, set->nodes.items[node].any);
        reach(walk, find_name(set, node, hash, name, len));
        for (uint32_t k = 0; k < num_globs; k++)
            reach(walk, find_glob(set, node, globs[k]));
    }
}

void pattern_walk_up(struct pattern_walk *walk)
{
    assert(walk->levels.len > 1);
    walk->active.len = vec_pop(&walk->levels);
}

const uint32_t *pattern_walk_matches(struct pattern_walk *walk, bool is_leaf, uint32_t *out_num)
{
    const struct pattern_set *set = walk->set;
    walk->matched.len = 0;
    for (uint32_t i = vec_last(&walk->levels); i < walk->active.len; i++) {
        uint32_t end = set->nodes.items[walk->active.items[i]].first_end;
        for (; end; end = set->ends.items[end].next)
            if (is_leaf || !set->ends.items[end].only_leaves)
                vec_push(walk->arena, &walk->matched, set->ends.items[end].matcher);
    }
    uint32_t num = 0;
    num_sort(walk->matched.items, walk->matched.len);
    for (uint32_t i = 0; i < walk->matched.len; i++)
        if (!i || walk->matched.items[i] != walk->matched.items[i - 1])
            walk->matched.items[num++] = walk->matched.items[i];
    *out_num = num;
    return walk->matched.items;
}
