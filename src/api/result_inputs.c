// SPDX-License-Identifier: Apache-2.0
/* The inputs of the document as a result sees them: compiled in, or in which state. */
#include "api/generation.h"

static const char *text_of(const mxg_result *result, str_id id)
{
    return str_text(&result->strings, id);
}

static const struct document *tree_of(const mxg_result *result)
{
    return &result->document->layer.doc;
}

/* ---- Compiled inputs ---- */

uint32_t mxg_result_num_compiled_inputs(const mxg_result *result)
{
    return result && result->has_shader ? result->shader.reflection.compiled.len : 0;
}

static void write_path(const struct document *doc, const struct shader_compiled_input *input,
                       struct text *out)
{
    doc_path(doc, input->element, '/', out);
    if (!doc_is_port(doc, input->element) && input->definition)
        text_fmt(out, "/%s", doc_name(doc, input->definition));
    text_char(out, '\0');
}

/* The starts of all paths, then the paths. Most hosts need none, so generation writes none. */
static void write_paths(const struct object *object, struct text *out)
{
    const mxg_result *result = (const mxg_result *)object;
    uint32_t count = result->shader.reflection.compiled.len;
    for (uint32_t i = 0; i < count; i++)
        text_mem(out, (const char *)&(uint32_t){0}, sizeof(uint32_t));
    for (uint32_t i = 0; i < count; i++) {
        uint32_t start = (uint32_t)out->len;
        memcpy(out->data + i * sizeof start, &start, sizeof start);
        write_path(tree_of(result), &result->shader.reflection.compiled.items[i], out);
    }
}

/* NULL: out of memory. */
static const char *compiled_path(const mxg_result *result, uint32_t index)
{
    const struct made_text *paths = object_text(&result->object, TEXT_COMPILED, write_paths);
    uint32_t start;
    if (!paths)
        return NULL;
    assert((index + 1) * sizeof start <= paths->size);
    memcpy(&start, paths->data + index * sizeof start, sizeof start);
    assert(start < paths->size);
    return paths->data + start;
}

void result_compiled(void *user_data, uint32_t index, struct shader_compiled_text *out)
{
    const mxg_result *result = user_data;
    const struct document *doc = tree_of(result);
    const struct shader_compiled_input *input = &result->shader.reflection.compiled.items[index];
    const struct attribute *own =
        doc_is_port(doc, input->element) ? doc_attr(doc, input->element, STR_value) : NULL;
    str_id value = own                 ? own->value
                   : input->definition ? doc_attr_value(doc, input->definition, STR_value)
                                       : 0;
    const char *path = compiled_path(result, index);
    *out = (struct shader_compiled_text){.path = path ? path : "",
                                         .type = text_of(result, input->doc_type),
                                         .value = text_of(result, value),
                                         .authored = own != NULL};
    result_input_ui(result, input->element, input->definition, &out->ui);
}

mxg_status mxg_result_compiled_input(const mxg_result *result, uint32_t index,
                                     mxg_compiled_input *out)
{
    if (index >= mxg_result_num_compiled_inputs(result))
        return MXG_ERROR_ARGUMENT;
    if (!compiled_path(result, index))
        return MXG_ERROR_MEMORY;
    struct shader_compiled_text input;
    result_compiled((void *)(uintptr_t)result, index, &input);
    mxg_compiled_input full = {
        .path = input.path,
        .type = input.type,
        .value = input.value,
        .authored = input.authored,
        .advanced = input.ui.advanced,
#define UI(member, attribute, key) .member = input.ui.member,
#include "shader/ui.def"
#undef UI
    };
    return struct_write(out, &full, sizeof full);
}

/* ---- States ---- */

/* An input of a node or nodegraph: its element, or the node and the port of its definition. */
struct found_input {
    elem_id element, node;
    const struct port *port; /* NULL: an input of a nodegraph without a definition */
};

/* False: the path names no input. */
static bool find_input(const mxg_result *result, const char *path, struct found_input *out)
{
    const struct document *doc = tree_of(result);
    const char *slash = strrchr(path, '/');
    elem_id node = slash ? doc_find(doc, path, (size_t)(slash - path)) : 0;
    str_id name = slash ? str_find(&result->strings, slash + 1, strlen(slash + 1)) : 0;
    if (!node || node <= doc->root || !name)
        return false;
    uint16_t kind = doc_element(doc, node)->kind;
    if (kind != KIND_NODE && kind != KIND_NODEGRAPH)
        return false;
    *out = (struct found_input){.node = node,
                                .element = doc_child_of_kind(doc, node, KIND_INPUT, name)};
    uint32_t nodedef = mxg_document_find_nodedef(result->document, node);
    if (nodedef == MXG_NONE)
        return kind == KIND_NODEGRAPH && out->element;
    int index = library_find_input(&result->document->layer, nodedef, name);
    if (index >= 0)
        out->port = library_ports(&result->document->layer, nodedef, NULL) + index;
    return index >= 0;
}

static bool is_compiled(const mxg_result *result, const struct found_input *input)
{
    for (uint32_t i = 0; i < result->shader.reflection.compiled.len; i++) {
        const struct shader_compiled_input *compiled = &result->shader.reflection.compiled.items[i];
        if (input->element ? compiled->element == input->element
                           : compiled->element == input->node && input->port
                                 && compiled->definition == input->port->element)
            return true;
    }
    return false;
}

static bool is_connected(const mxg_result *result, const struct found_input *input)
{
    const struct document *doc = tree_of(result);
    if (input->element && doc_is_connected(doc, input->element))
        return true;
    bool has_value = input->element && doc_attr(doc, input->element, STR_value);
    return !has_value && input->port && input->port->geomprop;
}

mxg_input_state mxg_result_input_state(const mxg_result *result, const char *path)
{
    struct found_input input;
    if (!result || !path || !result->has_shader || result->network.arena)
        return MXG_INPUT_UNKNOWN;
    path += *path == '/';
    if (!find_input(result, path, &input))
        return MXG_INPUT_UNKNOWN;
    if (is_compiled(result, &input))
        return MXG_INPUT_COMPILED;
    if (mxg_result_find_variable(result, path) != MXG_NONE)
        return MXG_INPUT_UNIFORM;
    return is_connected(result, &input) ? MXG_INPUT_CONNECTED : MXG_INPUT_UNUSED;
}
