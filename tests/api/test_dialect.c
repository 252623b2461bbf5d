// SPDX-License-Identifier: Apache-2.0
/* Targets of hosts: mxg_context_desc.dialects. */
#include "tests/unit/test.h"

#include <mxgen/mxgen.h>

#include <stdlib.h>

static const char text[] =
    "<materialx version='1.39'><targetdef name='mygl' inherit='genglsl'/>"
    "<nodedef name='ND_tone' node='tone'><input name='in' type='float' value='0.5'/>"
    "<output name='out' type='float'/></nodedef>"
    "<implementation name='IM_tone' nodedef='ND_tone' sourcecode='{{in}} * 2.0'/>"
    "<implementation name='IM_tone_mygl' nodedef='ND_tone' target='mygl' "
    "sourcecode='my_tone({{in}})'/>"
    "<tone name='t' type='float'/><output name='Tone' type='float' nodename='t'/>"
    "<standard_surface name='S' type='surfaceshader'/></materialx>";

static const char *const defaults[] = {"interface", "reduced", "uniform-blocks",
                                       "true",      "prefix",  "my_"};

static mxg_dialect dialect(void)
{
    return (mxg_dialect){.size = sizeof(mxg_dialect),
                         .name = "mygl",
                         .base = "genglsl",
                         .version = "330",
                         .options = defaults,
                         .num_options = 3,
                         .stage_suffix = {NULL, "my.frag"}};
}

static mxg_status create(const mxg_dialect *const *dialects, size_t count, mxg_context **out)
{
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.dialects = dialects;
    desc.num_dialects = count;
    desc.trust = true;
    return mxg_context_create(&desc, out);
}

static mxg_result *generate(mxg_context *context, const mxg_document *document, const char *element,
                            const char *target, const mxg_options *options, mxg_status expected)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_result *result = NULL;
    desc.target = target;
    desc.element = element;
    desc.options = options;
    REQUIRE_EQ(mxg_generate(context, document, &desc, &result), expected);
    return result;
}

static bool has(const mxg_result *result, const char *word)
{
    const char *source = mxg_result_source(result, MXG_STAGE_PIXEL, NULL);
    return source && strstr(source, word);
}

static void test_use(void)
{
    const mxg_dialect own = dialect(), *const list[] = {&own};
    mxg_context *context = NULL;
    mxg_document *document = NULL;
    REQUIRE_EQ(create(list, 1, &context), MXG_OK);
    mxg_library *library = mxg_library_builtin(context);
    REQUIRE_EQ(mxg_document_parse(context, library, "mygl.mtlx", text, sizeof text - 1, &document),
               MXG_OK);
    mxg_result *result = generate(context, document, "Tone", "mygl", NULL, MXG_OK);
    REQUIRE(has(result, "#version 330"));
    REQUIRE(has(result, "my_tone(0.5)")); /* its own implementation */
    mxg_shader_info info = MXG_INIT(mxg_shader_info);
    REQUIRE_EQ(mxg_result_info(result, &info), MXG_OK);
    REQUIRE_STR(info.target, "mygl");
    mxg_result_destroy(result);
    result = generate(context, document, "S", "mygl", NULL, MXG_OK);
    REQUIRE(has(result, "uniform my_PrivateUniforms {"));
    REQUIRE(!has(result, "PublicUniforms"));
    mxg_result_destroy(result);
    mxg_options *options = NULL;
    mxg_options_create(context, &options);
    mxg_options_set(options, "interface", "complete"); /* the host's own setting counts */
    mxg_options_set(options, "target-version", "450");
    result = generate(context, document, "S", "mygl", options, MXG_OK);
    REQUIRE(has(result, "uniform my_PublicUniforms {") && has(result, "#version 450"));
    mxg_result_destroy(result);
    mxg_options_destroy(options);
    result = generate(context, document, "S", "glsl", NULL, MXG_OK); /* the base stays */
    REQUIRE(has(result, "#version 450") && !has(result, "my_"));
    mxg_result_destroy(result);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
}

static void test_unknown(void)
{
    const mxg_dialect own = dialect(), *const list[] = {&own};
    mxg_context *context = NULL, *without = NULL;
    mxg_document *document = NULL;
    char message[512];
    REQUIRE_EQ(create(list, 1, &context), MXG_OK);
    REQUIRE_EQ(create(NULL, 0, &without), MXG_OK);
    for (int i = 0; i < 2; ++i) {
        mxg_context *c = i ? without : context;
        mxg_library *library = mxg_library_builtin(c);
        mxg_document_parse(c, library, "mygl.mtlx", text, sizeof text - 1, &document);
        mxg_result *result =
            generate(c, document, "S", i ? "mygl" : "yourgl", NULL, MXG_ERROR_DOCUMENT);
        mxg_diagnostics_format(mxg_result_diagnostics(result), 0, NULL, 0, false, message,
                               sizeof message);
        REQUIRE(strstr(message, "unknown-target"));
        REQUIRE_EQ(strstr(message, "mygl;") == NULL && strstr(message, ", mygl") != NULL, i == 0);
        mxg_result_destroy(result);
        mxg_document_destroy(document);
        mxg_library_unref(library);
    }
    mxg_context_destroy(context);
    mxg_context_destroy(without);
}

/* The reason begins with the text; "": a context is made. */
static void is_refused(mxg_context_desc desc, const char *reason)
{
    char told[512];
    size_t size = mxg_context_desc_error(&desc, told, sizeof told);
    REQUIRE_EQ(size, strlen(told));
    REQUIRE_EQ(size > 0, *reason != 0);
    if (!REQUIRE(strncmp(told, reason, strlen(reason)) == 0))
        printf("    %s\n", told);
}

static bool build_nothing(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data, (void)build, (void)results;
    return false;
}

/* Reasons of the other members. */
static void test_reasons(void)
{
    const mxg_node_code empty = {.size = sizeof empty, .name = "ND_x"},
                        lost = {.size = sizeof lost,
                                .name = "ND_x",
                                .target = "vulcan",
                                .build = build_nothing};
    const mxg_node_code *const none[] = {&empty}, *const far[] = {&lost}, *const null[] = {NULL};
    const mxg_resolver half = {0};
    const mxg_context_desc good = MXG_CONTEXT_DESC_INIT;
    mxg_context_desc desc = {0};
    is_refused(desc, "the size is not set; begin with MXG_CONTEXT_DESC_INIT");
    is_refused(desc = good, "");
    desc.warnings = "error, no-such-id,error";
    is_refused(desc, "warnings has the unknown word 'no-such-id'; expected error, error=ID");
    desc = good, desc.resolver = &half;
    is_refused(desc, "the resolver needs both open and release");
    desc = good, desc.num_include_roots = 1;
    is_refused(desc, "include_roots does not have num_include_roots items");
    desc = good, desc.num_source_paths = 1;
    is_refused(desc, "source_paths does not have num_source_paths items");
    desc = good, desc.num_node_codes = 1;
    is_refused(desc, "node_codes does not have num_node_codes items");
    desc.node_codes = null;
    is_refused(desc, "node_codes[0] is NULL, or its size is not set");
    desc.node_codes = none;
    is_refused(desc, "the code for 'ND_x' needs one of build and instead");
    desc.node_codes = far;
    is_refused(desc, "the code for 'ND_x' is for the unknown target 'vulcan'; expected a name");
    REQUIRE_EQ(mxg_context_desc_error(NULL, NULL, 0), 0);
}

static void test_mistakes(void)
{
    static const char *const unknown_key[] = {"colour", "red"},
                             *const bad_value[] = {"interface", "half"},
                             *const no_value[] = {"interface", NULL},
                             *const not_here[] = {"osl-network", "true"};
    static const char *const reasons[] = {
        "dialects[0] is NULL, or has no size, name or base",
        "dialect '' needs a name that no target has",
        "dialect 'genglsl' needs a name that no target has",
        "dialects[0] is NULL, or has no size, name or base",
        "dialect 'mygl' has the unknown base 'gl'",
        "dialect 'mygl': its base has no version '12'",
        "dialect 'mygl', option 'colour': unknown option 'colour'",
        "dialect 'mygl', option 'interface': 'half' is not a value of option",
        "dialect 'mygl': a key or a value of option 0 is NULL; num_options is the number of pairs",
        "dialect 'mygl', option 'osl-network': its base has no such option",
        "dialect 'mygl' has num_options, but no options"};
    const mxg_dialect good = dialect();
    mxg_dialect wrong[11];
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i)
        wrong[i] = dialect();
    wrong[0].name = NULL;
    wrong[1].name = "";
    wrong[2].name = "genglsl";
    wrong[3].base = NULL;
    wrong[4].base = "gl";
    wrong[5].version = "12";
    wrong[6].options = unknown_key, wrong[6].num_options = 1;
    wrong[7].options = bad_value, wrong[7].num_options = 1;
    wrong[8].options = no_value, wrong[8].num_options = 1;
    wrong[9].options = not_here, wrong[9].num_options = 1;
    wrong[10].options = NULL;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        const mxg_dialect *const list[] = {&wrong[i]};
        mxg_context *context = NULL;
        if (!REQUIRE_EQ(create(list, 1, &context), MXG_ERROR_ARGUMENT))
            printf("    mistake %zu\n", i);
        REQUIRE(!context);
        is_refused(
            (mxg_context_desc){sizeof(mxg_context_desc), .dialects = list, .num_dialects = 1},
            reasons[i]);
    }
    const mxg_dialect *const twice[] = {&good, &good}, *const nothing[] = {NULL};
    mxg_context *context = NULL;
    REQUIRE_EQ(create(twice, 2, &context), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(create(nothing, 1, &context), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(create(NULL, 1, &context), MXG_ERROR_ARGUMENT);
}

int main(void)
{
    test_use();
    test_unknown();
    test_mistakes();
    test_reasons();
    return test_report("api-dialect");
}
