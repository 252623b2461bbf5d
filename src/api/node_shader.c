// SPDX-License-Identifier: Apache-2.0
/* The code of a node takes definitions, streams and uniforms from its library and its shader. */
#include "dynamic/code.h"

#include "base/structs.h"
#include "tree/ast.h"

/* ---- Other definitions ---- */

/* The default of an input; a texture has its own variable. */
static ir_ref default_of(struct builder *b, const struct port *port, elem_id node)
{
    if (library_type_ir(b->lib, port->type) != IR_TYPE_SAMPLER)
        return build_default(b, port);
    struct shader_variable v = {.name = port->name, .type = IR_TYPE_SAMPLER, .file = port->value};
    return build_texture(b, v, node);
}

static bool fits(const struct builder *b, const struct port *port, ir_ref value)
{
    ir_type_id type = library_type_ir(b->lib, port->type);
    if (!value)
        return ir_type_is_closure(type) || ir_type_is_shader(type);
    ir_type_id have = ir_type_of(b->graph, value);
    return have == type || (type == IR_TYPE_SAMPLER && have == IR_TYPE_SAMPLER_ARRAY);
}

/* The arguments by input: those that the code names, and defaults. NULL after a report. */
static ir_ref *arguments(struct code_request *r, uint32_t nodedef, const ir_ref *given)
{
    struct builder *b = r->build->b;
    const struct nodedef *def = library_nodedef(b->lib, nodedef);
    const struct port *ports = library_ports(b->lib, nodedef, NULL);
    ir_ref *args = ARENA_ARRAY(b->arena, ir_ref, def->num_inputs);
    bool *is_given = ARENA_ARRAY(b->arena, bool, def->num_inputs);
    for (uint32_t i = 0; i < r->num; i++) {
        const char *word = r->names && r->names[i] ? r->names[i] : "NULL";
        str_id name = str_find(b->shader->strings, word, strlen(word));
        int index = name ? library_find_input(b->lib, nodedef, name) : -1;
        if (index < 0 || !fits(b, &ports[index], given[i])) {
            code_fault(r->build,
                       index < 0 ? "applies a definition that does not have the input"
                                 : "passes a value of another type for the input",
                       word);
            return NULL;
        }
        args[index] = given[i];
        is_given[index] = true;
    }
    for (unsigned i = 0; i < def->num_inputs; i++)
        if (!is_given[i])
            args[i] = default_of(b, &ports[i], r->build->frame->node.element);
    return args;
}

static void make_node(void *request)
{
    struct code_request *r = request;
    struct builder *b = r->build->b;
    str_id name = r->name ? str_find(b->shader->strings, r->name, strlen(r->name)) : 0;
    uint32_t nodedef = name ? library_nodedef_by_name(b->lib, name) : LIBRARY_NONE;
    ir_ref *given, results[LIBRARY_MAX_OUTPUTS];
    if (nodedef == LIBRARY_NONE) {
        code_fault(r->build, "applies an unknown definition:", r->name ? r->name : "NULL");
        return;
    }
    if (!r->results || r->num_results != library_nodedef(b->lib, nodedef)->num_outputs) {
        code_fault(r->build, "expects another number of outputs of", r->name);
        return;
    }
    if (!code_refs(r->build, r->args, r->num, &given))
        return;
    const ir_ref *args = arguments(r, nodedef, given);
    if (!args)
        return;
    uint32_t outer = b->without_code;
    if (nodedef == r->build->frame->node.nodedef)
        b->without_code = nodedef + 1;
    build_apply(b, nodedef, r->build->frame->node.element, args, results);
    b->without_code = outer;
    for (uint32_t i = 0; i < r->num_results; i++)
        r->results[i] = code_issue(r->build, results[i]);
    r->result = true;
}

bool mxg_build_node(mxg_build *build, const char *nodedef, const char *const *names,
                    const mxg_ref *args, uint32_t num_args, mxg_ref *results, uint32_t num_results)
{
    return code_request(&(struct code_request){.build = build,
                                               .name = nodedef,
                                               .names = names,
                                               .args = args,
                                               .num = num_args,
                                               .results = results,
                                               .num_results = num_results},
                        make_node)
           != 0;
}

/* ---- Streams ---- */

static void make_stream(void *request)
{
    struct code_request *r = request;
    struct builder *b = r->build->b;
    ir_type_id type = IR_TYPE_VOID;
    ir_ref stream = 0;
    if (r->type && (type = code_type(r->build, r->type)) == IR_TYPE_VOID)
        return;
    bool is_carried = type == IR_TYPE_VOID || build_is_number(type);
    if (r->name && is_carried)
        stream = shader_stream(b->shader, str_intern_z(b->shader->strings, r->name), type);
    if (stream && (type == IR_TYPE_VOID || ir_type_of(b->graph, stream) == type))
        r->result = code_issue(r->build, stream);
    else
        code_fault(r->build, "reads an unknown stream, or one without this type:",
                   r->name ? r->name : "NULL");
}

mxg_ref mxg_build_stream(mxg_build *build, const char *name, const char *type)
{
    return code_request(&(struct code_request){.build = build, .name = name, .type = type},
                        make_stream);
}

static bool reads_stream(const struct builder *b, uint32_t callee)
{
    const struct ir_callee *called = &b->graph->callees.items[callee];
    const struct lang_unit *layer;
    if (called->kind != IR_CALLEE_FUNCTION)
        return true;
    const struct lang_function *fn = lang_function(b->shader->unit, called->index, &layer);
    for (uint32_t i = 0; i < fn->num_globals; i++)
        if (lang_global(b->shader->unit, ast_globals(layer, fn)[i], NULL)->kind
            == LANG_GLOBAL_STREAM)
            return true;
    return false;
}

/* True if the value depends on the pixel in another way than by the nodes of streams. */
static bool belongs_to_pixel(struct builder *b, ir_ref value)
{
    const uint8_t *needed = ir_mark(b->graph, &value, 1, b->arena);
    for (ir_ref ref = 1; ref < b->graph->nodes.len; ref++) {
        const struct ir_node *node = ir_get(b->graph, ref);
        bool is_call = node->op == IR_CALL || node->op == IR_VERBATIM;
        bool is_local = node->op == IR_PARAM || node->op == IR_LOCAL || node->op == IR_CONTEXT
                        || node->op == IR_SAMPLE;
        if (needed[ref] && (is_local || (is_call && reads_stream(b, node->attr))))
            return true;
    }
    return false;
}

/* True for numbers and vectors of numbers, which stages can pass on. */
static bool is_varying(ir_type_id type)
{
    return type < IR_NUM_TYPES && ir_type_info(type)->components > 0 && !ir_type_is_matrix(type)
           && ir_type_info(type)->scalar >= IR_TYPE_INT
           && ir_type_info(type)->scalar <= IR_TYPE_FLOAT;
}

static void make_interpolated(void *request)
{
    struct code_request *r = request;
    struct builder *b = r->build->b;
    ir_ref value;
    if (!code_ref(r->build, r->value, &value))
        return;
    ir_type_id type = value ? ir_type_of(b->graph, value) : IR_TYPE_VOID;
    if (!is_varying(type) || !r->name) {
        code_fault(r->build,
                   "interpolates a value that is no number or vector:", r->name ? r->name : "NULL");
        return;
    }
    bool stays = !build_has_vertex_stage(b) || ir_is_const(b->graph, value)
                 || ir_get(b->graph, value)->op == IR_POISON || belongs_to_pixel(b, value);
    if (!stays)
        value = shader_interpolate(b->shader, str_intern_z(b->shader->strings, r->name), value);
    r->result = code_issue(r->build, value);
}

mxg_ref mxg_build_interpolation(mxg_build *build, const char *name, mxg_ref value)
{
    return code_request(&(struct code_request){.build = build, .name = name, .value = value},
                        make_interpolated);
}

/* ---- Uniforms ---- */

static void set_default(struct code_request *r, const mxg_build_uniform *uniform,
                        struct shader_variable *variable)
{
    struct ir_value value;
    if (!uniform->num_values
        || !code_numbers(r->build, variable->type, uniform->values, uniform->num_values, &value))
        return;
    variable->has_default = true;
    variable->value = value;
}

/* UINT32_MAX after a message: no shader can have the uniform, or it is elsewhere in the shader. */
static uint32_t declare(struct code_request *r, const mxg_build_uniform *uniform, ir_type_id type)
{
    struct builder *b = r->build->b;
    str_id name = str_intern_z(b->shader->strings, uniform->name);
    if (build_uniform_fault(b, name, type)) {
        code_fault(r->build, "adds a uniform of mxgen, with another type, or a word of the target:",
                   uniform->name);
        return UINT32_MAX;
    }
    if (!uniform->block)
        return shader_private_uniform(b->shader, name, type, 0);
    str_id block = str_intern_z(b->shader->strings, uniform->block);
    enum shader_block own = NUM_BLOCKS;
    bool may_be = *uniform->block && type != IR_TYPE_SAMPLER && !shader_knows_uniform(name);
    if (may_be && !build_uniform_fault(b, block, IR_TYPE_VOID))
        own = shader_own_block(b->shader, block);
    if (own != NUM_BLOCKS)
        return shader_own_uniform(b->shader, own, name, type);
    code_fault(r->build,
               may_be ? "adds a uniform to a block that the shader cannot have, because there are "
                        "four or the name is taken:"
                      : "adds a texture or a uniform of mxgen to a block:",
               may_be ? uniform->block : uniform->name);
    return UINT32_MAX;
}

static void make_uniform(void *request)
{
    struct code_request *r = request;
    struct builder *b = r->build->b;
    mxg_build_uniform uniform;
    if (!r->uniform || !struct_read(&uniform, sizeof uniform, r->uniform)) {
        code_fault(r->build, "describes a uniform by a struct of unknown size", NULL);
        return;
    }
    ir_type_id type = code_type(r->build, uniform.type);
    const char *word = uniform.name ? uniform.name : "NULL";
    if (type == IR_TYPE_VOID)
        return;
    if (!uniform.name || !*word || (!build_is_number(type) && type != IR_TYPE_SAMPLER)) {
        code_fault(r->build, "adds a uniform that no shader can have:", word);
        return;
    }
    uint32_t index = declare(r, &uniform, type);
    if (index == UINT32_MAX)
        return;
    struct shader_variable *variable = &b->shader->interface.variables.items[index];
    if (variable->type != type) {
        code_fault(r->build, "adds a uniform that has another type elsewhere:", word);
        return;
    }
    if (variable->rank == 0) {
        set_default(r, &uniform, variable);
        if (uniform.semantic)
            variable->semantic = str_intern_z(b->shader->strings, uniform.semantic);
    }
    r->result = code_issue(r->build, shader_read(b->shader, index));
}

mxg_ref mxg_build_add_uniform(mxg_build *build, const mxg_build_uniform *uniform)
{
    return code_request(&(struct code_request){.build = build, .uniform = uniform}, make_uniform);
}
