// SPDX-License-Identifier: Apache-2.0
/* Code actions: the cures of messages in a range, and the upgrade of an older document. */
#include "lsp/cures.h"
#include "lsp/diagnostics.h"
#include "lsp/formatting.h"
#include "lsp/handlers.h"
#include "lsp/wire.h"

#include <stdlib.h>
#include <string.h>

/* True if the client asks for a kind of actions, or for all: "source" has "source.upgrade". */
static bool wants(const json_t *params, const char *kind)
{
    const json_t *only = json_object_get(json_object_get(params, "context"), "only"), *item;
    size_t index;
    bool is_wanted = !json_is_array(only);
    json_array_foreach(only, index, item)
    {
        const char *text = json_string_value(item);
        size_t len = text ? strlen(text) : 0;
        is_wanted |= text && strncmp(kind, text, len) == 0 && (kind[len] == '.' || !kind[len]);
    }
    return is_wanted;
}

/* The subject of a finding begins at its place, or one after it where that is a '<'. */
static void cure_finding(struct cure *cure, const struct finding *finding, struct span span)
{
    cure->finding = finding;
    cure->span = span;
    cure->query.offset = span.start + (cure->query.text->bytes[span.start] == '<');
    cure->place = query_place(&cure->query);
    if (cure->query.text->bytes[span.start] == '<' && cure->place.part == PLACE_CONTENT)
        cure->place.element = MODEL_NONE;
    cure->diagnostic =
        diagnostics_json(cure->query.session, cure->query.document, cure->query.text, finding);
    cures_add(cure);
    json_decref(cure->diagnostic);
}

static void add_cures(const struct lsp_query *query, struct span range, json_t *actions)
{
    struct cure cure = {.query = *query, .actions = actions};
    for (size_t i = 0; i < query->document->findings.len; ++i) {
        const struct finding *finding = &query->document->findings.items[i];
        struct span span =
            findings_span(query->text, finding->line, finding->column, finding->length);
        bool is_here = span.start <= range.end && span.end >= range.start;
        if (is_here && strcmp(finding->path, query->document->path) == 0)
            cure_finding(&cure, finding, span);
    }
}

/* True if the document says that it is older than 1.39. */
static bool is_old(const struct lsp_query *query)
{
    char version[QUERY_NAME];
    uint32_t root = query_root(query);
    query_text(query, root, "version", version, sizeof version);
    return strncmp(version, "1.", 2) == 0 && strtoul(version + 2, NULL, 10) < 39;
}

static void add_upgrade(const struct lsp_query *query, json_t *actions)
{
    json_t *edits = is_old(query) ? formatting_edits(query, MXG_REWRITE_UPGRADE) : NULL;
    if (!edits)
        return;
    json_t *action = json_object();
    json_object_set_new(action, "title", json_string("Upgrade the document to MaterialX 1.39"));
    json_object_set_new(action, "kind", json_string("source.upgrade"));
    json_object_set_new(action, "edit",
                        wire_add_edits(wire_workspace_edit(), query->document->uri, edits));
    json_array_append_new(actions, action);
}

json_t *handle_actions(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    struct span range;
    if (!lsp_query(session, params, &query, error)
        || !wire_read_range(session, query.text, json_object_get(params, "range"), &range))
        return NULL;
    json_t *actions = json_array();
    if (wants(params, "quickfix")) {
        diagnostics_settle(session, query.document);
        add_cures(&query, range, actions);
    }
    if (wants(params, "source.upgrade"))
        add_upgrade(&query, actions);
    return actions;
}
