// SPDX-License-Identifier: Apache-2.0
/*
 * The IR: an append-only, hash-consed, topologically ordered graph (docs/ir.md).
 *
 * The operands of a node have smaller indices than the node, equal nodes are one node, and the
 * builder folds. So array order is topological order, common subexpressions are shared by
 * construction, and no algorithm recurses. ir_check verifies this.
 */
#ifndef MXG_IR_IR_H
#define MXG_IR_IR_H

#include "base/mem.h"
#include "base/strpool.h"
#include "base/table.h"
#include "base/text.h"

#include <assert.h>

/* op_types.c */

enum ir_type {
#define IR_TYPE(ID, text, scalar, components, columns) IR_TYPE_##ID,
#include "ir/types.def"
#undef IR_TYPE
    IR_NUM_TYPES,
    /*
     * The first struct or array type of a graph or function unit: IR_TYPE_FIRST_USER + index in its
     * ir_user_types.
     */
    IR_TYPE_FIRST_USER = 64
};
typedef uint16_t ir_type_id;

struct ir_type_info {
    const char *text;
    uint8_t scalar, components, columns;
};
extern const struct ir_type_info ir_types[IR_NUM_TYPES];
static inline const struct ir_type_info *ir_type_info(ir_type_id type) /* for built-in types */
{
    assert(type < IR_NUM_TYPES);
    return &ir_types[type];
}
const char *ir_type_text(ir_type_id type);
/* Every type has them: structs, arrays and types without numbers have 0 and the scalar VOID. */
unsigned ir_type_components(ir_type_id type);
unsigned ir_type_rows(ir_type_id type); /* of a vector or matrix; 1 of a scalar */
ir_type_id ir_type_scalar(ir_type_id type);
bool ir_type_is_vector(ir_type_id type);
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
ir_type_id ir_type_vector(ir_type_id scalar, unsigned components); /* VOID if there is none */

struct ir_member {
    str_id name;
    ir_type_id type;
    uint16_t reserved; /* 0: no record of a library image has padding */
};

/* A struct (array_length 0) or an array of one type. */
struct ir_user_type {
    str_id name;
    uint32_t array_length;
    ir_type_id element; /* for arrays */
    uint16_t num_members;
    uint32_t first_member; /* in the members of the table */
    /* of a value, all levels together: scalars, and vectors and scalars; not set in a graph */
    uint32_t num_words, num_leaves;
};

/*
 * constants.c, fold.c: constants and their arithmetic, for the builder and for the evaluator of the
 * portable language
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
    OP_PURE = 1, /* no effect and no hidden input: can fold */
    OP_COMMUTES = 2,
    OP_DERIVATIVE = 4, /* needs adjacent pixels: must stay in uniform control flow */
    OP_BUILTIN = 8,    /* a function of the portable language with this text as its name */
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
    IR_RULE_RELATION,
    IR_RULE_CHOICE,
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
static inline bool ir_is_difference(enum ir_op op)
{
    return op == IR_DFDX || op == IR_DFDY || op == IR_FWIDTH;
}

static inline const struct ir_op_info *ir_op_info(enum ir_op op)
{
    assert(op < IR_NUM_OPS);
    return &ir_ops[op];
}
/* The op on one component: scalars have operators in place of relational functions. */
enum ir_op ir_op_of_component(enum ir_op op);

/*
 * The result type of an op for built-in operand types. VOID if the operands do not match, or if the
 * rule is NONE and the op is not a built-in function (TEX gives VEC4, STEP the type of x, …).
 */
ir_type_id ir_op_result(enum ir_op op, const ir_type_id *args, unsigned num_args);

/*
 * Evaluates a pure op over constants in float32, with the semantics of GLSL 4.50. false if the
 * result is undefined (integer division by zero, a shift out of range, the logarithm of 0) or the
 * op cannot be evaluated. Infinities and NaN are values like others; a NaN in the result has the
 * bits IR_NAN. `attr` as in ir_node; `type` is the result type. `out` must not be one of `args`.
 */
#define IR_NAN 0x7fc00000u
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
    uint32_t origin; /* index in graph->origins: the source of the node; 0 = none */
};

/* The attr of a SAMPLE. */
enum { IR_SAMPLE_INDEX, IR_SAMPLE_TURN };

enum ir_node_flags {
    /* it or an operand has OP_DERIVATIVE, or calls a function with derivatives */
    IR_NODE_DERIVATIVE = 1,
    IR_NODE_CLOSURE = 2, /* closure or shader type */
    /* it or an operand is CONTEXT or SAMPLE, so it has a value only inside that loop */
    IR_NODE_LOOP = 4,
    IR_NODE_DEAR = 8, /* it or an operand is a call or reads a texture */
    /* it or an operand can be undefined for defined operands: a quotient, a root */
    IR_NODE_PARTIAL = 16,
    /* inherited from operands */
    IR_NODE_INHERITED = IR_NODE_DERIVATIVE | IR_NODE_LOOP | IR_NODE_DEAR | IR_NODE_PARTIAL
};

/* The name that a shader gives to a node, stored beside the node: node_names.c. */
struct ir_label {
    str_id name;    /* 0 = no name, or several candidates */
    uint8_t rank;   /* enum ir_name_rank: the name of the higher rank wins */
    bool is_shared; /* the node has more than one origin */
};

/*
 * The source of a node, for names, comments and diagnostics. The IR stores it and never reads it.
 */
struct ir_origin {
    str_id name;      /* a readable name for a local variable: "metal_ior" */
    uint32_t element; /* element of a document or library; 0 = none */
    uint32_t parent;  /* origin of the node that instantiates this one; 0 = none */
    str_id slot;      /* the layer of a stack: "050"; 0 = none */
};

enum ir_callee_kind {
    IR_CALLEE_FUNCTION, /* of CALL: a function of the portable language */
    IR_CALLEE_VERBATIM, /* of VERBATIM: source of the target */
    IR_CALLEE_FAMILY,   /* of LEAF: a family of functions of the portable language */
    IR_CALLEE_CLOSURE,  /* of LEAF: a closure of the target */
    IR_CALLEE_SOURCE,   /* of LEAF: functions in source of the target */
    IR_NUM_CALLEE_KINDS
};
extern const char *const ir_callee_kinds[IR_NUM_CALLEE_KINDS]; /* "function" … */

/* The attr of a CONTEXT that is the whole current light, for verbatim source. */
#define IR_WHOLE_LIGHT UINT32_MAX
/* The attr of a CONTEXT that is the number of the current light, for lights of the host. */
#define IR_LIGHT_INDEX (UINT32_MAX - 1)
/* True if a CONTEXT with this attr is the member of LightData that is variable `attr`. */
static inline bool ir_is_light_member(uint32_t attr)
{
    return attr < IR_LIGHT_INDEX;
}

/* A callee of CALL, VERBATIM or LEAF nodes. Equal kind and index is an equal callee. */
struct ir_callee {
    uint8_t kind;   /* enum ir_callee_kind */
    uint32_t index; /* the owner's number: id of a function, of a family, of the closure's name… */
    str_id name;
    bool derivative; /* it contains derivatives or implicit-LOD texture reads */
    bool pure;       /* its result depends only on its arguments (no uniform or stream inside) */
};

/*
 * A function in IR: a nodegraph with several uses. Its body is the part of the graph that its
 * results reach; its parameters are PARAM nodes. Calls follow the results, so the body precedes all
 * calls.
 */
struct ir_function {
    str_id name;
    uint32_t num_params, first_param_type; /* in graph->param_types */
    uint32_t num_results, first_result;    /* in graph->function_results: refs */
};

struct ir_graph {
    struct arena *arena;
    struct strpool *strings; /* may be NULL where no strings are built */
    /* [0] of both is unused; only graph.c writes to them */
    VEC(const struct ir_node) nodes;
    VEC(const ir_ref) args;
    VEC(struct ir_label) labels; /* by node */
    /* [0] is unused; constant pool: as many as the type has components */
    VEC(union ir_word) words;
    VEC(struct ir_origin) origins; /* [0] is nothing */
    VEC(struct ir_callee) callees;
    VEC(struct ir_function) functions;
    VEC(ir_type_id) param_types;
    VEC(ir_ref) function_results;
    VEC(struct ir_user_type) user_types;
    VEC(struct ir_member) members;
    struct table table;          /* hash-consing: of nodes */
    struct table callee_table;   /* callee indices + 1 */
    uint32_t origin;             /* of new nodes: ir_push_origin */
    str_id slot;                 /* of new origins */
    VEC(uint32_t) outer_origins; /* origins below it on the stack */
    uint64_t num_builds;    /* calls of ir_build, also those that add nothing: the work so far */
    bool has_no_neighbours; /* derivatives are 0 */
    /* of these derivatives, but for constants and coordinates, which choose levels of textures */
    VEC(uint32_t) flat_origins;
    uint32_t max_nodes; /* 0 = unlimited; beyond it ->overflow is set and POISON returned */
    bool overflow;
    bool exact;   /* only apply exact rules, which hold for infinities and NaN, too */
    bool no_fold; /* no folding; for tests */
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

/* The operands of SLOTS for one layer, after those of the stack. */
struct ir_slot {
    ir_ref surface;  /* 0: none */
    ir_ref weight;   /* of its closures, before its own opacity; of a vertical layer its mask */
    ir_ref mask;     /* from 0 to 1 */
    ir_ref presence; /* its share of the normal, opacity included */
    ir_ref normal;   /* vec3, unit, in the world; 0: the layer has none */
    ir_ref mode; /* an int constant: enum ir_slot_mode, + IR_SLOT_VERTICAL over the one before */
};
enum { IR_SLOTS_FIRST = 2, IR_SLOT_OPERANDS = 6 };
enum ir_slot_mode { IR_SLOT_ADD, IR_SLOT_MIX, IR_SLOT_NONE, IR_SLOT_VERTICAL };
static inline unsigned ir_num_slots(const struct ir_graph *graph, ir_ref slots)
{
    return (graph->nodes.items[slots].num_args - IR_SLOTS_FIRST) / IR_SLOT_OPERANDS;
}
static inline struct ir_slot ir_slot(const struct ir_graph *graph, ir_ref slots, unsigned i)
{
    const ir_ref *args = ir_args(graph, slots) + IR_SLOTS_FIRST + i * IR_SLOT_OPERANDS;
    return (struct ir_slot){args[0], args[1], args[2], args[3], args[4], args[5]};
}
/* The modes are small constants. */
bool ir_slot_is_vertical(const struct ir_graph *graph, const struct ir_slot *slot);
enum ir_slot_mode ir_slot_mode(const struct ir_graph *graph, const struct ir_slot *slot);
static inline ir_type_id ir_type_of(const struct ir_graph *graph, ir_ref ref)
{
    return graph->nodes.items[ref].type;
}

/* True for a closure, not for 0. */
static inline bool ir_is_closure(const struct ir_graph *graph, ir_ref ref)
{
    return ref && ir_type_is_closure(ir_type_of(graph, ref));
}
/* True for an op that makes a closure of others. */
static inline bool ir_is_operator(enum ir_op op)
{
    return op == IR_LAYER || op == IR_CLOSURE_MIX || op == IR_CLOSURE_ADD || op == IR_CLOSURE_SCALE;
}

/*
 * build.c: the only way to make nodes. Folds, orders commutative operands, applies rules.def,
 * hash-conses.
 */

/*
 * Builds any op with a given result type. Asserts that the operands exist and match. `args` may
 * point into the graph. A pure op with a POISON operand is POISON. A constant result that is not
 * finite does not fold, because no target can write it.
 */
ir_ref ir_build(struct ir_graph *graph, enum ir_op op, ir_type_id type, uint32_t attr,
                const ir_ref *args, unsigned num_args);
/* Builds a node over other operands. If it is new, it has the origin and the name of the old one.
 */
ir_ref ir_copy_as(struct ir_graph *graph, ir_ref ref, ir_type_id type, uint32_t attr,
                  const ir_ref *args, unsigned num_args);
/* ir_copy_as with the type, the attribute and the number of operands of the old node */
ir_ref ir_copy(struct ir_graph *graph, ir_ref ref, const ir_ref *args);

/* Builds an op and derives the type by its rule; 0 if the operands do not match. */
ir_ref ir_op1(struct ir_graph *graph, enum ir_op op, ir_ref a);
ir_ref ir_op2(struct ir_graph *graph, enum ir_op op, ir_ref a, ir_ref b);
ir_ref ir_op3(struct ir_graph *graph, enum ir_op op, ir_ref a, ir_ref b, ir_ref c);

ir_ref ir_const(struct ir_graph *graph, const struct ir_value *value);
/* from the components of a value */
ir_ref ir_const_words(struct ir_graph *graph, ir_type_id type, const union ir_word *words);
ir_ref ir_const_float(struct ir_graph *graph, float f);
ir_ref ir_const_int(struct ir_graph *graph, int32_t i);
ir_ref ir_const_bool(struct ir_graph *graph, bool b);
ir_ref ir_const_string(struct ir_graph *graph, str_id s);
/* vectors; the diagonal of matrices */
ir_ref ir_const_splat(struct ir_graph *graph, ir_type_id type, float f);
/* Its attribute is the origin, so that a message can name the place. */
ir_ref ir_poison(struct ir_graph *graph, ir_type_id type);

ir_ref ir_swizzle(struct ir_graph *graph, ir_ref a, const uint8_t *components, unsigned count);
ir_ref ir_component(struct ir_graph *graph, ir_ref a, unsigned index);
/* Converts parts of another scalar type; 0 if the parts do not match the type. */
ir_ref ir_construct(struct ir_graph *graph, ir_type_id type, const ir_ref *args, unsigned num_args);
/*
 * Converts between scalars or vectors of equal size, a scalar to a vector (or to the diagonal of a
 * matrix), a vector to a smaller one, and between matrices; 0 if there is no conversion.
 */
ir_ref ir_convert(struct ir_graph *graph, ir_type_id type, ir_ref a);

bool ir_is_const(const struct ir_graph *graph, ir_ref ref);
/*
 * The components of a constant of a built-in type. The pointer is valid until the next node is
 * built. NULL for other nodes.
 */
static inline const union ir_word *ir_constant_words(const struct ir_graph *graph, ir_ref ref)
{
    const struct ir_node *node = ir_get(graph, ref);
    return node->op == IR_CONST ? graph->words.items + node->attr : NULL;
}
/* The value of a constant of a built-in type; false for other nodes. */
bool ir_get_const(const struct ir_graph *graph, ir_ref ref, struct ir_value *out);
/*
 * Returns the rest of an operator of closures of which one operand is absent, 0: the other one. A
 * volume behind nothing is nothing.
 */
ir_ref ir_other_operand(const struct ir_graph *graph, enum ir_op op, ir_ref a, ir_ref b);
bool ir_const_is(const struct ir_graph *graph, ir_ref ref, float f); /* all components equal f */

/*
 * node_names.c: suggests names for the locals of a shader. The rank of a library function decreases
 * with the depth of its inlining. If two document nodes have the same result, the first one names
 * it. A node with several names of the same rank has the first.
 */
enum ir_name_rank {
    IR_NAME_NONE = 0,
    IR_NAME_PARAMETER = 50, /* of a library function that takes the value */
    IR_NAME_FUNCTION = 100, /* of a library function that returns the value */
    IR_NAME_LOCAL = 150,    /* of a local variable of a library function */
    IR_NAME_ROLE = 200,     /* its role in the shader: a weight, a throughput */
    IR_NAME_COPY = 220,     /* of one of several copies of a value: at one angle */
    IR_NAME_RESULT = 250,   /* of a document's node */
    IR_NAME_MAX_DEPTH = 49, /* deeper functions rank as this */
};
void ir_suggest_name(struct ir_graph *graph, ir_ref ref, str_id name, unsigned rank);
static inline const struct ir_label *ir_label(const struct ir_graph *graph, ir_ref ref)
{
    assert(ref < graph->labels.len);
    return &graph->labels.items[ref];
}

uint32_t ir_add_origin(struct ir_graph *graph, str_id name, uint32_t element, uint32_t parent);
/*
 * New nodes get the origin on top of a stack. The lowest entry is "no origin". Each push has its
 * pop in the same step of a generation.
 */
static inline void ir_push_origin(struct ir_graph *graph, uint32_t origin)
{
    assert(origin < graph->origins.len);
    vec_push(graph->arena, &graph->outer_origins, graph->origin);
    graph->origin = origin;
}
static inline void ir_pop_origin(struct ir_graph *graph)
{
    assert(graph->outer_origins.len > 0);
    graph->origin = vec_pop(&graph->outer_origins);
}
/* pushes a new origin that has only a name */
static inline void ir_push_name(struct ir_graph *graph, str_id name)
{
    ir_push_origin(graph, ir_add_origin(graph, name, 0, 0));
}
/* replaces the name on top of the stack */
static inline void ir_change_name(struct ir_graph *graph, str_id name)
{
    ir_pop_origin(graph);
    ir_push_name(graph, name);
}
static inline void ir_push_origin_of(struct ir_graph *graph, ir_ref ref)
{
    ir_push_origin(graph, ir_get(graph, ref)->origin);
}
/* returns the same index for an equal callee */
uint32_t ir_add_callee(struct ir_graph *graph, struct ir_callee callee);
uint32_t ir_add_struct(struct ir_graph *graph, str_id name, const struct ir_member *members,
                       unsigned num_members);
/* both return a type id */
uint32_t ir_add_array(struct ir_graph *graph, ir_type_id element, uint32_t length);
/* Adds an IR function. The caller sets its results after it built the body. */
uint32_t ir_add_function(struct ir_graph *graph, str_id name, const ir_type_id *param_types,
                         unsigned num_params);
ir_ref ir_param(struct ir_graph *graph, uint32_t function, unsigned index);
void ir_set_results(struct ir_graph *graph, uint32_t function, const ir_ref *results,
                    unsigned num_results);

/*
 * mark.c: marks the nodes that the roots need. Returns one byte per node, 0 or 1, including the
 * bodies of called IR functions.
 */
uint8_t *ir_mark(const struct ir_graph *graph, const ir_ref *roots, uint32_t num_roots,
                 struct arena *arena);
/*
 * A POISON that the roots need; 0: there is none. An arm of a SELECT may be POISON: functions leave
 * a variable without a value in the cases that they exclude.
 */
ir_ref ir_find_poison(const struct ir_graph *graph, const ir_ref *roots, uint32_t num_roots,
                      struct arena *arena);

/*
 * replace.c: rebuilds `root` with `to` in place of `from`, also in IR functions. Unchanged nodes
 * are not copied.
 */
ir_ref ir_replace(struct ir_graph *graph, ir_ref root, ir_ref from, ir_ref to, struct arena *arena);

/*
 * rebuild.c: makes a new graph from the needed nodes (ir_mark). Returns the new node per old
 * node, 0 for removed nodes. Types, callees, origins and functions keep their indices.
 */
struct ir_pass {
    void *user_data;
    /*
     * Builds the new node for the node `old`, of the same type; 0: a copy, which does not fold.
     * `node` is the content of `old`; `args` are the new operands, which the function may
     * overwrite. Constants are copied without this call.
     */
    ir_ref (*build)(void *user_data, struct ir_graph *graph, ir_ref old, const struct ir_node *node,
                    ir_ref *args);
};
const ir_ref *ir_rebuild(struct ir_graph *graph, const uint8_t *needed, const struct ir_pass *pass,
                         struct arena *arena);

/* graph_text.c: the text form (docs/ir.md). */
void ir_print(const struct ir_graph *graph, const ir_ref *roots, uint32_t num_roots,
              struct text *out);

/*
 * invariants.c: NULL, or the first broken invariant of a graph. *out_node receives the node that
 * breaks it, or 0 if a table of the graph breaks it.
 */
const char *ir_check(const struct ir_graph *graph, ir_ref *out_node);
/*
 * With -Dcheck_ir=true: if ir_check finds a broken invariant, ends the program and names the step,
 * the node and the invariant. Other builds do nothing here.
 */
void ir_assert_valid(const struct ir_graph *graph, const char *step);

/* eval.c: evaluates pure graphs, for tests and for folding whole graphs. */

enum { IR_MAX_RESULTS = 17 /* of a CALL that has a value */ };

struct ir_eval_env {
    void *user_data;
    /*
     * The value of a source (UNIFORM, STREAM, PARAM, LOCAL, CONTEXT), or of a screen derivative;
     * false if it is unknown.
     */
    bool (*source)(void *user_data, const struct ir_graph *graph, ir_ref ref, struct ir_value *out);
    /* The results of a CALL: out[i] is that of RESULT i. Returns their number; 0: unknown. */
    uint32_t (*call)(void *user_data, const struct ir_graph *graph, ir_ref call,
                     const struct ir_value *args, struct ir_value out[IR_MAX_RESULTS]);
    /*
     * The value of a texture; place: its coordinates, NULL if they are unknown. NULL: textures are
     * unknown.
     */
    bool (*texture)(void *user_data, const struct ir_graph *graph, ir_ref ref,
                    const struct ir_value *place, struct ir_value *out);
};
struct ir_eval_frame {
    ir_ref at, end;  /* next node, and end of the range */
    uint8_t *needed; /* per node */
    /*
     * per node: index of its value in ->words, or for a call of its results in ->results;
     * 0 = unknown
     */
    uint32_t *places;
    ir_ref call; /* the node that waits for this frame; 0 in the outermost frame */
};

/*
 * Evaluates many nodes of one graph, which may grow meanwhile. The sources keep their values. The
 * environment and the arena live as long.
 */
struct ir_evaluator {
    const struct ir_graph *graph;
    const struct ir_eval_env *env;
    struct arena *scratch;
    VEC(struct ir_eval_frame) frames;
    VEC(union ir_word) words; /* [0] unused */
    VEC(uint32_t) results;    /* [0] unused; places in words */
    VEC(uint8_t) needed;      /* of the outermost frame: visited in this run or before */
    VEC(uint32_t) places;
    VEC(ir_ref) visits;
    VEC(struct ir_value) args; /* of a call */
    uint64_t num_steps;        /* of all runs: nodes, also those in functions */
};
void ir_evaluator_init(struct ir_evaluator *e, const struct ir_graph *graph,
                       const struct ir_eval_env *env, struct arena *scratch);
bool ir_evaluate(struct ir_evaluator *e, ir_ref root, struct ir_value *out);
/* Forgets all values, because sources have others now. */
void ir_evaluator_forget(struct ir_evaluator *e);
/* One node; nothing is kept. */
bool ir_eval(const struct ir_graph *graph, ir_ref root, const struct ir_eval_env *env,
             struct arena *scratch, struct ir_value *out);

#endif
