// SPDX-License-Identifier: Apache-2.0
/* Statements in their blocks: branches, loops and chains of `else if`. */
#include "spell/spell.h"

#include <assert.h>

#define NO_EFFECT UINT32_MAX

/* An IF or a loop that is open, with the ELSE of the IF. */
struct open_block {
    uint32_t opening, otherwise;
};

static bool opens_block(uint8_t kind)
{
    return kind == EFFECT_IF || kind == EFFECT_ELSE || kind == EFFECT_LIGHTS
           || kind == EFFECT_SAMPLES;
}

/*
 * Finds each ELSE that holds an IF and nothing else, so that both are one "else if". Returns a flag
 * for each effect: true for such an ELSE, and for the END of its block.
 */
static const bool *find_chains(struct spell *spell, const struct effect_list *list)
{
    VEC(struct open_block) blocks = {0};
    bool *chained = arena_alloc(spell->scratch, (list->len + 1) * sizeof *chained);
    uint32_t closed = NO_EFFECT;
    for (uint32_t i = 0; i < list->len; i++) {
        uint8_t kind = list->items[i].kind;
        chained[i] = false;
        if (kind == EFFECT_ELSE) {
            blocks.items[blocks.len - 1].otherwise = i;
        } else if (opens_block(kind)) {
            vec_push(spell->scratch, &blocks, ((struct open_block){i, NO_EFFECT}));
        } else if (kind == EFFECT_END) {
            struct open_block block = vec_pop(&blocks);
            if (block.otherwise != NO_EFFECT && closed == block.otherwise + 1
                && list->items[closed].kind == EFFECT_IF && list->items[i - 1].kind == EFFECT_END)
                chained[i] = chained[block.otherwise] = true;
            closed = block.opening;
        }
    }
    return chained;
}

/* A single plain statement in an `if` needs no braces. */
static bool holds_one_statement(const struct spell *spell, const struct effect_list *list,
                                uint32_t opening)
{
    if (spell->style->syntax->always_braces || opening + 2 >= list->len
        || list->items[opening + 2].kind != EFFECT_END)
        return false;
    uint8_t kind = list->items[opening + 1].kind;
    return kind == EFFECT_ACCUMULATE || kind == EFFECT_ASSIGN;
}

/* Ends a block at its END or ELSE; `next` is the condition of an "else if", 0: there is none. */
static void close_block(struct spell *spell, unsigned indent, uint8_t kind, ir_ref next)
{
    spell_open_line(spell, indent, next ? ir_get(spell->shader->graph, next)->origin : 0);
    spell_text(spell, kind == EFFECT_END ? "}\n" : next ? "} else if (" : "} else {\n");
    if (!next)
        return;
    spell_expression(spell, next, LANG_PREC_ASSIGN);
    spell_text(spell, ") {\n");
}

static void write_blocks(struct spell *spell, const struct effect_list *list, unsigned indent)
{
    VEC(uint32_t) blocks = {0};
    const bool *chained = find_chains(spell, list);
    for (uint32_t i = 0; i < list->len; i++) {
        const struct effect *effect = &list->items[i];
        uint8_t kind = effect->kind;
        if (kind == EFFECT_END && chained[i])
            continue;
        if (kind == EFFECT_IF && holds_one_statement(spell, list, i)) {
            spell_if(spell, indent, effect->value, false);
            spell_effect(spell, indent + 1, &list->items[i + 1]);
            i += 2;
            continue;
        }
        if (kind == EFFECT_END || kind == EFFECT_ELSE) {
            names_close_block(&spell->names, vec_pop(&blocks));
            close_block(spell, --indent, kind, chained[i] ? list->items[++i].value : 0);
        } else if (kind == EFFECT_IF) {
            spell_if(spell, indent, effect->value, true);
        } else {
            spell_effect(spell, indent, effect);
        }
        if (opens_block(kind)) {
            vec_push(spell->scratch, &blocks, names_open_block(&spell->names));
            indent++;
        }
    }
    assert(blocks.len == 0);
}

void spell_statements(struct spell *spell, const struct effect_list *statements, unsigned indent)
{
    spell->let_names.len = 0;
    spell->loop_index = NULL;
    spell_plan_locals(spell, statements);
    write_blocks(spell, statements, indent);
    for (uint32_t i = 0; i < statements->len; i++)
        if (statements->items[i].kind == EFFECT_LET)
            spell->local_of[statements->items[i].value] = 0;
}
