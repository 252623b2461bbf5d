// SPDX-License-Identifier: Apache-2.0
/*
 * --sarif: the messages, for code review tools. OASIS SARIF 2.1.0; section numbers below refer to
 * it.
 */
#include "check/json.h"
#include "check/sink.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* The message ids so far, for the list of rules. */
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

/* Section 3.27.12; a region ends at the column after its last character (3.30.8). */
static json_t *make_location(const struct check_message *message)
{
    struct store store = {0};
    json_t *place =
        json_pack("{s:{s:s}}", "artifactLocation", "uri", uri_of(&store, message->file));
    store_finish(&store);
    json_t *region = json_object();
    json_set_count(region, "startLine", message->line);
    json_set_count(region, "startColumn", message->column);
    if (message->column && message->length)
        json_set_count(region, "endColumn", message->column + message->length);
    if (message->line)
        json_object_set(place, "region", region);
    json_decref(region);
    return json_pack("{s:o}", "physicalLocation", place);
}

static void write_result(struct sink *sink, const struct check_message *message)
{
    static const char *const levels[] = {"error", "warning", "note"};
    struct sarif_state *state = sink->state;
    json_t *result =
        json_pack("{s:s, s:s, s:{s:o}}", "ruleId", message->id, "level", levels[message->severity],
                  "message", "text", json_text(message->text));
    if (*message->file)
        json_object_set_new(result, "locations", json_pack("[o]", make_location(message)));
    note_id(state, message->id);
    fputs(state->comma ? ",\n" : "\n", sink->out);
    state->comma = true;
    json_dumpf(result, sink->out, JSON_STYLE);
    json_decref(result);
}

static void write_document(struct sink *sink, const struct check_document *document)
{
    for (size_t i = 0; sink->state && i < document->num_messages; ++i)
        write_result(sink, &document->messages[i]);
}

/* The cause and the cure from 'mxgen explain' (3.49). */
static json_t *make_rule(const char *id)
{
    mxg_diagnostic_kind kind = {sizeof kind};
    json_t *rule = json_pack("{s:s}", "id", id);
    uint32_t i = 0;
    while (mxg_get_diagnostic_kind(i, &kind) == MXG_OK && strcmp(kind.id, id) != 0)
        ++i;
    if (i == mxg_num_diagnostic_kinds())
        return rule;
    if (*kind.cause)
        json_object_set_new(rule, "fullDescription", json_pack("{s:s}", "text", kind.cause));
    if (*kind.cure)
        json_object_set_new(rule, "help", json_pack("{s:s}", "text", kind.cure));
    return rule;
}

static void end(struct sink *sink, const struct check_totals *totals)
{
    struct sarif_state *state = sink->state;
    json_t *rules = json_array();
    (void)totals;
    for (size_t i = 0; state && i < state->num_ids; ++i)
        json_array_append_new(rules, make_rule(state->ids[i]));
    json_t *driver = json_pack("{s:s, s:s, s:o}", "name", "mxgen", "version", mxg_version_string(),
                               "rules", rules);
    fputs("\n],\"tool\":{\"driver\":", sink->out);
    json_dumpf(driver, sink->out, JSON_STYLE);
    json_decref(driver);
    fputs("}}]}\n", sink->out);
    if (state)
        store_finish(&state->store);
    free(state);
}

const struct sink_kind sink_sarif = {"sarif", "writes the messages as SARIF 2.1.0", begin,
                                     write_document, end};
