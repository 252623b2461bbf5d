// SPDX-License-Identifier: Apache-2.0
/* The reflection as JSON (docs/reflection.md). Empty fields are left out. */
#include "shader/reflect.h"

#include <assert.h>
#include <math.h>

void reflect_id(struct reflect *r, const char *key, str_id value)
{
    json_put_text(&r->json, key, str_text(r->shader->strings, value));
}

/* JSON cannot express infinities and NaN. */
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

void reflect_value(struct json *json, const char *key, const struct ir_value *value)
{
    const struct ir_type_info *info = ir_type_info(value->type);
    json_key(json, key);
    if (info->components == 1) {
        write_scalar(json->out, info->scalar, value->w[0]);
        return;
    }
    json_open_flat(json, '[');
    for (unsigned i = 0; i < info->components; i++) {
        json_item(json);
        write_scalar(json->out, info->scalar, value->w[i]);
    }
    json_close(json, ']');
}

/* ---- Variables ---- */

/* A pass has one stage, in the place of the pixel stage. */
static const char *stage_name(const struct reflect *r, int stage)
{
    return stage == STAGE_VERTEX ? "vertex" : role_is_pass(r->shader->role) ? "compute" : "pixel";
}

static void put_item(struct json *json, const char *text)
{
    json_item(json);
    text_json_string(json->out, text, strlen(text));
}

static void put_stages(struct reflect *r, uint8_t stages)
{
    json_key(&r->json, "stages");
    json_open_flat(&r->json, '[');
    for (int stage = 0; stage < NUM_STAGES; stage++)
        if (stages >> stage & 1)
            put_item(&r->json, stage_name(r, stage));
    json_close(&r->json, ']');
}

static void put_place(struct reflect *r, const struct shader_variable *variable)
{
    enum shader_block block = (enum shader_block)variable->block;
    if (shader_block_has_uniforms(block) || block == BLOCK_LIGHT_DATA) {
        if (!r->shader->interface.buffers[block].size)
            return;
        assert(variable->offset + variable->size <= r->shader->interface.buffers[block].size);
        json_put_number(&r->json, "offset", variable->offset);
        json_put_number(&r->json, "size", variable->size);
        json_put_nonzero(&r->json, "arrayStride", variable->array_stride);
        json_put_nonzero(&r->json, "matrixStride", variable->matrix_stride);
    } else if (block == BLOCK_TEXTURES) {
        if (r->shader->interface.rules.bindings) {
            json_put_number(&r->json, "set", variable->set);
            json_put_number(&r->json, "binding", variable->binding);
            if (r->shader->interface.rules.sampler_bindings)
                json_put_number(&r->json, "samplerBinding", variable->sampler_binding);
        }
    } else if (shader_has_locations(r->shader, block)) {
        json_put_number(&r->json, "location", variable->location);
    }
}

static void put_ui(struct reflect *r, const struct shader_ui *ui)
{
    const struct {
        const char *key, *value;
    } fields[] = {
#define UI(member, attribute, key) {key, ui->member},
#include "shader/ui.def"
#undef UI
    };
    bool any = ui->advanced;
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        any |= fields[i].value && *fields[i].value;
    if (!any)
        return;
    json_key(&r->json, "ui");
    json_open(&r->json, '{');
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        json_put_text(&r->json, fields[i].key, fields[i].value);
    if (ui->advanced)
        json_put_bool(&r->json, "advanced", true);
    json_close(&r->json, '}');
}

static void put_sampling(struct reflect *r, const struct shader_sampling *sampling)
{
    reflect_id(r, "uaddressmode", sampling->uaddressmode);
    reflect_id(r, "vaddressmode", sampling->vaddressmode);
    reflect_id(r, "filtertype", sampling->filtertype);
    reflect_id(r, "layer", sampling->layer);
    reflect_id(r, "framerange", sampling->framerange);
    if (sampling->frameoffset) {
        json_key(&r->json, "frameoffset");
        text_fmt(r->json.out, "%d", sampling->frameoffset);
    }
    reflect_id(r, "frameendaction", sampling->frameendaction);
}

static void put_tiles(struct reflect *r, const struct shader_variable *variable)
{
    if (!variable->num_tiles)
        return;
    assert(variable->first_tile + variable->num_tiles <= r->shader->interface.tiles.len);
    json_key(&r->json, "tiles");
    json_open(&r->json, '[');
    for (uint32_t i = 0; i < variable->num_tiles; i++) {
        const struct shader_tile *tile =
            &r->shader->interface.tiles.items[variable->first_tile + i];
        json_item(&r->json);
        json_open(&r->json, '{');
        reflect_id(r, "file", tile->file);
        json_key(&r->json, "offset");
        text_fmt(r->json.out, "[%d, %d]", tile->u, tile->v);
        json_close(&r->json, '}');
    }
    json_close(&r->json, ']');
}

static void put_variable(struct reflect *r, const struct shader_variable *variable)
{
    struct shader_ui ui = {0};
    json_item(&r->json);
    json_open(&r->json, '{');
    reflect_id(r, "name", variable->name);
    json_put_text(&r->json, "type", ir_type_text(variable->type));
    json_put_nonzero(&r->json, "arrayLength", variable->array_length);
    put_stages(r, variable->stages);
    reflect_id(r, "slot", variable->slot);
    reflect_id(r, "path", variable->path);
    reflect_id(r, "documentType", variable->doc_type);
    reflect_id(r, "semantic", variable->semantic);
    reflect_id(r, "colorspace", variable->colorspace);
    reflect_id(r, "unit", variable->unit);
    reflect_id(r, "unittype", variable->unittype);
    if (variable->has_default)
        reflect_value(&r->json, "default", &variable->value);
    if (variable->flat)
        json_put_bool(&r->json, "flat", true);
    put_place(r, variable);
    reflect_id(r, "file", variable->file);
    reflect_id(r, "origin", variable->origin);
    put_sampling(r, &variable->sampling);
    put_tiles(r, variable);
    if (r->options->ui)
        r->options->ui(r->options->user_data, variable, &ui);
    put_ui(r, &ui);
    json_close(&r->json, '}');
}

static bool is_used(const struct shader *shader, enum shader_block block)
{
    for (uint32_t i = 0; i < shader->interface.used.len; i++)
        if (shader_interface_variable(shader, i)->block == block)
            return true;
    return false;
}

static void put_block(struct reflect *r, enum shader_block block)
{
    const struct shader *shader = r->shader;
    const struct shader_buffer *buffer = &shader->interface.buffers[block];
    if (!is_used(shader, block))
        return;
    json_item(&r->json);
    json_open(&r->json, '{');
    json_put_text(&r->json, "name", shader_block_name(shader, block));
    if (buffer->size) {
        if (shader->interface.rules.bindings) {
            json_put_number(&r->json, "set", buffer->set);
            json_put_number(&r->json, "binding", buffer->binding);
        }
        json_put_number(&r->json, "size", buffer->size);
    }
    if (block == BLOCK_LIGHT_DATA) {
        json_put_number(&r->json, "arrayLength", shader->interface.max_lights);
        json_put_nonzero(&r->json, "arrayStride", buffer->stride);
    }
    json_key(&r->json, "variables");
    json_open(&r->json, '[');
    for (uint32_t i = 0; i < shader->interface.used.len; i++) {
        const struct shader_variable *variable = shader_interface_variable(shader, i);
        if (variable->block == block)
            put_variable(r, variable);
    }
    json_close(&r->json, ']');
    json_close(&r->json, '}');
}

/* ---- The rest ---- */

static void put_compiled(struct reflect *r)
{
    json_key(&r->json, "compiledInputs");
    json_open(&r->json, '[');
    for (uint32_t i = 0; r->options->compiled && i < r->shader->reflection.compiled.len; i++) {
        struct shader_compiled_text input = {0};
        r->options->compiled(r->options->user_data, i, &input);
        json_item(&r->json);
        json_open(&r->json, '{');
        json_put_text(&r->json, "path", input.path);
        json_put_text(&r->json, "documentType", input.type);
        json_put_text(&r->json, "value", input.value);
        if (input.authored)
            json_put_bool(&r->json, "authored", true);
        put_ui(r, &input.ui);
        json_close(&r->json, '}');
    }
    json_close(&r->json, ']');
}

static void put_lights(struct reflect *r)
{
    const struct shader *shader = r->shader;
    if (!is_used(shader, BLOCK_LIGHT_DATA))
        return;
    json_key(&r->json, "lights");
    json_open(&r->json, '[');
    for (uint32_t i = 0; i < shader->interface.lights.len; i++) {
        const struct shader_light *light = &shader->interface.lights.items[i];
        assert(light->first_member + light->num_members <= shader->interface.light_members.len);
        json_item(&r->json);
        json_open(&r->json, '{');
        json_put_number(&r->json, "type", (uint32_t)light->type);
        if (light->shader)
            reflect_id(r, "shader", light->name);
        else
            reflect_id(r, "function",
                       light->source != UINT32_MAX
                           ? shader->sources.calls.items[light->source].function
                           : lang_function(shader->unit, light->function, NULL)->name);
        json_key(&r->json, "members");
        json_open(&r->json, '[');
        for (uint32_t m = 0; m < light->num_members; m++) {
            str_id name = shader->interface.variables
                              .items[shader->interface.light_members.items[light->first_member + m]]
                              .name;
            put_item(&r->json, str_text(shader->strings, name));
        }
        json_close(&r->json, ']');
        json_close(&r->json, '}');
    }
    json_close(&r->json, ']');
}

static void put_host_functions(struct reflect *r)
{
    const struct shader *shader = r->shader;
    if (!shader->reflection.host_functions.len)
        return;
    json_key(&r->json, "hostFunctions");
    json_open(&r->json, '[');
    for (uint32_t i = 0; i < shader->reflection.host_functions.len; i++)
        put_item(&r->json, str_text(shader->strings, shader->reflection.host_functions.items[i]));
    json_close(&r->json, ']');
}

static void put_functions(struct reflect *r)
{
    json_key(&r->json, "functions");
    json_open(&r->json, '{');
    for (int stage = 0; stage < NUM_STAGES; stage++) {
        const struct lang_reach *reach = &r->shader->stages[stage].reach;
        if (!reach->functions.len)
            continue;
        json_key(&r->json, stage_name(r, stage));
        json_open(&r->json, '[');
        for (uint32_t i = 0; i < reach->functions.len; i++) {
            const struct lang_function *fn =
                lang_function(r->shader->unit, reach->functions.items[i], NULL);
            if (fn->body)
                put_item(&r->json, str_text(r->shader->strings, fn->name));
        }
        json_close(&r->json, ']');
    }
    json_close(&r->json, '}');
}

static void put_topology(struct reflect *r)
{
    json_key(&r->json, "topology");
    text_char(r->json.out, '"');
    text_hex64(r->json.out, r->options->topology);
    text_char(r->json.out, '"');
}

static void put_surface(struct reflect *r)
{
    const struct shader *shader = r->shader;
    json_put_number(&r->json, "closures", shader->reflection.closures.len);
    json_put_bool(&r->json, "transparent", shader->reflection.transparent);
    if (shader->reflection.alpha != ALPHA_OPAQUE)
        json_put_text(&r->json, "alpha", shader->reflection.alpha == ALPHA_MASK ? "mask" : "blend");
    if (shader->reflection.displaced)
        json_put_bool(&r->json, "displaced", true);
    json_put_bool(&r->json, "lit", shader->reflection.lit);
    json_put_text(&r->json, "deviceFeatures", shader->reflection.device_features);
    json_put_text(&r->json, "function", shader->reflection.function);
    json_put_text(&r->json, "functionType", shader->reflection.function_type);
}

static void put_shader(struct reflect *r)
{
    const struct shader *shader = r->shader;
    if (!role_is_pass(shader->role))
        put_surface(r);
    if (r->options->more)
        r->options->more(r->options->user_data, &r->json);
    json_key(&r->json, "blocks");
    json_open(&r->json, '[');
    for (int block = 0; block < NUM_BLOCKS; block++)
        put_block(r, (enum shader_block)block);
    json_close(&r->json, ']');
    put_lights(r);
    put_host_functions(r);
    if (!role_is_pass(shader->role) || shader->stages[STAGE_PIXEL].reach.functions.len)
        put_functions(r);
    if (!role_is_pass(shader->role))
        put_compiled(r);
}

void shader_reflect_json(const struct shader *shader, const struct shader_reflect_options *options,
                         struct text *out)
{
    struct reflect r = {.json.out = out, .shader = shader, .options = options};
    json_open(&r.json, '{');
    reflect_id(&r, "name", shader->reflection.name);
    reflect_id(&r, "path", shader->reflection.path);
    reflect_id(&r, "element", shader->reflection.element_type);
    json_put_text(&r.json, "target", options->target);
    json_put_text(&r.json, "generator", options->generator);
    put_topology(&r);
    if (options->network)
        options->reflect_network(options->network, &r);
    else
        put_shader(&r);
    json_close(&r.json, '}');
    text_char(out, '\n');
}
