// SPDX-License-Identifier: Apache-2.0
/* Sums and products of nodes, where a whole formula of libraries/ would be more than that. */
#ifndef MXG_IR_ARITHMETIC_H
#define MXG_IR_ARITHMETIC_H

#include "ir/ir.h"

static inline ir_ref ir_add(struct ir_graph *graph, ir_ref a, ir_ref b)
{
    return ir_op2(graph, IR_ADD, a, b);
}
static inline ir_ref ir_sub(struct ir_graph *graph, ir_ref a, ir_ref b)
{
    return ir_op2(graph, IR_SUB, a, b);
}
static inline ir_ref ir_mul(struct ir_graph *graph, ir_ref a, ir_ref b)
{
    return ir_op2(graph, IR_MUL, a, b);
}
static inline ir_ref ir_div(struct ir_graph *graph, ir_ref a, ir_ref b)
{
    return ir_op2(graph, IR_DIV, a, b);
}
static inline ir_ref ir_mix(struct ir_graph *graph, ir_ref a, ir_ref b, ir_ref share)
{
    return ir_op3(graph, IR_MIX, a, b, share);
}
static inline ir_ref ir_scaled(struct ir_graph *graph, ir_ref a, float factor)
{
    return ir_op2(graph, IR_MUL, a, ir_const_float(graph, factor));
}
/* 1 - a */
static inline ir_ref ir_one_minus(struct ir_graph *graph, ir_ref a)
{
    return ir_op2(graph, IR_SUB, ir_const_splat(graph, ir_type_of(graph, a), 1.0f), a);
}
/* clamp(a, 0, 1) */
static inline ir_ref ir_saturate(struct ir_graph *graph, ir_ref a)
{
    ir_ref zero = ir_const_float(graph, 0.0f), one = ir_const_float(graph, 1.0f);
    return ir_op3(graph, IR_CLAMP, a, zero, one);
}
/* share.c: the same of a value that may be outside; 0 for 0. */
ir_ref ir_share(struct ir_graph *graph, ir_ref value);
static inline ir_ref ir_white(struct ir_graph *graph)
{
    return ir_const_splat(graph, IR_TYPE_VEC3, 1.0f);
}
static inline ir_ref ir_black(struct ir_graph *graph)
{
    return ir_const_splat(graph, IR_TYPE_VEC3, 0.0f);
}

/* (1, 0, 0), (0, 1, 0) or (0, 0, 1) */
static inline ir_ref ir_axis(struct ir_graph *graph, unsigned index)
{
    struct ir_value value = {.type = IR_TYPE_VEC3};
    value.w[index].f = 1.0f;
    return ir_const(graph, &value);
}

/* A sum in which 0 stands for nothing. */
static inline ir_ref ir_sum(struct ir_graph *graph, ir_ref a, ir_ref b)
{
    return a && b ? ir_add(graph, a, b) : a ? a : b;
}
/* A product in which 0 stands for 1. */
static inline ir_ref ir_product(struct ir_graph *graph, ir_ref a, ir_ref b)
{
    return a && b ? ir_mul(graph, a, b) : a ? a : b;
}

#endif
