// SPDX-License-Identifier: Apache-2.0
/*
 * A library as MaterialX. Where a definition has both code and a graph, other tools need the graph:
 * the code is left out, and a comment names the inputs without a part in the graph.
 */
#include "library/library.h"

struct writer {
    const struct library *lib;
    const uint32_t *impls;    /* by element: the number of its implementation + 1; 0: none */
    const uint8_t *has_graph; /* per definition of the layer */
    const uint8_t *has_code;
};

static bool is_graph(const struct implementation *impl)
{
    return impl->kind == IMPL_GRAPH && impl->ref == impl->element;
}

/* True if a node of the graph reads the input. */
static bool is_read(const struct document *doc, elem_id graph, str_id input)
{
    for (elem_id at = doc_element(doc, graph)->first_child; at;
         at = doc_next_in_tree(doc, graph, at))
        if (doc_attr_value(doc, at, STR_interfacename) == input)
            return true;
    return false;
}

static void name_losses(const struct library *lib, const struct implementation *graph,
                        struct text *out)
{
    const struct nodedef *def = library_nodedef(lib, graph->nodedef);
    const struct port *ports = library_ports(lib, graph->nodedef, NULL);
    const char *before = "  <!-- Without a part in this graph: ";
    for (uint32_t i = 0; i < def->num_inputs; i++) {
        if (is_read(&lib->doc, graph->element, ports[i].name))
            continue;
        text_fmt(out, "%s%s", before, str_text(&lib->strings, ports[i].name));
        before = ", ";
    }
    if (*before == ',')
        text_str(out, " -->\n");
}

static bool take(void *user_data, elem_id child, struct text *out)
{
    const struct writer *w = user_data;
    uint32_t own = w->impls[child - w->lib->doc.first_element];
    if (!own)
        return true;
    const struct implementation *impl = &w->lib->impls.items[own - 1];
    uint32_t def = impl->nodedef - w->lib->base_nodedefs;
    if (!w->has_graph[def] || !w->has_code[def])
        return true;
    if (is_graph(impl))
        name_losses(w->lib, impl, out);
    return is_graph(impl);
}

void library_write(const struct library *lib, struct text *out)
{
    uint8_t *has_graph = ARENA_ARRAY(out->arena, uint8_t, lib->nodedefs.len + 1);
    uint8_t *has_code = ARENA_ARRAY(out->arena, uint8_t, lib->nodedefs.len + 1);
    uint32_t *impls = ARENA_ARRAY(out->arena, uint32_t, doc_num_elements(&lib->doc));
    for (uint32_t i = 0; i < lib->impls.len; i++) {
        const struct implementation *impl = &lib->impls.items[i];
        if (impl->nodedef < lib->base_nodedefs || impl->target)
            continue;
        impls[impl->element - lib->doc.first_element] = i + 1;
        uint8_t *has = is_graph(impl) ? has_graph : has_code;
        has[impl->nodedef - lib->base_nodedefs] = 1;
    }
    struct writer writer = {
        .lib = lib, .impls = impls, .has_graph = has_graph, .has_code = has_code};
    struct doc_choice choice = {.user_data = &writer, .take = take};
    doc_write_part(&lib->doc, lib->doc.root, &choice, out);
}
