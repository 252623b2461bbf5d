// SPDX-License-Identifier: Apache-2.0
/*
 * The closure tree as a list. Every operator is linear in its operands' response, so a leaf's total
 * weight is the sum over its uses of the products on the way to the root:
 *
 *     layer(top, base)     top · w,  base · w · T(top)
 *     mix(bg, fg, m)       bg · w(1-m),  fg · w m
 *     add(a, b)            a · w,  b · w
 *     scale(a, c)          a · w c
 *
 * T, the throughput, is the fraction of light that an operand transmits to its base. Operands have
 * smaller indices than operators, so one pass upwards finds every throughput that a layer needs,
 * and one pass downwards every weight; nothing recurses.
 */
#include "closure/closure_priv.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

#include "base/hash.h"
#include "base/table.h"

#include <assert.h>
#include <stdlib.h>

struct weight {
    ir_ref scalar, color; /* scalar 0: the node is not reached */
    ir_ref medium;        /* transmittance of the volume behind for refracted light; 0 = 1 */
    ir_ref decay;         /* of closure_throughput */
    ir_ref interior;      /* that volume; 0: none */
};

/* A closure of the tree. */
struct closure_node {
    ir_ref ref;
    struct weight weight;
    ir_ref throughput; /* 0: no layer needs it */
    ir_ref decay;      /* how the throughput depends on ways through media */
    bool is_wanted;    /* a layer needs its throughput */
};

struct flattener {
    struct shader *shader;
    struct ir_graph *graph;
    const struct closure_host *host;
    VEC(struct closure_node) nodes; /* by ref, so operands come first */
};

ir_ref closure_mixed(struct ir_graph *g, ir_ref bg, ir_ref fg, ir_ref mix)
{
    assert(!bg || !fg || ir_type_of(g, bg) == ir_type_of(g, fg));
    ir_ref args[3] = {bg, fg, mix};
    return bg == fg ? bg : ir_build(g, IR_CLOSURE_MIX, ir_type_of(g, bg ? bg : fg), 0, args, 3);
}

/* The base of a leaf that modifies another closure; 0 for other leaves. */
static ir_ref modified_base(const struct flattener *f, ir_ref ref)
{
    const struct ir_node *node = ir_get(f->graph, ref);
    if (node->op != IR_LEAF || !closure_has(f->shader, f->host, ref, LEAF_FACTOR))
        return 0;
    return ir_arg(f->graph, ref, node->num_args - 1);
}

/* ---- nodes ---- */

static int compare_nodes(const void *a, const void *b)
{
    ir_ref x = ((const struct closure_node *)a)->ref, y = ((const struct closure_node *)b)->ref;
    return (x > y) - (x < y);
}

/* Returns the record of a closure below the root. */
static struct closure_node *node_of(const struct flattener *f, ir_ref ref)
{
    const struct closure_node key = {.ref = ref};
    return bsearch(&key, f->nodes.items, f->nodes.len, sizeof key, compare_nodes);
}

/* The closures that a closure needs; 0 where there is none. */
static void find_operands(const struct flattener *f, ir_ref ref, ir_ref out[2])
{
    const struct ir_node *node = ir_get(f->graph, ref);
    bool is_pair = ir_is_operator((enum ir_op)node->op) && node->op != IR_CLOSURE_SCALE;
    out[0] =
        ir_is_operator((enum ir_op)node->op) ? ir_arg(f->graph, ref, 0) : modified_base(f, ref);
    out[1] = is_pair ? ir_arg(f->graph, ref, 1) : 0;
}

static bool is_known(const struct flattener *f, const struct table *known, ir_ref ref)
{
    for (uint32_t at = hash_pair(ref, 0), found;
         (found = table_next(known, hash_pair(ref, 0), &at));)
        if (f->nodes.items[found - 1].ref == ref)
            return true;
    return false;
}

/* A stack takes the place of recursion. */
static void find_nodes(struct flattener *f, ir_ref root)
{
    struct arena *arena = f->shader->arena;
    struct table known = {0};
    VEC(ir_ref) open = {0};
    vec_push(arena, &open, root);
    while (open.len) {
        ir_ref ref = vec_last(&open), operands[2];
        open.len--;
        if (!ref || is_known(f, &known, ref))
            continue;
        vec_push(arena, &f->nodes, (struct closure_node){.ref = ref});
        table_add(&known, arena, hash_pair(ref, 0), f->nodes.len);
        find_operands(f, ref, operands);
        vec_push(arena, &open, operands[0]);
        vec_push(arena, &open, operands[1]);
    }
    qsort(f->nodes.items, f->nodes.len, sizeof *f->nodes.items, compare_nodes);
}

/* ---- throughput, upwards ---- */

static ir_ref through_of(const struct flattener *f, ir_ref ref)
{
    ir_ref throughput = ref ? node_of(f, ref)->throughput : 0;
    return throughput ? throughput : ir_const_splat(f->graph, IR_TYPE_VEC3, 1.0f);
}

static ir_ref decay_of(const struct flattener *f, ir_ref ref)
{
    return ref ? node_of(f, ref)->decay : 0;
}

static ir_ref operator_throughput(struct flattener *f, ir_ref ref)
{
    assert(ir_is_operator((enum ir_op)ir_get(f->graph, ref)->op));
    bool has_base = ir_get(f->graph, ref)->op != IR_CLOSURE_SCALE;
    ir_ref b = has_base ? ir_arg(f->graph, ref, 1) : 0;
    ir_ref of_a = through_of(f, ir_arg(f->graph, ref, 0)), of_b = through_of(f, b);
    return closure_operator_throughput(f->shader, ref, of_a, of_b);
}

/* Only a layer keeps a power of two: a sum of two different ones is none. */
static ir_ref operator_decay(const struct flattener *f, ir_ref ref)
{
    const struct ir_node *node = ir_get(f->graph, ref);
    ir_ref a = ir_arg(f->graph, ref, 0),
           b = node->op == IR_CLOSURE_SCALE ? a : ir_arg(f->graph, ref, 1);
    ir_ref of_a = decay_of(f, a), of_b = decay_of(f, b);
    if (node->op == IR_LAYER)
        return closure_both_decays(f->graph, of_a, of_b);
    bool keeps = node->op != IR_CLOSURE_ADD || !of_a;
    return of_a == of_b && keeps ? of_a : CLOSURE_MIXED;
}

/* Marks what is in the top of each layer: its throughputs are needed. */
static void want_throughputs(struct flattener *f)
{
    for (uint32_t i = f->nodes.len; i-- > 0;) {
        const struct closure_node *node = &f->nodes.items[i];
        ir_ref operands[2];
        find_operands(f, node->ref, operands);
        for (int k = 0; k < 2; k++)
            if (operands[k])
                node_of(f, operands[k])->is_wanted |=
                    node->is_wanted || (k == 0 && ir_get(f->graph, node->ref)->op == IR_LAYER);
    }
}

static void find_throughput(struct flattener *f, struct closure_node *node)
{
    ir_ref base = modified_base(f, node->ref);
    if (base) { /* a modifier has the throughput of its base */
        node->throughput = node_of(f, base)->throughput;
        node->decay = node_of(f, base)->decay;
    } else if (ir_get(f->graph, node->ref)->op == IR_LEAF) {
        node->throughput = closure_leaf_throughput(f->shader, f->host, node->ref, &node->decay);
    } else if (ir_is_operator((enum ir_op)ir_get(f->graph, node->ref)->op)) {
        node->throughput = operator_throughput(f, node->ref);
        node->decay = operator_decay(f, node->ref);
    }
    closure_name(f->shader, node->throughput, node->ref, "throughput");
}

static void find_throughputs(struct flattener *f)
{
    for (uint32_t i = 0; i < f->nodes.len; i++) {
        struct closure_node *node = &f->nodes.items[i];
        if (!node->is_wanted)
            continue;
        ir_push_origin_of(f->graph, node->ref);
        find_throughput(f, node);
        ir_pop_origin(f->graph);
    }
}

/*
 * Multiplies throughputs by those for incoming light, which are the throughputs for a viewer in the
 * light's direction. The product ignores light that bounces between layers, so it is a lower bound.
 */
static void add_way_in(struct flattener *f)
{
    struct flattener in = {.shader = f->shader, .graph = f->graph, .host = f->host};
    ir_ref view = f->host->point->view;
    for (uint32_t i = 0; i < f->nodes.len; i++)
        vec_push(f->shader->arena, &in.nodes,
                 (struct closure_node){.ref = f->nodes.items[i].ref,
                                       .is_wanted = f->nodes.items[i].is_wanted});
    f->host->point->view = *f->host->way_in;
    find_throughputs(&in);
    f->host->point->view = view;
    for (uint32_t i = 0; i < f->nodes.len; i++) {
        struct closure_node *node = &f->nodes.items[i];
        if (node->throughput && !node->decay) /* a decay is the way in through media */
            node->throughput =
                ir_op2(f->graph, IR_MUL, node->throughput, in.nodes.items[i].throughput);
    }
}

/* ---- weights, downwards ---- */

/* s·c as one value, so that weights can be added. */
static ir_ref combined(struct ir_graph *g, struct weight w)
{
    return ir_convert(g, IR_TYPE_VEC3, w.color ? ir_product(g, w.color, w.scalar) : w.scalar);
}

static ir_ref sum_of_weights(struct ir_graph *g, struct weight a, struct weight b)
{
    /* C leaves the evaluation order of arguments open; statements fix the order of the nodes */
    ir_ref first = combined(g, a), second = combined(g, b);
    return ir_op2(g, IR_ADD, first, second);
}

static void add_weight(struct flattener *f, ir_ref ref, struct weight add)
{
    struct ir_graph *g = f->graph;
    ir_ref scalar = add.scalar, color = add.color;
    if (!ref || ir_const_is(g, scalar, 0.0f) || (color && ir_const_is(g, color, 0.0f)))
        return;
    assert(ir_get(g, ref)->flags & IR_NODE_CLOSURE);
    struct weight *w = &node_of(f, ref)->weight;
    if (!w->scalar) {
        *w = add;
        return;
    }
    if (w->decay != add.decay)
        w->decay = CLOSURE_MIXED;
    if (w->color == color) {
        w->scalar = ir_op2(g, IR_ADD, w->scalar, scalar);
        return;
    }
    *w = (struct weight){ir_const_float(g, 1.0f), sum_of_weights(g, *w, add), w->medium, w->decay,
                         w->interior};
}

/* A factor multiplies the scalar if it is a float, else the colour. */
static void add_scaled(struct flattener *f, ir_ref ref, struct weight w, ir_ref factor)
{
    struct ir_graph *g = f->graph;
    bool is_scalar = ir_type_of(g, factor) == IR_TYPE_FLOAT;
    assert(is_scalar || ir_type_of(g, factor) == IR_TYPE_VEC3);
    if (is_scalar)
        w.scalar = ir_product(g, w.scalar, factor);
    else if (!ir_const_is(g, factor, 1.0f))
        w.color = ir_product(g, w.color, factor);
    if (ref && !ir_const_is(g, factor, 1.0f))
        closure_name(f->shader, is_scalar ? w.scalar : w.color, ref, "weight");
    add_weight(f, ref, w);
}

ir_ref closure_joined(struct ir_graph *g, ir_ref a, ir_ref b)
{
    ir_ref args[2] = {a, b};
    return a ? ir_build(g, IR_CLOSURE_ADD, IR_TYPE_VDF, 0, args, 2) : b;
}

ir_ref closure_transmittance(struct shader *shader, const struct closure_host *host, ir_ref volume)
{
    struct ir_graph *g = shader->graph;
    struct closure_list list;
    struct closure_host at_rest = *host;
    at_rest.way = 0;
    closure_flatten(shader, &at_rest, volume, &list);
    ir_ref sum = 0;
    for (uint32_t i = 0; i < list.leaves.len; i++) {
        const struct closure_leaf *leaf = &list.leaves.items[i];
        ir_ref absorption = closure_call(shader, host, leaf->leaf, LEAF_ABSORPTION, NULL);
        if (!absorption)
            continue;
        absorption = ir_product(g, absorption, ir_product(g, leaf->color, leaf->scalar));
        sum = ir_sum(g, sum, absorption);
    }
    return sum ? FORMULA(shader, "mx_transmittance", ir_convert(g, IR_TYPE_VEC3, sum)) : 0;
}

static void spread(struct flattener *f, ir_ref ref, struct weight w)
{
    struct ir_graph *g = f->graph;
    uint8_t op = ir_get(g, ref)->op;
    assert(w.scalar && ir_type_of(g, w.scalar) == IR_TYPE_FLOAT);
    ir_ref a = ir_arg(g, ref, 0), b = ir_arg(g, ref, 1);
    assert(a < ref && b < ref);
    if (op == IR_LAYER) {
        /* a volume behind changes only refracted light */
        if (b && ir_type_of(g, b) == IR_TYPE_VDF) {
            w.medium = ir_product(g, w.medium, closure_transmittance(f->shader, f->host, b));
            w.interior = closure_joined(g, w.interior, b);
        } else if (b) {
            struct weight below = w;
            below.decay = closure_both_decays(g, w.decay, decay_of(f, a));
            add_scaled(f, b, below, through_of(f, a));
        }
        add_weight(f, a, w);
    } else if (op == IR_CLOSURE_MIX) {
        ir_ref mix = ir_arg(g, ref, 2);
        add_scaled(f, a, w, ir_one_minus(g, mix));
        add_scaled(f, b, w, mix);
    } else if (op == IR_CLOSURE_ADD) {
        add_weight(f, a, w);
        add_weight(f, b, w);
    } else {
        add_scaled(f, a, w, b);
    }
}

/* The leaf with weight 1: its own weight moves into the total. */
static ir_ref unit_leaf(struct ir_graph *g, ir_ref ref, struct arena *arena)
{
    const struct ir_node node = *ir_get(g, ref);
    assert(node.op == IR_LEAF && node.num_args > 0);
    ir_ref *args = ARENA_ARRAY(arena, ir_ref, node.num_args);
    memcpy(args, ir_args(g, ref), node.num_args * sizeof *args);
    args[0] = ir_const_float(g, 1.0f);
    ir_push_origin(g, node.origin);
    ir_ref unit = ir_build(g, IR_LEAF, node.type, node.attr, args, node.num_args);
    ir_pop_origin(g);
    return unit;
}

static void merge_leaf(struct flattener *f, struct closure_list *out, ir_ref leaf, struct weight w)
{
    struct ir_graph *g = f->graph;
    for (uint32_t i = 0; i < out->leaves.len; i++) {
        struct closure_leaf *have = &out->leaves.items[i];
        if (have->leaf != leaf || have->interior != w.interior)
            continue;
        have->color =
            sum_of_weights(g, (struct weight){.scalar = have->scalar, .color = have->color}, w);
        have->scalar = ir_const_float(g, 1.0f);
        if (have->decay != w.decay)
            have->decay = CLOSURE_MIXED;
        return;
    }
    vec_push(f->shader->arena, &out->leaves,
             (struct closure_leaf){.leaf = leaf,
                                   .scalar = w.scalar,
                                   .color = w.color,
                                   .medium = w.medium,
                                   .interior = w.interior,
                                   .decay = w.decay});
}

static void take_leaf(struct flattener *f, ir_ref ref, struct weight w, struct closure_list *out)
{
    struct ir_graph *g = f->graph;
    ir_ref base = modified_base(f, ref);
    assert(w.scalar && (!base || base < ref));
    if (base) {
        add_scaled(f, base, w, closure_call(f->shader, f->host, ref, LEAF_FACTOR, NULL));
        return;
    }
    ir_ref scalar = ir_product(g, w.scalar, ir_arg(g, ref, 0));
    closure_name(f->shader, scalar, ref, "weight");
    if (ir_const_is(g, scalar, 0.0f))
        return;
    ir_ref leaf = unit_leaf(g, ref, f->shader->arena);
    if (ir_get(g, leaf)->op == IR_LEAF) /* the node is POISON if the graph is full */
        merge_leaf(f, out, leaf, (struct weight){scalar, w.color, w.medium, w.decay, w.interior});
}

/* The throughputs that layers below `root` need, and where `whole` its own. */
static struct flattener find_all_throughputs(struct shader *shader, const struct closure_host *host,
                                             ir_ref root, bool whole)
{
    struct flattener f = {.shader = shader, .graph = shader->graph, .host = host};
    find_nodes(&f, root);
    vec_last(&f.nodes).is_wanted = whole;
    want_throughputs(&f);
    find_throughputs(&f);
    if (host->way_in)
        add_way_in(&f);
    return f;
}

/* The throughput of the whole tree for host->way, as the weight of a leaf below it. */
static struct closure_leaf whole_throughput(struct shader *shader, const struct closure_host *host,
                                            ir_ref root)
{
    struct flattener f = find_all_throughputs(shader, host, root, true);
    return (struct closure_leaf){.leaf = root,
                                 .scalar = ir_const_float(shader->graph, 1.0f),
                                 .color = vec_last(&f.nodes).throughput,
                                 .decay = vec_last(&f.nodes).decay};
}

ir_ref closure_throughput(struct shader *shader, const struct closure_host *host, ir_ref root,
                          ir_ref way)
{
    if (!root)
        return ir_const_splat(shader->graph, IR_TYPE_VEC3, 1.0f);
    struct closure_leaf at[2], below = whole_throughput(shader, host, root);
    if (below.decay == CLOSURE_MIXED) {
        struct closure_host along = *host;
        for (along.way = 1; along.way <= 2; along.way++)
            at[along.way - 1] = whole_throughput(shader, &along, root);
        closure_fit_decay(shader, &below, (const struct closure_leaf *[]){&at[0], &at[1]});
    }
    return ir_convert(shader->graph, IR_TYPE_VEC3, closure_weight(shader, &below, way));
}

/* The list for host->way. */
static void flatten_along(struct shader *shader, const struct closure_host *host, ir_ref root,
                          struct closure_list *out)
{
    struct flattener f = find_all_throughputs(shader, host, root, false);
    memset(out, 0, sizeof *out);
    vec_last(&f.nodes).weight.scalar = ir_const_float(shader->graph, 1.0f);
    for (uint32_t i = f.nodes.len; i-- > 0;) {
        const struct closure_node node = f.nodes.items[i];
        if (!node.weight.scalar)
            continue;
        /* a weight gets the name of the operator that makes it */
        ir_push_origin_of(f.graph, node.ref);
        if (ir_is_operator((enum ir_op)ir_get(f.graph, node.ref)->op))
            spread(&f, node.ref, node.weight);
        else if (ir_get(f.graph, node.ref)->op == IR_LEAF)
            take_leaf(&f, node.ref, node.weight, out);
        ir_pop_origin(f.graph);
    }
    assert(out->leaves.len <= f.nodes.len);
}

static bool any_mixed(const struct closure_list *list)
{
    for (uint32_t i = 0; i < list->leaves.len; i++)
        if (list->leaves.items[i].decay == CLOSURE_MIXED)
            return true;
    return false;
}

/* The list for all ways, the last leaves first. */
static void flatten_all_ways(struct shader *shader, const struct closure_host *host, ir_ref root,
                             struct closure_list *out)
{
    assert(host->way == 0);
    flatten_along(shader, host, root, out);
    if (any_mixed(out)) {
        struct closure_list ways[2];
        struct closure_host along = *host;
        for (along.way = 1; along.way <= 2; along.way++)
            flatten_along(shader, &along, root, &ways[along.way - 1]);
        closure_fit_decays(shader, out, ways);
    }
}

/* True for a lobe around the mirrored direction, below media. */
static bool mirrors(const struct shader *shader, const struct closure_host *host,
                    const struct closure_leaf *leaf)
{
    return leaf->decay && !closure_has(shader, host, leaf->leaf, LEAF_WAY);
}

/* The weights of lobes that mirror, from a list with closure_host.spreads. */
static void spread_mirrors(struct shader *shader, const struct closure_host *host, ir_ref root,
                           struct closure_list *list)
{
    struct closure_list spread_list;
    struct closure_host spreading = *host;
    bool any = false;
    for (uint32_t i = 0; i < list->leaves.len; i++)
        any |= mirrors(shader, host, &list->leaves.items[i]);
    if (!any)
        return;
    spreading.spreads = true;
    flatten_all_ways(shader, &spreading, root, &spread_list);
    for (uint32_t i = 0; i < list->leaves.len; i++)
        for (uint32_t k = 0; k < spread_list.leaves.len; k++) {
            const struct closure_leaf *from = &spread_list.leaves.items[k];
            struct closure_leaf *leaf = &list->leaves.items[i];
            if (from->leaf == leaf->leaf && from->interior == leaf->interior
                && mirrors(shader, host, leaf))
                *leaf = *from;
        }
}

void closure_flatten(struct shader *shader, const struct closure_host *host, ir_ref root,
                     struct closure_list *out)
{
    memset(out, 0, sizeof *out);
    if (!root)
        return;
    flatten_all_ways(shader, host, root, out);
    spread_mirrors(shader, host, root, out);
    /*
     * The pass finds leaves from the root downwards; the list has them in source order: bases
     * first.
     */
    for (uint32_t i = 0, j = out->leaves.len; i + 1 < j; i++) {
        struct closure_leaf swap = out->leaves.items[i];
        out->leaves.items[i] = out->leaves.items[--j];
        out->leaves.items[j] = swap;
    }
}
