// SPDX-License-Identifier: Apache-2.0
/*
 * The parts of a reference that are not followed, as they are listed with their reasons: lines of
 * two names and of the numbers that are allowed instead, of which there may be none. What is listed
 * must be met by a test, and must deviate, unless its reason begins with "open: ": compilers choose
 * the value.
 */
#ifndef MXG_TESTS_CONFORMANCE_DEVIATIONS_H
#define MXG_TESTS_CONFORMANCE_DEVIATIONS_H

#include <stdbool.h>
#include <stddef.h>

enum { DEVIATION_MAX_NUMBERS = 2 };

struct deviation {
    char *whole, *part; /* document and row; material and image */
    double numbers[DEVIATION_MAX_NUMBERS];
    bool is_open, is_found;
};

struct deviations {
    struct deviation *items;
    size_t len;
};

/*
 * Reads a file whose lines have `num_numbers` numbers behind the names. False after printing that
 * there is none.
 */
bool deviations_read(struct deviations *list, const char *path, size_t num_numbers);
void deviations_finish(struct deviations *list);

/* The deviation of a part, which counts as found then; NULL: it is followed. */
struct deviation *deviations_find(struct deviations *list, const char *whole, const char *part);

/* Prints which were not found; returns how many. */
size_t deviations_list_lost(const struct deviations *list);

#endif
