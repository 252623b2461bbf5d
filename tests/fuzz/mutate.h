// SPDX-License-Identifier: Apache-2.0
/*
 * Mutation of a document by its elements and attributes: values become extreme, ports connect to
 * other nodes, elements are renamed, retyped, repeated, removed and nested. The text need not be
 * well-formed.
 */
#ifndef MXG_TESTS_FUZZ_MUTATE_H
#define MXG_TESTS_FUZZ_MUTATE_H

#include <stddef.h>

/* Changes the text in place, which has room for `capacity` bytes; returns its new size. */
size_t mutate_document(char *data, size_t size, size_t capacity, unsigned seed);

/*
 * Puts an element of another document into this one; returns the size in `out`, 0 if it does not
 * fit.
 */
size_t mutate_cross(const char *data, size_t size, const char *other, size_t other_size, char *out,
                    size_t capacity, unsigned seed);

#endif
