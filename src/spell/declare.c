// SPDX-License-Identifier: Apache-2.0
/*
 * What stands above the functions: structs, uniforms, textures, and what comes into the stage and
 * goes out.
 */
#include "spell/spell.h"

/* Loops over the places in the interface of a block's variables. */
#define EACH_OF_BLOCK(i, spell, block) \
    for (uint32_t i = (spell)->shader->first_of_block[block]; \
         i < (spell)->shader->first_of_block[(block) + 1]; i++)

static struct spell_name prefixed(struct spell *spell, const char *prefix, struct spell_name name)
{
    struct text text;
    text_init(&text, spell->scratch);
    text_str(&text, prefix);
    text_mem(&text, name.text, name.len);
    return (struct spell_name){text_cstr(&text), text.len};
}

static const struct shader_variable *interface_variable(const struct spell *spell, uint32_t i)
{
    return &spell->shader->variables.items[spell->shader->interface.items[i]];
}

static struct spell_name variable_name(const struct spell *spell,
                                       const struct shader_variable *variable)
{
    return spell_name_of(spell->shader->strings, variable->name);
}

static bool stage_reads(const struct spell *spell, const struct shader_variable *variable)
{
    return variable->stages >> spell->stage_id & 1;
}

/* ---- Names ---- */

void spell_name_interface(struct spell *spell)
{
    names_take_frame(&spell->names);
    bool io_block = spell_can(spell, CAP_BLOCK_STAGE_IO);
    for (uint32_t i = 0; i < spell->shader->interface.len; i++) {
        const struct shader_variable *variable = interface_variable(spell, i);
        struct spell_name name = variable_name(spell, variable);
        if (variable->block == BLOCK_VERTEX_DATA)
            name = prefixed(spell, io_block ? "vd." : "vd_", name);
        spell->variables[spell->shader->interface.items[i]] = name;
        bool declared = spell->blocks || stage_reads(spell, variable);
        if (declared && variable->block != BLOCK_LIGHT_DATA
            && !(variable->block == BLOCK_VERTEX_DATA && io_block))
            names_take(&spell->names, name.text, name.len);
    }
}

/* ---- Declarations ---- */

static void declare(struct spell *spell, const struct shader_variable *variable,
                    struct spell_name name)
{
    spell_variable(spell, variable->type, name);
    if (variable->array_length) {
        text_char(spell->out, '[');
        text_u32(spell->out, variable->array_length);
        text_char(spell->out, ']');
    }
}

/* Does this stage use a variable of the block? */
static bool needs_block(const struct spell *spell, enum shader_block block)
{
    EACH_OF_BLOCK(i, spell, block)
    if (stage_reads(spell, interface_variable(spell, i)))
        return true;
    return false;
}

/* "layout(set = 0, binding = 1, std140) ", as far as the target can; nothing where neither is asked
 * for. */
static void write_layout(struct spell *spell, uint32_t set, uint32_t binding, bool std140)
{
    if (!spell_can(spell, CAP_BINDINGS)) {
        spell_text(spell, std140 ? "layout(std140) " : "");
        return;
    }
    spell_text(spell, "layout(");
    if (spell_can(spell, CAP_SETS)) {
        spell_text(spell, "set = ");
        spell_number(spell, set);
        spell_text(spell, ", ");
    }
    spell_text(spell, "binding = ");
    spell_number(spell, binding);
    spell_text(spell, std140 ? ", std140) " : ") ");
}

static void write_location(struct spell *spell, uint32_t location)
{
    if (!spell_can(spell, CAP_BINDINGS))
        return;
    spell_text(spell, "layout(location = ");
    spell_number(spell, location);
    spell_text(spell, ") ");
}

static void write_members(struct spell *spell, enum shader_block block)
{
    EACH_OF_BLOCK(i, spell, block)
    {
        const struct shader_variable *variable = interface_variable(spell, i);
        spell_indent(spell, 1);
        if (variable->flat && !spell->shader->scatters)
            spell_text(spell, "flat ");
        declare(spell, variable, variable_name(spell, variable));
        spell_text(spell, ";\n");
    }
}

/* Blocks are declared whole in every stage that reads a member: their layout is shared. */
static void write_uniform_block(struct spell *spell, enum shader_block block)
{
    const struct shader_buffer *buffer = &spell->shader->buffers[block];
    write_layout(spell, buffer->set, buffer->binding, true);
    SPELL(spell, "uniform ", shader_block_name(block), " {\n");
    write_members(spell, block);
    spell_text(spell, "};\n");
}

static void write_uniform(struct spell *spell, const struct shader_variable *variable)
{
    spell_text(spell, "uniform ");
    declare(spell, variable, variable_name(spell, variable));
    bool fixed = variable->block == BLOCK_PRIVATE_UNIFORMS || !spell->options->neutral_names;
    if (variable->has_default && variable->block != BLOCK_TEXTURES && fixed
        && spell_can(spell, CAP_UNIFORM_DEFAULTS)) {
        spell_text(spell, " = ");
        lang_print_value(spell->style, spell->shader->strings, variable->value.type,
                         variable->value.w, LANG_PREC_COMMA, spell->out);
    }
    spell_text(spell, ";\n");
}

static void write_uniforms(struct spell *spell, enum shader_block block)
{
    if (!needs_block(spell, block))
        return;
    if (spell->blocks) {
        write_uniform_block(spell, block);
        return;
    }
    EACH_OF_BLOCK(i, spell, block)
    if (stage_reads(spell, interface_variable(spell, i)))
        write_uniform(spell, interface_variable(spell, i));
}

static void write_light_data(struct spell *spell)
{
    if (!spell->stage->has_lights)
        return;
    const struct shader_buffer *buffer = &spell->shader->buffers[BLOCK_LIGHT_DATA];
    spell_text(spell, "struct LightData {\n");
    write_members(spell, BLOCK_LIGHT_DATA);
    spell_text(spell, "};\n");
    if (spell->blocks)
        write_layout(spell, buffer->set, buffer->binding, true);
    spell_text(spell, spell->blocks ? "uniform LightData_block { LightData u_lightData["
                                    : "uniform LightData u_lightData[");
    spell_number(spell, spell->shader->max_lights);
    spell_text(spell, spell->blocks ? "]; };\n" : "];\n");
}

static void write_textures(struct spell *spell)
{
    EACH_OF_BLOCK(i, spell, BLOCK_TEXTURES)
    {
        const struct shader_variable *variable = interface_variable(spell, i);
        if (!stage_reads(spell, variable))
            continue;
        write_layout(spell, variable->set, variable->binding, false);
        write_uniform(spell, variable);
    }
}

static void write_attributes(struct spell *spell, enum shader_block block, const char *qualifier)
{
    EACH_OF_BLOCK(i, spell, block)
    {
        const struct shader_variable *variable = interface_variable(spell, i);
        if (!stage_reads(spell, variable))
            continue;
        if (*qualifier)
            write_location(spell, variable->location);
        if (variable->flat)
            spell_text(spell, "flat ");
        spell_text(spell, qualifier);
        declare(spell, variable, spell->variables[spell->shader->interface.items[i]]);
        spell_text(spell, ";\n");
    }
}

static void write_vertex_data(struct spell *spell)
{
    const char *qualifier = spell->stage_id == STAGE_VERTEX ? "out " : "in ";
    if (!needs_block(spell, BLOCK_VERTEX_DATA))
        return;
    if (spell->shader->scatters) {
        spell_text(spell, "struct VertexData {\n");
        write_members(spell, BLOCK_VERTEX_DATA);
        spell_text(spell, "};\nVertexData vd;\n");
        return;
    }
    if (!spell_can(spell, CAP_BLOCK_STAGE_IO)) {
        write_attributes(spell, BLOCK_VERTEX_DATA, qualifier);
        return;
    }
    write_location(spell, 0);
    SPELL(spell, qualifier, "VertexData {\n");
    write_members(spell, BLOCK_VERTEX_DATA);
    spell_text(spell, "} vd;\n");
}

static void write_structs(struct spell *spell)
{
    const struct lang_reach *reach = &spell->stage->reach;
    for (uint32_t i = 0; i < reach->user_types.len; i++)
        lang_print_struct(spell->style, &spell->lang_names, spell->shader->unit,
                          reach->user_types.items[i], spell->out);
}

void spell_interface(struct spell *spell)
{
    write_structs(spell);
    write_uniforms(spell, BLOCK_PUBLIC_UNIFORMS);
    write_uniforms(spell, BLOCK_PRIVATE_UNIFORMS);
    write_light_data(spell);
    write_textures(spell);
    if (spell->stage_id == STAGE_VERTEX)
        write_attributes(spell, BLOCK_APP_DATA, "in ");
    write_vertex_data(spell);
    if (spell->stage_id == STAGE_PIXEL)
        write_attributes(spell, BLOCK_OUTPUTS, spell->shader->scatters ? "" : "out ");
}
