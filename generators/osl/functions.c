// SPDX-License-Identifier: Apache-2.0
/*
 * Writes the called library functions above the shader. A function with a native counterpart
 * (natives.def) calls it instead of running library code, so functions that only this code calls
 * are left out.
 */
#include "generators/osl/osl.h"

#include <assert.h>

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

const char *osl_function_name(void *user_data, uint32_t id)
{
    struct spell *spell = user_data;
    ((struct osl *)spell->target_data)->called[id] = true;
    return spell->functions[id];
}

/*
 * "float mx_noise_float(vector p) {…}" with OSL's native function; false: there is none.
 */
static bool write_native(struct osl *osl, uint32_t id, struct text *out)
{
    const struct spell *spell = osl->spell;
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(spell->shader->unit, id, &layer);
    const char *name = str_text(spell->shader->strings, fn->name);
    for (size_t i = 0; i < sizeof natives / sizeof *natives; i++) {
        if (strcmp(natives[i].function, name) != 0 || !has_types(layer, fn, natives[i].types))
            continue;
        for (uint32_t k = 0; k < fn->num_params; k++)
            osl_type(osl, layer->slots.items[fn->first_slot + k].type);
        text_fmt(out, "%s %s(%s)\n{\n    %s\n    return n;\n}\n", natives[i].type,
                 spell->functions[id], natives[i].params, natives[i].body);
        return true;
    }
    return false;
}

/* Constants that functions read; arrays are local to functions (lang_syntax.arrays_are_local). */
static void write_constants(const struct osl *osl, struct text *out)
{
    const struct spell *spell = osl->spell;
    const struct lang_reach *reach = &spell->stage->reach;
    for (uint32_t i = 0; i < reach->globals.len; i++) {
        uint32_t id = reach->globals.items[i];
        bool is_array = lang_global(spell->shader->unit, id, NULL)->type >= IR_TYPE_FIRST_USER,
             is_variable = shader_global_variable(spell->shader, id) != UINT32_MAX;
        if (osl->read[id] && !is_array && !is_variable)
            lang_print_constant(spell->style, &spell->lang_names, spell->shader->unit, id, out);
    }
}

struct written {
    uint32_t id;
    struct text text;
};

/* Callees stand above their callers, so a function is written after all its calls. */
void osl_write_functions(struct osl *osl, struct text *out)
{
    struct spell *spell = osl->spell;
    assert(spell->out == out);
    const struct lang_reach *reach = &spell->stage->reach;
    VEC(struct written) kept = {0};
    for (uint32_t i = reach->functions.len; i-- > 0;) {
        uint32_t id = reach->functions.items[i];
        if (!osl->called[id] || osl_same_function(spell, id))
            continue;
        struct written function = {.id = id};
        struct text *text = &function.text;
        text_init(text, spell->scratch);
        if (!write_native(osl, id, text))
            lang_print_function(spell->style, &spell->lang_names, spell->shader->unit, id, text);
        vec_push(spell->scratch, &kept, function);
    }
    write_constants(osl, out);
    for (uint32_t i = kept.len; i-- > 0;) {
        spell_function_doc(spell, kept.items[i].id);
        text_mem(out, kept.items[i].text.data, kept.items[i].text.len);
        text_char(out, '\n');
    }
}
