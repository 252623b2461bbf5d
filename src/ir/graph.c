// SPDX-License-Identifier: Apache-2.0
/* graph: the arrays of a graph, and hash-consing: equal content is one node. */
#include "ir/ir_priv.h"

#include "base/hash.h"

#include <assert.h>

/* a shading model has about a thousand nodes */
enum { FIRST_NODES = 1280 };

static struct ir_content content_of(const struct ir_graph *graph, ir_ref ref)
{
    const struct ir_node *node = ir_get(graph, ref);
    struct ir_content c = {.op = (enum ir_op)node->op, .type = node->type};
    assert(node->op < IR_NUM_OPS);
    if (node->op == IR_CONST) {
        c.count = ir_type_info(node->type)->components;
        c.data = &graph->words.items[node->attr].u;
        assert(node->attr + c.count <= graph->words.len);
    } else {
        c.attr = node->attr;
        c.count = node->num_args;
        c.data = graph->args.items + node->first_arg;
        assert(node->first_arg + c.count <= graph->args.len);
    }
    return c;
}

static inline uint32_t hash_of(const struct ir_content *c)
{
    uint64_t h = hash_mix(0, (uint64_t)c->attr << 32 | (uint64_t)c->op << 16 | c->type);
    const uint32_t *data = c->data, *end = data + (c->count & ~1u);
    for (; data < end; data += 2)
        h = hash_mix(h, (uint64_t)data[0] << 32 | data[1]);
    if (c->count & 1)
        h = hash_mix(h, *data);
    return (uint32_t)(h ^ (h >> 32));
}

static inline bool has_content(const struct ir_graph *graph, ir_ref ref, const struct ir_content *c)
{
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op != c->op || node->type != c->type)
        return false;
    const uint32_t *data = &graph->words.items[node->attr].u;
    if (c->op != IR_CONST) {
        if (node->attr != c->attr || node->num_args != c->count)
            return false;
        data = graph->args.items + node->first_arg;
    }
    for (uint32_t i = 0; i < c->count; i++)
        if (data[i] != c->data[i])
            return false;
    return true;
}

static inline ir_ref find(const struct ir_graph *graph, const struct ir_content *c)
{
    for (uint32_t at = c->hash, ref; (ref = table_next(&graph->table, c->hash, &at));)
        if (has_content(graph, ref, c))
            return ref;
    return 0;
}

ir_ref ir_find_equal(const struct ir_graph *graph, ir_ref ref)
{
    struct ir_content c = content_of(graph, ref);
    c.hash = hash_of(&c);
    return find(graph, &c);
}

/* Reserves n more nodes. All other code sees the array as constant. */
static struct ir_node *reserve_nodes(struct ir_graph *graph, uint32_t n)
{
    struct ir_node *nodes = (struct ir_node *)(uintptr_t)graph->nodes.items;
    if (graph->nodes.cap - graph->nodes.len < n)
        graph->nodes.items = nodes = vec_more(graph->arena, nodes, &graph->nodes.cap, sizeof *nodes,
                                              graph->nodes.len + n - graph->nodes.cap);
    return nodes + graph->nodes.len;
}

/* Reserves n more operands. */
static ir_ref *reserve_args(struct ir_graph *graph, uint32_t n)
{
    ir_ref *args = (ir_ref *)(uintptr_t)graph->args.items;
    if (graph->args.cap - graph->args.len < n)
        graph->args.items = args = vec_more(graph->arena, args, &graph->args.cap, sizeof *args,
                                            graph->args.len + n - graph->args.cap);
    return args + graph->args.len;
}

void ir_graph_init(struct ir_graph *graph, struct arena *arena, struct strpool *strings)
{
    *graph = (struct ir_graph){.arena = arena, .strings = strings};
    /* index 0 means "no node"; it must not look like a constant */
    *reserve_nodes(graph, FIRST_NODES) = (struct ir_node){.op = IR_POISON};
    *reserve_args(graph, 2 * FIRST_NODES) = 0; /* index 0 must exist */
    graph->nodes.len = graph->args.len = 1;
    vec_reserve(arena, &graph->labels, FIRST_NODES);
    vec_push(arena, &graph->labels, (struct ir_label){0});
    vec_push(arena, &graph->words, (union ir_word){.u = 0});
    vec_push(arena, &graph->origins, (struct ir_origin){0});
    table_reserve(&graph->table, arena, FIRST_NODES / 2);
}

/* The flags that calls of an IR function inherit from its body. */
static unsigned function_flags(const struct ir_graph *graph, const struct ir_function *function)
{
    unsigned flags = 0;
    for (uint32_t i = 0; i < function->num_results; i++)
        flags |= ir_get(graph, graph->function_results.items[function->first_result + i])->flags;
    return flags & (IR_NODE_DERIVATIVE | IR_NODE_PARTIAL);
}

/* True for a constant, or for a value that is never below a constant. A divisor must not be 0. */
static bool is_bounded(const struct ir_graph *graph, ir_ref ref, bool is_divisor)
{
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op == IR_MAX || node->op == IR_CLAMP)
        ref = ir_arg(graph, ref, 1);
    else if (node->op == IR_ABS)
        return !is_divisor;
    return ir_is_const(graph, ref) && !(is_divisor && ir_const_is(graph, ref, 0.0f));
}

/* The flags of an op itself. An op with PARTIAL has this flag unless its operand is bounded. */
static const uint8_t flags_of_ops[IR_NUM_OPS] = {
    [IR_CONTEXT] = IR_NODE_LOOP,      [IR_SAMPLE] = IR_NODE_LOOP,
    [IR_DFDX] = IR_NODE_DERIVATIVE,   [IR_DFDY] = IR_NODE_DERIVATIVE,
    [IR_FWIDTH] = IR_NODE_DERIVATIVE, [IR_TEX] = IR_NODE_DERIVATIVE | IR_NODE_DEAR,
    [IR_TEX_LOD] = IR_NODE_DEAR,      [IR_TEX_GRAD] = IR_NODE_DEAR,
    [IR_TEX_FETCH] = IR_NODE_DEAR,    [IR_CALL] = IR_NODE_DEAR,
    [IR_VERBATIM] = IR_NODE_DEAR,     [IR_GRAPH_CALL] = IR_NODE_DEAR,
    [IR_DIV] = IR_NODE_PARTIAL,       [IR_MOD] = IR_NODE_PARTIAL,
    [IR_POW] = IR_NODE_PARTIAL,       [IR_SQRT] = IR_NODE_PARTIAL,
    [IR_RSQRT] = IR_NODE_PARTIAL,     [IR_LOG] = IR_NODE_PARTIAL,
    [IR_LOG2] = IR_NODE_PARTIAL,      [IR_ASIN] = IR_NODE_PARTIAL,
    [IR_ACOS] = IR_NODE_PARTIAL,      [IR_ACOSH] = IR_NODE_PARTIAL,
    [IR_ATANH] = IR_NODE_PARTIAL,
};

/* The flags of the node itself, without the flags that it inherits from operands. */
static unsigned own_flags(const struct ir_graph *graph, const struct ir_content *c)
{
    unsigned flags = flags_of_ops[c->op];
    if (flags & IR_NODE_PARTIAL) {
        bool divides = c->op == IR_DIV || c->op == IR_MOD;
        if (is_bounded(graph, c->data[divides], divides))
            flags = 0;
    } else if (c->op == IR_CALL || c->op == IR_VERBATIM || c->op == IR_LEAF) {
        flags |= graph->callees.items[c->attr].derivative ? IR_NODE_DERIVATIVE : 0u;
    } else if (c->op == IR_GRAPH_CALL) {
        flags |= function_flags(graph, &graph->functions.items[c->attr]);
    }
    return flags
           | (ir_type_is_closure(c->type) || ir_type_is_shader(c->type) ? IR_NODE_CLOSURE : 0u);
}

unsigned ir_flags_of(const struct ir_graph *graph, ir_ref ref)
{
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op == IR_CONST)
        return 0;
    unsigned inherited = 0;
    for (uint32_t i = 0; i < node->num_args; i++)
        inherited |= ir_get(graph, ir_arg(graph, ref, i))->flags;
    struct ir_content c = content_of(graph, ref);
    return own_flags(graph, &c) | (inherited & IR_NODE_INHERITED);
}

/*
 * Copies the operands to graph->args and returns their flags. The operands may lie in this array
 * already, and growing it moves them.
 */
static unsigned push_args(struct ir_graph *graph, const ir_ref *args, uint32_t num_args)
{
    uint32_t len = graph->args.len;
    uintptr_t offset = (uintptr_t)args - (uintptr_t)graph->args.items;
    ir_ref *to = reserve_args(graph, num_args);
    const ir_ref *from =
        offset < len * sizeof *args ? graph->args.items + offset / sizeof *args : args;
    const struct ir_node *nodes = graph->nodes.items;
    unsigned flags = 0;
    for (uint32_t i = 0; i < num_args; i++) {
        to[i] = from[i];
        flags |= nodes[from[i]].flags;
    }
    assert(graph->args.len == len);
    graph->args.len = len + num_args;
    return flags & IR_NODE_INHERITED;
}

static void push_words(struct ir_graph *graph, const uint32_t *words, uint32_t num_words)
{
    union ir_word *to = vec_extend(graph->arena, &graph->words, num_words);
    for (uint32_t i = 0; i < num_words; i++)
        to[i].u = words[i];
}

/*
 * True if the graph accepts one more node. Past the limit, the graph gives POISON and reports the
 * limit once.
 */
static bool has_room(struct ir_graph *graph, enum ir_op op)
{
    bool is_full = graph->max_nodes && graph->nodes.len > graph->max_nodes && op != IR_POISON;
    graph->overflow |= is_full;
    return !is_full;
}

static inline ir_ref add(struct ir_graph *graph, struct ir_node node, uint32_t hash)
{
    ir_ref ref = graph->nodes.len;
    *reserve_nodes(graph, 1) = node;
    graph->nodes.len++;
    vec_push(graph->arena, &graph->labels, (struct ir_label){0});
    table_add(&graph->table, graph->arena, hash, ref);
    assert(graph->nodes.len == graph->labels.len);
    return ref;
}

ir_ref ir_find(struct ir_graph *graph, struct ir_content *c)
{
    c->hash = hash_of(c);
    ir_ref equal = find(graph, c);
    if (equal && graph->origin && ir_get(graph, equal)->origin != graph->origin)
        graph->labels.items[equal].is_shared = true;
    return equal;
}

ir_ref ir_add(struct ir_graph *graph, const struct ir_content *c)
{
    assert(c->op != IR_CONST && c->op < IR_NUM_OPS);
    assert(c->type < IR_TYPE_FIRST_USER + graph->user_types.len);
    if (!has_room(graph, c->op))
        return ir_poison(graph, c->type);
    struct ir_node node = {.op = (uint8_t)c->op,
                           .type = c->type,
                           .attr = c->attr,
                           .origin = graph->origin,
                           .num_args = c->count,
                           .first_arg = graph->args.len};
    node.flags = (uint8_t)(own_flags(graph, c) | push_args(graph, c->data, c->count));
    return add(graph, node, c->hash);
}

ir_ref ir_intern(struct ir_graph *graph, enum ir_op op, ir_type_id type, uint32_t attr,
                 const ir_ref *args, unsigned num_args)
{
    struct ir_content c = {op, type, attr, num_args, args, 0};
    ir_ref equal = ir_find(graph, &c);
    return equal ? equal : ir_add(graph, &c);
}

ir_ref ir_intern_const(struct ir_graph *graph, ir_type_id type, const union ir_word *words)
{
    assert(ir_type_info(type)->components > 0);
    struct ir_content c = {IR_CONST, type, 0, ir_type_info(type)->components, &words->u, 0};
    c.hash = hash_of(&c);
    ir_ref equal = find(graph, &c);
    if (equal)
        return equal;
    if (!has_room(graph, IR_CONST))
        return ir_poison(graph, type);
    struct ir_node node = {
        .op = IR_CONST, .type = type, .attr = graph->words.len, .origin = graph->origin};
    push_words(graph, c.data, c.count);
    return add(graph, node, c.hash);
}

uint32_t ir_add_origin(struct ir_graph *graph, str_id name, uint32_t element, uint32_t parent)
{
    assert(parent < graph->origins.len);
    uint32_t index = graph->origins.len;
    vec_push(graph->arena, &graph->origins, (struct ir_origin){name, element, parent, graph->slot});
    return index;
}

uint32_t ir_add_callee(struct ir_graph *graph, struct ir_callee callee)
{
    assert(callee.kind < IR_NUM_CALLEE_KINDS);
    uint32_t hash = hash_pair(callee.kind, callee.index);
    for (uint32_t at = hash, found; (found = table_next(&graph->callee_table, hash, &at));) {
        const struct ir_callee *have = &graph->callees.items[found - 1];
        if (have->kind == callee.kind && have->index == callee.index)
            return found - 1;
    }
    vec_push(graph->arena, &graph->callees, callee);
    table_add(&graph->callee_table, graph->arena, hash, graph->callees.len);
    return graph->callees.len - 1;
}

static uint32_t add_user_type(struct ir_graph *graph, struct ir_user_type type)
{
    if (graph->user_types.len >= UINT16_MAX - IR_TYPE_FIRST_USER)
        mem_fail(graph->arena->mem);
    vec_push(graph->arena, &graph->user_types, type);
    return IR_TYPE_FIRST_USER + graph->user_types.len - 1;
}

static bool same_members(const struct ir_member *a, const struct ir_member *b, unsigned count)
{
    for (unsigned i = 0; i < count; i++)
        if (a[i].name != b[i].name || a[i].type != b[i].type)
            return false;
    return true;
}

uint32_t ir_add_struct(struct ir_graph *graph, str_id name, const struct ir_member *members,
                       unsigned num_members)
{
    assert(num_members > 0 && num_members <= UINT16_MAX);
    for (unsigned i = 0; i < num_members; i++)
        assert(members[i].type < IR_TYPE_FIRST_USER + graph->user_types.len);
    for (uint32_t i = 0; i < graph->user_types.len; i++) {
        const struct ir_user_type *type = &graph->user_types.items[i];
        if (type->array_length == 0 && type->name == name && type->num_members == num_members
            && same_members(graph->members.items + type->first_member, members, num_members))
            return IR_TYPE_FIRST_USER + i;
    }
    uint32_t first = graph->members.len;
    memcpy(vec_extend(graph->arena, &graph->members, num_members), members,
           num_members * sizeof *members);
    return add_user_type(graph, (struct ir_user_type){.name = name,
                                                      .num_members = (uint16_t)num_members,
                                                      .first_member = first});
}

uint32_t ir_add_array(struct ir_graph *graph, ir_type_id element, uint32_t length)
{
    assert(length > 0);
    assert(element < IR_TYPE_FIRST_USER + graph->user_types.len);
    for (uint32_t i = 0; i < graph->user_types.len; i++)
        if (graph->user_types.items[i].array_length == length
            && graph->user_types.items[i].element == element)
            return IR_TYPE_FIRST_USER + i;
    return add_user_type(graph, (struct ir_user_type){.element = element, .array_length = length});
}

uint32_t ir_add_function(struct ir_graph *graph, str_id name, const ir_type_id *param_types,
                         unsigned num_params)
{
    assert(graph->functions.len < 1u << 16 && num_params < 1u << 16);
    struct ir_function function = {
        .name = name, .num_params = num_params, .first_param_type = graph->param_types.len};
    if (num_params)
        memcpy(vec_extend(graph->arena, &graph->param_types, num_params), param_types,
               num_params * sizeof *param_types);
    vec_push(graph->arena, &graph->functions, function);
    return graph->functions.len - 1;
}

ir_ref ir_param(struct ir_graph *graph, uint32_t function, unsigned index)
{
    assert(function < graph->functions.len);
    const struct ir_function *f = &graph->functions.items[function];
    assert(index < f->num_params);
    ir_type_id type = graph->param_types.items[f->first_param_type + index];
    return ir_intern(graph, IR_PARAM, type, function << 16 | index, NULL, 0);
}

void ir_set_results(struct ir_graph *graph, uint32_t function, const ir_ref *results,
                    unsigned num_results)
{
    struct ir_function *f = &graph->functions.items[function];
    assert(f->num_results == 0 && num_results > 0);
    for (unsigned i = 0; i < num_results; i++)
        assert(results[i] && results[i] < graph->nodes.len);
    f->num_results = num_results;
    f->first_result = graph->function_results.len;
    memcpy(vec_extend(graph->arena, &graph->function_results, num_results), results,
           num_results * sizeof *results);
}

ir_ref ir_poison(struct ir_graph *graph, ir_type_id type)
{
    return ir_intern(graph, IR_POISON, type, graph->origin, NULL, 0);
}

bool ir_is_const(const struct ir_graph *graph, ir_ref ref)
{
    return ir_get(graph, ref)->op == IR_CONST;
}

bool ir_get_const(const struct ir_graph *graph, ir_ref ref, struct ir_value *out)
{
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op != IR_CONST)
        return false;
    out->type = node->type;
    memcpy(out->w, graph->words.items + node->attr,
           ir_type_info(node->type)->components * sizeof *out->w);
    return true;
}

ir_ref ir_other_operand(const struct ir_graph *graph, enum ir_op op, ir_ref a, ir_ref b)
{
    assert(!a || !b);
    bool is_volume = b && op == IR_LAYER && ir_type_of(graph, b) == IR_TYPE_VDF;
    return a ? a : is_volume ? 0 : b;
}

bool ir_const_is(const struct ir_graph *graph, ir_ref ref, float f)
{
    struct ir_value value;
    if (!ir_get_const(graph, ref, &value) || value.type == IR_TYPE_STRING)
        return false;
    const struct ir_type_info *info = ir_type_info(value.type);
    for (unsigned i = 0; i < info->components; i++) {
        union ir_word w = value.w[i];
        float component = info->scalar == IR_TYPE_FLOAT ? w.f
                          : info->scalar == IR_TYPE_INT ? (float)w.i
                                                        : (float)w.u;
        if (component != f)
            return false;
    }
    return true;
}

static unsigned mode_number(const struct ir_graph *graph, const struct ir_slot *slot)
{
    struct ir_value mode;
    bool is_known = ir_get_const(graph, slot->mode, &mode);
    assert(is_known && mode.w[0].u < 2 * IR_SLOT_VERTICAL);
    return is_known ? mode.w[0].u : IR_SLOT_MIX;
}

bool ir_slot_is_vertical(const struct ir_graph *graph, const struct ir_slot *slot)
{
    return mode_number(graph, slot) >= IR_SLOT_VERTICAL;
}

enum ir_slot_mode ir_slot_mode(const struct ir_graph *graph, const struct ir_slot *slot)
{
    return (enum ir_slot_mode)(mode_number(graph, slot) % IR_SLOT_VERTICAL);
}
