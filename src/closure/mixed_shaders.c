// SPDX-License-Identifier: Apache-2.0
/*
 * Surface shaders made of surface shaders, as the parts of one: mixes, and the layers of a stack.
 * Operands precede their node, so one pass finds nested ones.
 *
 *     mix(a, b, t)         a·(1-t) + b·t, each times its opacity
 *     slots                Σ weight · layer, each layer times its opacity
 *     a vertical layer     base·(1 - m + m·T) + top·m,  m its presence, T its throughput
 */
#include "closure/closure_priv.h"

#include "shader/formula.h"

#include <assert.h>

struct surfaces {
    struct shader *shader;
    struct ir_graph *graph;
    const struct closure_host *host;
    struct closure_surface *known; /* per node */
};

bool closure_is_opaque(const struct ir_graph *g, ir_ref opacity)
{
    return !opacity || ir_const_is(g, opacity, 1.0f);
}

ir_ref closure_surface_through(struct ir_graph *g, const struct closure_surface *s)
{
    if (s->through)
        return s->through;
    ir_ref rest = s->alpha ? ir_one_minus(g, s->alpha) : ir_const_float(g, 0.0f);
    return ir_convert(g, IR_TYPE_VEC3, rest);
}

static ir_ref scaled_closure(struct ir_graph *g, ir_ref closure, ir_ref factor)
{
    ir_ref args[2] = {closure, factor};
    if (!closure || ir_const_is(g, factor, 1.0f))
        return closure;
    return ir_build(g, IR_CLOSURE_SCALE, ir_type_of(g, closure), 0, args, 2);
}

static ir_ref color_of(struct ir_graph *g, ir_ref value)
{
    return ir_convert(g, IR_TYPE_VEC3, value);
}

static struct closure_surface scaled(struct ir_graph *g, struct closure_surface s, ir_ref factor)
{
    s.bsdf = scaled_closure(g, s.bsdf, factor);
    s.edf = scaled_closure(g, s.edf, factor);
    if (s.unlit && !ir_const_is(g, factor, 1.0f))
        s.unlit = ir_op2(g, IR_MUL, color_of(g, s.unlit), factor);
    s.aovs = closure_aovs_scaled(g, s.aovs, factor);
    return s;
}

static struct closure_surface premultiplied(struct ir_graph *g, struct closure_surface s)
{
    if (s.premultiplied || closure_is_opaque(g, s.alpha))
        return s;
    assert(ir_type_of(g, s.alpha) == IR_TYPE_FLOAT);
    s = scaled(g, s, s.alpha);
    s.premultiplied = true;
    return s;
}

/* 0: 1 */
static ir_ref mixed_alpha(struct ir_graph *g, ir_ref bg, ir_ref fg, ir_ref mix)
{
    ir_ref one = ir_const_float(g, 1.0f);
    return ir_op3(g, IR_MIX, bg ? bg : one, fg ? fg : one, mix);
}

static struct closure_surface mixed(const struct surfaces *s, struct closure_surface bg,
                                    struct closure_surface fg, ir_ref mix)
{
    struct ir_graph *g = s->graph;
    if (!s->host->keeps_color) {
        bg = premultiplied(g, bg);
        fg = premultiplied(g, fg);
    }
    ir_ref black = ir_const_splat(g, IR_TYPE_VEC3, 0.0f);
    struct closure_surface out = {.bsdf = closure_mixed(g, bg.bsdf, fg.bsdf, mix),
                                  .edf = closure_mixed(g, bg.edf, fg.edf, mix),
                                  .premultiplied = true,
                                  .is_matter = bg.is_matter && fg.is_matter};
    ir_ref behind = bg.unlit ? color_of(g, bg.unlit) : black,
           before = fg.unlit ? color_of(g, fg.unlit) : black;
    if (bg.unlit || fg.unlit)
        out.unlit = ir_op3(g, IR_MIX, behind, before, mix);
    out.alpha = mixed_alpha(g, bg.alpha, fg.alpha, mix);
    if (bg.through || fg.through) {
        ir_ref far = closure_surface_through(g, &bg), near = closure_surface_through(g, &fg);
        out.through = ir_op3(g, IR_MIX, far, near, mix);
    }
    out.aovs = closure_aovs_weighing(g, closure_aovs_mixed(g, bg.aovs, fg.aovs, mix), out.alpha);
    return out;
}

/*
 * Its transmission shows the background (MaterialX PBR specification, <surface_unlit>).
 */
static struct closure_surface unlit_surface(struct shader *shader, ir_ref emitted,
                                            ir_ref transmitted, ir_ref opacity)
{
    struct ir_graph *g = shader->graph;
    ir_ref through = FORMULA(shader, "mx_mean", color_of(g, transmitted));
    return (struct closure_surface){.unlit = ir_op2(g, IR_MUL, emitted, opacity),
                                    .alpha = ir_op2(g, IR_MUL, opacity, ir_one_minus(g, through)),
                                    .premultiplied = true};
}

static ir_ref sum_of(struct ir_graph *g, ir_ref a, ir_ref b)
{
    ir_ref args[2] = {a, b};
    if (!a || !b)
        return a ? a : b;
    return ir_build(g, IR_CLOSURE_ADD, ir_type_of(g, a), 0, args, 2);
}

static struct closure_surface sum(struct ir_graph *g, struct closure_surface a,
                                  struct closure_surface b)
{
    a.bsdf = sum_of(g, a.bsdf, b.bsdf);
    a.edf = sum_of(g, a.edf, b.edf);
    if (a.unlit && b.unlit) {
        a.unlit = color_of(g, a.unlit);
        a.unlit = ir_op2(g, IR_ADD, a.unlit, color_of(g, b.unlit));
    } else {
        a.unlit = a.unlit ? a.unlit : b.unlit;
    }
    a.aovs = closure_aovs_sum(g, a.aovs, b.aovs);
    return a;
}

/* The light that passes the top, of what emits below it, so its way in is 0. */
static ir_ref throughput_of(const struct surfaces *s, ir_ref bsdf)
{
    struct closure_host host = *s->host;
    host.context = SOURCE_INDIRECT;
    return closure_throughput(s->shader, &host, bsdf, ir_const_float(s->graph, 0.0f));
}

/*
 * A vertical layer over its base. The base has the opacity of the pair. The parts of the top may
 * have its opacity already: then the mask alone is missing. So it is for the base below matter.
 */
static struct closure_surface coated(const struct surfaces *s, struct closure_surface base,
                                     struct closure_surface top, ir_ref mask)
{
    struct ir_graph *g = s->graph;
    ir_ref presence = top.alpha ? ir_op2(g, IR_MUL, mask, top.alpha) : mask;
    struct closure_surface lit = scaled(g, top, top.premultiplied ? mask : presence), out = base;
    if (base.premultiplied && base.alpha)
        lit = scaled(g, lit, base.alpha);
    lit.alpha = base.alpha;
    ir_ref presence_of_aovs = presence;
    if (top.is_matter)
        presence = mask;
    if (top.bsdf && base.bsdf) {
        ir_ref layer[2] = {scaled_closure(g, top.bsdf, ir_const_float(g, 0.0f)), base.bsdf};
        ir_ref below = ir_build(g, IR_LAYER, IR_TYPE_BSDF, 0, layer, 2);
        out.bsdf = closure_mixed(g, base.bsdf, below, presence);
    }
    if (top.bsdf && (base.edf || base.unlit)) {
        ir_ref one = ir_const_splat(g, IR_TYPE_VEC3, 1.0f);
        ir_ref passed = ir_op3(g, IR_MIX, one, throughput_of(s, top.bsdf), presence);
        out.edf = scaled_closure(g, base.edf, passed);
        out.unlit = base.unlit ? ir_op2(g, IR_MUL, color_of(g, base.unlit), passed) : 0;
    }
    out.aovs = closure_aovs_coated(g, base.aovs, lit.aovs, presence_of_aovs);
    lit.aovs.num = 0;
    return sum(g, out, lit);
}

struct closure_surface closure_weighted(struct ir_graph *g, struct closure_surface layer,
                                        ir_ref weight)
{
    return scaled(g, premultiplied(g, layer), weight);
}

struct closure_surface closure_picked(struct ir_graph *g, struct closure_surface layer)
{
    if (layer.premultiplied && !closure_is_opaque(g, layer.alpha)) {
        /* a layer of opacity 0 is never picked */
        ir_ref one = ir_const_float(g, 1.0f), least = ir_const_float(g, 1e-6f);
        ir_ref opacity = ir_op2(g, IR_MAX, layer.alpha, least);
        layer = scaled(g, layer, ir_op2(g, IR_DIV, one, opacity));
    }
    layer.alpha = 0;
    layer.premultiplied = false;
    return layer;
}

/* The surface of a layer with its vertical ones. *next: the layer after them. */
static struct closure_surface layer_of(const struct surfaces *s, ir_ref slots, unsigned *next)
{
    struct ir_slot slot = ir_slot(s->graph, slots, (*next)++);
    struct closure_surface out =
        slot.surface ? s->known[slot.surface] : (struct closure_surface){0};
    for (; *next < ir_num_slots(s->graph, slots); ++*next) {
        struct ir_slot over = ir_slot(s->graph, slots, *next);
        if (!ir_slot_is_vertical(s->graph, &over))
            break;
        if (slot.surface && over.surface)
            out = coated(s, out, s->known[over.surface], over.weight);
    }
    return out;
}

static void find_layers(const struct surfaces *s, ir_ref slots, struct closure_surface *layers)
{
    for (unsigned i = 0, next = 0; i < ir_num_slots(s->graph, slots); i = next)
        layers[i] = layer_of(s, slots, &next);
}

/* 1 - Σ weight (1 - what the layer lets through) */
static ir_ref through_of_stack(const struct surfaces *s, ir_ref slots,
                               const struct closure_surface *layers)
{
    struct ir_graph *g = s->graph;
    ir_ref through = ir_const_splat(g, IR_TYPE_VEC3, 1.0f);
    for (unsigned i = 0; i < ir_num_slots(g, slots); i++) {
        struct ir_slot slot = ir_slot(g, slots, i);
        if (!slot.surface || ir_slot_is_vertical(g, &slot))
            continue;
        ir_ref held = ir_one_minus(g, closure_surface_through(g, &layers[i]));
        through = ir_op2(g, IR_SUB, through, ir_op2(g, IR_MUL, held, slot.weight));
    }
    return through;
}

static struct closure_surface stack_of(const struct surfaces *s, ir_ref slots)
{
    struct closure_surface out = {0};
    unsigned num = ir_num_slots(s->graph, slots);
    struct closure_surface *layers = ARENA_ARRAY(s->shader->arena, struct closure_surface, num);
    find_layers(s, slots, layers);
    for (unsigned i = 0; i < num; i++) {
        struct ir_slot slot = ir_slot(s->graph, slots, i);
        bool is_layer = slot.surface && !ir_slot_is_vertical(s->graph, &slot);
        if (is_layer && !ir_const_is(s->graph, slot.weight, 0.0f))
            out = sum(s->graph, out, closure_weighted(s->graph, layers[i], slot.weight));
    }
    out.alpha = ir_arg(s->graph, slots, 0);
    out.through = s->shader->has_two_sources ? through_of_stack(s, slots, layers) : 0;
    out.premultiplied = true;
    out.aovs = closure_aovs_weighing(s->graph, out.aovs, out.alpha);
    return out;
}

/* A surface with another value of an AOV. Closures of matter have its opacity, as the surface. */
static struct closure_surface with_aov(const struct surfaces *s, ir_ref ref)
{
    struct closure_surface out = s->known[ir_arg(s->graph, ref, 0)];
    ir_ref value = ir_arg(s->graph, ref, 1);
    bool is_closure = ir_is_closure(s->graph, value);
    bool has_alpha = out.premultiplied && !(out.is_matter && is_closure);
    out.aovs = closure_aovs_with(s->graph, out.aovs, ir_get(s->graph, ref)->attr, value,
                                 has_alpha ? out.alpha : 0);
    return out;
}

/* The alpha of a SURFACE_SHADER: matter has what it lets through in its place. */
static ir_ref alpha_of_leaf(struct shader *shader, ir_ref ref)
{
    ir_ref alpha = ir_arg(shader->graph, ref, 2);
    return ir_get(shader->graph, ref)->attr
               ? ir_one_minus(shader->graph, FORMULA(shader, "mx_mean", alpha))
               : alpha;
}

/* Returns what a surface without other surfaces lets through, if that is a colour; 0: 1 - alpha. */
static ir_ref through_of_leaf(const struct surfaces *s, ir_ref ref,
                              const struct closure_surface *surface)
{
    struct ir_graph *g = s->graph;
    const ir_ref *args = ir_args(g, ref);
    if (!s->shader->has_two_sources)
        return 0;
    if (surface->is_matter)
        return args[2];
    if (ir_get(g, ref)->op != IR_SURFACE_UNLIT)
        return 0;
    ir_ref opacity = args[2];
    return FORMULA(s->shader, "mx_weighted_throughput", color_of(g, args[1]), opacity);
}

/* A surface without other surfaces. */
static struct closure_surface leaf_of(const struct surfaces *s, ir_ref ref)
{
    const ir_ref *args = ir_args(s->graph, ref);
    bool is_matter = ir_get(s->graph, ref)->attr != 0;
    struct closure_surface out = {0};
    if (ir_get(s->graph, ref)->op == IR_SURFACE_UNLIT)
        out = unlit_surface(s->shader, args[0], args[1], args[2]);
    else
        out = (struct closure_surface){.bsdf = args[0],
                                       .edf = args[1],
                                       .alpha = alpha_of_leaf(s->shader, ref),
                                       .premultiplied = is_matter,
                                       .is_matter = is_matter};
    out.through = through_of_leaf(s, ref, &out);
    out.aovs = closure_aovs_weighing(s->graph, closure_aovs_of(s->shader),
                                     out.premultiplied ? out.alpha : 0);
    return out;
}

/*
 * A pile of matter has the opacity of its surface. It emits the light of its EDFs itself, so the
 * surface has none.
 */
static struct closure_surface matter_of(const struct surfaces *s, ir_ref surface)
{
    struct closure_surface out = premultiplied(s->graph, s->known[surface]);
    out.is_matter = true;
    out.edf = 0;
    return out;
}

static struct closure_surface parts_of(const struct surfaces *s, ir_ref ref)
{
    struct ir_graph *g = s->graph;
    const struct closure_surface *known = s->known;
    const struct ir_node *node = ir_get(g, ref);
    ir_ref args[4] = {0};
    memcpy(args, ir_args(g, ref), (node->num_args < 4 ? node->num_args : 4) * sizeof *args);
    switch (node->op) {
    case IR_SURFACE_SHADER:
    case IR_SURFACE_UNLIT: return leaf_of(s, ref);
    case IR_AOV: return with_aov(s, ref);
    case IR_SHADER_MIX: return mixed(s, known[args[0]], known[args[1]], args[2]);
    case IR_SLOTS: return stack_of(s, ref);
    case IR_MATTER: return matter_of(s, args[0]);
    default: return (struct closure_surface){0};
    }
}

/* Finds the parts of all surfaces below the root. */
static struct surfaces know(struct shader *shader, const struct closure_host *host, ir_ref root)
{
    struct surfaces s = {.shader = shader, .graph = shader->graph, .host = host};
    assert(ir_type_of(s.graph, root) == IR_TYPE_SURFACE);
    s.known = ARENA_ARRAY(shader->arena, struct closure_surface, root + 1);
    uint8_t *needed = ir_mark(s.graph, &root, 1, shader->arena);
    for (ir_ref ref = 1; ref <= root; ref++) {
        if (!needed[ref] || ir_type_of(s.graph, ref) != IR_TYPE_SURFACE)
            continue;
        ir_push_origin_of(s.graph, ref);
        s.known[ref] = parts_of(&s, ref);
        ir_pop_origin(s.graph);
    }
    return s;
}

struct closure_surface closure_surface_of(struct shader *shader, const struct closure_host *host,
                                          ir_ref root)
{
    const struct surfaces s = {.shader = shader, .graph = shader->graph, .host = host};
    if (!root)
        return (struct closure_surface){0};
    if (ir_get(s.graph, root)->op == IR_SURFACE_SHADER)
        return parts_of(&s, root);
    return know(shader, host, root).known[root];
}

struct closure_surface *closure_slot_surfaces(struct shader *shader,
                                              const struct closure_host *host, ir_ref slots)
{
    struct surfaces s = know(shader, host, slots);
    struct closure_surface *layers =
        ARENA_ARRAY(shader->arena, struct closure_surface, ir_num_slots(s.graph, slots));
    find_layers(&s, slots, layers);
    return layers;
}

ir_ref closure_without_aovs(const struct ir_graph *g, ir_ref surface)
{
    while (surface && ir_get(g, surface)->op == IR_AOV)
        surface = ir_arg(g, surface, 0);
    return surface;
}

/*
 * The alpha of a surface; `alphas`: of its operands. 0: 1, as of slabs, which are always there, and
 * of what stands for a surface after an error.
 */
static ir_ref alpha_of(struct shader *shader, ir_ref ref, const ir_ref *alphas)
{
    struct ir_graph *g = shader->graph;
    const struct ir_node node = *ir_get(g, ref);
    ir_ref args[3] = {0};
    memcpy(args, ir_args(g, ref), (node.num_args < 3 ? node.num_args : 3) * sizeof *args);
    switch (node.op) {
    case IR_SURFACE_SHADER: return alpha_of_leaf(shader, ref);
    case IR_SURFACE_UNLIT: return unlit_surface(shader, args[0], args[1], args[2]).alpha;
    case IR_AOV: return alphas[args[0]];
    case IR_SHADER_MIX: return mixed_alpha(g, alphas[args[0]], alphas[args[1]], args[2]);
    default: assert(node.op != IR_SLOTS && node.op != IR_MATTER); return 0;
    }
}

/* Only alphas: the same as closure_surface_of without closures. */
ir_ref closure_surface_alpha(struct shader *shader, ir_ref root)
{
    struct ir_graph *g = shader->graph;
    ir_ref *alphas = NULL;
    root = closure_without_aovs(g, root);
    if (ir_get(g, root)->op
        == IR_SHADER_MIX) { /* stacks have thousands of surfaces that are none */
        const uint8_t *needed = ir_mark(g, &root, 1, shader->arena);
        alphas = ARENA_ARRAY(shader->arena, ir_ref, root);
        for (ir_ref ref = 1; ref < root; ref++)
            if (needed[ref] && ir_type_of(g, ref) == IR_TYPE_SURFACE)
                alphas[ref] = alpha_of(shader, ref, alphas);
    }
    ir_ref alpha = alpha_of(shader, root, alphas);
    return alpha ? alpha : ir_const_float(g, 1.0f);
}
