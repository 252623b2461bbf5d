// SPDX-License-Identifier: Apache-2.0
/*
 * Definitions that are nodegraphs, where what is inside of them has to stand in the document. A
 * surface with another one inside, for which there is a translation, becomes that one. A closure
 * with textures or patterns inside, which are no formulas of its inputs, becomes its nodes. A
 * material becomes its nodes, too, because there is a surface inside. All happen level by level.
 */
#include "api/translate.h"

#include "api/edit.h"

/* ---- Nodes ---- */

static bool is_tree(const struct document *doc, elem_id node)
{
    ir_type_id type = doc_type_ir(doc_type_of(doc_attr_value(doc, node, STR_type)));
    return ir_type_is_closure(type) || ir_type_is_shader(type);
}

/*
 * Without an edit it only counts. What nothing reads in the end goes, except for surfaces and
 * materials.
 */
static bool flatten(struct translation *t, elem_id node)
{
    t->num_flattened++;
    if (!t->edit)
        return true;
    const struct document *doc = edit_tree(t->edit);
    elem_id scope = doc_element(doc, node)->parent,
            first = doc->first_element + doc_num_elements(doc);
    if (mxg_edit_flatten_node(t->edit, node) != MXG_OK) {
        t->num_flattened--; /* another surface has it, too, or the document is full */
        return false;
    }
    for (elem_id e = first; e < doc->first_element + doc_num_elements(doc); e++) {
        if (doc_element(doc, e)->parent != scope)
            continue;
        if (is_tree(doc, e))
            vec_push(t->kept, &t->opened, e);
        str_id type = doc_attr_value(doc, e, STR_type);
        if (type != STR_surfaceshader && type != STR_material)
            vec_push(t->kept, &t->replaced, e);
    }
    return true;
}

static uint32_t definition_of(const struct translation *t, elem_id node)
{
    struct diag_list unheard;
    diag_list_init_unheard(&unheard, t->arena);
    return doc_element(&t->document->layer.doc, node)->kind == KIND_NODE
               ? library_match(&t->document->layer, node, &unheard)
               : LIBRARY_NONE;
}

/* ---- Surfaces inside of surfaces ---- */

/* The node behind the only output of the nodegraph that implements a definition; 0: none. */
static elem_id node_inside(const struct translation *t, uint32_t nodedef)
{
    const struct library *lib = &t->document->layer;
    elem_id graph = nodedef == LIBRARY_NONE ? 0 : edit_find_graph(lib, nodedef);
    const struct nodedef *def = graph ? library_nodedef(lib, nodedef) : NULL;
    if (!def || def->num_outputs != 1)
        return 0;
    elem_id output = library_inner_output(lib, nodedef, 0, &lib->doc, graph);
    return output ? doc_named_node(&lib->doc, output) : 0;
}

/* True if a surface is, some levels down, one that a translation leads on from. */
static bool has_model_inside(struct translation *t, elem_id surface)
{
    enum { MAX_LEVELS = 32 }; /* a definition may contain itself, which is told elsewhere */
    elem_id node = surface;
    for (unsigned i = 0; i < MAX_LEVELS && node; i++) {
        if (node != surface && translate_leads(t, node))
            return true;
        node = node_inside(t, definition_of(t, node));
    }
    return false;
}

/* ---- Patterns inside of closures ---- */

enum { PATTERNS_UNKNOWN, PATTERNS_NONE, PATTERNS_INSIDE };

/* Nodes of these groups are no formulas of their inputs. */
static bool is_pattern(const struct library *lib, uint32_t nodedef)
{
    static const char *const groups[] = {"texture2d",    "texture3d",    "procedural",
                                         "procedural2d", "procedural3d", "geometric",
                                         "application",  "convolution2d"};
    elem_id element = library_nodedef(lib, nodedef)->element;
    const char *group = str_text(&lib->strings, doc_attr_value(&lib->doc, element, STR_nodegroup));
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        if (strcmp(groups[i], group) == 0)
            return true;
    return false;
}

/* True if the nodegraph of a definition has patterns, at any level. A cycle has none. */
static bool has_patterns(struct translation *t, uint32_t nodedef)
{
    const struct library *lib = &t->document->layer;
    if (nodedef == LIBRARY_NONE || t->patterns[nodedef])
        return nodedef != LIBRARY_NONE && t->patterns[nodedef] == PATTERNS_INSIDE;
    t->patterns[nodedef] = PATTERNS_NONE;
    elem_id graph = edit_find_graph(lib, nodedef);
    bool has = false;
    for (elem_id e = graph; e && !has; e = doc_next_in_tree(&lib->doc, graph, e)) {
        uint32_t inner = definition_of(t, e);
        has = inner != LIBRARY_NONE && (is_pattern(lib, inner) || has_patterns(t, inner));
    }
    t->patterns[nodedef] = has ? PATTERNS_INSIDE : PATTERNS_NONE;
    return has;
}

/* ---- Rounds ---- */

static void open_one(struct translation *t, elem_id surface)
{
    t->surface = surface;
    if (translate_leads(t, surface))
        return;
    bool is_shell = has_model_inside(t, surface);
    translate_find_closures(t);
    for (uint32_t i = 0; i < t->closures.len; i++) {
        elem_id node = t->closures.items[i];
        bool opens = is_shell ? node == surface : has_patterns(t, definition_of(t, node));
        /* messages about faults have places in the document as it was */
        if (opens && !translate_can_build(t))
            break;
        if (opens)
            flatten(t, node);
    }
    translate_forget_surface(t);
}

/* A material by a nodegraph stands in the document with its surface, which is then translated. */
static void open_material(struct translation *t, elem_id node)
{
    const struct document *doc = &t->document->layer.doc;
    uint32_t nodedef =
        doc_attr_value(doc, node, STR_type) == STR_material ? definition_of(t, node) : LIBRARY_NONE;
    if (nodedef == LIBRARY_NONE || !edit_find_graph(&t->document->layer, nodedef))
        return;
    t->surface = node;
    if (translate_is_sound(t) && !flatten(t, node))
        diag_add(t->diags, DIAG_ID_no_translation, doc_name_place(doc, node),
                 str_text(doc->strings, doc_element(doc, node)->category), t->wanted);
    translate_forget_surface(t);
}

/* False: no node was flattened. */
static bool open_level(struct translation *t,
                       void (*visit_all)(struct translation *t,
                                         void (*visit)(struct translation *t, elem_id node)),
                       void (*open)(struct translation *t, elem_id node))
{
    for (unsigned with_edit = 0; with_edit < 2; with_edit++) {
        t->num_flattened = 0;
        t->patterns = ARENA_ARRAY(t->kept, uint8_t, library_num_nodedefs(&t->document->layer));
        translate_forget_closures(t);
        if (with_edit)
            translate_start_edit(t);
        visit_all(t, open);
        if (with_edit)
            translate_commit_edit(t);
        if (!t->num_flattened || t->diags->num_errors)
            return false;
    }
    return true;
}

/* ---- Constants ---- */

/* The value that a definition computed of constants alone, for an input of what it had inside. */
static bool find_constant(struct translation *t, elem_id input, elem_id first_inside,
                          struct operand *out)
{
    const struct document *doc = &t->document->layer.doc;
    mxg_connection connection = {.size = sizeof connection};
    const char *type = str_text(doc->strings, doc_attr_value(doc, input, STR_type));
    struct text path;
    *out = (struct operand){.kind = OPERAND_CONSTANT, .type = value_type_of(type)};
    if (out->type == VALUE_NONE || doc_element(doc, input)->kind != KIND_INPUT
        || mxg_document_connection(t->document, input, &connection) != MXG_OK
        || connection.source < first_inside)
        return false;
    text_init(&path, t->arena);
    doc_path(doc, connection.source, '/', &path);
    text_fmt(&path, "%s%s", *connection.output ? "/" : "", connection.output);
    ir_ref root = translate_build_path(t, t->document, text_cstr(&path), "");
    return root && ir_get_const(&t->value->graph, root, &out->value);
}

static void fold(struct translation *t, elem_id first_inside)
{
    const struct document *doc = &t->document->layer.doc;
    translate_start_edit(t);
    for (uint32_t i = 0; i < t->opened.len; i++) {
        t->surface = t->opened.items[i];
        if (!doc_has_element(doc, t->surface)) /* it was opened itself */
            continue;
        for (elem_id e = doc_element(doc, t->surface)->first_child; e;
             e = doc_element(doc, e)->next) {
            struct operand value;
            if (find_constant(t, e, first_inside, &value))
                translate_set_constant(t, t->surface, doc_name(doc, e), &value);
        }
        translate_forget_surface(t);
    }
    translate_commit_edit(t);
}

void translate_definitions(struct translation *t)
{
    const struct document *doc = &t->document->layer.doc;
    elem_id first_inside = doc->first_element + doc_num_elements(doc);
    while (open_level(t, translate_visit_materials, open_material)) {
    }
    while (open_level(t, translate_visit_surfaces, open_one)) {
    }
    if (t->opened.len)
        fold(t, first_inside);
}
