// SPDX-License-Identifier: Apache-2.0
/* From a path, as users write it, to the element that is generated. */
#include "api/api.h"

struct search {
    const mxg_document *document;
    const struct document *doc;
    struct diag_list *diags;
};

static const char *text_of(const struct search *s, str_id id)
{
    return str_text(s->doc->strings, id);
}

static void report_unknown(const struct search *s, const char *path)
{
    VEC(const char *) names = {0};
    for (uint32_t i = 0; i < s->document->renderables.len; i++)
        vec_push(s->diags->arena, &names, s->document->renderable_paths[i]);
    for (elem_id e = doc_element(s->doc, s->doc->root)->first_child; e; e = doc_element(s->doc, e)->next)
        if (doc_element(s->doc, e)->name)
            vec_push(s->diags->arena, &names, text_of(s, doc_element(s->doc, e)->name));
    diag_add(s->diags, DIAG_ID_unknown_element, (struct diag_place){.file = s->document->files.len ? s->document->files.items[0] : NULL},
             path, diag_suggest(s->diags->arena, path, names.items, names.len));
}

static void report_not_renderable(const struct search *s, elem_id element)
{
    const struct element *e = doc_element(s->doc, element);
    diag_add(s->diags, DIAG_ID_not_renderable, doc_place(s->doc, element), text_of(s, e->name), text_of(s, e->category));
}

/* "a, b, c": reports that the element stands for several. */
static void report_ambiguous(const struct search *s, elem_id element, const elem_id *choices, uint32_t num_choices)
{
    struct text list;
    text_init(&list, s->diags->arena);
    for (uint32_t i = 0; i < num_choices; i++) {
        text_str(&list, i ? ", " : "");
        doc_path(s->doc, choices[i], '/', &list);
    }
    diag_add(s->diags, DIAG_ID_ambiguous_output, doc_place(s->doc, element), text_of(s, doc_element(s->doc, element)->name),
             text_cstr(&list));
}

struct choices {
    elem_id *items;
    uint32_t len, cap;
};

static void add_choice(const struct search *s, struct choices *choices, elem_id element)
{
    for (uint32_t i = 0; i < choices->len; i++)
        if (choices->items[i] == element)
            return;
    vec_push(s->diags->arena, choices, element);
}

static elem_id only_choice(const struct search *s, elem_id element, const struct choices *choices)
{
    if (choices->len == 1)
        return choices->items[0];
    if (choices->len)
        report_ambiguous(s, element, choices->items, choices->len);
    else
        report_not_renderable(s, element);
    return 0;
}

/* The material that a <materialassign> names; 0: there is none. */
static elem_id assigned_material(const struct search *s, elem_id assign)
{
    return doc_child_of_kind(s->doc, s->doc->root, KIND_NODE, doc_attr_value(s->doc, assign, STR_material));
}

/* A look stands for its material, where it has only one. Looks inherit from looks. */
static elem_id find_in_look(const struct search *s, elem_id look)
{
    struct choices materials = {0};
    elem_id at = look;
    for (unsigned depth = 0; at && depth < 100; depth++) {
        for (elem_id e = doc_element(s->doc, at)->first_child; e; e = doc_element(s->doc, e)->next) {
            elem_id material = doc_element(s->doc, e)->kind == KIND_MATERIALASSIGN ? assigned_material(s, e) : 0;
            if (material)
                add_choice(s, &materials, material);
        }
        at = doc_child_of_kind(s->doc, s->doc->root, KIND_LOOK, doc_attr_value(s->doc, at, STR_inherit));
    }
    return only_choice(s, look, &materials);
}

/* A graph stands for its output, where it has only one. */
static elem_id find_in_graph(const struct search *s, elem_id graph)
{
    struct choices outputs = {0};
    for (elem_id e = doc_element(s->doc, graph)->first_child; e; e = doc_element(s->doc, e)->next)
        if (doc_element(s->doc, e)->kind == KIND_OUTPUT)
            add_choice(s, &outputs, e);
    return only_choice(s, graph, &outputs);
}

static elem_id find_meant(const struct search *s, elem_id element)
{
    switch (doc_element(s->doc, element)->kind) {
    case KIND_NODE:
    case KIND_OUTPUT:
        return element;
    case KIND_NODEGRAPH:
        return find_in_graph(s, element);
    case KIND_LOOK:
        return find_in_look(s, element);
    case KIND_MATERIALASSIGN: {
        elem_id material = assigned_material(s, element);
        if (material)
            return material;
        break;
    }
    default:
        break;
    }
    report_not_renderable(s, element);
    return 0;
}

elem_id document_find_element(const struct mxg_document *document, const char *path, struct diag_list *diags)
{
    struct search s = {document, &document->layer.doc, diags};
    if (!path && document->renderables.len)
        return document->renderables.items[0];
    if (!path) {
        diag_add(diags, DIAG_ID_nothing_to_render, doc_place(s.doc, s.doc->root));
        return 0;
    }
    elem_id element = doc_find(s.doc, path, strlen(path));
    if (element > s.doc->root) /* of the document itself, not of its library */
        return find_meant(&s, element);
    report_unknown(&s, path);
    return 0;
}
