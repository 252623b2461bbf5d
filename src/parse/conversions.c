// SPDX-License-Identifier: Apache-2.0
/* Facts about types that need no tree. GLSL 4.50, 4.1.10. */
#include "parse/parse_priv.h"

#include <assert.h>

unsigned check_rank(ir_type_id scalar)
{
    return scalar == IR_TYPE_INT ? 1 : scalar == IR_TYPE_UINT ? 2 : scalar == IR_TYPE_FLOAT ? 3 : 0;
}

static const ir_type_id scalar_of_rank[] = {IR_TYPE_VOID, IR_TYPE_INT, IR_TYPE_UINT, IR_TYPE_FLOAT};

unsigned check_rank_of(ir_type_id type)
{
    return check_rank(ir_type_scalar(type));
}

bool check_is_vector(ir_type_id type)
{
    return type < IR_NUM_TYPES && ir_type_info(type)->components > 1 && !ir_type_is_matrix(type);
}

ir_type_id check_with_rank(ir_type_id type, unsigned rank)
{
    assert(rank < sizeof scalar_of_rank / sizeof *scalar_of_rank);
    if (ir_type_is_matrix(type))
        return rank == 3 ? type : IR_TYPE_VOID;
    return ir_type_vector(scalar_of_rank[rank], ir_type_info(type)->components);
}

bool check_converts(ir_type_id from, ir_type_id to)
{
    if (from == to)
        return true;
    unsigned rank = check_rank_of(from);
    return rank && rank < check_rank_of(to) && check_with_rank(from, check_rank_of(to)) == to;
}

bool check_is_array(const struct parser *p, ir_type_id type, ir_type_id *out_element,
                    uint32_t *out_length)
{
    if (type < IR_TYPE_FIRST_USER)
        return false;
    const struct ir_user_type *user = lang_user_type(p->unit, type, NULL);
    if (user->array_length == 0)
        return false;
    assert(user->num_members == 0);
    *out_element = user->element;
    *out_length = user->array_length;
    return true;
}
