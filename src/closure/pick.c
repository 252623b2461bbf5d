// SPDX-License-Identifier: Apache-2.0
/*
 * One layer of a stack instead of their sum (ASH paper, section 5.3):
 *
 *     pick = a number from 0 to below 1
 *     from the top down:  if (sum <= pick < sum + p) { the layer, without its opacity }
 *     p = weight · opacity of the layer,  sum = Σ p of the layers above
 *
 * In the mean this is the sum of all layers, because a layer counts 1 / p. Only the weights are
 * computed for all layers. What a layer reads through screen derivatives needs its neighbours,
 * which may have picked another layer: so textures take explicit derivatives, which the scheduler
 * moves before the branch.
 *
 * The number is the host's, u_layerSample, or below 0 a hash of the point and the frame.
 */
#include "closure/closure_priv.h"
#include "shader/formula.h"

#include <assert.h>

/* ---- The number ---- */

static ir_ref hash_of(struct shader *shader, ir_ref point)
{
    ir_ref frame =
        shader_read(shader, shader_private_uniform(shader, STR_u_frame, IR_TYPE_FLOAT, 0));
    return FORMULA(shader, "mx_layer_number", point, frame);
}

ir_ref closure_layer_number(struct shader *shader, ir_ref point)
{
    struct ir_graph *g = shader->graph;
    ir_ref given =
        shader_read(shader, shader_private_uniform(shader, STR_u_layerSample, IR_TYPE_FLOAT, 0));
    ir_ref is_absent = ir_op2(g, IR_LT, given, ir_const_float(g, 0.0f));
    ir_ref number = ir_op3(g, IR_SELECT, is_absent, hash_of(shader, point), given);
    ir_suggest_name(g, number, STR_pick, IR_NAME_ROLE);
    return number;
}

/* ---- The choice ---- */

/* The layers that a number may pick: those of weight 0 never are. */
static bool is_choice(const struct ir_graph *g, const struct ir_slot *slot)
{
    return slot->surface && !ir_slot_is_vertical(g, slot) && !ir_const_is(g, slot->weight, 0.0f);
}

static bool is_last(const struct ir_graph *g, ir_ref slots, unsigned i)
{
    while (i-- > 0) {
        struct ir_slot slot = ir_slot(g, slots, i);
        if (is_choice(g, &slot))
            return false;
    }
    return true;
}

/* 0 is all numbers; high 0: whatever is from `low` on. */
static ir_ref is_between(struct ir_graph *g, ir_ref number, ir_ref low, ir_ref high)
{
    ir_ref above = ir_const_is(g, low, 0.0f) ? 0 : ir_op2(g, IR_GE, number, low);
    ir_ref below = high ? ir_op2(g, IR_LT, number, high) : 0;
    return above && below ? ir_op2(g, IR_LAND, above, below) : above ? above : below;
}

/*
 * The base of an opaque stack takes the rest of the numbers, whatever the sum of the weights rounds
 * to.
 */
void closure_choose(struct shader *shader, const struct closure_host *host, ir_ref slots,
                    ir_ref number, struct closure_choices *out)
{
    struct ir_graph *g = shader->graph;
    ir_ref low = ir_const_float(g, 0.0f), one = ir_const_float(g, 1.0f);
    bool is_opaque = ir_const_is(g, ir_arg(g, slots, 0), 1.0f);
    const struct closure_surface *layers = closure_slot_surfaces(shader, host, slots);
    for (unsigned i = ir_num_slots(g, slots); i-- > 0;) {
        struct ir_slot slot = ir_slot(g, slots, i);
        if (!is_choice(g, &slot))
            continue;
        ir_ref share = ir_product(g, slot.weight, layers[i].alpha ? layers[i].alpha : one);
        ir_ref high = ir_op2(g, IR_ADD, low, share);
        bool takes_rest = is_opaque && is_last(g, slots, i);
        struct closure_choice choice = {.layer = closure_picked(g, layers[i]),
                                        .low = low,
                                        .high = high,
                                        .share = share,
                                        .is_it = is_between(g, number, low, takes_rest ? 0 : high)};
        vec_push(shader->arena, &out->items, choice);
        low = high;
    }
    out->covered = is_opaque ? 0 : low;
}

/* ---- The layers ---- */

/* texture(s, uv) with the derivatives of uv */
static ir_ref with_derivatives(struct closure_copies *r, ir_ref ref)
{
    struct ir_graph *g = r->shader->graph;
    ir_ref uv = r->became.items[ir_arg(g, ref, 1)];
    ir_ref args[4] = {ir_arg(g, ref, 0), uv, ir_op1(g, IR_DFDX, uv), ir_op1(g, IR_DFDY, uv)};
    return ir_build(g, IR_TEX_GRAD, ir_type_of(g, ref), 0, args, 4);
}

/* The nodes that the weights read: they are computed before the branch anyway. */
static const uint8_t *mark_shared(struct shader *shader, ir_ref slots)
{
    const struct ir_graph *g = shader->graph;
    uint32_t num = 0;
    ir_ref *shared = ARENA_ARRAY(shader->arena, ir_ref, ir_get(g, slots)->num_args);
    for (unsigned i = 0; i < ir_num_slots(g, slots); i++)
        shared[num++] = ir_slot(g, slots, i).weight;
    shared[num++] = ir_arg(g, slots, 0);
    return ir_mark(g, shared, num, shader->arena);
}

ir_ref closure_own_textures(struct shader *shader, ir_ref slots)
{
    struct ir_graph *g = shader->graph;
    struct closure_copies r = {.shader = shader};
    const uint8_t *is_shared = mark_shared(shader, slots),
                  *needed = ir_mark(g, &slots, 1, shader->arena);
    ir_ref *became = closure_room_for_copies(&r, slots);
    for (ir_ref ref = 1; ref <= slots; ref++) {
        became[ref] = ref;
        if (!needed[ref] || is_shared[ref])
            continue;
        ir_push_origin_of(g, ref);
        bool is_texture = ir_get(g, ref)->op == IR_TEX;
        became[ref] = is_texture ? with_derivatives(&r, ref) : closure_over_copies(&r, ref, 0);
        ir_pop_origin(g);
    }
    return became[slots];
}
