// SPDX-License-Identifier: Apache-2.0
/*
 * The frame of a stage of MSL: structs of what is bound, the struct that has it all as members, and
 * the function of the stage, which fills that struct.
 *
 * Bindings are those of MaterialX's generator: blocks have buffers from 0 on in the pixel stage,
 * and behind the vertex attributes in the vertex stage. Textures and samplers have one number.
 */
#include "generators/msl/msl.h"

static bool is_vertex(const struct spell *spell)
{
    return spell->stage_id == STAGE_VERTEX;
}

/* A pass that only discards has none. */
static bool has_outputs(const struct spell *spell)
{
    const uint32_t *first = &spell->shader->interface.first_of_block[BLOCK_OUTPUTS];
    return !is_vertex(spell) && first[1] > first[0];
}

static const char *entry_name(const struct spell *spell)
{
    const char *entry = spell_is_called(spell) ? spell->shader->role->entry
                        : is_vertex(spell)     ? "VertexMain"
                                               : "FragmentMain";
    return spell_frame_name(spell, entry);
}

/* ---- Structs ---- */

static void write_member(struct spell *spell, const struct shader_variable *variable)
{
    spell_indent(spell, 1);
    spell_declare(spell, PHRASE_PLAIN, variable,
                  spell_name_of(spell->shader->strings, variable->name));
}

static void open_struct(struct spell *spell, const char *name)
{
    SPELL(spell, "struct ", spell_frame_name(spell, name), " {\n");
}

static void write_block(struct spell *spell, enum shader_block block)
{
    if (!spell_uses_block(spell, block))
        return;
    open_struct(spell, shader_block_name(spell->shader, block));
    SPELL_EACH_OF_BLOCK(i, spell, block)
    {
        write_member(spell, spell_interface_variable(spell, i));
        spell_text(spell, ";\n");
    }
    spell_text(spell, "};\n");
}

/* Lights are 16 bytes or a multiple of it apart (docs/reflection.md). */
static void write_lights(struct spell *spell)
{
    const char *type = spell_frame_name(spell, "LightData");
    if (!spell_has_light_data(spell))
        return;
    SPELL(spell, "struct alignas(16) ", type, " {\n");
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_LIGHT_DATA)
    {
        write_member(spell, spell_interface_variable(spell, i));
        spell_text(spell, ";\n");
    }
    spell_text(spell, "};\n");
    open_struct(spell, "LightData_pixel");
    text_fmt(spell->out, "    %s %s[%u];\n};\n", type, spell_frame_name(spell, "u_lightData"),
             (unsigned)spell->shader->interface.max_lights);
}

static void write_textures(struct spell *spell)
{
    static const char
        plain[] = "struct MetalTexture {\n    texture2d<float> tex;\n    sampler s;\n};\n",
        array[] =
            "struct MetalTextureArray {\n    texture2d_array<float> tex;\n    sampler s;\n};\n";
    bool has[2] = {false, false};
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_TEXTURES)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        if (spell_uses(spell, variable))
            has[variable->type == IR_TYPE_SAMPLER_ARRAY] = true;
    }
    if (has[0])
        spell_once(spell, plain, sizeof plain - 1);
    if (has[1])
        spell_once(spell, array, sizeof array - 1);
}

static void write_inputs(struct spell *spell)
{
    open_struct(spell, "VertexInputs");
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_APP_DATA)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        if (!spell_uses(spell, variable))
            continue;
        write_member(spell, variable);
        text_fmt(spell->out, " [[attribute(%u)]];\n", (unsigned)variable->location);
    }
    spell_text(spell, "};\n");
}

/* Both stages declare the whole struct, also members that they do not read, so that they match. */
static void write_vertex_data(struct spell *spell)
{
    open_struct(spell, "VertexData");
    bool agrees = is_vertex(spell) && spell->shader->role->stages == STAGES_OF_PASS;
    if (!spell_is_called(spell))
        SPELL(spell, "    float4 pos [[position", agrees ? ", invariant" : "", "]];\n");
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_VERTEX_DATA)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        write_member(spell, variable);
        const char *name = str_text(spell->shader->strings, variable->name);
        if (!spell_is_called(spell))
            SPELL(spell, " [[user(", name, variable->flat ? "), flat]]" : ")]]");
        spell_text(spell, ";\n");
    }
    spell_text(spell, "};\n");
}

static void write_color(struct spell *spell, const struct shader_variable *variable)
{
    text_fmt(spell->out, " [[color(%u)%s]]", (unsigned)variable->location,
             shader_is_second_source(variable) ? ", index(1)" : "");
}

static void write_outputs(struct spell *spell)
{
    open_struct(spell, "PixelOutputs");
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_OUTPUTS)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        write_member(spell, variable);
        if (!spell_is_called(spell))
            write_color(spell, variable);
        spell_text(spell, ";\n");
    }
    spell_text(spell, "};\n");
}

static void declare_for_function(struct spell *spell)
{
    spell_text(spell, "#include <metal_stdlib>\nusing namespace metal;\n\n");
    spell_structs(spell);
    write_textures(spell);
    spell_uniform_blocks(spell, write_block);
}

/* The uniforms of passes. */
static void write_frame(struct spell *spell)
{
    SPELL_EACH_RESOURCE(r, spell)
    {
        if (strcmp(r.resource->kind, "uniform") != 0)
            continue;
        spell_text(spell, "struct MxFrame {\n");
        for (uint32_t i = 0; i < r.resource->num_members; i++) {
            const struct deferred_member *member = &r.resource->members[i];
            SPELL(spell, "    ", lang_syntax_type(spell->style->syntax, spell_member_type(member)),
                  " ", member->name, ";\n");
        }
        spell_text(spell, "};\n");
    }
}

static void declare(struct spell *spell)
{
    spell_text(spell, "// ");
    spell_title(spell);
    SPELL(spell, "\n// Metal Shading Language ", spell_version(spell), "\n");
    declare_for_function(spell);
    write_lights(spell);
    write_frame(spell);
    if (spell->shader->sources.pass.lacks_surface)
        return;
    if (is_vertex(spell))
        write_inputs(spell);
    write_vertex_data(spell);
    if (has_outputs(spell))
        write_outputs(spell);
}

/* ---- What is bound: members of the context, and parameters of the function of the stage ---- */

/* The number of vertex attributes, whose buffers stand before those of the blocks. */
static uint32_t num_attributes(const struct spell *spell)
{
    uint32_t end = 0;
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_APP_DATA)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        uint32_t next = variable->location + ir_type_info(variable->type)->columns;
        if (is_vertex(spell) && spell_uses(spell, variable) && next > end)
            end = next;
    }
    return end;
}

enum { HOST_BUFFER = 30 }; /* the last one of Metal */

/* How a list writes what is bound. */
enum list { MEMBERS, PARAMETERS, ARGUMENTS };

static const char *const begins[] = {"    ", ",\n    ", ", "}, *const ends[] = {";\n", "", ""};

static void list_block(struct spell *spell, enum list list, enum shader_block block)
{
    const char *instance = spell_instance(spell, block),
               *type = block == BLOCK_LIGHT_DATA ? "LightData_pixel"
                                                 : shader_block_name(spell->shader, block);
    bool is_there = block == BLOCK_LIGHT_DATA
                        ? spell_has_light_data(spell)
                        : shader_block_has_uniforms(block) && spell_uses_block(spell, block);
    if (!is_there)
        return;
    spell_text(spell, begins[list]);
    if (list != ARGUMENTS)
        SPELL(spell, "constant ", spell_frame_name(spell, type), "& ");
    spell_text(spell, instance);
    if (list == PARAMETERS)
        text_fmt(
            spell->out, " [[buffer(%u)]]",
            (unsigned)(spell->shader->interface.buffers[block].binding + num_attributes(spell)));
    spell_text(spell, ends[list]);
}

static void list_texture(struct spell *spell, enum list list,
                         const struct shader_variable *variable)
{
    const char *name = str_text(spell->shader->strings, variable->name);
    bool is_array = variable->type == IR_TYPE_SAMPLER_ARRAY;
    unsigned number = variable->binding;
    spell_text(spell, begins[list]);
    if (list == MEMBERS)
        SPELL(spell, is_array ? "MetalTextureArray " : "MetalTexture ", name);
    else if (list == ARGUMENTS)
        SPELL(spell, "{", name, "_tex, ", name, "_sampler}");
    else
        text_fmt(spell->out,
                 "%s<float> %s_tex [[texture(%u)]],\n    sampler %s_sampler [[sampler(%u)]]",
                 is_array ? "texture2d_array" : "texture2d", name, number, name, number);
    spell_text(spell, ends[list]);
}

/* An image or buffer of programs. */
static void list_resource(struct spell *spell, enum list list, const struct spell_resource *r)
{
    spell_text(spell, begins[list]);
    if (list != ARGUMENTS)
        SPELL(spell, spell_image(spell, r)->type, " ");
    if (strcmp(r->resource->kind, "uniform") == 0)
        spell_text(spell, SPELL_FRAME_INSTANCE);
    else
        SPELL(spell, "mx_", r->resource->name);
    if (list == PARAMETERS)
        text_fmt(spell->out, " [[%s(%u)]]", r->resource->num_members ? "buffer" : "texture",
                 (unsigned)(spell->target->first_resource + r->binding));
    spell_text(spell, ends[list]);
}

/* The struct of the host's file, which has the functions that the shader calls. */
static void list_host(struct spell *spell, enum list list)
{
    if (!spell_asks_host(spell))
        return;
    spell_text(spell, begins[list]);
    spell_text(spell, list == ARGUMENTS ? "host"
                      : list == MEMBERS ? "MxgHost " SPELL_HOST_INSTANCE
                                        : "constant MxgHost& " SPELL_HOST_INSTANCE);
    if (list == PARAMETERS)
        text_fmt(spell->out, " [[buffer(%u)]]", (unsigned)HOST_BUFFER);
    spell_text(spell, ends[list]);
}

/* MaterialX's order: lights, textures, blocks. */
static void list_bound(struct spell *spell, enum list list)
{
    list_block(spell, list, BLOCK_LIGHT_DATA);
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_TEXTURES)
    if (spell_uses(spell, spell_interface_variable(spell, i)))
        list_texture(spell, list, spell_interface_variable(spell, i));
    list_block(spell, list, BLOCK_PRIVATE_UNIFORMS);
    list_block(spell, list, BLOCK_PUBLIC_UNIFORMS);
    for (int block = BLOCK_OWN; block < NUM_BLOCKS; block++)
        list_block(spell, list, (enum shader_block)block);
    SPELL_EACH_RESOURCE(r, spell)
    list_resource(spell, list, &r);
    list_host(spell, list);
}

/* ---- The context ---- */

static void write_inputs_and_outputs(struct spell *spell)
{
    const char *vd = spell_frame_name(spell, "vd"),
               *vertex_data = spell_frame_name(spell, "VertexData");
    if (spell->shader->sources.pass.lacks_surface)
        return;
    if (spell->shader->role->is_in_host_file) {
        if (spell->shares_vertex_data)
            SPELL(spell, "    ", vertex_data, " ", vd, ";\n");
        return;
    }
    if (is_vertex(spell))
        SPELL(spell, "    ", spell_frame_name(spell, "VertexInputs"), " ",
              spell_instance(spell, BLOCK_APP_DATA), ";\n");
    SPELL(spell, "    ", vertex_data, " ", vd, ";\n");
    if (has_outputs(spell))
        SPELL(spell, "    ", spell_frame_name(spell, "PixelOutputs"), " ",
              spell_instance(spell, BLOCK_OUTPUTS), ";\n");
}

static void open_context(struct spell *spell)
{
    open_struct(spell, "GlobalContext");
    list_bound(spell, MEMBERS);
    write_inputs_and_outputs(spell);
    spell_text(spell, "\n");
}

static void open_main(struct spell *spell)
{
    SPELL(spell, "void ", entry_name(spell), "()\n{\n");
}

/* ---- The function of the stage ---- */

static void write_parameters(struct spell *spell)
{
    SPELL(spell, "(\n    ",
          spell_frame_name(spell, is_vertex(spell) ? "VertexInputs" : "VertexData"), " ",
          is_vertex(spell) ? spell_instance(spell, BLOCK_APP_DATA) : spell_frame_name(spell, "vd"),
          " [[stage_in]]");
    list_bound(spell, PARAMETERS);
    spell_text(spell, ")\n{\n");
}

/* Its functions are members, and those of Metal are for objects of a thread. */
static void copy_host(struct spell *spell)
{
    if (spell_asks_host(spell))
        spell_text(spell, "    MxgHost host = " SPELL_HOST_INSTANCE ";\n");
}

/* "    GlobalContext context = {u_prv, mx_words": the begin of a list. */
static void open_arguments(struct spell *spell)
{
    SPELL(spell, "    ", spell_frame_name(spell, "GlobalContext"), " context = {");
    size_t begin = spell->out->len;
    list_bound(spell, ARGUMENTS);
    if (spell->out->len == begin)
        return;
    memmove(spell->out->data + begin, spell->out->data + begin + 2, /* without the first comma */
            spell->out->len - begin - 2);
    spell->out->len -= 2;
}

static void write_kernel(struct spell *spell)
{
    const struct source_pass *pass = &spell->shader->sources.pass;
    SPELL(spell, "\nkernel void ComputeMain(\n    uint3 group [[threadgroup_position_in_grid]],\n",
          "    uint3 place [[thread_position_in_threadgroup]]");
    list_bound(spell, PARAMETERS);
    spell_text(spell, ")\n{\n");
    copy_host(spell);
    open_arguments(spell);
    SPELL(spell, "};\n",
          pass->has_group ? "    threadgroup atomic_uint bits;\n    context.mx_bits = &bits;\n"
                          : "",
          "    context.mx_run(group.xy, place.xy);\n}\n");
}

static void close_context(struct spell *spell)
{
    spell_text(spell, "};\n");
    if (spell->shader->sources.pass.runs)
        write_kernel(spell);
    if (spell_is_called(spell))
        return;
    const char *entry = entry_name(spell), *vd = spell_frame_name(spell, "vd");
    const char *inputs = is_vertex(spell) ? spell_instance(spell, BLOCK_APP_DATA) : vd,
               *outputs = is_vertex(spell) ? vd : spell_instance(spell, BLOCK_OUTPUTS);
    bool returns = is_vertex(spell) || has_outputs(spell);
    SPELL(spell, "\n", spell_tests_early(spell) ? "[[early_fragment_tests]]\n" : "",
          is_vertex(spell) ? "vertex " : "fragment ",
          is_vertex(spell) ? spell_frame_name(spell, "VertexData")
          : returns        ? spell_frame_name(spell, "PixelOutputs")
                           : "void",
          " ", entry);
    write_parameters(spell);
    copy_host(spell);
    if (spell_asks_host(spell))
        SPELL(spell, "    host.mxg_pixel = int2(", vd, ".pos.xy);\n");
    open_arguments(spell);
    spell_text(spell, spell->out->data[spell->out->len - 1] == '{' ? "" : ", ");
    SPELL(spell, inputs, returns ? ", {}};\n" : "};\n", "    context.", entry, "();\n");
    if (returns)
        SPELL(spell, "    return context.", outputs, ";\n");
    spell_text(spell, "}\n");
}

const struct target_frame msl_frame = {.declare = declare,
                                       .open = open_main,
                                       .open_context = open_context,
                                       .close_context = close_context,
                                       .declare_for_function = declare_for_function};
