// SPDX-License-Identifier: Apache-2.0
/*
 * --sarif: the messages, for code review tools. OASIS SARIF 2.1.0; section numbers below refer to
 * it.
 */
#include "program/json_values.h"
#include "check/below_root.h"
#include "check/sink.h"
#include "program/name_table.h"

#include <ctype.h>
#include <inttypes.h>
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

/*
 * Section 3.28. A region ends at the column after its last character (3.30.8); without an end it
 * would reach to the end of the line.
 */
static json_t *make_location(const char *file, uint32_t line, uint32_t column, uint32_t length)
{
    struct store store = {0};
    json_t *place = json_pack("{s:{s:s}}", "artifactLocation", "uri", uri_of(&store, file));
    store_finish(&store);
    json_t *region = json_object();
    json_set_count(region, "startLine", line);
    json_set_count(region, "startColumn", column);
    if (column)
        json_set_count(region, "endColumn", (uint64_t)column + (length ? length : 1));
    if (line)
        json_object_set(place, "region", region);
    json_decref(region);
    return json_pack("{s:o}", "physicalLocation", place);
}

/* The notes (3.27.22): each a place with its text. */
static json_t *make_related(const struct check_message *message)
{
    json_t *related = json_array();
    for (size_t i = 0; i < message->num_notes; ++i) {
        const struct check_note *note = &message->notes[i];
        json_t *location = *note->file
                               ? make_location(note->file, note->line, note->column, note->length)
                               : json_object();
        json_object_set_new(location, "message", json_pack("{s:o}", "text", json_text(note->text)));
        json_array_append_new(related, location);
    }
    return related;
}

/*
 * Section 3.27.17: what identifies a result although its document changes around it. Results of
 * one hash have numbers.
 */
static json_t *make_fingerprints(const struct check_document *document,
                                 const struct check_message *message, struct name_table *seen)
{
    char text[48];
    bool is_new;
    snprintf(text, sizeof text, "%016" PRIx64, place_hash(document, message));
    uint64_t number = ++names_add(seen, text, &is_new)->value;
    snprintf(text + 16, sizeof text - 16, ":%" PRIu64, number);
    return json_pack("{s:s}", "mxgenMessage/v1", text);
}

static void write_result(struct sink *sink, const struct check_document *document,
                         const struct check_message *message, struct name_table *seen)
{
    static const char *const levels[] = {"error", "warning", "note"};
    struct sarif_state *state = sink->state;
    json_t *result =
        json_pack("{s:s, s:s, s:{s:o}}", "ruleId", message->id, "level", levels[message->severity],
                  "message", "text", json_text(message->text));
    if (*message->file)
        json_object_set_new(result, "locations",
                            json_pack("[o]", make_location(message->file, message->line,
                                                           message->column, message->length)));
    if (message->num_notes)
        json_object_set_new(result, "relatedLocations", make_related(message));
    json_object_set_new(result, "partialFingerprints", make_fingerprints(document, message, seen));
    json_set_text(result, "baselineState", message->state);
    note_id(state, message->id);
    fputs(state->comma ? ",\n" : "\n", sink->out);
    state->comma = true;
    json_dumpf(result, sink->out, JSON_STYLE);
    json_decref(result);
}

static void write_document(struct sink *sink, const struct check_document *document)
{
    struct name_table seen = {0};
    for (size_t i = 0; sink->state && i < document->num_messages; ++i)
        write_result(sink, document, &document->messages[i], &seen);
    for (size_t i = 0; sink->state && i < document->num_gone_messages; ++i)
        write_result(sink, document, &document->gone_messages[i], &seen);
    names_finish(&seen);
}

/* The cause and the cure from 'mxgen explain' (3.49). */
static json_t *make_rule(const char *id)
{
    mxg_diagnostic_kind kind = {sizeof kind};
    json_t *rule = json_pack("{s:s}", "id", id);
    uint32_t i = 0;
    while (mxg_catalogue_diagnostic_kind(i, &kind) == MXG_OK && strcmp(kind.id, id) != 0)
        ++i;
    if (i == mxg_catalogue_num_diagnostic_kinds())
        return rule;
    json_object_set_new(rule, "helpUri", json_sprintf(MESSAGES_URL "#%s", id));
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

const struct sink_kind sink_sarif = {
    "sarif", "writes the messages as SARIF 2.1.0", begin, write_document, write_document, end};
