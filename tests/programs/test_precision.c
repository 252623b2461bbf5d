// SPDX-License-Identifier: Apache-2.0
/*
 * Pictures with --precision mediump. Mesa's processors compute all values with 32 bits, so the test
 * rounds in the source: every value that has the qualifier goes through a half float. The pictures
 * stay close to those without.
 */
#include "render/render.h"
#include "tests/unit/test.h"

#include <math.h>
#include <stdlib.h>

enum { SIZE = 96, CAPACITY = 1 << 18, MAX_NAMES = 64 };

static const char qualifier[] = "mediump ";

static const char rounding[] =
    "\nvec2 half_of(vec2 v) { return unpackHalf2x16(packHalf2x16(v)); }"
    "\nvec3 half_of(vec3 v) { return vec3(half_of(v.xy), half_of(v.zz).x); }"
    "\nvec4 half_of(vec4 v) { return vec4(half_of(v.xy), half_of(v.zw)); }\n";

/* A source as it grows. */
struct rounded {
    char text[CAPACITY];
    size_t len;
    const char *names[MAX_NAMES]; /* of the uniforms */
    size_t lens[MAX_NAMES];
    unsigned num_names, num_locals;
};

static void append(struct rounded *r, const char *text, size_t len)
{
    if (r->len + len >= CAPACITY)
        abort();
    memcpy(r->text + r->len, text, len);
    r->len += len;
    r->text[r->len] = 0;
}

static bool is_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* A name of a uniform, which is read as a half float; returns what was taken of the text. */
static size_t append_word(struct rounded *r, const char *at)
{
    size_t len = 0;
    while (is_word(at[len]))
        len++;
    bool found = false;
    for (unsigned i = 0; i < r->num_names; i++)
        found |= r->lens[i] == len && memcmp(r->names[i], at, len) == 0;
    append(r, found ? "half_of(" : "", found ? 8 : 0);
    append(r, at, len);
    append(r, found ? ")" : "", found ? 1 : 0);
    return len;
}

/* Text with the names of uniforms read as half floats. */
static void append_code(struct rounded *r, const char *begin, const char *end)
{
    for (const char *at = begin; at < end;) {
        if (is_word(*at)) {
            at += append_word(r, at);
        } else {
            append(r, at, 1);
            at++;
        }
    }
}

/* "mediump vec3 name = value;" or "mediump vec3 name;" without the qualifier. Returns its end. */
static const char *append_declaration(struct rounded *r, const char *at)
{
    const char *end = strchr(at, ';'), *equals = strstr(at, " = ");
    if (!end)
        abort();
    if (equals && equals < end) {
        append(r, at, (size_t)(equals + 3 - at));
        append(r, "half_of(", 8);
        append_code(r, equals + 3, end);
        append(r, ")", 1);
        r->num_locals++;
        return end;
    }
    const char *name = strchr(at, ' ') + 1;
    bool is_sampler = strncmp(at, "sampler2D", 9) == 0;
    if (!is_sampler && r->num_names < MAX_NAMES) {
        r->names[r->num_names] = name;
        r->lens[r->num_names++] = (size_t)(end - name);
    }
    append(r, at, (size_t)(end - at));
    return end;
}

static void round_source(const char *source, struct rounded *r)
{
    const char *at = strchr(source, '\n'), *next;
    append(r, source, (size_t)(at - source));
    append(r, rounding, sizeof rounding - 1);
    for (; (next = strstr(at, qualifier)); at = append_declaration(r, next + sizeof qualifier - 1))
        append_code(r, at, next);
    append_code(r, at, at + strlen(at));
}

static bool draw_source(struct gpu *gpu, struct bind *bind, const char *pixel, float *out)
{
    const char *sources[MXG_NUM_STAGES] = {
        [MXG_STAGE_VERTEX] = mxg_result_source(bind->result, MXG_STAGE_VERTEX, NULL),
        [MXG_STAGE_PIXEL] = pixel};
    struct compiled compiled = {0};
    struct draw_canvas *canvas = draw_open_canvas(gpu, SIZE, SIZE);
    bool good = canvas && bind_shader(bind) && compile_program("vulkan", sources, &compiled)
                && !compiled.errors;
    REQUIRE(good);
    for (int stage = 0; good && stage < 2; stage++) {
        bind->draw.code[stage] = compiled.stages[stage].words;
        bind->draw.code_words[stage] = compiled.stages[stage].num_words;
    }
    good = good && bind_scene(bind);
    struct draw_program *program = good ? draw_open(canvas, &bind->draw) : NULL;
    good = program && draw_frame(canvas, &program, 1, out);
    draw_close(program);
    draw_close_canvas(canvas);
    compiled_finish(&compiled);
    return good;
}

/* The largest difference of the channels, of brightness 1. */
static double difference(const float *a, const float *b)
{
    double worst = 0.0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE * 4; i++)
        worst = fmax(worst, fabs((double)a[i] - (double)b[i]) / fmax(1.0, fabs((double)b[i])));
    return worst;
}

static void compare(struct gpu *gpu, const struct scene *scene, mxg_context *context,
                    const char *path, const char *element)
{
    static float pictures[2][SIZE * SIZE * 4];
    static struct rounded rounded;
    mxg_document *document;
    REQUIRE(mxg_document_load(context, mxg_library_builtin(context), path, &document) == MXG_OK);
    mxg_options *options;
    mxg_options_create(context, &options);
    mxg_options_set(options, "precision", "mediump");
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "vulkan";
    desc.element = element;
    desc.options = options;
    mxg_result *result;
    REQUIRE(mxg_generate(context, document, &desc, &result) == MXG_OK);
    const char *pixel = mxg_result_source(result, MXG_STAGE_PIXEL, NULL);
    memset(&rounded, 0, sizeof rounded);
    round_source(pixel, &rounded);
    REQUIRE(rounded.num_names > 0 && rounded.num_locals > 0);
    for (int i = 0; i < 2; i++) {
        struct bind bind = {
            .result = result, .scene = scene, .is_opaque = true, .checker = true, .document = path};
        REQUIRE(draw_source(gpu, &bind, i ? rounded.text : pixel, pictures[i]));
        bind_finish(&bind);
    }
    double worst = difference(pictures[0], pictures[1]);
    printf("%s: %u uniforms, %u locals, difference %.5f\n", element, rounded.num_names,
           rounded.num_locals, worst);
    REQUIRE(worst > 0.0 && worst < 1.0 / 255.0);
    mxg_result_destroy(result);
    mxg_options_destroy(options);
    mxg_document_destroy(document);
}

/* Arguments: pairs of a document and an element. */
int main(int argc, char **argv)
{
    struct gpu gpu;
    struct scene scene;
    mxg_context *context = NULL;
    if (!gpu_open(&gpu)) {
        printf("skip: there is no Vulkan device: %s\nprecision: 0 passed, 0 failed, 1 skipped\n",
               gpu.reason);
        return 77;
    }
    compile_begin();
    REQUIRE(scene_init_sphere(&scene, 1.0));
    REQUIRE(mxg_context_create(NULL, &context) == MXG_OK);
    for (int i = 1; i + 1 < argc; i += 2)
        compare(&gpu, &scene, context, argv[i], argv[i + 1]);
    mxg_context_destroy(context);
    scene_finish(&scene);
    gpu_close(&gpu);
    compile_end();
    return test_report("precision");
}
