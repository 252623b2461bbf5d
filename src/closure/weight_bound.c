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

struct range {
    float least, most;
};

/* Returns the channels of a constant colour. */
static struct range const_range(const struct ir_graph *g, ir_ref ref)
{
    struct ir_value value;
    struct range r = {INFINITY, -INFINITY};
    if (!ir_get_const(g, ref, &value))
        return (struct range){1.0f, 1.0f};
    for (unsigned i = 0; i < ir_type_info(value.type)->components; i++)
        r = (struct range){fminf(r.least, value.w[i].f), fmaxf(r.most, value.w[i].f)};
    return r;
}

/* ---- Bounds ---- */

static struct range product_of(struct range a, struct range b)
{
    const float products[] = {a.least * b.least, a.least * b.most, a.most * b.least,
                              a.most * b.most};
    struct range r = {products[0], products[0]};
    for (int i = 1; i < 4; i++)
        r = (struct range){fminf(r.least, products[i]), fmaxf(r.most, products[i])};
    return r;
}

/* Bounds of a value whose shares have nothing to do with each other. ref 0: 1. */
static struct range range_of(struct weights *w, ir_ref ref)
{
    const struct ir_graph *g = w->graph;
    const struct range share = {0.0f, 1.0f}, one = {1.0f, 1.0f};
    w->is_too_large |= ++w->num_visits > MAX_VISITS;
    if (!ref || w->is_too_large)
        return one;
    uint8_t op = ir_get(g, ref)->op;
    if (op == IR_CONST)
        return const_range(g, ref);
    if (op == IR_CONVERT)
        return range_of(w, ir_arg(g, ref, 0));
    if (op != IR_ADD && op != IR_SUB && op != IR_MUL)
        return share;
    struct range a = range_of(w, ir_arg(g, ref, 0)), b = range_of(w, ir_arg(g, ref, 1));
    if (op == IR_MUL)
        return product_of(a, b);
    return op == IR_ADD ? (struct range){a.least + b.least, a.most + b.most}
                        : (struct range){a.least - b.most, a.most - b.least};
}

/* ---- Values ---- */

/* ref 0: 1. */
static float value_of(struct weights *w, ir_ref ref)
{
    const struct ir_graph *g = w->graph;
    w->is_too_large |= ++w->num_visits > MAX_VISITS;
    if (!ref || w->is_too_large)
        return 1.0f;
    const ir_ref *args = ir_args(g, ref);
    switch (ir_get(g, ref)->op) {
    case IR_CONST: return const_range(g, ref).most;
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
    struct range one = {1.0f, 1.0f}, colors = leaf->decay ? one : range_of(&w, leaf->color);
    float bound = product_of(range_of(&w, leaf->scalar), colors).most, most = 0.0f;
    if (!w.is_too_large && bound <= 1.0f)
        return bound; /* a product may have more shares than can be tried */
    w.is_too_large = false;
    do {
        w.num_visits = 0;
        /* what media above let through is a share, too */
        float color = leaf->decay ? 1.0f : value_of(&w, leaf->color);
        most = fmaxf(most, value_of(&w, leaf->scalar) * color);
    } while (!w.is_too_large && ++w.ones >> w.num_shares == 0);
    return w.is_too_large ? INFINITY : most;
}
