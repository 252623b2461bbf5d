// SPDX-License-Identifier: Apache-2.0
#include "slabs/spread.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

static bool is_opaque(const struct ir_graph *g, const ir_ref *in)
{
    return ir_const_is(g, in[SLAB_mean_free_path], 0.0f);
}

static bool scatters(const struct ir_graph *g, const ir_ref *in)
{
    return !is_opaque(g, in) && !ir_const_is(g, in[SLAB_diffuse_albedo], 0.0f);
}

bool slab_spreads(const struct ir_graph *g, const ir_ref *in)
{
    bool is_smooth = ir_const_is(g, in[SLAB_roughness], 0.0f)
                     && (ir_const_is(g, in[SLAB_second_roughness_weight], 0.0f)
                         || ir_const_is(g, in[SLAB_second_roughness], 0.0f));
    bool has_rough_interface = !is_smooth && !ir_const_is(g, in[SLAB_f0], 0.0f);
    return scatters(g, in) || (has_rough_interface && !is_opaque(g, in));
}

/* A formula of alpha, the presence and the coverage of the interface. */
static ir_ref of_interface(struct shader *shader, const char *formula, const ir_ref *in)
{
    ir_ref alpha = FORMULA(shader, "mx_spread_alpha", in[SLAB_roughness], in[SLAB_second_roughness],
                           in[SLAB_second_roughness_weight]);
    ir_ref presence = FORMULA(shader, "mx_spread_presence", in[SLAB_f0], in[SLAB_mean_free_path]);
    return FORMULA(shader, formula, alpha, presence, in[SLAB_coverage]);
}

ir_ref slab_slope(struct shader *shader, const ir_ref *in)
{
    return of_interface(shader, "mx_spread_slope", in);
}

ir_ref slab_spread(struct shader *shader, const ir_ref *in)
{
    return of_interface(shader, "mx_spread", in);
}

void slab_widen(struct shader *shader, ir_ref spread, ir_ref *in)
{
    struct ir_graph *g = shader->graph;
    if (!spread || ir_const_is(g, spread, 0.0f))
        return;
    in[SLAB_roughness] = FORMULA(shader, "mx_spread_widened", in[SLAB_roughness], spread);
    if (!ir_const_is(g, in[SLAB_second_roughness_weight], 0.0f))
        in[SLAB_second_roughness] =
            FORMULA(shader, "mx_spread_widened", in[SLAB_second_roughness], spread);
}

ir_ref slab_scattering(struct shader *shader, const ir_ref *in)
{
    struct ir_graph *g = shader->graph;
    if (!scatters(g, in))
        return 0;
    ir_ref of_matter =
        FORMULA(shader, "mx_medium_scattering", in[SLAB_diffuse_albedo], in[SLAB_mean_free_path],
                in[SLAB_phase_anisotropy], ir_const_float(g, 1.0f));
    return ir_op2(g, IR_MUL, of_matter, in[SLAB_coverage]);
}

void slab_even(struct shader *shader, ir_ref depth, ir_ref *in)
{
    struct ir_graph *g = shader->graph;
    if (!depth || ir_const_is(g, depth, 0.0f) || !is_opaque(g, in)
        || ir_const_is(g, in[SLAB_f0], 0.0f))
        return;
    ir_ref straight = FORMULA(shader, "mx_medium_straight", depth, in[SLAB_f0]);
    in[SLAB_diffuse_albedo] =
        FORMULA(shader, "mx_medium_evened", in[SLAB_f0], in[SLAB_diffuse_albedo], straight);
    in[SLAB_f0] = ir_op2(g, IR_MUL, in[SLAB_f0], straight);
}
