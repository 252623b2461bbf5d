// SPDX-License-Identifier: Apache-2.0
#include "lang/fragment.h"

#include "base/hash.h"
#include "lang/lower.h"

/* What no constant begins with: of type 0, or of an operand. */
enum { CODE_ABSENT = 0, CODE_SAME = 1, CODE_OPAQUE = 2, CODE_OPAQUE_IN_LOOP = 3 };
static_assert((unsigned)IR_CONST == 0, "heads of constants are types");

/* ---- Codes ---- */

unsigned fragment_write_head(const struct ir_graph *graph, const struct lang_unit *layer,
                             enum ir_op op, ir_type_id type, unsigned count,
                             uint16_t out[FRAGMENT_MAX_HEAD])
{
    out[0] = fragment_head(op, type, count);
    if (type < IR_TYPE_FIRST_USER)
        return 1;
    uint32_t known_as = graph->user_types.items[type - IR_TYPE_FIRST_USER].known_as;
    out[1] = (uint16_t)known_as;
    return known_as && known_as < IR_TYPE_FIRST_USER + layer->user_types.len
                   && known_as <= UINT16_MAX
               ? 2
               : 0;
}

unsigned fragment_write_constant(const struct ir_graph *graph, const struct lang_unit *layer,
                                 const struct ir_node *node, uint16_t out[FRAGMENT_MAX_CONSTANT])
{
    const union ir_word *words = graph->words.items + node->attr;
    if (node->type == IR_TYPE_STRING && words->u >= layer->strings->num)
        return 0;
    unsigned len = 0;
    out[len++] = fragment_head(IR_CONST, node->type, 0);
    for (unsigned i = 0; i < ir_type_info(node->type)->components; i++) {
        out[len++] = (uint16_t)(words[i].u & 0xffff);
        out[len++] = (uint16_t)(words[i].u >> 16);
    }
    return len;
}

/* ---- Patterns ---- */

static inline void put(struct fragment_pattern *pattern, unsigned code)
{
    if (pattern->len < FRAGMENT_MAX_PATTERN)
        pattern->codes[pattern->len++] = (uint16_t)code;
    else
        pattern->failed = true;
}

static inline void put_all(struct fragment_pattern *pattern, const uint16_t *codes, unsigned len)
{
    pattern->failed |= len == 0;
    for (unsigned i = 0; i < len; i++)
        put(pattern, codes[i]);
}

static void put_head(struct fragment_pattern *pattern, enum ir_op op, ir_type_id type,
                     unsigned count)
{
    uint16_t codes[FRAGMENT_MAX_HEAD];
    put_all(pattern, codes,
            fragment_write_head(pattern->graph, pattern->layer, op, type, count, codes));
}

static void put_node(struct fragment_pattern *pattern, ir_ref ref, unsigned depth);

static void put_looked_through(struct fragment_pattern *pattern, ir_ref ref, unsigned depth)
{
    const struct ir_node *node = ir_get(pattern->graph, ref);
    put_head(pattern, (enum ir_op)node->op, node->type, node->num_args);
    put(pattern, node->attr);
    pattern->failed |= node->attr > UINT16_MAX || depth == FRAGMENT_MAX_DEPTH;
    if (node->num_args >= FRAGMENT_MANY)
        put(pattern, node->num_args);
    for (uint32_t i = 0; i < node->num_args && !pattern->failed; i++)
        put_node(pattern, ir_arg(pattern->graph, ref, i), depth + 1);
}

static void put_node(struct fragment_pattern *pattern, ir_ref ref, unsigned depth)
{
    const struct ir_node *node = ir_get(pattern->graph, ref);
    if (node->op == IR_CONST) {
        uint16_t codes[FRAGMENT_MAX_CONSTANT];
        put_all(pattern, codes,
                fragment_write_constant(pattern->graph, pattern->layer, node, codes));
        return;
    }
    unsigned num_inputs = pattern->num_inputs;
    for (unsigned i = 0; i < num_inputs; i++)
        if (pattern->inputs[i] == ref) {
            put(pattern, CODE_SAME);
            put(pattern, i);
            return;
        }
    pattern->failed |= num_inputs == FRAGMENT_MAX_INPUTS;
    if (pattern->failed)
        return;
    pattern->inputs[pattern->num_inputs++] = ref;
    if (ir_is_looked_through((enum ir_op)node->op))
        put_looked_through(pattern, ref, depth);
    else
        put_head(pattern, IR_CONST, node->type,
                 node->flags & IR_NODE_LOOP ? CODE_OPAQUE_IN_LOOP : CODE_OPAQUE);
}

void fragment_pattern_begin(struct fragment_pattern *pattern, const struct ir_graph *graph,
                            const struct lang_unit *layer)
{
    pattern->graph = graph;
    pattern->len = pattern->num_inputs = 0;
    pattern->layer = layer;
    pattern->failed = false;
}

void fragment_pattern_add(struct fragment_pattern *pattern, ir_ref argument)
{
    if (argument && !pattern->failed)
        put_node(pattern, argument, 0);
    else
        put(pattern, CODE_ABSENT);
}

uint32_t fragment_hash(const struct fragment_pattern *pattern)
{
    return hash_bytes(pattern->codes, pattern->len * sizeof *pattern->codes);
}

const struct lang_fragment *fragment_find(const struct lang_unit *layer, uint32_t first,
                                          const struct fragment_pattern *pattern, uint32_t choice)
{
    uint32_t hash = fragment_hash(pattern);
    for (uint32_t next = pattern->failed ? 0 : first; next;) {
        const struct lang_fragment *fragment = &layer->fragments.items[next - 1];
        if (fragment->hash == hash && fragment->choice == choice
            && fragment->pattern_len == pattern->len
            && memcmp(layer->codes.items + fragment->first_code, pattern->codes,
                      pattern->len * sizeof *pattern->codes)
                   == 0)
            return fragment;
        next = fragment->next;
    }
    return NULL;
}

bool fragment_is_open(const struct fragment_pattern *pattern)
{
    for (unsigned at = 0; at < pattern->len; at++) {
        if (pattern->codes[at] == fragment_head(IR_CONST, IR_TYPE_STRING, 0))
            at += 2; /* its words */
        else if (pattern->codes[at] >> 9 != IR_CONST || (pattern->codes[at] & 7) != CODE_OPAQUE)
            return false;
    }
    return !pattern->failed;
}

/*
 * Whether an argument is what its part of an open pattern says; one that is opaque becomes an
 * input.
 */
static bool fits_open(const struct lang_unit *layer, const struct ir_graph *graph, ir_ref arg,
                      const uint16_t **codes, ir_ref *inputs, unsigned *num_inputs)
{
    const struct ir_node *node = ir_get(graph, arg);
    if (node->op == IR_POISON || node->flags & IR_NODE_LOOP)
        return false;
    if (node->op != IR_CONST) {
        inputs[(*num_inputs)++] = arg;
        return *(*codes)++ == fragment_head(IR_CONST, node->type, CODE_OPAQUE);
    }
    uint16_t constant[FRAGMENT_MAX_CONSTANT];
    unsigned len =
        node->type == IR_TYPE_STRING ? fragment_write_constant(graph, layer, node, constant) : 0;
    bool is_same = len && memcmp(*codes, constant, len * sizeof *constant) == 0;
    *codes += len;
    return is_same;
}

const struct lang_fragment *fragment_find_open(const struct lang_unit *layer, uint32_t first,
                                               const struct ir_graph *graph, uint32_t choice,
                                               const ir_ref *args, unsigned num_args,
                                               ir_ref *inputs, unsigned *out_num_inputs)
{
    for (uint32_t next = first; next; next = layer->fragments.items[next - 1].next) {
        const struct lang_fragment *fragment = &layer->fragments.items[next - 1];
        const uint16_t *codes = layer->codes.items + fragment->first_code;
        bool fits = fragment->choice == choice;
        *out_num_inputs = 0;
        for (unsigned i = 0; i < num_args && fits; i++)
            fits = fits_open(layer, graph, args[i], &codes, inputs, out_num_inputs);
        if (fits)
            return fragment;
    }
    return NULL;
}

void fragment_note_known(const struct ir_graph *graph, const ir_ref *inputs, unsigned num_inputs,
                         bool *known)
{
    ir_ref newest = 0; /* nothing is equal to what is newer than all before */
    for (unsigned i = 0; i < num_inputs; i++) {
        known[i] = ir_is_looked_through((enum ir_op)ir_get(graph, inputs[i])->op);
        for (unsigned k = 0; k < i && inputs[i] <= newest && !known[i]; k++)
            known[i] = inputs[k] == inputs[i];
        newest = inputs[i] > newest ? inputs[i] : newest;
    }
}

/* ---- Restoring ---- */

uint32_t fragment_callee(struct lang_unit *unit, struct ir_graph *graph, uint32_t function)
{
    const struct lang_function *fn = lang_function(unit, function, NULL);
    return ir_add_callee(graph,
                         (struct ir_callee){.id = function,
                                            .name = fn->name,
                                            .derivative = (fn->flags & LANG_FN_DERIVATIVE) != 0,
                                            .pure = (fn->flags & LANG_FN_PURE) != 0});
}

static ir_ref restore_constant(const struct fragment_host *host, ir_type_id type,
                               const uint16_t **codes)
{
    union ir_word words[16];
    for (unsigned i = 0; i < ir_type_info(type)->components; i++, *codes += 2)
        words[i].u = (uint32_t)(*codes)[0] | (uint32_t)(*codes)[1] << 16;
    return ir_const_words(host->graph, type, words);
}

static inline ir_type_id restore_type(const struct fragment_host *host, unsigned head,
                                      const uint16_t **codes)
{
    unsigned type = head >> 3 & 63;
    return type == FRAGMENT_USER_TYPE
               ? lower_graph_type(host->unit, host->graph, (ir_type_id) * (*codes)++)
               : (ir_type_id)type;
}

struct restoring {
    struct fragment_host *host;
    const uint16_t *codes; /* what comes next */
    const ir_ref *nodes;   /* by the numbers that operands have */
    /*
     * the same of an open fragment: more can be seen of the node than when it was taken down; or
     * NULL
     */
    bool *known;
    bool is_known; /* of the node at hand */
};

/*
 * What a user can see of `ref`, which was built over known operands, is what was taken down if it
 * is new, opaque and of the same op.
 */
static bool shows_more(const struct restoring *r, ir_ref ref, enum ir_op op, uint32_t num_before)
{
    return ref < num_before || ir_get(r->host->graph, ref)->op != op || ir_is_looked_through(op);
}

static ir_ref restore_op(struct restoring *r, unsigned head)
{
    struct fragment_host *host = r->host;
    enum ir_op op = (enum ir_op)(head >> 9);
    ir_type_id type = restore_type(host, head, &r->codes);
    unsigned count = head & 7;
    uint32_t attr = fragment_has_attr(op) ? *r->codes++ : 0;
    ir_ref args[FRAGMENT_MAX_OPERANDS];
    bool any_known = false;
    if (op == IR_CALL)
        attr = fragment_callee(host->unit, host->graph, attr);
    else if (op == IR_LEAF)
        attr = host->leaf(host->user_data, attr);
    if (count == FRAGMENT_MANY)
        count = *r->codes++;
    for (unsigned i = 0; i < count; i++)
        args[i] = r->nodes[r->codes[i]];
    for (unsigned i = 0; r->known && i < count; i++)
        any_known |= r->known[r->codes[i]];
    r->codes += count;
    if (!any_known)
        return ir_restore(host->graph, op, type, attr, args, count);
    uint32_t num_before = host->graph->nodes.len;
    ir_ref result = ir_build(host->graph, op, type, attr, args, count);
    host->has_folded |= ir_is_const(host->graph, result);
    r->is_known = shows_more(r, result, op, num_before);
    return result;
}

static ir_ref restore_node(struct restoring *r)
{
    struct fragment_host *host = r->host;
    unsigned head = *r->codes++;
    if (head >> 9 == IR_POISON) {
        host->origin(host->user_data, *r->codes++);
        head = *r->codes++;
    }
    enum ir_op op = (enum ir_op)(head >> 9);
    r->is_known = false;
    if (op == IR_CONST)
        return restore_constant(host, (ir_type_id)(head >> 3 & 63), &r->codes);
    if (op != IR_UNIFORM && op != IR_STREAM && op != IR_TEXTURE && op != IR_LOCAL)
        return restore_op(r, head);
    uint32_t num_before = host->graph->nodes.len;
    ir_ref result;
    if (op == IR_LOCAL) {
        ir_type_id type = restore_type(host, head, &r->codes);
        result = host->named(host->user_data, *r->codes++, type);
    } else {
        result = host->lang->global(host->lang->user_data, host->graph, host->unit, *r->codes++);
    }
    r->is_known = result < num_before; /* perhaps an input */
    return result;
}

const uint16_t *fragment_restore(struct fragment_host *host, const struct lang_unit *layer,
                                 const struct lang_fragment *fragment, unsigned num_inputs,
                                 ir_ref *nodes, bool *known)
{
    unsigned next = 1 + num_inputs, end = next + fragment->num_nodes;
    struct restoring r = {.host = host,
                          .nodes = nodes,
                          .known = known,
                          .codes =
                              layer->codes.items + fragment->first_code + fragment->pattern_len};
    for (; next < end; next++) {
        nodes[next] = restore_node(&r);
        if (known)
            known[next] = r.is_known;
    }
    return r.codes;
}
