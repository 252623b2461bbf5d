// SPDX-License-Identifier: Apache-2.0
/*
 * Reference values of nodes (README.md): rows of expected/<document>.csv, one for each output of
 * cases/<document>.mtlx, and deviations.tsv, the rows that are not followed. A test computes a
 * row's values by its own means and lets suite_judge compare.
 */
#ifndef MXG_TESTS_CONFORMANCE_ROWS_H
#define MXG_TESTS_CONFORMANCE_ROWS_H

#include "deviations.h"

#include <stdbool.h>
#include <stddef.h>

enum { ROW_PIXELS = 16, ROW_MAX_COMPONENTS = 4 };

struct row {
    char *name; /* element path: "g_add_float/v1" */
    unsigned components;
    /* false: the reference is not finite or not stable there; any value is right */
    bool is_defined;
    double tolerance;
    /* pixel by pixel, rows of 4 from the bottom; `components` for each */
    double values[ROW_PIXELS * ROW_MAX_COMPONENTS];
};

struct row_list {
    const char *document; /* "add" */
    struct row *items;
    size_t len;
};

struct suite {
    const char *folder;
    char **documents; /* sorted */
    size_t num_documents;
    struct deviations deviations;
    size_t agree, deviate, undefined, skipped, failed;
};

/*
 * Lists the documents, and the deviations of a file; NULL: deviations.tsv of the folder. False
 * after printing why.
 */
bool suite_open(struct suite *suite, const char *folder, const char *deviations);
void suite_close(struct suite *suite);

/* Rows of document `index`; false after printing why. row_list_free must follow in any case. */
bool suite_read(const struct suite *suite, size_t index, struct row_list *out);
void row_list_free(struct row_list *list);

/* "<folder>/cases/<document>.mtlx"; to be freed. */
char *suite_case_file(const struct suite *suite, size_t index);

/*
 * Compares and counts; differences are printed. `values` as in the row; NULL where there are none,
 * and `problem` tells why.
 */
void suite_judge(struct suite *suite, const struct row_list *list, const struct row *row,
                 const float *values, const char *problem);

/* Counts a row that this test cannot compute. */
void suite_skip(struct suite *suite, const struct row_list *list, const struct row *row);

/*
 * Prints the counts. Where all documents were read (`is_whole`) the list of deviations is checked
 * too. What main returns.
 */
int suite_report(struct suite *suite, const char *name, bool is_whole);

#endif
