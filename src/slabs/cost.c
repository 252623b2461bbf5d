// SPDX-License-Identifier: Apache-2.0
#include "slabs/cost.h"

#include "slabs/bytes.h"
#include "slabs/features.h"

/* ---- One side ---- */

static bool is_zero(const struct ir_graph *g, ir_ref slab, enum slab_operand input)
{
    return ir_const_is(g, ir_arg(g, slab, input), 0.0f);
}

/* True if the walk makes the same lobes at both spots of a closure. */
static bool are_same(const struct ir_graph *g, const struct slab_spot *a, const struct slab_spot *b)
{
    if (ir_get(g, a->ref)->op != IR_SLAB)
        return true;
    bool is_opaque = is_zero(g, a->ref, SLAB_mean_free_path),
         scatters = !is_zero(g, a->ref, SLAB_diffuse_albedo);
    return a->above == b->above
           && (is_opaque || (a->thickness == b->thickness && (!scatters || a->below == b->below)));
}

/* True where another spot of the list before has the same lobes. */
static bool is_repeated(const struct ir_graph *g, const struct slab_spots *spots,
                        const struct slab_spot *spot)
{
    for (uint32_t i = spot->next; i; i = spots->items.items[i - 1].next)
        if (are_same(g, &spots->items.items[i - 1], spot))
            return true;
    return false;
}

/* The operand that is on top of the others: of mixes and stacks the last one. 0: there is none. */
static ir_ref top_operand(const struct ir_graph *g, ir_ref ref)
{
    const struct ir_node *node = ir_get(g, ref);
    bool is_last = node->op == IR_CLOSURE_MIX || node->op == IR_CLOSURE_ADD
                   || node->op == IR_SHADER_MIX || node->op == IR_SLOTS;
    ir_ref top = 0;
    for (uint32_t i = 0; i < node->num_args && (is_last || !top); i++) {
        ir_ref arg = ir_arg(g, ref, i);
        bool is_matter =
            arg && (ir_type_of(g, arg) == IR_TYPE_BSDF || ir_type_is_shader(ir_type_of(g, arg)));
        if (is_matter && !slabs_is_absent(g, ref, i))
            top = arg;
    }
    return top;
}

/* True for a mix of which one operand is there. */
static bool is_alone(const struct ir_graph *g, ir_ref ref)
{
    return slabs_is_absent(g, ref, 0) || slabs_is_absent(g, ref, 1);
}

struct slab_top slabs_top(const struct ir_graph *g, ir_ref root)
{
    struct slab_top top = {root, true};
    while (top.ref && ir_get(g, top.ref)->op != IR_SLAB && ir_get(g, top.ref)->op != IR_LEAF) {
        uint8_t op = ir_get(g, top.ref)->op;
        top.is_whole &= op == IR_LAYER || op == IR_SLAB_LAYER || op == IR_SURFACE_SHADER
                        || op == IR_SLAB_SURFACE || op == IR_MATERIAL || is_alone(g, top.ref);
        top.ref = top_operand(g, top.ref);
    }
    return top;
}

/* Counts all closures of a root, as if it had no choices. */
static struct slab_cost cost_of_all(struct ir_graph *g, ir_ref root, struct arena *scratch)
{
    struct slab_spots spots;
    slabs_find_spots(g, root, scratch, &spots);
    struct slab_cost cost = {0};
    VEC(struct stored_slab) stored = {0};
    struct slab_top top = slabs_top(g, root);
    bool has_top = false;
    for (uint32_t i = 0; i < spots.items.len; i++) {
        const struct slab_spot *spot = &spots.items.items[i];
        uint8_t op = ir_get(g, spot->ref)->op;
        cost.features |= slab_features(g, spot);
        if ((op != IR_SLAB && op != IR_LEAF) || is_repeated(g, &spots, spot))
            continue;
        cost.closures++;
        cost.others += op == IR_LEAF;
        bool is_top = spot->ref == top.ref && !has_top;
        vec_push(scratch, &stored, slab_stored(g, spot->ref, is_top && top.is_whole));
        if (is_top) {
            struct stored_slab first = stored.items[0];
            stored.items[0] = vec_last(&stored);
            vec_last(&stored) = first;
            has_top = true; /* the same slab may also lie elsewhere */
        }
    }
    if (spots.items.len >= SLAB_MAX_SPOTS)
        cost.closures = SLAB_MAX_SPOTS; /* or more */
    cost.bytes = SLAB_WORD_BYTES * slab_stored_pixel(g, stored.items, stored.len);
    return cost;
}

uint32_t slabs_num_closures(struct ir_graph *g, ir_ref root, struct arena *scratch)
{
    return cost_of_all(g, root, scratch).closures;
}

/* ---- Choices ---- */

bool slab_is_choice(const struct ir_graph *g, ir_ref share)
{
    if (ir_get(g, share)->op != IR_SELECT)
        return false;
    ir_ref a = ir_arg(g, share, 1), b = ir_arg(g, share, 2);
    return (ir_const_is(g, a, 0.0f) || ir_const_is(g, a, 1.0f))
           && (ir_const_is(g, b, 0.0f) || ir_const_is(g, b, 1.0f));
}

/* The condition by which a mix below a root has one side; 0: none has. */
static ir_ref find_condition(const struct ir_graph *g, ir_ref root, struct arena *scratch)
{
    struct slab_nodes nodes;
    slabs_find_nodes(g, root, scratch, &nodes);
    for (uint32_t i = nodes.items.len; --i > 0;) {
        ir_ref ref = nodes.items.items[i];
        if (ir_get(g, ref)->op == IR_CLOSURE_MIX && slab_is_choice(g, ir_arg(g, ref, 2)))
            return ir_arg(g, ir_arg(g, ref, 2), 0);
    }
    return 0;
}

enum { MAX_CHOICES = 4 }; /* behind so many conditions both sides count */

static uint32_t larger(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

static struct slab_cost cost_of(struct ir_graph *g, ir_ref root, unsigned num_choices,
                                struct arena *scratch)
{
    ir_ref condition = num_choices < MAX_CHOICES ? find_condition(g, root, scratch) : 0;
    if (!condition)
        return cost_of_all(g, root, scratch);
    ir_ref with = ir_replace(g, root, condition, ir_const_bool(g, true), scratch),
           without = ir_replace(g, root, condition, ir_const_bool(g, false), scratch);
    struct slab_cost a = cost_of(g, with, num_choices + 1, scratch),
                     b = cost_of(g, without, num_choices + 1, scratch);
    return (struct slab_cost){.closures = larger(a.closures, b.closures),
                              .others = larger(a.others, b.others),
                              .bytes = larger(a.bytes, b.bytes),
                              .features = a.features | b.features};
}

struct slab_cost slabs_cost(struct ir_graph *g, ir_ref root, struct arena *scratch)
{
    return root ? cost_of(g, root, 0, scratch) : (struct slab_cost){0};
}
