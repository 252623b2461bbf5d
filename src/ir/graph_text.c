// SPDX-License-Identifier: Apache-2.0
/*
 * print: the text form of a graph (docs/ir.md): declarations, then the nodes that the roots need,
 * in array order.
 */
#include "ir/ir.h"

#include <math.h>

struct printer {
    const struct ir_graph *graph;
    struct text *out;
    uint32_t *number; /* line number per node; constants have none */
    uint32_t last_number;
    uint8_t *printed; /* per function: its results are printed */
};

static void print_string(struct printer *p, str_id s)
{
    const struct strpool *strings = p->graph->strings;
    text_json_string(p->out, s ? str_text(strings, s) : "", s ? str_len(strings, s) : 0);
}

static void print_type(struct printer *p, ir_type_id type)
{
    if (type < IR_TYPE_FIRST_USER) {
        text_str(p->out, ir_type_text(type));
        return;
    }
    text_char(p->out, '$');
    text_u32(p->out, type - (uint32_t)IR_TYPE_FIRST_USER);
}

/* The sign and payload of a NaN are part of a constant. */
static void print_float(struct printer *p, union ir_word w)
{
    text_float(p->out, w.f);
    if (isnan(w.f)) {
        text_char(p->out, '#');
        text_u32(p->out, w.u);
    }
}

static void print_word(struct printer *p, ir_type_id scalar, union ir_word w)
{
    switch (scalar) {
    case IR_TYPE_BOOL: text_str(p->out, w.u ? "true" : "false"); break;
    case IR_TYPE_INT: text_i32(p->out, w.i); break;
    case IR_TYPE_UINT:
        text_u32(p->out, w.u);
        text_char(p->out, 'u');
        break;
    case IR_TYPE_STRING: print_string(p, w.u); break;
    default: print_float(p, w);
    }
}

static void print_const(struct printer *p, const struct ir_node *node)
{
    const struct ir_type_info *info = ir_type_info(node->type);
    const union ir_word *words = p->graph->words.items + node->attr;
    if (info->components > 1) {
        text_str(p->out, info->text);
        text_char(p->out, '(');
    }
    for (unsigned i = 0; i < info->components; i++) {
        if (i)
            text_str(p->out, ", ");
        print_word(p, info->scalar, words[i]);
    }
    if (info->components > 1)
        text_char(p->out, ')');
}

static void print_operand(struct printer *p, ir_ref ref)
{
    if (ref == 0) {
        text_char(p->out, '_');
    } else if (ir_get(p->graph, ref)->op == IR_CONST) {
        print_const(p, ir_get(p->graph, ref));
    } else {
        text_char(p->out, '%');
        text_u32(p->out, p->number[ref]);
    }
}

static void print_operands(struct printer *p, const ir_ref *refs, uint32_t num_refs)
{
    for (uint32_t i = 0; i < num_refs; i++) {
        text_str(p->out, i ? ", " : " ");
        print_operand(p, refs[i]);
    }
}

static void print_attr(struct printer *p, const struct ir_node *node)
{
    switch (node->op) {
    case IR_SWIZZLE:
        text_str(p->out, " .");
        for (unsigned i = 0; i < node->attr >> 8; i++)
            text_char(p->out, "xyzw"[node->attr >> (2 * i) & 3]);
        break;
    case IR_PARAM:
        text_str(p->out, " @");
        text_u32(p->out, node->attr >> 16);
        text_char(p->out, ':');
        text_u32(p->out, node->attr & 0xffff);
        break;
    default:
        if (node->attr) {
            text_str(p->out, " @");
            text_u32(p->out, node->attr);
        }
    }
}

static void print_results(struct printer *p, uint32_t index)
{
    const struct ir_function *function = &p->graph->functions.items[index];
    if (p->printed[index])
        return;
    p->printed[index] = 1;
    text_str(p->out, "results ");
    text_u32(p->out, index);
    text_str(p->out, " =");
    print_operands(p, p->graph->function_results.items + function->first_result,
                   function->num_results);
    text_char(p->out, '\n');
}

/* Prints the origin as a comment. A line break would end the comment. */
static void print_origin(struct printer *p, const struct ir_node *node)
{
    str_id name = p->graph->origins.items[node->origin].name;
    if (!name)
        return;
    size_t begin = p->out->len;
    text_fmt(p->out, " ; %s", str_text(p->graph->strings, name));
    text_show(p->out, begin);
}

static void print_node(struct printer *p, ir_ref ref)
{
    const struct ir_node *node = ir_get(p->graph, ref);
    if (node->op == IR_CONST)
        return;
    if (node->op == IR_GRAPH_CALL)
        print_results(p, node->attr);
    p->number[ref] = ++p->last_number;
    print_operand(p, ref);
    text_str(p->out, " = ");
    text_str(p->out, ir_op_info((enum ir_op)node->op)->text);
    text_char(p->out, ' ');
    print_type(p, node->type);
    print_attr(p, node);
    print_operands(p, ir_args(p->graph, ref), node->num_args);
    print_origin(p, node);
    text_char(p->out, '\n');
}

static void print_user_types(struct printer *p)
{
    for (uint32_t i = 0; i < p->graph->user_types.len; i++) {
        const struct ir_user_type *type = &p->graph->user_types.items[i];
        if (type->array_length) {
            text_str(p->out, "array ");
            print_type(p, type->element);
            text_char(p->out, ' ');
            text_u32(p->out, type->array_length);
        } else {
            text_str(p->out, "struct ");
            print_string(p, type->name);
            for (uint32_t k = 0; k < type->num_members; k++) {
                const struct ir_member *member = &p->graph->members.items[type->first_member + k];
                text_str(p->out, k ? ", " : " ");
                print_type(p, member->type);
                text_char(p->out, ' ');
                print_string(p, member->name);
            }
        }
        text_char(p->out, '\n');
    }
}

static void print_callees(struct printer *p)
{
    for (uint32_t i = 0; i < p->graph->callees.len; i++) {
        const struct ir_callee *callee = &p->graph->callees.items[i];
        text_str(p->out, "callee ");
        print_string(p, callee->name);
        text_fmt(p->out, " %s %u", ir_callee_kinds[callee->kind], (unsigned)callee->index);
        text_str(p->out, callee->derivative ? " derivative" : "");
        text_str(p->out, callee->pure ? " pure\n" : "\n");
    }
}

static void print_functions(struct printer *p)
{
    for (uint32_t i = 0; i < p->graph->functions.len; i++) {
        const struct ir_function *function = &p->graph->functions.items[i];
        text_str(p->out, "function ");
        print_string(p, function->name);
        for (uint32_t k = 0; k < function->num_params; k++) {
            text_str(p->out, k ? ", " : " ");
            print_type(p, p->graph->param_types.items[function->first_param_type + k]);
        }
        text_char(p->out, '\n');
    }
}

void ir_print(const struct ir_graph *graph, const ir_ref *roots, uint32_t num_roots,
              struct text *out)
{
    struct printer p = {
        .graph = graph,
        .out = out,
        .number = ARENA_ARRAY(out->arena, uint32_t, graph->nodes.len),
        .printed = ARENA_ARRAY(out->arena, uint8_t, graph->functions.len),
    };
    const uint8_t *marked = ir_mark(graph, roots, num_roots, out->arena);
    print_user_types(&p);
    print_callees(&p);
    print_functions(&p);
    for (ir_ref ref = 1; ref < graph->nodes.len; ref++)
        if (marked[ref])
            print_node(&p, ref);
    if (num_roots) {
        text_str(out, "return");
        print_operands(&p, roots, num_roots);
        text_char(out, '\n');
    }
}
