// SPDX-License-Identifier: Apache-2.0
/*
 * Fragments: what functions of a library became for arguments of a pattern, taken down when the library is packed. Where a generation calls
 * such a function with such arguments, the nodes are restored one by one; no tree is read and nothing is folded.
 *
 * A pattern tells of each argument what lowering can see of it. Constants by value; an op that rules look through, with its operands;
 * which arguments are the same node; and nothing else of what is left, since the builder asks no more of it.
 *
 *     code       words behind it    in patterns                              in nodes
 *     CONST      the components     a constant                               the same
 *     op         operands           looked through: operands are codes       their numbers: inputs first, then earlier nodes
 *     global     its number                                                  a uniform, stream or texture of the host
 *     call       function           an argument like any other               and operands as of any op
 */
#ifndef MXG_LANG_FRAGMENT_H
#define MXG_LANG_FRAGMENT_H

#include "lang/lower.h"

enum {
    FRAGMENT_MAX_PATTERN = 160, /* codes */
    FRAGMENT_MAX_INPUTS = 48,
    FRAGMENT_MAX_DEPTH = 6,     /* of ops in ops that are looked through */
    FRAGMENT_MAX_NODES = 400,
};

struct fragment_pattern {
    uint16_t codes[FRAGMENT_MAX_PATTERN];
    ir_ref inputs[FRAGMENT_MAX_INPUTS]; /* each node that the pattern tells apart, in order of appearance */
    unsigned len, num_inputs;
    uint32_t num_strings; /* of the library */
    bool has_derivative; /* among the inputs */
    bool failed;         /* too large */
};

/* Heads of codes: op, type and number of operands. Of more than 6 operands the number follows. */
enum { FRAGMENT_MANY = 7 };
static inline uint16_t fragment_head(enum ir_op op, ir_type_id type, unsigned count)
{
    return (uint16_t)((unsigned)op << 9 | (unsigned)type << 3 | (count < FRAGMENT_MANY ? count : FRAGMENT_MANY));
}
static_assert((unsigned)IR_NUM_OPS <= 128 && (unsigned)IR_TYPE_FIRST_USER <= 64, "heads do not suffice");

/* Ops whose attribute follows their head. */
static inline bool fragment_has_attr(enum ir_op op)
{
    return op == IR_SWIZZLE || op == IR_MEMBER || op == IR_RESULT || op == IR_CALL;
}

/* Writes the pattern; false where the function has no fragments, and none are taken down. */
bool fragment_begin(struct lower *lo, uint32_t id, const ir_ref *args, struct fragment_pattern *pattern);
/* False where no fragment has the pattern. */
bool fragment_restore(struct lower *lo, uint32_t id, const struct fragment_pattern *pattern, ir_ref *results);

/* fragment_record.c */
void fragment_note_global(struct lang_recorder *recorder, ir_ref node, uint32_t global);
void fragment_record(struct lower *lo, uint32_t id, const struct fragment_pattern *pattern, const ir_ref *results);

uint32_t fragment_hash(const struct fragment_pattern *pattern);

#endif
