// SPDX-License-Identifier: Apache-2.0
/*
 * topology: a hash of a shader without the names of its variables and the values of its uniforms.
 * Shaders of equal topology can share a program.
 *
 * Nodes, functions and variables get numbers in the order of the statements, so that the hash does
 * not depend on the history of the graph. The hash takes a portable function of a library by name
 * and size, and a version of it node by node.
 */
#include "base/hash.h"
#include "shader/verbatim.h"
#include "tree/walk.h"

#include <assert.h>

struct hasher {
    const struct shader *shader;
    struct arena *arena;
    uint64_t hash;
    uint32_t *node_numbers; /* by node: its number, from 1; 0: not reached yet */
    uint32_t num_nodes;
    uint32_t *variable_numbers; /* by variable: 1 + its position in the interface */
    /* by portable function, and by IR function: 1 + its position in the stage's reach */
    uint32_t *function_numbers;
    uint32_t *graph_function_numbers;
};

static void add(struct hasher *h, uint64_t word)
{
    h->hash = hash_mix(h->hash, word);
}

static void add_text(struct hasher *h, str_id id)
{
    const char *text = str_text(h->shader->strings, id);
    add(h, hash_stable(HASH_STABLE_SEED, text, str_len(h->shader->strings, id)));
}

/* Adds a string by its text, because ids depend on the other strings. */
static void add_words(struct hasher *h, ir_type_id type, const union ir_word *words)
{
    if (type == IR_TYPE_STRING) {
        add_text(h, words->u);
        return;
    }
    for (uint32_t i = 0; i < ir_type_info(type)->components; i++)
        add(h, words[i].u);
}

static void add_variables(struct hasher *h)
{
    for (uint32_t i = 0; i < h->shader->interface.used.len; i++) {
        uint32_t index = h->shader->interface.used.items[i];
        const struct shader_variable *variable = &h->shader->interface.variables.items[index];
        h->variable_numbers[index] = i + 1;
        add(h, (uint64_t)variable->block << 40 | (uint64_t)variable->stages << 32
                   | (uint64_t)variable->array_length << 16 | variable->type);
        add_text(h, variable->semantic);
        if (variable->block >= BLOCK_OWN)
            add_text(h, h->shader->interface.own_blocks[variable->block - BLOCK_OWN]);
    }
}

/* ---- Portable functions ---- */

/*
 * Adds the fields of a node of a version. Names tell globals apart: their ids depend on what else
 * was parsed.
 */
static bool add_tree_node(void *user_data, lang_ref ref, unsigned access)
{
    struct hasher *h = user_data;
    const struct lang_unit *unit = h->shader->unit;
    const struct lang_node *node = &unit->nodes.items[ref];
    (void)access;
    assert(node->kind != LANG_CALL || h->function_numbers[node->a]);
    uint64_t own =
        (uint64_t)node->kind << 56 | (uint64_t)node->op << 48 | (uint64_t)node->type << 32;
    if (node->kind == LANG_VAR || node->kind == LANG_DECLARE)
        own |= node->a;
    else if (node->kind == LANG_CALL)
        own |= h->function_numbers[node->a];
    else if (node->kind == LANG_OP)
        own |= node->b;
    add(h, own);
    if (node->kind == LANG_GLOBAL)
        add_text(h, lang_global(unit, node->a, NULL)->name);
    if (node->kind == LANG_CONST && node->type < IR_NUM_TYPES)
        add_words(h, node->type, unit->words.items + node->a);
    return true;
}

static void add_portable_functions(struct hasher *h, const struct lang_reach *reach)
{
    for (uint32_t i = 0; i < reach->functions.len; i++) {
        const struct lang_unit *layer;
        const struct lang_function *fn =
            lang_function(h->shader->unit, reach->functions.items[i], &layer);
        h->function_numbers[reach->functions.items[i]] = i + 1;
        add(h, (uint64_t)fn->return_type << 32 | (uint64_t)fn->num_params << 16 | fn->num_slots);
        if (layer == h->shader->unit && layer->base)
            lang_walk(layer, fn->body, LANG_READ, add_tree_node, h);
        add_text(h, fn->name);
        add(h, fn->num_nodes);
    }
}

/* ---- The graph ---- */

/* A variable of the host is not in the interface: its name tells it apart. */
static uint32_t variable_number(struct hasher *h, uint32_t variable)
{
    if (h->shader->interface.variables.items[variable].is_hosts)
        add_text(h, h->shader->interface.variables.items[variable].name);
    return h->variable_numbers[variable];
}

static uint64_t attribute(struct hasher *h, ir_ref ref)
{
    const struct ir_node *node = ir_get(h->shader->graph, ref);
    switch (node->op) {
    case IR_POISON: /* an origin */
    case IR_CONST: return 0;
    case IR_CONTEXT:
        return ir_is_light_member(node->attr) ? variable_number(h, node->attr) : node->attr;
    case IR_UNIFORM:
    case IR_STREAM:
    case IR_TEXTURE: return variable_number(h, node->attr);
    case IR_PARAM: return node->attr & 0xffff;
    case IR_CALL: return h->function_numbers[shader_callee(h->shader, ref)];
    case IR_GRAPH_CALL: return h->graph_function_numbers[node->attr];
    case IR_VERBATIM: return shader_callee(h->shader, ref);
    case IR_LEAF: add_text(h, h->shader->graph->callees.items[node->attr].name); return 0;
    default: return node->attr;
    }
}

static void add_node(struct hasher *h, ir_ref ref)
{
    assert(h->node_numbers[ref] == 0);
    const struct ir_graph *graph = h->shader->graph;
    const struct ir_node *node = ir_get(graph, ref);
    h->node_numbers[ref] = ++h->num_nodes;
    add(h, (uint64_t)node->op << 48 | (uint64_t)node->type << 32 | node->num_args);
    add(h, attribute(h, ref));
    struct ir_value value;
    if (node->op == IR_CONST && ir_get_const(graph, ref, &value))
        add_words(h, value.type, value.w);
    for (uint32_t i = 0; i < node->num_args; i++)
        add(h, h->node_numbers[ir_arg(graph, ref, i)]);
}

static void add_expression(struct hasher *h, ir_ref root)
{
    struct visit {
        ir_ref ref;
        uint32_t next;
    };
    VEC(struct visit) stack = {0};
    if (!h->node_numbers[root])
        vec_push(h->arena, &stack, (struct visit){root, 0});
    while (stack.len) {
        struct visit *top = &vec_last(&stack);
        if (top->next < ir_get(h->shader->graph, top->ref)->num_args) {
            ir_ref operand = ir_arg(h->shader->graph, top->ref, top->next++);
            if (!h->node_numbers[operand])
                vec_push(h->arena, &stack, (struct visit){operand, 0});
            continue;
        }
        ir_ref ref = vec_pop(&stack).ref;
        if (!h->node_numbers[ref])
            add_node(h, ref);
    }
    add(h, h->node_numbers[root]);
}

static void add_effects(struct hasher *h, const struct effect_list *statements)
{
    for (uint32_t i = 0; i < statements->len; i++) {
        const struct effect *effect = &statements->items[i];
        if (effect->kind == EFFECT_COMMENT)
            continue;
        bool variable = effect->kind == EFFECT_OUTPUT;
        add(h, (uint64_t)effect->kind << 32
                   | (variable ? h->variable_numbers[effect->index] : effect->index));
        if (effect->value)
            add_expression(h, effect->value);
    }
}

static void add_stage(struct hasher *h, const struct shader_stage *stage)
{
    add_portable_functions(h, &stage->reach);
    for (uint32_t i = 0; i < stage->verbatim.len; i++) {
        const struct shader_verbatim *verbatim =
            &h->shader->sources.calls.items[stage->verbatim.items[i]];
        struct source_list sources = {0};
        for (uint32_t k = 0; k < verbatim->num_sources; k++)
            shader_collect_sources(h->shader,
                                   h->shader->sources.refs.items[verbatim->first_source + k],
                                   h->arena, &sources);
        for (uint32_t k = 0; k < sources.len; k++)
            add_text(h, h->shader->sources.all.items[sources.items[k]].text);
        add_text(h, verbatim->function);
        add_text(h, verbatim->expression);
    }
    for (uint32_t i = 0; i < stage->functions.len; i++) {
        h->graph_function_numbers[stage->functions.items[i].function] = i + 1;
        add_effects(h, &stage->functions.items[i].statements);
    }
    add_effects(h, &stage->statements);
}

uint64_t shader_topology(const struct shader *shader, struct arena *scratch)
{
    struct hasher h = {.shader = shader, .arena = scratch, .hash = HASH_STABLE_SEED};
    uint32_t num_functions =
        shader->unit ? shader->unit->base_functions + shader->unit->functions.len : 0;
    h.node_numbers = ARENA_ARRAY(h.arena, uint32_t, shader->graph->nodes.len);
    h.variable_numbers = ARENA_ARRAY(h.arena, uint32_t, shader->interface.variables.len + 1);
    h.function_numbers = ARENA_ARRAY(h.arena, uint32_t, num_functions + 1);
    h.graph_function_numbers = ARENA_ARRAY(h.arena, uint32_t, shader->graph->functions.len + 1);
    if (shader->reflection.codes)
        add(&h, shader->reflection.codes);
    add_variables(&h);
    for (uint32_t i = 0; i < shader->interface.lights.len; i++)
        add(&h, (uint64_t)(uint32_t)shader->interface.lights.items[i].type);
    for (int stage = 0; stage < NUM_STAGES; stage++)
        add_stage(&h, &shader->stages[stage]);
    assert(h.num_nodes < shader->graph->nodes.len);
    return h.hash;
}
