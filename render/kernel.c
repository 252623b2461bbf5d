// SPDX-License-Identifier: Apache-2.0
/* One shader as a kernel of the path tracer: its source, its inputs, its pipeline. */
#include "render/trace.h"

#include "compile/spirv.h"
#include "program/memory.h"
#include "render/each.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool kernel_fail(struct kernel *kernel, const char *id, const char *text)
{
    return !kernel->bind->reason[0] && bind_fail_as(kernel->bind, id, "%s", text);
}

/* ---- Text ---- */

static void append(struct memory_bytes *source, const char *text)
{
    memory_append(source, text, strlen(text));
}

/* ---- Attributes ---- */

/* Vertex data by name, computed from a hit. */
static const struct {
    const char *name, *value;
} hit_values[] = {
    {"positionObject", "(to_object * vec4(point, 1.0)).xyz"},
    {"positionWorld", "point"},
    {"normalObject", "normalize(normal * inverse(mat3(to_object)))"},
    {"normalWorld", "normal"},
    {"tangentObject", "normalize(mat3(to_object) * tangent)"},
    {"tangentWorld", "tangent"},
    {"bitangentObject", "normalize(mat3(to_object) * cross(normal, tangent))"},
    {"bitangentWorld", "cross(normal, tangent)"},
    {"texcoord_0", "texcoord"},
    {"dx_positionObject", "mat3(to_object) * dx_point"},
    {"dx_positionWorld", "dx_point"},
    {"dy_positionObject", "mat3(to_object) * dy_point"},
    {"dy_positionWorld", "dy_point"},
    {"dx_normalObject", "dx_normal * inverse(mat3(to_object))"},
    {"dx_normalWorld", "dx_normal"},
    {"dy_normalObject", "dy_normal * inverse(mat3(to_object))"},
    {"dy_normalWorld", "dy_normal"},
    {"dx_texcoord_0", "dx_texcoord"},
    {"dy_texcoord_0", "dy_texcoord"},
    {"viewWorld", "view"},
    {"random", "random"},
    {"lightWorld", "light"},
    {"normalMoved", "moved"},
    {"matter", "at_level"},
};

static const char *hit_value(const char *name)
{
    for (size_t k = 0; k < sizeof hit_values / sizeof *hit_values; ++k)
        if (strcmp(name, hit_values[k].name) == 0)
            return hit_values[k].value;
    return NULL;
}

/* True for vertex data that a mesh has: a geometric property, a colour, further coordinates. */
static bool is_attribute(const mxg_variable *variable)
{
    static const char *const prefixes[] = {"geomprop_", "texcoord_", "color_"};
    for (size_t i = 0; i < sizeof prefixes / sizeof *prefixes; ++i)
        if (strncmp(variable->name, prefixes[i], strlen(prefixes[i])) == 0)
            return !hit_value(variable->name);
    return false;
}

/* Attribute `index` of a kernel; false: it has no more. */
static bool find_attribute(const struct kernel *kernel, uint32_t index, mxg_variable *out)
{
    const mxg_result *result = kernel->bind->result;
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        *out = (mxg_variable){sizeof *out};
        mxg_result_variable(result, i, out);
        if (out->block == MXG_BLOCK_VERTEX_DATA && is_attribute(out) && index-- == 0)
            return true;
    }
    return false;
}

size_t kernel_num_values(const struct kernel *kernel, uint32_t object)
{
    size_t count = 0;
    for (mxg_variable variable; find_attribute(kernel, (uint32_t)count, &variable);)
        ++count;
    return count * kernel->bind->objects[object].mesh.num_indices;
}

void kernel_values(const struct kernel *kernel, uint32_t object, float (*out)[4])
{
    const struct scene_object *from = &kernel->bind->objects[object];
    mxg_variable variable;
    for (uint32_t a = 0; find_attribute(kernel, a, &variable); ++a) {
        char buffer[SCENE_MAX_NAME], own[SCENE_MAX_NAME];
        snprintf(own, sizeof own, "i_%s", variable.name);
        const char *name = scene_name(own, variable.semantic, buffer);
        for (uint32_t i = 0; i < from->mesh.num_indices; ++i, ++out) {
            memset(*out, 0, sizeof *out);
            if (!scene_attribute(from, name, from->mesh.indices[i], *out))
                memcpy(*out, variable.values, variable.num_values * sizeof **out);
        }
    }
}

/* ---- Source ---- */

/* "occlusion:90,1e+38": ambient occlusion in a cone of half this angle, up to a distance. */
static bool reads_occlusion(const mxg_variable *variable, double *out_angle, double *out_distance)
{
    return sscanf(variable->semantic, "occlusion:%lf,%lf", out_angle, out_distance) == 2;
}

static void append_fill(struct memory_bytes *source, const mxg_result *result)
{
    uint32_t attributes = 0;
    append(source,
           "vec3 dx_point, dy_point, dx_normal, dy_normal;\nvec2 dx_texcoord, dy_texcoord;\n"
           "mat4 to_object; // of the object at the hit\n"
           "vec2 at_level;  // of matter, and the number that picks what is there\n"
           "vec4 hit_value(uint i);\n"
           "float trace_occlusion(vec3 normal, vec3 view, float angle, float limit);\n\n");
    append(source, "void fill_vertex_data(vec3 point, vec3 normal, vec3 tangent, vec2 texcoord, "
                   "vec3 view, vec4 random,\n"
                   "                      vec4 light, vec3 moved)\n{\n");
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_variable variable = {sizeof variable};
        mxg_result_variable(result, i, &variable);
        if (variable.block != MXG_BLOCK_VERTEX_DATA)
            continue;
        char line[256];
        const char *value = hit_value(variable.name);
        bool is_vector = strncmp(variable.type, "vec", 3) == 0;
        double angle, distance;
        if (reads_occlusion(&variable, &angle, &distance))
            snprintf(line, sizeof line,
                     "    vd.%s = trace_occlusion(normal, view, float(%.9g), float(%.9g));\n",
                     variable.name, angle, distance);
        else if (value)
            snprintf(line, sizeof line, "    vd.%s = %s;\n", variable.name, value);
        else if (is_attribute(&variable))
            snprintf(line, sizeof line, "    vd.%s = %s(hit_value(%uu)%s);\n", variable.name,
                     variable.type, attributes++, is_vector ? "" : ".x");
        else /* data that no mesh has */
            snprintf(line, sizeof line, "    vd.%s = %s(0);\n", variable.name, variable.type);
        append(source, line);
    }
    append(source, "}\n\n");
}

/*
 * keep_aovs() adds the AOVs of the first hit to those of its pixel, times the path's share; an
 * integer is that of the first sample, because it has no mean. For keep_light() a BSDF keeps behind
 * all AOVs of the pixel what it gives of the light that comes by the path, from the environment and
 * from a bound light: light_aovs() adds that when the light comes. It returns the most of each.
 */
static void append_value(struct memory_bytes *source, const struct picture_aov *aov, size_t number,
                         const mxg_variable *variable)
{
    char line[256];
    const char *type = variable->type, *rest = strcmp(type, "vec4") == 0   ? ""
                                               : strcmp(type, "vec3") == 0 ? ", 0.0"
                                               : strcmp(type, "vec2") == 0 ? ", 0.0, 0.0"
                                                                           : ", 0.0, 0.0, 0.0";
    bool is_whole = aovs_is_whole(aov->type);
    snprintf(line, sizeof line, "%s    aov_film[at + %zu] %s vec4(%s%s);\n",
             is_whole ? "    if (is_first)\n    " : "", number, is_whole ? "=" : "+= share *",
             variable->name, rest);
    append(source, line);
}

static void append_keep_aovs(struct memory_bytes *source, const mxg_result *result,
                             const struct aovs *aovs)
{
    mxg_variable variable;
    append(source, "void keep_aovs(uint pixel, bool is_first, float share)\n{\n"
                   "    uint at = pixel * AOV_STRIDE;\n");
    for (size_t i = 0; i < aovs_num(aovs); ++i)
        if (aovs_find(&aovs->items[i], result, AOVS_VALUE, &variable))
            append_value(source, &aovs->items[i], i, &variable);
    append(source, "}\n\n");
}

static void append_keep_light(struct memory_bytes *source, const mxg_result *result,
                              const struct aovs *aovs)
{
    static const struct {
        enum aovs_output output;
        const char *factor;
    } parts[] = {{AOVS_WEIGHT, ""}, {AOVS_RESPONSE, " * arrives"}, {AOVS_LIGHT, ""}};
    const size_t num_parts = sizeof parts / sizeof *parts;
    mxg_variable variable;
    char line[256];
    size_t at = aovs_num(aovs);
    append(source, "mat3 keep_light(uint pixel, vec3 arrives)\n{\n"
                   "    uint at = pixel * AOV_STRIDE;\n    vec3 kept;\n"
                   "    mat3 most = mat3(0.0);\n");
    for (size_t i = 0; i < aovs_num(aovs); ++i)
        for (size_t k = 0; aovs_is_scattered(&aovs->items[i]) && k < num_parts; ++k, ++at) {
            bool is_there = aovs_find(&aovs->items[i], result, parts[k].output, &variable);
            snprintf(line, sizeof line,
                     "    kept = %s%s;\n    kept = is_light(kept) ? kept : vec3(0.0);\n"
                     "    aov_film[at + %zu] = vec4(kept, 0.0);\n"
                     "    most[%zu] = max(most[%zu], kept);\n",
                     is_there ? variable.name : "vec3(0.0)", parts[k].factor, at, k, k);
            append(source, line);
        }
    append(source, "    return most;\n}\n\n");
}

static void append_light_aovs(struct memory_bytes *source, const struct aovs *aovs)
{
    char line[128];
    size_t at = aovs_num(aovs);
    append(source, "void light_aovs(uint pixel, uint of, vec3 light)\n{\n"
                   "    uint at = pixel * AOV_STRIDE;\n");
    for (size_t i = 0; i < aovs_num(aovs); ++i) {
        if (!aovs_is_scattered(&aovs->items[i]))
            continue;
        snprintf(line, sizeof line,
                 "    aov_film[at + %zu].rgb += aov_film[at + of + %zu].rgb * light;\n", i, at);
        append(source, line);
        at += AOVS_SCATTERED;
    }
    append(source, "}\n\n");
}

static void append_aovs(struct memory_bytes *source, const mxg_result *result,
                        const struct aovs *aovs)
{
    char line[64];
    snprintf(line, sizeof line, "#define AOV_STRIDE %zuu\n", aovs_stride(aovs));
    append(source, line);
    append(source, "bool is_light(vec3 color);\n");
    append_keep_aovs(source, result, aovs);
    append_keep_light(source, result, aovs);
    append_light_aovs(source, aovs);
}

static bool has_output(const mxg_result *result, const char *name)
{
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_variable variable = {sizeof variable};
        mxg_result_variable(result, i, &variable);
        if (variable.block == MXG_BLOCK_OUTPUTS && strcmp(variable.name, name) == 0)
            return true;
    }
    return false;
}

/* macro: of the program that prepares; "": the paths. */
static bool compile(struct kernel *kernel, const struct trace_options *options, const char *macro,
                    struct compiled *out)
{
    struct memory_bytes source = {0};
    char line[160];
    const mxg_result *result = kernel->bind->result;
    append(&source, mxg_result_source(result, MXG_STAGE_PIXEL, NULL));
    append_fill(&source, kernel->bind->result);
    snprintf(line, sizeof line,
             "#define TRACER_SET %u\n"
             "layout(set = TRACER_SET, binding = 8, std430) buffer Aovs { vec4 aov_film[]; };\n",
             kernel->inputs.num_sets);
    append(&source, line);
    append_aovs(&source, kernel->bind->result, options->aovs);
    snprintf(line, sizeof line, "#define PICKS %" PRIu32 "u\n", options->picks);
    append(&source, line);
    append(&source,
           options->as_drawn ? "const bool AS_DRAWN = true;\n" : "const bool AS_DRAWN = false;\n");
    append(&source, kernel->info.transparent ? "#define TRANSPARENT\n" : "");
    append(&source, kernel->info.num_lights ? "#define LIGHTS\n" : "");
    append(&source, bind_has_semantic(result, "matter") ? "#define MATTER\n" : "");
    append(&source, kernel->is_volume ? "#define VOLUME\n" : "");
    append(&source, has_output(result, "out13") ? "#define INTERIOR\n" : "");
    append(&source, bind_has_semantic(result, "varies") ? "#define VARIES\n" : "");
    snprintf(line, sizeof line, "const uint PARTS = %zuu;\n",
             1 + aovs_num_scattered(options->aovs));
    append(&source, line);
    snprintf(line, sizeof line, *macro ? "#define %s\n" : "%s", macro);
    append(&source, line);
    for (const char *const *piece = trace_source; *piece; ++piece)
        append(&source, *piece);
    bool good = each_compile(source.data, out);
    free(source.data);
    if (good)
        return true;
    return kernel_fail(kernel, "bad-shader",
                       out->num_messages ? out->messages[0].text : "out of memory");
}

static bool create_pipeline(struct gpu *gpu, const struct kernel *kernel,
                            VkDescriptorSetLayout set_layout, struct kernel_program *program)
{
    const struct compiled_stage *code = &program->compiled.stages[MXG_STAGE_PIXEL];
    /* lavapipe compiles a shader again, for the values of its uniforms, whenever it is bound */
    spirv_store_uniforms(code->words, code->num_words);
    VkDescriptorSetLayout layouts[DRAW_MAX_SETS + 1];
    memcpy(layouts, kernel->inputs.set_layouts, sizeof kernel->inputs.set_layouts);
    layouts[kernel->inputs.num_sets] = set_layout;
    const VkPipelineLayoutCreateInfo layout = {.sType =
                                                   VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                               .setLayoutCount = kernel->inputs.num_sets + 1,
                                               .pSetLayouts = layouts};
    return each_create(gpu, &layout, &program->compiled, &program->layout, &program->pipeline);
}

/* True if the pixel stage reads uniforms that differ between objects. */
static bool differs_by_object(const struct bind *bind)
{
    for (uint32_t i = 0; i < mxg_result_num_variables(bind->result); ++i) {
        mxg_variable variable = {sizeof variable};
        mxg_result_variable(bind->result, i, &variable);
        if (variable.block == MXG_BLOCK_PRIVATE_UNIFORMS
            && (variable.stages & 1u << MXG_STAGE_PIXEL)
            && (strncmp(variable.name, "u_world", 7) == 0
                || strncmp(variable.name, "u_geomprop_", 11) == 0))
            return true;
    }
    return false;
}

bool kernel_open(struct gpu *gpu, struct bind *bind, uint32_t first_shader, struct kernel *out)
{
    *out = (struct kernel){.bind = bind, .info = {sizeof out->info}, .first_shader = first_shader};
    mxg_result_info(bind->result, &out->info);
    /* levels of matter have a tenth output, too, and volumes have none */
    out->is_volume =
        has_output(bind->result, "out10") && !bind_has_semantic(bind->result, "matter");
    out->prepared = out->info.displaced                         ? "DISPLACES"
                    : bind_has_semantic(bind->result, "varies") ? "MEASURES"
                                                                : "";
    if (!gpu->can_store)
        return kernel_fail(
            out, "no-device",
            "the device cannot write buffers in pixel stages, as '--path-trace' needs");
    if (!bind_shader(bind))
        return false;
    out->num_shaders = differs_by_object(bind) ? bind->num_objects : 1;
    return inputs_create(gpu, &bind->draw, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC, &out->inputs);
}

bool kernel_compile(struct gpu *gpu, struct kernel *kernel, VkDescriptorSetLayout set_layout,
                    const struct trace_options *options)
{
    return compile(kernel, options, "", &kernel->paths.compiled)
           && create_pipeline(gpu, kernel, set_layout, &kernel->paths)
           && (!*kernel->prepared
               || (compile(kernel, options, kernel->prepared, &kernel->prepares.compiled)
                   && create_pipeline(gpu, kernel, set_layout, &kernel->prepares)));
}

static void close_program(struct gpu *gpu, struct kernel_program *program)
{
    vkDestroyPipeline(gpu->device, program->pipeline, NULL);
    vkDestroyPipelineLayout(gpu->device, program->layout, NULL);
    compiled_finish(&program->compiled);
}

void kernel_close(struct gpu *gpu, struct kernel *kernel)
{
    close_program(gpu, &kernel->paths);
    close_program(gpu, &kernel->prepares);
    inputs_destroy(gpu, &kernel->bind->draw, &kernel->inputs);
}
