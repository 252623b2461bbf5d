// SPDX-License-Identifier: Apache-2.0
/*
 * The frame of a WGSL stage: a struct and a variable for each block of uniforms, a texture and its
 * sampler with a binding each, main with its inputs and outputs.
 */
#include "generators/wgsl/wgsl.h"

static struct spell_name own_name(const struct spell *spell, const struct shader_variable *variable)
{
    return spell_name_of(spell->shader->strings, variable->name);
}

/* "@group(0) @binding(3) " */
static void write_binding(struct spell *spell, uint32_t set, uint32_t binding)
{
    text_fmt(spell->out, "@group(%u) @binding(%u) ", (unsigned)set, (unsigned)binding);
}

/* ---- Uniforms ---- */

static void write_members(struct spell *spell, enum shader_block block)
{
    SPELL_EACH_OF_BLOCK(i, spell, block)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        bool is_first = i == spell->shader->interface.first_of_block[block];
        spell_indent(spell, 1);
        /* the size of an element of an array of uniforms is a multiple of its alignment */
        spell_text(spell, is_first && block == BLOCK_LIGHT_DATA ? "@align(16) " : "");
        spell_declare(spell, PHRASE_MEMBER, variable, own_name(spell, variable));
        spell_text(spell, "\n");
    }
}

static void write_buffer(struct spell *spell, enum shader_block block)
{
    const struct shader_buffer *buffer = &spell->shader->interface.buffers[block];
    const char *type = spell_frame_name(spell, shader_block_name(spell->shader, block));
    if (!spell_uses_block(spell, block))
        return;
    SPELL(spell, "struct ", type, " {\n");
    write_members(spell, block);
    spell_text(spell, "}\n");
    write_binding(spell, buffer->set, buffer->binding);
    SPELL(spell, "var<uniform> ", spell_instance(spell, block), ": ", type, ";\n");
}

static void write_lights(struct spell *spell)
{
    if (!spell_has_light_data(spell))
        return;
    const struct shader_buffer *buffer = &spell->shader->interface.buffers[BLOCK_LIGHT_DATA];
    const char *type = spell_frame_name(spell, "LightData");
    SPELL(spell, "struct ", type, " {\n");
    write_members(spell, BLOCK_LIGHT_DATA);
    spell_text(spell, "}\n");
    write_binding(spell, buffer->set, buffer->binding);
    text_fmt(spell->out, "var<uniform> %s: array<%s, %u>;\n",
             spell_frame_name(spell, "u_lightData"), type,
             (unsigned)spell->shader->interface.max_lights);
}

static void write_textures(struct spell *spell)
{
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_TEXTURES)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        if (!spell_uses(spell, variable))
            continue;
        write_binding(spell, variable->set, variable->binding);
        spell_text(spell, "var ");
        spell_declare(spell, PHRASE_PLAIN, variable, own_name(spell, variable));
        spell_text(spell, ";\n");
        write_binding(spell, variable->set, variable->sampler_binding);
        SPELL(spell, "var ", own_name(spell, variable).text, LANG_SAMPLER_SUFFIX ": sampler;\n");
    }
}

/* ---- Images and buffers of programs ---- */

static void write_frame_struct(struct spell *spell, const struct deferred_resource *frame)
{
    spell_text(spell, "struct MxFrame {\n");
    for (uint32_t i = 0; i < frame->num_members; i++)
        SPELL(spell, "    ", frame->members[i].name, ": ",
              lang_syntax_type(spell->style->syntax, spell_member_type(&frame->members[i])), ",\n");
    spell_text(spell, "}\n");
}

static void write_resources(struct spell *spell)
{
    SPELL_EACH_RESOURCE(r, spell)
    {
        bool is_frame = strcmp(r.resource->kind, "uniform") == 0;
        const char *space = is_frame                   ? "var<uniform> " SPELL_FRAME_INSTANCE
                            : !r.resource->num_members ? "var mx_"
                            : r.access & SPELL_WRITES  ? "var<storage, read_write> mx_"
                                                       : "var<storage, read> mx_";
        if (is_frame)
            write_frame_struct(spell, r.resource);
        write_binding(spell, r.set, r.binding);
        SPELL(spell, space, is_frame ? "" : r.resource->name, ": ", spell_image(spell, &r)->type,
              ";\n");
    }
}

/* ---- Stage inputs and outputs ---- */

static void write_located(struct spell *spell, const struct shader_variable *variable)
{
    text_fmt(spell->out, "@location(%u) ", (unsigned)variable->location);
    spell_text(spell, variable->flat ? "@interpolate(flat) " : "");
    spell_declare(spell, PHRASE_PLAIN, variable, own_name(spell, variable));
}

/* Both stages declare the whole struct, also members that they do not read, so that they match. */
static void write_vertex_data(struct spell *spell)
{
    bool agrees = spell->stage_id == STAGE_VERTEX && spell->shader->role->stages == STAGES_OF_PASS;
    SPELL(spell, "struct ", spell_frame_name(spell, "VertexData"), " {\n    ",
          agrees ? "@invariant " : "", "@builtin(position) position: vec4f,\n");
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_VERTEX_DATA)
    {
        spell_indent(spell, 1);
        write_located(spell, spell_interface_variable(spell, i));
        spell_text(spell, ",\n");
    }
    spell_text(spell, "}\n");
}

static uint32_t num_outputs(const struct spell *spell)
{
    const uint32_t *first = &spell->shader->interface.first_of_block[BLOCK_OUTPUTS];
    return spell->stage_id == STAGE_PIXEL ? first[1] - first[0] : 0;
}

/* True for a main whose two outputs are the sources of one blend. */
static bool blends_sources(const struct spell *spell)
{
    return spell->shader->has_two_sources && !spell_is_called(spell) && num_outputs(spell) > 0;
}

/* The struct of several outputs; a single one is the result of main. */
static void write_outputs(struct spell *spell)
{
    spell_text(spell, "struct PixelOutputs {\n");
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_OUTPUTS)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        spell_indent(spell, 1);
        if (blends_sources(spell))
            spell_text(spell,
                       shader_is_second_source(variable) ? "@blend_src(1) " : "@blend_src(0) ");
        write_located(spell, variable);
        spell_text(spell, ",\n");
    }
    spell_text(spell, "}\n");
}

/* The outputs as variables, of the module or of main. */
static void write_results(struct spell *spell, enum lang_phrase phrase, unsigned indent)
{
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_OUTPUTS)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        spell_indent(spell, indent);
        spell_declare(spell, phrase, variable, own_name(spell, variable));
        spell_text(spell, ";\n");
    }
}

static void declare_for_function(struct spell *spell)
{
    spell_structs(spell);
    spell_uniform_blocks(spell, write_buffer);
    write_textures(spell);
}

static void declare(struct spell *spell)
{
    spell_text(spell, "// ");
    spell_title(spell);
    SPELL(spell, "\n", spell->half_style ? "enable f16;\n" : "",
          blends_sources(spell) ? "enable dual_source_blending;\n" : "", "\n");
    spell_structs(spell);
    spell_uniform_blocks(spell, write_buffer);
    write_lights(spell);
    write_textures(spell);
    write_resources(spell);
    if (spell_reads_vertex_data(spell))
        write_vertex_data(spell);
    if (spell_shares_vertex_data(spell))
        SPELL(spell, "var<private> ", spell_frame_name(spell, "vd"), ": ",
              spell_frame_name(spell, "VertexData"), ";\n");
    if (spell_is_called(spell))
        write_results(spell, PHRASE_VARIABLE, 0);
    else if (num_outputs(spell) > 1)
        write_outputs(spell);
}

/* ---- Main ---- */

static void open_vertex(struct spell *spell)
{
    const char *type = spell_frame_name(spell, "VertexData"), *vd = spell_frame_name(spell, "vd"),
               *between = "";
    spell_text(spell, "@vertex\nfn main(");
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_APP_DATA)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        if (!spell_uses(spell, variable))
            continue;
        SPELL(spell, between, "\n    ");
        text_fmt(spell->out, "@location(%u) ", (unsigned)variable->location);
        spell_declare(spell, PHRASE_PLAIN, variable, own_name(spell, variable));
        between = ",";
    }
    SPELL(spell, ") -> ", type, "\n{\n");
    if (!spell_shares_vertex_data(spell))
        SPELL(spell, "    var ", vd, ": ", type, ";\n");
}

/* Hidden fragments must not write images: WGSL cannot ask for the depth test before the shader. */
static void test_depth(struct spell *spell)
{
    SPELL_EACH_RESOURCE(r, spell)
    if (r.binding == RESOURCE_DEPTH)
        SPELL(spell, "    if (textureLoad(mx_depth, vec2i(", spell_frame_name(spell, "vd"),
              ".position.xy), 0).x != ", spell_frame_name(spell, "vd"),
              ".position.z) {\n        discard;\n    }\n");
}

static void open_pixel(struct spell *spell)
{
    bool shares = spell_shares_vertex_data(spell);
    const char *vd = spell_frame_name(spell, "vd");
    spell_text(spell, "@fragment\nfn main(");
    if (spell_reads_vertex_data(spell))
        SPELL(spell, shares ? "vd_in" : vd, ": ", spell_frame_name(spell, "VertexData"));
    spell_text(spell, num_outputs(spell) > 1   ? ") -> PixelOutputs"
                      : num_outputs(spell) > 0 ? ") -> @location(0) "
                                               : ")");
    if (num_outputs(spell) == 1)
        spell_type(spell, spell_interface_variable(
                              spell, spell->shader->interface.first_of_block[BLOCK_OUTPUTS])
                              ->type);
    spell_text(spell, "\n{\n");
    if (shares)
        SPELL(spell, "    ", vd, " = vd_in;\n");
    test_depth(spell);
    write_results(spell, PHRASE_LOCAL, 1);
}

static void open_main(struct spell *spell)
{
    if (spell_is_called(spell))
        SPELL(spell, "fn ", spell_frame_name(spell, spell->shader->role->entry), "()\n{\n");
    else if (spell->stage_id == STAGE_VERTEX)
        open_vertex(spell);
    else
        open_pixel(spell);
}

static void return_outputs(struct spell *spell)
{
    const char *between = num_outputs(spell) > 1 ? "PixelOutputs(" : "";
    spell_text(spell, "    return ");
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_OUTPUTS)
    {
        SPELL(spell, between, own_name(spell, spell_interface_variable(spell, i)).text);
        between = ", ";
    }
    spell_text(spell, num_outputs(spell) > 1 ? ");\n" : ";\n");
}

static void close_main(struct spell *spell)
{
    if (!spell_is_called(spell) && spell->stage_id == STAGE_VERTEX)
        SPELL(spell, "    return ", spell_frame_name(spell, "vd"), ";\n");
    else if (!spell_is_called(spell) && num_outputs(spell))
        return_outputs(spell);
    spell_text(spell, "}\n");
}

static void close_context(struct spell *spell)
{
    if (spell->shader->sources.pass.runs)
        text_fmt(spell->out,
                 "\n@compute @workgroup_size(%d, %d)\n"
                 "fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) "
                 "place: vec3u)\n"
                 "{\n    mx_run(group.xy, place.xy);\n}\n",
                 DEFERRED_TILE, DEFERRED_TILE);
    wgsl_add_numbers(spell);
}

const struct target_frame wgsl_frame = {.declare = declare,
                                        .open = open_main,
                                        .close = close_main,
                                        .close_context = close_context,
                                        .declare_for_function = declare_for_function};
