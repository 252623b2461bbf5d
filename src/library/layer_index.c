// SPDX-License-Identifier: Apache-2.0
/* Fills a library layer from its document: types, definitions, geometric properties. */
#include "library/index_priv.h"

#include "base/hash.h"
#include "library/formulas.h"

#include <assert.h>

static const char *text_of(const struct library *lib, str_id id)
{
    return str_text(&lib->strings, id);
}

/* Stores the index of an element in the table of its kind. */
static void set_info(struct indexer *ix, elem_id element, uint32_t own)
{
    assert(element - ix->lib->doc.first_element < ix->lib->element_info.len);
    assert(!ix->lib->element_info.items[element - ix->lib->doc.first_element]);
    ix->lib->element_info.items[element - ix->lib->doc.first_element] = own + 1;
}

void index_note_graph(struct indexer *ix, elem_id graph, uint32_t own)
{
    const struct library *lib = ix->lib;
    if (graph >= lib->doc.first_element && !lib->element_info.items[graph - lib->doc.first_element])
        set_info(ix, graph, own);
}

/* ---- types ---- */

static ir_type_id struct_type(struct indexer *ix, elem_id element, str_id name)
{
    struct library *lib = ix->lib;
    uint32_t first = lib->unit.members.len;
    for (elem_id e = doc_element(&lib->doc, element)->first_child; e;
         e = doc_element(&lib->doc, e)->next) {
        doc_type type;
        if (doc_element(&lib->doc, e)->kind != KIND_MEMBER || !index_type(ix, e, &type))
            continue;
        vec_push(ix->arena, &lib->unit.members,
                 (struct ir_member){.name = doc_element(&lib->doc, e)->name,
                                    .type = library_type_ir(lib, type)});
    }
    uint32_t num_members = lib->unit.members.len - first;
    ir_type_id type = IR_TYPE_VOID;
    if (num_members && num_members <= UINT16_MAX)
        type = lang_add_type(&lib->unit, (struct ir_user_type){.name = name,
                                                               .num_members = (uint16_t)num_members,
                                                               .first_member = first});
    if (num_members && !type)
        diag_add(ix->diags, DIAG_ID_lang_limit, doc_place(&lib->doc, element), "it is too large");
    return type;
}

static void add_typedef(struct indexer *ix, elem_id element)
{
    str_id name = doc_element(&ix->lib->doc, element)->name;
    if (!name || doc_type_of(name))
        return;
    ir_type_id ir = struct_type(ix, element, name);
    vec_push(ix->arena, &ix->lib->types,
             (struct user_type){.name = name,
                                .semantic = index_attr(ix, element, STR_semantic),
                                .ir = ir,
                                .element = element});
    set_info(ix, element, ix->lib->types.len - 1);
}

/* ---- definitions ---- */

static void link_by_node(struct indexer *ix, uint32_t own)
{
    struct library *lib = ix->lib;
    struct nodedef *def = &lib->nodedefs.items[own];
    assert(def->next_same_node == LIBRARY_NONE);
    uint32_t hash = hash_pair(def->node, 0), at = hash, first;
    while ((first = table_next(&lib->node_table, hash, &at))
           && lib->nodedefs.items[first - 1].node != def->node)
        ;
    assert(!first || first - 1 > own);
    def->next_same_node = first - 1; /* LIBRARY_NONE: 0 - 1 */
    if (first)
        table_replace(&lib->node_table, at, own + 1);
    else
        table_add(&lib->node_table, ix->arena, hash, own + 1);
}

/* Drops the definitions of a node beyond the limit, because each use of the node tries them all. */
static void limit_definitions(struct indexer *ix, uint32_t first)
{
    struct library *lib = ix->lib;
    uint32_t last = first;
    for (unsigned i = 1; i < INDEX_MAX_VARIANTS && last != LIBRARY_NONE; i++)
        last = lib->nodedefs.items[last].next_same_node;
    if (last == LIBRARY_NONE || lib->nodedefs.items[last].next_same_node == LIBRARY_NONE)
        return;
    const struct nodedef *excess = &lib->nodedefs.items[lib->nodedefs.items[last].next_same_node];
    diag_add(ix->diags, DIAG_ID_too_many_variants, doc_place(&lib->doc, excess->element),
             text_of(lib, excess->node), INDEX_MAX_VARIANTS, "definitions");
    lib->nodedefs.items[last].next_same_node = LIBRARY_NONE;
}

/* From the last, so that the first of a node leads. */
static void make_node_table(struct indexer *ix)
{
    for (uint32_t i = ix->lib->nodedefs.len; i-- > 0;)
        link_by_node(ix, i);
    for (uint32_t i = 0; i < ix->lib->nodedefs.len; i++)
        if (library_first_of_node(ix->lib, ix->lib->nodedefs.items[i].node) == i)
            limit_definitions(ix, i);
}

static void add_targets(struct indexer *ix, struct nodedef *def)
{
    struct index_targets targets;
    index_read_targets(ix, def->element, &targets);
    def->first_target = ix->lib->refs.len;
    for (uint32_t i = 0; i < targets.len && targets.items[i]; i++, def->num_targets++)
        vec_push(ix->arena, &ix->lib->refs, targets.items[i]);
}

static void add_nodedef(struct indexer *ix, elem_id element)
{
    struct library *lib = ix->lib;
    struct nodedef def = {
        .name = doc_element(&lib->doc, element)->name,
        .node = index_attr(ix, element, STR_node),
        .version = index_attr(ix, element, STR_version),
        .is_default_version = doc_attr_is_true(&lib->doc, element, STR_isdefaultversion),
        .element = element,
        .first_impl = LIBRARY_NONE,
        .next_same_node = LIBRARY_NONE,
    };
    if (!def.node && (def.node = index_attr(ix, element, STR_nodename)) != 0)
        diag_add(ix->diags, DIAG_ID_nodedef_nodename,
                 doc_attr_place(&lib->doc, element, STR_nodename));
    if (!def.node)
        return; /* nodedefs without a node, for example of options */
    const struct port_list *ports = index_ports(ix, element);
    def.first_port = ports->first;
    def.num_inputs = ports->num_inputs;
    def.num_outputs = ports->num_outputs;
    add_targets(ix, &def);
    vec_push(ix->arena, &lib->nodedefs, def);
    set_info(ix, element, lib->nodedefs.len - 1);
}

/* ---- geometric properties ---- */

static uint32_t default_nodedef(const struct library *lib, str_id node, doc_type type)
{
    for (; lib; lib = lib->base)
        for (uint32_t i = library_first_of_node(lib, node); i != LIBRARY_NONE;
             i = lib->nodedefs.items[i].next_same_node) {
            const struct nodedef *def = &lib->nodedefs.items[i];
            if (def->num_outputs && !def->num_targets
                && lib->ports.items[def->first_port + def->num_inputs].type == type)
                return lib->base_nodedefs + i;
        }
    return LIBRARY_NONE;
}

static void add_geomprop(struct indexer *ix, elem_id element)
{
    struct library *lib = ix->lib;
    struct geomprop prop = {
        .name = doc_element(&lib->doc, element)->name,
        .geomprop = index_attr(ix, element, STR_geomprop),
        .space = index_attr(ix, element, STR_space),
        .element = element,
        .nodedef = LIBRARY_NONE,
    };
    if (!index_type(ix, element, &prop.type))
        return;
    str_id index = index_attr(ix, element, STR_index);
    struct ir_value value;
    if (index
        && doc_parse_value(DOC_TYPE_integer, text_of(lib, index), str_len(&lib->strings, index),
                           NULL, &value))
        prop.index = (uint16_t)value.w[0].i;
    if (prop.geomprop)
        prop.nodedef = default_nodedef(lib, prop.geomprop, prop.type);
    vec_push(ix->arena, &lib->geomprops, prop);
    set_info(ix, element, lib->geomprops.len - 1);
}

/* ---- units ---- */

static void add_unitdef(struct indexer *ix, elem_id element)
{
    library_index_units(ix->lib, element);
}

/* ---- the layer ---- */

static void for_each(struct indexer *ix, enum element_kind kind,
                     void (*add)(struct indexer *, elem_id))
{
    const struct document *doc = &ix->lib->doc;
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == kind)
            add(ix, e);
}

void library_index(struct library *lib, const struct lang_reader *reader, struct diag_list *diags)
{
    assert(lib->element_info.len == 0 && lib->impls.len == 0);
    struct indexer ix = {lib, lib->doc.arena, reader, diags};
    lib->deferred = ARENA_NEW(ix.arena, struct diag_list);
    diag_list_init(lib->deferred, ix.arena);
    uint32_t *info = vec_extend(ix.arena, &lib->element_info, doc_num_elements(&lib->doc));
    memset(info, 0, doc_num_elements(&lib->doc) * sizeof *info);
    if (!lib->base)
        library_add_formulas(&lib->unit);
    for_each(&ix, KIND_TYPEDEF, add_typedef);
    for_each(&ix, KIND_NODEDEF, add_nodedef);
    make_node_table(&ix);
    for_each(&ix, KIND_GEOMPROPDEF, add_geomprop);
    for_each(&ix, KIND_IMPLEMENTATION, index_implementation);
    for_each(&ix, KIND_NODEGRAPH, index_functional_graph);
    index_operators(&ix);
    index_link_implementations(&ix);
    for_each(&ix, KIND_UNITDEF, add_unitdef);
    library_sort_units(lib);
    assert(lib->element_info.len == doc_num_elements(&lib->doc));
}

/*
 * Stores the indices of interface inputs in the bindings of a nodegraph, unless another definition
 * shares the nodegraph.
 */
static void number_interface(const struct library *lib, uint32_t nodedef, struct binding *bindings,
                             uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        int input = bindings[i].kind == BIND_INTERFACE
                        ? library_find_input(lib, nodedef, bindings[i].ref)
                        : -1;
        bindings[i].input = input > 0 ? (uint16_t)input : 0;
    }
}

static void resolve_graph(struct library *lib, const struct implementation *impl,
                          struct resolve_out *out, struct diag_list *diags)
{
    elem_id graph = impl->ref;
    for (elem_id e = doc_element(&lib->doc, graph)->first_child; e;
         e = doc_element(&lib->doc, e)->next) {
        if (doc_element(&lib->doc, e)->kind != KIND_NODE
            || lib->element_info.items[e - lib->doc.first_element])
            continue;
        uint32_t first = out->bindings.len;
        bool is_settled = !library_depends_on_target(lib, e);
        struct graph_node node = library_resolve_node(lib, e, out, diags);
        assert(node.first_binding == first);
        number_interface(lib, impl->nodedef, out->bindings.items + first,
                         out->bindings.len - first);
        if (!is_settled)
            continue;
        assert(lib->graph_nodes.len < doc_num_elements(&lib->doc));
        vec_push(out->arena, &lib->graph_nodes, node);
        lib->element_info.items[e - lib->doc.first_element] = lib->graph_nodes.len;
    }
}

/* A graph with errors is a broken implementation of its definitions, as source with errors is. */
static void settle_graph(struct library *lib, uint32_t own, struct resolve_out *out,
                         struct diag_list *diags)
{
    struct implementation *impl = &lib->impls.items[own];
    uint32_t first = library_element_info(lib, impl->ref, NULL);
    assert(first <= own);
    if (first < own && lib->impls.items[first].kind == IMPL_BROKEN) {
        impl->kind = IMPL_BROKEN;
        impl->ref = lib->impls.items[first].ref;
        impl->count = lib->impls.items[first].count;
        return;
    }
    struct diag_list faults;
    diag_list_init(&faults, lib->doc.arena);
    faults.policy = diags->policy;
    faults.num_guesses = diags->num_guesses; /* all graphs together have a limited number */
    out->chains = (struct library_chains){0};
    resolve_graph(lib, impl, out, &faults);
    diags->num_guesses = faults.num_guesses;
    if (faults.num_errors)
        index_break(lib, impl, &faults);
    for (uint32_t i = 0; !faults.num_errors && i < faults.items.len; i++)
        diag_repeat(diags, &faults.items.items[i]);
}

void library_resolve_graphs(struct library *lib, struct diag_list *diags)
{
    struct resolve_out out = {.arena = lib->doc.arena};
    for (uint32_t i = 0; i < lib->impls.len; i++)
        if (lib->impls.items[i].kind == IMPL_GRAPH
            && lib->impls.items[i].ref >= lib->doc.first_element)
            settle_graph(lib, i, &out, diags);
    lib->bindings.items = out.bindings.items;
    lib->bindings.len = out.bindings.len;
}
