// SPDX-License-Identifier: Apache-2.0
/* A table of names by their hash of 64 bits; names of one hash count as one. */
#ifndef MXG_CHECK_NAMES_H
#define MXG_CHECK_NAMES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct name_entry {
    uint64_t hash; /* 0: there is no entry */
    uint64_t value;
    bool is_marked;
};

/* Zeroed at first. */
struct name_table {
    struct name_entry *entries;
    size_t num_entries, capacity; /* a power of two, and more than the entries */
};

/* The entry of a name, a new one with the value 0 if need be. Valid until the next call. */
struct name_entry *names_add(struct name_table *table, const char *name, bool *out_is_new);
/* NULL where there is none. */
struct name_entry *names_find(const struct name_table *table, const char *name);
void names_finish(struct name_table *table);

#endif
