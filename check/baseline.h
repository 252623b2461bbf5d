// SPDX-License-Identifier: Apache-2.0
/*
 * A baseline is a stored JSON report. A run reports its differences from it, which show the effect
 * of an edit on all documents.
 */
#ifndef MXG_CHECK_BASELINE_H
#define MXG_CHECK_BASELINE_H

#include "program/name_table.h"
#include "check/record.h"
#include "check/report_reader.h"
#include "check/root.h"

struct baseline {
    struct report_reader reader;
    bool is_open;
    /*
     * offsets of the documents in the report, by their names below the root; a mark shows that the
     * run has compared them
     */
    struct name_table offsets;
    uint64_t num_compared;
    size_t next_gone; /* the next entry that may be gone; the entries are then in order */
    bool is_sorted;
};

/* False: baseline->reader.fault has the reason. Call baseline_close in both cases. */
bool baseline_open(struct baseline *baseline, const char *path);
void baseline_close(struct baseline *baseline);

/*
 * The reason why a run with these targets has another subject than the baseline, which the caller
 * frees; NULL: it has the same one.
 */
char *baseline_find_mismatch(const struct baseline *baseline, const char *const *targets,
                             size_t num_targets, bool compiles);

/*
 * The reason why a root is another one than the baseline's, which the caller frees: none of the
 * baseline's documents is below it. NULL: it fits; a baseline without documents fits every root.
 */
char *baseline_find_other_root(struct baseline *baseline, const char *root);

/* Records the differences in the document, with memory of the store. */
void baseline_compare(struct baseline *baseline, struct store *store,
                      struct check_document *document);

/*
 * The next document of the baseline that the run has not compared, in its order; NULL: no more. No
 * comparison may follow.
 */
struct check_document *baseline_next_gone(struct baseline *baseline, struct store *store);

#endif
