// SPDX-License-Identifier: Apache-2.0
/*
 * An engine with the deferred pipeline of mxgen on Vulkan, without a display: balls of the
 * materials of documents under lamps of its own, with shadows, occlusion and a sky of its own, and
 * a decal.
 *
 *     host_deferred [--show NAME] [--no-decal] PICTURE.ppm FOLDER FILE.mtlx...
 *
 * FOLDER has lights.glsl, decal.glsl and decal.mtlx, which stand beside this file. It has the scene
 * and the materials; pipeline.c has the pipeline, ../host_vulkan the device. Textures show a
 * checkerboard. Materials that are drawn forward are told, and left out.
 */
#include "pipeline.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 480, HEIGHT = 300, COLUMNS = 20, ROWS = 12, NUM_BALLS = COLUMNS * ROWS };
enum { MAX_MATERIALS = 64 };
static const float spacing = 2.2f, radius = 0.9f; /* as in lights.glsl */

struct material {
    mxg_result *result;
    mxg_storage storage;
    struct program depth, program;
};

struct ball {
    const struct material *material;
    struct buffer uniforms; /* its blocks, then its constant attributes */
    uint32_t offsets[NUM_UNIFORM_BLOCKS + 1];
    VkDescriptorSet sets[2]; /* of depth and material: their layouts have one shape */
};

struct host {
    struct device device;
    struct pipeline pipeline;
    mxg_context *context;
    mxg_options *options;
    struct material materials[MAX_MATERIALS];
    uint32_t num_materials;
    struct ball balls[NUM_BALLS + 1]; /* the last one is the ground: a flat ball */
    VkDescriptorPool pool;
    float view_projection[16];
    struct view view;
    const char *folder;
};

static char *read_file(const char *folder, const char *name)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    check(file && fseek(file, 0, SEEK_END) == 0, path);
    long size = ftell(file);
    char *text = calloc((size_t)size + 1, 1);
    check(text && fseek(file, 0, SEEK_SET) == 0, path);
    check(fread(text, 1, (size_t)size, file) == (size_t)size, path);
    fclose(file);
    return text;
}

/* ---- Camera ---- */

enum { X, Y, Z, W };

static void transform(const float m[16], const float v[4], float out[4])
{
    for (int row = 0; row < 4; ++row) {
        out[row] = 0;
        for (int column = 0; column < 4; ++column)
            out[row] += m[4 * column + row] * v[column];
    }
}

/* A viewer in front of the balls, who looks down on them; matrices are by columns. */
static void set_camera(struct host *h)
{
    const float angle = 0.5f, focal = 1.7f, near = 1, far = 100;
    const float s = sinf(angle), c = cosf(angle), aspect = (float)WIDTH / HEIGHT;
    const float eye[3] = {0, 15, 26};
    const float a = far / (near - far), b = near * far / (near - far);
    /* right, up and back of the camera are the rows of its rotation */
    const float to_view[16] = {
        1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, 0, -c * eye[1] + s * eye[2], -s * eye[1] - c * eye[2],
        1};
    const float to_clip[16] = {focal / aspect, 0, 0, 0, 0, -focal, 0, 0, 0, 0, a, -1, 0, 0, b, 0};
    for (int i = 0; i < 4; ++i) {
        transform(to_clip, to_view + 4 * i, h->view_projection + 4 * i);
        /* back: pixels to clip space, to the view times w, to the world */
        const float pixel[4][4] = {
            {2.0f / WIDTH, 0, 0, 0}, {0, 2.0f / HEIGHT, 0, 0}, {0, 0, 1, 0}, {-1, -1, 0, 1}};
        const float *p = pixel[i];
        const float v[4] = {p[X] * aspect / focal, -p[Y] / focal, -p[W], (p[Z] + a * p[W]) / b};
        const float to_world[16] = {1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0, eye[0], eye[1], eye[2], 1};
        transform(to_world, v, h->view.to_world + 4 * i);
    }
    memcpy(h->view.position, eye, sizeof eye);
}

/* ---- Materials ---- */

/* NULL after an error, which is printed. */
static mxg_result *generate(const struct host *h, const mxg_document *document, const char *element,
                            const char *role)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_result *result = NULL;
    desc.target = "vulkan";
    desc.element = element;
    desc.options = h->options;
    mxg_options_set(h->options, "role", role);
    if (mxg_generate(h->context, document, &desc, &result) == MXG_OK)
        return result;
    program_print(mxg_result_diagnostics(result), MXG_SEVERITY_ERROR);
    mxg_result_destroy(result);
    return NULL;
}

static mxg_document *load(const struct host *h, const char *path)
{
    mxg_document *document = NULL;
    mxg_status status =
        mxg_document_load(h->context, mxg_library_builtin(h->context), path, &document);
    program_print(mxg_document_diagnostics(document), MXG_SEVERITY_ERROR);
    check(status == MXG_OK, path);
    return document;
}

static void add_material(struct host *h, const mxg_document *document, const char *element)
{
    struct material m = {.storage = MXG_INIT(mxg_storage)};
    m.result = generate(h, document, element, "deferred");
    if (!m.result)
        return;
    mxg_result_storage(m.result, &m.storage);
    if (m.storage.words && h->num_materials < MAX_MATERIALS) {
        h->materials[h->num_materials++] = m;
        return;
    }
    printf("%s lights itself\n", element);
    mxg_result_destroy(m.result);
}

static void add_materials(struct host *h, const char *path)
{
    mxg_document *document = load(h, path);
    for (uint32_t i = 0; i < mxg_document_num_renderables(document); ++i) {
        mxg_renderable renderable = MXG_INIT(mxg_renderable);
        mxg_document_renderable(document, i, &renderable);
        add_material(h, document, renderable.path);
    }
    mxg_document_destroy(document);
}

/* The depth pass needs the vertex stage alone. */
static void make_programs(struct host *h)
{
    struct target depth = {.pass = h->pipeline.depth_pass,
                           .width = WIDTH,
                           .height = HEIGHT,
                           .depth_test = VK_COMPARE_OP_LESS,
                           .writes_depth = true,
                           .set_1 = h->pipeline.sets[0]};
    struct target material = depth;
    material.pass = h->pipeline.material_pass;
    material.num_colors = 4;
    material.depth_test = VK_COMPARE_OP_EQUAL;
    material.writes_depth = false;
    for (uint32_t i = 0; i < h->num_materials; ++i) {
        program_make(&h->device, h->materials[i].result, &depth, &h->materials[i].depth);
        program_make(&h->device, h->materials[i].result, &material, &h->materials[i].program);
    }
}

/* ---- Balls ---- */

/* Place `index` in the rows; the last one is the ground below them. */
static void set_place(uint32_t index, float matrix[16])
{
    bool is_ground = index == NUM_BALLS;
    memset(matrix, 0, 16 * sizeof *matrix);
    matrix[0] = matrix[10] = is_ground ? 60 : radius;
    matrix[5] = is_ground ? 0.01f : radius;
    matrix[12] = is_ground ? 0 : spacing * ((float)(index % COLUMNS) - (COLUMNS - 1) / 2.0f);
    matrix[13] = is_ground ? -radius - 0.01f : 0;
    matrix[14] = is_ground ? 0 : spacing * ((float)(index / COLUMNS) - (ROWS - 1) / 2.0f);
    matrix[15] = 1;
}

struct ball_of {
    const struct host *host;
    uint32_t index;
};

static uint32_t value_of(void *user_data, const mxg_variable *variable, float values[16])
{
    const struct host *h = ((struct ball_of *)user_data)->host;
    uint32_t index = ((struct ball_of *)user_data)->index;
    const char *semantic = variable->semantic;
    if (strcmp(semantic, "worldMatrix") == 0)
        return set_place(index, values), 16;
    if (strcmp(semantic, "worldInverseTransposeMatrix") == 0) {
        set_place(index, values);
        values[0] = 1 / values[0], values[5] = 1 / values[5], values[10] = 1 / values[10];
        values[12] = values[13] = values[14] = 0;
        return 16;
    }
    if (strcmp(semantic, "viewProjectionMatrix") == 0)
        return memcpy(values, h->view_projection, sizeof h->view_projection), 16;
    if (strcmp(semantic, "viewPosition") == 0)
        return memcpy(values, h->view.position, sizeof h->view.position), 3;
    return 0;
}

static void make_ball(struct host *h, uint32_t index)
{
    struct ball *ball = &h->balls[index];
    struct ball_of of = {h, index};
    ball->material = &h->materials[index == NUM_BALLS ? 0 : index % h->num_materials];
    const mxg_result *result = ball->material->result;
    uint32_t size = program_place_blocks(result, 0, ball->offsets);
    ball->offsets[NUM_UNIFORM_BLOCKS] = size;
    ball->uniforms = device_make_buffer(&h->device, size + 16 * program_num_constants(result) + 1);
    for (uint32_t i = 0; i < NUM_UNIFORM_BLOCKS; ++i)
        program_fill_block(result, uniform_blocks[i], value_of, &of,
                           ball->uniforms.bytes + ball->offsets[i]);
    program_write_constants(result, ball->uniforms.bytes + size);
    for (int i = 0; i < 2; ++i) {
        const struct program *p = i ? &ball->material->program : &ball->material->depth;
        ball->sets[i] = device_make_set(&h->device, h->pool, p->set_layout);
        program_bind(&h->device, result, ball->uniforms.buffer, ball->offsets, ball->sets[i]);
    }
}

static void make_balls(struct host *h)
{
    enum { NUM_SETS = 2 * (NUM_BALLS + 1) };
    const VkDescriptorPoolSize sizes[] = {
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, NUM_SETS * NUM_UNIFORM_BLOCKS},
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, NUM_SETS * 16}};
    h->pool = device_make_pool(&h->device, NUM_SETS, sizes, 2);
    for (uint32_t i = 0; i <= NUM_BALLS; ++i)
        make_ball(h, i);
}

/* ---- Drawing ---- */

static void draw_balls(const struct host *h, VkCommandBuffer commands, bool is_depth)
{
    const struct pipeline *p = &h->pipeline;
    const VkClearValue clear[5] = {{.depthStencil = {is_depth ? 1.0f : 0.0f, 0}}};
    VkRenderPassBeginInfo pass = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                  .renderPass = is_depth ? p->depth_pass : p->material_pass,
                                  .framebuffer = is_depth ? p->depth_frame : p->material_frame,
                                  .renderArea = {{0, 0}, {WIDTH, HEIGHT}},
                                  .clearValueCount = is_depth ? 1 : 5,
                                  .pClearValues = clear};
    vkCmdBeginRenderPass(commands, &pass, VK_SUBPASS_CONTENTS_INLINE);
    for (uint32_t i = 0; i <= NUM_BALLS; ++i) {
        const struct ball *ball = &h->balls[i];
        const struct program *program =
            is_depth ? &ball->material->depth : &ball->material->program;
        const VkDescriptorSet sets[] = {ball->sets[!is_depth], p->resource_set};
        program_draw_ball(&h->device, commands, program, sets, 2, ball->uniforms.buffer,
                          ball->offsets[NUM_UNIFORM_BLOCKS]);
    }
    vkCmdEndRenderPass(commands);
    device_wait(commands);
}

/* A view has exact numbers; light has a curve for what is above 1, and the transfer of sRGB. */
static int byte_of(float value, bool is_view)
{
    float shown = is_view ? value : powf(value / (1 + value), 1 / 2.2f);
    return (int)(255 * fminf(fmaxf(shown, 0), 1) + 0.5f);
}

static void draw(struct host *h, const char *path, const char *show)
{
    struct pipeline *p = &h->pipeline;
    struct buffer pixels = device_make_buffer(&h->device, WIDTH * HEIGHT * 4 * sizeof(float));
    VkCommandBuffer commands = device_begin(&h->device);
    draw_balls(h, commands, true);
    draw_balls(h, commands, false);
    pipeline_light(p, commands, show);
    vkCmdCopyImageToBuffer(
        commands, pipeline_resource(p, "lit")->image.image, VK_IMAGE_LAYOUT_GENERAL, pixels.buffer,
        1,
        &(VkBufferImageCopy){.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                             .imageExtent = {WIDTH, HEIGHT, 1}});
    device_run(&h->device, commands);
    FILE *file = fopen(path, "wb");
    check(file, path);
    fprintf(file, "P6 %d %d 255\n", WIDTH, HEIGHT);
    const float *value = (const float *)(void *)pixels.bytes;
    for (int i = 0; i < WIDTH * HEIGHT; ++i)
        for (int c = 0; c < 3; ++c)
            fputc(byte_of(value[4 * i + c], show != NULL), file);
    check(fclose(file) == 0, path);
    device_free_buffer(&h->device, pixels);
}

/* ---- The program ---- */

static void make_decal(struct host *h)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/decal.mtlx", h->folder);
    mxg_document *document = load(h, path);
    mxg_result *payload = generate(h, document, "Ring", "payload");
    check(payload, "the decal");
    char *stage = read_file(h->folder, "decal.glsl");
    pipeline_make_decal(&h->pipeline, payload, stage);
    free(stage);
    mxg_document_destroy(document);
}

static void make_passes(struct host *h, uint32_t classes)
{
    char *lights = read_file(h->folder, "lights.glsl"), *functions = malloc(strlen(lights) + 128);
    check(functions, "memory");
    sprintf(functions, "const ivec2 BALLS = ivec2(%d, %d);\n%s", COLUMNS, ROWS, lights);
    mxg_options_set(h->options, "role", "deferred");
    mxg_options_set(h->options, "host-lights", "true");
    mxg_options_set(h->options, "host-occlusion", "true");
    mxg_options_set(h->options, "host-environment", "true");
    pipeline_make_passes(&h->pipeline, h->context, h->options, classes, functions, &h->view);
    free(functions);
    free(lights);
}

static void open_host(struct host *h, char **files, int num_files, bool has_decal)
{
    const VkPhysicalDeviceFeatures features = {.fragmentStoresAndAtomics = VK_TRUE,
                                               .shaderStorageImageWriteWithoutFormat = VK_TRUE};
    uint32_t words = 0, classes = 0;
    check(mxg_context_create(NULL, &h->context) == MXG_OK, "memory");
    check(mxg_options_create(h->context, &h->options) == MXG_OK, "memory");
    mxg_options_set(h->options, "slabs", "true");
    mxg_options_set(h->options, "interface", "reduced"); /* glass with the transmission 0 is none */
    for (int i = 0; i < num_files; ++i)
        add_materials(h, files[i]);
    check(h->num_materials, "no material is stored");
    for (uint32_t i = 0; i < h->num_materials; ++i) {
        const mxg_storage *storage = &h->materials[i].storage;
        words = storage->words > words ? storage->words : words;
        classes |= storage->classes;
    }
    printf("%u balls of %u materials, up to %u words\n", NUM_BALLS, h->num_materials, words);
    device_open(&h->device, &features);
    set_camera(h);
    pipeline_open(&h->pipeline, &h->device, WIDTH, HEIGHT, words);
    make_programs(h);
    make_balls(h);
    if (has_decal)
        make_decal(h);
    make_passes(h, classes);
}

static void close_host(struct host *h)
{
    pipeline_close(&h->pipeline);
    for (uint32_t i = 0; i <= NUM_BALLS; ++i)
        device_free_buffer(&h->device, h->balls[i].uniforms);
    for (uint32_t i = 0; i < h->num_materials; ++i) {
        program_free(&h->device, &h->materials[i].depth);
        program_free(&h->device, &h->materials[i].program);
        mxg_result_destroy(h->materials[i].result);
    }
    vkDestroyDescriptorPool(h->device.device, h->pool, NULL);
    device_close(&h->device);
    mxg_options_destroy(h->options);
    mxg_context_destroy(h->context);
}

int main(int argc, char **argv)
{
    static struct host h;
    const char *show = NULL;
    bool has_decal = true;
    int at = 1;
    for (; at < argc && strncmp(argv[at], "--", 2) == 0; ++at)
        if (strcmp(argv[at], "--no-decal") == 0)
            has_decal = false;
        else if (strcmp(argv[at], "--show") == 0 && at + 1 < argc)
            show = argv[++at];
    if (argc - at < 3) {
        fputs("usage: host_deferred [--show NAME] [--no-decal] PICTURE.ppm FOLDER FILE.mtlx...\n",
              stderr);
        return 2;
    }
    h.folder = argv[at + 1];
    open_host(&h, argv + at + 2, argc - at - 2, has_decal);
    draw(&h, argv[at], show);
    close_host(&h);
    return 0;
}
