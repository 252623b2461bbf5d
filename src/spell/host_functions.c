// SPDX-License-Identifier: Apache-2.0
/*
 * Functions that the host writes and the shader calls (docs/hosts.md, "Functions of the host"). The
 * lights are known here, because they have two results; the others are prototypes in libraries/.
 */
#include "spell/spell.h"
#include "tree/ast.h"

/* Several functions in one file declare the lights once. */
static void declare_lights(struct spell *spell)
{
    static const struct {
        enum lang_phrase phrase;
        ir_type_id type;
        const char *name;
    } parameters[] = {{PHRASE_PARAM_ASSIGNED, IR_TYPE_INT, "i"},
                      {PHRASE_PARAM_ASSIGNED, IR_TYPE_VEC3, "P"},
                      {PHRASE_PARAM_OUT, IR_TYPE_VEC3, "L"},
                      {PHRASE_PARAM_OUT, IR_TYPE_VEC3, "radiance"}};
    const struct lang_type_text none = {{"", 0}, 0}, count = spell_type_text(spell, IR_TYPE_INT);
    spell_text(spell, "#ifndef MXG_LIGHTS\n#define MXG_LIGHTS\n");
    struct lang_declaration head =
        lang_open(spell->style, PHRASE_FUNCTION, count, lang_word("mxg_light_count"), spell->out);
    lang_declare(spell->style, &head, spell->out);
    spell_text(spell, ";\n");
    head = lang_open(spell->style, PHRASE_PROCEDURE, none, lang_word("mxg_light"), spell->out);
    for (unsigned i = 0; i < sizeof parameters / sizeof *parameters; i++) {
        spell_text(spell, i ? ", " : "");
        spell_variable(spell, parameters[i].phrase, parameters[i].type,
                       (struct spell_name){parameters[i].name, strlen(parameters[i].name)});
    }
    lang_declare(spell->style, &head, spell->out);
    spell_text(spell, ";\n#endif\n");
}

/* A prototype that stands alone has no body. */
static void declare_others(struct spell *spell)
{
    const struct lang_reach *reach = &spell->stage->reach;
    for (uint32_t i = 0; i < reach->functions.len; i++) {
        struct text declaration;
        uint32_t id = reach->functions.items[i];
        if (lang_function(spell->shader->unit, id, NULL)->body)
            continue;
        text_init(&declaration, spell->scratch);
        lang_print_function(spell->style, &spell->lang_names, spell->shader->unit, id,
                            &declaration);
        spell_once(spell, declaration.data, declaration.len);
    }
}

bool spell_asks_host(const struct spell *spell)
{
    return spell->stage_id == STAGE_PIXEL && spell->shader->reflection.host_functions.len > 0;
}

const char *spell_host_prefix(const struct spell *spell)
{
    return spell->frame->open_context ? SPELL_HOST_INSTANCE "." : "";
}

const char *spell_host_name(const struct spell *spell, str_id name)
{
    const struct shader_reflection *reflection = &spell->shader->reflection;
    bool is_hosts = false;
    struct text text;
    for (uint32_t i = 0; i < reflection->host_functions.len; i++)
        is_hosts |= reflection->host_functions.items[i] == name;
    text_init(&text, spell->scratch);
    text_fmt(&text, "%s%s", is_hosts ? spell_host_prefix(spell) : "",
             str_text(spell->shader->strings, name));
    return text_cstr(&text);
}

void spell_host_functions(struct spell *spell)
{
    if (spell->frame->open_context || spell->style->syntax->no_directives)
        return;
    if (spell->stage->has_lights && spell->shader->lights == LIGHTS_OF_HOST)
        declare_lights(spell);
    declare_others(spell);
}
