// SPDX-License-Identifier: Apache-2.0
#include "render/draw.h"

#include "render/descriptors.h"
#include "render/stored.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COLOR_FORMAT VK_FORMAT_R32G32B32A32_SFLOAT
#define DEPTH_FORMAT VK_FORMAT_D32_SFLOAT

struct draw_canvas {
    struct gpu *gpu;
    uint32_t width, height;
    struct gpu_image depth;
    float clear[4];
    uint32_t num_outputs; /* the colour is the first */
    enum draw_output kinds[DRAW_MAX_OUTPUTS];
    struct gpu_image outputs[DRAW_MAX_OUTPUTS];
    struct gpu_buffer readbacks[DRAW_MAX_OUTPUTS];
    struct stored *stored; /* NULL: no program stores */
    VkQueryPool clock;     /* when a frame begins and ends; absent where the device has no clock */
};

/* The buffers of an object. */
struct object_buffers {
    struct gpu_buffer indices, attributes[DRAW_MAX_ATTRIBUTES];
};

struct draw_program {
    struct gpu *gpu;
    const struct draw *draw;
    struct object_buffers *objects;
    struct inputs inputs;
    VkPipelineLayout layout;
    VkShaderModule modules[2];
    VkPipeline pipeline;
    VkPipeline depth_pipeline; /* draws before programs store; may be absent */
};

/* ---- Resources ---- */

static VkFormat format_of(enum draw_output kind)
{
    return kind == DRAW_WHOLE ? VK_FORMAT_R32_SINT : COLOR_FORMAT;
}

bool draw_add_output(struct draw_canvas *canvas, enum draw_output kind)
{
    uint32_t i = canvas->num_outputs;
    size_t texel = kind == DRAW_WHOLE ? sizeof(int32_t) : 4 * sizeof(float);
    assert(i < DRAW_MAX_OUTPUTS);
    canvas->kinds[i] = kind;
    canvas->num_outputs = i + 1;
    VkImageUsageFlags usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    if (i == 0)
        usage |= VK_IMAGE_USAGE_STORAGE_BIT; /* the passes of stored.h write the colour */
    return gpu_create_image(canvas->gpu, format_of(kind), canvas->width, canvas->height, 0, 1,
                            usage, VK_IMAGE_ASPECT_COLOR_BIT, &canvas->outputs[i])
           && gpu_create_buffer(canvas->gpu, VK_BUFFER_USAGE_TRANSFER_DST_BIT, NULL,
                                (size_t)canvas->width * canvas->height * texel,
                                &canvas->readbacks[i]);
}

void draw_read_output(const struct draw_canvas *canvas, uint32_t location, float *out_pixels)
{
    const struct gpu_buffer *readback = &canvas->readbacks[location];
    size_t pixels = (size_t)canvas->width * canvas->height;
    assert(location < canvas->num_outputs);
    if (canvas->kinds[location] != DRAW_WHOLE) {
        memcpy(out_pixels, readback->mapped, readback->size);
        return;
    }
    for (size_t i = 0; i < pixels; ++i) {
        out_pixels[4 * i] = (float)((const int32_t *)readback->mapped)[i];
        out_pixels[4 * i + 1] = out_pixels[4 * i + 2] = out_pixels[4 * i + 3] = 0;
    }
}

static bool create_clock(struct draw_canvas *canvas)
{
    const VkQueryPoolCreateInfo info = {.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                        .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                        .queryCount = 2};
    struct gpu *gpu = canvas->gpu;
    return gpu->tick <= 0
           || gpu_check(gpu, vkCreateQueryPool(gpu->device, &info, NULL, &canvas->clock),
                        "making a clock");
}

struct draw_canvas *draw_open_canvas(struct gpu *gpu, uint32_t width, uint32_t height)
{
    struct draw_canvas *canvas = calloc(1, sizeof *canvas);
    if (!canvas) {
        gpu_check(gpu, VK_ERROR_OUT_OF_HOST_MEMORY, "preparing to draw");
        return NULL;
    }
    *canvas = (struct draw_canvas){.gpu = gpu, .width = width, .height = height};
    if (draw_add_output(canvas, DRAW_BLENDED)
        && gpu_create_image(gpu, DEPTH_FORMAT, width, height, 0, 1,
                            VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                | VK_IMAGE_USAGE_SAMPLED_BIT,
                            VK_IMAGE_ASPECT_DEPTH_BIT, &canvas->depth)
        && create_clock(canvas))
        return canvas;
    draw_close_canvas(canvas);
    return NULL;
}

struct gpu *draw_gpu(const struct draw_canvas *canvas)
{
    return canvas->gpu;
}

void draw_size(const struct draw_canvas *canvas, uint32_t *out_width, uint32_t *out_height)
{
    *out_width = canvas->width;
    *out_height = canvas->height;
}

struct stored *draw_store(struct draw_canvas *canvas, uint32_t words)
{
    uint32_t layers = words > STORED_TARGETS ? words - STORED_TARGETS : 0;
    canvas->stored = stored_open(canvas->gpu, canvas->width, canvas->height, layers,
                                 &canvas->outputs[0], &canvas->depth);
    return canvas->stored;
}

void draw_close_canvas(struct draw_canvas *canvas)
{
    if (!canvas)
        return;
    stored_close(canvas->stored);
    vkDestroyQueryPool(canvas->gpu->device, canvas->clock, NULL);
    for (uint32_t i = 0; i < canvas->num_outputs; ++i) {
        gpu_destroy_buffer(canvas->gpu, &canvas->readbacks[i]);
        gpu_destroy_image(canvas->gpu, &canvas->outputs[i]);
    }
    gpu_destroy_image(canvas->gpu, &canvas->depth);
    free(canvas);
}

static bool owns_indices(const struct draw *draw, uint32_t object)
{
    return draw->blend || !draw->objects[object].twin;
}

static bool create_buffers(struct draw_program *program)
{
    const struct draw *draw = program->draw;
    bool good = true;
    program->objects = calloc(draw->num_objects, sizeof *program->objects);
    if (!program->objects)
        return gpu_check(program->gpu, VK_ERROR_OUT_OF_HOST_MEMORY, "preparing to draw");
    for (uint32_t o = 0; good && o < draw->num_objects; ++o) {
        const struct draw_object *object = &draw->objects[o];
        if (object->twin)
            program->objects[o] = program->objects[object->twin - 1];
        if (owns_indices(draw, o))
            good = gpu_create_buffer(program->gpu, VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                                     object->indices, object->num_indices * sizeof *object->indices,
                                     &program->objects[o].indices);
        for (uint32_t i = 0; good && !object->twin && i < draw->num_attributes; ++i)
            good = gpu_create_buffer(program->gpu, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                                     object->attributes[i], (size_t)object->num_vertices * 16,
                                     &program->objects[o].attributes[i]);
    }
    return good;
}

static bool create_layout(struct draw_program *program, const struct draw_canvas *canvas)
{
    VkDescriptorSetLayout layouts[DRAW_MAX_SETS + 1];
    uint32_t count = program->inputs.num_sets;
    memcpy(layouts, program->inputs.set_layouts, sizeof program->inputs.set_layouts);
    if (program->draw->role == DRAW_STORES)
        layouts[count++] = stored_set_layout(canvas->stored);
    const VkPipelineLayoutCreateInfo info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                             .setLayoutCount = count,
                                             .pSetLayouts = layouts};
    return gpu_check(program->gpu,
                     vkCreatePipelineLayout(program->gpu->device, &info, NULL, &program->layout),
                     "making a pipeline layout");
}

/* ---- Pipeline ---- */

static bool create_modules(struct draw_program *program)
{
    bool good = true;
    for (int i = 0; good && i < 2; ++i)
        good = gpu_load_shader(program->gpu, program->draw->code[i], program->draw->code_words[i],
                               &program->modules[i]);
    return good;
}

static VkPipelineVertexInputStateCreateInfo vertex_input(
    const struct draw *draw, VkVertexInputBindingDescription *bindings,
    VkVertexInputAttributeDescription *attributes)
{
    for (uint32_t i = 0; i < draw->num_attributes; ++i) {
        bindings[i] = (VkVertexInputBindingDescription){i, 16, VK_VERTEX_INPUT_RATE_VERTEX};
        attributes[i] = (VkVertexInputAttributeDescription){draw->attributes[i].location, i,
                                                            draw->attributes[i].format, 0};
    }
    return (VkPipelineVertexInputStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = draw->num_attributes,
        .pVertexBindingDescriptions = bindings,
        .vertexAttributeDescriptionCount = draw->num_attributes,
        .pVertexAttributeDescriptions = attributes};
}

/* Colours are premultiplied. What lies behind is scaled by 1 - alpha, or by the second source. */
static VkPipelineColorBlendAttachmentState premultiplied_blending(bool enabled, bool is_dual)
{
    return (VkPipelineColorBlendAttachmentState){
        .blendEnable = enabled,
        .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstColorBlendFactor =
            is_dual ? VK_BLEND_FACTOR_SRC1_COLOR : VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
        .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
        .colorWriteMask = 0xf,
    };
}

/* The ways in which a program draws. */
enum draw_way {
    WAY_LIT,     /* to a picture */
    WAY_DEPTH,   /* depth alone, before the program stores */
    WAY_CUT,     /* the same with holes */
    WAY_STORED,  /* to the images of stored.h, where its depth is in front */
    WAY_TARGETS, /* to the targets of stored.h alone, with its depth */
    NUM_WAYS
};
static const struct {
    uint32_t num_targets, num_stages;
    VkCompareOp compare;
    bool writes_depth;
} ways[NUM_WAYS] = {
    [WAY_LIT] = {1, 2, VK_COMPARE_OP_LESS, true},
    [WAY_DEPTH] = {0, 1, VK_COMPARE_OP_LESS, true},
    [WAY_CUT] = {0, 2, VK_COMPARE_OP_LESS, true},
    [WAY_STORED] = {1 + STORED_TARGETS, 2, VK_COMPARE_OP_EQUAL, false},
    [WAY_TARGETS] = {1 + STORED_TARGETS, 2, VK_COMPARE_OP_LESS, true},
};
enum {
    MAX_TARGETS = DRAW_MAX_OUTPUTS > 1 + STORED_TARGETS ? DRAW_MAX_OUTPUTS : 1 + STORED_TARGETS
};

static uint32_t num_targets_of(const struct draw_canvas *canvas, enum draw_way way)
{
    return way == WAY_LIT ? canvas->num_outputs : ways[way].num_targets;
}

static bool create_pipeline(struct draw_program *program, const struct draw_canvas *canvas,
                            enum draw_way way, VkPipeline *out)
{
    const struct draw *draw = program->draw;
    const VkPipelineShaderStageCreateInfo stages[2] = {
        gpu_stage(VK_SHADER_STAGE_VERTEX_BIT, program->modules[0]),
        gpu_stage(VK_SHADER_STAGE_FRAGMENT_BIT, program->modules[1]),
    };
    VkVertexInputBindingDescription bindings[DRAW_MAX_ATTRIBUTES];
    VkVertexInputAttributeDescription attributes[DRAW_MAX_ATTRIBUTES];
    const VkPipelineVertexInputStateCreateInfo input = vertex_input(draw, bindings, attributes);
    /* A negative height turns the picture so that clip space has y upwards, as in OpenGL. */
    const VkViewport viewport = {
        0, (float)canvas->height, (float)canvas->width, -(float)canvas->height, 0, 1};
    const VkRect2D scissor = {{0, 0}, {canvas->width, canvas->height}};
    const VkPipelineViewportStateCreateInfo viewports = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .pViewports = &viewport,
        .scissorCount = 1,
        .pScissors = &scissor};
    const VkPipelineRasterizationStateCreateInfo raster = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .cullMode = VK_CULL_MODE_NONE,
        .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
        .lineWidth = 1.0f};
    const VkPipelineDepthStencilStateCreateInfo depth = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = VK_TRUE,
        .depthWriteEnable = ways[way].writes_depth && !draw->blend,
        .depthCompareOp = ways[way].compare};
    VkPipelineColorBlendAttachmentState blends[MAX_TARGETS];
    VkFormat formats[MAX_TARGETS];
    uint32_t num_targets = num_targets_of(canvas, way);
    for (uint32_t i = 0; i < num_targets; ++i) {
        bool blends_here = way != WAY_LIT || canvas->kinds[i] == DRAW_BLENDED;
        blends[i] = premultiplied_blending(draw->blend && blends_here, draw->blends_twice);
        formats[i] = way == WAY_LIT ? format_of(canvas->kinds[i]) : stored_target_format(i);
    }
    const VkPipelineRenderingCreateInfo rendering = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .colorAttachmentCount = num_targets,
        .pColorAttachmentFormats = formats,
        .depthAttachmentFormat = DEPTH_FORMAT,
    };
    const VkPipelineColorBlendStateCreateInfo blending = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = num_targets,
        .pAttachments = blends};
    const VkGraphicsPipelineCreateInfo info = {.sType =
                                                   VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                               .pNext = &rendering,
                                               .stageCount = ways[way].num_stages,
                                               .pStages = stages,
                                               .pVertexInputState = &input,
                                               .pInputAssemblyState = &gpu_triangles,
                                               .pViewportState = &viewports,
                                               .pRasterizationState = &raster,
                                               .pMultisampleState = &gpu_one_sample,
                                               .pDepthStencilState = &depth,
                                               .pColorBlendState = &blending,
                                               .layout = program->layout};
    VkResult result =
        vkCreateGraphicsPipelines(program->gpu->device, VK_NULL_HANDLE, 1, &info, NULL, out);
    return gpu_check(program->gpu, result, "compiling the shader");
}

static bool create_pipelines(struct draw_program *program, const struct draw_canvas *canvas)
{
    const struct draw *draw = program->draw;
    if (draw->role == DRAW_LIT)
        return create_pipeline(program, canvas, WAY_LIT, &program->pipeline);
    if (draw->role == DRAW_CUTS)
        return create_pipeline(program, canvas, WAY_CUT, &program->depth_pipeline);
    if (!draw->stores_layers && !draw->has_holes)
        return create_pipeline(program, canvas, WAY_TARGETS, &program->pipeline);
    return create_pipeline(program, canvas, WAY_STORED, &program->pipeline)
           && (draw->has_holes
               || create_pipeline(program, canvas, WAY_DEPTH, &program->depth_pipeline));
}

/* ---- Drawing ---- */

static void begin_rendering(const struct draw_canvas *canvas, VkCommandBuffer commands,
                            enum draw_way way, VkAttachmentLoadOp load,
                            VkAttachmentLoadOp load_depth)
{
    VkRenderingAttachmentInfo targets[MAX_TARGETS];
    for (uint32_t i = 0; i < num_targets_of(canvas, way); ++i)
        targets[i] = (VkRenderingAttachmentInfo){
            .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView =
                way == WAY_LIT ? canvas->outputs[i].view : stored_target(canvas->stored, i),
            .imageLayout = VK_IMAGE_LAYOUT_GENERAL,
            .loadOp = way == WAY_LIT && i > 0 ? VK_ATTACHMENT_LOAD_OP_CLEAR : load,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    if (way == WAY_LIT)
        memcpy(targets[0].clearValue.color.float32, canvas->clear, sizeof canvas->clear);
    const VkRenderingAttachmentInfo depth = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                             .imageView = canvas->depth.view,
                                             .imageLayout = VK_IMAGE_LAYOUT_GENERAL,
                                             .loadOp = load_depth,
                                             .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                             .clearValue = {.depthStencil = {.depth = 1.0f}}};
    const VkRenderingInfo info = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {{0, 0}, {canvas->width, canvas->height}},
                                  .layerCount = 1,
                                  .colorAttachmentCount = num_targets_of(canvas, way),
                                  .pColorAttachments = targets,
                                  .pDepthAttachment = &depth};
    vkCmdBeginRendering(commands, &info);
}

void draw_clear_to(struct draw_canvas *canvas, const float rgba[4])
{
    memcpy(canvas->clear, rgba, sizeof canvas->clear);
}

/* A draw call. */
struct call {
    const struct draw_program *program;
    uint32_t object;
};

static int compare_calls(const void *a, const void *b)
{
    const struct call *x = a, *y = b;
    bool blends = x->program->draw->blend;
    if (blends != y->program->draw->blend)
        return blends ? 1 : -1;
    double near = x->program->draw->objects[x->object].distance,
           far = y->program->draw->objects[y->object].distance;
    return blends ? (near < far) - (near > far) : 0;
}

/* The calls in their order; free. */
static struct call *sort_calls(struct draw_program *const *programs, size_t count,
                               size_t *out_count)
{
    size_t total = 0;
    for (size_t i = 0; i < count; ++i)
        total += programs[i]->draw->num_objects;
    struct call *calls = malloc((total + 1) * sizeof *calls);
    *out_count = 0;
    for (size_t i = 0; calls && i < count; ++i)
        for (uint32_t o = 0; o < programs[i]->draw->num_objects; ++o)
            calls[(*out_count)++] = (struct call){programs[i], o};
    if (calls)
        qsort(calls, total, sizeof *calls, compare_calls);
    return calls;
}

static void record_call(const struct draw_canvas *canvas, const struct call *call,
                        enum draw_way way, VkCommandBuffer commands)
{
    const struct draw_program *program = call->program;
    const struct draw *draw = program->draw;
    const struct object_buffers *buffers = &program->objects[call->object];
    const VkDeviceSize zero = 0;
    inputs_bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, program->layout, draw, &program->inputs,
                call->object);
    for (uint32_t i = 0; i < draw->num_attributes; ++i)
        vkCmdBindVertexBuffers(commands, i, 1, &buffers->attributes[i].buffer, &zero);
    vkCmdBindIndexBuffer(commands, buffers->indices.buffer, 0, VK_INDEX_TYPE_UINT32);
    if (draw->role == DRAW_STORES) {
        VkDescriptorSet set = stored_set(canvas->stored);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, program->layout,
                                program->inputs.num_sets, 1, &set, 0, NULL);
    }
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      way == WAY_DEPTH ? program->depth_pipeline : program->pipeline);
    vkCmdDrawIndexed(commands, draw->objects[call->object].num_indices, 1, 0, 0, 0);
}

static bool takes_part(const struct draw_program *program, enum draw_way way)
{
    if (way == WAY_DEPTH)
        return program->depth_pipeline != VK_NULL_HANDLE;
    return program->draw->role == (way == WAY_LIT ? DRAW_LIT : DRAW_STORES);
}

static void record_calls(const struct draw_canvas *canvas, const struct call *calls, size_t count,
                         enum draw_way way, VkCommandBuffer commands)
{
    for (size_t i = 0; i < count; ++i)
        if (takes_part(calls[i].program, way))
            record_call(canvas, &calls[i], way, commands);
    vkCmdEndRendering(commands);
}

static void record_stored(const struct draw_canvas *canvas, const struct call *calls, size_t count,
                          VkCommandBuffer commands)
{
    const VkAttachmentLoadOp clear = VK_ATTACHMENT_LOAD_OP_CLEAR;
    begin_rendering(canvas, commands, WAY_DEPTH, clear, clear);
    record_calls(canvas, calls, count, WAY_DEPTH, commands);
    stored_barrier(commands);
    begin_rendering(canvas, commands, WAY_STORED, clear, VK_ATTACHMENT_LOAD_OP_LOAD);
    record_calls(canvas, calls, count, WAY_STORED, commands);
    stored_run(canvas->stored, commands);
}

/* The first or second time of a frame. */
static void record_time(const struct draw_canvas *canvas, uint32_t i, VkCommandBuffer commands)
{
    if (!canvas->clock)
        return;
    if (i == 0)
        vkCmdResetQueryPool(commands, canvas->clock, 0, 2);
    vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, canvas->clock, i);
}

static void record_copies(const struct draw_canvas *canvas, VkCommandBuffer commands)
{
    for (uint32_t i = 0; i < canvas->num_outputs; ++i) {
        const VkBufferImageCopy copy = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                        .imageExtent = {canvas->width, canvas->height, 1}};
        gpu_image_barrier(commands, canvas->outputs[i].image, VK_IMAGE_ASPECT_COLOR_BIT, 0, 1,
                          VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        vkCmdCopyImageToBuffer(commands, canvas->outputs[i].image,
                               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, canvas->readbacks[i].buffer, 1,
                               &copy);
    }
}

static void record(const struct draw_canvas *canvas, const struct call *calls, size_t count,
                   VkCommandBuffer commands)
{
    VkAttachmentLoadOp load = VK_ATTACHMENT_LOAD_OP_CLEAR;
    for (uint32_t i = 0; i < canvas->num_outputs; ++i)
        gpu_image_barrier(commands, canvas->outputs[i].image, VK_IMAGE_ASPECT_COLOR_BIT, 0, 1,
                          VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
    gpu_image_barrier(commands, canvas->depth.image, VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1,
                      VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
    record_time(canvas, 0, commands);
    if (canvas->stored) {
        stored_begin(canvas->stored, commands);
        record_stored(canvas, calls, count, commands);
        load = VK_ATTACHMENT_LOAD_OP_LOAD;
    }
    begin_rendering(canvas, commands, WAY_LIT, load, load);
    record_calls(canvas, calls, count, WAY_LIT, commands);
    record_time(canvas, 1, commands);
    record_copies(canvas, commands);
}

static void update(struct draw_program *program)
{
    const struct draw *draw = program->draw;
    inputs_update(draw, &program->inputs);
    for (uint32_t o = 0; draw->blend && o < draw->num_objects; ++o)
        memcpy(program->objects[o].indices.mapped, draw->objects[o].indices,
               draw->objects[o].num_indices * sizeof *draw->objects[o].indices);
}

bool draw_frame(struct draw_canvas *canvas, struct draw_program *const *programs, size_t count,
                float *out_pixels)
{
    size_t num_calls;
    struct call *calls = sort_calls(programs, count, &num_calls);
    VkCommandBuffer commands = calls ? gpu_begin(canvas->gpu) : NULL;
    bool good = commands != NULL;
    if (!calls)
        gpu_check(canvas->gpu, VK_ERROR_OUT_OF_HOST_MEMORY, "preparing to draw");
    for (size_t i = 0; good && i < count; ++i)
        update(programs[i]);
    if (good)
        record(canvas, calls, num_calls, commands);
    free(calls);
    if (!good || !gpu_end(canvas->gpu, commands))
        return false;
    draw_read_output(canvas, 0, out_pixels);
    return true;
}

bool draw_frame_seconds(const struct draw_canvas *canvas, double *out)
{
    uint64_t times[2];
    struct gpu *gpu = canvas->gpu;
    if (!canvas->clock
        || vkGetQueryPoolResults(gpu->device, canvas->clock, 0, 2, sizeof times, times,
                                 sizeof *times, VK_QUERY_RESULT_64_BIT)
               != VK_SUCCESS)
        return false;
    *out = gpu->tick * (double)((times[1] - times[0]) & gpu->ticks);
    return true;
}

struct draw_program *draw_open(struct draw_canvas *canvas, const struct draw *draw)
{
    struct gpu *gpu = canvas->gpu;
    struct draw_program *program = calloc(1, sizeof *program);
    if (!program) {
        gpu_check(gpu, VK_ERROR_OUT_OF_HOST_MEMORY, "preparing to draw");
        return NULL;
    }
    program->gpu = gpu;
    program->draw = draw;
    if (draw->blends_twice && !gpu->blends_twice) {
        gpu->id = "no-device";
        snprintf(gpu->reason, sizeof gpu->reason,
                 "the device cannot blend with a second source, as '--transparency dual' needs");
    } else if (create_buffers(program)
               && inputs_create(program->gpu, draw, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC,
                                &program->inputs)
               && create_layout(program, canvas) && create_modules(program)
               && create_pipelines(program, canvas))
        return program;
    draw_close(program);
    return NULL;
}

void draw_close(struct draw_program *program)
{
    if (!program)
        return;
    struct gpu *gpu = program->gpu;
    vkDestroyPipeline(gpu->device, program->pipeline, NULL);
    vkDestroyPipeline(gpu->device, program->depth_pipeline, NULL);
    for (int i = 0; i < 2; ++i)
        vkDestroyShaderModule(gpu->device, program->modules[i], NULL);
    vkDestroyPipelineLayout(gpu->device, program->layout, NULL);
    inputs_destroy(gpu, program->draw, &program->inputs);
    for (uint32_t o = 0; program->objects && o < program->draw->num_objects; ++o) {
        for (uint32_t i = 0; !program->draw->objects[o].twin && i < program->draw->num_attributes;
             ++i)
            gpu_destroy_buffer(gpu, &program->objects[o].attributes[i]);
        if (owns_indices(program->draw, o))
            gpu_destroy_buffer(gpu, &program->objects[o].indices);
    }
    free(program->objects);
    free(program);
}
