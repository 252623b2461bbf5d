// SPDX-License-Identifier: Apache-2.0
/* The reflection as JSON (docs/reflection.md). Fields that say nothing are left out. */
#include "shader/shader.h"

#include <math.h>

struct json {
    const struct shader *shader;
    const struct shader_reflect_options *options;
    struct text *out;
    unsigned depth;
    bool first; /* nothing stands yet in the object or array at hand */
};

/* ---- Writing ---- */

static void begin_item(struct json *json)
{
    text_str(json->out, json->first ? "\n" : ",\n");
    for (unsigned i = 0; i < json->depth; i++)
        text_mem(json->out, "  ", 2);
    json->first = false;
}

static void open(struct json *json, char bracket)
{
    text_char(json->out, bracket);
    json->depth++;
    json->first = true;
}

static void close(struct json *json, char bracket)
{
    json->depth--;
    if (!json->first) {
        json->first = true;
        begin_item(json);
    }
    text_char(json->out, bracket);
    json->first = false;
}

static void key(struct json *json, const char *name)
{
    begin_item(json);
    text_json_string(json->out, name, strlen(name));
    text_mem(json->out, ": ", 2);
}

static void put_string(struct json *json, const char *name, const char *value)
{
    if (!value || !*value)
        return;
    key(json, name);
    text_json_string(json->out, value, strlen(value));
}

static void put_id(struct json *json, const char *name, str_id value)
{
    put_string(json, name, str_text(json->shader->strings, value));
}

static void put_number(struct json *json, const char *name, uint32_t value)
{
    key(json, name);
    text_u32(json->out, value);
}

static void put_nonzero(struct json *json, const char *name, uint32_t value)
{
    if (value)
        put_number(json, name, value);
}

static void put_bool(struct json *json, const char *name, bool value)
{
    key(json, name);
    text_str(json->out, value ? "true" : "false");
}

/* JSON has no word for infinities and NaN. */
static void write_scalar(struct text *out, ir_type_id scalar, union ir_word word)
{
    if (scalar == IR_TYPE_BOOL)
        text_str(out, word.u ? "true" : "false");
    else if (scalar == IR_TYPE_INT)
        text_i32(out, word.i);
    else if (scalar == IR_TYPE_UINT)
        text_u32(out, word.u);
    else if (!isfinite(word.f))
        text_str(out, "null");
    else
        text_float(out, word.f);
}

static void put_value(struct json *json, const char *name, const struct ir_value *value)
{
    const struct ir_type_info *info = ir_type_info(value->type);
    key(json, name);
    if (info->components > 1)
        text_char(json->out, '[');
    for (unsigned i = 0; i < info->components; i++) {
        if (i)
            text_mem(json->out, ", ", 2);
        write_scalar(json->out, info->scalar, value->w[i]);
    }
    if (info->components > 1)
        text_char(json->out, ']');
}

/* ---- Variables ---- */

static const char *const stage_names[NUM_STAGES] = {"vertex", "pixel"};

static void put_stages(struct json *json, uint8_t stages)
{
    key(json, "stages");
    text_char(json->out, '[');
    for (int stage = 0, n = 0; stage < NUM_STAGES; stage++)
        if (stages >> stage & 1)
            text_fmt(json->out, "%s\"%s\"", n++ ? ", " : "", stage_names[stage]);
    text_char(json->out, ']');
}

static void put_place(struct json *json, const struct shader_variable *variable)
{
    switch ((enum shader_block)variable->block) {
    case BLOCK_PUBLIC_UNIFORMS:
    case BLOCK_PRIVATE_UNIFORMS:
    case BLOCK_LIGHT_DATA:
        if (!json->shader->buffers[variable->block].size)
            return;
        put_number(json, "offset", variable->offset);
        put_number(json, "size", variable->size);
        put_nonzero(json, "arrayStride", variable->array_stride);
        put_nonzero(json, "matrixStride", variable->matrix_stride);
        break;
    case BLOCK_TEXTURES:
        if (json->shader->numbered) {
            put_number(json, "set", variable->set);
            put_number(json, "binding", variable->binding);
        }
        break;
    default:
        if (json->shader->numbered)
            put_number(json, "location", variable->location);
    }
}

static void put_ui(struct json *json, const struct shader_variable *variable)
{
    struct shader_ui ui = {0};
    if (!json->options->ui)
        return;
    json->options->ui(json->options->user_data, variable, &ui);
    const struct {
        const char *key, *value;
    } fields[] = {
        {"name", ui.name},         {"folder", ui.folder},    {"min", ui.min},
        {"max", ui.max},           {"softMin", ui.soft_min}, {"softMax", ui.soft_max},
        {"step", ui.step},         {"doc", ui.doc},          {"enum", ui.enum_names},
        {"enumValues", ui.enum_values},
    };
    bool any = ui.advanced;
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        any |= fields[i].value && *fields[i].value;
    if (!any)
        return;
    key(json, "ui");
    open(json, '{');
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        put_string(json, fields[i].key, fields[i].value);
    if (ui.advanced)
        put_bool(json, "advanced", true);
    close(json, '}');
}

static void put_sampling(struct json *json, const struct shader_sampling *sampling)
{
    put_id(json, "uaddressmode", sampling->uaddressmode);
    put_id(json, "vaddressmode", sampling->vaddressmode);
    put_id(json, "filtertype", sampling->filtertype);
    put_id(json, "layer", sampling->layer);
    put_id(json, "framerange", sampling->framerange);
    if (sampling->frameoffset) {
        key(json, "frameoffset");
        text_fmt(json->out, "%d", sampling->frameoffset);
    }
    put_id(json, "frameendaction", sampling->frameendaction);
}

static void put_tiles(struct json *json, const struct shader_variable *variable)
{
    if (!variable->num_tiles)
        return;
    key(json, "tiles");
    open(json, '[');
    for (uint32_t i = 0; i < variable->num_tiles; i++) {
        const struct shader_tile *tile = &json->shader->tiles.items[variable->first_tile + i];
        begin_item(json);
        open(json, '{');
        put_id(json, "file", tile->file);
        key(json, "offset");
        text_fmt(json->out, "[%d, %d]", tile->u, tile->v);
        close(json, '}');
    }
    close(json, ']');
}

static void put_variable(struct json *json, const struct shader_variable *variable)
{
    begin_item(json);
    open(json, '{');
    put_id(json, "name", variable->name);
    put_string(json, "type", ir_type_text(variable->type));
    put_nonzero(json, "arrayLength", variable->array_length);
    put_stages(json, variable->stages);
    put_id(json, "path", variable->path);
    put_id(json, "documentType", variable->doc_type);
    put_id(json, "semantic", variable->semantic);
    put_id(json, "colorspace", variable->colorspace);
    put_id(json, "unit", variable->unit);
    put_id(json, "unittype", variable->unittype);
    if (variable->has_default)
        put_value(json, "default", &variable->value);
    if (variable->flat)
        put_bool(json, "flat", true);
    put_place(json, variable);
    put_id(json, "file", variable->file);
    put_sampling(json, &variable->sampling);
    put_tiles(json, variable);
    put_ui(json, variable);
    close(json, '}');
}

static bool is_used(const struct shader *shader, enum shader_block block)
{
    for (uint32_t i = 0; i < shader->interface.len; i++)
        if (shader->variables.items[shader->interface.items[i]].block == block)
            return true;
    return false;
}

static void put_block(struct json *json, enum shader_block block)
{
    const struct shader *shader = json->shader;
    const struct shader_buffer *buffer = &shader->buffers[block];
    if (!is_used(shader, block))
        return;
    begin_item(json);
    open(json, '{');
    put_string(json, "name", shader_block_name(block));
    if (buffer->size) {
        if (shader->numbered) {
            put_number(json, "set", buffer->set);
            put_number(json, "binding", buffer->binding);
        }
        put_number(json, "size", buffer->size);
    }
    if (block == BLOCK_LIGHT_DATA) {
        put_number(json, "arrayLength", shader->max_lights);
        put_nonzero(json, "arrayStride", buffer->stride);
    }
    key(json, "variables");
    open(json, '[');
    for (uint32_t i = 0; i < shader->interface.len; i++) {
        const struct shader_variable *variable = &shader->variables.items[shader->interface.items[i]];
        if (variable->block == block)
            put_variable(json, variable);
    }
    close(json, ']');
    close(json, '}');
}

/* ---- The rest ---- */

static void put_compiled(struct json *json)
{
    key(json, "compiledInputs");
    open(json, '[');
    for (uint32_t i = 0; i < json->shader->compiled.len; i++) {
        const struct shader_compiled_input *input = &json->shader->compiled.items[i];
        begin_item(json);
        open(json, '{');
        put_id(json, "path", input->path);
        put_id(json, "documentType", input->doc_type);
        put_id(json, "value", input->value);
        close(json, '}');
    }
    close(json, ']');
}

static void put_lights(struct json *json)
{
    const struct shader *shader = json->shader;
    if (!is_used(shader, BLOCK_LIGHT_DATA))
        return;
    key(json, "lights");
    open(json, '[');
    for (uint32_t i = 0; i < shader->lights.len; i++) {
        const struct shader_light *light = &shader->lights.items[i];
        begin_item(json);
        open(json, '{');
        put_number(json, "type", (uint32_t)light->type);
        put_id(json, "function", lang_function(shader->unit, light->function, NULL)->name);
        key(json, "members");
        open(json, '[');
        for (uint32_t m = 0; m < light->num_members; m++) {
            str_id name = shader->variables.items[shader->light_members.items[light->first_member + m]].name;
            begin_item(json);
            text_json_string(json->out, str_text(shader->strings, name), str_len(shader->strings, name));
        }
        close(json, ']');
        close(json, '}');
    }
    close(json, ']');
}

static void put_functions(struct json *json)
{
    key(json, "functions");
    open(json, '{');
    for (int stage = 0; stage < NUM_STAGES; stage++) {
        const struct lang_reach *reach = &json->shader->stages[stage].reach;
        if (!reach->functions.len)
            continue;
        key(json, stage_names[stage]);
        open(json, '[');
        for (uint32_t i = 0; i < reach->functions.len; i++) {
            str_id name = lang_function(json->shader->unit, reach->functions.items[i], NULL)->name;
            begin_item(json);
            text_json_string(json->out, str_text(json->shader->strings, name), str_len(json->shader->strings, name));
        }
        close(json, ']');
    }
    close(json, '}');
}

void shader_reflect_json(const struct shader *shader, const struct shader_reflect_options *options, struct text *out)
{
    struct json json = {.shader = shader, .options = options, .out = out};
    open(&json, '{');
    put_id(&json, "name", shader->name);
    put_id(&json, "path", shader->path);
    put_id(&json, "element", shader->element_type);
    put_string(&json, "target", options->target);
    put_string(&json, "generator", options->generator);
    key(&json, "topology");
    text_char(out, '"');
    text_hex64(out, shader_topology(shader, out->arena));
    text_char(out, '"');
    put_number(&json, "closures", shader->num_closures);
    put_bool(&json, "transparent", shader->transparent);
    if (shader->alpha != ALPHA_OPAQUE)
        put_string(&json, "alpha", shader->alpha == ALPHA_MASK ? "mask" : "blend");
    if (shader->displaced)
        put_bool(&json, "displaced", true);
    put_bool(&json, "lit", shader->lit);
    key(&json, "blocks");
    open(&json, '[');
    for (int block = 0; block < NUM_BLOCKS; block++)
        put_block(&json, (enum shader_block)block);
    close(&json, ']');
    put_lights(&json);
    put_functions(&json);
    put_compiled(&json);
    close(&json, '}');
    text_char(out, '\n');
}
