// SPDX-License-Identifier: Apache-2.0
/*
 * Closures that are named alike, because two nodes of one definition have them, get the names of
 * what tells them apart: "rust_reflection" and "paint_reflection" for "rust/reflection" and
 * "paint/reflection". A level at which all of them agree says nothing, so it is left out.
 */
#include "api/generation.h"

#include <stdlib.h>

struct named_closure {
    uint32_t origin;
    str_id name, label;
    /* the node or graph that encloses what `label` says so far: an element within the origin */
    uint32_t outer;
    elem_id element; /* 0: none */
};

static int compare_closures(const void *a, const void *b)
{
    const struct named_closure *x = a, *y = b;
    return x->name != y->name ? (x->name > y->name) - (x->name < y->name)
                              : (x->origin > y->origin) - (x->origin < y->origin);
}

/* Goes to the graph around a node of a document, and from inside a definition to its user. */
static void go_outwards(const struct generation *g, struct named_closure *closure)
{
    const struct ir_origin *origins = g->result->graph.origins.items;
    const struct document *doc = &g->document->layer.doc;
    if (origins[closure->outer].parent) {
        closure->outer = origins[closure->outer].parent;
        closure->element = origins[closure->outer].element;
    } else if (closure->element) {
        closure->element = doc_element(doc, closure->element)->parent;
    }
}

static str_id outer_name(const struct generation *g, const struct named_closure *closure)
{
    const struct document *doc = &g->document->layer.doc;
    return closure->element ? doc_element(doc, closure->element)->name : 0;
}

static bool agree(const struct generation *g, const struct named_closure *closures, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++)
        if (outer_name(g, &closures[i]) != outer_name(g, &closures[0]))
            return false;
    return true;
}

static int compare_labels(const void *a, const void *b)
{
    str_id x = ((const struct named_closure *)a)->label,
           y = ((const struct named_closure *)b)->label;
    return (x > y) - (x < y);
}

/* Sorts them by label. */
static bool are_apart(struct named_closure *closures, uint32_t count)
{
    qsort(closures, count, sizeof *closures, compare_labels);
    for (uint32_t i = 1; i < count; i++)
        if (closures[i].label == closures[i - 1].label)
            return false;
    return true;
}

/* One level outwards. false: all of them are at the root. */
static bool add_level(struct generation *g, struct named_closure *closures, uint32_t count)
{
    bool is_inside = false;
    for (uint32_t i = 0; i < count; i++) {
        go_outwards(g, &closures[i]);
        is_inside |= closures[i].element != 0;
    }
    bool says_nothing = !is_inside || agree(g, closures, count);
    for (uint32_t i = 0; i < count && !says_nothing; i++) {
        const struct strpool *strings = g->result->shader.strings;
        str_id outer = outer_name(g, &closures[i]);
        struct text label;
        if (!outer)
            continue;
        text_init(&label, &g->scratch);
        text_fmt(&label, "%s_%s", str_text(strings, outer), str_text(strings, closures[i].label));
        closures[i].label = str_intern(g->result->shader.strings, label.data, label.len);
    }
    return is_inside;
}

/* closures: all of one name. */
static void tell_apart(struct generation *g, struct named_closure *closures, uint32_t count)
{
    while (!are_apart(closures, count) && add_level(g, closures, count)) {
    }
    for (uint32_t i = 0; i < count; i++)
        g->result->graph.origins.items[closures[i].origin].name = closures[i].label;
}

void generation_name_closures(struct generation *g)
{
    const struct ir_graph *graph = &g->result->graph;
    const uint8_t *needed = ir_mark(graph, &g->root, 1, &g->scratch);
    VEC(struct named_closure) closures = {0};
    for (ir_ref ref = 1; ref <= g->root; ref++) {
        const struct ir_node *node = ir_get(graph, ref);
        const struct ir_origin *origin = &graph->origins.items[node->origin];
        if ((node->flags & IR_NODE_CLOSURE) && needed[ref] && origin->name)
            vec_push(&g->scratch, &closures,
                     (struct named_closure){.origin = node->origin,
                                            .name = origin->name,
                                            .label = origin->name,
                                            .outer = node->origin,
                                            .element = origin->element});
    }
    if (closures.len > 1)
        qsort(closures.items, closures.len, sizeof *closures.items, compare_closures);
    uint32_t len = 0; /* one for each origin */
    for (uint32_t i = 0; i < closures.len; i++)
        if (!len || compare_closures(&closures.items[len - 1], &closures.items[i]) != 0)
            closures.items[len++] = closures.items[i];
    for (uint32_t i = 0, end; i < len; i = end) {
        for (end = i + 1; end < len && closures.items[end].name == closures.items[i].name;)
            end++;
        tell_apart(g, &closures.items[i], end - i);
    }
}
