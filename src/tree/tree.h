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
    LANG_CONST,  /* a: index in unit->words; the type gives their number */
    LANG_VAR,    /* a: slot of a parameter or local of the function */
    LANG_GLOBAL, /* a: index in unit->globals */
    LANG_INPUT,  /* a: slot of an inline expression's {{input}} */
    /*
     * op: enum ir_op (operators and built-ins; attr in b for SWIZZLE and MEMBER); first operand a,
     * chained by next; c: the str_id of the variable in whose place it stands, or that of the
     * function + LANG_OF_FUNCTION, or 0
     */
    LANG_OP,
    LANG_CALL, /* a: function id; first argument b, chained by next; c: as in OP */
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
    /* a: first statement, chained by next; b: the step statement of a FOR body, or 0 */
    LANG_BLOCK,
    LANG_RETURN, /* a: value or 0 */
    LANG_BREAK,
    LANG_CONTINUE,
    LANG_NUM_KINDS
};

/* beside the name in the member c of an operation: it is that of a function */
#define LANG_OF_FUNCTION (1u << 31)

struct lang_node {
    uint8_t kind;
    uint8_t op;
    ir_type_id type; /* type of an expression */
    lang_ref next;   /* next sibling: operand, argument or statement */
    uint32_t a, b, c;
};

enum lang_param_mode { LANG_IN, LANG_OUT, LANG_INOUT };

struct lang_slot { /* a parameter or local variable */
    str_id name;
    ir_type_id type;
    uint8_t mode;     /* enum lang_param_mode of a parameter */
    uint8_t assigned; /* an assignment after its declaration exists */
};

enum lang_function_flags {
    /* it or a callee reads derivatives, or textures with implicit level of detail */
    LANG_FN_DERIVATIVE = 1,
    LANG_FN_PURE = 2,     /* it and its callees read no uniform, stream, option or sampler */
    LANG_FN_STRAIGHT = 4, /* no loops, also in callees: lowering makes nodes */
    /* it has string parameters: targets without strings need a specialised copy */
    LANG_FN_STRINGS = 8,
    /* an inline expression: no name, LANG_INPUT slots, body is RETURN expr */
    LANG_FN_EXPRESSION = 16,
    /*
     * nothing to specialise, except for arguments and callees (canonical.c): saves a tenth of a
     * process (docs/benchmarks.md)
     */
    LANG_FN_FINAL = 32,
    LANG_FN_DIFFERENCE = 64, /* it or a callee has dFdx, dFdy or fwidth */
};

struct lang_function {
    str_id name;
    str_id doc; /* the first paragraph of the comment above it (parse/declaration.c); 0 = none */
    uint16_t flags;
    ir_type_id return_type;
    uint16_t num_params, num_slots; /* parameters come first among the slots */
    uint32_t first_slot;            /* in unit->slots */
    lang_ref body;                  /* a BLOCK; 0: the frame of a program, or the host, has it */
    uint32_t file;                  /* index in unit->files */
    uint32_t place;
    uint32_t num_nodes; /* size of the body: for inlining decisions */
    /*
     * in unit->refs, one after the other: ids of functions called directly and of globals read
     * directly, each once; with LANG_FN_FINAL its CALL nodes, arguments first
     */
    uint32_t first_ref, num_callees, num_globals, num_calls;
};

struct lang_version {    /* the origin of a function in a generation's layer (plan.c) */
    uint32_t origin;     /* id of the original function */
    uint32_t variant;    /* in the plan */
    uint32_t dropped[2]; /* bit i: the copy lacks parameter i of the original */
};

enum lang_global_kind {
    LANG_GLOBAL_CONST,
    LANG_GLOBAL_UNIFORM,
    LANG_GLOBAL_STREAM,
    LANG_GLOBAL_OPTION,
    LANG_GLOBAL_VARIABLE /* of a program (lang_parse_program); num_words 0: without a first value */
};

struct lang_global {
    str_id name;
    uint8_t kind; /* enum lang_global_kind */
    uint8_t reserved;
    ir_type_id type;
    /*
     * value of a CONST, OPTION or VARIABLE of built-in or array type, in unit->words (arrays:
     * elements in order)
     */
    uint32_t words;
    uint32_t num_words;
    uint32_t array_length; /* length of a uniform array; 0 = none */
    uint32_t file;
};

struct lang_file {
    str_id name;                          /* name in the form that the reader received */
    uint32_t first_include, num_includes; /* in unit->refs: files included directly */
    /* a file's functions have contiguous ids */
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
     * The result of a built-in texture function if the texture is special; 0: it is plain. The
     * portable language has no name for a special texture, so functions with such arguments are
     * lowered regardless of their size. May be NULL.
     */
    ir_ref (*texture)(void *user_data, enum ir_op op, const ir_ref *args);
    /* A constant index is out of range; the last part is read. May be NULL. */
    void (*bad_index)(void *user_data, int32_t index, uint32_t length);
    /* A call has more numbers and vectors than it may have; its results are poison. May be NULL. */
    void (*too_large)(void *user_data);
    /*
     * max_inline_nodes for the called function itself and its direct callees; 0: max_inline_nodes
     */
    uint32_t max_outer_nodes;
    /*
     * calls of functions with more tree nodes than this stay calls, unless their result folds to
     * constants
     */
    uint32_t max_inline_nodes;
    /* calls with derivatives become nodes whatever their size: what has no neighbours derives these
     */
    bool inlines_derivatives;
};

/*
 * A layer of functions. Ids of functions, files, globals and user types count through all layers
 * (base first); indices of nodes, slots, words and refs count within the layer.
 */
struct lang_unit {
    const struct lang_unit *base;
    struct strpool *strings;
    struct arena *arena; /* NULL in an image layer */
    /* numbers of items in the layers below */
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
    /* image layers only: */
    /* offset of each function's text, and the end of the last one (texts.c) */
    VEC(uint32_t) texts;
    VEC(char) text_bytes;
    /* layers of a generation only: */
    /* resolves options, and holds the graph of their values; from lang_lower_call */
    struct lang_host host;
    struct ir_graph *graph;
    uint32_t eval_steps;               /* that lang_eval_constant has spent */
    VEC(struct lang_version) versions; /* by function */
    /* plan.c: the constants that functions assume; NULL until the shader is complete */
    struct lang_plan *plan;
    /* by id, of the functions that a module beside the shader has: their names in calls, NULL of
     * others (shared_functions.c); num_module 0: there is no module */
    const char *const *module;
    uint32_t num_module;
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

/* The name with which a shader calls a function of its module; NULL: the shader has the function.
 */
static inline const char *lang_module_name(const struct lang_unit *unit, uint32_t id)
{
    return id < unit->num_module ? unit->module[id] : NULL;
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

enum { LANG_MAX_WORDS = 1 << 16 }; /* scalars of a struct or array */

/*
 * Adds a struct, whose members are the last of the unit, or an array. VOID: a value is larger than
 * LANG_MAX_WORDS, or the unit has too many types.
 */
ir_type_id lang_add_type(struct lang_unit *unit, struct ir_user_type type);

#define LANG_NONE UINT32_MAX /* no function, file… */

enum { LANG_TINY = 8 }; /* functions with at most this many nodes are always lowered */

#endif
