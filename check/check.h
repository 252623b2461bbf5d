// SPDX-License-Identifier: Apache-2.0
/* The parts of mxgen check: arguments and reports. */
#ifndef MXG_CHECK_CHECK_H
#define MXG_CHECK_CHECK_H

#include "check/sink.h"
#include "program/cli.h"
#include "program/output_files.h"

/* The command `mxgen check`; returns its exit code. */
int command_check(const struct command *command, int argc, char **argv);

/* The requested reports, and the totals. */
struct check_reports {
    struct check_run run;
    const char *paths[NUM_SINK_KINDS]; /* NULL: not requested */
    struct sink text, files[NUM_SINK_KINDS];
    struct check_totals totals;
};

/* Fills in the options of reports; returns their number, NUM_SINK_KINDS. */
size_t reports_args(struct check_reports *reports, struct arg *args);
/* The reason why the arguments are invalid; NULL if they are valid. reports_claim compares files.
 */
const char *reports_misuse(const struct check_reports *reports);

/*
 * Notes the files of the reports. False after a message about two reports with one file, or a
 * report over a file that `outputs` knows as an input.
 */
bool reports_claim(const struct check_reports *reports, struct outputs *outputs,
                   struct report *report);

/*
 * Opens the files. False after a message about a file that cannot be written; then nothing is left
 * to end.
 */
bool reports_begin(struct check_reports *reports, struct report *report);

/* Passes a document to all reports. Documents come in order. */
void reports_document(struct check_reports *reports, const struct check_document *document);

/* Passes a document of the baseline that the run lacks, after all documents of the run. */
void reports_gone(struct check_reports *reports, const struct check_document *document);

/*
 * True if the run passes: all documents pass, or, with a baseline, no change fails the run.
 */
bool reports_are_good(const struct check_reports *reports);

/*
 * Completes the files, or removes them. False after a message about a file that cannot be written.
 */
bool reports_end(struct check_reports *reports, struct report *report, bool keep);

/* merge.c: "mxgen check merge". */
int check_merge(const struct command *command, int argc, char **argv);

#endif
