// SPDX-License-Identifier: Apache-2.0
/*
 * A volume in a pixel stage: a homogeneous medium between the shaded point and the other side, as
 * thick as a ball of diameter u_volumeDepth, with single scattering (MaterialX PBR specification,
 * "Volume Shaders" and <anisotropic_vdf>; Pharr, Jakob, Humphreys, "Physically Based Rendering",
 * chapter 11). Back faces add nothing.
 *
 *     depth = u_volumeDepth · max(N · V, 0)
 *     τ = (σa + σs) · depth               optical depth
 *     alpha = the mean of 1 - exp(-τ)     the attenuation of the background
 *     path = depth · (1 - exp(-τ)) / τ    the effective length: ∫ exp(-σt · x) dx over the depth
 *     color = path · (emission + Σ σs · light · phase + σs · environment)
 *
 * Incoming light is not attenuated.
 */
#include "closure/closure_priv.h"

#include <assert.h>

/*
 * Below this optical depth (1 - exp(-τ)) / τ is 1 within 0.05 %, and rounding would lose the
 * difference from 1.
 */
static const float thin = 1e-3f;

struct parts { /* each 0 where absent */
    ir_ref vdf, edf;
};

/* Operands precede their node, so one pass finds nested mixes. */
static struct parts parts_of(struct shader *shader, ir_ref root)
{
    struct ir_graph *g = shader->graph;
    if (ir_type_of(g, root) == IR_TYPE_VDF)
        return (struct parts){.vdf = root};
    struct parts *known = ARENA_ARRAY(shader->arena, struct parts, root + 1);
    uint8_t *needed = ir_mark(g, &root, 1, shader->arena);
    for (ir_ref ref = 1; ref <= root; ref++) {
        const struct ir_node node = *ir_get(g, ref);
        if (!needed[ref] || node.type != IR_TYPE_VOLUME)
            continue;
        ir_ref a = ir_arg(g, ref, 0), b = ir_arg(g, ref, 1);
        assert(a < ref && b < ref);
        if (node.op == IR_VOLUME_SHADER)
            known[ref] = (struct parts){a, b};
        else if (node.op == IR_SHADER_MIX)
            known[ref] =
                (struct parts){closure_mixed(g, known[a].vdf, known[b].vdf, ir_arg(g, ref, 2)),
                               closure_mixed(g, known[a].edf, known[b].edf, ir_arg(g, ref, 2))};
    }
    return known[root];
}

static ir_ref splat(struct ir_graph *g, float value)
{
    return ir_const_splat(g, IR_TYPE_VEC3, value);
}

/* σa + σs of all leaves. */
static ir_ref extinction(struct shader *shader, const struct closure_host *host,
                         const struct closure_list *list)
{
    static const enum leaf_function coefficients[] = {LEAF_ABSORPTION, LEAF_SCATTERING};
    struct ir_graph *g = shader->graph;
    ir_ref sum = splat(g, 0.0f);
    for (uint32_t i = 0; i < list->leaves.len; i++) {
        const struct closure_leaf *leaf = &list->leaves.items[i];
        for (size_t k = 0; k < sizeof coefficients / sizeof *coefficients; k++) {
            ir_ref value = closure_call(shader, host, leaf->leaf, coefficients[k], NULL);
            if (value)
                sum = ir_op2(g, IR_ADD, sum,
                             closure_mul(g, value, closure_mul(g, leaf->color, leaf->scalar)));
        }
    }
    assert(ir_type_of(g, sum) == IR_TYPE_VEC3);
    return sum;
}

void closure_volume(struct shader *shader, const struct closure_host *host, ir_ref root,
                    struct closure_volume *out)
{
    struct ir_graph *g = shader->graph;
    struct parts parts = parts_of(shader, root);
    *out = (struct closure_volume){.vdf = parts.vdf, .edf = parts.edf};
    closure_flatten(shader, host, parts.vdf, &out->scattering);
    ir_push_name(g, STR_depth);
    ir_ref diameter =
        shader_read(shader, shader_private_uniform(shader, STR_u_volumeDepth, IR_TYPE_FLOAT, 0));
    /* statements fix the order of the nodes; C leaves the order of arguments open */
    ir_ref view = closure_view(shader, host), normal = closure_normal(shader, host);
    ir_ref facing = ir_op2(g, IR_DOT, normal, view);
    ir_ref depth = ir_op2(g, IR_MUL, diameter, ir_op2(g, IR_MAX, facing, ir_const_float(g, 0.0f)));
    ir_change_name(g, STR_optical_depth);
    ir_ref optical = ir_op2(g, IR_MUL, extinction(shader, host, &out->scattering), depth);
    ir_change_name(g, STR_lost);
    ir_ref lost = ir_op2(g, IR_SUB, splat(g, 1.0f), ir_op1(g, IR_EXP, ir_op1(g, IR_NEG, optical)));
    ir_change_name(g, STR_path);
    ir_ref gathered = ir_op2(g, IR_DIV, lost, ir_op2(g, IR_MAX, optical, splat(g, thin)));
    gathered =
        ir_op3(g, IR_MIX, splat(g, 1.0f), gathered, ir_op2(g, IR_STEP, splat(g, thin), optical));
    out->path = ir_op2(g, IR_MUL, gathered, depth);
    ir_change_name(g, STR_alpha);
    out->alpha = ir_op2(g, IR_DOT, lost, splat(g, 1.0f / 3.0f));
    ir_pop_origin(g);
    assert(ir_type_of(g, out->path) == IR_TYPE_VEC3 && ir_type_of(g, out->alpha) == IR_TYPE_FLOAT);
    for (uint32_t i = 0; i < out->scattering.leaves.len; i++) {
        struct closure_leaf *leaf = &out->scattering.leaves.items[i];
        leaf->color = leaf->color
                          ? ir_op2(g, IR_MUL, ir_convert(g, IR_TYPE_VEC3, leaf->color), out->path)
                          : out->path;
    }
}
