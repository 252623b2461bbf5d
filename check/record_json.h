// SPDX-License-Identifier: Apache-2.0
/*
 * Records as JSON: in reports, in the cache, and on the pipe from a worker to `mxgen check`. Tables
 * name the members of a record once, for reading and for writing.
 */
#ifndef MXG_CHECK_RECORD_JSON_H
#define MXG_CHECK_RECORD_JSON_H

#include "check/record.h"

#include <jansson.h>

/*
 * The document as JSON, which the caller unreferences. `with_times` false omits times, which differ
 * from run to run.
 */
json_t *record_to_json(const struct check_document *document, bool with_times);
/*
 * NULL if the JSON is no record, or a damaged one: members of another type, or words that they
 * cannot have. The record does not refer to the JSON.
 */
struct check_document *record_from_json(struct store *store, json_t *object);

/* Writes a record as text, which the caller frees. */
char *record_to_text(const struct check_document *document, size_t *out_size);
/* NULL if the text is no record. The record does not refer to the text. */
struct check_document *record_from_text(struct store *store, const char *text, size_t size);

#endif
