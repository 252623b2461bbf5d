// SPDX-License-Identifier: Apache-2.0
/*
 * The frame of an HLSL stage: constant buffers, textures with their samplers; stage_io.c has the
 * rest.
 *
 * Registers have the numbers of Vulkan's bindings: b0 to b2 are buffers, and each texture tN has
 * the sampler sN, so that hosts of both APIs bind by one number.
 */
#include "generators/hlsl/hlsl.h"

void hlsl_vulkan_binding(struct spell *spell, uint32_t binding, uint32_t set)
{
    text_fmt(spell->out, "[[vk::binding(%u, %u)]] ", (unsigned)binding, (unsigned)set);
}

static void write_binding(struct spell *spell, uint32_t binding, uint32_t set)
{
    if (spell->options->vulkan_attributes)
        hlsl_vulkan_binding(spell, binding, set);
}

/* ---- Buffers ---- */

void hlsl_variable(struct spell *spell, const struct shader_variable *variable)
{
    spell_declare(spell, PHRASE_PLAIN, variable,
                  spell_name_of(spell->shader->strings, variable->name));
}

void hlsl_member(struct spell *spell, const struct shader_variable *variable)
{
    spell_indent(spell, 1);
    if (ir_type_is_matrix(variable->type))
        spell_text(spell, "row_major ");
    hlsl_variable(spell, variable);
}

/* "cbuffer LightData_block : register(b2)" */
static void open_buffer(struct spell *spell, enum shader_block block, const char *name)
{
    const struct shader_buffer *buffer = &spell->shader->interface.buffers[block];
    write_binding(spell, buffer->binding, buffer->set);
    SPELL(spell, "cbuffer ", spell_frame_name(spell, name));
    text_fmt(spell->out, " : register(b%u)\n{\n", (unsigned)buffer->binding);
}

/* "float3 u_viewPosition : packoffset(c4.y);" */
static void write_buffer(struct spell *spell, enum shader_block block)
{
    if (!spell_uses_block(spell, block))
        return;
    open_buffer(spell, block, shader_block_name(spell->shader, block));
    SPELL_EACH_OF_BLOCK(i, spell, block)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        unsigned component = variable->offset / 4 % 4;
        hlsl_member(spell, variable);
        text_fmt(spell->out, " : packoffset(c%u", (unsigned)variable->offset / 16);
        if (component)
            text_fmt(spell->out, ".%c", "xyzw"[component]);
        spell_text(spell, ");\n");
    }
    spell_text(spell, "};\n");
}

void hlsl_light_struct(struct spell *spell)
{
    SPELL(spell, "struct ", spell_frame_name(spell, "LightData"), " {\n");
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_LIGHT_DATA)
    {
        hlsl_member(spell, spell_interface_variable(spell, i));
        spell_text(spell, ";\n");
    }
    spell_text(spell, "};\n");
}

void hlsl_light_member(struct spell *spell)
{
    text_fmt(spell->out, "    %s %s[%u];\n", spell_frame_name(spell, "LightData"),
             spell_frame_name(spell, "u_lightData"), (unsigned)spell->shader->interface.max_lights);
}

static void write_lights(struct spell *spell)
{
    if (!spell_has_light_data(spell))
        return;
    hlsl_light_struct(spell);
    open_buffer(spell, BLOCK_LIGHT_DATA, "LightData_block");
    hlsl_light_member(spell);
    spell_text(spell, "};\n");
}

static void write_textures(struct spell *spell)
{
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_TEXTURES)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        if (!spell_uses(spell, variable))
            continue;
        write_binding(spell, variable->binding, variable->set);
        hlsl_variable(spell, variable);
        text_fmt(spell->out, " : register(t%u);\n", (unsigned)variable->binding);
        write_binding(spell, variable->binding, variable->set);
        SPELL(spell, "SamplerState ", str_text(spell->shader->strings, variable->name),
              LANG_SAMPLER_SUFFIX);
        text_fmt(spell->out, " : register(s%u);\n", (unsigned)variable->binding);
    }
}

char hlsl_resource(struct spell *spell, const struct spell_resource *r)
{
    const char *type = spell_image(spell, r)->type;
    bool is_buffer = strncmp(type, "cbuffer", strlen("cbuffer")) == 0;
    SPELL(spell, type, is_buffer ? "" : " mx_", is_buffer ? "" : r->resource->name);
    return is_buffer ? 'b' : strncmp(type, "RW", 2) == 0 ? 'u' : 't';
}

void hlsl_members(struct spell *spell, const struct spell_resource *r)
{
    bool is_buffer = strcmp(r->resource->kind, "uniform") == 0;
    spell_text(spell, is_buffer ? "\n{\n" : "");
    for (uint32_t i = 0; is_buffer && i < r->resource->num_members; i++) {
        const struct deferred_member *member = &r->resource->members[i];
        ir_type_id type = spell_member_type(member);
        SPELL(spell, ir_type_is_matrix(type) ? "    row_major " : "    ",
              lang_syntax_type(spell->style->syntax, type), " ", member->name, ";\n");
    }
    spell_text(spell, is_buffer ? "};\n" : ";\n");
}

static void write_resources(struct spell *spell)
{
    SPELL_EACH_RESOURCE(r, spell)
    {
        write_binding(spell, r.binding, r.set);
        char kind = hlsl_resource(spell, &r);
        text_fmt(spell->out, " : register(%c%u, space%u)", kind, (unsigned)r.binding,
                 (unsigned)r.set);
        hlsl_members(spell, &r);
    }
}

static void declare_structs(struct spell *spell)
{
    spell_structs(spell);
    for (uint32_t i = 0; i < spell->stage->reach.user_types.len; i++)
        spell_name_maker(spell, spell->stage->reach.user_types.items[i]);
}

static void declare_for_function(struct spell *spell)
{
    declare_structs(spell);
    spell_uniform_blocks(spell, write_buffer);
    write_textures(spell);
}

static const struct hlsl_io io = {.heads = {"void main(", "void main("}};

static void declare(struct spell *spell)
{
    spell_text(spell, "// ");
    spell_title(spell);
    SPELL(spell, "\n// shader model ", spell_version(spell), "\n\n");
    declare_structs(spell);
    spell_uniform_blocks(spell, write_buffer);
    write_lights(spell);
    write_textures(spell);
    write_resources(spell);
    hlsl_declare_io(spell, &io);
}

static void open_main(struct spell *spell)
{
    hlsl_open_main(spell, &io);
}

static void close_context(struct spell *spell)
{
    hlsl_write_run(spell, "", "main");
}

const struct target_frame hlsl_frame = {.declare = declare,
                                        .open = open_main,
                                        .close = hlsl_close_main,
                                        .close_context = close_context,
                                        .declare_for_function = declare_for_function};
