// SPDX-License-Identifier: Apache-2.0
/*
 * The reflection of a shader: variables, facts; and its JSON form.
 */
#include "api/generation.h"
#include "base/hash.h"

#include <assert.h>

static const char *text_of(const mxg_result *result, str_id id)
{
    return str_text(&result->strings, id);
}

/* ---- Files ---- */

uint32_t mxg_result_num_files(const mxg_result *result)
{
    return result ? result->files.len : 0;
}

const char *mxg_result_file(const mxg_result *result, uint32_t index)
{
    return index < mxg_result_num_files(result) ? result->files.items[index] : NULL;
}

/* ---- Variables ---- */

uint32_t mxg_result_num_variables(const mxg_result *result)
{
    return result && result->has_shader ? result->shader.interface.used.len : 0;
}

/*
 * True if an input of a graph takes a UI attribute from the node input that it connects to. Ranges
 * apply; names and descriptions such as "left operand" do not.
 */
static bool is_inherited(const struct document *doc, elem_id input, str_id attr)
{
    bool is_of_graph =
        input && doc_element(doc, doc_element(doc, input)->parent)->kind == KIND_NODEGRAPH;
    return !is_of_graph
           || (attr != STR_doc && attr != STR_uiname && attr != STR_uifolder
               && attr != STR_uiadvanced);
}

/* An attribute of the document's input, else of the definition's. */
static const char *ui_text(const mxg_result *result, elem_id input, elem_id definition, str_id attr)
{
    const struct document *doc = &result->document->layer.doc;
    str_id value = input ? doc_attr_value(doc, input, attr) : 0;
    if (!value && definition && is_inherited(doc, input, attr))
        value = doc_attr_value(doc, definition, attr);
    return text_of(result, value);
}

void result_input_ui(const mxg_result *result, elem_id element, elem_id definition,
                     struct shader_ui *out)
{
    const struct document *doc = &result->document->layer.doc;
    /* texts of a node are not those of its inputs */
    elem_id input = element && doc_element(doc, element)->kind != KIND_NODE ? element : 0;
#define UI(member, attribute, key) \
    out->member = ui_text(result, input, definition, STR_##attribute);
#include "shader/ui.def"
#undef UI
    out->advanced = strcmp(ui_text(result, input, definition, STR_uiadvanced), "true") == 0;
}

void result_ui(void *user_data, const struct shader_variable *variable, struct shader_ui *out)
{
    result_input_ui(user_data, variable->element, variable->definition, out);
}

static void set_user_interface(const mxg_result *result, const struct shader_variable *variable,
                               mxg_variable *out)
{
    struct shader_ui ui;
    result_ui((void *)(uintptr_t)result, variable, &ui);
#define UI(member, attribute, key) out->member = ui.member;
#include "shader/ui.def"
#undef UI
    out->advanced = ui.advanced;
}

static void set_default(const struct shader_variable *variable, mxg_variable *out)
{
    if (!variable->has_default || variable->value.type >= IR_NUM_TYPES)
        return;
    const struct ir_type_info *info = ir_type_info(variable->value.type);
    out->num_values = info->components;
    out->integer = info->scalar == IR_TYPE_FLOAT ? 0 : variable->value.w[0].i;
    assert(out->num_values <= sizeof out->values / sizeof *out->values);
    for (uint32_t i = 0; i < out->num_values && i < 16; i++) {
        union ir_word word = variable->value.w[i];
        out->values[i] = info->scalar == IR_TYPE_FLOAT ? word.f
                         : info->scalar == IR_TYPE_INT ? (float)word.i
                                                       : (float)word.u;
    }
}

mxg_status mxg_result_variable(const mxg_result *result, uint32_t index, mxg_variable *out)
{
    _Static_assert((int)MXG_BLOCK_OUTPUTS == BLOCK_OUTPUTS && (int)MXG_BLOCK_OWN_1 == BLOCK_OWN
                       && (int)MXG_NUM_BLOCKS == NUM_BLOCKS,
                   "blocks have the same numbers");
    if (index >= mxg_result_num_variables(result))
        return MXG_ERROR_ARGUMENT;
    const struct shader_variable *v = result_variable(result, index);
    assert(v->block < NUM_BLOCKS);
    const struct lang_syntax *syntax = result->target->syntax;
    const char *block_type = shader_block_type(&result->shader, syntax, v);
    mxg_variable full = {
        .name = text_of(result, v->name),
        .block = (mxg_block)v->block,
        .stages = v->stages,
        .type = block_type ? block_type : lang_syntax_type(syntax, v->type),
        .document_type = text_of(result, v->doc_type),
        .path = text_of(result, v->path),
        .slot = text_of(result, v->slot),
        .semantic = text_of(result, v->semantic),
        .colorspace = text_of(result, v->colorspace),
        .unit = text_of(result, v->unit),
        .array_length = v->array_length,
        .set = v->set,
        .binding = v->binding,
        .location = v->location,
        .offset = v->offset,
        .byte_size = v->size,
        .array_stride = v->array_stride,
        .matrix_stride = v->matrix_stride,
        .file = text_of(result, v->file),
        .origin = v->origin ? text_of(result, v->origin)
                  : v->file ? mxg_document_file(result->document, 0)
                            : "",
        .uaddressmode = text_of(result, v->sampling.uaddressmode),
        .vaddressmode = text_of(result, v->sampling.vaddressmode),
        .filtertype = text_of(result, v->sampling.filtertype),
        .layer = text_of(result, v->sampling.layer),
        .framerange = text_of(result, v->sampling.framerange),
        .frameendaction = text_of(result, v->sampling.frameendaction),
        .frameoffset = v->sampling.frameoffset,
        .num_tiles = v->num_tiles,
        .unittype = text_of(result, v->unittype),
        .flat = v->flat,
        .sampler_binding = v->sampler_binding,
    };
    set_default(v, &full);
    set_user_interface(result, v, &full);
    return struct_write(out, &full, sizeof full);
}

static const struct shader_tile *tile_at(const mxg_result *result, uint32_t variable, uint32_t tile)
{
    if (variable >= mxg_result_num_variables(result)
        || tile >= result_variable(result, variable)->num_tiles)
        return NULL;
    assert(result_variable(result, variable)->first_tile + tile
           < result->shader.interface.tiles.len);
    return &result->shader.interface.tiles
                .items[result_variable(result, variable)->first_tile + tile];
}

mxg_status mxg_result_tile(const mxg_result *result, uint32_t variable, uint32_t index,
                           mxg_tile *out)
{
    const struct shader_tile *tile = tile_at(result, variable, index);
    if (!tile)
        return MXG_ERROR_ARGUMENT;
    mxg_tile full = {.file = text_of(result, tile->file), .u = tile->u, .v = tile->v};
    return struct_write(out, &full, sizeof full);
}

size_t mxg_result_texture_file(const mxg_result *result, uint32_t variable, uint32_t tile,
                               int32_t frame, char *out, size_t capacity)
{
    if (out && capacity)
        *out = '\0';
    if (variable >= mxg_result_num_variables(result))
        return 0;
    const struct shader_variable *v = result_variable(result, variable);
    const struct shader_tile *part = tile_at(result, variable, tile);
    if (v->num_tiles && !part)
        return 0;
    const struct frame_sequence sequence = {text_of(result, v->sampling.framerange),
                                            text_of(result, v->sampling.frameendaction),
                                            v->sampling.frameoffset};
    return frame_file(text_of(result, part ? part->file : v->file), &sequence, frame, out,
                      capacity);
}

uint32_t mxg_result_find_variable(const mxg_result *result, const char *path)
{
    uint32_t count = mxg_result_num_variables(result);
    str_id id = count && path ? str_find(&result->strings, path, strlen(path)) : 0;
    for (uint32_t i = 0; id && i < count; i++)
        if (result_variable(result, i)->path == id)
            return i;
    return MXG_NONE;
}

/* ---- The shader as a whole ---- */

static uint32_t count_textures(const mxg_result *result)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < result->shader.interface.used.len; i++)
        count += result_variable(result, i)->block == BLOCK_TEXTURES;
    return count;
}

/* Nodes in C count with their versions, because hosts keep shaders by their topology. */
static uint64_t network_topology(const mxg_result *result)
{
    uint64_t topology = result->target->network->topology(&result->network);
    return result->shader.reflection.codes ? hash_mix(topology, result->shader.reflection.codes)
                                           : topology;
}

/* Passes differ in texts of their own. */
static uint64_t topology_of(const mxg_result *result, struct arena *scratch)
{
    const struct stage_source *source = &result->stages[STAGE_PIXEL];
    if (role_is_pass(result->shader.role))
        return hash_stable(HASH_STABLE_SEED, source->text, source->size);
    return result->network.arena ? network_topology(result)
                                 : shader_topology(&result->shader, scratch);
}

static void write_topology(const struct object *object, struct text *out)
{
    const mxg_result *result = (const mxg_result *)object;
    uint64_t topology = topology_of(result, out->arena);
    text_mem(out, (const char *)&topology, sizeof topology);
}

bool result_topology(const mxg_result *result, uint64_t *out_topology)
{
    const struct made_text *topology = object_text(&result->object, TEXT_TOPOLOGY, write_topology);
    if (!topology)
        return false;
    assert(topology->size == sizeof *out_topology);
    memcpy(out_topology, topology->data, sizeof *out_topology);
    return true;
}

mxg_status mxg_result_info(const mxg_result *result, mxg_shader_info *out)
{
    if (!result || !result->has_shader)
        return MXG_ERROR_ARGUMENT;
    const struct shader *shader = &result->shader;
    bool has_light_data =
        shader->stages[STAGE_PIXEL].has_lights && shader->lights == LIGHTS_IN_SHADER;
    mxg_shader_info full = {
        .name = text_of(result, shader->reflection.name),
        .path = text_of(result, shader->reflection.path),
        .target = result->target->name,
        .num_closures = shader->reflection.closures.len,
        .num_textures = count_textures(result),
        .num_lights = has_light_data ? shader->interface.max_lights : 0,
        .transparent = shader->reflection.transparent,
        .alpha = (mxg_alpha)shader->reflection.alpha,
        .displaced = shader->reflection.displaced,
        .function = shader->reflection.function,
        .function_type = shader->reflection.function_type,
        .device_features = shader->reflection.device_features,
        .lit = shader->reflection.lit,
    };
    /* only the topology is expensive */
    if (out && out->size > offsetof(mxg_shader_info, topology)
        && !result_topology(result, &full.topology))
        return MXG_ERROR_MEMORY;
    return struct_write(out, &full, sizeof full);
}

uint32_t mxg_result_num_host_functions(const mxg_result *result)
{
    return result && result->has_shader ? result->shader.reflection.host_functions.len : 0;
}

const char *mxg_result_host_function(const mxg_result *result, uint32_t index)
{
    return index < mxg_result_num_host_functions(result)
               ? text_of(result, result->shader.reflection.host_functions.items[index])
               : NULL;
}

/* ---- JSON ---- */

static void write_json(const struct object *object, struct text *out)
{
    const mxg_result *result = (const mxg_result *)object;
    struct shader_reflect_options options = {
        .target = result->target->name,
        .generator = GENERATOR_NAME,
        .topology = topology_of(result, out->arena),
        .user_data = (void *)(uintptr_t)result,
        .ui = result_ui,
        .compiled = result_compiled,
        .more = result_storage,
    };
    if (result->network.arena) {
        options.network = &result->network;
        options.reflect_network = result->target->network->reflect;
    }
    shader_reflect_json(&result->shader, &options, out);
}

const char *mxg_result_reflection_json(const mxg_result *result, size_t *out_size)
{
    const struct made_text *made = result && result->has_shader
                                       ? object_text(&result->object, TEXT_REFLECTION, write_json)
                                       : NULL;
    if (out_size)
        *out_size = made ? made->size : 0;
    return made ? made->data : NULL;
}
