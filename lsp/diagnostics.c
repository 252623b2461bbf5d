// SPDX-License-Identifier: Apache-2.0
#include "lsp/diagnostics.h"

#include "lsp/check_document.h"
#include "lsp/cures.h"
#include "lsp/wire.h"
#include "program/cli.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

static bool reads_file(const mxg_document *parsed, const char *path)
{
    for (uint32_t i = 0; parsed && i < mxg_document_num_files(parsed); ++i)
        if (strcmp(mxg_document_file(parsed, i), path) == 0)
            return true;
    return false;
}

void diagnostics_expect(struct lsp_session *session, const char *path)
{
    for (struct lsp_document *document = session->documents; document; document = document->next) {
        if (strcmp(document->path, path) != 0 && !reads_file(document->parsed, path))
            continue;
        document->is_dirty = true;
        document->edition = ++session->num_editions;
    }
}

/* ---- Telling ---- */

/* Adds a note as a related place, or to the message if it has none. */
static void put_note(struct lsp_session *session, const struct lsp_document *reader,
                     const struct finding_note *note, json_t *related, json_t *object)
{
    if (!note->path) {
        char *message = cli_format("%s\n%s", json_text_of(object, "message"), note->message);
        json_object_set_new(object, "message", json_text(message));
        free(message);
        return;
    }
    struct text own;
    const struct text *text = lsp_file_text(session, reader, note->path, &own);
    char *uri = lsp_file_uri(session, note->path);
    json_t *item = json_object();
    json_object_set_new(item, "location",
                        wire_location(session, uri, text,
                                      findings_span(text, note->line, note->column, note->length)));
    json_object_set_new(item, "message", json_text(note->message));
    json_array_append_new(related, item);
    free(uri);
    text_finish(&own);
}

static json_t *data_of(const struct finding *finding)
{
    json_t *data = json_object(), *arguments = json_array();
    for (size_t i = 0; i < finding->num_arguments; ++i)
        json_array_append_new(arguments, json_text(finding->arguments[i]));
    json_object_set_new(data, "arguments", arguments);
    return data;
}

json_t *diagnostics_json(struct lsp_session *session, const struct lsp_document *reader,
                         const struct text *text, const struct finding *finding)
{
    json_t *object = json_object(), *related = json_array();
    struct span span = findings_span(text, finding->line, finding->column, finding->length);
    enum lsp_tag tag = cures_tag(finding->id);
    json_object_set_new(object, "range", wire_range(session, text, span));
    json_object_set_new(object, "severity",
                        json_integer(finding->severity == MXG_SEVERITY_ERROR ? 1 : 2));
    json_object_set_new(object, "code", json_text(finding->id));
    json_object_set_new(object, "source", json_string("mxgen"));
    json_object_set_new(object, "message", json_text(finding->message));
    if (session->desc.messages_url)
        json_object_set_new(
            object, "codeDescription",
            json_pack("{s:o}", "href",
                      json_sprintf("%s#%s", session->desc.messages_url, finding->id)));
    if (tag)
        json_object_set_new(object, "tags", json_pack("[i]", (int)tag));
    for (size_t i = 0; i < finding->num_notes; ++i)
        put_note(session, reader, &finding->notes[i], related, object);
    if (json_array_size(related))
        json_object_set(object, "relatedInformation", related);
    json_decref(related);
    json_object_set_new(object, "data", data_of(finding));
    return object;
}

static bool has_equal(const json_t *items, const json_t *item)
{
    const json_t *other;
    size_t index;
    bool has = false;
    json_array_foreach(items, index, other) has =
        has
        || (json_equal(json_object_get(other, "range"), json_object_get(item, "range"))
            && json_equal(json_object_get(other, "message"), json_object_get(item, "message")));
    return has;
}

/* Tells the client all findings in a file, of all open documents that read it. */
static void publish(struct lsp_session *session, const struct lsp_document *reader,
                    const char *path)
{
    struct text own;
    const struct text *text = lsp_file_text(session, reader, path, &own);
    const struct lsp_document *open = lsp_find_path(session, path);
    json_t *params = json_object(), *items = json_array();
    for (const struct lsp_document *document = session->documents; document;
         document = document->next) {
        size_t before = json_array_size(items);
        for (size_t i = 0; i < document->findings.len; ++i) {
            if (strcmp(document->findings.items[i].path, path) != 0)
                continue;
            json_t *item = diagnostics_json(session, document, text, &document->findings.items[i]);
            if (before && has_equal(items, item))
                json_decref(item);
            else
                json_array_append_new(items, item);
        }
    }
    char *uri = lsp_file_uri(session, path);
    json_object_set_new(params, "uri", json_text(uri));
    if (open)
        json_object_set_new(params, "version", json_integer(open->version));
    json_object_set_new(params, "diagnostics", items);
    lsp_notify(session, "textDocument/publishDiagnostics", params);
    free(uri);
    text_finish(&own);
}

static void add_path(struct arg_list *paths, const char *path)
{
    for (size_t i = 0; i < paths->len; ++i)
        if (strcmp(paths->items[i], path) == 0)
            return;
    args_append(paths, cli_copy(path, strlen(path)));
}

/*
 * Tells the files that have findings now, and those that had some before; the document itself comes
 * last, so whoever waits for it has all.
 */
static void publish_changed(struct lsp_session *session, struct lsp_document *document)
{
    struct arg_list paths = {0};
    add_path(&paths, document->path);
    for (size_t i = 0; i < document->findings.len; ++i)
        add_path(&paths, document->findings.items[i].path);
    size_t num_told = paths.len;
    for (size_t i = 0; i < document->told.len; ++i)
        add_path(&paths, document->told.items[i]);
    for (size_t i = paths.len; i-- > 0;)
        publish(session, document, paths.items[i]);
    args_free(&document->told);
    for (size_t i = 0; i < num_told; ++i)
        add_path(&document->told, paths.items[i]);
    args_free(&paths);
}

void diagnostics_forget(struct lsp_session *session, struct lsp_document *document)
{
    findings_clear(&document->findings);
    publish_changed(session, document);
    args_free(&document->told);
}

/* ---- Checking ---- */

struct lsp_check *lsp_session_begin_check(struct lsp_session *session)
{
    struct lsp_document *document = session->documents;
    while (document && !document->is_dirty)
        document = document->next;
    return document ? check_create(session, document) : NULL;
}

/* The findings become those of the document, and so does what was read, if it is good for more. */
static void take(struct lsp_document *document, struct lsp_check *check)
{
    struct findings old = document->findings;
    document->findings = check->findings;
    check->findings = old;
    if (check->read && (check->is_xml || !document->parsed)) {
        check_destroy(document->check);
        document->check = check;
        document->parsed = check->read;
    } else {
        check_destroy(check);
    }
}

void lsp_session_end_check(struct lsp_session *session, struct lsp_check *check)
{
    struct lsp_document *document = lsp_find_path(session, check->path);
    if (!document || document->edition != check->edition) {
        check_destroy(check);
        return;
    }
    document->is_dirty = false;
    take(document, check);
    publish_changed(session, document);
}

void diagnostics_settle(struct lsp_session *session, struct lsp_document *document)
{
    struct lsp_check *check = document->is_dirty ? check_create(session, document) : NULL;
    if (!check)
        return;
    lsp_check_run(check);
    lsp_session_end_check(session, check);
}
