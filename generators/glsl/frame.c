// SPDX-License-Identifier: Apache-2.0
/*
 * The frame of a GLSL stage: version and precision, loose uniforms or blocks, inputs and outputs of
 * the stage, main.
 */
#include "generators/glsl/glsl.h"

#include "spell/spell.h"

static void write_header(struct spell *spell)
{
    SPELL(spell, "#version ", spell_version(spell), "\n// ");
    spell_title(spell);
    spell_text(spell, "\n");
    if (spell_can(spell, CAP_PRECISION)
        && (spell->stage_id == STAGE_PIXEL || spell->shader->reflection.displaced))
        spell_text(spell,
                   "precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n");
    if (spell_can(spell, CAP_PRECISION) && spell->shader->interface.tiles.len)
        spell_text(spell, "precision highp sampler2DArray;\n");
    spell_text(spell, "\n");
}

/*
 * "layout(set = 0, binding = 1, std140) ", with the parts that the target has; nothing without
 * parts.
 */
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

static void write_location(struct spell *spell, enum shader_block block, uint32_t location)
{
    if (!shader_has_locations(spell->shader, block))
        return;
    spell_text(spell, "layout(location = ");
    spell_number(spell, location);
    spell_text(spell, ") ");
}

static void write_place(struct spell *spell, const struct shader_variable *variable)
{
    if (shader_is_second_source(variable))
        spell_text(spell, "layout(location = 0, index = 1) ");
    else
        write_location(spell, variable->block, variable->location);
}

static void write_members(struct spell *spell, enum shader_block block)
{
    SPELL_EACH_OF_BLOCK(i, spell, block)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        spell_indent(spell, 1);
        if (variable->flat && !spell_is_called(spell))
            spell_text(spell, "flat ");
        spell_declare(spell, PHRASE_PLAIN, variable,
                      spell_name_of(spell->shader->strings, variable->name));
        spell_text(spell, ";\n");
    }
}

/* Every stage that reads a member declares the whole block, because the stages share its layout. */
static void write_uniform_block(struct spell *spell, enum shader_block block)
{
    const struct shader_buffer *buffer = &spell->shader->interface.buffers[block];
    write_layout(spell, buffer->set, buffer->binding, true);
    SPELL(spell, "uniform ", spell_frame_name(spell, shader_block_name(spell->shader, block)),
          " {\n");
    write_members(spell, block);
    spell_text(spell, "};\n");
}

static void write_uniform(struct spell *spell, const struct shader_variable *variable)
{
    spell_text(spell, "uniform ");
    spell_declare(spell, PHRASE_PLAIN, variable,
                  spell_name_of(spell->shader->strings, variable->name));
    bool fixed =
        variable->block != BLOCK_PUBLIC_UNIFORMS || !spell->shader->interface.rules.neutral_names;
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
    if (!spell_uses_block(spell, block))
        return;
    if (spell->shader->interface.rules.blocks) {
        write_uniform_block(spell, block);
        return;
    }
    SPELL_EACH_OF_BLOCK(i, spell, block)
    if (spell_uses(spell, spell_interface_variable(spell, i)))
        write_uniform(spell, spell_interface_variable(spell, i));
}

static void write_light_data(struct spell *spell)
{
    if (!spell_has_light_data(spell))
        return;
    const struct shader_buffer *buffer = &spell->shader->interface.buffers[BLOCK_LIGHT_DATA];
    const char *type = spell_frame_name(spell, "LightData"),
               *lights = spell_frame_name(spell, "u_lightData");
    SPELL(spell, "struct ", type, " {\n");
    write_members(spell, BLOCK_LIGHT_DATA);
    spell_text(spell, "};\n");
    if (spell->shader->interface.rules.blocks) {
        write_layout(spell, buffer->set, buffer->binding, true);
        SPELL(spell, "uniform ", spell_frame_name(spell, "LightData_block"), " { ", type, " ",
              lights, "[");
    } else {
        SPELL(spell, "uniform ", type, " ", lights, "[");
    }
    spell_number(spell, spell->shader->interface.max_lights);
    spell_text(spell, spell->shader->interface.rules.blocks ? "]; };\n" : "];\n");
}

static void write_textures(struct spell *spell)
{
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_TEXTURES)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        if (!spell_uses(spell, variable))
            continue;
        write_layout(spell, variable->set, variable->binding, false);
        write_uniform(spell, variable);
    }
}

static void write_attributes(struct spell *spell, enum shader_block block, const char *qualifier)
{
    SPELL_EACH_OF_BLOCK(i, spell, block)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        if (!spell_uses(spell, variable))
            continue;
        if (*qualifier)
            write_place(spell, variable);
        if (variable->flat && *qualifier)
            spell_text(spell, "flat ");
        spell_text(spell, qualifier);
        spell_declare(spell, PHRASE_PLAIN, variable,
                      spell->variables[spell->shader->interface.used.items[i]]);
        spell_text(spell, ";\n");
    }
}

static void write_vertex_data(struct spell *spell)
{
    const char *qualifier = spell->stage_id == STAGE_VERTEX ? "out " : "in ",
               *type = spell_frame_name(spell, "VertexData");
    if (!spell_uses_block(spell, BLOCK_VERTEX_DATA))
        return;
    if (!spell_can(spell, CAP_BLOCK_STAGE_IO)) {
        write_attributes(spell, BLOCK_VERTEX_DATA, spell_is_called(spell) ? "" : qualifier);
        return;
    }
    if (spell_is_called(spell)) { /* the caller sets it */
        SPELL(spell, "struct ", type, " {\n");
        write_members(spell, BLOCK_VERTEX_DATA);
        SPELL(spell, "};\n", type, " ", spell_frame_name(spell, "vd"), ";\n");
        return;
    }
    write_location(spell, BLOCK_VERTEX_DATA, 0);
    SPELL(spell, qualifier, type, " {\n");
    write_members(spell, BLOCK_VERTEX_DATA);
    SPELL(spell, "} ", spell_frame_name(spell, "vd"), ";\n");
}

static void declare_for_function(struct spell *spell)
{
    spell_structs(spell);
    spell_uniform_blocks(spell, write_uniforms);
    write_textures(spell);
}

static void declare(struct spell *spell)
{
    write_header(spell);
    spell_structs(spell);
    spell_uniform_blocks(spell, write_uniforms);
    write_light_data(spell);
    write_textures(spell);
    if (spell->stage_id == STAGE_VERTEX)
        write_attributes(spell, BLOCK_APP_DATA, "in ");
    write_vertex_data(spell);
    if (spell->stage_id == STAGE_VERTEX && spell->shader->role->stages == STAGES_OF_PASS)
        spell_text(spell, "invariant gl_Position;\n");
    if (spell->stage_id == STAGE_PIXEL)
        write_attributes(spell, BLOCK_OUTPUTS, spell_is_called(spell) ? "" : "out ");
}

static void open_main(struct spell *spell)
{
    const char *entry = spell->shader->role->entry;
    SPELL(spell, "void ", spell_is_called(spell) ? spell_frame_name(spell, entry) : entry,
          "()\n{\n");
}

const struct target_frame glsl_frame = {
    .declare = declare, .open = open_main, .declare_for_function = declare_for_function};
