// SPDX-License-Identifier: Apache-2.0
#include "check/gate.h"

#include "program/cli.h"
#include "program/files.h"

#include <stdlib.h>
#include <string.h>

size_t gate_args(struct gate *gate, struct arg *args)
{
    args[0] = (struct arg){
        "update-baseline", 0, ARG_FLAG, NULL, "writes the baseline, and accepts what has changed",
        &gate->update};
    args[1] = (struct arg){"fail-on",
                           0,
                           ARG_LIST,
                           "KIND,...",
                           "changes that fail the run besides new failures: fixed, new-warnings, "
                           "topology, size, values, textures, picture, new, gone, ... or all",
                           &gate->fail_on};
    return NUM_GATE_ARGS;
}

/* ---- Arguments ---- */

/* Adds the kind of a word to the set; false after a message. */
static bool add_kind(check_change_set *set, const char *word)
{
    if (strcmp(word, "all") == 0) {
        *set = (1u << NUM_CHECK_CHANGES) - 1u;
        return true;
    }
    for (int kind = 0; kind < NUM_CHECK_CHANGES; ++kind) {
        if (strcmp(word, check_change_names[kind]) == 0) {
            *set |= 1u << kind;
            return true;
        }
    }
    const char *near = args_closest(word, check_change_names, NUM_CHECK_CHANGES);
    fprintf(stderr, "mxgen: there is no kind of change '%s'%s%s%s; expected one of: all", word,
            near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
    for (int kind = 0; kind < NUM_CHECK_CHANGES; ++kind)
        fprintf(stderr, ", %s", check_change_names[kind]);
    fputc('\n', stderr);
    return false;
}

static bool parse_kinds(const struct arg_list *lists, check_change_set *set)
{
    bool good = true;
    for (size_t i = 0; i < lists->len; ++i) {
        for (const char *at = lists->items[i]; *at && good;) {
            size_t len = strcspn(at, ",");
            char *word = cli_copy(at, len);
            good = add_kind(set, word);
            free(word);
            at += len + (at[len] == ',');
        }
    }
    return good;
}

bool gate_parse(struct gate *gate, struct check_reports *reports)
{
    const char *misuse = NULL;
    gate->path = reports->paths[SINK_BASELINE];
    reports->run.fail_on = check_failing_changes;
    reports->run.accepts = gate->update;
    if (gate->update && !gate->path)
        misuse = "--update-baseline needs the file: --baseline FILE";
    else if (gate->fail_on.len && !gate->path)
        misuse = "--fail-on compares with a baseline: --baseline FILE";
    else if (gate->update && reports->run.num_shards)
        misuse = "a shard cannot write the baseline of the whole run; use 'mxgen check merge "
                 "SHARD... --baseline FILE --update-baseline'";
    if (misuse)
        fprintf(stderr, "mxgen: %s\n", misuse);
    return !misuse && parse_kinds(&gate->fail_on, &reports->run.fail_on);
}

/* ---- The baseline ---- */

/* The reason why the run cannot be compared, which the caller frees; NULL: it can. */
static char *find_mismatch(struct gate *gate, const struct check_run *run, const char *root)
{
    char *reason =
        baseline_find_mismatch(&gate->baseline, run->targets, run->num_targets, run->compiles);
    return !reason && root ? baseline_find_other_root(&gate->baseline, root) : reason;
}

/*
 * An update replaces a baseline of another run, and one that cannot be read, without a comparison.
 */
static bool open_existing(struct gate *gate, struct check_run *run, const char *root,
                          struct report *report)
{
    if (!baseline_open(&gate->baseline, gate->path)) {
        if (!gate->update)
            report_error(report, "report-unreadable", "cannot read '%s': %s", gate->path,
                         gate->baseline.reader.fault);
        return gate->update;
    }
    char *mismatch = find_mismatch(gate, run, root);
    if (mismatch && !gate->update)
        report_error(report, "baseline-other", "'%s' is the baseline of another run: %s",
                     gate->path, mismatch);
    run->is_compared = !mismatch;
    free(mismatch);
    return run->is_compared || gate->update;
}

bool gate_open(struct gate *gate, struct check_reports *reports, const char *root,
               struct report *report)
{
    if (!gate->path)
        return true;
    if (!gate->update)
        reports->paths[SINK_BASELINE] = NULL;
    if (files_is_regular(gate->path))
        return open_existing(gate, &reports->run, root, report);
    if (!gate->update)
        report_error(report, "baseline-missing",
                     "there is no baseline '%s'; --update-baseline writes it", gate->path);
    return gate->update;
}

/* ---- Documents ---- */

void gate_compare(struct gate *gate, struct check_reports *reports, struct store *store,
                  struct check_document *document, struct report *report)
{
    if (gate->path && !*document->name && !gate->is_outside_told) {
        report_error(report, "outside-root",
                     "'%s' is not below the root, so a baseline cannot name it: name a folder "
                     "above it with --root DIR",
                     document->file);
        gate->is_outside_told = true;
        reports->files[SINK_BASELINE].fault = "a document is outside the root";
    }
    if (reports->run.is_compared)
        baseline_compare(&gate->baseline, store, document);
}

void gate_tell_gone(struct gate *gate, struct check_reports *reports)
{
    struct store store = {0};
    const struct check_document *document;
    if (!reports->run.is_compared || reports->run.num_shards)
        return;
    while ((document = baseline_next_gone(&gate->baseline, &store)) != NULL) {
        reports_gone(reports, document);
        store_finish(&store);
    }
}

void gate_finish(struct gate *gate)
{
    baseline_close(&gate->baseline);
    free(gate->fail_on.items);
}
