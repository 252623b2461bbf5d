// SPDX-License-Identifier: Apache-2.0
/* Checks of references: connections and their types, inheritance, looks; cycles in a graph. */
#include "document/validate.h"

enum { MAX_CANDIDATES = 256 }; /* names looked through for a suggestion */

static const char *text_of(const struct validation *v, str_id id)
{
    return str_text(v->doc->strings, id);
}

/* " (did you mean 'x'?)" from the children of a kind. */
static const char *suggest_child(struct validation *v, elem_id parent, enum element_kind kind, str_id wanted)
{
    const char *names[MAX_CANDIDATES];
    size_t count = 0;
    if (v->diags->num_errors > MAX_SUGGESTIONS)
        return "";
    elem_id e = parent ? doc_element(v->doc, parent)->first_child : 0;
    for (; e && count < MAX_CANDIDATES; e = doc_element(v->doc, e)->next)
        if (doc_element(v->doc, e)->kind == kind)
            names[count++] = text_of(v, doc_element(v->doc, e)->name);
    return diag_suggest(v->arena, text_of(v, wanted), names, count);
}

/* A top-level element of a kind, in the document or in what it stands on; 0: none. */
static elem_id find_top_level(const struct document *doc, enum element_kind kind, str_id name)
{
    elem_id found = 0;
    for (; doc && !found; doc = doc->base)
        found = doc_child_of_kind(doc, doc->root, kind, name);
    return found;
}

/* The graph whose nodes a port's nodename means; 0: none. */
static elem_id scope_of(const struct document *doc, elem_id port)
{
    const struct element *e = doc_element(doc, port);
    return e->kind == KIND_OUTPUT ? e->parent : doc_element(doc, e->parent)->parent;
}

static void check_types(struct validation *v, elem_id port, str_id attr, str_id source_type)
{
    str_id type = doc_attr_value(v->doc, port, STR_type);
    bool fits = type == source_type || !type || !source_type || source_type == STR_multioutput
                || (type == STR_filename && source_type == STR_string);
    if (!fits)
        diag_add(v->diags, DIAG_ID_type_mismatch, doc_attr_place(v->doc, port, attr),
                 text_of(v, doc_element(v->doc, port)->name), text_of(v, type), text_of(v, source_type));
}

static void check_nodename(struct validation *v, elem_id port, str_id name)
{
    const struct document *doc = v->doc;
    elem_id scope = scope_of(doc, port), node = scope ? doc_child(doc, scope, name) : 0;
    enum element_kind kind = node ? (enum element_kind)doc_element(doc, node)->kind : KIND_MATERIALX;
    if (kind == KIND_NODE) {
        check_types(v, port, STR_nodename, doc_attr_value(doc, node, STR_type));
    } else if (kind != KIND_NODEGRAPH) {
        diag_add(v->diags, DIAG_ID_dangling_nodename, doc_attr_place(doc, port, STR_nodename), text_of(v, name),
                 suggest_child(v, scope, KIND_NODE, name));
    }
}

/* The output of a graph that a port means; 0 where that is reported or left to the definition. */
static elem_id find_output(struct validation *v, elem_id port, elem_id graph)
{
    const struct document *doc = v->doc;
    str_id name = doc_attr_value(doc, port, STR_output);
    const char *graph_name = text_of(v, doc_element(doc, graph)->name);
    if (name) {
        elem_id found = doc_child_of_kind(doc, graph, KIND_OUTPUT, name);
        if (!found)
            diag_add(v->diags, DIAG_ID_dangling_output, doc_attr_place(doc, port, STR_output), graph_name, text_of(v, name),
                     suggest_child(v, graph, KIND_OUTPUT, name));
        return found;
    }
    elem_id first = 0, fitting = 0;
    uint32_t count = 0;
    for (elem_id e = doc_element(doc, graph)->first_child; e; e = doc_element(doc, e)->next) {
        if (doc_element(doc, e)->kind != KIND_OUTPUT)
            continue;
        count++;
        first = first ? first : e;
        if (!fitting && doc_attr_value(doc, e, STR_type) == doc_attr_value(doc, port, STR_type))
            fitting = e;
    }
    elem_id assumed = fitting ? fitting : first;
    if (count > 1) {
        const char *output = text_of(v, doc_element(doc, assumed)->name);
        diag_add(v->diags, DIAG_ID_output_needed, doc_attr_place(doc, port, STR_nodegraph), graph_name, output, output);
    }
    return assumed;
}

static void check_nodegraph(struct validation *v, elem_id port, str_id name)
{
    const struct document *doc = v->doc;
    elem_id scope = scope_of(doc, port), graph = scope ? doc_child_of_kind(doc, scope, KIND_NODEGRAPH, name) : 0;
    if (!graph)
        graph = find_top_level(doc, KIND_NODEGRAPH, name);
    if (!graph) {
        diag_add(v->diags, DIAG_ID_dangling_nodegraph, doc_attr_place(doc, port, STR_nodegraph), text_of(v, name),
                 suggest_child(v, doc->root, KIND_NODEGRAPH, name));
        return;
    }
    elem_id output = find_output(v, port, graph);
    if (output)
        check_types(v, port, STR_nodegraph, doc_attr_value(doc, output, STR_type));
}

/* Whether an <implementation> makes a graph the implementation of a definition, which then says the inputs. */
static bool is_implementation(const struct document *doc, elem_id graph)
{
    str_id name = doc_element(doc, graph)->name;
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_IMPLEMENTATION && doc_attr_value(doc, e, STR_nodegraph) == name)
            return true;
    return false;
}

/* The input of a definition or of one it inherits from. */
static elem_id find_nodedef_input(const struct document *doc, elem_id nodedef, str_id name)
{
    enum { MAX_INHERITANCE = 64 };
    elem_id found = 0;
    for (int depth = 0; nodedef && !found && depth < MAX_INHERITANCE; depth++) {
        found = doc_child(doc, nodedef, name);
        nodedef = find_top_level(doc, KIND_NODEDEF, doc_attr_value(doc, nodedef, STR_inherit));
    }
    return found;
}

static void check_interfacename(struct validation *v, elem_id port, str_id name)
{
    const struct document *doc = v->doc;
    elem_id graph = doc_element(doc, port)->parent;
    while (graph && doc_element(doc, graph)->kind != KIND_NODEGRAPH)
        graph = doc_element(doc, graph)->parent;
    elem_id input = graph ? doc_child(doc, graph, name) : 0;
    str_id nodedef_name = graph ? doc_attr_value(doc, graph, STR_nodedef) : STR_EMPTY;
    if (!input && nodedef_name) {
        elem_id nodedef = find_top_level(doc, KIND_NODEDEF, nodedef_name);
        if (!nodedef)
            return; /* it may be in a library that is not here */
        input = find_nodedef_input(doc, nodedef, name);
    } else if (!input && graph && is_implementation(doc, graph)) {
        return;
    }
    if (!input)
        diag_add(v->diags, DIAG_ID_dangling_interfacename, doc_attr_place(doc, port, STR_interfacename), text_of(v, name),
                 suggest_child(v, graph, KIND_INPUT, name));
    else
        check_types(v, port, STR_interfacename, doc_attr_value(doc, input, STR_type));
}

static void check_connections(struct validation *v, elem_id port)
{
    str_id nodename = doc_attr_value(v->doc, port, STR_nodename), graph = doc_attr_value(v->doc, port, STR_nodegraph);
    str_id interface = doc_attr_value(v->doc, port, STR_interfacename);
    if (nodename)
        check_nodename(v, port, nodename);
    if (graph)
        check_nodegraph(v, port, graph);
    if (interface)
        check_interfacename(v, port, interface);
}

/* References to top-level elements; lists have commas. */
static const struct {
    enum element_kind kind;
    str_id attr;
    enum element_kind target;
} references[] = {
    {KIND_MATERIALASSIGN, STR_collection, KIND_COLLECTION},
    {KIND_VISIBILITY, STR_collection, KIND_COLLECTION},
    {KIND_PROPERTYASSIGN, STR_collection, KIND_COLLECTION},
    {KIND_PROPERTYSETASSIGN, STR_collection, KIND_COLLECTION},
    {KIND_PROPERTYSETASSIGN, STR_propertyset, KIND_PROPERTYSET},
    {KIND_COLLECTION, STR_includecollection, KIND_COLLECTION},
    {KIND_LOOKGROUP, STR_looks, KIND_LOOK},
    {KIND_VARIANTASSIGN, STR_variantset, KIND_VARIANTSET},
    {KIND_UNITDEF, STR_unittype, KIND_UNITTYPEDEF},
    {KIND_MATERIALASSIGN, STR_material, KIND_NODE},
};

static void check_reference(struct validation *v, elem_id element, str_id attr, enum element_kind target)
{
    const struct document *doc = v->doc;
    str_id value = doc_attr_value(doc, element, attr);
    const char *text = str_text(doc->strings, value);
    for (text += strspn(text, ", "); *text; text += strspn(text, ", ")) {
        size_t len = strcspn(text, ", ");
        str_id name = str_find(doc->strings, text, len);
        bool graph_has_material = target == KIND_NODE && find_top_level(doc, KIND_NODEGRAPH, name);
        if ((!name || !find_top_level(doc, target, name)) && !graph_has_material)
            diag_add(v->diags, DIAG_ID_dangling_reference, doc_attr_place(doc, element, attr), text_of(v, attr),
                     arena_strndup(v->arena, text, len));
        text += len;
    }
}

static void check_references(struct validation *v, elem_id element)
{
    enum element_kind kind = (enum element_kind)doc_element(v->doc, element)->kind;
    for (size_t i = 0; i < sizeof references / sizeof *references; i++)
        if (references[i].kind == kind && doc_attr_value(v->doc, element, references[i].attr))
            check_reference(v, element, references[i].attr, references[i].target);
}

/*
 * Inheritance: each element of the document is followed once. marks[element] is the element that the walk began at; a walk that
 * comes to its own mark went round.
 */
static void check_inheritance(struct validation *v, elem_id element, elem_id *marks)
{
    const struct document *doc = v->doc;
    const struct element *start = doc_element(doc, element);
    bool by_name = start->kind == KIND_NODEDEF || start->kind == KIND_LOOK || start->kind == KIND_TARGETDEF;
    elem_id e = element;
    while (by_name && e >= doc->first_element && !marks[e - doc->first_element]) {
        marks[e - doc->first_element] = element;
        str_id base = doc_attr_value(doc, e, STR_inherit);
        if (!base)
            return;
        elem_id next = find_top_level(doc, (enum element_kind)start->kind, base);
        if (!next) {
            diag_add(v->diags, DIAG_ID_inherit_missing, doc_attr_place(doc, e, STR_inherit), text_of(v, doc_element(doc, e)->name),
                     text_of(v, base));
            return;
        }
        e = next;
    }
    if (by_name && e >= doc->first_element && marks[e - doc->first_element] == element)
        diag_add(v->diags, DIAG_ID_inherit_cycle, doc_attr_place(doc, e, STR_inherit), text_of(v, doc_element(doc, e)->name));
}

/* Cycles: a depth-first walk along the nodes of a graph, on a stack of its own. */

enum { NEW, ON_PATH, DONE };

struct path_step {
    elem_id node, input; /* the input followed, or to follow next; 0: all done */
};

struct walk {
    struct validation *v;
    uint8_t *states; /* by element */
    VEC(struct path_step) path;
};

static void report_cycle(struct walk *w, elem_id again)
{
    const struct document *doc = w->v->doc;
    struct text text;
    text_init(&text, w->v->arena);
    uint32_t i = w->path.len - 1;
    while (w->path.items[i].node != again)
        i--;
    for (; i < w->path.len; i++) {
        text_str(&text, text_of(w->v, doc_element(doc, w->path.items[i].node)->name));
        text_str(&text, " -> ");
    }
    text_str(&text, text_of(w->v, doc_element(doc, again)->name));
    diag_add(w->v->diags, DIAG_ID_cycle, doc_place(doc, again), text_cstr(&text));
}

static void enter(struct walk *w, elem_id node)
{
    const struct document *doc = w->v->doc;
    uint8_t *state = &w->states[node - doc->first_element];
    if (*state == ON_PATH)
        report_cycle(w, node);
    if (*state != NEW)
        return;
    *state = ON_PATH;
    vec_push(w->v->arena, &w->path, (struct path_step){node, doc_element(doc, node)->first_child});
}

static void check_cycles_from(struct walk *w, elem_id start)
{
    const struct document *doc = w->v->doc;
    enter(w, start);
    while (w->path.len) {
        struct path_step *step = &vec_last(&w->path);
        elem_id input = step->input;
        if (!input) {
            w->states[step->node - doc->first_element] = DONE;
            (void)vec_pop(&w->path);
            continue;
        }
        step->input = doc_element(doc, input)->next;
        str_id name = doc_attr_value(doc, input, STR_nodename);
        elem_id node = name ? doc_child_of_kind(doc, doc_element(doc, step->node)->parent, KIND_NODE, name) : 0;
        if (node)
            enter(w, node);
    }
}

void validate_links(struct validation *v)
{
    const struct document *doc = v->doc;
    struct walk walk = {.v = v, .states = ARENA_ARRAY(v->arena, uint8_t, doc->elements.len)};
    elem_id *marks = ARENA_ARRAY(v->arena, elem_id, doc->elements.len);
    for (elem_id e = doc->root; e; e = doc_next_in_tree(doc, doc->root, e)) {
        enum element_kind kind = (enum element_kind)doc_element(doc, e)->kind;
        if ((kind == KIND_INPUT || kind == KIND_OUTPUT) && doc_element(doc, e)->parent)
            check_connections(v, e);
        check_references(v, e);
        check_inheritance(v, e, marks);
        if (kind == KIND_NODE)
            check_cycles_from(&walk, e);
    }
}
