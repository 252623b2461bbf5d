// SPDX-License-Identifier: Apache-2.0
/*
 * From the IR back to a document: the nodes of MaterialX's standard library that compute a value.
 * The sources of the graph (uniforms) become leaves, which the caller connects to something. Equal
 * nodes of several values are one node.
 */
#ifndef MXG_TRANSLATE_VALUE_NODES_H
#define MXG_TRANSLATE_VALUE_NODES_H

#include "ir/ir.h"

/* The types of a document that values have here. Colours and vectors differ, unlike in the IR. */
enum value_type {
    VALUE_NONE, /* any other type */
    VALUE_BOOLEAN,
    VALUE_INTEGER,
    VALUE_FLOAT,
    VALUE_VECTOR2,
    VALUE_COLOR3,
    VALUE_VECTOR3,
    VALUE_COLOR4,
    VALUE_VECTOR4,
    NUM_VALUE_TYPES
};
enum value_type value_type_of(const char *name); /* "color3"; VALUE_NONE: it is none of them */
const char *value_type_name(enum value_type type);

enum operand_kind { OPERAND_CONSTANT, OPERAND_LEAF, OPERAND_NODE };
struct operand {
    enum operand_kind kind;
    enum value_type type;
    uint32_t index;        /* of the leaf or the node */
    struct ir_value value; /* of a constant */
};

enum { MAX_VALUE_INPUTS = 4 };
struct value_node {
    const char *category;
    enum value_type type;
    unsigned num_inputs;
    const char *names[MAX_VALUE_INPUTS];
    struct operand inputs[MAX_VALUE_INPUTS];
};

struct value_nodes {
    struct arena *arena;
    VEC(struct value_node) nodes; /* inputs precede their users */
    struct table table;
    /*
     * The leaf that a source of the graph is: its index and its type; false: it is none.
     * `user_data` is the caller's.
     */
    bool (*leaf)(void *user_data, const struct ir_graph *graph, ir_ref ref, struct operand *out);
    void *user_data;
};

/*
 * Adds the nodes of a value. *out is the constant, leaf or node that has it, of the type `type`.
 * NULL, or the name of an op that no node computes; then *out is not set.
 */
const char *value_nodes_add(struct value_nodes *nodes, const struct ir_graph *graph, ir_ref root,
                            enum value_type type, struct operand *out);

/* Adds a node of one input or, where `name1` is not NULL, two. */
struct operand value_nodes_call(struct value_nodes *nodes, const char *category,
                                enum value_type type, const char *name0, struct operand input0,
                                const char *name1, struct operand input1);

struct operand value_zero(enum value_type type);
/* The text of a constant, as documents have it. */
void value_write(const struct operand *constant, struct text *out);

#endif
