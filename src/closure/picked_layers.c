// SPDX-License-Identifier: Apache-2.0
/*
 * One layer of a stack: writes the code of each layer behind a test that a random number picks it.
 * Layers that are alike share their code.
 */
#include "closure/emitter.h"

#include <assert.h>

/* Locals for the AOVs of the layer that is picked. */
static uint32_t *declare_aovs(struct emitter *e)
{
    uint32_t num = e->shader->interface.aovs.len;
    uint32_t *locals = ARENA_ARRAY(e->shader->arena, uint32_t, num);
    for (uint32_t i = 0; i < num; i++) {
        if (!emitter_is_output(e, i))
            continue;
        locals[i] = shader_add_local(e->shader, e->shader->interface.aovs.items[i].name,
                                     closure_aov_type(e->shader, i));
        emitter_effect(e, EFFECT_VAR, locals[i], closure_aov_value(e->shader, i, 0));
    }
    return locals;
}

static void keep_aovs(struct emitter *e, struct closure_aovs aovs, const uint32_t *locals)
{
    for (uint32_t i = 0; i < aovs.num; i++) {
        ir_ref value = emitter_is_output(e, i) ? aovs.items[i].value : 0;
        if (ir_is_closure(e->graph, value)) {
            e->lit = (struct closure_lit){.color = locals[i]};
            emitter_light_aov(e, value);
            if (e->lit.base)
                emitter_effect(e, EFFECT_ACCUMULATE, locals[i], emitter_vec3(e, e->lit.base));
        } else if (value) {
            emitter_effect(e, EFFECT_ASSIGN, locals[i], closure_aov_value(e->shader, i, value));
        }
    }
}

static struct closure_aovs read_aovs(struct emitter *e, const uint32_t *locals)
{
    struct closure_aovs aovs = closure_aovs_of(e->shader);
    for (uint32_t i = 0; i < aovs.num; i++)
        if (emitter_is_output(e, i))
            aovs.items[i].value =
                ir_build(e->graph, IR_LOCAL, closure_aov_type(e->shader, i), locals[i], NULL, 0);
    return aovs;
}

void emitter_scatter_stack(struct emitter *e, ir_ref slots)
{
    struct closure_scatter_layer layer;
    struct closure_choices choices = {0};
    ir_ref alpha = ir_arg(e->graph, slots, 0), number = closure_scatter_number(e->shader, alpha);
    closure_choose(e->shader, e->host, slots, number, &choices);
    struct closure_scatter *scatter = closure_scatter_begin(e->shader, e->host, e->lighting);
    for (uint32_t i = 0; i < choices.items.len; i++) {
        const struct closure_choice *choice = &choices.items.items[i];
        layer.pile = NULL;
        emitter_find_scattering(e, &choice->layer, &layer);
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
        ir_type_id type = e->shader->effects.locals.items[local].type;
        emitter_effect(e, EFFECT_VAR, local, zero_of(e->graph, type));
    }
    for (uint32_t k = 0; k < num; k++) {
        if (members[k]->is_it)
            emitter_effect(e, EFFECT_IF, 0, members[k]->is_it);
        for (uint32_t i = 0; i < merged->variables.len; i++)
            emitter_effect(e, EFFECT_ASSIGN, merged->variables.items[i].local,
                           merged->values.items[merged->variables.items[i].first_value + k]);
        keep_aovs(e, members[k]->layer.aovs, aovs);
        if (members[k]->is_it)
            emitter_effect(e, EFFECT_END, 0, 0);
    }
}

static void emit_lit_layer(struct emitter *e, const struct closure_surface *s)
{
    uint32_t color = e->lit.color;
    e->lit = (struct closure_lit){.color = color};
    emitter_light_surface(e, s);
    if (e->lit.base)
        emitter_effect(e, EFFECT_ACCUMULATE, color, emitter_vec3(e, e->lit.base));
    emitter_write_lit(e);
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
        emitter_effect(e, EFFECT_IF, 0, is_it);
    emit_lit_layer(e, &merged.surface);
    if (is_it)
        emitter_effect(e, EFFECT_END, 0, 0);
}

static void emit_layer(struct emitter *e, const struct closure_choice *choice, const uint32_t *aovs)
{
    uint32_t color = e->lit.color;
    if (choice->is_it)
        emitter_effect(e, EFFECT_IF, 0, choice->is_it);
    emit_lit_layer(e, &choice->layer);
    keep_aovs(e, choice->layer.aovs, aovs);
    e->lit.color = color;
    if (choice->is_it)
        emitter_effect(e, EFFECT_END, 0, 0);
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

void emitter_pick_layer(struct emitter *e, ir_ref slots)
{
    struct ir_graph *g = e->graph;
    ir_ref one = ir_const_float(g, 1.0f), nothing = ir_const_float(g, 0.0f);
    ir_ref number = closure_layer_number(e->shader, closure_position(e->shader, e->host));
    struct closure_choices choices = {0};
    closure_choose(e->shader, e->host, closure_own_textures(e->shader, slots), number, &choices);
    emitter_declare_color(e);
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
    emitter_finish_surface(e, &whole);
}
