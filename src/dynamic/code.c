// SPDX-License-Identifier: Apache-2.0
/* One use of a node in C: its faults, its values, its results. */
#include "dynamic/code.h"

/* ---- Faults ---- */

struct diag_place code_place(const struct mxg_build *build)
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
    diag_add(build->b->diags, DIAG_ID_code_fault, code_place(build),
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
