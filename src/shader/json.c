// SPDX-License-Identifier: Apache-2.0
/* The reflection as JSON (docs/reflection.md). Fields that say nothing are left out. */
#include "shader/json.h"

/* ---- Variables ---- */

static const char *const stage_names[NUM_STAGES] = {"vertex", "pixel"};

static void put_stages(struct json *json, uint8_t stages)
{
    reflect_key(json, "stages");
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
        reflect_number(json, "offset", variable->offset);
        reflect_number(json, "size", variable->size);
        reflect_nonzero(json, "arrayStride", variable->array_stride);
        reflect_nonzero(json, "matrixStride", variable->matrix_stride);
        break;
    case BLOCK_TEXTURES:
        if (json->shader->numbered) {
            reflect_number(json, "set", variable->set);
            reflect_number(json, "binding", variable->binding);
        }
        break;
    default:
        if (json->shader->numbered)
            reflect_number(json, "location", variable->location);
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
        {"name", ui.name},        {"folder", ui.folder},
        {"min", ui.min},          {"max", ui.max},
        {"softMin", ui.soft_min}, {"softMax", ui.soft_max},
        {"step", ui.step},        {"doc", ui.doc},
        {"enum", ui.enum_names},  {"enumValues", ui.enum_values},
    };
    bool any = ui.advanced;
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        any |= fields[i].value && *fields[i].value;
    if (!any)
        return;
    reflect_key(json, "ui");
    reflect_open(json, '{');
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        reflect_string(json, fields[i].key, fields[i].value);
    if (ui.advanced)
        reflect_bool(json, "advanced", true);
    reflect_close(json, '}');
}

static void put_sampling(struct json *json, const struct shader_sampling *sampling)
{
    reflect_id(json, "uaddressmode", sampling->uaddressmode);
    reflect_id(json, "vaddressmode", sampling->vaddressmode);
    reflect_id(json, "filtertype", sampling->filtertype);
    reflect_id(json, "layer", sampling->layer);
    reflect_id(json, "framerange", sampling->framerange);
    if (sampling->frameoffset) {
        reflect_key(json, "frameoffset");
        text_fmt(json->out, "%d", sampling->frameoffset);
    }
    reflect_id(json, "frameendaction", sampling->frameendaction);
}

static void put_tiles(struct json *json, const struct shader_variable *variable)
{
    if (!variable->num_tiles)
        return;
    reflect_key(json, "tiles");
    reflect_open(json, '[');
    for (uint32_t i = 0; i < variable->num_tiles; i++) {
        const struct shader_tile *tile = &json->shader->tiles.items[variable->first_tile + i];
        reflect_item(json);
        reflect_open(json, '{');
        reflect_id(json, "file", tile->file);
        reflect_key(json, "offset");
        text_fmt(json->out, "[%d, %d]", tile->u, tile->v);
        reflect_close(json, '}');
    }
    reflect_close(json, ']');
}

static void put_variable(struct json *json, const struct shader_variable *variable)
{
    reflect_item(json);
    reflect_open(json, '{');
    reflect_id(json, "name", variable->name);
    reflect_string(json, "type", ir_type_text(variable->type));
    reflect_nonzero(json, "arrayLength", variable->array_length);
    put_stages(json, variable->stages);
    reflect_id(json, "path", variable->path);
    reflect_id(json, "documentType", variable->doc_type);
    reflect_id(json, "semantic", variable->semantic);
    reflect_id(json, "colorspace", variable->colorspace);
    reflect_id(json, "unit", variable->unit);
    reflect_id(json, "unittype", variable->unittype);
    if (variable->has_default)
        reflect_value(json, "default", &variable->value);
    if (variable->flat)
        reflect_bool(json, "flat", true);
    put_place(json, variable);
    reflect_id(json, "file", variable->file);
    put_sampling(json, &variable->sampling);
    put_tiles(json, variable);
    put_ui(json, variable);
    reflect_close(json, '}');
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
    reflect_item(json);
    reflect_open(json, '{');
    reflect_string(json, "name", shader_block_name(block));
    if (buffer->size) {
        if (shader->numbered) {
            reflect_number(json, "set", buffer->set);
            reflect_number(json, "binding", buffer->binding);
        }
        reflect_number(json, "size", buffer->size);
    }
    if (block == BLOCK_LIGHT_DATA) {
        reflect_number(json, "arrayLength", shader->max_lights);
        reflect_nonzero(json, "arrayStride", buffer->stride);
    }
    reflect_key(json, "variables");
    reflect_open(json, '[');
    for (uint32_t i = 0; i < shader->interface.len; i++) {
        const struct shader_variable *variable =
            &shader->variables.items[shader->interface.items[i]];
        if (variable->block == block)
            put_variable(json, variable);
    }
    reflect_close(json, ']');
    reflect_close(json, '}');
}

/* ---- The rest ---- */

static void put_compiled(struct json *json)
{
    reflect_key(json, "compiledInputs");
    reflect_open(json, '[');
    for (uint32_t i = 0; i < json->shader->compiled.len; i++) {
        const struct shader_compiled_input *input = &json->shader->compiled.items[i];
        reflect_item(json);
        reflect_open(json, '{');
        reflect_id(json, "path", input->path);
        reflect_id(json, "documentType", input->doc_type);
        reflect_id(json, "value", input->value);
        reflect_close(json, '}');
    }
    reflect_close(json, ']');
}

static void put_lights(struct json *json)
{
    const struct shader *shader = json->shader;
    if (!is_used(shader, BLOCK_LIGHT_DATA))
        return;
    reflect_key(json, "lights");
    reflect_open(json, '[');
    for (uint32_t i = 0; i < shader->lights.len; i++) {
        const struct shader_light *light = &shader->lights.items[i];
        reflect_item(json);
        reflect_open(json, '{');
        reflect_number(json, "type", (uint32_t)light->type);
        if (light->shader)
            reflect_id(json, "shader", light->name);
        else
            reflect_id(json, "function", lang_function(shader->unit, light->function, NULL)->name);
        reflect_key(json, "members");
        reflect_open(json, '[');
        for (uint32_t m = 0; m < light->num_members; m++) {
            str_id name =
                shader->variables.items[shader->light_members.items[light->first_member + m]].name;
            reflect_item(json);
            text_json_string(json->out, str_text(shader->strings, name),
                             str_len(shader->strings, name));
        }
        reflect_close(json, ']');
        reflect_close(json, '}');
    }
    reflect_close(json, ']');
}

static void put_functions(struct json *json)
{
    reflect_key(json, "functions");
    reflect_open(json, '{');
    for (int stage = 0; stage < NUM_STAGES; stage++) {
        const struct lang_reach *reach = &json->shader->stages[stage].reach;
        if (!reach->functions.len)
            continue;
        reflect_key(json, stage_names[stage]);
        reflect_open(json, '[');
        for (uint32_t i = 0; i < reach->functions.len; i++) {
            str_id name = lang_function(json->shader->unit, reach->functions.items[i], NULL)->name;
            reflect_item(json);
            text_json_string(json->out, str_text(json->shader->strings, name),
                             str_len(json->shader->strings, name));
        }
        reflect_close(json, ']');
    }
    reflect_close(json, '}');
}

static void put_topology(struct json *json, uint64_t topology)
{
    reflect_key(json, "topology");
    text_char(json->out, '"');
    text_hex64(json->out, topology);
    text_char(json->out, '"');
}

static void put_shader(struct json *json)
{
    const struct shader *shader = json->shader;
    put_topology(json, shader_topology(shader, json->out->arena));
    reflect_number(json, "closures", shader->closures.len);
    reflect_bool(json, "transparent", shader->transparent);
    if (shader->alpha != ALPHA_OPAQUE)
        reflect_string(json, "alpha", shader->alpha == ALPHA_MASK ? "mask" : "blend");
    if (shader->displaced)
        reflect_bool(json, "displaced", true);
    reflect_bool(json, "lit", shader->lit);
    reflect_key(json, "blocks");
    reflect_open(json, '[');
    for (int block = 0; block < NUM_BLOCKS; block++)
        put_block(json, (enum shader_block)block);
    reflect_close(json, ']');
    put_lights(json);
    put_functions(json);
    put_compiled(json);
}

static void put_network(struct json *json)
{
    put_topology(json, json->options->network_topology);
    json->options->reflect_network(json->options->network, json);
}

void shader_reflect_json(const struct shader *shader, const struct shader_reflect_options *options,
                         struct text *out)
{
    struct json json = {.shader = shader, .options = options, .out = out};
    reflect_open(&json, '{');
    reflect_id(&json, "name", shader->name);
    reflect_id(&json, "path", shader->path);
    reflect_id(&json, "element", shader->element_type);
    reflect_string(&json, "target", options->target);
    reflect_string(&json, "generator", options->generator);
    if (options->network)
        put_network(&json);
    else
        put_shader(&json);
    reflect_close(&json, '}');
    text_char(out, '\n');
}
