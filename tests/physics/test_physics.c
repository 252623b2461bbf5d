// SPDX-License-Identifier: Apache-2.0
/*
 * Energy, reciprocity and sampling of every leaf (leaves.def), measured on the first Vulkan device
 * by measure.glsl: a pixel for each setting and angle.
 *
 *     test_physics FOLDER SHADERS [-v] [NAME...]      FOLDER has measure.glsl, SHADERS the
 * library's shading functions
 */
#define _POSIX_C_SOURCE 200809L
#include "render/render.h"
#include "compile/compile.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EXIT_SKIPPED = 77 };

struct leaf {
    const char *name, *file, *function, *arguments, *eval_arguments;
    bool refracts;
    const char *back, *through;
    double albedo_error;
    bool is_reciprocal;
};

static const struct leaf leaves[] = {
#define LEAF(name, file, function, arguments, eval_arguments, refracts, back, through, \
             albedo_error, is_reciprocal) \
    {#name,    file, function, arguments,    eval_arguments, \
     refracts, back, through,  albedo_error, is_reciprocal},
#include "leaves.def"
#undef LEAF
};

struct run {
    const char *folder, *shaders;
    bool is_verbose;
    char *measures;                     /* measure.glsl */
    char source[32768], document[4096]; /* of the leaf at hand */
    mxg_context *context;
    mxg_library *library;
    mxg_options *options;
    struct gpu gpu;
    struct scene scene;
    unsigned passed, failed;
};

/* ---- Files ---- */

/* Its text, ended by 0; to be freed. NULL where it is not there. */
static char *read_file(const char *folder, const char *name, char *path, size_t room)
{
    snprintf(path, room, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    char *text = NULL;
    if (file && fseek(file, 0, SEEK_END) == 0) {
        size_t size = (size_t)ftell(file);
        rewind(file);
        text = malloc(size + 1);
        if (text)
            text[fread(text, 1, size, file)] = '\0';
    }
    if (file)
        fclose(file);
    return text;
}

/* The leaf's document and source are made here; what they include is the library's. */
static bool open_file(void *user_data, const char *from, const char *ref, mxg_blob *out,
                      const char **out_reason)
{
    static char path[4096], folder[4096];
    struct run *run = user_data;
    (void)out_reason;
    /* the leaf is in no folder; what it includes is relative to the library's */
    const char *end = from ? strrchr(from, '/') : NULL;
    snprintf(folder, sizeof folder, "%.*s", end ? (int)(end - from) : 4095,
             end ? from : run->shaders);
    bool is_source = strcmp(ref, "leaf.glsl") == 0;
    if (is_source || strcmp(ref, "leaf.mtlx") == 0) {
        out->data = is_source ? run->source : run->document;
        out->name = ref;
    } else {
        out->data = out->handle = read_file(folder, ref, path, sizeof path);
        out->name = path;
    }
    out->size = out->data ? strlen(out->data) : 0;
    return out->data != NULL;
}

static void release_file(void *user_data, mxg_blob *blob)
{
    (void)user_data;
    free(blob->handle);
}

/* ---- Making a leaf ---- */

static void make_source(struct run *run, const struct leaf *leaf)
{
    char refraction[1024] = "vec3(0.0)";
    if (leaf->refracts)
        snprintf(refraction, sizeof refraction, "mx_%s_refraction(%s, V, L)", leaf->function,
                 leaf->arguments);
    snprintf(run->source, sizeof run->source,
             "#include \"%s.glsl\"\n"
             "const vec3 N = vec3(0.0, 0.0, 1.0);\n"
             "const vec3 X = vec3(1.0, 0.0, 0.0);\n"
             "vec3 leaf_eval(float a, float b, vec3 V, vec3 L) { return mx_%s_eval(%s, %s); }\n"
             "vec3 leaf_refraction(float a, float b, vec3 V, vec3 L) { return %s; }\n"
             "vec3 leaf_albedo(float a, float b, vec3 V) { return mx_%s_albedo(%s, V); }\n"
             "vec3 leaf_sample(float a, float b, vec3 V, vec3 xi, out vec3 weight, out float pdf)\n"
             "{ vec3 L; mx_%s_sample(%s, V, xi, L, weight, pdf); return L; }\n"
             "float leaf_pdf(float a, float b, vec3 V, vec3 L) { return mx_%s_pdf(%s, V, L); }\n"
             "vec3 leaf_back(float a, float b, vec3 V) { return normalize(%s); }\n"
             "vec3 leaf_through(float a, float b, vec3 V) { return normalize(%s); }\n"
             "%s",
             leaf->file, leaf->function, leaf->arguments, leaf->eval_arguments, refraction,
             leaf->function, leaf->arguments, leaf->function, leaf->arguments, leaf->function,
             leaf->arguments, leaf->back, leaf->through, run->measures);
}

/* An output for each measure. */
static void make_document(struct run *run)
{
    static const char *const names[] = {"energy", "agreement", "histogram"};
    int len = snprintf(run->document, sizeof run->document, "<materialx version=\"1.39\">");
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        len +=
            snprintf(run->document + len, sizeof run->document - (size_t)len,
                     "<nodedef name=\"ND_%s\" node=\"%s\"><input name=\"st\" "
                     "type=\"vector2\"/><output name=\"out\" type=\"color4\"/>"
                     "</nodedef><implementation name=\"IM_%s\" nodedef=\"ND_%s\" "
                     "file=\"leaf.glsl\" function=\"%s\"/>"
                     "<texcoord name=\"st_%s\" type=\"vector2\"/><%s name=\"%s\" type=\"color4\">"
                     "<input name=\"st\" type=\"vector2\" nodename=\"st_%s\"/></%s>",
                     names[i], names[i], names[i], names[i], names[i], names[i], names[i], names[i],
                     names[i], names[i]);
    snprintf(run->document + len, sizeof run->document - (size_t)len, "</materialx>");
}

static void print_errors(const mxg_diagnostics *list)
{
    char text[1024];
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); ++i) {
        mxg_diagnostics_format(list, i, NULL, 0, false, text, sizeof text);
        puts(text);
    }
}

/* Rows from the bottom. */
static bool draw(struct run *run, mxg_document *document, const char *measure, uint32_t width,
                 uint32_t height, float (*out)[4])
{
    float(*pixels)[4] = malloc((size_t)width * height * sizeof *pixels);
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "vulkan";
    desc.element = measure;
    desc.options = run->options;
    mxg_result *result = NULL;
    bool good = pixels && mxg_generate(run->context, document, &desc, &result) == MXG_OK;
    if (good) {
        struct bind bind = {.result = result, .scene = &run->scene, .document = ""};
        good = render_result(&run->gpu, &bind, width, height, pixels[0]);
        if (!good)
            printf("%s\n", bind.reason);
        bind_finish(&bind);
    } else if (result) {
        print_errors(mxg_result_diagnostics(result));
    }
    for (uint32_t y = 0; good && y < height; ++y)
        memcpy(out[(size_t)y * width], pixels[(size_t)(height - 1 - y) * width],
               width * sizeof *pixels);
    free(pixels);
    mxg_result_destroy(result);
    return good;
}

/* ---- Judgement ---- */

static void expect(struct run *run, const struct leaf *leaf, const char *what, double got,
                   double at_most)
{
    bool good = got <= at_most;
    if (!good || run->is_verbose)
        printf("%s: %s %.4g%s\n", leaf->name, what, got, good ? "" : ": too much");
    *(good ? &run->passed : &run->failed) += 1;
}

enum { ANGLES = 8, SETTINGS = 24 };

/* Every pixel's value in one channel. */
static void expect_all(struct run *run, const struct leaf *leaf, const char *what,
                       float (*pixels)[4], int channel, double at_most)
{
    char text[128];
    size_t worst = 0;
    double values[ANGLES * SETTINGS];
    for (size_t i = 0; i < ANGLES * SETTINGS; ++i) {
        values[i] = isnan(pixels[i][channel]) ? INFINITY : fabs((double)pixels[i][channel]);
        worst = values[i] > values[worst] ? i : worst;
    }
    snprintf(text, sizeof text, "%s at angle %zu, settings %zu and %zu", what, worst % ANGLES,
             worst / ANGLES % 6, worst / ANGLES / 6);
    expect(run, leaf, text, values[worst], at_most);
}

/* Pixels of a measure; false, counted, where there are none. */
static bool measure(struct run *run, const struct leaf *leaf, mxg_document *document,
                    const char *name, uint32_t width, uint32_t height, float (*out)[4])
{
    bool good = draw(run, document, name, width, height, out);
    if (!good)
        printf("%s: no %s\n", leaf->name, name);
    run->failed += !good;
    return good;
}

static void judge_energy(struct run *run, const struct leaf *leaf, mxg_document *document)
{
    float pixels[ANGLES * SETTINGS][4];
    if (!measure(run, leaf, document, "energy", ANGLES, SETTINGS, pixels))
        return;
    expect_all(run, leaf, "albedo", pixels, 0, 1.0 + 1e-3);
    expect_all(run, leaf, "error of _albedo", pixels, 1, leaf->albedo_error);
    expect_all(run, leaf, "error of the integral of _pdf", pixels, 2, 0.02);
    expect_all(run, leaf, "error of the mean weight", pixels, 3, 0.02);
}

static void judge_agreement(struct run *run, const struct leaf *leaf, mxg_document *document)
{
    float pixels[ANGLES * SETTINGS][4];
    if (!measure(run, leaf, document, "agreement", ANGLES, SETTINGS, pixels))
        return;
    expect_all(run, leaf, "difference of weight pdf and _eval", pixels, 0, 0.01);
    expect_all(run, leaf, "difference of pdf and _pdf", pixels, 1, 0.01);
    if (leaf->is_reciprocal)
        expect_all(run, leaf, "difference of f(V, L) and f(L, V)", pixels, 2, 0.01);
    expect_all(run, leaf, "nonsense in samples", pixels, 3, 0.0);
}

/*
 * Pearson's test: bins of few samples are one; the statistic as a normal deviate (Wilson and
 * Hilferty 1931).
 */
static double chi_square_deviate(float (*bins)[4], size_t count, double samples)
{
    double statistic = 0.0, few_expected = 0.0, few_got = 0.0, freedom = -1.0;
    for (size_t i = 0; i < count; ++i) {
        double expected = (double)bins[i][0] * samples, got = (double)bins[i][1] * samples;
        if (expected < 5.0) {
            few_expected += expected;
            few_got += got;
            continue;
        }
        statistic += (got - expected) * (got - expected) / expected;
        ++freedom;
    }
    if (few_expected > 5.0) {
        statistic += (few_got - few_expected) * (few_got - few_expected) / few_expected;
        ++freedom;
    } else if (few_got > few_expected + 20.0) {
        return INFINITY;
    }
    double k = fmax(freedom, 1.0);
    return (cbrt(statistic / k) - (1.0 - 2.0 / (9.0 * k))) / sqrt(2.0 / (9.0 * k));
}

static void judge_histogram(struct run *run, const struct leaf *leaf, mxg_document *document)
{
    enum { RUNS = 4, BINS = 16 * 8, DRAWS = 8192 };
    static float pixels[RUNS * BINS][4];
    if (!measure(run, leaf, document, "histogram", 16, 8 * RUNS, pixels))
        return;
    for (size_t i = 0; i < RUNS; ++i)
        expect(run, leaf, "chi-square, as a normal deviate,",
               chi_square_deviate(pixels + i * BINS, BINS, DRAWS), 3.5);
}

static void check_leaf(struct run *run, const struct leaf *leaf)
{
    mxg_document *document = NULL;
    make_source(run, leaf);
    make_document(run);
    if (mxg_document_load(run->context, run->library, "leaf.mtlx", &document) == MXG_OK) {
        judge_energy(run, leaf, document);
        judge_agreement(run, leaf, document);
        judge_histogram(run, leaf, document);
    } else {
        ++run->failed;
        printf("%s: the document is faulty\n", leaf->name);
        if (document)
            print_errors(mxg_document_diagnostics(document));
    }
    mxg_document_destroy(document);
}

static bool start(struct run *run)
{
    mxg_resolver resolver = {run, open_file, release_file};
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.resolver = &resolver;
    char path[4096];
    compile_begin();
    run->measures = read_file(run->folder, "measure.glsl", path, sizeof path);
    return run->measures && mxg_context_create(&desc, &run->context) == MXG_OK
           && (run->library = mxg_library_builtin(run->context)) != NULL
           && mxg_options_create(run->context, &run->options) == MXG_OK
           && mxg_options_set(run->options, "role", "path") == MXG_OK
           && scene_init_plane(&run->scene);
}

static void stop(struct run *run)
{
    free(run->measures);
    scene_finish(&run->scene);
    gpu_close(&run->gpu);
    mxg_options_destroy(run->options);
    mxg_library_unref(run->library);
    mxg_context_destroy(run->context);
    compile_end();
}

static bool is_wanted(const char *name, char **names, int count)
{
    for (int i = 0; i < count; ++i)
        if (strcmp(names[i], name) == 0)
            return true;
    return count == 0;
}

int main(int argc, char **argv)
{
    if (argc < 3) {
        fprintf(stderr, "usage: %s FOLDER SHADERS [-v] [NAME...]\n", argv[0]);
        return 2;
    }
    static struct run run;
    run.folder = argv[1];
    run.shaders = argv[2];
    run.is_verbose = argc > 3 && strcmp(argv[3], "-v") == 0;
    int first = run.is_verbose ? 4 : 3, code = 1;
    if (!gpu_open(&run.gpu)) {
        printf("skip: there is no Vulkan device: %s\n", run.gpu.reason);
        code = EXIT_SKIPPED;
    } else if (start(&run)) {
        for (size_t i = 0; i < sizeof leaves / sizeof *leaves; ++i)
            if (is_wanted(leaves[i].name, argv + first, argc - first))
                check_leaf(&run, &leaves[i]);
        printf("physics: %u passed, %u failed\n", run.passed, run.failed);
        code = run.failed ? 1 : 0;
    }
    stop(&run);
    return code;
}
