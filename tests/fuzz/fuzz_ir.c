// SPDX-License-Identifier: Apache-2.0
/* IR text: what parses is sound, prints, and parses back to the same. */
#include "fuzz.h"

#include "ir/ir.h"

/* Parses into a graph of its own and prints it; NULL where the text is not IR. */
static const char *reprint(struct arena *arena, const char *text, size_t len)
{
    struct strpool strings;
    struct ir_graph graph;
    strpool_init(&strings, arena, NULL);
    ir_graph_init(&graph, arena, &strings);
    graph.max_nodes = 100000;
    ir_ref *roots, node;
    uint32_t num_roots, line;
    if (ir_parse(&graph, text, len, &roots, &num_roots, &line))
        return NULL;
    const char *problem = ir_check(&graph, &node);
    if (problem)
        fprintf(stderr, "node %u: %s\n", (unsigned)node, problem);
    FUZZ_REQUIRE(!problem);
    struct text out;
    text_init(&out, arena);
    ir_print(&graph, roots, num_roots, &out);
    return text_cstr(&out);
}

static void run(struct fuzz_job *job)
{
    const char *first = reprint(&job->arena, job->data, job->size);
    if (!first)
        return;
    const char *second = reprint(&job->arena, first, strlen(first));
    FUZZ_REQUIRE(second);
    if (strcmp(first, second) != 0)
        fprintf(stderr, "---- first\n%s\n---- second\n%s\n", first, second);
    FUZZ_REQUIRE(strcmp(first, second) == 0);
}

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    fuzz_run_job(data, size, heap, 0, run);
}
