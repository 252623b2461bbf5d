// SPDX-License-Identifier: Apache-2.0
/*
 * The element tree: types and values, building, names in layers, templates, namespaces, validation.
 * Upgrades: test_upgrade.c.
 */
#include "cases.h"
#include "document_fixture.h"

#define ROOT "<materialx version=\"1.39\">"
#define END "</materialx>"

static void test_types(void)
{
    for (doc_type type = DOC_TYPE_NONE + 1; type < DOC_NUM_TYPES; type++)
        REQUIRE_EQ(doc_type_of(doc_type_name(type)), type);
    REQUIRE_EQ(doc_type_of(STR_color3), DOC_TYPE_color3);
    REQUIRE_EQ(doc_type_ir(DOC_TYPE_color3), IR_TYPE_VEC3);
    REQUIRE_EQ(doc_type_ir(DOC_TYPE_material), IR_TYPE_MATERIAL);
    REQUIRE_EQ(doc_type_components(DOC_TYPE_matrix44), 16);
    REQUIRE_EQ(doc_type_of(STR_name), DOC_TYPE_NONE);
    REQUIRE_EQ(doc_type_of(STR_EMPTY), DOC_TYPE_NONE);
    REQUIRE_EQ(doc_kind_of(STR_nodegraph), KIND_NODEGRAPH);
    REQUIRE_EQ(doc_kind_of(STR_add), KIND_NODE);
    REQUIRE_EQ(doc_kind_of(STR_NUM_WORDS + 5), KIND_NODE);
}

static void test_values(void)
{
    static const struct {
        doc_type type;
        const char *text;
        bool good;
        float last; /* component */
    } cases[] = {
        {DOC_TYPE_float, "0.5", true, 0.5f},
        {DOC_TYPE_float, " -1e-2\n", true, -0.01f},
        {DOC_TYPE_float, "abc", false, 0},
        {DOC_TYPE_float, "0.5.0", false, 0},
        {DOC_TYPE_float, "1 2", false, 0},
        {DOC_TYPE_float, "", false, 0},
        {DOC_TYPE_integer, "-7", true, 0},
        {DOC_TYPE_integer, "1.5", false, 0},
        {DOC_TYPE_integer, "3000000000", false, 0},
        {DOC_TYPE_color3, "1, 0,0.25", true, 0.25f},
        {DOC_TYPE_color3, "1 0 0.25", true, 0.25f},
        {DOC_TYPE_color3, "1,,0", false, 0},
        {DOC_TYPE_color3, "1, 0", false, 0},
        {DOC_TYPE_color3, "1, 0, 0,", false, 0},
        {DOC_TYPE_color3, "1, 0, 0, 0", false, 0},
        {DOC_TYPE_vector2, "1,2", true, 2},
        {DOC_TYPE_matrix33, "1,2,3, 4,5,6, 7,8,9", true, 9},
        {DOC_TYPE_boolean, "true", true, 0},
        {DOC_TYPE_boolean, "True", false, 0},
        {DOC_TYPE_boolean, "1", false, 0},
        {DOC_TYPE_filename, "a.png", false, 0}, /* no value to compute with */
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct ir_value value = {0};
        unsigned components = doc_type_components(cases[i].type);
        bool good =
            doc_parse_value(cases[i].type, cases[i].text, strlen(cases[i].text), NULL, &value);
        if (!REQUIRE_EQ(good, cases[i].good))
            printf("    '%s'\n", cases[i].text);
        if (good && cases[i].last != 0)
            REQUIRE(value.w[components - 1].f == cases[i].last);
    }
    REQUIRE(doc_value_is_valid(DOC_TYPE_vector2array, "1, 2, 3, 4", 10));
    REQUIRE(!doc_value_is_valid(DOC_TYPE_vector2array, "1, 2, 3", 7));
    REQUIRE(!doc_value_is_valid(DOC_TYPE_integerarray, "1, 2.5", 6));
    REQUIRE(doc_value_is_valid(DOC_TYPE_floatarray, "", 0));
    REQUIRE(doc_value_is_valid(DOC_TYPE_stringarray, "a, b", 4));
}

static elem_id add(struct document *doc, elem_id parent, const char *category, const char *name)
{
    return doc_add_element(doc, parent, str_intern_z(doc->strings, category),
                           str_intern_z(doc->strings, name), 0, 1, 1);
}

static void test_building(void)
{
    struct fixture f;
    fixture_read(&f, ROOT "<nodegraph name=\"g\"/>" END, NULL);
    struct document *doc = &f.doc;
    elem_id a = add(doc, doc->root, "add", "a"), b = add(doc, doc->root, "add", "b"),
            c = add(doc, a, "input", "c");
    doc_set_attr(doc, a, STR_type, STR_float); /* after others were added */
    doc_set_attr(doc, b, STR_type, STR_color3);
    doc_set_attr(doc, a, STR_value, STR_true);
    doc_set_attr(doc, a, STR_type, STR_integer);
    REQUIRE_STR(fixture_tree(&f),
                "<nodegraph name=\"g\"/>\n"
                "<add name=\"a\" type=\"integer\" value=\"true\">\n  <input name=\"c\"/>\n</add>\n"
                "<add name=\"b\" type=\"color3\"/>\n");
    REQUIRE(doc_attr_is_true(doc, a, STR_value));
    doc_remove_attr(doc, a, STR_type);
    doc_move_before(doc, b, a);
    doc_move_element(doc, c, b);
    doc_set_category(doc, c, STR_output);
    REQUIRE_STR(fixture_tree(&f), "<nodegraph name=\"g\"/>\n<add name=\"b\" type=\"color3\">\n  "
                                  "<output name=\"c\"/>\n</add>\n"
                                  "<add name=\"a\" value=\"true\"/>\n");
    doc_remove_element(doc, a);
    doc_remove_element(doc, doc_element(doc, doc->root)->first_child);
    doc_index_names(doc, NULL);
    REQUIRE_EQ(doc_find(doc, "b/c", 3), c);
    REQUIRE_EQ(doc_find(doc, "a", 1), 0);
    REQUIRE_EQ(doc_element(doc, c)->kind, KIND_OUTPUT);
    fixture_close(&f);
}

static void test_layers(void)
{
    struct fixture f;
    fixture_read(
        &f, ROOT "<nodedef name=\"ND_x\"><input name=\"in\" type=\"float\"/></nodedef>" END, NULL);
    struct strpool strings;
    struct document top;
    strpool_init(&strings, &f.arena, &f.strings);
    doc_init(&top, &f.arena, &strings, &f.doc);
    const char *text = "<materialx version=\"1.39\" fileprefix=\"p/\"><x name=\"y\"><input "
                       "name=\"file\" fileprefix=\"\"/></x>" END;
    REQUIRE(xml_read_memory(&top, NULL, NULL, "top.mtlx", text, strlen(text), &f.diags));
    elem_id below = doc_find(&top, "/ND_x/in", 8), own = doc_find(&top, "y/file", 6);
    REQUIRE(below && own && below < top.root && own > top.root);
    REQUIRE_EQ(doc_attr_value(&top, below, STR_type), STR_float);
    REQUIRE_STR(doc_place(&top, below).file, "test.mtlx");
    REQUIRE_STR(doc_place(&top, own).file, "top.mtlx");
    REQUIRE_EQ(doc_child(&top, doc_element(&top, below)->parent, STR_in), below);
    REQUIRE_EQ(doc_child_of_kind(&top, doc_element(&top, below)->parent, KIND_OUTPUT, STR_in), 0);
    /* the nearest counts, empty or not */
    REQUIRE_EQ(doc_inherited_attr(&top, own, STR_fileprefix), STR_EMPTY);
    REQUIRE_STR(
        str_text(&strings, doc_inherited_attr(&top, doc_find(&top, "y", 1), STR_fileprefix)), "p/");
    struct text path;
    text_init(&path, &f.arena);
    doc_path(&top, own, '/', &path);
    REQUIRE_STR(text_cstr(&path), "y/file");
    doc_path(&top, below, '.', &path);
    REQUIRE_STR(text_cstr(&path), "y/fileND_x.in");
    doc_path(&top, top.root, '.', &path);
    REQUIRE_STR(text_cstr(&path), "y/fileND_x.in");
    fixture_close(&f);
}

static void test_namespaces(void)
{
    static const struct fixture_file files[] = {
        {"lib.mtlx", "<materialx version=\"1.39\" namespace=\"lib\"><nodedef name=\"ND_a\" "
                     "node=\"a\"/><nodegraph name=\"NG_a\" nodedef=\"ND_a\"/>"
                     "<a name=\"x\" nodedef=\"ND_a\"/><b name=\"y\"><input name=\"in\" "
                     "nodename=\"x\"/></b></materialx>"},
        {NULL, NULL},
    };
    REQUIRE_TREE(
        "<materialx version=\"1.39\" xmlns:xi=\"http://www.w3.org/2001/XInclude\"><xi:include "
        "href=\"lib.mtlx\"/>"
        "<lib:a name=\"x\" nodedef=\"lib:ND_a\"/><a name=\"z\"/>" END,
        files,
        "<nodedef name=\"lib:ND_a\" node=\"lib:a\" namespace=\"lib\"/>\n"
        "<nodegraph name=\"lib:NG_a\" nodedef=\"lib:ND_a\" namespace=\"lib\"/>\n"
        "<lib:a name=\"lib:x\" nodedef=\"lib:ND_a\" namespace=\"lib\"/>\n"
        "<b name=\"lib:y\" namespace=\"lib\">\n  <input name=\"in\" nodename=\"lib:x\"/>\n</b>\n"
        "<lib:a name=\"x\" nodedef=\"lib:ND_a\"/>\n<a name=\"z\"/>\n");
    struct fixture f;
    fixture_read(&f,
                 "<materialx version=\"1.39\" namespace=\"n\"><nodegraph name=\"g\"><add "
                 "name=\"a\"><input name=\"i\" nodename=\"g\"/>"
                 "</add></nodegraph></materialx>",
                 NULL);
    REQUIRE(doc_find(&f.doc, "n:g/a", 5)
            && doc_find(&f.doc, "g/a", 3) == doc_find(&f.doc, "n:g/a", 5));
    /* a node of the graph */
    REQUIRE_STR(
        str_text(&f.strings, doc_attr_value(&f.doc, doc_find(&f.doc, "g/a/i", 5), STR_nodename)),
        "g");
    fixture_close(&f);
}

/* "tree", "messages" or "validated": what a document with this content is, or gives. */
static void run_case(const struct test_case *c)
{
    struct fixture f;
    struct text text, said;
    fixture_init(&f);
    text_init(&text, &f.arena);
    text_fmt(&text, ROOT "\n%s" END, c->in);
    fixture_read_bytes(&f, text.data, text.len, NULL);
    if (strcmp(c->words, "validated") == 0)
        doc_validate(&f.doc, &f.diags);
    text_init(&said, &f.arena);
    text_fmt(&said, f.diags.items.len ? "%s\n" : "%s", fixture_messages(&f));
    REQUIRE_STR(strcmp(c->words, "tree") == 0 ? fixture_tree(&f) : text_cstr(&said), c->out);
    fixture_close(&f);
}

static void test_writing(void)
{
    struct fixture f;
    fixture_read(&f, ROOT "<a b=\"&lt;&gt;&amp;&quot;'&#10;&#9;\"/>" END, NULL);
    struct text text;
    text_init(&text, &f.arena);
    doc_write(&f.doc, f.doc.root, &text);
    REQUIRE_STR(text_cstr(&text), "<?xml version=\"1.0\"?>\n<materialx version=\"1.39\">\n"
                                  "  <a b=\"&lt;&gt;&amp;&quot;'&#10;&#9;\"/>\n</materialx>\n");
    fixture_close(&f);
}

/* The argument is the path of document.txt. */
int main(int argc, char **argv)
{
    xml_startup();
    test_cases(argc > 1 ? argv[1] : NULL, run_case);
    test_types();
    test_values();
    test_building();
    test_layers();
    test_namespaces();
    test_writing();
    return test_report("document");
}
