// SPDX-License-Identifier: Apache-2.0
/*
 * The loops over the samples of the environment. Parts that share a call or a texture read of a
 * sample share a loop; other parts have their own, because a loop for all parts would keep the
 * values of all of them in registers.
 *
 *     metal, reflection: equal roughness and frame    one loop, each sample is read once
 *     coat                                            a loop of its own
 *
 * A choice that all samples of a loop make alike stands outside: for example film or none. A GPU
 * computes one side of it, and a processor that masks branches ends a loop that no pixel needs
 * after one round.
 */
#include "closure/closure_priv.h"

#include "shader/formula.h"

#include <assert.h>

/* ---- Which parts share a loop ---- */

static bool is_dear_in_loop(const struct ir_graph *g, ir_ref ref)
{
    const unsigned wanted = IR_NODE_LOOP | IR_NODE_DEAR;
    return (ir_get(g, ref)->flags & wanted) == wanted;
}

static uint32_t leader_of(uint32_t *leaders, uint32_t part)
{
    while (leaders[part] != part)
        part = leaders[part] = leaders[leaders[part]];
    return part;
}

/* The first part leads. */
static void join(uint32_t *leaders, uint32_t a, uint32_t b)
{
    a = leader_of(leaders, a);
    b = leader_of(leaders, b);
    leaders[a < b ? b : a] = a < b ? a : b;
}

/* The condition of a choice between expressions of a sample, the same for all samples; 0: none. */
static ir_ref choice_of(const struct ir_graph *g, ir_ref ref)
{
    if (ir_get(g, ref)->op != IR_SELECT || ir_get(g, ir_arg(g, ref, 0))->flags & IR_NODE_LOOP)
        return 0;
    bool is_dear = is_dear_in_loop(g, ir_arg(g, ref, 1)) || is_dear_in_loop(g, ir_arg(g, ref, 2));
    return is_dear ? ir_arg(g, ref, 0) : 0;
}

/* Operands precede their node, so one downward pass finds what the parts share. */
static void find_shared(struct shader *shader, const struct closure_parts *list, uint32_t *leaders,
                        ir_ref *choices)
{
    const struct ir_graph *g = shader->graph;
    ir_ref last = 0;
    for (uint32_t i = 0; i < list->parts.len; i++) {
        ir_ref value = list->parts.items[i].value;
        last = value > last ? value : last;
        leaders[i] = i;
    }
    uint32_t *owners = ARENA_ARRAY(shader->arena, uint32_t, last + 1); /* part + 1 */
    for (uint32_t i = 0; i < list->parts.len; i++) {
        uint32_t *owner = &owners[list->parts.items[i].value];
        if (*owner)
            join(leaders, *owner - 1, i);
        *owner = i + 1;
    }
    for (ir_ref ref = last; ref > 0; ref--) {
        if (!owners[ref])
            continue;
        uint32_t part = owners[ref] - 1;
        ir_ref choice = choice_of(g, ref);
        if (choice && (!choices[part] || choice < choices[part]))
            choices[part] = choice;
        const ir_ref *args = ir_args(g, ref);
        for (uint32_t i = 0; i < ir_get(g, ref)->num_args; i++) {
            if (!is_dear_in_loop(g, args[i]))
                continue;
            if (owners[args[i]]
                && list->parts.items[owners[args[i]] - 1].count == list->parts.items[part].count)
                join(leaders, owners[args[i]] - 1, part);
            owners[args[i]] = part + 1;
        }
    }
}

void closure_find_sample_loops(struct shader *shader, const struct closure_parts *list,
                               struct closure_sample_loops *out)
{
    uint32_t count = list->parts.len;
    uint32_t *leaders = ARENA_ARRAY(shader->arena, uint32_t, count + 1),
             *loops = ARENA_ARRAY(shader->arena, uint32_t, count + 1);
    ir_ref *choices = ARENA_ARRAY(shader->arena, ir_ref, count + 1);
    find_shared(shader, list, leaders, choices);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t leader = leader_of(leaders, i);
        assert(leader <= i);
        if (leader == i) {
            loops[i] = out->loops.len;
            vec_push(shader->arena, &out->loops, (struct closure_sample_loop){0});
        }
        struct closure_sample_loop *loop = &out->loops.items[loops[leader]];
        vec_push(shader->arena, &loop->list.parts, list->parts.items[i]);
        if (!loop->choice)
            loop->choice = choices[i];
    }
}

/* ---- The number of samples ---- */

static bool is_per_sample(const struct ir_graph *g, ir_ref value)
{
    return value && ir_get(g, value)->flags & IR_NODE_LOOP;
}

ir_ref closure_num_samples(struct closure_copies *c, ir_ref *value)
{
    struct ir_graph *g = c->shader->graph;
    if (!is_per_sample(g, *value))
        return 0;
    closure_forget_copies(c);
    ir_ref is_sooner = closure_last_sample(c, *value);
    closure_forget_copies(c);
    bool ends = is_sooner && ir_const_is(g, closure_chosen(c, *value, is_sooner, false), 0.0f);
    closure_forget_copies(c);
    if (!ends)
        return shader_read(
            c->shader, shader_private_uniform(c->shader, STR_u_envRadianceSamples, IR_TYPE_INT, 0));
    ir_ref count = ir_arg(g, is_sooner, 1);
    *value = closure_chosen(c, *value, is_sooner, true);
    closure_forget_copies(c);
    if (count != ir_const_int(g, 1))
        return count;
    *value = closure_at_first_sample(c, *value);
    closure_forget_copies(c);
    return 0;
}

/* ---- The turn of samples ---- */

ir_ref closure_first_turn(struct ir_graph *g)
{
    ir_ref one = ir_const_float(g, 1.0f), zero = ir_const_float(g, 0.0f);
    return ir_construct(g, IR_TYPE_VEC2, (ir_ref[]){one, zero}, 2);
}

ir_ref closure_next_turn(struct shader *shader, const struct closure_parts *list)
{
    struct ir_graph *g = shader->graph;
    struct closure_copies seen = {.shader = shader};
    bool any = false;
    for (uint32_t i = 0; i < list->parts.len && !any; i++)
        any = closure_reads_turn(&seen, list->parts.items[i].value);
    if (!any)
        return 0;
    ir_ref turn = ir_build(g, IR_SAMPLE, IR_TYPE_VEC2, IR_SAMPLE_TURN, NULL, 0);
    return FORMULA(shader, "mx_next_turn", turn);
}

ir_ref closure_gathered(struct shader *shader, ir_ref value)
{
    struct ir_graph *g = shader->graph;
    assert(ir_type_of(g, value) == IR_TYPE_VEC3);
    struct closure_copies copies = {.shader = shader};
    ir_ref count = closure_num_samples(&copies, &value);
    if (!count)
        return value;
    uint32_t sum = shader_add_local(shader, STR_gathered, IR_TYPE_VEC3);
    ir_ref nothing = ir_const_splat(g, IR_TYPE_VEC3, 0.0f);
    struct closure_parts parts = {0};
    vec_push(shader->arena, &parts.parts, (struct closure_part){.value = value});
    ir_ref turn = closure_next_turn(shader, &parts);
    closure_enter_loop(&copies, shader->effects.num_sample_loops++);
    value = closure_in_loop(&copies, value);
    turn = closure_in_loop(&copies, turn);
    struct effect effects[] = {{.kind = EFFECT_VAR, .index = sum, .value = nothing},
                               {.kind = EFFECT_TURN, .value = closure_first_turn(g)},
                               {.kind = EFFECT_SAMPLES, .value = count},
                               {.kind = EFFECT_ACCUMULATE, .index = sum, .value = value},
                               {.kind = EFFECT_NEXT, .value = turn},
                               {.kind = EFFECT_END}};
    for (unsigned i = 0; i < sizeof effects / sizeof *effects; i++)
        if (turn || (effects[i].kind != EFFECT_TURN && effects[i].kind != EFFECT_NEXT))
            shader_effect(shader, STAGE_PIXEL, effects[i]);
    return ir_build(g, IR_LOCAL, IR_TYPE_VEC3, sum, NULL, 0);
}
