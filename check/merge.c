// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen check merge: merges the JSON reports of shards into one run and writes any report from it.
 * Documents follow their index.
 */
#include "check/check.h"
#include "check/record_io.h"
#include "check/report_reader.h"

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
            part->reader.fault = "a document in it cannot be read";
    }
    if (part->reader.fault)
        fail(merge, part->path, part->reader.fault);
}

/* "shard": {"number": 2, "count": 8}; 0 if the report is no shard. */
static uint64_t shard_of(const struct part *part, const char *key)
{
    return json_count_of(json_object_get(part->reader.header, "shard"), key);
}

static void read_targets(struct merge *merge)
{
    const json_t *targets = json_object_get(merge->parts[0].reader.header, "targets");
    for (size_t i = 0; i < json_array_size(targets); ++i) {
        const char *name = json_string_value(json_array_get(targets, i));
        args_append(&merge->targets, name ? name : "");
    }
}

/* True if the parts are all shards of one run. */
static bool are_complete(struct merge *merge)
{
    uint64_t expected = shard_of(&merge->parts[0], "count");
    if (expected > MAX_SHARDS) {
        fail(merge, merge->parts[0].path, "it is of more shards than there can be");
        return false;
    }
    bool *seen = calloc((size_t)merge->num_parts + 1, sizeof *seen);
    for (size_t i = 0; seen && i < merge->num_parts; ++i) {
        uint64_t number = shard_of(&merge->parts[i], "number");
        if (shard_of(&merge->parts[i], "count") != expected)
            report_error(&merge->cli.report, "shard-other",
                         "'%s' and '%s' are not shards of the same run", merge->parts[i].path,
                         merge->parts[0].path);
        if (number <= merge->num_parts)
            seen[number] = true;
    }
    for (uint64_t number = 1; seen && number <= expected && expected; ++number)
        if (number > merge->num_parts || !seen[number])
            report_error(&merge->cli.report, "shard-missing",
                         "shard %" PRIu64 " of %" PRIu64 " is missing", number, expected);
    free(seen);
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

static void report_all(struct merge *merge)
{
    uint64_t expected = 0;
    for (size_t i = 0; i < merge->num_parts; ++i)
        advance(merge, &merge->parts[i]);
    for (struct part *part; (part = find_next(merge)) != NULL; advance(merge, part)) {
        if (part->document->index < expected)
            report_error(&merge->cli.report, "shard-twice",
                         "'%s' contains document %" PRIu64
                         ", '%s', but another shard contains it too",
                         part->path, part->document->index, part->document->file);
        else
            reports_document(&merge->reports, part->document);
        expected = part->document->index + 1;
    }
}

static int run(struct merge *merge)
{
    if (!open_parts(merge))
        return EXIT_FAULT;
    const json_t *header = merge->parts[0].reader.header;
    merge->reports.run = (struct check_run){
        .targets = merge->targets.items,
        .num_targets = merge->targets.len,
        .quiet = merge->cli.quiet,
        .verbose = merge->cli.verbose,
        .compiles = json_is_true(json_object_get(header, "compiles")),
        .is_compared = json_is_true(json_object_get(header, "compared")),
        .with_times = merge->stats,
    };
    if (!reports_begin(&merge->reports, &merge->cli.report))
        return EXIT_FAULT;
    report_all(merge);
    reports_end(&merge->reports, &merge->cli.report, merge->cli.report.errors == 0);
    return merge->cli.report.errors || !reports_are_good(&merge->reports) ? EXIT_FAULT : EXIT_DONE;
}

static int run_if_sensible(struct merge *merge)
{
    const char *misuse = reports_misuse(&merge->reports);
    if (misuse)
        fprintf(stderr, "mxgen: %s\n", misuse);
    return misuse ? EXIT_USAGE : run(merge);
}

int check_merge(const struct command *command, int argc, char **argv)
{
    struct merge merge = {0};
    struct arg args[4 + NUM_SINK_KINDS] = {
        {"stats", 0, ARG_FLAG, NULL, "prints times, the slowest documents and the largest shaders",
         &merge.stats},
    };
    size_t num_args = 1 + reports_args(&merge.reports, args + 1);
    int code;
    if (cli_start(&merge.cli, command, args, num_args, CLI_NEEDS_INPUT | CLI_LIBRARY_IS_INPUT, argc,
                  argv, &code))
        code = run_if_sensible(&merge);
    for (size_t i = 0; i < merge.num_parts; ++i) {
        reader_close(&merge.parts[i].reader);
        store_finish(&merge.parts[i].store);
    }
    free(merge.parts);
    free(merge.targets.items);
    cli_finish(&merge.cli);
    return code;
}
