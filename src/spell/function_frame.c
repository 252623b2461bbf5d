// SPDX-License-Identifier: Apache-2.0
/*
 * The frame of a shader that is a function of the host's shader: the vertex data
 * are its parameters, the outputs are members of the struct that it returns, and the lights are
 * those of the host.
 *
 *     int mxg_light_count();
 *     void mxg_light(int i, vec3 P, out vec3 L, out vec3 radiance);
 *     struct Surface { vec3 color; float alpha; };
 *     Surface surface(vec3 positionWorld, vec3 normalWorld)
 */
#include "spell/spell.h"

static void write_members(struct spell *spell, enum shader_block block)
{
    SPELL_EACH_OF_BLOCK(i, spell, block)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        spell_indent(spell, 1);
        spell_declare(spell, PHRASE_MEMBER, variable,
                      spell_name_of(spell->shader->strings, variable->name));
        spell_text(spell, "\n");
    }
}

static void open_struct(struct spell *spell, const char *name)
{
    SPELL(spell, "struct ", name, " {\n");
}

static void close_struct(struct spell *spell)
{
    SPELL(spell, spell->style->phrases[PHRASE_STRUCT_END], "\n");
}

/* Declares a variable of a struct: "Surface result", "var result: Surface". */
static void write_variable(struct spell *spell, enum lang_phrase phrase, const char *type,
                           const char *name)
{
    (void)lang_open(spell->style, phrase, (struct lang_type_text){lang_word(type), 0},
                    lang_word(name), spell->out);
}

static void declare(struct spell *spell)
{
    spell_text(spell, "// ");
    spell_title(spell);
    spell_text(spell, "\n\n");
    spell->frame->declare_for_function(spell);
    bool has_context = spell->frame->open_context != NULL;
    spell_host_functions(spell);
    if (spell->shares_vertex_data) {
        const char *type = spell_frame_name(spell, "VertexData");
        open_struct(spell, type);
        write_members(spell, BLOCK_VERTEX_DATA);
        close_struct(spell);
        if (!has_context) {
            write_variable(spell, PHRASE_VARIABLE, type, spell_frame_name(spell, "vd"));
            spell_text(spell, ";\n");
        }
    }
    open_struct(spell, spell->shader->reflection.function_type);
    write_members(spell, BLOCK_OUTPUTS);
    close_struct(spell);
}

static void open_function(struct spell *spell)
{
    const char *type = spell->shader->reflection.function_type, *between = "";
    struct lang_declaration head =
        lang_open(spell->style, PHRASE_FUNCTION, (struct lang_type_text){lang_word(type), 0},
                  lang_word(spell->shader->reflection.function), spell->out);
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_VERTEX_DATA)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        spell_text(spell, between);
        spell_declare(spell, PHRASE_PARAM_ASSIGNED, variable,
                      spell_name_of(spell->shader->strings, variable->name));
        between = ", ";
    }
    lang_declare(spell->style, &head, spell->out);
    spell_text(spell, "\n{\n");
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_VERTEX_DATA)
    {
        const char *name =
            str_text(spell->shader->strings, spell_interface_variable(spell, i)->name);
        if (spell->shares_vertex_data)
            SPELL(spell, "    ", spell_frame_name(spell, "vd"), ".", name, " = ", name, ";\n");
    }
    spell_indent(spell, 1);
    write_variable(spell, PHRASE_LOCAL, type, "result");
    spell_text(spell, ";\n");
}

static void close_function(struct spell *spell)
{
    spell_text(spell, "    return result;\n}\n");
}

const struct target_frame spell_function_frame = {
    .declare = declare, .open = open_function, .close = close_function};
