// SPDX-License-Identifier: Apache-2.0
/*
 * ir_check finds each rule of src/ir/invariants.c broken. A case reads a good graph and overwrites
 * one number of it behind the builder's back. Argument: the path of invariants.c, whose messages
 * must all stand among the cases.
 */
#include "ir/ir.h"

#include "ir_text.h"
#include "test.h"

#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

enum part {
    OP,
    TYPE,
    ATTR,
    NUM_ARGS,
    FIRST_ARG,
    FLAGS,
    ORIGIN,
    ARG, /* the first operand */
    ARG_1,
    FIRST_PARAM, /* of function 0 */
    FIRST_RESULT,
    RESULT,
    ELEMENT, /* of user type 0 */
    FIRST_MEMBER,
    MEMBER,
    PARENT, /* of origin 1 */
    PUSHED, /* an origin */
};

/* A function that is called, and one without results. */
#define FUNCTION \
    "function \"f\" float\nfunction \"g\"\n%1 = param float @0:0\n%2 = neg float %1\n" \
    "results 0 = %2\n%3 = uniform float @9\n%4 = graph_call float %3\n"
/* struct { float a; } s[2] */
#define TYPES "struct \"s\" float \"a\"\narray $0 2\n%1 = uniform $0\n%2 = member float %1\n"

static const struct {
    const char *text;
    ir_ref node; /* that is damaged: the numbers of the text; 0: the graph's tables are */
    enum part part;
    uint32_t value;
    const char *problem;
} cases[] = {
    {"%1 = uniform float", 1, OP, 250, "there is no such op"},
    {"%1 = uniform float", 1, TYPE, 60, "there is no such type"},
    {"%1 = uniform float", 1, TYPE, IR_TYPE_FIRST_USER, "there is no such type"},
    {"%1 = uniform float", 1, FLAGS, IR_NODE_LOOP,
     "the flags are not those of the op and its operands"},
    {"%1 = context float\n%2 = neg float %1", 2, FLAGS, 0,
     "the flags are not those of the op and its operands"},
    {"%1 = uniform vec3\n%2 = dFdx vec3 %1", 2, FLAGS, 0,
     "the flags are not those of the op and its operands"},
    {"%1 = uniform float", 1, ORIGIN, 5, "the origin lies outside of the graph"},
    {"%1 = uniform float\n%2 = add float %1, %1", 2, NUM_ARGS, 1, "wrong number of operands"},
    {"%1 = uniform float\n%2 = neg float %1", 2, FIRST_ARG, 99,
     "the operands lie outside of the graph"},
    {"%1 = uniform float\n%2 = neg float %1", 2, NUM_ARGS, 99,
     "the operands lie outside of the graph"},
    {"%1 = uniform float\n%2 = neg float %1", 2, ARG, 2, "an operand is not older than the node"},
    {"%1 = uniform float\n%2 = neg float %1", 2, ARG, 0, "an operand is missing"},
    {"%1 = uniform float\n%2 = neg float %1\n%3 = sin float %1", 3, OP, IR_NEG,
     "the node stands twice"},
    {"%1 = uniform float\n%2 = uniform int\n%3 = neg float %1", 3, ARG, 2,
     "the operands give another type"},
    {"%1 = uniform bool\n%2 = uniform float\n%3 = neg float %2", 3, ARG, 1,
     "the operands do not fit the op"},
    {"%1 = uniform float\n%2 = construct vec3 %1", 2, TYPE, IR_TYPE_INT,
     "the parts do not make the type"},
    {FUNCTION "%5 = result float %4", 5, TYPE, IR_TYPE_BSDF,
     "a call gives a closure or a shader, which no later step would see"},
    {"%1 = uniform float\n%2 = convert int %1", 2, TYPE, IR_TYPE_VEC3,
     "there is no such conversion"},
    {"%1 = uniform vec3\n%2 = swizzle float .z %1", 2, ATTR, 0x103,
     "the operand does not have these components"},
    {TYPES, 2, ATTR, 1, "the operand does not have this member"},
    {"%1 = uniform vec3\n%2 = uniform int\n%3 = index float %1, %2", 3, TYPE, IR_TYPE_INT,
     "the operand cannot be indexed so"},
    {"%1 = uniform int\n%2 = uniform float\n%3 = sample int %1", 3, ARG, 2,
     "the operand is no number of a loop"},
    {"%1 = context int\n%2 = uniform float\n%3 = local float %1", 3, ARG, 2,
     "the operand is no number of a light"},
    {"%1 = sample int", 1, TYPE, IR_TYPE_VEC2, "neither the index nor the turn of a sample"},
    {"callee \"f\" function 1\n%1 = call float", 1, ATTR, 1, "there is no such callee"},
    {"callee \"f\" function 1\ncallee \"g\" family 1\n%1 = call float", 1, ATTR, 1,
     "the callee is not of the op's kind"},
    {"%1 = uniform float\n%2 = uniform BSDF\n%3 = layer BSDF %2, %2", 3, ARG_1, 1,
     "an operand has the wrong type"},
    {"callee \"f\" function 1\n%1 = call void\n%2 = result float %1\n%3 = neg float %2", 3, OP,
     IR_RESULT, "the operand of a result is not a call"},
    {"%1 = uniform float @9", 1, OP, IR_CONST, "a constant lies outside of the pool"},
    {"%1 = uniform BSDF", 1, OP, IR_CONST, "a constant has a type without values"},
    {FUNCTION, 1, ATTR, 7 << 16, "there is no such function"},
    {FUNCTION, 1, ATTR, 1, "the function has fewer parameters"},
    {FUNCTION, 1, TYPE, IR_TYPE_INT, "the parameter has another type"},
    {FUNCTION, 4, ATTR, 7, "there is no such function"},
    {FUNCTION, 4, ATTR, 1, "the function is called before its results are set"},
    {FUNCTION, 4, NUM_ARGS, 0, "the call does not have the function's number of arguments"},
    {FUNCTION "%5 = uniform int", 4, TYPE, IR_TYPE_INT,
     "the type is neither void nor that of the first result"},
    {"function \"f\" float\n%1 = uniform int\nresults 0 = %1\n%2 = uniform float\n"
     "%3 = graph_call int %2",
     3, ARG, 1, "an argument does not have the parameter's type"},
    {FUNCTION "%5 = graph_call void %3\n%6 = result float %5", 6, ATTR, 1,
     "the function has fewer results"},
    {FUNCTION "%5 = graph_call void %3\n%6 = result float %5", 6, TYPE, IR_TYPE_INT,
     "the result does not have the function's type"},
    {FUNCTION "%5 = exp float %4", 4, RESULT, 5,
     "the body of a function is not older than its call"},
    {FUNCTION, 0, FIRST_PARAM, 9, "the parameters of a function lie outside of the graph"},
    {FUNCTION, 0, FIRST_RESULT, 9, "the results of a function lie outside of the graph"},
    {FUNCTION, 0, RESULT, 99, "a result of a function is no node"},
    {FUNCTION, 0, RESULT, 0, "a result of a function is no node"},
    {"array float 2", 0, ELEMENT, IR_TYPE_FIRST_USER,
     "the element type of an array is not older than the array"},
    {TYPES, 0, FIRST_MEMBER, 9, "the members of a struct lie outside of the graph"},
    {TYPES, 0, MEMBER, IR_TYPE_FIRST_USER, "the type of a member is not older than the struct"},
    {"%1 = uniform float", 0, PARENT, 1, "the parent of an origin is not older than the origin"},
    {"%1 = uniform float", 0, PUSHED, 1, "an origin was pushed and not popped"},
};
enum { NUM_CASES = sizeof cases / sizeof *cases };

struct fixture {
    struct mem mem;
    struct arena arena;
    struct strpool strings;
    struct ir_graph graph;
};

static void damage(struct ir_graph *g, ir_ref ref, enum part part, uint32_t value)
{
    struct ir_node *node = (struct ir_node *)(uintptr_t)&g->nodes.items[ref];
    ir_ref *args = (ir_ref *)(uintptr_t)g->args.items + node->first_arg;
    switch (part) {
    case OP: node->op = (uint8_t)value; break;
    case TYPE: node->type = (ir_type_id)value; break;
    case ATTR: node->attr = value; break;
    case NUM_ARGS: node->num_args = value; break;
    case FIRST_ARG: node->first_arg = value; break;
    case FLAGS: node->flags = (uint8_t)value; break;
    case ORIGIN: node->origin = value; break;
    case ARG: args[0] = value; break;
    case ARG_1: args[1] = value; break;
    case FIRST_PARAM: g->functions.items[0].first_param_type = value; break;
    case FIRST_RESULT: g->functions.items[0].first_result = value; break;
    case RESULT: g->function_results.items[g->functions.items[0].first_result] = value; break;
    case ELEMENT: g->user_types.items[0].element = (ir_type_id)value; break;
    case FIRST_MEMBER: g->user_types.items[0].first_member = value; break;
    case MEMBER:
        g->members.items[g->user_types.items[0].first_member].type = (ir_type_id)value;
        break;
    case PARENT: g->origins.items[1].parent = value; break;
    case PUSHED: ir_push_origin(g, value); break;
    }
}

/* Nodes are what the text says, in its order: nothing is folded, and no constant comes between. */
static void setup(struct fixture *f, const char *text)
{
    mem_init(&f->mem, NULL, NULL);
    arena_init(&f->arena, &f->mem);
    strpool_init(&f->strings, &f->arena, NULL);
    ir_graph_init(&f->graph, &f->arena, &f->strings);
    ir_add_origin(&f->graph, 0, 0, 0);
    f->graph.no_fold = true;
    ir_ref *roots, node;
    uint32_t num_roots;
    REQUIRE_EQ(ir_text_read(&f->graph, text, &roots, &num_roots), 0);
    REQUIRE(!ir_check(&f->graph, &node));
}

static void test_rules(void)
{
    for (size_t i = 0; i < NUM_CASES; i++) {
        struct fixture f;
        ir_ref node;
        setup(&f, cases[i].text);
        damage(&f.graph, cases[i].node, cases[i].part, cases[i].value);
        if (!REQUIRE_STR(ir_check(&f.graph, &node), cases[i].problem)
            || !REQUIRE_EQ(node, cases[i].node))
            printf("    case %u: %s\n", (unsigned)i, cases[i].text);
        arena_finish(&f.arena);
    }
}

static bool has_case(const char *problem, size_t len)
{
    for (size_t i = 0; i < NUM_CASES; i++)
        if (strlen(cases[i].problem) == len && memcmp(cases[i].problem, problem, len) == 0)
            return true;
    return false;
}

/* A message is a string of several words behind a `return`, `?`, `:` or `=`. */
static void test_complete(const char *path)
{
    static char source[1 << 16];
    FILE *file = fopen(path, "r");
    if (!REQUIRE(file))
        return;
    source[fread(source, 1, sizeof source - 1, file)] = '\0';
    fclose(file);
    unsigned num_messages = 0;
    for (char *at = strchr(source, '"'), *end; at; at = strchr(end + 1, '"')) {
        end = strchr(at + 1, '"');
        size_t len = (size_t)(end - at - 1);
        bool is_rule = memchr(at, ' ', len + 1) && !memchr(at, '%', len);
        /* ir_build asks ir_const for constants, and ir_check never asks for one */
        if (!is_rule || strncmp(at + 1, "a constant is not built", 23) == 0)
            continue;
        num_messages++;
        if (!REQUIRE(has_case(at + 1, len)))
            printf("    %.*s\n", (int)len, at + 1);
    }
    REQUIRE(num_messages > 30);
}

#ifdef MXG_CHECK_IR
/* A broken rule ends the program, and says where. */
static void test_end(void)
{
    struct fixture f;
    char said[256] = "";
    int ends[2], status = 0;
    if (!REQUIRE(pipe(ends) == 0))
        return;
    pid_t child = fork();
    if (child == 0) {
        dup2(ends[1], STDERR_FILENO);
        setup(&f, "%1 = uniform float\n%2 = neg float %1");
        ir_assert_valid(&f.graph, "after nothing");
        damage(&f.graph, 2, ARG, 2);
        ir_assert_valid(&f.graph, "after damage");
        _exit(0);
    }
    close(ends[1]);
    REQUIRE(read(ends[0], said, sizeof said - 1) > 0);
    close(ends[0]);
    REQUIRE(waitpid(child, &status, 0) == child && WIFSIGNALED(status)
            && WTERMSIG(status) == SIGABRT);
    REQUIRE_STR(said, "mxgen: internal error: IR, after damage: node 2 (neg): "
                      "an operand is not older than the node\n");
}
#endif

int main(int argc, char **argv)
{
    test_rules();
    if (argc > 1)
        test_complete(argv[1]);
#ifdef MXG_CHECK_IR
    test_end();
#endif
    return test_report("ir_check");
}
