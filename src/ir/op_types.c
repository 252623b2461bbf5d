// SPDX-License-Identifier: Apache-2.0
/* types: the tables of types and ops, and how an op's operand types give its result type. */
#include "ir/ir_priv.h"

const struct ir_type_info ir_types[IR_NUM_TYPES] = {
#define IR_TYPE(ID, text, scalar, components, columns) \
    {text, IR_TYPE_##scalar, components, columns},
#include "ir/types.def"
#undef IR_TYPE
};

const struct ir_op_info ir_ops[IR_NUM_OPS] = {
#define OP(ID, text, arity, rule, flags, doc) \
    {text, arity, IR_RULE_##rule, flags, sizeof text - 1, doc},
#include "ir/ops.def"
#undef OP
};

const char *const ir_callee_kinds[IR_NUM_CALLEE_KINDS] = {
    [IR_CALLEE_FUNCTION] = "function", [IR_CALLEE_VERBATIM] = "verbatim",
    [IR_CALLEE_FAMILY] = "family",     [IR_CALLEE_CLOSURE] = "closure",
    [IR_CALLEE_SOURCE] = "source",
};

const char *ir_type_text(ir_type_id type)
{
    return type < IR_NUM_TYPES ? ir_types[type].text : "struct or array";
}

unsigned ir_type_components(ir_type_id type)
{
    return type < IR_NUM_TYPES ? ir_types[type].components : 0;
}

unsigned ir_type_rows(ir_type_id type)
{
    unsigned columns = type < IR_NUM_TYPES ? ir_types[type].columns : 0;
    return ir_type_components(type) / (columns > 1 ? columns : 1);
}

ir_type_id ir_type_scalar(ir_type_id type)
{
    return type < IR_NUM_TYPES ? ir_types[type].scalar : IR_TYPE_VOID;
}

bool ir_type_is_vector(ir_type_id type)
{
    return ir_type_components(type) > 1 && ir_types[type].columns == 1;
}

ir_type_id ir_type_vector(ir_type_id scalar, unsigned components)
{
    if (components == 1 && scalar < IR_NUM_TYPES && ir_types[scalar].scalar == scalar
        && ir_types[scalar].components == 1)
        return scalar;
    if (components < 2 || components > 4)
        return IR_TYPE_VOID;
    switch (scalar) {
    case IR_TYPE_BOOL: return (ir_type_id)(IR_TYPE_BVEC2 + components - 2);
    case IR_TYPE_INT: return (ir_type_id)(IR_TYPE_IVEC2 + components - 2);
    case IR_TYPE_UINT: return (ir_type_id)(IR_TYPE_UVEC2 + components - 2);
    case IR_TYPE_FLOAT: return (ir_type_id)(IR_TYPE_VEC2 + components - 2);
    default: return IR_TYPE_VOID;
    }
}

static bool is_scalar(ir_type_id type)
{
    return ir_type_components(type) == 1;
}

static bool is_integer(ir_type_id type)
{
    return ir_type_scalar(type) == IR_TYPE_INT || ir_type_scalar(type) == IR_TYPE_UINT;
}

static bool is_numeric(ir_type_id type)
{
    return is_integer(type) || ir_type_scalar(type) == IR_TYPE_FLOAT;
}

bool ir_is_linear_mul(ir_type_id a, ir_type_id b)
{
    return (ir_type_is_matrix(a) && !is_scalar(b)) || (ir_type_is_matrix(b) && !is_scalar(a));
}

/* True if SAME, SPLAT and REDUCE ops compute over `type`. */
static bool in_domain(enum ir_op op, ir_type_id type)
{
    unsigned flags = ir_ops[op].flags;
    if (flags & OP_MATRIX)
        return ir_type_is_matrix(type);
    if (op == IR_CROSS)
        return type == IR_TYPE_VEC3;
    if (type >= IR_NUM_TYPES || ir_types[type].columns > 1)
        return false;
    ir_type_id scalar = ir_types[type].scalar;
    return scalar == IR_TYPE_FLOAT || (scalar == IR_TYPE_INT && (flags & OP_SIGNED))
           || (scalar == IR_TYPE_UINT && (flags & OP_UNSIGNED));
}

static bool all_equal(const ir_type_id *args, unsigned num_args)
{
    for (unsigned i = 1; i < num_args; i++)
        if (args[i] != args[0])
            return false;
    return true;
}

static ir_type_id result_arith(enum ir_op op, const ir_type_id *args, unsigned num_args)
{
    ir_type_id a = args[0], b = args[num_args - 1];
    if (!is_numeric(a) || !is_numeric(b) || ir_types[a].scalar != ir_types[b].scalar)
        return IR_TYPE_VOID;
    if (a == b || is_scalar(b))
        return a;
    if (is_scalar(a))
        return b;
    if (op != IR_MUL || !ir_is_linear_mul(a, b))
        return IR_TYPE_VOID;
    if (ir_type_is_matrix(a))
        return ir_types[a].columns == ir_types[b].components ? b : IR_TYPE_VOID;
    return ir_types[b].columns == ir_types[a].components ? a : IR_TYPE_VOID;
}

static ir_type_id result_splat(enum ir_op op, const ir_type_id *args, unsigned num_args)
{
    ir_type_id type = args[0], last = args[num_args - 1];
    if (!in_domain(op, type) || (op == IR_REFRACT && last != IR_TYPE_FLOAT))
        return IR_TYPE_VOID;
    if (last != type && last != ir_types[type].scalar)
        return IR_TYPE_VOID;
    ir_type_id middle = op == IR_MIX || op == IR_REFRACT ? type : last;
    return num_args < 3 || args[1] == middle ? type : IR_TYPE_VOID;
}

static ir_type_id result_compare(enum ir_op op, const ir_type_id *args, unsigned num_args)
{
    ir_type_id type = args[0];
    bool is_user_type = type >= IR_NUM_TYPES;
    if (!all_equal(args, num_args) || (!is_user_type && ir_types[type].components == 0))
        return IR_TYPE_VOID;
    if (op == IR_EQ || op == IR_NE)
        return IR_TYPE_BOOL;
    if (is_user_type)
        return IR_TYPE_VOID;
    if (num_args == 1)
        return ir_type_scalar(type) == IR_TYPE_FLOAT && ir_types[type].columns == 1
                   ? ir_type_vector(IR_TYPE_BOOL, ir_types[type].components)
                   : IR_TYPE_VOID;
    return is_scalar(type) && is_numeric(type) ? IR_TYPE_BOOL : IR_TYPE_VOID;
}

/* Bools have no order; the relations that commute need none. */
static ir_type_id result_relation(enum ir_op op, const ir_type_id *args, unsigned num_args)
{
    ir_type_id type = args[0];
    bool has_order = is_numeric(type);
    if (!all_equal(args, num_args) || !ir_type_is_vector(type)
        || (!has_order && !(ir_ops[op].flags & OP_COMMUTES)))
        return IR_TYPE_VOID;
    return ir_type_vector(IR_TYPE_BOOL, ir_types[type].components);
}

static ir_type_id result_choice(const ir_type_id *args)
{
    ir_type_id type = args[0];
    bool fits = ir_type_is_vector(type) && ir_type_scalar(type) == IR_TYPE_FLOAT && args[1] == type
                && args[2] == ir_type_vector(IR_TYPE_BOOL, ir_types[type].components);
    return fits ? type : IR_TYPE_VOID;
}

static ir_type_id result_integer(enum ir_op op, const ir_type_id *args, unsigned num_args)
{
    ir_type_id a = args[0], b = args[num_args - 1];
    bool is_shift = op == IR_SHL || op == IR_SHR;
    if (!is_integer(a) || !is_integer(b) || (!is_shift && ir_type_scalar(a) != ir_type_scalar(b)))
        return IR_TYPE_VOID;
    if (ir_types[a].components == ir_types[b].components || is_scalar(b))
        return a;
    return is_scalar(a) && !is_shift ? b : IR_TYPE_VOID;
}

/* The operands of built-in functions whose types follow no rule. */
static const struct signature {
    uint8_t op;
    ir_type_id result, args[4];
} signatures[] = {
    {IR_TEX, IR_TYPE_VEC4, {IR_TYPE_SAMPLER, IR_TYPE_VEC2}},
    {IR_TEX_LOD, IR_TYPE_VEC4, {IR_TYPE_SAMPLER, IR_TYPE_VEC2, IR_TYPE_FLOAT}},
    {IR_TEX_GRAD, IR_TYPE_VEC4, {IR_TYPE_SAMPLER, IR_TYPE_VEC2, IR_TYPE_VEC2, IR_TYPE_VEC2}},
    {IR_TEX_LOD, IR_TYPE_VEC4, {IR_TYPE_SAMPLER_ARRAY, IR_TYPE_VEC3, IR_TYPE_FLOAT}},
    {IR_TEX_GRAD, IR_TYPE_VEC4, {IR_TYPE_SAMPLER_ARRAY, IR_TYPE_VEC3, IR_TYPE_VEC2, IR_TYPE_VEC2}},
    {IR_TEX_SIZE, IR_TYPE_IVEC2, {IR_TYPE_SAMPLER, IR_TYPE_INT}},
    {IR_TEX_SIZE, IR_TYPE_IVEC2, {IR_TYPE_SAMPLER_ARRAY, IR_TYPE_INT}},
    {IR_TEX_FETCH, IR_TYPE_VEC4, {IR_TYPE_SAMPLER, IR_TYPE_IVEC2, IR_TYPE_INT}},
};

/* Built-in functions of one operand whose result has components of another type. */
static const struct {
    uint8_t op;
    ir_type_id from, to; /* types of the components */
    bool takes_vectors_only, is_scalar;
} retyping[] = {
    {IR_FLOAT_TO_INT_BITS, IR_TYPE_FLOAT, IR_TYPE_INT, false, false},
    {IR_FLOAT_TO_UINT_BITS, IR_TYPE_FLOAT, IR_TYPE_UINT, false, false},
    {IR_INT_BITS_TO_FLOAT, IR_TYPE_INT, IR_TYPE_FLOAT, false, false},
    {IR_UINT_BITS_TO_FLOAT, IR_TYPE_UINT, IR_TYPE_FLOAT, false, false},
    {IR_ANY, IR_TYPE_BOOL, IR_TYPE_BOOL, true, true},
    {IR_ALL, IR_TYPE_BOOL, IR_TYPE_BOOL, true, true},
    {IR_NOT_EACH, IR_TYPE_BOOL, IR_TYPE_BOOL, true, false},
};

static ir_type_id result_builtin(enum ir_op op, const ir_type_id *args, unsigned num_args)
{
    for (size_t i = 0; i < sizeof retyping / sizeof *retyping; i++)
        if (retyping[i].op == op) {
            bool fits = ir_type_scalar(args[0]) == retyping[i].from
                        && (ir_type_is_vector(args[0])
                            || (is_scalar(args[0]) && !retyping[i].takes_vectors_only));
            return !fits ? IR_TYPE_VOID
                   : retyping[i].is_scalar
                       ? retyping[i].to
                       : ir_type_vector(retyping[i].to, ir_types[args[0]].components);
        }
    if (op == IR_STEP || op == IR_SMOOTHSTEP) { /* edges of the type of x, or scalar */
        ir_type_id x = args[num_args - 1];
        bool fits = in_domain(op, x) && all_equal(args, num_args - 1)
                    && (args[0] == x || args[0] == IR_TYPE_FLOAT);
        return fits ? x : IR_TYPE_VOID;
    }
    for (size_t i = 0; i < sizeof signatures / sizeof *signatures; i++)
        if (signatures[i].op == op
            && memcmp(signatures[i].args, args, num_args * sizeof *args) == 0)
            return signatures[i].result;
    return IR_TYPE_VOID;
}

ir_type_id ir_op_result(enum ir_op op, const ir_type_id *args, unsigned num_args)
{
    const struct ir_op_info *info = &ir_ops[op];
    if (num_args == 0 || (info->arity >= 0 && num_args != (unsigned)info->arity))
        return IR_TYPE_VOID;
    switch ((enum ir_rule)info->rule) {
    case IR_RULE_NONE:
        return info->flags & OP_BUILTIN ? result_builtin(op, args, num_args) : IR_TYPE_VOID;
    case IR_RULE_SAME:
        return all_equal(args, num_args) && in_domain(op, args[0]) ? args[0] : IR_TYPE_VOID;
    case IR_RULE_REDUCE:
        return all_equal(args, num_args) && in_domain(op, args[0]) ? ir_types[args[0]].scalar
                                                                   : IR_TYPE_VOID;
    case IR_RULE_ARITH: return result_arith(op, args, num_args);
    case IR_RULE_SPLAT: return result_splat(op, args, num_args);
    case IR_RULE_COMPARE: return result_compare(op, args, num_args);
    case IR_RULE_RELATION: return result_relation(op, args, num_args);
    case IR_RULE_CHOICE: return result_choice(args);
    case IR_RULE_LOGIC:
        return all_equal(args, num_args) && args[0] == IR_TYPE_BOOL ? IR_TYPE_BOOL : IR_TYPE_VOID;
    case IR_RULE_INTEGER: return result_integer(op, args, num_args);
    case IR_RULE_SELECT:
        return args[0] == IR_TYPE_BOOL && args[1] == args[2] ? args[1] : IR_TYPE_VOID;
    }
    return IR_TYPE_VOID;
}

enum ir_op ir_op_of_component(enum ir_op op)
{
    switch (op) {
    case IR_LESS: return IR_LT;
    case IR_LESS_EQUAL: return IR_LE;
    case IR_GREATER: return IR_GT;
    case IR_GREATER_EQUAL: return IR_GE;
    case IR_EQUAL: return IR_EQ;
    case IR_NOT_EQUAL: return IR_NE;
    default: return op;
    }
}
