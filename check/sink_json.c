// SPDX-License-Identifier: Apache-2.0
/* --json: everything, with a document on each line (docs/check.md, docs/check.schema.json). */
#include "check/sink.h"

static void begin(struct sink *sink)
{
    struct json_writer json = {.out = sink->out};
    json_begin(&json, '{');
    json_put_string(&json, "format", "mxgen-check");
    json_put_count(&json, "version", CHECK_FORMAT_VERSION);
    json_put_string(&json, "mxgen", mxg_version_string());
    json_key(&json, "targets");
    json_begin(&json, '[');
    for (size_t i = 0; i < sink->run->num_targets; ++i)
        json_string(&json, sink->run->targets[i]);
    json_end(&json, ']');
    json_key(&json, "compiles");
    json_bool(&json, sink->run->compiles);
    if (sink->run->is_compared && sink->kind == &sink_json) {
        json_key(&json, "compared");
        json_bool(&json, true);
    }
    if (sink->run->num_shards) {
        json_key(&json, "shard");
        json_begin(&json, '{');
        json_put_count(&json, "number", sink->run->shard);
        json_put_count(&json, "count", sink->run->num_shards);
        json_end(&json, '}');
    }
    json_key(&json, "documents");
    json_begin(&json, '[');
}

static void write_document(struct sink *sink, const struct check_document *document)
{
    fputs(sink->num_documents ? ",\n" : "\n", sink->out);
    check_write_document(sink->out, document, sink->run->with_times);
}

static void put_stages(struct json_writer *json, const struct check_totals *totals)
{
    json_key(json, "stages");
    json_begin(json, '{');
    for (int stage = 0; stage < NUM_CHECK_STAGES; ++stage)
        json_put_count(json, check_stage_name((enum check_stage)stage), totals->failed[stage]);
    json_end(json, '}');
}

static void put_changes(struct json_writer *json, const struct check_totals *totals)
{
    json_key(json, "changes");
    json_begin(json, '{');
    for (int kind = 0; kind < NUM_CHECK_CHANGES; ++kind)
        json_put_count(json, check_change_name((enum check_change_kind)kind),
                       totals->changes[kind]);
    json_end(json, '}');
}

static void end(struct sink *sink, const struct check_totals *totals)
{
    struct json_writer json = {.out = sink->out};
    fputc('\n', sink->out);
    json_end(&json, ']');
    json_key(&json, "summary");
    json_begin(&json, '{');
    json_key(&json, "documents");
    json_count(&json, totals->documents);
    json_key(&json, "failed");
    json_count(&json, totals->documents - totals->failed[CHECK_PASSED]);
    json_key(&json, "elements");
    json_count(&json, totals->elements);
    json_key(&json, "shaders");
    json_count(&json, totals->shaders);
    json_put_count(&json, "errors", totals->errors);
    json_put_count(&json, "warnings", totals->warnings);
    put_stages(&json, totals);
    if (sink->run->is_compared && sink->kind == &sink_json)
        put_changes(&json, totals);
    json_end(&json, '}');
    json_end(&json, '}');
    fputc('\n', sink->out);
}

/*
 * A baseline: the same without pictures, of which signatures are enough, and without what came of a
 * comparison.
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
    "baseline", "compares with this report of an earlier run; writes it where there is none", begin,
    write_plain, end};
const struct sink_kind sink_json = {"json", "writes all that was found as JSON", begin,
                                    write_document, end};
