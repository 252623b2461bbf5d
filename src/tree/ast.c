// SPDX-License-Identifier: Apache-2.0
#include "tree/ast.h"

#include <assert.h>

uint32_t ast_member_offset(const struct lang_unit *unit, ir_type_id type, uint32_t index,
                           uint32_t (*size_of)(const struct lang_unit *, ir_type_id),
                           ir_type_id *out_type)
{
    const struct lang_unit *layer;
    const struct ir_user_type *user = lang_user_type(unit, type, &layer);
    assert(index < user->num_members);
    const struct ir_member *members = layer->members.items + user->first_member;
    uint32_t offset = 0;
    for (uint32_t i = 0; i < index; i++)
        offset += size_of(unit, members[i].type);
    *out_type = members[index].type;
    return offset;
}

uint32_t ast_target_slot(const struct lang_unit *layer, lang_ref target)
{
    const struct lang_node *node = ast_node(layer, target);
    while (node->kind == LANG_OP)
        node = ast_node(layer, node->a);
    assert(node->kind == LANG_VAR);
    return node->a;
}

uint32_t ast_num_parts(const struct lang_unit *unit, ir_type_id type)
{
    if (ast_is_user_type(type))
        return lang_user_type(unit, type, NULL)->array_length;
    const struct ir_type_info *info = ir_type_info(type);
    return info->columns > 1 ? info->columns : info->components;
}

uint8_t ast_param_mode(const struct lang_unit *unit, uint32_t function, uint32_t param)
{
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(unit, function, &layer);
    assert(param < fn->num_params);
    return ast_slot(layer, fn, param)->mode;
}

unsigned ast_list(const struct lang_unit *layer, lang_ref first, lang_ref *out, unsigned max)
{
    unsigned count = 0;
    for (lang_ref ref = first; ref; ref = ast_node(layer, ref)->next, count++)
        if (count < max)
            out[count] = ref;
    return count;
}

lang_ref ast_returned(const struct lang_unit *layer, const struct lang_function *fn)
{
    const struct lang_node *body = ast_node(layer, fn->body);
    assert(!fn->body || body->kind == LANG_BLOCK);
    const struct lang_node *first = fn->body && body->a ? ast_node(layer, body->a) : NULL;
    return first && first->kind == LANG_RETURN ? first->a : 0;
}
