// SPDX-License-Identifier: Apache-2.0
/*
 * Maps and functions of the host that darken light; the maps have the names that hosts of MaterialX
 * bind.
 *
 * Shadow: variance shadow maps (William Donnelly and Andrew Lauritzen, "Variance Shadow Maps",
 * I3D 2006). The map has the mean m and the mean square s of the depth. The part of the light that
 * reaches depth d is 1 for d <= m; behind, Chebyshev's inequality bounds it:
 *
 *     σ² / (σ² + (d - m)²),    σ² = max(s - m², 10⁻⁵)
 */
#include "closure/closure_priv.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

static ir_ref uniform(struct shader *shader, str_id name, ir_type_id type)
{
    return shader_read(shader, shader_private_uniform(shader, name, type, 0));
}

static ir_ref texel(struct ir_graph *g, ir_ref map, ir_ref uv, unsigned channel)
{
    ir_ref args[2] = {map, uv};
    return ir_component(g, ir_build(g, IR_TEX, IR_TYPE_VEC4, 0, args, 2), channel);
}

ir_ref closure_occlusion(struct shader *shader, bool flips_v)
{
    struct ir_graph *g = shader->graph;
    ir_ref uv = shader_stream(shader, str_intern_z(shader->strings, "texcoord_0"), IR_TYPE_VEC2);
    if (flips_v) {
        ir_ref parts[2] = {ir_component(g, uv, 0), ir_one_minus(g, ir_component(g, uv, 1))};
        uv = ir_construct(g, IR_TYPE_VEC2, parts, 2);
    }
    ir_ref open = texel(g, uniform(shader, STR_u_ambOccMap, IR_TYPE_SAMPLER), uv, 0);
    return ir_mix(g, ir_const_float(g, 1.0f), open,
                  uniform(shader, STR_u_ambOccGain, IR_TYPE_FLOAT));
}

ir_ref closure_shadow(struct shader *shader, const struct closure_host *host)
{
    struct ir_graph *g = shader->graph;
    ir_ref point = closure_position(shader, host),
           to_map = uniform(shader, STR_u_shadowMatrix, IR_TYPE_MAT4);
    ir_ref place = FORMULA(shader, "mx_shadow_place", to_map, point);
    ir_ref map = uniform(shader, STR_u_shadowMap, IR_TYPE_SAMPLER),
           uv = ir_swizzle(g, place, (const uint8_t[]){0, 1}, 2), mean = texel(g, map, uv, 0),
           square = texel(g, map, uv, 1), depth = ir_component(g, place, 2);
    return FORMULA(shader, "mx_shadow_lit", depth, mean, square);
}

ir_ref closure_host_shadow(struct shader *shader, const struct closure_host *host, ir_ref light)
{
    ir_ref index = ir_build(shader->graph, IR_CONTEXT, IR_TYPE_INT, IR_LIGHT_INDEX, NULL, 0),
           point = closure_position(shader, host), normal = closure_normal(shader, host);
    return FORMULA(shader, "mxg_shadow", index, point, normal, light);
}

ir_ref closure_host_occlusion(struct shader *shader, const struct closure_host *host)
{
    ir_ref point = closure_position(shader, host), normal = closure_normal(shader, host);
    return FORMULA(shader, "mxg_ambient_occlusion", point, normal);
}

ir_ref closure_stored_occlusion(struct shader *shader)
{
    return shader_stream(shader, str_intern_z(shader->strings, "geomprop_open"), IR_TYPE_FLOAT);
}
