// SPDX-License-Identifier: Apache-2.0
#include "slabs/spread.h"

#include "shader/formula.h"

bool slab_spreads(const struct ir_graph *g, const ir_ref *in)
{
    bool is_smooth = ir_const_is(g, in[SLAB_roughness], 0.0f)
                     && (ir_const_is(g, in[SLAB_second_roughness_weight], 0.0f)
                         || ir_const_is(g, in[SLAB_second_roughness], 0.0f));
    return !is_smooth && !ir_const_is(g, in[SLAB_f0], 0.0f)
           && !ir_const_is(g, in[SLAB_mean_free_path], 0.0f);
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
