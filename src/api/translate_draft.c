// SPDX-License-Identifier: Apache-2.0
/*
 * The draft: a document with the nodes of the chain, whose first has the inputs of the surface,
 * and with a copy of the surface. Connected inputs have a value there and become uniforms, so the
 * IR of an output depends on them by name, and folds all else.
 */
#include "api/translate.h"

#include <mxgen/library.h>

/* The name of the draft's node: 0 is the surface, 1 the first translation. */
const char *translate_step_name(const struct translation *t, unsigned step)
{
    struct text name;
    text_init(&name, t->arena);
    text_fmt(&name, "%s%u", t->draft_name, step);
    return text_cstr(&name);
}

const char *translate_free_name(const struct translation *t)
{
    struct text name;
    text_init(&name, t->arena);
    for (unsigned i = 0;; i++) {
        name.len = 0;
        text_fmt(&name, "translation%u_", i);
        text_str(&name, "0");
        if (!mxg_document_find_element(t->document, 0, text_cstr(&name)))
            break;
    }
    name.len--;
    return text_cstr(&name);
}

static elem_id child_input(const struct translation *t, const char *name)
{
    const struct document *doc = &t->document->layer.doc;
    str_id id = str_find(doc->strings, name, strlen(name));
    elem_id found = id ? doc_child(doc, t->surface, id) : 0;
    return found && doc_element(doc, found)->category == STR_input ? found : 0;
}

static const char *attribute(const struct translation *t, elem_id element, str_id name)
{
    const struct document *doc = &t->document->layer.doc;
    str_id value = element ? doc_attr_value(doc, element, name) : 0;
    return value ? str_text(doc->strings, value) : "";
}

static bool is_connected(const struct translation *t, elem_id input)
{
    return *attribute(t, input, STR_nodename) || *attribute(t, input, STR_nodegraph)
           || *attribute(t, input, STR_interfacename) || *attribute(t, input, STR_output);
}

void translate_read_sources(struct translation *t, uint32_t definition)
{
    mxg_nodedef info = {.size = sizeof info};
    mxg_document_nodedef(t->document, definition, &info);
    t->sources.len = 0;
    for (uint32_t i = 0; i < info.num_inputs; i++) {
        struct source_input source = {.port.size = sizeof source.port};
        mxg_document_port(t->document, definition, i, &source.port);
        source.element = child_input(t, source.port.name);
        source.is_connected = is_connected(t, source.element);
        source.type = value_type_of(source.port.type);
        vec_push(t->arena, &t->sources, source);
    }
}

bool translate_is_default(const mxg_port *port, const struct strpool *strings, const char *text)
{
    doc_type type = doc_type_of(str_find(strings, port->type, strlen(port->type)));
    return doc_is_same_value(type, text, port->value);
}

static const char *text_of(const struct translation *t, const struct source_input *source)
{
    return source->text ? source->text : attribute(t, source->element, STR_value);
}

const char *translate_value_of(const struct translation *t, const struct source_input *source)
{
    const char *text = text_of(t, source);
    return *text ? text : source->port.value;
}

bool translate_is_authored(const struct translation *t, const struct source_input *source)
{
    return (source->element || source->text)
           && (source->is_connected
               || !translate_is_default(&source->port, t->document->layer.doc.strings,
                                        text_of(t, source)));
}

/* ---- The nodes of the draft ---- */

const char *translate_text_of_zero(const struct translation *t, enum value_type type)
{
    const struct operand zero = value_zero(type);
    struct text text;
    text_init(&text, t->arena);
    value_write(&zero, &text);
    return text_cstr(&text);
}

/* As the document writes it: a name of an enumeration stays one. "" is no attribute. */
static void set_attribute(const struct translation *t, mxg_element element, str_id name,
                          const char *value)
{
    translate_expect(t, element != 0);
    if (*value)
        translate_expect(t, mxg_edit_set_attribute(t->draft_edit, element,
                                                   str_text(t->document->layer.doc.strings, name),
                                                   value)
                                == MXG_OK);
}

/* The value of an input of the surface; an input with neither a value nor a default has none. */
static void set_value(struct translation *t, mxg_element node, const struct source_input *source)
{
    static const str_id kept[] = {STR_unit, STR_unittype};
    const struct document *doc = &t->document->layer.doc;
    const char *text = translate_value_of(t, source);
    if (source->is_connected)
        text = source->type == VALUE_NONE ? "" : translate_text_of_zero(t, source->type);
    if (!*text)
        return;
    mxg_element input =
        mxg_edit_add_element(t->draft_edit, node, "input", source->port.name, source->port.type);
    set_attribute(t, input, STR_value, text);
    if (source->is_connected || !source->element)
        return;
    for (size_t i = 0; i < sizeof kept / sizeof *kept; i++)
        set_attribute(t, input, kept[i], attribute(t, source->element, kept[i]));
    str_id space = doc_inherited_attr(doc, source->element, STR_colorspace);
    set_attribute(t, input, STR_colorspace, space ? str_text(doc->strings, space) : "");
}

/* The type of a node with the definition `index`: of its only output, or that of several. */
static const char *type_of_node(const struct translation *t, uint32_t index,
                                const mxg_nodedef *info)
{
    mxg_port output = {.size = sizeof output};
    if (info->num_outputs != 1)
        return "multioutput";
    mxg_document_port(t->document, index, info->num_inputs, &output);
    return output.type;
}

static mxg_element add_node(struct translation *t, unsigned step, uint32_t index)
{
    mxg_nodedef info = {.size = sizeof info};
    mxg_document_nodedef(t->document, index, &info);
    mxg_element node = mxg_edit_add_element(
        t->draft_edit, 0, info.node, translate_step_name(t, step), type_of_node(t, index, &info));
    translate_expect(t, node != 0
                            && mxg_edit_set_attribute(t->draft_edit, node, "nodedef", info.name)
                                   == MXG_OK);
    return node;
}

/* The surface, or the first translation with the inputs that it has. */
static void add_first(struct translation *t, unsigned step, uint32_t definition)
{
    mxg_element node = add_node(t, step, definition);
    for (uint32_t i = 0; i < t->sources.len; i++) {
        mxg_port port;
        if (translate_find_port(t, definition, t->sources.items[i].port.name, false, &port)
            && strcmp(port.type, t->sources.items[i].port.type) == 0)
            set_value(t, node, &t->sources.items[i]);
    }
}

/*
 * An input of a later translation: an output of the one before, or the default of the model between
 * them.
 */
static void connect_step(struct translation *t, mxg_element node, mxg_element before,
                         uint32_t definition, const mxg_port *input)
{
    mxg_port port;
    const char *output = translate_output_name(t, input->name);
    if (translate_find_port(t, definition, output, true, &port))
        translate_expect(t, mxg_edit_connect_input(t->draft_edit, node, input->name, before, output)
                                == MXG_OK);
}

static void add_step(struct translation *t, unsigned step)
{
    mxg_nodedef info = {.size = sizeof info};
    uint32_t definition = t->chain.items[step];
    mxg_document_nodedef(t->document, definition, &info);
    mxg_element before = mxg_edit_find_element(t->draft_edit, 0, translate_step_name(t, step));
    mxg_element node = add_node(t, step + 1, definition);
    for (uint32_t i = 0; i < info.num_inputs; i++) {
        mxg_port input = {.size = sizeof input};
        mxg_document_port(t->document, definition, i, &input);
        connect_step(t, node, before, t->chain.items[step - 1], &input);
    }
}

/*
 * The document, if it has definitions, which a translation may need. Otherwise the draft stands
 * alone: each build takes time for the whole document.
 */
static const mxg_document *origin_of_draft(const struct translation *t)
{
    bool has_definitions =
        mxg_document_num_nodedefs(t->document) != mxg_library_num_nodedefs(t->library);
    return has_definitions ? t->document : NULL;
}

void translate_start_draft(struct translation *t)
{
    t->draft_name = translate_free_name(t);
    translate_expect(
        t, mxg_edit_create(t->context, t->library, origin_of_draft(t), NULL, &t->draft_edit)
               == MXG_OK);
}

void translate_commit_draft(struct translation *t)
{
    mxg_document *next = NULL;
    mxg_status status = mxg_edit_commit(t->draft_edit, &next);
    mxg_result_destroy(t->value); /* it refers to the draft before */
    t->value = NULL;
    mxg_document_destroy(t->draft);
    t->draft = next;
    mxg_edit_destroy(t->draft_edit);
    t->draft_edit = NULL;
    translate_expect(t, status != MXG_ERROR_MEMORY);
}

void translate_make_draft(struct translation *t, uint32_t definition)
{
    translate_start_draft(t);
    add_first(t, 0, definition);
    add_first(t, 1, t->chain.items[0]);
    for (uint32_t i = 1; i < t->chain.len; i++)
        add_step(t, i);
    translate_commit_draft(t);
}

/* ---- Values ---- */

static void build(struct generation *g)
{
    bool good = generation_start(g);
    g->build_options.max_inline_nodes = UINT32_MAX; /* no node of MaterialX is a call */
    *(ir_ref *)g->user_data = good && generation_build(g) ? g->root : 0;
}

const char *translate_uniforms(const struct translation *t, uint32_t more)
{
    struct text list;
    text_init(&list, t->arena);
    for (uint32_t i = 0; i < t->sources.len; i++) {
        const struct source_input *source = &t->sources.items[i];
        bool is_one = source->is_connected || i == more
                      || (more == TRANSLATE_ALL_INPUTS && (source->element || source->text));
        for (unsigned step = 0; step < 2 && is_one; step++)
            text_fmt(&list, "%s%s/%s", list.len ? "," : "", translate_step_name(t, step),
                     source->port.name);
    }
    return text_cstr(&list);
}

void translate_generate_for(struct translation *t, const struct target *target,
                            const mxg_document *document, const char *path, const char *uniforms,
                            void steps(struct generation *g), void *user_data)
{
    mxg_options_destroy(t->options); /* lists grow */
    t->options = NULL;
    translate_expect(t, mxg_options_create(t->context, &t->options) == MXG_OK
                            && mxg_options_set(t->options, "interface", "reduced") == MXG_OK
                            && mxg_options_set(t->options, "uniform", uniforms) == MXG_OK);
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = target->name;
    desc.element = path;
    desc.options = t->options;
    desc.without_source = true;
    mxg_result_destroy(t->value);
    t->value = NULL;
    translate_expect(t, generation_run(t->context, document, &desc, steps, user_data, &t->value)
                            != MXG_ERROR_MEMORY);
}

void translate_generate(struct translation *t, const mxg_document *document, const char *path,
                        const char *uniforms, void steps(struct generation *g), void *user_data)
{
    /* any target: only the graph of the shader is read */
    translate_generate_for(t, targets[0], document, path, uniforms, steps, user_data);
}

ir_ref translate_build_path(struct translation *t, const mxg_document *document, const char *path,
                            const char *uniforms)
{
    ir_ref root = 0;
    translate_generate(t, document, path, uniforms, build, &root);
    return root;
}

bool translate_can_build(struct translation *t)
{
    struct text path;
    text_init(&path, t->arena);
    doc_path(&t->document->layer.doc, t->surface, '/', &path);
    return translate_build_path(t, t->document, text_cstr(&path), "") != 0;
}

ir_ref translate_build(struct translation *t, unsigned step, const char *output, uint32_t more)
{
    struct text path;
    text_init(&path, t->arena);
    text_fmt(&path, "%s/%s", translate_step_name(t, step), output);
    return translate_build_path(t, t->draft, text_cstr(&path), translate_uniforms(t, more));
}

/* The input of the draft that a uniform comes from; NULL: the node is none. */
static const char *uniform_name(const struct translation *t, const struct ir_graph *graph,
                                ir_ref ref)
{
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op != IR_UNIFORM)
        return NULL;
    const struct shader_variable *v = &t->value->shader.interface.variables.items[node->attr];
    const char *path = v->path ? str_text(&t->value->strings, v->path) : "",
               *slash = strchr(path, '/');
    return slash ? slash + 1 : NULL;
}

uint32_t translate_source_of(const struct translation *t, const struct ir_graph *graph, ir_ref ref)
{
    const char *name = uniform_name(t, graph, ref);
    uint32_t found = 0;
    while (name && found < t->sources.len && strcmp(t->sources.items[found].port.name, name) != 0)
        found++;
    return name ? found : t->sources.len;
}
