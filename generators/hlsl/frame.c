// SPDX-License-Identifier: Apache-2.0
/*
 * The frame of an HLSL stage: constant buffers, textures with their samplers, main with its
 * semantics.
 *
 * Registers have the numbers of Vulkan's bindings: b0 to b2 are buffers, and each texture tN has
 * the sampler sN, so that hosts of both APIs bind by one number.
 */
#include "generators/hlsl/hlsl.h"

/* "[[vk::binding(3, 0)]] ", if the option asks for it. */
static void write_binding(struct spell *spell, uint32_t binding, uint32_t set)
{
    if (spell->options->vulkan_attributes)
        text_fmt(spell->out, "[[vk::binding(%u, %u)]] ", (unsigned)binding, (unsigned)set);
}

static void write_location(struct spell *spell, uint32_t location)
{
    if (spell->options->vulkan_attributes)
        text_fmt(spell->out, "[[vk::location(%u)]] ", (unsigned)location);
}

/* Writes the variable under its own name. */
static void write_variable(struct spell *spell, const struct shader_variable *variable)
{
    spell_declare(spell, PHRASE_PLAIN, variable,
                  spell_name_of(spell->shader->strings, variable->name));
}

/* ---- Buffers ---- */

static void write_member(struct spell *spell, const struct shader_variable *variable)
{
    spell_indent(spell, 1);
    if (ir_type_is_matrix(variable->type))
        spell_text(spell, "row_major ");
    write_variable(spell, variable);
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
        write_member(spell, variable);
        text_fmt(spell->out, " : packoffset(c%u", (unsigned)variable->offset / 16);
        if (component)
            text_fmt(spell->out, ".%c", "xyzw"[component]);
        spell_text(spell, ");\n");
    }
    spell_text(spell, "};\n");
}

static void write_buffers(struct spell *spell)
{
    for (int block = 0; block < NUM_BLOCKS; block++)
        if (shader_block_has_uniforms((enum shader_block)block))
            write_buffer(spell, (enum shader_block)block);
}

static void write_lights(struct spell *spell)
{
    if (!spell->stage->has_lights)
        return;
    const char *type = spell_frame_name(spell, "LightData");
    SPELL(spell, "struct ", type, " {\n");
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_LIGHT_DATA)
    {
        write_member(spell, spell_interface_variable(spell, i));
        spell_text(spell, ";\n");
    }
    spell_text(spell, "};\n");
    open_buffer(spell, BLOCK_LIGHT_DATA, "LightData_block");
    text_fmt(spell->out, "    %s %s[%u];\n};\n", type, spell_frame_name(spell, "u_lightData"),
             (unsigned)spell->shader->interface.max_lights);
}

static void write_textures(struct spell *spell)
{
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_TEXTURES)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        if (!spell_uses(spell, variable))
            continue;
        write_binding(spell, variable->binding, variable->set);
        write_variable(spell, variable);
        text_fmt(spell->out, " : register(t%u);\n", (unsigned)variable->binding);
        write_binding(spell, variable->binding, variable->set);
        SPELL(spell, "SamplerState ", str_text(spell->shader->strings, variable->name),
              LANG_SAMPLER_SUFFIX);
        text_fmt(spell->out, " : register(s%u);\n", (unsigned)variable->binding);
    }
}

/* ---- Stage inputs and outputs ---- */

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

/*
 * Semantics ignore case. Of two properties that differ only in case, the later one gets a number.
 */
static void write_semantic(struct spell *spell, uint32_t place)
{
    const struct shader_variable *variable = spell_interface_variable(spell, place);
    const char *semantic = semantic_from(spell, variable);
    bool is_taken = false;
    for (uint32_t i = spell->shader->interface.first_of_block[BLOCK_APP_DATA];
         i < place && !is_taken; i++)
        is_taken = !strcmp(semantic_from(spell, spell_interface_variable(spell, i)), semantic);
    if (is_taken)
        text_fmt(spell->out, "ATTRIBUTE%u", (unsigned)variable->location);
    else
        spell_text(spell, semantic);
}

/* Both stages declare the whole struct, also members that they do not read, so that they match. */
static void write_vertex_data(struct spell *spell)
{
    SPELL(spell, "struct ", spell_frame_name(spell, "VertexData"),
          " {\n    float4 position : SV_Position;\n");
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_VERTEX_DATA)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        spell_indent(spell, 1);
        write_location(spell, variable->location);
        spell_text(spell, variable->flat ? "nointerpolation " : "");
        write_variable(spell, variable);
        text_fmt(spell->out, " : TEXCOORD%u;\n", (unsigned)variable->location);
    }
    spell_text(spell, "};\n");
}

static bool reads_vertex_data(const struct spell *spell)
{
    return spell->stage_id == STAGE_VERTEX || spell_uses_block(spell, BLOCK_VERTEX_DATA);
}

/* True for a function of other code, which sets the vertex data. */
static bool is_called(const struct spell *spell)
{
    return spell->shader->role->stages == STAGES_NONE;
}

/*
 * Functions may read vertex data, which is otherwise a parameter of main. Then main copies between
 * its parameter and a variable at file scope.
 */
static bool shares_vertex_data(const struct spell *spell)
{
    bool shares = is_called(spell) || spell_functions_read_vertex_data(spell);
    return shares && reads_vertex_data(spell);
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

static void declare_structs(struct spell *spell)
{
    spell_structs(spell);
    for (uint32_t i = 0; i < spell->stage->reach.user_types.len; i++)
        spell_name_maker(spell, spell->stage->reach.user_types.items[i]);
}

static void declare_for_function(struct spell *spell)
{
    declare_structs(spell);
    write_buffers(spell);
    write_textures(spell);
}

static void declare(struct spell *spell)
{
    const char *version =
        spell->options->version ? spell->options->version : spell->target->versions[0];
    spell_text(spell, "// ");
    spell_title(spell);
    SPELL(spell, "\n// shader model ", version, "\n\n");
    declare_structs(spell);
    write_buffers(spell);
    write_lights(spell);
    write_textures(spell);
    if (reads_vertex_data(spell))
        write_vertex_data(spell);
    if (shares_vertex_data(spell))
        SPELL(spell, "static ", spell_frame_name(spell, "VertexData"), " ",
              spell_frame_name(spell, "vd"), ";\n");
    if (is_called(spell))
        write_results(spell);
}

/* ---- Main ---- */

/* Each parameter of main has its own line. */
static void begin_parameter(struct spell *spell, bool *is_first)
{
    spell_text(spell, *is_first ? "\n    " : ",\n    ");
    *is_first = false;
}

static void write_parameters(struct spell *spell, enum shader_block block, bool *is_first)
{
    SPELL_EACH_OF_BLOCK(i, spell, block)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        if (!spell_uses(spell, variable))
            continue;
        begin_parameter(spell, is_first);
        write_location(spell, variable->location);
        spell_text(spell, block == BLOCK_OUTPUTS ? "out " : "");
        write_variable(spell, variable);
        if (block == BLOCK_OUTPUTS) {
            text_fmt(spell->out, " : SV_Target%u", (unsigned)variable->location);
        } else {
            spell_text(spell, " : ");
            write_semantic(spell, i);
        }
    }
}

static void open_main(struct spell *spell)
{
    if (is_called(spell)) {
        SPELL(spell, "void ", spell_frame_name(spell, spell->shader->role->entry), "()\n{\n");
        return;
    }
    const char *vd = spell_frame_name(spell, "vd");
    bool is_pixel = spell->stage_id == STAGE_PIXEL, shares = shares_vertex_data(spell),
         is_first = true;
    spell_text(spell, "void main(");
    if (!is_pixel)
        write_parameters(spell, BLOCK_APP_DATA, &is_first);
    if (reads_vertex_data(spell)) {
        begin_parameter(spell, &is_first);
        SPELL(spell, is_pixel ? "" : "out ", spell_frame_name(spell, "VertexData"), " ",
              !shares    ? vd
              : is_pixel ? "vd_in"
                         : "vd_out");
    }
    if (is_pixel)
        write_parameters(spell, BLOCK_OUTPUTS, &is_first);
    spell_text(spell, ")\n{\n");
    if (is_pixel && shares)
        SPELL(spell, "    ", vd, " = vd_in;\n");
}

static void close_main(struct spell *spell)
{
    if (spell->stage_id == STAGE_VERTEX && shares_vertex_data(spell))
        SPELL(spell, "    vd_out = ", spell_frame_name(spell, "vd"), ";\n");
    spell_text(spell, "}\n");
}

const struct target_frame hlsl_frame = {.declare = declare,
                                        .open = open_main,
                                        .close = close_main,
                                        .declare_for_function = declare_for_function};
