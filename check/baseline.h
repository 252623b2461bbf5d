// SPDX-License-Identifier: Apache-2.0
/*
 * A baseline is a JSON report that was kept. What of a run differs from it becomes changes in the
 * documents: so that one sees what an edit of a library does to a whole show.
 */
#ifndef MXG_CHECK_BASELINE_H
#define MXG_CHECK_BASELINE_H

#include "check/names.h"
#include "check/record.h"
#include "check/report_reader.h"

struct baseline {
    struct report_reader reader;
    bool is_open;
    /* the places of the documents in the report; those that were compared are marked */
    struct name_table offsets;
};

/* False: baseline->reader.fault says why. baseline_close must follow in both cases. */
bool baseline_open(struct baseline *baseline, const char *path);
void baseline_close(struct baseline *baseline);

/* Notes in the document, with memory of the store, what differs. */
void baseline_compare(struct baseline *baseline, struct store *store,
                      struct check_document *document);

/*
 * Names the documents of the baseline that were not compared, in its order; returns how many there
 * are.
 */
uint64_t baseline_list_gone(struct baseline *baseline, FILE *out);

#endif
