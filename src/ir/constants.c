// SPDX-License-Identifier: Apache-2.0
/* values: constants of built-in types. */
#include "ir/ir.h"

struct ir_value ir_value_float(float f)
{
    return (struct ir_value){.type = IR_TYPE_FLOAT, .w[0].f = f};
}

struct ir_value ir_value_int(int32_t i)
{
    return (struct ir_value){.type = IR_TYPE_INT, .w[0].i = i};
}

struct ir_value ir_value_bool(bool b)
{
    return (struct ir_value){.type = IR_TYPE_BOOL, .w[0].u = b};
}

bool ir_value_equal(const struct ir_value *a, const struct ir_value *b)
{
    size_t components = ir_type_info(a->type)->components;
    return a->type == b->type && memcmp(a->w, b->w, components * sizeof *a->w) == 0;
}
