// SPDX-License-Identifier: Apache-2.0
/*
 * The IR: an append-only, hash-consed, topologically ordered graph (docs/ir.md).
 *
 * A node's operands have smaller indices than the node; identical nodes are one node; the builder
 * folds. So topological order is array order, common subexpressions are shared by construction, and
 * nothing recurses. ir_check verifies it.
 */
#ifndef MXG_IR_IR_H
#define MXG_IR_IR_H

#include "base/mem.h"
#include "base/strpool.h"
#include "base/text.h"

#include <assert.h>

/* types.c */

enum ir_type {
#define IR_TYPE(ID, text, scalar, components, columns) IR_TYPE_##ID,
#include "ir/types.def"
#undef IR_TYPE
    IR_NUM_TYPES,
    /*
     * From here on: structs and arrays of one graph or function unit, IR_TYPE_FIRST_USER + index in
     * its ir_user_types.
     */
    IR_TYPE_FIRST_USER = 64
};
typedef uint16_t ir_type_id;

struct ir_type_info {
    const char *text;
    uint8_t scalar, components, columns;
};
extern const struct ir_type_info ir_types[IR_NUM_TYPES];
static inline const struct ir_type_info *ir_type_info(ir_type_id type) /* of a built-in type */
{
    assert(type < IR_NUM_TYPES);
    return &ir_types[type];
}
const char *ir_type_text(ir_type_id type);
static inline bool ir_type_is_closure(ir_type_id type)
{
    return type >= IR_TYPE_BSDF && type <= IR_TYPE_VDF;
}
/* surface, volume, displacement, light shaders and material */
static inline bool ir_type_is_shader(ir_type_id type)
{
    return type >= IR_TYPE_SURFACE && type <= IR_TYPE_MATERIAL;
}
static inline bool ir_type_is_matrix(ir_type_id type)
{
    return type >= IR_TYPE_MAT2 && type <= IR_TYPE_MAT4;
}
static inline bool ir_type_is_float(ir_type_id type) /* float, vector or matrix of float */
{
    return type == IR_TYPE_FLOAT || (type >= IR_TYPE_VEC2 && type <= IR_TYPE_MAT4);
}
ir_type_id ir_type_vector(ir_type_id scalar, unsigned components); /* VOID where there is none */

struct ir_member {
    str_id name;
    ir_type_id type;
};

/* A struct (array_length 0) or an array of one type. */
struct ir_user_type {
    str_id name;
    uint32_t array_length;
    ir_type_id element; /* of an array */
    uint16_t num_members;
    uint32_t first_member; /* in the table's members */
};

/*
 * values.c, fold.c: constants and their arithmetic, shared by the builder and by the language's
 * evaluator
 */

union ir_word {
    float f;
    int32_t i;
    uint32_t u; /* also str_id, and bool as 0 or 1 */
};

struct ir_value {
    ir_type_id type; /* a built-in type with 1 to 16 components */
    union ir_word w[16];
};

struct ir_value ir_value_float(float f);
struct ir_value ir_value_int(int32_t i);
struct ir_value ir_value_bool(bool b);
bool ir_value_equal(const struct ir_value *a, const struct ir_value *b); /* bitwise */

enum ir_op {
#define OP(ID, text, arity, rule, flags, doc) IR_##ID,
#include "ir/ops.def"
#undef OP
    IR_NUM_OPS
};

enum ir_op_flags {
    OP_PURE = 1, /* no effect, no hidden input: may be folded */
    OP_COMMUTES = 2,
    OP_DERIVATIVE = 4, /* needs its neighbours: must stay in uniform control flow */
    OP_BUILTIN = 8,    /* a function of the portable language, called by its text */
    OP_OPERATOR = 16,  /* syntax of the portable language */
    OP_SIGNED = 32,    /* also over int and its vectors */
    OP_UNSIGNED = 64,  /* also over uint */
    OP_MATRIX = 128,   /* over matrices only */
};

enum ir_rule {
    IR_RULE_NONE,
    IR_RULE_SAME,
    IR_RULE_ARITH,
    IR_RULE_SPLAT,
    IR_RULE_REDUCE,
    IR_RULE_COMPARE,
    IR_RULE_LOGIC,
    IR_RULE_INTEGER,
    IR_RULE_SELECT
};

struct ir_op_info {
    const char *text;
    int8_t arity; /* -1: variable */
    uint8_t rule; /* enum ir_rule */
    uint8_t flags;
    uint8_t text_len;
    const char *doc;
};
extern const struct ir_op_info ir_ops[IR_NUM_OPS];
static inline const struct ir_op_info *ir_op_info(enum ir_op op)
{
    assert(op < IR_NUM_OPS);
    return &ir_ops[op];
}

/*
 * The result type of an op over built-in operand types by its rule; VOID where they do not fit or
 * where the rule is NONE and the op is not a built-in function (TEX gives VEC4, STEP the type of x,
 * …).
 */
ir_type_id ir_op_result(enum ir_op op, const ir_type_id *args, unsigned num_args);

/*
 * Computes a pure op over constants in float32, with the semantics of GLSL 4.50; false where the
 * result is undefined (integer division by zero, a shift out of range, the logarithm of 0) or the
 * op is not computable. `attr` as in ir_node; `type` the result's. `out` must not be one of `args`.
 */
bool ir_eval_op(enum ir_op op, ir_type_id type, uint32_t attr, const struct ir_value *args,
                unsigned num_args, struct ir_value *out);

/* graph.c */

typedef uint32_t ir_ref; /* index of a node; 0 = none */

struct ir_node {
    uint8_t op;
    uint8_t flags; /* enum ir_node_flags */
    ir_type_id type;
    uint32_t num_args;
    uint32_t first_arg; /* in graph->args */
    uint32_t attr;
    uint32_t origin;   /* what the node was built for: index in graph->origins; 0 = nothing */
    str_id name;       /* what a reader calls it (names.c); 0 = nothing, or several things */
    uint8_t name_rank; /* enum ir_name_rank; of two names the one of the higher rank wins */
    bool is_shared;    /* it was asked for by more than one origin */
};

enum ir_node_flags {
    IR_NODE_DERIVATIVE = 1, /* it or an operand has OP_DERIVATIVE, or calls something that has */
    IR_NODE_CLOSURE = 2,    /* closure or shader type */
    /* it or an operand is CONTEXT or SAMPLE: it has a value inside of their loop only */
    IR_NODE_LOOP = 4,
    IR_NODE_DEAR = 8, /* it or an operand is a call or reads a texture */
    /* it or an operand may be undefined where its own operands are not: a quotient, a root */
    IR_NODE_PARTIAL = 16,
    /* from operands */
    IR_NODE_INHERITED = IR_NODE_DERIVATIVE | IR_NODE_LOOP | IR_NODE_DEAR | IR_NODE_PARTIAL
};

/*
 * Where a node comes from: for names, comments and diagnostics. The IR carries it and does not look
 * inside.
 */
struct ir_origin {
    str_id name;      /* a readable name for a local variable: "metal_ior" */
    uint32_t element; /* element of the document or library; 0 = none */
    uint32_t parent;  /* the origin of the instantiating node; 0 = none */
};

/*
 * A callee of CALL, VERBATIM or LEAF nodes. `id` is the owner's (a function id, a family id…):
 * equal ids are equal callees.
 */
struct ir_callee {
    uint64_t id;
    str_id name;
    bool derivative; /* it contains derivatives or implicit-LOD texture reads */
    bool pure;       /* its result depends on its arguments only (no uniform or stream inside) */
};

/*
 * A function made of IR: a graph used often. Its body is what its results reach; its parameters are
 * PARAM nodes. It is called only after its results are set, so that the body stands before the
 * calls.
 */
struct ir_function {
    str_id name;
    uint32_t num_params, first_param_type; /* in graph->param_types */
    uint32_t num_results, first_result;    /* in graph->function_results: refs */
};

struct ir_graph {
    struct arena *arena;
    struct strpool *strings;   /* may be NULL where no strings are built */
    VEC(struct ir_node) nodes; /* [0] is unused */
    VEC(ir_ref) args;          /* [0] is unused */
    /* [0] is unused; constant pool: as many as the type has components */
    VEC(union ir_word) words;
    VEC(struct ir_origin) origins; /* [0] is nothing */
    VEC(struct ir_callee) callees;
    VEC(struct ir_function) functions;
    VEC(ir_type_id) param_types;
    VEC(ir_ref) function_results;
    VEC(struct ir_user_type) user_types;
    VEC(struct ir_member) members;
    uint32_t *table; /* hash-consing: open addressing over node indices */
    uint32_t table_mask;
    uint32_t *callee_table; /* the same over callee indices + 1 */
    uint32_t callee_mask;
    uint32_t origin;    /* given to new nodes */
    uint32_t max_nodes; /* 0 = unlimited; beyond it ->overflow is set and POISON returned */
    bool overflow;
    bool exact;   /* apply only rules that hold for every input, infinities and NaN included */
    bool no_fold; /* build exactly what is asked for: for tests */
};

void ir_graph_init(struct ir_graph *graph, struct arena *arena, struct strpool *strings);

static inline const struct ir_node *ir_get(const struct ir_graph *graph, ir_ref ref)
{
    return &graph->nodes.items[ref];
}
static inline const ir_ref *ir_args(const struct ir_graph *graph, ir_ref ref)
{
    return graph->args.items + graph->nodes.items[ref].first_arg;
}
static inline ir_ref ir_arg(const struct ir_graph *graph, ir_ref ref, unsigned i)
{
    return ir_args(graph, ref)[i];
}
static inline ir_type_id ir_type_of(const struct ir_graph *graph, ir_ref ref)
{
    return graph->nodes.items[ref].type;
}

/*
 * build.c: the only way to make nodes. Folds, canonicalises commutative operands, applies
 * rules.def, hash-conses.
 */

/*
 * Any op with its result type given. Operands must exist and fit; asserts otherwise. They may lie
 * in the graph itself. Pure ops over POISON are POISON. A constant result that is not a finite
 * number is not folded: no target can spell it.
 */
ir_ref ir_build(struct ir_graph *graph, enum ir_op op, ir_type_id type, uint32_t attr,
                const ir_ref *args, unsigned num_args);

/* An op whose rule gives the type; 0 where the operands do not fit. */
ir_ref ir_op1(struct ir_graph *graph, enum ir_op op, ir_ref a);
ir_ref ir_op2(struct ir_graph *graph, enum ir_op op, ir_ref a, ir_ref b);
ir_ref ir_op3(struct ir_graph *graph, enum ir_op op, ir_ref a, ir_ref b, ir_ref c);

ir_ref ir_const(struct ir_graph *graph, const struct ir_value *value);
/* the same of a value's components */
ir_ref ir_const_words(struct ir_graph *graph, ir_type_id type, const union ir_word *words);
ir_ref ir_const_float(struct ir_graph *graph, float f);
ir_ref ir_const_int(struct ir_graph *graph, int32_t i);
ir_ref ir_const_bool(struct ir_graph *graph, bool b);
ir_ref ir_const_string(struct ir_graph *graph, str_id s);
/* vectors; the diagonal of matrices */
ir_ref ir_const_splat(struct ir_graph *graph, ir_type_id type, float f);
ir_ref ir_poison(struct ir_graph *graph, ir_type_id type);

ir_ref ir_swizzle(struct ir_graph *graph, ir_ref a, const uint8_t *components, unsigned count);
ir_ref ir_component(struct ir_graph *graph, ir_ref a, unsigned index);
/* Parts of another scalar type are converted; 0 where the parts do not make the type. */
ir_ref ir_construct(struct ir_graph *graph, ir_type_id type, const ir_ref *args, unsigned num_args);
/*
 * Between scalars or vectors of equal size, a scalar to any vector (and a matrix's diagonal), a
 * vector to a smaller one, between matrices; 0 where there is no conversion.
 */
ir_ref ir_convert(struct ir_graph *graph, ir_type_id type, ir_ref a);

bool ir_is_const(const struct ir_graph *graph, ir_ref ref);
/*
 * The components of a constant of a built-in type, until the next node is built; NULL for anything
 * else.
 */
static inline const union ir_word *ir_constant_words(const struct ir_graph *graph, ir_ref ref)
{
    const struct ir_node *node = ir_get(graph, ref);
    return node->op == IR_CONST ? graph->words.items + node->attr : NULL;
}
/* The value of such a constant; false for anything else. */
bool ir_get_const(const struct ir_graph *graph, ir_ref ref, struct ir_value *out);
bool ir_const_is(const struct ir_graph *graph, ir_ref ref, float f); /* all components equal f */

/*
 * names.c: names for the locals of a shader. A library function that is lowered inside of another
 * one ranks lower by its depth. Of two document nodes with one result the first names it; a node
 * that functions of one rank call by several names has none.
 */
enum ir_name_rank {
    IR_NAME_NONE = 0,
    IR_NAME_PARAMETER = 50, /* of a library function that takes the value */
    IR_NAME_FUNCTION = 100, /* of a library function that returns the value */
    IR_NAME_LOCAL = 150,    /* of a local variable of a library function */
    IR_NAME_ROLE = 200,     /* what the compiler knows of it: a weight, a throughput */
    IR_NAME_RESULT = 250,   /* of a document's node */
    IR_NAME_MAX_DEPTH = 49, /* deeper functions rank as this */
};
void ir_suggest_name(struct ir_graph *graph, ir_ref ref, str_id name, unsigned rank);
/* The name of a node that `copy` replaces. */
void ir_inherit_name(struct ir_graph *graph, ir_ref copy, const struct ir_node *original);

uint32_t ir_add_origin(struct ir_graph *graph, str_id name, uint32_t element, uint32_t parent);
/* the same index for the same id */
uint32_t ir_add_callee(struct ir_graph *graph, struct ir_callee callee);
uint32_t ir_add_struct(struct ir_graph *graph, str_id name, const struct ir_member *members,
                       unsigned num_members);
/* both return a type id */
uint32_t ir_add_array(struct ir_graph *graph, ir_type_id element, uint32_t length);
/* A new IR function; its results are set when its body stands. */
uint32_t ir_add_function(struct ir_graph *graph, str_id name, const ir_type_id *param_types,
                         unsigned num_params);
ir_ref ir_param(struct ir_graph *graph, uint32_t function, unsigned index);
void ir_set_results(struct ir_graph *graph, uint32_t function, const ir_ref *results,
                    unsigned num_results);

/*
 * mark.c: which nodes the roots need. Returns one byte per node: 0 or 1; bodies of called IR
 * functions included.
 */
uint8_t *ir_mark(const struct ir_graph *graph, const ir_ref *roots, uint32_t num_roots,
                 struct arena *arena);
/*
 * How often each marked node is used as an operand of marked nodes (and as a root), saturating at
 * 255.
 */
uint8_t *ir_count_uses(const struct ir_graph *graph, const uint8_t *marked, const ir_ref *roots,
                       uint32_t num_roots, struct arena *arena);

/*
 * replace.c: the node `root` over `to` where it was over `from`, in IR functions, too; what does
 * not change is not copied.
 */
ir_ref ir_replace(struct ir_graph *graph, ir_ref root, ir_ref from, ir_ref to, struct arena *arena);

/* print.c, parse.c: the text form (docs/ir.md); what is printed parses back to an equal graph. */

void ir_print(const struct ir_graph *graph, const ir_ref *roots, uint32_t num_roots,
              struct text *out);
/* NULL, or why the text is not IR, with *out_line counted from 1. Roots named by "return" lines. */
const char *ir_parse(struct ir_graph *graph, const char *text, size_t len, ir_ref **out_roots,
                     uint32_t *out_num_roots, uint32_t *out_line);

/*
 * check.c: NULL, or the first violated invariant, with the node's index. For tests and debug
 * builds.
 */
const char *ir_check(const struct ir_graph *graph, ir_ref *out_node);

/* eval.c: values of pure graphs, for tests and folding of whole graphs. */

struct ir_eval_env {
    void *user_data;
    /*
     * The value of a source (UNIFORM, STREAM, PARAM, LOCAL, CONTEXT) or of a CALL's result; false:
     * unknown.
     */
    bool (*source)(void *user_data, const struct ir_graph *graph, ir_ref ref, struct ir_value *out);
    bool (*call)(void *user_data, const struct ir_graph *graph, ir_ref call,
                 const struct ir_value *args, uint32_t result, struct ir_value *out);
};
bool ir_eval(const struct ir_graph *graph, ir_ref root, const struct ir_eval_env *env,
             struct arena *scratch, struct ir_value *out);

#endif
