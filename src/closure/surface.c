// SPDX-License-Identifier: Apache-2.0
/*
 * The code of the pixel stage for a surface or volume: its light (lit.c), its AOVs and its alpha,
 *
 *     out1 = vec4(color · opacity, opacity)
 */
#include "closure/emitter.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

#include <assert.h>

static ir_ref encoded(struct emitter *e, ir_ref color)
{
    return e->lighting->encodes ? FORMULA(e->shader, "mx_srgb_encoded", color) : color;
}

static void write_surface(struct emitter *e, ir_ref color, ir_ref alpha, ir_ref through)
{
    ir_suggest_name(e->graph, alpha, STR_opacity, IR_NAME_ROLE);
    closure_write_output(e->shader, encoded(e, color), alpha, through);
}

/* The pixel stage discards pixels below the host's threshold. */
static void alpha_test(struct emitter *e, ir_ref alpha)
{
    uint32_t threshold = shader_private_uniform(e->shader, STR_u_alphaThreshold, IR_TYPE_FLOAT, 0);
    emitter_effect(e, EFFECT_DISCARD, 0,
                   ir_op2(e->graph, IR_LT, alpha, shader_read(e->shader, threshold)));
    e->shader->reflection.transparent = true;
    e->shader->reflection.alpha = e->lighting->transparency == TRANSPARENCY_AUTO
                                      ? (uint8_t)closure_alpha(e->shader, alpha)
                                  : e->lighting->transparency == TRANSPARENCY_MASK ? ALPHA_MASK
                                                                                   : ALPHA_BLEND;
}

/* The alpha of the output: the opacity without the transmitted part. 0 = 1. */
static ir_ref output_alpha(struct emitter *e, const struct closure_surface *s)
{
    struct ir_graph *g = e->graph;
    if (!e->through)
        return s->alpha;
    return ir_product(g, s->alpha, FORMULA(e->shader, "mx_hidden", e->through));
}

/* Returns what the surface lets through, with the transmitted part. 0: 1 - alpha of the output. */
static ir_ref output_through(struct emitter *e, const struct closure_surface *s)
{
    struct ir_graph *g = e->graph;
    if (!e->shader->has_two_sources || (!e->through && !s->through))
        return 0;
    ir_ref one = ir_const_splat(g, IR_TYPE_VEC3, 1.0f);
    ir_ref through = closure_surface_through(g, s);
    if (!e->through)
        return through;
    return ir_mix(g, ir_saturate(g, e->through), one, through);
}

/*
 * A value as an output: behind up to three numbers stands the alpha of the surface, so that hosts
 * can blend it as they blend the colour. A float is grey, as a colour is.
 */
static ir_ref with_alpha(struct emitter *e, ir_ref value, ir_ref alpha)
{
    struct ir_graph *g = e->graph;
    ir_type_id type = ir_type_of(g, value);
    ir_ref parts[3] = {value, alpha, 0};
    if (type == IR_TYPE_INT || type == IR_TYPE_VEC4)
        return value;
    if (type == IR_TYPE_FLOAT)
        parts[0] = ir_convert(g, IR_TYPE_VEC3, value);
    if (type == IR_TYPE_VEC2) {
        parts[1] = ir_const_float(g, 0.0f);
        parts[2] = alpha;
    }
    return ir_construct(g, IR_TYPE_VEC4, parts, parts[2] ? 3 : 2);
}

/* scale: what the colour is multiplied by; 0: 1. alpha: of the output. */
static void write_aovs(struct emitter *e, struct closure_aovs aovs, ir_ref scale, ir_ref alpha)
{
    if (scale)
        aovs = closure_aovs_scaled(e->graph, aovs, scale);
    for (uint32_t i = 0; i < e->shader->interface.aovs.len; i++) {
        if (!e->shader->interface.aovs.items[i].is_output)
            continue;
        ir_ref value = closure_aov_value(e->shader, i, aovs.num ? aovs.items[i].value : 0);
        value = with_alpha(e, value, alpha);
        emitter_effect(e, EFFECT_OUTPUT,
                       closure_aov_output(e->shader, i, AOV_VALUE, ir_type_of(e->graph, value)),
                       value);
    }
}

static bool draws_all(const struct emitter *e, ir_ref alpha)
{
    return e->lighting->transparency == TRANSPARENCY_OPAQUE
           || (closure_is_opaque(e->graph, alpha) && e->lighting->transparency != TRANSPARENCY_BLEND
               && !e->shader->has_two_sources);
}

void emitter_finish_surface(struct emitter *e, const struct closure_surface *s)
{
    ir_ref alpha = output_alpha(e, s), one = ir_const_float(e->graph, 1.0f);
    if (draws_all(e, alpha)) {
        write_surface(e, emitter_color(e), one, 0);
        write_aovs(e, s->aovs, 0, one);
        return;
    }
    alpha = alpha ? alpha : one;
    emitter_comment(e, STR_opacity);
    alpha_test(e, alpha);
    ir_ref color = emitter_color(e);
    bool has_alpha = !s->alpha || s->premultiplied || e->host->keeps_color;
    if (!has_alpha)
        color = ir_op2(e->graph, IR_MUL, color, s->alpha);
    alpha = e->host->keeps_color ? one : alpha;
    write_surface(e, color, alpha, output_through(e, s));
    write_aovs(e, s->aovs, has_alpha ? 0 : s->alpha, alpha);
}

bool emitter_is_output(const struct emitter *e, uint32_t aov)
{
    return e->shader->interface.aovs.items[aov].is_output;
}

static bool has_aov_outputs(const struct emitter *e)
{
    for (uint32_t i = 0; i < e->shader->interface.aovs.len; i++)
        if (emitter_is_output(e, i))
            return true;
    return false;
}

/* Replaces closures by their light. */
static void light_aovs(struct emitter *e, struct closure_aovs aovs)
{
    for (uint32_t i = 0; i < aovs.num; i++) {
        if (!ir_is_closure(e->graph, aovs.items[i].value) || !emitter_is_output(e, i))
            continue;
        struct closure_lit surface = e->lit;
        e->lit = (struct closure_lit){.color = UINT32_MAX};
        emitter_light_aov(e, aovs.items[i].value);
        aovs.items[i].value = emitter_color(e);
        e->lit = surface;
    }
}

static bool is_cut(struct emitter *e, ir_ref alpha)
{
    return e->lighting->transparency == TRANSPARENCY_MASK
           || (e->lighting->transparency == TRANSPARENCY_AUTO
               && closure_alpha(e->shader, alpha) == ALPHA_MASK);
}

static struct closure_surface only(struct emitter *e, ir_ref closure)
{
    bool emits = ir_type_of(e->graph, closure) == IR_TYPE_EDF;
    return (struct closure_surface){.bsdf = emits ? 0 : closure, .edf = emits ? closure : 0};
}

void emitter_light_aov(struct emitter *e, ir_ref closure)
{
    struct closure_surface s = only(e, closure);
    ir_ref through = e->through; /* it is not that of the surface */
    emitter_light_surface(e, &s);
    emitter_write_lit(e);
    e->through = through;
}

/* Returns the emission of a closure; 0: black. */
static ir_ref find_scattering_of_aov(struct emitter *e, ir_ref closure, struct closure_list *out)
{
    struct closure_surface s = only(e, closure);
    struct closure_lit surface = e->lit;
    emitter_flatten(e, &s, out);
    ir_ref emission = e->lit.base;
    e->lit = surface;
    return emission;
}

/* Returns what does not come from the BSDF. */
static ir_ref emission_on_top(struct emitter *e, const struct closure_surface *s)
{
    ir_ref unlit = s->unlit ? emitter_vec3(e, s->unlit) : 0, edf = emitter_emission(e, s->edf);
    edf = edf ? emitter_vec3(e, edf) : 0;
    return unlit && edf ? ir_op2(e->graph, IR_ADD, unlit, edf) : unlit ? unlit : edf;
}

void emitter_find_scattering(struct emitter *e, const struct closure_surface *s,
                             struct closure_scatter_layer *out)
{
    const struct closure_pile *pile = out->pile;
    *out = (struct closure_scatter_layer){.pile = pile};
    if (!pile)
        emitter_flatten(e, s, &out->list);
    out->emission = pile ? emission_on_top(e, s) : e->lit.base;
    out->alpha = s->premultiplied ? s->alpha : 0;
    out->aovs = s->aovs;
    out->aov_lists = ARENA_ARRAY(e->shader->arena, struct closure_list, s->aovs.num);
    for (uint32_t i = 0; i < s->aovs.num; i++) {
        ir_ref *value = &out->aovs.items[i].value;
        bool walks = pile && *value && ir_type_of(e->graph, *value) == IR_TYPE_BSDF;
        if (walks) /* its light is that of levels */
            *value = 0;
        else if (ir_is_closure(e->graph, *value))
            *value = find_scattering_of_aov(e, *value, &out->aov_lists[i]);
    }
}

static enum ir_op op_of(const struct emitter *e, ir_ref root)
{
    return root ? (enum ir_op)ir_get(e->graph, root)->op : IR_SURFACE_SHADER;
}

/* The closures that light walks through: that of the surface, and those of its AOVs. */
static bool find_pile(struct emitter *e, ir_ref root, const struct closure_surface *s,
                      struct closure_pile *out)
{
    const struct ir_graph *g = e->graph;
    ir_ref *closures = ARENA_ARRAY(e->shader->arena, ir_ref, e->shader->interface.aovs.len + 1);
    bool is_whole = closure_is_opaque(g, s->alpha), is_joined = op_of(e, root) == IR_MATTER;
    uint32_t num = 0;
    closures[num++] = is_joined ? ir_arg(g, root, 1) : s->bsdf;
    for (uint32_t i = 0; i < e->shader->interface.aovs.len; i++)
        if (emitter_is_output(e, i) && e->shader->interface.aovs.items[i].type == IR_TYPE_BSDF)
            closures[num++] = is_joined ? ir_arg(g, root, i + 2) : 0;
    return !e->host->above && (s->is_matter || is_whole || !s->premultiplied)
           && closure_find_pile(e->shader, e->host, closures, num, s->is_matter && !is_whole, out);
}

/* Light of a pile goes through it by itself, so its opacity is 1. pile NULL: there is none. */
static void emit_layer(struct emitter *e, const struct closure_surface *s,
                       const struct closure_pile *pile)
{
    struct closure_scatter_layer layer = {.pile = pile};
    emitter_find_scattering(e, s, &layer);
    struct closure_scatter *scatter = closure_scatter_begin(e->shader, e->host, e->lighting);
    closure_scatter_layer(scatter, &layer);
    closure_scatter_end(scatter, pile && s->is_matter ? 0 : s->alpha);
}

/* Where MATTER is no pile, its surface is lit as others are. */
static void emit_scattering(struct emitter *e, ir_ref root)
{
    struct closure_pile pile;
    if (op_of(e, root) == IR_SLOTS) {
        emitter_scatter_stack(e, root);
        return;
    }
    const struct closure_surface s = closure_surface_of(e->shader, e->host, root);
    bool walks = find_pile(e, root, &s, &pile);
    if (!walks && op_of(e, root) == IR_MATTER)
        emit_scattering(e, ir_arg(e->graph, root, 0));
    else
        emit_layer(e, &s, walks ? &pile : NULL);
}

static void store_surface(struct emitter *e, const struct closure_surface *s,
                          const struct closure_list *list, bool is_whole)
{
    e->shader->reflection.alpha = draws_all(e, s->alpha) ? ALPHA_OPAQUE
                                  : is_whole             ? ALPHA_MASK
                                                         : ALPHA_BLEND;
    bool has_map = e->lighting->occlusion == DARKENED_BY_MAP;
    const struct closure_stored stored = {
        .bsdf = s->bsdf,
        .list = list,
        .emission = e->lit.base,
        .alpha = s->alpha,
        .premultiplied = s->premultiplied,
        .open = has_map ? closure_occlusion(e->shader, e->lighting->flips_v) : 0,
    };
    e->host->store(e->shader, e->host, &stored);
}

/* A pixel stores whole surfaces without AOVs, if its slabs have room. NULL: this is one. */
static const char *why_not_stored(const struct emitter *e, const struct closure_list *list,
                                  bool is_whole)
{
    return !is_whole            ? "its opacity may be between 0 and 1"
           : has_aov_outputs(e) ? "it has AOVs"
                                : e->host->why_no_room(e->shader, list);
}

/* A payload stores every surface, and none of its AOVs. */
static bool is_stored(struct emitter *e, const struct closure_list *list, bool is_whole)
{
    if (role_packs_pixel(e->shader->role))
        e->shader->reflection.not_stored = why_not_stored(e, list, is_whole);
    return role_stores(e->shader->role) && !e->shader->reflection.not_stored;
}

static void emit_surface(struct emitter *e, ir_ref root)
{
    if (e->shader->role->returns == RETURNS_PATH) {
        emit_scattering(e, root);
        return;
    }
    if (op_of(e, root) == IR_SLOTS && e->shader->picks) {
        emitter_pick_layer(e, root);
        return;
    }
    struct closure_surface s = closure_surface_of(e->shader, e->host, root);
    if (e->shader->role->returns == RETURNS_HOLES) {
        if (!draws_all(e, s.alpha))
            alpha_test(e, s.alpha);
        return;
    }
    struct closure_list list;
    bool is_whole = draws_all(e, s.alpha) || is_cut(e, s.alpha);
    emitter_flatten(e, &s, &list);
    if (is_stored(e, &list, is_whole)) {
        store_surface(e, &s, &list, is_whole);
        return;
    }
    emitter_light_list(e, s.bsdf, &list);
    emitter_write_lit(e);
    light_aovs(e, s.aovs);
    emitter_finish_surface(e, &s);
}

static void emit_volume(struct emitter *e, ir_ref root)
{
    struct closure_volume volume;
    closure_volume(e->shader, e->host, root, &volume);
    struct closure_lighting lighting = *e->lighting;
    lighting.two_sided = false; /* a volume has no layers */
    e->lighting = &lighting;
    ir_ref emitted_light = emitter_emission(e, volume.edf);
    e->lit.base =
        emitted_light ? ir_op2(e->graph, IR_MUL, emitter_vec3(e, emitted_light), volume.path) : 0;
    emitter_find_parts(e, 0, &volume.scattering);
    for (uint32_t i = 0; i < volume.scattering.leaves.len; i++)
        shader_add_closure(e->shader, volume.scattering.leaves.items[i].leaf);
    emitter_write_lit(e);
    e->shader->reflection.transparent = true;
    /* no alpha test: emission may leave the background unchanged */
    e->shader->reflection.alpha = ALPHA_BLEND;
    write_surface(e, emitter_color(e), volume.alpha, 0);
}

static enum closure_variation variation_of(struct emitter *e, const struct closure_medium *medium,
                                           ir_ref emission)
{
    ir_ref *values = ARENA_ARRAY(e->shader->arena, ir_ref, 3 + 3 * medium->list.leaves.len);
    uint32_t num = 0;
    values[num++] = medium->extinction;
    if (emission)
        values[num++] = emission;
    for (uint32_t i = 0; i < medium->list.leaves.len; i++) {
        const struct closure_leaf *leaf = &medium->list.leaves.items[i];
        values[num++] = leaf->leaf;
        values[num++] = leaf->scalar;
        if (leaf->color)
            values[num++] = leaf->color;
    }
    return closure_variation_of(e->shader, values, num);
}

/*
 * A volume for path tracers (docs/library.md): what it does at a point, as of a surface, and its
 * coefficients.
 */
static bool emit_traced_volume(struct emitter *e, ir_ref root)
{
    struct closure_medium medium;
    closure_medium(e->shader, e->host, root, &medium);
    ir_ref emission = emitter_emission(e, medium.edf);
    enum closure_variation varies = variation_of(e, &medium, emission);
    if (varies == VARIES_BY_SURFACE) {
        e->shader->reflection.not_traced = "inside the mesh of a volume there are positions alone, "
                                           "no texture coordinates, normals or properties";
        return false;
    }
    struct closure_scatter_layer layer = {.list = medium.list, .emission = emission};
    struct closure_scatter *scatter = closure_scatter_begin(e->shader, e->host, e->lighting);
    closure_scatter_layer(scatter, &layer);
    closure_scatter_end(scatter, 0);
    closure_scatter_medium(scatter, &medium, varies == VARIES_BY_PLACE);
    e->shader->reflection.transparent = true;
    return true;
}

bool closure_is_surface(const struct shader *shader, ir_ref root)
{
    const struct ir_graph *g = shader->graph;
    if (root && ir_get(g, root)->op == IR_MATERIAL && ir_arg(g, root, 3))
        return false;
    if (root && ir_get(g, root)->op == IR_MATERIAL)
        root = ir_arg(g, root, 0);
    ir_type_id type = root ? ir_type_of(g, root) : IR_TYPE_SURFACE;
    return type == IR_TYPE_SURFACE || type == IR_TYPE_BSDF || type == IR_TYPE_EDF;
}

bool closure_emit(struct shader *shader, const struct closure_host *host,
                  const struct closure_lighting *lighting, ir_ref root)
{
    struct emitter e = {.shader = shader,
                        .copies = {.shader = shader},
                        .graph = shader->graph,
                        .host = host,
                        .lighting = lighting,
                        .lit = {.color = UINT32_MAX}};
    if (root && shader->role->derivatives == DERIVATIVES_OF_RAYS)
        root = closure_differentials(shader, root);
    if (root && ir_get(e.graph, root)->op == IR_MATERIAL)
        root = ir_arg(e.graph, root, 3) ? ir_arg(e.graph, root, 3)
                                        : closure_displace(shader, host, ir_arg(e.graph, root, 0),
                                                           ir_arg(e.graph, root, 2));
    closure_find_aovs(shader, root);
    ir_type_id type = root ? ir_type_of(e.graph, root) : IR_TYPE_SURFACE;
    if (type == IR_TYPE_BSDF || type == IR_TYPE_EDF) {
        ir_ref args[4] = {type == IR_TYPE_BSDF ? root : 0, type == IR_TYPE_EDF ? root : 0,
                          ir_const_float(e.graph, 1.0f), ir_const_bool(e.graph, false)};
        root = ir_build(e.graph, IR_SURFACE_SHADER, IR_TYPE_SURFACE, 0, args, 4);
        type = IR_TYPE_SURFACE;
    }
    if (type == IR_TYPE_VOLUME || type == IR_TYPE_VDF) {
        if (shader->role->returns == RETURNS_PATH)
            return emit_traced_volume(&e, root);
        emit_volume(&e, root);
        return true;
    }
    if (type != IR_TYPE_SURFACE)
        return closure_emit_value(shader, lighting->encodes, root);
    emit_surface(&e, root);
    return true;
}

struct closure_sides closure_sides_of(const struct ir_graph *g, ir_ref root)
{
    if (root && ir_get(g, root)->op == IR_MATERIAL)
        return (struct closure_sides){.front = ir_arg(g, root, ir_arg(g, root, 0) ? 0 : 3),
                                      .back = ir_arg(g, root, 1),
                                      .displacement = ir_arg(g, root, 2)};
    bool is_displacement = root && ir_type_of(g, root) == IR_TYPE_DISPLACEMENT;
    return is_displacement ? (struct closure_sides){.displacement = root}
                           : (struct closure_sides){.front = root};
}
