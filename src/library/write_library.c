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

/* The next input of the definition, from `input` on, that the graph does not read; the number of
 * inputs: there is none. */
static uint32_t next_loss(const struct library *lib, const struct implementation *graph,
                          uint32_t input)
{
    const struct port *ports = library_ports(lib, graph->nodedef, NULL);
    uint32_t num = library_nodedef(lib, graph->nodedef)->num_inputs;
    while (input < num && library_graph_reads(lib, graph->element, ports[input].name))
        input++;
    return input;
}

static void name_losses(const struct library *lib, const struct implementation *graph,
                        struct text *out)
{
    const struct nodedef *def = library_nodedef(lib, graph->nodedef);
    const struct port *ports = library_ports(lib, graph->nodedef, NULL);
    const char *before = "  <!-- Without a part in this graph: ";
    for (uint32_t i = 0; (i = next_loss(lib, graph, i)) < def->num_inputs; i++) {
        text_fmt(out, "%s%s", before, str_text(&lib->strings, ports[i].name));
        before = ", ";
    }
    if (*before == ',')
        text_str(out, " -->\n");
}

static void report_graph(const struct library *lib, const struct implementation *graph,
                         struct diag_list *diags)
{
    const struct nodedef *def = library_nodedef(lib, graph->nodedef);
    const struct port *ports = library_ports(lib, graph->nodedef, NULL);
    for (uint32_t i = 0; (i = next_loss(lib, graph, i)) < def->num_inputs; i++)
        diag_add(diags, DIAG_ID_expand_loss, doc_name_place(&lib->doc, ports[i].element),
                 str_text(&lib->strings, ports[i].name), str_text(&lib->strings, def->node));
}

/* True for an implementation of a definition that has both code and a graph. */
static bool has_both(const struct writer *w, const struct implementation *impl)
{
    uint32_t def = impl->nodedef - w->lib->base_nodedefs;
    return w->has_graph[def] && w->has_code[def];
}

static bool take(void *user_data, elem_id child, struct text *out)
{
    const struct writer *w = user_data;
    uint32_t own = w->impls[child - w->lib->doc.first_element];
    if (!own)
        return true;
    const struct implementation *impl = &w->lib->impls.items[own - 1];
    if (!has_both(w, impl))
        return true;
    if (is_graph(impl))
        name_losses(w->lib, impl, out);
    return is_graph(impl);
}

static struct writer open_writer(const struct library *lib, struct arena *arena)
{
    uint8_t *has_graph = ARENA_ARRAY(arena, uint8_t, lib->nodedefs.len + 1);
    uint8_t *has_code = ARENA_ARRAY(arena, uint8_t, lib->nodedefs.len + 1);
    uint32_t *impls = ARENA_ARRAY(arena, uint32_t, doc_num_elements(&lib->doc));
    for (uint32_t i = 0; i < lib->impls.len; i++) {
        const struct implementation *impl = &lib->impls.items[i];
        if (impl->nodedef < lib->base_nodedefs || impl->target)
            continue;
        impls[impl->element - lib->doc.first_element] = i + 1;
        uint8_t *has = is_graph(impl) ? has_graph : has_code;
        has[impl->nodedef - lib->base_nodedefs] = 1;
    }
    return (struct writer){
        .lib = lib, .impls = impls, .has_graph = has_graph, .has_code = has_code};
}

void library_write(const struct library *lib, struct text *out)
{
    struct writer writer = open_writer(lib, out->arena);
    struct doc_choice choice = {.user_data = &writer, .take = take};
    doc_write_part(&lib->doc, lib->doc.root, &choice, out);
}

void library_report_losses(const struct library *lib, struct diag_list *diags)
{
    struct writer writer = open_writer(lib, diags->arena);
    for (uint32_t i = 0; i < lib->impls.len; i++) {
        const struct implementation *impl = &lib->impls.items[i];
        bool is_own = impl->nodedef >= lib->base_nodedefs && !impl->target;
        if (is_own && is_graph(impl) && has_both(&writer, impl))
            report_graph(lib, impl, diags);
    }
}
