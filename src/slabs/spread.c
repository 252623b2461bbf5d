// SPDX-License-Identifier: Apache-2.0
#include "slabs/spread.h"

#define POWER 1.1f
#define MOST 0.999f   /* alpha^1.1 of the widest lobe */
#define SLOPE 0.0801f /* of alpha 1: 1 / (18 ln 2) */

static ir_ref num(struct ir_graph *g, float f)
{
    return ir_const_float(g, f);
}

static ir_ref mul(struct ir_graph *g, ir_ref a, ir_ref b)
{
    return ir_op2(g, IR_MUL, a, b);
}

static ir_ref mixed(struct ir_graph *g, ir_ref a, ir_ref b, ir_ref share)
{
    return ir_op3(g, IR_MIX, a, b, share);
}

static ir_ref variance(struct ir_graph *g, ir_ref alpha)
{
    ir_ref power = num(g, POWER), least = num(g, 0.0f), most = num(g, MOST);
    ir_ref wide = ir_op2(g, IR_POW, ir_op2(g, IR_MAX, alpha, least), power);
    wide = ir_op2(g, IR_MIN, wide, most);
    return ir_op2(g, IR_DIV, wide, closure_one_minus(g, wide));
}

/* Of the variance: sqrt(alpha). */
static ir_ref roughness_of(struct ir_graph *g, ir_ref sum)
{
    ir_ref wide = ir_op2(g, IR_DIV, sum, ir_op2(g, IR_ADD, sum, num(g, 1.0f)));
    ir_ref power = num(g, 0.5f / POWER);
    return ir_op2(g, IR_POW, wide, power);
}

static ir_ref greatest(struct ir_graph *g, ir_ref color)
{
    ir_ref x = ir_component(g, color, 0), y = ir_component(g, color, 1),
           z = ir_component(g, color, 2);
    return ir_op2(g, IR_MAX, x, ir_op2(g, IR_MAX, y, z));
}

/*
 * 0 to 1: whether light goes through an interface at all. An interface fades out where f0 falls
 * below 0.02, and nothing goes through opaque matter.
 */
static ir_ref presence(struct ir_graph *g, const ir_ref *in)
{
    ir_ref zero = num(g, 0.0f), one = num(g, 1.0f);
    ir_ref f0 = greatest(g, in[SLAB_f0]), bend = mul(g, f0, num(g, 50.0f));
    bend = ir_op3(g, IR_CLAMP, bend, zero, one);
    ir_ref is_open = ir_op2(g, IR_GT, greatest(g, in[SLAB_mean_free_path]), zero);
    return ir_op3(g, IR_SELECT, is_open, bend, zero);
}

bool slab_spreads(const struct ir_graph *g, const ir_ref *in)
{
    bool is_smooth = ir_const_is(g, in[SLAB_roughness], 0.0f)
                     && (ir_const_is(g, in[SLAB_second_roughness_weight], 0.0f)
                         || ir_const_is(g, in[SLAB_second_roughness], 0.0f));
    return !is_smooth && !ir_const_is(g, in[SLAB_f0], 0.0f)
           && !ir_const_is(g, in[SLAB_mean_free_path], 0.0f);
}

/* Of both lobes. */
static ir_ref mean_alpha(struct ir_graph *g, const ir_ref *in)
{
    ir_ref mean =
        mixed(g, in[SLAB_roughness], in[SLAB_second_roughness], in[SLAB_second_roughness_weight]);
    return mul(g, mean, mean);
}

ir_ref slab_slope(struct ir_graph *g, const ir_ref *in)
{
    ir_ref alpha = mean_alpha(g, in), seen = presence(g, in), unit = num(g, SLOPE);
    ir_ref slope = mul(g, mul(g, alpha, alpha), unit);
    return mul(g, mul(g, slope, seen), in[SLAB_coverage]);
}

ir_ref slab_spread(struct ir_graph *g, const ir_ref *in)
{
    ir_ref alpha = mean_alpha(g, in), seen = presence(g, in);
    ir_ref inwards = variance(g, mul(g, alpha, num(g, 1.0f / 6.0f)));
    ir_ref outwards = variance(g, mul(g, alpha, num(g, 0.25f)));
    ir_ref both = ir_op2(g, IR_ADD, inwards, outwards);
    return mul(g, mul(g, both, seen), in[SLAB_coverage]);
}

static ir_ref widened(struct ir_graph *g, ir_ref roughness, ir_ref spread)
{
    ir_ref own = variance(g, mul(g, roughness, roughness));
    return roughness_of(g, ir_op2(g, IR_ADD, own, spread));
}

void slab_widen(struct ir_graph *g, ir_ref spread, ir_ref *in)
{
    if (!spread || ir_const_is(g, spread, 0.0f))
        return;
    in[SLAB_roughness] = widened(g, in[SLAB_roughness], spread);
    if (!ir_const_is(g, in[SLAB_second_roughness_weight], 0.0f))
        in[SLAB_second_roughness] = widened(g, in[SLAB_second_roughness], spread);
}
