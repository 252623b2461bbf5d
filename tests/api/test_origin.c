// SPDX-License-Identifier: Apache-2.0
/*
 * The files that documents name are relative to the file that names them: an include, a definition.
 * They stay the same files in the text of the document, and in a document for another folder.
 */
#include "tests/api/fixture.h"

/* clang-format off */
#define GRAPH(attributes, file) \
    "<nodegraph " attributes "><image name='img' type='color3'><input name='file' type='filename' " file "/></image>" \
    "<output name='out' type='color3' nodename='img'/></nodegraph>"
#define DOCUMENT(attributes, elements) "<materialx version='1.39'" attributes ">" elements "</materialx>"

static const struct memory_file files[] = {
    {"show/lib/wood.mtlx", DOCUMENT("",
        GRAPH("name='wood'", "value='wood.png'")
        GRAPH("name='own' fileprefix='set/'", "value='own.png'")
        GRAPH("name='fixed' fileprefix='/disk/'", "value='fixed.png'")
        "<nodedef name='ND_grain' node='grain'><input name='file' type='filename' value='grain.png'/>"
        "<output name='out' type='color3'/></nodedef>"
        GRAPH("name='NG_grain' nodedef='ND_grain'", "interfacename='file'"))},
    {"maps/iron.mtlx", DOCUMENT("", GRAPH("name='iron'", "value='iron.png'"))},
    {"/disk/steel.mtlx", DOCUMENT("", GRAPH("name='steel'", "value='steel.png'"))},
    {NULL, NULL},
};

static const char text[] = DOCUMENT(" fileprefix='tex/' xmlns:xi='http://www.w3.org/2001/XInclude'",
    "<xi:include href='show/lib/wood.mtlx'/>"
    "<xi:include href='maps/iron.mtlx'/>"
    "<xi:include href='/disk/steel.mtlx'/>"
    GRAPH("name='main'", "value='main.png'")
    "<grain name='grain' type='color3'/>");
/* clang-format on */

static const struct row {
    const char *element, *path;
    const char *file, *origin; /* as it is read */
    const char *written;       /* the file, relative to the document */
    const char *copied;        /* the file, relative to other/new.mtlx */
} rows[] = {
    {"main", "main/img/file", "tex/main.png", "show/main.mtlx", "tex/main.png",
     "../show/tex/main.png"},
    {"wood", "wood/img/file", "tex/wood.png", "show/lib/wood.mtlx", "lib/tex/wood.png",
     "../show/lib/tex/wood.png"},
    {"own", "own/img/file", "set/own.png", "show/lib/wood.mtlx", "lib/set/own.png",
     "../show/lib/set/own.png"},
    {"fixed", "fixed/img/file", "/disk/fixed.png", "show/lib/wood.mtlx", "/disk/fixed.png",
     "/disk/fixed.png"},
    {"grain", "grain/file", "tex/grain.png", "show/lib/wood.mtlx", "lib/tex/grain.png", NULL},
    {"iron", "iron/img/file", "tex/iron.png", "maps/iron.mtlx", "../maps/tex/iron.png",
     "../maps/tex/iron.png"},
    {"steel", "steel/img/file", "tex/steel.png", "/disk/steel.mtlx", "/disk/tex/steel.png",
     "/disk/tex/steel.png"},
};

struct suite {
    struct memory_files files;
    mxg_context *context;
    mxg_library *library;
    mxg_document *document;
};

static void has_file(struct suite *s, const mxg_document *document, const struct row *row,
                     const char *file, const char *origin)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_variable variable = MXG_INIT(mxg_variable);
    mxg_result *result = NULL;
    desc.target = "glsl";
    desc.element = row->element;
    REQUIRE_EQ(mxg_generate(s->context, document, &desc, &result), MXG_OK);
    uint32_t index = mxg_result_find_variable(result, row->path);
    if (REQUIRE_EQ(mxg_result_variable(result, index, &variable), MXG_OK)) {
        REQUIRE_STR(variable.file, file);
        REQUIRE_STR(variable.origin, origin);
        const char *json = mxg_result_reflection_json(result, NULL);
        REQUIRE_EQ(strstr(json, "\"origin\"") != NULL,
                   strcmp(origin, mxg_document_file(document, 0)) != 0);
    }
    mxg_result_destroy(result);
}

static void test_written(struct suite *s)
{
    mxg_document *again = NULL;
    size_t size = 0;
    const char *xml = mxg_document_xml(s->document, &size);
    REQUIRE_EQ(mxg_document_parse(s->context, s->library, "show/main.mtlx", xml, size, &again),
               MXG_OK);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        has_file(s, s->document, &rows[i], rows[i].file, rows[i].origin);
        has_file(s, again, &rows[i], rows[i].written, "show/main.mtlx");
    }
    REQUIRE_STR(mxg_document_xml(again, NULL), xml);
    mxg_document_destroy(again);
}

static void test_copied(struct suite *s)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        mxg_edit *edit = NULL;
        mxg_document *copied = NULL;
        mxg_element element = mxg_document_find_element(s->document, 0, rows[i].element);
        if (!rows[i].copied)
            continue; /* its definition does not come along */
        REQUIRE_EQ(mxg_edit_create(s->context, s->library, NULL, "other/new.mtlx", &edit), MXG_OK);
        REQUIRE(mxg_edit_copy_element(edit, 0, s->document, element, NULL));
        REQUIRE_EQ(mxg_edit_commit(edit, &copied), MXG_OK);
        has_file(s, copied, &rows[i], rows[i].copied, "other/new.mtlx");
        mxg_document_destroy(copied);
        mxg_edit_destroy(edit);
    }
}

/* The file is another one if another document names it. */
static void test_changed(struct suite *s)
{
    static const char moved[] =
        DOCUMENT(" fileprefix='tex/'", GRAPH("name='wood'", "value='wood.png'"));
    mxg_document *after = NULL;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_result *results[2] = {NULL, NULL};
    uint32_t num = 0;
    desc.target = "glsl";
    desc.element = "wood";
    mxg_document_parse(s->context, s->library, "show/main.mtlx", moved, sizeof moved - 1, &after);
    mxg_generate(s->context, s->document, &desc, &results[0]);
    mxg_generate(s->context, after, &desc, &results[1]);
    REQUIRE_EQ(mxg_result_change(results[0], results[1], NULL, 0, &num), MXG_CHANGE_VALUES);
    REQUIRE_EQ(num, 1);
    REQUIRE_EQ(mxg_result_change(results[0], results[0], NULL, 0, &num), MXG_CHANGE_NOTHING);
    mxg_result_destroy(results[0]);
    mxg_result_destroy(results[1]);
    mxg_document_destroy(after);
}

int main(void)
{
    struct suite s = {.files = {.files = files}};
    mxg_resolver resolver = memory_resolver(&s.files);
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.resolver = &resolver;
    mxg_context_create(&desc, &s.context);
    s.library = mxg_library_builtin(s.context);
    REQUIRE_EQ(mxg_document_parse(s.context, s.library, "show/main.mtlx", text, sizeof text - 1,
                                  &s.document),
               MXG_OK);
    test_written(&s);
    test_copied(&s);
    test_changed(&s);
    mxg_document_destroy(s.document);
    mxg_library_unref(s.library);
    mxg_context_destroy(s.context);
    return test_report("api-origin");
}
