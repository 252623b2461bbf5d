// SPDX-License-Identifier: Apache-2.0
/* Finds the element to generate from a path in the form that users write. */
#include "api/api.h"

#include <assert.h>

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
    struct diag_guess guess;
    diag_guess_begin(&guess, s->diags, path);
    for (uint32_t i = 0; i < s->document->renderables.num; i++)
        diag_guess_add(&guess, renderable_path(s->document, i));
    for (elem_id e = doc_element(s->doc, s->doc->root)->first_child; e;
         e = doc_element(s->doc, e)->next)
        if (doc_element(s->doc, e)->name)
            diag_guess_add(&guess, text_of(s, doc_element(s->doc, e)->name));
    diag_add(
        s->diags, DIAG_ID_unknown_element,
        (struct diag_place){.file = s->document->files.len ? s->document->files.items[0] : NULL},
        path, diag_guess_text(&guess));
}

static void report_not_renderable(const struct search *s, elem_id element, const char *reason)
{
    diag_add(s->diags, DIAG_ID_not_renderable, doc_place(s->doc, element),
             text_of(s, doc_element(s->doc, element)->name), reason);
}

static void report_kind(const struct search *s, elem_id element)
{
    struct text reason;
    text_init(&reason, s->diags->arena);
    text_fmt(&reason, "it is a <%s>; choose an output, node, material or look",
             text_of(s, doc_element(s->doc, element)->category));
    report_not_renderable(s, element, text_cstr(&reason));
}

/* Appends a path to the list "a, b, c"; `output` is an output of a node, or 0. */
static void list_choice(const struct search *s, struct text *list, elem_id element, str_id output)
{
    text_str(list, list->len ? ", " : "");
    doc_path(s->doc, element, '/', list);
    if (output)
        text_fmt(list, "/%s", text_of(s, output));
}

static void report_ambiguous(const struct search *s, elem_id element, struct text *list)
{
    diag_add(s->diags, DIAG_ID_ambiguous_output, doc_place(s->doc, element),
             text_of(s, doc_element(s->doc, element)->name), text_cstr(list));
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
    struct text list;
    text_init(&list, s->diags->arena);
    for (uint32_t i = 0; i < choices->len; i++)
        list_choice(s, &list, choices->items[i], 0);
    if (choices->len)
        report_ambiguous(s, element, &list);
    else
        report_not_renderable(s, element, "it has neither an output nor a material");
    return 0;
}

/* The material of a <materialassign>; 0: none. */
static elem_id assigned_material(const struct search *s, elem_id assign)
{
    return doc_child_of_kind(s->doc, s->doc->root, KIND_NODE,
                             doc_attr_value(s->doc, assign, STR_material));
}

/* True if a look, or a look that it inherits from, assigns a material. */
static bool look_assigns(const struct search *s, elem_id look, elem_id material)
{
    for (unsigned depth = 0; look && depth < 100; depth++) {
        for (elem_id e = doc_element(s->doc, look)->first_child; e;
             e = doc_element(s->doc, e)->next)
            if (doc_element(s->doc, e)->kind == KIND_MATERIALASSIGN
                && assigned_material(s, e) == material)
                return true;
        look = doc_child_of_kind(s->doc, s->doc->root, KIND_LOOK,
                                 doc_attr_value(s->doc, look, STR_inherit));
    }
    return false;
}

static elem_id find_top(const struct search *s, enum element_kind kind, const char *name,
                        size_t len)
{
    str_id id = str_find(s->doc->strings, name, len);
    return id ? doc_child_of_kind(s->doc, s->doc->root, kind, id) : 0;
}

/*
 * True if a look assigns a material. For names such as "day, night": one of the looks or look
 * groups.
 */
static bool assigns(const struct search *s, elem_id look, elem_id material, unsigned depth)
{
    enum { MAX_GROUPS = 16 };
    if (doc_element(s->doc, look)->kind == KIND_LOOK)
        return look_assigns(s, look, material);
    for (const char *name = str_text(s->doc->strings, doc_attr_value(s->doc, look, STR_looks));
         *name && depth < MAX_GROUPS;) {
        name += strspn(name, ", ");
        size_t len = strcspn(name, ", ");
        elem_id part = find_top(s, KIND_LOOK, name, len);
        if (!part)
            part = find_top(s, KIND_LOOKGROUP, name, len);
        if (part && assigns(s, part, material, depth + 1))
            return true;
        name += len;
    }
    return false;
}

/*
 * A look with one material stands for this material; a look group for its default look, or for all
 * its looks.
 */
static elem_id find_in_look(const struct search *s, elem_id look)
{
    assert(doc_element(s->doc, look)->kind == KIND_LOOK
           || doc_element(s->doc, look)->kind == KIND_LOOKGROUP);
    struct choices materials = {0};
    elem_id usual = doc_child_of_kind(s->doc, s->doc->root, KIND_LOOK,
                                      doc_attr_value(s->doc, look, STR_default));
    for (uint32_t i = 0; i < s->document->renderables.num; i++)
        if (assigns(s, usual ? usual : look, renderable_at(s->document, i), 0))
            add_choice(s, &materials, renderable_at(s->document, i));
    return only_choice(s, look, &materials);
}

/* A nodegraph with one output stands for this output. */
static elem_id find_in_graph(const struct search *s, elem_id graph)
{
    assert(doc_element(s->doc, graph)->kind == KIND_NODEGRAPH);
    struct choices outputs = {0};
    for (elem_id e = doc_element(s->doc, graph)->first_child; e; e = doc_element(s->doc, e)->next)
        if (doc_element(s->doc, e)->kind == KIND_OUTPUT)
            add_choice(s, &outputs, e);
    return only_choice(s, graph, &outputs);
}

/* Finds `output` of a node (0: its only output); false after a diagnostic. */
static bool find_output(const struct search *s, elem_id node, str_id output, unsigned *out_index)
{
    const struct library *lib = &s->document->layer;
    bool is_one_of_several = doc_attr_value(s->doc, node, STR_type) == STR_multioutput;
    if (output || !is_one_of_several) {
        int index = library_resolve_output(lib, node, node, output, DOC_TYPE_NONE, s->diags);
        *out_index = index < 0 ? 0 : (unsigned)index;
        return index >= 0;
    }
    uint32_t nodedef = library_match(lib, node, s->diags);
    if (nodedef == LIBRARY_NONE)
        return false;
    const struct nodedef *def = library_nodedef(lib, nodedef);
    const struct port *outputs = library_ports(lib, nodedef, NULL) + def->num_inputs;
    struct text list;
    text_init(&list, s->diags->arena);
    for (uint32_t i = 0; i < def->num_outputs; i++)
        list_choice(s, &list, node, outputs[i].name);
    if (def->num_outputs > 1)
        report_ambiguous(s, node, &list);
    *out_index = 0;
    return def->num_outputs == 1;
}

static elem_id find_meant(const struct search *s, elem_id element)
{
    switch (doc_element(s->doc, element)->kind) {
    case KIND_NODE:
    case KIND_OUTPUT: return element;
    case KIND_NODEGRAPH: return find_in_graph(s, element);
    case KIND_LOOK:
    case KIND_LOOKGROUP: return find_in_look(s, element);
    case KIND_MATERIALASSIGN: {
        elem_id material = assigned_material(s, element);
        if (material)
            return material;
        break;
    }
    default: break;
    }
    report_kind(s, element);
    return 0;
}

/* The element at a path, if it belongs to the document itself instead of its library; else 0. */
static elem_id find_own(const struct search *s, const char *path, size_t len)
{
    elem_id element = doc_find(s->doc, path, len);
    return element > s->doc->root ? element : 0;
}

/*
 * Finds "node/out": *out_output becomes the name of the node's output, declared in the document or
 * not.
 */
static elem_id find_path(const struct search *s, const char *path, str_id *out_output)
{
    elem_id element = find_own(s, path, strlen(path)),
            parent = element ? doc_element(s->doc, element)->parent : 0;
    if (parent && doc_element(s->doc, element)->kind == KIND_OUTPUT
        && doc_element(s->doc, parent)->kind == KIND_NODE) {
        *out_output = doc_element(s->doc, element)->name;
        return parent;
    }
    const char *slash = element ? NULL : strrchr(path, '/');
    elem_id node = slash ? find_own(s, path, (size_t)(slash - path)) : 0;
    if (!node || doc_element(s->doc, node)->kind != KIND_NODE)
        return element;
    *out_output = str_find(s->doc->strings, slash + 1, strlen(slash + 1));
    return *out_output ? node : 0;
}

static elem_id find_asked(const struct search *s, const char *path, str_id *out_output)
{
    elem_id found = find_path(s, path, out_output);
    if (!found)
        report_unknown(s, path);
    return found ? find_meant(s, found) : 0;
}

/* A document of an earlier version than it declares may have materials that are none now. */
static void report_nothing(const struct search *s)
{
    for (elem_id e = doc_element(s->doc, s->doc->root)->first_child; e;
         e = doc_element(s->doc, e)->next)
        if (doc_is_outdated(s->doc, e)) {
            doc_report_outdated(s->doc, e, s->diags);
            return;
        }
    diag_add(s->diags, DIAG_ID_nothing_to_render, doc_place(s->doc, s->doc->root));
}

elem_id document_find_element(const struct mxg_document *document, const char *path,
                              struct diag_list *diags, str_id *out_output, unsigned *out_index)
{
    struct search s = {document, &document->layer.doc, diags};
    *out_output = STR_EMPTY;
    *out_index = 0;
    elem_id element = 0;
    if (path)
        element = find_asked(&s, path, out_output);
    else if (document->renderables.num)
        element = renderable_at(document, 0);
    else
        report_nothing(&s);
    if (element && doc_element(s.doc, element)->kind == KIND_NODE
        && !find_output(&s, element, *out_output, out_index))
        return 0;
    assert(!element || element > s.doc->root);
    return element;
}

bool mxg_document_has_assignment(const mxg_document *document, const char *look, uint32_t index)
{
    if (!look || index >= mxg_document_num_renderables(document))
        return false;
    struct search s = {document, &document->layer.doc, NULL};
    elem_id element = find_own(&s, look, strlen(look));
    enum element_kind kind = element ? doc_element(s.doc, element)->kind : KIND_NODE;
    return (kind == KIND_LOOK || kind == KIND_LOOKGROUP)
           && assigns(&s, element, renderable_at(document, index), 0);
}
