// SPDX-License-Identifier: Apache-2.0
/*
 * A host with Vulkan, without a display: draws each material of a document on a ball, and follows
 * changes of the document. Materials that differ only in values share a program.
 *
 *     host_vulkan FILE.mtlx < commands
 *
 * Commands, one per line:
 *     set NODE INPUT NUMBER...   changes an input: a uniform at once, any other by a new program
 *     connect NODE INPUT NODE    connects an input to a node
 *     reload                     reads the file again; after an error the old document stays
 *     draw FILE.ppm              writes a picture
 *
 * This file has the documents, program.c the pipelines, gpu.c the picture, device.c the device.
 * Textures show a checkerboard, because reading image files is another subject.
 */
#include "gpu.h"
#include "program.h"

#include <math.h>
#include <mxgen/document.h>
#include <mxgen/mxgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_PROGRAMS = 64 };

/* A material. Its part of the buffer of uniforms: its blocks, then its constant attributes. */
struct ball {
    mxg_result *result; /* of the current document, without source */
    uint32_t program;
    uint32_t offsets[NUM_UNIFORM_BLOCKS + 1];
    VkDescriptorSet set;
};

struct host {
    struct gpu gpu;
    mxg_context *context;
    mxg_library *library;
    mxg_options *options;
    mxg_document *document;
    const char *path; /* of its file */
    struct program programs[MAX_PROGRAMS];
    uint32_t num_programs;
    struct ball *balls; /* in the order of the document's materials */
    uint32_t num_balls;
    struct buffer uniforms;
    VkDescriptorPool sets;
};

/* ---- Results and programs ---- */

/* NULL after an error. `without_source` is fast, and enough to compare and to fill uniforms. */
static mxg_result *generate(struct host *h, const mxg_document *document, uint32_t index,
                            bool without_source)
{
    mxg_renderable renderable = MXG_INIT(mxg_renderable);
    mxg_document_renderable(document, index, &renderable);
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_result *result = NULL;
    desc.target = "vulkan";
    desc.element = renderable.path;
    desc.options = h->options;
    desc.without_source = without_source;
    mxg_status status = mxg_generate(h->context, document, &desc, &result);
    if (status == MXG_OK)
        return result;
    program_print(mxg_result_diagnostics(result), MXG_SEVERITY_NOTE);
    mxg_result_destroy(result);
    return NULL;
}

/* The program of a material: results of one topology have the same text, as names are neutral. */
static uint32_t find_program(struct host *h, uint32_t index)
{
    mxg_shader_info info = MXG_INIT(mxg_shader_info);
    mxg_result_info(h->balls[index].result, &info);
    for (uint32_t i = 0; i < h->num_programs; ++i)
        if (h->programs[i].topology == info.topology)
            return i;
    check(h->num_programs < MAX_PROGRAMS, "too many programs");
    mxg_result *whole = generate(h, h->document, index, false);
    check(whole, info.path);
    const struct target target = {.pass = h->gpu.pass,
                                  .width = SIZE,
                                  .height = SIZE,
                                  .num_colors = 1,
                                  .depth_test = VK_COMPARE_OP_LESS,
                                  .writes_depth = true};
    program_make(&h->gpu.device, whole, &target, &h->programs[h->num_programs]);
    mxg_result_destroy(whole);
    return h->num_programs++;
}

/* ---- Uniforms ---- */

/* Columns of the matrix from the world, of which the balls fill a square, to Vulkan's clip space.
 */
static void set_view(struct host *h, float matrix[16])
{
    float side = ceilf(sqrtf((float)h->num_balls));
    const float view[16] = {
        1 / side, 0, 0, 0, 0, -1 / side, 0, 0, 0, 0, -0.25f, 0, 0, 0, 0.5f, 1,
    };
    memcpy(matrix, view, sizeof view);
}

/* Ball `index` stands in a row of a square; rows go downwards. */
static void set_place(struct host *h, uint32_t index, float matrix[16])
{
    uint32_t side = (uint32_t)ceilf(sqrtf((float)h->num_balls));
    float first = 1 - (float)side;
    const float place[16] = {0.9f,
                             0,
                             0,
                             0,
                             0,
                             0.9f,
                             0,
                             0,
                             0,
                             0,
                             0.9f,
                             0,
                             first + 2 * (float)(index % side),
                             -first - 2 * (float)(index / side),
                             0,
                             1};
    memcpy(matrix, place, sizeof place);
}

struct ball_of {
    struct host *host;
    uint32_t index;
};

/* The values of one semantic, and their number; 0: the default of the shader stays. */
static uint32_t value_of(void *user_data, const mxg_variable *variable, float values[16])
{
    struct host *h = ((struct ball_of *)user_data)->host;
    uint32_t index = ((struct ball_of *)user_data)->index;
    /* a member of a light has the name of the light shader's input */
    const char *semantic = variable->semantic[0] ? variable->semantic : variable->name;
    if (strcmp(semantic, "worldMatrix") == 0)
        return set_place(h, index, values), 16;
    if (strcmp(semantic, "worldInverseTransposeMatrix") == 0) { /* for normals, of any length */
        memset(values, 0, 16 * sizeof *values);
        values[0] = values[5] = values[10] = values[15] = 1;
        return 16;
    }
    if (strcmp(semantic, "viewProjectionMatrix") == 0)
        return set_view(h, values), 16;
    if (strcmp(semantic, "viewPosition") == 0)
        return values[0] = 0, values[1] = 0, values[2] = 100, 3;
    if (strcmp(semantic, "numActiveLightSources") == 0 || strcmp(semantic, "type") == 0
        || strcmp(semantic, "intensity") == 0)
        return values[0] = semantic[0] == 'i' ? 3 : 1, 1;
    if (strcmp(semantic, "color") == 0)
        return values[0] = values[1] = values[2] = 1, 3;
    if (strcmp(semantic, "direction") == 0) /* in which the light travels */
        return values[0] = -0.577f, values[1] = values[2] = values[0], 3;
    return 0;
}

static void fill(struct host *h, uint32_t index)
{
    const struct ball *ball = &h->balls[index];
    struct ball_of of = {h, index};
    for (uint32_t i = 0; i < NUM_UNIFORM_BLOCKS; ++i)
        program_fill_block(ball->result, uniform_blocks[i], value_of, &of,
                           h->uniforms.bytes + ball->offsets[i]);
    program_write_constants(ball->result, h->uniforms.bytes + ball->offsets[NUM_UNIFORM_BLOCKS]);
}

/* Gives each ball its place in the buffer. Returns the size of the buffer. */
static uint32_t place_uniforms(struct host *h)
{
    uint32_t size = 0;
    for (uint32_t i = 0; i < h->num_balls; ++i) {
        struct ball *ball = &h->balls[i];
        size = program_place_blocks(ball->result, size, ball->offsets);
        ball->offsets[NUM_UNIFORM_BLOCKS] = size;
        size += (16 * program_num_constants(ball->result) + 255) / 256 * 256;
    }
    return size;
}

static void make_sets(struct host *h)
{
    const VkDescriptorPoolSize sizes[] = {
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, h->num_balls * NUM_UNIFORM_BLOCKS},
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, h->num_balls * 16}};
    vkDestroyDescriptorPool(h->gpu.device.device, h->sets, NULL);
    h->sets = device_make_pool(&h->gpu.device, h->num_balls, sizes, 2);
    for (uint32_t i = 0; i < h->num_balls; ++i) {
        struct ball *ball = &h->balls[i];
        ball->set = device_make_set(&h->gpu.device, h->sets, h->programs[ball->program].set_layout);
        program_bind(&h->gpu.device, ball->result, h->uniforms.buffer, ball->offsets, ball->set);
    }
}

/* After a change of programs: finds them, and lays out the uniforms anew. */
static void arrange(struct host *h)
{
    for (uint32_t i = 0; i < h->num_balls; ++i)
        h->balls[i].program = find_program(h, i);
    device_free_buffer(&h->gpu.device, h->uniforms);
    h->uniforms = device_make_buffer(&h->gpu.device, place_uniforms(h) + 256);
    make_sets(h);
    for (uint32_t i = 0; i < h->num_balls; ++i)
        fill(h, i);
}

/* ---- Changes of the document ---- */

static void free_balls(struct ball *balls, uint32_t num)
{
    for (uint32_t i = 0; i < num; ++i)
        mxg_result_destroy(balls[i].result);
    free(balls);
}

/* The materials of a document; NULL after an error. */
static struct ball *generate_all(struct host *h, const mxg_document *document, uint32_t num)
{
    struct ball *balls = calloc(num, sizeof *balls);
    check(balls, "memory");
    for (uint32_t i = 0; i < num; ++i) {
        balls[i].result = generate(h, document, i, true);
        if (!balls[i].result) {
            free_balls(balls, i);
            return NULL;
        }
    }
    return balls;
}

/* Draws `next` from now on, and destroys the old document. After an error all stays as it is. */
static bool follow(struct host *h, mxg_document *next)
{
    uint32_t num = mxg_document_num_renderables(next), changes[3] = {0};
    struct ball *balls = num ? generate_all(h, next, num) : NULL;
    if (!balls) {
        mxg_document_destroy(next);
        return false;
    }
    for (uint32_t i = 0; i < num; ++i) {
        mxg_change change = MXG_CHANGE_SHADER;
        if (num == h->num_balls) {
            change = mxg_result_change(h->balls[i].result, balls[i].result, NULL, 0, NULL);
            mxg_result *result = balls[i].result;
            balls[i] = h->balls[i];
            balls[i].result = result;
        }
        ++changes[change];
    }
    struct ball *old = h->balls;
    uint32_t num_old = h->num_balls;
    mxg_document_destroy(h->document);
    h->document = next;
    h->balls = balls;
    h->num_balls = num;
    if (changes[MXG_CHANGE_SHADER])
        arrange(h);
    else
        for (uint32_t i = 0; i < num; ++i)
            fill(h, i);
    free_balls(old, num_old);
    printf("%u unchanged, %u with other values, %u with other shaders, %u programs\n", changes[0],
           changes[1], changes[2], h->num_programs);
    return true;
}

static bool load(struct host *h)
{
    mxg_document *next;
    mxg_status status = mxg_document_load(h->context, h->library, h->path, &next);
    program_print(mxg_document_diagnostics(next), MXG_SEVERITY_NOTE);
    if (status == MXG_OK)
        return follow(h, next);
    mxg_document_destroy(next);
    return false;
}

/* The type of an input that is compiled in; NULL: the shader does not use the input. */
static const char *compiled_type(const mxg_result *result, const char *path)
{
    for (uint32_t i = 0; i < mxg_result_num_compiled_inputs(result); ++i) {
        mxg_compiled_input input = MXG_INIT(mxg_compiled_input);
        if (mxg_result_compiled_input(result, i, &input) == MXG_OK && !strcmp(input.path, path))
            return input.type;
    }
    return NULL;
}

/* The use that the materials of the document make of an input. */
struct use {
    bool known, compiled, connected;
    const char *type;
};

/* Writes the uniform of every material that has the input as one. */
static struct use write_uniforms(struct host *h, const char *path, const float *values,
                                 uint32_t num)
{
    struct use use = {0};
    for (uint32_t i = 0; i < h->num_balls; ++i) {
        const struct ball *ball = &h->balls[i];
        mxg_input_state state = mxg_result_input_state(ball->result, path);
        mxg_variable v = MXG_INIT(mxg_variable);
        uint32_t index;
        use.known |= state != MXG_INPUT_UNKNOWN;
        use.compiled |= state == MXG_INPUT_COMPILED;
        use.connected |= state == MXG_INPUT_CONNECTED;
        if (state == MXG_INPUT_COMPILED)
            use.type = compiled_type(ball->result, path);
        if ((index = mxg_result_find_variable(ball->result, path)) == MXG_NONE
            || mxg_result_variable(ball->result, index, &v) != MXG_OK || num != v.num_values)
            continue;
        use.type = v.document_type;
        mxg_result_pack_value(ball->result, index, 0, values, num,
                              h->uniforms.bytes + ball->offsets[1],
                              program_block_size(ball->result, MXG_BLOCK_PUBLIC_UNIFORMS));
    }
    return use;
}

/* Ends an edit; only a change of uniforms needs no generation. */
static bool end_edit(struct host *h, mxg_edit *edit, bool only_uniforms)
{
    mxg_document *next;
    char reason[256];
    if (mxg_edit_error(edit, reason, sizeof reason)) {
        fprintf(stderr, "%s\n", reason);
        mxg_edit_destroy(edit);
        return false;
    }
    mxg_status status = mxg_edit_commit(edit, &next);
    mxg_edit_destroy(edit);
    program_print(mxg_document_diagnostics(next), MXG_SEVERITY_NOTE);
    if (status != MXG_OK) {
        mxg_document_destroy(next);
        return false;
    }
    if (!only_uniforms)
        return follow(h, next);
    mxg_document_destroy(h->document);
    h->document = next;
    puts("a uniform");
    return true;
}

static bool set(struct host *h, const char *node, const char *input, const float *values,
                uint32_t num)
{
    char path[512];
    mxg_edit *edit;
    snprintf(path, sizeof path, "%s/%s", node, input);
    struct use use = write_uniforms(h, path, values, num);
    if (!use.known || use.connected) {
        fprintf(stderr, use.known ? "%s is connected\n" : "there is no %s\n", path);
        return false;
    }
    if (mxg_edit_create(h->context, h->library, h->document, NULL, &edit) != MXG_OK)
        return false;
    mxg_edit_set_numbers(edit, mxg_edit_find_element(edit, 0, node), input, use.type, values, num);
    return end_edit(h, edit, !use.compiled);
}

static bool connect_input(struct host *h, const char *node, const char *input, const char *from)
{
    mxg_edit *edit;
    if (mxg_edit_create(h->context, h->library, h->document, NULL, &edit) != MXG_OK)
        return false;
    mxg_edit_connect_input(edit, mxg_edit_find_element(edit, 0, node), input,
                           mxg_edit_find_element(edit, 0, from), NULL);
    return end_edit(h, edit, false);
}

/* ---- Drawing and commands ---- */

static void draw(struct host *h, const char *path)
{
    VkCommandBuffer commands = device_begin(&h->gpu.device);
    const VkClearValue clear[] = {{.color = {{0.02f, 0.02f, 0.02f, 1}}}, {.depthStencil = {1, 0}}};
    VkRenderPassBeginInfo pass = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                  .renderPass = h->gpu.pass,
                                  .framebuffer = h->gpu.frame,
                                  .renderArea = {{0, 0}, {SIZE, SIZE}},
                                  .clearValueCount = 2,
                                  .pClearValues = clear};
    vkCmdBeginRenderPass(commands, &pass, VK_SUBPASS_CONTENTS_INLINE);
    for (uint32_t i = 0; i < h->num_balls; ++i) {
        const struct ball *ball = &h->balls[i];
        program_draw_ball(&h->gpu.device, commands, &h->programs[ball->program], &ball->set, 1,
                          h->uniforms.buffer, ball->offsets[NUM_UNIFORM_BLOCKS]);
    }
    vkCmdEndRenderPass(commands);
    gpu_write_picture(&h->gpu, commands, path);
}

static bool run_command(struct host *h, char *line)
{
    char *words[20] = {0};
    uint32_t num = 0;
    for (char *word = strtok(line, " \n"); word && num < 20; word = strtok(NULL, " \n"))
        words[num++] = word;
    if (num == 1 && strcmp(words[0], "reload") == 0)
        return load(h);
    if (num == 2 && strcmp(words[0], "draw") == 0)
        return draw(h, words[1]), true;
    if (num == 4 && strcmp(words[0], "connect") == 0)
        return connect_input(h, words[1], words[2], words[3]);
    if (num >= 4 && strcmp(words[0], "set") == 0) {
        float values[17];
        for (uint32_t i = 3; i < num; ++i)
            values[i - 3] = strtof(words[i], NULL);
        return set(h, words[1], words[2], values, num - 3);
    }
    fprintf(stderr, "unknown command; host.c lists the commands\n");
    return false;
}

static bool run(struct host *h)
{
    char line[1024];
    bool good = load(h);
    while (good && fgets(line, sizeof line, stdin)) {
        run_command(h, line); /* prints its fault, and the next command follows */
        fflush(stdout);
    }
    return good;
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: host_vulkan FILE.mtlx < commands\n", stderr);
        return 2;
    }
    struct host h = {.path = argv[1]};
    check(mxg_context_create(NULL, &h.context) == MXG_OK, "memory");
    h.library = mxg_library_builtin(h.context);
    check(mxg_options_create(h.context, &h.options) == MXG_OK, "memory");
    mxg_options_set(h.options, "names", "neutral");
    mxg_options_set(h.options, "environment", "none");
    mxg_options_set(h.options, "lights", "directional_light");
    gpu_open(&h.gpu);
    bool good = run(&h);
    free_balls(h.balls, h.num_balls);
    for (uint32_t i = 0; i < h.num_programs; ++i)
        program_free(&h.gpu.device, &h.programs[i]);
    vkDestroyDescriptorPool(h.gpu.device.device, h.sets, NULL);
    device_free_buffer(&h.gpu.device, h.uniforms);
    gpu_close(&h.gpu);
    mxg_options_destroy(h.options);
    mxg_document_destroy(h.document);
    mxg_library_unref(h.library);
    mxg_context_destroy(h.context);
    return good ? 0 : 1;
}
