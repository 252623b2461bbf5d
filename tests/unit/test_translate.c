// SPDX-License-Identifier: Apache-2.0
/* The nodes of a document that compute values of the IR: each op, with its types, and what nodes
 * cannot compute. */
#include "base/mem.h"
#include "translate/nodes.h"

#include "ir_text.h"
#include "test.h"

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

/* "n0 = multiply color3 in1 u0 in2 2.0; n0" */
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
        text_str(out, "; ");
    }
    write_operand(value, out);
}

static void expect(const char *ir, enum value_type type, const char *wanted)
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
    if (!REQUIRE_EQ(ir_text_read(&graph, ir, &roots, &count), 0) || !REQUIRE_EQ(count, 1))
        return;
    text_init(&text, &arena);
    const char *lacks = value_nodes_add(&nodes, &graph, roots[0], type, &value);
    if (lacks)
        text_fmt(&text, "no %s", lacks);
    else
        write_nodes(&nodes, &value, &text);
    if (!REQUIRE(strcmp(text_cstr(&text), wanted) == 0))
        printf("    %s\n    is     %s\n    wanted %s\n", ir, text_cstr(&text), wanted);
}

static void test_values(void)
{
    expect("return 0.5\n", VALUE_FLOAT, "0.5");
    expect("return vec3(1.0, 0.5, 0.0)\n", VALUE_COLOR3, "1.0, 0.5, 0.0");
    expect("return true\n", VALUE_BOOLEAN, "true");
    expect("return 2\n", VALUE_INTEGER, "2");
    expect("%1 = uniform vec3\nreturn %1\n", VALUE_COLOR3, "u0");
    expect("%1 = uniform vec3\nreturn %1\n", VALUE_VECTOR3, "n0 = convert vector3 in u0; n0");
    expect("%1 = uniform float @2\nreturn %1\n", VALUE_COLOR3, "n0 = convert color3 in u2; n0");
}

static void test_arithmetic(void)
{
    expect("%1 = uniform vec3\n%2 = mul vec3 %1, 2.0\nreturn %2\n", VALUE_COLOR3,
           "n0 = multiply color3 in1 u0 in2 2.0; n0");
    /* a number stands behind the colour */
    expect("%1 = uniform float @2\n%2 = uniform vec3\n%3 = mul vec3 %1, %2\nreturn %3\n",
           VALUE_COLOR3, "n0 = multiply color3 in1 u0 in2 u2; n0");
    expect("%1 = uniform vec3\n%2 = uniform float @2\n%3 = sub vec3 %2, %1\nreturn %3\n",
           VALUE_COLOR3, "n0 = convert color3 in u2; n1 = subtract color3 in1 n0 in2 u0; n1");
    expect("%1 = uniform vec3\n%2 = uniform float @2\n%3 = mix vec3 vec3(1.0, 1.0, 1.0), %1, "
           "%2\nreturn %3\n",
           VALUE_COLOR3, "n0 = mix color3 bg 1.0, 1.0, 1.0 fg u0 mix u2; n0");
    expect("%1 = uniform float @2\n%2 = neg float %1\nreturn %2\n", VALUE_FLOAT,
           "n0 = multiply float in1 u2 in2 -1.0; n0");
    /* colours have no root */
    expect("%1 = uniform vec3\n%2 = sqrt vec3 %1\nreturn %2\n", VALUE_COLOR3,
           "n0 = convert vector3 in u0; n1 = sqrt vector3 in n0; n2 = convert color3 in n1; n2");
    expect("%1 = uniform vec3\n%2 = dot float %1, vec3(0.5, 0.5, 0.5)\nreturn %2\n", VALUE_FLOAT,
           "n0 = convert vector3 in u0; n1 = dotproduct float in1 n0 in2 0.5, 0.5, 0.5; n1");
    expect("%1 = uniform vec3\n%2 = swizzle float .y %1\nreturn %2\n", VALUE_FLOAT,
           "n0 = extract float in u0 index 1; n0");
    expect("%1 = uniform vec4 @5\n%2 = swizzle vec3 .zyx %1\nreturn %2\n", VALUE_COLOR3,
           "n0 = extract float in u5 index 2; n1 = extract float in u5 index 1; n2 = extract float "
           "in u5 index 0; "
           "n3 = combine3 color3 in1 n0 in2 n1 in3 n2; n3");
    expect("%1 = uniform float @2\n%2 = construct vec3 %1, 0.5, %1\nreturn %2\n", VALUE_VECTOR3,
           "n0 = combine3 vector3 in1 u2 in2 0.5 in3 u2; n0");
    /* equal nodes are one */
    expect("%1 = uniform float @2\n%2 = add float %1, 1.0\n%3 = mul float %2, %2\nreturn %3\n",
           VALUE_FLOAT, "n0 = add float in1 u2 in2 1.0; n1 = multiply float in1 n0 in2 n0; n1");
}

static void test_conditions(void)
{
    expect(
        "%1 = uniform float @2\n%2 = gt bool %1, 0.0\n%3 = select float %2, 1.0, %1\nreturn %3\n",
        VALUE_FLOAT,
        "n0 = ifgreater boolean value1 u2 value2 0.0; n1 = ifgreater float value1 u2 value2 0.0 "
        "in1 1.0 in2 u2; n1");
    expect(
        "%1 = uniform float @2\n%2 = lt bool %1, 0.25\n%3 = select float %2, 1.0, %1\nreturn %3\n",
        VALUE_FLOAT,
        "n0 = ifgreater boolean value1 0.25 value2 u2; n1 = ifgreater float value1 0.25 value2 u2 "
        "in1 1.0 in2 u2; n1");
    expect("%1 = uniform int @3\n%2 = ne bool %1, 1\n%3 = select float %2, 0.5, 0.25\nreturn %3\n",
           VALUE_FLOAT,
           "n0 = ifequal boolean value1 u3 value2 1; n1 = not boolean in n0; "
           "n2 = ifequal float value1 u3 value2 1 in1 0.25 in2 0.5; n2");
    expect("%1 = uniform float @2\n%2 = step float 0.25, %1\nreturn %2\n", VALUE_FLOAT,
           "n0 = ifgreatereq float value1 u2 value2 0.25 in1 1.0 in2 0.0; n0");
    expect("%1 = uniform vec3\n%2 = step vec3 0.25, %1\nreturn %2\n", VALUE_COLOR3,
           "n0 = extract float in u0 index 0; n1 = ifgreatereq float value1 n0 value2 0.25 in1 1.0 "
           "in2 0.0; n2 = extract float in u0 index 1; n3 = ifgreatereq float value1 n2 value2 "
           "0.25 in1 1.0 in2 0.0; n4 = extract float in u0 index 2; n5 = ifgreatereq float value1 "
           "n4 value2 0.25 in1 1.0 in2 0.0; n6 = combine3 color3 in1 n1 in2 n3 in3 n5; n6");
    expect("%1 = uniform bool @4\n%2 = select float %1, 0.5, 0.25\nreturn %2\n", VALUE_FLOAT,
           "n0 = ifequal float value1 u4 value2 true in1 0.5 in2 0.25; n0");
    expect("%1 = uniform vec3\n%2 = eq bool %1, vec3(0.0, 0.0, 0.0)\nreturn %2\n", VALUE_BOOLEAN,
           "n0 = extract float in u0 index 0; n1 = ifequal boolean value1 n0 value2 0.0; "
           "n2 = extract float in u0 index 1; n3 = ifequal boolean value1 n2 value2 0.0; n4 = and "
           "boolean in1 n1 in2 n3; "
           "n5 = extract float in u0 index 2; n6 = ifequal boolean value1 n5 value2 0.0; n7 = and "
           "boolean in1 n4 in2 n6; n7");
}

/* Matrices are stored by column: 1, 2, 3 is the first column. */
static void test_matrices(void)
{
    expect("%1 = uniform vec3 @1\n%2 = mul vec3 mat3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0), "
           "%1\nreturn %2\n",
           VALUE_VECTOR3,
           "n0 = dotproduct float in1 u1 in2 1.0, 4.0, 7.0; n1 = dotproduct float in1 u1 in2 2.0, "
           "5.0, 8.0; n2 = dotproduct float in1 u1 in2 3.0, 6.0, 9.0; n3 = combine3 vector3 in1 n0 "
           "in2 n1 in3 n2; n3");
    expect("%1 = uniform vec3 @1\n%2 = mul vec3 %1, mat3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, "
           "9.0)\nreturn %2\n",
           VALUE_VECTOR3,
           "n0 = dotproduct float in1 u1 in2 1.0, 2.0, 3.0; n1 = dotproduct float in1 u1 in2 4.0, "
           "5.0, 6.0; n2 = dotproduct float in1 u1 in2 7.0, 8.0, 9.0; n3 = combine3 vector3 in1 n0 "
           "in2 n1 in3 n2; n3");
    expect("%1 = uniform mat3 @9\n%2 = uniform vec3 @1\n%3 = mul vec3 %1, %2\nreturn %3\n",
           VALUE_VECTOR3, "no uniform");
}

static void test_faults(void)
{
    expect("%1 = uniform float @9\nreturn %1\n", VALUE_FLOAT, "no uniform");
    expect("%1 = uniform float @2\n%2 = dFdx float %1\nreturn %2\n", VALUE_FLOAT, "no dFdx");
    expect("return inf\n", VALUE_FLOAT, "no inf");
    expect("%1 = uniform float @2\n%2 = tanh float %1\nreturn %2\n", VALUE_FLOAT, "no tanh");
}

int main(void)
{
    mem_init(&mem, NULL, NULL);
    arena_init(&arena, &mem);
    test_values();
    test_arithmetic();
    test_conditions();
    test_matrices();
    test_faults();
    arena_finish(&arena);
    return test_report("translate");
}
