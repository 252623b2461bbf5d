// SPDX-License-Identifier: Apache-2.0
/*
 * Shaders that count what they do (bench/operations.h), against counts by hand: a loop that runs as
 * often as the pixel's column says, a branch that half of the pixels take, a function that is
 * called twice, and operations on vectors.
 */
#include "bench/operations.h"
#include "compile/compile.h"
#include "render/draw.h"
#include "unit/test.h"

#include <stdlib.h>

enum { SIZE = 8, NUM_FLOATS = SIZE * SIZE * 4 };

static const char vertex[] = "#version 450\n"
                             "void main()\n"
                             "{\n"
                             "    vec2 at = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0,\n"
                             "                   gl_VertexIndex == 2 ? 3.0 : -1.0);\n"
                             "    gl_Position = vec4(at, 0.5, 1.0);\n"
                             "}\n";

/* Draws the shader whose main function has this body, after other text, as it counts itself. */
static void count(struct gpu *gpu, struct draw_canvas *canvas, const char *before, const char *body,
                  enum count_of what, float *out)
{
    static const uint32_t indices[3] = {0, 1, 2};
    struct draw_object object = {.num_vertices = 3, .num_indices = 3, .indices = indices};
    struct draw draw = {.objects = &object, .num_objects = 1};
    struct compiled compiled;
    char pixel[2048];
    size_t num_words = 0;
    snprintf(pixel, sizeof pixel,
             "#version 450\nlayout(location = 0) out vec4 color;\n%s\nvoid main()\n{\n%s\n}\n",
             before, body);
    const char *const sources[MXG_NUM_STAGES] = {
        [MXG_STAGE_VERTEX] = vertex, [MXG_STAGE_PIXEL] = pixel};
    memset(out, 0, NUM_FLOATS * sizeof *out);
    if (!REQUIRE(compile_program("vulkan", sources, &compiled)))
        printf("    %s\n", compiled.num_messages ? compiled.messages[0].text : pixel);
    const struct compiled_stage *stage = &compiled.stages[MXG_STAGE_PIXEL];
    uint32_t *words = operations_instrument(stage->words, stage->num_words, what, &num_words);
    REQUIRE(words);
    draw.code[MXG_STAGE_VERTEX] = compiled.stages[MXG_STAGE_VERTEX].words;
    draw.code_words[MXG_STAGE_VERTEX] = compiled.stages[MXG_STAGE_VERTEX].num_words;
    draw.code[MXG_STAGE_PIXEL] = words;
    draw.code_words[MXG_STAGE_PIXEL] = num_words;
    struct draw_program *program = draw_open(canvas, &draw);
    if (!REQUIRE(program && draw_frame(canvas, &program, 1, out)))
        printf("    %s\n", gpu->reason);
    draw_close(program);
    free(words);
    compiled_finish(&compiled);
}

/* The counts of all pixels: `base`, `column` for each column to the left, `right` in the right
 * half. */
static void require_counts(const float *pixels, int base, int column, int right)
{
    for (int i = 0; i < SIZE * SIZE; ++i) {
        int x = i % SIZE;
        if (!REQUIRE_EQ(pixels[i * 4], base + column * x + (x >= SIZE / 2 ? right : 0)))
            break;
    }
    REQUIRE_EQ(pixels[3], 1);
}

static void test_counts(struct gpu *gpu, struct draw_canvas *canvas)
{
    float pixels[NUM_FLOATS];
    count(gpu, canvas, "", "    color = vec4(gl_FragCoord.x);", COUNT_OPERATIONS, pixels);
    require_counts(pixels, 0, 0, 0);
    /* an addition of four components, and a product of four by one */
    count(gpu, canvas, "", "    color = (gl_FragCoord + vec4(1.0)) * gl_FragCoord.x;",
          COUNT_OPERATIONS, pixels);
    require_counts(pixels, 8, 0, 0);
    /* dot: its operands have four components; the root has one */
    count(gpu, canvas, "", "    color = vec4(sqrt(dot(gl_FragCoord, gl_FragCoord)));",
          COUNT_OPERATIONS, pixels);
    require_counts(pixels, 5, 0, 0);
    /* the conversion; comparison, branch, root, sum and ++i for each column; the last comparison */
    count(gpu, canvas, "",
          "    float sum = 0.0;\n"
          "    int end = int(gl_FragCoord.x);\n"
          "    for (int i = 0; i < end; ++i)\n"
          "        sum += sqrt(gl_FragCoord.y);\n"
          "    color = vec4(sum);",
          COUNT_OPERATIONS, pixels);
    require_counts(pixels, 1 + 2, 5, 0);
    /* the comparison and the branch; on the right a function twice, of a sine and a product */
    count(gpu, canvas, "float f(float x)\n{\n    return sin(x) * 2.0;\n}\n",
          "    color = vec4(0.0);\n"
          "    if (gl_FragCoord.x > 4.0)\n"
          "        color = vec4(f(gl_FragCoord.x), f(gl_FragCoord.y), 0.0, 0.0);",
          COUNT_OPERATIONS, pixels);
    require_counts(pixels, 2, 0, 4);
    /* every instruction: the place of x, its load, the vector, the store, and the return */
    count(gpu, canvas, "", "    color = vec4(gl_FragCoord.x);", COUNT_INSTRUCTIONS, pixels);
    require_counts(pixels, 5, 0, 0);
}

static void test_no_output(void)
{
    static const char pixel[] = "#version 450\nlayout(location = 1) out vec4 color;\n"
                                "void main()\n{\n    color = vec4(1.0);\n}\n";
    const char *const sources[MXG_NUM_STAGES] = {
        [MXG_STAGE_VERTEX] = vertex, [MXG_STAGE_PIXEL] = pixel};
    struct compiled compiled;
    size_t num_words = 1;
    REQUIRE(compile_program("vulkan", sources, &compiled));
    const struct compiled_stage *stage = &compiled.stages[MXG_STAGE_PIXEL];
    REQUIRE(!operations_instrument(stage->words, stage->num_words, COUNT_OPERATIONS, &num_words));
    REQUIRE_EQ(num_words, 0);
    compiled_finish(&compiled);
}

int main(void)
{
    struct gpu gpu;
    compile_begin();
    test_no_output();
    if (gpu_open(&gpu)) {
        struct draw_canvas *canvas = draw_open_canvas(&gpu, SIZE, SIZE);
        if (REQUIRE(canvas))
            test_counts(&gpu, canvas);
        draw_close_canvas(canvas);
    } else {
        printf("skip: %s\n", gpu.reason);
    }
    gpu_close(&gpu);
    compile_end();
    return test_report("operations");
}
