// SPDX-License-Identifier: Apache-2.0
/*
 * simplify: ops that build and take apart cancel out.
 *
 * A vector is a list of components: each is a scalar node or one component of a vector node.
 * Swizzles and constructors become such lists, and the lists become nodes again in one canonical
 * form:
 *
 *     construct(v.x, v.y, v.z)  →  v                    v.zyx.xy                →  v.zy
 *     construct(a, b, c).yx     →  construct(b, a)
 *     construct(v.x, v.y, s)    →  construct(v.xy, s)
 */
#include "ir/ir_priv.h"

#include <assert.h>
#include <math.h>

struct component {
    ir_ref source;  /* a scalar, or a vector other than a constant, swizzle or constructor */
    unsigned index; /* index in a vector */
};

static bool is_vector(ir_type_id type)
{
    return type < IR_NUM_TYPES && ir_type_info(type)->components > 1
           && ir_type_info(type)->columns == 1;
}

static bool is_float_vector(ir_type_id type)
{
    return type >= IR_TYPE_VEC2 && type <= IR_TYPE_VEC4;
}

static unsigned components_of(const struct ir_graph *graph, ir_ref ref)
{
    return ir_type_info(ir_type_of(graph, ref))->components;
}

static struct component component_of_const(struct ir_graph *graph, ir_ref ref, unsigned index)
{
    const struct ir_node *node = ir_get(graph, ref);
    assert(index < ir_type_info(node->type)->components);
    union ir_word word = graph->words.items[node->attr + index];
    return (struct component){.source =
                                  ir_intern_const(graph, ir_type_info(node->type)->scalar, &word)};
}

/* Component `index` of scalar or vector `ref`, looked up through one swizzle. */
static struct component component_of_part(struct ir_graph *graph, ir_ref ref, unsigned index)
{
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op == IR_CONST)
        return component_of_const(graph, ref, index);
    if (node->op == IR_SWIZZLE)
        return (struct component){.source = ir_arg(graph, ref, 0),
                                  .index = node->attr >> (2 * index) & 3};
    return (struct component){.source = ref, .index = index};
}

/*
 * component_of_part, through a constructor too. The parts of the constructor are no constructors
 * themselves.
 */
static struct component component_of(struct ir_graph *graph, ir_ref ref, unsigned index)
{
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op != IR_CONSTRUCT)
        return component_of_part(graph, ref, index);
    if (node->num_args == 1)
        return component_of_part(graph, ir_arg(graph, ref, 0), 0);
    for (unsigned k = 0;; k++) {
        ir_ref part = ir_arg(graph, ref, k);
        unsigned count = components_of(graph, part);
        if (index < count)
            return component_of_part(graph, part, index);
        index -= count;
    }
}

/* Counts the components, from the first, that belong to one vector. */
static unsigned run_length(const struct ir_graph *graph, const struct component *list,
                           unsigned count)
{
    unsigned n = 1;
    if (is_vector(ir_type_of(graph, list[0].source)))
        while (n < count && list[n].source == list[0].source)
            n++;
    return n;
}

/* Components of one vector: the vector itself or a swizzle; a scalar stands for itself. */
static ir_ref join_run(struct ir_graph *graph, const struct component *list, unsigned count)
{
    ir_ref source = list[0].source;
    ir_type_id type = ir_type_of(graph, source);
    if (!is_vector(type))
        return source;
    uint32_t attr = count << 8;
    bool whole = count == ir_type_info(type)->components;
    for (unsigned i = 0; i < count; i++) {
        attr |= (uint32_t)list[i].index << (2 * i);
        whole = whole && list[i].index == i;
    }
    ir_type_id result = ir_type_vector(ir_type_info(type)->scalar, count);
    assert(result != IR_TYPE_VOID);
    return whole ? source : ir_intern(graph, IR_SWIZZLE, result, attr, &source, 1);
}

static bool is_splat(const struct ir_graph *graph, const struct component *list, unsigned count)
{
    if (is_vector(ir_type_of(graph, list[0].source)))
        return false;
    for (unsigned i = 1; i < count; i++)
        if (list[i].source != list[0].source)
            return false;
    return true;
}

static ir_ref join(struct ir_graph *graph, ir_type_id type, const struct component *list,
                   unsigned count)
{
    unsigned length = run_length(graph, list, count);
    if (length == count)
        return join_run(graph, list, count);
    if (is_splat(graph, list, count)) {
        ir_ref scalar = list[0].source;
        return ir_intern(graph, IR_CONSTRUCT, type, 0, &scalar, 1);
    }
    ir_ref parts[4];
    unsigned num_parts = 0;
    for (unsigned at = 0; at < count; at += length) {
        length = run_length(graph, list + at, count - at);
        parts[num_parts++] = join_run(graph, list + at, length);
    }
    assert(num_parts >= 2 && num_parts <= count);
    return ir_intern(graph, IR_CONSTRUCT, type, 0, parts, num_parts);
}

/* Constants are folded before, so at least one component here is not constant. */
static ir_ref simplify_swizzle(struct ir_graph *graph, ir_type_id type, uint32_t attr, ir_ref a)
{
    struct component list[4];
    unsigned count = ir_type_info(type)->components;
    for (unsigned i = 0; i < count; i++)
        list[i] = component_of(graph, a, attr >> (2 * i) & 3);
    assert(count == attr >> 8);
    union ir_word words[4];
    for (unsigned i = 0; i < count; i++) {
        const struct ir_node *node = ir_get(graph, list[i].source);
        if (node->op == IR_NEG && count == 1) /* a sign is cheaper on a part */
            return ir_op1(graph, IR_NEG,
                          ir_component(graph, ir_arg(graph, list[i].source, 0), list[i].index));
        if (node->op != IR_CONST)
            return join(graph, type, list, count);
        words[i] = graph->words.items[node->attr];
    }
    /* a swizzle that drops the variable part of a constructor */
    return ir_intern_const(graph, type, words);
}

/* The struct if these are all its members in order; 0 otherwise. */
static ir_ref whole_of(const struct ir_graph *graph, ir_type_id type, const ir_ref *members,
                       unsigned count)
{
    const struct ir_node *first = ir_get(graph, members[0]);
    ir_ref whole = first->op == IR_MEMBER ? ir_arg(graph, members[0], 0) : 0;
    if (!whole || ir_type_of(graph, whole) != type)
        return 0;
    for (unsigned i = 0; i < count; i++) {
        const struct ir_node *node = ir_get(graph, members[i]);
        if (node->op != IR_MEMBER || node->attr != i || ir_arg(graph, members[i], 0) != whole)
            return 0;
    }
    return whole;
}

static ir_ref simplify_construct(struct ir_graph *graph, ir_type_id type, const ir_ref *args,
                                 unsigned num_args)
{
    if (num_args == 1 && ir_type_of(graph, args[0]) == type)
        return args[0];
    if (type >= IR_NUM_TYPES)
        return whole_of(graph, type, args, num_args);
    if (!is_vector(type))
        return 0;
    struct component list[4];
    unsigned count = ir_type_info(type)->components, at = 0;
    if (num_args == 1)
        for (; at < count; at++)
            list[at] = component_of(graph, args[0], 0);
    for (unsigned k = 0; at < count; k++)
        for (unsigned i = 0, n = components_of(graph, args[k]); i < n; i++)
            list[at++] = component_of(graph, args[k], i);
    assert(at == count);
    return join(graph, type, list, count);
}

static ir_ref simplify_convert(struct ir_graph *graph, ir_type_id type, ir_ref a)
{
    ir_type_id from = ir_type_of(graph, a);
    if (from == type)
        return a;
    if (!is_vector(from) || ir_type_info(from)->scalar != ir_type_info(type)->scalar)
        return 0;
    static const uint8_t leading[4] = {0, 1, 2, 3};
    return ir_swizzle(graph, a, leading, ir_type_info(type)->components);
}

/*
 * Part `index` of a constructor of a struct, array or matrix of columns; 0 if `a` is no such
 * constructor.
 */
static ir_ref part_of(const struct ir_graph *graph, ir_ref a, uint32_t index)
{
    const struct ir_node *node = ir_get(graph, a);
    if (node->op != IR_CONSTRUCT || index >= node->num_args)
        return 0;
    if (ir_type_is_matrix(node->type) && node->num_args != ir_type_info(node->type)->columns)
        return 0;
    return ir_arg(graph, a, index);
}

static uint32_t num_parts(const struct ir_graph *graph, ir_type_id type)
{
    if (type >= IR_NUM_TYPES)
        return graph->user_types.items[type - IR_TYPE_FIRST_USER].array_length;
    const struct ir_type_info *info = ir_type_info(type);
    return info->columns > 1 ? info->columns : info->components;
}

/* No target takes a constant index that is out of range: the last part stands for those beyond. */
static ir_ref simplify_index(struct ir_graph *graph, ir_type_id type, ir_ref a, ir_ref index)
{
    const struct ir_node *node = ir_get(graph, index);
    if (node->op != IR_CONST)
        return 0;
    uint32_t i = graph->words.items[node->attr].u, length = num_parts(graph, ir_type_of(graph, a));
    if (i >= length) {
        ir_ref last = ir_const_int(graph, (int32_t)length - 1);
        return ir_build(graph, IR_INDEX, type, 0, (ir_ref[]){a, last}, 2);
    }
    return is_vector(ir_type_of(graph, a)) ? ir_component(graph, a, i) : part_of(graph, a, i);
}

/* ---- Arithmetic of vectors and scalars ---- */

static bool is_scalar_float(const struct ir_graph *graph, ir_ref ref)
{
    return ir_type_of(graph, ref) == IR_TYPE_FLOAT;
}

/* The scalar that fills a vector; 0 if the components differ. */
static ir_ref splat_of(struct ir_graph *graph, ir_ref ref)
{
    const struct ir_node *node = ir_get(graph, ref);
    if (!is_float_vector(node->type))
        return 0;
    if (node->op == IR_CONSTRUCT && node->num_args == 1)
        return ir_arg(graph, ref, 0);
    if (node->op != IR_CONST)
        return 0;
    const union ir_word *words = graph->words.items + node->attr;
    for (unsigned i = 1; i < ir_type_info(node->type)->components; i++)
        if (words[i].u != words[0].u)
            return 0;
    return ir_const_float(graph, words[0].f);
}

/* v.y for v.yyy; 0 for other nodes. */
static ir_ref repeated_of(struct ir_graph *graph, ir_ref ref)
{
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op != IR_SWIZZLE || !is_float_vector(node->type))
        return 0;
    for (unsigned i = 1; i < ir_type_info(node->type)->components; i++)
        if ((node->attr >> (2 * i) & 3) != (node->attr & 3))
            return 0;
    return ir_component(graph, ir_arg(graph, ref, 0), node->attr & 3);
}

/* (v · s) · t = v · (s t): a product of scalars replaces a product of vectors. */
static ir_ref gather_scalars(struct ir_graph *graph, ir_ref a, ir_ref b)
{
    if (is_scalar_float(graph, a)) {
        ir_ref swap = a;
        a = b;
        b = swap;
    }
    const struct ir_node *node = ir_get(graph, a);
    if (graph->exact || node->op != IR_MUL || !is_vector(node->type) || !is_scalar_float(graph, b))
        return 0;
    /* v · s may move in front of the loop, or several products may share it */
    if (ir_get(graph, b)->flags & IR_NODE_LOOP)
        return 0;
    ir_ref v = ir_arg(graph, a, 0), s = ir_arg(graph, a, 1);
    if (is_scalar_float(graph, v))
        return ir_op2(graph, IR_MUL, s, ir_op2(graph, IR_MUL, v, b));
    return is_scalar_float(graph, s) ? ir_op2(graph, IR_MUL, v, ir_op2(graph, IR_MUL, s, b)) : 0;
}

static bool is_negative(float f)
{
    return f < 0.0f;
}

/* True if the reciprocal of f is exact. */
static bool is_power_of_two(float f)
{
    int exponent;
    return fabsf(frexpf(f, &exponent)) == 0.5f && exponent > -120 && exponent < 120 && f != 1.0f;
}

static bool all_components(const struct ir_graph *graph, ir_ref ref, bool (*test)(float))
{
    const union ir_word *words = ir_constant_words(graph, ref);
    for (unsigned i = 0; i < ir_type_info(ir_type_of(graph, ref))->components; i++)
        if (!test(words[i].f))
            return false;
    return true;
}

static bool is_not_negative(float f)
{
    return f >= 0.0f;
}

ir_ref ir_simplify_abs(const struct ir_graph *graph, ir_ref a)
{
    ir_ref low = ir_get(graph, a)->op == IR_CLAMP ? ir_arg(graph, a, 1) : 0;
    return low && ir_is_const(graph, low)
                   && ir_type_info(ir_type_of(graph, low))->scalar == IR_TYPE_FLOAT
                   && all_components(graph, low, is_not_negative)
               ? a
               : 0;
}

ir_ref ir_simplify_by_constant(struct ir_graph *graph, enum ir_op op, ir_ref a, ir_ref b)
{
    const struct ir_type_info *info = ir_type_info(ir_type_of(graph, b));
    /* a product of matrices is not componentwise */
    if (!ir_is_const(graph, b) || info->scalar != IR_TYPE_FLOAT || info->columns != 1)
        return 0;
    if (op == IR_DIV && all_components(graph, b, is_power_of_two))
        return ir_op2(graph, IR_MUL, a,
                      ir_op2(graph, IR_DIV, ir_const_splat(graph, ir_type_of(graph, b), 1.0f), b));
    if ((op == IR_ADD || op == IR_SUB) && all_components(graph, b, is_negative))
        return ir_op2(graph, op == IR_ADD ? IR_SUB : IR_ADD, a, ir_op1(graph, IR_NEG, b));
    return 0;
}

/*
 * vec3(a) op vec3(b) = vec3(a op b), and vec3(a) op v = a op v. A constant stays a vector, except
 * in a product, because targets compute with the vector anyway.
 */
static ir_ref simplify_arithmetic(struct ir_graph *graph, enum ir_op op, ir_type_id type, ir_ref a,
                                  ir_ref b)
{
    if (!is_float_vector(type))
        return 0;
    ir_ref sa = is_scalar_float(graph, a) ? a : splat_of(graph, a),
           sb = is_scalar_float(graph, b) ? b : splat_of(graph, b);
    ir_ref fill_a = sa ? sa : repeated_of(graph, a), fill_b = sb ? sb : repeated_of(graph, b);
    if (fill_a && fill_b) {
        ir_ref scalar = ir_op2(graph, op, fill_a, fill_b);
        return ir_build(graph, IR_CONSTRUCT, type, 0, &scalar, 1);
    }
    if (op != IR_MUL && sa == a && ir_is_const(graph, a))
        return ir_op2(graph, op, ir_convert(graph, type, a), b);
    if (op != IR_MUL && sb == b && ir_is_const(graph, b))
        return ir_op2(graph, op, a, ir_convert(graph, type, b));
    bool narrow_a = sa && sa != a && (op == IR_MUL || ir_get(graph, a)->op != IR_CONST)
                    && ir_type_of(graph, b) == type;
    bool narrow_b = sb && sb != b && (op == IR_MUL || ir_get(graph, b)->op != IR_CONST)
                    && ir_type_of(graph, a) == type;
    if (narrow_a || narrow_b)
        return ir_op2(graph, op, narrow_a ? sa : a, narrow_b ? sb : b);
    return op == IR_MUL ? gather_scalars(graph, a, b) : 0;
}

/* f(vec3(a), vec3(b)) = vec3(f(a, b)) where f works component by component. */
static ir_ref simplify_componentwise(struct ir_graph *graph, enum ir_op op, ir_type_id type,
                                     const ir_ref *args, unsigned num_args)
{
    ir_ref scalars[3];
    if (!is_float_vector(type))
        return 0;
    for (unsigned i = 0; i < num_args; i++) {
        scalars[i] = is_scalar_float(graph, args[i]) ? args[i] : splat_of(graph, args[i]);
        if (!scalars[i])
            return 0;
    }
    ir_ref scalar = ir_build(graph, op, IR_TYPE_FLOAT, 0, scalars, num_args);
    return ir_build(graph, IR_CONSTRUCT, type, 0, &scalar, 1);
}

/* dot(vec3(a), k) = a (k.x + k.y + k.z) for a constant k. */
static ir_ref simplify_dot(struct ir_graph *graph, ir_ref a, ir_ref b)
{
    bool is_swapped = ir_is_const(graph, a);
    ir_ref k = is_swapped ? a : b, scalar = splat_of(graph, is_swapped ? b : a);
    if (graph->exact || !scalar || !ir_is_const(graph, k))
        return 0;
    const union ir_word *words = ir_constant_words(graph, k);
    double sum = 0;
    for (unsigned i = 0; i < ir_type_info(ir_type_of(graph, k))->components; i++)
        sum += (double)words[i].f;
    return ir_op2(graph, IR_MUL, scalar, ir_const_float(graph, (float)sum));
}

/* The scalar s of a product v s; 0 if `ref` is no such product. */
static ir_ref scalar_factor(const struct ir_graph *graph, ir_ref ref, ir_ref v)
{
    if (ir_get(graph, ref)->op != IR_MUL)
        return 0;
    ir_ref a = ir_arg(graph, ref, 0), b = ir_arg(graph, ref, 1);
    if (a == v && is_scalar_float(graph, b))
        return b;
    return b == v && is_scalar_float(graph, a) ? a : 0;
}

/* c ? v s : 0 = v (c ? s : 0). */
static ir_ref simplify_select_or_zero(struct ir_graph *graph, ir_ref condition, ir_ref product)
{
    if (ir_get(graph, product)->op != IR_MUL)
        return 0;
    ir_ref v = ir_arg(graph, product, 0), s = ir_arg(graph, product, 1);
    if (is_scalar_float(graph, v)) {
        ir_ref swap = v;
        v = s;
        s = swap;
    }
    if (!is_scalar_float(graph, s))
        return 0;
    return ir_op2(graph, IR_MUL, v,
                  ir_op3(graph, IR_SELECT, condition, s, ir_const_float(graph, 0.0f)));
}

/* c ? v : v s = v (c ? 1 : s): the choice is between scalars. */
static ir_ref simplify_select(struct ir_graph *graph, ir_type_id type, ir_ref condition, ir_ref a,
                              ir_ref b)
{
    if (graph->exact || !is_float_vector(type))
        return 0;
    if (ir_const_is(graph, b, 0.0f))
        return simplify_select_or_zero(graph, condition, a);
    ir_ref in_b = scalar_factor(graph, b, a), in_a = in_b ? 0 : scalar_factor(graph, a, b);
    if (!in_a && !in_b)
        return 0;
    ir_ref one = ir_const_float(graph, 1.0f);
    ir_ref scalar = ir_op3(graph, IR_SELECT, condition, in_b ? one : in_a, in_b ? in_b : one);
    return ir_op2(graph, IR_MUL, in_b ? a : b, scalar);
}

ir_ref ir_simplify(struct ir_graph *graph, enum ir_op op, ir_type_id type, uint32_t attr,
                   const ir_ref *args, unsigned num_args)
{
    switch (op) {
    case IR_ADD:
    case IR_SUB:
    case IR_MUL:
    case IR_DIV: return simplify_arithmetic(graph, op, type, args[0], args[1]);
    case IR_DOT: return simplify_dot(graph, args[0], args[1]);
    case IR_SELECT: return simplify_select(graph, type, args[0], args[1], args[2]);
    case IR_SWIZZLE: return simplify_swizzle(graph, type, attr, args[0]);
    case IR_CONSTRUCT: return simplify_construct(graph, type, args, num_args);
    case IR_CONVERT: return simplify_convert(graph, type, args[0]);
    case IR_MEMBER: return part_of(graph, args[0], attr);
    case IR_INDEX: return simplify_index(graph, type, args[0], args[1]);
    default:
        return op >= IR_RADIANS && op <= IR_SMOOTHSTEP
                   ? simplify_componentwise(graph, op, type, args, num_args)
                   : 0;
    }
}
