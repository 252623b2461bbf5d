// SPDX-License-Identifier: Apache-2.0
/*
 * layout: the order of the interface, byte offsets by the packing of the target's blocks, bindings
 * and locations.
 */
#include "shader/shader.h"

#include <assert.h>

/*
 * The bindings of these blocks are equal in all shaders, so that hosts can share set layouts.
 * Textures and the blocks of nodes in C follow.
 */
enum { BINDING_PRIVATE, BINDING_PUBLIC, BINDING_LIGHTS, BINDING_FIRST_TEXTURE };

enum { STD140_ROUND = 16 }; /* alignment of arrays, matrix columns and structs: a vec4 */

static uint32_t round_up(uint32_t n, uint32_t to)
{
    return (n + to - 1) / to * to;
}

/*
 * Rules 1 to 3: the alignment of a scalar is its size. Vectors of 2 and 4 align to their sizes,
 * vectors of 3 like vectors of 4. Matrices are arrays of columns.
 */
uint32_t std140_align(ir_type_id type, bool array)
{
    const struct ir_type_info *info = ir_type_info(type);
    assert(info->components > 0);
    if (array || info->columns > 1)
        return STD140_ROUND;
    return info->components == 3 ? 16 : 4u * info->components;
}

uint32_t std140_size(ir_type_id type, uint16_t array_length)
{
    const struct ir_type_info *info = ir_type_info(type);
    uint32_t size =
        info->columns > 1 ? (uint32_t)info->columns * STD140_ROUND : 4u * info->components;
    return array_length ? array_length * round_up(size, STD140_ROUND) : size;
}

static bool is_in_interface(const struct shader_variable *variable)
{
    return variable->stages && !variable->is_hosts;
}

/*
 * Gathers the blocks first, so that the sort by rank moves private variables only, which are few.
 */
static void order_interface(struct shader *shader)
{
    uint32_t starts[NUM_BLOCKS + 1] = {0}, ends[NUM_BLOCKS];
    for (uint32_t i = 0; i < shader->interface.variables.len; i++)
        starts[shader->interface.variables.items[i].block + 1] +=
            is_in_interface(&shader->interface.variables.items[i]);
    for (int block = 0; block < NUM_BLOCKS; block++) {
        ends[block] = starts[block];
        starts[block + 1] += starts[block];
    }
    memcpy(shader->interface.first_of_block, starts, sizeof starts);
    shader->interface.used.len = 0;
    uint32_t *order = vec_extend(shader->arena, &shader->interface.used, starts[NUM_BLOCKS]);
    for (uint32_t i = 0; i < shader->interface.variables.len; i++) {
        const struct shader_variable *variable = &shader->interface.variables.items[i];
        if (!is_in_interface(variable))
            continue;
        uint32_t at = ends[variable->block]++;
        for (; at > starts[variable->block]
               && shader->interface.variables.items[order[at - 1]].rank > variable->rank;
             at--)
            order[at] = order[at - 1];
        order[at] = i;
    }
    for (int block = 0; block < NUM_BLOCKS; block++)
        assert(ends[block] == starts[block + 1]);
}

/* A column of a matrix or a vector: that of 3 is as large as that of 4. */
static uint32_t metal_column(ir_type_id type)
{
    const struct ir_type_info *info = ir_type_info(type);
    uint32_t rows = ir_type_rows(type);
    return (info->scalar == IR_TYPE_BOOL ? 1u : 4u) * (rows == 3 ? 4 : rows);
}

static void place_in_struct(struct shader_buffer *buffer, struct shader_variable *variable)
{
    const uint32_t column = metal_column(variable->type),
                   columns = ir_type_info(variable->type)->columns,
                   element = column * (columns > 1 ? columns : 1);
    variable->size = element * (variable->array_length ? variable->array_length : 1);
    variable->offset = round_up(buffer->size, column);
    variable->array_stride = variable->array_length ? element : 0;
    variable->matrix_stride = columns > 1 ? column : 0;
}

static uint32_t next_offset(const struct shader_variable *variable, enum shader_packing packing,
                            uint32_t end)
{
    uint32_t align = std140_align(variable->type, variable->array_length > 0);
    bool is_vector = !variable->array_length && !ir_type_is_matrix(variable->type);
    if (packing == PACKING_STD140 || !is_vector)
        return round_up(end, align);
    return end % STD140_ROUND + variable->size > STD140_ROUND ? round_up(end, STD140_ROUND) : end;
}

static void place_in_rows(struct shader_buffer *buffer, enum shader_packing packing,
                          struct shader_variable *variable)
{
    bool array = variable->array_length > 0, matrix = ir_type_is_matrix(variable->type);
    variable->size = std140_size(variable->type, variable->array_length);
    variable->offset = next_offset(variable, packing, buffer->size);
    assert(variable->offset >= buffer->size && variable->offset % 4 == 0);
    assert(variable->block != BLOCK_LIGHT_DATA
           || variable->offset == next_offset(variable, PACKING_STD140, buffer->size));
    variable->array_stride = array ? variable->size / variable->array_length : 0;
    variable->matrix_stride = matrix ? STD140_ROUND : 0;
}

static void place_in_buffer(struct shader_buffer *buffer, enum shader_packing packing,
                            struct shader_variable *variable)
{
    if (packing == PACKING_METAL)
        place_in_struct(buffer, variable);
    else
        place_in_rows(buffer, packing, variable);
    assert(variable->offset >= buffer->size && variable->size > 0);
    variable->set = buffer->set;
    variable->binding = buffer->binding;
    buffer->size = variable->offset + variable->size;
}

/* The number of locations that a vertex attribute or a member of vertex data takes. */
static uint32_t num_locations(ir_type_id type)
{
    assert(ir_type_info(type)->columns > 0);
    return ir_type_info(type)->columns;
}

bool shader_has_locations(const struct shader *shader, enum shader_block block)
{
    const uint32_t *first = &shader->interface.first_of_block[block];
    bool are_several_outputs = block == BLOCK_OUTPUTS && first[1] - first[0] > 1
                               && shader->role->stages != STAGES_NONE
                               && !shader->interface.rules.one_stage;
    return shader->interface.rules.bindings || are_several_outputs;
}

bool shader_is_second_source(const struct shader_variable *variable)
{
    return variable->block == BLOCK_OUTPUTS && variable->semantic == STR_transmittance;
}

static void finish_buffers(struct shader *shader)
{
    for (int block = 0; block < NUM_BLOCKS; block++)
        shader->interface.buffers[block].size =
            round_up(shader->interface.buffers[block].size, STD140_ROUND);
    struct shader_buffer *lights = &shader->interface.buffers[BLOCK_LIGHT_DATA];
    lights->stride = lights->size; /* rule 9: the size of a struct is a multiple of a vec4 */
    lights->size *= shader->interface.max_lights;
}

/*
 * Long vectors come first and matrices last: std140 and constant buffers then agree on each offset.
 * Members of a struct have no packoffset, and glslang takes the size of structs in HLSL from
 * std140.
 */
static void rank_light_members(struct shader *shader)
{
    for (uint32_t i = 0; i < shader->interface.variables.len; i++) {
        struct shader_variable *variable = &shader->interface.variables.items[i];
        const struct ir_type_info *info = ir_type_info(variable->type);
        if (variable->block == BLOCK_LIGHT_DATA)
            variable->rank = info->columns > 1 ? 4 : (uint16_t)(4 - info->components);
    }
}

static void place_uniform(struct shader *shader, struct shader_variable *variable)
{
    if (shader->interface.rules.blocks)
        place_in_buffer(&shader->interface.buffers[variable->block],
                        shader->interface.rules.packing, variable);
}

/* The blocks of a shader in the order of MaterialX's generator: lights, private, public. */
static void number_blocks(struct shader *shader)
{
    static const enum shader_block order[] = {BLOCK_LIGHT_DATA, BLOCK_PRIVATE_UNIFORMS,
                                              BLOCK_PUBLIC_UNIFORMS};
    uint32_t binding = shader->interface.rules.first_binding, count = sizeof order / sizeof *order;
    for (uint32_t i = 0; i < count + MAX_OWN_BLOCKS; i++) {
        uint32_t block = i < count ? (uint32_t)order[i] : BLOCK_OWN + i - count;
        const uint32_t *first = shader->interface.first_of_block + block;
        if (first[1] > first[0])
            shader->interface.buffers[block].binding = binding++;
    }
}

/* Own blocks follow the textures. */
static void bind_own_blocks(struct shader *shader, uint32_t first_texture)
{
    const uint32_t *first = shader->interface.first_of_block;
    uint32_t textures = first[BLOCK_TEXTURES + 1] - first[BLOCK_TEXTURES],
             binding =
                 first_texture + textures * (shader->interface.rules.sampler_bindings ? 2 : 1);
    for (int block = BLOCK_OWN; block < NUM_BLOCKS; block++)
        if (first[block + 1] > first[block])
            shader->interface.buffers[block].binding = binding++;
}

static void bind_blocks(struct shader *shader)
{
    const struct shader_layout_rules *rules = &shader->interface.rules;
    const uint32_t first = rules->first_binding;
    struct shader_buffer *buffers = shader->interface.buffers;
    if (rules->own_numbers)
        number_blocks(shader);
    if (rules->own_numbers || !rules->bindings)
        return;
    for (int block = 0; block < NUM_BLOCKS; block++)
        buffers[block].set = rules->set;
    buffers[BLOCK_PRIVATE_UNIFORMS].binding = first + BINDING_PRIVATE;
    buffers[BLOCK_PUBLIC_UNIFORMS].binding = first + BINDING_PUBLIC;
    buffers[BLOCK_LIGHT_DATA].binding = first + BINDING_LIGHTS;
    bind_own_blocks(shader, first + BINDING_FIRST_TEXTURE);
}

void shader_layout(struct shader *shader)
{
    const struct shader_layout_rules *rules = &shader->interface.rules;
    if (rules->packing != PACKING_STD140)
        rank_light_members(shader);
    order_interface(shader);
    memset(shader->interface.buffers, 0, sizeof shader->interface.buffers);
    bind_blocks(shader);
    uint32_t texture = rules->first_binding + (rules->own_numbers ? 0 : BINDING_FIRST_TEXTURE),
             location[NUM_BLOCKS] = {0};
    for (uint32_t i = 0; i < shader->interface.used.len; i++) {
        struct shader_variable *variable = shader_interface_variable(shader, i);
        switch ((enum shader_block)variable->block) {
        case BLOCK_PUBLIC_UNIFORMS:
        case BLOCK_PRIVATE_UNIFORMS:
        case BLOCK_LIGHT_DATA: place_uniform(shader, variable); break;
        case BLOCK_TEXTURES:
            if (rules->bindings) {
                variable->set = rules->set;
                variable->binding = texture++;
                variable->sampler_binding = variable->binding;
                if (rules->sampler_bindings)
                    variable->sampler_binding = texture++;
            }
            break;
        default:
            if (variable->block >= BLOCK_OWN) {
                place_uniform(shader, variable);
            } else if (shader_has_locations(shader, (enum shader_block)variable->block)) {
                if (shader_is_second_source(variable))
                    break;
                variable->location = location[variable->block];
                location[variable->block] += num_locations(variable->type);
            }
            break;
        }
    }
    finish_buffers(shader);
}
