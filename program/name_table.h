// SPDX-License-Identifier: Apache-2.0
/* The hash table of programs: of names by their 64-bit hash; names with equal hashes count as one.
 */
#ifndef MXG_PROGRAM_NAME_TABLE_H
#define MXG_PROGRAM_NAME_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* FNV-1a of a text and of the previous hash; the first is NAMES_HASH_OF_NOTHING. */
#define NAMES_HASH_OF_NOTHING 0xcbf29ce484222325u
uint64_t names_hash(uint64_t hash, const char *text);

struct name_entry {
    uint64_t hash; /* 0: free entry */
    uint64_t value;
    bool is_marked;
};

/* Zero-initialise it. */
struct name_table {
    struct name_entry *entries;
    size_t num_entries, capacity; /* a power of two, greater than the number of entries */
};

/* The entry of a name; adds one with the value 0 if it is new. Valid until the next call. */
struct name_entry *names_add(struct name_table *table, const char *name, bool *out_is_new);
/* Adds an entry for what the caller hashes. */
struct name_entry *names_add_hash(struct name_table *table, uint64_t hash, bool *out_is_new);
/* NULL if there is none. */
struct name_entry *names_find(const struct name_table *table, const char *name);
struct name_entry *names_find_hash(const struct name_table *table, uint64_t hash);
void names_finish(struct name_table *table);

#endif
