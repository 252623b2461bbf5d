// SPDX-License-Identifier: Apache-2.0
/*
 * The largest weight that a leaf may have. A weight is a sum of products of shares and of what they
 * leave, so it is largest where each share is 0 or 1.
 */
#include "closure/closure.h"

#include <math.h>

enum { MAX_SHARES = 12, MAX_VISITS = 1024 };

struct weights {
    const struct ir_graph *graph;
    ir_ref shares[MAX_SHARES];
    unsigned num_shares, num_visits;
    bool is_too_large;
    uint32_t ones; /* bit i: share i is 1 */
};

static float share_value(struct weights *w, ir_ref share)
{
    unsigned i = 0;
    while (i < w->num_shares && w->shares[i] != share)
        i++;
    w->is_too_large |= i == MAX_SHARES;
    if (w->is_too_large)
        return 1.0f;
    if (i == w->num_shares)
        w->shares[w->num_shares++] = share;
    return (float)(w->ones >> i & 1u);
}

/* Returns the largest channel of a constant colour. */
static float const_value(const struct ir_graph *g, ir_ref ref)
{
    struct ir_value value;
    float most = -INFINITY;
    if (!ir_get_const(g, ref, &value))
        return 1.0f;
    for (unsigned i = 0; i < ir_type_info(value.type)->components; i++)
        most = fmaxf(most, value.w[i].f);
    return most;
}

/* ref 0: 1. */
static float value_of(struct weights *w, ir_ref ref)
{
    const struct ir_graph *g = w->graph;
    w->is_too_large |= ++w->num_visits > MAX_VISITS;
    if (!ref || w->is_too_large)
        return 1.0f;
    const ir_ref *args = ir_args(g, ref);
    switch (ir_get(g, ref)->op) {
    case IR_CONST: return const_value(g, ref);
    case IR_CONVERT: return value_of(w, args[0]);
    case IR_ADD: return value_of(w, args[0]) + value_of(w, args[1]);
    case IR_SUB: return value_of(w, args[0]) - value_of(w, args[1]);
    case IR_MUL: return value_of(w, args[0]) * value_of(w, args[1]);
    default: return share_value(w, ref);
    }
}

float closure_most_weight(const struct ir_graph *graph, const struct closure_leaf *leaf)
{
    struct weights w = {.graph = graph};
    float most = 0.0f;
    do {
        w.num_visits = 0;
        /* what media above let through is a share, too */
        float color = leaf->decay ? 1.0f : value_of(&w, leaf->color);
        most = fmaxf(most, value_of(&w, leaf->scalar) * color);
    } while (!w.is_too_large && ++w.ones >> w.num_shares == 0);
    return w.is_too_large ? INFINITY : most;
}
