// SPDX-License-Identifier: Apache-2.0
/* Assignments and unknown elements in messages. */
#include "bind/look.h"

static const char *text_of(const struct bind_look *look, str_id id)
{
    return str_text(look->doc->strings, id);
}

void look_guess(const struct bind_look *look, struct diag_guess *guess, enum element_kind kind)
{
    const struct document *doc = look->doc;
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == kind
            && (kind != KIND_NODE || doc_attr_value(doc, e, STR_type) == STR_material))
            diag_guess_add(guess, text_of(look, doc_element(doc, e)->name));
}

void look_report_unknown(struct bind_look *look, elem_id element, str_id attr, const char *what,
                         enum element_kind kind)
{
    const struct document *doc = look->doc;
    const char *name = text_of(look, doc_attr_value(doc, element, attr)), *near = "";
    struct diag_guess guess;
    if (diag_guess_begin(&guess, look->diags, name)) {
        look_guess(look, &guess, kind);
        near = diag_guess_text(&guess);
    }
    diag_add(look->diags, DIAG_ID_unknown_assigned, doc_attr_place(doc, element, attr), what, name,
             near);
}

void look_assign_name(const struct bind_look *look, uint32_t assign, struct text *out)
{
    const struct look_assign *a = &look->assigns.items[assign];
    const struct document *doc = look->doc;
    if (a->binding) {
        scene_write_binding(look->scene, &look->scene->bindings.items[a->binding - 1], out);
        return;
    }
    str_id name = doc_element(doc, a->element)->name;
    text_fmt(out, "%s/", text_of(look, doc_element(doc, a->look)->name));
    if (name)
        text_str(out, text_of(look, name));
    else
        text_fmt(out, "#%u", (unsigned)a->ordinal);
}

struct diag_place look_assign_place(const struct bind_look *look, const struct look_assign *assign)
{
    return assign->binding ? look->scene->bindings.items[assign->binding - 1].place
                           : doc_place(look->doc, assign->element);
}

struct diag_place look_slot_place(const struct bind_look *look, const struct look_assign *assign)
{
    return assign->binding ? look->scene->bindings.items[assign->binding - 1].place
                           : doc_attr_place(look->doc, assign->element, STR_slot);
}
