// SPDX-License-Identifier: Apache-2.0
/* The elements of a document, for reading. */
#include "api/api.h"

#include <assert.h>

static const struct document *tree_of(const mxg_document *document)
{
    return &document->layer.doc;
}

/* The element if it is in the tree of the document, else 0. */
static elem_id in_tree(const mxg_document *document, mxg_element element)
{
    return document && doc_has_element(tree_of(document), element) ? element : 0;
}

static const char *text_of(const mxg_document *document, str_id id)
{
    return str_text(tree_of(document)->strings, id);
}

mxg_element mxg_document_find_element(const mxg_document *document, mxg_element below,
                                      const char *path)
{
    const struct document *doc = document && path ? tree_of(document) : NULL;
    elem_id start = !doc ? 0 : below ? in_tree(document, below) : doc->root;
    return start ? doc_find_below(doc, start, path, strlen(path)) : 0;
}

struct path_job {
    const struct document *doc;
    elem_id element;
    char *out;
    size_t capacity, len;
};

static void write_path(void *arg, struct arena *scratch)
{
    struct path_job *job = arg;
    struct text path;
    text_init(&path, scratch);
    doc_path(job->doc, job->element, '/', &path);
    job->len = text_copy(path.data, path.len, job->out, job->capacity);
}

size_t mxg_document_element_path(const mxg_document *document, mxg_element element, char *buffer,
                                 size_t capacity)
{
    text_copy("", 0, buffer, capacity);
    if (!in_tree(document, element))
        return 0;
    struct path_job job = {
        .doc = tree_of(document), .element = element, .out = buffer, .capacity = capacity};
    mxg_status status = context_run(document->object.context, write_path, &job);
    return status == MXG_OK ? job.len : 0;
}

mxg_status mxg_document_element(const mxg_document *document, mxg_element element,
                                mxg_element_info *out)
{
    if (!in_tree(document, element))
        return MXG_ERROR_ARGUMENT;
    const struct document *doc = tree_of(document);
    const struct element *e = doc_element(doc, element);
    struct diag_place place = doc_place(doc, element);
    mxg_element_info full = {
        .category = text_of(document, e->category),
        .name = text_of(document, e->name),
        .type = text_of(document, doc_attr_value(doc, element, STR_type)),
        .parent = e->parent,
        .first_child = e->first_child,
        .next = e->next,
        .num_attributes = e->num_attrs,
        .file = place.line ? place.file : NULL,
        .line = place.line,
        .column = place.column,
    };
    return struct_write(out, &full, sizeof full);
}

mxg_status mxg_document_attribute(const mxg_document *document, mxg_element element, uint32_t index,
                                  mxg_attribute *out)
{
    if (!in_tree(document, element) || index >= doc_element(tree_of(document), element)->num_attrs)
        return MXG_ERROR_ARGUMENT;
    const struct attribute *attr = &doc_attrs(tree_of(document), element)[index];
    mxg_attribute full = {.name = text_of(document, attr->name),
                          .value = text_of(document, attr->value)};
    return struct_write(out, &full, sizeof full);
}

uint32_t mxg_document_find_attribute(const mxg_document *document, mxg_element element,
                                     const char *name)
{
    if (!in_tree(document, element) || !name)
        return MXG_NONE;
    const struct document *doc = tree_of(document);
    str_id id = str_find(doc->strings, name, strlen(name));
    const struct attribute *attr = id ? doc_attr(doc, element, id) : NULL;
    return attr ? (uint32_t)(attr - doc_attrs(doc, element)) : MXG_NONE;
}

/* ---- Values ---- */

static void read_numbers(doc_type type, const char *text, mxg_value *out)
{
    struct ir_value value;
    unsigned num = doc_type_components(type);
    if (type == DOC_TYPE_boolean)
        num = 1;
    if (!num || num > sizeof out->values / sizeof *out->values
        || !doc_parse_value(type, text, strlen(text), NULL, &value))
        return;
    bool is_float = type != DOC_TYPE_integer && type != DOC_TYPE_boolean;
    out->num_values = num;
    for (unsigned i = 0; i < num; i++)
        out->values[i] = is_float ? value.w[i].f : (float)value.w[i].i;
    out->integer = is_float ? 0 : value.w[0].i;
}

mxg_status mxg_document_value(const mxg_document *document, mxg_element element, mxg_value *out)
{
    const struct attribute *attr =
        in_tree(document, element) ? doc_attr(tree_of(document), element, STR_value) : NULL;
    if (!attr)
        return MXG_ERROR_ARGUMENT;
    str_id type = doc_attr_value(tree_of(document), element, STR_type);
    mxg_value full = {.type = text_of(document, type), .text = text_of(document, attr->value)};
    read_numbers(doc_type_of(type), full.text, &full);
    return struct_write(out, &full, sizeof full);
}

/* ---- Connections ---- */

/* The element in which the names of a port's connection are. */
static elem_id scope_of(const struct document *doc, elem_id port)
{
    const struct element *e = doc_element(doc, port);
    return e->kind == KIND_OUTPUT ? e->parent : doc_element(doc, e->parent)->parent;
}

static elem_id graph_input(const mxg_document *document, elem_id port, str_id name)
{
    const struct document *doc = tree_of(document);
    elem_id graph = library_graph_around(&document->layer, port);
    return graph ? doc_child_of_kind(doc, graph, KIND_INPUT, name) : 0;
}

mxg_status mxg_document_connection(const mxg_document *document, mxg_element port,
                                   mxg_connection *out)
{
    const struct document *doc = in_tree(document, port) ? tree_of(document) : NULL;
    if (!doc || !doc_element(doc, port)->parent)
        return MXG_ERROR_ARGUMENT;
    str_id node = doc_attr_value(doc, port, STR_nodename),
           graph = doc_attr_value(doc, port, STR_nodegraph),
           interface = doc_attr_value(doc, port, STR_interfacename);
    elem_id scope = scope_of(doc, port);
    mxg_connection full = {.output = text_of(document, doc_attr_value(doc, port, STR_output)),
                           .interfacename = text_of(document, interface)};
    if (node || graph) {
        full.source = scope ? doc_child(doc, scope, node ? node : graph) : 0;
        if (!full.source && graph)
            full.source = doc_child_of_kind(doc, doc->root, KIND_NODEGRAPH, graph);
    } else if (interface) {
        full.source = graph_input(document, port, interface);
    } else if (*full.output && scope) { /* before 1.38: an output of the document */
        full.source =
            doc_child_of_kind(doc, scope, KIND_OUTPUT, doc_attr_value(doc, port, STR_output));
    } else {
        return MXG_ERROR_ARGUMENT;
    }
    mxg_status status = struct_write(out, &full, sizeof full);
    return status == MXG_OK && !full.source && !interface ? MXG_ERROR_DOCUMENT : status;
}

/* ---- Definitions ---- */

struct match_job {
    const mxg_document *document;
    elem_id element;
    uint32_t nodedef;
};

static void match(void *arg, struct arena *scratch)
{
    struct match_job *job = arg;
    const struct library *lib = &job->document->layer;
    struct diag_list diags;
    diag_list_init(&diags, scratch);
    const struct element *e = doc_element(&lib->doc, job->element);
    if (e->kind == KIND_NODE && e->parent)
        job->nodedef = library_match(lib, job->element, &diags);
    else if (e->kind == KIND_NODEGRAPH)
        job->nodedef = library_implemented_nodedef(lib, job->element);
}

uint32_t mxg_document_find_nodedef(const mxg_document *document, mxg_element element)
{
    struct match_job job = {document, element, LIBRARY_NONE};
    bool found = in_tree(document, element)
                 && context_run(document->object.context, match, &job) == MXG_OK
                 && job.nodedef != LIBRARY_NONE;
    return found ? job.nodedef : MXG_NONE;
}

uint32_t mxg_document_num_nodedefs(const mxg_document *document)
{
    return document ? library_num_nodedefs(&document->layer) : 0;
}

mxg_status mxg_document_nodedef(const mxg_document *document, uint32_t index, mxg_nodedef *out)
{
    return document ? definition_info(document->object.context, &document->layer, index, out)
                    : MXG_ERROR_ARGUMENT;
}

mxg_status mxg_document_port(const mxg_document *document, uint32_t nodedef, uint32_t index,
                             mxg_port *out)
{
    return document ? definition_port(&document->layer, nodedef, index, out) : MXG_ERROR_ARGUMENT;
}

uint32_t mxg_document_num_implementations(const mxg_document *document, uint32_t nodedef)
{
    return document ? definition_num_implementations(&document->layer, nodedef) : 0;
}

mxg_status mxg_document_implementation(const mxg_document *document, uint32_t nodedef,
                                       uint32_t index, mxg_implementation *out)
{
    return document ? definition_implementation(&document->layer, nodedef, index, out)
                    : MXG_ERROR_ARGUMENT;
}

/* ---- Text ---- */

static void write_xml(const struct object *object, struct text *out)
{
    const struct document *doc = tree_of((const mxg_document *)object);
    doc_write(doc, doc->root, out);
}

const char *mxg_document_xml(const mxg_document *document, size_t *out_size)
{
    const struct made_text *made = document ? object_text(&document->object, 0, write_xml) : NULL;
    if (out_size)
        *out_size = made ? made->size : 0;
    return made ? made->data : NULL;
}
