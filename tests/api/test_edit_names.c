// SPDX-License-Identifier: Apache-2.0
/* mxg_edit_rename_element: every attribute that names elements follows, and no other one. */
#include "edit_fixture.h"

static const char *const attributes[] = {
#define REFERENCE(attribute, users, targets, place, checked) #attribute,
#include "src/document/references.def"
#undef REFERENCE
};

/* The document has a name that changes in each attribute of the table. */
static void test_table(const char *xml)
{
    for (size_t i = 0; i < sizeof attributes / sizeof *attributes; ++i) {
        char start[64];
        snprintf(start, sizeof start, " %s=\"", attributes[i]);
        bool has_name = false;
        for (const char *at = xml; !has_name && (at = strstr(at, start)) != NULL;) {
            at += strlen(start);
            const char *name = strstr(at, "old_"), *end = strchr(at, '"');
            has_name = name && end && name < end;
        }
        if (!REQUIRE(has_name))
            printf("    %s\n", attributes[i]);
    }
}

/* Renames old_X to new_X, children first. */
static void rename_below(mxg_edit *edit, const mxg_document *document, mxg_element element)
{
    mxg_element_info info = MXG_INIT(mxg_element_info);
    mxg_document_element(document, element, &info);
    mxg_element child = info.first_child;
    while (child) {
        mxg_element_info below = MXG_INIT(mxg_element_info);
        mxg_document_element(document, child, &below);
        rename_below(edit, document, child);
        child = below.next;
    }
    if (strncmp(info.name, "old_", 4) == 0) {
        char name[64];
        snprintf(name, sizeof name, "new_%s", info.name + 4);
        REQUIRE_EQ(mxg_edit_rename_element(edit, element, name), MXG_OK);
    }
}

static void test_all(struct fixture *f)
{
    static char expected[8192];
    mxg_document *d = parse(f, document_text("names.mtlx")), *next = NULL;
    mxg_edit *edit = begin(f, d);
    snprintf(expected, sizeof expected, "%s", xml_below(d));
    test_table(expected);
    for (char *at = expected; (at = strstr(at, "old_")) != NULL;)
        memcpy(at, "new_", 4);
    rename_below(edit, d, mxg_document_find_element(d, 0, ""));
    commit(edit, &next);
    REQUIRE_STR(xml_below(next), expected);
    mxg_document_destroy(next);
    mxg_document_destroy(d);
}

/* Equal names elsewhere are those of other elements. */
static void test_others(struct fixture *f)
{
    static const char text[] =
        "<materialx version='1.39'><unitdef name='u1' unittype='distance'><unit "
        "name='x'/></unitdef>"
        "<unitdef name='u2' unittype='angle'><unit name='x'/></unitdef>"
        "<nodegraph name='G'><surfacematerial name='M' type='material'/>"
        "<backdrop name='b' contains='M'/></nodegraph>"
        "<variantset name='s'><variant name='v'/></variantset>"
        "<variantset name='t'><variant name='v'/></variantset>"
        "<constant name='c' type='float'>"
        "<input name='value' type='float' unit='x' unittype='angle'/></constant>"
        "<look name='L'><materialassign name='a' material='M' geom='/'/>"
        "<variantassign name='w' variantset='t' variant='v'/></look></materialx>";
    static const char *const renamed[] = {"u1/x", "G/M", "s/v"};
    mxg_document *d = parse(f, text), *next = NULL;
    mxg_edit *edit = begin(f, d);
    for (size_t i = 0; i < sizeof renamed / sizeof *renamed; ++i)
        REQUIRE_EQ(mxg_edit_rename_element(edit, edited_at(edit, renamed[i]), "y"), MXG_OK);
    commit(edit, &next);
    REQUIRE_STR(attribute_of(next, element_at(next, "c/value"), "unit"), "x");
    REQUIRE_STR(attribute_of(next, element_at(next, "L/a"), "material"), "M");
    REQUIRE_STR(attribute_of(next, element_at(next, "L/w"), "variant"), "v");
    REQUIRE_STR(attribute_of(next, element_at(next, "G/b"), "contains"), "y");
    mxg_document_destroy(next);
    mxg_document_destroy(d);
}

/* Whoever has a port of a definition has it by the new name. */
static void test_ports(struct fixture *f)
{
    static char expected[8192];
    mxg_document *d = parse(f, document_text("ports.mtlx")), *next = NULL;
    mxg_edit *edit = begin(f, d);
    snprintf(expected, sizeof expected, "%s", xml_below(d));
    REQUIRE_EQ(mxg_edit_rename_element(edit, edited_at(edit, "ND_p/old"), "now"), MXG_OK);
    REQUIRE_EQ(commit(edit, &next), MXG_OK);
    for (char *at = expected; (at = strstr(at, "\"old\"")) != NULL; ++at) {
        const char *other = strstr(at, "doc=\"other\"");
        if (!other || other > strchr(at, '>'))
            memcpy(at, "\"now\"", 5);
    }
    REQUIRE_STR(xml_below(next), expected);
    mxg_document_destroy(next);
    mxg_document_destroy(d);
}

/* A port that some of them have already is no new name. */
static void test_taken_port(struct fixture *f)
{
    mxg_document *d =
        parse(f, "<materialx version='1.39'><nodedef name='ND_p' node='p'>"
                 "<token name='old' type='string'/><output name='out' type='float'/></nodedef>"
                 "<p name='P' type='float'><token name='old' type='string' value='a'/></p>"
                 "<p name='Q' type='float'><token name='old' type='string' value='b'/>"
                 "<input name='now' type='float' value='1'/></p></materialx>");
    mxg_edit *edit = begin(f, d);
    const mxg_element token = edited_at(edit, "ND_p/old");
    REQUIRE_EQ(mxg_edit_rename_element(edit, token, "now"), MXG_ERROR_ARGUMENT);
    REQUIRE(failed_for(edit, "'Q' has the port, too, and an element 'now' already"));
    REQUIRE(edited_at(edit, "ND_p/old") && edited_at(edit, "P/old"));
    REQUIRE_EQ(mxg_edit_rename_element(edit, token, "then"), MXG_OK);
    REQUIRE(edited_at(edit, "P/then") && edited_at(edit, "Q/then"));
    REQUIRE_EQ(mxg_edit_rename_element(edit, token, "again"), MXG_OK);
    REQUIRE(edited_at(edit, "P/again") && edited_at(edit, "Q/again"));
    mxg_edit_destroy(edit);
    mxg_document_destroy(d);
}

/* A frame contains what stands in the place of its nodes. */
static void test_frames(struct fixture *f)
{
    mxg_document *next = NULL,
                 *d = parse(f, "<materialx version='1.39'><constant name='a' type='float'/>"
                               "<constant name='b' type='float'/><constant name='c' type='float'/>"
                               "<constant name='d' type='float'/>"
                               "<backdrop name='f' contains='a, b, c'/>"
                               "<backdrop name='g' contains='d'/></materialx>");
    mxg_edit *edit = begin(f, d);
    const mxg_element pair[] = {edited_at(edit, "a"), edited_at(edit, "c")};
    REQUIRE_EQ(mxg_edit_remove_element(edit, edited_at(edit, "d")), MXG_OK);
    mxg_element graph = mxg_edit_group_nodes(edit, pair, 2, "G");
    REQUIRE(graph != 0);
    REQUIRE_EQ(mxg_edit_move_element(edit, edited_at(edit, "b"), graph, 0), MXG_OK);
    REQUIRE_EQ(commit(edit, &next), MXG_OK);
    REQUIRE_STR(attribute_of(next, element_at(next, "f"), "contains"), "G");
    REQUIRE(!attribute_of(next, element_at(next, "g"), "contains"));
    mxg_document_destroy(next);
    mxg_document_destroy(d);
}

int main(void)
{
    struct fixture f;
    open_fixture(&f);
    test_all(&f);
    test_others(&f);
    test_ports(&f);
    test_taken_port(&f);
    test_frames(&f);
    close_fixture(&f);
    return test_report("api-edit_names");
}
