// SPDX-License-Identifier: Apache-2.0
/* The difference between two results, for a host that has a program of the first. */
#include "api/generation.h"

/* False: the hosts draw them in different ways, or memory is missing. */
static bool share_program(const mxg_result *before, const mxg_result *after)
{
    const struct shader *a = &before->shader, *b = &after->shader;
    uint64_t first, second;
    return before->target == after->target && before->options == after->options
           && a->reflection.transparent == b->reflection.transparent
           && a->reflection.alpha == b->reflection.alpha
           && a->reflection.displaced == b->reflection.displaced
           && a->reflection.lit == b->reflection.lit
           && a->interface.used.len == b->interface.used.len && result_topology(before, &first)
           && result_topology(after, &second) && first == second;
}

/* The results have pools of their own, so equal texts may differ in their ids. */
static bool same_text(const mxg_result *before, str_id a, const mxg_result *after, str_id b)
{
    return strcmp(str_text(&before->strings, a), str_text(&after->strings, b)) == 0;
}

static bool same_sampling(const mxg_result *before, const struct shader_sampling *a,
                          const mxg_result *after, const struct shader_sampling *b)
{
    return a->frameoffset == b->frameoffset
           && same_text(before, a->uaddressmode, after, b->uaddressmode)
           && same_text(before, a->vaddressmode, after, b->vaddressmode)
           && same_text(before, a->filtertype, after, b->filtertype)
           && same_text(before, a->layer, after, b->layer)
           && same_text(before, a->framerange, after, b->framerange)
           && same_text(before, a->frameendaction, after, b->frameendaction);
}

static bool same_tiles(const mxg_result *before, const struct shader_variable *a,
                       const mxg_result *after, const struct shader_variable *b)
{
    if (a->num_tiles != b->num_tiles)
        return false;
    for (uint32_t i = 0; i < a->num_tiles; i++) {
        const struct shader_tile *x = &before->shader.interface.tiles.items[a->first_tile + i],
                                 *y = &after->shader.interface.tiles.items[b->first_tile + i];
        if (x->u != y->u || x->v != y->v || !same_text(before, x->file, after, y->file))
            return false;
    }
    return true;
}

static bool same_default(const mxg_result *before, const struct shader_variable *a,
                         const mxg_result *after, const struct shader_variable *b)
{
    if (a->has_default != b->has_default || !a->has_default)
        return a->has_default == b->has_default;
    if (a->value.type != b->value.type)
        return false;
    if (a->value.type == IR_TYPE_STRING)
        return same_text(before, a->value.w[0].u, after, b->value.w[0].u);
    uint32_t count = ir_type_components(a->value.type);
    for (uint32_t i = 0; i < count; i++)
        if (a->value.w[i].u != b->value.w[i].u)
            return false;
    return true;
}

static bool same_value(const mxg_result *before, const mxg_result *after, uint32_t index)
{
    const struct shader_variable *a = result_variable(before, index),
                                 *b = result_variable(after, index);
    assert(a->block == b->block && a->type == b->type && a->array_length == b->array_length);
    return same_default(before, a, after, b) && same_text(before, a->file, after, b->file)
           && same_text(before, a->origin, after, b->origin)
           && same_text(before, a->colorspace, after, b->colorspace)
           && same_sampling(before, &a->sampling, after, &b->sampling)
           && same_tiles(before, a, after, b);
}

/* The values of a network stand in its description only. */
static mxg_change network_change(const mxg_result *before, const mxg_result *after)
{
    const char *a = mxg_result_reflection_json(before, NULL),
               *b = mxg_result_reflection_json(after, NULL);
    return a && b && strcmp(a, b) == 0 ? MXG_CHANGE_NOTHING : MXG_CHANGE_SHADER;
}

mxg_change mxg_result_change(const mxg_result *before, const mxg_result *after, uint32_t *variables,
                             uint32_t capacity, uint32_t *out_num)
{
    uint32_t num = 0;
    if (out_num)
        *out_num = 0;
    if (!before || !after || !before->has_shader || !after->has_shader)
        return MXG_CHANGE_SHADER;
    if (before->network.arena && after->network.arena)
        return network_change(before, after);
    if (before->network.arena || after->network.arena || !share_program(before, after))
        return MXG_CHANGE_SHADER;
    for (uint32_t i = 0; i < mxg_result_num_variables(before); i++) {
        if (same_value(before, after, i))
            continue;
        if (variables && num < capacity)
            variables[num] = i;
        num++;
    }
    if (out_num)
        *out_num = num;
    return num ? MXG_CHANGE_VALUES : MXG_CHANGE_NOTHING;
}
