// SPDX-License-Identifier: Apache-2.0
/* mxgen check, in parts: what is asked for, and the reports of what came of it. */
#ifndef MXG_CHECK_CHECK_H
#define MXG_CHECK_CHECK_H

#include "check/sink.h"
#include "cli/cli.h"

/* The reports asked for, and the sums. */
struct check_reports {
    struct check_run run;
    const char *paths[NUM_SINK_KINDS]; /* NULL: not asked for */
    struct sink text, files[NUM_SINK_KINDS];
    struct check_totals totals;
};

/* Fills in the options of reports; returns how many: NUM_SINK_KINDS. */
size_t reports_args(struct check_reports *reports, struct arg *args);
/* What is wrong with what was asked for, NULL: nothing. */
const char *reports_misuse(const struct check_reports *reports);

/* Opens the files. False after telling which cannot be written. */
bool reports_begin(struct check_reports *reports, struct report *report);

/* Tells all reports of a document. Documents come in order. */
void reports_document(struct check_reports *reports, const struct check_document *document);

/*
 * Whether the run passes: all documents do, or with a baseline, nothing fails that did not fail
 * before.
 */
bool reports_are_good(const struct check_reports *reports);

/* Finishes the files, or takes them away. False after telling which could not be written. */
bool reports_end(struct check_reports *reports, struct report *report, bool keep);

/* merge.c: "mxgen check merge". */
int check_merge(const struct command *command, int argc, char **argv);

#endif
