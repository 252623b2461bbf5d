// SPDX-License-Identifier: Apache-2.0
/* Where a connection ends: constants, uniforms, textures, geometric properties, defaults. */
#include "build/build_priv.h"

#include "base/num.h"

static const struct document *doc_of(const struct builder *b)
{
    return &b->lib->doc;
}

/* ---- constants ---- */

/* An enum's name stands for the value in the same place of enumvalues. */
static str_id enum_value(struct builder *b, const struct port *port, str_id text)
{
    str_id names = doc_attr_value(doc_of(b), port->element, STR_enum);
    str_id values = doc_attr_value(doc_of(b), port->element, STR_enumvalues);
    if (!names || !values)
        return 0;
    const char *name = build_text(b, names), *value = build_text(b, values),
               *word = build_text(b, text);
    size_t len = strlen(word);
    while (*name) {
        size_t n = strcspn(name, ","), m = strcspn(value, ",");
        while (*name == ' ') {
            name++;
            n--;
        }
        if (n == len && memcmp(name, word, len) == 0)
            return str_intern(b->shader->strings, value, m);
        name += n + (name[n] == ',');
        value += m + (value[m] == ',');
    }
    return 0;
}

static bool parse(struct builder *b, doc_type type, str_id text, const struct port *port,
                  struct ir_value *out)
{
    const char *z = build_text(b, text);
    if (doc_parse_value(type, z, str_len(b->shader->strings, text), b->shader->strings, out))
        return true;
    str_id value = port && (port->flags & PORT_ENUM) ? enum_value(b, port, text) : 0;
    return value
           && doc_parse_value(type, build_text(b, value), str_len(b->shader->strings, value), NULL,
                              out);
}

/*
 * The constant that attribute `value` of an element says; poison and a diagnostic where it does not
 * parse.
 */
static ir_ref constant(struct builder *b, const struct port *port, str_id text, elem_id element)
{
    ir_type_id ir = library_type_ir(b->lib, port->type);
    struct ir_value value;
    if (ir == IR_TYPE_STRING) {
        library_check_enum(b->lib, port, text, doc_attr_place(doc_of(b), element, STR_value),
                           b->diags);
        return ir_const_string(b->graph, text);
    }
    if (parse(b, port->type, text, port, &value))
        return ir_const(b->graph, &value);
    diag_add(b->diags, DIAG_ID_bad_value, doc_attr_place(doc_of(b), element, STR_value),
             build_text(b, text), build_text(b, library_type_name(b->lib, port->type)),
             doc_value_fault(port->type, build_text(b, text), str_len(&b->lib->strings, text),
                             b->diags->arena));
    return ir_poison(b->graph, ir);
}

/* ---- interface ---- */

/*
 * Goes back to what stands in front of the names of an owner's inputs; true where that is to be
 * written.
 */
static bool begin_text(struct builder *b, struct build_prefix *prefix, elem_id owner)
{
    bool is_known = prefix->text.arena && prefix->owner == owner;
    if (!prefix->text.arena)
        text_init(&prefix->text, b->arena);
    prefix->text.len = is_known ? prefix->len : 0;
    prefix->owner = owner;
    return !is_known;
}

static str_id end_text(struct builder *b, struct text *text, str_id name)
{
    text_mem(text, build_text(b, name), str_len(b->shader->strings, name));
    return str_intern(b->shader->strings, text->data, text->len);
}

str_id build_input_path(struct builder *b, elem_id node, str_id input, elem_id element)
{
    struct text *path = &b->path.text;
    elem_id owner = element ? doc_element(doc_of(b), element)->parent : node;
    if (begin_text(b, &b->path, owner)) {
        doc_path(doc_of(b), owner, '/', path);
        if (path->len)
            text_char(path, '/');
        b->path.len = path->len;
    }
    return end_text(b, path, element ? doc_element(doc_of(b), element)->name : input);
}

struct glob_retry { /* where to go on when what stands behind a star does not match */
    const char *glob, *path;
};

bool build_glob_matches(const char *glob, const char *path)
{
    struct glob_retry star = {0}, deep = {0}; /* the last '*' since the last '**', and that */
    while (*glob || *path) {
        if (*glob == '*') {
            bool is_deep = glob[1] == '*';
            glob += is_deep ? 2 : 1;
            *(is_deep ? &deep : &star) = (struct glob_retry){glob, path};
            if (is_deep)
                star.glob = NULL;
        } else if (*path && (*glob == *path || (*glob == '?' && *path != '/'))) {
            glob++;
            path++;
        } else if (star.glob && *star.path && *star.path != '/') {
            glob = star.glob;
            path = ++star.path;
        } else if (deep.glob && *deep.path) {
            star.glob = NULL;
            glob = deep.glob;
            path = ++deep.path;
        } else {
            return false;
        }
    }
    return true;
}

static bool any_glob(const char *const *globs, unsigned n, const char *path)
{
    for (unsigned i = 0; i < n; i++)
        if (build_glob_matches(globs[i], path))
            return true;
    return false;
}

/*
 * True for inputs of the shader nodes and of the document's graphs: those that the interface mode
 * is about.
 */
static bool is_public(const struct builder *b, elem_id node)
{
    if (doc_element(doc_of(b), node)->kind == KIND_NODEGRAPH)
        return true;
    for (uint32_t i = 0; i < b->public_nodes.len; i++)
        if (b->public_nodes.items[i] == node)
            return true;
    return false;
}

static bool stays_variable(const struct builder *b, elem_id node, bool authored, str_id path)
{
    const struct build_options *o = b->options;
    if (o->num_constant_globs
        && any_glob(o->constant_globs, o->num_constant_globs, build_text(b, path)))
        return false;
    if (o->num_uniform_globs
        && any_glob(o->uniform_globs, o->num_uniform_globs, build_text(b, path)))
        return true;
    if (o->interface == INTERFACE_REDUCED || !is_public(b, node))
        return false;
    return o->interface == INTERFACE_COMPLETE || authored;
}

/*
 * "SR_gold_base_color": the path's last two names; or "base_color", as long as there is one of it.
 */
static str_id variable_name(struct builder *b, elem_id node, str_id input)
{
    if (b->options->short_names && shader_name_is_free(b->shader, input))
        return input;
    struct text *name = &b->name.text;
    if (begin_text(b, &b->name, node)) {
        text_str(name, build_text(b, doc_element(doc_of(b), node)->name));
        text_char(name, '_');
        b->name.len = name->len;
    }
    return end_text(b, name, input);
}

static str_id element_attr(const struct builder *b, elem_id element, str_id name)
{
    return element ? doc_attr_value(doc_of(b), element, name) : 0;
}

static struct shader_variable describe(struct builder *b, elem_id node, const struct port *port,
                                       elem_id element, str_id input, str_id path)
{
    return (struct shader_variable){
        .name = variable_name(b, node, input),
        .type = library_type_ir(b->lib, port->type),
        .doc_type = library_type_name(b->lib, port->type),
        .path = path,
        .element = element ? element : node,
        .definition = port->element,
        .colorspace = element ? doc_inherited_attr(doc_of(b), element, STR_colorspace) : 0,
        .unit = element_attr(b, element, STR_unit),
        .unittype = element_attr(b, element, STR_unittype),
    };
}

static ir_ref add_uniform(struct builder *b, struct shader_variable v, ir_ref initial)
{
    v.block = BLOCK_PUBLIC_UNIFORMS;
    v.update = UPDATE_UNIFORM;
    v.has_default = ir_get_const(b->graph, initial, &v.value);
    uint32_t index = shader_add_variable(b->shader, &v);
    return ir_build(b->graph, IR_UNIFORM, v.type, index, NULL, 0);
}

/*
 * A literal or default of an input of a node of the document: uniform or constant as the interface
 * says.
 */
static ir_ref publish(struct builder *b, elem_id node, const struct port *port, elem_id element,
                      str_id input, ir_ref value, bool authored)
{
    ir_type_id type = ir_type_of(b->graph, value);
    bool can_vary = type != IR_TYPE_STRING && ir_is_const(b->graph, value);
    if (!can_vary && !(type == IR_TYPE_STRING && is_public(b, node)))
        return value;
    str_id path = build_input_path(b, node, input, element);
    if (can_vary && stays_variable(b, node, authored, path))
        return add_uniform(b, describe(b, node, port, element, input, path), value);
    if (authored && is_public(b, node))
        vec_push(b->arena, &b->shader->compiled,
                 (struct shader_compiled_input){path, library_type_name(b->lib, port->type),
                                                element_attr(b, element, STR_value), element});
    return value;
}

bool build_initial(const struct builder *b, ir_ref value, struct ir_value *out)
{
    const struct ir_node *node = ir_get(b->graph, value);
    const struct shader_variable *uniform =
        node->op == IR_UNIFORM ? &b->shader->variables.items[node->attr] : NULL;
    if (uniform)
        *out = uniform->value;
    return uniform ? uniform->has_default : ir_get_const(b->graph, value, out);
}

/* ---- textures ---- */

static ir_ref texture(struct builder *b, const struct instance *scope, elem_id node,
                      const struct port *port, elem_id element, str_id input)
{
    struct shader_variable v =
        describe(b, node, port, element, input, build_input_path(b, node, input, element));
    v.file = element ? build_file_name(b, scope, element) : port->value;
    return build_texture(b, v, element ? element : node);
}

/* ---- defaults ---- */

static ir_ref geomprop_arg(struct builder *b, const struct geomprop *prop, const struct port *port)
{
    if (port->name == STR_space && prop->space)
        return ir_const_string(b->graph, prop->space);
    if (port->name == STR_index)
        return ir_const_int(b->graph, prop->index);
    return build_default(b, port);
}

/*
 * A property that a node gives is that node with the property's space and index; any other is a
 * stream of its name.
 */
static ir_ref make_geomprop(struct builder *b, const struct geomprop *prop)
{
    if (prop->nodedef == LIBRARY_NONE && b->recorder)
        return build_property_layer(b, prop);
    if (prop->nodedef == LIBRARY_NONE) {
        struct text name;
        text_init(&name, b->arena);
        text_fmt(&name, "geomprop_%s", build_text(b, prop->name));
        return shader_stream(b->shader, str_intern(b->shader->strings, name.data, name.len),
                             library_type_ir(b->lib, prop->type));
    }
    const struct nodedef *def = library_nodedef(b->lib, prop->nodedef);
    const struct port *ports = library_ports(b->lib, prop->nodedef, NULL);
    ir_ref *args = ARENA_ARRAY(b->arena, ir_ref, def->num_inputs);
    for (uint32_t i = 0; i < def->num_inputs; i++)
        args[i] = geomprop_arg(b, prop, &ports[i]);
    ir_push_name(b->graph, b->recorder ? prop->name : prop->geomprop);
    ir_ref results[BUILD_MAX_OUTPUTS];
    build_apply(b, prop->nodedef, prop->element, args, results);
    ir_pop_origin(b->graph);
    return results[0];
}

ir_ref build_geomprop(struct builder *b, str_id name, doc_type type, struct diag_place place)
{
    for (uint32_t i = 0; i < b->geomprops.len; i += 2)
        if (b->geomprops.items[i] == name)
            return b->geomprops.items[i + 1];
    const struct geomprop *prop = library_geomprop(b->lib, name);
    if (!prop) {
        diag_add(b->diags, DIAG_ID_unknown_geomprop, place, build_text(b, name), "");
        return ir_poison(b->graph, library_type_ir(b->lib, type));
    }
    ir_ref value = make_geomprop(b, prop);
    vec_push(b->arena, &b->geomprops, name);
    vec_push(b->arena, &b->geomprops, value);
    return value;
}

static ir_ref zero(struct builder *b, ir_type_id type)
{
    struct ir_value value = {.type = type};
    return ir_const(b->graph, &value);
}

ir_ref build_default(struct builder *b, const struct port *port)
{
    if (port->geomprop)
        return build_geomprop(b, port->geomprop, port->type,
                              doc_attr_place(doc_of(b), port->element, STR_defaultgeomprop));
    ir_type_id type = library_type_ir(b->lib, port->type);
    if (type == IR_TYPE_STRING)
        return ir_const_string(b->graph, port->value);
    if (type >= IR_NUM_TYPES || !ir_type_info(type)->components) /* of no value */
        return 0;
    return port->flags & PORT_HAS_VALUE && port->value
               ? constant(b, port, port->value, port->element)
               : zero(b, type);
}

/* ---- bindings ---- */

/* The value that an element of the document or a graph says, with its colour space and unit. */
static ir_ref literal(struct builder *b, const struct instance *scope, elem_id owner,
                      const struct port *port, elem_id element, bool outermost)
{
    str_id name = doc_element(doc_of(b), element)->name;
    ir_type_id type = library_type_ir(b->lib, port->type);
    if (type == IR_TYPE_SAMPLER)
        return texture(b, scope, owner, port, element, name);
    if (ir_type_is_closure(type) || ir_type_is_shader(type))
        return 0; /* value="" is how documents write "nothing" */
    ir_ref value = constant(b, port, doc_attr_value(doc_of(b), element, STR_value), element);
    if (outermost)
        value = publish(b, owner, port, element, name, value, true);
    if (port->type == DOC_TYPE_color3 || port->type == DOC_TYPE_color4) {
        str_id space = outermost || doc_attr(doc_of(b), element, STR_colorspace)
                           ? build_colorspace(b, element)
                           : 0;
        if (space)
            value = build_color_transform(b, value, port->type, space,
                                          doc_attr_place(doc_of(b), element, STR_colorspace));
    }
    return build_unit_conversion(b, value, element, port);
}

static ir_ref unset(struct builder *b, const struct instance *scope, elem_id owner,
                    const struct port *port, elem_id element, bool outermost)
{
    if (library_type_ir(b->lib, port->type) == IR_TYPE_SAMPLER)
        return texture(b, scope, owner, port, element, port->name);
    ir_ref value = build_default(b, port);
    if (!outermost || port->geomprop || !value)
        return value;
    return publish(b, owner, port, element,
                   element ? doc_element(doc_of(b), element)->name : port->name, value, false);
}

static elem_id graph_around(const struct builder *b, elem_id element)
{
    while (element && doc_element(doc_of(b), element)->kind != KIND_NODEGRAPH)
        element = doc_element(doc_of(b), element)->parent;
    return element;
}

/*
 * A functional graph that is not used as a node, but is itself generated, has the defaults of its
 * definition.
 */
static ir_ref interface_arg(struct builder *b, struct instance *scope, const struct port *port,
                            const struct binding *binding)
{
    elem_id alone = scope->graph ? 0 : graph_around(b, binding->element);
    uint32_t nodedef = alone ? library_implemented_nodedef(b->lib, alone) : scope->nodedef;
    /* reported when the document was read */
    if (nodedef == LIBRARY_NONE && element_attr(b, alone, STR_nodedef))
        return unset(b, scope, doc_element(doc_of(b), binding->element)->parent, port,
                     binding->element, true);
    int index =
        library_resolve_interface(b->lib, binding->element, nodedef, binding, port, b->diags);
    if (index < 0)
        return ir_poison(b->graph, library_type_ir(b->lib, port->type));
    const struct port *have = library_ports(b->lib, nodedef, NULL) + index;
    return alone ? unset(b, scope, alone, have, 0, true) : scope->args[index];
}

/*
 * A value that ends here. In the document it is made once however many nodes read it, and belongs
 * to the element that says it: perhaps an interface input further up, which is what a host changes.
 */
static ir_ref end_of_chain(struct builder *b, struct instance *scope, elem_id node,
                           const struct port *port, const struct binding *binding)
{
    elem_id element = binding->element;
    bool outermost = !scope->graph;
    elem_id owner = element && doc_element(doc_of(b), element)->kind == KIND_INPUT
                        ? doc_element(doc_of(b), element)->parent
                        : node;
    uint32_t *slot = element && outermost ? &scope->slots[element - scope->first] : NULL;
    if (slot && *slot >= SLOT_RESULTS)
        return b->results.items[*slot - SLOT_RESULTS];
    bool says_value = binding->kind == BIND_VALUE;
    /* MaterialX's generators all do so, and materials depend on it */
    if (says_value && port->geomprop && owner == node) {
        diag_add(b->diags, DIAG_ID_geomprop_literal, doc_attr_place(doc_of(b), element, STR_value),
                 build_text(b, port->name), build_text(b, port->geomprop));
        says_value = false;
    }
    ir_ref value = says_value ? literal(b, scope, owner, port, element, outermost)
                              : unset(b, scope, owner, port, element, outermost);
    if (slot) {
        *slot = SLOT_RESULTS + b->results.len;
        vec_push(b->arena, &b->results, value);
    }
    return value;
}

ir_ref build_input(struct builder *b, struct instance *scope, elem_id node, const struct port *port,
                   const struct binding *binding)
{
    switch ((enum binding_kind)binding->kind) {
    case BIND_NODE: return build_result(b, scope, binding->ref, binding->output, port->type);
    case BIND_INTERFACE: return interface_arg(b, scope, port, binding);
    case BIND_ERROR: return ir_poison(b->graph, library_type_ir(b->lib, port->type));
    case BIND_VALUE:
    case BIND_DEFAULT: break;
    }
    return end_of_chain(b, scope, node, port, binding);
}
