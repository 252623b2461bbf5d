// SPDX-License-Identifier: Apache-2.0
/*
 * --sarif: the messages, for code review tools. OASIS SARIF 2.1.0; section numbers below are its
 * own.
 */
#include "check/sink.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* The ids that were met, for the list of rules. */
struct sarif_state {
    struct store store;
    const char **ids;
    size_t num_ids;
    bool comma;
};

static void begin(struct sink *sink)
{
    sink->state = calloc(1, sizeof(struct sarif_state));
    fputs("{\"$schema\":\"https://json.schemastore.org/sarif-2.1.0.json\",\"version\":\"2.1.0\","
          "\"runs\":[{\"columnKind\":\"unicodeCodePoints\",\"results\":[",
          sink->out);
}

static void note_id(struct sarif_state *state, const char *id)
{
    for (size_t i = 0; i < state->num_ids; ++i)
        if (strcmp(state->ids[i], id) == 0)
            return;
    state->ids = store_grow(&state->store, state->ids, state->num_ids, sizeof *state->ids);
    state->ids[state->num_ids++] = store_text(&state->store, id, strlen(id));
}

/* A path as URI reference (3.4.3; RFC 3986, 2.1). */
static char *uri_of(struct store *store, const char *path)
{
    char *uri = store_alloc(store, 3 * strlen(path) + 8), *out = uri;
    if (*path == '/')
        out += sprintf(out, "file://");
    for (; *path; ++path) {
        if (isalnum((unsigned char)*path) || strchr("-._~/", *path))
            *out++ = *path;
        else
            out += sprintf(out, "%%%02X", (unsigned char)*path);
    }
    return uri;
}

/* Section 3.27.12; the end of a region is the column behind it (3.30.8). */
static void put_location(struct json_writer *json, struct store *store,
                         const struct check_message *message)
{
    json_key(json, "locations");
    json_begin(json, '[');
    json_begin(json, '{');
    json_key(json, "physicalLocation");
    json_begin(json, '{');
    json_key(json, "artifactLocation");
    json_begin(json, '{');
    json_put_string(json, "uri", uri_of(store, message->file));
    json_end(json, '}');
    if (message->line) {
        json_key(json, "region");
        json_begin(json, '{');
        json_put_count(json, "startLine", message->line);
        json_put_count(json, "startColumn", message->column);
        json_put_count(json, "endColumn",
                       message->column && message->length ? message->column + message->length : 0);
        json_end(json, '}');
    }
    json_end(json, '}');
    json_end(json, '}');
    json_end(json, ']');
}

static void write_result(struct sink *sink, const struct check_message *message)
{
    static const char *const levels[] = {"error", "warning", "note"};
    struct sarif_state *state = sink->state;
    struct store store = {0};
    struct json_writer json = {.out = sink->out};
    note_id(state, message->id);
    fputs(state->comma ? ",\n" : "\n", sink->out);
    state->comma = true;
    json_begin(&json, '{');
    json_put_string(&json, "ruleId", message->id);
    json_put_string(&json, "level", levels[message->severity]);
    json_key(&json, "message");
    json_begin(&json, '{');
    json_put_string(&json, "text", message->text);
    json_end(&json, '}');
    if (*message->file)
        put_location(&json, &store, message);
    json_end(&json, '}');
    store_finish(&store);
}

static void write_document(struct sink *sink, const struct check_document *document)
{
    for (size_t i = 0; sink->state && i < document->num_messages; ++i)
        write_result(sink, &document->messages[i]);
}

static void put_text(struct json_writer *json, const char *key, const char *text)
{
    if (!*text)
        return;
    json_key(json, key);
    json_begin(json, '{');
    json_put_string(json, "text", text);
    json_end(json, '}');
}

/* What 'mxgen explain' says of an id (3.49). */
static void write_rule(struct json_writer *json, const char *id)
{
    mxg_diagnostic_kind kind = {sizeof kind};
    uint32_t i = 0;
    while (mxg_get_diagnostic_kind(i, &kind) == MXG_OK && strcmp(kind.id, id) != 0)
        ++i;
    json_begin(json, '{');
    json_put_string(json, "id", id);
    if (i < mxg_num_diagnostic_kinds()) {
        put_text(json, "fullDescription", kind.cause);
        put_text(json, "help", kind.cure);
    }
    json_end(json, '}');
}

static void end(struct sink *sink, const struct check_totals *totals)
{
    struct sarif_state *state = sink->state;
    struct json_writer json = {.out = sink->out};
    (void)totals;
    fputs("\n],\"tool\":{\"driver\":", sink->out);
    json_begin(&json, '{');
    json_put_string(&json, "name", "mxgen");
    json_put_string(&json, "version", mxg_version_string());
    json_key(&json, "rules");
    json_begin(&json, '[');
    for (size_t i = 0; state && i < state->num_ids; ++i)
        write_rule(&json, state->ids[i]);
    json_end(&json, ']');
    json_end(&json, '}');
    fputs("}}]}\n", sink->out);
    if (state)
        store_finish(&state->store);
    free(state);
}

const struct sink_kind sink_sarif = {"sarif", "writes the messages as SARIF 2.1.0", begin,
                                     write_document, end};
