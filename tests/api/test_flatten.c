// SPDX-License-Identifier: Apache-2.0
/* mxg_edit_flatten_node: what the document is afterwards, and that it draws the same. */
#include "fixture.h"

#include <mxgen/document.h>
#include <mxgen/reflection.h>

struct fixture {
    mxg_context *context;
    mxg_library *library;
};

static void open_fixture(struct fixture *f, uint32_t max_elements)
{
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.max_elements = max_elements;
    REQUIRE_EQ(mxg_context_create(&desc, &f->context), MXG_OK);
    f->library = mxg_library_builtin(f->context);
}

static void close_fixture(struct fixture *f)
{
    mxg_library_unref(f->library);
    mxg_context_destroy(f->context);
}

#define DOCUMENT(attributes, text) \
    "<?xml version='1.0'?><materialx version='1.39'" attributes ">" text "</materialx>"

static mxg_document *parse(const struct fixture *f, const char *text)
{
    mxg_document *document = NULL;
    REQUIRE_EQ(
        mxg_document_parse(f->context, f->library, "text.mtlx", text, strlen(text), &document),
        MXG_OK);
    return document;
}

/* The document with the nodes of some paths flattened, one after the other. */
static mxg_document *flatten(const struct fixture *f, const mxg_document *from,
                             const char *const *paths)
{
    mxg_edit *edit = NULL;
    mxg_document *document = NULL;
    REQUIRE_EQ(mxg_edit_create(f->context, f->library, from, NULL, &edit), MXG_OK);
    for (; *paths; paths++)
        if (!REQUIRE_EQ(mxg_edit_flatten_node(edit, edited_at(edit, *paths)), MXG_OK))
            printf("    %s\n", *paths);
    REQUIRE_EQ(commit(edit, &document), MXG_OK);
    return document;
}

static void expect_attribute(const mxg_document *document, const char *path, const char *name,
                             const char *wanted)
{
    mxg_element element = element_at(document, path);
    mxg_attribute attribute = MXG_INIT(mxg_attribute);
    uint32_t index = mxg_document_find_attribute(document, element, name);
    bool has = mxg_document_attribute(document, element, index, &attribute) == MXG_OK;
    if (!REQUIRE(element) || !REQUIRE_STR(has ? attribute.value : "", wanted))
        printf("    %s of %s\n", name, path);
}

/* ---- Values ---- */

#define PATTERN \
    "<nodedef name='ND_p' node='pattern'>" \
    "<input name='hue' type='color3' value='0.25, 0.5, 0.75'/>" \
    "<input name='scale' type='float' value='4'/>" \
    "<input name='st' type='vector2' defaultgeomprop='UV0'/>" \
    "<input name='at' type='vector3' defaultgeomprop='Pobject'/>" \
    "<output name='out' type='color3'/></nodedef>" \
    "<nodegraph name='NG_p' nodedef='ND_p'>" \
    "<multiply name='wide' type='vector2'><input name='in1' type='vector2' interfacename='st'/>" \
    "<input name='in2' type='float' interfacename='scale'/></multiply>" \
    "<noise2d name='spots' type='float'>" \
    "<input name='texcoord' type='vector2' nodename='wide'/></noise2d>" \
    "<noise2d name='plain' type='float'>" \
    "<input name='texcoord' type='vector2' interfacename='st'/></noise2d>" \
    "<extract name='x' type='float'><input name='in' type='vector3' " \
    "interfacename='at'/></extract>" \
    "<add name='sum' type='float'><input name='in1' type='float' nodename='spots'/>" \
    "<input name='in2' type='float' nodename='plain'/></add>" \
    "<add name='more' type='float'><input name='in1' type='float' nodename='sum'/>" \
    "<input name='in2' type='float' nodename='x'/></add>" \
    "<multiply name='end' type='color3'><input name='in1' type='color3' interfacename='hue'/>" \
    "<input name='in2' type='float' nodename='more'/></multiply>" \
    "<output name='out' type='color3' nodename='end'/></nodegraph>"
#define SURFACE(inputs) \
    "<standard_surface name='S' type='surfaceshader'>" inputs "</standard_surface>"

static void test_values(struct fixture *f)
{
    mxg_document *before = parse(
        f, DOCUMENT(
               " colorspace='srgb_texture'", PATTERN
               "<constant name='size' type='float'><input name='value' type='float' "
               "value='2'/></constant>"
               "<constant name='P_sum' type='float'/>"
               "<pattern name='P' type='color3'><input name='scale' type='float' nodename='size'/>"
               "<input name='hue' type='color3' value='0.5, 0.1, 0.1' "
               "colorspace='none'/></pattern>" SURFACE(
                   "<input name='base_color' type='color3' nodename='P' output='out'/>"
                   "<input name='emission_color' type='color3' nodename='P'/>")));
    mxg_document *after = flatten(f, before, (const char *const[]){"P", NULL});
    expect_attribute(after, "S/base_color", "nodename", "P");
    expect_attribute(after, "S/base_color", "output", "");
    expect_attribute(after, "P/in1", "value", "0.5, 0.1, 0.1");
    expect_attribute(after, "P/in1", "colorspace", "none");
    expect_attribute(after, "P_wide/in2", "nodename", "size");
    /* what an input has by itself is left out; otherwise a node gives it */
    REQUIRE(!element_at(after, "P_plain/texcoord"));
    expect_attribute(after, "P_wide/in1", "nodename", "P_UV0");
    expect_attribute(after, "P_Pobject/space", "value", "object");
    /* the document has the name already */
    expect_attribute(after, "P_more/in1", "nodename", "P_sum2");
    REQUIRE(draws_the_same(f->context, before, after, "S"));
    mxg_document_destroy(before);
    mxg_document_destroy(after);
}

/* Defaults of a definition mean what they mean in its own file. */
static void test_defaults(struct fixture *f)
{
    mxg_document *before = parse(
        f, DOCUMENT(" colorspace='srgb_texture'", PATTERN
                    "<nodegraph name='G' colorspace='lin_rec709'><pattern name='P' type='color3'/>"
                    "<output name='out' type='color3' nodename='P'/></nodegraph>" SURFACE(
                        "<input name='base_color' type='color3' nodegraph='G'/>")));
    mxg_document *after = flatten(f, before, (const char *const[]){"G/P", NULL});
    expect_attribute(after, "G/P/in1", "value", "0.25, 0.5, 0.75");
    expect_attribute(after, "G/P/in1", "colorspace", "srgb_texture");
    expect_attribute(after, "G/out", "nodename", "P");
    REQUIRE(draws_the_same(f->context, before, after, "S"));
    mxg_document_destroy(before);
    mxg_document_destroy(after);
}

/* ---- Outputs, units, files ---- */

#define SPLIT \
    "<nodedef name='ND_s' node='split'>" \
    "<input name='depth' type='float' value='1' unit='meter' unittype='distance'/>" \
    "<input name='file' type='filename' value='none.png'/>" \
    "<token name='kind' type='string' value='color'/>" \
    "<output name='a' type='color3'/><output name='b' type='float'/>" \
    "<output name='c' type='float'/></nodedef>" \
    "<nodegraph name='NG_s' nodedef='ND_s' fileprefix='there/'>" \
    "<image name='i' type='color3'>" \
    "<input name='file' type='filename' interfacename='file'/></image>" \
    "<image name='own' type='color3'><input name='file' type='filename' " \
    "value='[kind].png'/></image>" \
    "<add name='both' type='color3'><input name='in1' type='color3' nodename='i'/>" \
    "<input name='in2' type='color3' nodename='own'/></add>" \
    "<separate3 name='parts' type='multioutput'>" \
    "<input name='in' type='color3' nodename='both'/></separate3>" \
    "<output name='a' type='color3' nodename='both'/>" \
    "<output name='b' type='float' nodename='parts' output='outg'/>" \
    "<output name='c' type='float' interfacename='depth'/></nodegraph>"

static void test_outputs(struct fixture *f)
{
    mxg_document *before =
        parse(f, DOCUMENT(" fileprefix='here/'", SPLIT
                          "<split name='P' type='multioutput'>"
                          "<input name='depth' type='float' value='0.5' unit='kilometer'/>"
                          "<input name='file' type='filename' value='wood.png'/>"
                          "<token name='kind' type='string' value='rust'/></split>" SURFACE(
                              "<input name='base_color' type='color3' nodename='P' output='a'/>"
                              "<input name='base' type='float' nodename='P' output='b'/>"
                              "<input name='coat' type='float' nodename='P' output='c'/>")));
    mxg_document *after = flatten(f, before, (const char *const[]){"P", NULL});
    expect_attribute(after, "S/base_color", "nodename", "P_both");
    expect_attribute(after, "S/base_color", "output", "");
    expect_attribute(after, "S/base", "nodename", "P_parts");
    expect_attribute(after, "S/base", "output", "outg");
    /* in the unit of the definition, which the surface does not know */
    expect_attribute(after, "S/coat", "value", "500.0");
    expect_attribute(after, "S/coat", "unit", "");
    expect_attribute(after, "P_own/file", "fileprefix", "there/");
    expect_attribute(after, "P_own/kind", "value", "rust");
    expect_attribute(after, "P_i/file", "value", "wood.png");
    REQUIRE(!element_at(after, "P"));
    REQUIRE(draws_the_same(f->context, before, after, "S"));
    mxg_document_destroy(before);
    mxg_document_destroy(after);
}

#define READER(name, says) \
    "<nodedef name='ND_" name "' node='" name "'>" \
    "<input name='a' type='filename' value='none.png'/>" \
    "<output name='out' type='color3'/></nodedef>" \
    "<nodegraph name='NG_" name "' nodedef='ND_" name "'>" \
    "<image name='i' type='color3'>" \
    "<input name='file' type='filename' interfacename='a' " says "/></image>"
#define END(node) "<output name='out' type='color3' nodename='" node "'/></nodegraph>"
#define ADDING \
    "<add name='sum' type='color3'><input name='in1' type='color3' nodename='i'/>" \
    "<input name='in2' type='color3' value='0.1, 0.2, 0.3'/></add>"
#define READERS \
    READER("plain", "") \
    END("i") \
    READER("adding", "") \
    ADDING END("sum") READER("stating", "colorspace='srgb_texture'") ADDING END("sum")

/*
 * A file from a node has the space of the input that it goes through; what the definition says
 * stays.
 */
static void test_files(struct fixture *f)
{
    mxg_document *before = parse(
        f, DOCUMENT(" colorspace='lin_rec709'", READERS
                    "<constant name='map' type='filename'>"
                    "<input name='value' type='filename' value='wood.png'/></constant>"
                    "<plain name='P' type='color3'>"
                    "<input name='a' type='filename' nodename='map' colorspace='acescg'/></plain>"
                    "<stating name='Q' type='color3'><input name='a' type='filename' "
                    "value='rust.png' colorspace='acescg'/></stating>"
                    "<adding name='R' type='color3'/>" SURFACE(
                        "<input name='base_color' type='color3' nodename='P'/>"
                        "<input name='coat_color' type='color3' nodename='R'/>"
                        "<input name='emission_color' type='color3' nodename='Q'/>")));
    mxg_document *after = flatten(f, before, (const char *const[]){"P", "Q", "R", NULL});
    expect_attribute(after, "P/file", "nodename", "map");
    expect_attribute(after, "P/file", "colorspace", "acescg");
    expect_attribute(after, "Q_i/file", "value", "rust.png");
    expect_attribute(after, "Q_i/file", "colorspace", "srgb_texture");
    REQUIRE(draws_the_same(f->context, before, after, "S"));
    mxg_document_destroy(before);
    mxg_document_destroy(after);
}

/* The default of a library's definition is a file beside the library, in the working space. */
static void test_files_of_libraries(void)
{
    static const struct memory_file library[] = {
        {"library.mtlx", DOCUMENT(" colorspace='acescg' fileprefix='tex/'", READERS)},
        {NULL, NULL}};
    struct memory_files files = {.files = library};
    struct fixture own = {0};
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    const mxg_resolver resolver = memory_resolver(&files);
    desc.resolver = &resolver;
    REQUIRE_EQ(mxg_context_create(&desc, &own.context), MXG_OK);
    mxg_library *builtin = mxg_library_builtin(own.context);
    REQUIRE_EQ(mxg_library_load(own.context, builtin, (const char *const[]){"library.mtlx"}, 1,
                                &own.library),
               MXG_OK);
    mxg_library_unref(builtin);
    mxg_document *before =
        parse(&own, DOCUMENT(" colorspace='srgb_texture' fileprefix='here/'",
                             "<adding name='P' type='color3'/>" SURFACE(
                                 "<input name='base_color' type='color3' nodename='P'/>")));
    mxg_document *after = flatten(&own, before, (const char *const[]){"P", NULL});
    expect_attribute(after, "P_i/file", "fileprefix", "tex/");
    expect_attribute(after, "P_i/file", "colorspace", "none");
    mxg_result *result = generate_reduced(own.context, after, "S");
    REQUIRE(strstr(mxg_result_reflection_json(result, NULL), "\"file\": \"tex/none.png\""));
    REQUIRE(!strstr(mxg_result_source(result, MXG_STAGE_PIXEL, NULL), "srgb"));
    mxg_result_destroy(result);
    mxg_document_destroy(before);
    mxg_document_destroy(after);
    close_fixture(&own);
}

/* No node of a graph can convert as a node does behind its graph, or before it. */
static void test_conversions(struct fixture *f)
{
    static const struct {
        const char *inputs, *reason;
    } cases[] = {
        {READERS "<adding name='P' type='color3'><input name='a' type='filename' value='wood.png'/>"
                 "</adding>",
         "the results of 'P' are converted from the colour space or unit of the file 'a'"},
        {READERS "<adding name='P' type='color3'/>", /* of the document, like its default */
         "the results of 'P' are converted"},
        {SPLIT "<nodegraph name='G'>"
               "<input name='far' type='float' value='2' unit='inch' unittype='distance'/>"
               "<split name='P' type='multioutput'>"
               "<input name='depth' type='float' interfacename='far'/>"
               "<input name='file' type='filename' value='' colorspace='none'/></split>"
               "<output name='out' type='float' nodename='P' output='c'/></nodegraph>",
         "'depth' of 'P' is in 'meter', and what it reads in 'inch'"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[8192], reason[512];
        snprintf(text, sizeof text,
                 "<materialx version='1.39' colorspace='srgb_texture'>%s</materialx>",
                 cases[i].inputs);
        mxg_document *document = parse(f, text);
        mxg_edit *edit = NULL;
        REQUIRE_EQ(mxg_edit_create(f->context, f->library, document, NULL, &edit), MXG_OK);
        mxg_element node = edited_at(edit, i == 2 ? "G/P" : "P");
        REQUIRE_EQ(mxg_edit_flatten_node(edit, node), MXG_ERROR_ARGUMENT);
        mxg_edit_error(edit, reason, sizeof reason);
        if (!REQUIRE(strstr(reason, cases[i].reason)))
            printf("    %s\n", reason);
        mxg_edit_destroy(edit);
        mxg_document_destroy(document);
    }
}

/* Results that are no colours leave the conversion to the image, which keeps it. */
static void test_converted_inside(struct fixture *f)
{
    mxg_document *before =
        parse(f, DOCUMENT("", "<nodedef name='ND_g' node='green'>"
                              "<input name='file' type='filename' value='a.png'/>"
                              "<output name='out' type='float'/></nodedef>"
                              "<nodegraph name='NG_g' nodedef='ND_g'><image name='i' type='color3'>"
                              "<input name='file' type='filename' interfacename='file'/></image>"
                              "<extract name='e' type='float'>"
                              "<input name='in' type='color3' nodename='i'/></extract>"
                              "<output name='out' type='float' nodename='e'/></nodegraph>"
                              "<green name='P' type='float'><input name='file' type='filename' "
                              "value='wood.png' colorspace='srgb_texture'/></green>" SURFACE(
                                  "<input name='base' type='float' nodename='P'/>")));
    mxg_document *after = flatten(f, before, (const char *const[]){"P", NULL});
    expect_attribute(after, "P_i/file", "colorspace", "srgb_texture");
    mxg_document *both[] = {before, after};
    for (int i = 0; i < 2; i++) {
        mxg_result *result = generate_reduced(f->context, both[i], "S");
        REQUIRE(strstr(mxg_result_source(result, MXG_STAGE_PIXEL, NULL),
                       "mx_srgb_texture_to_lin_rec709(texture("));
        mxg_result_destroy(result);
        mxg_document_destroy(both[i]);
    }
}

/* A string that names a file has no prefix, and the file has the space of the definition. */
static void test_named_files(struct fixture *f)
{
    mxg_document *before = parse(
        f, DOCUMENT(" fileprefix='here/' colorspace='lin_rec709'",
                    "<nodedef name='ND_t' node='named'>"
                    "<input name='a' type='string' value='none.png'/>"
                    "<output name='out' type='color3'/></nodedef>"
                    "<nodegraph name='NG_t' nodedef='ND_t' colorspace='srgb_texture'>"
                    "<image name='i' type='color3'>"
                    "<input name='file' type='filename' interfacename='a'/></image>"
                    "<output name='out' type='color3' nodename='i'/></nodegraph>"
                    "<constant name='c' type='string'>"
                    "<input name='value' type='string' value='wood.png'/></constant>"
                    "<named name='P' type='color3'>"
                    "<input name='a' type='string' value='rust.png'/></named>"
                    "<named name='Q' type='color3'/>"
                    "<named name='R' type='color3'>"
                    "<input name='a' type='string' nodename='c'/></named>"
                    "<add name='sum' type='color3'><input name='in1' type='color3' nodename='P'/>"
                    "<input name='in2' type='color3' nodename='Q'/></add>"
                    "<add name='all' type='color3'><input name='in1' type='color3' nodename='sum'/>"
                    "<input name='in2' type='color3' nodename='R'/></add>" SURFACE(
                        "<input name='base_color' type='color3' nodename='all'/>")));
    mxg_document *after = flatten(f, before, (const char *const[]){"P", "Q", "R", NULL});
    expect_attribute(after, "P/file", "value", "rust.png");
    expect_attribute(after, "P/file", "colorspace", "srgb_texture");
    expect_attribute(after, "Q/file", "value", "none.png");
    expect_attribute(after, "R/file", "nodename", "c");
    expect_attribute(after, "R/file", "colorspace", "srgb_texture");
    REQUIRE(draws_the_same(f->context, before, after, "S"));
    mxg_document_destroy(before);
    mxg_document_destroy(after);
}

/* ---- Definitions inside of others, and those of the library ---- */

static void test_levels(struct fixture *f)
{
    mxg_document *before = parse(
        f, DOCUMENT("", PATTERN
                    "<nodedef name='ND_o' node='outer'><input name='tint' type='color3' value='1, "
                    "0.5, 0.5'/>"
                    "<output name='out' type='surfaceshader'/></nodedef><nodegraph name='NG_o' "
                    "nodedef='ND_o'>"
                    "<pattern name='p' type='color3'>"
                    "<input name='hue' type='color3' interfacename='tint'/></pattern>"
                    "<standard_surface name='s' type='surfaceshader'>"
                    "<input name='base_color' type='color3' nodename='p'/></standard_surface>"
                    "<output name='out' type='surfaceshader' nodename='s'/></nodegraph>"
                    "<outer name='S' type='surfaceshader'/>"));
    mxg_document *one = flatten(f, before, (const char *const[]){"S", NULL}),
                 *all = flatten(f, before, (const char *const[]){"S", "S_p", "S", NULL});
    expect_attribute(one, "S/base_color", "nodename", "S_p");
    expect_attribute(all, "S_p/in1", "value", "1, 0.5, 0.5");
    mxg_element_info info = MXG_INIT(mxg_element_info);
    mxg_document_element(all, element_at(all, "S"), &info);
    REQUIRE_STR(info.category, "surface"); /* the standard_surface of the library is a graph, too */
    REQUIRE(draws_the_same(f->context, before, one, "S"));
    mxg_document_destroy(before);
    mxg_document_destroy(one);
    mxg_document_destroy(all);
}

static void test_library(struct fixture *f)
{
    mxg_document *before = parse(
        f, DOCUMENT("", SURFACE("<input name='base_color' type='color3' value='0.5, 0.1, 0.2'/>"
                                "<input name='coat' type='float' value='0.5'/>"
                                "<input name='metalness' type='float' value='0.25'/>")));
    mxg_document *after = flatten(f, before, (const char *const[]){"S", NULL});
    REQUIRE(draws_the_same(f->context, before, after, "S"));
    mxg_document_destroy(before);
    mxg_document_destroy(after);
}

/* ---- What is no such node ---- */

static void expect_failure(const struct fixture *f, const mxg_document *from, const char *path,
                           const char *reason)
{
    char said[256];
    mxg_edit *edit = NULL;
    mxg_document *after = NULL;
    mxg_edit_create(f->context, f->library, from, NULL, &edit);
    REQUIRE_EQ(mxg_edit_flatten_node(edit, edited_at(edit, path)), MXG_ERROR_ARGUMENT);
    mxg_edit_error(edit, said, sizeof said);
    if (!REQUIRE(strstr(said, reason)))
        printf("    %s: %s\n", path, said);
    commit(edit, &after);
    REQUIRE_STR(mxg_document_xml(after, NULL), mxg_document_xml(from, NULL));
    mxg_document_destroy(after);
}

static void test_failures(void)
{
    struct fixture f;
    open_fixture(&f, 100);
    mxg_document *document = parse(
        &f,
        DOCUMENT("",
                 "<nodedef name='ND_r' node='round'><output name='out' type='float'/></nodedef>"
                 "<nodegraph name='NG_r' nodedef='ND_r'><round name='r' type='float'/>"
                 "<output name='out' type='float' nodename='r'/></nodegraph>"
                 "<add name='a' type='float'/><standard_surface name='S' type='surfaceshader'/>"));
    expect_failure(&f, document, "a", "no nodegraph implements the definition of 'a'");
    expect_failure(&f, document, "NG_r", "no nodegraph implements the definition of 'NG_r'");
    expect_failure(&f, document, "NG_r/r", "'r' is a part of its own definition");
    expect_failure(&f, document, "S", "more elements than the context allows");
    expect_failure(&f, document, "nothing", "there is no such element");
    REQUIRE_EQ(mxg_edit_flatten_node(NULL, 1), MXG_ERROR_ARGUMENT);
    mxg_document_destroy(document);
    close_fixture(&f);
}

static void (*const tests[])(struct fixture *f) = {
    test_values,           test_defaults,    test_outputs, test_files,   test_conversions,
    test_converted_inside, test_named_files, test_levels,  test_library,
};

int main(void)
{
    for (size_t i = 0; i < sizeof tests / sizeof *tests; i++) {
        struct fixture f;
        open_fixture(&f, 0);
        tests[i](&f);
        close_fixture(&f);
    }
    test_files_of_libraries();
    test_failures();
    return test_report("api-flatten");
}
