// SPDX-License-Identifier: Apache-2.0
/*
 * The library's functions above the shader: those that OSL has of itself (natives.def) call it, and
 * what only these would have needed is left out.
 */
#include "generators/osl/osl.h"

static const struct {
    const char *function, *types, *name;
} same[] = {
#define SAME(function, types, name) {function, types, name},
#include "generators/osl/natives.def"
};

static const struct {
    const char *function, *types, *type, *params, *body;
} natives[] = {
#define NATIVE(function, types, type, params, body) {function, types, type, params, body},
#include "generators/osl/natives.def"
};

static bool has_types(const struct lang_unit *layer, const struct lang_function *fn,
                      const char *types)
{
    if (fn->num_params != strlen(types))
        return false;
    for (uint32_t i = 0; i < fn->num_params; i++)
        if (osl_type_letter(layer->slots.items[fn->first_slot + i].type) != types[i])
            return false;
    return true;
}

const char *osl_same_function(const struct spell *spell, uint32_t id)
{
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(spell->shader->unit, id, &layer);
    const char *name = str_text(spell->shader->strings, fn->name);
    for (size_t i = 0; i < sizeof same / sizeof *same; i++)
        if (strcmp(same[i].function, name) == 0 && has_types(layer, fn, same[i].types))
            return same[i].name;
    return NULL;
}

void osl_name_same_functions(struct spell *spell)
{
    const struct lang_reach *reach = &spell->stage->reach;
    for (uint32_t i = 0; i < reach->functions.len; i++) {
        const char *name = osl_same_function(spell, reach->functions.items[i]);
        if (name)
            spell->functions[reach->functions.items[i]] = name;
    }
}

/*
 * "float mx_noise_float(vector p) {…}" by what OSL has; false: the function is the library's alone.
 */
static bool write_native(const struct spell *spell, uint32_t id, struct text *out)
{
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(spell->shader->unit, id, &layer);
    const char *name = str_text(spell->shader->strings, fn->name);
    for (size_t i = 0; i < sizeof natives / sizeof *natives; i++) {
        if (strcmp(natives[i].function, name) != 0 || !has_types(layer, fn, natives[i].types))
            continue;
        text_fmt(out, "%s %s(%s)\n{\n    %s\n    return n;\n}\n", natives[i].type,
                 spell->functions[id], natives[i].params, natives[i].body);
        return true;
    }
    return false;
}

static bool is_needed_constant(const struct spell *spell, uint32_t global,
                               const char *const *functions, uint32_t num_functions)
{
    const char *name =
        str_text(spell->shader->strings, lang_global(spell->shader->unit, global, NULL)->name);
    bool needed = false;
    for (uint32_t i = 0; i < num_functions; i++)
        needed |= osl_mentions(functions[i], name);
    return needed && shader_global_variable(spell->shader, global) == UINT32_MAX;
}

static bool is_array(const struct spell *spell, uint32_t global)
{
    return lang_global(spell->shader->unit, global, NULL)->type >= IR_TYPE_FIRST_USER;
}

/* Arrays cannot be macros: functions that mention one begin with it. */
static void add_arrays(const struct spell *spell, struct text *function)
{
    const struct lang_reach *reach = &spell->stage->reach;
    struct text arrays;
    text_init(&arrays, spell->scratch);
    const char *body = strstr(text_cstr(function), "\n{\n");
    for (uint32_t i = 0; body && i < reach->globals.len; i++) {
        uint32_t global = reach->globals.items[i];
        if (!is_array(spell, global) || !is_needed_constant(spell, global, &body, 1))
            continue;
        text_str(&arrays, "    ");
        lang_print_constant(spell->style, &spell->lang_names, spell->shader->unit, global, &arrays);
    }
    if (!arrays.len)
        return;
    struct text whole;
    text_init(&whole, spell->scratch);
    text_fmt(&whole, "%.*s\n{\n%s%s", (int)(body - text_cstr(function)), text_cstr(function),
             text_cstr(&arrays), body + strlen("\n{\n"));
    *function = whole;
}

/*
 * What is called later stands earlier, so it is from the last function to the first that one sees
 * what is needed.
 */
void osl_write_functions(struct osl *osl, const char *shader, struct text *out)
{
    struct spell *spell = osl->spell;
    const struct lang_reach *reach = &spell->stage->reach;
    struct text *before = spell->out;
    VEC(const char *) kept = {0};
    for (uint32_t i = reach->functions.len; i-- > 0;) {
        uint32_t id = reach->functions.items[i];
        if (osl_same_function(spell, id))
            continue;
        bool needed = osl_mentions(shader, spell->functions[id]);
        for (uint32_t k = 0; k < kept.len && !needed; k++)
            needed = osl_mentions(kept.items[k], spell->functions[id]);
        if (!needed)
            continue;
        struct text text;
        text_init(&text, spell->scratch);
        if (!write_native(spell, id, &text))
            lang_print_function(spell->style, &spell->lang_names, spell->shader->unit, id, &text);
        add_arrays(spell, &text);
        vec_push(spell->scratch, &kept, text_cstr(&text));
    }
    spell->out = out;
    for (uint32_t i = 0; i < reach->globals.len; i++)
        if (!is_array(spell, reach->globals.items[i])
            && is_needed_constant(spell, reach->globals.items[i], kept.items, kept.len))
            lang_print_constant(spell->style, &spell->lang_names, spell->shader->unit,
                                reach->globals.items[i], out);
    for (uint32_t i = kept.len; i-- > 0;)
        SPELL(spell, kept.items[i], "\n");
    spell->out = before;
}
