// SPDX-License-Identifier: Apache-2.0
/*
 * A volume in a pixel stage: a homogeneous medium between the shaded point and the other side, as
 * thick as a ball of diameter u_volumeDepth, or as the host says, with single scattering (MaterialX
 * PBR specification, "Volume Shaders" and <anisotropic_vdf>; Pharr, Jakob, Humphreys, "Physically
 * Based Rendering", chapter 11). Back faces add nothing.
 *
 *     depth = u_volumeDepth · max(N · V, 0), or mxg_thickness(P, -V) where N · V > 0
 *     τ = (σa + σs) · depth               optical depth
 *     alpha = the mean of 1 - exp(-τ)     the attenuation of the background
 *     path = depth · (1 - exp(-τ)) / τ    the effective length: ∫ exp(-σt · x) dx over the depth
 *     color = path · (emission + Σ σs · light · phase + σs · environment)
 *
 * Incoming light is not attenuated. A path tracer has the coefficients, and walks through the
 * medium itself (docs/library.md, "Path tracers").
 */
#include "closure/closure_priv.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

#include <assert.h>

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

static const enum leaf_function coefficients[] = {LEAF_SCATTERING, LEAF_ABSORPTION};

/* The sum of the first coefficients, 1 or 2, of all leaves. */
static ir_ref sum_of(struct shader *shader, const struct closure_host *host,
                     const struct closure_list *list, size_t num)
{
    struct ir_graph *g = shader->graph;
    ir_ref sum = ir_black(g);
    for (uint32_t i = 0; i < list->leaves.len; i++) {
        const struct closure_leaf *leaf = &list->leaves.items[i];
        for (size_t k = num; k-- > 0;) {
            ir_ref value = closure_call(shader, host, leaf->leaf, coefficients[k], NULL);
            if (value)
                sum =
                    ir_add(g, sum, ir_product(g, value, ir_product(g, leaf->color, leaf->scalar)));
        }
    }
    assert(ir_type_of(g, sum) == IR_TYPE_VEC3);
    return sum;
}

/* Σ gᵢ · mean σsᵢ / Σ mean σsᵢ. */
static ir_ref mean_anisotropy(struct shader *shader, const struct closure_host *host,
                              const struct closure_list *list)
{
    struct ir_graph *g = shader->graph;
    ir_ref sum = ir_const_float(g, 0.0f), all = ir_const_float(g, 1e-20f);
    for (uint32_t i = 0; i < list->leaves.len; i++) {
        const struct closure_leaf *leaf = &list->leaves.items[i];
        ir_ref anisotropy = closure_call(shader, host, leaf->leaf, LEAF_ANISOTROPY, NULL),
               light = closure_call(shader, host, leaf->leaf, LEAF_SCATTERING, NULL);
        if (!anisotropy || !light)
            continue;
        light = ir_product(g, light, ir_product(g, leaf->color, leaf->scalar));
        ir_ref part = FORMULA(shader, "mx_mean", light);
        all = ir_add(g, all, part);
        sum = ir_add(g, sum, ir_op2(g, IR_MUL, part, anisotropy));
    }
    return ir_op2(g, IR_DIV, sum, all);
}

void closure_medium(struct shader *shader, const struct closure_host *host, ir_ref root,
                    struct closure_medium *out)
{
    struct parts parts = parts_of(shader, root);
    *out = (struct closure_medium){.edf = parts.edf};
    closure_flatten(shader, host, parts.vdf, &out->list);
    out->scattering = sum_of(shader, host, &out->list, 1);
    out->extinction = sum_of(shader, host, &out->list, 2);
    out->anisotropy = mean_anisotropy(shader, host, &out->list);
}

enum closure_variation closure_variation_of(struct shader *shader, const ir_ref *values,
                                            uint32_t num_values)
{
    const struct ir_graph *g = shader->graph;
    enum closure_variation varies = VARIES_NOT;
    uint8_t *needed = ir_mark(g, values, num_values, shader->arena);
    for (ir_ref ref = 1; ref < g->nodes.len; ref++) {
        const struct ir_node *node = ir_get(g, ref);
        if (!needed[ref] || node->op != IR_STREAM)
            continue;
        str_id name = shader->interface.variables.items[node->attr].name;
        if (name != STR_positionObject && name != STR_positionWorld)
            return VARIES_BY_SURFACE;
        varies = VARIES_BY_PLACE;
    }
    return varies;
}

ir_ref closure_host_thickness(struct shader *shader, const struct closure_host *host,
                              ir_ref direction)
{
    ir_ref point = closure_position(shader, host);
    return FORMULA(shader, "mxg_thickness", point, direction);
}

/* The way of the view through the medium. */
static ir_ref depth_of(struct shader *shader, const struct closure_host *host)
{
    /* statements fix the order of the nodes; C leaves the order of arguments open */
    if (host->asks_thickness) {
        ir_ref view = closure_view(shader, host), normal = closure_normal(shader, host);
        ir_ref inwards = ir_op1(shader->graph, IR_NEG, view);
        ir_ref way = closure_host_thickness(shader, host, inwards);
        return FORMULA(shader, "mx_volume_way", way, normal, view);
    }
    uint32_t ball = shader_private_uniform(shader, STR_u_volumeDepth, IR_TYPE_FLOAT, 0);
    ir_ref diameter = shader_read(shader, ball);
    ir_ref view = closure_view(shader, host), normal = closure_normal(shader, host);
    return FORMULA(shader, "mx_volume_depth", diameter, normal, view);
}

void closure_volume(struct shader *shader, const struct closure_host *host, ir_ref root,
                    struct closure_volume *out)
{
    struct ir_graph *g = shader->graph;
    struct parts parts = parts_of(shader, root);
    *out = (struct closure_volume){.vdf = parts.vdf, .edf = parts.edf};
    closure_flatten(shader, host, parts.vdf, &out->scattering);
    ir_push_name(g, STR_depth);
    ir_ref depth = depth_of(shader, host);
    ir_change_name(g, STR_optical_depth);
    ir_ref optical = ir_mul(g, sum_of(shader, host, &out->scattering, 2), depth);
    ir_change_name(g, STR_lost);
    ir_ref lost = FORMULA(shader, "mx_volume_lost", optical);
    ir_change_name(g, STR_path);
    out->path = FORMULA(shader, "mx_volume_path", depth, optical, lost);
    ir_change_name(g, STR_alpha);
    out->alpha = FORMULA(shader, "mx_mean", lost);
    ir_pop_origin(g);
    assert(ir_type_of(g, out->path) == IR_TYPE_VEC3 && ir_type_of(g, out->alpha) == IR_TYPE_FLOAT);
    for (uint32_t i = 0; i < out->scattering.leaves.len; i++) {
        struct closure_leaf *leaf = &out->scattering.leaves.items[i];
        leaf->color = leaf->color ? ir_mul(g, ir_convert(g, IR_TYPE_VEC3, leaf->color), out->path)
                                  : out->path;
    }
}
