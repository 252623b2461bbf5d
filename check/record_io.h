// SPDX-License-Identifier: Apache-2.0
/*
 * Reads and writes records as JSON, for reports and the cache, and as bytes, for the pipe from a
 * worker to `mxgen check`. One description (record_io.c) names the members of a record; a coding
 * reads or writes each of them.
 */
#ifndef MXG_CHECK_RECORD_IO_H
#define MXG_CHECK_RECORD_IO_H

#include "check/record.h"

#include <jansson.h>

/* The first member of a coding's own state. */
struct record_io {
    const struct record_coding *coding;
    struct store *store; /* memory when reading; NULL: the record is written */
};

/*
 * Members of objects have a key; items of arrays have the key NULL. A reading function sets the
 * value, to 0 or "" if the member is missing or has another type.
 */
struct record_coding {
    void (*text)(struct record_io *io, const char *key, const char **value);
    void (*count)(struct record_io *io, const char *key, uint64_t *value);
    void (*flag)(struct record_io *io, const char *key, bool *value);
    void (*time)(struct record_io *io, const char *key, double *milliseconds);
    /* an index into names, which it returns; 0 for an unknown name */
    unsigned (*name)(struct record_io *io, const char *key, unsigned value,
                     const char *const *names, unsigned num_names);
    void (*parts)(struct record_io *io, struct check_shader *shader);
    /* The writer omits an empty list. */
    void (*settings)(struct record_io *io, const char *key, struct check_setting **settings,
                     size_t *num_settings);
    /* Returns the number of items: `num` when writing. */
    size_t (*begin_array)(struct record_io *io, const char *key, size_t num);
    /* The writer omits an empty array unless `is_required`. */
    void (*end_array)(struct record_io *io, const char *key, bool is_required);
    void (*begin_object)(struct record_io *io); /* the next item of the current array */
    void (*end_object)(struct record_io *io);
};

/* The members of a document, in the current object. */
void record_members(struct record_io *io, struct check_document *document);

/*
 * record_json.c: the document as JSON, which the caller unreferences. `with_times` false omits
 * times, which differ from run to run.
 */
json_t *record_to_json(const struct check_document *document, bool with_times);
/* NULL if the JSON is no record. The record does not refer to the JSON. */
struct check_document *record_from_json(struct store *store, json_t *object);

/* record_bytes.c: a buffer for one record at a time. */
struct record_bytes {
    char *data;
    size_t size, capacity;
};

/* Writes the record, without index and changes, over the previous one; the caller frees data. */
void record_to_bytes(struct record_bytes *out, const struct check_document *document);
/* NULL if the bytes are no record. Its texts point into the bytes, which must live as long. */
struct check_document *record_from_bytes(struct store *store, const char *data, size_t size);

#endif
