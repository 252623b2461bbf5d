// SPDX-License-Identifier: Apache-2.0
/*
 * --json: all data, with one document per line (docs/check.md, docs/check.schema.json). The report
 * is one object, and the sink writes its members as they arrive.
 */
#include "program/json_values.h"
#include "check/below_root.h"
#include "check/record_json.h"
#include "check/sink.h"

#include <inttypes.h>
#include <stdio.h>

/* Writes the members without the braces around them. */
static void write_members(FILE *out, json_t *members)
{
    json_dumpf(members, out, JSON_STYLE | JSON_EMBED);
    json_decref(members);
}

static void begin(struct sink *sink)
{
    const struct check_run *run = sink->run;
    json_t *header = json_pack("{s:s, s:i, s:s}", "format", "mxgen-check", "version",
                               CHECK_FORMAT_VERSION, "mxgen", mxg_version_string());
    json_t *targets = json_array();
    for (size_t i = 0; i < run->num_targets; ++i)
        json_array_append_new(targets, json_text(run->targets[i]));
    json_object_set_new(header, "targets", targets);
    json_object_set_new(header, "compiles", json_boolean(run->compiles));
    if (run->is_compared && sink->kind == &sink_json)
        json_object_set_new(header, "compared", json_true());
    if (run->num_shards)
        json_object_set_new(header, "shard",
                            json_pack("{s:I, s:I}", "number", (json_int_t)run->shard, "count",
                                      (json_int_t)run->num_shards));
    putc('{', sink->out);
    write_members(sink->out, header);
    fputs(",\"documents\":[", sink->out);
}

static void write_document(struct sink *sink, const struct check_document *document)
{
    json_t *record = record_to_json(document, sink->run->with_times);
    fputs(sink->num_documents ? ",\n" : "\n", sink->out);
    json_dumpf(record, sink->out, JSON_STYLE);
    json_decref(record);
}

/* Ends the documents, and begins the documents that are gone. */
static void write_gone(struct sink *sink, const struct check_document *document)
{
    json_t *record = record_to_json(document, false);
    fputs(sink->num_gone ? ",\n" : "\n],\"gone\":[\n", sink->out);
    json_dumpf(record, sink->out, JSON_STYLE);
    json_decref(record);
}

/* An object with the nonzero counts, by their names. */
static json_t *make_counts(const char *const *names, const uint64_t *counts, size_t num)
{
    json_t *object = json_object();
    for (size_t i = 0; i < num; ++i)
        json_set_count(object, names[i], counts[i]);
    return object;
}

static void put_list(json_t *summary, uint64_t hash)
{
    char text[17];
    snprintf(text, sizeof text, "%016" PRIx64, hash);
    json_set_text(summary, "list", text);
}

static void end(struct sink *sink, const struct check_totals *totals)
{
    json_t *summary =
        json_pack("{s:I, s:I, s:I, s:I}", "documents", (json_int_t)totals->documents, "failed",
                  (json_int_t)(totals->documents - totals->failed[CHECK_PASSED]), "elements",
                  (json_int_t)totals->elements, "shaders", (json_int_t)totals->shaders);
    json_set_count(summary, "errors", totals->errors);
    json_set_count(summary, "warnings", totals->warnings);
    json_object_set_new(summary, "failures",
                        make_counts(check_failure_names, totals->failed, NUM_CHECK_FAILURES));
    if (sink->run->is_compared && sink->kind == &sink_json)
        json_object_set_new(summary, "changes",
                            make_counts(check_change_names, totals->changes, NUM_CHECK_CHANGES));
    if (sink->run->num_shards)
        put_list(summary, sink->run->list_hash);
    fputs("\n],", sink->out);
    write_members(sink->out, json_pack("{s:o}", "summary", summary));
    fputs("}\n", sink->out);
}

/* ---- Baselines ---- */

static struct check_message *plain_messages(struct store *store,
                                            const struct check_document *document)
{
    struct check_message *messages = store_array(store, document->num_messages, sizeof *messages);
    for (size_t i = 0; i < document->num_messages; ++i) {
        const struct check_message *message = &document->messages[i];
        messages[i] = *message;
        messages[i].file = place_name(store, document, message->file);
        messages[i].text = place_text(store, document, message->text);
        messages[i].rendered = messages[i].state = "";
        messages[i].num_notes = 0;
    }
    return messages;
}

static struct check_element *plain_elements(struct store *store,
                                            const struct check_document *document)
{
    struct check_element *elements = store_array(store, document->num_elements, sizeof *elements);
    for (size_t i = 0; i < document->num_elements; ++i) {
        elements[i] = document->elements[i];
        elements[i].picture = elements[i].full = elements[i].drawn_error = "";
        elements[i].slabs = "";
        elements[i].num_steps = 0;
        elements[i].shaders =
            store_array(store, elements[i].num_shaders, sizeof *elements[i].shaders);
        for (size_t k = 0; k < elements[i].num_shaders; ++k) {
            elements[i].shaders[k] = document->elements[i].shaders[k];
            elements[i].shaders[k].num_parts = 0;
        }
    }
    return elements;
}

/*
 * A baseline is a report of the facts that a comparison needs, with names below the root: it does
 * not depend on the folder of the run.
 */
static void write_plain(struct sink *sink, const struct check_document *document)
{
    struct check_document plain = *document;
    struct store store = {0};
    plain.file = *document->name ? document->name : document->file;
    plain.messages = plain_messages(&store, document);
    plain.elements = plain_elements(&store, document);
    plain.num_files = plain.num_folders = plain.num_images = 0;
    plain.num_changes = plain.num_gone_messages = 0;
    write_document(sink, &plain);
    store_finish(&store);
}

const struct sink_kind sink_baseline = {
    "baseline", "compares with this stored report; --update-baseline writes it",
    begin,      write_plain,
    NULL,       end};
const struct sink_kind sink_json = {
    "json", "writes the full report as JSON", begin, write_document, write_gone, end};
