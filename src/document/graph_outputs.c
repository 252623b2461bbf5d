// SPDX-License-Identifier: Apache-2.0
/*
 * The outputs of nodegraphs by their type: many ports may read one graph with many outputs, and
 * none of them walks the graph. An edit that touches an output of a graph ends the index of that
 * graph, which is walked from then on.
 */
#include "base/hash.h"
#include "document/document.h"

#include <assert.h>

static struct doc_outputs walk(const struct document *doc, elem_id graph, str_id type)
{
    struct doc_outputs found = {.graph = graph, .type = type};
    for (elem_id e = doc_element(doc, graph)->first_child; e && !found.second;
         e = doc_element(doc, e)->next) {
        if (doc_element(doc, e)->kind != KIND_OUTPUT
            || (type && doc_attr_value(doc, e, STR_type) != type))
            continue;
        *(found.first ? &found.second : &found.first) = e;
    }
    return found;
}

static struct doc_outputs *find(const struct document *doc, elem_id graph, str_id type)
{
    uint32_t hash = hash_pair(graph, type), at = hash;
    for (uint32_t found; (found = table_next(&doc->output_table, hash, &at));) {
        struct doc_outputs *outputs = &doc->outputs.items[found - 1];
        if (outputs->graph == graph && outputs->type == type)
            return outputs;
    }
    return NULL;
}

static void add(struct document *doc, elem_id graph, str_id type, elem_id output)
{
    struct doc_outputs *known = find(doc, graph, type);
    if (known) {
        known->second = known->second ? known->second : output;
        return;
    }
    vec_push(doc->arena, &doc->outputs, (struct doc_outputs){graph, type, output, 0});
    table_add(&doc->output_table, doc->arena, hash_pair(graph, type), doc->outputs.len);
}

void doc_index_outputs(struct document *doc)
{
    assert(!doc->origin);
    doc->outputs.len = 0;
    doc->output_table = doc->touched = (struct table){0};
    doc->has_outputs = true;
    for (uint32_t i = 0; i < doc->elements.len; i++) {
        if (doc->elements.items[i].kind != KIND_NODEGRAPH)
            continue;
        elem_id graph = doc->first_element + i;
        for (elem_id e = doc_element(doc, graph)->first_child; e; e = doc_element(doc, e)->next) {
            if (doc_element(doc, e)->kind != KIND_OUTPUT)
                continue;
            str_id type = doc_attr_value(doc, e, STR_type);
            add(doc, graph, STR_EMPTY, e);
            if (type)
                add(doc, graph, type, e);
        }
    }
}

static bool is_touched(const struct document *doc, elem_id graph)
{
    uint32_t hash = hash_pair(graph, 0), at = hash, found;
    while ((found = table_next(&doc->touched, hash, &at)) && found != graph)
        ;
    return found != 0;
}

void doc_touch_outputs(struct document *doc, elem_id element, elem_id parent)
{
    if (parent && doc_element(doc, element)->kind == KIND_OUTPUT && !is_touched(doc, parent))
        table_add(&doc->touched, doc->arena, hash_pair(parent, 0), parent);
}

struct doc_outputs doc_outputs(const struct document *doc, elem_id graph, str_id type)
{
    const struct document *layer = doc_layer(doc, graph);
    bool is_touched_above = false;
    for (; layer->origin && !is_touched_above; layer = layer->origin)
        is_touched_above = is_touched(layer, graph);
    if (is_touched_above || !layer->has_outputs || is_touched(layer, graph))
        return walk(doc, graph, type);
    const struct doc_outputs *known = find(layer, graph, type);
    return known ? *known : (struct doc_outputs){.graph = graph, .type = type};
}
