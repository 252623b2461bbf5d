// SPDX-License-Identifier: Apache-2.0
/*
 * The element tree: types and values, building, names in layers, templates, namespaces, validation.
 * Upgrades: test_upgrade.c.
 */
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

static void test_duplicates(void)
{
    REQUIRE_MESSAGES(ROOT "\n<a name=\"n\"/>\n<b name=\"n\"/>\n" END, NULL,
                     "3:10 duplicate-name, 2:10 previous-definition");
    REQUIRE_MESSAGES(ROOT "\n<a name=\"n\"/>\n<a name=\"n\" type=\"x\"/>\n" END, NULL,
                     "3:10 duplicate-name, 2:10 previous-definition");
    REQUIRE_MESSAGES(ROOT "\n<a name=\"n\"><b/></a>\n<a name=\"n\"><b/><b/></a>\n" END, NULL,
                     "3:10 duplicate-name, 2:10 previous-definition");
    REQUIRE_MESSAGES(
        ROOT
        "\n<a name=\"n\" x=\"1\" y=\"2\"><b/></a>\n<a y=\"2\" x=\"1\" name=\"n\"><b/></a>\n" END,
        NULL, "3:22 repeated-element, 2:10 previous-definition");
    REQUIRE_TREE(ROOT "<a name=\"n\"/><a name=\"n\"/><a/><a/>" END, NULL,
                 "<a name=\"n\"/>\n<a/>\n<a/>\n");
}

static void test_templates(void)
{
    REQUIRE_TREE(ROOT "<first/><template vars=\"type n\" rows=\"float 1; color3 2;\">"
                      "<a name=\"x_@type@_@n@\" t=\"@type@\" z=\"@type.zero@\" o=\"@type.one@\" "
                      "h=\"@type.half@\" g=\"@type.glsl@\" "
                      "s=\"@type.size@\"/><b mail=\"a@b.c\"/></template><last/>" END,
                 NULL,
                 "<first/>\n"
                 "<a name=\"x_float_1\" t=\"float\" z=\"0.0\" o=\"1.0\" h=\"0.5\" g=\"float\" "
                 "s=\"1\"/>\n<b mail=\"a@b.c\"/>\n"
                 "<a name=\"x_color3_2\" t=\"color3\" z=\"0.0, 0.0, 0.0\" o=\"1.0, 1.0, 1.0\" "
                 "h=\"0.5, 0.5, 0.5\" g=\"vec3\" s=\"3\"/>\n"
                 "<b mail=\"a@b.c\"/>\n<last/>\n");
    REQUIRE_TREE(ROOT "<template vars=\"t\" rows=\"matrix33; boolean; integer; filename\"><a "
                      "one=\"@t.one@\" g=\"@t.glsl@\"/></template>" END,
                 NULL,
                 "<a one=\"1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0\" g=\"mat3\"/>\n<a "
                 "one=\"true\" g=\"bool\"/>\n"
                 "<a one=\"1\" g=\"int\"/>\n<a one=\"\" g=\"sampler2D\"/>\n");
    REQUIRE_TREE(ROOT "<nodedef><template vars=\"a\" rows=\"1; 2\"><template vars=\"b\" "
                      "rows=\"@a@x; y\"><in v=\"@a@@b@\"><in/></in>"
                      "</template><in v=\"@a@\"/></template></nodedef>" END,
                 NULL,
                 "<nodedef>\n  <in v=\"11x\">\n    <in/>\n  </in>\n  <in v=\"1y\">\n    <in/>\n  "
                 "</in>\n  <in v=\"1\"/>\n"
                 "  <in v=\"22x\">\n    <in/>\n  </in>\n  <in v=\"2y\">\n    <in/>\n  </in>\n  <in "
                 "v=\"2\"/>\n</nodedef>\n");
    REQUIRE_MESSAGES(ROOT "<template rows=\"x\"><a/></template>" END, NULL, "1:27 template-bad");
    REQUIRE_MESSAGES(ROOT "<template vars=\"a b\" rows=\"1 2; 3\"><a/></template>" END, NULL,
                     "1:54 template-bad");
    REQUIRE_MESSAGES(ROOT "<template vars=\"a\" rows=\"1\"><a b=\"@c@\"/></template>" END, NULL,
                     "1:43 template-bad");
    REQUIRE_MESSAGES(ROOT "<template vars=\"a\" rows=\"1\"><a b=\"@a.zero@\"/></template>" END,
                     NULL, "1:52 template-bad");
    REQUIRE_MESSAGES(ROOT "<template vars=\"a\" rows=\"1\"><template vars=\"a\" "
                          "rows=\"2\"><x/></template></template>" END,
                     NULL, "1:43 template-bad");
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

static void require_valid(const char *content, const char *expected)
{
    struct fixture f;
    fixture_init(&f);
    struct text text;
    text_init(&text, &f.arena);
    text_fmt(&text, ROOT "\n%s" END, content);
    fixture_read_bytes(&f, text.data, text.len, NULL);
    doc_validate(&f.doc, &f.diags);
    if (!REQUIRE_STR(fixture_messages(&f), expected))
        printf("    in %s\n", content);
    fixture_close(&f);
}

static void test_validation(void)
{
    require_valid("", "");
    require_valid("<nodedef name=\"ND_a\" node=\"a\"><input name=\"in\" type=\"float\" "
                  "value=\"1\"/><output name=\"out\" type=\"float\"/></nodedef>"
                  "<nodegraph name=\"NG_a\" nodedef=\"ND_a\"><add name=\"b\" type=\"float\"><input "
                  "name=\"in1\" type=\"float\" interfacename=\"in\"/>"
                  "</add><output name=\"out\" type=\"float\" nodename=\"b\"/></nodegraph>"
                  "<add name=\"c\" type=\"float\"><input name=\"in1\" type=\"float\" "
                  "nodegraph=\"NG_a\"/></add>",
                  "");
    require_valid("<add name=\"1a\" type=\"float\"/>", "2:12 bad-name");
    require_valid("<add name=\"a b\" type=\"float\"/>", "2:12 bad-name");
    require_valid("<add type=\"float\"/>", "2:1 name-missing");
    require_valid("<add name=\"a\"/>", "2:1 missing-attribute");
    require_valid("<add name=\"a\" type=\"flaot\"/>", "2:21 unknown-type");
    require_valid("<typedef name=\"t\"><member name=\"m\" type=\"float\" "
                  "value=\"x\"/></typedef><add name=\"a\" type=\"t\"/>",
                  "2:56 bad-value");
    require_valid(
        "<add name=\"a\" type=\"float\"><input name=\"in1\" type=\"float\" value=\"abc\"/></add>",
        "2:66 bad-value");
    require_valid("<nodedef name=\"N\" node=\"n\"><input name=\"i\" type=\"color3\" "
                  "uimax=\"1\"/><output name=\"o\" type=\"float\"/></nodedef>",
                  "2:65 bad-value");
    require_valid("<nodedef name=\"N\" node=\"n\"/>", "2:1 no-output");
    require_valid("<input name=\"i\" type=\"float\"/>", ""); /* of the document */
    require_valid("<look name=\"L\"><input name=\"i\" type=\"float\"/></look>",
                  "2:16 misplaced-element");
    require_valid("<nodedef name=\"N\" node=\"n\"><add name=\"a\" type=\"float\"/><output "
                  "name=\"o\" type=\"float\"/></nodedef>",
                  "2:28 misplaced-element");
    require_valid("<add name=\"b\" type=\"float\"/><add name=\"a\" type=\"float\"><input "
                  "name=\"in1\" type=\"float\" nodename=\"b\" value=\"1\"/></add>",
                  "2:107 value-and-connection");
    require_valid("<add name=\"b\" type=\"float\"/><nodegraph name=\"c\"><output name=\"o\" "
                  "type=\"float\"/></nodegraph>"
                  "<add name=\"a\" type=\"float\"><input name=\"in1\" type=\"float\" "
                  "nodename=\"b\" nodegraph=\"c\"/></add>",
                  "2:119 several-connections");
    require_valid(
        "<add name=\"a\" type=\"float\"><input name=\"in1\" type=\"float\" nodename=\"b\"/></add>"
        "<add name=\"b\" type=\"float\"><input name=\"in1\" type=\"float\" nodename=\"a\"/></add>",
        "2:12 cycle, 2:147 reads, 2:69 reads");
    require_valid(
        "<add name=\"a\" type=\"float\"><input name=\"in1\" type=\"float\" nodename=\"a\"/></add>",
        "2:12 cycle, 2:69 reads");
    require_valid("<nodedef name=\"N\" node=\"n\" inherit=\"M\"/>", "2:37 inherit-missing");
    require_valid("<nodedef name=\"N\" node=\"n\" inherit=\"M\"/><nodedef name=\"M\" node=\"n\" "
                  "inherit=\"N\"/>",
                  "2:37 inherit-cycle");
    require_valid(
        "<look name=\"l\"><materialassign name=\"m\" material=\"x\" collection=\"c\"/></look>",
        "2:66 dangling-reference, 2:51 dangling-reference");
    require_valid("<implementation name=\"i\"/>", "2:1 missing-attribute");
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

int main(void)
{
    xml_startup();
    test_types();
    test_values();
    test_building();
    test_layers();
    test_duplicates();
    test_templates();
    test_namespaces();
    test_validation();
    test_writing();
    return test_report("document");
}
