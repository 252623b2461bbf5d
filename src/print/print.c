// SPDX-License-Identifier: Apache-2.0
/* Printing functions: their heads, and the copies that their bodies begin with. */
#include "print/print_priv.h"

#include <assert.h>

static struct printer start(struct lang_style *style, const struct lang_names *names,
                            const struct lang_unit *unit, uint32_t id, struct text *out)
{
    struct printer p = {.style = style, .names = names, .unit = unit, .id = id, .out = out};
    p.has_results = lang_has_results(style->syntax, unit, id);
    p.is_typed = lang_is_typed(style->syntax, names);
    p.fn = lang_function(unit, id, &p.layer);
    p.locals = arena_alloc(out->arena, p.fn->num_slots * sizeof *p.locals);
    p.visible = arena_alloc(out->arena, p.fn->num_slots * sizeof *p.visible);
    for (uint32_t i = 0; i < p.fn->num_params; i++)
        print_bring_into_scope(&p, i);
    assert(p.num_visible == p.fn->num_params);
    return p;
}

/* A copied parameter has the name of its slot with the suffix "_in". */
static bool is_copied(const struct printer *p, const struct lang_slot *param)
{
    return p->style->syntax->copies_params && param->assigned && param->mode == LANG_IN;
}

static struct text_word copied_name(struct printer *p, uint32_t slot)
{
    struct text name;
    text_init(&name, p->out->arena);
    text_put(&name, p->locals[slot]);
    text_str(&name, "_in");
    return (struct text_word){text_cstr(&name), name.len};
}

/* The host need not write `const` as we do. */
static enum lang_phrase param_phrase(const struct lang_syntax *syntax,
                                     const struct lang_slot *param, bool is_hosts)
{
    if (param->mode != LANG_IN && !syntax->results_in_struct)
        return param->mode == LANG_OUT ? PHRASE_PARAM_OUT : PHRASE_PARAM_INOUT;
    if (param->type == IR_TYPE_SAMPLER)
        return PHRASE_PLAIN;
    return param->assigned || is_hosts ? PHRASE_PARAM_ASSIGNED : PHRASE_PARAM_IN;
}

static void print_param(struct printer *p, uint32_t slot)
{
    const struct lang_slot *param = ast_slot(p->layer, p->fn, slot);
    struct text_word name = is_copied(p, param) ? copied_name(p, slot) : p->locals[slot];
    lang_print_variable(p->style, p->names, p->unit,
                        param_phrase(p->style->syntax, param, !p->fn->body), param->type, name,
                        p->out);
    if (param->type == IR_TYPE_SAMPLER)
        lang_put_sampler(p->style, name, p->out);
}

static void print_constant_arrays(struct printer *p)
{
    for (uint32_t i = 0; p->style->syntax->arrays_are_local && i < p->fn->num_globals; i++) {
        uint32_t id = ast_globals(p->layer, p->fn)[i];
        const struct lang_global *global = lang_global(p->unit, id, NULL);
        if (!ast_is_user_type(global->type) || !global->num_words)
            continue;
        text_str(p->out, "    ");
        lang_print_constant(p->style, p->names, p->unit, id, p->out);
    }
}

static void print_copies(struct printer *p)
{
    for (uint32_t i = 0; i < p->fn->num_params; i++) {
        if (!is_copied(p, ast_slot(p->layer, p->fn, i)))
            continue;
        text_str(p->out, "    ");
        print_variable(p, PHRASE_LOCAL, i);
        text_str(p->out, " = ");
        text_put(p->out, copied_name(p, i));
        text_str(p->out, ";\n");
    }
}

static void print_head(struct printer *p, uint32_t id)
{
    bool returns = p->has_results || p->fn->return_type != IR_TYPE_VOID, is_first = true;
    struct lang_type_text type =
        p->has_results ? print_results_type(p, id)
                       : lang_type_text(p->style, p->names, p->unit, p->fn->return_type);
    const char *array = print_array_name(p->names, type);
    if (array)
        type = (struct lang_type_text){lang_word(array), 0};
    text_str(p->out, p->style->exports);
    struct lang_declaration head =
        lang_open(p->style, returns ? PHRASE_FUNCTION : PHRASE_PROCEDURE, type,
                  lang_word(print_function_name(p->names, p->unit, id)), p->out);
    for (uint32_t i = 0; i < p->fn->num_params; i++) {
        if (p->has_results && ast_slot(p->layer, p->fn, i)->mode == LANG_OUT)
            continue;
        text_str(p->out, is_first ? "" : ", ");
        print_param(p, i);
        is_first = false;
    }
    lang_declare(p->style, &head, p->out);
}

void lang_print_results(struct lang_style *style, const struct lang_names *names,
                        const struct lang_unit *unit, uint32_t id, struct text *out)
{
    if (!lang_has_results(style->syntax, unit, id))
        return;
    struct printer p = start(style, names, unit, id, out);
    print_results_struct(&p, id);
}

void lang_print_function(struct lang_style *style, const struct lang_names *names,
                         const struct lang_unit *unit, uint32_t id, struct text *out)
{
    if (print_from_image(style, names, unit, id, out))
        return;
    struct printer p = start(style, names, unit, id, out);
    print_head(&p, id);
    if (!p.fn->body) {
        text_str(out, ";\n");
        return;
    }
    text_str(out, "\n{\n");
    if (p.has_results)
        print_result_locals(&p);
    print_constant_arrays(&p);
    print_copies(&p);
    print_body(&p, node_at(&p, p.fn->body));
    assert(p.num_visible == p.fn->num_params && p.indent == 0);
    if (p.has_results && p.fn->return_type == IR_TYPE_VOID) {
        text_str(out, "    ");
        print_return_results(&p, id, 0);
        text_str(out, ";\n");
    }
    text_str(out, "}\n");
}
