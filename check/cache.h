// SPDX-License-Identifier: Apache-2.0
/*
 * Records of earlier checks. The name of an entry is a hash of everything that the record depends
 * on: the document's bytes and name, the workers' arguments, their program and the libraries. The
 * entry lists the other files with their hashes, and images of pictures and budgets with size and
 * time. Each entry appears as a whole, so several runs can share a cache, and a killed run leaves
 * no broken entry. An entry begins with its checksum; a damaged one counts as absent and is made
 * anew.
 */
#ifndef MXG_CHECK_CACHE_H
#define MXG_CHECK_CACHE_H

#include "program/args.h"
#include "check/record.h"

#include <jansson.h>
#include <sha2.h>
#include <time.h>

/* A SHA-256 in hexadecimal. */
struct cache_hash {
    char hex[SHA256_DIGEST_STRING_LENGTH];
};

struct cache_key {
    struct cache_hash name;     /* name of the entry; "": the document cannot be read */
    struct cache_hash document; /* hash of the document's bytes */
};

struct cache {
    const char *folder; /* NULL: no cache */
    /*
     * limits for the hash of a file: the cache does not know files past them, so a worker, which
     * has the same limits, checks their documents
     */
    uint64_t max_file_size, time_limit; /* bytes; nanoseconds */
    struct cache_hash configuration;
    struct cached_file *files; /* hashes of recently read files */
    const char *fault;         /* the reason why entries cannot be written */
    time_t begin;
};

/*
 * `args` are the arguments of the workers, the program first. The caller sets folder and limits
 * before.
 */
void cache_init(struct cache *cache, const struct arg_list *args, const mxg_library *library);
void cache_finish(struct cache *cache);

/*
 * The key of a document in its current state, and its record as JSON, which the caller
 * unreferences; NULL if there is none.
 */
json_t *cache_find(struct cache *cache, const char *path, struct cache_key *out_key);

/* Stores a record if it depends only on files and these have not changed. */
void cache_put(struct cache *cache, const struct cache_key *key,
               const struct check_document *document);

#endif
