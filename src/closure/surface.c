// SPDX-License-Identifier: Apache-2.0
/*
 * The code of the pixel stage for a surface:
 *
 *     color = emission
 *     for each light: color += intensity · Σ w · eval
 *     color += Σ w · environment + Σ w · transmission
 *     for leaves that share samples, for each sample of the environment:
 *         color += Σ w · environment + Σ w · transmission
 *     out1 = vec4(color · opacity, opacity)
 *
 * A leaf with a variable weight may have weight 0: its expensive part stands behind `if (weight >
 * 0)`.
 */
#include "closure/closure_priv.h"

#include <assert.h>

struct emitter {
    struct shader *shader;
    struct ir_graph *graph;
    const struct closure_host *host;
    const struct closure_lighting *lighting;
    struct closure_lit lit;
    struct closure_copies copies; /* of the current loop */
    ir_ref through;               /* vec3: the transmitted part, with transmits_alpha; 0: none */
};

static void effect(struct emitter *e, enum effect_kind kind, uint32_t index, ir_ref value)
{
    value = closure_in_loop(&e->copies, value);
    shader_effect(e->shader, STAGE_PIXEL,
                  (struct effect){.kind = (uint8_t)kind, .index = index, .value = value});
}

static ir_ref add(struct emitter *e, ir_ref a, ir_ref b)
{
    if (!a || !b)
        return a ? a : b;
    return ir_op2(e->graph, IR_ADD, a, b);
}

static ir_ref vec3_of(struct emitter *e, ir_ref value)
{
    return ir_convert(e->graph, IR_TYPE_VEC3, value);
}

/* The factor of light on a way through the media above; 0 = 1. */
static ir_ref weight_along(struct emitter *e, const struct closure_leaf *leaf, ir_ref way)
{
    if (leaf->decay)
        return closure_weight(e->shader, leaf, way);
    return ir_const_is(e->graph, leaf->scalar, 1.0f)
               ? leaf->color
               : closure_mul(e->graph, leaf->color, leaf->scalar);
}

/* value · weight; 0 if the product vanishes. way: of the light, if media lie above. */
static ir_ref weighted(struct emitter *e, const struct closure_leaf *leaf, ir_ref value, ir_ref way)
{
    struct ir_graph *g = e->graph;
    if (!value || ir_const_is(g, value, 0.0f))
        return 0;
    ir_push_origin_of(g, leaf->leaf);
    ir_ref weight = weight_along(e, leaf, way);
    closure_name(e->shader, weight, leaf->leaf, "weight");
    value = closure_product(g, value, weight);
    closure_name(e->shader, value, leaf->leaf, "response");
    ir_pop_origin(g);
    return value;
}

static void declare_color(struct emitter *e)
{
    if (e->lit.color != UINT32_MAX)
        return;
    e->lit.color = shader_add_local(e->shader, STR_color, IR_TYPE_VEC3);
    effect(e, EFFECT_VAR, e->lit.color,
           e->lit.base ? vec3_of(e, e->lit.base) : ir_const_splat(e->graph, IR_TYPE_VEC3, 0.0f));
}

static void add_part(struct emitter *e, enum closure_place place, const struct closure_leaf *leaf,
                     ir_ref value)
{
    if (value)
        vec_push(e->shader->arena, &e->lit.at[place].parts,
                 (struct closure_part){leaf->leaf, leaf->scalar, value, false, false});
}

static void accumulate(struct emitter *e, ir_ref factor, ir_ref value)
{
    assert(e->lit.color < e->shader->locals.len);
    ir_push_origin_of(e->graph, value);
    value = factor ? closure_product(e->graph, factor, value) : value;
    effect(e, EFFECT_ACCUMULATE, e->lit.color, vec3_of(e, value));
    ir_pop_origin(e->graph);
}

static void comment(struct emitter *e, str_id text)
{
    shader_effect(e->shader, STAGE_PIXEL, (struct effect){.kind = EFFECT_COMMENT, .text = text});
}

/* Writes a comment such as "metal, reflection": the leaves of the next parts, each once. */
static void comment_leaves(struct emitter *e, const struct closure_part *parts, uint32_t count)
{
    struct text names;
    text_init(&names, e->shader->arena);
    str_id last = 0;
    for (uint32_t i = 0; i < count; i++) {
        str_id name = e->graph->origins.items[ir_get(e->graph, parts[i].leaf)->origin].name;
        if (!name || name == last)
            continue;
        text_str(&names, names.len ? ", " : "");
        text_str(&names, str_text(e->shader->strings, name));
        last = name;
    }
    if (names.len)
        comment(e, str_intern(e->shader->strings, names.data, names.len));
}

/* Parts [begin, end) as one statement; guard 0: unconditionally. */
static void accumulate_parts(struct emitter *e, const struct closure_part *parts, uint32_t count,
                             ir_ref guard, ir_ref factor)
{
    struct ir_graph *g = e->graph;
    ir_ref sum = 0;
    for (uint32_t i = 0; i < count; i++)
        sum = add(e, sum, parts[i].value);
    comment_leaves(e, parts, count);
    if (guard) {
        ir_ref condition = ir_op2(g, IR_GT, guard, ir_const_float(g, 0.0f));
        closure_name(e->shader, condition, parts->leaf, "visible");
        effect(e, EFFECT_IF, 0, condition);
    }
    accumulate(e, factor, sum);
    if (guard)
        effect(e, EFFECT_END, 0, 0);
}

/*
 * color += factor · Σ parts. Leaves without branch and loop share one line, which comes first:
 * their weights need no registers in the loops. Neighbours with the same guard share a branch.
 */
static void accumulate_all(struct emitter *e, struct closure_parts *list, bool in_loop,
                           ir_ref factor)
{
    struct closure_parts plain = {0}, dear = {0};
    closure_find_guarded(e->shader, list, in_loop);
    for (uint32_t i = 0; i < list->parts.len; i++) {
        struct closure_part *part = &list->parts.items[i];
        part->is_guarded &= !ir_is_const(e->graph, part->scalar);
        bool is_plain = !part->is_guarded && !part->has_loop;
        vec_push(e->shader->arena, is_plain ? &plain.parts : &dear.parts, *part);
    }
    if (plain.parts.len)
        accumulate_parts(e, plain.parts.items, plain.parts.len, 0, factor);
    for (uint32_t i = 0, end; i < dear.parts.len; i = end) {
        const struct closure_part *first = &dear.parts.items[i];
        for (end = i + 1; end < dear.parts.len && first->is_guarded; end++)
            if (dear.parts.items[end].scalar != first->scalar)
                break;
        accumulate_parts(e, first, end - i, first->is_guarded ? first->scalar : 0, factor);
    }
}

static bool has_function(const struct emitter *e, const struct closure_leaf *leaf,
                         enum leaf_function which)
{
    return closure_has(e->shader, e->host, leaf->leaf, which);
}

static bool any_has(const struct emitter *e, const struct closure_list *list,
                    enum leaf_function which)
{
    for (uint32_t i = 0; i < list->leaves.len; i++)
        if (has_function(e, &list->leaves.items[i], which))
            return true;
    return false;
}

/* Flattens the closure for a context. `light`: the direction to the light. */
static void flatten_for(struct emitter *e, ir_ref bsdf, enum source_context context,
                        const ir_ref *light, struct closure_list *out)
{
    struct closure_host host = *e->host;
    host.context = context;
    host.light = light;
    if (context == SOURCE_REFLECTION && e->lighting->two_sided)
        host.way_in = light;
    closure_flatten(e->shader, &host, bsdf, out);
}

/*
 * True if the throughputs differ by context: portable leaves have one throughput, leaves in source
 * one per context.
 */
static bool has_contexts(const struct emitter *e, const struct closure_list *list)
{
    for (uint32_t i = 0; i < list->leaves.len; i++)
        if (closure_source(e->shader, list->leaves.items[i].leaf))
            return true;
    return false;
}

/*
 * The leaves of `list` with their weights in another context: the same leaves, because only
 * throughputs differ.
 */
static const struct closure_list *in_context(struct emitter *e, ir_ref bsdf,
                                             enum source_context context, const ir_ref *light,
                                             const struct closure_list *list,
                                             struct closure_list *out)
{
    bool is_two_sided = context == SOURCE_REFLECTION && e->lighting->two_sided;
    if (!bsdf || (!is_two_sided && !has_contexts(e, list)))
        return list;
    flatten_for(e, bsdf, context, light, out);
    assert(out->leaves.len == list->leaves.len);
    return out;
}

static void find_lit_parts(struct emitter *e, ir_ref bsdf, const struct closure_list *list,
                           bool *emitted)
{
    if (!e->lighting->lights || !any_has(e, list, LEAF_EVAL))
        return;
    struct closure_list lit;
    closure_sample_light(e->shader, e->host, &e->lit.light);
    list = in_context(e, bsdf, SOURCE_REFLECTION, &e->lit.light.direction, list, &lit);
    for (uint32_t i = 0; i < list->leaves.len; i++) {
        const struct closure_leaf *leaf = &list->leaves.items[i];
        ir_ref way = leaf->decay ? closure_way(e->shader, e->host, e->lit.light.direction) : 0;
        ir_ref value = weighted(
            e, leaf,
            closure_call(e->shader, e->host, leaf->leaf, LEAF_EVAL, &e->lit.light.direction), way);
        add_part(e, PLACE_LIGHT, leaf, value);
        emitted[i] |= value != 0;
    }
}

static bool add_surrounding_part(struct emitter *e, const struct closure_leaf *leaf, ir_ref value)
{
    ir_ref way = value && leaf->decay ? closure_environment_way(e->shader, e->host, leaf->leaf) : 0;
    value = weighted(e, leaf, value, way);
    bool is_sampled = value && ir_get(e->graph, value)->flags & IR_NODE_LOOP;
    add_part(e, is_sampled ? PLACE_SAMPLE : PLACE_WHOLE, leaf, value);
    return value != 0;
}

/* Adds the part of the light from behind that passes a leaf straight on. */
static bool add_through(struct emitter *e, const struct closure_leaf *leaf)
{
    ir_ref value = closure_through(e->shader, e->host, leaf->leaf);
    if (!value)
        return false;
    ir_ref way = leaf->decay ? closure_environment_way(e->shader, e->host, leaf->leaf) : 0;
    value = weighted(e, leaf, closure_mul(e->graph, value, leaf->medium), way);
    e->through = add(e, e->through, value ? vec3_of(e, value) : 0);
    return value != 0;
}

/* Finds the values of whole functions, and the values per environment sample. */
static void find_surrounding_parts(struct emitter *e, ir_ref bsdf, const struct closure_list *list,
                                   bool *emitted)
{
    bool shows = e->lighting->environment, transmits_alpha = e->lighting->transmits_alpha;
    if (!shows && !transmits_alpha)
        return;
    struct closure_list through;
    const struct closure_list *behind =
        any_has(e, list, LEAF_TRANSMISSION)
            ? in_context(e, bsdf, SOURCE_TRANSMISSION, NULL, list, &through)
            : list;
    for (uint32_t i = 0; i < list->leaves.len; i++) {
        const struct closure_leaf *leaf = &list->leaves.items[i], *other = &behind->leaves.items[i];
        ir_ref refracted = 0, reflected = 0;
        if (!transmits_alpha)
            refracted = closure_call(e->shader, e->host, other->leaf, LEAF_TRANSMISSION, NULL);
        if (shows)
            reflected = closure_call(e->shader, e->host, leaf->leaf, LEAF_ENVIRONMENT, NULL);
        emitted[i] |= add_surrounding_part(e, leaf, reflected);
        if (transmits_alpha)
            emitted[i] |= add_through(e, other);
        else if (refracted)
            emitted[i] |=
                add_surrounding_part(e, other, closure_mul(e->graph, refracted, other->medium));
    }
}

/* Only the first light has a shadow map: its factor is 1 in the later rounds of the loop. */
static void loop_lights(struct emitter *e)
{
    ir_ref factor = e->lit.light.intensity;
    uint32_t local = 0;
    if (e->lighting->shadow) {
        local = shader_add_local(e->shader, STR_occlusion, IR_TYPE_FLOAT);
        effect(e, EFFECT_VAR, local, closure_shadow(e->shader, e->host));
        factor = ir_op2(e->graph, IR_MUL, factor,
                        ir_build(e->graph, IR_LOCAL, IR_TYPE_FLOAT, local, NULL, 0));
    }
    comment(e, STR_lights);
    effect(e, EFFECT_LIGHTS, 0, 0);
    closure_enter_loop(&e->copies, e->shader->num_light_loops++);
    accumulate_all(e, &e->lit.at[PLACE_LIGHT], true, factor);
    if (e->lighting->shadow)
        effect(e, EFFECT_ASSIGN, local, ir_const_float(e->graph, 1.0f));
    effect(e, EFFECT_END, 0, 0);
}

/* ---- samples of the environment ---- */

static void loop_samples(struct emitter *e, struct closure_parts *list, ir_ref factor)
{
    struct closure_turn turn = closure_turn_of_samples(e->shader, list);
    effect(e, EFFECT_SAMPLES, 0, turn.first);
    closure_enter_loop(&e->copies, e->shader->num_sample_loops++);
    if (list->parts.len == 1)
        accumulate(e, factor, list->parts.items[0].value);
    else
        accumulate_all(e, list, true, factor);
    if (turn.next)
        effect(e, EFFECT_NEXT, 0, turn.next);
    effect(e, EFFECT_END, 0, 0);
}

/* The parts where a choice is true, or false. */
static struct closure_parts chosen_parts(struct emitter *e, const struct closure_sample_loop *loop,
                                         bool is_true)
{
    struct closure_copies copies = {.shader = e->shader};
    struct closure_parts chosen = {0};
    for (uint32_t i = 0; i < loop->list.parts.len; i++) {
        struct closure_part part = loop->list.parts.items[i];
        part.value = closure_chosen(&copies, part.value, loop->choice, is_true);
        vec_push(e->shader->arena, &chosen.parts, part);
    }
    return chosen;
}

static void loop_samples_by_choice(struct emitter *e, struct closure_sample_loop *loop,
                                   ir_ref factor)
{
    if (!loop->choice) {
        loop_samples(e, &loop->list, factor);
        return;
    }
    struct closure_parts sides[2] = {chosen_parts(e, loop, true), chosen_parts(e, loop, false)};
    effect(e, EFFECT_IF, 0, loop->choice);
    loop_samples(e, &sides[0], factor);
    effect(e, EFFECT_ELSE, 0, 0);
    loop_samples(e, &sides[1], factor);
    effect(e, EFFECT_END, 0, 0);
}

/* True if a weight of the parts is not 0; 0: always. */
static ir_ref is_any_visible(struct emitter *e, const struct closure_parts *list)
{
    struct ir_graph *g = e->graph;
    ir_ref any = 0;
    for (uint32_t i = 0; i < list->parts.len; i++) {
        const struct closure_part *part = &list->parts.items[i];
        if (ir_is_const(g, part->scalar))
            return 0;
        ir_ref visible = ir_op2(g, IR_GT, part->scalar, ir_const_float(g, 0.0f));
        closure_name(e->shader, visible, part->leaf, "visible");
        any = any && any != visible ? ir_op2(g, IR_LOR, any, visible) : visible;
    }
    return any;
}

static void gather_samples(struct emitter *e, struct closure_sample_loop *loop, ir_ref factor)
{
    ir_ref visible = is_any_visible(e, &loop->list);
    comment_leaves(e, loop->list.parts.items, loop->list.parts.len);
    if (visible)
        effect(e, EFFECT_IF, 0, visible);
    loop_samples_by_choice(e, loop, factor);
    if (visible)
        effect(e, EFFECT_END, 0, 0);
}

/* Emits the parts as effects. */
static void emit_lit(struct emitter *e)
{
    bool has_lights = e->lit.light.intensity != 0,
         has_samples = e->lit.at[PLACE_SAMPLE].parts.len > 0;
    if (!has_lights && !has_samples && !e->lit.at[PLACE_WHOLE].parts.len)
        return;
    declare_color(e);
    if (has_lights)
        loop_lights(e);
    bool has_environment = has_samples || e->lit.at[PLACE_WHOLE].parts.len;
    ir_ref open = has_environment && e->lighting->occlusion
                      ? closure_occlusion(e->shader, e->lighting->flips_v)
                      : 0;
    if (has_environment)
        comment(e, STR_environment);
    accumulate_all(e, &e->lit.at[PLACE_WHOLE], false, open);
    struct closure_sample_loops samples = {0};
    closure_find_sample_loops(e->shader, &e->lit.at[PLACE_SAMPLE], &samples);
    for (uint32_t i = 0; i < samples.loops.len; i++)
        gather_samples(e, &samples.loops.items[i], open);
    e->shader->lit = true;
}

/* Light starts at the leaf, so its way in is 0. */
static ir_ref emission_of(struct emitter *e, const struct closure_list *list)
{
    ir_ref sum = 0, at_rest = ir_const_float(e->graph, 0.0f);
    for (uint32_t i = 0; i < list->leaves.len; i++) {
        ir_ref value =
            closure_call(e->shader, e->host, list->leaves.items[i].leaf, LEAF_EMISSION, NULL);
        value = weighted(e, &list->leaves.items[i], value, at_rest);
        if (value)
            shader_add_closure(e->shader, list->leaves.items[i].leaf);
        sum = add(e, sum, value);
    }
    return sum;
}

static ir_ref emission(struct emitter *e, ir_ref edf)
{
    struct closure_list list;
    closure_flatten(e->shader, e->host, edf, &list);
    return emission_of(e, &list);
}

/* ---- outputs ---- */

static ir_ref encoded(struct emitter *e, ir_ref color)
{
    return e->lighting->encodes ? closure_encoded(e->graph, color) : color;
}

static void write_surface(struct emitter *e, ir_ref color, ir_ref alpha)
{
    ir_suggest_name(e->graph, alpha, STR_opacity, IR_NAME_ROLE);
    closure_write_output(e->shader, encoded(e, color), alpha);
}

/* The pixel stage discards pixels below the host's threshold. */
static void alpha_test(struct emitter *e, ir_ref alpha)
{
    uint32_t threshold = shader_private_uniform(e->shader, STR_u_alphaThreshold, IR_TYPE_FLOAT, 0);
    effect(e, EFFECT_DISCARD, 0, ir_op2(e->graph, IR_LT, alpha, shader_read(e->shader, threshold)));
    e->shader->transparent = true;
    e->shader->alpha = e->lighting->transparency == TRANSPARENCY_AUTO
                           ? (uint8_t)closure_alpha(e->shader, alpha)
                       : e->lighting->transparency == TRANSPARENCY_MASK ? ALPHA_MASK
                                                                        : ALPHA_BLEND;
}

static ir_ref final_color(struct emitter *e)
{
    if (e->lit.color != UINT32_MAX)
        return ir_build(e->graph, IR_LOCAL, IR_TYPE_VEC3, e->lit.color, NULL, 0);
    return e->lit.base ? vec3_of(e, e->lit.base) : ir_const_splat(e->graph, IR_TYPE_VEC3, 0.0f);
}

/* ---- surfaces ---- */

/* The alpha of the output: the opacity without the transmitted part. 0 = 1. */
static ir_ref output_alpha(struct emitter *e, const struct closure_surface *s)
{
    struct ir_graph *g = e->graph;
    if (!e->through)
        return s->alpha;
    ir_ref mean = ir_op2(g, IR_DOT, e->through, ir_const_splat(g, IR_TYPE_VEC3, 1.0f / 3.0f));
    ir_ref rest = closure_one_minus(
        g, ir_op3(g, IR_CLAMP, mean, ir_const_float(g, 0.0f), ir_const_float(g, 1.0f)));
    return s->alpha ? ir_op2(g, IR_MUL, s->alpha, rest) : rest;
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
    for (uint32_t i = 0; i < e->shader->aovs.len; i++) {
        if (!e->shader->aovs.items[i].is_output)
            continue;
        ir_ref value = closure_aov_value(e->shader, i, aovs.num ? aovs.items[i].value : 0);
        value = with_alpha(e, value, alpha);
        effect(e, EFFECT_OUTPUT, closure_aov_output(e->shader, i, ir_type_of(e->graph, value)),
               value);
    }
}

static bool draws_all(const struct emitter *e, ir_ref alpha)
{
    return e->lighting->transparency == TRANSPARENCY_OPAQUE
           || (closure_is_opaque(e->graph, alpha)
               && e->lighting->transparency != TRANSPARENCY_BLEND);
}

static void finish_surface(struct emitter *e, const struct closure_surface *s)
{
    ir_ref alpha = output_alpha(e, s), one = ir_const_float(e->graph, 1.0f);
    if (draws_all(e, alpha)) {
        write_surface(e, final_color(e), one);
        write_aovs(e, s->aovs, 0, one);
        return;
    }
    alpha = alpha ? alpha : one;
    comment(e, STR_opacity);
    alpha_test(e, alpha);
    ir_ref color = final_color(e);
    bool has_alpha = !s->alpha || s->premultiplied || e->host->keeps_color;
    if (!has_alpha)
        color = ir_op2(e->graph, IR_MUL, color, s->alpha);
    alpha = e->host->keeps_color ? one : alpha;
    write_surface(e, color, alpha);
    write_aovs(e, s->aovs, has_alpha ? 0 : s->alpha, alpha);
}

/* Finds the parts under lights and environment. Returns which leaves contribute there. */
static const bool *find_parts(struct emitter *e, ir_ref bsdf, const struct closure_list *list)
{
    bool *emitted = ARENA_ARRAY(e->shader->arena, bool, list->leaves.len);
    find_lit_parts(e, bsdf, list, emitted);
    find_surrounding_parts(e, bsdf, list, emitted);
    return emitted;
}

/* The leaves and the emission of a surface. */
static void flatten_surface(struct emitter *e, const struct closure_surface *s,
                            struct closure_list *out)
{
    /* most environment light arrives at the mirror of the viewer's angle */
    struct closure_host host = *e->host;
    ir_ref view = e->lighting->two_sided ? closure_view(e->shader, e->host) : 0;
    host.way_in = view ? &view : NULL;
    host.context = SOURCE_INDIRECT;
    closure_flatten(e->shader, &host, s->bsdf, out);
    if (host.above)
        closure_put_under(e->shader, &host, host.above, out);
    e->lit.base = s->unlit ? vec3_of(e, s->unlit) : 0;
    e->lit.base = add(e, e->lit.base, emission(e, s->edf));
    e->lit.base = add(e, e->lit.base, emission_of(e, out));
}

static void find_scattering(struct emitter *e, const struct closure_surface *s,
                            struct closure_scatter_layer *out)
{
    *out = (struct closure_scatter_layer){0};
    flatten_surface(e, s, &out->list);
    out->emission = e->lit.base;
    out->alpha = s->premultiplied ? s->alpha : 0;
    out->aovs = s->aovs;
    for (uint32_t i = 0; i < s->aovs.num; i++) {
        ir_ref *value = &out->aovs.items[i].value;
        if (*value && ir_type_of(e->graph, *value) == IR_TYPE_EDF)
            *value = emission(e, *value);
    }
}

/* Finds the parts under lights and environment, and the emission. */
static void light_surface(struct emitter *e, const struct closure_surface *s)
{
    struct closure_list list;
    flatten_surface(e, s, &list);
    const bool *emitted = find_parts(e, s->bsdf, &list);
    for (uint32_t i = 0; i < list.leaves.len; i++)
        if (emitted[i])
            shader_add_closure(e->shader, list.leaves.items[i].leaf);
}

/* ---- AOVs of closures ---- */

/*
 * Adds the light of a closure, as if it were the whole surface, to the current colour. Its loops
 * are its own.
 */
static void light_aov(struct emitter *e, ir_ref closure)
{
    bool emits = ir_type_of(e->graph, closure) == IR_TYPE_EDF;
    struct closure_surface s = {.bsdf = emits ? 0 : closure, .edf = emits ? closure : 0};
    ir_ref through = e->through; /* it is not that of the surface */
    light_surface(e, &s);
    emit_lit(e);
    e->through = through;
}

static bool is_output(const struct emitter *e, uint32_t aov)
{
    return e->shader->aovs.items[aov].is_output;
}

static bool has_aov_outputs(const struct emitter *e)
{
    for (uint32_t i = 0; i < e->shader->aovs.len; i++)
        if (is_output(e, i))
            return true;
    return false;
}

static bool is_closure(const struct emitter *e, ir_ref value)
{
    return value && ir_type_is_closure(ir_type_of(e->graph, value));
}

/* Replaces closures by their light. */
static void light_aovs(struct emitter *e, struct closure_aovs aovs)
{
    for (uint32_t i = 0; i < aovs.num; i++) {
        if (!is_closure(e, aovs.items[i].value) || !is_output(e, i))
            continue;
        struct closure_lit surface = e->lit;
        e->lit = (struct closure_lit){.color = UINT32_MAX};
        light_aov(e, aovs.items[i].value);
        aovs.items[i].value = final_color(e);
        e->lit = surface;
    }
}

/* Locals for the AOVs of the layer that is picked. */
static uint32_t *declare_aovs(struct emitter *e)
{
    uint32_t num = e->shader->aovs.len;
    uint32_t *locals = ARENA_ARRAY(e->shader->arena, uint32_t, num);
    for (uint32_t i = 0; i < num; i++) {
        if (!is_output(e, i))
            continue;
        locals[i] = shader_add_local(e->shader, e->shader->aovs.items[i].name,
                                     closure_aov_type(e->shader, i));
        effect(e, EFFECT_VAR, locals[i], closure_aov_value(e->shader, i, 0));
    }
    return locals;
}

static void keep_aovs(struct emitter *e, struct closure_aovs aovs, const uint32_t *locals)
{
    for (uint32_t i = 0; i < aovs.num; i++) {
        ir_ref value = is_output(e, i) ? aovs.items[i].value : 0;
        if (is_closure(e, value)) {
            e->lit = (struct closure_lit){.color = locals[i]};
            light_aov(e, value);
            if (e->lit.base)
                effect(e, EFFECT_ACCUMULATE, locals[i], vec3_of(e, e->lit.base));
        } else if (value) {
            effect(e, EFFECT_ASSIGN, locals[i], closure_aov_value(e->shader, i, value));
        }
    }
}

static struct closure_aovs read_aovs(struct emitter *e, const uint32_t *locals)
{
    struct closure_aovs aovs = closure_aovs_of(e->shader);
    for (uint32_t i = 0; i < aovs.num; i++)
        if (is_output(e, i))
            aovs.items[i].value =
                ir_build(e->graph, IR_LOCAL, closure_aov_type(e->shader, i), locals[i], NULL, 0);
    return aovs;
}

/* ---- one layer of a stack ---- */

/* A path tracer always picks. */
static void scatter_stack(struct emitter *e, ir_ref slots)
{
    struct closure_scatter_layer layer;
    struct closure_choices choices = {0};
    ir_ref alpha = ir_arg(e->graph, slots, 0), number = closure_scatter_number(e->shader, alpha);
    closure_choose(e->shader, e->host, slots, number, &choices);
    struct closure_scatter *scatter = closure_scatter_begin(e->shader, e->host, e->lighting);
    for (uint32_t i = 0; i < choices.items.len; i++) {
        const struct closure_choice *choice = &choices.items.items[i];
        find_scattering(e, &choice->layer, &layer);
        layer.is_it = choice->is_it;
        layer.chance =
            ir_op2(e->graph, IR_DIV, ir_op2(e->graph, IR_SUB, number, choice->low), choice->share);
        closure_scatter_layer(scatter, &layer);
    }
    closure_scatter_end(scatter, alpha);
}

static bool is_dark(const struct emitter *e, const struct closure_surface *s)
{
    for (uint32_t i = 0; i < s->aovs.num; i++)
        if (s->aovs.items[i].value)
            return false;
    return !s->bsdf && !s->edf && (!s->unlit || ir_const_is(e->graph, s->unlit, 0.0f));
}

static ir_ref zero_of(struct ir_graph *g, ir_type_id type)
{
    return type == IR_TYPE_INT    ? ir_const_int(g, 0)
           : type == IR_TYPE_BOOL ? ir_const_bool(g, false)
                                  : ir_const_splat(g, type, 0.0f);
}

/* Declares the variables of merged layers, and gives them the values of the one that is picked. */
static void emit_values(struct emitter *e, const struct closure_merged *merged,
                        const struct closure_choice *const *members, uint32_t num,
                        const uint32_t *aovs)
{
    for (uint32_t i = 0; i < merged->variables.len; i++) {
        uint32_t local = merged->variables.items[i].local;
        ir_type_id type = e->shader->locals.items[local].type;
        effect(e, EFFECT_VAR, local, zero_of(e->graph, type));
    }
    for (uint32_t k = 0; k < num; k++) {
        if (members[k]->is_it)
            effect(e, EFFECT_IF, 0, members[k]->is_it);
        for (uint32_t i = 0; i < merged->variables.len; i++)
            effect(e, EFFECT_ASSIGN, merged->variables.items[i].local,
                   merged->values.items[merged->variables.items[i].first_value + k]);
        keep_aovs(e, members[k]->layer.aovs, aovs);
        if (members[k]->is_it)
            effect(e, EFFECT_END, 0, 0);
    }
}

static void emit_lit_layer(struct emitter *e, const struct closure_surface *s)
{
    uint32_t color = e->lit.color;
    e->lit = (struct closure_lit){.color = color};
    light_surface(e, s);
    if (e->lit.base)
        effect(e, EFFECT_ACCUMULATE, color, vec3_of(e, e->lit.base));
    emit_lit(e);
    e->lit.color = color;
}

/* Layers that are alike. is_it: one of them is picked; 0: always. */
static void emit_layers(struct emitter *e, const struct closure_choice *const *members,
                        uint32_t num, ir_ref is_it, const uint32_t *aovs)
{
    struct closure_surface **surfaces =
        ARENA_ARRAY(e->shader->arena, struct closure_surface *, num);
    struct closure_merged merged;
    uint32_t color = e->lit.color;
    for (uint32_t i = 0; i < num; i++) {
        surfaces[i] = ARENA_ARRAY(e->shader->arena, struct closure_surface, 1);
        *surfaces[i] = members[i]->layer;
    }
    closure_merge(e->shader, e->host, surfaces, num, &merged);
    emit_values(e, &merged, members, num, aovs);
    e->lit.color = color;
    if (is_it)
        effect(e, EFFECT_IF, 0, is_it);
    emit_lit_layer(e, &merged.surface);
    if (is_it)
        effect(e, EFFECT_END, 0, 0);
}

static void emit_layer(struct emitter *e, const struct closure_choice *choice, const uint32_t *aovs)
{
    uint32_t color = e->lit.color;
    if (choice->is_it)
        effect(e, EFFECT_IF, 0, choice->is_it);
    emit_lit_layer(e, &choice->layer);
    keep_aovs(e, choice->layer.aovs, aovs);
    e->lit.color = color;
    if (choice->is_it)
        effect(e, EFFECT_END, 0, 0);
}

static ir_ref either(struct ir_graph *g, ir_ref a, ir_ref b)
{
    return a && b ? ir_op2(g, IR_LOR, a, b) : 0;
}

/* A layer with those below it that are alike; marks them in `is_done`. */
static void emit_group(struct emitter *e, struct closure_choices *choices, uint32_t first,
                       bool *is_done, const uint32_t *aovs)
{
    uint32_t num = 0, num_all = choices->items.len;
    const struct closure_choice **members =
        ARENA_ARRAY(e->shader->arena, const struct closure_choice *, num_all);
    struct closure_choice *items = choices->items.items;
    ir_ref is_it = items[first].is_it;
    members[num++] = &items[first];
    for (uint32_t i = first + 1; i < num_all; i++) {
        if (is_done[i] || !closure_are_alike(e->shader, &items[first].layer, &items[i].layer))
            continue;
        is_done[i] = true;
        is_it = either(e->graph, is_it, items[i].is_it);
        members[num++] = &items[i];
    }
    if (num == 1)
        emit_layer(e, members[0], aovs);
    else
        emit_layers(e, members, num, num == num_all && !choices->covered ? 0 : is_it, aovs);
}

static void emit_picked(struct emitter *e, ir_ref slots)
{
    struct ir_graph *g = e->graph;
    ir_ref one = ir_const_float(g, 1.0f), nothing = ir_const_float(g, 0.0f);
    ir_ref number = closure_layer_number(e->shader, closure_position(e->shader, e->host));
    struct closure_choices choices = {0};
    closure_choose(e->shader, e->host, closure_own_textures(e->shader, slots), number, &choices);
    declare_color(e);
    uint32_t *aovs = declare_aovs(e);
    bool *is_done = ARENA_ARRAY(e->shader->arena, bool, choices.items.len);
    for (uint32_t i = 0; i < choices.items.len; i++)
        is_done[i] = is_dark(e, &choices.items.items[i].layer);
    for (uint32_t i = 0; i < choices.items.len; i++)
        if (!is_done[i])
            emit_group(e, &choices, i, is_done, aovs);
    e->lit.base = 0;
    struct closure_surface whole = {.premultiplied = true, .aovs = read_aovs(e, aovs)};
    if (choices.covered)
        whole.alpha = ir_op3(g, IR_SELECT, ir_op2(g, IR_LT, number, choices.covered), one, nothing);
    finish_surface(e, &whole);
}

static bool is_cut(struct emitter *e, ir_ref alpha)
{
    return e->lighting->transparency == TRANSPARENCY_MASK
           || (e->lighting->transparency == TRANSPARENCY_AUTO
               && closure_alpha(e->shader, alpha) == ALPHA_MASK);
}

static void emit_surface(struct emitter *e, ir_ref root)
{
    bool is_stack = root && ir_get(e->graph, root)->op == IR_SLOTS;
    if (is_stack && e->shader->scatters) {
        scatter_stack(e, root);
        return;
    }
    if (is_stack && e->shader->picks) {
        emit_picked(e, root);
        return;
    }
    struct closure_surface s = closure_surface_of(e->shader, e->host, root);
    if (e->shader->scatters) {
        struct closure_scatter_layer layer;
        find_scattering(e, &s, &layer);
        struct closure_scatter *scatter = closure_scatter_begin(e->shader, e->host, e->lighting);
        closure_scatter_layer(scatter, &layer);
        closure_scatter_end(scatter, s.alpha);
        return;
    }
    if (e->host->only_cuts) {
        if (!draws_all(e, s.alpha))
            alpha_test(e, s.alpha);
        return;
    }
    bool is_whole = draws_all(e, s.alpha) || is_cut(e, s.alpha);
    if (e->host->store && is_whole && !has_aov_outputs(e)) {
        struct closure_list list;
        e->shader->alpha = draws_all(e, s.alpha) ? ALPHA_OPAQUE : ALPHA_MASK;
        flatten_surface(e, &s, &list);
        e->host->store(e->shader, e->host, s.bsdf, &list, e->lit.base);
        return;
    }
    light_surface(e, &s);
    emit_lit(e);
    light_aovs(e, s.aovs);
    finish_surface(e, &s);
}

/* ---- volumes ---- */

static void emit_volume(struct emitter *e, ir_ref root)
{
    struct closure_volume volume;
    closure_volume(e->shader, e->host, root, &volume);
    struct closure_lighting lighting = *e->lighting;
    lighting.two_sided = false; /* a volume has no layers */
    e->lighting = &lighting;
    ir_ref emitted_light = emission(e, volume.edf);
    e->lit.base =
        emitted_light ? ir_op2(e->graph, IR_MUL, vec3_of(e, emitted_light), volume.path) : 0;
    find_parts(e, 0, &volume.scattering);
    for (uint32_t i = 0; i < volume.scattering.leaves.len; i++)
        shader_add_closure(e->shader, volume.scattering.leaves.items[i].leaf);
    emit_lit(e);
    e->shader->transparent = true;
    /* no alpha test: emission may leave the background unchanged */
    e->shader->alpha = ALPHA_BLEND;
    write_surface(e, final_color(e), volume.alpha);
}

/* ---- entry ---- */

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
    if (root && shader->scatters)
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
        if (shader->scatters)
            return false;
        emit_volume(&e, root);
        return true;
    }
    if (type != IR_TYPE_SURFACE)
        return closure_emit_value(shader, lighting->encodes, root);
    emit_surface(&e, root);
    return true;
}
