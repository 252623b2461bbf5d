// SPDX-License-Identifier: Apache-2.0
/*
 * Fragments: what functions and graphs of a library became for arguments of a pattern, taken down
 * when the library is packed. Where a generation uses such a function with such arguments, the
 * nodes are restored one by one; no tree is read and nothing is folded.
 *
 * A pattern tells of each argument what the builder can see of it: constants by value; an op that
 * is looked through, with its operands; which arguments are the same node; of anything else the
 * type, and whether it belongs to a loop.
 *
 *     code       words behind it        in patterns                         in nodes
 *     CONST      the components         a constant                          the same
 *     op         attribute, operands    looked through: operands are codes  numbers: 0 is none,
 * inputs from 1, then earlier nodes UNIFORM…   the global's number a uniform, stream or texture of
 * the host CALL, LEAF function or family     an argument like any other          and operands as of
 * any op POISON     an element                                                 the origin of the
 * nodes that follow LOCAL      a name                                                     what the
 * host knows by it
 *
 * Functions are called with few arguments, of which much may be known: what they became is restored
 * for arguments of the very same pattern. Graphs have many. Their fragments are *open*: taken down
 * with nothing known of any argument but of strings, and right for all that are no constants. Where
 * more is known, nodes are built again, which may simplify them.
 */
#ifndef MXG_LANG_FRAGMENT_H
#define MXG_LANG_FRAGMENT_H

#include "lang/lang.h"

#include <assert.h>

enum {
    FRAGMENT_MAX_PATTERN = 240, /* codes */
    FRAGMENT_MAX_INPUTS = 100,
    FRAGMENT_MAX_DEPTH = 6, /* of ops in ops that are looked through */
    FRAGMENT_MAX_NODES = 400,
    FRAGMENT_MAX_OPERANDS = 128,
};

enum { FRAGMENT_OUTER = UINT16_MAX };

struct fragment_pattern {
    const struct ir_graph *graph;
    const struct lang_unit *layer; /* the library's */
    unsigned len, num_inputs;
    bool failed; /* too large */
    uint16_t codes[FRAGMENT_MAX_PATTERN];
    /* each node that the pattern tells apart, in order of appearance */
    ir_ref inputs[FRAGMENT_MAX_INPUTS];
};

void fragment_pattern_begin(struct fragment_pattern *pattern, const struct ir_graph *graph,
                            const struct lang_unit *layer);
void fragment_pattern_add(struct fragment_pattern *pattern, ir_ref argument); /* 0: absent */

/*
 * Who asks for nodes. Those of functions need the first three; those of graphs have leaves, origins
 * and names, too.
 */
struct fragment_host {
    struct lang_unit *unit; /* the generation's */
    struct ir_graph *graph;
    const struct lang_host *lang;
    void *user_data;
    /* the graph's number for what a LEAF calls */
    uint32_t (*leaf)(void *user_data, uint32_t family);
    /* of nodes from here on; 0: `own`; FRAGMENT_OUTER: `outer` */
    void (*origin)(void *user_data, uint32_t element);
    uint32_t own, outer; /* origins; elements of the graph have one below the latter */
    /* a node that has a name beyond the graph */
    ir_ref (*named)(void *user_data, str_id name, ir_type_id type);
    str_id (*name)(void *user_data, ir_ref node); /* the same backwards; 0: it has none */
    bool has_folded;                              /* a node of an open fragment became a constant */
};

/*
 * The fragment with this pattern in the chain that begins at `first`, made for the same options;
 * NULL.
 */
const struct lang_fragment *fragment_find(const struct lang_unit *layer, uint32_t first,
                                          const struct fragment_pattern *pattern, uint32_t choice);
/*
 * The open fragment of the chain for arguments without constants; NULL: there is none for these.
 * `inputs` has room for all arguments and becomes those that the fragment is made over.
 */
const struct lang_fragment *fragment_find_open(const struct lang_unit *layer, uint32_t first,
                                               const struct ir_graph *graph, uint32_t choice,
                                               const ir_ref *args, unsigned num_args,
                                               ir_ref *inputs, unsigned *out_num_inputs);
bool fragment_is_open(const struct fragment_pattern *pattern);
/* What `known` says of inputs, see fragment_restore. */
void fragment_note_known(const struct ir_graph *graph, const ir_ref *inputs, unsigned num_inputs,
                         bool *known);

/*
 * Restores the nodes of a fragment into `nodes`, which has room for fragment_room(), and begins
 * with none and the inputs; the nodes come behind them. Returns the codes behind the last: the
 * number of results, and theirs. Of an open fragment `known` tells of each node whether more can be
 * seen of it than when it was taken down; otherwise NULL.
 */
static inline size_t fragment_room(const struct lang_fragment *fragment, unsigned num_inputs)
{
    return (size_t)1 + num_inputs + fragment->num_nodes;
}
const uint16_t *fragment_restore(struct fragment_host *host, const struct lang_unit *layer,
                                 const struct lang_fragment *fragment, unsigned num_inputs,
                                 ir_ref *nodes, bool *known);

/*
 * fragment_record.c: takes down what became of `pattern`; its number + 1, or 0 where it cannot be.
 * `first` is the chain.
 */
unsigned fragment_record(const struct fragment_host *host, uint16_t *first,
                         const struct fragment_pattern *pattern, const ir_ref *results,
                         unsigned num_results);
/*
 * What follows on the nodes of a fragment: codes that must be the same where it is restored,
 * results, and codes behind them.
 */
struct fragment_follower {
    const ir_ref *nodes, *results;
    const uint16_t *key, *more;
    unsigned num_nodes, num_results, num_key, num_more;
};
void fragment_record_follower(const struct fragment_host *host, unsigned leader,
                              const struct fragment_follower *follower);
void fragment_note_global(struct lang_recorder *recorder, ir_ref node, uint32_t global);

/* The graph's number for a function that is called. */
uint32_t fragment_callee(struct lang_unit *unit, struct ir_graph *graph, uint32_t function);

/* ---- Codes ---- */

/*
 * Heads: op, type and number of operands. Of structs and arrays the language's type follows, of
 * more than 6 operands the number.
 */
enum {
    FRAGMENT_MANY = 7,
    FRAGMENT_USER_TYPE = 63,
    FRAGMENT_MAX_HEAD = 2,
    FRAGMENT_MAX_CONSTANT = 1 + 2 * 16
};
static inline uint16_t fragment_head(enum ir_op op, ir_type_id type, unsigned count)
{
    unsigned known = type < IR_TYPE_FIRST_USER ? type : FRAGMENT_USER_TYPE;
    return (uint16_t)((unsigned)op << 9 | known << 3
                      | (count < FRAGMENT_MANY ? count : FRAGMENT_MANY));
}
static_assert((unsigned)IR_NUM_OPS <= 128 && (unsigned)IR_NUM_TYPES <= (unsigned)FRAGMENT_USER_TYPE,
              "heads do not suffice");

/*
 * Writes a head and what follows it of the type; returns how many codes, 0 where the library
 * (`layer`) does not know the type.
 */
unsigned fragment_write_head(const struct ir_graph *graph, const struct lang_unit *layer,
                             enum ir_op op, ir_type_id type, unsigned count,
                             uint16_t out[FRAGMENT_MAX_HEAD]);
/*
 * The same for a constant; of strings that the library does not know, whose numbers are chance, 0.
 */
unsigned fragment_write_constant(const struct ir_graph *graph, const struct lang_unit *layer,
                                 const struct ir_node *node, uint16_t out[FRAGMENT_MAX_CONSTANT]);

/* Ops whose attribute follows their head. */
static inline bool fragment_has_attr(enum ir_op op)
{
    return op == IR_SWIZZLE || op == IR_MEMBER || op == IR_RESULT || op == IR_CALL || op == IR_LEAF;
}

uint32_t fragment_hash(const struct fragment_pattern *pattern);

#endif
