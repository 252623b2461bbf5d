// SPDX-License-Identifier: Apache-2.0
/* Combines closures: sums, factors, mixes and layers. Constants simplify the result. */
#include "generators/osl/closure_tree.h"

#include <assert.h>

ir_ref osl_call(struct osl_tree *t, const char *name, ir_type_id type, const ir_ref *args,
                unsigned n)
{
    assert(ir_type_is_closure(type));
    str_id id = str_intern_z(t->shader->strings, name);
    uint32_t callee = ir_add_callee(
        t->graph, (struct ir_callee){.kind = IR_CALLEE_CLOSURE, .index = id, .name = id});
    return ir_build(t->graph, IR_LEAF, type, callee, args, n);
}

ir_ref osl_transparent(struct osl_tree *t)
{
    return osl_call(t, "transparent_bsdf", IR_TYPE_BSDF, NULL, 0);
}

ir_ref osl_behind(struct osl_tree *t)
{
    str_id name = str_intern_z(t->shader->strings, "u_backfacing");
    return shader_read(t->shader, shader_private_uniform(t->shader, name, IR_TYPE_BOOL, 0));
}

ir_ref osl_emission(struct osl_tree *t, ir_ref radiance)
{
    assert(ir_type_of(t->graph, radiance) == IR_TYPE_VEC3);
    return osl_call(t, "uniform_edf", IR_TYPE_EDF, &radiance, 1);
}

/* The number that all parts of a colour share; otherwise the colour itself. */
static ir_ref number_of(const struct ir_graph *g, ir_ref color)
{
    const struct ir_node *node = ir_get(g, color);
    bool is_splat = (node->op == IR_CONSTRUCT || node->op == IR_CONVERT) && node->num_args == 1;
    return is_splat && ir_type_of(g, ir_arg(g, color, 0)) == IR_TYPE_FLOAT ? ir_arg(g, color, 0)
                                                                           : color;
}

ir_ref osl_scaled(struct osl_tree *t, ir_ref closure, ir_ref factor)
{
    if (!closure || !factor || ir_const_is(t->graph, factor, 1.0f))
        return closure;
    if (ir_const_is(t->graph, factor, 0.0f))
        return 0;
    ir_ref args[2] = {closure, number_of(t->graph, factor)};
    return ir_build(t->graph, IR_CLOSURE_SCALE, ir_type_of(t->graph, closure), 0, args, 2);
}

ir_ref osl_sum(struct osl_tree *t, ir_ref a, ir_ref b)
{
    ir_ref args[2] = {a, b};
    if (!a || !b)
        return a ? a : b;
    return ir_build(t->graph, IR_CLOSURE_ADD, ir_type_of(t->graph, a), 0, args, 2);
}

/* The factor f if `closure` is f times the other closure; 0 if it is not. */
static ir_ref factor_over(struct osl_tree *t, ir_ref closure, ir_ref scale)
{
    const struct ir_node *node = ir_get(t->graph, scale);
    ir_ref factor = 0;
    for (; node->op == IR_CLOSURE_SCALE; node = ir_get(t->graph, scale)) {
        ir_ref own = ir_arg(t->graph, scale, 1);
        scale = ir_arg(t->graph, scale, 0);
        factor = factor ? ir_op2(t->graph, IR_MUL, own, factor) : own;
        if (scale == closure)
            return factor;
    }
    return 0;
}

ir_ref osl_mixed(struct osl_tree *t, ir_ref bg, ir_ref fg, ir_ref mix)
{
    ir_ref args[3] = {bg, fg, mix};
    if (ir_const_is(t->graph, mix, 0.0f) || bg == fg)
        return bg;
    if (ir_const_is(t->graph, mix, 1.0f))
        return fg;
    if (!bg)
        return osl_scaled(t, fg, mix);
    if (!fg)
        return osl_scaled(t, bg, ir_one_minus(t->graph, mix));
    ir_ref factor = factor_over(t, bg, fg);
    if (factor) /* the closure once, mixed between 1 and the factor */
        return osl_scaled(t, bg,
                          ir_op3(t->graph, IR_MIX,
                                 ir_const_splat(t->graph, ir_type_of(t->graph, factor), 1.0f),
                                 factor, mix));
    return ir_build(t->graph, IR_CLOSURE_MIX, ir_type_of(t->graph, bg), 0, args, 3);
}

ir_ref osl_layered(struct osl_tree *t, ir_ref top, ir_ref base)
{
    ir_ref args[2] = {top, base};
    if (!top || !base)
        return top ? top : base;
    return ir_build(t->graph, IR_LAYER, IR_TYPE_BSDF, 0, args, 2);
}
