// SPDX-License-Identifier: Apache-2.0
/*
 * Surfaces without a translation of their own: they become the first model on the way from slabs,
 * which `slab_to_open_pbr_surface` of the library leads to, before the others begin. Their closures
 * are taken for slabs (material/matter.h), in a draft of the document where each input of a closure
 * that is connected to a value has a number instead, as a uniform. So what is computed inside of
 * definitions becomes part of the formulas, and what the document connects stays connected.
 */
#include "api/translate.h"

#include "material/matter.h"

#include <mxgen/library.h>

#include <stdlib.h>

/* ---- The closures of a surface ---- */

static str_id type_of(const struct translation *t, elem_id port)
{
    return doc_attr_value(&t->document->layer.doc, port, STR_type);
}

static enum value_type value_type_at(const struct translation *t, elem_id port)
{
    str_id type = type_of(t, port);
    return type ? value_type_of(str_text(t->document->layer.doc.strings, type)) : VALUE_NONE;
}

/* The port that an input stands for: through inputs of the nodegraphs around it. 0: it is missing.
 */
static elem_id port_behind(const struct translation *t, elem_id port)
{
    const struct document *doc = &t->document->layer.doc;
    str_id name;
    while (port && (name = doc_attr_value(doc, port, STR_interfacename))) {
        elem_id graph = doc_element(doc, doc_element(doc, port)->parent)->parent;
        port = graph && graph != port ? doc_child_of_kind(doc, graph, KIND_INPUT, name) : 0;
    }
    return port;
}

/* False: the surface in work has it already. */
static bool is_new(struct translation *t, elem_id element)
{
    elem_id *seen = &t->seen[element - t->document->layer.doc.first_element];
    bool is = *seen != t->surface;
    *seen = t->surface;
    return is;
}

void translate_forget_closures(struct translation *t)
{
    t->seen = ARENA_ARRAY(t->kept, elem_id, doc_num_elements(&t->document->layer.doc));
}

/* Lists what gives an input its closure, or the input, if a value is connected. */
static void follow(struct translation *t, elem_id input)
{
    elem_id port = port_behind(t, input);
    mxg_connection connection = {.size = sizeof connection};
    if (!port || mxg_document_connection(t->document, port, &connection) != MXG_OK
        || !connection.source)
        return;
    ir_type_id type = doc_type_ir(doc_type_of(type_of(t, port)));
    bool is_tree = ir_type_is_closure(type) || ir_type_is_shader(type);
    elem_id source = is_tree ? translate_find_source(t, port) : 0;
    if (source && is_new(t, source)) {
        vec_push(t->arena, &t->closures, source);
        vec_push(t->kept, &t->replaced, source);
    }
    if (value_type_at(t, port) != VALUE_NONE && is_new(t, port))
        vec_push(t->arena, &t->leaves, port);
}

void translate_find_closures(struct translation *t)
{
    const struct document *doc = &t->document->layer.doc;
    is_new(t, t->surface);
    vec_push(t->arena, &t->closures, t->surface);
    for (uint32_t i = 0; i < t->closures.len; i++) {
        elem_id node = t->closures.items[i];
        for (elem_id e = doc_element(doc, node)->first_child; e; e = doc_element(doc, e)->next)
            if (doc_element(doc, e)->kind == KIND_INPUT)
                follow(t, e);
    }
}

/* ---- The draft ---- */

/* A number that is no special case. */
static const char *general_text(const struct translation *t, elem_id port)
{
    struct operand value = value_zero(value_type_at(t, port));
    struct text text;
    text_init(&text, t->arena);
    for (unsigned i = 0; i < ir_type_components(value.value.type); i++) {
        if (ir_type_is_float(value.value.type))
            value.value.w[i].f = 0.5f;
        else
            value.value.w[i].u = 1;
    }
    value_write(&value, &text);
    return text_cstr(&text);
}

/* Connects a leaf to a number, because an input that the geometry fills has no value of its own. */
static void add_number(struct translation *t, uint32_t leaf, struct text *paths)
{
    const struct document *doc = &t->document->layer.doc;
    elem_id port = t->leaves.items[leaf], node = doc_element(doc, port)->parent;
    elem_id scope = doc_element(doc, node)->parent;
    const char *type = str_text(doc->strings, type_of(t, port));
    mxg_element number =
        mxg_edit_add_element(t->draft_edit, scope, "constant", translate_step_name(t, leaf), type);
    translate_expect(
        t, number != 0
               && mxg_edit_set_value(t->draft_edit, number, "value", type, general_text(t, port))
                      == MXG_OK
               && mxg_edit_connect_input(t->draft_edit, node, doc_name(doc, port), number, NULL)
                      == MXG_OK);
    /* colours of the document may have another space */
    mxg_edit_set_attribute(t->draft_edit, mxg_edit_find_element(t->draft_edit, number, "value"),
                           "colorspace", "none");
    text_str(paths, paths->len ? "," : "");
    doc_path(doc, scope, '/', paths);
    text_fmt(paths, "%s%s/value", scope == doc->root ? "" : "/", translate_step_name(t, leaf));
}

/* The document with numbers at its leaves; returns the paths of these. */
static const char *make_draft(struct translation *t)
{
    struct text paths;
    text_init(&paths, t->arena);
    t->draft_name = translate_free_name(t);
    translate_expect(t, mxg_edit_create(t->context, t->library, t->document, NULL, &t->draft_edit)
                            == MXG_OK);
    for (uint32_t i = 0; i < t->leaves.len; i++)
        add_number(t, i, &paths);
    translate_commit_draft(t);
    return text_cstr(&paths);
}

/* ---- Values ---- */

struct taken {
    struct matter matter;
    const char *definition; /* that makes the model of slabs */
    ir_ref results[LIBRARY_MAX_OUTPUTS];
    bool is_good;
};

static void take(struct generation *g)
{
    struct taken *taken = g->user_data;
    bool good = generation_start(g);
    g->build_options.max_inline_nodes = UINT32_MAX; /* no node of MaterialX is a call */
    if (!good || !generation_build(g))
        return;
    generation_start_closures(g);
    if (!build_matter(g->builder, &g->closure_host, &g->estimates, g->root, &taken->matter)
        || !generation_slabs_are_few(g, &taken->matter.report))
        return;
    build_apply_to_matter(g->builder, taken->definition, &taken->matter, taken->results);
    taken->is_good = diags_of(g)->num_errors == 0;
}

static bool is_taken(const struct translation *t, const char *name)
{
    for (uint32_t i = 0; i < t->sources.len; i++)
        if (strcmp(t->sources.items[i].port.name, name) == 0)
            return true;
    return false;
}

/* "NG_coat_roughness" for the path "NG/coat/roughness", with a number if another leaf has it. */
static const char *leaf_name(const struct translation *t, elem_id port)
{
    struct text name;
    text_init(&name, t->arena);
    doc_path(&t->document->layer.doc, port, '_', &name);
    size_t len = name.len;
    for (unsigned number = 2; is_taken(t, text_cstr(&name)); number++) {
        name.len = len;
        text_fmt(&name, "%u", number);
    }
    return text_cstr(&name);
}

static uint32_t source_of_port(struct translation *t, elem_id port)
{
    for (uint32_t i = 0; i < t->sources.len; i++)
        if (t->sources.items[i].map == port)
            return i;
    struct source_input source = {.port = {.size = sizeof source.port, .name = leaf_name(t, port)},
                                  .element = port,
                                  .map = port,
                                  .is_connected = true,
                                  .type = value_type_at(t, port)};
    source.port.type = value_type_name(source.type);
    vec_push(t->arena, &t->sources, source);
    return t->sources.len - 1;
}

/* The leaf of the number that a uniform is; t->leaves.len: it is none. */
static uint32_t leaf_of(const struct translation *t, const struct ir_node *node)
{
    const struct shader_variable *v =
        node->op == IR_UNIFORM ? &t->value->shader.interface.variables.items[node->attr] : NULL;
    const char *path = v && v->path ? str_text(&t->value->strings, v->path) : "",
               *name = strstr(path, t->draft_name);
    unsigned long leaf = name ? strtoul(name + strlen(t->draft_name), NULL, 10) : t->leaves.len;
    return leaf < t->leaves.len ? (uint32_t)leaf : t->leaves.len;
}

static bool find_leaf(void *user_data, const struct ir_graph *graph, ir_ref ref,
                      struct operand *out)
{
    struct translation *t = user_data;
    uint32_t leaf = leaf_of(t, ir_get(graph, ref));
    if (leaf == t->leaves.len)
        return false;
    uint32_t index = source_of_port(t, t->leaves.items[leaf]);
    *out = (struct operand){
        .kind = OPERAND_LEAF, .type = t->sources.items[index].type, .index = index};
    return true;
}

/* True if the document connects something that a value depends on. */
static bool reads_leaf(struct translation *t, ir_ref root)
{
    const struct ir_graph *graph = &t->value->graph;
    const uint8_t *needed = ir_mark(graph, &root, 1, t->arena);
    bool reads = false;
    for (ir_ref ref = 1; ref <= root && !reads; ref++)
        reads = needed[ref] && leaf_of(t, ir_get(graph, ref)) < t->leaves.len;
    return reads;
}

/* A direction that the geometry does not give by itself. */
static void set_direction(struct translation *t, const struct taken *taken,
                          struct translated_input *input)
{
    enum meaning meaning = translate_meaning_of(&input->port);
    bool is_coat = meaning == MEANING_COAT_NORMAL || meaning == MEANING_COAT_TANGENT;
    bool is_tangent = meaning == MEANING_TANGENT || meaning == MEANING_COAT_TANGENT;
    ir_ref slab = is_coat ? taken->matter.coat : taken->matter.base;
    ir_ref value =
        slab ? ir_arg(&t->value->graph, slab, is_tangent ? SLAB_tangent : SLAB_normal) : 0;
    if (value && (ir_is_const(&t->value->graph, value) || reads_leaf(t, value)))
        translate_set_input(t, input, value);
}

/* The value that a translation gives an input; 0: it has none. */
static ir_ref result_for(const struct translation *t, uint32_t definition,
                         const struct taken *taken, const char *input)
{
    mxg_nodedef info = {.size = sizeof info};
    const char *name = translate_output_name(t, input);
    mxg_document_nodedef(t->document, definition, &info);
    for (uint32_t i = 0; i < info.num_outputs; i++) {
        mxg_port port = {.size = sizeof port};
        mxg_document_port(t->document, definition, info.num_inputs + i, &port);
        if (strcmp(port.name, name) == 0)
            return taken->results[i];
    }
    return 0;
}

static void set_inputs(struct translation *t, uint32_t step, const struct taken *taken)
{
    mxg_nodedef info = {.size = sizeof info};
    mxg_document_nodedef(t->document, t->definition, &info);
    t->nodes = (struct value_nodes){.arena = t->arena, .leaf = find_leaf, .user_data = t};
    for (uint32_t i = 0; i < info.num_inputs; i++) {
        struct translated_input input = {.port.size = sizeof input.port};
        mxg_document_port(t->document, t->definition, i, &input.port);
        ir_ref value = result_for(t, step, taken, input.port.name);
        if (*input.port.defaultgeomprop)
            set_direction(t, taken, &input);
        else if (value)
            translate_set_input(t, &input, value);
        vec_push(t->arena, &t->inputs, input);
    }
}

/* ---- What is lost ---- */

static void report_blends(struct translation *t, const struct slab_report *report)
{
    struct text steps, error;
    text_init(&steps, t->arena);
    text_init(&error, t->arena);
    for (uint32_t i = 0; i < report->steps.len; i++) {
        const struct slab_step *step = &report->steps.items[i];
        if (step->kind == SLAB_STEP_RECOGNISE || step->kind == SLAB_STEP_ASKED)
            continue;
        text_str(&steps, steps.len ? ", " : "");
        slabs_describe_step(&t->value->shader, step, &steps);
    }
    generation_write_error(&error, report->error);
    if (steps.len)
        translate_report(t, DIAG_ID_translation_blend, text_cstr(&steps), text_cstr(&error));
}

static void report_loss(const struct translation *t, const char *input, const char *category)
{
    diag_add(t->diags, DIAG_ID_translation_loss,
             doc_name_place(&t->document->layer.doc, t->surface), input, category,
             "changes this surface", t->wanted);
}

/* Features of slabs that no model has, by the value at which they are not there. */
static void report_features(struct translation *t, ir_ref slab)
{
    static const struct {
        enum slab_operand operand;
        const char *name;
        float none;
    } features[] = {{SLAB_second_roughness_weight, "second_roughness_weight", 0.0f},
                    {SLAB_f90, "f90", 1.0f},
                    {SLAB_glint_density, "glint_density", 0.0f},
                    {SLAB_specular_lut_weight, "specular_lut", 0.0f}};
    const struct ir_graph *g = &t->value->graph;
    for (size_t i = 0; slab && i < sizeof features / sizeof *features; i++)
        if (!ir_const_is(g, ir_arg(g, slab, features[i].operand), features[i].none))
            report_loss(t, features[i].name, "slab");
}

static void report_matter(struct translation *t, const struct matter *matter)
{
    report_blends(t, &matter->report);
    report_features(t, matter->base);
    report_features(t, matter->coat);
    if (matter->lost_input)
        report_loss(t, matter->lost_input, matter->lost_of);
    if (matter->other)
        translate_report(t, DIAG_ID_translation_closure, matter->other, NULL);
}

/* ---- Surfaces ---- */

static void translate_one(struct translation *t, elem_id surface)
{
    struct text path;
    const struct translation_step *step = t->slab_step;
    mxg_nodedef info = {.size = sizeof info};
    struct taken taken = {0};
    mxg_document_nodedef(t->document, step->definition, &info);
    taken.definition = info.name;
    t->surface = surface;
    text_init(&path, t->arena);
    if (!translate_is_sound(t))
        return;
    translate_find_closures(t);
    const char *uniforms = make_draft(t);
    doc_path(&t->document->layer.doc, surface, '/', &path);
    translate_generate(t, t->draft, text_cstr(&path), uniforms, take, &taken);
    if (!taken.is_good) {
        translate_repeat_errors(t);
        return;
    }
    set_inputs(t, step->definition, &taken);
    report_matter(t, &taken.matter);
    translate_start_draft(t);
    translate_commit_draft(t);
    translate_drop_idle(t);
    translate_write(t);
}

/* The first step from slabs to the model; NULL: there is none. */
static const struct translation_step *first_step(struct translation *t)
{
    const struct translation_step *step = NULL;
    bool found = translate_find_chain(t, "slab", t->wanted);
    for (uint32_t i = 0; i < t->steps.len && found; i++)
        if (t->steps.items[i].definition == t->chain.items[0])
            step = &t->steps.items[i];
    memset(&t->chain, 0, sizeof t->chain);
    return step;
}

static void count(struct translation *t, elem_id surface)
{
    t->num_left += !translate_leads(t, surface);
}

static void visit(struct translation *t, elem_id surface)
{
    const struct document *doc = &t->document->layer.doc;
    const char *category = str_text(doc->strings, doc_element(doc, surface)->category);
    if (translate_leads(t, surface))
        return;
    if (t->slab_step)
        translate_one(t, surface);
    else
        diag_add(t->diags, DIAG_ID_no_translation, doc_name_place(doc, surface), category,
                 t->wanted);
    translate_forget_surface(t);
}

void translate_closures(struct translation *t)
{
    t->num_left = 0;
    translate_visit_surfaces(t, count);
    if (!t->num_left)
        return;
    t->slab_step = first_step(t);
    translate_forget_closures(t);
    t->model = t->slab_step ? t->slab_step->to : t->model;
    translate_find_surface(t, t->model, &t->definition);
    translate_each_surface(t, visit);
    translate_remove_remains(t);
    t->model = t->wanted;
    translate_find_model(t); /* definitions may have other numbers now */
}
