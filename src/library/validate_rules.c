// SPDX-License-Identifier: Apache-2.0
/*
 * Rules of the MaterialX specification that generation does not need: mxgen assumes the most likely
 * meaning, but other programs may not. The section names are those of the main document.
 */
#include "library/validate_nodes.h"

#include <stdlib.h>

static const char *text_of(const struct validate *v, str_id id)
{
    return str_text(&v->lib->strings, id);
}

static bool is_array(doc_type type)
{
    return type >= DOC_TYPE_integerarray && type <= DOC_TYPE_geomnamearray;
}

/* "Inputs": strings, filenames and arrays do not vary over a surface. */
bool validate_is_uniform_type(doc_type type)
{
    return type == DOC_TYPE_string || type == DOC_TYPE_filename || is_array(type);
}

/* ---- Uniform inputs ---- */

static elem_id child_input(const struct validate *v, elem_id node, const char *name)
{
    for (elem_id e = doc_element(v->doc, node)->first_child; e; e = doc_element(v->doc, e)->next)
        if (strcmp(text_of(v, doc_element(v->doc, e)->name), name) == 0)
            return e;
    return 0;
}

/* Looks through <dot>, which passes its input on. 0: no source. */
static elem_id source_of_dots(struct validate *v, elem_id node)
{
    for (unsigned depth = 0;
         node && strcmp(text_of(v, doc_element(v->doc, node)->category), "dot") == 0; depth++) {
        elem_id in = child_input(v, node, "in");
        str_id name = in ? doc_attr_value(v->doc, in, STR_nodename) : 0;
        node = name && depth < 64
                   ? doc_child_of_kind(v->doc, doc_element(v->doc, node)->parent, KIND_NODE, name)
                   : 0;
    }
    return node;
}

static bool gives_uniform(struct validate *v, elem_id node, unsigned output)
{
    const char *category = text_of(v, doc_element(v->doc, node)->category);
    struct diag_list ignored; /* discarded: the check of the node itself reports these */
    diag_list_init_unheard(&ignored, v->resolved.arena);
    if (strcmp(category, "constant") == 0 || strcmp(category, "geompropvalueuniform") == 0)
        return true;
    uint32_t nodedef = library_match(v->lib, node, &ignored);
    if (nodedef == LIBRARY_NONE || output >= library_nodedef(v->lib, nodedef)->num_outputs)
        return true; /* unknown */
    const struct port *ports = library_ports(v->lib, nodedef, NULL);
    return ports[library_nodedef(v->lib, nodedef)->num_inputs + output].flags & PORT_UNIFORM;
}

/* The input of the definition if it varies; 0: it is uniform, or mxgen reports its absence. */
static elem_id varying_interface(const struct validate *v, const struct binding *binding)
{
    elem_id graph = library_graph_around(v->lib, binding->element);
    uint32_t nodedef = graph ? library_implemented_nodedef(v->lib, graph) : LIBRARY_NONE;
    int input = nodedef == LIBRARY_NONE ? -1 : library_find_input(v->lib, nodedef, binding->ref);
    if (input < 0)
        return 0;
    const struct port *port = &library_ports(v->lib, nodedef, NULL)[input];
    return port->flags & PORT_UNIFORM || validate_is_uniform_type(port->type) ? 0 : port->element;
}

void validate_uniform(struct validate *v, elem_id node, const struct port *port,
                      const struct binding *binding)
{
    if (!(port->flags & PORT_UNIFORM || validate_is_uniform_type(port->type)))
        return;
    elem_id varies = 0;
    if (binding->kind == BIND_INTERFACE)
        varies = varying_interface(v, binding);
    if (binding->kind == BIND_NODE && binding->ref >= v->doc->first_element) {
        elem_id source = source_of_dots(v, binding->ref);
        if (source && !gives_uniform(v, source, source == binding->ref ? binding->output : 0))
            varies = source;
    }
    /* 0 for the output of a nodegraph between them */
    elem_id input = varies ? child_input(v, node, text_of(v, port->name)) : 0;
    if (!input)
        return;
    diag_add(v->diags, DIAG_ID_uniform_connected, doc_name_place(v->doc, input),
             text_of(v, port->name), text_of(v, doc_element(v->doc, node)->category));
    diag_add(v->diags, DIAG_ID_connected_here, doc_name_place(v->doc, varies),
             text_of(v, doc_element(v->doc, varies)->name));
}

/* ---- Spaces ---- */

bool validate_is_among(const char *word, const char *const *words, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(words[i], word) == 0)
            return true;
    return false;
}

void validate_space(struct validate *v, elem_id node, const struct port *port, elem_id input)
{
    static const char *const nodes[] = {"transformpoint", "transformvector", "transformnormal"},
                             *const inputs[] = {"fromspace", "tospace"},
                             *const spaces[] = {"model", "object", "world"};
    const char *category = text_of(v, doc_element(v->doc, node)->category),
               *space = text_of(v, doc_attr_value(v->doc, input, STR_value));
    if (validate_is_among(text_of(v, port->name), inputs, 2)
        && validate_is_among(category, nodes, 3) && *space && !validate_is_among(space, spaces, 3))
        diag_add(v->diags, DIAG_ID_unknown_space, doc_attr_place(v->doc, input, STR_value), space,
                 category, diag_suggest(v->diags, space, spaces, 3));
}

/* ---- Declarations ---- */

void validate_report(struct validate *v, elem_id element, const char *what)
{
    const struct element *e = doc_element(v->doc, element);
    diag_add(v->diags, DIAG_ID_bad_definition, doc_place(v->doc, element), text_of(v, e->category),
             text_of(v, e->name), what);
}

static bool has(const struct validate *v, elem_id element, str_id attr)
{
    return doc_attr(v->doc, element, attr) != NULL;
}

static bool is_connected(const struct validate *v, elem_id port)
{
    return has(v, port, STR_nodename) || has(v, port, STR_nodegraph)
           || has(v, port, STR_interfacename);
}

/* "NodeDef Input Elements" */
static void check_declared_input(struct validate *v, elem_id input)
{
    doc_type type = library_type(v->lib, doc_attr_value(v->doc, input, STR_type));
    bool is_uniform = doc_attr_is_true(v->doc, input, STR_uniform),
         takes_geometry = has(v, input, STR_defaultgeomprop);
    if (validate_is_uniform_type(type) && !is_uniform)
        validate_report(v, input,
                        "has a type that cannot vary over a surface; write uniform=\"true\"");
    if (takes_geometry && is_uniform)
        validate_report(v, input, "is uniform, but its defaultgeomprop varies");
    else if (takes_geometry && type != DOC_TYPE_vector2 && type != DOC_TYPE_vector3)
        validate_report(v, input, "has a defaultgeomprop, which needs the type vector2 or vector3");
    else if (takes_geometry && has(v, input, STR_value))
        validate_report(v, input, "has a value and a defaultgeomprop; keep one of them");
    else if (takes_geometry)
        library_default_geomprop(v->lib, input, type, v->diags);
}

/* "NodeDef Output Elements" */
static void check_declared_output(struct validate *v, elem_id nodedef, elem_id output)
{
    str_id name = doc_attr_value(v->doc, output, STR_defaultinput);
    elem_id input = name ? doc_child_of_kind(v->doc, nodedef, KIND_INPUT, name) : 0;
    if (is_connected(v, output))
        validate_report(v, output, "belongs to a nodedef and cannot be connected");
    if (is_array(library_type(v->lib, doc_attr_value(v->doc, output, STR_type))))
        validate_report(v, output, "has the type of an array, which no node has as an output");
    if (input
        && doc_attr_value(v->doc, input, STR_type) != doc_attr_value(v->doc, output, STR_type))
        validate_report(v, output, "has a defaultinput of another type");
    else if (name && !input && !has(v, nodedef, STR_inherit))
        validate_report(v, output, "has a defaultinput that names no input");
}

static void check_nodedef(struct validate *v, elem_id nodedef)
{
    for (elem_id e = doc_element(v->doc, nodedef)->first_child; e;
         e = doc_element(v->doc, e)->next) {
        if (doc_element(v->doc, e)->kind == KIND_INPUT)
            check_declared_input(v, e);
        else if (doc_element(v->doc, e)->kind == KIND_OUTPUT)
            check_declared_output(v, nodedef, e);
    }
}

/* "Functional Nodegraphs": the definition declares the inputs and outputs. */
static void check_functional_graph(struct validate *v, elem_id graph, uint32_t id)
{
    const struct nodedef *def = library_nodedef(v->lib, id);
    const struct port *outputs = library_ports(v->lib, id, NULL) + def->num_inputs;
    for (elem_id e = doc_element(v->doc, graph)->first_child; e; e = doc_element(v->doc, e)->next)
        if (doc_element(v->doc, e)->kind == KIND_INPUT) {
            validate_report(
                v, e,
                "is ignored, because the nodegraph takes its inputs from the nodedef that it "
                "implements");
            break;
        }
    for (unsigned i = 0; i < def->num_outputs; i++) {
        elem_id output = library_inner_output(v->lib, id, i, v->doc, graph);
        if (!output)
            validate_report(v, graph, "lacks an output of the nodedef that it implements");
        else if (library_type(v->lib, doc_attr_value(v->doc, output, STR_type)) != outputs[i].type)
            validate_report(
                v, output,
                "differs in type from the output of the nodedef that its nodegraph implements");
    }
}

static void check_graph(struct validate *v, elem_id graph)
{
    uint32_t nodedef = library_implemented_nodedef(v->lib, graph);
    if (nodedef != LIBRARY_NONE)
        check_functional_graph(v, graph, nodedef);
    for (elem_id e = doc_element(v->doc, graph)->first_child; e; e = doc_element(v->doc, e)->next)
        if (doc_element(v->doc, e)->kind == KIND_OUTPUT && !is_connected(v, e)
            && !has(v, e, STR_value))
            validate_report(v, e, "is not connected");
}

static void check_unit_scale(struct validate *v, elem_id unit)
{
    struct ir_value scale;
    str_id text = doc_attr_value(v->doc, unit, STR_scale);
    bool is_number = text
                     && doc_parse_value(DOC_TYPE_float, text_of(v, text),
                                        str_len(&v->lib->strings, text), NULL, &scale);
    if (text && (!is_number || !(scale.w[0].f > 0.0f)))
        validate_report(v, unit, "needs a scale above 0");
}

/* "Custom Data Types" */
static void check_typedef(struct validate *v, elem_id element)
{
    static const char *const semantics[] = {"default", "color", "shader", "material"};
    const char *semantic = text_of(v, doc_attr_value(v->doc, element, STR_semantic));
    if (doc_type_of(doc_element(v->doc, element)->name))
        validate_report(v, element, "has the name of a standard type");
    if (*semantic && !validate_is_among(semantic, semantics, sizeof semantics / sizeof *semantics))
        validate_report(v, element,
                        "has an unknown semantic; expected default, color, shader or material");
}

void validate_declaration(struct validate *v, elem_id element)
{
    const struct element *e = doc_element(v->doc, element);
    switch (e->kind) {
    case KIND_NODEDEF: check_nodedef(v, element); break;
    case KIND_NODEGRAPH: check_graph(v, element); break;
    case KIND_GEOMPROPDEF: validate_geompropdef(v, element); break;
    case KIND_GEOMPROP: validate_type_of_property(v, element, e->name); break;
    case KIND_NODE: validate_reader(v, element); break;
    case KIND_IMPLEMENTATION:
        if (has(v, element, STR_file) && has(v, element, STR_sourcecode))
            validate_report(v, element, "has a file and sourcecode; keep one of them");
        break;
    case KIND_TYPEDEF: check_typedef(v, element); break;
    case KIND_UNIT: check_unit_scale(v, element); break;
    case KIND_INPUT:
        if (doc_element(v->doc, e->parent)->kind == KIND_VARIANT && is_connected(v, element))
            validate_report(v, element, "belongs to a variant and needs a value, not a connection");
        break;
    default: break;
    }
}

/* ---- Implementations ---- */

/*
 * "Custom Node Definition Using Node Graphs": a definition cannot have two of the same kind; source
 * and a nodegraph can coexist.
 */
struct claim {
    uint32_t nodedef;
    str_id target, format;
    bool is_graph;
    /* the nodegraph may be claimed by its own attribute and by an <implementation> */
    uint32_t graph;
    elem_id element;
};

static int compare_claims(const void *left, const void *right)
{
    const struct claim *a = left, *b = right;
    uint32_t first[] = {a->nodedef, a->target, a->format, a->is_graph, a->element};
    uint32_t second[] = {b->nodedef, b->target, b->format, b->is_graph, b->element};
    for (size_t i = 0; i < sizeof first / sizeof *first; i++)
        if (first[i] != second[i])
            return first[i] < second[i] ? -1 : 1;
    return 0;
}

static bool is_competing(const struct claim *a, const struct claim *b)
{
    return a->nodedef == b->nodedef && a->target == b->target && a->format == b->format
           && a->is_graph == b->is_graph && a->element != b->element
           && !(a->is_graph && a->graph == b->graph);
}

void validate_implementations(struct validate *v, struct arena *scratch)
{
    uint32_t count = v->lib->impls.len;
    struct claim *claims = ARENA_ARRAY(scratch, struct claim, count);
    for (uint32_t i = 0; i < count; i++) {
        const struct implementation *impl = &v->lib->impls.items[i];
        claims[i] = (struct claim){impl->nodedef,
                                   impl->target,
                                   doc_attr_value(v->doc, impl->element, STR_format),
                                   impl->kind == IMPL_GRAPH,
                                   impl->kind == IMPL_GRAPH ? impl->ref : 0,
                                   impl->element};
    }
    if (count > 1)
        qsort(claims, count, sizeof *claims, compare_claims);
    /* each element once, though it may compete for several targets */
    bool *is_told = ARENA_ARRAY(scratch, bool, doc_num_elements(v->doc));
    for (uint32_t i = 1; i < count; i++) {
        bool *told = &is_told[claims[i].element - v->doc->first_element];
        if (!*told && (*told = is_competing(&claims[i - 1], &claims[i])))
            diag_add(v->diags, DIAG_ID_competing_implementations,
                     doc_place(v->doc, claims[i].element),
                     text_of(v, doc_element(v->doc, claims[i].element)->name),
                     text_of(v, library_nodedef(v->lib, claims[i].nodedef)->name),
                     text_of(v, doc_element(v->doc, claims[i - 1].element)->name));
    }
}

/*
 * True if a node without a version may mean both definitions: their outputs are alike, and no input
 * has another type.
 */
static bool is_rival(const struct library *lib, const struct nodedef *a, const struct nodedef *b)
{
    const struct port *of_a = &lib->ports.items[a->first_port];
    const struct port *of_b = &lib->ports.items[b->first_port];
    if (a->num_outputs != b->num_outputs || !library_share_target(lib, a, b))
        return false;
    for (uint32_t i = 0; i < a->num_outputs; i++)
        if (of_a[a->num_inputs + i].type != of_b[b->num_inputs + i].type)
            return false;
    for (uint32_t i = 0; i < a->num_inputs; i++)
        for (uint32_t k = 0; k < b->num_inputs; k++)
            if (of_a[i].name == of_b[k].name && of_a[i].type != of_b[k].type)
                return false;
    return true;
}

void validate_default_versions(struct validate *v)
{
    const struct library *lib = v->lib;
    for (uint32_t i = 0; i < lib->nodedefs.len; i++) {
        const struct nodedef *first = &lib->nodedefs.items[i];
        uint32_t next = first->is_default_version ? first->next_same_node : LIBRARY_NONE;
        for (; next != LIBRARY_NONE; next = lib->nodedefs.items[next].next_same_node) {
            const struct nodedef *other = &lib->nodedefs.items[next];
            if (other->is_default_version && is_rival(lib, first, other)) {
                diag_add(v->diags, DIAG_ID_two_default_versions,
                         doc_attr_place(v->doc, other->element, STR_isdefaultversion),
                         text_of(v, first->name), text_of(v, other->name), text_of(v, first->node),
                         text_of(v, first->name));
                break;
            }
        }
    }
}

void validate_type_of_meaning(struct validate *v, elem_id element)
{
    str_id name = doc_attr_value(v->doc, element, STR_type);
    doc_type type = library_type(v->lib, name);
    if (doc_type_is_colorless(type) && doc_element(v->doc, element)->kind == KIND_INPUT
        && has(v, element, STR_colorspace))
        diag_add(v->diags, DIAG_ID_colorspace_misplaced,
                 doc_attr_place(v->doc, element, STR_colorspace),
                 text_of(v, doc_element(v->doc, element)->name), text_of(v, name));
    if (type && !doc_type_can_have_unit(type)
        && (has(v, element, STR_unit) || has(v, element, STR_unittype)))
        diag_add(v->diags, DIAG_ID_unit_misplaced, doc_place(v->doc, element),
                 text_of(v, doc_element(v->doc, element)->name), text_of(v, name));
}

void validate_connected_meaning(struct validate *v, const struct port *port, elem_id input)
{
    static const str_id meanings[] = {STR_colorspace, STR_unit};
    for (unsigned i = 0; port->type != DOC_TYPE_filename && i < 2; i++)
        if (has(v, input, meanings[i]))
            diag_add(v->diags, DIAG_ID_connected_meaning,
                     doc_attr_place(v->doc, input, meanings[i]), text_of(v, meanings[i]),
                     text_of(v, doc_element(v->doc, input)->name));
}

/*
 * The definition or the input has the type of a unit; otherwise the first type with this unit
 * applies.
 */
void validate_unit(struct validate *v, elem_id node, const struct port *port, elem_id input)
{
    str_id unit = doc_attr_value(v->doc, input, STR_unit),
           type = doc_attr_value(v->doc, port->element, STR_unittype);
    float scale;
    bool is_known = unit && library_unit_type_of(v->lib, unit);
    if (!is_known || !doc_type_can_have_unit(port->type) || (!type && has(v, input, STR_unittype)))
        return; /* reported, or valid without a definition */
    if (!type)
        diag_add(v->diags, DIAG_ID_unit_without_type, doc_attr_place(v->doc, input, STR_unit),
                 text_of(v, unit), text_of(v, doc_element(v->doc, node)->category),
                 text_of(v, library_unit_type_of(v->lib, unit)));
    else if (!library_unit_scale(v->lib, type, unit, &scale))
        library_report_unit(v->lib, type, unit, doc_attr_place(v->doc, input, STR_unit), v->diags);
}
