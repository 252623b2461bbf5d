// SPDX-License-Identifier: Apache-2.0
/* Edits of documents in which several elements have one name. */
#include "edit_fixture.h"

static unsigned count(const char *text, const char *part)
{
    unsigned num = 0;
    for (; (text = strstr(text, part)) != NULL; text++)
        num++;
    return num;
}

/* The document is as its text: same text, messages and shader, but for what the edit removed. */
static void check_as_parsed(struct fixture *f, const mxg_document *document, unsigned num_elements)
{
    const char *text = mxg_document_xml(document, NULL);
    mxg_document *parsed = parse(f, text);
    mxg_diagnostic one = {sizeof one}, other = {sizeof other};
    const mxg_diagnostics *list = mxg_document_diagnostics(document),
                          *fresh = mxg_document_diagnostics(parsed);
    mxg_result *result, *again;
    REQUIRE_STR(mxg_document_xml(parsed, NULL), text);
    REQUIRE_EQ(count(text, "<constant") + count(text, "<input"), num_elements);
    uint32_t removed = has_diagnostic(list, "removed-reference");
    REQUIRE_EQ(mxg_diagnostics_num_items(list), mxg_diagnostics_num_items(fresh) + removed);
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); i++) { /* the order may differ */
        mxg_diagnostics_item(list, i, &one);
        bool is_found = strcmp(one.id, "removed-reference") == 0;
        for (uint32_t k = 0; k < mxg_diagnostics_num_items(fresh) && !is_found; k++) {
            mxg_diagnostics_item(fresh, k, &other);
            is_found = strcmp(one.message, other.message) == 0;
        }
        REQUIRE(is_found);
    }
    REQUIRE_STR(generate(f, document, "o", &result), generate(f, parsed, "o", &again));
    REQUIRE_EQ(mxg_diagnostics_num_items(mxg_result_diagnostics(result)),
               mxg_diagnostics_num_items(mxg_result_diagnostics(again)));
    mxg_result_destroy(result);
    mxg_result_destroy(again);
    mxg_document_destroy(parsed);
}

enum operation { NOTHING, REMOVE, RENAME, SET_NAME, MOVE, VALUE, NUM_OPERATIONS };

static void change(mxg_edit *edit, mxg_element element, enum operation operation)
{
    mxg_status status = MXG_OK;
    if (operation == REMOVE)
        status = mxg_edit_remove_element(edit, element);
    else if (operation == RENAME)
        status = mxg_edit_rename_element(edit, element, "z");
    else if (operation == SET_NAME)
        status = mxg_edit_set_attribute(edit, element, "name", "z");
    else if (operation == MOVE)
        status = mxg_edit_move_element(edit, element,
                                       mxg_edit_add_element(edit, 0, "nodegraph", "G", NULL), 0);
    else if (operation == VALUE)
        status = mxg_edit_set_attribute(edit, element, "uiname", "x");
    REQUIRE_EQ(status, MXG_OK);
}

/* Three elements of a name, two of which are equal, and comments; each is changed in turn. */
static void test_equal_names(void)
{
    static const char text[] =
        "<materialx version=\"1.39\">"
        "<!-- 1 --><constant name=\"a\" type=\"float\"><input name=\"value\" type=\"float\" "
        "value=\"1\"/><input name=\"value\" type=\"float\" value=\"4\"/></constant>"
        "<!-- 2 --><constant name=\"a\" type=\"float\"><input name=\"value\" type=\"float\" "
        "value=\"2\"/></constant>"
        "<constant name=\"c\" type=\"float\"/>"
        "<!-- 3 --><constant name=\"a\" type=\"float\"><input name=\"value\" type=\"float\" "
        "value=\"2\"/></constant><!-- 4 -->"
        "<add name=\"b\" type=\"float\"><input name=\"in1\" type=\"float\" "
        "nodename=\"a\"/></add><output name=\"o\" type=\"float\" nodename=\"b\"/>"
        "</materialx>";
    static const char *const paths[] = {"a", "a/value", "c", "b"};
    enum { NUM_ELEMENTS = 9 };
    struct fixture f;
    open_fixture(&f);
    mxg_document *document = parse(&f, text);
    check_as_parsed(&f, document, NUM_ELEMENTS);
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++)
        for (int operation = 0; operation < NUM_OPERATIONS; operation++) {
            static const unsigned lost[] = {3, 1, 1, 1};
            if (operation == MOVE && i == 1)
                continue;
            mxg_edit *edit = begin(&f, document);
            mxg_document *edited = NULL;
            change(edit, edited_at(edit, paths[i]), (enum operation)operation);
            /* the next of the name takes its place, also in the same edit */
            REQUIRE((edited_at(edit, paths[i]) != 0)
                    == (i < 2 || operation == NOTHING || operation == VALUE));
            mxg_edit_commit(edit, &edited);
            mxg_edit_destroy(edit);
            check_as_parsed(&f, edited, NUM_ELEMENTS - (operation == REMOVE ? lost[i] : 0));
            mxg_document_destroy(edited);
        }
    mxg_document_destroy(document);
    close_fixture(&f);
}

int main(void)
{
    test_equal_names();
    return test_report("api-equal-names");
}
