// SPDX-License-Identifier: Apache-2.0
#include "render/trace.h"

#include "render/bvh.h"
#include "render/each.h"
#include "render/importance.h"
#include "render/inside.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The tracer's buffers, as bindings of its set in path.glsl. */
enum {
    NODES,
    CORNERS,
    FILM,
    SUMS,
    OBJECTS,
    VALUES,
    PATHS,
    WAITING,
    AOVS,
    MEDIA,
    CAMERA,
    NUM_BUFFERS,
    NUM_BINDINGS = NUM_BUFFERS + 1,
    MOST_AROUND = 4,    /* media around one */
    ROW = 4096,         /* invocations of programs that prepare, side by side */
    MEASURED_SIDE = 32, /* cells along each edge of a volume's box */
    MEASURED = MEASURED_SIDE * MEASURED_SIDE * MEASURED_SIDE,
    SAMPLES_AT_ONCE = 16
};

/* The types of GLSL in a buffer (layout std430), for its structs. A typedef has no alignment. */
typedef unsigned int uint;
typedef float floats2[2], floats3[3], floats4[4], floats4x4[4][4];
typedef uint uints4[4];
#define vec2 _Alignas(8) floats2
#define vec3 _Alignas(16) floats3
#define vec4 _Alignas(16) floats4
#define uvec4 _Alignas(16) uints4
#define mat4 _Alignas(16) floats4x4
typedef struct Hit Hit;
typedef struct Medium Medium;
typedef struct Shadow Shadow;
#include "render/path_structs.glsl"
#undef vec2
#undef vec3
#undef vec4
#undef uvec4
#undef mat4
_Static_assert(sizeof(struct Node) == sizeof(struct bvh_node)
                   && sizeof(struct Corner) == sizeof(struct bvh_corner),
               "the tree has the structs of path_structs.glsl");

struct tracer {
    struct gpu *gpu;
    const struct trace_options *options;
    struct kernel *kernels;
    size_t num_kernels;
    uint32_t num_shaders;
    const struct scene_object **objects; /* of all kernels, in their order */
    uint32_t num_objects;
    struct bvh bvh;
    struct gpu_buffer buffers[NUM_BUFFERS];
    struct gpu_image environment;
    VkSampler sampler;
    VkDescriptorSetLayout set_layout;
    VkDescriptorPool pool;
    VkDescriptorSet set;
    uint32_t width, height;
};

static const struct scene *scene_of(const struct tracer *tracer)
{
    return tracer->kernels[0].bind->scene;
}

static bool fail_for_memory(struct tracer *tracer)
{
    return kernel_fail(&tracer->kernels[0], "render-failed", "out of memory");
}

/* ---- Objects ---- */

static bool collect_objects(struct tracer *tracer)
{
    for (size_t k = 0; k < tracer->num_kernels; ++k)
        tracer->num_objects += tracer->kernels[k].bind->num_objects;
    tracer->objects = calloc(tracer->num_objects + 1, sizeof(struct scene_object *));
    uint32_t at = 0;
    for (size_t k = 0; tracer->objects && k < tracer->num_kernels; ++k)
        for (uint32_t o = 0; o < tracer->kernels[k].bind->num_objects; ++o)
            tracer->objects[at++] = &tracer->kernels[k].bind->objects[o];
    return tracer->objects || fail_for_memory(tracer);
}

static struct Object describe_object(const struct kernel *kernel, uint32_t object,
                                     size_t first_value)
{
    const struct scene_object *from = &kernel->bind->objects[object];
    struct Object out = {.shader = kernel->first_shader + (kernel->num_shaders > 1 ? object : 0),
                         .blocks_light = !kernel->info.transparent,
                         .first_value = (uint32_t)first_value,
                         .num_triangles = from->mesh.num_indices / 3};
    struct matrix to_object = matrix_inverse(from->world);
    for (size_t i = 0; i < 16; ++i)
        out.to_object[i / 4][i % 4] = (float)to_object.m[i / 4][i % 4];
    return out;
}

/* Fills the buffers of the objects and of their attributes. */
static bool create_objects(struct tracer *tracer)
{
    const VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    size_t num_values = 1; /* no buffer is empty */
    for (size_t k = 0; k < tracer->num_kernels; ++k)
        for (uint32_t o = 0; o < tracer->kernels[k].bind->num_objects; ++o)
            num_values += kernel_num_values(&tracer->kernels[k], o);
    if (!gpu_create_buffer(tracer->gpu, usage, NULL, tracer->num_objects * sizeof(struct Object),
                           &tracer->buffers[OBJECTS])
        || !gpu_create_buffer(tracer->gpu, usage, NULL, num_values * 4 * sizeof(float),
                              &tracer->buffers[VALUES]))
        return false;
    struct Object *object = tracer->buffers[OBJECTS].mapped;
    float(*values)[4] = tracer->buffers[VALUES].mapped;
    size_t first = 0;
    for (size_t k = 0; k < tracer->num_kernels; ++k)
        for (uint32_t o = 0; o < tracer->kernels[k].bind->num_objects; ++o) {
            *object++ = describe_object(&tracer->kernels[k], o, first);
            kernel_values(&tracer->kernels[k], o, values + first);
            first += kernel_num_values(&tracer->kernels[k], o);
        }
    return true;
}

/* ---- Device ---- */

/* True if a kernel has the program with this macro. */
static bool prepares(const struct tracer *tracer, const char *macro)
{
    bool any = false;
    for (size_t k = 0; k < tracer->num_kernels; ++k)
        any = any || strcmp(tracer->kernels[k].prepared, macro) == 0;
    return any;
}

/* The rows that the film needs: for two pictures, and for what programs write that prepare. */
static size_t count_rows(const struct tracer *tracer)
{
    size_t pixels = (size_t)tracer->width * tracer->height, rows = 2 * pixels,
           corners = 3 * (size_t)tracer->bvh.num_triangles;
    if (prepares(tracer, "DISPLACES") && rows < corners)
        rows = corners;
    if (prepares(tracer, "MEASURES") && rows < MEASURED)
        rows = MEASURED;
    return rows;
}

/* The most media that are kept around the one where a path is: an object may have parts inside each
 * other. */
static uint32_t most_around(const struct tracer *tracer)
{
    uint32_t parts = 2 * tracer->num_objects;
    return parts - 1 < MOST_AROUND ? parts - 1 : MOST_AROUND;
}

static bool create_buffers(struct tracer *tracer)
{
    struct gpu *gpu = tracer->gpu;
    const struct bvh *bvh = &tracer->bvh;
    size_t pixels = (size_t)tracer->width * tracer->height,
           corners = 3 * (size_t)bvh->num_triangles;
    size_t film = count_rows(tracer) * 4 * sizeof(float);
    size_t num_sums;
    float *sums = importance_of_map(&scene_of(tracer)->radiance, &num_sums);
    const struct {
        const void *data;
        size_t size;
        unsigned buffer;
    } made[] = {{bvh->nodes, bvh->num_nodes * sizeof *bvh->nodes, NODES},
                {bvh->corners, corners * sizeof *bvh->corners, CORNERS},
                {NULL, film, FILM},
                {sums, num_sums * sizeof *sums, SUMS},
                {NULL, pixels * sizeof(struct Path), PATHS},
                {NULL, most_around(tracer) * NUM_RAYS * pixels * sizeof(struct Medium), MEDIA},
                {NULL, tracer->num_shaders * sizeof(uint32_t), WAITING},
                {NULL, (aovs_stride(tracer->options->aovs) * pixels + 1) * 4 * sizeof(float), AOVS},
                {NULL, sizeof(struct Camera), CAMERA}};
    bool good = sums || fail_for_memory(tracer);
    for (size_t i = 0; good && i < sizeof made / sizeof *made; ++i)
        good = gpu_create_buffer(gpu, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, made[i].data,
                                 made[i].size, &tracer->buffers[made[i].buffer]);
    free(sums);
    if (!good || !create_objects(tracer))
        return false;
    memset(tracer->buffers[FILM].mapped, 0, film);
    memset(tracer->buffers[AOVS].mapped, 0, tracer->buffers[AOVS].size);
    const VkSamplerCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                      .magFilter = VK_FILTER_LINEAR,
                                      .minFilter = VK_FILTER_LINEAR,
                                      .addressModeU = VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                      .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                      .addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE};
    return gpu_upload_texture(gpu, &scene_of(tracer)->radiance, false, &tracer->environment)
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
            1, VK_SHADER_STAGE_FRAGMENT_BIT, NULL};
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

/* ---- Running ---- */

static struct Camera make_camera(const struct tracer *tracer)
{
    const struct scene *scene = scene_of(tracer);
    struct matrix axes = matrix_transpose(scene->view); /* of a rotation: its inverse */
    struct Camera camera = {.frame = {tracer->width, tracer->height, 0, 0}};
    camera.eye[3] = (float)tracer->options->bounces;
    camera.up[3] = tracer->options->dark ? 0 : 1;
    camera.forward[3] = (float)most_around(tracer);
    camera.environment[0][3] = (float)scene->near;
    for (size_t i = 0; i < 3; ++i) {
        camera.eye[i] = (float)scene->eye[i];
        camera.right[i] = (float)(axes.m[0][i] / scene->projection.m[0][0]);
        camera.up[i] = (float)(axes.m[1][i] / scene->projection.m[1][1]);
        camera.forward[i] = /* the middle of the frame */
            (float)(scene->projection.m[2][0] / scene->projection.m[0][0] * axes.m[0][i]
                    + scene->projection.m[2][1] / scene->projection.m[1][1] * axes.m[1][i]
                    - axes.m[2][i]);
        for (size_t c = 0; c < 3; ++c)
            camera.environment[c][i] = (float)scene->environment.m[c][i];
    }
    return camera;
}

static const struct kernel *kernel_of(const struct tracer *tracer, uint32_t shader)
{
    size_t k = 0;
    while (shader >= tracer->kernels[k].first_shader + tracer->kernels[k].num_shaders)
        ++k;
    return &tracer->kernels[k];
}

/* Runs one invocation of a shader, which traces or prepares, per element of an area. */
static bool run(struct tracer *tracer, uint32_t shader, bool is_first, struct Camera *camera,
                uint32_t width, uint32_t height)
{
    const struct kernel *kernel = kernel_of(tracer, shader);
    const struct kernel_program *program = is_first ? &kernel->prepares : &kernel->paths;
    VkCommandBuffer commands = gpu_begin(tracer->gpu);
    if (!commands)
        return false;
    camera->environment[1][3] = (float)shader;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, program->pipeline);
    inputs_bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, program->layout, &kernel->bind->draw,
                &kernel->inputs, shader - kernel->first_shader);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, program->layout,
                            kernel->inputs.num_sets, 1, &tracer->set, 0, NULL);
    memcpy(tracer->buffers[CAMERA].mapped, camera, sizeof *camera);
    each_run(commands, width, height);
    return gpu_end(tracer->gpu, commands);
}

/* The vertices that move: the corners of one have equal attributes. */
struct vertices {
    size_t *first;  /* by object: the number of its first vertex */
    uint32_t *rows; /* by vertex: its row in the film; UINT32_MAX: none */
    uint32_t num_rows;
};

static size_t vertex_of(const struct tracer *tracer, const struct vertices *vertices,
                        uint32_t corner)
{
    const struct bvh_corner *at = &tracer->bvh.corners[corner];
    const struct mesh *mesh = &tracer->objects[at->object]->mesh;
    return vertices->first[at->object] + mesh->indices[3 * at->triangle + corner % 3];
}

/* Writes a corner of each vertex to the film: its number, as a fourth component. */
static bool list_vertices(const struct tracer *tracer, struct vertices *out)
{
    const struct Object *objects = tracer->buffers[OBJECTS].mapped;
    float *film = tracer->buffers[FILM].mapped;
    out->first = calloc(tracer->num_objects + 1, sizeof *out->first);
    for (uint32_t o = 0; out->first && o < tracer->num_objects; ++o)
        out->first[o + 1] = out->first[o] + tracer->objects[o]->mesh.num_vertices;
    size_t size = out->first ? out->first[tracer->num_objects] * sizeof *out->rows : 0;
    out->rows = malloc(size + 1);
    if (!out->first || !out->rows)
        return false;
    memset(out->rows, 0xff, size);
    for (uint32_t c = 0; c < 3 * tracer->bvh.num_triangles; ++c) {
        uint32_t *row = &out->rows[vertex_of(tracer, out, c)];
        const struct Object *object = &objects[tracer->bvh.corners[c].object];
        if (*row != UINT32_MAX || !kernel_of(tracer, object->shader)->info.displaced)
            continue;
        memcpy(&film[4 * (size_t)out->num_rows + 3], &c, sizeof c);
        *row = out->num_rows++;
    }
    return true;
}

/* Replaces the rows of vertices by those of corners, from the last on: no corner stands before the
 * row of its vertex. */
static void place_corners(const struct tracer *tracer, const struct vertices *vertices)
{
    float *film = tracer->buffers[FILM].mapped;
    for (uint32_t c = 3 * tracer->bvh.num_triangles; c-- > 0;) {
        uint32_t row = vertices->rows[vertex_of(tracer, vertices, c)];
        for (size_t k = 0; k < 3; ++k) {
            float offset = row == UINT32_MAX ? 0 : film[4 * (size_t)row + k];
            film[4 * (size_t)c + k] = tracer->bvh.corners[c].rest[k] + offset;
        }
    }
}

/* Evaluates the displacement of the vertices in the shaders, and moves the corners. */
static bool displace_vertices(struct tracer *tracer, struct vertices *vertices)
{
    if (!list_vertices(tracer, vertices))
        return fail_for_memory(tracer);
    uint32_t count = vertices->num_rows;
    struct Camera camera = {.frame = {ROW, count, 0, 0}};
    for (size_t k = 0; k < tracer->num_kernels; ++k) {
        const struct kernel *kernel = &tracer->kernels[k];
        for (uint32_t i = 0; kernel->info.displaced && i < kernel->num_shaders; ++i)
            if (!run(tracer, kernel->first_shader + i, true, &camera, ROW, (count + ROW - 1) / ROW))
                return false;
    }
    place_corners(tracer, vertices);
    size_t corners = 3 * (size_t)tracer->bvh.num_triangles;
    float *film = tracer->buffers[FILM].mapped;
    if (!bvh_move(&tracer->bvh, film))
        return fail_for_memory(tracer);
    memcpy(tracer->buffers[NODES].mapped, tracer->bvh.nodes,
           tracer->bvh.num_nodes * sizeof *tracer->bvh.nodes);
    memcpy(tracer->buffers[CORNERS].mapped, tracer->bvh.corners,
           corners * sizeof *tracer->bvh.corners);
    memset(film, 0, corners * 4 * sizeof *film);
    return true;
}

static bool displace(struct tracer *tracer)
{
    struct vertices vertices = {0};
    bool good = displace_vertices(tracer, &vertices);
    free(vertices.first);
    free(vertices.rows);
    return good;
}

/* ---- Media ---- */

/* About the most extinction of a medium that varies, with something to spare. */
static bool measure_medium(struct tracer *tracer, uint32_t object, const struct inside_box *box)
{
    const float ROOM = 1.25f, FEWEST = 4; /* FEWEST: collisions along the diagonal of the box */
    struct Object *to = (struct Object *)tracer->buffers[OBJECTS].mapped + object;
    struct Camera camera = {.frame = {ROW, MEASURED / ROW, MEASURED_SIDE, object}};
    float most = 0, diagonal = 0;
    for (size_t i = 0; i < 3; ++i) {
        camera.eye[i] = box->low[i];
        camera.right[i] = box->high[i];
        diagonal = hypotf(diagonal, box->high[i] - box->low[i]);
    }
    if (!run(tracer, to->shader, true, &camera, ROW, MEASURED / ROW))
        return false;
    float(*film)[4] = tracer->buffers[FILM].mapped;
    for (size_t p = 0; p < MEASURED; ++p)
        for (size_t c = 0; c < 3; ++c)
            if (isfinite(film[p][c]))
                most = fmaxf(most, film[p][c]);
    memset(film, 0, MEASURED * sizeof *film);
    to->majorant = fmaxf(ROOM * most, FEWEST / fmaxf(diagonal, 1e-30f));
    return true;
}

static bool measure_media(struct tracer *tracer)
{
    struct inside_box *boxes = malloc((tracer->num_objects + 1) * sizeof *boxes);
    if (!boxes)
        return fail_for_memory(tracer);
    inside_boxes(&tracer->bvh, boxes, tracer->num_objects);
    const struct Object *objects = tracer->buffers[OBJECTS].mapped;
    bool good = true;
    for (uint32_t o = 0; good && o < tracer->num_objects; ++o)
        if (strcmp(kernel_of(tracer, objects[o].shader)->prepared, "MEASURES") == 0)
            good = measure_medium(tracer, o, &boxes[o]);
    free(boxes);
    return good;
}

/* Finds the volumes around the eye. */
static bool surround_eye(struct tracer *tracer)
{
    enum { IS_BODY = 2 }; /* as in path.glsl: the side of a mesh where light comes in */
    struct Object *objects = tracer->buffers[OBJECTS].mapped;
    uint32_t around[MOST_AROUND + 1];
    bool *is_volume = calloc(tracer->num_objects + 1, sizeof *is_volume);
    for (uint32_t o = 0; is_volume && o < tracer->num_objects; ++o)
        is_volume[o] = kernel_of(tracer, objects[o].shader)->is_volume;
    size_t num = is_volume ? inside_find(&tracer->bvh, is_volume, tracer->num_objects,
                                         scene_of(tracer)->eye, around, most_around(tracer) + 1)
                           : SIZE_MAX;
    free(is_volume);
    if (num == SIZE_MAX)
        return fail_for_memory(tracer);
    for (size_t i = 0; i < num; ++i)
        objects[i].around_eye = (around[i] + 1) * 4 + IS_BODY;
    return true;
}

/* Finds all that paths need before they are traced. */
static bool prepare(struct tracer *tracer)
{
    return (!prepares(tracer, "DISPLACES") || displace(tracer))
           && (!prepares(tracer, "MEASURES") || measure_media(tracer)) && surround_eye(tracer);
}

/* ---- Paths ---- */

/* The shader for which most paths wait; false: none does. */
static bool find_waiting(const struct tracer *tracer, uint32_t *out_shader)
{
    const uint32_t *waiting = tracer->buffers[WAITING].mapped;
    *out_shader = 0;
    for (uint32_t i = 1; i < tracer->num_shaders; ++i)
        if (waiting[i] > waiting[*out_shader])
            *out_shader = i;
    return waiting[*out_shader] != 0;
}

/* Traces some samples of each pixel: from kernel to kernel, until no path waits. */
static bool trace_samples(struct tracer *tracer, struct Camera *camera)
{
    uint32_t *waiting = tracer->buffers[WAITING].mapped, shader = 0;
    memset(waiting, 0, tracer->num_shaders * sizeof *waiting);
    camera->environment[2][3] = 1;
    bool good = run(tracer, 0, false, camera, tracer->width, tracer->height);
    camera->environment[2][3] = 0;
    while (good && find_waiting(tracer, &shader)) {
        waiting[shader] = 0;
        good = run(tracer, shader, false, camera, tracer->width, tracer->height);
    }
    return good;
}

/* Opens the kernels, and the buffers that they share. */
static bool open_kernels(struct tracer *tracer, struct bind *const *binds, size_t count,
                         size_t *out_failed)
{
    for (size_t i = 0; i < count; ++i) {
        struct kernel *kernel = &tracer->kernels[i];
        *out_failed = i;
        ++tracer->num_kernels;
        if (!kernel_open(tracer->gpu, binds[i], tracer->num_shaders, kernel))
            return false;
        tracer->num_shaders += kernel->num_shaders;
    }
    *out_failed = 0;
    if (!collect_objects(tracer))
        return false;
    if (!bvh_build(tracer->objects, tracer->num_objects, &tracer->bvh))
        return fail_for_memory(tracer);
    if (!create_buffers(tracer) || !create_set(tracer))
        return false;
    write_set(tracer);
    for (size_t i = 0; i < count; ++i) {
        *out_failed = i;
        if (!kernel_compile(tracer->gpu, &tracer->kernels[i], tracer->set_layout, tracer->options))
            return false;
    }
    *out_failed = 0;
    return true;
}

static void close(struct tracer *tracer)
{
    struct gpu *gpu = tracer->gpu;
    for (size_t i = 0; i < tracer->num_kernels; ++i)
        kernel_close(gpu, &tracer->kernels[i]);
    vkDestroyDescriptorPool(gpu->device, tracer->pool, NULL);
    vkDestroyDescriptorSetLayout(gpu->device, tracer->set_layout, NULL);
    vkDestroySampler(gpu->device, tracer->sampler, NULL);
    gpu_destroy_image(gpu, &tracer->environment);
    for (size_t i = 0; i < NUM_BUFFERS; ++i)
        gpu_destroy_buffer(gpu, &tracer->buffers[i]);
    bvh_finish(&tracer->bvh);
    free(tracer->objects);
    free(tracer->kernels);
}

static void take_pixels(const struct tracer *tracer, uint32_t samples, struct image *out)
{
    size_t pixels = (size_t)tracer->width * tracer->height;
    const float *light = tracer->buffers[FILM].mapped, *through = light + 4 * pixels;
    float *pixel = out->pixels;
    for (size_t p = 0; p < pixels; ++p, pixel += 4) {
        float sum = 0;
        for (size_t c = 0; c < 3; ++c) {
            pixel[c] = light[4 * p + c] / (float)samples;
            out->through[3 * p + c] = through[4 * p + c] / (float)samples;
            sum += out->through[3 * p + c];
        }
        pixel[3] = 1 - sum / 3;
    }
}

static void take_aovs(const struct tracer *tracer, uint32_t samples)
{
    const float *film = tracer->buffers[AOVS].mapped;
    size_t pixels = (size_t)tracer->width * tracer->height;
    size_t stride = aovs_stride(tracer->options->aovs);
    for (size_t i = 0; i < aovs_num(tracer->options->aovs); ++i) {
        struct picture_aov *aov = &tracer->options->aovs->items[i];
        float scale = aovs_is_whole(aov->type) ? 1 : 1 / (float)samples;
        for (size_t p = 0; p < 4 * pixels; ++p)
            aov->pixels[p] = film[4 * (p / 4 * stride + i) + p % 4] * scale;
    }
}

bool trace_picture(struct gpu *gpu, struct bind *const *binds, size_t count,
                   const struct trace_options *options, struct image *out, size_t *out_failed)
{
    struct tracer tracer = {.gpu = gpu,
                            .options = options,
                            .kernels = calloc(count, sizeof *tracer.kernels),
                            .width = out->width,
                            .height = out->height};
    uint32_t samples = options->paths * options->picks;
    *out_failed = 0;
    bool good =
        tracer.kernels && open_kernels(&tracer, binds, count, out_failed) && prepare(&tracer);
    struct Camera camera = {0};
    if (good)
        camera = make_camera(&tracer);
    for (uint32_t done = 0; good && done < samples; done += camera.frame[3]) {
        camera.frame[2] = done;
        camera.frame[3] = samples - done < SAMPLES_AT_ONCE ? samples - done : SAMPLES_AT_ONCE;
        good = trace_samples(&tracer, &camera);
        if (options->progress)
            options->progress(options->progress_data, done + camera.frame[3], samples);
    }
    if (good) {
        take_pixels(&tracer, samples, out);
        take_aovs(&tracer, samples);
    }
    if (!good && tracer.kernels && gpu->reason[0])
        kernel_fail(&tracer.kernels[*out_failed], gpu->id, gpu->reason);
    close(&tracer);
    return good;
}
