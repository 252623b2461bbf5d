// SPDX-License-Identifier: Apache-2.0
/*
 * Most functions of a shader are those of the library as they stand there. Their text in a syntax that several targets share is written
 * once, when the library is packed, and copied from its image, as long as everything that the text names has its own name in the shader.
 */
#include "lang/lower.h"
#include "lang/print.h"

/* Can it be in a shader as it is? Structs may have other names there. */
static bool is_worth_text(const struct lang_function *fn)
{
    bool stays = fn->flags & LANG_FN_FINAL && fn->flags & LANG_FN_PLAIN && !(fn->flags & LANG_FN_STRINGS);
    bool is_called = fn->num_nodes > LOWER_TINY || !(fn->flags & LANG_FN_STRAIGHT);
    return stays && is_called;
}

enum { MAX_TEXT = 1024 }; /* few shaders have longer ones, and the image has room for many shorter */

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
        vec_push(arena, &unit->texts, (uint32_t)before);
        if (is_worth_text(&unit->functions.items[i]))
            lang_print_function(style, NULL, unit, unit->base_functions + i, &text);
        if (text.len > before + MAX_TEXT)
            text.len = before;
    }
    vec_push(arena, &unit->texts, (uint32_t)text.len);
    memset(&unit->text_bytes, 0, sizeof unit->text_bytes);
    memcpy(vec_extend(arena, &unit->text_bytes, text.len), text.data, text.len);
}

/* Names of the source are compared by address: they are the pool's. */
static bool has_own_names(const struct lang_names *names, const struct lang_unit *unit, const struct lang_unit *layer,
                          const struct lang_function *fn, uint32_t id)
{
    const struct strpool *strings = unit->strings;
    if (print_function_name(names, unit, id) != str_text(strings, fn->name))
        return false;
    const uint32_t *refs = layer->refs.items + fn->first_callee;
    for (uint32_t i = 0; i < fn->num_callees; i++)
        if (print_function_name(names, unit, refs[i]) != str_text(strings, lang_function(unit, refs[i], NULL)->name))
            return false;
    refs = layer->refs.items + fn->first_global;
    for (uint32_t i = 0; i < fn->num_globals; i++)
        if (print_global_name(names, unit, refs[i]) != str_text(strings, lang_global(unit, refs[i], NULL)->name))
            return false;
    return true;
}

bool print_from_image(const struct lang_style *style, const struct lang_names *names, const struct lang_unit *unit, uint32_t id,
                 struct text *out)
{
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(unit, id, &layer);
    if (!style->from_images || layer->texts.len == 0 || (fn->flags & LANG_FN_DERIVATIVE && style->syntax->without_neighbours))
        return false;
    const uint32_t *at = &layer->texts.items[id - layer->base_functions];
    if (at[0] == at[1] || !has_own_names(names, unit, layer, fn, id))
        return false;
    text_mem(out, layer->text_bytes.items + at[0], at[1] - at[0]);
    return true;
}
