// SPDX-License-Identifier: Apache-2.0
/* Inputs and outputs of a stage of HLSL and its dialects: vertex data, semantics, main. */
#include "generators/hlsl/hlsl.h"

/* ---- Semantics ---- */

/* "NORMAL" of i_normal, "TEXCOORD0" of i_texcoord_0, "GEOMPROP_WEAR" of i_geomprop_wear. */
static const char *semantic_from(struct spell *spell, const struct shader_variable *variable)
{
    struct text text;
    text_init(&text, spell->scratch);
    const char *name = str_text(spell->shader->strings, variable->name);
    size_t prefix = strlen(spell->shader->interface.naming.prefix);
    if (strncmp(name, spell->shader->interface.naming.prefix, prefix) == 0
        && strncmp(name + prefix, "i_", 2) == 0)
        name += prefix + 2;
    for (; *name; name++) {
        bool joins_number = *name == '_' && strspn(name + 1, "0123456789") == strlen(name + 1);
        if (!joins_number)
            text_char(&text, *name >= 'a' && *name <= 'z' ? (char)(*name - 'a' + 'A') : *name);
    }
    return text_cstr(&text);
}

/* The variable itself names what no semantic of Direct3D means. */
static bool is_own(const struct shader_variable *variable, const char *semantic)
{
    return variable->block == BLOCK_VERTEX_DATA || strncmp(semantic, "GEOMPROP_", 9) == 0;
}

/*
 * Semantics ignore case. Of two variables that differ only in case, the later one gets a number.
 */
static void write_semantic(struct spell *spell, const struct hlsl_io *io, uint32_t place)
{
    const struct shader_variable *variable = spell_interface_variable(spell, place);
    const uint32_t first = spell->shader->interface.first_of_block[variable->block];
    const char *semantic = semantic_from(spell, variable);
    bool is_taken = false;
    for (uint32_t i = first; i < place && !is_taken; i++)
        is_taken = !strcmp(semantic_from(spell, spell_interface_variable(spell, i)), semantic);
    if (is_taken)
        text_fmt(spell->out, "ATTRIBUTE%u", (unsigned)(place - first));
    else
        spell_text(spell, io->own_semantics && is_own(variable, semantic)
                              ? str_text(spell->shader->strings, variable->name)
                              : semantic);
}

/* ---- Declarations ---- */

/* D3D blends with the target behind the first one, Vulkan with index 1 of the first location. */
static void write_location(struct spell *spell, const struct hlsl_io *io,
                           const struct shader_variable *variable)
{
    bool blends = variable->block == BLOCK_OUTPUTS && spell->shader->has_two_sources;
    if (!spell->options->vulkan_attributes && !(blends && io->places_sources))
        return;
    text_fmt(spell->out, "[[vk::location(%u)]] ", (unsigned)variable->location);
    if (blends)
        text_fmt(spell->out, "[[vk::index(%u)]] ", (unsigned)shader_is_second_source(variable));
}

/* Both stages declare the whole struct, also members that they do not read, so that they match. */
static void write_vertex_data(struct spell *spell, const struct hlsl_io *io)
{
    bool agrees = spell->stage_id == STAGE_VERTEX && spell->shader->role->stages == STAGES_OF_PASS;
    SPELL(spell, "struct ", spell_frame_name(spell, "VertexData"), " {\n    ",
          agrees ? "precise " : "", "float4 position : SV_Position;\n");
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_VERTEX_DATA)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        spell_indent(spell, 1);
        write_location(spell, io, variable);
        spell_text(spell, variable->flat ? "nointerpolation " : "");
        hlsl_variable(spell, variable);
        spell_text(spell, " : ");
        if (io->own_semantics)
            write_semantic(spell, io, i);
        else
            text_fmt(spell->out, "TEXCOORD%u", (unsigned)variable->location);
        spell_text(spell, ";\n");
    }
    spell_text(spell, "};\n");
}

/* The parameters of a function for path tracers. */
static void write_results(struct spell *spell)
{
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_OUTPUTS)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        spell_declare(spell, PHRASE_VARIABLE, variable,
                      spell_name_of(spell->shader->strings, variable->name));
        spell_text(spell, ";\n");
    }
}

void hlsl_declare_io(struct spell *spell, const struct hlsl_io *io)
{
    if (spell_reads_vertex_data(spell))
        write_vertex_data(spell, io);
    if (spell_shares_vertex_data(spell))
        SPELL(spell, "static ", spell_frame_name(spell, "VertexData"), " ",
              spell_frame_name(spell, "vd"), ";\n");
    if (spell_is_called(spell))
        write_results(spell);
}

/* ---- Main ---- */

/* Each parameter of main has its own line. */
static void begin_parameter(struct spell *spell, bool *is_first)
{
    spell_text(spell, *is_first ? "\n    " : ",\n    ");
    *is_first = false;
}

static void write_parameters(struct spell *spell, const struct hlsl_io *io, enum shader_block block,
                             bool *is_first)
{
    SPELL_EACH_OF_BLOCK(i, spell, block)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        if (!spell_uses(spell, variable))
            continue;
        begin_parameter(spell, is_first);
        write_location(spell, io, variable);
        spell_text(spell, block == BLOCK_OUTPUTS ? "out " : "");
        hlsl_variable(spell, variable);
        spell_text(spell, " : ");
        if (block == BLOCK_OUTPUTS)
            text_fmt(spell->out, "SV_Target%u",
                     variable->location + shader_is_second_source(variable));
        else
            write_semantic(spell, io, i);
    }
}

void hlsl_open_main(struct spell *spell, const struct hlsl_io *io)
{
    if (spell_is_called(spell)) {
        SPELL(spell, "void ", spell_frame_name(spell, spell->shader->role->entry), "()\n{\n");
        return;
    }
    const char *vd = spell_frame_name(spell, "vd");
    bool is_pixel = spell->stage_id == STAGE_PIXEL, shares = spell_shares_vertex_data(spell),
         is_first = true;
    SPELL(spell, spell_tests_early(spell) ? "[earlydepthstencil]\n" : "",
          io->heads[spell->stage_id]);
    if (!is_pixel)
        write_parameters(spell, io, BLOCK_APP_DATA, &is_first);
    if (spell_reads_vertex_data(spell)) {
        begin_parameter(spell, &is_first);
        SPELL(spell, is_pixel ? "" : "out ", spell_frame_name(spell, "VertexData"), " ",
              !shares    ? vd
              : is_pixel ? "vd_in"
                         : "vd_out");
    }
    if (is_pixel)
        write_parameters(spell, io, BLOCK_OUTPUTS, &is_first);
    spell_text(spell, ")\n{\n");
    if (is_pixel && shares)
        SPELL(spell, "    ", vd, " = vd_in;\n");
}

void hlsl_close_main(struct spell *spell)
{
    if (spell->stage_id == STAGE_VERTEX && spell_shares_vertex_data(spell))
        SPELL(spell, "    vd_out = ", spell_frame_name(spell, "vd"), ";\n");
    spell_text(spell, "}\n");
}

void hlsl_write_run(struct spell *spell, const char *attribute, const char *name)
{
    if (!spell->shader->sources.pass.runs)
        return;
    text_fmt(spell->out, "\n%s[numthreads(%d, %d, 1)]\n", attribute, DEFERRED_TILE, DEFERRED_TILE);
    SPELL(spell, "void ", name, "(uint3 group : SV_GroupID, uint3 place : SV_GroupThreadID)\n{\n",
          "    mx_run(group.xy, place.xy);\n}\n");
}
