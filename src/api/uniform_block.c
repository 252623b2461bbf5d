// SPDX-License-Identifier: Apache-2.0
/* Blocks of uniforms: their places, and their bytes for upload. */
#include "api/generation.h"

#include "base/num.h"

static bool has_block(const mxg_result *result, mxg_block block)
{
    return result && result->has_shader && (unsigned)block < MXG_NUM_BLOCKS;
}

/* The buffer that holds a block; NULL: the block has none. */
static const struct shader_buffer *buffer_of(const mxg_result *result, mxg_block block)
{
    const struct shader_buffer *buffer =
        has_block(result, block) ? &result->shader.interface.buffers[block] : NULL;
    return buffer && buffer->size ? buffer : NULL;
}

mxg_status mxg_result_block(const mxg_result *result, mxg_block block, mxg_block_info *out)
{
    if (!has_block(result, block))
        return MXG_ERROR_ARGUMENT;
    const struct shader *shader = &result->shader;
    const struct shader_buffer *buffer = &shader->interface.buffers[block];
    uint32_t first = shader->interface.first_of_block[block];
    mxg_block_info full = {
        .name = shader_block_name(shader, (enum shader_block)block),
        .first_variable = first,
        .num_variables = shader->interface.first_of_block[block + 1] - first,
        .byte_size = buffer->size,
        .set = buffer->size ? buffer->set : 0,
        .binding = buffer->size ? buffer->binding : 0,
    };
    assert(first + full.num_variables <= shader->interface.used.len);
    if (block == MXG_BLOCK_LIGHT_DATA && full.num_variables) {
        full.array_length = shader->interface.max_lights;
        full.array_stride = buffer->stride;
        assert(!buffer->size || buffer->size == buffer->stride * shader->interface.max_lights);
    }
    return struct_write(out, &full, sizeof full);
}

/* ---- Values ---- */

/* Columns are matrix_stride bytes apart, and their components follow each other. */
void block_write_words(const struct shader_variable *v, const union ir_word *words, char *to)
{
    const struct ir_type_info *info = ir_type_info(v->type);
    if (v->type == IR_TYPE_BOOL && v->size == 1) { /* PACKING_METAL */
        *to = words->u != 0;
        return;
    }
    uint32_t rows = ir_type_rows(v->type);
    for (uint32_t i = 0; i < info->components; i++)
        memcpy(to + i / rows * v->matrix_stride + i % rows * sizeof *words, &words[i],
               sizeof *words);
}

size_t block_size(const mxg_result *result, mxg_block block)
{
    const struct shader_buffer *buffer = buffer_of(result, block);
    return buffer ? buffer->size : 0;
}

void block_pack(const mxg_result *result, mxg_block block, void *bytes)
{
    const struct shader_buffer *buffer = buffer_of(result, block);
    memset(bytes, 0, buffer->size);
    const struct shader *shader = &result->shader;
    for (uint32_t i = shader->interface.first_of_block[block];
         block != MXG_BLOCK_LIGHT_DATA && i < shader->interface.first_of_block[block + 1]; i++) {
        const struct shader_variable *v = result_variable(result, i);
        assert(v->offset + v->size <= buffer->size);
        if (v->has_default && v->value.type == v->type && !v->array_length)
            block_write_words(v, v->value.w, (char *)bytes + v->offset);
    }
}

/* False: the number is no value of the type. */
static bool word_of(ir_type_id scalar, float number, union ir_word *out)
{
    out->f = number;
    if (scalar == IR_TYPE_BOOL)
        out->u = number != 0;
    else if (scalar != IR_TYPE_FLOAT && num_is_exact_integer(number))
        out->i = (int32_t)number;
    else
        return scalar == IR_TYPE_FLOAT;
    return true;
}

/* Where element `element` of a variable begins in its buffer; false: it has no such element. */
static bool find_place(const mxg_result *result, const struct shader_variable *v, uint32_t element,
                       uint32_t *out_offset)
{
    bool is_of_light = v->block == BLOCK_LIGHT_DATA;
    uint32_t count = is_of_light       ? result->shader.interface.max_lights
                     : v->array_length ? v->array_length
                                       : 1,
             stride = is_of_light ? result->shader.interface.buffers[BLOCK_LIGHT_DATA].stride
                                  : v->array_stride;
    *out_offset = v->offset + element * stride;
    return element < count;
}

mxg_status mxg_result_pack_value(const mxg_result *result, uint32_t variable, uint32_t element,
                                 const float *values, uint32_t num_values, void *bytes,
                                 size_t capacity)
{
    if (variable >= mxg_result_num_variables(result) || !values || !bytes)
        return MXG_ERROR_ARGUMENT;
    const struct shader_variable *v = result_variable(result, variable);
    const struct shader_buffer *buffer = buffer_of(result, (mxg_block)v->block);
    uint32_t offset;
    if (!buffer || capacity < buffer->size || !find_place(result, v, element, &offset)
        || num_values != ir_type_info(v->type)->components)
        return MXG_ERROR_ARGUMENT;
    union ir_word words[16];
    assert(num_values <= sizeof words / sizeof *words && offset < buffer->size);
    for (uint32_t i = 0; i < num_values; i++)
        if (!word_of(ir_type_info(v->type)->scalar, values[i], &words[i]))
            return MXG_ERROR_ARGUMENT;
    block_write_words(v, words, (char *)bytes + offset);
    return MXG_OK;
}

/* ---- Lights ---- */

uint32_t mxg_result_num_light_types(const mxg_result *result)
{
    bool reads_lights = result && result->has_shader
                        && result->shader.interface.first_of_block[BLOCK_LIGHT_DATA]
                               < result->shader.interface.first_of_block[BLOCK_LIGHT_DATA + 1];
    return reads_lights ? result->shader.interface.lights.len : 0;
}

mxg_status mxg_result_light_type(const mxg_result *result, uint32_t index, mxg_light_type *out)
{
    if (index >= mxg_result_num_light_types(result))
        return MXG_ERROR_ARGUMENT;
    const struct shader_light *light = &result->shader.interface.lights.items[index];
    str_id name = light->shader ? light->name
                                : lang_function(result->shader.unit, light->function, NULL)->name;
    mxg_light_type full = {.type = light->type,
                           .name = str_text(&result->strings, name),
                           .is_shader = light->shader != 0,
                           .num_members = light->num_members};
    return struct_write(out, &full, sizeof full);
}

uint32_t mxg_result_light_member(const mxg_result *result, uint32_t light, uint32_t member)
{
    if (light >= mxg_result_num_light_types(result)
        || member >= result->shader.interface.lights.items[light].num_members)
        return MXG_NONE;
    const struct shader *shader = &result->shader;
    uint32_t wanted = shader->interface.light_members
                          .items[shader->interface.lights.items[light].first_member + member];
    for (uint32_t i = shader->interface.first_of_block[BLOCK_LIGHT_DATA];
         i < shader->interface.first_of_block[BLOCK_LIGHT_DATA + 1]; i++)
        if (shader->interface.used.items[i] == wanted)
            return i;
    return MXG_NONE;
}
