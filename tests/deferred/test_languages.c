// SPDX-License-Identifier: Apache-2.0
/*
 * The passes that belong to no material compile in a language. Argument: the target. Options change
 * what they read and write, so that each form of a resource occurs.
 */
#include "compile/compile.h"
#include "unit/test.h"

enum { MAX_SETTINGS = 4 };

static const struct {
    const char *name;
    const char *settings[MAX_SETTINGS][2];
} variants[] = {
    {"default", {{NULL, NULL}}},
    {"bodies", {{"sss", "diffusion"}}},
    {"blurred", {{"rough-refraction", "blur"}}},
    {"bodies, blurred", {{"sss", "diffusion"}, {"rough-refraction", "blur"}}},
    {"whole floats",
     {{"storage", "float"},
      {"shadow-map", "true"},
      {"environment", "prefiltered"},
      {"albedo", "table"}}},
    {"functions of a host",
     {{"host-lights", "true"}, {"host-occlusion", "true"}, {"host-environment", "true"}}},
    {"shadows of a host", {{"host-shadows", "true"}, {"environment", "none"}}},
    {"one light", {{"storage", "round"}, {"max-lights", "1"}, {"environment", "none"}}},
};

/* Compiles what has a stage. Returns whether there was one. */
static bool compile_stage(const char *target, const char *variant, const char *name,
                          const mxg_result *result)
{
    mxg_pass pass = {sizeof pass};
    struct compiled compiled = {0};
    const char *source = mxg_result_source(result, MXG_STAGE_PIXEL, NULL);
    if (!source || mxg_result_pass(result, &pass) != MXG_OK || !pass.group_size[0])
        return false;
    if (!REQUIRE(compile_pass(target, source, &compiled)))
        printf("%s, %s: %s\n", name, variant,
               compiled.num_messages ? compiled.messages[0].text : "no message");
    compiled_finish(&compiled);
    return true;
}

static uint32_t compile_passes(mxg_context *context, const char *target, size_t variant)
{
    uint32_t compiled = 0;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_options *options;
    if (!REQUIRE_EQ(mxg_options_create(context, &options), MXG_OK))
        return 0;
    for (size_t i = 0; i < MAX_SETTINGS && variants[variant].settings[i][0]; ++i)
        REQUIRE_EQ(mxg_options_set(options, variants[variant].settings[i][0],
                                   variants[variant].settings[i][1]),
                   MXG_OK);
    desc.target = target;
    desc.options = options;
    for (uint32_t i = 0; i < mxg_catalogue_num_passes(); ++i) {
        mxg_result *result;
        if (REQUIRE_EQ(mxg_generate_pass(context, i, &desc, &result), MXG_OK))
            compiled +=
                compile_stage(target, variants[variant].name, mxg_catalogue_pass(i), result);
        mxg_result_destroy(result);
    }
    mxg_options_destroy(options);
    return compiled;
}

int main(int argc, char **argv)
{
    static const uint32_t expected[] = {9, 10, 10, 11,
                                        9, 9,  9,  9}; /* passes that the options ask for */
    mxg_context *context;
    if (argc < 2 || mxg_context_create(NULL, &context) != MXG_OK)
        return 2;
    compile_begin();
    bool is_known = compile_knows_target(argv[1]);
    for (size_t i = 0; is_known && i < sizeof variants / sizeof *variants; ++i)
        REQUIRE_EQ(compile_passes(context, argv[1], i), expected[i]);
    mxg_context_destroy(context);
    compile_end();
    return is_known ? test_report("deferred-languages") : 77;
}
