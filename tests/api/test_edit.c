// SPDX-License-Identifier: Apache-2.0
/* Edits: building a document, and making one from another. */
#include "edit_fixture.h"

#include <math.h>

/* ---- Building ---- */

/* The document of gold.mtlx. */
static void build_gold(mxg_edit *e)
{
    mxg_element shader = mxg_edit_add_element(e, 0, "standard_surface", "SR", "surfaceshader"),
                material = mxg_edit_add_element(e, 0, "surfacematerial", "Gold", "material"),
                graph = mxg_edit_add_element(e, 0, "nodegraph", "NG", NULL),
                amount = mxg_edit_add_element(e, graph, "input", "amount", "float"),
                spots = mxg_edit_add_element(e, graph, "noise2d", "spots", "float"),
                split = mxg_edit_add_element(e, graph, "separate2", "split", "multioutput"),
                wear = mxg_edit_add_element(e, graph, "output", "wear", "float"),
                x = mxg_edit_add_element(e, graph, "output", "x", "float");
    const float pair[] = {1, 2};
    mxg_edit_set_value(e, shader, "base_color", "color3", "0.9, 0.6, 0.2");
    mxg_edit_set_attribute(e, amount, "value", "0.75");
    mxg_edit_set_numbers(e, split, "in", "vector2", pair, 2);
    mxg_edit_connect_input(e, material, "surfaceshader", shader, NULL);
    mxg_edit_connect_input(e, spots, "amplitude", amount, NULL);
    mxg_edit_connect_input(e, wear, NULL, spots, NULL);
    mxg_edit_connect_input(e, x, NULL, split, "outx");
    mxg_edit_connect_input(e, shader, "metalness", graph, "wear");
}

static void test_build(struct fixture *f)
{
    mxg_edit *edit = begin(f, NULL);
    build_gold(edit);
    REQUIRE_EQ(mxg_edit_error(edit, NULL, 0), 0);
    mxg_document *built = NULL, *parsed = parse(f, document_text("gold.mtlx"));
    REQUIRE_EQ(commit(edit, &built), MXG_OK);
    REQUIRE_STR(xml_below(built), document_text("gold.mtlx"));
    REQUIRE_STR(xml_below(parsed), document_text("gold.mtlx"));
    REQUIRE_EQ(mxg_document_num_renderables(built), 1);
    mxg_result *a = NULL, *b = NULL;
    const char *from_built = generate(f, built, NULL, &a);
    REQUIRE(strlen(from_built) > 1000);
    REQUIRE_STR(from_built, generate(f, parsed, NULL, &b));
    mxg_result_destroy(a);
    mxg_result_destroy(b);
    mxg_document_destroy(built);
    mxg_document_destroy(parsed);
}

/* ---- Editing ---- */

static void test_edit_of_a_document(struct fixture *f)
{
    mxg_element shader = element_at(f->document, "S"), texture = element_at(f->document, "G/i");
    char before[4096];
    snprintf(before, sizeof before, "%s", xml_below(f->document));
    mxg_edit *edit = begin(f, f->document);
    const float half[] = {0.5f}, quarter[] = {0.25f};
    REQUIRE_EQ(mxg_edit_set_numbers(edit, shader, "metalness", "float", half, 1), MXG_OK);
    REQUIRE_EQ(mxg_edit_set_value(edit, shader, "coat", NULL, "0.5"), MXG_OK);
    REQUIRE_EQ(mxg_edit_set_numbers(edit, shader, "coat", NULL, quarter, 1), MXG_OK);
    REQUIRE_EQ(mxg_edit_set_attribute(edit, texture, "doc", "a \"quoted\" <text> & more"), MXG_OK);
    REQUIRE_EQ(mxg_edit_set_attribute(edit, texture, "doc", NULL), MXG_OK);
    mxg_document *next = NULL;
    REQUIRE_EQ(commit(edit, &next), MXG_OK);
    /* numbers of elements stay, the old document does, too, and places lead to the old file */
    REQUIRE_EQ(element_at(next, "S"), shader);
    REQUIRE_STR(attribute_of(next, element_at(next, "S/coat"), "value"), "0.25");
    REQUIRE_STR(xml_below(f->document), before);
    REQUIRE_EQ(mxg_document_num_files(next), mxg_document_num_files(f->document));
    mxg_element_info info = MXG_INIT(mxg_element_info);
    REQUIRE_EQ(mxg_document_element(next, shader, &info), MXG_OK);
    REQUIRE_EQ(info.line, 11);
    REQUIRE_EQ(mxg_document_element(next, element_at(next, "S/metalness"), &info), MXG_OK);
    REQUIRE(info.line == 0 && !info.file);
    /* the edited document is what its text says */
    mxg_result *a = NULL, *b = NULL;
    mxg_document *again = parse(f, mxg_document_xml(next, NULL));
    REQUIRE_STR(xml_below(again), xml_below(next));
    REQUIRE_STR(generate(f, next, "M", &a), generate(f, again, "M", &b));
    mxg_result_destroy(a);
    mxg_result_destroy(b);
    /* an edit of an edit, after the first document is gone */
    mxg_document_destroy(f->document);
    f->document = NULL;
    edit = begin(f, next);
    REQUIRE_EQ(mxg_edit_remove_element(edit, edited_at(edit, "S/metalness")), MXG_OK);
    REQUIRE_EQ(mxg_edit_set_value(edit, shader, "coat", "float", "0.5"), MXG_OK);
    mxg_document_destroy(next);
    REQUIRE_EQ(commit(edit, &next), MXG_OK);
    REQUIRE_STR(xml_below(next), before);
    mxg_document_destroy(again);
    mxg_document_destroy(next);
}

/* Only what names the element itself changes, whatever else has the name. */
static void test_rename_in_scope(struct fixture *f)
{
    mxg_document *next = NULL,
                 *d = parse(f, "<materialx version='1.39'><constant name='x' type='float'/>"
                               "<nodegraph name='A'><input name='in' type='float' nodename='x'/>"
                               "<constant name='x' type='float'/>"
                               "<sin name='s' type='float'><input name='in' type='float' "
                               "nodename='x'/></sin>"
                               "<output name='x2' type='float' nodename='x'/></nodegraph>"
                               "<nodegraph name='B'><input name='in' type='float' nodename='A'/>"
                               "<cos name='c' type='float'><input name='in' type='float' "
                               "interfacename='in'/></cos></nodegraph>"
                               "<sin name='t' type='float'><input name='in' type='float' "
                               "nodegraph='A' output='x2'/></sin></materialx>");
    mxg_edit *edit = begin(f, d);
    REQUIRE_EQ(mxg_edit_rename_element(edit, edited_at(edit, "A/x"), "inner"), MXG_OK);
    REQUIRE_EQ(mxg_edit_rename_element(edit, edited_at(edit, "A"), "G"), MXG_OK);
    REQUIRE_EQ(mxg_edit_rename_element(edit, edited_at(edit, "G/x2"), "out"), MXG_OK);
    REQUIRE_EQ(mxg_edit_rename_element(edit, edited_at(edit, "B/in"), "number"), MXG_OK);
    REQUIRE_EQ(commit(edit, &next), MXG_OK);
    static const char *const expected[][3] = {{"G/in", "nodename", "x"},
                                              {"G/s/in", "nodename", "inner"},
                                              {"G/out", "nodename", "inner"},
                                              {"B/number", "nodename", "G"},
                                              {"B/c/in", "interfacename", "number"},
                                              {"t/in", "nodegraph", "G"},
                                              {"t/in", "output", "out"}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; ++i)
        REQUIRE_STR(attribute_of(next, element_at(next, expected[i][0]), expected[i][1]),
                    expected[i][2]);
    mxg_document_destroy(d);
    /* a node that an edit moves has the names of its new place */
    edit = begin(f, next);
    mxg_element moved = edited_at(edit, "G/s");
    REQUIRE_EQ(mxg_edit_move_element(edit, moved, 0, 0), MXG_OK);
    REQUIRE_EQ(mxg_edit_connect_input(edit, moved, "in", edited_at(edit, "x"), NULL), MXG_OK);
    REQUIRE_EQ(mxg_edit_move_element(edit, moved, edited_at(edit, "B"), 0), MXG_OK);
    REQUIRE_EQ(mxg_edit_move_element(edit, edited_at(edit, "x"), edited_at(edit, "B"), moved),
               MXG_OK);
    REQUIRE_EQ(mxg_edit_rename_element(edit, edited_at(edit, "B/x"), "y"), MXG_OK);
    mxg_document *last = NULL;
    REQUIRE_EQ(commit(edit, &last), MXG_OK);
    REQUIRE_STR(attribute_of(last, element_at(last, "B/s/in"), "nodename"), "y");
    mxg_document_destroy(next);
    mxg_document_destroy(last);
}

static void test_rename(struct fixture *f)
{
    mxg_document *d = parse(f, document_text("gold.mtlx")), *next = NULL;
    mxg_edit *edit = begin(f, d);
    REQUIRE_EQ(mxg_edit_rename_element(edit, edited_at(edit, "SR"), "Shader"), MXG_OK);
    REQUIRE_EQ(mxg_edit_set_attribute(edit, edited_at(edit, "NG"), "name", "Graph"), MXG_OK);
    REQUIRE_EQ(mxg_edit_rename_element(edit, edited_at(edit, "Graph/wear"), "worn"), MXG_OK);
    REQUIRE_EQ(mxg_edit_rename_element(edit, edited_at(edit, "Graph/amount"), "much"), MXG_OK);
    REQUIRE_EQ(mxg_edit_rename_element(edit, edited_at(edit, "Graph/spots"), "dots"), MXG_OK);
    REQUIRE_EQ(commit(edit, &next), MXG_OK);
    const char *xml = xml_below(next);
    REQUIRE(strstr(xml, "nodename=\"Shader\"") && !strstr(xml, "\"SR\""));
    REQUIRE(strstr(xml, "nodegraph=\"Graph\" output=\"worn\"") && !strstr(xml, "\"wear\""));
    REQUIRE(strstr(xml, "interfacename=\"much\"") && !strstr(xml, "\"amount\""));
    REQUIRE(strstr(xml, "nodename=\"dots\"") && !strstr(xml, "\"spots\""));
    mxg_document_destroy(next);
    mxg_document_destroy(d);
    test_rename_in_scope(f);
    d = parse(f, "<materialx version='1.39'><look name='day'/><look name='night' inherit='day'/>"
                 "<lookgroup name='all' looks='day, night' active='day'/>"
                 "<nodedef name='day2' node='x'><output name='out' type='float'/></nodedef>"
                 "</materialx>");
    edit = begin(f, d);
    REQUIRE_EQ(mxg_edit_rename_element(edit, edited_at(edit, "day"), "noon"), MXG_OK);
    commit(edit, &next);
    xml = xml_below(next);
    REQUIRE(strstr(xml, "inherit=\"noon\"") && strstr(xml, "looks=\"noon, night\""));
    mxg_document_destroy(next);
    mxg_document_destroy(d);
}

static void test_move_and_copy(struct fixture *f)
{
    mxg_document *d = parse(f, document_text("gold.mtlx")), *next = NULL;
    mxg_edit *edit = begin(f, d);
    mxg_element graph = edited_at(edit, "NG"), shader = edited_at(edit, "SR");
    REQUIRE_EQ(mxg_edit_move_element(edit, graph, 0, shader), MXG_OK);
    mxg_element copy = mxg_edit_copy_element(edit, 0, d, shader, "SR2");
    REQUIRE(copy != 0);
    /* from another document, and below itself */
    REQUIRE(mxg_edit_copy_element(edit, graph, f->document, element_at(f->document, "G/i"), NULL));
    REQUIRE(mxg_edit_copy_element(edit, 0, f->document, element_at(f->document, "G"), NULL));
    REQUIRE_EQ(commit(edit, &next), MXG_OK);
    mxg_element_info info = MXG_INIT(mxg_element_info);
    REQUIRE_EQ(mxg_document_element(next, element_at(next, ""), &info), MXG_OK);
    REQUIRE_EQ(info.first_child, graph);
    REQUIRE_EQ(element_at(next, "SR2"), copy);
    REQUIRE_STR(attribute_of(next, element_at(next, "SR2/base_color"), "value"), "0.9, 0.6, 0.2");
    REQUIRE_STR(attribute_of(next, element_at(next, "G/i/file"), "value"), "wood.png");
    REQUIRE(element_at(next, "NG/i/file") != 0);
    mxg_document_destroy(next);
    mxg_document_destroy(d);
}

/* ---- Bad input ---- */

static void test_refused(struct fixture *f)
{
    mxg_document *d = parse(f, document_text("gold.mtlx"));
    mxg_edit *e = begin(f, d);
    mxg_element shader = edited_at(e, "SR"), graph = edited_at(e, "NG"),
                spots = edited_at(e, "NG/spots"), wear = edited_at(e, "NG/wear"),
                material = edited_at(e, "Gold");
    const float numbers[] = {1, NAN, 3};
#define REFUSED(call, text) \
    do { \
        REQUIRE_EQ(call, MXG_ERROR_ARGUMENT); \
        failed_for(e, text); \
    } while (0)
#define NO_ELEMENT(call, text) \
    do { \
        REQUIRE_EQ(call, 0); \
        failed_for(e, text); \
    } while (0)
    NO_ELEMENT(mxg_edit_add_element(e, 0, "add", "SR", "float"), "'SR' already");
    NO_ELEMENT(mxg_edit_add_element(e, 0, "add", "2x", "float"), "'2x' is no name");
    NO_ELEMENT(mxg_edit_add_element(e, 0, "a d", "x", "float"), "'a d' is no name");
    NO_ELEMENT(mxg_edit_add_element(e, 0, NULL, "x", "float"), "the category is missing");
    NO_ELEMENT(mxg_edit_add_element(e, 0, "add", "\xff", "float"), "the name has bytes");
    NO_ELEMENT(mxg_edit_add_element(e, 0, "add", "x", "\xff"), "the type has bytes");
    NO_ELEMENT(mxg_edit_add_element(e, 1, "add", "x", "float"), "no such element");
    NO_ELEMENT(mxg_edit_add_element(e, UINT32_MAX, "add", "x", "float"), "no such element");
    REFUSED(mxg_edit_set_attribute(e, shader, "doc", "\xff"), "XML cannot hold");
    REFUSED(mxg_edit_set_attribute(e, shader, "doc", "\x01"), "XML cannot hold");
    REFUSED(mxg_edit_set_attribute(e, shader, "a=b", "c"), "is no name");
    REFUSED(mxg_edit_set_attribute(e, shader, "name", NULL), "the name is missing");
    REFUSED(mxg_edit_set_attribute(e, shader, "", "c"), "the attribute is missing");
    REFUSED(mxg_edit_set_attribute(e, shader, NULL, "c"), "the attribute is missing");
    REFUSED(mxg_edit_set_value(e, shader, NULL, "float", "1"), "the input is missing");
    REFUSED(mxg_edit_set_value(e, shader, "coat", "float", NULL), "value of 'coat' is missing");
    REFUSED(mxg_edit_rename_element(e, shader, "NG"), "'NG' already");
    REFUSED(mxg_edit_set_value(e, shader, "coat_rougness", NULL, "1"),
            "'coat_rougness' (did you mean 'coat_roughness'?); a new one needs its type");
    REFUSED(mxg_edit_set_value(e, graph, "coat", NULL, "1"), "has no input 'coat'; a new one");
    REFUSED(mxg_edit_set_value(e, shader, "coat", NULL, "much"),
            "'much' is no value of 'coat', whose type is float");
    REFUSED(mxg_edit_set_value(e, shader, "coat", "float", "much"), "'much' is no value");
    REFUSED(mxg_edit_set_value(e, 0, "coat", "float", "1"), "no such element");
    REFUSED(mxg_edit_set_numbers(e, shader, "coat", "color3", numbers, 3), "not a number");
    const float half = 0.5f, large = 16777218.0f;
    REFUSED(mxg_edit_set_numbers(e, shader, "n", "integer", &half, 1), "has a fraction");
    REFUSED(mxg_edit_set_numbers(e, shader, "n", "integer", &large, 1), "more digits");
    REFUSED(mxg_edit_set_numbers(e, shader, "n", "boolean", &half, 1), "0 or 1");
    REFUSED(mxg_edit_set_numbers(e, shader, "coat", "color3", numbers, 2),
            "'coat' is color3, which does not have 2 components");
    REFUSED(mxg_edit_set_numbers(e, shader, "coat", "surfaceshader", numbers, 1),
            "'coat' is surfaceshader, which does not have 1 component");
    REFUSED(mxg_edit_set_numbers(e, shader, "coat", NULL, numbers, 3),
            "'coat' is float, which does not have 3 components");
    REFUSED(mxg_edit_set_numbers(e, shader, "coat", "color3", NULL, 3),
            "numbers of 'coat' are missing");
    REFUSED(mxg_edit_connect_input(e, shader, "coat", spots, NULL), "beside the port");
    REFUSED(mxg_edit_connect_input(e, spots, NULL, graph, NULL), "is an <output>");
    REFUSED(mxg_edit_connect_input(e, shader, "coat", graph, "none"),
            "output 'none' of 'NG' is unknown");
    REFUSED(mxg_edit_connect_input(e, wear, NULL, edited_at(e, "NG/split"), "outq"), "is unknown");
    REFUSED(mxg_edit_connect_input(e, material, "surfaceshader", 0, NULL), "no such element");
    REFUSED(mxg_edit_move_element(e, graph, spots, 0), "below or before itself");
    REFUSED(mxg_edit_move_element(e, graph, 0, graph), "below or before itself");
    REFUSED(mxg_edit_move_element(e, graph, 0, spots), "'spots' is not below the parent, so 'NG'");
    mxg_element look = mxg_edit_add_element(e, 0, "look", NULL, NULL);
    REFUSED(mxg_edit_connect_input(e, shader, "coat", look, NULL), "'look' is no node");
    REFUSED(mxg_edit_move_element(e, look, look, 0), "'look' cannot move below");
    NO_ELEMENT(mxg_edit_copy_element(e, 0, NULL, shader, NULL), "document to copy from is missing");
    REQUIRE_EQ(mxg_edit_remove_element(e, look), MXG_OK);
    REFUSED(mxg_edit_remove_element(e, element_at(d, "")), "no such element");
    NO_ELEMENT(mxg_edit_copy_element(e, graph, d, element_at(d, ""), NULL), "no such element");
    NO_ELEMENT(mxg_edit_copy_element(e, 0, d, shader, NULL), "'SR' already");
    NO_ELEMENT(mxg_edit_copy_element(e, 0, d, shader, ""), "'SR' already");
    REQUIRE_EQ(mxg_edit_remove_element(e, graph), MXG_OK);
    REFUSED(mxg_edit_set_attribute(e, spots, "doc", "of a removed graph"), "no such element");
    /* nothing else has changed */
    mxg_document *next = NULL;
    REQUIRE_EQ(mxg_edit_commit(e, &next), MXG_ERROR_DOCUMENT);
    REQUIRE(has_diagnostic(mxg_document_diagnostics(next), "removed-reference"));
    REQUIRE_EQ(mxg_diagnostics_num_items(mxg_document_diagnostics(next)), 1);
    /* it ends the edit */
    REFUSED(mxg_edit_set_value(e, shader, "coat", "float", "1"), "has made its document");
    NO_ELEMENT(mxg_edit_add_element(e, 0, "add", "x", "float"), "has made its document");
    REQUIRE_EQ(edited_at(e, "SR"), 0);
    mxg_document *again = NULL;
    REQUIRE_EQ(mxg_edit_commit(e, &again), MXG_ERROR_ARGUMENT);
    REQUIRE(!again);
    mxg_edit_destroy(e);
    REQUIRE_STR(attribute_of(next, element_at(next, "SR/base_color"), "value"), "0.9, 0.6, 0.2");
    REQUIRE_EQ(element_at(next, "SR/coat"), 0);
    mxg_document_destroy(next);
    /* handles */
    mxg_library *other = NULL;
    const char *paths[] = {"model.mtlx"};
    REQUIRE_EQ(mxg_library_load(f->context, f->library, paths, 1, &other), MXG_OK);
    REQUIRE_EQ(mxg_edit_create(f->context, other, d, NULL, &e), MXG_ERROR_ARGUMENT);
    REQUIRE(!e);
    REQUIRE_EQ(mxg_edit_create(NULL, f->library, d, NULL, &e), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_edit_commit(NULL, &next), MXG_ERROR_ARGUMENT);
    e = begin(f, d);
    REQUIRE_EQ(mxg_edit_commit(e, NULL), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(commit(e, &next), MXG_OK); /* the call before has changed nothing */
    mxg_document_destroy(next);
    mxg_edit_destroy(NULL);
    mxg_edit_destroy(begin(f, d));
    mxg_library_unref(other);
    mxg_document_destroy(d);
}

/* The tree of an edit takes the same steps as the tree of a file. */
static void test_completed(struct fixture *f)
{
    mxg_edit *edit = begin(f, NULL);
    mxg_element image = mxg_edit_add_element(edit, 0, "image", "I", "color3");
    mxg_edit_set_value(edit, image, "file", "filename", "maps\\oak.png");
    mxg_document *d = NULL;
    REQUIRE_EQ(commit(edit, &d), MXG_OK);
    REQUIRE(has_diagnostic(mxg_document_diagnostics(d), "backslash"));
    REQUIRE_STR(attribute_of(d, element_at(d, "I/file"), "value"), "maps/oak.png");
    mxg_document_destroy(d);
}

/* The type of a new input comes from the definition, also from one of the document. */
static void test_types(struct fixture *f)
{
    mxg_document *d =
        parse(f, "<materialx version='1.39'><nodedef name='ND_own' node='own'>"
                 "<input name='size' type='vector2'/><output name='out' type='float'/>"
                 "</nodedef><own name='O' type='float'/>"
                 "<mix name='M' type='color3'/></materialx>");
    mxg_edit *e = begin(f, d);
    mxg_element own = edited_at(e, "O"), mix = edited_at(e, "M");
    const float numbers[] = {1, 2, 3};
    REQUIRE_EQ(mxg_edit_set_numbers(e, own, "size", NULL, numbers, 2), MXG_OK);
    REQUIRE_EQ(mxg_edit_set_value(e, mix, "fg", NULL, "1, 0, 0"), MXG_OK);
    REQUIRE_EQ(mxg_edit_set_value(e, mix, "mix", NULL, "0.5"), MXG_OK);
    REQUIRE_EQ(mxg_edit_set_value(e, mix, "mix", "color3", "0.5, 1, 0"), MXG_OK);
    mxg_document *next = NULL;
    REQUIRE_EQ(commit(e, &next), MXG_OK);
    static const char *const types[][2] = {
        {"O/size", "vector2"}, {"M/fg", "color3"}, {"M/mix", "color3"}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        REQUIRE_STR(attribute_of(next, element_at(next, types[i][0]), "type"), types[i][1]);
    mxg_document_destroy(next);
    mxg_document_destroy(d);
}

/* Commits the edit, and returns the number of references to removed elements. */
static unsigned count_lost(mxg_edit *edit)
{
    mxg_document *next = NULL;
    mxg_status status = commit(edit, &next);
    unsigned num = mxg_diagnostics_num_items(mxg_document_diagnostics(next));
    REQUIRE_EQ(status, num ? MXG_ERROR_DOCUMENT : MXG_OK);
    mxg_document_destroy(next);
    return num;
}

static void test_removed(struct fixture *f)
{
    mxg_document *d = parse(f, document_text("gold.mtlx"));
    static const struct {
        const char *path;
        unsigned num;
    } removed[] = {{"SR", 1},        {"NG", 1},   {"NG/wear", 1},      {"NG/spots", 1},
                   {"NG/amount", 1}, {"Gold", 0}, {"SR/base_color", 0}};
    for (size_t i = 0; i < sizeof removed / sizeof *removed; i++) {
        mxg_edit *e = begin(f, d);
        mxg_edit_remove_element(e, edited_at(e, removed[i].path));
        REQUIRE_EQ(count_lost(e), removed[i].num);
    }
    /* the user is gone, has a value, or the name stands for another element */
    mxg_edit *e = begin(f, d);
    mxg_edit_remove_element(e, edited_at(e, "NG/spots"));
    mxg_edit_remove_element(e, edited_at(e, "NG"));
    mxg_edit_set_value(e, edited_at(e, "SR"), "metalness", NULL, "1");
    mxg_edit_remove_element(e, edited_at(e, "SR"));
    mxg_edit_add_element(e, 0, "disney_principled", "SR", "surfaceshader");
    REQUIRE_EQ(count_lost(e), 0);
    mxg_document_destroy(d);
}

/* An element without a line is named by its path. */
static void test_diagnostics(struct fixture *f)
{
    mxg_edit *edit = begin(f, NULL);
    mxg_element shader = mxg_edit_add_element(edit, 0, "standard_surface", "SR", "surfaceshader");
    mxg_edit_set_value(edit, shader, "coat", "color3", "1, 1, 1");
    mxg_document *d = NULL;
    commit(edit, &d);
    mxg_result *result = NULL;
    REQUIRE_EQ(mxg_validate(f->context, d, &result), MXG_ERROR_DOCUMENT);
    const mxg_diagnostics *list = mxg_result_diagnostics(result);
    mxg_diagnostic first = MXG_INIT(mxg_diagnostic);
    REQUIRE_EQ(mxg_diagnostics_item(list, 0, &first), MXG_OK);
    REQUIRE(strncmp(first.path, "SR", 2) == 0 && first.line == 0);
    char text[512];
    mxg_diagnostics_format(list, 0, NULL, 0, false, text, sizeof text);
    REQUIRE(strstr(text, "<edit>: SR") == text);
    mxg_result_destroy(result);
    mxg_document_destroy(d);
}

/*
 * Each allocation fails once, while a document shares its origin, or leaves it with a new
 * definition; nothing leaks, and the calls say so.
 */
static void test_memory_of(bool leaves_origin)
{
    unsigned failures = 0;
    for (unsigned at = 1;; at++) {
        struct fixture f;
        open_fixture(&f);
        f.heap.fail_at = f.heap.calls + at;
        unsigned before = f.heap.calls;
        mxg_edit *edit = NULL;
        mxg_document *next = NULL;
        mxg_status status = mxg_edit_create(f.context, f.library, f.document, NULL, &edit);
        if (status == MXG_OK) {
            build_gold(edit);
            if (leaves_origin)
                mxg_edit_add_element(edit, 0, "nodedef", "ND_new", NULL);
            status = commit(edit, &next);
        }
        bool reached = f.heap.calls - before >= at;
        failures += status == MXG_ERROR_MEMORY;
        REQUIRE(status == MXG_OK || status == MXG_ERROR_DOCUMENT || status == MXG_ERROR_MEMORY);
        mxg_document_destroy(next);
        close_fixture(&f);
        if (!reached)
            break;
    }
    REQUIRE(failures >= (leaves_origin ? 5 : 3));
}

static void test_memory(void)
{
    test_memory_of(false);
    test_memory_of(true);
}

static void (*const tests[])(struct fixture *f) = {
    test_build,      test_edit_of_a_document, test_rename, test_move_and_copy,
    test_refused,    test_completed,          test_types,  test_removed,
    test_diagnostics};

int main(void)
{
    for (size_t i = 0; i < sizeof tests / sizeof *tests; i++) {
        struct fixture f;
        open_fixture(&f);
        tests[i](&f);
        close_fixture(&f);
    }
    test_memory();
    return test_report("api-edit");
}
