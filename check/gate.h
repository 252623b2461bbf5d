// SPDX-License-Identifier: Apache-2.0
/*
 * The comparison of a run with its baseline, and the changes that fail the run: --baseline,
 * --update-baseline and --fail-on.
 */
#ifndef MXG_CHECK_GATE_H
#define MXG_CHECK_GATE_H

#include "check/baseline.h"
#include "check/check.h"

enum { NUM_GATE_ARGS = 2 };

/* Zero-initialise it. */
struct gate {
    const char *path; /* the baseline; NULL: none */
    bool update;
    struct arg_list fail_on; /* lists of kinds of changes */
    struct baseline baseline;
    bool is_outside_told;
};

/* Fills in the options; returns their number, NUM_GATE_ARGS. */
size_t gate_args(struct gate *gate, struct arg *args);

/* False after a message about arguments that make no sense: exit code 2. */
bool gate_parse(struct gate *gate, struct check_reports *reports);

/*
 * Opens the baseline of a run whose targets are known; `root` is the root of its documents, NULL
 * for a merge, which reads none. False after a message: it is missing, unreadable, or the baseline
 * of another run.
 */
bool gate_open(struct gate *gate, struct check_reports *reports, const char *root,
               struct report *report);

/* Compares a document, if there is a baseline. */
void gate_compare(struct gate *gate, struct check_reports *reports, struct store *store,
                  struct check_document *document, struct report *report);

/* Passes the documents that are gone to the reports. */
void gate_tell_gone(struct gate *gate, struct check_reports *reports);

void gate_finish(struct gate *gate);

#endif
