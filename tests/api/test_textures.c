// SPDX-License-Identifier: Apache-2.0
/*
 * Files that nodes name: what hosts are told of textures, their tiles, layers and frames;
 * photometric profiles.
 */
#include "tests/api/fixture.h"

/* Names in the folder "maps/" of the files' place, in no order. */
static const char folder[] =
    "wall.1013.png\0wall.1001.png\0wall.101.png\0wall.1002.png\0wall.1002.jpg\0notes\0"
    "sea.u2_v1.0003.exr\0sea.u1_v1.0003.exr\0sea.u1_v1.0004.exr\0wall.1002.png~\0wall.10011.png";

static size_t list_maps(void *user_data, const char *from, const char *name, char *names,
                        size_t capacity)
{
    (void)user_data;
    if (strcmp(from, "test.mtlx") != 0 || strcmp(name, "maps/") != 0)
        return 0;
    if (capacity >= sizeof folder)
        memcpy(names, folder, sizeof folder);
    return sizeof folder;
}

static const struct memory_file files[] = {
    {"loop.glsl", "uniform float u_time;\n"
                  "float sum(sampler2D f) { float s = 0.0; for (float i = 0.0; i < u_time; ++i) s "
                  "+= texture(f, vec2(i)).r; return s; }"},
    /* At 0, 45 and 90 degrees from the axis 2, 1 and, in the mean around it, 0.75 candela */
    {"lamp.ies", "IESNA:LM-63-2002\r\n[TEST] none\r\nTILT=NONE\r\n1 1000 0.5 3 3 1 2 0 0 0\r\n1 1 "
                 "100\r\n0 45 90\r\n0, 90, 180\r\n"
                 "4 2 1\r\n4 2 2\r\n4 2 1\r\n"},
    {"tilted.ies", "TILT=INCLUDE\n1 2 0 90 1 1\n1 1000 1 2 1 1 2 0 0 0\n1 1 100\n0 90 0 1 1"},
    {"type_b.ies", "TILT=NONE\n1 1000 1 2 1 2 2 0 0 0\n1 1 100\n0 90 0 1 1"},
    {"short.ies", "TILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 100\n0 90 0 1"},
    {"dark.ies", "TILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 100\n0 90 0 0 0"},
    {"mixed_up.ies", "TILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 100\n90 0 0 1 1"},
    {"many.ies", "TILT=NONE\n1 1000 1 1e9 1 1 2 0 0 0\n1 1 100\n"},
    {"infinite.ies", "TILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 100\n0 90 0 1 1e40"},
    {"other.ies", "not a profile"},
    {NULL, NULL},
};

/* The file whose texels the compiler asked for. */
struct asked {
    unsigned count;
    bool is_right; /* each time */
};

static bool read_texels(void *user_data, const char *from, const char *file, const char *layer,
                        uint32_t size, float *out_texels)
{
    struct asked *asked = user_data;
    asked->count++;
    asked->is_right &= strcmp(from, "test.mtlx") == 0 && strcmp(file, "maps/mask.exr") == 0
                       && strcmp(layer, "rust") == 0 && size > 0;
    for (size_t i = 0; i < (size_t)size * size * 4; i++)
        out_texels[i] = 1.0f;
    return true;
}

struct shot {
    struct asked asked;
    struct memory_files files;
    mxg_context *context;
    mxg_library *library;
    mxg_document *document;
    mxg_result *result;
};

/* Generates the only output of a document with `body`; with `option` set to `value`. */
static void shoot(struct shot *shot, const char *body, bool lists, const char *option,
                  const char *value, mxg_status expected)
{
    static const char head[] = "<materialx version=\"1.39\" fileprefix=\"maps/\">",
                      tail[] = "</materialx>";
    static char text[4096];
    snprintf(text, sizeof text, "%s%s%s", head, body, tail);
    *shot = (struct shot){.asked.is_right = true, .files = {.files = files}};
    mxg_resolver resolver = memory_resolver(&shot->files);
    resolver.list_folder = lists ? list_maps : NULL;
    mxg_context_desc context = MXG_CONTEXT_DESC_INIT;
    context.resolver = &resolver;
    const mxg_texel_reader reader = {&shot->asked, read_texels};
    context.texels = &reader;
    REQUIRE_EQ(mxg_context_create(&context, &shot->context), MXG_OK);
    shot->library = mxg_library_builtin(shot->context);
    REQUIRE_EQ(mxg_document_parse(shot->context, shot->library, "test.mtlx", text, strlen(text),
                                  &shot->document),
               MXG_OK);
    mxg_options *options = NULL;
    REQUIRE_EQ(mxg_options_create(shot->context, &options), MXG_OK);
    REQUIRE(!option || mxg_options_set(options, option, value) == MXG_OK);
    mxg_generate_desc desc = {sizeof desc, "glsl", NULL, options};
    REQUIRE_EQ(mxg_generate(shot->context, shot->document, &desc, &shot->result), expected);
    mxg_options_destroy(options);
}

static void finish(struct shot *shot)
{
    mxg_result_destroy(shot->result);
    mxg_document_destroy(shot->document);
    mxg_library_unref(shot->library);
    mxg_context_destroy(shot->context);
}

static uint32_t find(const struct shot *shot, const char *path, mxg_variable *out)
{
    uint32_t index = UINT32_MAX;
    *out = (mxg_variable){sizeof *out};
    REQUIRE((index = mxg_result_find_variable(shot->result, path)) != MXG_NONE);
    REQUIRE_EQ(mxg_result_variable(shot->result, index, out), MXG_OK);
    return index;
}

static unsigned count_diagnostics(const struct shot *shot, const char *id)
{
    const mxg_diagnostics *list = mxg_result_diagnostics(shot->result);
    unsigned count = 0;
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); i++) {
        mxg_diagnostic diagnostic = {sizeof diagnostic};
        mxg_diagnostics_item(list, i, &diagnostic);
        count += strcmp(diagnostic.id, id) == 0;
    }
    return count;
}

#define IMAGE(file, more) \
    "<image name=\"i\" type=\"color3\"><input name=\"file\" type=\"filename\" value=\"" file \
    "\"/>" more "</image>" \
    "<output name=\"o\" type=\"color3\" nodename=\"i\"/>"

static void require_tile(const struct shot *shot, uint32_t variable, uint32_t index,
                         const char *file, int32_t u, int32_t v)
{
    mxg_tile tile = {sizeof tile};
    REQUIRE_EQ(mxg_result_tile(shot->result, variable, index, &tile), MXG_OK);
    REQUIRE_STR(tile.file, file);
    REQUIRE_EQ(tile.u, u);
    REQUIRE_EQ(tile.v, v);
}

static void test_tiles_of_folder(void)
{
    struct shot shot;
    mxg_variable file;
    shoot(&shot, IMAGE("wall.&lt;UDIM&gt;.png", ""), true, NULL, NULL, MXG_OK);
    uint32_t index = find(&shot, "i/file", &file);
    REQUIRE_STR(file.type, "sampler2DArray");
    REQUIRE_STR(file.file, "maps/wall.<UDIM>.png");
    REQUIRE_STR(file.uaddressmode, "clamp");
    REQUIRE_EQ(file.num_tiles, 3);
    require_tile(&shot, index, 0, "maps/wall.1001.png", 0, 0);
    require_tile(&shot, index, 1, "maps/wall.1002.png", 1, 0);
    require_tile(&shot, index, 2, "maps/wall.1013.png", 2, 1);
    mxg_tile tile = {sizeof tile};
    REQUIRE_EQ(mxg_result_tile(shot.result, index, 3, &tile), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_result_tile(shot.result, UINT32_MAX, 0, &tile), MXG_ERROR_ARGUMENT);
    finish(&shot);
    shoot(&shot, IMAGE("sea.&lt;UVTILE&gt;.{04frame}.exr", ""), true, NULL, NULL, MXG_OK);
    index = find(&shot, "i/file", &file);
    REQUIRE_EQ(file.num_tiles, 2);
    require_tile(&shot, index, 0, "maps/sea.u1_v1.{04frame}.exr", 0, 0);
    require_tile(&shot, index, 1, "maps/sea.u2_v1.{04frame}.exr", 1, 0);
    finish(&shot);
}

/* Tiles that the document lists need no files. */
static void test_tiles_of_document(void)
{
    struct shot shot;
    mxg_variable file;
    shoot(&shot,
          "<geominfo name=\"a\" geom=\"/a\"><geomprop name=\"udimset\" type=\"stringarray\" "
          "value=\"1011, 1001\"/></geominfo>"
          "<geominfo name=\"b\" geom=\"/b\"><geomprop name=\"udimset\" type=\"stringarray\" "
          "value=\"1001,1002,99\"/></geominfo>" IMAGE("wall.&lt;UDIM&gt;.png", ""),
          false, NULL, NULL, MXG_OK);
    uint32_t index = find(&shot, "i/file", &file);
    REQUIRE_EQ(file.num_tiles, 3);
    require_tile(&shot, index, 2, "maps/wall.1011.png", 0, 1);
    REQUIRE_EQ(count_diagnostics(&shot, "bad-tile"), 1);
    finish(&shot);
}

static void test_no_tiles(void)
{
    static const struct {
        const char *body;
        bool lists;
        const char *option, *value, *warning;
    } cases[] = {
        {IMAGE("none.&lt;UDIM&gt;.png", ""), true, NULL, NULL, "no-tiles"},
        /* the host does not say, so it knows */
        {IMAGE("none.&lt;UDIM&gt;.png", ""), false, NULL, NULL, NULL},
        {IMAGE("wall.&lt;UDIM&gt;.png", ""), true, "tiles", "host", NULL},
        {IMAGE("&lt;UDIM&gt;/wall.png", ""), true, NULL, NULL, "no-tiles"},
        {"<geominfo name=\"a\" geom=\"/a\"><geomprop name=\"uvtileset\" type=\"stringarray\" "
         "value=\"u1_v1,u900_v2\"/></geominfo>" IMAGE("sea.&lt;UVTILE&gt;.exr", ""),
         true, NULL, NULL, "too-many-tiles"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct shot shot;
        mxg_variable file;
        shoot(&shot, cases[i].body, cases[i].lists, cases[i].option, cases[i].value, MXG_OK);
        find(&shot, "i/file", &file);
        REQUIRE_STR(file.type, "sampler2D");
        REQUIRE_EQ(file.num_tiles, 0);
        REQUIRE_EQ(mxg_diagnostics_num_items(mxg_result_diagnostics(shot.result)),
                   cases[i].warning ? 1 : 0);
        REQUIRE(!cases[i].warning || count_diagnostics(&shot, cases[i].warning) == 1);
        finish(&shot);
    }
}

/* A loop cannot be lowered, so that its texture cannot be an array. */
static void test_tiles_in_loop(void)
{
    static const char body[] =
        "<nodedef name=\"ND_s\" node=\"s\"><input name=\"file\" type=\"filename\" "
        "value=\"\"/><output name=\"out\" type=\"float\"/></nodedef>"
        "<implementation name=\"IM_s\" nodedef=\"ND_s\" file=\"loop.glsl\" function=\"sum\"/>"
        "<s name=\"i\" type=\"float\"><input name=\"file\" type=\"filename\" "
        "value=\"wall.&lt;UDIM&gt;.png\"/></s>"
        "<output name=\"o\" type=\"float\" nodename=\"i\"/>";
    struct shot shot;
    shoot(&shot, body, true, NULL, NULL, MXG_ERROR_DOCUMENT);
    REQUIRE_EQ(count_diagnostics(&shot, "tiles-in-loop"), 1);
    finish(&shot);
    shoot(&shot, body, true, "tiles", "host", MXG_OK);
    finish(&shot);
}

/* A blur reads nine tiles, each with a footprint that reaches to the next reading. */
static void test_blurred_tiles(void)
{
    static const char body[] =
        "<image name=\"i\" type=\"color3\"><input name=\"file\" type=\"filename\" "
        "value=\"wall.&lt;UDIM&gt;.png\"/></image>"
        "<blur name=\"b\" type=\"color3\"><input name=\"in\" type=\"color3\" nodename=\"i\"/>"
        "<input name=\"size\" type=\"float\" value=\"0.1\"/></blur><output name=\"o\" "
        "type=\"color3\" nodename=\"b\"/>";
    struct shot shot;
    shoot(&shot, body, true, "interface", "reduced", MXG_OK);
    const char *source = mxg_result_source(shot.result, MXG_STAGE_PIXEL, NULL);
    unsigned readings = 0;
    for (const char *at = source; (at = strstr(at, "textureGrad(")) != NULL; at++)
        readings++;
    REQUIRE_EQ(readings, 9);
    /* what the screen asks for, and the kernel */
    REQUIRE(strstr(source, "dFdx(vd.texcoord_0)") && strstr(source, " + abs("));
    finish(&shot);
}

static const char *file_at(const struct shot *shot, int32_t frame)
{
    static char file[64];
    mxg_variable variable;
    size_t len = mxg_result_texture_file(shot->result, find(shot, "i/file", &variable), 0, frame,
                                         file, sizeof file);
    REQUIRE_EQ(len, strlen(file));
    return file;
}

static void test_frames(void)
{
    static const struct {
        const char *end_action;
        struct {
            int32_t frame;
            const char *file; /* "" where there is none */
        } at[4];
    } cases[] = {
        /* of frames 2 to 4, which frames 7 to 9 show */
        {"constant", {{6, ""}, {7, "maps/a2_02.png"}, {9, "maps/a4_04.png"}, {10, ""}}},
        {"clamp",
         {{-100, "maps/a2_02.png"},
          {8, "maps/a3_03.png"},
          {10, "maps/a4_04.png"},
          {100, "maps/a4_04.png"}}},
        {"periodic",
         {{6, "maps/a4_04.png"},
          {10, "maps/a2_02.png"},
          {5, "maps/a3_03.png"},
          {13, "maps/a2_02.png"}}},
        {"mirror",
         {{6, "maps/a3_03.png"},
          {10, "maps/a3_03.png"},
          {11, "maps/a2_02.png"},
          {12, "maps/a3_03.png"}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char body[512];
        snprintf(body, sizeof body,
                 IMAGE("a{frame}_{02frame}.png",
                       "<input name=\"framerange\" type=\"string\" value=\"2-4\"/>"
                       "<input name=\"frameoffset\" type=\"integer\" value=\"-5\"/>"
                       "<input name=\"frameendaction\" type=\"string\" value=\"%s\"/>"),
                 cases[i].end_action);
        struct shot shot;
        mxg_variable file;
        shoot(&shot, body, false, NULL, NULL, MXG_OK);
        find(&shot, "i/file", &file);
        REQUIRE_STR(file.framerange, "2-4");
        REQUIRE_STR(file.frameendaction, cases[i].end_action);
        REQUIRE_EQ(file.frameoffset, -5);
        for (size_t k = 0; k < 4; k++)
            REQUIRE_STR(file_at(&shot, cases[i].at[k].frame), cases[i].at[k].file);
        finish(&shot);
    }
}

/* Without a range there is no end; other braces are the host's; what does not fit is cut. */
static void test_frame_names(void)
{
    struct shot shot;
    mxg_variable variable;
    char small[8] = "unset";
    shoot(&shot, IMAGE("{shot}_{04frame}_{4frame}{frame", ""), false, NULL, NULL, MXG_OK);
    REQUIRE_STR(file_at(&shot, 12345), "maps/{shot}_12345_{4frame}{frame");
    REQUIRE_STR(file_at(&shot, -7), "maps/{shot}_-007_{4frame}{frame");
    uint32_t index = find(&shot, "i/file", &variable);
    REQUIRE_EQ(mxg_result_texture_file(shot.result, index, 0, 7, small, sizeof small),
               strlen("maps/{shot}_0007_{4frame}{frame"));
    REQUIRE_STR(small, "maps/{s");
    REQUIRE_EQ(mxg_result_texture_file(shot.result, index, 0, 7, NULL, 0),
               strlen("maps/{shot}_0007_{4frame}{frame"));
    REQUIRE_EQ(mxg_result_texture_file(shot.result, UINT32_MAX, 0, 7, small, sizeof small), 0);
    REQUIRE_STR(small, "");
    finish(&shot);
}

/* One file input read in two ways: two samplers. */
static void test_two_ways(void)
{
    static const char body[] =
        "<nodegraph name=\"G\"><input name=\"file\" type=\"filename\" value=\"a.png\"/>"
        "<image name=\"a\" type=\"color3\"><input name=\"file\" type=\"filename\" "
        "interfacename=\"file\"/>"
        "<input name=\"uaddressmode\" type=\"string\" value=\"mirror\"/></image>"
        "<image name=\"b\" type=\"color3\"><input name=\"file\" type=\"filename\" "
        "interfacename=\"file\"/>"
        "<input name=\"layer\" type=\"string\" value=\"diffuse\"/></image>"
        "<image name=\"c\" type=\"color3\"><input name=\"file\" type=\"filename\" "
        "interfacename=\"file\"/>"
        "<input name=\"uaddressmode\" type=\"string\" value=\"mirror\"/><input name=\"texcoord\" "
        "type=\"vector2\" nodename=\"p\"/></image>"
        "<position name=\"q\" type=\"vector3\"/><convert name=\"p\" type=\"vector2\"><input "
        "name=\"in\" type=\"vector3\" nodename=\"q\"/></convert>"
        "<add name=\"d\" type=\"color3\"><input name=\"in1\" type=\"color3\" "
        "nodename=\"a\"/><input name=\"in2\" type=\"color3\" nodename=\"b\"/></add>"
        "<add name=\"e\" type=\"color3\"><input name=\"in1\" type=\"color3\" "
        "nodename=\"d\"/><input name=\"in2\" type=\"color3\" nodename=\"c\"/></add>"
        "<output name=\"o\" type=\"color3\" nodename=\"e\"/></nodegraph>";
    struct shot shot;
    unsigned mirrored = 0, layered = 0;
    shoot(&shot, body, false, NULL, NULL, MXG_OK);
    for (uint32_t i = 0; i < mxg_result_num_variables(shot.result); i++) {
        mxg_variable v = {sizeof v};
        REQUIRE_EQ(mxg_result_variable(shot.result, i, &v), MXG_OK);
        if (v.block != MXG_BLOCK_TEXTURES)
            continue;
        REQUIRE_STR(v.path, "G/file");
        mirrored += strcmp(v.uaddressmode, "mirror") == 0 && !*v.layer;
        layered += strcmp(v.uaddressmode, "periodic") == 0 && strcmp(v.layer, "diffuse") == 0;
    }
    REQUIRE_EQ(mirrored, 1);
    REQUIRE_EQ(layered, 1);
    finish(&shot);
}

/* A border of the default's colour: the sampler makes it, or the shader over one that clamps. */
static void test_borders(void)
{
    static const char *const modes[][2] = {
        {"sampler", "constant"}, {"shared", "clamp"}, {"shader", "constant"}};
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        struct shot shot;
        mxg_variable file;
        shoot(&shot,
              IMAGE("a.png", "<input name='uaddressmode' type='string' value='constant'/>"
                             "<input name='vaddressmode' type='string' value='mirror'/>"),
              false, "texture-modes", modes[i][0], MXG_OK);
        find(&shot, "i/file", &file);
        REQUIRE_STR(file.uaddressmode, modes[i][1]);
        REQUIRE_STR(file.vaddressmode, "mirror");
        finish(&shot);
    }
}

#define NAME(type, value) "<input name='" type "' type='string' value='" value "'/>"
#define CONSTANT(value) "<constant name='c' type='string'>" NAME("value", value) "</constant>"
#define READ(name, from) \
    "<image name='" name "' type='color3'><input name='file' type='filename' " from "/></image>"
#define SHOW(from) "<output name='o' type='color3' " from "/>"
#define NAMED(input) \
    "<nodedef name='ND_n' node='named'>" input "<output name='out' type='color3'/></nodedef>" \
    "<nodegraph name='NG_n' nodedef='ND_n'>" READ( \
        "i", "interfacename='name'") "<output name='out' type='color3' nodename='i'/></nodegraph>"

/* A string that is the name of a file (specification, "Inputs"): as it stands, without prefix. */
static void test_strings(void)
{
    static const struct {
        const char *body, *path, *file;
    } cases[] = {
        {SHOW("nodename='i'") CONSTANT("a.png") READ("i", "nodename='c'"), "i/file", "a.png"},
        {SHOW("nodename='i'") CONSTANT(
             "[T].png") "<dot name='d' type='string'><input name='in' type='string' "
                        "nodename='c'/></dot>"
                        "<token name='T' type='string' value='t'/>" READ("i", "nodename='d'"),
         "i/file", "[T].png"},
        {"<nodegraph name='G'>" NAME("name", "b.png") READ("i", "interfacename='name'")
             SHOW("nodename='i'") "</nodegraph>",
         "G/i/file", "b.png"},
        {CONSTANT("c.png") "<nodegraph name='G'><input name='name' type='string' "
                           "nodename='c'/>" READ("i", "interfacename='name'")
                               SHOW("nodename='i'") "</nodegraph>",
         "G/i/file", "c.png"},
        {SHOW("nodename='i'") "<nodegraph name='G'>" CONSTANT(
             "d.png") "<output name='p' type='string' nodename='c'/>"
                      "</nodegraph>" READ("i", "nodegraph='G'"),
         "i/file", "d.png"},
        {SHOW("nodename='i'") "<nodegraph name='G'>" CONSTANT(
             "d.png") "<constant name='n' type='float'/>"
                      "<output name='l' type='float' nodename='n'/>"
                      "<output name='p' type='string' nodename='c'/></nodegraph>" READ(
                          "i", "nodegraph='G'"),
         "i/file", "d.png"},
        {SHOW("nodename='n'") NAMED(NAME("name", "e.png")) "<named name='n' type='color3'/>",
         "NG_n/i/file", "e.png"},
        {SHOW("nodename='n'") NAMED(NAME("name", "e.png")) "<named name='n' type='color3'>" NAME(
             "name", "f.png") "</named>",
         "NG_n/i/file", "f.png"},
        {SHOW("nodename='n'") NAMED("<input name='name' type='filename' value='e.png'/>")
             CONSTANT("g.png") "<named name='n' type='color3'><input name='name' type='filename' "
                               "nodename='c'/></named>",
         "n/name", "g.png"},
        {SHOW("nodename='i'") "<geompropvalueuniform name='p' type='string'>" NAME("geomprop",
                                                                                   "map")
             NAME("default", "h.png") "</geompropvalueuniform>" READ("i", "nodename='p'"),
         "i/file", "h.png"},
        {SHOW("nodename='i'") "<nodedef name='ND_pick' node='pick'><input name='a' type='string' "
                              "value='k.png'/>"
                              "<output name='out' type='string'/></nodedef><implementation "
                              "name='IM_pick' "
                              "nodedef='ND_pick' sourcecode='{{a}}'/><pick name='p' "
                              "type='string'/>" READ("i", "nodename='p'"),
         "i/file", "k.png"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct shot shot;
        mxg_variable v;
        shoot(&shot, cases[i].body, false, NULL, NULL, MXG_OK);
        find(&shot, cases[i].path, &v);
        if (!REQUIRE_STR(v.file, cases[i].file))
            printf("    %s\n", cases[i].body);
        REQUIRE_STR(v.document_type, "filename");
        finish(&shot);
    }
}

/* The text of a string may be an address and a file's name at once. */
static void test_string_of_two_readers(void)
{
    static const char body[] = "<nodegraph name='G'>" NAME("name", "mirror") READ(
        "i", "interfacename='name'") "<image name='j' type='color3'><input name='file' "
                                     "type='filename' interfacename='name'/>"
                                     "<input name='uaddressmode' type='string' "
                                     "interfacename='name'/></image>"
                                     "<add name='s' type='color3'><input name='in1' type='color3' "
                                     "nodename='i'/>"
                                     "<input name='in2' type='color3' nodename='j'/></add>" SHOW(
                                         "nodename='s'") "</nodegraph>";
    struct shot shot;
    mxg_variable v;
    shoot(&shot, body, false, NULL, NULL, MXG_OK);
    find(&shot, "G/i/file", &v);
    REQUIRE_STR(v.file, "mirror");
    REQUIRE_STR(v.uaddressmode, "periodic");
    find(&shot, "G/j/file", &v);
    REQUIRE_STR(v.file, "mirror");
    REQUIRE_STR(v.uaddressmode, "mirror");
    finish(&shot);
}

#define LAMP(file) \
    "<measured_edf name=\"light\" type=\"EDF\"><input name=\"file\" type=\"filename\" " \
    "fileprefix=\"\" value=\"" file "\"/></measured_edf>" \
    "<surface name=\"s\" type=\"surfaceshader\"><input name=\"edf\" type=\"EDF\" " \
    "nodename=\"light\"/></surface>"

/*
 * Intensities relative to the greatest, every two degrees; what stands behind the last angle is not
 * stored.
 */
static void test_profile(void)
{
    struct shot shot;
    mxg_compiled_input file = {sizeof file};
    uint32_t last;
    shoot(&shot, LAMP("lamp.ies"), false, NULL, NULL, MXG_OK);
    REQUIRE_EQ(mxg_diagnostics_num_items(mxg_result_diagnostics(shot.result)), 0);
    const char *table =
        strstr(mxg_result_source(shot.result, MXG_STAGE_PIXEL, NULL), "float[47](1.0, 0.9777");
    /* 90 degrees, and behind */
    REQUIRE(table && strstr(table, ", 0.375") && strstr(table, ", 0.0);"));
    REQUIRE_EQ(mxg_result_num_files(shot.result), 1);
    REQUIRE_STR(mxg_result_file(shot.result, 0), "lamp.ies");
    REQUIRE(!mxg_result_file(shot.result, 1));
    /* the texture is no variable: the shader has its numbers */
    last = mxg_result_num_compiled_inputs(shot.result) - 1;
    REQUIRE_EQ(mxg_result_compiled_input(shot.result, last, &file), MXG_OK);
    REQUIRE_EQ(mxg_result_input_state(shot.result, "light/file"), MXG_INPUT_COMPILED);
    REQUIRE_STR(file.path, "light/file");
    finish(&shot);
    shoot(&shot, LAMP("tilted.ies"), false, NULL, NULL, MXG_OK);
    REQUIRE_EQ(mxg_diagnostics_num_items(mxg_result_diagnostics(shot.result)), 0);
    finish(&shot);
}

static void test_bad_profiles(void)
{
    static const char *const bodies[] = {
        LAMP("type_b.ies"), LAMP("short.ies"), LAMP("dark.ies"),     LAMP("mixed_up.ies"),
        LAMP("many.ies"),   LAMP("other.ies"), LAMP("infinite.ies"), LAMP("missing.ies")};
    for (size_t i = 0; i < sizeof bodies / sizeof *bodies; i++) {
        struct shot shot;
        shoot(&shot, bodies[i], false, NULL, NULL, MXG_OK);
        REQUIRE_EQ(count_diagnostics(&shot, "no-profile"), 1);
        REQUIRE(!strstr(mxg_result_source(shot.result, MXG_STAGE_PIXEL, NULL), "float["));
        finish(&shot);
    }
}

static void test_texels_of_budgets(void)
{
    static const char body[] =
        "<image name=\"mask\" type=\"float\">"
        "<input name=\"file\" type=\"filename\" value=\"mask.exr\"/>"
        "<input name=\"layer\" type=\"string\" value=\"rust\"/></image>"
        "<slab name=\"a\" type=\"BSDF\"/>"
        "<slab name=\"b\" type=\"BSDF\"><input name=\"roughness\" type=\"float\" "
        "value=\"0.2\"/></slab>"
        "<slab_mix name=\"m\" type=\"BSDF\"><input name=\"fg\" type=\"BSDF\" nodename=\"a\"/>"
        "<input name=\"bg\" type=\"BSDF\" nodename=\"b\"/>"
        "<input name=\"mix\" type=\"float\" nodename=\"mask\"/></slab_mix>"
        "<slab_surface name=\"s\" type=\"surfaceshader\">"
        "<input name=\"bsdf\" type=\"BSDF\" nodename=\"m\"/></slab_surface>"
        "<surfacematerial name=\"M\" type=\"material\">"
        "<input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"s\"/></surfacematerial>";
    struct shot shot;
    shoot(&shot, body, false, NULL, NULL, MXG_OK);
    REQUIRE_EQ(shot.asked.count, 0);
    finish(&shot);
    shoot(&shot, body, false, "max-slabs", "1", MXG_OK); /* nobody sees an estimate */
    REQUIRE_EQ(shot.asked.count, 0);
    finish(&shot);
    shoot(&shot, body, false, "max-error", "0.5", MXG_OK);
    REQUIRE_EQ(shot.asked.count, 1);
    REQUIRE(shot.asked.is_right);
    finish(&shot);
}

int main(void)
{
    test_profile();
    test_bad_profiles();
    test_tiles_of_folder();
    test_tiles_of_document();
    test_no_tiles();
    test_tiles_in_loop();
    test_blurred_tiles();
    test_frames();
    test_frame_names();
    test_texels_of_budgets();
    test_two_ways();
    test_borders();
    test_strings();
    test_string_of_two_readers();
    return test_report("api-textures");
}
