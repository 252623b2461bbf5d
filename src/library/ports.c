// SPDX-License-Identifier: Apache-2.0
/*
 * The ports of a nodedef: its own ones first, then those that it inherits and does not declare
 * again (specification, "NodeDef Inheritance"). A nodedef takes them from the list of the one that
 * it inherits, so a chain is walked once.
 */
#include "base/hash.h"
#include "library/index_priv.h"

bool index_type(struct indexer *ix, elem_id element, doc_type *out_type)
{
    *out_type = library_type(ix->lib, index_attr(ix, element, STR_type));
    if (*out_type)
        return true;
    doc_report_type(&ix->lib->doc, element, ix->diags);
    return false;
}

/* True if the element has a list of words; reports one beyond the limit, which each use would
 * search. */
static bool has_words(struct indexer *ix, elem_id element)
{
    enum { MAX_SIZE = 1 << 14 };
    static const str_id lists[] = {STR_enum, STR_enumvalues};
    const struct document *doc = &ix->lib->doc;
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        str_id list = index_attr(ix, element, lists[i]);
        if (!list || str_len(&ix->lib->strings, list) <= MAX_SIZE)
            continue;
        diag_add(ix->diags, DIAG_ID_too_many_variants, doc_attr_place(doc, element, lists[i]),
                 index_text(ix, doc_element(doc, element)->name), (unsigned)MAX_SIZE,
                 "bytes in a list of words");
        return false;
    }
    return index_attr(ix, element, STR_enum) != 0;
}

static void add_port(struct indexer *ix, elem_id element, bool input)
{
    struct document *doc = &ix->lib->doc;
    struct port port = {.name = doc_element(doc, element)->name, .element = element};
    if (!index_type(ix, element, &port.type))
        return;
    const struct attribute *value = doc_attr(doc, element, input ? STR_value : STR_default);
    port.value = value ? value->value : 0;
    port.flags = (uint16_t)((value ? PORT_HAS_VALUE : 0)
                            | (doc_attr_is_true(doc, element, STR_uniform) ? PORT_UNIFORM : 0)
                            | (has_words(ix, element) ? PORT_ENUM : 0));
    port.geomprop = index_attr(ix, element, input ? STR_defaultgeomprop : STR_defaultinput);
    vec_push(ix->arena, &ix->lib->ports, port);
}

/* ---- Ports of one kind ---- */

struct adding {
    struct indexer *ix;
    elem_id nodedef;
    enum element_kind kind;
    uint32_t first, most; /* ports of this kind */
};

static bool has_port(const struct adding *adding, uint32_t end, str_id name)
{
    const struct library *lib = adding->ix->lib;
    for (uint32_t i = adding->first; i < end; i++)
        if (lib->ports.items[i].name == name)
            return true;
    return false;
}

/* False after reporting at `place` that there is no room for one more port. */
static bool has_room(const struct adding *adding, struct diag_place place)
{
    const struct library *lib = adding->ix->lib;
    if (lib->ports.len - adding->first < adding->most)
        return true;
    diag_add(adding->ix->diags, DIAG_ID_too_many_ports, place,
             index_text(adding->ix, doc_element(&lib->doc, adding->nodedef)->name),
             (unsigned)adding->most);
    return false;
}

static void add_own(struct adding *adding)
{
    struct library *lib = adding->ix->lib;
    for (elem_id e = doc_element(&lib->doc, adding->nodedef)->first_child; e;
         e = doc_element(&lib->doc, e)->next) {
        const struct element *child = doc_element(&lib->doc, e);
        if (child->kind != adding->kind || has_port(adding, lib->ports.len, child->name))
            continue;
        if (!has_room(adding, doc_place(&lib->doc, e)))
            return;
        add_port(adding->ix, e, adding->kind == KIND_INPUT);
    }
}

/* Adds those ports of another nodedef that this one does not have. */
static void inherit(struct adding *adding, uint32_t first, uint32_t num)
{
    struct library *lib = adding->ix->lib;
    uint32_t own_end = lib->ports.len;
    for (uint32_t i = first; i < first + num; i++) {
        struct port port = lib->ports.items[i];
        if (has_port(adding, own_end, port.name))
            continue;
        if (!has_room(adding, doc_attr_place(&lib->doc, adding->nodedef, STR_inherit)))
            return;
        vec_push(adding->ix->arena, &lib->ports, port);
    }
}

static uint16_t add_kind(struct indexer *ix, elem_id nodedef, enum element_kind kind,
                         uint32_t inherited, uint32_t num_inherited)
{
    struct adding adding = {.ix = ix,
                            .nodedef = nodedef,
                            .kind = kind,
                            .first = ix->lib->ports.len,
                            .most = kind == KIND_INPUT ? INDEX_MAX_PORTS : LIBRARY_MAX_OUTPUTS};
    add_own(&adding);
    inherit(&adding, inherited, num_inherited);
    return (uint16_t)(ix->lib->ports.len - adding.first);
}

/* ---- Inheritance ---- */

enum { MAX_INHERIT = 256 }; /* because a definition has a list of all ports that it inherits */

/* Closes the list of a nodedef that inherits from `base`, which is closed; NULL: from nothing. */
static void close_list(struct indexer *ix, struct port_list *list, const struct port_list *base)
{
    const struct port_list none = {0}, *from = base ? base : &none;
    list->first = ix->lib->ports.len;
    list->num_inputs = add_kind(ix, list->nodedef, KIND_INPUT, from->first, from->num_inputs);
    list->num_outputs =
        add_kind(ix, list->nodedef, KIND_OUTPUT, from->first + from->num_inputs, from->num_outputs);
    list->depth = (uint16_t)(from->depth + 1);
    list->is_open = false;
}

/* LIBRARY_NONE: the nodedef has no list yet. */
static uint32_t find_list(const struct indexer *ix, elem_id nodedef)
{
    uint32_t hash = hash_pair(nodedef, 0);
    for (uint32_t at = hash, found; (found = table_next(&ix->port_table, hash, &at));)
        if (ix->port_lists.items[found - 1].nodedef == nodedef)
            return found - 1;
    return LIBRARY_NONE;
}

static void report(struct indexer *ix, elem_id nodedef, enum diag_id id)
{
    const struct document *doc = &ix->lib->doc;
    diag_add(ix->diags, id, doc_attr_place(doc, nodedef, STR_inherit),
             index_text(ix, doc_element(doc, nodedef)->name),
             index_text(ix, index_attr(ix, nodedef, STR_inherit)));
}

/* The nodedef that a nodedef inherits; 0: none, or after a diagnostic. */
static elem_id base_of(struct indexer *ix, elem_id nodedef)
{
    str_id name = index_attr(ix, nodedef, STR_inherit);
    elem_id base = 0;
    for (const struct library *layer = ix->lib; name && !base && layer; layer = layer->base)
        base = doc_child_of_kind(&layer->doc, layer->doc.root, KIND_NODEDEF, name);
    if (name && !base)
        report(ix, nodedef, DIAG_ID_inherit_missing);
    return base;
}

/* The list that another may inherit from; NULL: none, or after a diagnostic. */
static const struct port_list *usable(struct indexer *ix, const struct port_list *list,
                                      const struct port_list *base)
{
    if (!base || (!base->is_open && base->depth < MAX_INHERIT))
        return base;
    if (base->is_open)
        report(ix, base->nodedef, DIAG_ID_inherit_cycle); /* as doc_validate does */
    else
        report(ix, list->nodedef, DIAG_ID_inherit_depth);
    return NULL;
}

const struct port_list *index_ports(struct indexer *ix, elem_id nodedef)
{
    uint32_t first = ix->port_lists.len, found = LIBRARY_NONE;
    for (elem_id at = nodedef; at && (found = find_list(ix, at)) == LIBRARY_NONE;
         at = base_of(ix, at)) {
        vec_push(ix->arena, &ix->port_lists, (struct port_list){.nodedef = at, .is_open = true});
        table_add(&ix->port_table, ix->arena, hash_pair(at, 0), ix->port_lists.len);
    }
    if (found != LIBRARY_NONE && first == ix->port_lists.len)
        return &ix->port_lists.items[found];
    const struct port_list *base = found == LIBRARY_NONE ? NULL : &ix->port_lists.items[found];
    for (uint32_t i = ix->port_lists.len; i-- > first;) {
        struct port_list *list = &ix->port_lists.items[i];
        close_list(ix, list, usable(ix, list, base));
        base = list;
    }
    return &ix->port_lists.items[first];
}
