// SPDX-License-Identifier: Apache-2.0
/*
 * Parameters of a shader that functions of graphs cannot see, because they stand above it: such a
 * function has them as parameters behind its own, and each call passes them on.
 */
#include "spell/spell.h"

typedef VEC(ir_ref) node_stack;

static void add(struct spell *spell, struct spell_passed *passed, uint32_t variable)
{
    for (uint32_t i = 0; i < passed->variables.len; i++)
        if (passed->variables.items[i] == variable)
            return;
    vec_push(spell->scratch, &passed->variables, variable);
}

/* Adds the variables that a node of the function reads itself, or passes on to another function. */
static void find_of_node(struct spell *spell, struct spell_passed *passed,
                         const struct ir_node *node)
{
    if (node->op == IR_GRAPH_CALL) {
        const struct spell_passed *callee = &spell->passed[node->attr];
        for (uint32_t i = 0; i < callee->variables.len; i++)
            add(spell, passed, callee->variables.items[i]);
    }
    bool is_read = node->op == IR_UNIFORM || node->op == IR_TEXTURE;
    if (is_read
        && spell->frame->passed_type(spell, &spell->shader->interface.variables.items[node->attr]))
        add(spell, passed, node->attr);
}

/* `seen`: by node, 1 + the last function that has it. */
static void find_of_function(struct spell *spell, uint32_t index, uint32_t *seen, node_stack *stack)
{
    const struct ir_graph *graph = spell->shader->graph;
    const struct ir_function *fn = &graph->functions.items[index];
    for (uint32_t i = 0; i < fn->num_results; i++)
        vec_push(spell->scratch, stack, graph->function_results.items[fn->first_result + i]);
    while (stack->len) {
        ir_ref ref = stack->items[--stack->len];
        if (!ref || seen[ref] == index + 1)
            continue;
        seen[ref] = index + 1;
        const struct ir_node *node = ir_get(graph, ref);
        find_of_node(spell, &spell->passed[index], node);
        for (uint32_t i = 0; i < node->num_args; i++)
            vec_push(spell->scratch, stack, ir_arg(graph, ref, i));
    }
}

void spell_find_passed(struct spell *spell)
{
    if (!spell->frame->passed_type)
        return;
    const struct ir_graph *graph = spell->shader->graph;
    node_stack stack = {0};
    spell->passed = ARENA_ARRAY(spell->scratch, struct spell_passed, graph->functions.len + 1);
    uint32_t *seen = ARENA_ARRAY(spell->scratch, uint32_t, graph->nodes.len);
    for (uint32_t i = 0; i < spell->stage->functions.len; i++)
        find_of_function(spell, spell->stage->functions.items[i].function, seen, &stack);
}

void spell_passed(struct spell *spell, uint32_t function, bool declares, bool is_first)
{
    static const struct spell_passed none;
    const struct spell_passed *passed = spell->passed ? &spell->passed[function] : &none;
    for (uint32_t i = 0; i < passed->variables.len; i++) {
        const struct shader_variable *variable =
            &spell->shader->interface.variables.items[passed->variables.items[i]];
        spell_text(spell, is_first && !i ? "" : ", ");
        if (declares)
            SPELL(spell, spell->frame->passed_type(spell, variable), " ");
        spell_text(spell, str_text(spell->shader->strings, variable->name));
    }
}
