// SPDX-License-Identifier: Apache-2.0
/*
 * After the closures of surfaces became inputs of a model: those that nothing reads any more go,
 * and with them the outputs of nodegraphs that gave them to the surface.
 */
#include "api/translate.h"

struct remains {
    struct translation *t;
    const struct document *doc;
    uint32_t *readers; /* per element: ports that read a node, or an output of a nodegraph */
    bool *may_go;      /* per element */
    VEC(elem_id) unread;
};

static uint32_t index_of(const struct remains *r, elem_id element)
{
    return element - r->doc->first_element;
}

/* The node, or output of a nodegraph, that a port reads; 0: none. */
static elem_id read_by(const struct remains *r, elem_id port)
{
    mxg_connection connection = {.size = sizeof connection};
    if (mxg_document_connection(r->t->document, port, &connection) != MXG_OK || !connection.source
        || *connection.interfacename)
        return 0;
    elem_id source = connection.source;
    if (doc_element(r->doc, source)->kind != KIND_NODEGRAPH)
        return source;
    return translate_find_graph_output(r->t, source, connection.output);
}

static void count_readers(struct remains *r)
{
    for (elem_id e = r->doc->root; e; e = doc_next_in_tree(r->doc, r->doc->root, e)) {
        elem_id source = doc_is_port(r->doc, e) ? read_by(r, e) : 0;
        if (source)
            r->readers[index_of(r, source)]++;
        bool is_output = source && doc_element(r->doc, e)->kind == KIND_OUTPUT;
        r->may_go[index_of(r, e)] |= is_output && r->may_go[index_of(r, source)];
    }
}

static void find_unread(struct remains *r)
{
    for (elem_id e = r->doc->root; e; e = doc_next_in_tree(r->doc, r->doc->root, e))
        if (r->may_go[index_of(r, e)] && !r->readers[index_of(r, e)])
            vec_push(r->t->arena, &r->unread, e);
}

/* One reader less of what a port reads. */
static void leave(struct remains *r, elem_id port)
{
    elem_id source = doc_is_port(r->doc, port) ? read_by(r, port) : 0;
    if (source && --r->readers[index_of(r, source)] == 0 && r->may_go[index_of(r, source)])
        vec_push(r->t->arena, &r->unread, source);
}

static void remove_unread(struct remains *r)
{
    for (uint32_t i = 0; i < r->unread.len; i++) {
        elem_id element = r->unread.items[i];
        leave(r, element);
        for (elem_id e = doc_element(r->doc, element)->first_child; e;
             e = doc_element(r->doc, e)->next)
            leave(r, e);
        translate_expect(r->t, mxg_edit_remove_element(r->t->edit, element) == MXG_OK);
    }
}

void translate_remove_remains(struct translation *t)
{
    const struct document *doc = &t->document->layer.doc;
    uint32_t count = doc_num_elements(doc);
    struct remains r = {t, doc, ARENA_ARRAY(t->arena, uint32_t, count),
                        ARENA_ARRAY(t->arena, bool, count)};
    for (uint32_t i = 0; i < t->replaced.len; i++)
        r.may_go[index_of(&r, t->replaced.items[i])] = true;
    count_readers(&r);
    find_unread(&r);
    translate_start_edit(t);
    remove_unread(&r);
    translate_commit_edit(t);
    arena_finish(t->arena);
}
