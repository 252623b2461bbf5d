// SPDX-License-Identifier: Apache-2.0
/*
 * A leaf's value times its weight. Loop-invariant factors come first: their product is one node,
 * which the scheduler moves in front of the loop, and which the light loop shares with the
 * environment.
 *
 *     ((c · lobe) · fresnel) · w    →    (c · w) · lobe · fresnel
 */
#include "closure/closure_priv.h"

#include <assert.h>

enum { VARIES = 1, IS_VECTOR = 2, NUM_KINDS = 4, MAX_FACTORS = 16 };

/* by kind, each kind in the order of its nodes, so that equal products are equal nodes */
struct factors {
    ir_ref items[NUM_KINDS][MAX_FACTORS];
    unsigned counts[NUM_KINDS], count;
};

static void insert(const struct ir_graph *g, struct factors *f, ir_ref ref)
{
    unsigned kind = (ir_get(g, ref)->flags & IR_NODE_LOOP ? VARIES : 0)
                    | (ir_type_of(g, ref) == IR_TYPE_FLOAT ? 0 : IS_VECTOR);
    assert(f->counts[kind] < MAX_FACTORS);
    unsigned at = f->counts[kind]++;
    for (; at > 0 && f->items[kind][at - 1] > ref; at--)
        f->items[kind][at] = f->items[kind][at - 1];
    f->items[kind][at] = ref;
    f->count++;
}

/*
 * Outside loops a colour and its scale stay together, because other leaves may use the same
 * product.
 */
static bool is_product(const struct ir_graph *g, ir_ref ref)
{
    const struct ir_node *node = ir_get(g, ref);
    if (node->op != IR_MUL)
        return false;
    for (unsigned i = 0; i < 2; i++) {
        ir_type_id type = ir_type_of(g, ir_arg(g, ref, i));
        if (type != IR_TYPE_VEC3 && type != IR_TYPE_FLOAT)
            return false;
    }
    return true;
}

/* A vector of one scalar is a factor of that scalar. */
static bool is_splat(const struct ir_graph *g, ir_ref ref)
{
    const struct ir_node *node = ir_get(g, ref);
    return node->op == IR_CONSTRUCT && node->num_args == 1
           && ir_type_of(g, ir_arg(g, ref, 0)) == IR_TYPE_FLOAT;
}

static void gather(const struct ir_graph *g, struct factors *f, ir_ref value)
{
    ir_ref open[MAX_FACTORS] = {value};
    for (unsigned len = 1; len;) {
        ir_ref ref = open[--len];
        assert(f->count + len < MAX_FACTORS);
        if (is_splat(g, ref))
            ref = ir_arg(g, ref, 0);
        if (f->count + len + 2 <= MAX_FACTORS && is_product(g, ref)) {
            open[len++] = ir_arg(g, ref, 0);
            open[len++] = ir_arg(g, ref, 1);
        } else {
            insert(g, f, ref);
        }
    }
}

static ir_ref product_of(struct ir_graph *g, const struct factors *f, unsigned kind, ir_ref product)
{
    for (unsigned i = 0; i < f->counts[kind]; i++)
        product = ir_product(g, product, f->items[kind][i]);
    return product;
}

ir_ref closure_product(struct ir_graph *g, ir_ref value, ir_ref weight, ir_ref *out_invariant)
{
    ir_ref unused, *invariant = out_invariant ? out_invariant : &unused;
    *invariant = 0;
    if (!weight)
        return value;
    struct factors f = {.count = 1};
    gather(g, &f, value);
    insert(g, &f, is_splat(g, weight) ? ir_arg(g, weight, 0) : weight);
    assert(f.counts[0] + f.counts[1] + f.counts[2] + f.counts[3] + 1 == f.count);
    ir_ref constant = product_of(g, &f, IS_VECTOR, 0);
    constant = *invariant = ir_product(g, constant, product_of(g, &f, 0, 0));
    bool is_number = constant && ir_type_of(g, constant) == IR_TYPE_FLOAT;
    /* numbers before vectors, the last one first: Fresnel's factor is often one number in three */
    ir_ref product = product_of(g, &f, VARIES, is_number ? constant : 0);
    for (unsigned i = f.counts[VARIES | IS_VECTOR]; i-- > 0;)
        product = ir_product(g, product, f.items[VARIES | IS_VECTOR][i]);
    return is_number ? product : ir_product(g, product, constant);
}
