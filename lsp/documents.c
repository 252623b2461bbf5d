// SPDX-License-Identifier: Apache-2.0
/* The documents that the editor has open, and their changes. */
#include "lsp/check_document.h"
#include "lsp/diagnostics.h"
#include "lsp/handlers.h"
#include "lsp/wire.h"
#include "program/cli.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

struct lsp_document *lsp_find_document(const struct lsp_session *session, const char *uri)
{
    struct lsp_document *document = session->documents;
    while (document && strcmp(document->uri, uri) != 0)
        document = document->next;
    return document;
}

struct lsp_document *lsp_find_path(const struct lsp_session *session, const char *path)
{
    struct lsp_document *document = session->documents;
    while (document && strcmp(document->path, path) != 0)
        document = document->next;
    return document;
}

void lsp_document_destroy(struct lsp_document *document)
{
    check_destroy(document->check);
    findings_clear(&document->findings);
    args_free(&document->told);
    text_finish(&document->text);
    model_finish(&document->model);
    free(document->uri);
    free(document->path);
    free(document);
}

const struct text *lsp_file_text(struct lsp_session *session, const struct lsp_document *reader,
                                 const char *path, struct text *out_own)
{
    const struct lsp_document *document = lsp_find_path(session, path);
    *out_own = (struct text){0};
    if (document)
        return &document->text;
    size_t size = 0;
    session->disk.from = check_origin(reader);
    char *bytes = disk_read(&session->disk, path, 0, &size);
    text_set(out_own, bytes ? bytes : "", bytes && size <= TEXT_MAX ? size : 0);
    free(bytes);
    return out_own;
}

char *lsp_file_uri(const struct lsp_session *session, const char *path)
{
    const struct lsp_document *document = lsp_find_path(session, path);
    return document ? cli_copy(document->uri, strlen(document->uri)) : wire_uri(path);
}

bool lsp_query(struct lsp_session *session, const json_t *params, struct lsp_query *out,
               struct lsp_error *error)
{
    const char *uri = json_text_of(json_object_get(params, "textDocument"), "uri");
    const json_t *position = json_object_get(params, "position");
    struct lsp_document *document = lsp_find_document(session, uri);
    *out = (struct lsp_query){.session = session, .document = document};
    if (!document) {
        *error = (struct lsp_error){LSP_INVALID_PARAMS, "the document is not open"};
        return false;
    }
    out->text = &document->text;
    out->model = &document->model;
    if (!position || wire_read_position(session, out->text, position, &out->offset))
        return true;
    *error = (struct lsp_error){LSP_INVALID_PARAMS, "the position is no position"};
    return false;
}

json_t *handle_open(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    (void)error;
    const json_t *item = json_object_get(params, "textDocument"),
                 *bytes = json_object_get(item, "text");
    const char *uri = json_text_of(item, "uri");
    if (!*uri || !json_is_string(bytes) || json_string_length(bytes) > TEXT_MAX)
        return NULL;
    struct lsp_document *document = lsp_find_document(session, uri);
    if (!document) {
        document = memory_alloc(sizeof *document);
        document->uri = cli_copy(uri, strlen(uri));
        document->path = wire_path(uri);
        document->is_file = document->path != NULL;
        document->path = document->path ? document->path : cli_copy(uri, strlen(uri));
        document->next = session->documents;
        session->documents = document;
    }
    document->version = json_integer_value(json_object_get(item, "version"));
    text_set(&document->text, json_string_value(bytes), json_string_length(bytes));
    model_read(&document->model, &document->text);
    diagnostics_expect(session, document->path);
    return NULL;
}

/* A change of a range, or a new text. */
static void apply(struct lsp_session *session, struct lsp_document *document, const json_t *change)
{
    const json_t *new_text = json_object_get(change, "text"),
                 *range = json_object_get(change, "range");
    const char *bytes = json_string_value(new_text);
    size_t len = json_string_length(new_text);
    struct span span;
    if (!bytes || len > TEXT_MAX)
        return;
    if (!range) {
        text_set(&document->text, bytes, len);
        model_read(&document->model, &document->text);
    } else if (wire_read_range(session, &document->text, range, &span)
               && text_replace(&document->text, span, bytes, len)) {
        model_update(&document->model, &document->text, span, span.start + (uint32_t)len);
    }
}

json_t *handle_change(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    if (!lsp_query(session, params, &query, error))
        return NULL;
    const json_t *changes = json_object_get(params, "contentChanges"), *change;
    size_t index;
    json_array_foreach(changes, index, change) apply(session, query.document, change);
    query.document->version =
        json_integer_value(json_object_get(json_object_get(params, "textDocument"), "version"));
    diagnostics_expect(session, query.document->path);
    return NULL;
}

json_t *handle_save(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    if (lsp_query(session, params, &query, error))
        diagnostics_expect(session, query.document->path);
    return NULL;
}

json_t *handle_close(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    if (!lsp_query(session, params, &query, error))
        return NULL;
    struct lsp_document **at = &session->documents;
    while (*at != query.document)
        at = &(*at)->next;
    *at = query.document->next;
    diagnostics_forget(session, query.document);
    diagnostics_expect(session, query.document->path);
    lsp_document_destroy(query.document);
    return NULL;
}

/* A file beside the open ones changed: a texture, an include. */
json_t *handle_watched_files(struct lsp_session *session, const json_t *params,
                             struct lsp_error *error)
{
    (void)params;
    (void)error;
    for (struct lsp_document *document = session->documents; document; document = document->next)
        diagnostics_expect(session, document->path);
    return NULL;
}
