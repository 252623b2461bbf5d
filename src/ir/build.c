// SPDX-License-Identifier: Apache-2.0
/*
 * build: the only code that makes nodes. It sorts commutative operands, folds constants, applies
 * rules.def, cancels constructors and swizzles, and hash-conses the result, in this order.
 */
#include "ir/ir_priv.h"

#include <assert.h>

enum { MAX_FOLD_ARGS = 16 }; /* a mat4 from scalars */

static ir_ref fold(struct ir_graph *graph, enum ir_op op, ir_type_id type, uint32_t attr,
                   const ir_ref *args, unsigned num_args)
{
    struct ir_value values[MAX_FOLD_ARGS], result;
    for (unsigned i = 0; i < num_args; i++)
        ir_get_const(graph, args[i], &values[i]);
    if (!ir_eval_op(op, type, attr, values, num_args, &result))
        return 0;
    assert(result.type == type);
    return ir_intern_const(graph, type, result.w);
}

/*
 * Constants go last, so that rules look for them in one place; otherwise the older operand goes
 * first. Products of linear algebra do not commute.
 */
static void sort_operands(const struct ir_graph *graph, enum ir_op op, ir_ref *args)
{
    const struct ir_node *a = ir_get(graph, args[0]), *b = ir_get(graph, args[1]);
    bool a_is_const = a->op == IR_CONST, b_is_const = b->op == IR_CONST;
    bool sorted = a_is_const == b_is_const ? args[0] <= args[1] : b_is_const;
    if (sorted || (op == IR_MUL && ir_is_linear_mul(a->type, b->type)))
        return;
    ir_ref first = args[0];
    args[0] = args[1];
    args[1] = first;
}

/*
 * The simplifier sees arithmetic, choices and functions only if they have vector operands. It sees
 * constructors, swizzles, members and indices of every type, and dot products.
 */
static bool may_simplify(enum ir_op op, ir_type_id type)
{
    if ((op > IR_SELECT && op <= IR_INDEX) || op == IR_DOT)
        return true;
    bool on_vectors = (op >= IR_SELECT && op <= IR_SMOOTHSTEP) || (op >= IR_ADD && op <= IR_DIV);
    return on_vectors && type >= IR_TYPE_VEC2 && type <= IR_TYPE_VEC4;
}

/* This check costs about as much as making the node, so only test builds do it. */
static void assert_well_formed(const struct ir_graph *graph, enum ir_op op, ir_type_id type,
                               uint32_t attr, const ir_ref *args, unsigned num_args)
{
#ifdef MXG_CHECK_IR
    const char *problem = ir_node_problem(graph, op, type, attr, args, num_args);
    if (problem)
        ir_fail("a new node", graph->nodes.len, op, problem);
#else
    (void)graph, (void)op, (void)type, (void)attr, (void)args, (void)num_args;
#endif
}

ir_ref ir_build(struct ir_graph *graph, enum ir_op op, ir_type_id type, uint32_t attr,
                const ir_ref *args, unsigned num_args)
{
    assert_well_formed(graph, op, type, attr, args, num_args);
    graph->num_builds++;
    if (op == IR_KNOWN) {
        const union ir_word *words = ir_constant_words(graph, args[0]);
        return ir_const_bool(graph, words && words->u);
    }
    if (graph->has_no_neighbours && ir_is_difference(op)) {
        if (ir_get(graph, args[0])->op != IR_CONST && type != IR_TYPE_VEC2)
            vec_push(graph->arena, &graph->flat_origins, graph->origin);
        return ir_const_splat(graph, type, 0.0f);
    }
    if (graph->no_fold || num_args == 0 || num_args > MAX_FOLD_ARGS)
        return ir_intern(graph, op, type, attr, args, num_args);
    ir_ref own[MAX_FOLD_ARGS]; /* the simplifier adds nodes, and `args` may point into the graph */
    unsigned num_consts = 0, flags = ir_op_info(op)->flags;
    bool has_poison = false;
    for (unsigned i = 0; i < num_args; i++) {
        own[i] = args[i];
        num_consts += ir_get(graph, own[i])->op == IR_CONST;
        has_poison |= ir_get(graph, own[i])->op == IR_POISON;
    }
    if (has_poison && flags & OP_PURE && op != IR_SELECT)
        return ir_poison(graph, type);
    ir_ref result = 0;
    if (num_consts == num_args && flags & OP_PURE)
        result = fold(graph, op, type, attr, own, num_args);
    if (!result && (op == IR_MUL || flags & OP_COMMUTES))
        sort_operands(graph, op, own);
    struct ir_content content = {op, type, attr, num_args, own, 0};
    if (!result) /* no rule applied to an equal node when it was made */
        result = ir_find(graph, &content);
    if (!result)
        result = ir_apply_rules(graph, op, type, own, num_args);
    if (!result && num_consts && (op == IR_ADD || op == IR_SUB || op == IR_DIV))
        result = ir_simplify_by_constant(graph, op, own[0], own[1]);
    if (!result && op == IR_ABS)
        result = ir_simplify_abs(graph, own[0]);
    if (!result && may_simplify(op, type))
        result = ir_simplify(graph, op, type, attr, own, num_args);
    return result ? result : ir_add(graph, &content);
}

ir_ref ir_copy_as(struct ir_graph *graph, ir_ref ref, ir_type_id type, uint32_t attr,
                  const ir_ref *args, unsigned num_args)
{
    uint32_t num_nodes = graph->nodes.len;
    ir_push_origin_of(graph, ref);
    ir_ref copy = ir_build(graph, (enum ir_op)ir_get(graph, ref)->op, type, attr, args, num_args);
    ir_pop_origin(graph);
    if (copy >= num_nodes)
        graph->labels.items[copy] = graph->labels.items[ref];
    return copy;
}

ir_ref ir_copy(struct ir_graph *graph, ir_ref ref, const ir_ref *args)
{
    const struct ir_node node = *ir_get(graph, ref);
    return ir_copy_as(graph, ref, node.type, node.attr, args, node.num_args);
}

static ir_ref build_by_rule(struct ir_graph *graph, enum ir_op op, const ir_ref *args,
                            unsigned num_args)
{
    ir_type_id types[3];
    for (unsigned i = 0; i < num_args; i++)
        types[i] = ir_type_of(graph, args[i]);
    assert(num_args <= sizeof types / sizeof *types);
    ir_type_id type = ir_op_result(op, types, num_args);
    return type == IR_TYPE_VOID ? 0 : ir_build(graph, op, type, 0, args, num_args);
}

ir_ref ir_op1(struct ir_graph *graph, enum ir_op op, ir_ref a)
{
    return build_by_rule(graph, op, &a, 1);
}

ir_ref ir_op2(struct ir_graph *graph, enum ir_op op, ir_ref a, ir_ref b)
{
    return build_by_rule(graph, op, (ir_ref[]){a, b}, 2);
}

ir_ref ir_op3(struct ir_graph *graph, enum ir_op op, ir_ref a, ir_ref b, ir_ref c)
{
    return build_by_rule(graph, op, (ir_ref[]){a, b, c}, 3);
}

/* ---- Constants ---- */

ir_ref ir_const(struct ir_graph *graph, const struct ir_value *value)
{
    return ir_intern_const(graph, value->type, value->w);
}

ir_ref ir_const_words(struct ir_graph *graph, ir_type_id type, const union ir_word *words)
{
    return ir_intern_const(graph, type, words);
}

ir_ref ir_const_float(struct ir_graph *graph, float f)
{
    return ir_intern_const(graph, IR_TYPE_FLOAT, &(union ir_word){.f = f});
}

ir_ref ir_const_int(struct ir_graph *graph, int32_t i)
{
    return ir_intern_const(graph, IR_TYPE_INT, &(union ir_word){.i = i});
}

ir_ref ir_const_bool(struct ir_graph *graph, bool b)
{
    return ir_intern_const(graph, IR_TYPE_BOOL, &(union ir_word){.u = b});
}

ir_ref ir_const_string(struct ir_graph *graph, str_id s)
{
    return ir_intern_const(graph, IR_TYPE_STRING, &(union ir_word){.u = s});
}

ir_ref ir_const_splat(struct ir_graph *graph, ir_type_id type, float f)
{
    struct ir_value scalar = ir_value_float(f), value;
    bool fits = ir_eval_op(IR_CONSTRUCT, type, 0, &scalar, 1, &value);
    assert(fits);
    return fits ? ir_const(graph, &value) : ir_poison(graph, type);
}

/* ---- Constructors and parts ---- */

ir_ref ir_swizzle(struct ir_graph *graph, ir_ref a, const uint8_t *components, unsigned count)
{
    uint32_t attr = count << 8;
    assert(count >= 1 && count <= 4);
    for (unsigned i = 0; i < count; i++)
        attr |= (uint32_t)components[i] << (2 * i);
    ir_type_id scalar = ir_type_info(ir_type_of(graph, a))->scalar;
    return ir_build(graph, IR_SWIZZLE, ir_type_vector(scalar, count), attr, &a, 1);
}

ir_ref ir_component(struct ir_graph *graph, ir_ref a, unsigned index)
{
    uint8_t component = (uint8_t)index;
    assert(index < ir_type_info(ir_type_of(graph, a))->components);
    return ir_swizzle(graph, a, &component, 1);
}

/* The type with the shape of `from` and another scalar type; VOID if there is none. */
static ir_type_id with_scalar(ir_type_id from, ir_type_id scalar)
{
    const struct ir_type_info *info = ir_type_info(from);
    if (info->scalar == scalar)
        return from;
    bool fits = info->columns == 1 && info->scalar >= IR_TYPE_BOOL && info->scalar <= IR_TYPE_FLOAT
                && scalar >= IR_TYPE_BOOL && scalar <= IR_TYPE_FLOAT;
    return fits ? ir_type_vector(scalar, info->components) : IR_TYPE_VOID;
}

ir_ref ir_construct(struct ir_graph *graph, ir_type_id type, const ir_ref *args, unsigned num_args)
{
    ir_ref parts[MAX_FOLD_ARGS];
    if (type >= IR_NUM_TYPES)
        return ir_node_problem(graph, IR_CONSTRUCT, type, 0, args, num_args)
                   ? 0
                   : ir_build(graph, IR_CONSTRUCT, type, 0, args, num_args);
    if (num_args > MAX_FOLD_ARGS)
        return 0;
    for (unsigned i = 0; i < num_args; i++) {
        ir_type_id from = ir_type_of(graph, args[i]);
        ir_type_id to =
            from < IR_NUM_TYPES ? with_scalar(from, ir_type_info(type)->scalar) : IR_TYPE_VOID;
        if (to == IR_TYPE_VOID)
            return 0;
        parts[i] = ir_build(graph, IR_CONVERT, to, 0, &args[i], 1);
    }
    if (ir_node_problem(graph, IR_CONSTRUCT, type, 0, parts, num_args))
        return 0;
    return ir_build(graph, IR_CONSTRUCT, type, 0, parts, num_args);
}

ir_ref ir_convert(struct ir_graph *graph, ir_type_id type, ir_ref a)
{
    ir_type_id from = ir_type_of(graph, a);
    if (from == type)
        return a;
    if (from >= IR_NUM_TYPES || type >= IR_NUM_TYPES)
        return 0;
    const struct ir_type_info *info = ir_type_info(type);
    if (ir_type_info(from)->components == 1 && info->components > 1)
        return ir_construct(graph, type, &a, 1);
    if (!ir_type_is_matrix(type)) { /* cut first: fewer components to convert */
        if (ir_type_info(from)->components > info->components && ir_type_info(from)->columns == 1)
            a = ir_build(graph, IR_CONVERT,
                         ir_type_vector(ir_type_info(from)->scalar, info->components), 0, &a, 1);
    }
    if (ir_node_problem(graph, IR_CONVERT, type, 0, &a, 1))
        return 0;
    return ir_build(graph, IR_CONVERT, type, 0, &a, 1);
}
