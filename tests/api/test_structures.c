// SPDX-License-Identifier: Apache-2.0
/*
 * Elements of equal structure, in all documents of some folders, have shaders of equal topology,
 * interface, counts and diagnostics; with neutral names and without comments, of equal text. So
 * have variants of them, in which an attribute has the value of another, a digit is another or an
 * element is left out. And of every element it is told without the shader what is told with it.
 * Arguments: the folders; of those that are not there the test says so.
 */
#define _XOPEN_SOURCE 700
#include "tests/api/fixture.h"

#include <ftw.h>
#include <inttypes.h>

static const struct request {
    const char *target, *interface;
    bool has_values; /* in the source: uniforms' values stand in it */
    bool has_variants;
} requests[] = {
    {"glsl", "complete", true, false},  {"glsl", "authored", true, false},
    {"glsl", "reduced", true, false},   {"vulkan", "complete", false, true},
    {"vulkan", "reduced", false, true}, {"osl", "complete", true, false},
    {"osl", "reduced", true, false},
};
enum { NUM_REQUESTS = sizeof requests / sizeof *requests };

struct known {
    uint64_t structure;
    char *facts, *element;
};

static struct corpus {
    mxg_context *context;
    mxg_library *library;
    mxg_options *options[NUM_REQUESTS];
    struct known *known; /* of the request at hand, by structure in a table */
    size_t len, mask;
    char **paths;
    size_t num_paths;
    unsigned num_elements, num_told, num_equal;
} corpus;

/* ---- Documents ---- */

static int collect(const char *path, const struct stat *status, int kind, struct FTW *at)
{
    size_t len = strlen(path);
    (void)status;
    (void)at;
    if (kind != FTW_F || len < 5 || strcmp(path + len - 5, ".mtlx") != 0)
        return 0;
    corpus.paths = realloc(corpus.paths, (corpus.num_paths + 1) * sizeof *corpus.paths);
    corpus.paths[corpus.num_paths] = memcpy(malloc(len + 1), path, len + 1);
    corpus.num_paths++;
    return 0;
}

/* ---- What is compared ---- */

static uint64_t hash_text(const char *text)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (; text && *text; text++)
        hash = (hash ^ (unsigned char)*text) * 0x100000001b3u;
    return hash;
}

static void print_variables(FILE *out, const mxg_result *result)
{
    for (uint32_t i = 0; i < mxg_result_num_variables(result); i++) {
        mxg_variable v = {sizeof v};
        mxg_result_variable(result, i, &v);
        fprintf(out,
                "%d %s %s %s stages %u, [%u], at %u %u %u, offset %u size %u strides %u %u, values "
                "%u, modes %s %s %s, tiles %u\n",
                (int)v.block, v.type, v.document_type, v.semantic, v.stages, v.array_length, v.set,
                v.binding, v.location, v.offset, v.byte_size, v.array_stride, v.matrix_stride,
                v.num_values, v.uaddressmode, v.vaddressmode, v.filtertype, v.num_tiles);
    }
}

static void print_diagnostics(FILE *out, const mxg_result *result)
{
    const mxg_diagnostics *list = mxg_result_diagnostics(result);
    for (uint32_t i = 0; i < mxg_diagnostics_count(list); i++) {
        mxg_diagnostic d = {sizeof d};
        mxg_diagnostics_get(list, i, &d);
        fprintf(out, "%d %s\n", (int)d.severity, d.id);
    }
}

static void compare_diagnostics(const mxg_document *document, mxg_generate_desc desc,
                                mxg_status status, const mxg_result *whole)
{
    mxg_result *told = NULL;
    desc.only_diagnostics = true;
    REQUIRE_EQ(mxg_generate(corpus.context, document, &desc, &told), status);
    const mxg_diagnostics *list = mxg_result_diagnostics(told),
                          *expected = mxg_result_diagnostics(whole);
    REQUIRE_EQ(mxg_diagnostics_count(list), mxg_diagnostics_count(expected));
    for (uint32_t i = 0; i < mxg_diagnostics_count(expected); i++) {
        char texts[2][512];
        mxg_diagnostics_format(list, i, NULL, 0, false, texts[0], sizeof texts[0]);
        mxg_diagnostics_format(expected, i, NULL, 0, false, texts[1], sizeof texts[1]);
        REQUIRE_STR(texts[0], texts[1]);
    }
    mxg_result_destroy(told);
}

static char *facts_of(const struct request *request, mxg_status status, const mxg_result *result)
{
    char *facts = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&facts, &size);
    mxg_shader_info info = {sizeof info};
    fprintf(out, "status %d\n", (int)status);
    print_diagnostics(out, result);
    if (status == MXG_OK && mxg_result_info(result, &info) == MXG_OK) {
        fprintf(out,
                "topology %016" PRIx64
                ", closures %u, textures %u, lights %u, %d %d %d %d, compiled %u\n",
                info.topology, info.num_closures, info.num_textures, info.num_lights,
                info.transparent, info.lit, info.displaced, (int)info.alpha,
                request->has_values ? 0 : mxg_result_num_compiled_inputs(result));
        print_variables(out, result);
    }
    for (int stage = 0; stage < MXG_NUM_STAGES && !request->has_values; stage++)
        fprintf(out, "source %016" PRIx64 "\n",
                hash_text(mxg_result_source(result, (mxg_stage)stage, NULL)));
    fclose(out);
    return facts;
}

/* ---- The table ---- */

static struct known *find(uint64_t structure)
{
    size_t at = (size_t)structure & corpus.mask;
    while (corpus.known[at].structure && corpus.known[at].structure != structure)
        at = (at + 1) & corpus.mask;
    return &corpus.known[at];
}

static void grow(void)
{
    struct known *old = corpus.known;
    size_t slots = corpus.known ? corpus.mask + 1 : 0;
    corpus.mask = slots ? slots * 2 - 1 : 255;
    corpus.known = calloc(corpus.mask + 1, sizeof *corpus.known);
    for (size_t i = 0; i < slots; i++)
        if (old[i].structure)
            *find(old[i].structure) = old[i];
    free(old);
}

static void forget(void)
{
    for (size_t i = 0; corpus.known && i <= corpus.mask; i++) {
        free(corpus.known[i].facts);
        free(corpus.known[i].element);
    }
    free(corpus.known);
    corpus.known = NULL;
    corpus.len = corpus.mask = 0;
}

static void compare(uint64_t structure, char *facts, const char *path, const char *element)
{
    if (corpus.len * 2 >= corpus.mask)
        grow();
    struct known *known = find(structure);
    if (!known->structure) {
        size_t size = strlen(path) + strlen(element) + 3;
        *known = (struct known){structure, facts, malloc(size)};
        snprintf(known->element, size, "%s: %s", path, element);
        corpus.len++;
        return;
    }
    corpus.num_equal++;
    if (!REQUIRE_STR(facts, known->facts))
        printf("    %s: %s, and %s\n", path, element, known->element);
    free(facts);
}

/* ---- Variants ---- */

/* bytes of a document, variants of each, elements of those */
enum { MAX_VARIED = 1 << 16, NUM_VARIANTS = 10, NUM_VARIED_ELEMENTS = 3 };

static uint64_t random_state = 1;

/* Knuth's linear congruential generator (MMIX), its high bits. */
static size_t pick(size_t n)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (size_t)(random_state >> 33) % n;
}

static char *read_text(const char *path, size_t *out_len)
{
    FILE *file = fopen(path, "rb");
    char *text = malloc(MAX_VARIED + 1);
    *out_len = file ? fread(text, 1, MAX_VARIED, file) : 0;
    text[*out_len] = '\0';
    if (file)
        fclose(file);
    return text;
}

/* The text between quotes of an attribute from `at` on; false: there is none. */
static bool find_attribute(const char *text, size_t at, const char *name, size_t *out_begin,
                           size_t *out_end)
{
    char start[32];
    snprintf(start, sizeof start, " %s=\"", name);
    const char *found = strstr(text + at, start),
               *end = found ? strchr(found + strlen(start), '"') : NULL;
    if (!end)
        return false;
    *out_begin = (size_t)(found - text) + strlen(start);
    *out_end = (size_t)(end - text);
    return true;
}

static char *splice(const char *text, size_t begin, size_t end, const char *other, size_t len)
{
    size_t size = strlen(text);
    char *out = malloc(size + len + 1);
    memcpy(out, text, begin);
    memcpy(out + begin, other, len);
    memcpy(out + begin + len, text + end, size - end + 1);
    return out;
}

/* To be freed; NULL: nothing could be changed there. */
static char *vary(const char *text, size_t len)
{
    static const char *const names[] = {"value",    "value",         "value",
                                        "nodename", "output",        "colorspace",
                                        "type",     "interfacename", "nodegraph"};
    const char *name = names[pick(sizeof names / sizeof *names)];
    size_t begin, end, other, other_end;
    if (pick(4) == 0) {
        const char *input = strstr(text + pick(len), "<input "),
                   *close = input ? strstr(input, "/>") : NULL;
        return close ? splice(text, (size_t)(input - text), (size_t)(close - text) + 2, "", 0)
                     : NULL;
    }
    if (!find_attribute(text, pick(len), name, &begin, &end))
        return NULL;
    if (pick(2) && find_attribute(text, pick(len), name, &other, &other_end))
        return splice(text, begin, end, text + other, other_end - other);
    size_t digit = begin + strcspn(text + begin, "0123456789\"");
    char changed = (char)('0' + pick(10));
    return digit < end ? splice(text, digit, digit + 1, &changed, 1) : NULL;
}

static void examine(const mxg_document *document, const char *path, unsigned at, uint32_t limit);

static void examine_variants(const char *path, unsigned at)
{
    size_t len;
    char *text = read_text(path, &len);
    for (int i = 0; i < NUM_VARIANTS && len && len < MAX_VARIED; i++) {
        char *variant = vary(text, len);
        mxg_document *document = NULL;
        if (variant)
            mxg_document_parse(corpus.context, corpus.library, path, variant, strlen(variant),
                               &document);
        if (document)
            examine(document, path, at, NUM_VARIED_ELEMENTS);
        mxg_document_destroy(document);
        free(variant);
    }
    free(text);
}

/* ---- The whole ---- */

static void examine(const mxg_document *document, const char *path, unsigned at, uint32_t limit)
{
    for (uint32_t i = 0; i < mxg_document_num_renderables(document) && i < limit; i++) {
        mxg_renderable renderable = {sizeof renderable};
        mxg_document_renderable(document, i, &renderable);
        mxg_generate_desc desc = {sizeof desc, requests[at].target, renderable.path,
                                  corpus.options[at], requests[at].has_values};
        uint64_t structure = 0;
        REQUIRE_EQ(mxg_document_structure(corpus.context, document, &desc, &structure), MXG_OK);
        mxg_result *result = NULL;
        mxg_status status = mxg_generate(corpus.context, document, &desc, &result);
        compare_diagnostics(document, desc, status, result);
        corpus.num_elements++;
        corpus.num_told += structure != 0;
        if (structure)
            compare(structure, facts_of(&requests[at], status, result), path, renderable.path);
        mxg_result_destroy(result);
    }
}

static void examine_all(unsigned at)
{
    REQUIRE_EQ(mxg_options_create(corpus.context, &corpus.options[at]), MXG_OK);
    mxg_options_set(corpus.options[at], "interface", requests[at].interface);
    mxg_options_set(corpus.options[at], "names", "neutral");
    mxg_options_set(corpus.options[at], "comments", "false");
    for (size_t i = 0; i < corpus.num_paths; i++) {
        mxg_document *document = NULL;
        mxg_document_load(corpus.context, corpus.library, corpus.paths[i], &document);
        examine(document, corpus.paths[i], at, UINT32_MAX);
        mxg_document_destroy(document);
        if (requests[at].has_variants)
            examine_variants(corpus.paths[i], at);
    }
    forget();
    mxg_options_destroy(corpus.options[at]);
}

int main(int argc, char **argv)
{
    mxg_context_create(NULL, &corpus.context);
    corpus.library = mxg_library_builtin(corpus.context);
    for (int i = 1; i < argc; i++) {
        size_t before = corpus.num_paths;
        nftw(argv[i], collect, 16, FTW_PHYS);
        if (corpus.num_paths == before)
            printf("skipped: '%s' has no documents\n", argv[i]);
    }
    REQUIRE(corpus.num_paths > 0);
    for (unsigned at = 0; at < NUM_REQUESTS; at++)
        examine_all(at);
    printf("%u elements, of which %u have a structure, and %u are equal to one before\n",
           corpus.num_elements, corpus.num_told, corpus.num_equal);
    REQUIRE(corpus.num_equal > 0);
    for (size_t i = 0; i < corpus.num_paths; i++)
        free(corpus.paths[i]);
    free(corpus.paths);
    mxg_library_unref(corpus.library);
    mxg_context_destroy(corpus.context);
    return test_report("api-structures");
}
