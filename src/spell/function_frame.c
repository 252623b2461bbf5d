// SPDX-License-Identifier: Apache-2.0
/*
 * The frame of a shader that is a function of the host's shader (option `form`): the vertex data
 * are its parameters, the outputs are members of the struct that it returns, and the lights are
 * those of the host.
 *
 *     int mxg_light_count();
 *     void mxg_light(int i, vec3 P, out vec3 L, out vec3 radiance);
 *     struct Surface { vec3 color; float alpha; };
 *     Surface surface(vec3 positionWorld, vec3 normalWorld)
 */
#include "spell/spell.h"

#include <assert.h>

static void write_members(struct spell *spell, enum shader_block block)
{
    SPELL_EACH_OF_BLOCK(i, spell, block)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        spell_indent(spell, 1);
        spell_declare(spell, variable, spell_name_of(spell->shader->strings, variable->name));
        spell_text(spell, ";\n");
    }
}

/* Several functions in one file declare them once. */
static void declare_lights(struct spell *spell)
{
    const char *const parameters[] = {"int i, ", " P, out ", " L, out ", " radiance);\n#endif\n"};
    spell_text(spell, "#ifndef MXG_LIGHTS\n#define MXG_LIGHTS\nint mxg_light_count();\n"
                      "void mxg_light(");
    for (unsigned i = 0; i < 4; i++) {
        spell_text(spell, parameters[i]);
        if (i < 3)
            spell_type(spell, IR_TYPE_VEC3);
    }
}

void spell_declare_function(struct spell *spell)
{
    assert(spell->shader->is_function);
    if (spell->stage->has_lights)
        declare_lights(spell);
    if (spell->shares_vertex_data) {
        const char *type = spell_frame_name(spell, "VertexData");
        SPELL(spell, "struct ", type, " {\n");
        write_members(spell, BLOCK_VERTEX_DATA);
        SPELL(spell, "};\n", spell->frame->variable ? spell->frame->variable : "", type, " ",
              spell_frame_name(spell, "vd"), ";\n");
    }
    SPELL(spell, "struct ", spell->shader->function_type, " {\n");
    write_members(spell, BLOCK_OUTPUTS);
    spell_text(spell, "};\n");
}

void spell_open_function(struct spell *spell)
{
    const char *type = spell->shader->function_type, *between = "";
    SPELL(spell, type, " ", spell->shader->function, "(");
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_VERTEX_DATA)
    {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        spell_text(spell, between);
        spell_declare(spell, variable, spell_name_of(spell->shader->strings, variable->name));
        between = ", ";
    }
    spell_text(spell, ")\n{\n");
    SPELL_EACH_OF_BLOCK(i, spell, BLOCK_VERTEX_DATA)
    {
        const char *name =
            str_text(spell->shader->strings, spell_interface_variable(spell, i)->name);
        if (spell->shares_vertex_data)
            SPELL(spell, "    ", spell_frame_name(spell, "vd"), ".", name, " = ", name, ";\n");
    }
    SPELL(spell, "    ", type, " result;\n");
}

void spell_close_function(struct spell *spell)
{
    spell_text(spell, "    return result;\n");
}
