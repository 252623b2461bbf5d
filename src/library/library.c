// SPDX-License-Identifier: Apache-2.0
#include "library/library.h"

#include "base/hash.h"

#include <assert.h>

void library_init(struct library *lib, struct arena *arena, struct library *base)
{
    memset(lib, 0, sizeof *lib);
    lib->base = base;
    strpool_init(&lib->strings, arena, base ? &base->strings : NULL);
    doc_init(&lib->doc, arena, &lib->strings, base ? &base->doc : NULL);
    lang_unit_init(&lib->unit, arena, &lib->strings, base ? &base->unit : NULL);
    if (!base)
        return;
    lib->base_nodedefs = base->base_nodedefs + base->nodedefs.len;
    lib->base_impls = base->base_impls + base->impls.len;
    lib->base_families = base->base_families + base->families.len;
    lib->base_verbatims = base->base_verbatims + base->verbatims.len;
    lib->base_sources = base->base_sources + base->sources.len;
    lib->base_types = base->base_types + base->types.len;
    lib->base_geomprops = base->base_geomprops + base->geomprops.len;
    assert(lib->doc.root == base->doc.first_element + doc_num_elements(&base->doc));
    assert(lib->base_nodedefs == library_num_nodedefs(base));
}

void library_share(struct library *lib, const struct library *from)
{
    const struct document doc = lib->doc;
    const struct strpool strings = lib->strings;
    assert(strings.base == &from->strings && doc.first_element == from->doc.first_element);
    *lib = *from;
    lib->doc = doc;
    lib->strings = strings;
    lib->unit.strings = lib->doc.strings = &lib->strings;
}

const struct nodedef *library_nodedef(const struct library *lib, uint32_t id)
{
    while (id < lib->base_nodedefs)
        lib = lib->base;
    assert(id - lib->base_nodedefs < lib->nodedefs.len);
    return &lib->nodedefs.items[id - lib->base_nodedefs];
}

const struct implementation *library_impl(const struct library *lib, uint32_t id,
                                          const struct library **out_layer)
{
    while (id < lib->base_impls)
        lib = lib->base;
    if (out_layer)
        *out_layer = lib;
    assert(id - lib->base_impls < lib->impls.len);
    return &lib->impls.items[id - lib->base_impls];
}

const struct family *library_family(const struct library *lib, uint32_t id)
{
    while (id < lib->base_families)
        lib = lib->base;
    assert(id - lib->base_families < lib->families.len);
    return &lib->families.items[id - lib->base_families];
}

const struct verbatim *library_verbatim(const struct library *lib, uint32_t id,
                                        const struct library **out_layer)
{
    while (id < lib->base_verbatims)
        lib = lib->base;
    if (out_layer)
        *out_layer = lib;
    assert(id - lib->base_verbatims < lib->verbatims.len);
    return &lib->verbatims.items[id - lib->base_verbatims];
}

const struct source_file *library_source(const struct library *lib, uint32_t id,
                                         const struct library **out_layer)
{
    while (id < lib->base_sources)
        lib = lib->base;
    if (out_layer)
        *out_layer = lib;
    assert(id - lib->base_sources < lib->sources.len);
    return &lib->sources.items[id - lib->base_sources];
}

static void add_once(struct library_sources *out, uint32_t id, struct arena *arena)
{
    for (uint32_t i = 0; i < out->len; i++)
        if (out->items[i] == id)
            return;
    vec_push(arena, out, id);
}

void library_collect_sources(const struct library *lib, uint32_t file, struct arena *arena,
                             struct library_sources *out)
{
    uint32_t next = out->len;
    add_once(out, file, arena);
    for (; next < out->len; next++) {
        const struct library *layer;
        const struct source_file *source = library_source(lib, out->items[next], &layer);
        assert(source->first_include + source->num_includes <= layer->refs.len);
        for (uint32_t i = 0; i < source->num_includes; i++)
            add_once(out, layer->refs.items[source->first_include + i], arena);
    }
}

const struct library *library_of_element(const struct library *lib, elem_id element)
{
    while (element < lib->doc.first_element)
        lib = lib->base;
    assert(element - lib->doc.first_element < doc_num_elements(&lib->doc));
    return lib;
}

uint32_t library_element_info(const struct library *lib, elem_id element,
                              const struct library **out_layer)
{
    lib = library_of_element(lib, element);
    if (out_layer)
        *out_layer = lib;
    uint32_t own = element - lib->doc.first_element;
    assert(!lib->narrow_info || lib->element_info.len == 0);
    if (lib->narrow_info)
        return own < doc_num_elements(&lib->doc) ? (uint32_t)lib->narrow_info[own] - 1
                                                 : LIBRARY_NONE;
    return own < lib->element_info.len ? lib->element_info.items[own] - 1 : LIBRARY_NONE;
}

/* The index of a top-level element in its layer; LIBRARY_NONE: it does not exist or is invalid. */
static uint32_t own_index(const struct library *layer, enum element_kind kind, str_id name)
{
    elem_id element = name ? doc_child_of_kind(&layer->doc, layer->doc.root, kind, name) : 0;
    return element >= layer->doc.first_element && element
               ? library_element_info(layer, element, NULL)
               : LIBRARY_NONE;
}

const struct geomprop *library_geomprop(const struct library *lib, str_id name)
{
    uint32_t own = LIBRARY_NONE;
    for (; lib && (own = own_index(lib, KIND_GEOMPROPDEF, name)) == LIBRARY_NONE; lib = lib->base)
        continue;
    assert(!lib || own < lib->geomprops.len);
    return lib ? &lib->geomprops.items[own] : NULL;
}

uint32_t library_num_nodedefs(const struct library *lib)
{
    return lib->base_nodedefs + lib->nodedefs.len;
}

const struct port *library_ports(const struct library *lib, uint32_t nodedef,
                                 const struct library **out_layer)
{
    while (nodedef < lib->base_nodedefs)
        lib = lib->base;
    assert(nodedef - lib->base_nodedefs < lib->nodedefs.len);
    if (out_layer)
        *out_layer = lib;
    return lib->ports.items + lib->nodedefs.items[nodedef - lib->base_nodedefs].first_port;
}

static int find_port(const struct port *ports, int first, int end, str_id name)
{
    assert(first <= end);
    for (int i = first; i < end; i++)
        if (ports[i].name == name)
            return i - first;
    return -1;
}

int library_find_input(const struct library *lib, uint32_t nodedef, str_id name)
{
    return find_port(library_ports(lib, nodedef, NULL), 0,
                     library_nodedef(lib, nodedef)->num_inputs, name);
}

int library_find_output(const struct library *lib, uint32_t nodedef, str_id name)
{
    const struct nodedef *def = library_nodedef(lib, nodedef);
    return find_port(library_ports(lib, nodedef, NULL), def->num_inputs,
                     def->num_inputs + def->num_outputs, name);
}

uint32_t library_nodedef_by_name(const struct library *lib, str_id name)
{
    for (; lib; lib = lib->base) {
        elem_id element = doc_child(&lib->doc, lib->doc.root, name);
        if (!element || doc_element(&lib->doc, element)->kind != KIND_NODEDEF)
            continue;
        uint32_t own = library_element_info(lib, element, NULL);
        assert(own == LIBRARY_NONE || own < lib->nodedefs.len);
        if (own != LIBRARY_NONE)
            return library_of_element(lib, element)->base_nodedefs + own;
    }
    return LIBRARY_NONE;
}

static const struct user_type *user_type(const struct library *lib, doc_type type)
{
    uint32_t id = (uint32_t)type - DOC_TYPE_FIRST_USER;
    while (id < lib->base_types)
        lib = lib->base;
    assert(id - lib->base_types < lib->types.len);
    return &lib->types.items[id - lib->base_types];
}

doc_type library_type(const struct library *lib, str_id name)
{
    doc_type standard = doc_type_of(name);
    if (standard)
        return standard;
    uint32_t own = LIBRARY_NONE;
    for (; lib && (own = own_index(lib, KIND_TYPEDEF, name)) == LIBRARY_NONE; lib = lib->base)
        continue;
    assert(!lib || own < lib->types.len);
    return lib ? (doc_type)(DOC_TYPE_FIRST_USER + lib->base_types + own) : DOC_TYPE_NONE;
}

str_id library_type_name(const struct library *lib, doc_type type)
{
    return type >= DOC_TYPE_FIRST_USER ? user_type(lib, type)->name : doc_type_name(type);
}

elem_id library_typedef(const struct library *lib, doc_type type)
{
    assert(type >= DOC_TYPE_FIRST_USER);
    return user_type(lib, type)->element;
}

ir_type_id library_type_ir(const struct library *lib, doc_type type)
{
    return type >= DOC_TYPE_FIRST_USER ? user_type(lib, type)->ir : doc_type_ir(type);
}

void library_report_foreign(const struct library *lib, struct arena *scratch,
                            struct diag_list *diags)
{
    struct count {
        str_id target;
        unsigned num;
    };
    VEC(struct count) targets = {0};
    elem_id first = 0, last = 0;
    unsigned num = 0;
    for (uint32_t i = 0; i < lib->impls.len; i++) {
        const struct implementation *impl = &lib->impls.items[i];
        if (impl->kind != IMPL_FOREIGN)
            continue;
        uint32_t at = 0;
        while (at < targets.len && targets.items[at].target != impl->target)
            at++;
        if (at == targets.len)
            vec_push(scratch, &targets, (struct count){.target = impl->target});
        targets.items[at].num++;
        num += impl->element != last; /* one may be for several targets */
        first = first ? first : impl->element;
        last = impl->element;
    }
    struct text list;
    text_init(&list, scratch);
    for (uint32_t i = 0; i < targets.len; i++)
        text_fmt(&list, "%s%s (%u)", i ? ", " : "",
                 str_text(&lib->strings, targets.items[i].target), targets.items[i].num);
    if (num)
        diag_add(diags, DIAG_ID_foreign_implementations, doc_place(&lib->doc, first), num,
                 text_cstr(&list));
}
