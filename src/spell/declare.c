// SPDX-License-Identifier: Apache-2.0
/* The interface of a stage: names of variables, and the loops that frames declare them with. */
#include "spell/spell.h"

#include <assert.h>

static struct spell_name prefixed(struct spell *spell, const char *prefix, struct spell_name name)
{
    struct text text;
    text_init(&text, spell->scratch);
    text_str(&text, prefix);
    text_mem(&text, name.text, name.len);
    return (struct spell_name){text_cstr(&text), text.len};
}

const struct shader_variable *spell_interface_variable(const struct spell *spell, uint32_t place)
{
    assert(place < spell->shader->interface.len);
    return &spell->shader->variables.items[spell->shader->interface.items[place]];
}

static struct spell_name variable_name(const struct spell *spell,
                                       const struct shader_variable *variable)
{
    return spell_name_of(spell->shader->strings, variable->name);
}

bool spell_uses(const struct spell *spell, const struct shader_variable *variable)
{
    return variable->stages >> spell->stage_id & 1;
}

/* ---- Names ---- */

void spell_name_interface(struct spell *spell)
{
    names_take_frame(&spell->names, spell->shader);
    bool io_block = spell_can(spell, CAP_BLOCK_STAGE_IO);
    for (uint32_t i = 0; i < spell->shader->interface.len; i++) {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        struct spell_name name = variable_name(spell, variable);
        if (variable->block == BLOCK_VERTEX_DATA)
            name = prefixed(spell, io_block ? "vd." : "vd_", name);
        spell->variables[spell->shader->interface.items[i]] = name;
        bool declared = spell->shader->rules.blocks || spell_uses(spell, variable);
        if (declared && variable->block != BLOCK_LIGHT_DATA
            && !(variable->block == BLOCK_VERTEX_DATA && io_block))
            names_take(&spell->names, name.text, name.len);
    }
}

/* ---- Declarations ---- */

void spell_declare(struct spell *spell, const struct shader_variable *variable,
                   struct spell_name name)
{
    spell_variable(spell, variable->type, name);
    if (variable->array_length) {
        text_char(spell->out, '[');
        text_u32(spell->out, variable->array_length);
        text_char(spell->out, ']');
    }
}

/* True if this stage uses a variable of the block. */
bool spell_uses_block(const struct spell *spell, enum shader_block block)
{
    assert(spell->shader->first_of_block[block] <= spell->shader->first_of_block[block + 1]);
    SPELL_EACH_OF_BLOCK(i, spell, block)
    if (spell_uses(spell, spell_interface_variable(spell, i)))
        return true;
    return false;
}

void spell_structs(struct spell *spell)
{
    const struct lang_reach *reach = &spell->stage->reach;
    for (uint32_t i = 0; i < reach->user_types.len; i++)
        lang_print_struct(spell->style, &spell->lang_names, spell->shader->unit,
                          reach->user_types.items[i], spell->out);
}
