// SPDX-License-Identifier: Apache-2.0
#include "bench/foreign.h"

#include "bench/frame_time.h"
#include "program/files.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    mxg_block block;
} blocks[] = {
    {"PublicUniforms", MXG_BLOCK_PUBLIC_UNIFORMS},
    {"PrivateUniforms", MXG_BLOCK_PRIVATE_UNIFORMS},
    {"LightData", MXG_BLOCK_LIGHT_DATA},
    {"Textures", MXG_BLOCK_TEXTURES},
    {"AppData", MXG_BLOCK_APP_DATA},
};

static void set_values(const json_t *value, mxg_variable *out)
{
    size_t count = json_is_array(value) ? json_array_size(value) : value != NULL;
    if (count > sizeof out->values / sizeof *out->values)
        bench_fail("'%s' has more than 16 values", out->name);
    for (size_t i = 0; i < count; ++i) {
        const json_t *item = json_is_array(value) ? json_array_get(value, i) : value;
        out->values[i] = json_is_true(item) ? 1.0f : (float)json_number_value(item);
    }
    out->num_values = (uint32_t)count;
}

/* A texture has a set and a binding of its own, a uniform those of its block. */
static mxg_variable variable_of(const json_t *json, const json_t *block)
{
    const json_t *bound = json_object_get(json, "binding") ? json : block;
    mxg_variable variable = {.size = sizeof variable,
                             .name = json_text_of(json, "name"),
                             .type = json_text_of(json, "type"),
                             .document_type = "",
                             .path = json_text_of(json, "path"),
                             .semantic = "",
                             .set = (uint32_t)json_count_of(bound, "set"),
                             .binding = (uint32_t)json_count_of(bound, "binding"),
                             .location = (uint32_t)json_count_of(json, "location"),
                             .offset = (uint32_t)json_count_of(json, "offset"),
                             .byte_size = (uint32_t)json_count_of(json, "size"),
                             .matrix_stride = (uint32_t)json_count_of(json, "matrixStride"),
                             .file = json_text_of(json, "file"),
                             .uaddressmode = json_text_of(json, "uaddressmode"),
                             .vaddressmode = json_text_of(json, "vaddressmode"),
                             .filtertype = json_text_of(json, "filtertype"),
                             .layer = ""};
    set_values(json_object_get(json, "default"), &variable);
    return variable;
}

static void add_block(struct foreign *foreign, const json_t *json)
{
    struct bind_program *program = &foreign->program;
    const char *name = json_text_of(json, "name");
    size_t k = 0, i;
    json_t *variable;
    while (k < sizeof blocks / sizeof *blocks && strcmp(name, blocks[k].name) != 0)
        ++k;
    if (k == sizeof blocks / sizeof *blocks)
        return; /* VertexData, Outputs */
    if (blocks[k].block == MXG_BLOCK_LIGHT_DATA)
        program->num_lights = (uint32_t)json_count_of(json, "arrayLength");
    json_array_foreach(json_object_get(json, "variables"), i, variable)
    {
        if (program->num_variables == FOREIGN_MAX_VARIABLES)
            bench_fail("a shader has more than %d variables", FOREIGN_MAX_VARIABLES);
        foreign->variables[program->num_variables] = variable_of(variable, json);
        foreign->variables[program->num_variables++].block = blocks[k].block;
    }
}

struct foreign *foreign_open(const char *stem)
{
    static const char *const endings[MXG_NUM_STAGES] = {
        [MXG_STAGE_VERTEX] = "vert", [MXG_STAGE_PIXEL] = "frag"};
    struct foreign *foreign = calloc(1, sizeof *foreign);
    char path[4096];
    json_error_t error;
    json_t *block;
    size_t i, size;
    if (!foreign)
        bench_fail("out of memory");
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage) {
        snprintf(path, sizeof path, "%s.%s", stem, endings[stage]);
        foreign->program.sources[stage] = foreign->sources[stage] = files_read(path, &size);
        if (!foreign->sources[stage]) {
            foreign_close(foreign);
            return NULL;
        }
    }
    snprintf(path, sizeof path, "%s.json", stem);
    foreign->reflection = json_load_file(path, 0, &error);
    if (!foreign->reflection)
        bench_fail("%s:%d:%d: %s", path, error.line, error.column, error.text);
    json_array_foreach(json_object_get(foreign->reflection, "blocks"), i, block)
        add_block(foreign, block);
    foreign->program.variables = foreign->variables;
    return foreign;
}

void foreign_close(struct foreign *foreign)
{
    if (!foreign)
        return;
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage)
        free(foreign->sources[stage]);
    json_decref(foreign->reflection);
    free(foreign);
}
