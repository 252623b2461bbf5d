// SPDX-License-Identifier: Apache-2.0
/*
 * src/api/combinations.def: every pair of values of its options is generated. A pair of a row is an
 * error that names both options, and all others give a shader.
 */
#include <mxgen/mxgen.h>

#include "test.h"

#include <string.h>

static const struct row {
    const char *option, *value, *other, *other_value;
} rows[] = {
#define COMBINATION(option, value, other, other_value, why) {#option, value, #other, other_value},
#include "api/combinations.def"
#undef COMBINATION
};
enum { NUM_ROWS = sizeof rows / sizeof *rows };

/* The values of the options that have rows; the first is the default, "" where it is not set. */
static const struct setting {
    const char *id, *key, *values[5];
} settings[] = {
    {"pipeline", "pipeline", {"forward", "deferred", "depth"}},
    {"integrator", "integrator", {"raster", "path", "scatter"}},
    {"form", "form", {"program", "function", "payload"}},
    {"storage", "storage", {"dither", "round", "float"}},
    {"sss", "sss", {"wrap", "diffusion"}},
    {"rough_refraction", "rough-refraction", {"sharp", "blur"}},
    {"slots", "slots", {"blend", "stochastic"}},
    {"transparency", "transparency", {"auto", "opaque", "mask", "blend", "dual"}},
    {"transmission", "transmission", {"refraction", "opacity"}},
    {"layering", "layering", {"view", "two-sided"}},
    {"encode", "encode", {"linear", "srgb"}},
    {"occlusion_map", "occlusion-map", {"false", "true"}},
    {"shadow_map", "shadow-map", {"false", "true"}},
    {"sample_filter", "sample-filter", {"wide", "narrow"}},
    {"lights", "lights", {"", "point_light=2"}},
    {"max_lights", "max-lights", {"3", "8"}},
};
enum { NUM_SETTINGS = sizeof settings / sizeof *settings };

struct run {
    mxg_context *context;
    mxg_document *document;
    bool is_found[NUM_ROWS];
    unsigned good, bad;
};

/* The row of a pair, in this order; NUM_ROWS: there is none. */
static size_t row_of(const struct setting *a, size_t i, const struct setting *b, size_t k)
{
    for (size_t r = 0; r < NUM_ROWS; r++) {
        const struct row *row = &rows[r];
        bool has_other = row->other_value ? strcmp(row->other_value, b->values[k]) == 0 : k > 0;
        if (strcmp(row->option, a->id) == 0 && strcmp(row->value, a->values[i]) == 0
            && strcmp(row->other, b->id) == 0 && has_other)
            return r;
    }
    return NUM_ROWS;
}

/* The message of the only diagnostic names both options. */
static void check_message(const mxg_result *result, const struct row *row,
                          const struct setting *option, const struct setting *other)
{
    char one[64], two[64];
    mxg_diagnostic diagnostic = {sizeof diagnostic};
    const mxg_diagnostics *list = mxg_result_diagnostics(result);
    snprintf(one, sizeof one, "'%s=%s'", option->key, row->value);
    snprintf(two, sizeof two, row->other_value ? "'%s=%s'" : "'%s'", other->key,
             row->other_value ? row->other_value : "");
    if (REQUIRE_EQ(mxg_diagnostics_count(list), 1)
        && REQUIRE(mxg_diagnostics_get(list, 0, &diagnostic) == MXG_OK))
        REQUIRE(strstr(diagnostic.message, one) && strstr(diagnostic.message, two));
}

static void set(mxg_options *options, const char *key, const char *value)
{
    if (*value)
        REQUIRE(mxg_options_set(options, key, value) == MXG_OK);
}

static void test_pair(struct run *run, const struct setting *a, size_t i, const struct setting *b,
                      size_t k)
{
    mxg_options *options = NULL;
    mxg_result *result = NULL;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    size_t row = row_of(a, i, b, k), back = row_of(b, k, a, i), size = 0;
    REQUIRE(row == NUM_ROWS || back == NUM_ROWS);
    REQUIRE(mxg_options_create(run->context, &options) == MXG_OK);
    set(options, a->key, a->values[i]);
    set(options, b->key, b->values[k]);
    desc.target = "vulkan";
    desc.element = "SR";
    desc.options = options;
    mxg_status status = mxg_generate(run->context, run->document, &desc, &result);
    bool is_good = row == NUM_ROWS && back == NUM_ROWS;
    if (!REQUIRE((status == MXG_OK) == is_good))
        printf("    %s=%s, %s=%s\n", a->key, a->values[i], b->key, b->values[k]);
    else if (is_good)
        REQUIRE(mxg_result_source(result, MXG_STAGE_PIXEL, &size) && size > 0);
    else if (row < NUM_ROWS)
        check_message(result, &rows[row], a, b);
    else
        check_message(result, &rows[back], b, a);
    for (size_t r = 0; r < NUM_ROWS; r++)
        run->is_found[r] |= r == row || r == back;
    run->good += is_good;
    run->bad += !is_good;
    mxg_result_destroy(result);
    mxg_options_destroy(options);
}

static void test_options(struct run *run, const struct setting *a, const struct setting *b)
{
    enum { MAX_VALUES = sizeof a->values / sizeof *a->values };
    for (size_t i = 0; i < MAX_VALUES && a->values[i]; i++)
        for (size_t k = 0; k < MAX_VALUES && b->values[k]; k++)
            test_pair(run, a, i, b, k);
}

int main(void)
{
    static const char text[] =
        "<materialx version='1.39'><slab name='matter' type='BSDF'/>"
        "<slab_surface name='SR' type='surfaceshader'>"
        "<input name='bsdf' type='BSDF' nodename='matter'/></slab_surface></materialx>";
    struct run run = {.good = 0};
    REQUIRE(mxg_context_create(NULL, &run.context) == MXG_OK);
    mxg_library *library = mxg_library_builtin(run.context);
    REQUIRE(mxg_document_parse(run.context, library, "c.mtlx", text, strlen(text), &run.document)
            == MXG_OK);
    for (size_t i = 0; i < NUM_SETTINGS; i++)
        for (size_t k = i + 1; k < NUM_SETTINGS; k++)
            test_options(&run, &settings[i], &settings[k]);
    for (size_t r = 0; r < NUM_ROWS; r++)
        if (!REQUIRE(run.is_found[r]))
            printf("    no pair has %s=%s, %s\n", rows[r].option, rows[r].value, rows[r].other);
    printf("%u pairs with a meaning, %u without\n", run.good, run.bad);
    mxg_document_destroy(run.document);
    mxg_library_unref(library);
    mxg_context_destroy(run.context);
    return test_report("combinations");
}
