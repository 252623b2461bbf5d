// SPDX-License-Identifier: Apache-2.0
/*
 * The nodes of a definition's nodegraph in the place of a node. They mean there what they meant in
 * the definition: inputs of the definition become those of the node, or their defaults, and what
 * elements around the graph say about colours and files becomes part of each value.
 */
#include "api/edit.h"

struct copied {
    elem_id original, copy;
};

/* A node that gives a geometric property, the default of an input of the definition. */
struct property_node {
    const struct geomprop *property;
    elem_id node;
};

struct flattening {
    struct edit_change *c; /* `element` is the node */
    struct library view;   /* the tree of the edit, with the definitions that it knows */
    uint32_t nodedef;
    elem_id graph;
    VEC(struct copied) copies;
    VEC(struct property_node) properties;
};

static struct document *tree_of(struct flattening *f)
{
    return edit_tree(f->c->edit);
}

/* Each change may move the arrays of the tree. */
static const struct library *view_of(struct flattening *f)
{
    edit_view(f->c->edit, &f->view);
    return &f->view;
}

static struct arena *arena_of(struct flattening *f)
{
    return &f->c->edit->document->object.arena;
}

/* ---- Which graph ---- */

static elem_id first_graph(const struct library *lib, uint32_t impl)
{
    for (const struct implementation *i; impl != LIBRARY_NONE; impl = i->next) {
        i = library_impl(lib, impl, NULL);
        if (i->kind == IMPL_GRAPH && !i->target)
            return i->ref;
    }
    return 0;
}

elem_id edit_find_graph(const struct library *lib, uint32_t nodedef)
{
    elem_id graph = 0;
    for (const struct library *layer = lib; layer && !graph; layer = layer->base)
        graph = first_graph(lib, library_first_override(layer, nodedef));
    return graph ? graph : first_graph(lib, library_nodedef(lib, nodedef)->first_impl);
}

static elem_id first_token(struct flattening *f)
{
    const struct document *doc = tree_of(f);
    elem_id e = doc_element(doc, library_nodedef(view_of(f), f->nodedef)->element)->first_child;
    while (e && doc_element(doc, e)->kind != KIND_TOKEN)
        e = doc_element(doc, e)->next;
    return e;
}

/* Each input of the definition may become a node with two inputs, and each node have all tokens. */
static uint64_t most_elements(struct flattening *f)
{
    const struct document *doc = tree_of(f);
    uint64_t num = 3 * (uint64_t)library_nodedef(view_of(f), f->nodedef)->num_inputs, each = 1;
    for (elem_id e = first_token(f); e; e = doc_element(doc, e)->next)
        each++;
    for (elem_id e = f->graph; e; e = doc_next_in_tree(doc, f->graph, e))
        num += each;
    return num;
}

/* False after a reason. */
static bool find(struct flattening *f)
{
    struct edit_change *c = f->c;
    if (!edit_check_element(c, &c->element, false))
        return false;
    f->nodedef = edit_find_definition(c, c->element, &f->view);
    f->graph = f->nodedef == LIBRARY_NONE ? 0 : edit_find_graph(view_of(f), f->nodedef);
    if (!f->graph)
        edit_fail(c, "no nodegraph implements the definition of '%s'",
                  edit_label(c->edit, c->element));
    else if (doc_is_within(tree_of(f), c->element, f->graph))
        edit_fail(c, "'%s' is a part of its own definition", edit_label(c->edit, c->element));
    else
        edit_check_flat(c, view_of(f), f->nodedef, f->graph);
    return !c->failed && edit_check_room(c, most_elements(f));
}

/* ---- Names ---- */

/* "node_name", with a number if the scope has that name already. */
static str_id free_name(struct flattening *f, str_id name)
{
    const struct document *doc = tree_of(f);
    const struct element *node = doc_element(doc, f->c->element);
    struct text text;
    text_init(&text, arena_of(f));
    text_fmt(&text, "%s_%s", str_text(doc->strings, node->name), str_text(doc->strings, name));
    size_t len = text.len;
    for (unsigned i = 2; edit_child(f->c->edit, node->parent, text_cstr(&text)); i++) {
        text.len = len;
        text_fmt(&text, "%u", i);
    }
    return edit_word(f->c, text_cstr(&text));
}

/* The copy of an element of the graph; 0: none has the name. */
static elem_id copy_of(struct flattening *f, str_id name)
{
    elem_id original = name ? doc_child(tree_of(f), f->graph, name) : 0;
    for (uint32_t i = 0; i < f->copies.len && original; i++)
        if (f->copies.items[i].original == original)
            return f->copies.items[i].copy;
    return 0;
}

/* ---- Values ---- */

/* Lets an attribute that elements inherit have the value `wanted`; 0: none, which is `none`. */
static void keep_inherited(struct flattening *f, elem_id port, str_id attr, str_id wanted,
                           str_id none)
{
    if (doc_inherited_attr(tree_of(f), port, attr) != wanted)
        doc_set_attr(tree_of(f), port, attr, wanted ? wanted : none);
}

static void keep_meaning(struct flattening *f, elem_id port, elem_id original)
{
    const struct document *doc = tree_of(f);
    doc_type type = doc_type_of(doc_attr_value(doc, port, STR_type));
    if (doc_type_is_color(type) || type == DOC_TYPE_filename)
        keep_inherited(f, port, STR_colorspace, doc_inherited_attr(doc, original, STR_colorspace),
                       STR_none);
    if (type == DOC_TYPE_filename)
        keep_inherited(f, port, STR_fileprefix, doc_inherited_attr(doc, original, STR_fileprefix),
                       STR_EMPTY);
}

/* The values below a copied element, which has the same tree as the original. */
static void keep_meanings(struct flattening *f, elem_id copy, elem_id original)
{
    const struct document *doc = tree_of(f);
    for (elem_id e = copy, o = original; e;
         e = doc_next_in_tree(doc, copy, e), o = doc_next_in_tree(doc, original, o))
        if (doc_element(doc, e)->kind == KIND_INPUT && doc_attr(doc, e, STR_value))
            keep_meaning(f, e, o);
}

static void copy_attrs(struct flattening *f, elem_id to, elem_id from, const str_id *attrs,
                       size_t num)
{
    struct document *doc = tree_of(f);
    for (size_t i = 0; i < num; i++) {
        const struct attribute *attr = doc_attr(doc, from, attrs[i]);
        if (attr)
            doc_set_attr(doc, to, attrs[i], attr->value);
    }
}

/*
 * A value in another unit than that of the definition becomes one in the latter. False: the units
 * need no change.
 */
static bool scale_value(struct flattening *f, elem_id port, elem_id from, elem_id declared)
{
    struct document *doc = tree_of(f);
    str_id unit = doc_attr_value(doc, from, STR_unit), to = doc_attr_value(doc, declared, STR_unit),
           kind = doc_attr_value(doc, declared, STR_unittype),
           text = doc_attr_value(doc, from, STR_value);
    doc_type type = doc_type_of(doc_attr_value(doc, from, STR_type));
    float scale, base;
    struct ir_value value;
    struct text made;
    if (!unit || !to || !library_unit_scale(view_of(f), kind, unit, &scale)
        || !library_unit_scale(view_of(f), kind, to, &base) || !ir_type_is_float(doc_type_ir(type))
        || !doc_parse_value(type, str_text(doc->strings, text), str_len(doc->strings, text), NULL,
                            &value))
        return false;
    text_init(&made, arena_of(f));
    for (unsigned i = 0; i < ir_type_components(value.type); i++) {
        text_str(&made, i ? ", " : "");
        text_float(&made, value.w[i].f * (scale / base));
    }
    doc_set_attr(doc, port, STR_value, edit_word(f->c, text_cstr(&made)));
    return true;
}

/* ---- Inputs of the definition ---- */

static bool has_source(const struct document *doc, elem_id port)
{
    return doc_attr_value(doc, port, STR_nodename) || doc_attr_value(doc, port, STR_nodegraph)
           || doc_attr_value(doc, port, STR_interfacename)
           || (doc_element(doc, port)->kind == KIND_INPUT && doc_attr_value(doc, port, STR_output));
}

/* A port takes over what the input of the node has. */
static void take_input(struct flattening *f, elem_id port, elem_id from, const struct port *input)
{
    static const str_id values[] = {STR_value, STR_unit, STR_unittype};
    struct document *doc = tree_of(f);
    bool is_file = input->type == DOC_TYPE_filename,
         port_says = doc_attr(doc, port, STR_colorspace) != NULL;
    if (has_source(doc, from)) {
        copy_attrs(f, port, from, doc_connections, DOC_NUM_CONNECTIONS);
        if (is_file && !port_says)
            copy_attrs(f, port, from, (const str_id[]){STR_colorspace}, 1);
        if (is_file && !doc_attr(doc, port, STR_unit))
            copy_attrs(f, port, from, values + 1, 2);
        return;
    }
    if (!scale_value(f, port, from, input->element))
        copy_attrs(f, port, from, values, sizeof values / sizeof *values);
    /*
     * An attribute of the input goes before one of the port, except of a file, and that before
     * those of its ancestors.
     */
    if (!port_says || (!is_file && doc_attr(doc, from, STR_colorspace)))
        keep_meaning(f, port, from);
}

/*
 * The default of an input of the definition. Colours and files of a library are in the working
 * space, if they say no other.
 */
static void take_default(struct flattening *f, elem_id port, const struct port *input)
{
    struct document *doc = tree_of(f);
    bool is_file = input->type == DOC_TYPE_filename,
         port_says = doc_attr(doc, port, STR_colorspace) != NULL,
         says = input->element >= doc->first_element
                || doc_attr_value(doc, input->element, STR_colorspace);
    doc_set_attr(doc, port, STR_value, input->value);
    if (says && !port_says)
        keep_meaning(f, port, input->element);
    else if (!port_says && (is_file || doc_type_is_color(input->type)))
        keep_inherited(f, port, STR_colorspace, STR_EMPTY, STR_none);
    if (is_file)
        keep_inherited(f, port, STR_fileprefix,
                       doc_inherited_attr(doc, input->element, STR_fileprefix), STR_EMPTY);
}

static void add_input(struct flattening *f, elem_id node, const char *name, const char *type,
                      const char *value)
{
    elem_id input = edit_add(f->c, node, "input", name, type);
    doc_set_attr(tree_of(f), input, STR_value, edit_word(f->c, value));
}

/* The node that gives a geometric property, beside the others. */
static elem_id property_node(struct flattening *f, const struct geomprop *property)
{
    struct document *doc = tree_of(f);
    for (uint32_t i = 0; i < f->properties.len; i++)
        if (f->properties.items[i].property == property)
            return f->properties.items[i].node;
    bool has_node = property->nodedef != LIBRARY_NONE;
    const char *category = has_node ? str_text(doc->strings, property->geomprop) : "geompropvalue";
    const char *type = str_text(doc->strings, library_type_name(view_of(f), property->type));
    elem_id node = edit_add(f->c, doc_element(doc, f->c->element)->parent, category,
                            str_text(doc->strings, free_name(f, property->name)), type);
    if (!has_node)
        add_input(f, node, "geomprop", "string", str_text(doc->strings, property->name));
    if (has_node && property->space)
        add_input(f, node, "space", "string", str_text(doc->strings, property->space));
    if (has_node && property->index) {
        struct text index;
        text_init(&index, arena_of(f));
        text_u32(&index, property->index);
        add_input(f, node, "index", "integer", text_cstr(&index));
    }
    doc_move_before(doc, node, f->copies.len ? f->copies.items[0].copy : f->c->element);
    vec_push(arena_of(f), &f->properties, (struct property_node){property, node});
    return node;
}

/* The property that the port has by itself, without a source; NULL: none. */
static const struct geomprop *own_property(struct flattening *f, elem_id port)
{
    const struct document *doc = tree_of(f);
    elem_id node = doc_element(doc, port)->parent;
    struct library view;
    uint32_t nodedef = edit_find_definition(f->c, node, &view);
    int index = nodedef == LIBRARY_NONE
                    ? -1
                    : library_find_input(&view, nodedef, doc_element(doc, port)->name);
    str_id name = index < 0 ? STR_EMPTY : library_ports(&view, nodedef, NULL)[index].geomprop;
    return name ? library_geomprop(&view, name) : NULL;
}

/* Takes the default property of the geometry. A port that has it by itself is left out. */
static void take_property(struct flattening *f, elem_id port, const struct port *input)
{
    const struct geomprop *property = library_geomprop(view_of(f), input->geomprop);
    if (property && property == own_property(f, port)) {
        doc_remove_element(tree_of(f), port);
    } else if (property) {
        elem_id node = property_node(f, property);
        doc_set_attr(tree_of(f), port, STR_nodename, doc_element(tree_of(f), node)->name);
    }
}

/*
 * A string that names a file: its text has no prefix, and the file has the colour space of the
 * port.
 */
static void take_name(struct flattening *f, elem_id port, elem_id original, elem_id from,
                      const struct port *input)
{
    struct document *doc = tree_of(f);
    if (from && has_source(doc, from)) {
        copy_attrs(f, port, from, doc_connections, DOC_NUM_CONNECTIONS);
    } else {
        const struct attribute *value = from ? doc_attr(doc, from, STR_value) : NULL;
        doc_set_attr(doc, port, STR_value, value ? value->value : input->value);
        keep_inherited(f, port, STR_fileprefix, STR_EMPTY, STR_EMPTY);
    }
    keep_inherited(f, port, STR_colorspace, doc_inherited_attr(doc, original, STR_colorspace),
                   STR_none);
}

/*
 * Gives a port, which names no source any more, what an input of the definition has here; it is the
 * copy of `original`.
 */
static void take(struct flattening *f, elem_id port, elem_id original, str_id name)
{
    const struct document *doc = tree_of(f);
    int index = library_find_input(view_of(f), f->nodedef, name);
    const struct port *input =
        index < 0 ? NULL : &library_ports(view_of(f), f->nodedef, NULL)[index];
    elem_id from = doc_child_of_kind(doc, f->c->element, KIND_INPUT, name);
    bool has_value = from && doc_attr(doc, from, STR_value);
    if (!input)
        return;
    if (input->type == DOC_TYPE_string && doc_attr_value(doc, port, STR_type) == STR_filename)
        take_name(f, port, original, from, input);
    else if (from && (has_source(doc, from) || (has_value && !input->geomprop)))
        take_input(f, port, from, input);
    else if (input->geomprop)
        take_property(f, port, input);
    else if (input->flags & PORT_HAS_VALUE)
        take_default(f, port, input);
}

/* ---- Copies ---- */

/* A port takes what another one, in the graph, has. */
static void connect(struct flattening *f, elem_id port, elem_id original)
{
    static const str_id values[] = {STR_value, STR_output};
    struct document *doc = tree_of(f);
    str_id interface = doc_attr_value(doc, original, STR_interfacename);
    elem_id node = copy_of(f, doc_attr_value(doc, original, STR_nodename)),
            graph = copy_of(f, doc_attr_value(doc, original, STR_nodegraph));
    doc_disconnect(doc, port);
    doc_remove_attr(doc, port, STR_value);
    if (interface)
        take(f, port, original, interface);
    else
        copy_attrs(f, port, original, values, sizeof values / sizeof *values);
    if (node || graph)
        doc_set_attr(doc, port, node ? STR_nodename : STR_nodegraph,
                     doc_element(doc, node ? node : graph)->name);
    if (doc_has_element(doc, port))
        doc_index_change(doc, port);
}

/* ---- Tokens ---- */

static bool names_token(const struct document *doc, elem_id node)
{
    bool names = false;
    for (elem_id e = node; e && !names; e = doc_next_in_tree(doc, node, e))
        names = strchr(str_text(doc->strings, doc_attr_value(doc, e, STR_value)), '[') != NULL;
    return names;
}

/* The token of the node, or else of its definition; 0: none has the name. */
static elem_id find_token(struct flattening *f, str_id name)
{
    elem_id definition = library_nodedef(view_of(f), f->nodedef)->element;
    elem_id own = doc_child_of_kind(tree_of(f), f->c->element, KIND_TOKEN, name);
    return own ? own : doc_child_of_kind(tree_of(f), definition, KIND_TOKEN, name);
}

/* A token of a copy that stands for one of the definition has what that one has. */
static void take_token(struct flattening *f, elem_id token)
{
    static const str_id attrs[] = {STR_value, STR_interfacename};
    str_id name = doc_attr_value(tree_of(f), token, STR_interfacename);
    elem_id from = name ? find_token(f, name) : 0;
    if (from) {
        doc_remove_attr(tree_of(f), token, STR_interfacename);
        copy_attrs(f, token, from, attrs, sizeof attrs / sizeof *attrs);
    }
}

/* Gives a copy the tokens that the names of its files had in the definition. */
static void add_tokens(struct flattening *f, elem_id copy)
{
    struct document *doc = tree_of(f);
    for (elem_id e = doc_element(doc, copy)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_TOKEN)
            take_token(f, e);
    for (elem_id e = names_token(doc, copy) ? first_token(f) : 0; e;
         e = doc_element(doc, e)->next) {
        str_id name = doc_element(doc, e)->name;
        if (doc_element(doc, e)->kind == KIND_TOKEN && !doc_child(doc, copy, name))
            doc_copy_element(doc, copy, doc, find_token(f, name), STR_EMPTY);
    }
}

static void copy_nodes(struct flattening *f)
{
    struct document *doc = tree_of(f);
    elem_id node = f->c->element, scope = doc_element(doc, node)->parent;
    for (elem_id e = doc_element(doc, f->graph)->first_child; e; e = doc_element(doc, e)->next) {
        uint16_t kind = doc_element(doc, e)->kind;
        if (kind != KIND_NODE && kind != KIND_NODEGRAPH)
            continue;
        elem_id copy =
            doc_copy_element(doc, scope, doc, e, free_name(f, doc_element(doc, e)->name));
        doc_move_before(doc, copy, node);
        keep_meanings(f, copy, e);
        add_tokens(f, copy);
        vec_push(arena_of(f), &f->copies, (struct copied){e, copy});
    }
}

static void connect_copies(struct flattening *f)
{
    const struct document *doc = tree_of(f);
    for (uint32_t i = 0; i < f->copies.len; i++) {
        elem_id original = doc_element(doc, f->copies.items[i].original)->first_child;
        /* a copy may have tokens behind what the original has */
        for (elem_id e = doc_element(doc, f->copies.items[i].copy)->first_child, next; original;
             e = next, original = doc_element(doc, original)->next) {
            next = doc_element(doc, e)->next;
            if (doc_element(doc, e)->kind == KIND_INPUT && has_source(doc, original))
                connect(f, e, original);
        }
    }
}

/* ---- Users ---- */

static elem_id output_of(struct flattening *f, int index)
{
    return library_inner_output(view_of(f), f->nodedef, (unsigned)index, tree_of(f), f->graph);
}

static void connect_user(void *arg, elem_id user, str_id attr)
{
    struct flattening *f = arg;
    str_id name = doc_attr_value(tree_of(f), user, STR_output);
    int index = name ? library_find_output(view_of(f), f->nodedef, name) : 0;
    elem_id output = attr == STR_nodename && index >= 0 ? output_of(f, index) : 0;
    if (output)
        connect(f, user, output);
}

/* The node behind the only output, which gets the name of the flattened one; 0: there is none. */
static elem_id find_heir(struct flattening *f)
{
    struct document *doc = tree_of(f);
    bool is_only = library_nodedef(view_of(f), f->nodedef)->num_outputs == 1;
    elem_id output = is_only ? output_of(f, 0) : 0;
    return output ? copy_of(f, doc_attr_value(doc, output, STR_nodename)) : 0;
}

static void flatten(void *arg)
{
    struct flattening f = {.c = arg};
    if (!find(&f))
        return;
    struct document *doc = tree_of(&f);
    str_id name = doc_element(doc, f.c->element)->name;
    copy_nodes(&f);
    connect_copies(&f);
    doc_visit_users(doc, f.c->element, connect_user, &f);
    elem_id heir = find_heir(&f);
    if (!heir)
        edit_replace_in_frames(f.c, f.c->element, 0);
    doc_remove_element(doc, f.c->element);
    if (heir)
        doc_rename(doc, heir, name);
}

mxg_status mxg_edit_flatten_node(mxg_edit *edit, mxg_element node)
{
    struct edit_change change = {.edit = edit, .element = node};
    return edit ? edit_run(&change, flatten) : MXG_ERROR_ARGUMENT;
}
