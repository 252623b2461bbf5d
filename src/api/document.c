// SPDX-License-Identifier: Apache-2.0
/* Documents: a library layer above the library's, and its renderables. */
#include "api/api.h"

#include <assert.h>

struct load {
    mxg_document *document;
    const mxg_library *base;
    const char *name, *data; /* data NULL: read the file `name` */
    size_t size;
    struct file_source files;
};

void document_finish(struct mxg_document *document, struct file_source *files)
{
    struct library *layer = &document->layer;
    struct lang_reader reader = file_source_for_lang(files);
    const struct diag_list *diags = &document->object.diagnostics.list;
    uint32_t before = diags->items.len;
    library_index(layer, &reader, &document->object.diagnostics.list);
    document->is_silent = diags->items.len == before;
    document_find_renderables(document);
    document->files.items = files->names.items;
    document->files.len = files->names.len;
}

void document_follow_context(mxg_document *document)
{
    struct mxg_context *context = document->object.context;
    document->layer.trust = context->trust;
    document->layer.knows_target = target_exists;
    document->layer.target_user_data = context;
}

static void read_layer(void *arg)
{
    struct load *load = arg;
    mxg_document *document = load->document;
    struct library *layer = &document->layer;
    struct diag_list *diags = &document->object.diagnostics.list;
    const mxg_context *context = document->object.context;
    const struct xml_limits *limits = &context->xml_limits;
    struct xml_files files = file_source_for_xml(&load->files);
    /* only its reference count changes */
    library_init(layer, &document->object.arena, (struct library *)(uintptr_t)&load->base->layer);
    for (uint32_t i = 0; i < load->base->folders.len; i++)
        vec_push(&document->object.arena, &load->files.folders, load->base->folders.items[i]);
    document_follow_context(document);
    layer->doc.keeps_comments = true;
    const char *fault = load->data ? NULL : sandbox_named_fault(context, load->name);
    if (fault) {
        diag_add(diags, DIAG_ID_file_unreadable, (struct diag_place){0}, load->name, fault);
    } else if (load->data) {
        vec_push(&document->object.arena, &load->files.names,
                 arena_strndup(&document->object.arena, load->name, strlen(load->name)));
        xml_read_memory(&layer->doc, &files, limits, load->name, load->data, load->size, diags);
    } else {
        xml_read_file(&layer->doc, &files, limits, load->name, diags);
    }
    document_finish(document, &load->files);
}

static mxg_status load_document(mxg_context *context, mxg_library *library, struct load *load,
                                mxg_document **out_document)
{
    if (out_document)
        *out_document = NULL;
    if (!context || !library || !load->name || !out_document
        || object_status(&library->object) != MXG_OK)
        return MXG_ERROR_ARGUMENT;
    load->document = object_new(context, sizeof *load->document, &library->object);
    if (!load->document)
        return MXG_ERROR_MEMORY;
    load->base = library;
    struct object *object = &load->document->object;
    if (!sandbox_admit_file(context, load->name)) {
        object_unref(object);
        return MXG_ERROR_MEMORY;
    }
    file_source_init(&load->files, object);
    mxg_status status = object_run(object, read_layer, load);
    file_source_finish(&load->files);
    if (status != MXG_OK) {
        object_unref(object);
        return status;
    }
    *out_document = load->document;
    return object_status(object);
}

mxg_status mxg_document_load(mxg_context *context, mxg_library *library, const char *path,
                             mxg_document **out_document)
{
    return load_document(context, library, &(struct load){.name = path}, out_document);
}

mxg_status mxg_document_parse(mxg_context *context, mxg_library *library, const char *name,
                              const char *data, size_t size, mxg_document **out_document)
{
    if (!data && size)
        name = NULL; /* the sandbox refuses the file */
    return load_document(context, library,
                         &(struct load){.name = name, .data = data ? data : "", .size = size},
                         out_document);
}

void mxg_document_destroy(mxg_document *document)
{
    object_unref(document ? &document->object : NULL);
}

uint32_t mxg_document_num_files(const mxg_document *document)
{
    return document ? document->files.len : 0;
}

const char *mxg_document_file(const mxg_document *document, uint32_t index)
{
    return index < mxg_document_num_files(document) ? document->files.items[index] : NULL;
}

uint32_t mxg_document_num_renderables(const mxg_document *document)
{
    return document ? document->renderables.num : 0;
}

mxg_status mxg_document_renderable(const mxg_document *document, uint32_t index,
                                   mxg_renderable *out)
{
    if (index >= mxg_document_num_renderables(document))
        return MXG_ERROR_ARGUMENT;
    const struct document *doc = &document->layer.doc;
    elem_id element = renderable_at(document, index);
    assert(element > document->layer.doc.root);
    mxg_renderable full = {
        .path = renderable_path(document, index),
        .type = str_text(doc->strings, doc_attr_value(doc, element, STR_type)),
        .category = str_text(doc->strings, doc_element(doc, element)->category),
    };
    return struct_write(out, &full, sizeof full);
}
