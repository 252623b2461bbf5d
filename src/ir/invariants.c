// SPDX-License-Identifier: Apache-2.0
/*
 * check: the invariants of each node and of the graph as a whole. ir_node_problem is the one
 * definition of a well-formed node: the builder asserts it, the parser reports it, and ir_check
 * applies it to each node.
 */
#include "ir/ir_priv.h"

#include <stdio.h>
#include <stdlib.h>

/*
 * Operand types of closures and shaders, one letter each: c closure, s shader, n float or vector, b
 * bool, o closure or shader, x anything.
 */
static const struct operands {
    uint8_t op;
    const char *classes;
} operand_classes[] = {
    {IR_LAYER, "cc"},
    {IR_CLOSURE_MIX, "ccn"},
    {IR_CLOSURE_ADD, "oo"},
    {IR_CLOSURE_SCALE, "on"},
    {IR_SURFACE_SHADER, "ccnb"},
    {IR_SURFACE_UNLIT, "nnn"},
    {IR_VOLUME_SHADER, "cc"},
    {IR_DISPLACEMENT_SHADER, "nn"},
    {IR_LIGHT_SHADER, "cnn"},
    {IR_SHADER_MIX, "ssn"},
    {IR_MATERIAL, "ssss"},
    {IR_SLAB_LAYER, "ccn"},
    {IR_SLAB_SURFACE, "cbn"},
    {IR_SUBSTANCE, "snnn"},
    {IR_SLOTS, "nnsnnnnx"},
    {IR_AOV, "sx"},
    {IR_MATTER, "sc"},
};

/* The class of an operand: the last ones repeat for each layer of a stack, and for each AOV. */
static char class_of(const struct operands *operands, unsigned index)
{
    if (operands->op == IR_SLOTS && index >= IR_SLOTS_FIRST)
        index = IR_SLOTS_FIRST + (index - IR_SLOTS_FIRST) % IR_SLOT_OPERANDS;
    return operands->classes[operands->op == IR_MATTER && index ? 1 : index];
}

static bool is_of_class(ir_type_id type, char class)
{
    switch (class) {
    case 'c': return ir_type_is_closure(type);
    case 's': return ir_type_is_shader(type);
    case 'o': return ir_type_is_closure(type) || ir_type_is_shader(type);
    case 'n': return ir_type_is_float(type) && !ir_type_is_matrix(type);
    case 'b': return type == IR_TYPE_BOOL;
    default: return true;
    }
}

static bool is_type(const struct ir_graph *graph, ir_type_id type)
{
    return type < IR_NUM_TYPES
           || (type >= IR_TYPE_FIRST_USER
               && type - IR_TYPE_FIRST_USER < (int)graph->user_types.len);
}

static const struct ir_user_type *user_type(const struct ir_graph *graph, ir_type_id type)
{
    return type >= IR_TYPE_FIRST_USER ? &graph->user_types.items[type - IR_TYPE_FIRST_USER] : NULL;
}

static bool is_user_construct(const struct ir_graph *graph, const struct ir_user_type *type,
                              const ir_ref *args, unsigned num_args)
{
    if (num_args != (type->array_length ? type->array_length : type->num_members))
        return false;
    for (unsigned i = 0; i < num_args; i++) {
        ir_type_id expected =
            type->array_length ? type->element : graph->members.items[type->first_member + i].type;
        if (ir_type_of(graph, args[i]) != expected)
            return false;
    }
    return true;
}

static bool is_construct(const struct ir_graph *graph, ir_type_id type, const ir_ref *args,
                         unsigned num_args)
{
    const struct ir_user_type *user = user_type(graph, type);
    if (user)
        return is_user_construct(graph, user, args, num_args);
    const struct ir_type_info *info = ir_type_info(type);
    uint64_t total = 0;
    for (unsigned i = 0; i < num_args; i++) {
        ir_type_id part = ir_type_of(graph, args[i]);
        if (part >= IR_NUM_TYPES || ir_type_info(part)->scalar != info->scalar
            || ir_type_info(part)->columns > 1)
            return false;
        total += ir_type_info(part)->components;
    }
    return info->components > 1 && (total == info->components || (total == 1 && num_args == 1));
}

static bool is_convert(ir_type_id type, ir_type_id from)
{
    if (type >= IR_NUM_TYPES || from >= IR_NUM_TYPES)
        return false;
    const struct ir_type_info *to_info = ir_type_info(type), *from_info = ir_type_info(from);
    if (ir_type_is_matrix(type) || ir_type_is_matrix(from) || type == from)
        return type == from || (ir_type_is_matrix(type) && ir_type_is_matrix(from));
    if (to_info->scalar == from_info->scalar)
        return to_info->components > 0 && to_info->components < from_info->components;
    return to_info->components == from_info->components && to_info->scalar >= IR_TYPE_BOOL
           && to_info->scalar <= IR_TYPE_FLOAT && from_info->scalar >= IR_TYPE_BOOL
           && from_info->scalar <= IR_TYPE_FLOAT;
}

static bool is_swizzle(ir_type_id type, uint32_t attr, ir_type_id from)
{
    unsigned count = attr >> 8;
    if (from >= IR_NUM_TYPES || ir_type_info(from)->columns > 1 || count < 1 || count > 4
        || (attr & 255) >> (2 * count))
        return false;
    for (unsigned i = 0; i < count; i++)
        if ((attr >> (2 * i) & 3) >= ir_type_info(from)->components)
            return false;
    return type != IR_TYPE_VOID && type == ir_type_vector(ir_type_info(from)->scalar, count);
}

static bool is_member(const struct ir_graph *graph, ir_type_id type, uint32_t attr, ir_type_id from)
{
    const struct ir_user_type *user = user_type(graph, from);
    return user && attr < user->num_members
           && graph->members.items[user->first_member + attr].type == type;
}

static bool is_index(const struct ir_graph *graph, ir_type_id type, ir_type_id from,
                     ir_type_id index)
{
    if (index != IR_TYPE_INT && index != IR_TYPE_UINT)
        return false;
    const struct ir_user_type *user = user_type(graph, from);
    if (user)
        return user->array_length && user->element == type;
    const struct ir_type_info *info = ir_type_info(from);
    if (ir_type_is_matrix(from))
        return type == ir_type_vector(IR_TYPE_FLOAT, info->columns);
    return info->components > 1 && type == info->scalar;
}

static bool is_call(const struct ir_graph *graph, ir_ref ref)
{
    unsigned op = ir_get(graph, ref)->op;
    return op == IR_CALL || op == IR_VERBATIM || op == IR_GRAPH_CALL;
}

static const char *callee_problem(const struct ir_graph *graph, enum ir_op op, uint32_t attr)
{
    if (attr >= graph->callees.len)
        return "there is no such callee";
    enum ir_callee_kind kind = graph->callees.items[attr].kind;
    bool fits = op == IR_LEAF ? kind == IR_CALLEE_FAMILY || kind == IR_CALLEE_CLOSURE
                                    || kind == IR_CALLEE_SOURCE
                              : kind == (op == IR_CALL ? IR_CALLEE_FUNCTION : IR_CALLEE_VERBATIM);
    return fits ? NULL : "the callee is not of the op's kind";
}

static const char *graph_call_problem(const struct ir_graph *graph, ir_type_id type, uint32_t attr,
                                      const ir_ref *args, unsigned num_args)
{
    if (attr >= graph->functions.len)
        return "there is no such function";
    const struct ir_function *function = &graph->functions.items[attr];
    if (!function->num_results)
        return "the function is called before its results are set";
    if (num_args != function->num_params)
        return "the call does not have the function's number of arguments";
    for (unsigned i = 0; i < num_args; i++)
        if (ir_type_of(graph, args[i]) != graph->param_types.items[function->first_param_type + i])
            return "an argument does not have the parameter's type";
    ir_type_id first = ir_type_of(graph, graph->function_results.items[function->first_result]);
    return type == IR_TYPE_VOID || type == first
               ? NULL
               : "the type is neither void nor that of the first result";
}

static const char *result_problem(const struct ir_graph *graph, ir_type_id type, uint32_t attr,
                                  ir_ref call)
{
    const struct ir_node *node = ir_get(graph, call);
    if (!is_call(graph, call))
        return "the operand of a result is not a call";
    if (node->op != IR_GRAPH_CALL)
        return NULL;
    const struct ir_function *function = &graph->functions.items[node->attr];
    if (attr >= function->num_results)
        return "the function has fewer results";
    ir_ref result = graph->function_results.items[function->first_result + attr];
    return ir_type_of(graph, result) == type ? NULL
                                             : "the result does not have the function's type";
}

static const char *param_problem(const struct ir_graph *graph, ir_type_id type, uint32_t attr)
{
    uint32_t index = attr & 0xffff;
    if (attr >> 16 >= graph->functions.len)
        return "there is no such function";
    const struct ir_function *function = &graph->functions.items[attr >> 16];
    if (index >= function->num_params)
        return "the function has fewer parameters";
    return graph->param_types.items[function->first_param_type + index] == type
               ? NULL
               : "the parameter has another type";
}

/* Ops whose operands follow no rule in op_types.c. */
static const char *special_problem(const struct ir_graph *graph, enum ir_op op, ir_type_id type,
                                   uint32_t attr, const ir_ref *args, unsigned num_args)
{
    ir_type_id from = num_args ? ir_type_of(graph, args[0]) : IR_TYPE_VOID;
    bool is_value = op == IR_CALL || (op == IR_RESULT && ir_get(graph, args[0])->op != IR_VERBATIM);
    if (is_value && (ir_type_is_closure(type) || ir_type_is_shader(type)))
        return "a call gives a closure or a shader, which no later step would see";
    switch (op) {
    case IR_CONST: return "a constant is not built from operands";
    case IR_PARAM: return param_problem(graph, type, attr);
    case IR_CONSTRUCT:
        return is_construct(graph, type, args, num_args) ? NULL : "the parts do not make the type";
    case IR_CONVERT: return is_convert(type, from) ? NULL : "there is no such conversion";
    case IR_SWIZZLE:
        return is_swizzle(type, attr, from) ? NULL : "the operand does not have these components";
    case IR_MEMBER:
        return is_member(graph, type, attr, from) ? NULL : "the operand does not have this member";
    case IR_INDEX:
        return is_index(graph, type, from, ir_type_of(graph, args[1]))
                   ? NULL
                   : "the operand cannot be indexed so";
    case IR_CALL:
    case IR_VERBATIM:
    case IR_LEAF: return callee_problem(graph, op, attr);
    case IR_GRAPH_CALL: return graph_call_problem(graph, type, attr, args, num_args);
    case IR_RESULT: return result_problem(graph, type, attr, args[0]);
    case IR_CONTEXT:
    case IR_SAMPLE:
        if (op == IR_SAMPLE && type != (attr == IR_SAMPLE_TURN ? IR_TYPE_VEC2 : IR_TYPE_INT))
            return "neither the index nor the turn of a sample";
        if (num_args > 1 || (num_args && from != IR_TYPE_INT))
            return "the operand is no number of a loop";
        break;
    case IR_LOCAL:
        if (num_args > 1 || (num_args && from != IR_TYPE_INT))
            return "the operand is no number of a light";
        break;
    case IR_SLOTS:
        if (num_args % IR_SLOT_OPERANDS != IR_SLOTS_FIRST)
            return "wrong number of operands";
        break;
    default: break;
    }
    for (size_t i = 0; i < sizeof operand_classes / sizeof *operand_classes; i++)
        for (unsigned k = 0; operand_classes[i].op == op && k < num_args; k++)
            if (args[k]
                && !is_of_class(ir_type_of(graph, args[k]), class_of(&operand_classes[i], k)))
                return "an operand has the wrong type";
    return NULL;
}

const char *ir_node_problem(const struct ir_graph *graph, enum ir_op op, ir_type_id type,
                            uint32_t attr, const ir_ref *args, unsigned num_args)
{
    const struct ir_op_info *info = ir_op_info(op);
    if (info->arity >= 0 && num_args != (unsigned)info->arity)
        return "wrong number of operands";
    if (!is_type(graph, type))
        return "there is no such type";
    bool may_be_absent = op >= IR_LEAF;
    ir_type_id types[4];
    for (unsigned i = 0; i < num_args; i++) {
        if (args[i] >= graph->nodes.len || (args[i] == 0 && !may_be_absent))
            return "an operand is missing";
        if (i < 4)
            types[i] = ir_type_of(graph, args[i]);
    }
    if (info->rule == IR_RULE_NONE && !(info->flags & OP_BUILTIN))
        return special_problem(graph, op, type, attr, args, num_args);
    ir_type_id result = ir_op_result(op, types, num_args);
    if (result == IR_TYPE_VOID)
        return "the operands do not fit the op";
    bool is_part = op == IR_TEX && (type == IR_TYPE_FLOAT || type == IR_TYPE_VEC3);
    return result == type || is_part ? NULL : "the operands give another type";
}

static const char *const_problem(const struct ir_graph *graph, const struct ir_node *node)
{
    if (node->type >= IR_NUM_TYPES || ir_type_info(node->type)->components == 0)
        return "a constant has a type without values";
    unsigned components = ir_type_info(node->type)->components;
    return node->attr <= graph->words.len && graph->words.len - node->attr >= components
               ? NULL
               : "a constant lies outside of the pool";
}

static const char *args_problem(const struct ir_graph *graph, ir_ref ref)
{
    const struct ir_node *node = ir_get(graph, ref);
    if (node->num_args > graph->args.len || node->first_arg > graph->args.len - node->num_args)
        return "the operands lie outside of the graph";
    for (uint32_t i = 0; i < node->num_args; i++)
        if (ir_arg(graph, ref, i) >= ref)
            return "an operand is not older than the node";
    return NULL;
}

/* The body of a function is older than its calls, so a walk from the newest node sees it later. */
static bool has_body_below(const struct ir_graph *graph, ir_ref call)
{
    const struct ir_function *function = &graph->functions.items[ir_get(graph, call)->attr];
    for (uint32_t i = 0; i < function->num_results; i++)
        if (graph->function_results.items[function->first_result + i] >= call)
            return false;
    return true;
}

static const char *node_problem(const struct ir_graph *graph, ir_ref ref)
{
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op >= IR_NUM_OPS)
        return "there is no such op";
    const char *problem = args_problem(graph, ref);
    if (!problem)
        problem = node->op == IR_CONST
                      ? const_problem(graph, node)
                      : ir_node_problem(graph, (enum ir_op)node->op, node->type, node->attr,
                                        ir_args(graph, ref), node->num_args);
    if (problem)
        return problem;
    if (node->origin >= graph->origins.len)
        return "the origin lies outside of the graph";
    if (node->op == IR_GRAPH_CALL && !has_body_below(graph, ref))
        return "the body of a function is not older than its call";
    if (node->flags != ir_flags_of(graph, ref))
        return "the flags are not those of the op and its operands";
    return ir_find_equal(graph, ref) == ref ? NULL : "the node stands twice";
}

static const char *function_problem(const struct ir_graph *graph,
                                    const struct ir_function *function)
{
    if (function->num_params > graph->param_types.len
        || function->first_param_type > graph->param_types.len - function->num_params)
        return "the parameters of a function lie outside of the graph";
    if (function->num_results > graph->function_results.len
        || function->first_result > graph->function_results.len - function->num_results)
        return "the results of a function lie outside of the graph";
    for (uint32_t i = 0; i < function->num_results; i++)
        if (graph->function_results.items[function->first_result + i] - 1 >= graph->nodes.len - 1)
            return "a result of a function is no node";
    return NULL;
}

static const char *user_type_problem(const struct ir_graph *graph, uint32_t index)
{
    const struct ir_user_type *type = &graph->user_types.items[index];
    ir_type_id own = (ir_type_id)(IR_TYPE_FIRST_USER + index);
    if (type->array_length)
        return is_type(graph, type->element) && type->element < own
                   ? NULL
                   : "the element type of an array is not older than the array";
    if (type->num_members > graph->members.len
        || type->first_member > graph->members.len - type->num_members)
        return "the members of a struct lie outside of the graph";
    for (uint32_t i = 0; i < type->num_members; i++) {
        ir_type_id member = graph->members.items[type->first_member + i].type;
        if (!is_type(graph, member) || member >= own)
            return "the type of a member is not older than the struct";
    }
    return NULL;
}

/* The tables that nodes refer to. */
static const char *tables_problem(const struct ir_graph *graph)
{
    const char *problem = NULL;
    for (uint32_t i = 0; i < graph->functions.len && !problem; i++)
        problem = function_problem(graph, &graph->functions.items[i]);
    for (uint32_t i = 0; i < graph->user_types.len && !problem; i++)
        problem = user_type_problem(graph, i);
    for (uint32_t i = 1; i < graph->origins.len && !problem; i++)
        if (graph->origins.items[i].parent >= i)
            problem = "the parent of an origin is not older than the origin";
    if (!problem && graph->outer_origins.len)
        problem = "an origin was pushed and not popped";
    return problem;
}

const char *ir_check(const struct ir_graph *graph, ir_ref *out_node)
{
    *out_node = 0;
    const char *problem = tables_problem(graph);
    for (ir_ref ref = 1; ref < graph->nodes.len && !problem; ref++)
        if ((problem = node_problem(graph, ref)) != NULL)
            *out_node = ref;
    return problem;
}

void ir_fail(const char *where, ir_ref node, enum ir_op op, const char *problem)
{
    fprintf(stderr, "mxgen: internal error: IR, %s: node %u (%s): %s\n", where, (unsigned)node,
            op < IR_NUM_OPS ? ir_op_info(op)->text : "?", problem);
    abort();
}

void ir_assert_valid(const struct ir_graph *graph, const char *step)
{
#ifdef MXG_CHECK_IR
    ir_ref node;
    const char *problem = ir_check(graph, &node);
    if (problem)
        ir_fail(step, node, (enum ir_op)ir_get(graph, node)->op, problem);
#else
    (void)graph;
    (void)step;
#endif
}
