// SPDX-License-Identifier: Apache-2.0
/*
 * Records of documents that were checked before. An entry is named after all that its record
 * follows from: the document's bytes and name, what the workers are told, their program and the
 * libraries; inside it says which other files were read, with the hashes of these, and for images
 * that pictures show size and time. Entries appear whole or not at all, so that several runs may
 * share a cache and one that is killed leaves nothing broken; what cannot be read counts as absent.
 */
#ifndef MXG_CHECK_CACHE_H
#define MXG_CHECK_CACHE_H

#include "cli/args.h"
#include "check/record.h"

#include <jansson.h>
#include <sha2.h>
#include <time.h>

/* A SHA-256 in hexadecimal. */
struct cache_hash {
    char hex[SHA256_DIGEST_STRING_LENGTH];
};

struct cache_key {
    struct cache_hash name;     /* of the entry; "": the document cannot be read */
    struct cache_hash document; /* of its bytes */
};

struct cache {
    const char *folder; /* NULL: no cache */
    struct cache_hash configuration;
    struct cached_file *files; /* hashes of files that were met lately */
    const char *fault;         /* entries cannot be written: why */
    time_t begin;
};

/* `args` are those of the workers, the program first. */
void cache_init(struct cache *cache, const char *folder, const struct arg_list *args,
                const mxg_library *library);
void cache_finish(struct cache *cache);

/*
 * The key of a document as it is now, and its record as JSON, to be unreferenced; NULL where there
 * is none.
 */
json_t *cache_find(struct cache *cache, const char *path, struct cache_key *out_key);

/* Keeps a record, if it follows from files alone and these are still what they were. */
void cache_put(struct cache *cache, const struct cache_key *key,
               const struct check_document *document);

#endif
