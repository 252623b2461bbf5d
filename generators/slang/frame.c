// SPDX-License-Identifier: Apache-2.0
/* The frame of a Slang stage: structs of textures, one constant buffer, main. */
#include "generators/slang/slang.h"

static const struct hlsl_io io = {
    .heads = {"[shader(\"vertex\")]\nvoid vertexMain(",
              "[shader(\"fragment\")]\nvoid fragmentMain("},
    .own_semantics = true,
    .places_sources = true,
};

/* ---- Textures ---- */

static bool uses_textures(const struct spell *spell, ir_type_id type)
{
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_TEXTURES)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        if (variable->type == type && spell_uses(spell, variable))
            return true;
    }
    return false;
}

static void write_texture_structs(struct spell *spell)
{
    static const char single[] = "struct SamplerTexture2D {\n    Texture2D tex;\n"
                                 "    SamplerState sampler;\n};\n",
                      array[] = "struct SamplerTexture2DArray {\n    Texture2DArray tex;\n"
                                "    SamplerState sampler;\n};\n";
    if (uses_textures(spell, IR_TYPE_SAMPLER))
        spell_once(spell, single, sizeof single - 1);
    if (uses_textures(spell, IR_TYPE_SAMPLER_ARRAY))
        spell_once(spell, array, sizeof array - 1);
}

/* ---- The constant buffer ---- */

static bool is_in_buffer(enum shader_block block)
{
    return block == BLOCK_TEXTURES || shader_block_has_uniforms(block);
}

static void write_members(struct spell *spell, enum shader_block block)
{
    SPELL_EACH_OF_BLOCK(i, spell, block)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        if (!spell_uses(spell, variable))
            continue;
        hlsl_member(spell, variable);
        spell_text(spell, ";\n");
    }
}

static void write_buffer(struct spell *spell)
{
    bool has_lights = spell_has_light_data(spell), is_used = has_lights;
    for (int block = 0; block < NUM_BLOCKS; block++)
        is_used |= is_in_buffer((enum shader_block)block)
                   && spell_uses_block(spell, (enum shader_block)block);
    if (!is_used)
        return;
    if (has_lights)
        hlsl_light_struct(spell);
    SPELL(spell, "cbuffer ",
          spell_frame_name(spell, spell->stage_id == STAGE_VERTEX ? "vertexCB" : "pixelCB"),
          "\n{\n");
    for (int block = 0; block < NUM_BLOCKS; block++)
        if (is_in_buffer((enum shader_block)block))
            write_members(spell, (enum shader_block)block);
    if (has_lights)
        hlsl_light_member(spell);
    spell_text(spell, "};\n");
}

static void write_resources(struct spell *spell)
{
    SPELL_EACH_RESOURCE(r, spell)
    {
        hlsl_vulkan_binding(spell, r.binding, r.set);
        (void)hlsl_resource(spell, &r);
        hlsl_members(spell, &r);
    }
}

static void declare_for_function(struct spell *spell)
{
    spell_structs(spell);
    write_texture_structs(spell);
    write_buffer(spell);
}

/* ---- Main ---- */

static void declare(struct spell *spell)
{
    spell_text(spell, "// ");
    spell_title(spell);
    SPELL(spell, "\n// Slang ", spell_version(spell), "\n\n");
    declare_for_function(spell);
    write_resources(spell);
    hlsl_declare_io(spell, &io);
}

static void open_main(struct spell *spell)
{
    hlsl_open_main(spell, &io);
}

static void close_context(struct spell *spell)
{
    hlsl_write_run(spell, "[shader(\"compute\")]\n", "computeMain");
}

const struct target_frame slang_frame = {.declare = declare,
                                         .open = open_main,
                                         .close = hlsl_close_main,
                                         .close_context = close_context,
                                         .declare_for_function = declare_for_function};
