// SPDX-License-Identifier: Apache-2.0
/* The nodes of a document that compute values of the IR: each op, with its types, and what nodes
 * cannot compute. */
#include "base/mem.h"
#include "translate/value_nodes.h"

#include "cases.h"
#include "ir_text.h"

#include <stdio.h>

static struct mem mem;
static struct arena arena;

/* The type of uniform number `attr`. */
static const enum value_type leaves[] = {VALUE_COLOR3,  VALUE_VECTOR3, VALUE_FLOAT,
                                         VALUE_INTEGER, VALUE_BOOLEAN, VALUE_COLOR4};

static bool leaf(void *user_data, const struct ir_graph *graph, ir_ref ref, struct operand *out)
{
    (void)user_data;
    const struct ir_node *node = ir_get(graph, ref);
    bool is_leaf = node->op == IR_UNIFORM && node->attr < sizeof leaves / sizeof *leaves;
    if (is_leaf)
        *out =
            (struct operand){.kind = OPERAND_LEAF, .type = leaves[node->attr], .index = node->attr};
    return is_leaf;
}

static void write_operand(const struct operand *operand, struct text *out)
{
    if (operand->kind == OPERAND_CONSTANT)
        value_write(operand, out);
    else
        text_fmt(out, "%s%u", operand->kind == OPERAND_LEAF ? "u" : "n", (unsigned)operand->index);
}

/* "n0 = multiply color3 in1 u0 in2 2.0", and on the last line "n0" */
static void write_nodes(const struct value_nodes *nodes, const struct operand *value,
                        struct text *out)
{
    for (uint32_t i = 0; i < nodes->nodes.len; i++) {
        const struct value_node *node = &nodes->nodes.items[i];
        text_fmt(out, "n%u = %s %s", (unsigned)i, node->category, value_type_name(node->type));
        for (unsigned k = 0; k < node->num_inputs; k++) {
            text_fmt(out, " %s ", node->names[k]);
            write_operand(&node->inputs[k], out);
        }
        text_char(out, '\n');
    }
    write_operand(value, out);
}

/* "TYPE": the nodes of IR as an element of the type. */
static void run_case(const struct test_case *c)
{
    struct ir_graph graph;
    struct strpool strings;
    struct value_nodes nodes = {.arena = &arena, .leaf = leaf};
    ir_ref *roots;
    uint32_t count;
    struct operand value;
    struct text text;
    strpool_init(&strings, &arena, NULL);
    ir_graph_init(&graph, &arena, &strings);
    if (!REQUIRE_EQ(ir_text_read(&graph, c->in, &roots, &count), 0) || !REQUIRE_EQ(count, 1))
        return;
    text_init(&text, &arena);
    const char *lacks = value_nodes_add(&nodes, &graph, roots[0], value_type_of(c->words), &value);
    if (lacks)
        text_fmt(&text, "no %s", lacks);
    else
        write_nodes(&nodes, &value, &text);
    text_char(&text, '\n');
    REQUIRE_STR(text_cstr(&text), c->out);
}

/* The argument is the path of translate.txt. */
int main(int argc, char **argv)
{
    mem_init(&mem, NULL, NULL);
    arena_init(&arena, &mem);
    test_cases(argc > 1 ? argv[1] : NULL, run_case);
    arena_finish(&arena);
    return test_report("translate");
}
