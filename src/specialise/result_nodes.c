// SPDX-License-Identifier: Apache-2.0
/* Makes and reads nodes of the result. */
#include "specialise/spec.h"

#include <assert.h>

lang_ref spec_add(struct spec *s, struct lang_node node)
{
    node.next = 0;
    lang_ref ref = s->unit->nodes.len;
    vec_push(s->unit->arena, &s->unit->nodes, node);
    return ref;
}

void spec_append(struct spec *s, struct chain *chain, lang_ref ref)
{
    assert(!chain->first == !chain->last && ref != chain->last);
    if (chain->last)
        spec_node(s, chain->last)->next = ref;
    else
        chain->first = ref;
    chain->last = ref;
}

lang_ref spec_constant_words(struct spec *s, ir_type_id type, const union ir_word *words)
{
    uint32_t count = ir_type_info(type)->components, at = s->unit->words.len;
    union ir_word copy[16]; /* the words may move when the unit grows */
    assert(count <= sizeof copy / sizeof *copy);
    memcpy(copy, words, count * sizeof *copy);
    union ir_word *to = vec_extend(s->unit->arena, &s->unit->words, count);
    memcpy(to, copy, count * sizeof *copy);
    return spec_add(s, (struct lang_node){.kind = LANG_CONST, .type = type, .a = at});
}

lang_ref spec_constant(struct spec *s, const struct ir_value *value)
{
    return spec_constant_words(s, value->type, value->w);
}

bool spec_get(const struct spec *s, lang_ref ref, struct ir_value *out)
{
    const struct lang_node *node = ast_node(s->unit, ref);
    if (node->kind != LANG_CONST)
        return false;
    *out = ast_value(node->type, ast_words(s->unit, node));
    return true;
}
