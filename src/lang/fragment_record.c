// SPDX-License-Identifier: Apache-2.0
/* Takes down fragments: what the results of a use need, above what the pattern names. */
#include "lang/fragment.h"

/* Vectors of the library's that grow while it is in use. */
#define COPY_VECTOR(arena, to, from) \
    (memset((to), 0, sizeof *(to)), \
     (from)->len ? (void)memcpy(vec_extend(arena, to, (from)->len), (from)->items, \
                                (from)->len * sizeof *(from)->items) \
                 : (void)0)

static void copy_library(struct lang_recorder *recorder, const struct lang_unit *lowest)
{
    struct lang_unit *copy = &recorder->library;
    copy->arena = recorder->arena;
    copy->strings = lowest->strings;
    COPY_VECTOR(recorder->arena, &copy->nodes, &lowest->nodes);
    COPY_VECTOR(recorder->arena, &copy->slots, &lowest->slots);
    COPY_VECTOR(recorder->arena, &copy->functions, &lowest->functions);
    COPY_VECTOR(recorder->arena, &copy->words, &lowest->words);
    COPY_VECTOR(recorder->arena, &copy->refs, &lowest->refs);
}

void lang_recorder_give(const struct lang_recorder *recorder, struct lang_unit *unit)
{
    const struct lang_unit *library = &recorder->library;
    memcpy(&unit->fragments, &recorder->fragments, sizeof unit->fragments);
    memcpy(&unit->codes, &recorder->codes, sizeof unit->codes);
    memcpy(&unit->fragment_of, &recorder->fragment_of, sizeof unit->fragment_of);
    memcpy(&unit->graph_fragment_of, &recorder->graph_fragment_of, sizeof unit->graph_fragment_of);
    memcpy(&unit->nodes, &library->nodes, sizeof unit->nodes);
    memcpy(&unit->slots, &library->slots, sizeof unit->slots);
    memcpy(&unit->functions, &library->functions, sizeof unit->functions);
    memcpy(&unit->words, &library->words, sizeof unit->words);
    memcpy(&unit->refs, &library->refs, sizeof unit->refs);
    memcpy(&unit->known, &library->known, sizeof unit->known);
    memcpy(&unit->known_facts, &library->known_facts, sizeof unit->known_facts);
}

void lang_recorder_init(struct lang_recorder *recorder, struct arena *arena,
                        const struct lang_unit *lowest, uint32_t num_graphs)
{
    *recorder = (struct lang_recorder){.arena = arena};
    copy_library(recorder, lowest);
    uint32_t count = lowest->functions.len;
    if (count)
        memset(vec_extend(arena, &recorder->fragment_of, count), 0,
               count * sizeof *recorder->fragment_of.items);
    if (num_graphs)
        memset(vec_extend(arena, &recorder->graph_fragment_of, num_graphs), 0,
               num_graphs * sizeof *recorder->graph_fragment_of.items);
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
    const struct fragment_host *host;
    const struct ir_graph *graph;
    struct lang_recorder *recorder;
    const ir_ref *inputs;
    unsigned num_inputs;
    const struct lang_unit *layer; /* the library's */
    uint16_t *numbers;             /* of nodes; 0: has none; NEEDED: has none yet */
    unsigned num_nodes;
    uint32_t origin; /* that was taken down last */
    bool failed;
};
enum { NEEDED = UINT16_MAX };

static void put(struct taker *t, uint64_t code)
{
    t->failed |= code > UINT16_MAX;
    vec_push(t->recorder->arena, &t->recorder->codes, (uint16_t)code);
}

static void put_all(struct taker *t, const uint16_t *codes, unsigned len)
{
    t->failed |= len == 0;
    for (unsigned i = 0; i < len; i++)
        put(t, codes[i]);
}

static void put_head(struct taker *t, enum ir_op op, ir_type_id type, unsigned count)
{
    uint16_t codes[FRAGMENT_MAX_HEAD];
    put_all(t, codes, fragment_write_head(t->graph, t->layer, op, type, count, codes));
}

static str_id name_of(const struct taker *t, ir_ref ref)
{
    return t->host->name ? t->host->name(t->host->user_data, ref) : 0;
}

/* Marks what results need, down to inputs and what has a name. */
static void find_needed(struct taker *t, const ir_ref *results, unsigned num_results)
{
    for (unsigned i = 0; i < t->num_inputs; i++)
        if (t->inputs[i])
            t->numbers[t->inputs[i]] = (uint16_t)(i + 1);
    for (unsigned i = 0; i < num_results; i++)
        if (results[i] && !t->numbers[results[i]])
            t->numbers[results[i]] = NEEDED;
    for (ir_ref ref = t->recorder->first_new; ref && ref < t->graph->nodes.len; ref++)
        if (!t->numbers[ref])
            t->numbers[ref] = NEEDED;
    t->recorder->first_new = 0;
    for (ir_ref ref = t->graph->nodes.len; ref-- > 1;) {
        bool has_operands = t->numbers[ref] == NEEDED && !name_of(t, ref);
        for (uint32_t i = 0; has_operands && i < ir_get(t->graph, ref)->num_args; i++) {
            ir_ref operand = ir_arg(t->graph, ref, i);
            if (operand && !t->numbers[operand])
                t->numbers[operand] = NEEDED;
        }
    }
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

static void put_op(struct taker *t, ir_ref ref)
{
    const struct ir_node *node = ir_get(t->graph, ref);
    bool has_attr = fragment_has_attr((enum ir_op)node->op),
         has_callee = node->op == IR_CALL || node->op == IR_LEAF;
    t->failed |=
        node->num_args == 0 || node->num_args > FRAGMENT_MAX_OPERANDS || (node->attr && !has_attr);
    if (has_attr)
        put(t, has_callee ? t->graph->callees.items[node->attr].id & UINT32_MAX : node->attr);
    if (node->num_args >= FRAGMENT_MANY)
        put(t, node->num_args);
    for (uint32_t i = 0; i < node->num_args; i++)
        put(t, t->numbers[ir_arg(t->graph, ref, i)]);
}

/* Nodes of graphs belong to elements of theirs, those of functions to whoever calls. */
static void put_origin(struct taker *t, const struct ir_node *node)
{
    if (!t->host->origin || node->op == IR_CONST)
        return;
    const struct ir_origin *origin = &t->graph->origins.items[node->origin];
    bool is_own = node->origin == t->host->own, is_outer = node->origin == t->host->outer;
    uint32_t element = is_own ? 0 : is_outer ? FRAGMENT_OUTER : origin->element;
    t->failed |= !is_own && !is_outer
                 && (origin->parent != t->host->outer || !element || element == FRAGMENT_OUTER);
    if (element == t->origin)
        return;
    t->origin = element;
    put(t, fragment_head(IR_POISON, IR_TYPE_VOID, 0));
    put(t, element);
}

static void put_name(struct taker *t, const struct ir_node *node, str_id name)
{
    t->failed |= name >= t->layer->strings->num;
    put_head(t, IR_LOCAL, node->type, 0);
    put(t, name);
}

static void put_node(struct taker *t, ir_ref ref)
{
    const struct ir_node *node = ir_get(t->graph, ref);
    put_origin(t, node);
    if (node->op == IR_CONST) {
        uint16_t codes[FRAGMENT_MAX_CONSTANT];
        put_all(t, codes, fragment_write_constant(t->graph, t->layer, node, codes));
        return;
    }
    put_head(t, (enum ir_op)node->op, node->type, node->num_args);
    if (node->op == IR_UNIFORM || node->op == IR_STREAM || node->op == IR_TEXTURE)
        put_global(t, ref);
    else
        put_op(t, ref);
}

static void take_node(struct taker *t, ir_ref ref)
{
    const struct ir_node *node = ir_get(t->graph, ref);
    bool is_closure = node->flags & IR_NODE_CLOSURE && !t->host->leaf,
         is_texture = node->type == IR_TYPE_SAMPLER && t->host->leaf;
    if (is_closure || is_texture || t->num_nodes == FRAGMENT_MAX_NODES) {
        t->failed = true;
        return;
    }
    str_id name = name_of(t, ref);
    if (name)
        put_name(t, node, name);
    else
        put_node(t, ref);
    vec_push(t->graph->arena, &t->recorder->nodes, ref);
    t->num_nodes++;
    t->numbers[ref] = (uint16_t)(t->num_inputs + t->num_nodes);
}

static void take(struct taker *t, const ir_ref *results, unsigned num_results)
{
    /* those before went with their generation */
    memset(&t->recorder->nodes, 0, sizeof t->recorder->nodes);
    vec_push(t->graph->arena, &t->recorder->nodes, 0);
    for (unsigned i = 0; i < t->num_inputs; i++)
        vec_push(t->graph->arena, &t->recorder->nodes, t->inputs[i]);
    t->numbers = ARENA_ARRAY(t->graph->arena, uint16_t, t->graph->nodes.len);
    find_needed(t, results, num_results);
    for (ir_ref ref = 1; ref < t->graph->nodes.len && !t->failed; ref++)
        if (t->numbers[ref] == NEEDED)
            take_node(t, ref);
    put(t, num_results);
    for (unsigned i = 0; i < num_results; i++)
        put(t, t->numbers[results[i]]);
}

/* The number of the new fragment + 1; 0 where it cannot be one. */
static unsigned finish(struct taker *t, struct lang_fragment fragment)
{
    struct lang_recorder *recorder = t->recorder;
    if (t->failed || recorder->fragments.len == UINT16_MAX) {
        recorder->codes.len = fragment.first_code;
        return 0;
    }
    fragment.num_nodes = (uint16_t)t->num_nodes;
    fragment.choice = t->host->lang->choice;
    vec_push(recorder->arena, &recorder->fragments, fragment);
    return recorder->fragments.len;
}

static bool is_taken(const struct lang_recorder *recorder, uint32_t first, uint32_t hash,
                     uint32_t choice)
{
    for (uint32_t next = first; next; next = recorder->fragments.items[next - 1].next)
        if (recorder->fragments.items[next - 1].hash == hash
            && recorder->fragments.items[next - 1].choice == choice)
            return true;
    return false;
}

unsigned fragment_record(const struct fragment_host *host, uint16_t *first,
                         const struct fragment_pattern *pattern, const ir_ref *results,
                         unsigned num_results)
{
    struct lang_recorder *recorder = host->unit->recorder;
    struct taker t = {.host = host,
                      .graph = host->graph,
                      .recorder = recorder,
                      .inputs = pattern->inputs,
                      .num_inputs = pattern->num_inputs,
                      .layer = pattern->layer};
    struct lang_fragment fragment = {.hash = fragment_hash(pattern),
                                     .first_code = recorder->codes.len,
                                     .next = *first,
                                     .pattern_len = (uint16_t)pattern->len};
    if (pattern->failed || is_taken(recorder, *first, fragment.hash, host->lang->choice))
        return 0;
    for (unsigned i = 0; i < pattern->len; i++)
        put(&t, pattern->codes[i]);
    take(&t, results, num_results);
    unsigned number = finish(&t, fragment);
    if (number)
        *first = (uint16_t)number;
    return number;
}

void fragment_record_follower(const struct fragment_host *host, unsigned leader,
                              const struct fragment_follower *follower)
{
    struct lang_recorder *recorder = host->unit->recorder;
    struct taker t = {.host = host,
                      .graph = host->graph,
                      .recorder = recorder,
                      .inputs = follower->nodes + 1,
                      .num_inputs = follower->num_nodes - 1,
                      .layer = lang_lowest(host->unit)};
    struct lang_fragment fragment = {.first_code = recorder->codes.len,
                                     .pattern_len = (uint16_t)follower->num_key};
    for (unsigned i = 0; i < follower->num_key; i++)
        put(&t, follower->key[i]);
    take(&t, follower->results, follower->num_results);
    for (unsigned i = 0; i < follower->num_more; i++)
        put(&t, follower->more[i]);
    recorder->fragments.items[leader - 1].follower = (uint16_t)finish(&t, fragment);
}
