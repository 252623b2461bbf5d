// SPDX-License-Identifier: Apache-2.0
/* Inputs of the shader's interface: their names, their paths, and which of them become uniforms. */
#include "base/hash.h"
#include "build/build_priv.h"

str_id build_input_path(struct builder *b, elem_id node, str_id input, elem_id element)
{
    struct text *path = &b->scratch;
    path->len = 0;
    doc_path(build_doc(b), element ? element : node, '/', path);
    if (!element && path->len)
        text_char(path, '/');
    if (!element)
        text_str(path, build_text(b, input));
    return str_intern(b->shader->strings, path->data, path->len);
}

struct glob_retry { /* the position to retry from, if the text after a star does not match */
    const char *glob, *path;
};

bool build_glob_matches(const char *glob, const char *path)
{
    struct glob_retry star = {0}, deep = {0}; /* the last '*' since the last '**'; the last '**' */
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
 * True for inputs of the document, its graphs and the shader nodes: the interface mode applies to
 * them.
 */
static bool is_public(const struct builder *b, elem_id node)
{
    enum element_kind kind = doc_element(build_doc(b), node)->kind;
    if (kind == KIND_MATERIALX || kind == KIND_NODEGRAPH)
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
    if (o->interface == INTERFACE_REDUCED || (!o->publish_all && !is_public(b, node)))
        return false;
    return o->interface == INTERFACE_COMPLETE || authored;
}

/*
 * The name that MaterialX's generators give the uniform (ShaderGraph::create and finalize): that of
 * the input of the generated shader or graph; else the node that reads the value and its input. A
 * value in another colour space belongs to the input of the node that converts it.
 */
static str_id materialx_name(struct builder *b, elem_id owner, str_id input)
{
    bool is_of_graph = owner == b->root_graph || !b->reader.node;
    elem_id node = is_of_graph ? owner : b->reader.node;
    input = is_of_graph ? input : b->reader.input;
    bool is_root = is_public(b, node) && !b->reader.transforms;
    if (is_root && shader_name_is_free(b->shader, input))
        return input;
    struct text *name = &b->scratch;
    name->len = 0;
    text_fmt(name, "%s_%s%s", build_text(b, doc_element(build_doc(b), node)->name),
             build_text(b, input), b->reader.transforms ? "_cm_in" : "");
    return str_intern(b->shader->strings, name->data, name->len);
}

/*
 * A variable name: the last two names of the path, "SR_gold_base_color"; with short names
 * "base_color", if it is unique; in a stack with its slot, "050_SR_gold_base_color".
 */
static str_id variable_name(struct builder *b, elem_id node, str_id input)
{
    bool has_own_scope = b->options->caps & CAP_SCOPED_PARAMETERS;
    if (b->options->publish_all && !has_own_scope && !b->slot)
        return materialx_name(b, node, input);
    if (!b->slot && has_own_scope && shader_name_is_free(b->shader, input))
        return input;
    struct text *name = &b->scratch;
    name->len = 0;
    str_id owner = doc_element(build_doc(b), node)->name; /* 0: the document */
    if (b->slot)                                          /* layers may share nodes */
        text_fmt(name, "%s_", build_text(b, b->slot));
    if (owner)
        text_fmt(name, "%s_", build_text(b, owner));
    text_str(name, build_text(b, input));
    return str_intern(b->shader->strings, name->data, name->len);
}

static str_id element_attr(const struct builder *b, elem_id element, str_id name)
{
    return element ? doc_attr_value(build_doc(b), element, name) : 0;
}

struct shader_variable build_describe(struct builder *b, elem_id node, const struct port *port,
                                      elem_id element, str_id input, str_id path)
{
    return (struct shader_variable){
        .name = variable_name(b, node, input),
        .type = build_type(b, port->type),
        .doc_type = library_type_name(b->lib, port->type),
        .path = path,
        .slot = b->slot,
        .element = element ? element : node,
        .definition = port->element,
        .colorspace = element ? doc_inherited_attr(build_doc(b), element, STR_colorspace) : 0,
        .unit = element_attr(b, element, STR_unit),
        .unittype = element_attr(b, element, STR_unittype),
    };
}

static ir_ref add_uniform(struct builder *b, struct shader_variable v, ir_ref initial)
{
    assert(ir_is_const(b->graph, initial) && ir_type_of(b->graph, initial) == v.type);
    v.block = BLOCK_PUBLIC_UNIFORMS;
    v.update = UPDATE_UNIFORM;
    v.has_default = ir_get_const(b->graph, initial, &v.value);
    uint32_t index = shader_add_variable(b->shader, &v);
    return ir_build(b->graph, IR_UNIFORM, v.type, index, NULL, 0);
}

/*
 * The nodes of a graph are built once per use, so an input may come again. An element has one value
 * for all its readers; without an element, each input of the node has its own.
 */
static bool is_known(struct builder *b, const struct shader_compiled_input *input, bool has_element)
{
    uint32_t hash = hash_pair(input->element, has_element ? 0 : input->definition);
    for (uint32_t at = hash, found; (found = table_next(&b->compiled, hash, &at));) {
        const struct shader_compiled_input *other =
            &b->shader->reflection.compiled.items[found - 1];
        if (other->element == input->element
            && (has_element || other->definition == input->definition))
            return true;
    }
    table_add(&b->compiled, b->arena, hash, b->shader->reflection.compiled.len + 1);
    return false;
}

void build_compile_in(struct builder *b, elem_id node, const struct port *port, elem_id element)
{
    const struct shader_compiled_input input = {element ? element : node, port->element,
                                                library_type_name(b->lib, port->type)};
    bool is_of_document = input.element >= build_doc(b)->first_element;
    if (is_of_document && !b->recorder && !is_known(b, &input, element != 0))
        vec_push(b->arena, &b->shader->reflection.compiled, input);
}

ir_ref build_publish(struct builder *b, elem_id node, const struct port *port, elem_id element,
                     str_id input, ir_ref value, bool authored)
{
    if (!ir_is_const(b->graph, value))
        return value;
    if (ir_type_of(b->graph, value) != IR_TYPE_STRING) {
        str_id path = build_input_path(b, node, input, element);
        if (stays_variable(b, node, authored, path))
            return add_uniform(b, build_describe(b, node, port, element, input, path), value);
    }
    build_compile_in(b, node, port, element);
    return value;
}

const char *build_uniform_fault(const struct builder *b, str_id name, ir_type_id type)
{
    const char *text = build_text(b, name);
    ir_type_id known = shader_uniform_type(name);
    if (known != IR_TYPE_VOID && known != type)
        return "which is a uniform of mxgen with another type";
    bool is_reserved = strncmp(text, "gl_", 3) == 0 || strcmp(text, "main") == 0
                       || strstr(text, "__")
                       || lang_syntax_is_reserved(b->options->syntax, text, strlen(text));
    return is_reserved ? "which is a word of the target" : NULL;
}
