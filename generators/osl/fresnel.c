// SPDX-License-Identifier: Apache-2.0
/* The reflectance of an interface at a cosine, relative to normal incidence, as nodes. */
#include "generators/osl/tree.h"

static ir_ref squared(struct ir_graph *g, ir_ref x)
{
    return ir_op2(g, IR_MUL, x, x);
}

/* The reflectance of a conductor at normal incidence: ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2). */
static ir_ref frontal_of_conductor(struct ir_graph *g, ir_ref n, ir_ref k)
{
    ir_ref one = ir_const_float(g, 1.0f), extinct = squared(g, k);
    ir_ref less = ir_op2(g, IR_ADD, squared(g, ir_op2(g, IR_SUB, n, one)), extinct);
    return ir_op2(g, IR_DIV, less,
                  ir_op2(g, IR_ADD, squared(g, ir_op2(g, IR_ADD, n, one)), extinct));
}

/* By Schlick's curve. */
static ir_ref schlick_rise(struct ir_graph *g, ir_ref frontal, ir_ref edge, ir_ref exponent,
                           ir_ref cosine)
{
    ir_ref rise = ir_op2(g, IR_POW, closure_one_minus(g, cosine),
                         exponent ? exponent : ir_const_float(g, 5.0f));
    edge = edge ? edge : ir_const_splat(g, ir_type_of(g, frontal), 1.0f);
    return ir_op2(g, IR_DIV, ir_op3(g, IR_MIX, frontal, edge, rise), frontal);
}

/*
 * For a dielectric: F = ((d - c) / (d + c))^2 (1 + ((c (d + c) - 1) / (c (d - c) + 1))^2) / 2 with
 * d^2 = n^2 - 1 + c^2 (Cook 1982).
 */
static ir_ref dielectric_rise(struct ir_graph *g, ir_ref n, ir_ref cosine)
{
    ir_ref one = ir_const_float(g, 1.0f);
    ir_ref d = ir_op2(g, IR_SUB, squared(g, n), one);
    d = ir_op1(g, IR_SQRT, ir_op2(g, IR_ADD, d, squared(g, cosine)));
    ir_ref sum = ir_op2(g, IR_ADD, d, cosine), difference = ir_op2(g, IR_SUB, d, cosine);
    ir_ref across = squared(g, ir_op2(g, IR_DIV, difference, sum));
    ir_ref ratio = ir_op2(g, IR_SUB, ir_op2(g, IR_MUL, cosine, sum), one);
    ratio = ir_op2(g, IR_DIV, ratio, ir_op2(g, IR_ADD, ir_op2(g, IR_MUL, cosine, difference), one));
    ir_ref frontal = ir_op2(g, IR_SUB, n, one);
    frontal = squared(g, ir_op2(g, IR_DIV, frontal, ir_op2(g, IR_ADD, n, one)));
    ir_ref twice = ir_op2(g, IR_MUL, across, ir_op2(g, IR_ADD, squared(g, ratio), one));
    return ir_op2(g, IR_DIV, ir_op2(g, IR_MUL, twice, ir_const_float(g, 0.5f)), frontal);
}

ir_ref osl_fresnel_rise(struct ir_graph *g, const struct osl_interface *of, ir_ref cosine)
{
    if (of->color0)
        return schlick_rise(g, of->color0, of->color90, of->exponent, cosine);
    if (of->extinction)
        return schlick_rise(g, frontal_of_conductor(g, of->ior, of->extinction), 0, 0, cosine);
    return dielectric_rise(g, of->ior, cosine);
}
