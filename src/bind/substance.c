// SPDX-License-Identifier: Apache-2.0
#include "bind/substance.h"

#include "base/hash.h"

static const struct document *doc_of(const struct substance *s)
{
    return &s->lib->doc;
}

static const struct element *element(const struct substance *s, elem_id id)
{
    return doc_element(doc_of(s), id);
}

/* ---- The walk ---- */

/* True if the element is met for the first time. */
static bool meet(struct substance *s, elem_id id)
{
    uint32_t hash = hash_pair(id, 0);
    for (uint32_t at = hash, found; (found = table_next(&s->met, hash, &at));)
        if (s->order.items[found - 1] == id)
            return false;
    vec_push(s->arena, &s->order, id);
    table_add(&s->met, s->arena, hash, s->order.len);
    return true;
}

static void meet_graph(struct substance *s, elem_id graph)
{
    bool is_plain = graph && element(s, graph)->kind == KIND_NODEGRAPH
                    && !doc_attr_value(doc_of(s), graph, STR_nodedef);
    if (is_plain && meet(s, graph))
        vec_push(s->arena, &s->graphs, graph);
}

struct binding substance_resolve(struct substance *s, elem_id port)
{
    return library_resolve_port(s->lib, port, DOC_TYPE_NONE, &s->resolved, &s->ignored);
}

/* Follows the connection of an input to its node, and notes the nodegraph that it names. */
static void follow(struct substance *s, elem_id input)
{
    str_id graph = doc_attr_value(doc_of(s), input, STR_nodegraph);
    if (graph)
        meet_graph(s, doc_top_level(doc_of(s), KIND_NODEGRAPH, graph));
    struct binding binding = substance_resolve(s, input);
    if (binding.kind == BIND_NODE && meet(s, binding.ref))
        vec_push(s->arena, &s->open, binding.ref);
}

static void follow_inputs(struct substance *s, elem_id owner)
{
    for (elem_id e = element(s, owner)->first_child; e; e = element(s, e)->next)
        if (element(s, e)->kind == KIND_INPUT)
            follow(s, e);
}

static void visit_open(struct substance *s)
{
    while (s->open.len) {
        elem_id node = vec_pop(&s->open);
        str_id type = doc_attr_value(doc_of(s), node, STR_type);
        if (type == STR_surfaceshader || type == STR_displacementshader || type == STR_volumeshader)
            vec_push(s->arena, &s->shaders, node);
        meet_graph(s, element(s, node)->parent);
        follow_inputs(s, node);
    }
}

void substance_follow(struct substance *s, elem_id input)
{
    follow(s, input);
    visit_open(s);
}

elem_id bind_material_node(const struct library *lib, elem_id target, struct diag_list *ignored)
{
    const struct document *doc = &lib->doc;
    if (doc_element(doc, target)->kind == KIND_NODE)
        return target;
    elem_id output = doc_outputs(doc, target, STR_material).first;
    if (!output)
        return 0;
    struct resolve_out out = {.arena = ignored->arena};
    struct binding binding = library_resolve_port(lib, output, DOC_TYPE_NONE, &out, ignored);
    return binding.kind == BIND_NODE ? binding.ref : 0;
}

void substance_find(struct substance *s, const struct library *lib, elem_id target,
                    struct arena *arena)
{
    *s = (struct substance){.lib = lib, .arena = arena, .resolved.arena = arena};
    diag_list_init(&s->ignored, arena);
    s->material = bind_material_node(lib, target, &s->ignored);
    if (!s->material)
        return;
    meet(s, s->material);
    meet_graph(s, element(s, s->material)->parent);
    follow_inputs(s, s->material);
    visit_open(s);
}

/* ---- Variant sets ---- */

/* True if a list of the document has the word. */
static bool lists(const struct substance *s, str_id list, str_id word)
{
    const char *text = str_text(doc_of(s)->strings, list);
    for (size_t len; *text; text += len) {
        text += strspn(text, ", \t\r\n");
        len = strcspn(text, ", \t\r\n");
        if (len == str_len(doc_of(s)->strings, word)
            && memcmp(text, str_text(doc_of(s)->strings, word), len) == 0)
            return len > 0;
    }
    return false;
}

bool substance_set_takes(struct substance *s, elem_id set, elem_id node)
{
    str_id nodes = doc_attr_value(doc_of(s), set, STR_node),
           nodedefs = doc_attr_value(doc_of(s), set, STR_nodedef);
    if (nodes && !lists(s, nodes, element(s, node)->category))
        return false;
    uint32_t nodedef = nodedefs ? library_match(s->lib, node, &s->ignored) : LIBRARY_NONE;
    return !nodedefs
           || (nodedef != LIBRARY_NONE
               && lists(s, nodedefs, library_nodedef(s->lib, nodedef)->name));
}

bool substance_set_applies(struct substance *s, elem_id set)
{
    if (!s->material || substance_set_takes(s, set, s->material))
        return s->material;
    for (uint32_t i = 0; i < s->shaders.len; i++)
        if (substance_set_takes(s, set, s->shaders.items[i]))
            return true;
    return false;
}
