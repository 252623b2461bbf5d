// SPDX-License-Identifier: Apache-2.0
/*
 * structure: what a generation would read of an element, as one number, in a small part of the
 * time. The elements that count are numbered as they are met, breadth first, and each adds what it
 * says:
 *
 *     0 surfacematerial   surfaceshader → 1
 *     1 standard_surface  base_color → 2, output 0
 *     2 image_color3      file: a texture
 *
 * Nodes are their definitions, with those inputs that are not what they would be unset, in the
 * definition's order; so names and places do not count. What else these elements say counts, unless
 * it is known that no program depends on it: an attribute that nobody thought of here makes two
 * numbers differ, which costs a generation, and never two programs equal.
 *
 * What becomes a uniform does not count. That rests on a rule of this room: values of uniforms
 * decide nothing, but those of integers.
 */
#include "build/build.h"

#include "base/hash.h"

/* its inputs are the shader's interface; those of shaders connected to it, too */
enum { IS_PUBLIC = 1, IS_ROOT = 2 };

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
    VEC(struct met) met; /* in the order of their numbers */
    uint32_t *table;     /* by element: its number + 1 */
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

/*
 * What follows: no text and no number looks like one of these, so that words mean one thing only.
 */
enum mark {
    MARK_ELEMENT,
    MARK_INPUT,
    MARK_UNIFORM,
    MARK_NUMBER,
    MARK_TEXT,
    MARK_FILE,
    MARK_NO_FILE,
    MARK_SPACE,
    MARK_CONNECTION,
    MARK_END
};

static void mark(struct walk *w, enum mark what, uint32_t more)
{
    add(w, (uint64_t)1 << 62 | (uint64_t)what << 48 | more);
}

/* Texts that the library knows have one id in all documents that stand on it. */
static void add_text(struct walk *w, str_id id)
{
    const struct strpool *strings = &w->lib->strings;
    add(w, id < strings->first
               ? id
               : hash_long((uint64_t)1 << 63, str_text(strings, id), str_len(strings, id)));
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
        const char *working = w->options->colorspace, *text = text_of(w, space),
                   *meant = library_canonical_space(text);
        bool is_none = !space || space == STR_none || strcmp(text, working) == 0
                       || strcmp(meant, "none") == 0 || strcmp(meant, working) == 0;
        w->space = space;
        w->space_meant = is_none ? NULL : meant;
    }
    return w->space_meant;
}

static bool parse(const struct walk *w, doc_type type, str_id text, struct ir_value *out)
{
    bool has_words =
        type < DOC_NUM_TYPES && (doc_type_components(type) || type == DOC_TYPE_boolean);
    return has_words
           && doc_parse_value(type, text_of(w, text), str_len(&w->lib->strings, text), NULL, out);
}

static bool is_uniform(const struct walk *w, bool is_public, const struct ir_value *value)
{
    return is_public && w->options->interface != INTERFACE_REDUCED
           && (ir_type_is_float(value->type) || value->type == IR_TYPE_BOOL);
}

/*
 * Which file it is does not count, but whether there is one does, and the host's tokens do. Tiles
 * depend on what lies in a folder, and names with tokens on where these are found.
 */
static void add_file(struct walk *w, elem_id element, str_id file)
{
    const char *text = text_of(w, file),
               *prefix = text_of(w, doc_inherited_attr(w->doc, element, STR_fileprefix));
    w->is_unknown |= strpbrk(text, "<[") || strpbrk(prefix, "<[");
    mark(w, *text ? MARK_FILE : MARK_NO_FILE, 0);
    if (strchr(text, '{'))
        add_text(w, file);
}

/*
 * Numbers that are compiled in, or that may decide what becomes of a program, count however they
 * are written.
 */
static void add_number(struct walk *w, const struct ir_value *value)
{
    unsigned n = ir_type_info(value->type)->components;
    mark(w, MARK_NUMBER, n);
    for (unsigned i = 0; i < n; i++)
        add(w, value->w[i].u);
}

static bool is_color(doc_type type)
{
    return type == DOC_TYPE_color3 || type == DOC_TYPE_color4;
}

static void add_value(struct walk *w, elem_id element, str_id text, bool is_public)
{
    doc_type type = type_of(w, element);
    struct ir_value value;
    const char *space = is_color(type) || type == DOC_TYPE_filename ? space_of(w, element) : NULL;
    if (type == DOC_TYPE_filename) {
        add_file(w, element, text);
    } else if (!parse(w, type, text, &value)) {
        mark(w, MARK_TEXT, 0);
        add_text(w, text);
    } else if (is_uniform(w, is_public, &value)) {
        mark(w, MARK_UNIFORM, 0);
    } else {
        add_number(w, &value);
    }
    if (space) {
        mark(w, MARK_SPACE, 0);
        add(w, hash_long(0, space, strlen(space)));
    }
}

/* ---- Attributes ---- */

/*
 * Attributes that nobody reads, as they are no words of ours, or that generation does not look at,
 * or finds in another way: definitions, and by values colour spaces and prefixes.
 */
static bool is_left_out(str_id attr, bool is_node)
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
    case STR_fileprefix: return true;
    case STR_type:
    case STR_nodedef:
    case STR_version: return is_node;
    default: return attr >= STR_NUM_WORDS;
    }
}

static bool is_connection(str_id attr)
{
    return attr == STR_nodename || attr == STR_nodegraph || attr == STR_interfacename
           || attr == STR_output;
}

/*
 * True where the element is a port that is connected: what it is connected to says more than the
 * names.
 */
static bool add_attributes(struct walk *w, elem_id element, bool is_public)
{
    const struct element *e = doc_element(w->doc, element);
    const struct attribute *attrs = doc_attrs(w->doc, element);
    unsigned num_says = 0;
    bool is_port = e->kind == KIND_INPUT || e->kind == KIND_OUTPUT, is_connected = false;
    for (uint32_t i = 0; i < e->num_attrs; i++) {
        str_id name = attrs[i].name, value = attrs[i].value;
        if (is_port && is_connection(name)) {
            is_connected |= value != 0;
            num_says += value && name != STR_output;
        } else if (!is_left_out(name, !is_port)) {
            add(w, name);
            num_says += name == STR_value && value;
            if (is_port && name == STR_value)
                add_value(w, element, value, is_public);
            else
                add_text(w, value);
        }
        if (name == STR_unit)
            w->is_unknown |= w->lib->units.len > 0; /* units of the document itself */
    }
    mark(w, MARK_END, 0);
    w->is_unknown |= is_port && (num_says > 1 || type_of(w, element) == DOC_TYPE_NONE);
    return is_connected;
}

/* ---- Ports ---- */

/*
 * What stands behind a port is added by its number. The number of a node is returned; UINT32_MAX:
 * it is none, or a fault.
 */
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
    mark(w, MARK_CONNECTION, (uint32_t)binding.kind << 8 | binding.output);
    add(w, number);
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
        for (uint32_t i = library_first_of_node(layer, category); i != LIBRARY_NONE;
             i = layer->nodedefs.items[i].next_same_node) {
            const struct nodedef *def = &layer->nodedefs.items[i];
            for (uint32_t k = 0; k < def->num_outputs; k++)
                if (!doc_type_components(
                        layer->ports.items[def->first_port + def->num_inputs + k].type))
                    return false;
        }
    return true;
}

static void add_input(struct walk *w, elem_id input, uint8_t flags)
{
    if (type_of(w, input) == DOC_TYPE_filename) /* what emits may have its profile in the program */
        w->is_unknown |= !gives_numbers(w, doc_element(w->doc, input)->parent);
    if (!add_attributes(w, input, flags & IS_PUBLIC))
        return;
    uint32_t number = add_connection(w, input);
    if (number != UINT32_MAX && flags & IS_ROOT && is_shader(w, input))
        w->met.items[number].flags |= IS_PUBLIC;
}

/* ---- Nodes ---- */

static bool is_closure(const struct walk *w, doc_type type)
{
    ir_type_id ir = library_type_ir(w->lib, type);
    return ir_type_is_closure(ir) || ir_type_is_shader(ir);
}

static bool is_default(const struct walk *w, const struct port *port, str_id text,
                       const struct ir_value *value)
{
    struct ir_value usual;
    if (!(port->flags & PORT_HAS_VALUE) || !port->value)
        return false;
    return text == port->value
           || (parse(w, port->type, port->value, &usual) && ir_value_equal(value, &usual));
}

/*
 * A literal that is what the input would be if the document did not mention it: the default, or one
 * of the uniforms that the complete interface makes of all inputs; and of closures and shaders,
 * which have none, nothing.
 */
static bool is_as_unset(struct walk *w, elem_id input, const struct port *port, bool is_public)
{
    const struct element *e = doc_element(w->doc, input);
    const struct attribute *attrs = doc_attrs(w->doc, input);
    str_id text = doc_attr_value(w->doc, input, STR_value);
    struct ir_value value;
    if (type_of(w, input) != port->type)
        return false;
    for (uint32_t i = 0; i < e->num_attrs; i++)
        if (!is_left_out(attrs[i].name, false) && attrs[i].name != STR_type
            && attrs[i].name != STR_value)
            return false;
    if (is_closure(w, port->type))
        return true;
    if (port->geomprop || !text || !parse(w, port->type, text, &value)
        || (is_color(port->type) && space_of(w, input)))
        return false;
    if (is_public && w->options->interface != INTERFACE_COMPLETE)
        return false;
    return is_uniform(w, is_public, &value) || is_default(w, port, text, &value);
}

/*
 * Most nodes have their inputs in the definition's order: the search goes on where it ended. `n`:
 * there is none of that name.
 */
static unsigned find_port(const struct port *ports, unsigned n, unsigned start, str_id name)
{
    for (unsigned tried = 0; tried < n; tried++) {
        unsigned port = start + tried < n ? start + tried : start + tried - n;
        if (ports[port].name == name)
            return port;
    }
    return n;
}

/*
 * The node's inputs by port. Outputs say nothing that the definition does not; anything else is
 * left to a generation.
 */
static elem_id *sort_inputs(struct walk *w, elem_id node, const struct port *ports, unsigned n)
{
    elem_id *inputs = ARENA_ARRAY(w->arena, elem_id, n);
    unsigned port = 0;
    for (elem_id child = doc_element(w->doc, node)->first_child; child;
         child = doc_element(w->doc, child)->next) {
        const struct element *e = doc_element(w->doc, child);
        bool is_output = e->kind == KIND_OUTPUT && type_of(w, child) != DOC_TYPE_NONE;
        port = e->kind == KIND_INPUT ? find_port(ports, n, port, e->name) : n;
        w->is_unknown |= e->first_child || (!is_output && (port == n || inputs[port]));
        if (w->is_unknown)
            break;
        if (!is_output)
            inputs[port] = child;
    }
    return inputs;
}

static void add_node(struct walk *w, elem_id node, uint8_t flags)
{
    uint32_t nodedef = library_match(w->lib, node, &w->faults);
    w->is_unknown |= nodedef == LIBRARY_NONE || w->faults.items.len;
    if (w->is_unknown)
        return;
    unsigned n = library_nodedef(w->lib, nodedef)->num_inputs;
    const struct port *ports = library_ports(w->lib, nodedef, NULL);
    elem_id *inputs = sort_inputs(w, node, ports, n);
    add(w, nodedef);
    for (unsigned i = 0; i < n && !w->is_unknown; i++)
        if (inputs[i] && !is_as_unset(w, inputs[i], &ports[i], flags & IS_PUBLIC)) {
            mark(w, MARK_INPUT, i);
            add_input(w, inputs[i], flags);
        }
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

/*
 * Inputs of graphs belong to the interface, too. What is around an element says nothing that is not
 * asked for from below.
 */
static void add_element(struct walk *w, uint32_t number)
{
    struct met met = w->met.items[number];
    const struct element *e = doc_element(w->doc, met.element);
    bool in_graph = e->parent && doc_element(w->doc, e->parent)->kind == KIND_NODEGRAPH,
         of_graph = e->kind == KIND_INPUT && in_graph;
    w->is_unknown |= in_graph && doc_attr(w->doc, e->parent, STR_nodedef);
    mark(w, MARK_ELEMENT, (uint32_t)e->kind << 8 | (of_graph || met.flags & IS_PUBLIC));
    bool is_connected = add_attributes(w, met.element, of_graph || met.flags & IS_PUBLIC);
    if (e->kind == KIND_NODE)
        add_node(w, met.element, met.flags);
    else if (number == 0 && is_connected)
        add_output(w, met.element);
    mark(w, MARK_END, 0);
}

/* Definitions of the document's own, and graphs that implement one, are left to a generation. */
static bool has_definitions(const struct library *layer)
{
    return layer->nodedefs.len || layer->impls.len || layer->geomprops.len || layer->types.len;
}

uint64_t build_structure(const struct library *lib, const struct structure_options *options,
                         elem_id element, unsigned output, struct arena *scratch)
{
    struct walk w = {.lib = lib,
                     .doc = &lib->doc,
                     .options = options,
                     .arena = scratch,
                     .hash = hash_mix(options->seed, output),
                     .is_unknown = has_definitions(lib)};
    diag_list_init(&w.faults, scratch);
    number_of(&w, element);
    if (doc_element(w.doc, element)->kind == KIND_NODE)
        w.met.items[0].flags = IS_PUBLIC | IS_ROOT;
    for (uint32_t i = 0; i < w.met.len && !w.is_unknown; i++)
        add_element(&w, i);
    return w.is_unknown ? 0 : w.hash ? w.hash : 1;
}
