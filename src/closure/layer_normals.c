// SPDX-License-Identifier: Apache-2.0
/*
 * The normals of a stack's layers. From the base up, with the presence m and the normal n of a
 * layer, and Ng, the normal of the (displaced) surface:
 *
 *     mix     N = normalize(mix(N, n, m))
 *     add     N = normalize(N + m·(n - Ng))
 *     none    every layer gets n - Ng in the end
 *
 * A layer is shaded with the normal after it: every read of the surface's normal gives that one.
 * Presences and weights stand beside the surfaces, so they keep the normal of the surface before
 * displacement: the vertex stage has no other.
 */
#include "closure/closure_priv.h"

#include "shader/formula.h"

#include <assert.h>

struct normals {
    struct shader *shader;
    struct ir_graph *graph;
    ir_ref stream, own; /* the stream of normals, and Ng */
    ir_ref current;     /* after the layers so far */
    ir_ref everywhere;  /* Σ n - Ng of the layers with `none`; 0: there are none */
};

static void find_everywhere(struct normals *n, ir_ref slots)
{
    struct ir_graph *g = n->graph;
    for (unsigned i = 0; i < ir_num_slots(g, slots); i++) {
        struct ir_slot slot = ir_slot(g, slots, i);
        if (!slot.normal || ir_slot_mode(g, &slot) != IR_SLOT_NONE)
            continue;
        ir_ref bend = ir_op2(g, IR_SUB, slot.normal, n->own);
        n->everywhere = n->everywhere ? ir_op2(g, IR_ADD, n->everywhere, bend) : bend;
    }
}

static void add_normal(struct normals *n, const struct ir_slot *slot)
{
    struct ir_graph *g = n->graph;
    if (!slot->normal || ir_slot_mode(g, slot) == IR_SLOT_NONE)
        return;
    if (ir_slot_mode(g, slot) == IR_SLOT_ADD) {
        ir_ref bend = ir_op2(g, IR_SUB, slot->normal, n->own);
        n->current = FORMULA(n->shader, "mx_normal_bent", n->current, bend, slot->presence);
    } else if (ir_const_is(g, slot->presence, 1.0f)) {
        n->current = slot->normal;
    } else {
        n->current =
            FORMULA(n->shader, "mx_normal_under", n->current, slot->normal, slot->presence);
    }
}

/* The surface with another normal. The opacity counts for the weights, so it stays. */
static ir_ref shade(struct normals *n, ir_ref surface, ir_ref normal)
{
    struct ir_graph *g = n->graph;
    ir_ref shaded = ir_replace(g, surface, n->stream, normal, n->shader->arena),
           inner = closure_without_aovs(g, shaded);
    if (ir_get(g, inner)->op != IR_SURFACE_SHADER)
        return shaded;
    ir_ref args[4] = {ir_arg(g, inner, 0), ir_arg(g, inner, 1),
                      ir_arg(g, closure_without_aovs(g, surface), 2), ir_arg(g, inner, 3)};
    ir_ref seen = ir_build(g, IR_SURFACE_SHADER, IR_TYPE_SURFACE, ir_get(g, inner)->attr, args, 4);
    return ir_replace(g, shaded, inner, seen, n->shader->arena);
}

ir_ref closure_shade_slots(struct shader *shader, ir_ref slots, ir_ref moved)
{
    struct ir_graph *g = shader->graph;
    struct normals n = {.shader = shader, .graph = g};
    uint32_t num_args = ir_get(g, slots)->num_args;
    ir_ref *args = ARENA_ARRAY(shader->arena, ir_ref, num_args);
    memcpy(args, ir_args(g, slots), num_args * sizeof *args);
    n.stream = shader_stream(shader, STR_normalWorld, IR_TYPE_VEC3);
    n.own = n.current = moved ? moved : ir_op1(g, IR_NORMALIZE, n.stream);
    find_everywhere(&n, slots);
    for (unsigned i = 0; i < ir_num_slots(g, slots); i++) {
        struct ir_slot slot = ir_slot(g, slots, i);
        ir_ref *operands = args + IR_SLOTS_FIRST + i * IR_SLOT_OPERANDS;
        if (slot.normal && moved)
            slot.normal = ir_replace(g, slot.normal, n.stream, moved, shader->arena);
        add_normal(&n, &slot);
        ir_ref normal = n.current;
        if (n.everywhere)
            normal = FORMULA(shader, "mx_normal_bent", n.current, n.everywhere);
        bool is_plain = !moved && normal == n.own;
        if (slot.surface && !is_plain)
            operands[0] = shade(&n, slot.surface, normal);
        operands[4] = 0;
    }
    return ir_build(g, IR_SLOTS, IR_TYPE_SURFACE, 0, args, num_args);
}
