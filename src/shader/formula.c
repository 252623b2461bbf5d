// SPDX-License-Identifier: Apache-2.0
#include "shader/formula.h"

#include "lower/lower.h"

#include <assert.h>

/*
 * Tree nodes of the functions that become nodes themselves, so that what is known of their operands
 * makes them shorter, and neighbours share their parts.
 */
enum { MAX_FORMULA_NODES = 50 };

static bool takes(const struct shader *shader, const struct lang_unit *unit,
                  const struct lang_function *function, const ir_ref *args, unsigned num_args)
{
    bool does = function->num_params == num_args;
    for (unsigned i = 0; i < num_args && does; i++)
        does =
            unit->slots.items[function->first_slot + i].type == ir_type_of(shader->graph, args[i]);
    return does;
}

/* Formulas are the first functions of the lowest unit. */
static uint32_t find(const struct shader *shader, const char *name, const ir_ref *args,
                     unsigned num_args)
{
    const struct lang_unit *lowest = shader->unit;
    str_id id = str_find(shader->strings, name, strlen(name));
    while (lowest->base)
        lowest = lowest->base;
    for (uint32_t i = 0; i < lowest->functions.len; i++) {
        const struct lang_function *function = &lowest->functions.items[i];
        if (function->name == id && takes(shader, lowest, function, args, num_args))
            return i;
    }
    return LANG_NONE;
}

ir_ref shader_formula(struct shader *shader, const char *name, const ir_ref *args,
                      unsigned num_args)
{
    static const struct lang_host host = {.max_outer_nodes = MAX_FORMULA_NODES,
                                          .max_inline_nodes = MAX_FORMULA_NODES};
    /* formulas read no declarations of the host, which the unit keeps for other functions */
    const struct lang_host kept = shader->unit->host;
    uint32_t function = find(shader, name, args, num_args);
    assert(function != LANG_NONE && lang_num_results(shader->unit, function) == 1);
    ir_ref result;
    lang_lower_call(shader->unit, shader->graph, &host, function, args, &result);
    shader->unit->host = kept;
    return result;
}
