// SPDX-License-Identifier: Apache-2.0
/*
 * AOVs (docs/slots.md, "AOVs"). An AOV is a part of a surface, so that layers and mixes blend it as
 * they blend closures. The <aov> nodes of a definition belong to the surfaces that it gives; a
 * later value of an AOV of one surface replaces the earlier one.
 */
#include "dynamic/dynamic.h"

bool build_is_aov(const struct document *doc, elem_id element)
{
    const struct element *e = doc_element(doc, element);
    return e->kind == KIND_NODE && (e->category == STR_aov || e->category == STR_aovpass);
}

elem_id build_next_aov(const struct builder *b, elem_id element)
{
    while (element && !build_is_aov(build_doc(b), element))
        element = doc_element(build_doc(b), element)->next;
    return element;
}

void build_leave_out_aov(struct builder *b, const struct aov_use *use, const char *why)
{
    diag_add(b->diags, DIAG_ID_aov_left_out, doc_place(build_doc(b), use->node),
             build_text(b, use->name), why);
}

/* ---- Uses ---- */

/* The constant text of an input; 0 after a report. */
static str_id name_from(mxg_build *build, const char *input)
{
    mxg_value value = MXG_INIT(mxg_value);
    if (!mxg_build_require_constant(build, input, &value))
        return 0;
    if (value.text[0])
        return str_intern_z(build->b->shader->strings, value.text);
    mxg_build_report_error(build, input, "an AOV needs a name");
    return 0;
}

static str_id output_type(const mxg_build *build)
{
    return library_type_name(build->b->lib, build->ports[build->def->num_inputs].type);
}

static void note(mxg_build *build, str_id name, str_id source, ir_ref value)
{
    struct aov_use use = {
        build->frame->scope, build->frame->node.element, name, output_type(build), source, value};
    vec_push(build->b->arena, &build->b->aovs, use);
}

bool dynamic_aov(void *user_data, mxg_build *build, mxg_ref *results)
{
    str_id name = name_from(build, "name");
    (void)user_data;
    if (!name)
        return false;
    results[0] = mxg_build_input(build, "value");
    note(build, name, 0, dynamic_arg(build, STR_value));
    return true;
}

static void report_unknown(mxg_build *build, ir_ref shader, str_id source)
{
    struct builder *b = build->b;
    const struct document *doc = build_doc(b);
    struct diag_guess guess;
    bool guesses = diag_guess_begin(&guess, b->diags, build_text(b, source));
    for (ir_ref s = shader; guesses && s && ir_get(b->graph, s)->op == IR_AOV;
         s = ir_arg(b->graph, s, 0))
        diag_guess_add(
            &guess, build_text(b, b->shader->interface.aovs.items[ir_get(b->graph, s)->attr].name));
    diag_add(b->diags, DIAG_ID_unknown_aov, doc_place(doc, build->frame->node.element),
             build_text(b, source), build_text(b, output_type(build)),
             guesses ? diag_guess_text(&guess) : "");
}

/* The AOV of a surface with a name and type; UINT32_MAX: it has none. */
static uint32_t find_in(const struct builder *b, ir_ref surface, str_id name, str_id type,
                        ir_ref *out_value)
{
    for (ir_ref s = surface; s && ir_get(b->graph, s)->op == IR_AOV; s = ir_arg(b->graph, s, 0)) {
        uint32_t index = ir_get(b->graph, s)->attr;
        const struct shader_aov *aov = &b->shader->interface.aovs.items[index];
        *out_value = ir_arg(b->graph, s, 1);
        if (aov->name == name && aov->doc_type == type)
            return index;
    }
    return UINT32_MAX;
}

bool dynamic_aovpass(void *user_data, mxg_build *build, mxg_ref *results)
{
    str_id name = name_from(build, "name"), source = name_from(build, "source");
    ir_ref shader = dynamic_arg(build, STR_shader), value;
    (void)user_data;
    if (!name || !source)
        return false;
    if (find_in(build->b, shader, source, output_type(build), &value) == UINT32_MAX) {
        if (!shader || ir_get(build->b->graph, shader)->op != IR_POISON)
            report_unknown(build, shader, source);
        build->has_failed = true;
        return false;
    }
    note(build, name, source, value);
    results[0] = code_issue(build, value);
    return true;
}

/* ---- Surfaces with AOVs ---- */

/* Changes the surfaces of a material, or a surface. True if there was one. */
static bool change_surfaces(struct builder *b, ir_ref *root, uint32_t aov, ir_ref value,
                            ir_ref (*change)(struct builder *b, ir_ref surface, uint32_t aov,
                                             ir_ref value))
{
    const struct ir_node node = *ir_get(b->graph, *root);
    ir_ref args[4];
    bool any = false;
    if (node.type == IR_TYPE_SURFACE) {
        *root = change(b, *root, aov, value);
        return true;
    }
    if (node.op != IR_MATERIAL && node.op != IR_SUBSTANCE)
        return false;
    assert(node.num_args == 4);
    memcpy(args, ir_args(b->graph, *root), sizeof args);
    if (node.op == IR_SUBSTANCE) /* materials do not nest further */
        any = change_surfaces(b, &args[0], aov, value, change);
    for (unsigned side = 0; side < 2 && node.op == IR_MATERIAL; side++)
        if (args[side]) {
            args[side] = change(b, args[side], aov, value);
            any = true;
        }
    *root = ir_build(b->graph, (enum ir_op)node.op, node.type, node.attr, args, 4);
    return any;
}

static ir_ref with_value(struct builder *b, ir_ref surface, uint32_t aov, ir_ref value)
{
    ir_ref args[2] = {surface, value};
    return ir_build(b->graph, IR_AOV, IR_TYPE_SURFACE, aov, args, 2);
}

static ir_ref without_value(struct builder *b, ir_ref surface, uint32_t aov, ir_ref ignored)
{
    ir_ref inner = surface;
    VEC(ir_ref) outer = {0};
    (void)ignored;
    for (; ir_get(b->graph, inner)->op == IR_AOV; inner = ir_arg(b->graph, inner, 0))
        if (ir_get(b->graph, inner)->attr != aov)
            vec_push(b->arena, &outer, inner);
    while (outer.len) {
        ir_ref of = vec_pop(&outer);
        inner = with_value(b, inner, ir_get(b->graph, of)->attr, ir_arg(b->graph, of, 1));
    }
    return inner;
}

static void report_types(struct builder *b, const struct aov_use *use, const struct shader_aov *aov)
{
    diag_add(b->diags, DIAG_ID_aov_types, doc_place(build_doc(b), use->node),
             build_text(b, use->name), build_text(b, use->type), build_text(b, aov->doc_type));
    if (aov->element)
        diag_add(b->diags, DIAG_ID_previous_definition, doc_place(build_doc(b), aov->element));
}

/* The number of an AOV in the shader; UINT32_MAX after a report: it has another type already. */
static uint32_t number_of(struct builder *b, const struct aov_use *use)
{
    struct shader *shader = b->shader;
    for (uint32_t i = 0; i < shader->interface.aovs.len; i++) {
        struct shader_aov *aov = &shader->interface.aovs.items[i];
        if (aov->name != use->name)
            continue;
        if (aov->doc_type != use->type) {
            report_types(b, use, aov);
            return UINT32_MAX;
        }
        if (!aov->element)
            aov->element = use->node;
        return i;
    }
    vec_push(b->arena, &shader->interface.aovs,
             (struct shader_aov){.name = use->name,
                                 .doc_type = use->type,
                                 .type = ir_type_of(b->graph, use->value),
                                 .element = use->node});
    return shader->interface.aovs.len - 1;
}

void build_add_aov(struct builder *b, const struct aov_use *use, ir_ref *root)
{
    if (!use->value) {
        build_leave_out_aov(b, use, "it has no value");
        return;
    }
    uint32_t aov = number_of(b, use);
    if (aov != UINT32_MAX && !change_surfaces(b, root, aov, use->value, with_value))
        build_leave_out_aov(b, use, "the material has no surface");
}

bool build_report_second_aov(struct builder *b, const struct aov_use *first,
                             const struct aov_use *second)
{
    diag_add(b->diags, DIAG_ID_aov_twice, doc_place(build_doc(b), second->node),
             build_text(b, second->name));
    diag_add(b->diags, DIAG_ID_previous_definition, doc_place(build_doc(b), first->node));
    return false;
}

/* ---- Definitions ---- */

static bool is_only(struct builder *b, const struct aov_use *uses, uint32_t index)
{
    for (uint32_t i = 0; i < index; i++)
        if (uses[i].name == uses[index].name)
            return build_report_second_aov(b, &uses[i], &uses[index]);
    return true;
}

/* Takes the own names from values that an <aovpass> gives another name. */
static void take_sources(struct builder *b, const struct aov_use *uses, uint32_t num, ir_ref *root)
{
    for (uint32_t i = 0; i < num; i++)
        for (uint32_t k = 0; uses[i].source && k < b->shader->interface.aovs.len; k++)
            if (b->shader->interface.aovs.items[k].name == uses[i].source)
                change_surfaces(b, root, k, 0, without_value);
}

void build_finish_graph_aovs(struct builder *b, const struct frame *frame, ir_ref *results)
{
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    const struct aov_use *uses = b->aovs.items + frame->first_aov;
    uint32_t num = b->aovs.len - frame->first_aov;
    bool any = false;
    for (uint32_t o = 0; num && o < def->num_outputs; o++) {
        ir_type_id type = results[o] ? ir_type_of(b->graph, results[o]) : IR_TYPE_VOID;
        if (type != IR_TYPE_SURFACE && type != IR_TYPE_MATERIAL)
            continue;
        any = true;
        take_sources(b, uses, num, &results[o]);
        for (uint32_t i = 0; i < num; i++)
            if (is_only(b, uses, i))
                build_add_aov(b, &uses[i], &results[o]);
    }
    for (uint32_t i = 0; i < num && !any; i++)
        build_leave_out_aov(b, &uses[i], "its definition gives no surface or material");
    b->aovs.len = frame->first_aov;
}

/* ---- The list of the options ---- */

static bool can_be_aov(ir_type_id type)
{
    return type == IR_TYPE_BOOL || type == IR_TYPE_INT || type == IR_TYPE_BSDF
           || type == IR_TYPE_EDF || (ir_type_is_float(type) && !ir_type_is_matrix(type));
}

void build_list_aovs(struct builder *b, const char *const *items, uint32_t num)
{
    struct shader *shader = b->shader;
    const struct diag_place nowhere = {0};
    shader->interface.lists_aovs = true;
    for (uint32_t i = 0; i < num; i++) {
        if (strcmp(items[i], "none") == 0) {
            shader->interface.aovs.len = 0;
            continue;
        }
        const char *equals = strrchr(items[i], '=');
        size_t len = equals ? (size_t)(equals - items[i]) : 0;
        str_id word = equals ? str_intern_z(shader->strings, equals + 1) : 0;
        doc_type type = word ? library_type(b->lib, word) : DOC_TYPE_NONE;
        ir_type_id of_graph = type ? library_type_ir(b->lib, type) : IR_TYPE_VOID;
        if (!len || !can_be_aov(of_graph)) {
            diag_add(b->diags, DIAG_ID_bad_option, nowhere, items[i], "aovs",
                     "NAME=TYPE with the type of an AOV, such as dirt=color3, or none");
            return;
        }
        struct shader_aov aov = {
            .name = str_intern(shader->strings, items[i], len), .doc_type = word, .type = of_graph};
        vec_push(b->arena, &shader->interface.aovs, aov);
    }
    shader->interface.num_listed_aovs = shader->interface.aovs.len;
}
