// SPDX-License-Identifier: Apache-2.0
/*
 * A baseline is a stored JSON report. Differences from it become changes in the documents, which
 * show the effect of a library edit on all documents.
 */
#ifndef MXG_CHECK_BASELINE_H
#define MXG_CHECK_BASELINE_H

#include "cli/names.h"
#include "check/record.h"
#include "check/report_reader.h"

struct baseline {
    struct report_reader reader;
    bool is_open;
    /* offsets of the documents in the report; a mark shows that the run has compared them */
    struct name_table offsets;
};

/* False: baseline->reader.fault has the reason. Call baseline_close in both cases. */
bool baseline_open(struct baseline *baseline, const char *path);
void baseline_close(struct baseline *baseline);

/* Records the differences in the document, with memory of the store. */
void baseline_compare(struct baseline *baseline, struct store *store,
                      struct check_document *document);

/*
 * Prints the documents of the baseline that the run has not compared, in its order; returns their
 * number.
 */
uint64_t baseline_list_gone(struct baseline *baseline, FILE *out);

#endif
