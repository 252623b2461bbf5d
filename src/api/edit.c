// SPDX-License-Identifier: Apache-2.0
/* Edits: how a document under construction begins, and how it becomes a document. */
#include "api/edit.h"
#include "api/scene.h"
#include "bind/materials.h"

#include <assert.h>

/* ---- Begin ---- */

struct begin_job {
    mxg_edit *edit;
    struct library *base;
    const mxg_document *from;
    const char *name;
};

static void begin_empty(struct document *doc, const char *name)
{
    uint16_t file = doc_add_file(doc, str_intern_z(doc->strings, name));
    doc_set_place(doc, doc->root, file, 0, 0);
    doc_set_attr(doc, doc->root, STR_version, str_intern_z(doc->strings, "1.39"));
    doc->is_global = doc->keeps_comments = true;
}

/* The document whose elements a document that begins with `from` shares. */
static const mxg_document *origin_of(const mxg_document *from)
{
    const struct document *shared = from ? doc_to_share(&from->layer.doc) : NULL;
    while (from && &from->layer.doc != shared)
        from = from->origin;
    return from;
}

/* True if elements are in the tree again that the edited document leaves out. */
static bool begin_from(mxg_document *document, const mxg_document *from)
{
    struct arena *arena = &document->object.arena;
    struct library *layer = &document->layer;
    document->origin = origin_of(from);
    library_init(layer, arena, from->layer.base);
    strpool_init(&layer->strings, arena, &document->origin->layer.strings);
    doc_begin_edit(&layer->doc, arena, &layer->strings, &from->layer.doc,
                   &document->origin->layer.doc);
    bool is_restored = doc_restore_left_out(&layer->doc, &from->layer.doc);
    renderables_begin(document, from);
    for (uint32_t i = 0; i < from->files.len; i++) {
        const char *file = from->files.items[i];
        vec_push(arena, &document->files, arena_strndup(arena, file, strlen(file)));
    }
    return is_restored;
}

static void begin_document(void *arg)
{
    struct begin_job *job = arg;
    mxg_document *document = job->edit->document;
    struct arena *arena = &document->object.arena;
    struct library *layer = &document->layer;
    if (job->from) {
        job->edit->is_unchecked = begin_from(document, job->from);
    } else {
        const char *name = job->name ? job->name : "<edit>";
        library_init(layer, arena, job->base);
        begin_empty(&layer->doc, name);
        vec_push(arena, &document->files, arena_strndup(arena, name, strlen(name)));
    }
    document_follow_context(document);
    layer->doc.max_elements = document->object.context->xml_limits.max_elements;
}

/* The document holds its origin, which holds the library. */
static mxg_edit *new_edit(mxg_context *context, mxg_library *library, const mxg_document *from)
{
    /* only its reference count changes */
    struct object *origin = from ? (struct object *)(uintptr_t)&origin_of(from)->object : NULL;
    mxg_document *document =
        object_new(context, sizeof *document, origin ? origin : &library->object);
    if (!document)
        return NULL;
    mxg_edit *edit = object_new(context, sizeof *edit, &document->object);
    object_unref(&document->object); /* the edit holds it */
    if (!edit)
        return NULL;
    edit->document = document;
    text_init(&edit->error, &edit->object.arena);
    return edit;
}

mxg_status mxg_edit_create(mxg_context *context, mxg_library *library, const mxg_document *from,
                           const char *name, mxg_edit **out_edit)
{
    if (out_edit)
        *out_edit = NULL;
    if (!context || !library || !out_edit || object_status(&library->object) != MXG_OK
        || (from && from->layer.base != &library->layer))
        return MXG_ERROR_ARGUMENT;
    struct begin_job job = {new_edit(context, library, from), &library->layer, from, name};
    if (!job.edit)
        return MXG_ERROR_MEMORY;
    mxg_status status = object_run(&job.edit->document->object, begin_document, &job);
    if (status == MXG_OK)
        *out_edit = job.edit;
    else
        mxg_edit_destroy(job.edit);
    return status;
}

void mxg_edit_destroy(mxg_edit *edit)
{
    object_unref(edit ? &edit->object : NULL);
}

/* ---- End ---- */

struct end_job {
    const mxg_edit *edit;
    struct file_source files;
};

static const mxg_document *whole_of(const mxg_document *origin)
{
    while (origin->origin)
        origin = origin->origin;
    return origin;
}

/* Leaves the origin: the document gets arrays and definitions of its own. */
static void stand_alone(mxg_document *document)
{
    doc_leave_origin(&document->layer.doc);
    strpool_leave_base(&document->layer.strings, &whole_of(document->origin)->layer.strings);
    struct library own = document->layer;
    library_init(&document->layer, &document->object.arena, own.base);
    document->layer.doc = own.doc;
    document->layer.strings = own.strings;
    document->layer.doc.strings = &document->layer.strings;
    document_follow_context(document);
    document->origin = NULL;
}

static void complete(struct end_job *job)
{
    mxg_document *document = job->edit->document;
    struct document *doc = &document->layer.doc;
    struct diag_list *diags = &document->object.diagnostics.list;
    if (document->origin && !job->edit->is_unchecked
        && edit_share(document, &job->files.scratch, diags))
        return;
    for (uint32_t i = 0; i < document->files.len; i++)
        file_source_remember(&job->files, document->files.items[i]);
    if (document->origin)
        stand_alone(document);
    doc_keep_paths(doc);
    doc_upgrade_edit(doc, diags);
    doc_complete(doc, diags);
    doc->bases.len = 0; /* the text of this document has their values */
    document_finish(document, &job->files);
}

/* True if an element of the kind and name is there again. */
static bool is_found(const struct document *doc, const struct lost_reference *lost, elem_id parent)
{
    enum element_kind kind = (enum element_kind)lost->kind;
    return parent == doc->root
               ? doc_top_level(doc, kind, lost->name)
               : doc_has_element(doc, parent) && doc_child_of_kind(doc, parent, kind, lost->name);
}

static void report_lost(mxg_document *document, const struct lost_reference *lost)
{
    const struct document *doc = &document->layer.doc;
    if (doc_has_element(doc, lost->user) && doc_has_name(doc, lost->user, lost->attr, lost->name)
        && !is_found(doc, lost, lost->parent) && !is_found(doc, lost, doc->root))
        diag_add(&document->object.diagnostics.list, DIAG_ID_removed_reference,
                 doc_attr_place(doc, lost->user, lost->attr), str_text(doc->strings, lost->attr),
                 str_text(doc->strings, lost->name));
}

static void end_document(void *arg)
{
    struct end_job *job = arg;
    complete(job);
    for (uint32_t i = 0; i < job->edit->lost.len; i++)
        report_lost(job->edit->document, &job->edit->lost.items[i]);
}

/* A document that stands alone holds the library in the place of its former origin. */
static void hold_library(struct object *object, const mxg_document *origin)
{
    struct object *former = object->below, *library = whole_of(origin)->object.below;
    assert(former == &origin->object);
    object_ref(library);
    object->below = library;
    object_unref(former);
}

mxg_status mxg_edit_commit(mxg_edit *edit, mxg_document **out_document)
{
    if (out_document)
        *out_document = NULL;
    if (!edit || !edit->document || !out_document)
        return MXG_ERROR_ARGUMENT;
    struct end_job job = {.edit = edit};
    struct object *object = &edit->document->object;
    const mxg_document *origin = edit->document->origin;
    file_source_init(&job.files, object);
    mxg_status status = object_run(object, end_document, &job);
    file_source_finish(&job.files);
    if (status == MXG_OK) {
        if (origin && !edit->document->origin)
            hold_library(object, origin);
        object_ref(object);
        *out_document = edit->document;
        status = object_status(object);
    }
    edit->document = NULL;
    return status;
}

/* ---- Materials of a stage ---- */

struct materials_job {
    mxg_document *document;
    const mxg_scene *scene;
    struct file_source files;
    struct arena scratch;
};

static size_t read_image(void *user_data, const char *file, unsigned char *buffer, size_t capacity)
{
    struct materials_job *job = user_data;
    return file_source_begin(&job->files, job->scene->scene.layer.file, file, buffer, capacity);
}

static void add_materials(void *arg)
{
    struct materials_job *job = arg;
    const struct bind_images images = {job, read_image};
    bind_add_materials(&job->scene->scene, &job->document->layer, &images, &job->scratch,
                       &job->document->object.diagnostics.list);
}

mxg_status mxg_document_import(mxg_context *context, mxg_library *library,
                               const mxg_document *document, const mxg_scene *scene,
                               mxg_document **out_document)
{
    mxg_edit *edit;
    if (out_document)
        *out_document = NULL;
    if (!scene || !out_document)
        return MXG_ERROR_ARGUMENT;
    mxg_status status = mxg_edit_create(context, library, document, "<stage>", &edit);
    if (status != MXG_OK)
        return status;
    struct materials_job job = {.document = edit->document, .scene = scene};
    edit->is_unchecked = true;
    arena_init(&job.scratch, &edit->document->object.mem);
    file_source_init(&job.files, &edit->document->object);
    status = object_run(&edit->document->object, add_materials, &job);
    file_source_finish(&job.files);
    arena_finish(&job.scratch);
    if (status == MXG_OK)
        status = mxg_edit_commit(edit, out_document);
    mxg_edit_destroy(edit);
    return status;
}
