// SPDX-License-Identifier: Apache-2.0
/*
 * Groups of equal warnings. Exporters repeat a fault throughout a document: the first of equal
 * warnings appears in full, the others as lines in a note.
 */
#ifndef MXG_PROGRAM_WARNING_GROUPS_H
#define MXG_PROGRAM_WARNING_GROUPS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* Warnings with equal keys are equal; NULL is an empty text. */
struct group_key {
    const char *id, *file, *text;
    const char *state; /* of a message that is compared with a baseline */
};

struct groups {
    uint32_t *first; /* per message: the index of the first one that is equal */
    uint32_t *next;  /* per message: the index of the next equal one; 0: none */
    bool *is_told;   /* per first message: one of the group was printed; the caller sets it */
};

/* The hash of a message at a place. */
uint64_t group_key_hash_at(const struct group_key *key, uint32_t line, uint32_t column);

/*
 * The groups of `count` messages. `key_of` sets the key of the message at an index, or returns
 * false if that message belongs to no group. The program ends if memory is exhausted.
 */
struct groups groups_make(const void *messages, uint32_t count,
                          bool (*key_of)(const void *messages, uint32_t index,
                                         struct group_key *out_key));
void groups_finish(struct groups *groups);

enum { MAX_REST_LINES = 8 };

/* The messages of a group after its first one; zeroed at the start. */
struct group_rest {
    uint32_t count;
    uint32_t num_lines, previous; /* the lines in `lines`, and the last line that was added */
    char lines[MAX_REST_LINES * 12];
};

/* Adds a message; its line is 0 if it has no place. */
void group_rest_add(struct group_rest *rest, uint32_t line);

/* "note: and 14 more, in the lines 7, 9, …"; nothing without a message. */
void group_rest_print(const struct group_rest *rest, FILE *out);

#endif
