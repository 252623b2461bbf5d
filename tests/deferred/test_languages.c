// SPDX-License-Identifier: Apache-2.0
/*
 * The passes that belong to no material compile in a language. Argument: the target. Options change
 * what they read and write, so that each form of a resource occurs. Functions of a host read the
 * top of a pixel.
 */
#include "compile/compile.h"
#include "unit/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

/* ---- Functions of a host that read the top of a pixel ---- */

/*
 * They stand behind a pass. In Metal they stand above it, with the functions of the pass `read` in
 * a namespace.
 */
static const struct {
    const char *target, *text;
    bool is_above;
} readers[] = {
    {"hlsl",
     "float3 host_top()\n{\n    MxClosure top;\n"
     "    return mx_read_top(mxg_pixel, top) ? top.normal : (float3)0.0;\n}\n",
     false},
    {"slang",
     "float3 host_top()\n{\n    MxClosure top;\n"
     "    return mx_read_top(mxg_pixel, top) ? top.normal : float3(0.0);\n}\n",
     false},
    {"wgsl",
     "fn host_top() -> vec3f\n{\n    var top: MxClosure;\n"
     "    if (mx_read_top(mxg_pixel, &top)) {\n        return top.normal;\n    }\n"
     "    return vec3f(0.0);\n}\n",
     false},
    {"msl",
     "struct Host {\n    int2 mxg_pixel;\n    texture2d_array<uint, access::read> words;\n"
     "    texture2d<uint, access::read> word0, word1, word2;\n    float3 top()\n    {\n"
     "        stored::MxClosure top;\n"
     "        stored::GlobalContext context = {words, word0, word1, word2};\n"
     "        return context.mx_read_top(mxg_pixel, top) ? top.normal : float3(0.0);\n    }\n};\n",
     true},
};

static mxg_result *generate_pass(mxg_context *context, const char *target, const char *name)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_result *result = NULL;
    uint32_t pass = 0;
    desc.target = target;
    while (strcmp(mxg_catalogue_pass(pass), name) != 0)
        ++pass;
    REQUIRE_EQ(mxg_generate_pass(context, pass, &desc, &result), MXG_OK);
    return result;
}

/* A pass with a function of its host that reads the top: malloc. */
static char *with_reader(const char *target, const char *read, const char *source)
{
    static const char above[] = "#include <metal_stdlib>\nusing namespace metal;\n"
                                "namespace stored {\n%s}\n%s%s";
    char *out = NULL;
    for (size_t i = 0; i < sizeof readers / sizeof *readers; ++i) {
        const char *text = readers[i].text;
        size_t size = sizeof above + strlen(read) + strlen(text) + strlen(source);
        if (strcmp(readers[i].target, target) != 0 || !REQUIRE((out = malloc(size)) != NULL))
            continue;
        if (readers[i].is_above)
            snprintf(out, size, above, read, text, source);
        else
            snprintf(out, size, "%s%s", source, text);
    }
    return out;
}

/* Compiles a lighting pass whose host reads the top. */
static void compile_reader(mxg_context *context, const char *target, const char *name,
                           const char *source)
{
    struct compiled compiled = {0};
    mxg_result *read = generate_pass(context, target, "read");
    char *text = with_reader(target, mxg_result_source(read, MXG_STAGE_PIXEL, NULL), source);
    if (text && !REQUIRE(compile_pass(target, text, &compiled)))
        printf("%s, read by its host: %s\n", name,
               compiled.num_messages ? compiled.messages[0].text : "no message");
    REQUIRE(text != NULL);
    compiled_finish(&compiled);
    free(text);
    mxg_result_destroy(read);
}

/* ---- Passes ---- */

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
        const char *name = mxg_catalogue_pass(i);
        if (REQUIRE_EQ(mxg_generate_pass(context, i, &desc, &result), MXG_OK)) {
            compiled += compile_stage(target, variants[variant].name, name, result);
            if (strcmp(variants[variant].name, "functions of a host") == 0
                && strcmp(name, "light_complex") == 0)
                compile_reader(context, target, name,
                               mxg_result_source(result, MXG_STAGE_PIXEL, NULL));
        }
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
