// SPDX-License-Identifier: Apache-2.0
/* Takes down fragments: what the results of a call need, beneath them what the pattern names. */
#include "lang/fragment.h"

void lang_recorder_init(struct lang_recorder *recorder, struct arena *arena, const struct lang_unit *lowest)
{
    *recorder = (struct lang_recorder){.arena = arena};
    uint32_t count = lowest->functions.len;
    memset(vec_extend(arena, &recorder->fragment_of, count), 0, count * sizeof *recorder->fragment_of.items);
}

void fragment_note_global(struct lang_recorder *recorder, ir_ref node, uint32_t global)
{
    for (unsigned i = 0; i < recorder->num_globals; i++)
        if (recorder->globals[i].node == node)
            return;
    if (recorder->num_globals < sizeof recorder->globals / sizeof *recorder->globals)
        recorder->globals[recorder->num_globals++] = (struct lang_global_use){node, global};
}

struct taker {
    struct lower *lo;
    struct lang_recorder *recorder;
    const struct fragment_pattern *pattern;
    uint16_t *numbers; /* of nodes, + 1; 0: has none; NEEDED: has none yet */
    unsigned num_nodes;
    bool failed;
};
enum { NEEDED = UINT16_MAX };

static void put(struct taker *t, uint32_t code)
{
    t->failed |= code > UINT16_MAX;
    vec_push(t->recorder->arena, &t->recorder->codes, (uint16_t)code);
}

/* Marks what results need. Strings of the document are not known to the library. */
static void find_needed(struct taker *t, const ir_ref *results, unsigned num_results)
{
    const struct ir_graph *graph = t->lo->graph;
    for (unsigned i = 0; i < t->pattern->num_inputs; i++)
        t->numbers[t->pattern->inputs[i]] = (uint16_t)(i + 1);
    for (unsigned i = 0; i < num_results; i++)
        if (!t->numbers[results[i]])
            t->numbers[results[i]] = NEEDED;
    for (ir_ref ref = graph->nodes.len; ref-- > 1;)
        for (uint32_t i = 0; t->numbers[ref] == NEEDED && i < ir_get(graph, ref)->num_args; i++)
            if (!t->numbers[ir_arg(graph, ref, i)])
                t->numbers[ir_arg(graph, ref, i)] = NEEDED;
}

static void put_global(struct taker *t, ir_ref ref)
{
    for (unsigned i = 0; i < t->recorder->num_globals; i++)
        if (t->recorder->globals[i].node == ref) {
            put(t, t->recorder->globals[i].global);
            return;
        }
    t->failed = true;
}

static void put_constant(struct taker *t, const struct ir_node *node)
{
    const union ir_word *words = t->lo->graph->words.items + node->attr;
    for (unsigned i = 0; i < ir_type_info(node->type)->components; i++) {
        put(t, words[i].u & 0xffff);
        put(t, words[i].u >> 16);
    }
}

static void put_op(struct taker *t, ir_ref ref)
{
    const struct ir_graph *graph = t->lo->graph;
    const struct ir_node *node = ir_get(graph, ref);
    bool has_attr = fragment_has_attr((enum ir_op)node->op);
    t->failed |= node->num_args == 0 || node->num_args > LOWER_MAX_LEAVES || (node->attr && !has_attr);
    if (has_attr)
        put(t, node->op == IR_CALL ? (uint32_t)graph->callees.items[node->attr].id : node->attr);
    if (node->num_args >= FRAGMENT_MANY)
        put(t, node->num_args);
    for (uint32_t i = 0; i < node->num_args; i++)
        put(t, t->numbers[ir_arg(graph, ref, i)] - 1u);
}

static void take_node(struct taker *t, ir_ref ref)
{
    const struct ir_node *node = ir_get(t->lo->graph, ref);
    if (node->type >= IR_TYPE_FIRST_USER || node->flags & IR_NODE_CLOSURE || t->num_nodes == FRAGMENT_MAX_NODES) {
        t->failed = true;
        return;
    }
    put(t, fragment_head((enum ir_op)node->op, node->type, node->num_args));
    if (node->op == IR_CONST)
        put_constant(t, node);
    else if (node->op == IR_UNIFORM || node->op == IR_STREAM || node->op == IR_TEXTURE)
        put_global(t, ref);
    else
        put_op(t, ref);
    t->num_nodes++;
    t->numbers[ref] = (uint16_t)(t->pattern->num_inputs + t->num_nodes);
}

static bool has_foreign_string(const struct taker *t)
{
    const struct ir_graph *graph = t->lo->graph;
    const struct strpool *known = t->lo->frame->layer->strings;
    for (ir_ref ref = 1; ref < graph->nodes.len; ref++) {
        const struct ir_node *node = ir_get(graph, ref);
        if (node->op == IR_CONST && node->type == IR_TYPE_STRING && t->numbers[ref] && graph->words.items[node->attr].u >= known->num)
            return true;
    }
    return false;
}

static bool is_taken(const struct taker *t, uint32_t id, uint32_t hash)
{
    for (uint32_t next = t->recorder->fragment_of.items[id]; next;) {
        const struct lang_fragment *fragment = &t->recorder->fragments.items[next - 1];
        if (fragment->hash == hash && fragment->choice == t->lo->host->choice)
            return true;
        next = fragment->next;
    }
    return false;
}

void fragment_record(struct lower *lo, uint32_t id, const struct fragment_pattern *pattern, const ir_ref *results)
{
    struct lang_recorder *recorder = lo->unit->recorder;
    struct taker t = {.lo = lo, .recorder = recorder, .pattern = pattern};
    unsigned num_results = lang_num_results(lo->unit, id);
    uint32_t hash = fragment_hash(pattern), first_code = recorder->codes.len;
    if (is_taken(&t, id, hash) || (lo->weighed && pattern->has_derivative) || recorder->fragments.len == UINT16_MAX)
        return;
    t.numbers = ARENA_ARRAY(lo->graph->arena, uint16_t, lo->graph->nodes.len);
    find_needed(&t, results, num_results);
    for (unsigned i = 0; i < pattern->len; i++)
        put(&t, pattern->codes[i]);
    for (ir_ref ref = 1; ref < lo->graph->nodes.len && !t.failed; ref++)
        if (t.numbers[ref] == NEEDED)
            take_node(&t, ref);
    put(&t, num_results);
    for (unsigned i = 0; i < num_results; i++)
        put(&t, t.numbers[results[i]] - 1u);
    if (t.failed || has_foreign_string(&t)) {
        recorder->codes.len = first_code;
        return;
    }
    vec_push(recorder->arena, &recorder->fragments,
             (struct lang_fragment){.hash = hash, .first_code = first_code, .pattern_len = (uint16_t)pattern->len,
                                    .num_nodes = (uint16_t)t.num_nodes, .next = recorder->fragment_of.items[id],
                                    .flags = lo->weighed ? LANG_FRAGMENT_WEIGHED : 0, .choice = lo->host->choice});
    recorder->fragment_of.items[id] = (uint16_t)recorder->fragments.len;
}
