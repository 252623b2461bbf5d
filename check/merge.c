// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen check merge: merges the JSON reports of shards into one run and writes any report from it.
 * Documents follow their index.
 */
#define _POSIX_C_SOURCE 200809L
#include "check/check.h"
#include "check/gate.h"
#include "program/json_values.h"
#include "check/record_json.h"
#include "check/report_reader.h"
#include "program/memory.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

struct part {
    const char *path;
    struct report_reader reader;
    struct store store;
    struct check_document *document; /* the next document; NULL: no more */
};

struct merge {
    struct cli cli;
    struct arg_list targets;
    struct check_reports reports;
    struct gate gate;
    bool stats;
    struct part *parts;
    size_t num_parts;
};

static void fail(struct merge *merge, const char *path, const char *reason)
{
    report_error(&merge->cli.report, "report-unreadable", "cannot read '%s': %s", path, reason);
}

static void advance(struct merge *merge, struct part *part)
{
    store_finish(&part->store);
    part->document = NULL;
    if (reader_next(&part->reader, NULL)) {
        part->document = record_from_json(&part->store, part->reader.document);
        if (!part->document)
            part->reader.fault = REPORT_DOCUMENT_DAMAGED;
    }
    if (part->reader.fault)
        fail(merge, part->path, part->reader.fault);
}

/* "shard": {"number": 2, "count": 8}; 0 if the report is no shard. */
static uint64_t shard_of(const struct part *part, const char *key)
{
    return json_count_of(json_object_get(part->reader.header, "shard"), key);
}

static bool is_compared(const struct merge *merge)
{
    return json_is_true(json_object_get(merge->parts[0].reader.header, "compared"));
}

static void read_targets(struct merge *merge)
{
    const json_t *targets = json_object_get(merge->parts[0].reader.header, "targets");
    for (size_t i = 0; i < json_array_size(targets); ++i) {
        const char *name = json_string_value(json_array_get(targets, i));
        args_append(&merge->targets, name ? name : "");
    }
}

/* True if two reports are of one run: their heads are equal, but for the number of the shard. */
static bool is_same_run(const struct part *a, const struct part *b)
{
    json_t *left = json_deep_copy(a->reader.header), *right = json_deep_copy(b->reader.header);
    json_object_del(json_object_get(left, "shard"), "number");
    json_object_del(json_object_get(right, "shard"), "number");
    bool is_same = json_equal(left, right);
    json_decref(left);
    json_decref(right);
    return is_same;
}

static void tell_other(struct merge *merge, const struct part *part, const char *why)
{
    report_error(&merge->cli.report, "shard-other",
                 "'%s' and '%s' are not shards of the same run%s", part->path, merge->parts[0].path,
                 why);
}

/* Once all documents are read: shards that could be read have seen the same list of documents. */
static void compare_lists(struct merge *merge)
{
    for (size_t i = 1; i < merge->num_parts; ++i) {
        const json_t *first = json_object_get(merge->parts[0].reader.tail, "summary"),
                     *other = json_object_get(merge->parts[i].reader.tail, "summary");
        if (first && other && strcmp(json_text_of(first, "list"), json_text_of(other, "list")) != 0)
            tell_other(merge, &merge->parts[i], ": their lists of documents differ");
    }
}

/* Reports shards of other runs, and shards that are there twice; fills in the first of each. */
static void find_first(struct merge *merge, const struct part **first, uint64_t count)
{
    for (size_t i = 0; i < merge->num_parts; ++i) {
        const struct part *part = &merge->parts[i];
        uint64_t number = shard_of(part, "number");
        if (!is_same_run(part, &merge->parts[0]) || number < 1 || number > count)
            tell_other(merge, part, "");
        else if (first[number - 1])
            report_error(&merge->cli.report, "shard-twice",
                         "'%s' and '%s' are both shard %" PRIu64 " of %" PRIu64,
                         first[number - 1]->path, part->path, number, count);
        else
            first[number - 1] = part;
    }
}

/* "3, 5, 7" */
static char *list_missing(const struct part *const *first, uint64_t count, uint64_t *out_num)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    *out_num = 0;
    for (uint64_t i = 0; i < count && out; ++i)
        if (!first[i])
            fprintf(out, "%s%" PRIu64, (*out_num)++ ? ", " : "", i + 1);
    if (out)
        fclose(out);
    return text;
}

/* True if the parts are all shards of one run; a report that is no shard is complete alone. */
static bool are_complete(struct merge *merge)
{
    uint64_t count = shard_of(&merge->parts[0], "count"), num_missing;
    if (merge->num_parts == 1 && !json_object_get(merge->parts[0].reader.header, "shard"))
        return true;
    if (count > MAX_SHARDS) {
        fail(merge, merge->parts[0].path, "it is of more shards than there can be");
        return false;
    }
    const struct part **first = memory_alloc((size_t)(count + 1) * sizeof *first);
    find_first(merge, first, count);
    char *missing = list_missing(first, count, &num_missing);
    if (num_missing)
        report_error(&merge->cli.report, "shard-missing",
                     num_missing == 1 ? "shard %s of %" PRIu64 " is missing"
                                      : "shards %s of %" PRIu64 " are missing",
                     missing ? missing : "", count);
    free(missing);
    free(first);
    return merge->cli.report.errors == 0;
}

static bool open_parts(struct merge *merge)
{
    const struct arg_list *paths = &merge->cli.parser.inputs;
    merge->parts = calloc(paths->len, sizeof *merge->parts);
    merge->num_parts = merge->parts ? paths->len : 0;
    for (size_t i = 0; i < merge->num_parts; ++i) {
        merge->parts[i].path = paths->items[i];
        if (!reader_open(&merge->parts[i].reader, paths->items[i]))
            fail(merge, paths->items[i], merge->parts[i].reader.fault);
    }
    if (!merge->num_parts || merge->cli.report.errors || !are_complete(merge))
        return false;
    read_targets(merge);
    return true;
}

/* The part with the next document. */
static struct part *find_next(const struct merge *merge)
{
    struct part *found = NULL;
    for (size_t i = 0; i < merge->num_parts; ++i) {
        struct part *part = &merge->parts[i];
        if (part->document && (!found || part->document->index < found->document->index))
            found = part;
    }
    return found;
}

/* The shards may have been compared; the merge compares their documents again. */
static void report_part(struct merge *merge, struct part *part)
{
    struct check_document *document = part->document;
    gate_compare(&merge->gate, &merge->reports, &part->store, document, &merge->cli.report);
    reports_document(&merge->reports, document);
}

static void report_all(struct merge *merge)
{
    for (size_t i = 0; i < merge->num_parts; ++i)
        advance(merge, &merge->parts[i]);
    for (struct part *part; (part = find_next(merge)) != NULL; advance(merge, part))
        report_part(merge, part);
    compare_lists(merge);
    gate_tell_gone(&merge->gate, &merge->reports);
}

/* The merge compares anew, because shards do not know which documents are gone. */
static bool has_baseline(struct merge *merge)
{
    bool good = merge->gate.path || !is_compared(merge);
    if (!good)
        report_error(&merge->cli.report, "baseline-missing",
                     "'%s' is compared with a baseline, which the merge needs too: --baseline FILE",
                     merge->parts[0].path);
    return good;
}

/* A baseline whose documents are all unknown here has other names for them. */
static void find_other_root(struct merge *merge)
{
    const struct gate *gate = &merge->gate;
    if (merge->reports.run.is_compared && merge->reports.totals.documents
        && gate->baseline.offsets.num_entries && !gate->baseline.num_compared && !gate->update)
        report_error(&merge->cli.report, "baseline-other",
                     "'%s' is the baseline of another run: it has none of these documents, perhaps "
                     "because their root is another (--root)",
                     gate->path);
}

static void describe_run(struct merge *merge)
{
    const json_t *header = merge->parts[0].reader.header;
    struct check_run *run = &merge->reports.run;
    run->targets = merge->targets.items;
    run->num_targets = merge->targets.len;
    run->quiet = merge->cli.quiet;
    run->verbose = merge->cli.verbose;
    run->compiles = json_is_true(json_object_get(header, "compiles"));
    run->with_times = merge->stats;
}

/* False after an error: a report would overwrite a part or another report. */
static bool claim_outputs(struct merge *merge)
{
    struct outputs outputs = {0};
    bool good = true;
    for (size_t i = 0; i < merge->num_parts; ++i)
        good = outputs_read(&outputs, &merge->cli.report, merge->parts[i].path) && good;
    good = reports_claim(&merge->reports, &outputs, &merge->cli.report) && good;
    outputs_finish(&outputs);
    return good;
}

static int run(struct merge *merge)
{
    if (!open_parts(merge) || !has_baseline(merge))
        return EXIT_FAULT;
    describe_run(merge);
    if (!claim_outputs(merge) || !gate_open(&merge->gate, &merge->reports, NULL, &merge->cli.report)
        || !reports_begin(&merge->reports, &merge->cli.report))
        return EXIT_FAULT;
    report_all(merge);
    find_other_root(merge);
    reports_end(&merge->reports, &merge->cli.report, merge->cli.report.errors == 0);
    return merge->cli.report.errors || !reports_are_good(&merge->reports) ? EXIT_FAULT : EXIT_DONE;
}

static int run_if_sensible(struct merge *merge)
{
    const char *misuse = reports_misuse(&merge->reports);
    if (misuse)
        fprintf(stderr, "mxgen: %s\n", misuse);
    return misuse || !gate_parse(&merge->gate, &merge->reports) ? EXIT_USAGE : run(merge);
}

int check_merge(const struct command *command, int argc, char **argv)
{
    struct merge merge = {0};
    struct arg args[4 + NUM_GATE_ARGS + NUM_SINK_KINDS] = {
        {"stats", 0, ARG_FLAG, NULL, "prints times, the slowest documents and the largest shaders",
         &merge.stats},
    };
    size_t num_args = 1 + reports_args(&merge.reports, args + 1);
    num_args += gate_args(&merge.gate, args + num_args);
    int code;
    if (cli_start(&merge.cli, command, args, num_args, CLI_NEEDS_INPUT | CLI_LIBRARY_IS_INPUT, argc,
                  argv, &code))
        code = run_if_sensible(&merge);
    for (size_t i = 0; i < merge.num_parts; ++i) {
        reader_close(&merge.parts[i].reader);
        store_finish(&merge.parts[i].store);
    }
    gate_finish(&merge.gate);
    free(merge.parts);
    free(merge.targets.items);
    cli_finish(&merge.cli);
    return code;
}
