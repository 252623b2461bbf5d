// SPDX-License-Identifier: Apache-2.0
/*
 * Typed trees of the portable shading language (docs/shading-language.md).
 *
 * A unit is the set of functions of one library layer. Source files are parsed and type-checked
 * once, when a library is packed. The result is flat arrays without pointers, and the library image
 * holds them. Trees are immutable: specialisation makes a new tree in the unit of the generation.
 *
 *     text ─ parse → typed tree ─┬─ lower:      a call becomes IR nodes
 *                                ├─ specialise: arguments are bound, dead code is dropped
 *                                ├─ eval:       a call with constant arguments has a value
 *                                └─ print:      text in the language of a syntax table
 */
#ifndef MXG_TREE_TREE_H
#define MXG_TREE_TREE_H

#include "base/strpool.h"
#include "ir/ir.h"

/* The tree */

typedef uint32_t lang_ref; /* index of a node in its unit; 0 = none */

enum lang_kind {
    /* expressions */
    LANG_CONST,  /* a: index in unit->words; type says how many */
    LANG_VAR,    /* a: slot of a parameter or local of the function */
    LANG_GLOBAL, /* a: index in unit->globals */
    LANG_INPUT,  /* a: slot of an inline expression's {{input}} */
    /*
     * op: enum ir_op (operators and built-ins; attr in b for SWIZZLE and MEMBER); first operand a,
     * chained by next
     */
    LANG_OP,
    LANG_CALL, /* a: function id; first argument b, chained by next */
    /* statements */
    LANG_DECLARE, /* a: slot; b: initialiser or 0 */
    /*
     * a: target expression (VAR, SWIZZLE, INDEX, MEMBER of one); b: value; op: IR_NUM_OPS for =,
     * else the operator of `op=`
     */
    LANG_ASSIGN,
    LANG_EXPR, /* a: a call for its effect */
    LANG_IF,   /* a: condition; b: then block; c: else block or 0 */
    /* a: init statement or 0; b: condition or 0; c: body block, which has the step */
    LANG_FOR,
    LANG_WHILE, /* b: condition; c: body block */
    LANG_DO,    /* b: condition; c: body block */
    /* a: first statement, chained by next; b: of the body of a FOR, its step statement or 0 */
    LANG_BLOCK,
    LANG_RETURN, /* a: value or 0 */
    LANG_BREAK,
    LANG_CONTINUE,
    LANG_NUM_KINDS
};

/*
 * Which of a node's fields are its children, by kind; `next`, where it is set, is a sibling. ast.c
 */
enum lang_child_field { LANG_CHILD_A = 1, LANG_CHILD_B = 2, LANG_CHILD_C = 4 };
extern const uint8_t lang_child_fields[LANG_NUM_KINDS];

struct lang_node {
    uint8_t kind;
    uint8_t op;
    ir_type_id type; /* of an expression */
    lang_ref next;   /* next sibling: operand, argument or statement */
    uint32_t a, b, c;
};

enum lang_param_mode { LANG_IN, LANG_OUT, LANG_INOUT };

struct lang_slot { /* a parameter or local variable */
    str_id name;
    ir_type_id type;
    uint8_t mode;     /* enum lang_param_mode; of a parameter */
    uint8_t assigned; /* somebody assigns it after its declaration */
};

enum lang_function_flags {
    /* it or what it calls reads derivatives or textures with implicit level of detail */
    LANG_FN_DERIVATIVE = 1,
    LANG_FN_PURE = 2,     /* it and what it calls read no uniform, stream, option or sampler */
    LANG_FN_STRAIGHT = 4, /* no loops, nor in what it calls: may be lowered to IR whole */
    /* it has string parameters: to be specialised before it is printed for hardware */
    LANG_FN_STRINGS = 8,
    /* an inline expression: no name, LANG_INPUT slots, body is RETURN expr */
    LANG_FN_EXPRESSION = 16,
    LANG_FN_FINAL = 32, /* nothing to specialise, unless arguments or callees are: canonical.c */
};

struct lang_function {
    str_id name;
    str_id doc; /* the first sentence of the comment above it; 0: none */
    uint16_t flags;
    ir_type_id return_type;
    uint16_t num_params, num_slots; /* parameters come first among the slots */
    uint32_t first_slot;            /* in unit->slots */
    lang_ref body;                  /* a BLOCK */
    uint32_t file;                  /* index in unit->files */
    uint32_t place;
    uint32_t num_nodes; /* size of the body: for inlining decisions */
    /* in unit->refs: function ids called directly, each once */
    uint32_t first_callee, num_callees;
    uint32_t first_global, num_globals; /* in unit->refs: globals read directly, each once */
    /* in unit->refs, where it is LANG_FN_FINAL: its CALL nodes, arguments first */
    uint32_t first_call, num_calls;
};

struct lang_version {    /* what a function of a generation's layer is (plan.c) */
    uint32_t origin;     /* id of the function that it was made from */
    uint32_t dropped[2]; /* bit i is set where parameter i of that is gone */
};

enum lang_global_kind {
    LANG_GLOBAL_CONST,
    LANG_GLOBAL_UNIFORM,
    LANG_GLOBAL_STREAM,
    LANG_GLOBAL_OPTION
};

struct lang_global {
    str_id name;
    uint8_t kind; /* enum lang_global_kind */
    ir_type_id type;
    /*
     * value of a CONST or OPTION of built-in or array type, in unit->words (arrays: elements in
     * order)
     */
    uint32_t words;
    uint32_t num_words;
    uint32_t array_length; /* of a uniform array; 0 = none */
    uint32_t file;
};

struct lang_file {
    str_id name;                          /* as given to the reader */
    uint32_t first_include, num_includes; /* in unit->refs: files included directly */
    /* ids of the functions that the file itself defines are contiguous */
    uint32_t first_function, num_functions;
    uint32_t first_global, num_globals;
};

struct lang_unit;

struct lang_host { /* how globals become IR nodes */
    void *user_data;
    /*
     * The IR node for a uniform or stream (by its name and type); option constants give a constant.
     */
    ir_ref (*global)(void *user_data, struct ir_graph *graph, const struct lang_unit *unit,
                     uint32_t global_id);
    /*
     * What a built-in function of textures gives where the texture is not a plain one; 0: it is
     * plain. Functions that are given such a texture, which the portable language has no name for,
     * are lowered whatever their size. May be NULL.
     */
    ir_ref (*texture)(void *user_data, enum ir_op op, const ir_ref *args);
    /*
     * the same limit for the called function itself and what it calls directly; 0: max_inline_nodes
     */
    uint32_t max_outer_nodes;
    /* functions larger than this are called, not lowered, unless their result folds to constants */
    uint32_t max_inline_nodes;
};

/*
 * A layer of functions. Function, file, global and type ids count through the layers (base first);
 * node, slot, word and ref indices are the layer's own. User type ids also count through the
 * layers.
 */
struct lang_unit {
    const struct lang_unit *base;
    struct strpool *strings;
    struct arena *arena; /* NULL in an image layer */
    /* how many the layers below have */
    uint32_t base_functions, base_files, base_globals, base_user_types;
    VEC(struct lang_node) nodes; /* [0] unused; cap 0 in an image layer */
    VEC(struct lang_slot) slots;
    VEC(struct lang_function) functions;
    VEC(struct lang_global) globals;
    VEC(struct lang_file) files;
    VEC(union ir_word) words;
    VEC(uint32_t) refs;
    VEC(struct ir_user_type) user_types;
    VEC(struct ir_member) members;
    /* Of an image layer: */
    /* where the text of each function begins, and where the last one's ends (texts.c) */
    VEC(uint32_t) texts;
    VEC(char) text_bytes;
    /* Of a generation's layer: */
    /* who knows the options, and the graph that their values are nodes of; from lang_lower_call */
    struct lang_host host;
    struct ir_graph *graph;
    VEC(struct lang_version) versions; /* by function */
    /* plan.c: which constants functions take for granted; NULL until the shader stands */
    struct lang_plan *plan;
};

void lang_unit_init(struct lang_unit *unit, struct arena *arena, struct strpool *strings,
                    const struct lang_unit *base);

/*
 * Access by id through the layers. *out_unit (may be NULL) receives the layer, which the function's
 * own indices refer to.
 */
static inline const struct lang_function *lang_function(const struct lang_unit *unit, uint32_t id,
                                                        const struct lang_unit **out_unit)
{
    while (id < unit->base_functions)
        unit = unit->base;
    if (out_unit)
        *out_unit = unit;
    assert(id - unit->base_functions < unit->functions.len);
    return &unit->functions.items[id - unit->base_functions];
}

static inline const struct lang_global *lang_global(const struct lang_unit *unit, uint32_t id,
                                                    const struct lang_unit **out_unit)
{
    while (id < unit->base_globals)
        unit = unit->base;
    if (out_unit)
        *out_unit = unit;
    assert(id - unit->base_globals < unit->globals.len);
    return &unit->globals.items[id - unit->base_globals];
}

static inline const struct lang_file *lang_file(const struct lang_unit *unit, uint32_t id,
                                                const struct lang_unit **out_unit)
{
    while (id < unit->base_files)
        unit = unit->base;
    if (out_unit)
        *out_unit = unit;
    assert(id - unit->base_files < unit->files.len);
    return &unit->files.items[id - unit->base_files];
}

static inline const struct ir_user_type *lang_user_type(const struct lang_unit *unit,
                                                        ir_type_id type,
                                                        const struct lang_unit **out_unit)
{
    uint32_t id = (uint32_t)type - IR_TYPE_FIRST_USER;
    while (id < unit->base_user_types)
        unit = unit->base;
    if (out_unit)
        *out_unit = unit;
    assert(id - unit->base_user_types < unit->user_types.len);
    return &unit->user_types.items[id - unit->base_user_types];
}

#define LANG_NONE UINT32_MAX /* no function, file… */

enum { LANG_TINY = 8 }; /* functions of at most so many nodes are never worth a call */

#endif
