// SPDX-License-Identifier: Apache-2.0
/*
 * The light that a surface sends to the viewer: finds the contributions of its leaves, and writes
 * them as effects:
 *
 *     color = emission
 *     for each light: color += intensity · Σ w · eval
 *     color += Σ w · environment + Σ w · transmission
 *     for leaves that share samples, for each sample of the environment:
 *         color += Σ w · environment + Σ w · transmission
 *
 * A leaf with a variable weight may have weight 0: its expensive part stands behind `if (weight >
 * 0)`.
 */
#include "closure/emitter.h"

#include "ir/arithmetic.h"

#include <assert.h>

void emitter_effect(struct emitter *e, enum effect_kind kind, uint32_t index, ir_ref value)
{
    value = closure_in_loop(&e->copies, value);
    shader_effect(e->shader, STAGE_PIXEL,
                  (struct effect){.kind = (uint8_t)kind, .index = index, .value = value});
}

ir_ref emitter_vec3(struct emitter *e, ir_ref value)
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
               : ir_product(e->graph, leaf->color, leaf->scalar);
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
    ir_ref invariant;
    value = closure_product(g, value, weight, &invariant);
    closure_name(e->shader, value, leaf->leaf, "response");
    if (invariant && !ir_label(g, invariant)->name)
        closure_name(e->shader, invariant, leaf->leaf, "factor");
    ir_pop_origin(g);
    return value;
}

void emitter_declare_color(struct emitter *e)
{
    if (e->lit.color != UINT32_MAX)
        return;
    e->lit.color = shader_add_local(e->shader, STR_color, IR_TYPE_VEC3);
    emitter_effect(e, EFFECT_VAR, e->lit.color,
                   e->lit.base ? emitter_vec3(e, e->lit.base)
                               : ir_const_splat(e->graph, IR_TYPE_VEC3, 0.0f));
}

/* count: of closure_num_samples. */
static void add_part(struct emitter *e, enum closure_place place, const struct closure_list *list,
                     uint32_t order, ir_ref value, ir_ref count)
{
    const struct closure_leaf *leaf = &list->leaves.items[order];
    if (value)
        vec_push(e->shader->arena, &e->lit.at[place].parts,
                 (struct closure_part){.leaf = leaf->leaf,
                                       .order = order,
                                       .scalar = leaf->scalar,
                                       .value = value,
                                       .count = count});
}

static void accumulate(struct emitter *e, ir_ref factor, ir_ref value)
{
    assert(e->lit.color < e->shader->effects.locals.len);
    ir_push_origin_of(e->graph, value);
    if (factor) /* of the numbers of both a GPU makes one, before it comes to vectors */
        value = closure_product(e->graph, factor, value, NULL);
    emitter_effect(e, EFFECT_ACCUMULATE, e->lit.color, emitter_vec3(e, value));
    ir_pop_origin(e->graph);
}

void emitter_comment(struct emitter *e, str_id text)
{
    shader_effect(e->shader, STAGE_PIXEL, (struct effect){.kind = EFFECT_COMMENT, .text = text});
}

/* The name of the closure that a part comes from; 0: none. */
static str_id leaf_name(const struct emitter *e, const struct closure_part *part)
{
    return e->graph->origins.items[ir_get(e->graph, part->leaf)->origin].name;
}

/*
 * Writes a comment such as "environment: metal, reflection": the section and the leaves of the next
 * parts, each once. section "": the leaves alone; NULL: no comment.
 */
static void comment_leaves(struct emitter *e, const char *section, const struct closure_part *parts,
                           uint32_t count)
{
    struct text names;
    text_init(&names, e->shader->arena);
    str_id last = 0;
    if (!section)
        return;
    text_str(&names, section);
    size_t opening = names.len;
    for (uint32_t i = 0; i < count; i++) {
        str_id name = leaf_name(e, &parts[i]);
        if (!name || name == last)
            continue;
        text_str(&names, names.len > opening ? ", " : opening ? ": " : "");
        text_str(&names, str_text(e->shader->strings, name));
        last = name;
    }
    if (names.len)
        emitter_comment(e, str_intern(e->shader->strings, names.data, names.len));
}

/* Parts [begin, end) as one statement; guard 0: unconditionally. */
static void accumulate_parts(struct emitter *e, const char *section,
                             const struct closure_part *parts, uint32_t count, ir_ref guard,
                             ir_ref factor)
{
    struct ir_graph *g = e->graph;
    ir_ref sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        sum = ir_sum(g, sum, parts[i].value);
        if (i)
            ir_suggest_name(g, sum, STR_response, IR_NAME_ROLE);
    }
    comment_leaves(e, section, parts, count);
    if (guard) {
        ir_ref condition = ir_op2(g, IR_GT, guard, ir_const_float(g, 0.0f));
        closure_name(e->shader, condition, parts->leaf, "visible");
        emitter_effect(e, EFFECT_IF, 0, condition);
    }
    accumulate(e, factor, sum);
    if (guard)
        emitter_effect(e, EFFECT_END, 0, 0);
}

/*
 * color += factor · Σ parts. section: as in comment_leaves. Leaves without a branch share one line,
 * which comes first: their weights need no registers in the others. Neighbours with the same guard
 * share a branch.
 */
static void accumulate_all(struct emitter *e, const char *section, struct closure_parts *list,
                           bool in_loop, ir_ref factor)
{
    struct closure_parts plain = {0}, dear = {0};
    closure_find_guarded(e->shader, list, in_loop);
    for (uint32_t i = 0; i < list->parts.len; i++) {
        struct closure_part *part = &list->parts.items[i];
        part->is_guarded &= !ir_is_const(e->graph, part->scalar);
        vec_push(e->shader->arena, part->is_guarded ? &dear.parts : &plain.parts, *part);
    }
    if (plain.parts.len)
        accumulate_parts(e, section, plain.parts.items, plain.parts.len, 0, factor);
    for (uint32_t i = 0, end; i < dear.parts.len; i = end) {
        const struct closure_part *first = &dear.parts.items[i];
        for (end = i + 1; end < dear.parts.len; end++)
            if (dear.parts.items[end].scalar != first->scalar)
                break;
        accumulate_parts(e, section, first, end - i, first->scalar, factor);
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
        add_part(e, PLACE_LIGHT, list, i, value, 0);
        emitted[i] |= value != 0;
    }
}

static bool add_surrounding_part(struct emitter *e, const struct closure_list *list, uint32_t order,
                                 ir_ref value)
{
    const struct closure_leaf *leaf = &list->leaves.items[order];
    ir_ref way = value && leaf->decay ? closure_environment_way(e->shader, e->host, leaf->leaf) : 0;
    ir_ref count = closure_num_samples(&e->copies, &value);
    value = weighted(e, leaf, value, way);
    add_part(e, count ? PLACE_SAMPLE : PLACE_WHOLE, list, order, value, count);
    return value != 0;
}

/* Adds the part of the light from behind that passes a leaf straight on. */
static bool add_through(struct emitter *e, const struct closure_leaf *leaf)
{
    ir_ref value = closure_through(e->shader, e->host, leaf->leaf);
    if (!value)
        return false;
    ir_ref way = leaf->decay ? closure_environment_way(e->shader, e->host, leaf->leaf) : 0;
    value = weighted(e, leaf, ir_product(e->graph, value, leaf->medium), way);
    e->through = ir_sum(e->graph, e->through, value ? emitter_vec3(e, value) : 0);
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
        emitted[i] |= add_surrounding_part(e, list, i, reflected);
        if (transmits_alpha)
            emitted[i] |= add_through(e, other);
        else if (refracted)
            emitted[i] |=
                add_surrounding_part(e, behind, i, ir_product(e->graph, refracted, other->medium));
    }
}

const bool *emitter_find_parts(struct emitter *e, ir_ref bsdf, const struct closure_list *list)
{
    bool *emitted = ARENA_ARRAY(e->shader->arena, bool, list->leaves.len);
    find_lit_parts(e, bsdf, list, emitted);
    find_surrounding_parts(e, bsdf, list, emitted);
    return emitted;
}

/*
 * Only the first light has a shadow map: its factor is 1 in the later rounds of the loop. The
 * function of a host has a factor for each light.
 */
static void loop_lights(struct emitter *e, struct closure_parts *lit, bool is_one_of_several)
{
    ir_ref factor = e->lit.light.intensity;
    uint32_t local = 0;
    bool has_map = e->lighting->shadow == DARKENED_BY_MAP;
    if (e->lighting->shadow == DARKENED_BY_HOST)
        factor =
            closure_product(e->graph, factor,
                            closure_host_shadow(e->shader, e->host, e->lit.light.direction), NULL);
    if (has_map) {
        local = shader_add_local(e->shader, STR_occlusion, IR_TYPE_FLOAT);
        emitter_effect(e, EFFECT_VAR, local, closure_shadow(e->shader, e->host));
        factor = ir_op2(e->graph, IR_MUL, factor,
                        ir_build(e->graph, IR_LOCAL, IR_TYPE_FLOAT, local, NULL, 0));
    }
    comment_leaves(e, str_text(e->shader->strings, STR_lights), lit->parts.items,
                   is_one_of_several ? lit->parts.len : 0);
    emitter_effect(e, EFFECT_LIGHTS, 0, 0);
    closure_enter_loop(&e->copies, e->shader->effects.num_light_loops++);
    for (uint32_t i = 0; i < e->lit.light.choice.len; i++) {
        const struct effect *part = &e->lit.light.choice.items[i];
        emitter_effect(e, (enum effect_kind)part->kind, part->index, part->value);
    }
    accumulate_all(e, "", lit, true, factor);
    if (has_map)
        emitter_effect(e, EFFECT_ASSIGN, local, ir_const_float(e->graph, 1.0f));
    emitter_effect(e, EFFECT_END, 0, 0);
}

static void loop_samples(struct emitter *e, struct closure_parts *list, ir_ref factor)
{
    ir_ref next = closure_next_turn(e->shader, list);
    if (next)
        shader_effect(e->shader, STAGE_PIXEL,
                      (struct effect){.kind = EFFECT_TURN,
                                      .value = closure_first_turn(e->graph),
                                      .text = leaf_name(e, list->parts.items)});
    emitter_effect(e, EFFECT_SAMPLES, 0, list->parts.items[0].count);
    closure_enter_loop(&e->copies, e->shader->effects.num_sample_loops++);
    if (list->parts.len == 1)
        accumulate(e, factor, list->parts.items[0].value);
    else
        accumulate_all(e, NULL, list, true, factor);
    if (next)
        emitter_effect(e, EFFECT_NEXT, 0, next);
    emitter_effect(e, EFFECT_END, 0, 0);
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
    emitter_effect(e, EFFECT_IF, 0, loop->choice);
    loop_samples(e, &sides[0], factor);
    emitter_effect(e, EFFECT_ELSE, 0, 0);
    loop_samples(e, &sides[1], factor);
    emitter_effect(e, EFFECT_END, 0, 0);
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

static void gather_samples(struct emitter *e, const char *section, struct closure_sample_loop *loop,
                           ir_ref factor)
{
    ir_ref visible = is_any_visible(e, &loop->list);
    comment_leaves(e, section, loop->list.parts.items, loop->list.parts.len);
    if (visible)
        emitter_effect(e, EFFECT_IF, 0, visible);
    loop_samples_by_choice(e, loop, factor);
    if (visible)
        emitter_effect(e, EFFECT_END, 0, 0);
}

/* The light of a batch. open: the part of the environment that is not occluded; 0: all. */
static void write_batch(struct emitter *e, struct closure_parts *at, bool is_one_of_several,
                        ir_ref open)
{
    if (at[PLACE_LIGHT].parts.len)
        loop_lights(e, &at[PLACE_LIGHT], is_one_of_several);
    if (!at[PLACE_SAMPLE].parts.len && !at[PLACE_WHOLE].parts.len)
        return;
    const char *section = str_text(e->shader->strings, STR_environment);
    accumulate_all(e, section, &at[PLACE_WHOLE], false, open);
    struct closure_sample_loops samples = {0};
    closure_find_sample_loops(e->shader, &at[PLACE_SAMPLE], &samples);
    for (uint32_t i = 0; i < samples.loops.len; i++)
        gather_samples(e, section, &samples.loops.items[i], open);
}

/* The part of the environment that is not occluded; 0: all. */
static ir_ref open_part(struct emitter *e)
{
    switch (e->lighting->occlusion) {
    case DARKENED_BY_MAP: return closure_occlusion(e->shader, e->lighting->flips_v);
    case DARKENED_BY_HOST: return closure_host_occlusion(e->shader, e->host);
    case DARKENED_AS_STORED: return closure_stored_occlusion(e->shader);
    default: return 0;
    }
}

void emitter_write_lit(struct emitter *e)
{
    struct closure_parts *all = e->lit.at;
    bool has_environment = all[PLACE_SAMPLE].parts.len || all[PLACE_WHOLE].parts.len;
    if (!all[PLACE_LIGHT].parts.len && !has_environment)
        return;
    emitter_declare_color(e);
    ir_ref open = has_environment ? open_part(e) : 0;
    struct closure_batches batches = {0};
    closure_find_batches(e->shader, &all[PLACE_LIGHT], &batches);
    uint32_t next[NUM_PLACES] = {0};
    for (uint32_t i = 0; i < batches.ends.len; i++) {
        struct closure_parts batch[NUM_PLACES] = {0};
        for (unsigned place = 0; place < NUM_PLACES; place++)
            for (; next[place] < all[place].parts.len; next[place]++) {
                const struct closure_part *part = &all[place].parts.items[next[place]];
                if (part->order >= batches.ends.items[i])
                    break;
                vec_push(e->shader->arena, &batch[place].parts, *part);
            }
        write_batch(e, batch, batches.ends.len > 1, open);
    }
    e->shader->reflection.lit = true;
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
        sum = ir_sum(e->graph, sum, value);
    }
    return sum;
}

ir_ref emitter_emission(struct emitter *e, ir_ref edf)
{
    struct closure_list list;
    closure_flatten(e->shader, e->host, edf, &list);
    return emission_of(e, &list);
}

void emitter_flatten(struct emitter *e, const struct closure_surface *s, struct closure_list *out)
{
    /* most environment light arrives at the mirror of the viewer's angle */
    struct closure_host host = *e->host;
    ir_ref view = e->lighting->two_sided ? closure_view(e->shader, e->host) : 0;
    host.way_in = view ? &view : NULL;
    host.context = SOURCE_INDIRECT;
    closure_flatten(e->shader, &host, s->bsdf, out);
    if (host.above)
        closure_put_under(e->shader, &host, host.above, out);
    e->lit.base = s->unlit ? emitter_vec3(e, s->unlit) : 0;
    e->lit.base = ir_sum(e->graph, e->lit.base, emitter_emission(e, s->edf));
    e->lit.base = ir_sum(e->graph, e->lit.base, emission_of(e, out));
}

void emitter_light_list(struct emitter *e, ir_ref bsdf, struct closure_list *list)
{
    const bool *emitted = emitter_find_parts(e, bsdf, list);
    for (uint32_t i = 0; i < list->leaves.len; i++)
        if (emitted[i])
            shader_add_closure(e->shader, list->leaves.items[i].leaf);
}

void emitter_light_surface(struct emitter *e, const struct closure_surface *s)
{
    struct closure_list list;
    emitter_flatten(e, s, &list);
    emitter_light_list(e, s->bsdf, &list);
}

ir_ref emitter_color(struct emitter *e)
{
    if (e->lit.color != UINT32_MAX)
        return ir_build(e->graph, IR_LOCAL, IR_TYPE_VEC3, e->lit.color, NULL, 0);
    return e->lit.base ? emitter_vec3(e, e->lit.base)
                       : ir_const_splat(e->graph, IR_TYPE_VEC3, 0.0f);
}
