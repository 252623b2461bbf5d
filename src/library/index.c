// SPDX-License-Identifier: Apache-2.0
/*
 * Fills a library layer from its document: types, definitions, geometric properties,
 * implementations.
 */
#include "library/library.h"

#include "base/hash.h"

#include <assert.h>

struct indexer {
    struct library *lib;
    struct arena *arena;
    const struct lang_reader *reader;
    struct diag_list *diags;
};

static const char *text_of(const struct library *lib, str_id id)
{
    return str_text(&lib->strings, id);
}

static str_id attr(const struct indexer *ix, elem_id element, str_id name)
{
    return doc_attr_value(&ix->lib->doc, element, name);
}

static bool has_type(struct indexer *ix, elem_id element, doc_type *out_type)
{
    str_id name = attr(ix, element, STR_type);
    *out_type = library_type(ix->lib, name);
    if (*out_type)
        return true;
    doc_report_type(&ix->lib->doc, element, ix->diags);
    return false;
}

/* Stores the index of an element in the table of its kind. */
static void set_info(struct indexer *ix, elem_id element, uint32_t own)
{
    assert(element - ix->lib->doc.first_element < ix->lib->element_info.len);
    assert(!ix->lib->element_info.items[element - ix->lib->doc.first_element]);
    ix->lib->element_info.items[element - ix->lib->doc.first_element] = own + 1;
}

/* ---- types ---- */

static ir_type_id struct_type(struct indexer *ix, elem_id element, str_id name)
{
    struct library *lib = ix->lib;
    uint32_t first = lib->unit.members.len;
    for (elem_id e = doc_element(&lib->doc, element)->first_child; e;
         e = doc_element(&lib->doc, e)->next) {
        doc_type type;
        if (doc_element(&lib->doc, e)->kind != KIND_MEMBER || !has_type(ix, e, &type))
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
                                .semantic = attr(ix, element, STR_semantic),
                                .ir = ir,
                                .element = element});
    set_info(ix, element, ix->lib->types.len - 1);
}

/* ---- definitions ---- */

static void add_port(struct indexer *ix, elem_id element, bool input)
{
    struct document *doc = &ix->lib->doc;
    struct port port = {.name = doc_element(doc, element)->name, .element = element};
    if (!has_type(ix, element, &port.type))
        return;
    const struct attribute *value = doc_attr(doc, element, input ? STR_value : STR_default);
    port.value = value ? value->value : 0;
    port.flags = (uint16_t)((value ? PORT_HAS_VALUE : 0)
                            | (doc_attr_is_true(doc, element, STR_uniform) ? PORT_UNIFORM : 0)
                            | (attr(ix, element, STR_enum) ? PORT_ENUM : 0));
    port.geomprop = attr(ix, element, input ? STR_defaultgeomprop : STR_defaultinput);
    vec_push(ix->arena, &ix->lib->ports, port);
}

static bool port_exists(const struct library *lib, uint32_t first, str_id name)
{
    for (uint32_t i = first; i < lib->ports.len; i++)
        if (lib->ports.items[i].name == name)
            return true;
    return false;
}

enum { MAX_PORTS = 1024 }; /* of the inputs of a definition, because lookups are linear */

static void add_ports_of(struct indexer *ix, elem_id nodedef, enum element_kind kind,
                         uint32_t first)
{
    struct library *lib = ix->lib;
    uint32_t max_ports = kind == KIND_INPUT ? MAX_PORTS : LIBRARY_MAX_OUTPUTS;
    assert(lib->ports.len - first <= max_ports);
    for (elem_id e = doc_element(&lib->doc, nodedef)->first_child; e;
         e = doc_element(&lib->doc, e)->next) {
        if (doc_element(&lib->doc, e)->kind != kind
            || port_exists(lib, first, doc_element(&lib->doc, e)->name))
            continue;
        if (lib->ports.len - first == max_ports) {
            diag_add(ix->diags, DIAG_ID_too_many_ports, doc_place(&lib->doc, e),
                     text_of(lib, doc_element(&lib->doc, nodedef)->name), (unsigned)max_ports);
            return;
        }
        add_port(ix, e, kind == KIND_INPUT);
    }
}

enum { MAX_INHERIT = 256 };

/*
 * Adds own ports first, then inherited ports without a redeclaration (specification, "NodeDef
 * Inheritance").
 */
static uint16_t add_ports(struct indexer *ix, elem_id nodedef, enum element_kind kind)
{
    struct library *lib = ix->lib;
    uint32_t first = lib->ports.len;
    elem_id at = nodedef, mark = nodedef; /* Brent: a cycle comes back to one of the marks */
    for (unsigned depth = 1; at; depth++) {
        add_ports_of(ix, at, kind, first);
        str_id inherit = attr(ix, at, STR_inherit);
        if (!inherit)
            break;
        elem_id parent = 0;
        for (const struct library *layer = lib; !parent && layer; layer = layer->base)
            parent = doc_child_of_kind(&layer->doc, layer->doc.root, KIND_NODEDEF, inherit);
        if (parent == mark || depth == MAX_INHERIT || !parent) {
            diag_add(ix->diags,
                     !parent          ? DIAG_ID_inherit_missing
                     : parent == mark ? DIAG_ID_inherit_cycle
                                      : DIAG_ID_inherit_depth,
                     doc_attr_place(&lib->doc, at, STR_inherit),
                     text_of(lib, doc_element(&lib->doc, at)->name), text_of(lib, inherit));
            break;
        }
        at = parent;
        if ((depth & (depth - 1)) == 0)
            mark = at;
    }
    return (uint16_t)(lib->ports.len - first);
}

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

/* From the last, so that the first of a node leads. */
static void make_node_table(struct indexer *ix)
{
    for (uint32_t i = ix->lib->nodedefs.len; i-- > 0;)
        link_by_node(ix, i);
}

static void add_nodedef(struct indexer *ix, elem_id element)
{
    struct library *lib = ix->lib;
    struct nodedef def = {
        .name = doc_element(&lib->doc, element)->name,
        .node = attr(ix, element, STR_node),
        .version = attr(ix, element, STR_version),
        .target = attr(ix, element, STR_target),
        .is_default_version = doc_attr_is_true(&lib->doc, element, STR_isdefaultversion),
        .element = element,
        .first_port = lib->ports.len,
        .first_impl = LIBRARY_NONE,
        .next_same_node = LIBRARY_NONE,
    };
    if (!def.node && (def.node = attr(ix, element, STR_nodename)) != 0)
        diag_add(ix->diags, DIAG_ID_nodedef_nodename,
                 doc_attr_place(&lib->doc, element, STR_nodename));
    if (!def.node)
        return; /* nodedefs without a node, for example of options */
    def.num_inputs = add_ports(ix, element, KIND_INPUT);
    uint32_t before = lib->ports.len;
    add_ports(ix, element, KIND_OUTPUT);
    def.num_outputs = (uint16_t)(lib->ports.len - before);
    assert(def.first_port + def.num_inputs + def.num_outputs == lib->ports.len);
    vec_push(ix->arena, &lib->nodedefs, def);
    set_info(ix, element, lib->nodedefs.len - 1);
}

/* ---- geometric properties ---- */

static uint32_t default_nodedef(const struct library *lib, str_id node, doc_type type)
{
    enum { MAX_TRIED = 1024 }; /* standard nodes have few definitions */
    uint32_t tried = 0;
    for (; lib; lib = lib->base)
        for (uint32_t i = library_first_of_node(lib, node); i != LIBRARY_NONE && tried < MAX_TRIED;
             i = lib->nodedefs.items[i].next_same_node, tried++) {
            const struct nodedef *def = &lib->nodedefs.items[i];
            if (def->num_outputs
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
        .geomprop = attr(ix, element, STR_geomprop),
        .space = attr(ix, element, STR_space),
        .element = element,
        .nodedef = LIBRARY_NONE,
    };
    if (!has_type(ix, element, &prop.type))
        return;
    str_id index = attr(ix, element, STR_index);
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

/* ---- implementations ---- */

static bool is_closure(doc_type type)
{
    return type == DOC_TYPE_BSDF || type == DOC_TYPE_EDF || type == DOC_TYPE_VDF;
}

static uint32_t input_types(const struct indexer *ix, uint32_t nodedef, struct lang_input *out,
                            uint32_t max)
{
    const struct nodedef *def = library_nodedef(ix->lib, nodedef);
    assert(def->num_inputs <= max);
    const struct port *ports = library_ports(ix->lib, nodedef, NULL);
    uint32_t n = def->num_inputs < max ? def->num_inputs : max;
    for (uint32_t i = 0; i < n; i++)
        out[i] = (struct lang_input){ports[i].name, library_type_ir(ix->lib, ports[i].type)};
    return n;
}

static uint32_t parse_expression(struct indexer *ix, uint32_t nodedef, unsigned output,
                                 str_id source, uint32_t file, struct diag_place where,
                                 struct diag_list *diags)
{
    struct lang_input inputs[MAX_PORTS];
    uint32_t n = input_types(ix, nodedef, inputs, MAX_PORTS);
    const struct nodedef *def = library_nodedef(ix->lib, nodedef);
    assert(output < def->num_outputs);
    const struct port *out = library_ports(ix->lib, nodedef, NULL) + def->num_inputs + output;
    return lang_parse_expression(&ix->lib->unit, text_of(ix->lib, source),
                                 str_len(&ix->lib->strings, source), inputs, n,
                                 library_type_ir(ix->lib, out->type), file, where, diags);
}

static bool ends_with(const char *text, const char *end)
{
    size_t n = strlen(text), m = strlen(end);
    return n >= m && strcmp(text + n - m, end) == 0;
}

/* The text of a source file, interned; 0 after a diagnostic. */
static str_id read_source(struct indexer *ix, elem_id element, str_id file, const char *from,
                          struct diag_list *diags)
{
    const char *name, *text, *reason = "the context cannot read files";
    size_t len;
    if (!ix->reader
        || !ix->reader->read(ix->reader->user_data, from, text_of(ix->lib, file), &name, &text,
                             &len, &reason)) {
        diag_add(diags, DIAG_ID_missing_source_file,
                 doc_attr_place(&ix->lib->doc, element, STR_file), text_of(ix->lib, file),
                 text_of(ix->lib, doc_element(&ix->lib->doc, element)->name), reason);
        return 0;
    }
    return str_intern(&ix->lib->strings, text, len);
}

static const char *file_of(const struct indexer *ix, elem_id element)
{
    const char *name = doc_place(&ix->lib->doc, element).file;
    return name ? name : "";
}

/* Parses one inline expression per output: of the <implementation>, or of its <output> children. */
static bool parse_expressions(struct indexer *ix, struct implementation *impl, str_id source,
                              uint32_t file, struct diag_list *diags)
{
    const struct document *doc = &ix->lib->doc;
    const struct nodedef *def = library_nodedef(ix->lib, impl->nodedef);
    const struct port *outputs = library_ports(ix->lib, impl->nodedef, NULL) + def->num_inputs;
    uint32_t ids[MAX_PORTS];
    for (unsigned i = 0; i < def->num_outputs; i++) {
        elem_id child = doc_child_of_kind(doc, impl->element, KIND_OUTPUT, outputs[i].name);
        str_id own = child ? doc_attr_value(doc, child, STR_sourcecode) : 0;
        struct diag_place where = doc_attr_place(doc, own ? child : impl->element, STR_sourcecode);
        if (!own && (def->num_outputs > 1 || !source)) {
            diag_add(diags, DIAG_ID_function_signature, where, "sourcecode",
                     text_of(ix->lib, def->name),
                     "each output needs an <output> child with sourcecode");
            return false;
        }
        ids[i] = parse_expression(ix, impl->nodedef, i, own ? own : source, file, where, diags);
        if (ids[i] == LANG_NONE)
            return false;
    }
    impl->kind = IMPL_EXPRESSION;
    impl->ref = ix->lib->refs.len;
    impl->count = def->num_outputs;
    for (unsigned i = 0; i < def->num_outputs; i++)
        vec_push(ix->arena, &ix->lib->refs, ids[i]);
    assert(impl->ref + impl->count == ix->lib->refs.len);
    return true;
}

static const char *const family_suffixes[NUM_FAMILY_MEMBERS] = {
    [FAMILY_EVAL] = "_eval",
    [FAMILY_ENVIRONMENT] = "_environment",
    [FAMILY_TRANSMISSION] = "_transmission",
    [FAMILY_THROUGHPUT] = "_throughput",
    [FAMILY_EMISSION] = "_emission",
    [FAMILY_FACTOR] = "_factor",
    [FAMILY_ABSORPTION] = "_absorption",
    [FAMILY_ALBEDO] = "_albedo",
    [FAMILY_REFRACTION] = "_refraction",
    [FAMILY_SAMPLE] = "_sample",
    [FAMILY_PDF] = "_pdf",
    [FAMILY_SCATTERING] = "_scattering",
    [FAMILY_ANISOTROPY] = "_anisotropy",
};

static bool find_family(struct indexer *ix, struct implementation *impl, str_id name, uint32_t file)
{
    struct family family = {.name = name, .nodedef = impl->nodedef};
    bool any = false;
    for (unsigned i = 0; i < NUM_FAMILY_MEMBERS; i++) {
        char full[256];
        size_t len = str_len(&ix->lib->strings, name), suffix = strlen(family_suffixes[i]);
        family.functions[i] = LANG_NONE;
        if (len + suffix >= sizeof full)
            continue;
        memcpy(full, text_of(ix->lib, name), len);
        memcpy(full + len, family_suffixes[i], suffix);
        str_id id = str_find(&ix->lib->strings, full, len + suffix);
        if (id)
            family.functions[i] = lang_find_function(&ix->lib->unit, file, id, NULL, 0);
        any = any || family.functions[i] != LANG_NONE;
    }
    impl->kind = IMPL_FAMILY;
    impl->ref = ix->lib->base_families + ix->lib->families.len;
    vec_push(ix->arena, &ix->lib->families, family);
    return any;
}

static const char *check_signature(const struct indexer *ix, const struct implementation *impl,
                                   uint32_t function)
{
    const struct lang_unit *unit;
    const struct lang_function *fn = lang_function(&ix->lib->unit, function, &unit);
    const struct nodedef *def = library_nodedef(ix->lib, impl->nodedef);
    const struct port *ports = library_ports(ix->lib, impl->nodedef, NULL);
    uint32_t outs = fn->return_type == IR_TYPE_VOID ? def->num_outputs : 0u;
    if (library_type_ir(ix->lib, ports[def->num_inputs].type) == IR_TYPE_LIGHT)
        return NULL; /* lights have a different signature, see library.md */
    if (fn->num_params != def->num_inputs + outs)
        return "it needs one parameter per input, then one `out` parameter per output (or a return "
               "value)";
    if (fn->return_type != IR_TYPE_VOID && def->num_outputs != 1)
        return "it returns a value, but the node has several outputs";
    assert(fn->first_slot + fn->num_params <= unit->slots.len);
    for (uint32_t i = 0; i < fn->num_params; i++) {
        const struct lang_slot *slot = &unit->slots.items[fn->first_slot + i];
        bool out = i >= def->num_inputs;
        if (slot->type != library_type_ir(ix->lib, ports[i].type))
            return "a parameter differs in type from its input or output";
        if ((slot->mode != LANG_IN) != out)
            return "inputs need `in` parameters, and outputs need `out` parameters";
    }
    return NULL;
}

static bool find_implementation_function(struct indexer *ix, struct implementation *impl,
                                         str_id name, uint32_t file, struct diag_list *diags)
{
    const struct library *lib = ix->lib;
    const struct nodedef *def = library_nodedef(lib, impl->nodedef);
    assert(def->num_outputs > 0);
    const struct port *ports = library_ports(lib, impl->nodedef, NULL);
    struct diag_place where = doc_attr_place(&lib->doc, impl->element, STR_function);
    if (is_closure(ports[def->num_inputs].type)) {
        if (find_family(ix, impl, name, file))
            return true;
        diag_add(diags, DIAG_ID_missing_function, where, text_of(lib, name),
                 " with a suffix of a closure family, for example '_eval'");
        return false;
    }
    struct lang_input inputs[MAX_PORTS];
    ir_type_id types[2 * MAX_PORTS];
    uint32_t n = input_types(ix, impl->nodedef, inputs, MAX_PORTS);
    for (uint32_t i = 0; i < n; i++)
        types[i] = inputs[i].type;
    uint32_t function = lang_find_function(&ix->lib->unit, file, name, types, n);
    for (uint32_t i = n; function == LANG_NONE && i < n + def->num_outputs; i++) {
        types[i] = library_type_ir(lib, ports[i].type);
        function = lang_find_function(&ix->lib->unit, file, name, types, i + 1);
    }
    if (function == LANG_NONE)
        function = lang_find_function(&ix->lib->unit, file, name, NULL, 0);
    if (function == LANG_NONE) {
        diag_add(diags, DIAG_ID_missing_function, where, text_of(lib, name), "");
        return false;
    }
    const char *fault = check_signature(ix, impl, function);
    if (fault) {
        diag_add(diags, DIAG_ID_function_signature, where, text_of(lib, name),
                 text_of(lib, def->name), fault);
        return false;
    }
    impl->kind = IMPL_FUNCTION;
    impl->ref = function;
    return true;
}

static bool parse_source(struct indexer *ix, struct implementation *impl, struct diag_list *diags)
{
    elem_id element = impl->element;
    str_id file_name = attr(ix, element, STR_file), function = attr(ix, element, STR_function);
    str_id source = attr(ix, element, STR_sourcecode);
    uint32_t file = LANG_NONE;
    const char *from = file_of(ix, element);
    if (file_name && ends_with(text_of(ix->lib, file_name), ".inline")) {
        source = read_source(ix, element, file_name, from, diags);
        if (!source)
            return false;
    } else if (file_name) {
        if (!ix->reader)
            return read_source(ix, element, file_name, from, diags) != 0;
        file = lang_parse_file(&ix->lib->unit, ix->reader, from, text_of(ix->lib, file_name),
                               doc_attr_place(&ix->lib->doc, element, STR_file), diags);
        if (file == LANG_NONE)
            return false;
    }
    if (function)
        return find_implementation_function(ix, impl, function, file, diags);
    return parse_expressions(ix, impl, source, file, diags);
}

static void refuse_source(struct indexer *ix, const struct implementation *impl, const char *reason,
                          struct diag_list *diags)
{
    diag_add(diags, DIAG_ID_untrusted_source, doc_place(&ix->lib->doc, impl->element),
             text_of(ix->lib, impl->name), reason);
}

/* Source for a target that does not parse stays verbatim; a portable implementation must parse. */
static void parse_implementation(struct indexer *ix, struct implementation *impl)
{
    struct diag_list faults;
    diag_list_init(&faults, ix->arena);
    if (ix->lib->trust == LIBRARY_TRUST_GRAPHS)
        refuse_source(ix, impl, "a sandbox allows no source", &faults);
    else if (impl->target && ix->lib->trust == LIBRARY_TRUST_PORTABLE)
        refuse_source(ix, impl, "it is for one target only", &faults);
    else if (parse_source(ix, impl, &faults))
        return;
    str_id file_name = attr(ix, impl->element, STR_file);
    if (impl->target && ix->lib->trust == LIBRARY_TRUST_ALL) {
        struct diag_list unread;
        diag_list_init(&unread, ix->arena);
        str_id source = file_name ? read_source(ix, impl->element, file_name,
                                                file_of(ix, impl->element), &unread)
                                  : attr(ix, impl->element, STR_sourcecode);
        if (source) {
            impl->kind = IMPL_VERBATIM;
            impl->ref = ix->lib->base_verbatims + ix->lib->verbatims.len;
            vec_push(ix->arena, &ix->lib->verbatims,
                     (struct verbatim){
                         source, file_name && !ends_with(text_of(ix->lib, file_name), ".inline")
                                     ? attr(ix, impl->element, STR_function)
                                     : 0});
            return;
        }
    }
    impl->kind = IMPL_BROKEN;
    impl->ref = ix->lib->deferred->items.len;
    impl->count = faults.items.len;
    for (uint32_t i = 0; i < faults.items.len; i++)
        vec_push(ix->arena, &ix->lib->deferred->items, faults.items.items[i]);
}

static void add_impl(struct indexer *ix, struct implementation impl)
{
    struct library *lib = ix->lib;
    if (impl.nodedef < lib->base_nodedefs)
        vec_push(ix->arena, &lib->overrides, lib->impls.len);
    vec_push(ix->arena, &lib->impls, impl);
}

/* Backwards, so that the first implementation of a definition becomes the head. */
static void link_implementations(struct library *lib)
{
    for (uint32_t i = lib->impls.len; i-- > 0;) {
        struct implementation *impl = &lib->impls.items[i];
        impl->next = LIBRARY_NONE;
        if (impl->nodedef < lib->base_nodedefs)
            continue;
        uint32_t *first = &lib->nodedefs.items[impl->nodedef - lib->base_nodedefs].first_impl;
        impl->next = *first;
        *first = lib->base_impls + i;
    }
}

static elem_id find_nodegraph(const struct library *lib, str_id name)
{
    elem_id found = 0;
    for (; lib && !found; lib = lib->base)
        found = doc_child_of_kind(&lib->doc, lib->doc.root, KIND_NODEGRAPH, name);
    return found;
}

static void add_implementation(struct indexer *ix, elem_id element)
{
    struct library *lib = ix->lib;
    const struct element *e = doc_element(&lib->doc, element);
    struct implementation impl = {
        .name = e->name, .target = attr(ix, element, STR_target), .element = element};
    str_id nodedef = attr(ix, element, STR_nodedef);
    if (!nodedef)
        return; /* validation reports the missing nodedef */
    impl.nodedef = library_nodedef_by_name(lib, nodedef);
    if (impl.nodedef == LIBRARY_NONE) {
        diag_add(ix->diags, DIAG_ID_implementation_unknown_nodedef,
                 doc_attr_place(&lib->doc, element, STR_nodedef), text_of(lib, e->name),
                 text_of(lib, nodedef));
        return;
    }
    if (!library_is_unique(lib, library_nodedef(lib, impl.nodedef)->element, element, STR_nodedef,
                           ix->diags))
        return;
    if (!library_nodedef(lib, impl.nodedef)->num_outputs)
        return; /* reported as no-output or unknown-type */
    str_id graph = attr(ix, element, STR_nodegraph);
    bool outputs = false;
    for (elem_id c = e->first_child; c; c = doc_element(&lib->doc, c)->next)
        outputs = outputs || doc_attr(&lib->doc, c, STR_sourcecode);
    if (graph) {
        impl.kind = IMPL_GRAPH;
        impl.ref = find_nodegraph(lib, graph);
        if (!impl.ref)
            diag_add(ix->diags, DIAG_ID_dangling_nodegraph,
                     doc_attr_place(&lib->doc, element, STR_nodegraph), text_of(lib, graph), "");
        if (!impl.ref)
            return;
    } else if (attr(ix, element, STR_file) || attr(ix, element, STR_sourcecode) || outputs) {
        parse_implementation(ix, &impl);
    } else {
        impl.kind = IMPL_DYNAMIC;
        impl.ref = attr(ix, element, STR_function);
    }
    add_impl(ix, impl);
}

static void add_functional_graph(struct indexer *ix, elem_id element)
{
    struct library *lib = ix->lib;
    str_id name = attr(ix, element, STR_nodedef);
    if (!name)
        return;
    struct implementation impl = {.name = doc_element(&lib->doc, element)->name,
                                  .target = attr(ix, element, STR_target),
                                  .element = element,
                                  .kind = IMPL_GRAPH,
                                  .ref = element};
    impl.nodedef = library_nodedef_by_name(lib, name);
    if (impl.nodedef == LIBRARY_NONE) {
        library_report_nodedef(lib, element, name, ix->diags);
        return;
    }
    if (!library_is_unique(lib, library_nodedef(lib, impl.nodedef)->element, element, STR_nodedef,
                           ix->diags))
        return;
    add_impl(ix, impl);
}

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
    uint32_t *info = vec_extend(ix.arena, &lib->element_info, lib->doc.elements.len);
    memset(info, 0, lib->doc.elements.len * sizeof *info);
    for_each(&ix, KIND_TYPEDEF, add_typedef);
    for_each(&ix, KIND_NODEDEF, add_nodedef);
    make_node_table(&ix);
    for_each(&ix, KIND_GEOMPROPDEF, add_geomprop);
    for_each(&ix, KIND_IMPLEMENTATION, add_implementation);
    for_each(&ix, KIND_NODEGRAPH, add_functional_graph);
    link_implementations(lib);
    for_each(&ix, KIND_UNITDEF, add_unitdef);
    library_sort_units(lib);
    assert(lib->element_info.len == lib->doc.elements.len);
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
        struct graph_node node = library_resolve_node(lib, e, out, diags);
        assert(node.first_binding == first);
        number_interface(lib, impl->nodedef, out->bindings.items + first,
                         out->bindings.len - first);
        assert(lib->graph_nodes.len < lib->doc.elements.len);
        vec_push(out->arena, &lib->graph_nodes, node);
        lib->element_info.items[e - lib->doc.first_element] = lib->graph_nodes.len;
    }
}

void library_resolve_graphs(struct library *lib, struct diag_list *diags)
{
    struct resolve_out out = {.arena = lib->doc.arena};
    for (uint32_t i = 0; i < lib->impls.len; i++)
        if (lib->impls.items[i].kind == IMPL_GRAPH
            && lib->impls.items[i].ref >= lib->doc.first_element)
            resolve_graph(lib, &lib->impls.items[i], &out, diags);
    lib->bindings.items = out.bindings.items;
    lib->bindings.len = out.bindings.len;
}
