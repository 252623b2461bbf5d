// SPDX-License-Identifier: Apache-2.0
/* Text for text: a document as it is written, in the layout of doc_write. */
#include "api/generation.h"

#include <assert.h>

struct rewriting {
    mxg_result *result;
    enum xml_steps steps;
    const char *name, *data; /* data NULL: read the file `name` */
    size_t size;
    struct file_source files;
    struct document doc;
};

static void rewrite(void *arg)
{
    struct rewriting *r = arg;
    mxg_result *result = r->result;
    struct object *object = &result->object;
    struct xml_limits limits = object->context->xml_limits;
    struct xml_files files = file_source_for_xml(&r->files);
    struct diag_list *diags = &object->diagnostics.list;
    limits.steps = r->steps;
    strpool_init(&result->strings, &object->arena, NULL);
    doc_init(&r->doc, &object->arena, &result->strings, NULL);
    r->doc.keeps_comments = true;
    bool read = r->data
                    ? xml_read_memory(&r->doc, &files, &limits, r->name, r->data, r->size, diags)
                    : xml_read_file(&r->doc, &files, &limits, r->name, diags);
    if (!read)
        return;
    struct text text;
    text_init(&text, &object->arena);
    doc_write(&r->doc, r->doc.root, &text);
    result->text = text_cstr(&text);
    result->text_size = text.len;
}

mxg_status mxg_rewrite(mxg_context *context, mxg_rewriting rewriting, const char *name,
                       const char *data, size_t size, mxg_result **out_result)
{
    static const enum xml_steps steps[] = {
        [MXG_REWRITE_FORMAT] = XML_NO_STEPS, [MXG_REWRITE_UPGRADE] = XML_UPGRADE};
    if (out_result)
        *out_result = NULL;
    if (!context || !name || !out_result || (!data && size)
        || (unsigned)rewriting >= sizeof steps / sizeof *steps)
        return MXG_ERROR_ARGUMENT;
    struct rewriting r = {.steps = steps[rewriting], .name = name, .data = data, .size = size};
    r.result = object_new(context, sizeof *r.result, NULL);
    if (!r.result)
        return MXG_ERROR_MEMORY;
    struct object *object = &r.result->object;
    if (!sandbox_admit_file(context, name)) {
        object_unref(object);
        return MXG_ERROR_MEMORY;
    }
    file_source_init(&r.files, object);
    mxg_status status = object_run(object, rewrite, &r);
    file_source_finish(&r.files);
    if (status != MXG_OK) {
        object_unref(object);
        return status;
    }
    assert(!r.result->text == (object_status(object) != MXG_OK));
    *out_result = r.result;
    return object_status(object);
}
