// SPDX-License-Identifier: Apache-2.0
/* The arguments of a use of a node in C, its definition, and its errors (mxgen/node.h). */
#include "base/structs.h"
#include "dynamic/code.h"

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
        diag_add(b->diags, DIAG_ID_input_must_be_constant, code_place(build),
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
    return input ? doc_place(doc, input) : code_place(build);
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
