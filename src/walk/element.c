// SPDX-License-Identifier: Apache-2.0
#include "dynamic/code.h"
#include "print/print.h"

#include <assert.h>

/* Finds the value of a constant that library functions can read; false if no such one exists. */
static bool find_option(const struct builder *b, const char *name, int *out_value)
{
    const struct build_options *options = b->options;
    const struct {
        const char *name;
        int value;
    } known[] = {{"option_environment", options->environment},
                 {"option_host_environment", options->host_environment},
                 {"option_albedo", options->albedo},
                 {"option_texture_modes", options->texture_modes},
                 {"option_texture_origin", options->texture_origin},
                 {"option_quality", options->quality},
                 {"option_sss", options->sss},
                 {"option_path", b->shader->role->is_on_path},
                 {"option_stored", role_is_pass(b->shader->role)}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(name, known[i].name) == 0) {
            *out_value = known[i].value;
            return true;
        }
    return false;
}

static ir_ref make_uniform(struct builder *b, struct ir_graph *graph,
                           const struct lang_global *global)
{
    const char *fault = build_uniform_fault(b, global->name, global->type);
    if (fault) {
        diag_add(b->diags, DIAG_ID_uniform_name,
                 doc_place(build_doc(b), b->called ? b->called : build_doc(b)->root),
                 build_text(b, global->name), fault);
        return ir_poison(graph, global->type);
    }
    uint32_t variable = shader_private_uniform(b->shader, global->name, global->type,
                                               (uint16_t)global->array_length);
    enum ir_op op = global->type == IR_TYPE_SAMPLER ? IR_TEXTURE : IR_UNIFORM;
    return ir_build(graph, op, global->type, variable, NULL, 0);
}

/*
 * Resolves the globals of library functions: uniforms and streams become interface variables,
 * options become constants.
 */
static ir_ref make_global(struct builder *b, struct ir_graph *graph, const struct lang_unit *unit,
                          uint32_t global_id)
{
    const struct lang_unit *layer;
    const struct lang_global *global = lang_global(unit, global_id, &layer);
    assert(global->words + global->num_words <= layer->words.len);
    switch ((enum lang_global_kind)global->kind) {
    case LANG_GLOBAL_STREAM: return shader_stream(b->shader, global->name, global->type);
    case LANG_GLOBAL_UNIFORM: return make_uniform(b, graph, global);
    case LANG_GLOBAL_OPTION: {
        int option;
        if (find_option(b, str_text(unit->strings, global->name), &option))
            return ir_const_int(graph, option);
        break;
    }
    case LANG_GLOBAL_CONST:
    case LANG_GLOBAL_VARIABLE: break;
    }
    struct ir_value value = {.type = global->type};
    memcpy(value.w, layer->words.items + global->words, global->num_words * sizeof *value.w);
    return ir_const(graph, &value);
}

static ir_ref global_node(void *user_data, struct ir_graph *graph, const struct lang_unit *unit,
                          uint32_t global_id)
{
    struct builder *b = user_data;
    assert(global_id < b->shader->unit->base_globals + b->shader->unit->globals.len);
    if (!b->globals[global_id])
        b->globals[global_id] = make_global(b, graph, unit, global_id);
    return b->globals[global_id];
}

/*
 * Functions of at most this many tree nodes are lowered into the shader's graph instead of being
 * called.
 */
enum { INLINE_NODES = 14 };

struct builder *build_start(const struct library *lib, const struct build_options *options,
                            struct shader *shader, struct diag_list *diags)
{
    assert(shader->unit->base_globals == lib->unit.base_globals + lib->unit.globals.len);
    assert(shader->strings->base == &lib->strings && shader->unit->strings == shader->strings);
    struct builder *b = ARENA_NEW(shader->arena, struct builder);
    b->view = *lib;
    b->view.targets = options->targets;
    b->view.num_targets = options->num_targets;
    b->view.target_strings = shader->strings;
    b->lib = &b->view;
    b->options = options;
    b->shader = shader;
    b->graph = shader->graph;
    b->arena = shader->arena;
    b->diags = diags;
    diags->trace = build_trace; /* the builder lives as long as the list: the result owns both */
    diags->trace_data = b;
    b->resolved.arena = b->arena;
    text_init(&b->scratch, b->arena);
    b->apply = build_apply_definition;
    b->globals =
        ARENA_ARRAY(b->arena, ir_ref, shader->unit->base_globals + shader->unit->globals.len);
    b->host = (struct lang_host){
        .user_data = b,
        .global = global_node,
        .texture = build_read_tiles,
        .bad_index = build_report_index,
        .too_large = build_report_large,
        .max_inline_nodes = options->max_inline_nodes ? options->max_inline_nodes : INLINE_NODES,
        .inlines_derivatives = shader->role->derivatives == DERIVATIVES_OF_RAYS};
    b->document = ARENA_NEW(b->arena, struct instance);
    b->document->nodedef = LIBRARY_NONE;
    b->document->first = lib->doc.first_element;
    b->document->node = lib->doc.root;
    b->document->num_slots = doc_num_elements(&lib->doc);
    b->document->slots = ARENA_ARRAY(b->arena, uint32_t, doc_num_elements(&lib->doc));
    build_check_colorspace(b);
    build_check_distance_unit(b);
    code_find_all(b);
    return b;
}

const struct lang_host *build_lang_host(struct builder *b)
{
    return &b->host;
}

/* The port that gives a shader to an input of a material, by a drive or by itself; 0: none. */
static elem_id shader_port(const struct builder *b, elem_id node, elem_id input)
{
    const struct element *e = doc_element(build_doc(b), input);
    doc_type type = library_type(b->lib, doc_attr_value(build_doc(b), input, STR_type));
    if (e->kind != KIND_INPUT || !type || !ir_type_is_shader(library_type_ir(b->lib, type)))
        return 0;
    elem_id driver = library_driver(b->resolved.drives, node, e->name);
    return driver ? driver : input;
}

static void publish_shader(struct builder *b, elem_id port)
{
    struct diag_list ignored; /* the resolution of the node itself reports them */
    struct resolve_out out = {.arena = b->arena, .drives = b->resolved.drives};
    diag_list_init_unheard(&ignored, b->arena);
    struct binding binding = library_resolve_port(b->lib, port, DOC_TYPE_NONE, &out, &ignored);
    if (binding.kind == BIND_NODE)
        vec_push(b->arena, &b->public_nodes, binding.ref);
}

/* The interface of a material is the interface of its shaders. */
static void publish_nodes(struct builder *b, elem_id node)
{
    const struct library_drives *drives = b->resolved.drives;
    vec_push(b->arena, &b->public_nodes, node);
    for (elem_id e = doc_element(build_doc(b), node)->first_child; e;
         e = doc_element(build_doc(b), e)->next) {
        elem_id port = shader_port(b, node, e);
        if (port)
            publish_shader(b, port);
    }
    for (uint32_t i = 0; drives && i < drives->items.len; i++)
        if (drives->items.items[i].owner == node)
            publish_shader(b, drives->items.items[i].source);
}

static ir_ref build_node_element(struct builder *b, elem_id node, unsigned output)
{
    assert(node - b->document->first < b->document->num_slots);
    publish_nodes(b, node);
    build_demand(b, b->document, node);
    assert(b->frames.len == 0);
    if (b->document->slots[node - b->document->first] < SLOT_RESULTS)
        return 0;
    return build_result(b, b->document, node, output, DOC_TYPE_NONE);
}

static ir_ref build_output_element(struct builder *b, elem_id output)
{
    doc_type type = library_type(b->lib, doc_attr_value(build_doc(b), output, STR_type));
    struct binding binding = library_resolve_port(b->lib, output, type, &b->resolved, b->diags);
    if (binding.kind == BIND_NODE) {
        if (ir_type_is_shader(library_type_ir(b->lib, type)))
            return build_node_element(b, binding.ref, binding.output);
        /*
         * An <output> of the document shows the inputs of its node; an <output> of a nodegraph
         * shows the inputs of the graph.
         */
        elem_id parent = doc_element(build_doc(b), output)->parent;
        if (parent == build_doc(b)->root)
            vec_push(b->arena, &b->public_nodes, binding.ref);
        else
            b->root_graph = parent;
        build_demand(b, b->document, binding.ref);
        if (b->document->slots[binding.ref - b->document->first] < SLOT_RESULTS)
            return 0;
    }
    struct port port = {.name = STR_out, .type = type, .element = output};
    return binding.kind == BIND_ERROR
               ? 0
               : build_input(b, b->document, doc_element(build_doc(b), output)->parent, &port,
                             &binding);
}

ir_ref build_element(struct builder *b, elem_id element, unsigned output)
{
    assert(b->frames.len == 0);
    bool is_node = doc_element(build_doc(b), element)->kind == KIND_NODE;
    ir_ref root =
        is_node ? build_node_element(b, element, output) : build_output_element(b, element);
    root = build_element_aovs(b, root);
    bool is_substance = root && ir_get(b->graph, root)->op == IR_SUBSTANCE;
    return is_substance && !b->slot ? build_lone_substance(b, root) : root;
}
