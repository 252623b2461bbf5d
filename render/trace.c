// SPDX-License-Identifier: Apache-2.0
#include "render/trace.h"

#include "render/bvh.h"
#include "render/importance.h"
#include "render/inputs.h"
#include "compile/compile.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NUM_BUFFERS = 4, NUM_BINDINGS = NUM_BUFFERS + 1, GROUP = 8, SAMPLES_AT_ONCE = 16 };

struct camera { /* layout as in path.glsl */
    float eye[4], right[4], up[4], forward[4], environment[3][4];
    uint32_t frame[4];
};

struct tracer {
    struct gpu *gpu;
    struct bind *bind;
    const struct trace_options *options;
    mxg_shader_info info;
    struct compiled compiled;
    struct bvh bvh;
    struct inputs inputs;
    struct gpu_buffer buffers[NUM_BUFFERS]; /* nodes, corners, film, sums */
    struct gpu_image environment;
    VkSampler sampler;
    VkDescriptorSetLayout set_layout;
    VkDescriptorPool pool;
    VkDescriptorSet set;
    VkPipelineLayout layout;
    VkShaderModule module;
    VkPipeline pipeline;
    uint32_t width, height;
};

static bool fail(struct tracer *tracer, const char *id, const char *text)
{
    tracer->bind->id = id;
    snprintf(tracer->bind->reason, sizeof tracer->bind->reason, "%s", text);
    return false;
}

/* ---- Source ---- */

struct source {
    char *text;
    size_t len, capacity;
};

static void append(struct source *source, const char *text)
{
    size_t len = strlen(text);
    if (source->len + len + 1 > source->capacity) {
        size_t capacity = (source->len + len + 1) * 2;
        char *more = realloc(source->text, capacity);
        if (!more) {
            free(source->text);
            *source = (struct source){.capacity = SIZE_MAX}; /* the source is complete */
            return;
        }
        source->text = more;
        source->capacity = capacity;
    }
    if (source->text) {
        memcpy(source->text + source->len, text, len + 1);
        source->len += len;
    }
}

/* Vertex data by name, computed from a hit. The studio's mesh has no world transform. */
static const struct {
    const char *name, *value;
    bool is_family;
} hit_values[] = {
    {"positionObject", "point", false},
    {"positionWorld", "point", false},
    {"normalObject", "normal", false},
    {"normalWorld", "normal", false},
    {"tangentObject", "tangent", false},
    {"tangentWorld", "tangent", false},
    {"bitangentObject", "cross(normal, tangent)", false},
    {"bitangentWorld", "cross(normal, tangent)", false},
    {"texcoord_", "texcoord", true},
    {"dx_positionObject", "dx_point", false},
    {"dx_positionWorld", "dx_point", false},
    {"dy_positionObject", "dy_point", false},
    {"dy_positionWorld", "dy_point", false},
    {"dx_normalObject", "dx_normal", false},
    {"dx_normalWorld", "dx_normal", false},
    {"dy_normalObject", "dy_normal", false},
    {"dy_normalWorld", "dy_normal", false},
    {"dx_texcoord_", "dx_texcoord", true},
    {"dy_texcoord_", "dy_texcoord", true},
    {"viewWorld", "view", false},
    {"random", "random", false},
    {"lightWorld", "light", false},
    {"normalMoved", "moved", false},
};

static void append_fill(struct source *source, const mxg_result *result)
{
    append(source,
           "vec3 dx_point, dy_point, dx_normal, dy_normal;\nvec2 dx_texcoord, dy_texcoord;\n\n");
    append(source, "void fill_vertex_data(vec3 point, vec3 normal, vec3 tangent, vec2 texcoord, "
                   "vec3 view, vec4 random,\n"
                   "                      vec4 light, vec3 moved)\n{\n");
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_variable variable = {sizeof variable};
        mxg_result_variable(result, i, &variable);
        if (variable.block != MXG_BLOCK_VERTEX_DATA)
            continue;
        char line[256];
        /* data that no mesh has */
        snprintf(line, sizeof line, "    vd.%s = %s(0);\n", variable.name, variable.type);
        for (size_t k = 0; k < sizeof hit_values / sizeof *hit_values; ++k) {
            const char *name = hit_values[k].name;
            if (hit_values[k].is_family ? strncmp(variable.name, name, strlen(name)) == 0
                                        : strcmp(variable.name, name) == 0)
                snprintf(line, sizeof line, "    vd.%s = %s;\n", variable.name,
                         hit_values[k].value);
        }
        append(source, line);
    }
    append(source, "}\n\n");
}

static bool compile(struct tracer *tracer)
{
    struct source source = {0};
    char line[64];
    append(&source, mxg_result_source(tracer->bind->result, MXG_STAGE_PIXEL, NULL));
    append_fill(&source, tracer->bind->result);
    snprintf(line, sizeof line, "#define TRACER_SET %u\n", tracer->inputs.num_sets);
    append(&source, line);
    append(&source, tracer->info.transparent ? "#define TRANSPARENT\n" : "");
    append(&source, tracer->info.num_lights ? "#define LIGHTS\n" : "");
    append(&source, tracer->info.displaced ? "#define DISPLACED\n" : "");
    for (const char *const *piece = trace_source; *piece; ++piece)
        append(&source, *piece);
    bool good = source.text && compile_compute(source.text, &tracer->compiled);
    free(source.text);
    if (good)
        return true;
    const char *text =
        tracer->compiled.num_messages ? tracer->compiled.messages[0].text : "out of memory";
    fail(tracer, "bad-shader", text);
    return false;
}

/* ---- Device ---- */

static bool create_buffers(struct tracer *tracer)
{
    struct gpu *gpu = tracer->gpu;
    size_t pixels = (size_t)tracer->width * tracer->height,
           corners = 3 * (size_t)tracer->bvh.num_triangles;
    size_t film =
        (tracer->info.displaced && corners > pixels ? corners : pixels) * 4 * sizeof(float);
    const VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    size_t num_sums;
    float *sums = importance_of_map(&tracer->bind->scene->radiance, &num_sums);
    bool good =
        sums ? gpu_create_buffer(gpu, usage, sums, num_sums * sizeof *sums, &tracer->buffers[3])
             : fail(tracer, "render-failed", "out of memory");
    free(sums);
    if (!good
        || !gpu_create_buffer(gpu, usage, tracer->bvh.nodes,
                              tracer->bvh.num_nodes * sizeof *tracer->bvh.nodes,
                              &tracer->buffers[0])
        || !gpu_create_buffer(gpu, usage, tracer->bvh.corners,
                              3 * (size_t)tracer->bvh.num_triangles * sizeof *tracer->bvh.corners,
                              &tracer->buffers[1])
        || !gpu_create_buffer(gpu, usage, NULL, film, &tracer->buffers[2]))
        return false;
    memset(tracer->buffers[2].mapped, 0, film);
    const VkSamplerCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                      .magFilter = VK_FILTER_LINEAR,
                                      .minFilter = VK_FILTER_LINEAR,
                                      .addressModeU = VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                      .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                      .addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE};
    return gpu_upload_texture(gpu, &tracer->bind->scene->radiance, false, &tracer->environment)
           && gpu_check(gpu, vkCreateSampler(gpu->device, &info, NULL, &tracer->sampler),
                        "making a sampler");
}

static bool create_set(struct tracer *tracer)
{
    struct gpu *gpu = tracer->gpu;
    VkDescriptorSetLayoutBinding bindings[NUM_BINDINGS];
    for (uint32_t i = 0; i < NUM_BINDINGS; ++i)
        bindings[i] = (VkDescriptorSetLayoutBinding){
            i,
            i < NUM_BUFFERS ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
                            : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
            1, VK_SHADER_STAGE_COMPUTE_BIT, NULL};
    const VkDescriptorSetLayoutCreateInfo layout = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = NUM_BINDINGS,
        .pBindings = bindings};
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, NUM_BUFFERS},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1}};
    const VkDescriptorPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                             .maxSets = 1,
                                             .poolSizeCount = 2,
                                             .pPoolSizes = sizes};
    if (!gpu_check(gpu,
                   vkCreateDescriptorSetLayout(gpu->device, &layout, NULL, &tracer->set_layout),
                   "making a set layout")
        || !gpu_check(gpu, vkCreateDescriptorPool(gpu->device, &pool, NULL, &tracer->pool),
                      "making a descriptor pool"))
        return false;
    const VkDescriptorSetAllocateInfo set = {.sType =
                                                 VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                             .descriptorPool = tracer->pool,
                                             .descriptorSetCount = 1,
                                             .pSetLayouts = &tracer->set_layout};
    return gpu_check(gpu, vkAllocateDescriptorSets(gpu->device, &set, &tracer->set),
                     "making a descriptor set");
}

static void write_set(struct tracer *tracer)
{
    for (uint32_t i = 0; i < NUM_BINDINGS; ++i) {
        bool is_buffer = i < NUM_BUFFERS;
        const VkDescriptorBufferInfo buffer = {
            is_buffer ? tracer->buffers[i].buffer : VK_NULL_HANDLE, 0, VK_WHOLE_SIZE};
        const VkDescriptorImageInfo image = {tracer->sampler, tracer->environment.view,
                                             VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
        const VkWriteDescriptorSet write = {
            .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
            .dstSet = tracer->set,
            .dstBinding = i,
            .descriptorCount = 1,
            .descriptorType = is_buffer ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
                                        : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
            .pBufferInfo = &buffer,
            .pImageInfo = &image};
        vkUpdateDescriptorSets(tracer->gpu->device, 1, &write, 0, NULL);
    }
}

static bool create_pipeline(struct tracer *tracer)
{
    struct gpu *gpu = tracer->gpu;
    const struct compiled_stage *code = &tracer->compiled.stages[MXG_STAGE_PIXEL];
    VkDescriptorSetLayout layouts[DRAW_MAX_SETS + 1];
    memcpy(layouts, tracer->inputs.set_layouts, sizeof tracer->inputs.set_layouts);
    layouts[tracer->inputs.num_sets] = tracer->set_layout;
    const VkPushConstantRange camera = {VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(struct camera)};
    const VkPipelineLayoutCreateInfo layout = {.sType =
                                                   VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                               .setLayoutCount = tracer->inputs.num_sets + 1,
                                               .pSetLayouts = layouts,
                                               .pushConstantRangeCount = 1,
                                               .pPushConstantRanges = &camera};
    const VkShaderModuleCreateInfo module = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                             .codeSize = code->num_words * sizeof(uint32_t),
                                             .pCode = code->words};
    if (!gpu_check(gpu, vkCreatePipelineLayout(gpu->device, &layout, NULL, &tracer->layout),
                   "making a pipeline layout")
        || !gpu_check(gpu, vkCreateShaderModule(gpu->device, &module, NULL, &tracer->module),
                      "loading the shader"))
        return false;
    const VkComputePipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = tracer->module,
                  .pName = "main"},
        .layout = tracer->layout};
    VkResult result =
        vkCreateComputePipelines(gpu->device, VK_NULL_HANDLE, 1, &info, NULL, &tracer->pipeline);
    return gpu_check(gpu, result, "compiling the shader");
}

/* ---- Running ---- */

static struct camera make_camera(const struct tracer *tracer)
{
    const struct scene *scene = tracer->bind->scene;
    struct matrix axes = matrix_transpose(scene->view); /* of a rotation: its inverse */
    struct camera camera = {.frame = {tracer->width, tracer->height, 0, 0}};
    camera.eye[3] = (float)tracer->options->bounces;
    camera.right[3] = tracer->options->as_drawn ? 1 : 0;
    camera.up[3] = tracer->options->dark ? 0 : 1;
    for (size_t i = 0; i < 3; ++i) {
        camera.eye[i] = (float)scene->eye[i];
        camera.right[i] = (float)(axes.m[0][i] / scene->projection.m[0][0]);
        camera.up[i] = (float)(axes.m[1][i] / scene->projection.m[1][1]);
        camera.forward[i] = (float)-axes.m[2][i];
        for (size_t c = 0; c < 3; ++c)
            camera.environment[c][i] = (float)scene->environment.m[c][i];
    }
    return camera;
}

/* Runs one invocation per element of an area. */
static bool run(struct tracer *tracer, const struct camera *camera, uint32_t width, uint32_t height)
{
    VkCommandBuffer commands = gpu_begin(tracer->gpu);
    if (!commands)
        return false;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, tracer->pipeline);
    if (tracer->inputs.num_sets)
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, tracer->layout, 0,
                                tracer->inputs.num_sets, tracer->inputs.sets, 0, NULL);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, tracer->layout,
                            tracer->inputs.num_sets, 1, &tracer->set, 0, NULL);
    vkCmdPushConstants(commands, tracer->layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof *camera,
                       camera);
    vkCmdDispatch(commands, (width + GROUP - 1) / GROUP, (height + GROUP - 1) / GROUP, 1);
    return gpu_end(tracer->gpu, commands);
}

/* Evaluates the displacement of the corners in the shader, and moves them. */
static bool displace(struct tracer *tracer)
{
    enum { ROW = 1024 };
    uint32_t count = 3 * tracer->bvh.num_triangles;
    const struct camera camera = {.forward = {0, 0, 0, 1}, .frame = {ROW, count, 0, 0}};
    if (!run(tracer, &camera, ROW, (count + ROW - 1) / ROW))
        return false;
    if (!bvh_move(&tracer->bvh, tracer->buffers[2].mapped))
        return fail(tracer, "render-failed", "out of memory");
    memcpy(tracer->buffers[0].mapped, tracer->bvh.nodes,
           tracer->bvh.num_nodes * sizeof *tracer->bvh.nodes);
    memcpy(tracer->buffers[1].mapped, tracer->bvh.corners, count * sizeof *tracer->bvh.corners);
    memset(tracer->buffers[2].mapped, 0, count * 4 * sizeof(float));
    return true;
}

static bool open(struct tracer *tracer)
{
    if (!bvh_build(&tracer->bind->scene->mesh, &tracer->bvh))
        return fail(tracer, "render-failed", "out of memory");
    if (!bind_shader(tracer->bind)
        || !inputs_create(tracer->gpu, &tracer->bind->draw, &tracer->inputs) || !compile(tracer)
        || !create_buffers(tracer) || !create_set(tracer))
        return false;
    write_set(tracer);
    return create_pipeline(tracer) && (!tracer->info.displaced || displace(tracer));
}

static void close(struct tracer *tracer)
{
    struct gpu *gpu = tracer->gpu;
    vkDestroyPipeline(gpu->device, tracer->pipeline, NULL);
    vkDestroyShaderModule(gpu->device, tracer->module, NULL);
    vkDestroyPipelineLayout(gpu->device, tracer->layout, NULL);
    vkDestroyDescriptorPool(gpu->device, tracer->pool, NULL);
    vkDestroyDescriptorSetLayout(gpu->device, tracer->set_layout, NULL);
    vkDestroySampler(gpu->device, tracer->sampler, NULL);
    gpu_destroy_image(gpu, &tracer->environment);
    for (size_t i = 0; i < NUM_BUFFERS; ++i)
        gpu_destroy_buffer(gpu, &tracer->buffers[i]);
    inputs_destroy(gpu, &tracer->bind->draw, &tracer->inputs);
    compiled_finish(&tracer->compiled);
    bvh_finish(&tracer->bvh);
}

bool trace_picture(struct gpu *gpu, struct bind *bind, uint32_t width, uint32_t height,
                   const struct trace_options *options, float *out_pixels)
{
    struct tracer tracer = {.gpu = gpu,
                            .bind = bind,
                            .options = options,
                            .info = {sizeof tracer.info},
                            .width = width,
                            .height = height};
    mxg_result_info(bind->result, &tracer.info);
    uint32_t samples = options->paths;
    bool good = open(&tracer);
    struct camera camera = make_camera(&tracer);
    for (uint32_t done = 0; good && done < samples; done += camera.frame[3]) {
        camera.frame[2] = done;
        camera.frame[3] = samples - done < SAMPLES_AT_ONCE ? samples - done : SAMPLES_AT_ONCE;
        good = run(&tracer, &camera, width, height);
        if (options->progress)
            options->progress(options->progress_data, done + camera.frame[3], samples);
    }
    for (size_t i = 0; good && i < (size_t)width * height * 4; ++i)
        out_pixels[i] = ((const float *)tracer.buffers[2].mapped)[i] / (float)samples;
    if (!good && gpu->reason[0] && !bind->reason[0])
        fail(&tracer, gpu->id, gpu->reason);
    close(&tracer);
    return good;
}
