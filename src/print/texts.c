// SPDX-License-Identifier: Apache-2.0
/*
 * Most functions of a shader are unchanged functions of the library. The packer of a library writes
 * their text once, in a syntax that several targets share. Generation copies the text from the
 * image, if each name in the text is the name in the shader, too.
 */
#include "print/print_priv.h"

#include <assert.h>

/* True if a shader may contain the function unchanged. */
static bool is_worth_text(const struct lang_function *fn)
{
    bool is_called = fn->num_nodes > LANG_TINY || !(fn->flags & LANG_FN_STRAIGHT);
    return fn->flags & LANG_FN_FINAL && !(fn->flags & LANG_FN_STRINGS) && is_called;
}

/*
 * A text may contain the names of structs in the function's slots and return type only, because
 * has_own_types checks these.
 */
struct type_watch {
    const struct lang_unit *unit;
    const struct lang_function *fn;
    bool found_other;
};

static ir_type_id without_lengths(const struct lang_unit *unit, ir_type_id type)
{
    while (ast_is_user_type(type) && lang_user_type(unit, type, NULL)->array_length)
        type = lang_user_type(unit, type, NULL)->element;
    return type;
}

static const char *watch_type(void *user_data, ir_type_id type)
{
    struct type_watch *watch = user_data;
    bool is_of_function = without_lengths(watch->unit, watch->fn->return_type) == type;
    for (uint32_t i = 0; i < watch->fn->num_slots; i++)
        is_of_function |=
            without_lengths(watch->unit, ast_slot(watch->unit, watch->fn, i)->type) == type;
    watch->found_other |= !is_of_function;
    return NULL;
}

/* few shaders have longer functions, and in the same room the image has many short ones */
enum { MAX_TEXT = 660 };

void lang_make_texts(struct lang_unit *unit, const struct lang_syntax *syntax, struct arena *arena)
{
    struct lang_style *style = arena_alloc(arena, sizeof *style);
    lang_style_init(style, syntax, arena);
    style->from_images = false;
    struct text text;
    text_init(&text, arena);
    memset(&unit->texts, 0, sizeof unit->texts);
    for (uint32_t i = 0; i < unit->functions.len; i++) {
        size_t before = text.len;
        assert(unit->texts.len == i);
        vec_push(arena, &unit->texts, (uint32_t)before);
        struct type_watch watch = {.unit = unit, .fn = &unit->functions.items[i]};
        struct lang_names names = {.user_data = &watch, .user_type = watch_type};
        if (is_worth_text(watch.fn))
            lang_print_function(style, &names, unit, unit->base_functions + i, &text);
        if (text.len > before + MAX_TEXT || watch.found_other)
            text.len = before;
    }
    vec_push(arena, &unit->texts, (uint32_t)text.len);
    assert(unit->texts.len == unit->functions.len + 1);
    memset(&unit->text_bytes, 0, sizeof unit->text_bytes);
    if (text.len)
        memcpy(vec_extend(arena, &unit->text_bytes, text.len), text.data, text.len);
}

static bool has_own_type(const struct lang_names *names, const struct lang_unit *unit,
                         ir_type_id type)
{
    type = without_lengths(unit, type);
    return !ast_is_user_type(type)
           || print_struct_name(names, unit, type)
                  == str_text(unit->strings, lang_user_type(unit, type, NULL)->name);
}

static bool has_own_types(const struct lang_names *names, const struct lang_unit *unit,
                          const struct lang_unit *layer, const struct lang_function *fn)
{
    for (uint32_t i = 0; i < fn->num_slots; i++)
        if (!has_own_type(names, unit, ast_slot(layer, fn, i)->type))
            return false;
    return has_own_type(names, unit, fn->return_type);
}

/* Compares names by address: an unchanged name is the string of the pool. */
static bool has_own_names(const struct lang_names *names, const struct lang_unit *unit,
                          const struct lang_unit *layer, const struct lang_function *fn,
                          uint32_t id)
{
    const struct strpool *strings = unit->strings;
    if (print_function_name(names, unit, id) != str_text(strings, fn->name))
        return false;
    const uint32_t *refs = ast_callees(layer, fn);
    for (uint32_t i = 0; i < fn->num_callees; i++)
        if (print_function_name(names, unit, refs[i])
            != str_text(strings, lang_function(unit, refs[i], NULL)->name))
            return false;
    refs = ast_globals(layer, fn);
    for (uint32_t i = 0; i < fn->num_globals; i++)
        if (print_global_name(names, unit, refs[i])
            != str_text(strings, lang_global(unit, refs[i], NULL)->name))
            return false;
    return true;
}

bool print_from_image(const struct lang_style *style, const struct lang_names *names,
                      const struct lang_unit *unit, uint32_t id, struct text *out)
{
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(unit, id, &layer);
    if (!style->from_images || layer->texts.len == 0
        || (fn->flags & LANG_FN_DERIVATIVE && style->syntax->without_neighbours))
        return false;
    assert(layer->texts.len == layer->functions.len + 1);
    const uint32_t *at = &layer->texts.items[id - layer->base_functions];
    assert(at[0] <= at[1] && at[1] <= layer->text_bytes.len);
    if (at[0] == at[1] || !has_own_names(names, unit, layer, fn, id)
        || !has_own_types(names, unit, layer, fn))
        return false;
    text_mem(out, layer->text_bytes.items + at[0], at[1] - at[0]);
    return true;
}
