// SPDX-License-Identifier: Apache-2.0
/*
 * structure: what a generation would read of an element, as one number, in a small part of the time. The elements that count are numbered
 * as they are met, breadth first, and each adds what it says:
 *
 *     0 surfacematerial   surfaceshader → 1
 *     1 standard_surface  base_color → 2, output 0
 *     2 image_color3      file: a texture
 *
 * So names do not count, nor what else is in the document. Everything that these elements say counts, unless it is known that no program
 * depends on it: an attribute that nobody thought of here makes two numbers differ, which costs a generation, and never two programs equal.
 *
 * What becomes a uniform does not count. That rests on a rule of this room: values of uniforms of floats decide nothing. Where every
 * input of a node is one, whether the document sets it or not, it need not even be there.
 */
#include "build/build.h"

#include "base/hash.h"

enum { IS_PUBLIC = 1, IS_ROOT = 2 }; /* its inputs are the shader's interface; those of shaders connected to it, too */

struct met {
    elem_id element;
    uint8_t flags;
};

struct walk {
    const struct library *lib;
    const struct document *doc;
    const struct structure_options *options;
    struct arena *arena;
    struct diag_list faults;
    bool is_unknown;
    uint64_t hash;
    VEC(struct met) met;     /* in the order of their numbers */
    uint32_t *table;         /* by element: its number + 1 */
    uint32_t table_mask;
    str_id space;            /* the colour space that was asked for last */
    const char *space_meant; /* and what it means; NULL: no conversion */
};

static const char *text_of(const struct walk *w, str_id id)
{
    return str_text(&w->lib->strings, id);
}

/* ---- Numbers ---- */

static void add(struct walk *w, uint64_t word)
{
    w->hash = hash_mix(w->hash, word);
}

/* Texts that the library knows have one id in all documents that stand on it. */
static void add_text(struct walk *w, str_id id)
{
    const struct strpool *strings = &w->lib->strings;
    add(w, id < strings->first ? id : hash_long((uint64_t)1 << 63, str_text(strings, id), str_len(strings, id)));
}

static void grow_table(struct walk *w)
{
    w->table_mask = w->table_mask ? w->table_mask * 4 + 3 : 63;
    w->table = ARENA_ARRAY(w->arena, uint32_t, w->table_mask + 1);
    for (uint32_t i = 0; i < w->met.len; i++) {
        uint32_t slot = hash_pair(w->met.items[i].element, 0) & w->table_mask;
        while (w->table[slot])
            slot = (slot + 1) & w->table_mask;
        w->table[slot] = i + 1;
    }
}

static uint32_t number_of(struct walk *w, elem_id element)
{
    if (w->met.len * 2 >= w->table_mask)
        grow_table(w);
    uint32_t slot = hash_pair(element, 0) & w->table_mask;
    for (; w->table[slot]; slot = (slot + 1) & w->table_mask)
        if (w->met.items[w->table[slot] - 1].element == element)
            return w->table[slot] - 1;
    vec_push(w->arena, &w->met, (struct met){.element = element});
    return (w->table[slot] = w->met.len) - 1;
}

/* ---- Values ---- */

static doc_type type_of(const struct walk *w, elem_id element)
{
    return library_type(w->lib, doc_attr_value(w->doc, element, STR_type));
}

/* The colour space that build_colorspace gives for an element; NULL: none. */
static const char *space_of(struct walk *w, elem_id element)
{
    str_id space = doc_inherited_attr(w->doc, element, STR_colorspace);
    if (space != w->space) {
        const char *working = w->options->colorspace, *text = text_of(w, space), *meant = library_canonical_space(text);
        bool is_none = !space || space == STR_none || strcmp(text, working) == 0 || strcmp(meant, "none") == 0 || strcmp(meant, working) == 0;
        w->space = space;
        w->space_meant = is_none ? NULL : meant;
    }
    return w->space_meant;
}

/* Numbers and words decide what becomes of a program, and so do floats that do not parse. */
static bool is_uniform_value(const struct walk *w, doc_type type, str_id value)
{
    struct ir_value parsed;
    return w->options->interface != INTERFACE_REDUCED && type < DOC_NUM_TYPES && doc_type_components(type)
           && ir_type_is_float(doc_type_ir(type))
           && doc_parse_value(type, text_of(w, value), str_len(&w->lib->strings, value), NULL, &parsed);
}

/*
 * Which file it is does not count, but whether there is one does, and the host's tokens do. Tiles depend on what lies in a folder, and
 * names with tokens on where these are found.
 */
static void add_file(struct walk *w, elem_id element, str_id file)
{
    const char *text = text_of(w, file), *prefix = text_of(w, doc_inherited_attr(w->doc, element, STR_fileprefix));
    w->is_unknown |= strpbrk(text, "<[") || strpbrk(prefix, "<[");
    if (strchr(text, '{'))
        add_text(w, file);
    else
        add(w, *text != '\0');
}

static void add_value(struct walk *w, elem_id element, str_id value, bool is_public)
{
    doc_type type = type_of(w, element);
    w->is_unknown |= type == DOC_TYPE_NONE;
    if (type == DOC_TYPE_filename)
        add_file(w, element, value);
    else if (is_public && is_uniform_value(w, type, value))
        add(w, UINT64_MAX);
    else
        add_text(w, value);
    if (type == DOC_TYPE_color3 || type == DOC_TYPE_color4 || type == DOC_TYPE_filename) {
        const char *space = space_of(w, element);
        add(w, space ? hash_long(0, space, strlen(space)) : 0);
    }
}

/* ---- Attributes ---- */

/* What generation does not look at, or what is found from below: colour spaces and prefixes by values. */
static bool is_left_out(str_id attr)
{
    switch (attr) {
    case STR_doc:
    case STR_xpos:
    case STR_ypos:
    case STR_uiname:
    case STR_uifolder:
    case STR_uimin:
    case STR_uimax:
    case STR_uisoftmin:
    case STR_uisoftmax:
    case STR_uistep:
    case STR_uiadvanced:
    case STR_uivisible:
    case STR_colorspace:
    case STR_fileprefix:
        return true;
    default:
        return false;
    }
}

static bool is_connection(str_id attr)
{
    return attr == STR_nodename || attr == STR_nodegraph || attr == STR_interfacename || attr == STR_output;
}

static bool has_own_units(const struct document *doc)
{
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_UNITDEF || doc_element(doc, e)->kind == KIND_UNITTYPEDEF)
            return true;
    return false;
}

/* True where the element is a port that is connected: what it is connected to says more than the names. */
static bool add_attributes(struct walk *w, elem_id element, bool is_public)
{
    const struct element *e = doc_element(w->doc, element);
    const struct attribute *attrs = doc_attrs(w->doc, element);
    bool is_port = e->kind == KIND_INPUT || e->kind == KIND_OUTPUT, is_connected = false;
    for (uint32_t i = 0; i < e->num_attrs; i++) {
        str_id name = attrs[i].name, value = attrs[i].value;
        if (is_left_out(name))
            continue;
        add_text(w, name);
        if (is_port && is_connection(name))
            is_connected |= value != 0;
        else if (is_port && name == STR_value)
            add_value(w, element, value, is_public);
        else
            add_text(w, value);
        if (name == STR_unit)
            w->is_unknown |= has_own_units(w->doc);
    }
    return is_connected;
}

/* ---- Ports ---- */

/* What stands behind a port is added by its number. The number of a node is returned; UINT32_MAX: it is none, or a fault. */
static uint32_t add_connection(struct walk *w, elem_id port)
{
    doc_type type = type_of(w, port);
    struct binding binding = {.kind = BIND_ERROR};
    if (type != DOC_TYPE_NONE)
        binding = library_resolve_connection(w->lib, port, type, &w->faults);
    bool is_end = binding.kind == BIND_VALUE || binding.kind == BIND_DEFAULT;
    w->is_unknown |= w->faults.items.len > 0 || !(is_end || binding.kind == BIND_NODE);
    if (w->is_unknown || (is_end && binding.element == port))
        return UINT32_MAX;
    uint32_t number = number_of(w, is_end ? binding.element : binding.ref);
    add(w, (uint64_t)binding.kind << 48 | (uint64_t)binding.output << 32 | number);
    return is_end ? UINT32_MAX : number;
}

static bool is_shader(const struct walk *w, elem_id port)
{
    doc_type type = type_of(w, port);
    return type && ir_type_is_shader(library_type_ir(w->lib, type));
}

static bool gives_numbers(const struct walk *w, elem_id node)
{
    doc_type type = type_of(w, node);
    if (type != DOC_TYPE_multioutput)
        return doc_type_components(type) > 0;
    str_id category = doc_element(w->doc, node)->category;
    for (const struct library *layer = w->lib; layer; layer = layer->base)
        for (uint32_t i = library_first_of_node(layer, category); i != LIBRARY_NONE; i = layer->nodedefs.items[i].next_same_node) {
            const struct nodedef *def = &layer->nodedefs.items[i];
            for (uint32_t k = 0; k < def->num_outputs; k++)
                if (!doc_type_components(layer->ports.items[def->first_port + def->num_inputs + k].type))
                    return false;
        }
    return true;
}

/* Inputs and outputs count by name. Tokens, which files are named by, and what does not belong there are left to a generation. */
static void add_child(struct walk *w, elem_id child, uint8_t flags)
{
    const struct element *e = doc_element(w->doc, child);
    w->is_unknown |= (e->kind != KIND_INPUT && e->kind != KIND_OUTPUT) || e->first_child;
    if (doc_attr_value(w->doc, child, STR_type) == STR_filename) /* what emits may have its profile in the program */
        w->is_unknown |= !gives_numbers(w, e->parent);
    add(w, (uint64_t)e->kind + 1);
    add_text(w, e->name);
    if (!add_attributes(w, child, flags & IS_PUBLIC) || e->kind != KIND_INPUT)
        return;
    uint32_t number = add_connection(w, child);
    if (number != UINT32_MAX && flags & IS_ROOT && is_shader(w, child))
        w->met.items[number].flags |= IS_PUBLIC;
}

/* ---- Nodes of the interface ---- */

/*
 * An input that is what it would be if the document did not mention it: a uniform of floats, or the default itself. The definition's
 * type is the input's, since they match.
 */
static bool is_as_unset(struct walk *w, elem_id input, const struct port *port)
{
    const struct element *e = doc_element(w->doc, input);
    const struct attribute *attrs = doc_attrs(w->doc, input);
    str_id value = doc_attr_value(w->doc, input, STR_value);
    if (w->options->interface != INTERFACE_COMPLETE || port->geomprop || !value || e->first_child)
        return false;
    for (uint32_t i = 0; i < e->num_attrs; i++)
        if (!is_left_out(attrs[i].name) && attrs[i].name != STR_type && attrs[i].name != STR_value)
            return false;
    if ((port->type == DOC_TYPE_color3 || port->type == DOC_TYPE_color4) && space_of(w, input))
        return false;
    bool is_choice = port->type == DOC_TYPE_boolean || port->type == DOC_TYPE_integer;
    return is_choice ? value == port->value : is_uniform_value(w, port->type, value);
}

/* Most nodes have their inputs in the definition's order: the search goes on where it ended. `n`: there is none of that name. */
static unsigned find_port(const struct port *ports, unsigned n, unsigned start, str_id name)
{
    for (unsigned tried = 0; tried < n; tried++) {
        unsigned port = start + tried < n ? start + tried : start + tried - n;
        if (ports[port].name == name)
            return port;
    }
    return n;
}

/* Inputs in the order of the definition, so that it does not count either in which order, or whether, documents set them. */
static void add_public_inputs(struct walk *w, elem_id node, uint8_t flags)
{
    uint32_t nodedef = library_match(w->lib, node, &w->faults);
    w->is_unknown |= nodedef == LIBRARY_NONE || w->faults.items.len;
    if (w->is_unknown)
        return;
    const struct nodedef *def = library_nodedef(w->lib, nodedef);
    const struct port *ports = library_ports(w->lib, nodedef, NULL);
    elem_id *inputs = ARENA_ARRAY(w->arena, elem_id, def->num_inputs);
    unsigned port = 0;
    for (elem_id e = doc_element(w->doc, node)->first_child; e; e = doc_element(w->doc, e)->next) {
        if (doc_element(w->doc, e)->kind != KIND_INPUT) {
            add_child(w, e, flags);
            continue;
        }
        port = find_port(ports, def->num_inputs, port, doc_element(w->doc, e)->name);
        w->is_unknown |= port == def->num_inputs || inputs[port];
        if (w->is_unknown)
            return;
        inputs[port] = e;
    }
    for (unsigned i = 0; i < def->num_inputs && !w->is_unknown; i++)
        if (inputs[i] && !is_as_unset(w, inputs[i], &ports[i]))
            add_child(w, inputs[i], flags);
}

/* ---- Elements ---- */

/* The output that is generated: as build_element does, it publishes what its value comes from. */
static void add_output(struct walk *w, elem_id output)
{
    uint32_t number = add_connection(w, output);
    if (number == UINT32_MAX)
        return;
    if (is_shader(w, output))
        w->met.items[number].flags |= IS_PUBLIC | IS_ROOT;
    else if (doc_element(w->doc, output)->parent == w->doc->root)
        w->met.items[number].flags |= IS_PUBLIC;
}

static void add_inputs(struct walk *w, elem_id node, uint8_t flags)
{
    for (elem_id child = doc_element(w->doc, node)->first_child; child && !w->is_unknown; child = doc_element(w->doc, child)->next)
        add_child(w, child, flags);
}

/* Inputs of graphs belong to the interface, too. The document itself says nothing that is not asked for from below. */
static void add_element(struct walk *w, uint32_t number)
{
    struct met met = w->met.items[number];
    const struct element *e = doc_element(w->doc, met.element);
    bool of_graph = e->kind == KIND_INPUT && e->parent && doc_element(w->doc, e->parent)->kind == KIND_NODEGRAPH;
    add(w, e->kind);
    if (!e->parent)
        return;
    add_text(w, e->category);
    add(w, number_of(w, e->parent));
    bool is_connected = add_attributes(w, met.element, of_graph || met.flags & IS_PUBLIC);
    if (e->kind == KIND_NODE && met.flags & IS_PUBLIC)
        add_public_inputs(w, met.element, met.flags);
    else if (e->kind == KIND_NODE)
        add_inputs(w, met.element, met.flags);
    else if (number == 0 && is_connected)
        add_output(w, met.element);
    add(w, 0);
}

/* Definitions of the document's own, and graphs that implement one, are left to a generation. */
static bool has_definitions(const struct library *layer)
{
    return layer->nodedefs.len || layer->impls.len || layer->geomprops.len || layer->types.len;
}

uint64_t build_structure(const struct library *lib, const struct structure_options *options, elem_id element, unsigned output,
                         struct arena *scratch)
{
    struct walk w = {.lib = lib, .doc = &lib->doc, .options = options, .arena = scratch,
                     .hash = hash_mix(options->seed, output), .is_unknown = has_definitions(lib)};
    diag_list_init(&w.faults, scratch);
    number_of(&w, element);
    if (doc_element(w.doc, element)->kind == KIND_NODE)
        w.met.items[0].flags = IS_PUBLIC | IS_ROOT;
    for (uint32_t i = 0; i < w.met.len && !w.is_unknown; i++)
        add_element(&w, i);
    return w.is_unknown ? 0 : w.hash ? w.hash : 1;
}
