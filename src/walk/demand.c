// SPDX-License-Identifier: Apache-2.0
/*
 * Walks from a node to its inputs: each frame is a node whose inputs are in progress. Each node is
 * built once per scope; a graph with two uses and equal arguments is built once.
 */
#include "build/build_priv.h"

#include "base/hash.h"

#include <assert.h>

enum { MAX_DEFINITION_DEPTH = 200 };

enum frame_phase { PHASE_INPUTS, PHASE_OUTPUTS };

static const char *name_of(const struct builder *b, elem_id element)
{
    return build_text(b, doc_element(build_doc(b), element)->name);
}

/* Reports the cycle from the frame of the first visit to the current one. */
static void report_cycle(struct builder *b, const struct instance *scope, elem_id node)
{
    uint32_t first = b->frames.len, n = 0;
    while (first > 0
           && !(b->frames.items[first - 1].scope == scope
                && b->frames.items[first - 1].node.element == node))
        first--;
    assert(first > 0); /* a busy node has a frame */
    struct doc_cycle_link *links =
        ARENA_ARRAY(b->arena, struct doc_cycle_link, b->frames.len - first + 1);
    for (uint32_t i = first - 1; i < b->frames.len; i++) {
        const struct frame *frame = &b->frames.items[i];
        if (frame->scope == scope && frame->phase == PHASE_INPUTS && frame->next)
            links[n++] = (struct doc_cycle_link){frame->node.element,
                                                 frame->bindings[frame->next - 1].element};
    }
    doc_report_cycle(build_doc(b), links, n, b->diags);
}

static bool is_recursive(const struct instance *scope, elem_id graph)
{
    for (; scope; scope = scope->parent)
        if (scope->graph == graph)
            return true;
    return false;
}

static void report_recursion(struct builder *b, const struct instance *scope, elem_id graph,
                             elem_id node)
{
    struct text path;
    text_init(&path, b->arena);
    text_str(&path, name_of(b, graph));
    for (const struct instance *s = scope; s && s->graph; s = s->parent) {
        text_fmt(&path, " <- %s", name_of(b, s->graph));
        if (s->graph == graph)
            break;
    }
    diag_add(b->diags, DIAG_ID_recursive_definition, doc_place(build_doc(b), node),
             name_of(b, graph), text_cstr(&path));
}

/* Finds definition and bindings: from the library's tables, or by resolution now. */
static void resolve(struct builder *b, struct frame *frame, elem_id node)
{
    const struct library *layer;
    uint32_t own = library_element_info(b->lib, node, &layer);
    if (own != LIBRARY_NONE && own < layer->graph_nodes.len
        && layer->graph_nodes.items[own].element == node) {
        frame->node = layer->graph_nodes.items[own];
        assert(frame->node.first_binding <= layer->bindings.len);
        frame->bindings = layer->bindings.items + frame->node.first_binding;
        return;
    }
    if (layer == b->lib) /* report attributes that no definition reads */
        doc_check_children(build_doc(b), node, b->diags);
    /* Bindings move when the vector grows, so each frame keeps its own copy. */
    uint32_t before = b->resolved.bindings.len;
    frame->node = library_resolve_node(b->lib, node, &b->resolved, b->diags);
    uint32_t n = b->resolved.bindings.len - before;
    struct binding *copy = ARENA_ARRAY(b->arena, struct binding, n);
    if (n)
        memcpy(copy, b->resolved.bindings.items + before, n * sizeof *copy);
    assert(b->resolved.bindings.len >= before);
    b->resolved.bindings.len = before;
    frame->bindings = copy;
    if (layer == b->lib && frame->node.nodedef != LIBRARY_NONE)
        library_check_shaders(b->lib, node, frame->node.nodedef, copy, b->diags);
}

static void push(struct builder *b, struct instance *scope, elem_id node)
{
    uint32_t *slot = build_slot(scope, node);
    if (*slot == SLOT_BUSY) {
        report_cycle(b, scope, node);
        *slot = SLOT_ERROR;
    }
    if (*slot != SLOT_EMPTY)
        return;
    struct frame frame = {.scope = scope};
    resolve(b, &frame, node);
    if (frame.node.nodedef != LIBRARY_NONE)
        frame.impl = build_choose(b, frame.node.nodedef, node);
    if (!frame.impl) {
        *slot = SLOT_ERROR;
        return;
    }
    assert(frame.impl->nodedef == frame.node.nodedef);
    *slot = SLOT_BUSY;
    vec_push(b->arena, &b->frames, frame);
}

static void finish(struct builder *b, uint32_t first_result)
{
    struct frame *frame = &vec_last(&b->frames);
    uint32_t *slot = build_slot(frame->scope, frame->node.element);
    assert(frame->phase == PHASE_OUTPUTS
           || frame->next >= library_nodedef(b->lib, frame->node.nodedef)->num_inputs);
    assert(first_result <= b->results.len && (*slot == SLOT_BUSY || *slot == SLOT_ERROR));
    if (*slot == SLOT_BUSY)
        *slot = SLOT_RESULTS + first_result;
    b->frames.len--;
}

static uint32_t add_results(struct builder *b, const ir_ref *results, uint32_t n)
{
    uint32_t first = b->results.len;
    for (uint32_t i = 0; i < n; i++) /* a definition without outputs has no results */
        vec_push(b->arena, &b->results, results[i]);
    return first;
}

static void build_args(struct builder *b, struct frame *frame)
{
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    assert(frame->next == def->num_inputs);
    const struct port *ports = library_ports(b->lib, frame->node.nodedef, NULL);
    frame->args = ARENA_ARRAY(b->arena, ir_ref, def->num_inputs);
    struct build_meaning ignored;
    bool may_have_border = build_meaning_of_property(b, frame->node.element, &ignored);
    for (uint32_t pass = 0; pass < 2; pass++) /* files first: they say what a border means */
        for (uint32_t i = 0; i < def->num_inputs; i++) {
            bool is_file = ports[i].type == DOC_TYPE_filename;
            may_have_border |= is_file;
            if (is_file == (pass == 1))
                continue;
            frame->args[i] = may_have_border && build_is_border(b, frame, &ports[i])
                                 ? build_border(b, frame, i)
                                 : build_input(b, frame->scope, frame->node.element, &ports[i],
                                               &frame->bindings[i]);
        }
}

/*
 * Converts the results of image nodes from the colour space and the unit of their file, and colours
 * of the geometry from theirs (specification, "Color Spaces" and "Units").
 */
static void convert_results(struct builder *b, const struct frame *frame, ir_ref *results)
{
    assert(frame->impl->nodedef == frame->node.nodedef);
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    const struct port *ports = library_ports(b->lib, frame->node.nodedef, NULL);
    struct build_meaning meaning;
    if (!build_meaning_of_results(b, frame, &meaning))
        return;
    for (uint32_t o = 0; o < def->num_outputs; o++)
        results[o] = build_convert(b, results[o], ports[def->num_inputs + o].type, &meaning);
}

static void push_origin(struct builder *b, const struct frame *frame)
{
    str_id name = doc_element(build_doc(b), frame->node.element)->name;
    ir_push_origin(b->graph,
                   ir_add_origin(b->graph, name, frame->node.element, frame->scope->origin));
}

/* Names results: "noise1", or "separate1_outr" if a node has several results. */
static void name_results(struct builder *b, const struct frame *frame, const ir_ref *results)
{
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    const struct port *ports = library_ports(b->lib, frame->node.nodedef, NULL);
    str_id node = doc_element(build_doc(b), frame->node.element)->name;
    for (uint32_t i = 0; i < def->num_outputs; i++) {
        str_id name = node;
        if (def->num_outputs > 1) {
            struct text text;
            text_init(&text, b->arena);
            text_fmt(&text, "%s_%s", build_text(b, node),
                     build_text(b, ports[def->num_inputs + i].name));
            name = str_intern(b->shader->strings, text_cstr(&text), text.len);
        }
        ir_suggest_name(b->graph, results[i], name, IR_NAME_RESULT);
    }
}

/* The node has the results of its implementation, with the meaning of its files. */
static void finish_node(struct builder *b, const struct frame *frame, ir_ref *results)
{
    convert_results(b, frame, results);
    name_results(b, frame, results);
    finish(b, add_results(b, results, library_nodedef(b->lib, frame->node.nodedef)->num_outputs));
}

/*
 * The results of a graph for these arguments are complete; the memo keeps them for equal uses,
 * whose files may mean something else.
 */
static void finish_graph(struct builder *b, struct frame *frame, ir_ref *results)
{
    assert(frame->is_alone || frame->memo_key < b->memos.len);
    if (!frame->is_alone)
        b->memos.items[frame->memo_key].first_result =
            add_results(b, results, library_nodedef(b->lib, frame->node.nodedef)->num_outputs) + 1;
    struct frame use = *frame; /* frames move while a conversion applies definitions */
    finish_node(b, &use, results);
}

static void finish_call(struct builder *b, struct frame *frame, uint32_t function)
{
    ir_ref results[LIBRARY_MAX_OUTPUTS];
    push_origin(b, frame);
    build_call_function(b, frame, function, results);
    finish_graph(b, frame, results);
    ir_pop_origin(b->graph);
}

static bool gives_surface(const struct builder *b, const struct nodedef *def,
                          const struct port *outputs)
{
    for (uint32_t i = 0; i < def->num_outputs; i++) {
        ir_type_id type = library_type_ir(b->lib, outputs[i].type);
        if (type == IR_TYPE_SURFACE || type == IR_TYPE_MATERIAL)
            return true;
    }
    return false;
}

static void enter_graph(struct builder *b, struct frame *frame)
{
    assert(frame->impl->kind == IMPL_GRAPH && frame->phase == PHASE_INPUTS);
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    elem_id graph = frame->impl->ref;
    if (is_recursive(frame->scope, graph) || frame->scope->depth >= MAX_DEFINITION_DEPTH) {
        if (frame->scope->depth >= MAX_DEFINITION_DEPTH)
            diag_add(b->diags, DIAG_ID_graph_depth, doc_place(build_doc(b), frame->node.element),
                     MAX_DEFINITION_DEPTH);
        else
            report_recursion(b, frame->scope, graph, frame->node.element);
        *build_slot(frame->scope, frame->node.element) = SLOT_ERROR;
        b->frames.len--;
        return;
    }
    if (gives_surface(b, def, library_ports(b->lib, frame->node.nodedef, NULL) + def->num_inputs))
        build_unread_inputs(b, frame, graph);
    struct memo *memo = build_memo(b, frame->impl->ref, frame->args, def->num_inputs);
    const struct build_meaning *files = build_meaning_inside(b, frame);
    frame->is_alone = files || build_has_tokens(b, frame->node.element, frame->node.nodedef);
    if (memo->first_result && !frame->is_alone) {
        ir_ref results[LIBRARY_MAX_OUTPUTS];
        memcpy(results, b->results.items + memo->first_result - 1,
               def->num_outputs * sizeof *results);
        struct frame use = *frame;
        finish_node(b, &use, results);
        return;
    }
    frame->memo_key = (uint32_t)(memo - b->memos.items);
    frame->outline = frame->is_alone ? LIBRARY_NONE : build_outlined(b, frame);
    uint32_t function =
        frame->outline == LIBRARY_NONE ? 0 : b->memos.items[frame->outline].function;
    if (function) {
        finish_call(b, frame, function - 1);
        return;
    }
    frame->inner = build_new_instance(b, frame->scope, graph);
    frame->inner->nodedef = frame->node.nodedef;
    frame->inner->args = frame->args;
    frame->inner->node = frame->node.element;
    frame->inner->origin = b->graph->origin;
    frame->inner->files = files;
    if (frame->outline != LIBRARY_NONE)
        build_begin_function(b, frame);
    frame->phase = PHASE_OUTPUTS;
    frame->first_aov = b->aovs.len;
    frame->next = 0;
}

static void step_inputs(struct builder *b)
{
    struct frame *frame = &vec_last(&b->frames);
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    while (frame->next < def->num_inputs) {
        assert(frame->phase != PHASE_OUTPUTS);
        const struct binding *binding = &frame->bindings[frame->next++];
        if (binding->kind == BIND_NODE && *build_slot(frame->scope, binding->ref) <= SLOT_BUSY) {
            uint32_t before = b->frames.len;
            push(b, frame->scope, binding->ref);
            if (b->frames.len > before)
                return; /* this frame continues after the other one ends */
        }
    }
    push_origin(b, frame);
    struct frame use = *frame; /* frames move while an input or a node applies definitions */
    build_args(b, &use);
    if (use.impl->kind == IMPL_GRAPH) {
        frame = &vec_last(&b->frames);
        frame->args = use.args;
        enter_graph(b, frame);
    } else {
        ir_ref results[LIBRARY_MAX_OUTPUTS];
        build_node(b, &use, results);
        finish_node(b, &use, results);
    }
    ir_pop_origin(b->graph);
}

/* The <output> of the inner graph for output `i` of the definition. */
static elem_id inner_output(const struct builder *b, const struct frame *frame, uint32_t i)
{
    return library_inner_output(b->lib, frame->node.nodedef, i, build_doc(b), frame->inner->graph);
}

static void leave_graph(struct builder *b)
{
    struct frame *frame = &vec_last(&b->frames);
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    assert(frame->phase == PHASE_OUTPUTS && frame->next == def->num_outputs);
    const struct port *outputs = library_ports(b->lib, frame->node.nodedef, NULL) + def->num_inputs;
    ir_ref results[LIBRARY_MAX_OUTPUTS];
    for (uint32_t i = 0; i < def->num_outputs; i++) {
        elem_id output = inner_output(b, frame, i);
        struct binding binding = {.kind = BIND_ERROR};
        if (output)
            binding = library_resolve_port(b->lib, output, outputs[i].type, &b->resolved, b->diags);
        else
            diag_add(b->diags, DIAG_ID_dangling_output,
                     doc_place(build_doc(b), frame->inner->graph), name_of(b, frame->inner->graph),
                     build_text(b, outputs[i].name), "");
        results[i] = build_input(b, frame->inner, frame->inner->graph, &outputs[i], &binding);
    }
    if (frame->outline == LIBRARY_NONE) {
        build_finish_graph_aovs(b, frame, results);
        finish_graph(b, frame, results);
        return;
    }
    assert(!b->memos.items[frame->outline].function);
    ir_set_results(b->graph, frame->function, results, def->num_outputs);
    b->memos.items[frame->outline].function = frame->function + 1;
    finish_call(b, frame, frame->function);
}

/* True if it began to build an <aov> of the inner graph, which nothing needs to read. */
static bool step_aovs(struct builder *b)
{
    struct frame *frame = &vec_last(&b->frames);
    elem_id first = doc_element(build_doc(b), frame->inner->graph)->first_child;
    for (elem_id e = first; (e = build_next_aov(b, e)) != 0; e = doc_element(build_doc(b), e)->next)
        if (*build_slot(frame->inner, e) == SLOT_EMPTY) {
            uint32_t before = b->frames.len;
            push(b, frame->inner, e);
            if (b->frames.len > before)
                return true;
        }
    return false;
}

static void step_outputs(struct builder *b)
{
    struct frame *frame = &vec_last(&b->frames);
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    struct diag_list ignored; /* the exit from the graph reports faults of the connection */
    struct resolve_out out = {.arena = b->arena};
    diag_list_init_unheard(&ignored, b->arena);
    while (frame->next < def->num_outputs) {
        elem_id output = inner_output(b, frame, frame->next++);
        if (!output)
            continue;
        struct binding binding =
            library_resolve_port(b->lib, output, DOC_TYPE_NONE, &out, &ignored);
        if (binding.kind == BIND_NODE && *build_slot(frame->inner, binding.ref) == SLOT_EMPTY) {
            uint32_t before = b->frames.len;
            push(b, frame->inner, binding.ref);
            if (b->frames.len > before)
                return;
        }
    }
    const struct port *ports = library_ports(b->lib, frame->node.nodedef, NULL);
    if (gives_surface(b, def, ports + def->num_inputs) && step_aovs(b))
        return;
    leave_graph(b);
}

void build_demand(struct builder *b, struct instance *scope, elem_id node)
{
    uint32_t bottom = b->frames.len;
    push(b, scope, node);
    for (uint32_t steps = 0; b->frames.len > bottom; steps++) {
        if ((steps & 1023) == 1023 && b->options->cancel
            && b->options->cancel(b->options->cancel_user_data))
            b->cancelled = true;
        if (b->cancelled || b->graph->overflow || build_network_is_full(b)) {
            b->frames.len = bottom;
            return;
        }
        if (vec_last(&b->frames).phase == PHASE_INPUTS)
            step_inputs(b);
        else
            step_outputs(b);
    }
}

void build_apply_definition(struct builder *b, uint32_t nodedef, elem_id where, const ir_ref *args,
                            ir_ref *results)
{
    const struct nodedef *def = library_nodedef(b->lib, nodedef);
    const struct port *outputs = library_ports(b->lib, nodedef, NULL) + def->num_inputs;
    struct frame frame = {.node = {.nodedef = nodedef, .element = where},
                          .args = (ir_ref *)(uintptr_t)args};
    frame.impl = build_choose(b, nodedef, where);
    if (frame.impl && frame.impl->kind != IMPL_GRAPH) {
        build_node(b, &frame, results);
        return;
    }
    for (uint32_t i = 0; i < def->num_outputs; i++)
        results[i] = ir_poison(b->graph, build_type(b, outputs[i].type));
    if (!frame.impl)
        return;
    struct instance *inner = build_new_instance(b, b->document, frame.impl->ref);
    inner->nodedef = nodedef;
    inner->args = args;
    inner->origin = b->graph->origin;
    for (uint32_t i = 0; i < def->num_outputs; i++) {
        elem_id output = library_inner_output(b->lib, nodedef, i, build_doc(b), inner->graph);
        struct binding binding = {.kind = BIND_ERROR};
        if (output)
            binding = library_resolve_port(b->lib, output, outputs[i].type, &b->resolved, b->diags);
        if (binding.kind == BIND_NODE)
            build_demand(b, inner, binding.ref);
        results[i] = build_input(b, inner, inner->graph, &outputs[i], &binding);
    }
}

bool build_cancelled(const struct builder *b)
{
    return b->cancelled;
}
