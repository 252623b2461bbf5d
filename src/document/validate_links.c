// SPDX-License-Identifier: Apache-2.0
/* Checks of references: inheritance, looks, and cycles in a nodegraph. */
#include "document/validate_elements.h"

#include <assert.h>

static const char *text_of(const struct validation *v, str_id id)
{
    return str_text(v->doc->strings, id);
}

/* The kind of element that an attribute names, as messages call it. */
static const char *target_of(const struct validation *v, const struct doc_naming *naming)
{
    static const str_id words[] = {
#define KIND(ID, word) [KIND_##ID] = STR_##word,
#include "document/kinds.def"
#undef KIND
    };
    bool may_be_node = naming->targets >> KIND_NODE & 1 && naming->attr != STR_material;
    for (size_t i = 0; i < sizeof words / sizeof *words && !may_be_node; i++)
        if (words[i] && naming->targets >> i & 1)
            return text_of(v, naming->attr == STR_material ? STR_material : words[i]);
    return "node";
}

/* Lists have commas. */
static void check_reference(struct validation *v, elem_id element, const struct doc_naming *naming)
{
    const struct document *doc = v->doc;
    const char *text = text_of(v, doc_attr_value(doc, element, naming->attr)), *part;
    size_t len;
    while (part = doc_next_name(&text, &len), len) {
        str_id name = str_find(doc->strings, part, len);
        if (!name || !doc_names_element(doc, element, naming, name))
            diag_add(v->diags, DIAG_ID_dangling_reference,
                     doc_attr_place(doc, element, naming->attr), target_of(v, naming),
                     arena_strndup(v->arena, part, len));
    }
}

static void check_references(struct validation *v, elem_id element)
{
    enum element_kind kind = (enum element_kind)doc_element(v->doc, element)->kind;
    if (kind == KIND_NODE || kind == KIND_INPUT || kind == KIND_OUTPUT)
        return; /* most attributes are not checked here */
    for (uint32_t i = 0; i < doc_element(v->doc, element)->num_attrs; i++) {
        const struct doc_naming *naming =
            doc_naming(v->doc, element, doc_attrs(v->doc, element)[i].name);
        if (naming && naming->checked >> kind & 1)
            check_reference(v, element, naming);
    }
}

/*
 * Inheritance. The walk visits each element of the document once. marks[element] is the start of
 * the walk that visited it; a walk that meets its own mark found a cycle.
 */
static void check_inheritance(struct validation *v, elem_id element, elem_id *marks)
{
    const struct document *doc = v->doc;
    const struct element *start = doc_element(doc, element);
    bool by_name = start->kind == KIND_NODEDEF || start->kind == KIND_LOOK
                   || start->kind == KIND_TARGETDEF || start->kind == KIND_TYPEDEF;
    elem_id e = element;
    while (by_name && e >= doc->first_element && !marks[e - doc->first_element]) {
        marks[e - doc->first_element] = element;
        str_id base = doc_attr_value(doc, e, STR_inherit);
        if (!base || (start->kind == KIND_TYPEDEF && doc_type_of(base)))
            return;
        elem_id next = doc_top_level(doc, (enum element_kind)start->kind, base);
        if (!next) {
            diag_add(v->diags, DIAG_ID_inherit_missing, doc_attr_place(doc, e, STR_inherit),
                     text_of(v, doc_element(doc, e)->name), text_of(v, base));
            return;
        }
        e = next;
    }
    if (by_name && e >= doc->first_element && marks[e - doc->first_element] == element)
        diag_add(v->diags, DIAG_ID_inherit_cycle, doc_attr_place(doc, e, STR_inherit),
                 text_of(v, doc_element(doc, e)->name));
}

/* Cycles: a depth-first walk along the nodes of a nodegraph, with an explicit stack. */

enum { NEW, ON_PATH, DONE };

struct path_step {
    elem_id node, input; /* the next input; 0: all done */
    elem_id reading;     /* the current input */
};

struct walk {
    struct validation *v;
    uint8_t *states; /* by element */
    VEC(struct path_step) path;
};

static void report_cycle(struct walk *w, elem_id again)
{
    assert(w->path.len > 0);
    uint32_t first = w->path.len - 1;
    while (w->path.items[first].node != again)
        first--;
    uint32_t n = w->path.len - first;
    struct doc_cycle_link *links = ARENA_ARRAY(w->v->arena, struct doc_cycle_link, n);
    for (uint32_t i = 0; i < n; i++)
        links[i] = (struct doc_cycle_link){w->path.items[first + i].node,
                                           w->path.items[first + i].reading};
    doc_report_cycle(w->v->doc, links, n, w->v->diags);
}

static void enter(struct walk *w, elem_id node)
{
    const struct document *doc = w->v->doc;
    assert(node - doc->first_element < doc_num_elements(doc));
    uint8_t *state = &w->states[node - doc->first_element];
    if (*state == ON_PATH)
        report_cycle(w, node);
    if (*state != NEW)
        return;
    *state = ON_PATH;
    vec_push(w->v->arena, &w->path,
             (struct path_step){node, doc_element(doc, node)->first_child, 0});
}

static void check_cycles_from(struct walk *w, elem_id start)
{
    assert(w->path.len == 0);
    const struct document *doc = w->v->doc;
    enter(w, start);
    while (w->path.len) {
        struct path_step *step = &vec_last(&w->path);
        elem_id input = step->input;
        if (!input) {
            assert(w->states[step->node - doc->first_element] == ON_PATH);
            w->states[step->node - doc->first_element] = DONE;
            (void)vec_pop(&w->path);
            continue;
        }
        step->input = doc_element(doc, input)->next;
        step->reading = input;
        str_id name = doc_attr_value(doc, input, STR_nodename);
        elem_id node =
            name ? doc_child_of_kind(doc, doc_element(doc, step->node)->parent, KIND_NODE, name)
                 : 0;
        if (node)
            enter(w, node);
    }
}

/* ---- Elements that contain others of their kind by a list of names ---- */

static const struct nesting {
    enum element_kind kind;
    str_id attr;
} nestings[] = {{KIND_COLLECTION, STR_includecollection}, {KIND_LOOKGROUP, STR_looks}};

struct container {
    elem_id element;
    const char *rest; /* of its list */
};

struct containers {
    struct container *items;
    uint32_t len, cap;
};

static void report_nesting(struct validation *v, const struct nesting *nesting,
                           const struct containers *path, elem_id again)
{
    struct text names;
    text_init(&names, v->arena);
    uint32_t i = path->len;
    while (path->items[--i].element != again)
        continue;
    for (; i < path->len; i++)
        text_fmt(&names, "%s -> ", text_of(v, doc_element(v->doc, path->items[i].element)->name));
    const char *name = text_of(v, doc_element(v->doc, again)->name);
    text_str(&names, name);
    struct diag_place place = doc_attr_place(v->doc, vec_last(path).element, nesting->attr);
    if (nesting->kind == KIND_COLLECTION)
        diag_add(v->diags, DIAG_ID_collection_cycle, place, name, text_cstr(&names));
    else
        diag_add(v->diags, DIAG_ID_look_cycle, place, name, "among its looks");
}

static void open_container(struct walk *w, const struct nesting *nesting, struct containers *path,
                           elem_id element)
{
    uint8_t *state = &w->states[element - w->v->doc->first_element];
    if (*state == ON_PATH)
        report_nesting(w->v, nesting, path, element);
    if (*state != NEW)
        return;
    *state = ON_PATH;
    const char *list = text_of(w->v, doc_attr_value(w->v->doc, element, nesting->attr));
    vec_push(w->v->arena, path, (struct container){element, list});
}

static void check_nesting(struct walk *w, const struct nesting *nesting, elem_id start)
{
    const struct document *doc = w->v->doc;
    struct containers path = {0};
    open_container(w, nesting, &path, start);
    while (path.len) {
        size_t len;
        const char *name = doc_next_name(&vec_last(&path).rest, &len);
        if (!len) {
            w->states[vec_pop(&path).element - doc->first_element] = DONE;
            continue;
        }
        str_id id = str_find(doc->strings, name, len);
        elem_id inner = id ? doc_top_level(doc, nesting->kind, id) : 0;
        if (inner >= doc->first_element)
            open_container(w, nesting, &path, inner);
    }
}

void validate_links(struct validation *v)
{
    const struct document *doc = v->doc;
    struct walk walk = {.v = v, .states = ARENA_ARRAY(v->arena, uint8_t, doc_num_elements(doc))};
    elem_id *marks = ARENA_ARRAY(v->arena, elem_id, doc_num_elements(doc));
    for (elem_id e = doc->root; e; e = doc_next_in_tree(doc, doc->root, e)) {
        enum element_kind kind = (enum element_kind)doc_element(doc, e)->kind;
        check_references(v, e);
        check_inheritance(v, e, marks);
        if (kind == KIND_NODE)
            check_cycles_from(&walk, e);
        for (size_t i = 0; i < sizeof nestings / sizeof *nestings; i++)
            if (kind == nestings[i].kind)
                check_nesting(&walk, &nestings[i], e);
    }
}
