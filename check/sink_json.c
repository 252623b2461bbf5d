// SPDX-License-Identifier: Apache-2.0
/*
 * --json: all data, with one document per line (docs/check.md, docs/check.schema.json). The report
 * is one object, and the sink writes its members as they arrive.
 */
#include "check/json.h"
#include "check/record_io.h"
#include "check/sink.h"

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

/* An object with the nonzero counts, by their names. */
static json_t *make_counts(const char *const *names, const uint64_t *counts, size_t num)
{
    json_t *object = json_object();
    for (size_t i = 0; i < num; ++i)
        json_set_count(object, names[i], counts[i]);
    return object;
}

static void end(struct sink *sink, const struct check_totals *totals)
{
    json_t *summary =
        json_pack("{s:I, s:I, s:I, s:I}", "documents", (json_int_t)totals->documents, "failed",
                  (json_int_t)(totals->documents - totals->failed[CHECK_PASSED]), "elements",
                  (json_int_t)totals->elements, "shaders", (json_int_t)totals->shaders);
    json_set_count(summary, "errors", totals->errors);
    json_set_count(summary, "warnings", totals->warnings);
    json_object_set_new(summary, "stages",
                        make_counts(check_stage_names, totals->failed, NUM_CHECK_STAGES));
    if (sink->run->is_compared && sink->kind == &sink_json)
        json_object_set_new(summary, "changes",
                            make_counts(check_change_names, totals->changes, NUM_CHECK_CHANGES));
    fputs("\n],", sink->out);
    write_members(sink->out, json_pack("{s:o}", "summary", summary));
    fputs("}\n", sink->out);
}

/*
 * A baseline: a report without pictures, because their signatures are enough, and without the
 * results of a comparison.
 */
static void write_plain(struct sink *sink, const struct check_document *document)
{
    struct check_document plain = *document;
    struct store store = {0};
    plain.num_changes = 0;
    plain.elements = store_array(&store, plain.num_elements, sizeof *plain.elements);
    for (size_t i = 0; i < plain.num_elements; ++i) {
        plain.elements[i] = document->elements[i];
        plain.elements[i].picture = "";
    }
    write_document(sink, &plain);
    store_finish(&store);
}

const struct sink_kind sink_baseline = {
    "baseline", "compares with this earlier JSON report, or writes it if it does not exist", begin,
    write_plain, end};
const struct sink_kind sink_json = {"json", "writes the full report as JSON", begin, write_document,
                                    end};
