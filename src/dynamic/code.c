// SPDX-License-Identifier: Apache-2.0
/* One use of a node in C: its arguments, its faults, its results. */
#include "dynamic/code.h"

#include "base/structs.h"

/* ---- Faults ---- */

static struct diag_place place_of_use(const struct mxg_build *build)
{
    return doc_place(build_doc(build->b), build->frame->node.element);
}

void code_fault(struct mxg_build *build, const char *fault, const char *word)
{
    struct text text;
    text_init(&text, build->b->arena);
    text_str(&text, fault);
    if (word)
        text_fmt(&text, " '%s'", word);
    build->has_failed = true;
    diag_add(build->b->diags, DIAG_ID_code_fault, place_of_use(build),
             build_text(build->b, build->def->name), text_cstr(&text));
}

/* ---- Requests ---- */

mxg_ref code_request(struct code_request *request, void (*work)(void *request))
{
    struct mxg_build *build = request->build;
    if (!build || build->has_failed)
        return 0;
    if (!build->foreign)
        work(request);
    else if (!mem_try(build->b->arena->mem, work, request))
        build->has_failed = build->has_no_memory = true;
    build->has_failed |= build->b->graph->overflow || build->b->cancelled;
    return build->has_failed ? 0 : request->result;
}

/* ---- Values ---- */

mxg_ref code_issue(struct mxg_build *build, ir_ref ref)
{
    struct builder *b = build->b;
    if (!ref)
        return 0;
    vec_push(b->arena, &b->code_values, (struct code_value){ref, build->serial});
    return b->code_values.len;
}

bool code_ref(struct mxg_build *build, mxg_ref value, ir_ref *out)
{
    const struct builder *b = build->b;
    *out = 0;
    if (!value)
        return true;
    if (value > b->code_values.len || b->code_values.items[value - 1].serial != build->serial) {
        code_fault(build, "passes a value that belongs to another call", NULL);
        return false;
    }
    *out = b->code_values.items[value - 1].ref;
    return true;
}

bool code_refs(struct mxg_build *build, const mxg_ref *values, uint32_t n, ir_ref **out)
{
    *out = ARENA_ARRAY(build->b->arena, ir_ref, n);
    if (n && !values) {
        code_fault(build, "passes no list of values", NULL);
        return false;
    }
    for (uint32_t i = 0; i < n; i++)
        if (!code_ref(build, values[i], &(*out)[i]))
            return false;
    return true;
}

ir_type_id code_type(struct mxg_build *build, const char *name)
{
    for (unsigned type = IR_TYPE_BOOL; name && type < IR_NUM_TYPES; type++)
        if (strcmp(ir_type_info((ir_type_id)type)->text, name) == 0)
            return (ir_type_id)type;
    code_fault(build, "names an unknown type:", name ? name : "NULL");
    return IR_TYPE_VOID;
}

/* ---- Arguments ---- */

static int find_input(const struct mxg_build *build, const char *name)
{
    for (unsigned i = 0; i < build->def->num_inputs; i++)
        if (strcmp(build_text(build->b, build->ports[i].name), name) == 0)
            return (int)i;
    return -1;
}

static void read_input(void *request)
{
    struct code_request *r = request;
    int index = r->name ? find_input(r->build, r->name) : -1;
    if (index >= 0)
        r->result = code_issue(r->build, r->build->frame->args[index]);
    else
        code_fault(r->build, "asks for an input that the definition does not have:", r->name);
}

mxg_ref mxg_build_input(mxg_build *build, const char *name)
{
    return code_request(&(struct code_request){.build = build, .name = name}, read_input);
}

static float as_number(ir_type_id scalar, union ir_word word)
{
    return scalar == IR_TYPE_FLOAT  ? word.f
           : scalar == IR_TYPE_UINT ? (float)word.u
                                    : (float)word.i;
}

/* False: the caller's struct has no known size. */
static bool write_value(const struct mxg_build *build, const struct ir_value *value, mxg_value *out)
{
    const struct ir_type_info *info = ir_type_info(value->type);
    mxg_value full = {.type = info->text, .text = ""};
    if (value->type == IR_TYPE_STRING) {
        full.text = build_text(build->b, value->w[0].u);
    } else {
        full.num_values = info->components;
        full.integer = info->scalar == IR_TYPE_FLOAT ? 0 : value->w[0].i;
        for (unsigned i = 0; i < info->components; i++)
            full.values[i] = as_number(info->scalar, value->w[i]);
    }
    return struct_write(out, &full, sizeof full) == MXG_OK;
}

struct known_request {
    struct code_request request;
    mxg_value *out;
    const char *type;
};

static void read_type(void *request)
{
    struct known_request *r = request;
    ir_ref ref;
    if (!code_ref(r->request.build, r->request.value, &ref) || !ref)
        return;
    ir_type_id type = ir_type_of(r->request.build->b->graph, ref);
    r->type = ir_type_text(type == IR_TYPE_SAMPLER_ARRAY ? IR_TYPE_SAMPLER : type);
}

const char *mxg_build_type(mxg_build *build, mxg_ref value)
{
    struct known_request r = {.request = {.build = build, .value = value}};
    code_request(&r.request, read_type);
    return r.type;
}

static void read_known(void *request)
{
    struct known_request *r = request;
    const struct mxg_build *build = r->request.build;
    ir_ref ref;
    struct ir_value known;
    r->request.result = code_ref(r->request.build, r->request.value, &ref) && ref
                        && ir_get_const(build->b->graph, ref, &known)
                        && (!r->out || write_value(build, &known, r->out));
}

bool mxg_build_value(mxg_build *build, mxg_ref value, mxg_value *out)
{
    struct known_request r = {.request = {.build = build, .value = value}, .out = out};
    return code_request(&r.request, read_known) != 0;
}

static void report_not_constant(struct mxg_build *build, unsigned index)
{
    struct builder *b = build->b;
    build->has_failed = true;
    if (ir_get(b->graph, build->frame->args[index])->op != IR_POISON) /* the fault is reported */
        diag_add(b->diags, DIAG_ID_input_must_be_constant, place_of_use(build),
                 build_text(b, build->ports[index].name), build_text(b, build->def->node));
}

static void read_constant(void *request)
{
    struct known_request *r = request;
    struct mxg_build *build = r->request.build;
    struct ir_value value;
    int index = r->request.name ? find_input(build, r->request.name) : -1;
    if (index < 0)
        code_fault(build, "asks for an input that the definition does not have:", r->request.name);
    else if (!build->frame->args[index]
             || !build_initial(build->b, build->frame->args[index], &value))
        report_not_constant(build, (unsigned)index);
    else
        r->request.result = write_value(build, &value, r->out);
}

bool mxg_build_require_constant(mxg_build *build, const char *input, mxg_value *out)
{
    struct known_request r = {.request = {.build = build, .name = input}, .out = out};
    return code_request(&r.request, read_constant) != 0;
}

/* ---- The definition ---- */

mxg_status mxg_build_use(mxg_build *build, mxg_build_info *out)
{
    if (!build)
        return MXG_ERROR_ARGUMENT;
    const struct builder *b = build->b;
    mxg_build_info full = {.nodedef = build_text(b, build->def->name),
                           .node = build_text(b, build->def->node),
                           .target =
                               b->options->num_targets ? build_text(b, b->options->targets[0]) : "",
                           .num_inputs = build->def->num_inputs,
                           .num_outputs = build->def->num_outputs,
                           .has_vertex_stage = build_has_vertex_stage(b)};
    return struct_write(out, &full, sizeof full);
}

const char *mxg_build_port(mxg_build *build, uint32_t index, const char **out_type)
{
    if (!build || index >= (uint32_t)build->def->num_inputs + build->def->num_outputs)
        return NULL;
    const struct port *port = &build->ports[index];
    if (out_type)
        *out_type = ir_type_text(library_type_ir(build->b->lib, port->type));
    return build_text(build->b, port->name);
}

/* ---- Errors ---- */

static struct diag_place place_of_input(const struct mxg_build *build, int index)
{
    const struct document *doc = build_doc(build->b);
    elem_id input = index < 0 ? 0
                              : doc_child_of_kind(doc, build->frame->node.element, KIND_INPUT,
                                                  build->ports[index].name);
    return input ? doc_place(doc, input) : place_of_use(build);
}

static void report_error(void *request)
{
    struct code_request *r = request;
    struct mxg_build *build = r->build;
    int index = r->name ? find_input(build, r->name) : -1;
    build->has_failed = true;
    if (index >= 0 && build->frame->args[index]
        && ir_get(build->b->graph, build->frame->args[index])->op == IR_POISON)
        return; /* it follows from an error that is reported */
    diag_add(build->b->diags, DIAG_ID_code_error, place_of_input(build, index),
             build_text(build->b, build->def->node), r->text ? r->text : "");
}

void mxg_build_report_error(mxg_build *build, const char *input, const char *text)
{
    code_request(&(struct code_request){.build = build, .name = input, .text = text}, report_error);
}

/* ---- Runs ---- */

enum { MAX_NESTED = 16 };

/* NULL, or the fault of a result. */
static const char *result_fault(const struct mxg_build *build, unsigned output, ir_ref ref)
{
    ir_type_id type =
        library_type_ir(build->b->lib, build->ports[build->def->num_inputs + output].type);
    bool may_be_absent = ir_type_is_closure(type) || ir_type_is_shader(type);
    if (!ref)
        return may_be_absent ? NULL : "gives no value for the output";
    return ir_type_of(build->b->graph, ref) == type
               ? NULL
               : "gives a value of another type for the output";
}

static void take_results(struct mxg_build *build, const mxg_ref *values, ir_ref *results)
{
    for (unsigned i = 0; i < build->def->num_outputs && !build->has_failed; i++) {
        if (!code_ref(build, values[i], &results[i]))
            return;
        const char *fault = build->foreign ? result_fault(build, i, results[i]) : NULL;
        if (fault)
            code_fault(build, fault,
                       build_text(build->b, build->ports[build->def->num_inputs + i].name));
    }
}

static void poison_results(const struct mxg_build *build, ir_ref *results)
{
    for (unsigned i = 0; i < build->def->num_outputs; i++)
        results[i] = ir_poison(
            build->b->graph,
            library_type_ir(build->b->lib, build->ports[build->def->num_inputs + i].type));
}

void code_run(struct builder *b, const struct frame *frame, mxg_build_fn build, void *user_data,
              const char *foreign, ir_ref *results)
{
    const struct frame use = *frame; /* frames move when the code applies other definitions */
    struct mxg_build call = {.b = b,
                             .frame = &use,
                             .def = library_nodedef(b->lib, use.node.nodedef),
                             .ports = library_ports(b->lib, use.node.nodedef, NULL),
                             .serial = ++b->code_serial,
                             .foreign = foreign};
    mxg_ref values[LIBRARY_MAX_OUTPUTS] = {0};
    call.type = library_type_ir(b->lib, call.ports[call.def->num_inputs].type);
    if (b->code_depth == MAX_NESTED)
        code_fault(&call, "applies definitions whose code applies it again", NULL);
    b->code_depth++;
    uint32_t errors = b->diags->num_errors;
    bool is_good = !call.has_failed && build(user_data, &call, values);
    b->code_depth--;
    if (call.has_no_memory)
        mem_fail(b->arena->mem);
    if (!is_good && !call.has_failed && b->diags->num_errors == errors)
        code_fault(&call, "fails without an error", NULL);
    call.has_failed |= !is_good;
    take_results(&call, values, results);
    if (call.has_failed)
        poison_results(&call, results);
}
