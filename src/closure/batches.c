// SPDX-License-Identifier: Apache-2.0
/*
 * Batches of leaves: neighbours that share the loop over the lights. One loop for all leaves finds
 * the direction and the intensity of each light once, but what its leaves need lives in registers
 * as long as it runs. A single model fits; the layers of a stack do not, so they are evaluated one
 * after the other:
 *
 *     leaves of layer 1   lights, environment
 *     leaves of layer 2   lights, environment
 *
 * A batch that becomes too large ends where the fewest numbers are needed on both sides.
 */
#include "closure/closure_priv.h"

#include <assert.h>

enum {
    /*
     * Numbers that may live through a loop; more cost more than a further loop, which repeats about
     * 55 instructions for a light (docs/benchmarks.md, "Slots").
     */
    MAX_NUMBERS_IN_LOOP = 72,
    NUMBERS_OF_STRUCT = 8
};

/* Numbers that the loop reads, by part: sums over the parts before it. */
struct needs {
    uint32_t first; /* that these parts need and no earlier one */
    uint32_t last;  /* that these parts need and no later one */
};

struct batches {
    struct shader *shader;
    uint32_t *seen; /* by node: the last part that reads it, + 1 */
    VEC(ir_ref) visits, read;
    struct needs *needs;
};

/* A number of registers; constants and uniforms need none. */
static uint32_t numbers_of(const struct ir_graph *g, ir_ref ref)
{
    if (ir_is_const(g, ref) || ir_get(g, ref)->op == IR_UNIFORM)
        return 0;
    unsigned components = ir_type_components(ir_type_of(g, ref));
    return components ? components : NUMBERS_OF_STRUCT;
}

/* Finds the values outside of the loop that a part reads. */
static void visit(struct batches *b, ir_ref value, uint32_t part)
{
    const struct ir_graph *g = b->shader->graph;
    vec_push(b->shader->arena, &b->visits, value);
    while (b->visits.len) {
        ir_ref ref = vec_pop(&b->visits);
        if (!ref || b->seen[ref] == part + 1)
            continue;
        const struct ir_node *node = ir_get(g, ref);
        bool is_new = !b->seen[ref];
        b->seen[ref] = part + 1;
        if (node->flags & IR_NODE_LOOP) {
            for (uint32_t i = 0; i < node->num_args; i++)
                vec_push(b->shader->arena, &b->visits, ir_arg(g, ref, i));
        } else if (is_new) {
            b->needs[part + 1].first += numbers_of(g, ref);
            vec_push(b->shader->arena, &b->read, ref);
        }
    }
}

static void find_needs(struct batches *b, const struct closure_parts *lit)
{
    uint32_t count = lit->parts.len;
    for (uint32_t i = 0; i < count; i++)
        visit(b, lit->parts.items[i].value, i);
    for (uint32_t i = 0; i < b->read.len; i++) {
        ir_ref ref = b->read.items[i];
        assert(b->seen[ref] > 0 && b->seen[ref] <= count);
        b->needs[b->seen[ref]].last += numbers_of(b->shader->graph, ref);
    }
    for (uint32_t i = 0; i < count; i++) {
        b->needs[i + 1].first += b->needs[i].first;
        b->needs[i + 1].last += b->needs[i].last;
    }
}

/* Numbers that parts before and after the beginning of `part` need. */
static uint32_t across(const struct batches *b, uint32_t part)
{
    assert(b->needs[part].first >= b->needs[part].last);
    return b->needs[part].first - b->needs[part].last;
}

/* Numbers that live through the loop of parts [begin, end). */
static uint32_t in_loop(const struct batches *b, uint32_t begin, uint32_t end)
{
    return across(b, begin) + b->needs[end].first - b->needs[begin].first;
}

/* The end of a batch of which parts [begin, end) are too many; it is no small one. */
static uint32_t best_end(const struct batches *b, uint32_t begin, uint32_t end)
{
    uint32_t best = end - 1;
    for (uint32_t i = end - 1; i > begin && 2 * in_loop(b, begin, i) >= MAX_NUMBERS_IN_LOOP; i--)
        if (across(b, i) < across(b, best))
            best = i;
    return best;
}

void closure_find_batches(struct shader *shader, const struct closure_parts *lit,
                          struct closure_batches *out)
{
    uint32_t count = lit->parts.len, begin = 0;
    ir_ref last = 0;
    for (uint32_t i = 0; i < count; i++)
        last = lit->parts.items[i].value > last ? lit->parts.items[i].value : last;
    struct batches b = {.shader = shader,
                        .seen = ARENA_ARRAY(shader->arena, uint32_t, last + 1),
                        .needs = ARENA_ARRAY(shader->arena, struct needs, count + 1)};
    find_needs(&b, lit);
    for (uint32_t end = 2; end <= count; end++)
        while (end - begin > 1 && in_loop(&b, begin, end) > MAX_NUMBERS_IN_LOOP) {
            begin = best_end(&b, begin, end);
            vec_push(shader->arena, &out->ends, lit->parts.items[begin].order);
        }
    vec_push(shader->arena, &out->ends, UINT32_MAX);
}
