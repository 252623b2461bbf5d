// SPDX-License-Identifier: Apache-2.0
/*
 * thinfilmbsdf: a film on a base (ShaderX 2018, section 4.2). A film changes Fresnel's factor,
 * which only microfacet leaves have, so the film becomes an input of these leaves: those with the
 * inputs thinfilm_thickness and thinfilm_ior. Other leaves stay as they are.
 *
 *     film(metal)                    metal with a film
 *     film(mix(metal, diffuse))      mix(metal with a film, diffuse)
 *     film(layer(coat, metal))       layer(coat with a film, metal): the film lies on the coat
 *     film(layer(sheen, metal))      layer(sheen, metal with a film)
 *
 * A film on a leaf with its own film replaces it unless the thickness is 0.
 */
#include "build/build_priv.h"

struct film {
    struct builder *b;
    ir_ref thickness, ior;
    uint8_t *needed;   /* per node: the base depends on it */
    uint8_t *has_slot; /* per node: a closure with a leaf that can take the film */
    uint8_t *takes;    /* per node: the film lies on it */
    ir_ref *filmed;    /* per node: the node under the film */
};

/* The operand of a leaf with this input; 0: the leaf has no such input. */
static unsigned operand_of(struct builder *b, ir_ref leaf, const char *input)
{
    uint32_t callee = ir_get(b->graph, leaf)->attr;
    const char *name;
    for (unsigned i = 0; (name = build_leaf_input(b, callee, i)); i++)
        if (strcmp(name, input) == 0)
            return i + 1;
    return 0;
}

static bool takes_film(struct builder *b, ir_ref ref)
{
    return ir_get(b->graph, ref)->op == IR_LEAF && operand_of(b, ref, "thinfilm_thickness")
           && operand_of(b, ref, "thinfilm_ior");
}

/* Operands precede their node: one pass upwards. */
static void find_slots(struct film *f, ir_ref base)
{
    for (ir_ref ref = 1; ref <= base; ref++) {
        if (!f->needed[ref] || !ir_is_closure(f->b->graph, ref))
            continue;
        f->has_slot[ref] = takes_film(f->b, ref);
        for (uint32_t i = 0; i < ir_get(f->b->graph, ref)->num_args; i++)
            f->has_slot[ref] |= f->has_slot[ir_arg(f->b->graph, ref, i)];
    }
}

/* True if a film on the node also lies on this operand: only the top of layers is in its reach. */
static bool reaches(const struct film *f, ir_ref ref, uint32_t operand)
{
    const struct ir_graph *g = f->b->graph;
    bool is_below =
        ir_get(g, ref)->op == IR_LAYER && operand == 1 && f->has_slot[ir_arg(g, ref, 0)];
    return f->has_slot[ir_arg(g, ref, operand)] && !is_below;
}

/* One pass downwards: which closures the film lies on. */
static void spread(struct film *f, ir_ref base)
{
    const struct ir_graph *g = f->b->graph;
    f->takes[base] = f->has_slot[base];
    for (ir_ref ref = base; ref > 0; ref--) {
        for (uint32_t i = 0; f->takes[ref] && i < ir_get(g, ref)->num_args; i++)
            f->takes[ir_arg(g, ref, i)] |= reaches(f, ref, i);
    }
}

/* Puts the film on a leaf: `own` is the leaf's value of an input. */
static ir_ref over(struct film *f, bool is_bare, ir_ref film, ir_ref own)
{
    struct ir_graph *g = f->b->graph;
    ir_ref is_there = ir_op2(g, IR_GT, f->thickness, ir_const_float(g, 0.0f));
    return is_bare ? film : ir_op3(g, IR_SELECT, is_there, film, own);
}

static ir_ref filmed(struct film *f, ir_ref ref)
{
    struct ir_graph *g = f->b->graph;
    const struct ir_node node = *ir_get(g, ref);
    ir_ref *args = ARENA_ARRAY(f->b->arena, ir_ref, node.num_args);
    for (uint32_t i = 0; i < node.num_args; i++) {
        ir_ref arg = ir_arg(g, ref, i);
        args[i] = reaches(f, ref, i) ? f->filmed[arg] : arg;
    }
    if (takes_film(f->b, ref)) {
        ir_ref *thickness = &args[operand_of(f->b, ref, "thinfilm_thickness")],
               *ior = &args[operand_of(f->b, ref, "thinfilm_ior")];
        bool is_bare = ir_const_is(g, *thickness, 0.0f);
        *ior = over(f, is_bare, f->ior, *ior);
        *thickness = over(f, is_bare, f->thickness, *thickness);
    }
    return ir_copy(g, ref, args);
}

static ir_ref left_out(struct builder *b, ir_ref base, elem_id node)
{
    diag_add(b->diags, DIAG_ID_film_left_out, doc_place(&b->lib->doc, node));
    return base;
}

ir_ref build_film(struct builder *b, ir_ref thickness, ir_ref ior, ir_ref base, elem_id node)
{
    if (!base || ir_const_is(b->graph, thickness, 0.0f))
        return base;
    struct film f = {.b = b, .thickness = thickness, .ior = ior};
    f.needed = ir_mark(b->graph, &base, 1, b->arena);
    f.has_slot = ARENA_ARRAY(b->arena, uint8_t, base + 1);
    f.takes = ARENA_ARRAY(b->arena, uint8_t, base + 1);
    f.filmed = ARENA_ARRAY(b->arena, ir_ref, base + 1);
    find_slots(&f, base);
    if (!f.has_slot[base])
        return left_out(b, base, node);
    build_leave_layer(b);
    spread(&f, base);
    for (ir_ref ref = 1; ref <= base; ref++)
        if (f.takes[ref])
            f.filmed[ref] = filmed(&f, ref);
    assert(f.filmed[base]);
    return f.filmed[base];
}
