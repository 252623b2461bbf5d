// SPDX-License-Identifier: Apache-2.0
/*
 * The results of a generation: source with places, reflection, views; and what a path of an element
 * means.
 */
#include "documents.h"

struct bench {
    struct memory_files files;
    mxg_context *context;
    mxg_library *library;
    mxg_document *document;
    mxg_options *options;
};

static void bench_open(struct bench *b, const char *name)
{
    *b = (struct bench){.files = {.files = documents}};
    mxg_resolver resolver = memory_resolver(&b->files);
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.resolver = &resolver;
    REQUIRE_EQ(mxg_context_create(&desc, &b->context), MXG_OK);
    b->library = mxg_library_builtin(b->context);
    REQUIRE_EQ(mxg_document_load(b->context, b->library, name, &b->document), MXG_OK);
    REQUIRE_EQ(mxg_options_create(b->context, &b->options), MXG_OK);
}

static void bench_close(struct bench *b)
{
    mxg_options_destroy(b->options);
    mxg_document_destroy(b->document);
    mxg_library_unref(b->library);
    mxg_context_destroy(b->context);
}

static mxg_result *generate(const struct bench *b, const char *target, const char *element,
                            mxg_status expected)
{
    mxg_generate_desc desc = {sizeof desc, target, element, b->options};
    mxg_result *result = NULL;
    REQUIRE_EQ(mxg_generate(b->context, b->document, &desc, &result), expected);
    return result;
}

/* ---- Source ---- */

static void test_targets(const struct bench *b)
{
    REQUIRE(mxg_catalogue_num_targets() >= 3);
    for (uint32_t i = 0; i < mxg_catalogue_num_targets(); i++) {
        mxg_target target = {sizeof target};
        REQUIRE_EQ(mxg_catalogue_target(i, &target), MXG_OK);
        const char *const names[] = {target.name, target.materialx_name};
        for (int n = 0; n < 2; n++) {
            mxg_result *result = generate(b, names[n], NULL, MXG_OK);
            for (int stage = 0; stage < MXG_NUM_STAGES; stage++) {
                size_t size = 0;
                const char *source = mxg_result_source(result, (mxg_stage)stage, &size);
                /* nothing is displaced */
                bool has_closures =
                         strcmp(target.name, "osl") == 0 || strcmp(target.name, "mdl") == 0,
                     is_optional = has_closures && stage == MXG_STAGE_VERTEX;
                REQUIRE((source != NULL) == (target.stage_suffix[stage] != NULL && !is_optional));
                REQUIRE(!source || strlen(source) == size);
            }
            mxg_result_destroy(result);
        }
    }
    mxg_result *result = generate(b, "cobol", NULL, MXG_ERROR_DOCUMENT);
    REQUIRE(has_diagnostic(mxg_result_diagnostics(result), "unknown-target"));
    mxg_result_destroy(result);
}

/* The line that calls `tint` comes from node "t" of the graph, in line 8 of the document. */
static void test_places(const struct bench *b)
{
    mxg_result *result = generate(b, "glsl", NULL, MXG_OK);
    const char *source = mxg_result_source(result, MXG_STAGE_PIXEL, NULL);
    bool found = false, inside = false;
    uint32_t line = 1;
    for (const char *c = source; *c; line += *c++ == '\n') {
        mxg_place at = {sizeof at};
        if ((c != source && c[-1] != '\n')
            || mxg_result_source_place(result, MXG_STAGE_PIXEL, line, &at) != MXG_OK)
            continue;
        REQUIRE(at.file && at.path && at.line && at.column);
        char node[64];
        size_t len = mxg_result_source_path(result, MXG_STAGE_PIXEL, line, node, sizeof node);
        /* the same, or inside of it */
        REQUIRE(len == strlen(node) && strncmp(node, at.path, strlen(at.path)) == 0);
        inside = inside || strncmp(node, "S/", 2) == 0;
        found = found
                || (strcmp(at.path, "G/t") == 0 && at.line == 8 && at.column == 5
                    && strcmp(at.file, "main.mtlx") == 0);
    }
    REQUIRE(found && inside);
    char cut[2];
    REQUIRE_EQ(mxg_result_source_path(result, MXG_STAGE_PIXEL, 1, cut, sizeof cut), 0);
    mxg_place none = {sizeof none};
    REQUIRE_EQ(mxg_result_source_place(result, MXG_STAGE_PIXEL, 1, &none), MXG_ERROR_ARGUMENT);
    mxg_result_destroy(result);
}

/* ---- Reflection ---- */

static void test_variables(const struct bench *b)
{
    mxg_result *result = generate(b, "vulkan", NULL, MXG_OK);
    uint32_t index = 0;
    REQUIRE((index = mxg_result_find_variable(result, "S/coat")) != MXG_NONE);
    mxg_variable coat = {sizeof coat};
    REQUIRE_EQ(mxg_result_variable(result, index, &coat), MXG_OK);
    REQUIRE_STR(coat.path, "S/coat");
    REQUIRE_STR(coat.type, "float");
    REQUIRE_STR(coat.document_type, "float");
    REQUIRE_STR(coat.uifolder, "Coat");
    REQUIRE(coat.block == MXG_BLOCK_PUBLIC_UNIFORMS && coat.num_values == 1
            && coat.values[0] == 0.5f && coat.byte_size == 4);
    REQUIRE_EQ(coat.stages, 1u << MXG_STAGE_PIXEL);
    REQUIRE((index = mxg_result_find_variable(result, "G/scale")) != MXG_NONE);
    mxg_variable scale = {sizeof scale};
    REQUIRE_EQ(mxg_result_variable(result, index, &scale), MXG_OK);
    REQUIRE_STR(scale.uiname, "Scale");
    REQUIRE((index = mxg_result_find_variable(result, "G/i/file")) != MXG_NONE);
    mxg_variable texture = {sizeof texture};
    REQUIRE_EQ(mxg_result_variable(result, index, &texture), MXG_OK);
    REQUIRE_STR(texture.file, "wood.png");
    REQUIRE_STR(texture.type, "sampler2D");
    REQUIRE_EQ(texture.block, MXG_BLOCK_TEXTURES);
    REQUIRE((index = mxg_result_find_variable(result, "S/base_color")) == MXG_NONE); /* connected */
    REQUIRE(mxg_result_find_variable(result, "S/none") == MXG_NONE
            && mxg_result_find_variable(result, NULL) == MXG_NONE);
    size_t size = 0;
    const char *json = mxg_result_reflection_json(result, &size);
    REQUIRE(json && strlen(json) == size && strstr(json, "\"S/coat\""));
    REQUIRE(mxg_result_reflection_json(result, NULL) == json);
    mxg_shader_info info = {sizeof info};
    REQUIRE_EQ(mxg_result_info(result, &info), MXG_OK);
    REQUIRE_STR(info.path, "M");
    REQUIRE_STR(info.target, "vulkan");
    REQUIRE(info.topology && info.num_closures && info.num_textures >= 1 && info.lit);
    bool has_coating = false;
    for (uint32_t i = 0; i < info.num_closures; i++) {
        char leaf[64];
        size_t len = mxg_result_closure_path(result, i, leaf, sizeof leaf);
        REQUIRE(len > 2 && len == strlen(leaf) && strncmp(leaf, "S/", 2) == 0);
        has_coating = has_coating || strcmp(leaf, "S/coating") == 0;
    }
    REQUIRE(has_coating);
    REQUIRE_EQ(mxg_result_closure_path(result, info.num_closures, NULL, 0), 0);
    REQUIRE_EQ(mxg_result_closure_path(NULL, 0, NULL, 0), 0);
    mxg_result_destroy(result);
}

/* A host makes a user interface of all that the JSON says. */
static void test_user_interface(void)
{
    struct bench b;
    bench_open(&b, "knobs.mtlx");
    mxg_result *result = generate(&b, "glsl", "G", MXG_OK);
    uint32_t index = 0;
    mxg_variable mode = MXG_INIT(mxg_variable), width = MXG_INIT(mxg_variable);
    REQUIRE((index = mxg_result_find_variable(result, "G/mode")) != MXG_NONE);
    REQUIRE_EQ(mxg_result_variable(result, index, &mode), MXG_OK);
    REQUIRE((index = mxg_result_find_variable(result, "G/width")) != MXG_NONE);
    REQUIRE_EQ(mxg_result_variable(result, index, &width), MXG_OK);
    REQUIRE_STR(width.unit, "meter");
    REQUIRE_STR(width.unittype, "distance");
    REQUIRE_STR(width.doc, ""); /* not "Right operand." */
    const struct {
        const char *key, *value;
    } fields[] = {{"name", mode.uiname},       {"folder", mode.uifolder},
                  {"min", mode.uimin},         {"max", mode.uimax},
                  {"softMin", mode.uisoftmin}, {"softMax", mode.uisoftmax},
                  {"step", mode.uistep},       {"doc", mode.doc},
                  {"enum", mode.enum_names},   {"enumValues", mode.enum_values}};
    const char *json = strstr(mxg_result_reflection_json(result, NULL), "\"path\": \"G/mode\"");
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
        char field[64];
        snprintf(field, sizeof field, "\"%s\": \"%s\"", fields[i].key, fields[i].value);
        REQUIRE(json && *fields[i].value && strstr(json, field));
    }
    REQUIRE(mode.advanced && !width.advanced);
    REQUIRE_STR(mode.enum_names, "low,middle,high");
    REQUIRE_STR(mode.uistep, "1");
    unsigned num_flat = 0, num_given = 0;
    for (uint32_t i = 0; i < mxg_result_num_variables(result); i++) {
        mxg_variable variable = MXG_INIT(mxg_variable);
        REQUIRE_EQ(mxg_result_variable(result, i, &variable), MXG_OK);
        num_flat += variable.flat && variable.block == MXG_BLOCK_VERTEX_DATA;
        num_given += strcmp(variable.semantic, "geomprop:id") == 0 && variable.num_values == 1
                     && variable.values[0] == 3.0f;
    }
    REQUIRE_EQ(num_flat, 1); /* an integer */
    /* what it is where the geometry has none: of the attribute, and between the stages */
    REQUIRE_EQ(num_given, 2);
    mxg_result_destroy(result);
    result = generate(&b, "osl", "G", MXG_OK);
    REQUIRE(
        strstr(mxg_result_source(result, MXG_STAGE_PIXEL, NULL), "id = 3 [[ int lockgeom = 0 ]]"));
    mxg_result_destroy(result);
    bench_close(&b);
}

/* How many variables of the host have the semantic, the type and the default. */
static unsigned num_properties(const mxg_result *result, const char *semantic, const char *type,
                               float value)
{
    unsigned num = 0;
    for (uint32_t i = 0; i < mxg_result_num_variables(result); i++) {
        mxg_variable v = MXG_INIT(mxg_variable);
        REQUIRE_EQ(mxg_result_variable(result, i, &v), MXG_OK);
        num += v.block != MXG_BLOCK_VERTEX_DATA && strcmp(v.semantic, semantic) == 0
               && strcmp(v.type, type) == 0 && (v.num_values ? v.values[0] : 0.0f) == value;
    }
    return num;
}

/* Readers of a property: each default that differs has a variable of its own. */
static void test_properties(void)
{
    static const struct {
        const char *semantic, *type;
        float value;
    } wanted[] = {{"geomprop:fade", "float", 0.25f},      {"geomprop:fade", "float", 0.75f},
                  {"geomprop:fade", "vec2", 0.5f},        {"geomprop:fade", "int", 7.0f},
                  {"geomprop_on", "bool", 1.0f},          {"geomprop_on", "bool", 0.0f},
                  {"geomprop:a b", "float", 0.5f},        {"geomprop:bare", "vec2", 0.0f},
                  {"geomprop_picture", "sampler2D", 0.0f}};
    static const char *const texts[] = {
        "int on = 1 [[ int lockgeom = 0 ]]",
        "float fade = 0.25 [[ int lockgeom = 0 ]]",
        "string picture = \"wood.png\" [[ int lockgeom = 0 ]]",
        "    float fade_2 = 0.75;\n    getattribute(\"fade\", fade_2);\n",
        "    float fade_3[2] = {0.5, 1};\n    getattribute(\"fade\", fade_3);\n",
        "    float a_b = 0.5;\n    getattribute(\"a b\", a_b);\n"};
    struct bench b;
    bench_open(&b, "properties.mtlx");
    mxg_result *result = generate(&b, "glsl", "G", MXG_OK);
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
        REQUIRE_EQ(num_properties(result, wanted[i].semantic, wanted[i].type, wanted[i].value), 1);
    REQUIRE(strstr(mxg_result_reflection_json(result, NULL), "\"file\": \"wood.png\""));
    mxg_result_destroy(result);
    result = generate(&b, "osl", "G", MXG_OK);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        REQUIRE(strstr(mxg_result_source(result, MXG_STAGE_PIXEL, NULL), texts[i]));
    mxg_result_destroy(result);
    bench_close(&b);
}

static void test_without_source(struct bench *b)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "glsl";
    desc.element = "M";
    desc.options = b->options;
    mxg_result *whole = NULL, *facts = NULL;
    REQUIRE_EQ(mxg_generate(b->context, b->document, &desc, &whole), MXG_OK);
    desc.without_source = true;
    REQUIRE_EQ(mxg_generate(b->context, b->document, &desc, &facts), MXG_OK);
    REQUIRE(mxg_result_source(whole, MXG_STAGE_PIXEL, NULL)
            && !mxg_result_source(facts, MXG_STAGE_PIXEL, NULL));
    REQUIRE_STR(mxg_result_reflection_json(facts, NULL), mxg_result_reflection_json(whole, NULL));
    REQUIRE_EQ(mxg_diagnostics_num_items(mxg_result_diagnostics(facts)),
               mxg_diagnostics_num_items(mxg_result_diagnostics(whole)));
    REQUIRE_EQ(mxg_result_source_path(facts, MXG_STAGE_PIXEL, 1, NULL, 0), 0);
    mxg_place none = {sizeof none};
    REQUIRE_EQ(mxg_result_source_place(facts, MXG_STAGE_PIXEL, 1, &none), MXG_ERROR_ARGUMENT);
    mxg_result_destroy(whole);
    mxg_result_destroy(facts);
}

static void test_only_diagnostics(struct bench *b)
{
    static const char *const elements[] = {"M", "nothing"};
    for (int i = 0; i < 2; i++) {
        mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
        desc.target = "glsl";
        desc.element = elements[i];
        mxg_result *whole = NULL, *told = NULL;
        mxg_shader_info info = {sizeof info};
        mxg_status status = mxg_generate(b->context, b->document, &desc, &whole);
        desc.only_diagnostics = true;
        REQUIRE_EQ(mxg_generate(b->context, b->document, &desc, &told), status);
        REQUIRE_EQ(status, i ? MXG_ERROR_DOCUMENT : MXG_OK);
        REQUIRE_EQ(mxg_diagnostics_num_items(mxg_result_diagnostics(told)),
                   mxg_diagnostics_num_items(mxg_result_diagnostics(whole)));
        REQUIRE_EQ(mxg_result_num_files(told), mxg_result_num_files(whole));
        REQUIRE(!mxg_result_source(told, MXG_STAGE_PIXEL, NULL)
                && !mxg_result_reflection_json(told, NULL));
        REQUIRE_EQ(mxg_result_num_variables(told), 0);
        REQUIRE_EQ(mxg_result_info(told, &info), MXG_ERROR_ARGUMENT);
        mxg_result_destroy(whole);
        mxg_result_destroy(told);
    }
}

static void test_interfaces(struct bench *b)
{
    mxg_options_set(b->options, "interface", "reduced");
    mxg_result *result = generate(b, "glsl", NULL, MXG_OK);
    REQUIRE(mxg_result_find_variable(result, "S/coat") == MXG_NONE);
    bool found = false;
    for (uint32_t i = 0; i < mxg_result_num_compiled_inputs(result); i++) {
        mxg_compiled_input input = {sizeof input};
        REQUIRE_EQ(mxg_result_compiled_input(result, i, &input), MXG_OK);
        found = found
                || (strcmp(input.path, "S/coat") == 0 && strcmp(input.value, "0.5") == 0
                    && strcmp(input.type, "float") == 0);
    }
    REQUIRE(found);
    mxg_result_destroy(result);
    mxg_options_set(b->options, "uniform", "S/c*t");
    result = generate(b, "glsl", NULL, MXG_OK);
    REQUIRE(mxg_result_find_variable(result, "S/coat") != MXG_NONE
            && mxg_result_find_variable(result, "S/base") == MXG_NONE);
    REQUIRE_EQ(mxg_diagnostics_num_items(mxg_result_diagnostics(result)), 0);
    mxg_result_destroy(result);
}

static void test_globs(struct bench *b)
{
    static const struct {
        const char *glob;
        bool matches;
    } globs[] = {
        {"**", true},           {"S/coat", true},    {"G/*", true},     {"*/sp*roughness", true},
        {"**/i/f*e", true},     {"?/coat", true},    {"G/i/*", true},   {"coat", false},
        {"S/*/coat", false},    {"*coat", false},    {"S?coat", false}, {"s/coat", false},
        {"**/i/*/file", false}, {"S/coat*x", false}, {"S/", false}};
    for (size_t i = 0; i < sizeof globs / sizeof *globs; i++) {
        mxg_options *options = NULL;
        mxg_options_create(b->context, &options);
        mxg_options_set(options, "constant", globs[i].glob);
        mxg_generate_desc desc = {sizeof desc, "glsl", NULL, options};
        mxg_result *result = NULL;
        REQUIRE_EQ(mxg_generate(b->context, b->document, &desc, &result), MXG_OK);
        if (!REQUIRE_EQ(has_diagnostic(mxg_result_diagnostics(result), "glob-no-match"),
                        !globs[i].matches))
            puts(globs[i].glob);
        mxg_result_destroy(result);
        mxg_options_destroy(options);
    }
}

/* ---- Views ---- */

static void test_views(const struct bench *b)
{
    static const char *const words[] = {[MXG_VIEW_ELEMENTS] = "[renderable]",
                                        [MXG_VIEW_GRAPH] = "G/t",
                                        [MXG_VIEW_DOT] = "digraph",
                                        [MXG_VIEW_IR] = "%",
                                        [MXG_VIEW_CLOSURES] = "mx_",
                                        [MXG_VIEW_STATISTICS] = "closures",
                                        [MXG_VIEW_SLABS] = "a body, as slabs",
                                        [MXG_VIEW_SLABS_JSON] = "\"recognised\": true"};
    mxg_generate_desc desc = {sizeof desc, "glsl", NULL, NULL};
    for (int view = 0; view <= MXG_VIEW_SLABS_JSON; view++) {
        mxg_result *result = NULL;
        size_t size = 0;
        REQUIRE_EQ(mxg_inspect(b->context, b->document, (mxg_view)view, &desc, &result), MXG_OK);
        const char *text = mxg_result_text(result, &size);
        REQUIRE(text && strlen(text) == size && strstr(text, words[view]));
        REQUIRE(!mxg_result_source(result, MXG_STAGE_PIXEL, NULL) || view == MXG_VIEW_STATISTICS);
        mxg_result_destroy(result);
    }
}

/* ---- Elements ---- */

static void test_elements(void)
{
    static const struct {
        const char *path, *fault; /* an id, or NULL */
        const char *meant;        /* the path of what was generated */
    } cases[] = {
        {NULL, NULL, "M"},
        {"M", NULL, "M"},
        {"L", NULL, "M"},
        {"day", NULL, "M"},
        {"all", NULL, "M"},
        {"night", "not-renderable", NULL}, /* it names itself, and a look without a material */
        {"S", NULL, "S"},
        {"S/out", NULL, "S/out"},
        {"one", NULL, "one/out"},
        {"one/use", NULL, "one/use"},
        {"two/y", NULL, "two/y"},
        {"two/parts/outg", NULL, "two/parts/outg"},
        {"said/outg", NULL, "said/outg"},
        {"said/outb", NULL, "said/outb"},
        {"NG_a", NULL, "NG_a/out"}, /* a definition's own graph: with its defaults */
        {"NG_a/sum", NULL, "NG_a/sum"},
        {"NG_b/out", NULL, "NG_b/out"},
        {"two", "ambiguous-output", NULL},
        {"two/parts", "ambiguous-output", NULL},
        {"said", "ambiguous-output", NULL},
        {"two/parts/out", "dangling-output", NULL},
        {"two/parts/nowhere", "unknown-element", NULL},
        {"ND_a", "not-renderable", NULL},
        {"two/parts/in", "not-renderable", NULL},
        {"nothing", "unknown-element", NULL},
        {"", "unknown-element", NULL},
        {"/", "unknown-element", NULL},
    };
    struct bench b;
    bench_open(&b, "elements.mtlx");
    REQUIRE_EQ(mxg_document_num_renderables(b.document), 1); /* M */
    REQUIRE(mxg_document_has_assignment(b.document, "L", 0));
    REQUIRE(mxg_document_has_assignment(b.document, "all", 0));
    REQUIRE(!mxg_document_has_assignment(b.document, "night", 0));
    REQUIRE(!mxg_document_has_assignment(b.document, "L", 1));
    REQUIRE(!mxg_document_has_assignment(b.document, "M", 0));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mxg_result *result =
            generate(&b, "glsl", cases[i].path, cases[i].fault ? MXG_ERROR_DOCUMENT : MXG_OK);
        mxg_shader_info info = {sizeof info};
        bool good = cases[i].fault ? has_diagnostic(mxg_result_diagnostics(result), cases[i].fault)
                                   : mxg_result_info(result, &info) == MXG_OK
                                         && strcmp(info.path, cases[i].meant) == 0;
        if (!REQUIRE(good))
            printf("    %s\n", cases[i].path ? cases[i].path : "(null)");
        mxg_result_destroy(result);
    }
    bench_close(&b);
    bench_open(&b, "empty.mtlx");
    mxg_result *result = generate(&b, "glsl", NULL, MXG_ERROR_DOCUMENT);
    REQUIRE(has_diagnostic(mxg_result_diagnostics(result), "nothing-to-render"));
    mxg_result_destroy(result);
    bench_close(&b);
}

/* ---- Tokens in names of files ---- */

static bool has_file(const mxg_result *result, const char *name)
{
    for (uint32_t i = 0; i < mxg_result_num_variables(result); i++) {
        mxg_variable variable = {sizeof variable};
        if (mxg_result_variable(result, i, &variable) == MXG_OK && strcmp(variable.file, name) == 0)
            return true;
    }
    return false;
}

/* Uses of one definition with different tokens are not the same, though their arguments are. */
static void test_tokens(void)
{
    static const char *const names[] = {
        "maps/inner_default.png", "maps/default_7_<UDIM>.png", "maps/inner_set.png",
        "maps/set_7_<UDIM>.png", "maps/inner_oak.png", "maps/oak_7_<UDIM>.png",
        /* defaults of the definition */
        "maps/mask_default.png", "maps/mask_set.png", "maps/mask_oak.png"};
    struct bench b;
    bench_open(&b, "tokens.mtlx");
    mxg_result *result = generate(&b, "glsl", "G", MXG_OK);
    REQUIRE_EQ(mxg_diagnostics_num_items(mxg_result_diagnostics(result)), 0);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        REQUIRE(has_file(result, names[i]));
    mxg_result_destroy(result);
    result = generate(&b, "glsl", "NG_outer", MXG_OK);
    REQUIRE(has_file(result, names[0]) && has_file(result, names[1]));
    REQUIRE(has_file(result, "maps/mask_default.png"));
    mxg_result_destroy(result);
    bench_close(&b);
}

/* A result outlives the caller's other references, but for the context. */
static void test_lifetimes(void)
{
    struct bench b;
    bench_open(&b, "main.mtlx");
    mxg_result *result = generate(&b, "glsl", NULL, MXG_OK);
    mxg_options_destroy(b.options);
    mxg_document_destroy(b.document);
    mxg_library_unref(b.library);
    REQUIRE(strstr(mxg_result_source(result, MXG_STAGE_PIXEL, NULL), "void main()"));
    REQUIRE(strstr(mxg_result_reflection_json(result, NULL), "wood.png"));
    mxg_result_destroy(result);
    mxg_context_destroy(b.context);
}

/* ---- Networks ---- */

static bool has_part(const mxg_result *result, const char *name, const char *nodedef)
{
    for (uint32_t i = 0; i < mxg_result_num_parts(result); i++) {
        mxg_part part = {sizeof part};
        REQUIRE_EQ(mxg_result_part(result, i, &part), MXG_OK);
        REQUIRE_EQ(strlen(part.source), part.source_size);
        if (strcmp(part.name, name) == 0)
            return strcmp(part.nodedef, nodedef) == 0 && strstr(part.source, name);
    }
    return false;
}

/* A shader for each node that does something, and the list of them in the place of the shader. */
static void test_network(void)
{
    struct bench b;
    bench_open(&b, "network.mtlx");
    mxg_result *whole = generate(&b, "osl", "M", MXG_OK);
    REQUIRE_EQ(mxg_result_num_parts(whole), 0);
    REQUIRE_EQ(mxg_options_set(b.options, "osl-network", "true"), MXG_OK);
    mxg_result *result = generate(&b, "osl", "M", MXG_OK);
    REQUIRE(has_part(result, "ND_noise2d_float", "ND_noise2d_float"));
    REQUIRE(has_part(result, "ND_oren_nayar_diffuse_bsdf", "ND_oren_nayar_diffuse_bsdf"));
    REQUIRE(has_part(result, "mx_surface_root", ""));
    REQUIRE(!has_part(result, "ND_multiply_float", "ND_multiply_float")); /* by 1 */
    const char *list = mxg_result_source(result, MXG_STAGE_PIXEL, NULL);
    REQUIRE(strstr(list, "param float amplitude 0.25 ;\nshader ND_noise2d_float n ;\n"));
    REQUIRE(strstr(list, "connect n.out b.roughness ;\n"));
    REQUIRE(!mxg_result_source(result, MXG_STAGE_VERTEX, NULL));
    REQUIRE(strstr(mxg_result_reflection_json(result, NULL), "\"shader\": \"ND_noise2d_float\""));
    mxg_part part = {sizeof part};
    REQUIRE_EQ(mxg_result_part(result, mxg_result_num_parts(result), &part), MXG_ERROR_ARGUMENT);
    mxg_shader_info info = {sizeof info}, whole_info = {sizeof whole_info};
    REQUIRE(mxg_result_info(result, &info) == MXG_OK
            && mxg_result_info(whole, &whole_info) == MXG_OK);
    REQUIRE(info.topology != whole_info.topology);
    mxg_result_destroy(result);
    mxg_result_destroy(whole);
    result = generate(&b, "glsl", "M", MXG_OK); /* a target without networks ignores the option */
    REQUIRE_EQ(mxg_result_num_parts(result), 0);
    mxg_result_destroy(result);
    bench_close(&b);
}

static bool applies(const char *key, const char *target)
{
    mxg_option option = {sizeof option};
    for (uint32_t i = 0; mxg_catalogue_option(i, &option) == MXG_OK; i++)
        if (strcmp(option.key, key) == 0)
            return mxg_catalogue_has_option(i, target);
    return false;
}

static void test_options_of_targets(void)
{
    REQUIRE(applies("interface", "glsl") && applies("interface", "osl"));
    REQUIRE(applies("lights", "hlsl") && !applies("lights", "osl"));
    REQUIRE(applies("metadata", "osl") && !applies("metadata", "essl"));
    REQUIRE(applies("osl-network", "osl") && !applies("osl-network", "vulkan"));
    REQUIRE(applies("uniform-blocks", "glsl") && !applies("uniform-blocks", "hlsl"));
    REQUIRE(applies("hlsl-vulkan-bindings", "hlsl") && !applies("hlsl-vulkan-bindings", "glsl"));
    REQUIRE(applies("texture-modes", "essl310") && !applies("texture-modes", "osl"));
    REQUIRE(!applies("interface", "cobol"));
    REQUIRE(!mxg_catalogue_has_option(mxg_catalogue_num_options(), "glsl")
            && !mxg_catalogue_has_option(0, NULL));
}

/* A pass that lights has no shader where only diagnostics are wanted, in each way of writing it. */
static void test_pass_without_shader(const struct bench *b, mxg_generate_desc desc)
{
    static const char *const languages[] = {"vulkan", "hlsl"};
    uint32_t index = 0;
    while (strcmp(mxg_catalogue_pass(index), "light_simple") != 0)
        index++;
    desc.only_diagnostics = true;
    for (size_t i = 0; i < sizeof languages / sizeof *languages; i++) {
        mxg_result *result;
        desc.target = languages[i];
        REQUIRE_EQ(mxg_generate_pass(b->context, index, &desc, &result), MXG_OK);
        REQUIRE(!mxg_result_source(result, MXG_STAGE_PIXEL, NULL));
        mxg_result_destroy(result);
    }
}

/*
 * A pass that the options do not ask for has no source. A surface is no pass. The pass "read" has
 * functions for passes of the host.
 */
static void test_passes(const struct bench *b)
{
    mxg_generate_desc desc = {.size = sizeof desc, .target = "vulkan"};
    unsigned num_left_out = 0;
    for (uint32_t i = 0; i < mxg_catalogue_num_passes(); i++) {
        mxg_result *result;
        mxg_pass pass = {sizeof pass};
        REQUIRE_EQ(mxg_generate_pass(b->context, i, &desc, &result), MXG_OK);
        bool has_source = mxg_result_source(result, MXG_STAGE_PIXEL, NULL);
        num_left_out += !has_source;
        REQUIRE_EQ(mxg_result_reflection_json(result, NULL) != NULL, has_source);
        REQUIRE_EQ(mxg_result_pass(result, &pass), has_source ? MXG_OK : MXG_ERROR_ARGUMENT);
        bool is_part = strcmp(mxg_catalogue_pass(i), "read") == 0;
        REQUIRE(
            !has_source
            || (pass.reads && !pass.writes == is_part && pass.group_size[0] == (is_part ? 0 : 8)));
        mxg_result_destroy(result);
    }
    REQUIRE_EQ(num_left_out, 2);
    mxg_pass_member member = {sizeof member};
    REQUIRE_EQ(mxg_catalogue_pass_member(0, 0, &member), MXG_ERROR_ARGUMENT); /* an image */
    REQUIRE_EQ(mxg_catalogue_pass_member(mxg_catalogue_num_pass_resources(), 0, &member),
               MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_result_pass(NULL, NULL), MXG_ERROR_ARGUMENT);
    test_pass_without_shader(b, desc);
    desc.without_source = true;
    REQUIRE_EQ(mxg_generate_pass(b->context, 0, &desc, NULL), MXG_ERROR_ARGUMENT);
}

/* ---- Modules ---- */

static mxg_result *generate_module(const struct bench *b, mxg_generate_desc desc,
                                   mxg_status expected)
{
    mxg_result *result = NULL;
    desc.options = b->options;
    REQUIRE_EQ(mxg_generate_module(b->context, b->library, &desc, &result), expected);
    return result;
}

/* A target without modules, an option without a name, and elements have none. */
static void test_no_module(const struct bench *b)
{
    mxg_generate_desc desc = {.size = sizeof desc, .target = "mdl", .element = "NG"};
    mxg_result *result = generate_module(b, desc, MXG_ERROR_ARGUMENT);
    REQUIRE(!result);
    desc.element = NULL;
    desc.target = "osl";
    mxg_result_destroy(generate_module(b, desc, MXG_ERROR_DOCUMENT));
    desc.target = "mdl";
    desc.only_diagnostics = true;
    result = generate_module(b, desc, MXG_OK);
    REQUIRE(!mxg_result_source(result, MXG_STAGE_PIXEL, NULL));
    mxg_result_destroy(result);
    REQUIRE_EQ(mxg_options_set(b->options, "mdl-module", ""), MXG_OK);
    mxg_result_destroy(generate_module(b, desc, MXG_ERROR_DOCUMENT));
}

static void test_module(const struct bench *b)
{
    mxg_generate_desc desc = {.size = sizeof desc, .target = "mdl"};
    mxg_shader_info info = {sizeof info};
    REQUIRE_EQ(mxg_options_set(b->options, "mdl-module", "studio"), MXG_OK);
    mxg_result *result = generate_module(b, desc, MXG_OK);
    const char *source = mxg_result_source(result, MXG_STAGE_PIXEL, NULL);
    REQUIRE(source && strstr(source, "\nexport float mx_fractal_float("));
    REQUIRE(!mxg_result_source(result, MXG_STAGE_VERTEX, NULL));
    REQUIRE_EQ(mxg_result_info(result, &info), MXG_OK);
    REQUIRE_STR(info.name, "studio");
    mxg_pass pass = {sizeof pass};
    REQUIRE_EQ(mxg_result_pass(result, &pass), MXG_ERROR_ARGUMENT);
    mxg_result_destroy(result);
    test_no_module(b);
}

/* Lobes that reflect nothing have no loops: over samples of the environment, or over lights. */
static void test_idle_lobes(void)
{
    static const struct {
        const char *element;
        bool has_samples, has_lights;
    } surfaces[] = {{"slab_without_interface", false, true},
                    {"matte", false, true},
                    {"nothing", false, false},
                    {"glossy", true, true}};
    struct bench b;
    bench_open(&b, "unlit_lobes.mtlx");
    for (size_t i = 0; i < sizeof surfaces / sizeof *surfaces; i++) {
        mxg_result *result = generate_reduced(b.context, b.document, surfaces[i].element);
        const char *source = mxg_result_source(result, MXG_STAGE_PIXEL, NULL);
        REQUIRE_EQ(strstr(source, "for (int i = 0;") != NULL, surfaces[i].has_samples);
        REQUIRE_EQ(strstr(source, "u_lightData[i]") != NULL, surfaces[i].has_lights);
        mxg_result_destroy(result);
    }
    bench_close(&b);
}

int main(void)
{
    struct bench b;
    bench_open(&b, "main.mtlx");
    test_targets(&b);
    test_places(&b);
    test_variables(&b);
    test_views(&b);
    test_globs(&b);
    test_without_source(&b);
    test_only_diagnostics(&b);
    test_interfaces(&b);
    test_passes(&b);
    test_module(&b);
    bench_close(&b);
    test_elements();
    test_tokens();
    test_user_interface();
    test_properties();
    test_network();
    test_options_of_targets();
    test_lifetimes();
    test_idle_lobes();
    return test_report("api-generation");
}
