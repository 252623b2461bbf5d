// SPDX-License-Identifier: Apache-2.0
/*
 * The AOVs of a material of the document. Nothing needs to read them, so they are found by their
 * place (docs/slots.md, "AOVs"). Those of overrides come last, and replace the others.
 */
#include "build/build_priv.h"

/* The <aov> nodes of the document outside definitions. */
struct aov_nodes {
    VEC(elem_id) items;
    VEC(elem_id) read; /* those at the top level that something reads */
};

/* The top-level node that a port reads; 0: none. */
static elem_id read_at_top(const struct document *doc, elem_id port)
{
    const struct element *e = doc_element(doc, port);
    str_id name = doc_attr_value(doc, port, STR_nodename);
    if (!name || (e->kind != KIND_INPUT && e->kind != KIND_OUTPUT))
        return 0;
    elem_id scope = e->kind == KIND_OUTPUT ? e->parent : doc_element(doc, e->parent)->parent;
    return scope == doc->root ? doc_child_of_kind(doc, scope, KIND_NODE, name) : 0;
}

static const struct aov_nodes *nodes_of(struct builder *b)
{
    const struct document *doc = build_doc(b);
    if (b->aov_nodes)
        return b->aov_nodes;
    b->aov_nodes = ARENA_NEW(b->arena, struct aov_nodes);
    for (elem_id e = doc->has_aovs ? doc->root : 0; e; e = doc_next_in_tree(doc, doc->root, e)) {
        elem_id node = read_at_top(doc, e);
        if (node && build_is_aov(doc, node))
            vec_push(b->arena, &b->aov_nodes->read, node);
        if (build_is_aov(doc, e))
            vec_push(b->arena, &b->aov_nodes->items, e);
    }
    return b->aov_nodes;
}

static bool is_read(const struct aov_nodes *nodes, elem_id node)
{
    for (uint32_t i = 0; i < nodes->read.len; i++)
        if (nodes->read.items[i] == node)
            return true;
    return false;
}

/* 0: no override's; from 1 on: of the override with this number. */
static uint32_t rank_of(const struct builder *b, elem_id node)
{
    uint32_t rank = b->aov_graphs.len;
    while (rank && b->aov_graphs.items[rank - 1] != doc_element(build_doc(b), node)->parent)
        rank--;
    return rank;
}

/*
 * True if the material that was built has the node: it reads the node, or another one of the same
 * nodegraph; or the node stands at the top level, and nothing reads it.
 */
static bool belongs(const struct builder *b, elem_id node)
{
    const struct document *doc = build_doc(b);
    elem_id parent = doc_element(doc, node)->parent;
    if (*build_slot(b->document, node) != SLOT_EMPTY || rank_of(b, node))
        return true;
    if (parent == doc->root)
        return !is_read(b->aov_nodes, node);
    for (elem_id e = doc_element(doc, parent)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_NODE && *build_slot(b->document, e) != SLOT_EMPTY)
            return true;
    return false;
}

struct own_aov {
    elem_id node;
    uint32_t rank;
};
struct own_aovs {
    struct own_aov *items;
    uint32_t len, cap;
};

/* Before the AOVs are built, because these read nodes, too. */
static void find_own(struct builder *b, struct own_aovs *out)
{
    const struct aov_nodes *nodes = nodes_of(b);
    for (uint32_t i = 0; i < nodes->items.len; i++)
        if (belongs(b, nodes->items.items[i]))
            vec_push(b->arena, out,
                     (struct own_aov){nodes->items.items[i], rank_of(b, nodes->items.items[i])});
}

static const struct aov_use *use_of(const struct builder *b, elem_id node)
{
    for (uint32_t i = 0; i < b->aovs.len; i++)
        if (b->aovs.items[i].node == node && b->aovs.items[i].scope == b->document)
            return &b->aovs.items[i];
    return NULL;
}

/* Adds the AOVs of one rank, in the order of the document. */
static void add_rank(struct builder *b, const struct own_aovs *own, uint32_t rank, ir_ref *root)
{
    for (uint32_t i = 0; i < own->len; i++) {
        const struct aov_use *use = own->items[i].rank == rank ? use_of(b, own->items[i].node) : 0;
        bool is_good = use != NULL; /* else its own fault is reported */
        for (uint32_t k = 0; k < i && is_good; k++) {
            const struct aov_use *other =
                own->items[k].rank == rank ? use_of(b, own->items[k].node) : NULL;
            if (other && other->name == use->name)
                is_good = build_report_second_aov(b, other, use);
        }
        if (is_good)
            build_add_aov(b, use, root);
    }
}

ir_ref build_element_aovs(struct builder *b, ir_ref root)
{
    struct own_aovs own = {0};
    ir_type_id type = root ? ir_type_of(b->graph, root) : IR_TYPE_VOID;
    if (type != IR_TYPE_SURFACE && type != IR_TYPE_MATERIAL)
        return root;
    find_own(b, &own);
    for (uint32_t i = 0; i < own.len; i++)
        build_demand(b, b->document, own.items[i].node);
    if (b->cancelled)
        return 0;
    for (uint32_t rank = 0; own.len && rank <= b->aov_graphs.len; rank++)
        add_rank(b, &own, rank, &root);
    return root;
}
