// SPDX-License-Identifier: Apache-2.0
/*
 * Warns about globs of the options "uniform" and "constant" that match no input of the document,
 * because most of them are misspelt.
 */
#include "api/generation.h"

struct search {
    const struct library *lib;
    const char *glob;
    struct text path;         /* path of the current element */
    struct diag_list ignored; /* building a node reports its faults, not this search */
};

static bool input_matches(struct search *s, size_t element_len, str_id input)
{
    s->path.len = element_len;
    text_fmt(&s->path, "/%s", str_text(s->lib->doc.strings, input));
    return build_glob_matches(s->glob, text_cstr(&s->path));
}

/* True if a glob matches an input of the element, or an input that only its definition has. */
static bool element_matches(struct search *s, elem_id element)
{
    const struct document *doc = &s->lib->doc;
    s->path.len = 0;
    doc_path(doc, element, '/', &s->path);
    size_t len = s->path.len;
    for (elem_id e = doc_element(doc, element)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_INPUT
            && input_matches(s, len, doc_element(doc, e)->name))
            return true;
    bool is_node = doc_element(doc, element)->kind == KIND_NODE;
    uint32_t nodedef = is_node ? library_match(s->lib, element, &s->ignored) : LIBRARY_NONE;
    uint32_t num_inputs =
        nodedef != LIBRARY_NONE ? library_nodedef(s->lib, nodedef)->num_inputs : 0;
    const struct port *ports = num_inputs ? library_ports(s->lib, nodedef, NULL) : NULL;
    for (uint32_t i = 0; i < num_inputs; i++)
        if (input_matches(s, len, ports[i].name))
            return true;
    return false;
}

static bool glob_matches(const struct generation *g, const char *glob, struct arena *arena)
{
    const struct document *doc = &g->document->layer.doc;
    struct search s = {.lib = &g->document->layer, .glob = glob};
    text_init(&s.path, arena);
    diag_list_init(&s.ignored, arena);
    const char *slash = strrchr(glob, '/');
    if (slash && !strpbrk(glob, "*?")) { /* a path */
        elem_id element = doc_find(doc, glob, (size_t)(slash - glob));
        return element && element_matches(&s, element);
    }
    for (elem_id e = doc->root; e; e = doc_next_in_tree(doc, doc->root, e)) {
        enum element_kind kind = (enum element_kind)doc_element(doc, e)->kind;
        if ((kind == KIND_NODE || kind == KIND_NODEGRAPH) && element_matches(&s, e))
            return true;
    }
    return false;
}

void generation_check_globs(struct generation *g)
{
    static const enum option_id options[] = {OPTION_uniform, OPTION_constant};
    for (size_t i = 0; i < sizeof options / sizeof *options; i++) {
        const struct option_value *value = &g->options[options[i]];
        for (uint32_t k = 0; k < value->list.len; k++)
            if (!glob_matches(g, value->list.items[k], &g->scratch))
                diag_add(&g->result->object.diagnostics.list, DIAG_ID_glob_no_match,
                         (struct diag_place){0}, value->list.items[k]);
    }
}
