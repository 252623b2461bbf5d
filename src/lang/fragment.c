// SPDX-License-Identifier: Apache-2.0
#include "lang/fragment.h"

#include "base/hash.h"

/* What no constant begins with: of type 0, or of an operand. */
enum { CODE_ABSENT = 0, CODE_SAME = 1, CODE_OPAQUE = 2, CODE_OPAQUE_IN_LOOP = 3 };
static_assert((unsigned)IR_CONST == 0, "heads of constants are types");

/* ---- Patterns ---- */

static inline void put(struct fragment_pattern *pattern, unsigned code)
{
    if (pattern->len < FRAGMENT_MAX_PATTERN)
        pattern->codes[pattern->len++] = (uint16_t)code;
    else
        pattern->failed = true;
}

/* A string that the library does not know has a number by chance. */
static void put_constant(struct fragment_pattern *pattern, const struct ir_graph *graph, const struct ir_node *node)
{
    const union ir_word *words = graph->words.items + node->attr;
    pattern->failed |= node->type == IR_TYPE_STRING && words->u >= pattern->num_strings;
    put(pattern, fragment_head(IR_CONST, node->type, 0));
    for (unsigned i = 0; i < ir_type_info(node->type)->components; i++) {
        put(pattern, words[i].u & 0xffff);
        put(pattern, words[i].u >> 16);
    }
}

static void put_node(struct fragment_pattern *pattern, const struct ir_graph *graph, ir_ref ref, unsigned depth)
{
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op == IR_CONST) {
        put_constant(pattern, graph, node);
        return;
    }
    for (unsigned i = 0; i < pattern->num_inputs; i++)
        if (pattern->inputs[i] == ref) {
            put(pattern, CODE_SAME);
            put(pattern, i);
            return;
        }
    pattern->failed |= pattern->num_inputs == FRAGMENT_MAX_INPUTS || depth > FRAGMENT_MAX_DEPTH || node->type >= IR_TYPE_FIRST_USER
                    || node->attr > UINT16_MAX;
    if (pattern->failed)
        return;
    pattern->inputs[pattern->num_inputs++] = ref;
    pattern->has_derivative |= (node->flags & IR_NODE_DERIVATIVE) != 0;
    if (!ir_is_looked_through((enum ir_op)node->op)) {
        put(pattern, fragment_head(IR_CONST, node->type, node->flags & IR_NODE_LOOP ? CODE_OPAQUE_IN_LOOP : CODE_OPAQUE));
        return;
    }
    put(pattern, fragment_head((enum ir_op)node->op, node->type, node->num_args));
    put(pattern, node->attr);
    if (node->num_args >= FRAGMENT_MANY)
        put(pattern, node->num_args);
    for (uint32_t i = 0; i < node->num_args; i++)
        put_node(pattern, graph, ir_arg(graph, ref, i), depth + 1);
}

uint32_t fragment_hash(const struct fragment_pattern *pattern)
{
    return hash_bytes(pattern->codes, pattern->len * sizeof *pattern->codes);
}

bool fragment_begin(struct lower *lo, uint32_t id, const ir_ref *args, struct fragment_pattern *pattern)
{
    const struct lang_unit *layer = lo->frame->layer;
    const struct lang_function *fn = lo->frame->fn;
    bool has_any = id < layer->fragment_of.len && layer->fragment_of.items[id];
    if ((!has_any && !lo->unit->recorder) || layer->base || lo->host->choice == LANG_NONE || !(fn->flags & LANG_FN_PLAIN))
        return false;
    if (lo->unit->recorder)
        lo->unit->recorder->num_globals = 0;
    pattern->num_strings = layer->strings->num;
    pattern->len = pattern->num_inputs = 0;
    pattern->has_derivative = pattern->failed = false;
    put(pattern, lo->host->max_outer_nodes);
    put(pattern, lo->host->max_inline_nodes);
    for (uint32_t i = 0; i < fn->num_params && !pattern->failed; i++) {
        if (ast_slot(layer, fn, i)->mode == LANG_OUT)
            continue;
        if (*args)
            put_node(pattern, lo->graph, *args, 0);
        else
            put(pattern, CODE_ABSENT);
        args++;
    }
    return !pattern->failed;
}

/* ---- Restoring ---- */

static const struct lang_fragment *find(const struct lower *lo, uint32_t id, const struct fragment_pattern *pattern)
{
    const struct lang_unit *layer = lo->frame->layer;
    uint32_t hash = fragment_hash(pattern);
    for (uint32_t next = layer->fragment_of.items[id]; next;) {
        const struct lang_fragment *fragment = &layer->fragments.items[next - 1];
        if (fragment->hash == hash && fragment->choice == lo->host->choice && fragment->pattern_len == pattern->len
            && !(pattern->has_derivative && fragment->flags & LANG_FRAGMENT_WEIGHED)
            && memcmp(layer->codes.items + fragment->first_code, pattern->codes, pattern->len * sizeof *pattern->codes) == 0)
            return fragment;
        next = fragment->next;
    }
    return NULL;
}

static ir_ref restore_constant(struct lower *lo, ir_type_id type, const uint16_t **codes)
{
    union ir_word words[16];
    for (unsigned i = 0; i < ir_type_info(type)->components; i++, *codes += 2)
        words[i].u = (uint32_t)(*codes)[0] | (uint32_t)(*codes)[1] << 16;
    return ir_const_words(lo->graph, type, words);
}

static ir_ref restore_node(struct lower *lo, const ir_ref *nodes, const uint16_t **codes)
{
    unsigned head = *(*codes)++, count = head & 7;
    enum ir_op op = (enum ir_op)(head >> 9);
    ir_type_id type = (ir_type_id)(head >> 3 & 63);
    ir_ref args[LOWER_MAX_LEAVES];
    if (op == IR_CONST)
        return restore_constant(lo, type, codes);
    if (op == IR_UNIFORM || op == IR_STREAM || op == IR_TEXTURE)
        return lo->host->global(lo->host->user_data, lo->graph, lo->unit, *(*codes)++);
    uint32_t attr = fragment_has_attr(op) ? *(*codes)++ : 0;
    if (count == FRAGMENT_MANY)
        count = *(*codes)++;
    for (unsigned i = 0; i < count; i++)
        args[i] = nodes[(*codes)[i]];
    *codes += count;
    return ir_restore(lo->graph, op, type, op == IR_CALL ? lower_callee(lo, attr) : attr, args, count);
}

bool fragment_restore(struct lower *lo, uint32_t id, const struct fragment_pattern *pattern, ir_ref *results)
{
    const struct lang_unit *layer = lo->frame->layer;
    const struct lang_fragment *fragment = lo->unit->recorder ? NULL : find(lo, id, pattern);
    if (!fragment)
        return false;
    ir_ref nodes[FRAGMENT_MAX_INPUTS + FRAGMENT_MAX_NODES];
    memcpy(nodes, pattern->inputs, pattern->num_inputs * sizeof *nodes);
    const uint16_t *codes = layer->codes.items + fragment->first_code + fragment->pattern_len;
    for (unsigned i = 0; i < fragment->num_nodes; i++)
        nodes[pattern->num_inputs + i] = restore_node(lo, nodes, &codes);
    for (unsigned count = *codes++; count > 0; count--)
        *results++ = nodes[*codes++];
    return true;
}
