// SPDX-License-Identifier: Apache-2.0
/*
 * What changes the structure of an element: one change of a document, of the options or of the
 * library at a time.
 */
#define _POSIX_C_SOURCE 200809L
#include "tests/api/fixture.h"

static const char original[] =
    "<materialx version=\"1.39\">\n"
    "  <nodegraph name=\"G\">\n"
    "    <input name=\"tint\" type=\"color3\" value=\"1, 0.5, 0.25\"/>\n"
    "    <input name=\"steps\" type=\"integer\" value=\"3\"/>\n"
    "    <input name=\"picture\" type=\"filename\" value=\"wood.png\" "
    "colorspace=\"srgb_texture\"/>\n"
    "    <image name=\"wood\" type=\"color3\"><input name=\"file\" type=\"filename\" "
    "interfacename=\"picture\"/>"
    "<input name=\"default\" type=\"color3\" value=\"0, 0, 0\"/><input name=\"uaddressmode\" "
    "type=\"string\" value=\"clamp\"/></image>\n"
    "    <image name=\"bump\" type=\"vector3\"><input name=\"file\" type=\"filename\" "
    "value=\"bump.png\"/></image>\n"
    "    <fractal3d name=\"noise\" type=\"float\"><input name=\"octaves\" type=\"integer\" "
    "interfacename=\"steps\"/>"
    "<input name=\"amplitude\" type=\"float\" value=\"0.5\"/></fractal3d>\n"
    "    <multiply name=\"tinted\" type=\"color3\"><input name=\"in1\" type=\"color3\" "
    "nodename=\"wood\"/>"
    "<input name=\"in2\" type=\"color3\" interfacename=\"tint\"/></multiply>\n"
    "    <multiply name=\"noisy\" type=\"color3\"><input name=\"in1\" type=\"color3\" "
    "nodename=\"tinted\"/>"
    "<input name=\"in2\" type=\"float\" nodename=\"noise\"/></multiply>\n"
    "    <normalmap name=\"turned\" type=\"vector3\"><input name=\"in\" type=\"vector3\" "
    "nodename=\"bump\"/></normalmap>\n"
    "    <separate3 name=\"parts\" type=\"multioutput\"><input name=\"in\" type=\"color3\" "
    "nodename=\"wood\"/></separate3>\n"
    "    <output name=\"color\" type=\"color3\" nodename=\"noisy\"/>\n"
    "    <output name=\"normal\" type=\"vector3\" nodename=\"turned\"/>\n"
    "    <output name=\"rough\" type=\"float\" nodename=\"parts\" output=\"outr\"/>\n"
    "  </nodegraph>\n"
    "  <standard_surface name=\"S\" type=\"surfaceshader\">\n"
    "    <input name=\"base_color\" type=\"color3\" nodegraph=\"G\" output=\"color\"/>\n"
    "    <input name=\"specular_roughness\" type=\"float\" nodegraph=\"G\" output=\"rough\"/>\n"
    "    <input name=\"coat\" type=\"float\" value=\"0.5\"/>\n"
    "    <input name=\"coat_color\" type=\"color3\" value=\"1, 0.9, 0.8\"/>\n"
    "    <input name=\"thin_walled\" type=\"boolean\" value=\"true\"/>\n"
    "    <input name=\"normal\" type=\"vector3\" nodegraph=\"G\" output=\"normal\"/>\n"
    "  </standard_surface>\n"
    "  <surfacematerial name=\"M\" type=\"material\"><input name=\"surfaceshader\" "
    "type=\"surfaceshader\" nodename=\"S\"/></surfacematerial>\n"
    "</materialx>\n";

enum expected { SAME, OTHER, UNTOLD };

static const struct change {
    enum expected expected;
    const char *from, *to; /* everywhere */
} changes[] = {
    /* values of uniforms, and whether they are set */
    {SAME, "\"1, 0.5, 0.25\"", "\"0, 1, 0\""},
    {SAME, "value=\"0.5\"/>\n    <input name=\"coat_color",
     "value=\"0.25\"/>\n    <input name=\"coat_color"},
    {SAME, "type=\"boolean\" value=\"true\"", "type=\"boolean\" value=\"false\""},
    {SAME, "type=\"boolean\" value=\"true\"", "type=\"boolean\" value=\" true \""},
    {OTHER, "type=\"boolean\" value=\"true\"", "type=\"boolean\" value=\"yes\""},
    {SAME, "    <input name=\"coat\" type=\"float\" value=\"0.5\"/>\n", ""},
    {SAME, "  </standard_surface>",
     "<input name=\"metalness\" type=\"float\" value=\"1\"/></standard_surface>"},
    {SAME, "  </standard_surface>",
     "<input name=\"transmission_scatter\" type=\"color3\" value=\"1, 1, 0\" "
     "colorspace=\"lin_rec709\"/></standard_surface>"},
    {OTHER, "  </standard_surface>",
     "<input name=\"transmission_scatter\" type=\"color3\" value=\"1, 1, 0\" "
     "colorspace=\"acescg\"/></standard_surface>"},
    {OTHER, "value=\"1, 0.9, 0.8\"", "value=\"1, 0.9\""},
    {UNTOLD, "name=\"coat\" type=\"float\"", "name=\"coat\""},
    {UNTOLD, "name=\"coat\"", "name=\"coatt\""},
    /* values that are compiled in */
    {OTHER, "<input name=\"steps\" type=\"integer\" value=\"3\"/>",
     "<input name=\"steps\" type=\"integer\" value=\"4\"/>"},
    {OTHER, "name=\"amplitude\" type=\"float\" value=\"0.5\"",
     "name=\"amplitude\" type=\"float\" value=\"0.25\""},
    {OTHER, "\"0, 0, 0\"", "\"1, 0, 0\""},
    {OTHER, "\"0, 0, 0\"", "\"\""},
    {SAME, "\"0, 0, 0\"", "\"0.0,0.0,  0\""},
    {SAME, "<input name=\"default\" type=\"color3\" value=\"0, 0, 0\"/>", ""},
    {SAME, "name=\"amplitude\" type=\"float\" value=\"0.5\"",
     "name=\"amplitude\" type=\"float\" value=\"5e-1\""},
    {SAME, "<input name=\"amplitude\"",
     "<input name=\"lacunarity\" type=\"float\" value=\"2\"/><input name=\"amplitude\""},
    {OTHER, "<input name=\"amplitude\"",
     "<input name=\"lacunarity\" type=\"float\" value=\"3\"/><input name=\"amplitude\""},
    {SAME, "type=\"material\">",
     "type=\"material\"><input name=\"displacementshader\" type=\"displacementshader\" "
     "value=\"\"/>"},
    {OTHER, "\"clamp\"", "\"mirror\""},
    {OTHER, "name=\"amplitude\"", "name=\"diminish\""},
    /* connections and nodes */
    {OTHER, "nodename=\"tinted\"", "nodename=\"wood\""},
    {OTHER, "output=\"outr\"", "output=\"outg\""},
    {OTHER, "  </standard_surface>",
     "<input name=\"coat_normal\" type=\"vector3\" nodegraph=\"G\" "
     "output=\"normal\"/></standard_surface>"},
    {OTHER, "nodegraph=\"G\" output=\"color\"", "value=\"1, 1, 1\""},
    {OTHER, "multiply", "divide"},
    {OTHER, "interfacename=\"tint\"", "value=\"1, 0.5, 0.25\""},
    {UNTOLD, "nodename=\"tinted\"", "nodename=\"nothing\""},
    {UNTOLD, "nodename=\"tinted\"", "nodename=\"noise\""},
    {UNTOLD, "interfacename=\"tint\"", "interfacename=\"nothing\""},
    {UNTOLD, "output=\"rough\"", "output=\"nothing\""},
    /* names, places, and what is said for people */
    {SAME, "\"S\"", "\"Other\""},
    {SAME, "\"G\"", "\"Graph\""},
    {SAME, "\"wood\"", "\"image1\""},
    {SAME, "\"tint\"", "\"colour\""},
    {SAME, "name=\"noisy\" ", "name=\"noisy\" xpos=\"1.5\" ypos=\"2\" "},
    {SAME, "name=\"tint\" ", "name=\"tint\" uiname=\"Tint\" uimin=\"0, 0, 0\" doc=\"its colour\" "},
    {SAME, "<materialx version=\"1.39\">",
     "<materialx version=\"1.38\" colorspace=\"lin_rec709\" doc=\"a wood\">"},
    {SAME, "</materialx>", "<standard_surface name=\"T\" type=\"surfaceshader\"/></materialx>"},
    {SAME, "name=\"noisy\" ", "name=\"noisy\" mood=\"sad\" nodedef=\"ND_multiply_color3FA\" "},
    {OTHER, "name=\"amplitude\" ", "name=\"amplitude\" unit=\"meter\" unittype=\"distance\" "},
    {OTHER, "name=\"amplitude\" ", "name=\"amplitude\" semantic=\"read by nobody yet\" "},
    /* files and colour spaces */
    {SAME, "bump.png", "other.exr"},
    {SAME, "wood.png", "bump.png"},
    {SAME, "<nodegraph name=\"G\">", "<nodegraph name=\"G\" fileprefix=\"maps/\">"},
    {OTHER, "bump.png", ""},
    {OTHER, "bump.png", "bump.{frame}.png"},
    {UNTOLD, "bump.png", "bump.<UDIM>.png"},
    {UNTOLD, "bump.png", "[size]/bump.png"},
    {UNTOLD, "<nodegraph name=\"G\">", "<nodegraph name=\"G\" fileprefix=\"[size]/\">"},
    {OTHER, " colorspace=\"srgb_texture\"", ""},
    {OTHER, "srgb_texture", "acescg"},
    {SAME, "srgb_texture", "sRGB - Texture"},
    {OTHER, "<materialx version=\"1.39\">", "<materialx version=\"1.39\" colorspace=\"acescg\">"},
    /* definitions, and what generation refuses */
    {UNTOLD, "</materialx>",
     "<nodedef name=\"ND_x\" node=\"x\"><output name=\"out\" "
     "type=\"float\"/></nodedef></materialx>"},
    {UNTOLD, "<nodegraph name=\"G\">",
     "<nodegraph name=\"G\" nodedef=\"ND_standard_surface_surfaceshader\">"},
    {UNTOLD, "<normalmap name=\"turned\" type=\"vector3\">",
     "<normalmap name=\"turned\" type=\"vector3\"><token name=\"t\" type=\"string\" value=\"x\"/>"},
};
enum { NUM_CHANGES = sizeof changes / sizeof *changes };

static struct {
    mxg_context *context;
    mxg_library *library;
} all;

/* To be freed. */
static char *replace(const char *text, const char *from, const char *to)
{
    char *out = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&out, &size);
    for (const char *at; (at = strstr(text, from)) != NULL; text = at + strlen(from))
        fprintf(file, "%.*s%s", (int)(at - text), text, to);
    fputs(text, file);
    fclose(file);
    return out;
}

static mxg_document *parse(mxg_library *library, const char *text)
{
    mxg_document *document = NULL;
    mxg_document_parse(all.context, library, "wood.mtlx", text, strlen(text), &document);
    return document;
}

static uint64_t structure_of(const mxg_document *document, const char *target, const char *element,
                             const mxg_options *options)
{
    mxg_generate_desc desc = {sizeof desc, target, element, options, false};
    uint64_t structure = 1;
    REQUIRE_EQ(mxg_document_structure(all.context, document, &desc, &structure), MXG_OK);
    return structure;
}

static uint64_t topology_of(const mxg_document *document, unsigned *out_diagnostics)
{
    mxg_generate_desc desc = {sizeof desc, "glsl", "M", NULL, true};
    mxg_result *result = NULL;
    mxg_shader_info info = {sizeof info};
    mxg_generate(all.context, document, &desc, &result);
    mxg_result_info(result, &info);
    *out_diagnostics = mxg_diagnostics_count(mxg_result_diagnostics(result));
    mxg_result_destroy(result);
    return info.topology;
}

static bool is_expected(enum expected expected, uint64_t structure, uint64_t before)
{
    return expected == UNTOLD ? structure == 0
                              : structure && (structure == before) == (expected == SAME);
}

static void test_change(const struct change *change, const mxg_document *before)
{
    unsigned diagnostics_before, diagnostics;
    char *text = replace(original, change->from, change->to);
    REQUIRE(strcmp(text, original) != 0);
    mxg_document *document = parse(all.library, text);
    uint64_t structure = structure_of(document, "glsl", "M", NULL),
             topology = topology_of(document, &diagnostics);
    bool good =
        REQUIRE(is_expected(change->expected, structure, structure_of(before, "glsl", "M", NULL)));
    if (change->expected == SAME)
        good &= REQUIRE_EQ(topology, topology_of(before, &diagnostics_before))
                && REQUIRE_EQ(diagnostics, diagnostics_before);
    if (!good)
        printf("    '%s' becomes '%s'\n", change->from, change->to);
    mxg_document_destroy(document);
    free(text);
}

static void test_options(const mxg_document *document)
{
    static const char *const settings[][2] = {{"interface", "reduced"},  {"interface", "authored"},
                                              {"environment", "none"},   {"max-lights", "5"},
                                              {"colorspace", "acescg"},  {"lights", "none"},
                                              {"uniform-blocks", "true"}};
    static const char *const untold[][2] = {
        {"uniform", "S/*"}, {"constant", "S/coat"}, {"osl-network", "true"}};
    uint64_t met[16] = {
        structure_of(document, "glsl", NULL, NULL), structure_of(document, "vulkan", NULL, NULL),
        structure_of(document, "glsl", "G/color", NULL), structure_of(document, "glsl", "S", NULL)};
    unsigned num_met = 4;
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        mxg_options *options = NULL;
        mxg_options_create(all.context, &options);
        REQUIRE_EQ(structure_of(document, "glsl", NULL, options), met[0]);
        mxg_options_set(options, settings[i][0], settings[i][1]);
        met[num_met++] = structure_of(document, "glsl", NULL, options);
        mxg_options_destroy(options);
    }
    for (unsigned i = 0; i < num_met; i++)
        for (unsigned k = 0; k < i; k++)
            REQUIRE(met[i] && met[i] != met[k]);
    for (size_t i = 0; i < sizeof untold / sizeof *untold; i++) {
        mxg_options *options = NULL;
        mxg_options_create(all.context, &options);
        mxg_options_set(options, untold[i][0], untold[i][1]);
        REQUIRE_EQ(structure_of(document, "osl", NULL, options), 0);
        mxg_options_destroy(options);
    }
    REQUIRE_EQ(structure_of(document, "glsl", NULL, NULL),
               structure_of(document, "glsl", "M", NULL));
    REQUIRE_EQ(structure_of(document, "nothing", NULL, NULL), 0);
    REQUIRE_EQ(structure_of(document, "glsl", "nothing", NULL), 0);
}

/* With everything compiled in, every value counts; as authored, whether there is one. */
static void test_interfaces(const mxg_document *document)
{
    static const struct {
        const char *interface, *from, *to;
        bool is_same;
    } cases[] = {
        {"reduced", "\"1, 0.5, 0.25\"", "\"0, 1, 0\"", false},
        {"authored", "\"1, 0.5, 0.25\"", "\"0, 1, 0\"", true},
        {"authored", "    <input name=\"coat\" type=\"float\" value=\"0.5\"/>\n", "", false},
        {"reduced", "\"S\"", "\"Other\"", true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mxg_options *options = NULL;
        mxg_options_create(all.context, &options);
        mxg_options_set(options, "interface", cases[i].interface);
        char *text = replace(original, cases[i].from, cases[i].to);
        mxg_document *changed = parse(all.library, text);
        uint64_t before = structure_of(document, "glsl", "M", options),
                 after = structure_of(changed, "glsl", "M", options);
        REQUIRE(before && after && (before == after) == cases[i].is_same);
        mxg_document_destroy(changed);
        mxg_options_destroy(options);
        free(text);
    }
}

/*
 * Two reads of one file are told apart by the uniforms that their defaults are, not by what these
 * are at first.
 */
static void test_defaults(void)
{
    static const char text[] =
        "<materialx version=\"1.39\"><nodegraph name=\"G\"><input name=\"a\" type=\"color3\" "
        "value=\"1, 0, 0\"/>"
        "<input name=\"b\" type=\"color3\" value=\"1, 0, 0\"/><input name=\"file\" "
        "type=\"filename\" value=\"wood.png\"/>"
        "<image name=\"i\" type=\"color3\"><input name=\"file\" type=\"filename\" "
        "interfacename=\"file\"/>"
        "<input name=\"default\" type=\"color3\" interfacename=\"a\"/></image>"
        "<image name=\"k\" type=\"color3\"><input name=\"file\" type=\"filename\" "
        "interfacename=\"file\"/>"
        "<input name=\"default\" type=\"color3\" interfacename=\"b\"/></image>"
        "<add name=\"both\" type=\"color3\"><input name=\"in1\" type=\"color3\" "
        "nodename=\"i\"/><input name=\"in2\" type=\"color3\" nodename=\"k\"/></add>"
        "<output name=\"out\" type=\"color3\" nodename=\"both\"/></nodegraph>"
        "<surface_unlit name=\"S\" type=\"surfaceshader\"><input name=\"emission_color\" "
        "type=\"color3\" nodegraph=\"G\" output=\"out\"/></surface_unlit>"
        "<surfacematerial name=\"M\" type=\"material\"><input name=\"surfaceshader\" "
        "type=\"surfaceshader\" nodename=\"S\"/></surfacematerial></materialx>";
    unsigned diagnostics;
    char *changed = replace(text, "\"b\" type=\"color3\" value=\"1, 0, 0\"",
                            "\"b\" type=\"color3\" value=\"0, 1, 0\"");
    mxg_document *before = parse(all.library, text), *after = parse(all.library, changed);
    REQUIRE(strcmp(text, changed) != 0);
    REQUIRE(structure_of(before, "glsl", "M", NULL)
            && structure_of(before, "glsl", "M", NULL) == structure_of(after, "glsl", "M", NULL));
    REQUIRE_EQ(topology_of(before, &diagnostics), topology_of(after, &diagnostics));
    mxg_document_destroy(before);
    mxg_document_destroy(after);
    free(changed);
}

/* Layers of other files give other numbers, and those of equal files the same. */
static void test_libraries(void)
{
    struct memory_file files[] = {{"a.mtlx", "<materialx version=\"1.39\"/>"}, {NULL, NULL}};
    struct memory_files source = {.files = files};
    mxg_resolver resolver = memory_resolver(&source);
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    mxg_context *before = all.context;
    desc.resolver = &resolver;
    uint64_t met[4] = {0};
    REQUIRE_EQ(mxg_context_create(&desc, &all.context), MXG_OK);
    mxg_library *builtin = mxg_library_builtin(all.context);
    for (unsigned i = 0; i < 4; i++) {
        const char *path = "a.mtlx";
        mxg_library *library = NULL;
        if (i == 2)
            files[0].text = "<materialx version=\"1.39\"><geompropdef name=\"wear\" "
                            "type=\"float\"/></materialx>";
        if (i == 3)
            library = mxg_library_ref(builtin);
        else
            REQUIRE_EQ(mxg_library_load(all.context, builtin, &path, 1, &library), MXG_OK);
        mxg_document *document = parse(library, original);
        met[i] = structure_of(document, "glsl", "M", NULL);
        mxg_document_destroy(document);
        mxg_library_unref(library);
    }
    REQUIRE(met[0] && met[0] == met[1]);
    REQUIRE(met[2] && met[2] != met[1]);
    REQUIRE(met[3] && met[3] != met[2] && met[3] != met[1]);
    mxg_library_unref(builtin);
    mxg_context_destroy(all.context);
    all.context = before;
}

int main(void)
{
    unsigned diagnostics;
    REQUIRE_EQ(mxg_context_create(NULL, &all.context), MXG_OK);
    all.library = mxg_library_builtin(all.context);
    mxg_document *document = parse(all.library, original);
    REQUIRE(topology_of(document, &diagnostics) && diagnostics == 0);
    for (size_t i = 0; i < NUM_CHANGES; i++)
        test_change(&changes[i], document);
    test_options(document);
    test_interfaces(document);
    test_defaults();
    test_libraries();
    mxg_document_destroy(document);
    mxg_library_unref(all.library);
    mxg_context_destroy(all.context);
    return test_report("api-structure");
}
