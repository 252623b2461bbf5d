// SPDX-License-Identifier: Apache-2.0
/*
 * What a path tracer asks of a surface: light that it emits, opacity, and one direction to go on in.
 *
 *     out1 = vec4(emission, opacity)
 *     pick = random.w · Σ pᵢ                       pᵢ = the mean of wᵢ · (1 + albedoᵢ) / 2
 *     for each leaf:  if (0 <= pick < pᵢ) { L, f cos / pdf = sample(random.xyz);  weight = wᵢ · f cos / pdf · Σ pᵢ / pᵢ }
 *                     pick -= pᵢ
 *     out2 = vec4(L, 1)       out3 = vec4(weight, 1)
 *
 * One leaf is picked, and its sample weighs what that leaf alone gives there, over the chance to pick it: the expectation is the sum of all
 * leaves (Pharr, Jakob, Humphreys, "Physically Based Rendering", section 2.2.3, on a discrete choice). Densities of the other leaves do
 * not enter, so lobes may be as sharp as they like, mirrors included; and weights stay below 2 Σ pᵢ, since a leaf's own sample is near its
 * albedo.
 */
#include "closure/closure_priv.h"

struct scatter {
    struct shader *shader;
    struct ir_graph *graph;
    const struct closure_host *host;
    uint32_t pick, direction, weight; /* locals */
    ir_ref total;
};

static void effect(struct scatter *s, enum effect_kind kind, uint32_t index, ir_ref value)
{
    shader_effect(s->shader, STAGE_PIXEL, (struct effect){.kind = (uint8_t)kind, .index = index, .value = value});
}

static uint32_t local(struct scatter *s, str_id name, ir_type_id type, ir_ref value)
{
    uint32_t index = shader_add_local(s->shader, name, type);
    effect(s, EFFECT_VAR, index, value);
    return index;
}

static ir_ref read(struct scatter *s, uint32_t index, ir_type_id type)
{
    return ir_build(s->graph, IR_LOCAL, type, index, NULL, 0);
}

static ir_ref weight_of(struct scatter *s, const struct closure_leaf *leaf)
{
    ir_ref weight = closure_mul(s->graph, leaf->color, leaf->scalar);
    return ir_convert(s->graph, IR_TYPE_VEC3, weight);
}

/* The chance to pick a leaf, times the sum of all. An albedo tells of reflection only; what refracts must have its chance, too. */
static ir_ref share_of(struct scatter *s, const struct closure_leaf *leaf)
{
    struct ir_graph *g = s->graph;
    ir_ref albedo = closure_call(s->shader, s->host, leaf->leaf, LEAF_ALBEDO, NULL), light = weight_of(s, leaf);
    if (albedo) {
        ir_ref half = ir_const_splat(g, IR_TYPE_VEC3, 0.5f);
        albedo = ir_op2(g, IR_ADD, half, ir_op2(g, IR_MUL, half, ir_convert(g, IR_TYPE_VEC3, albedo)));
        light = ir_op2(g, IR_MUL, light, albedo);
    }
    ir_ref mean = ir_op2(g, IR_DOT, light, ir_const_splat(g, IR_TYPE_VEC3, 1.0f / 3.0f));
    return ir_op2(g, IR_MAX, mean, ir_const_float(g, 0.0f));
}

static void sample(struct scatter *s, const struct closure_leaf *leaf, ir_ref share)
{
    struct ir_graph *g = s->graph;
    ir_ref pick = read(s, s->pick, IR_TYPE_FLOAT), zero = ir_const_float(g, 0.0f);
    ir_ref is_it = ir_op2(g, IR_LAND, ir_op2(g, IR_GE, pick, zero), ir_op2(g, IR_LT, pick, share));
    ir_ref results[3]; /* direction, f cos / pdf, pdf */
    closure_call_all(s->shader, s->host, leaf->leaf, LEAF_SAMPLE, NULL, results);
    ir_ref weight = ir_op2(g, IR_MUL, ir_op2(g, IR_MUL, weight_of(s, leaf), results[1]), ir_op2(g, IR_DIV, s->total, share));
    effect(s, EFFECT_IF, 0, is_it);
    effect(s, EFFECT_ASSIGN, s->direction, results[0]);
    effect(s, EFFECT_ASSIGN, s->weight, weight);
    effect(s, EFFECT_END, 0, 0);
    effect(s, EFFECT_ACCUMULATE, s->pick, ir_op1(g, IR_NEG, share));
}

static bool can_sample(const struct scatter *s, const struct closure_leaf *leaf)
{
    return s->host->leaf_functions(s->host->user_data, ir_get(s->graph, leaf->leaf)->attr)[LEAF_SAMPLE] != LANG_NONE;
}

static void sample_leaves(struct scatter *s, const struct closure_list *list)
{
    struct ir_graph *g = s->graph;
    ir_ref *shares = ARENA_ARRAY(s->shader->arena, ir_ref, list->leaves.len);
    s->total = ir_const_float(g, 0.0f);
    for (uint32_t i = 0; i < list->leaves.len; i++) {
        shares[i] = can_sample(s, &list->leaves.items[i]) ? share_of(s, &list->leaves.items[i]) : 0;
        s->total = shares[i] ? ir_op2(g, IR_ADD, s->total, shares[i]) : s->total;
    }
    ir_ref chance = ir_component(g, shader_stream(s->shader, STR_random, IR_TYPE_VEC4), 3);
    ir_ref nothing = ir_const_splat(g, IR_TYPE_VEC3, 0.0f);
    s->pick = local(s, STR_pick, IR_TYPE_FLOAT, ir_op2(g, IR_MUL, chance, s->total));
    s->direction = local(s, STR_L, IR_TYPE_VEC3, nothing);
    s->weight = local(s, STR_weight, IR_TYPE_VEC3, nothing);
    for (uint32_t i = 0; i < list->leaves.len; i++) {
        if (!shares[i] || ir_const_is(g, shares[i], 0.0f))
            continue;
        sample(s, &list->leaves.items[i], shares[i]);
        shader_add_closure(s->shader, list->leaves.items[i].leaf);
    }
}

static void write_output(struct scatter *s, str_id name, ir_ref rgb, ir_ref a)
{
    uint32_t out = shader_add_variable(s->shader, &(struct shader_variable){.name = name, .block = BLOCK_OUTPUTS,
                                                                            .type = IR_TYPE_VEC4});
    ir_ref parts[2] = {rgb, a};
    effect(s, EFFECT_OUTPUT, out, ir_construct(s->graph, IR_TYPE_VEC4, parts, 2));
}

void closure_scatter(struct shader *shader, const struct closure_host *host, const struct closure_list *list, ir_ref emission,
                     ir_ref alpha)
{
    struct scatter s = {.shader = shader, .graph = shader->graph, .host = host};
    ir_ref one = ir_const_float(s.graph, 1.0f), nothing = ir_const_splat(s.graph, IR_TYPE_VEC3, 0.0f);
    sample_leaves(&s, list);
    write_output(&s, STR_out1, emission ? ir_convert(s.graph, IR_TYPE_VEC3, emission) : nothing, alpha ? alpha : one);
    write_output(&s, STR_out2, read(&s, s.direction, IR_TYPE_VEC3), one);
    write_output(&s, STR_out3, read(&s, s.weight, IR_TYPE_VEC3), one);
    shader->transparent = alpha && !ir_const_is(s.graph, alpha, 1.0f);
}
