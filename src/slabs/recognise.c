// SPDX-License-Identifier: Apache-2.0
/*
 * From the leaves up. A leaf becomes a slab with a part of its inputs: an interface over nothing,
 * or a medium without an interface, or fuzz alone. Then a layer of two slabs is one where the parts
 * complete each other:
 *
 *     interface over medium              a slab
 *     fuzz over a slab                   that slab with fuzz
 *     interface over (slab times color)  a coat with that color, over the slab
 */
#include "slabs/recognise.h"
#include "slabs/regime.h"

#include "shader/formula.h"

#include <assert.h>

struct recogniser {
    struct shader *shader;
    struct ir_graph *graph;
    const struct slabs_host *host;
    bool takes_all;
    const uint8_t *needed;
    uint8_t *is_top;  /* per node: other matter lies below it */
    ir_ref *replaced; /* per node; 0: the same */
};

static bool is_bsdf(const struct ir_graph *g, ir_ref ref)
{
    return ref && ir_type_of(g, ref) == IR_TYPE_BSDF;
}

static bool is_slab(const struct ir_graph *g, ir_ref ref)
{
    return ref && ir_get(g, ref)->op == IR_SLAB;
}

static bool input_is(const struct ir_graph *g, ir_ref slab, enum slab_operand input, float value)
{
    return ir_const_is(g, ir_arg(g, slab, input), value);
}

/* ---- Parts of slabs ---- */

static bool has_interface(const struct ir_graph *g, ir_ref slab)
{
    return !input_is(g, slab, SLAB_f0, 0.0f);
}

static bool has_fuzz(const struct ir_graph *g, ir_ref slab)
{
    return !input_is(g, slab, SLAB_fuzz_amount, 0.0f);
}

/* True for matter that is nothing but its interface and fuzz. */
static bool is_clear(const struct ir_graph *g, ir_ref slab)
{
    return input_is(g, slab, SLAB_diffuse_albedo, 0.0f)
           && input_is(g, slab, SLAB_mean_free_path, SLABS_CLEAR_PATH);
}

/* A slab with other inputs. */
static ir_ref made(struct ir_graph *g, ir_ref slab, const ir_ref *in)
{
    uint32_t attr = (ir_get(g, slab)->attr & ~(uint32_t)SLAB_NEVER_CLEAR) | slab_regime(g, in);
    return ir_build(g, IR_SLAB, IR_TYPE_BSDF, attr, in, NUM_SLAB_OPERANDS);
}

/* A slab with some inputs of another one. */
static ir_ref with(struct ir_graph *g, ir_ref slab, ir_ref from, const uint8_t *inputs,
                   unsigned num_inputs)
{
    ir_ref in[NUM_SLAB_OPERANDS];
    memcpy(in, ir_args(g, slab), sizeof in);
    for (unsigned i = 0; i < num_inputs; i++)
        in[inputs[i]] = ir_arg(g, from, inputs[i]);
    return made(g, slab, in);
}

/* The interface and the fuzz of one slab, the medium of the other. */
static ir_ref interface_over(struct ir_graph *g, ir_ref top, ir_ref base)
{
    static const uint8_t medium[] = {SLAB_diffuse_albedo, SLAB_mean_free_path,
                                     SLAB_phase_anisotropy, SLAB_emission};
    return with(g, top, base, medium, sizeof medium);
}

static ir_ref fuzz_over(struct ir_graph *g, ir_ref top, ir_ref base)
{
    static const uint8_t fuzz[] = {SLAB_fuzz_amount, SLAB_fuzz_color, SLAB_fuzz_roughness};
    return with(g, base, top, fuzz, sizeof fuzz);
}

/* One slab for a layer of two; 0: they are two pieces of matter. */
static ir_ref one_piece(struct ir_graph *g, ir_ref top, ir_ref base)
{
    if (!is_slab(g, top) || !is_slab(g, base) || !is_clear(g, top))
        return 0;
    if (has_fuzz(g, top))
        return !has_interface(g, top) && !has_fuzz(g, base) ? fuzz_over(g, top, base) : 0;
    return !has_interface(g, base) && !has_fuzz(g, base) && input_is(g, base, SLAB_coverage, 1.0f)
               ? interface_over(g, top, base)
               : 0;
}

/* ---- Coats ---- */

/*
 * A coat with the colour that its base is multiplied by, with the mean way in and out:
 * docs/slabs.md, "Ways".
 */
static ir_ref colored(const struct recogniser *r, ir_ref coat, ir_ref color)
{
    struct ir_graph *g = r->graph;
    ir_ref in[NUM_SLAB_OPERANDS], thickness = ir_const_float(g, SLABS_LAYER_THICKNESS),
                                  ways = ir_const_float(g, 2.0f * CLOSURE_MEAN_WAY);
    memcpy(in, ir_args(g, coat), sizeof in);
    in[SLAB_mean_free_path] =
        FORMULA(r->shader, "mx_blend_path_of", ir_convert(g, IR_TYPE_VEC3, color), thickness, ways);
    return made(g, coat, in);
}

static ir_ref layer(struct ir_graph *g, ir_ref top, ir_ref base)
{
    ir_ref args[2] = {top, base};
    return ir_build(g, IR_LAYER, IR_TYPE_BSDF, 0, args, 2);
}

static ir_ref recognised_layer(const struct recogniser *r, ir_ref top, ir_ref base)
{
    struct ir_graph *g = r->graph;
    if (r->takes_all && base && !is_bsdf(g, base)) /* a volume is seen through lobes that refract */
        return top;
    if (!top || !is_bsdf(g, base))
        return layer(g, top, base);
    ir_ref piece = one_piece(g, top, base);
    if (piece)
        return piece;
    uint8_t op = base ? ir_get(g, base)->op : 0;
    if (op == IR_CLOSURE_SCALE && is_slab(g, top) && is_clear(g, top)) {
        ir_ref matter = ir_arg(g, base, 0);
        return layer(g, colored(r, top, ir_arg(g, base, 1)), matter);
    }
    piece = base && slabs_is_layer(g, base) ? one_piece(g, top, ir_arg(g, base, 0)) : 0;
    if (!piece)
        return layer(g, top, base);
    ir_ref args[3] = {piece, ir_arg(g, base, 1), op == IR_LAYER ? 0 : ir_arg(g, base, 2)};
    return ir_build(g, (enum ir_op)op, IR_TYPE_BSDF, 0, args, op == IR_LAYER ? 2 : 3);
}

/* ---- The tree ---- */

/* Operators stand behind their operands, so one pass downwards is enough. */
static void find_tops(const struct recogniser *r, ir_ref root)
{
    const struct ir_graph *g = r->graph;
    for (ir_ref ref = root; ref; ref--) {
        const struct ir_node *node = ir_get(g, ref);
        bool is_layer = slabs_is_layer(g, ref);
        if (!r->needed[ref] || node->type != IR_TYPE_BSDF)
            continue;
        for (uint32_t i = 0; i < node->num_args; i++) {
            ir_ref arg = ir_arg(g, ref, i);
            bool has_base = is_layer && i == 0 && is_bsdf(g, ir_arg(g, ref, 1));
            if (is_bsdf(g, arg))
                r->is_top[arg] |= r->is_top[ref] | has_base;
        }
    }
}

static ir_ref replaced(const struct recogniser *r, ir_ref ref)
{
    return ref && r->replaced[ref] ? r->replaced[ref] : ref;
}

static ir_ref recognised_leaf(const struct recogniser *r, ir_ref leaf)
{
    struct ir_graph *g = r->graph;
    ir_ref slab = r->host->slab_of(r->host->user_data, leaf, r->is_top[leaf], r->takes_all);
    if (slab || !r->takes_all)
        return slab ? slab : leaf;
    ir_ref albedo = closure_call(r->shader, r->host->closures, leaf, LEAF_ALBEDO, NULL);
    albedo = albedo ? ir_convert(g, IR_TYPE_VEC3, albedo) : ir_const_splat(g, IR_TYPE_VEC3, 0.0f);
    albedo = ir_op2(g, IR_MUL, albedo, ir_arg(g, leaf, 0));
    return r->host->slab_like(r->host->user_data, leaf, albedo);
}

static ir_ref recognise_node(const struct recogniser *r, ir_ref ref)
{
    struct ir_graph *g = r->graph;
    const struct ir_node node = *ir_get(g, ref);
    if (node.op == IR_LEAF && node.type == IR_TYPE_BSDF)
        return recognised_leaf(r, ref);
    ir_ref *args = ARENA_ARRAY(r->shader->arena, ir_ref, node.num_args);
    bool any = false;
    for (uint32_t i = 0; i < node.num_args; i++) {
        args[i] = replaced(r, ir_arg(g, ref, i));
        any |= args[i] != ir_arg(g, ref, i);
    }
    bool is_layer = node.op == IR_LAYER && node.type == IR_TYPE_BSDF;
    bool has_volume = is_layer && args[1] && !is_bsdf(g, args[1]);
    if (!any && !(has_volume && r->takes_all))
        return ref;
    return is_layer ? recognised_layer(r, args[0], args[1]) : ir_copy(g, ref, args);
}

ir_ref slabs_recognise(struct shader *shader, const struct slabs_host *host, bool takes_all,
                       ir_ref root)
{
    struct ir_graph *g = shader->graph;
    struct recogniser r = {.shader = shader, .graph = g, .host = host, .takes_all = takes_all};
    r.needed = ir_mark(g, &root, 1, shader->arena);
    r.is_top = ARENA_ARRAY(shader->arena, uint8_t, root + 1);
    r.replaced = ARENA_ARRAY(shader->arena, ir_ref, root + 1);
    find_tops(&r, root);
    for (ir_ref ref = 1; ref <= root; ref++) {
        ir_type_id type = ir_type_of(g, ref);
        bool is_part = type == IR_TYPE_BSDF || ir_type_is_shader(type) || ref == root;
        if (!r.needed[ref] || !is_part)
            continue;
        ir_push_origin_of(g, ref);
        r.replaced[ref] = recognise_node(&r, ref);
        ir_pop_origin(g);
    }
    return r.replaced[root];
}
