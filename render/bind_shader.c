// SPDX-License-Identifier: Apache-2.0
#include "render/bind_shader.h"

#include "program/memory.h"
#include "render/prefilter.h"
#include "render/stored.h"
#include "render/twins.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAX_COMPONENTS 16
#define STD140_ROUND 16u
#define INTEGER_ATTRIBUTE 3 /* what every integer attribute is */

bool bind_fail_as(struct bind *bind, const char *id, const char *format, ...)
{
    va_list args;
    bind->id = id;
    va_start(args, format);
    vsnprintf(bind->reason, sizeof bind->reason, format, args);
    va_end(args);
    return false;
}

static uint32_t num_variables(const struct bind *bind)
{
    return bind->variables ? bind->num_variables
           : bind->program ? bind->program->num_variables
                           : mxg_result_num_variables(bind->result);
}

static mxg_variable read_variable(const struct bind *bind, uint32_t index)
{
    mxg_variable variable = {sizeof variable};
    if (bind->program)
        return bind->program->variables[index];
    mxg_result_variable(bind->result, index, &variable);
    return variable;
}

static mxg_variable get_variable(const struct bind *bind, uint32_t index)
{
    return bind->variables ? bind->variables[index] : read_variable(bind, index);
}

static mxg_shader_info get_info(const struct bind *bind)
{
    mxg_shader_info info = {sizeof info};
    if (bind->program)
        info.num_lights = bind->program->num_lights;
    else
        mxg_result_info(bind->result, &info);
    return info;
}

/* ---- Types by name ---- */

enum { NUM_FAMILIES = 3 }; /* languages that share names: of GLSL, of HLSL, and WGSL */

struct shape {
    const char *names[NUM_FAMILIES];
    unsigned columns, rows;
    bool is_float;
};

static const struct shape shapes[] = {
    {{"float", "float", "f32"}, 1, 1, true},       {{"vec2", "float2", "vec2f"}, 1, 2, true},
    {{"vec3", "float3", "vec3f"}, 1, 3, true},     {{"vec4", "float4", "vec4f"}, 1, 4, true},
    {{"mat2", "float2x2", "mat2x2f"}, 2, 2, true}, {{"mat3", "float3x3", "mat3x3f"}, 3, 3, true},
    {{"mat4", "float4x4", "mat4x4f"}, 4, 4, true}, {{"int", "int", "i32"}, 1, 1, false},
    {{"ivec2", "int2", "vec2i"}, 1, 2, false},     {{"ivec3", "int3", "vec3i"}, 1, 3, false},
    {{"ivec4", "int4", "vec4i"}, 1, 4, false},     {{"uint", "uint", "u32"}, 1, 1, false},
    {{"bool", "bool", "bool"}, 1, 1, false},
};

static const struct shape *find_shape(const char *type)
{
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; ++i)
        for (size_t k = 0; k < NUM_FAMILIES; ++k)
            if (strcmp(type, shapes[i].names[k]) == 0)
                return &shapes[i];
    return NULL;
}

/* ---- Blocks ---- */

static struct draw_block *find_block(struct draw *draw, uint32_t set, uint32_t binding)
{
    for (uint32_t i = 0; i < draw->num_blocks; ++i) {
        if (draw->blocks[i].set == set && draw->blocks[i].binding == binding)
            return &draw->blocks[i];
    }
    return NULL;
}

static uint32_t round_up(uint32_t value)
{
    return (value + STD140_ROUND - 1) / STD140_ROUND * STD140_ROUND;
}

/* Makes the block of a variable large enough for it. */
static bool reserve(struct bind *bind, const mxg_variable *variable)
{
    struct draw *draw = &bind->draw;
    if (variable->set >= DRAW_MAX_SETS)
        return bind_fail(bind, "'%s' is in descriptor set %u", variable->name, variable->set);
    struct draw_block *block = find_block(draw, variable->set, variable->binding);
    if (!block) {
        if (draw->num_blocks == DRAW_MAX_BLOCKS)
            return bind_fail(bind, "the shader has more than %u uniform blocks", DRAW_MAX_BLOCKS);
        block = &draw->blocks[draw->num_blocks++];
        *block = (struct draw_block){variable->set, variable->binding, 0};
    }
    uint32_t end = variable->offset + variable->byte_size;
    if (variable->block == MXG_BLOCK_LIGHT_DATA) /* an array of structures */
        end += (bind->max_lights - 1) * bind->light_stride;
    if (round_up(end) > block->size)
        block->size = round_up(end);
    return true;
}

/* The array of lights is alone in a block: the last member decides. */
static uint32_t stride_of_lights(const struct bind *bind)
{
    uint32_t stride = 0;
    for (uint32_t i = 0; i < num_variables(bind); ++i) {
        const mxg_variable variable = get_variable(bind, i);
        uint32_t end = round_up(variable.offset + variable.byte_size);
        if (variable.block == MXG_BLOCK_LIGHT_DATA && end > stride)
            stride = end;
    }
    return stride;
}

/* Metal's booleans have one byte, the first of an integer in memory. */
static size_t word_size(const mxg_variable *variable)
{
    return variable->byte_size == 1 ? 1 : sizeof(float);
}

static void store(unsigned char *at, const mxg_variable *variable, const float *values)
{
    const struct shape *shape = find_shape(variable->type);
    for (unsigned c = 0; shape && c < shape->columns; ++c) {
        for (unsigned r = 0; r < shape->rows; ++r) {
            float value = values[c * shape->rows + r];
            int32_t integer = (int32_t)value;
            const void *word = shape->is_float ? (const void *)&value : &integer;
            memcpy(at + (size_t)c * (shape->columns > 1 ? variable->matrix_stride : 0)
                       + r * sizeof(float),
                   word, word_size(variable));
        }
    }
}

static unsigned char *address(struct bind *bind, uint32_t object, const mxg_variable *variable)
{
    struct draw *draw = &bind->draw;
    size_t block = (size_t)(find_block(draw, variable->set, variable->binding) - draw->blocks);
    return draw->objects[object].blocks[block] + variable->offset;
}

/*
 * Finite numbers as in documents, separated by commas or spaces; "true" is 1. Returns their number;
 * 0 for other text.
 */
static unsigned parse_numbers(const char *text, float values[MAX_COMPONENTS])
{
    unsigned count = 0;
    if (strcmp(text, "true") == 0 || strcmp(text, "false") == 0) {
        values[0] = text[0] == 't' ? 1.0f : 0.0f;
        return 1;
    }
    for (text += strspn(text, ", "); *text && count < MAX_COMPONENTS; text += strspn(text, ", ")) {
        char *end;
        values[count] = strtof(text, &end);
        if (end == text || !isfinite(values[count]))
            return 0;
        ++count;
        text = end;
    }
    return *text ? 0 : count;
}

/* The user's text as a value of the variable. */
static bool parse_value(const char *text, const struct shape *shape, float values[MAX_COMPONENTS])
{
    const float limit = 2147483648.0f; /* of an integer */
    unsigned count = shape->columns * shape->rows;
    if (parse_numbers(text, values) != count)
        return false;
    for (unsigned i = 0; i < count && !shape->is_float; ++i)
        if (values[i] != floorf(values[i]) || values[i] < -limit || values[i] >= limit)
            return false;
    return true;
}

const char *bind_user_value(const struct bind *bind, const mxg_variable *variable)
{
    const char *text = NULL;
    for (size_t i = 0; i < bind->num_values; ++i) {
        if (strcmp(bind->values[i].path, variable->path) == 0)
            text = bind->values[i].text;
    }
    return text;
}

static bool store_public(struct bind *bind, uint32_t object, const mxg_variable *variable)
{
    float values[MAX_COMPONENTS];
    memcpy(values, variable->values, sizeof values);
    const char *text = bind_user_value(bind, variable);
    const struct shape *shape = find_shape(variable->type);
    if (tints_is_number(variable)) {
        values[0] = (float)tints_find(bind->tints, text ? text : variable->file);
        text = NULL;
    }
    if (!shape)
        return bind_fail(bind, "'%s' has a type that cannot be bound: %s", variable->name,
                         variable->type);
    if (text && !parse_value(text, shape, values))
        return bind_fail_as(bind, "bad-value", "'%s' is not a value of '%s', which is a %s", text,
                            variable->path, variable->type);
    store(address(bind, object, variable), variable, values);
    return true;
}

static void store_private(struct bind *bind, uint32_t object, const mxg_variable *variable)
{
    float values[MAX_COMPONENTS] = {0};
    char buffer[SCENE_MAX_NAME];
    const char *name = scene_name(variable->name, variable->semantic, buffer);
    bool is_there = scene_uniform(bind->scene, &bind->objects[object], name, values) != 0;
    if (!is_there && variable->num_values)
        memcpy(values, variable->values, sizeof values);
    if (!is_there && name == buffer)
        bind_note_lack(bind, object, variable);
    if (strcmp(variable->name, "u_numActiveLightSources") == 0
        && values[0] > (float)bind->max_lights)
        values[0] = (float)bind->max_lights;
    store(address(bind, object, variable), variable, values);
}

/* "u_lightData[2].color": the name of the member, or NULL where the path is none of a light. */
static const char *light_member(const char *path, uint32_t *out_light)
{
    static const char array[] = "u_lightData[";
    if (strncmp(path, array, sizeof array - 1) != 0)
        return NULL;
    char *end;
    unsigned long light = strtoul(path + sizeof array - 1, &end, 10);
    *out_light = light < SCENE_NUM_LIGHTS ? (uint32_t)light : UINT32_MAX;
    return strncmp(end, "].", 2) == 0 ? end + 2 : NULL;
}

/* Returns what the user says of a light's member; NULL: nothing. */
static const struct bind_value *light_value(const struct bind *bind, uint32_t light,
                                            const char *member)
{
    const struct bind_value *found = NULL;
    for (size_t i = 0; i < bind->num_values; ++i) {
        uint32_t number;
        const char *name = light_member(bind->values[i].path, &number);
        if (name && number == light && strcmp(name, member) == 0)
            found = &bind->values[i];
    }
    return found;
}

static bool store_lights(struct bind *bind, uint32_t object, const mxg_variable *variable)
{
    const struct shape *shape = find_shape(variable->type);
    const char *member = *variable->semantic ? variable->semantic : variable->name;
    uint32_t num_lights = bind->scene->num_lights;
    if (num_lights < SCENE_NUM_LIGHTS)
        num_lights = SCENE_NUM_LIGHTS; /* those that the user may switch on */
    for (uint32_t i = 0; i < num_lights && i < bind->max_lights; ++i) {
        float values[MAX_COMPONENTS] = {0};
        if (!scene_light(bind->scene, i, member, values) && variable->num_values)
            memcpy(values, variable->values, sizeof values);
        const struct bind_value *said = light_value(bind, i, variable->name);
        if (said && (!shape || !parse_value(said->text, shape, values)))
            return bind_fail_as(bind, "bad-value", "'%s' is not a value of '%s', which is a %s",
                                said->text, said->path, variable->type);
        store(address(bind, object, variable) + (size_t)i * bind->light_stride, variable, values);
    }
    return true;
}

/* mxgen's own uniforms, and those of nodes in C. */
static bool is_private(const mxg_variable *variable)
{
    return variable->block == MXG_BLOCK_PRIVATE_UNIFORMS || variable->block >= MXG_BLOCK_OWN_1;
}

static bool is_uniform(const mxg_variable *variable)
{
    return variable->block == MXG_BLOCK_PUBLIC_UNIFORMS || is_private(variable)
           || variable->block == MXG_BLOCK_LIGHT_DATA;
}

static bool make_blocks(struct bind *bind)
{
    if (!bind->light_stride)
        bind->light_stride = stride_of_lights(bind);
    for (uint32_t i = 0; i < num_variables(bind); ++i) {
        mxg_variable variable = get_variable(bind, i);
        if (is_uniform(&variable) && !reserve(bind, &variable))
            return false;
    }
    for (uint32_t o = 0; o < bind->num_objects; ++o)
        for (uint32_t i = 0; i < bind->draw.num_blocks; ++i)
            bind->draw.objects[o].blocks[i] = memory_alloc(bind->draw.blocks[i].size);
    return true;
}

/* Uniforms that are not private are equal for all objects: the others copy them from the first. */
static bool fill_blocks(struct bind *bind, uint32_t object)
{
    for (uint32_t i = 0; object && i < bind->draw.num_blocks; ++i)
        memcpy(bind->draw.objects[object].blocks[i], bind->draw.objects[0].blocks[i],
               bind->draw.blocks[i].size);
    for (uint32_t i = 0; i < num_variables(bind); ++i) {
        const mxg_variable variable = get_variable(bind, i);
        if (is_private(&variable))
            store_private(bind, object, &variable);
        if (object)
            continue;
        if (variable.block == MXG_BLOCK_PUBLIC_UNIFORMS && !store_public(bind, object, &variable))
            return false;
        if (variable.block == MXG_BLOCK_LIGHT_DATA && !store_lights(bind, object, &variable))
            return false;
    }
    return true;
}

/* ---- Textures ---- */

static VkSamplerAddressMode address_mode(const char *name)
{
    static const struct {
        const char *name;
        VkSamplerAddressMode mode;
    } modes[] = {{"clamp", VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE},
                 {"mirror", VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT},
                 {"constant", VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER}};
    for (size_t i = 0; i < sizeof modes / sizeof *modes; ++i) {
        if (strcmp(name, modes[i].name) == 0)
            return modes[i].mode;
    }
    return VK_SAMPLER_ADDRESS_MODE_REPEAT;
}

/* An environment map: around in u, and at its end at the poles. */
static struct draw_texture environment_texture(const struct image *image)
{
    return (struct draw_texture){.image = image,
                                 .u = VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                 .v = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                 .filter = VK_FILTER_LINEAR,
                                 .has_mips = true};
}

/*
 * The directional albedo of GGX: the scene's, or made now. Its image is NULL where there is no
 * memory.
 */
static struct draw_texture albedo_texture(struct bind *bind)
{
    const struct image *image = &bind->scene->albedo;
    if (!image->pixels) {
        struct image *made = &bind->images[bind->num_images];
        image = bake_albedo_table(made) ? made : NULL;
        bind->num_images += image != NULL;
    }
    return (struct draw_texture){.image = image,
                                 .u = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                 .v = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                 .filter = VK_FILTER_LINEAR};
}

/* The scene's texture, which is there to be sampled exactly. */
static struct draw_texture test_texture(const struct image *image)
{
    return (struct draw_texture){.image = image,
                                 .bottom_first = true,
                                 .u = VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                 .v = VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                 .filter = VK_FILTER_LINEAR};
}

/* A texture of the document: its files, or the user's. Its image is NULL on failure. */
static struct draw_texture document_texture(struct bind *bind, uint32_t index,
                                            const mxg_variable *variable)
{
    struct image *image = &bind->images[bind->num_images];
    const char *file = bind_user_value(bind, variable);
    if (strncmp(variable->semantic, "geomprop_", 9) == 0)
        bind_note_lack(bind, 0, variable);
    if (!file && bind->program)
        file = variable->file;
    bool is_checker = false,
         good = bind_read_texture(bind, index, variable, file, image, &is_checker);
    bool is_closest = strcmp(variable->filtertype, "closest") == 0 || is_checker;
    bind->num_images += good;
    return (struct draw_texture){.image = good ? image : NULL,
                                 .bottom_first = true,
                                 .u = address_mode(variable->uaddressmode),
                                 .v = address_mode(variable->vaddressmode),
                                 .filter = is_closest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR,
                                 .has_mips = !is_checker};
}

static bool bind_texture(struct bind *bind, uint32_t index, const mxg_variable *variable)
{
    if (bind->draw.num_textures == DRAW_MAX_TEXTURES || variable->set >= DRAW_MAX_SETS)
        return bind_fail(bind, "the shader has more than %u textures", DRAW_MAX_TEXTURES);
    const struct scene *scene = bind->scene;
    const bool is_tints = strcmp(variable->name, "u_tints") == 0;
    const struct image *environment = scene_image(scene, variable->name);
    bool is_test = scene->texture.pixels && !variable->num_tiles;
    bool is_albedo = strcmp(variable->name, "u_albedoTable") == 0;
    struct draw_texture texture = is_albedo     ? albedo_texture(bind)
                                  : is_tints    ? test_texture(&bind->tints->image)
                                  : environment ? environment_texture(environment)
                                  : is_test     ? test_texture(&scene->texture)
                                                : document_texture(bind, index, variable);
    texture.set = variable->set;
    texture.binding = variable->binding;
    bind->draw.textures[bind->draw.num_textures++] = texture;
    return texture.image && bind_place_texture(bind, variable);
}

static bool bind_textures(struct bind *bind)
{
    for (uint32_t i = 0; i < num_variables(bind); ++i) {
        mxg_variable variable = get_variable(bind, i);
        if (variable.block == MXG_BLOCK_TEXTURES && !bind_texture(bind, i, &variable))
            return false;
    }
    return bind->checker || !bind->num_faults
           || bind_fail_as(bind, "missing-texture", "%s", bind->faults[0].reason);
}

/* ---- Attributes ---- */

static VkFormat attribute_format(const struct shape *shape)
{
    static const VkFormat floats[] = {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT,
                                      VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT};
    static const VkFormat integers[] = {VK_FORMAT_R32_SINT, VK_FORMAT_R32G32_SINT,
                                        VK_FORMAT_R32G32B32_SINT, VK_FORMAT_R32G32B32A32_SINT};
    return (shape->is_float ? floats : integers)[shape->rows - 1];
}

/* Fills the attribute that was added last for one object. */
static void fill_attribute(struct bind *bind, uint32_t object, const mxg_variable *variable,
                           const struct shape *shape)
{
    const struct scene_object *from = &bind->objects[object];
    char buffer[SCENE_MAX_NAME];
    const char *name = scene_name(variable->name, variable->semantic, buffer);
    bool is_twin = bind->draw.objects[object].twin != 0; /* only tells what it lacks */
    uint32_t count = is_twin ? 1 : from->mesh.num_vertices;
    float one[1][4], (*data)[4] = is_twin ? one : memory_alloc(count * sizeof *data);
    if (!is_twin)
        bind->draw.objects[object].attributes[bind->draw.num_attributes - 1] = data;
    bool has_primvar = bind_note_type(bind, object, name, shape->rows);
    for (uint32_t i = 0; i < count; ++i) {
        bool has_stand_in = !shape->is_float && !from->path;
        float values[4] = {INTEGER_ATTRIBUTE, INTEGER_ATTRIBUTE, INTEGER_ATTRIBUTE,
                           INTEGER_ATTRIBUTE};
        for (uint32_t k = 0; !has_stand_in && k < 4; ++k)
            values[k] = k < variable->num_values ? variable->values[k] : 0.0f;
        if (!has_stand_in && !scene_attribute(from, name, i, values) && i == 0 && !has_primvar)
            bind_note_lack(bind, object, variable);
        for (uint32_t k = 0; k < 4; ++k) {
            int32_t integer = (int32_t)values[k];
            if (shape->is_float)
                data[i][k] = values[k];
            else
                memcpy(&data[i][k], &integer, sizeof integer);
        }
    }
}

static bool bind_attribute(struct bind *bind, const mxg_variable *variable)
{
    const struct shape *shape = find_shape(variable->type);
    if (!shape || shape->columns != 1 || bind->draw.num_attributes == DRAW_MAX_ATTRIBUTES)
        return bind_fail(bind, "the attribute '%s' (%s) cannot be bound", variable->name,
                         variable->type);
    bind->draw.attributes[bind->draw.num_attributes++] =
        (struct draw_attribute){variable->location, attribute_format(shape)};
    for (uint32_t o = 0; o < bind->num_objects; ++o)
        fill_attribute(bind, o, variable, shape);
    return true;
}

uint32_t bind_unwrapped_location(const struct bind *bind)
{
    uint32_t location = 0;
    for (uint32_t i = 0; i < num_variables(bind); ++i) {
        mxg_variable variable = get_variable(bind, i);
        if (variable.block == MXG_BLOCK_APP_DATA && variable.location >= location)
            location = variable.location + 1;
    }
    return location;
}

static bool bind_unwrapped(struct bind *bind)
{
    struct draw *draw = &bind->draw;
    if (draw->num_attributes == DRAW_MAX_ATTRIBUTES)
        return bind_fail(bind, "the shader has more than %u attributes", DRAW_MAX_ATTRIBUTES);
    uint32_t at = draw->num_attributes++;
    draw->attributes[at] =
        (struct draw_attribute){bind_unwrapped_location(bind), VK_FORMAT_R32G32_SFLOAT};
    for (uint32_t o = 0; o < bind->num_objects; ++o) {
        const struct mesh *mesh = &bind->objects[o].mesh;
        if (draw->objects[o].twin)
            continue;
        float(*data)[4] = memory_alloc(mesh->num_vertices * sizeof *data);
        draw->objects[o].attributes[at] = data;
        for (uint32_t i = 0; i < mesh->num_vertices; ++i)
            memcpy(data[i], mesh->vertices[i].texcoord, sizeof mesh->vertices[i].texcoord);
    }
    return true;
}

static bool bind_attributes(struct bind *bind)
{
    for (uint32_t i = 0; i < num_variables(bind); ++i) {
        mxg_variable variable = get_variable(bind, i);
        if (variable.block == MXG_BLOCK_APP_DATA && !bind_attribute(bind, &variable))
            return false;
    }
    return !bind->unwraps || bind_unwrapped(bind);
}

static bool is_light_value(const struct bind *bind, const char *path)
{
    uint32_t light;
    const char *name = light_member(path, &light);
    for (uint32_t i = 0; name && light < bind->max_lights && i < num_variables(bind); ++i) {
        mxg_variable variable = get_variable(bind, i);
        if (variable.block == MXG_BLOCK_LIGHT_DATA && strcmp(variable.name, name) == 0)
            return true;
    }
    return false;
}

static bool is_input(const struct bind *bind, const char *path)
{
    bool found = false;
    for (uint32_t i = 0; !found && i < num_variables(bind); ++i) {
        mxg_variable variable = get_variable(bind, i);
        found = *path && strcmp(variable.path, path) == 0;
    }
    return found;
}

/* A value for an input that the shader does not have would be silently lost. */
static bool check_values(struct bind *bind)
{
    for (size_t i = 0; i < bind->num_values; ++i) {
        const char *path = bind->values[i].path;
        if (!is_input(bind, path) && !is_light_value(bind, path))
            return bind_fail_as(bind, "no-uniform", "the shader has no uniform for '%s'", path);
    }
    return true;
}

/* The variables of the shader, which are read for each object. */
static bool keep_variables(struct bind *bind)
{
    uint32_t num = num_variables(bind);
    bind->variables = memory_alloc((num + bind->num_places) * sizeof *bind->variables);
    bind->num_variables = num;
    for (uint32_t i = 0; i < num; ++i)
        bind->variables[i] = read_variable(bind, i);
    return !bind->num_places || bind_place_variables(bind);
}

static void make_objects(struct bind *bind)
{
    if (!bind->num_objects) {
        bind->objects = &bind->scene->object;
        bind->num_objects = 1;
    }
    bind->draw.objects = memory_alloc(bind->num_objects * sizeof *bind->draw.objects);
    bind->orders = memory_alloc(bind->num_objects * sizeof(uint32_t *));
    bind->draw.num_objects = bind->num_objects;
    uint32_t *twins = twins_find(bind->objects, bind->num_objects);
    for (uint32_t o = 0; o < bind->num_objects; ++o) {
        bind->draw.objects[o].twin = twins[o];
        bind->draw.objects[o].num_vertices = bind->objects[o].mesh.num_vertices;
        bind->draw.objects[o].num_indices = bind->objects[o].mesh.num_indices;
    }
    free(twins);
}

bool bind_has_semantic(const mxg_result *result, const char *semantic)
{
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_variable variable = {sizeof variable};
        mxg_result_variable(result, i, &variable);
        if (strcmp(variable.semantic, semantic) == 0)
            return true;
    }
    return false;
}

bool bind_shader(struct bind *bind)
{
    mxg_shader_info info = get_info(bind);
    bind->draw.blend = info.alpha == MXG_ALPHA_BLEND && !bind->is_opaque;
    bind->draw.blends_twice = bind->draw.blend && bind_has_semantic(bind->result, "transmittance");
    mxg_storage storage = {sizeof storage};
    mxg_result_storage(bind->result, &storage);
    bind->draw.stores_layers = storage.words > STORED_TARGETS;
    bind->max_lights = info.num_lights;
    make_objects(bind);
    return keep_variables(bind) && check_values(bind) && make_blocks(bind) && bind_textures(bind)
           && bind_attributes(bind) && bind_scene(bind);
}

/* Triangles that can be seen through come from far to near. */
static void bind_order(struct bind *bind, uint32_t index)
{
    const struct scene *scene = bind->scene;
    const struct scene_object *object = &bind->objects[index];
    struct draw_object *drawn = &bind->draw.objects[index];
    drawn->indices = object->mesh.indices;
    if (!bind->draw.blend)
        return;
    struct matrix to_mesh = matrix_inverse(object->world);
    double eye[3], centre[3], square = 0;
    mesh_centre(&object->mesh, centre);
    matrix_point(to_mesh, scene->eye, eye);
    matrix_point(object->world, centre, centre);
    for (size_t i = 0; i < 3; ++i)
        square += (centre[i] - scene->eye[i]) * (centre[i] - scene->eye[i]);
    drawn->distance = square;
    free(bind->orders[index]);
    drawn->indices = bind->orders[index] = mesh_sorted(&object->mesh, eye);
}

bool bind_scene(struct bind *bind)
{
    bool good = true;
    for (uint32_t o = 0; good && o < bind->num_objects; ++o) {
        good = fill_blocks(bind, o);
        bind_order(bind, o);
    }
    return good;
}

void bind_finish(struct bind *bind)
{
    for (uint32_t o = 0; o < bind->draw.num_objects; ++o) {
        for (uint32_t i = 0; i < bind->draw.num_attributes; ++i) /* twins have none */
            free(bind->draw.objects[o].attributes[i]);
        for (uint32_t i = 0; i < bind->draw.num_blocks; ++i)
            free(bind->draw.objects[o].blocks[i]);
        free(bind->orders[o]);
    }
    for (uint32_t i = 0; i < bind->num_images; ++i)
        image_finish(&bind->images[i]);
    free(bind->faults);
    free(bind->variables);
    free(bind->draw.objects);
    free(bind->orders);
}
