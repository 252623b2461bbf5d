// SPDX-License-Identifier: Apache-2.0
/* Implementations: from their elements to parsed functions and expressions. */
#include "library/index_priv.h"

#include "base/hash.h"

#include <assert.h>

static bool is_closure(doc_type type)
{
    return type == DOC_TYPE_BSDF || type == DOC_TYPE_EDF || type == DOC_TYPE_VDF;
}

static uint32_t input_types(const struct indexer *ix, const struct implementation *impl,
                            struct lang_input *out, uint32_t max)
{
    const struct nodedef *def = library_nodedef(ix->lib, impl->nodedef);
    assert(def->num_inputs <= max);
    const struct port *ports = library_ports(ix->lib, impl->nodedef, NULL);
    uint32_t n = def->num_inputs < max ? def->num_inputs : max;
    for (uint32_t i = 0; i < n; i++)
        out[i] = (struct lang_input){
            ports[i].name,
            library_type_ir(ix->lib, library_source_type(ix->lib, impl->element, &ports[i]))};
    return n;
}

static uint32_t parse_expression(struct indexer *ix, const struct implementation *impl,
                                 unsigned output, str_id source, uint32_t file,
                                 struct diag_place where, struct diag_list *diags)
{
    struct lang_input inputs[INDEX_MAX_PORTS];
    uint32_t n = input_types(ix, impl, inputs, INDEX_MAX_PORTS);
    const struct nodedef *def = library_nodedef(ix->lib, impl->nodedef);
    assert(output < def->num_outputs);
    const struct port *out = library_ports(ix->lib, impl->nodedef, NULL) + def->num_inputs + output;
    return lang_parse_expression(&ix->lib->unit, index_text(ix, source),
                                 str_len(&ix->lib->strings, source), inputs, n,
                                 library_type_ir(ix->lib, out->type), file, where, diags);
}

bool index_parse_expressions(struct indexer *ix, struct implementation *impl, str_id source,
                             uint32_t file, struct diag_list *diags)
{
    const struct document *doc = &ix->lib->doc;
    const struct nodedef *def = library_nodedef(ix->lib, impl->nodedef);
    const struct port *outputs = library_ports(ix->lib, impl->nodedef, NULL) + def->num_inputs;
    uint32_t ids[INDEX_MAX_PORTS];
    for (unsigned i = 0; i < def->num_outputs; i++) {
        elem_id child = doc_child_of_kind(doc, impl->element, KIND_OUTPUT, outputs[i].name);
        str_id own = child ? doc_attr_value(doc, child, STR_sourcecode) : 0;
        struct diag_place where = doc_attr_place(doc, own ? child : impl->element, STR_sourcecode);
        if (!own && (def->num_outputs > 1 || !source)) {
            diag_add(diags, DIAG_ID_function_signature, where, "sourcecode",
                     index_text(ix, def->name),
                     "each output needs an <output> child with sourcecode");
            return false;
        }
        ids[i] = parse_expression(ix, impl, i, own ? own : source, file, where, diags);
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

/*
 * The functions of a closure: the end of the name, and what such a function computes, for the
 * reader of a shader, where the library has no comment of its own.
 */
static const struct {
    const char *suffix, *doc;
} family_members[NUM_FAMILY_MEMBERS] = {
    [FAMILY_EVAL] = {"_eval",
                     "The light from L that the closure reflects to V, without its weight."},
    [FAMILY_ENVIRONMENT] = {"_environment",
                            "The light of the environment that the closure reflects to V. Its "
                            "samples, by `sample_index`, add up to it."},
    [FAMILY_TRANSMISSION] =
        {"_transmission",
         "The light of the environment behind that the closure lets through to V."},
    [FAMILY_THROUGHPUT] = {"_throughput",
                           "The part of the light that reaches what lies below the closure."},
    [FAMILY_EMISSION] = {"_emission", "The light that the closure emits to V."},
    [FAMILY_FACTOR] = {"_factor", "The factor by which the closure changes its base."},
    [FAMILY_ABSORPTION] = {"_absorption", "The coefficient of absorption of the medium."},
    [FAMILY_ALBEDO] = {"_albedo", "The directional albedo of the closure towards V."},
    [FAMILY_REFRACTION] =
        {"_refraction", "The light from L behind the surface that the closure lets through to V."},
    [FAMILY_SAMPLE] = {"_sample", "A direction L by three random numbers xi; `weight` is the value "
                                  "of the closure there over the density `pdf`."},
    [FAMILY_PDF] = {"_pdf", "The density of L among the samples of the closure, in solid angle."},
    [FAMILY_TRANSMITTANCE] = {"_transmittance",
                              "The factor of light that goes straight through the medium once."},
    [FAMILY_WAY] = {"_way",
                    "The mean way, through media above, of the light that the closure reflects."},
    [FAMILY_TINT] = {"_tint", "The factor of the closure that stands for the leaf."},
    [FAMILY_FACET] =
        {"_facet",
         "The normal of the closure that stands for the leaf, and its share of the roughness."},
    [FAMILY_SCATTERING] = {"_scattering", "The coefficient of scattering of the medium."},
    [FAMILY_ANISOTROPY] = {"_anisotropy", "The anisotropy of the phase function of the medium."},
};

/* Finds a member of a family by its name, and gives it a comment if it has none. */
static uint32_t find_member(struct indexer *ix, uint32_t file, str_id name, unsigned member)
{
    struct lang_unit *unit = &ix->lib->unit;
    uint32_t id = lang_find_function(unit, file, name, NULL, 0);
    if (id == LANG_NONE || id < unit->base_functions)
        return id;
    struct lang_function *function = &unit->functions.items[id - unit->base_functions];
    if (!function->doc)
        function->doc = str_intern_z(&ix->lib->strings, family_members[member].doc);
    return id;
}

static bool find_family(struct indexer *ix, struct implementation *impl, str_id name, uint32_t file)
{
    struct family family = {.name = name, .nodedef = impl->nodedef};
    bool any = false;
    for (unsigned i = 0; i < NUM_FAMILY_MEMBERS; i++) {
        char full[256];
        size_t len = str_len(&ix->lib->strings, name), suffix = strlen(family_members[i].suffix);
        family.functions[i] = LANG_NONE;
        if (len + suffix >= sizeof full)
            continue;
        memcpy(full, index_text(ix, name), len);
        memcpy(full + len, family_members[i].suffix, suffix);
        str_id id = str_find(&ix->lib->strings, full, len + suffix);
        if (id)
            family.functions[i] = find_member(ix, file, id, i);
        any = any || family.functions[i] != LANG_NONE;
    }
    impl->kind = IMPL_FAMILY;
    impl->ref = ix->lib->base_families + ix->lib->families.len;
    vec_push(ix->arena, &ix->lib->families, family);
    return any;
}

/* The extra inputs that a function for one target takes after the inputs of its node. */
static uint32_t find_extra(const struct indexer *ix, const struct implementation *impl,
                           uint32_t function)
{
    const struct lang_unit *unit;
    const struct lang_function *fn = lang_function(&ix->lib->unit, function, &unit);
    uint32_t next = library_nodedef(ix->lib, impl->nodedef)->num_inputs, extra = 0;
    for (uint32_t i = 0; i < LIBRARY_NUM_EXTRA_INPUTS && impl->target; i++) {
        if (next >= fn->num_params)
            break;
        const struct lang_slot *slot = &unit->slots.items[fn->first_slot + next];
        if (slot->mode != LANG_IN || slot->type != library_extra_inputs[i].type
            || strcmp(index_text(ix, slot->name), library_extra_inputs[i].name) != 0)
            continue;
        extra |= 1u << i;
        next++;
    }
    return extra;
}

static uint32_t count_extra(uint32_t extra)
{
    uint32_t n = 0;
    for (; extra; extra &= extra - 1)
        n++;
    return n;
}

/* NULL, or the fault of a function's parameters. Keeps its extra inputs. */
static const char *check_signature(const struct indexer *ix, struct implementation *impl,
                                   uint32_t function)
{
    const struct lang_unit *unit;
    const struct lang_function *fn = lang_function(&ix->lib->unit, function, &unit);
    const struct nodedef *def = library_nodedef(ix->lib, impl->nodedef);
    const struct port *ports = library_ports(ix->lib, impl->nodedef, NULL);
    uint32_t outs = fn->return_type == IR_TYPE_VOID ? def->num_outputs : 0u;
    if (library_type_ir(ix->lib, ports[def->num_inputs].type) == IR_TYPE_LIGHT)
        return NULL; /* lights have a different signature, see library.md */
    uint32_t extra = find_extra(ix, impl, function);
    uint32_t inputs = def->num_inputs + count_extra(extra);
    if (fn->num_params != inputs + outs)
        return "it needs one parameter per input, then one `out` parameter per output (or a return "
               "value)";
    if (fn->return_type != IR_TYPE_VOID && def->num_outputs != 1)
        return "it returns a value, but the node has several outputs";
    assert(fn->first_slot + fn->num_params <= unit->slots.len);
    for (uint32_t i = 0; i < fn->num_params; i++) {
        const struct lang_slot *slot = &unit->slots.items[fn->first_slot + i];
        bool out = i >= inputs, is_extra = i >= def->num_inputs && !out;
        if ((slot->mode != LANG_IN) != out)
            return "inputs need `in` parameters, and outputs need `out` parameters";
        if (is_extra)
            continue;
        const struct port *port = &ports[out ? i - count_extra(extra) : i];
        ir_type_id type = library_type_ir(
            ix->lib, out ? port->type : library_source_type(ix->lib, impl->element, port));
        bool is_word = impl->target && type == IR_TYPE_STRING && slot->type == IR_TYPE_INT;
        if (slot->type != type && !is_word)
            return "a parameter differs in type from its input or output";
    }
    impl->count = extra;
    return NULL;
}

bool index_find_function(struct indexer *ix, struct implementation *impl, str_id name,
                         uint32_t file, struct diag_list *diags)
{
    const struct library *lib = ix->lib;
    const struct nodedef *def = library_nodedef(lib, impl->nodedef);
    assert(def->num_outputs > 0);
    const struct port *ports = library_ports(lib, impl->nodedef, NULL);
    struct diag_place where = doc_attr_place(&lib->doc, impl->element, STR_function);
    if (is_closure(ports[def->num_inputs].type)) {
        if (find_family(ix, impl, name, file))
            return true;
        diag_add(diags, DIAG_ID_missing_function, where, str_text(&lib->strings, name),
                 " with a suffix of a closure family, for example '_eval'");
        return false;
    }
    struct lang_input inputs[INDEX_MAX_PORTS];
    ir_type_id types[2 * INDEX_MAX_PORTS];
    uint32_t n = input_types(ix, impl, inputs, INDEX_MAX_PORTS);
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
        diag_add(diags, DIAG_ID_missing_function, where, str_text(&lib->strings, name), "");
        return false;
    }
    const char *fault = check_signature(ix, impl, function);
    if (fault) {
        diag_add(diags, DIAG_ID_function_signature, where, str_text(&lib->strings, name),
                 str_text(&lib->strings, def->name), fault);
        return false;
    }
    impl->kind = IMPL_FUNCTION;
    impl->ref = function;
    return true;
}

static bool parse_source(struct indexer *ix, struct implementation *impl, struct diag_list *diags)
{
    elem_id element = impl->element;
    str_id file_name = index_attr(ix, element, STR_file),
           function = index_attr(ix, element, STR_function);
    str_id source = index_attr(ix, element, STR_sourcecode);
    uint32_t file = LANG_NONE;
    const char *from = index_file(ix, element);
    if (file_name && index_is_inline(ix, file_name)) {
        source = index_read_source(ix, element, file_name, diags);
        if (!source)
            return false;
    } else if (file_name) {
        if (!ix->reader)
            return index_read_source(ix, element, file_name, diags) != 0;
        struct diag_place where = doc_attr_place(&ix->lib->doc, element, STR_file);
        const char *ref = index_text(ix, file_name);
        file = index_has_prelude(ix, impl)
                   ? index_parse_with_prelude(ix, from, ref, where, diags)
                   : lang_parse_file(&ix->lib->unit, ix->reader, from, ref, where, diags);
        if (file == LANG_NONE)
            return false;
    }
    if (function)
        return index_find_function(ix, impl, function, file, diags);
    if (source && impl->target)
        source = index_expression(ix, source);
    if (file == LANG_NONE && index_has_prelude(ix, impl))
        file = index_parse_with_prelude(ix, "", NULL, doc_place(&ix->lib->doc, element), diags);
    return index_parse_expressions(ix, impl, source, file, diags);
}

static void refuse_source(struct indexer *ix, const struct implementation *impl, const char *reason,
                          struct diag_list *diags)
{
    diag_add(diags, DIAG_ID_untrusted_source, doc_place(&ix->lib->doc, impl->element),
             index_text(ix, impl->name), reason);
}

void index_break(struct library *lib, struct implementation *impl, const struct diag_list *faults)
{
    impl->kind = IMPL_BROKEN;
    impl->ref = lib->deferred->items.len;
    impl->count = faults->items.len;
    for (uint32_t i = 0; i < faults->items.len; i++)
        vec_push(lib->doc.arena, &lib->deferred->items, faults->items.items[i]);
}

/*
 * Source for a target that is not portable stays verbatim, if it is trusted; an implementation
 * without a target must be portable.
 */
static void parse_implementation(struct indexer *ix, struct implementation *impl)
{
    struct diag_list faults, unfit;
    diag_list_init(&faults, ix->arena);
    diag_list_init(&unfit, ix->arena);
    enum library_trust trust = ix->lib->trust;
    if (trust != LIBRARY_TRUST_GRAPHS && parse_source(ix, impl, &faults))
        return;
    if (trust == LIBRARY_TRUST_ALL && impl->target && index_verbatim(ix, impl, &faults, &unfit))
        return;
    if (trust == LIBRARY_TRUST_GRAPHS)
        refuse_source(ix, impl, "a sandbox allows no source", &unfit);
    else if (trust == LIBRARY_TRUST_PORTABLE && impl->target)
        refuse_source(ix, impl, "it is for one target, and not portable", &unfit);
    index_break(ix->lib, impl, impl->target || unfit.items.len ? &unfit : &faults);
}

static bool are_in_one_file(const struct indexer *ix, elem_id a, elem_id b)
{
    return strcmp(index_file(ix, a), index_file(ix, b)) == 0;
}

/*
 * The implementation of another file for the same definition, target and format; NULL: there is
 * none. Two implementations of one file are a matter of validation. *out_num: how many there are
 * for the definition and the target.
 */
static struct implementation *find_rival(const struct indexer *ix,
                                         const struct implementation *impl, uint32_t *out_num)
{
    uint32_t hash = hash_pair(impl->nodedef, impl->target);
    *out_num = 0;
    for (uint32_t at = hash, found; (found = table_next(&ix->claims, hash, &at)); ++*out_num) {
        struct implementation *other = &ix->lib->impls.items[found - 1];
        if (other->nodedef == impl->nodedef && other->target == impl->target
            && index_attr(ix, other->element, STR_format)
                   == index_attr(ix, impl->element, STR_format)
            && !are_in_one_file(ix, other->element, impl->element))
            return other;
    }
    return NULL;
}

/* The later of two libraries wins. */
static void replace_impl(struct indexer *ix, struct implementation *old,
                         const struct implementation *impl)
{
    const struct document *doc = &ix->lib->doc;
    diag_add(ix->diags, DIAG_ID_replaced_implementation, doc_name_place(doc, impl->element),
             index_text(ix, impl->name), index_file(ix, impl->element), index_text(ix, old->name),
             index_file(ix, old->element),
             index_text(ix, library_nodedef(ix->lib, impl->nodedef)->name));
    diag_add(ix->diags, DIAG_ID_previous_definition, doc_name_place(doc, old->element));
    *old = *impl;
}

static void add_impl(struct indexer *ix, struct implementation impl)
{
    enum { MAX_CLAIMS = 16 }; /* of one definition and target, each of which a further one asks */
    struct library *lib = ix->lib;
    uint32_t num;
    struct implementation *rival = find_rival(ix, &impl, &num);
    uint32_t own = rival ? (uint32_t)(rival - lib->impls.items) : lib->impls.len;
    if (rival) {
        replace_impl(ix, rival, &impl);
    } else {
        vec_push(ix->arena, &lib->impls, impl);
        if (num < MAX_CLAIMS)
            table_add(&ix->claims, ix->arena, hash_pair(impl.nodedef, impl.target), lib->impls.len);
    }
    if (impl.kind == IMPL_GRAPH)
        index_note_graph(ix, impl.ref, own);
}

/* True for a node of served.def that gives a closure, a shader or a material. */
static bool is_operator(const struct indexer *ix, const struct nodedef *def)
{
    static const char *const operators[] = {
#define OPERATOR(node) #node,
#include "library/served.def"
    };
    ir_type_id type =
        library_type_ir(ix->lib, ix->lib->ports.items[def->first_port + def->num_inputs].type);
    for (size_t i = 0; i < sizeof operators / sizeof *operators; i++)
        if (strcmp(operators[i], index_text(ix, def->node)) == 0)
            return ir_type_is_closure(type) || ir_type_is_shader(type);
    return false;
}

void index_operators(struct indexer *ix)
{
    struct library *lib = ix->lib;
    bool *has_one = ARENA_ARRAY(ix->arena, bool, lib->nodedefs.len);
    for (uint32_t i = 0; i < lib->impls.len; i++) {
        const struct implementation *impl = &lib->impls.items[i];
        if (impl->nodedef >= lib->base_nodedefs && impl->kind != IMPL_FOREIGN)
            has_one[impl->nodedef - lib->base_nodedefs] = true;
    }
    for (uint32_t i = 0; i < lib->nodedefs.len; i++) {
        const struct nodedef *def = &lib->nodedefs.items[i];
        if (!has_one[i] && def->num_outputs == 1 && is_operator(ix, def))
            add_impl(ix, (struct implementation){.name = def->name,
                                                 .element = def->element,
                                                 .kind = IMPL_DYNAMIC,
                                                 .nodedef = lib->base_nodedefs + i});
    }
}

/* Makes the implementation the first one of this layer for a definition of a lower layer. */
static void link_override(struct indexer *ix, uint32_t own)
{
    struct library *lib = ix->lib;
    struct implementation *impl = &lib->impls.items[own];
    uint32_t hash = hash_pair(impl->nodedef, 0), at = hash, first;
    while ((first = table_next(&lib->overrides, hash, &at))
           && lib->impls.items[first - 1].nodedef != impl->nodedef)
        ;
    impl->next = first ? lib->base_impls + first - 1 : LIBRARY_NONE;
    if (first)
        table_replace(&lib->overrides, at, own + 1);
    else
        table_add(&lib->overrides, ix->arena, hash, own + 1);
}

/* Drops the implementations beyond the limit, which would make each use of the node slow. */
static void limit_implementations(struct indexer *ix, uint32_t first, const char *nodedef)
{
    uint32_t count = 1, id = first;
    for (; id != LIBRARY_NONE; id = library_impl(ix->lib, id, NULL)->next)
        if (count++ == INDEX_MAX_VARIANTS)
            break;
    if (id == LIBRARY_NONE)
        return;
    struct implementation *last = &ix->lib->impls.items[id - ix->lib->base_impls];
    if (last->next == LIBRARY_NONE)
        return;
    const struct implementation *excess = library_impl(ix->lib, last->next, NULL);
    diag_add(ix->diags, DIAG_ID_too_many_variants, doc_place(&ix->lib->doc, excess->element),
             nodedef, INDEX_MAX_VARIANTS, "implementations");
    last->next = LIBRARY_NONE;
}

void index_link_implementations(struct indexer *ix)
{
    struct library *lib = ix->lib;
    /* backwards, so that the first implementation of a definition becomes the head */
    for (uint32_t i = lib->impls.len; i-- > 0;) {
        struct implementation *impl = &lib->impls.items[i];
        if (impl->nodedef < lib->base_nodedefs) {
            link_override(ix, i);
            continue;
        }
        uint32_t *first = &lib->nodedefs.items[impl->nodedef - lib->base_nodedefs].first_impl;
        impl->next = *first;
        *first = lib->base_impls + i;
    }
    for (uint32_t i = 0; i < lib->impls.len; i++) {
        uint32_t nodedef = lib->impls.items[i].nodedef, id = lib->base_impls + i;
        const struct nodedef *def = library_nodedef(lib, nodedef);
        if (id
            == (nodedef < lib->base_nodedefs ? library_first_override(lib, nodedef)
                                             : def->first_impl))
            limit_implementations(ix, id, index_text(ix, def->name));
    }
}

static elem_id find_nodegraph(const struct library *lib, str_id name)
{
    elem_id found = 0;
    for (; lib && !found; lib = lib->base)
        found = doc_child_of_kind(&lib->doc, lib->doc.root, KIND_NODEGRAPH, name);
    return found;
}

/* True if mxgen does not have the target. */
static bool is_foreign(const struct indexer *ix, str_id target)
{
    return target && ix->lib->knows_target
           && !ix->lib->knows_target(ix->lib->target_user_data, index_text(ix, target));
}

/* The definition of an implementation; LIBRARY_NONE after a diagnostic. */
static uint32_t implemented(struct indexer *ix, elem_id element)
{
    struct library *lib = ix->lib;
    str_id name = index_attr(ix, element, STR_nodedef);
    bool is_graph = doc_element(&lib->doc, element)->kind == KIND_NODEGRAPH;
    if (!name)
        return LIBRARY_NONE; /* a plain nodegraph, or validation reports it */
    uint32_t nodedef = library_nodedef_by_name(lib, name);
    if (nodedef == LIBRARY_NONE && is_graph)
        library_report_nodedef(lib, element, name, ix->diags);
    else if (nodedef == LIBRARY_NONE)
        diag_add(ix->diags, DIAG_ID_implementation_unknown_nodedef,
                 doc_attr_place(&lib->doc, element, STR_nodedef),
                 str_text(&lib->strings, doc_element(&lib->doc, element)->name),
                 str_text(&lib->strings, name));
    bool is_known = nodedef != LIBRARY_NONE
                    && library_is_unique(lib, library_nodedef(lib, nodedef)->element, element,
                                         STR_nodedef, ix->diags);
    return is_known ? nodedef : LIBRARY_NONE;
}

static bool has_source(const struct indexer *ix, elem_id element)
{
    const struct document *doc = &ix->lib->doc;
    bool outputs = false;
    for (elem_id c = doc_element(doc, element)->first_child; c; c = doc_element(doc, c)->next)
        outputs = outputs || doc_attr(doc, c, STR_sourcecode);
    return outputs || index_attr(ix, element, STR_file) || index_attr(ix, element, STR_sourcecode);
}

/* Fills in the kind of an <implementation> without a nodegraph. */
static void read_source(struct indexer *ix, struct implementation *impl)
{
    if (is_foreign(ix, impl->target)) {
        impl->kind = IMPL_FOREIGN;
    } else if (has_source(ix, impl->element)) {
        parse_implementation(ix, impl);
    } else if (index_attr(ix, impl->element, STR_function) == STR_chosen_input
               || !index_served(ix, impl)) {
        impl->kind = IMPL_DYNAMIC;
        impl->ref = index_attr(ix, impl->element, STR_function);
    }
}

/* Adds an implementation for each of its targets. `graph`: 0 for source. */
static void add_for_targets(struct indexer *ix, const struct implementation *common, elem_id graph)
{
    struct index_targets targets;
    index_read_targets(ix, common->element, &targets);
    for (uint32_t i = 0; i < targets.len; i++) {
        struct implementation impl = *common;
        impl.target = targets.items[i];
        impl.kind = IMPL_GRAPH;
        impl.ref = graph;
        if (!graph)
            read_source(ix, &impl);
        add_impl(ix, impl);
    }
}

void index_implementation(struct indexer *ix, elem_id element)
{
    struct library *lib = ix->lib;
    struct implementation impl = {.name = doc_element(&lib->doc, element)->name,
                                  .nodedef = implemented(ix, element),
                                  .element = element};
    if (impl.nodedef == LIBRARY_NONE || !library_nodedef(lib, impl.nodedef)->num_outputs)
        return; /* reported, also as no-output or unknown-type */
    str_id name = index_attr(ix, element, STR_nodegraph);
    elem_id graph = name ? find_nodegraph(lib, name) : 0;
    if (name && !graph)
        diag_add(ix->diags, DIAG_ID_dangling_nodegraph,
                 doc_attr_place(&lib->doc, element, STR_nodegraph), str_text(&lib->strings, name),
                 "");
    else
        add_for_targets(ix, &impl, graph);
}

void index_functional_graph(struct indexer *ix, elem_id element)
{
    struct implementation impl = {.name = doc_element(&ix->lib->doc, element)->name,
                                  .nodedef = implemented(ix, element),
                                  .element = element};
    if (impl.nodedef != LIBRARY_NONE)
        add_for_targets(ix, &impl, element);
}
