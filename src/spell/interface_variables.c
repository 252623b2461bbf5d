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
    return shader_interface_variable(spell->shader, place);
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

const char *spell_instance(const struct spell *spell, enum shader_block block)
{
    const char *const *instances = spell->target->instances;
    if (!instances || (block < BLOCK_OWN && !instances[block]))
        return NULL;
    if (block < BLOCK_OWN)
        return spell_frame_name(spell, instances[block]);
    struct text text;
    text_init(&text, spell->scratch);
    text_fmt(&text, "u_%s", shader_block_name(spell->shader, block));
    return spell_frame_name(spell, text_cstr(&text));
}

/* The text before the names of a block's variables; it ends with '.' if they are members. */
static const char *member_prefix(struct spell *spell, enum shader_block block)
{
    bool is_in_host_file = spell->shader->role->is_in_host_file;
    if (is_in_host_file && block == BLOCK_OUTPUTS)
        return "result.";
    if (is_in_host_file && block == BLOCK_VERTEX_DATA && !spell->shares_vertex_data)
        return "";
    const char *instance = spell_instance(spell, block);
    if (block == BLOCK_LIGHT_DATA || (!instance && block != BLOCK_VERTEX_DATA))
        return "";
    struct text text;
    bool is_member = instance || spell_can(spell, CAP_BLOCK_STAGE_IO) || is_in_host_file;
    text_init(&text, spell->scratch);
    text_fmt(&text, "%s%c", instance ? instance : spell_frame_name(spell, "vd"),
             is_member ? '.' : '_');
    return text_cstr(&text);
}

/* The others are reserved words of the language. */
static void take_own_instances(struct spell *spell)
{
    for (int i = 0; spell->target->instances && i < MAX_OWN_BLOCKS; i++) {
        const char *name = spell_instance(spell, (enum shader_block)(BLOCK_OWN + i));
        if (spell->shader->interface.own_blocks[i])
            names_take(&spell->names, name, strlen(name));
    }
}

void spell_name_interface(struct spell *spell)
{
    names_take_frame(&spell->names, spell->shader);
    take_own_instances(spell);
    const char *prefixes[NUM_BLOCKS];
    for (int block = 0; block < NUM_BLOCKS; block++)
        prefixes[block] = member_prefix(spell, (enum shader_block)block);
    for (uint32_t i = 0; i < spell->shader->interface.used.len; i++) {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        struct spell_name name = variable_name(spell, variable);
        const char *prefix = prefixes[variable->block];
        if (spell->shader->role->is_in_host_file && variable->block == BLOCK_VERTEX_DATA)
            names_take(&spell->names, name.text, name.len); /* of a parameter */
        if (*prefix)
            name = prefixed(spell, prefix, name);
        spell->variables[spell->shader->interface.used.items[i]] = name;
        bool declared = spell->shader->interface.rules.blocks || spell_uses(spell, variable),
             is_member = variable->block == BLOCK_LIGHT_DATA || strchr(prefix, '.');
        if (declared && !is_member)
            names_take(&spell->names, name.text, name.len);
    }
    for (uint32_t i = 0; i < spell->shader->interface.variables.len; i++)
        if (spell->shader->interface.variables.items[i].is_hosts)
            spell->variables[i] =
                variable_name(spell, &spell->shader->interface.variables.items[i]);
}

bool spell_functions_read_vertex_data(const struct spell *spell)
{
    const struct lang_reach *reach = &spell->stage->reach;
    const uint32_t *of_block = &spell->shader->interface.first_of_block[BLOCK_VERTEX_DATA];
    bool reads = spell->stage->functions.len > 0;
    for (uint32_t i = 0; i < reach->globals.len && !reads; i++)
        reads = lang_global(spell->shader->unit, reach->globals.items[i], NULL)->kind
                == LANG_GLOBAL_STREAM;
    for (uint32_t i = 0; i < spell->stage->verbatim.len && !reads; i++)
        reads = spell->shader->sources.calls.items[spell->stage->verbatim.items[i]].num_sources > 0;
    return spell_reads_position(spell) || (reads && of_block[0] < of_block[1]);
}

bool spell_is_called(const struct spell *spell)
{
    return spell->shader->role->stages == STAGES_NONE;
}

bool spell_reads_vertex_data(const struct spell *spell)
{
    return spell->stage_id == STAGE_VERTEX || spell_uses_block(spell, BLOCK_VERTEX_DATA)
           || spell_reads_position(spell);
}

bool spell_shares_vertex_data(const struct spell *spell)
{
    bool shares = spell_is_called(spell) || spell_functions_read_vertex_data(spell);
    return shares && spell_reads_vertex_data(spell);
}

/* ---- Declarations ---- */

void spell_uniform_blocks(struct spell *spell,
                          void (*write)(struct spell *spell, enum shader_block block))
{
    for (int block = 0; block < NUM_BLOCKS; block++)
        if (shader_block_has_uniforms((enum shader_block)block))
            write(spell, (enum shader_block)block);
}

void spell_declare(struct spell *spell, enum lang_phrase phrase,
                   const struct shader_variable *variable, struct spell_name name)
{
    struct lang_type_text type = spell_type_text(spell, variable->type);
    if (variable->array_length)
        type.length = variable->array_length;
    const char *block_type = shader_block_type(spell->shader, spell->style->syntax, variable);
    if (block_type)
        type.name = lang_word(block_type);
    if (spell_is_half_variable(spell, variable))
        type.name = spell_half_type(spell, variable->type);
    (void)lang_open(spell->style, phrase, type, spell_word(name), spell->out);
}

/* True if this stage uses a variable of the block. */
bool spell_uses_block(const struct spell *spell, enum shader_block block)
{
    assert(spell->shader->interface.first_of_block[block]
           <= spell->shader->interface.first_of_block[block + 1]);
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
