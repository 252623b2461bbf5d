// SPDX-License-Identifier: Apache-2.0
/*
 * Light goes through the media above a leaf on its way in. The weight of the leaf is a function of
 * that way x, in thicknesses of the media: a sum of powers of x, because each combination of
 * slabs that are there lets one power through. Three values of the sum give one power:
 *
 *     w(x)  = A + B decay^x
 *     decay = (w(1) - w(2)) / (w(0) - w(1))
 *     B     = (w(0) - w(1)) / (1 - decay)
 *
 * A sum of powers is convex, so the decay lies in 0..1. docs/slabs.md has the measured error.
 */
#include "closure/closure_priv.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

#include <assert.h>

ir_ref closure_both_decays(struct ir_graph *g, ir_ref a, ir_ref b)
{
    if (!a || !b)
        return a ? a : b;
    return a == CLOSURE_MIXED || b == CLOSURE_MIXED ? CLOSURE_MIXED : ir_mul(g, a, b);
}

ir_ref closure_way(struct shader *shader, const struct closure_host *host, ir_ref direction)
{
    return FORMULA(shader, "mx_closure_way", closure_normal(shader, host), direction);
}

ir_ref closure_environment_way(struct shader *shader, const struct closure_host *host, ir_ref leaf)
{
    ir_ref way = closure_call(shader, host, leaf, LEAF_WAY, NULL);
    /* the mirror of the viewer's angle */
    return way ? way : closure_way(shader, host, closure_view(shader, host));
}

static ir_ref white_or(struct ir_graph *g, ir_ref color)
{
    return color ? ir_convert(g, IR_TYPE_VEC3, color) : ir_white(g);
}

ir_ref closure_weight(struct shader *shader, const struct closure_leaf *leaf, ir_ref way)
{
    struct ir_graph *g = shader->graph;
    if (!leaf->decay)
        return ir_product(g, leaf->color, leaf->scalar);
    assert(leaf->decay != CLOSURE_MIXED);
    ir_ref color = leaf->color;
    if (!ir_const_is(g, way, 0.0f)) {
        color = white_or(g, color);
        color = FORMULA(shader, "mx_decayed", color, leaf->decay, way);
    }
    color = white_or(g, color);
    if (leaf->steady)
        color = ir_add(g, leaf->steady, color);
    return ir_product(g, color, leaf->scalar);
}

/* Finds a leaf in another list; NULL: it has no weight there. */
static const struct closure_leaf *same_leaf(const struct closure_list *list,
                                            const struct closure_leaf *of)
{
    for (uint32_t i = 0; i < list->leaves.len; i++) {
        const struct closure_leaf *leaf = &list->leaves.items[i];
        if (leaf->leaf == of->leaf && leaf->interior == of->interior)
            return leaf;
    }
    return NULL;
}

/* Its colour, as a factor of `scalar`. */
static ir_ref color_over(struct ir_graph *g, const struct closure_leaf *leaf, ir_ref scalar)
{
    if (!leaf)
        return ir_black(g);
    return leaf->scalar == scalar ? white_or(g, leaf->color)
                                  : white_or(g, ir_product(g, leaf->color, leaf->scalar));
}

void closure_fit_decay(struct shader *shader, struct closure_leaf *leaf,
                       const struct closure_leaf *const at[2])
{
    struct ir_graph *g = shader->graph;
    ir_ref one = ir_const_float(g, 1.0f);
    for (unsigned i = 0; i < 2; i++)
        if (at[i] && at[i]->scalar != leaf->scalar) {
            leaf->color = ir_product(g, leaf->color, leaf->scalar);
            leaf->scalar = one;
        }
    ir_ref at_rest = white_or(g, leaf->color), once = color_over(g, at[0], leaf->scalar),
           twice = color_over(g, at[1], leaf->scalar);
    ir_ref decay = FORMULA(shader, "mx_decay", at_rest, once, twice);
    ir_ref share = FORMULA(shader, "mx_decaying", at_rest, once, decay);
    closure_name(shader, decay, leaf->leaf, "decay");
    leaf->decay = decay;
    leaf->steady = ir_sub(g, at_rest, share);
    leaf->color = share;
    closure_name(shader, leaf->steady, leaf->leaf, "steady");
}

void closure_fit_decays(struct shader *shader, struct closure_list *list,
                        const struct closure_list ways[2])
{
    for (uint32_t i = 0; i < list->leaves.len; i++) {
        struct closure_leaf *leaf = &list->leaves.items[i];
        if (leaf->decay != CLOSURE_MIXED)
            continue;
        const struct closure_leaf *at[2] = {same_leaf(&ways[0], leaf), same_leaf(&ways[1], leaf)};
        ir_push_origin_of(shader->graph, leaf->leaf);
        closure_fit_decay(shader, leaf, at);
        ir_pop_origin(shader->graph);
    }
}

void closure_put_under(struct shader *shader, const struct closure_host *host,
                       const struct closure_above *above, struct closure_list *list)
{
    struct ir_graph *g = shader->graph;
    ir_ref nothing = ir_const_float(g, 0.0f), way = ir_const_float(g, CLOSURE_MEAN_WAY);
    ir_ref spreads = ir_op2(g, IR_GT, above->spreads, nothing);
    ir_ref one = ir_white(g), mean = FORMULA(shader, "mx_decayed", above->color, above->decay, way);
    for (uint32_t i = 0; i < list->leaves.len; i++) {
        struct closure_leaf *leaf = &list->leaves.items[i];
        assert(!leaf->decay && !leaf->steady);
        bool mirrors = !closure_has(shader, host, leaf->leaf, LEAF_WAY);
        ir_ref color = mirrors ? ir_op3(g, IR_SELECT, spreads, mean, above->color) : above->color;
        leaf->decay = mirrors ? ir_op3(g, IR_SELECT, spreads, one, above->decay) : above->decay;
        leaf->steady = ir_product(g, leaf->color, above->steady);
        leaf->color = ir_product(g, leaf->color, color);
    }
}
