// SPDX-License-Identifier: Apache-2.0
/*
 * Finds the vec3 nodes that are colours. OSL distinguishes colours, vectors, points and normals,
 * and warns of calls that mix them. One pass upwards: results of colours are colours. One pass
 * downwards: nodes that could be either, usually literals, get the kind of their use. A literal has
 * one kind in the whole shader, so a third pass finds sums that are vectors after all.
 */
#include "generators/osl/osl.h"

static bool is_triple(const struct ir_graph *graph, ir_ref ref)
{
    return ref && ir_type_of(graph, ref) == IR_TYPE_VEC3;
}

/* Ops that return a vector, and calls of library functions, for any operands. */
static bool gives_vector(enum ir_op op)
{
    return op == IR_NORMALIZE || op == IR_CROSS || op == IR_REFLECT || op == IR_REFRACT
           || op == IR_FACEFORWARD || op == IR_CALL || op == IR_GRAPH_CALL || op == IR_VERBATIM
           || op == IR_RESULT || op == IR_SWIZZLE || op == IR_INDEX || op == IR_MEMBER;
}

static enum osl_kind kind_of_variable(const struct osl *osl, uint32_t index)
{
    const struct shader_variable *variable = &osl->spell->shader->interface.variables.items[index];
    const char *spelled = osl->spell->variables[index].text; /* NULL: nothing reads it */
    if (spelled && strcmp(spelled, "P") == 0)
        return OSL_POINT;
    if (spelled && strcmp(spelled, "N") == 0)
        return OSL_NORMAL;
    return variable->doc_type == STR_color3 ? OSL_COLOR : OSL_VECTOR;
}

/* True for a call of a library function that a function of stdosl.h replaces. */
static bool is_same_call(const struct osl *osl, ir_ref ref)
{
    const struct spell *spell = osl->spell;
    return ir_get(spell->shader->graph, ref)->op == IR_CALL
           && osl_same_function(spell, shader_callee(spell->shader, ref));
}

static enum osl_kind kind_of(const struct osl *osl, ir_ref ref)
{
    const struct ir_graph *graph = osl->spell->shader->graph;
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op == IR_UNIFORM || node->op == IR_STREAM)
        return kind_of_variable(osl, node->attr);
    if (node->op == IR_TEX || (node->op == IR_RESULT && is_same_call(osl, ir_arg(graph, ref, 0))))
        return OSL_COLOR;
    if (gives_vector(node->op) || (node->num_args == 0 && node->op != IR_CONST))
        return OSL_VECTOR;
    enum osl_kind kind = OSL_ANY;
    for (uint32_t i = 0; i < node->num_args; i++) {
        ir_ref arg = ir_arg(graph, ref, i);
        if (!is_triple(graph, arg) || osl->kinds[arg] == OSL_ANY)
            continue;
        if (osl->kinds[arg] == OSL_COLOR)
            return OSL_COLOR;
        bool is_operator = ir_op_info(node->op)->flags & OP_OPERATOR;
        if (kind != OSL_POINT)
            kind = is_operator && (kind == OSL_ANY || osl->kinds[arg] == OSL_POINT)
                       ? (enum osl_kind)osl->kinds[arg]
                       : OSL_VECTOR;
    }
    return kind;
}

/* The kind that an op needs for operands that could be either. */
static enum osl_kind wanted_kind(const struct osl *osl, ir_ref user)
{
    const struct ir_graph *graph = osl->spell->shader->graph;
    const struct ir_node *node = ir_get(graph, user);
    if (node->op >= IR_LEAF)
        return OSL_COLOR;
    if (node->op == IR_DOT) /* "dot(opacity, color(…))" */
        return (enum osl_kind)(osl->kinds[ir_arg(graph, user, 0)] == OSL_COLOR
                                   ? OSL_COLOR
                                   : osl->kinds[ir_arg(graph, user, 1)]);
    return is_triple(graph, user) && !gives_vector(node->op) ? (enum osl_kind)osl->kinds[user]
                                                             : OSL_ANY;
}

/* True for a sum or product of numbers and vectors alone, which is no colour in OSL. */
static bool is_of_vectors(const struct osl *osl, ir_ref ref)
{
    const struct ir_graph *graph = osl->spell->shader->graph;
    const struct ir_node *node = ir_get(graph, ref);
    bool any = false;
    if (node->op < IR_ADD || node->op > IR_DIV)
        return false;
    for (uint32_t i = 0; i < node->num_args; i++) {
        ir_ref arg = ir_arg(graph, ref, i);
        if (ir_type_is_matrix(ir_type_of(graph, arg))
            || (is_triple(graph, arg) && osl->kinds[arg] != OSL_VECTOR))
            return false;
        any |= is_triple(graph, arg);
    }
    return any;
}

void osl_find_kinds(struct osl *osl)
{
    const struct ir_graph *graph = osl->spell->shader->graph;
    osl->kinds = ARENA_ARRAY(osl->spell->scratch, uint8_t, graph->nodes.len);
    for (ir_ref ref = 1; ref < graph->nodes.len; ref++)
        osl->kinds[ref] = (uint8_t)(is_triple(graph, ref) ? kind_of(osl, ref) : OSL_ANY);
    for (ir_ref ref = graph->nodes.len; ref-- > 1;) {
        const struct ir_node *node = ir_get(graph, ref);
        enum osl_kind wanted = wanted_kind(osl, ref);
        for (uint32_t i = 0; i < node->num_args && wanted != OSL_ANY; i++) {
            ir_ref arg = ir_arg(graph, ref, i);
            if (is_triple(graph, arg) && osl->kinds[arg] == OSL_ANY)
                osl->kinds[arg] = (uint8_t)wanted;
        }
    }
    for (ir_ref ref = 1; ref < graph->nodes.len; ref++)
        if (is_of_vectors(osl, ref))
            osl->kinds[ref] = OSL_VECTOR;
}

const char *osl_node_type(const struct spell *spell, ir_ref ref)
{
    const struct osl *osl = spell->target_data;
    bool is_color = is_triple(spell->shader->graph, ref) ? osl->kinds[ref] == OSL_COLOR
                                                         : is_same_call(osl, ref);
    return is_color ? "color" : NULL;
}
