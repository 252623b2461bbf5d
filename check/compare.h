// SPDX-License-Identifier: Apache-2.0
/* The differences between two records of a document. */
#ifndef MXG_CHECK_COMPARE_H
#define MXG_CHECK_COMPARE_H

#include "check/record.h"

/*
 * Writes the differences of a document from its record in a baseline (NULL: it is new): its
 * changes, the states of its messages, and its gone messages, with memory of the store.
 */
void compare_documents(struct store *store, struct check_document *now,
                       const struct check_document *before);

/* Turns the record of a baseline into that of a document that is gone. */
void compare_gone(struct store *store, struct check_document *before);

#endif
