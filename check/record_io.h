// SPDX-License-Identifier: Apache-2.0
/*
 * Records are written and read as JSON, for reports and the cache, and as bytes, for the way from a
 * worker to `mxgen check`. One description (record_io.c) names the members of a record; a coding
 * writes each of them, or reads it.
 */
#ifndef MXG_CHECK_RECORD_IO_H
#define MXG_CHECK_RECORD_IO_H

#include "check/record.h"

#include <jansson.h>

/* The first member of a coding's own state. */
struct record_io {
    const struct record_coding *coding;
    struct store *store; /* for what is read; NULL: the record is written */
};

/*
 * Members of objects have a key; items of arrays have none: NULL. A function that reads sets the
 * value, to 0 or "" where there is none of that kind.
 */
struct record_coding {
    void (*text)(struct record_io *io, const char *key, const char **value);
    void (*count)(struct record_io *io, const char *key, uint64_t *value);
    void (*flag)(struct record_io *io, const char *key, bool *value);
    void (*time)(struct record_io *io, const char *key, double *milliseconds);
    /* one of some names by its index, which is returned; 0 for a name that is none of them */
    unsigned (*name)(struct record_io *io, const char *key, unsigned value,
                     const char *const *names, unsigned num_names);
    void (*parts)(struct record_io *io, struct check_shader *shader);
    /* Returns how many items there are: `num` where it writes. */
    size_t (*begin_array)(struct record_io *io, const char *key, size_t num);
    /* What has no items is left out unless `is_required`. */
    void (*end_array)(struct record_io *io, const char *key, bool is_required);
    void (*begin_object)(struct record_io *io); /* the next item of the array at hand */
    void (*end_object)(struct record_io *io);
};

/* The members of a document; the object that they belong to is at hand. */
void record_members(struct record_io *io, struct check_document *document);

/*
 * record_json.c: the document as JSON, to be unreferenced. Times change from run to run, and are
 * left out on demand.
 */
json_t *record_to_json(const struct check_document *document, bool with_times);
/* NULL where the JSON is no record. The record keeps nothing of the JSON. */
struct check_document *record_from_json(struct store *store, json_t *object);

/* record_bytes.c: room for one record after the other. */
struct record_bytes {
    char *data;
    size_t size, capacity;
};

/* Writes the record, without index and changes, in place of the one before; data is to be freed. */
void record_to_bytes(struct record_bytes *out, const struct check_document *document);
/* NULL where the bytes are no record. Its texts are those in the bytes, which must live as long. */
struct check_document *record_from_bytes(struct store *store, const char *data, size_t size);

#endif
