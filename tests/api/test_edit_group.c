// SPDX-License-Identifier: Apache-2.0
/* mxg_edit_group_nodes: what the document is afterwards, and that it draws the same. */
#include "documents.h"

#include <mxgen/document.h>

enum { MAX_NODES = 8 };

struct fixture {
    mxg_context *context;
    mxg_library *library;
    mxg_document *loose;
};

static void open_fixture(struct fixture *f, uint32_t max_elements)
{
    const char *text = document_text("loose.mtlx");
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.max_elements = max_elements;
    REQUIRE_EQ(mxg_context_create(&desc, &f->context), MXG_OK);
    f->library = mxg_library_builtin(f->context);
    REQUIRE_EQ(
        mxg_document_parse(f->context, f->library, "loose.mtlx", text, strlen(text), &f->loose),
        MXG_OK);
}

static void close_fixture(struct fixture *f)
{
    mxg_document_destroy(f->loose);
    mxg_library_unref(f->library);
    mxg_context_destroy(f->context);
}

/* paths: ends with NULL */
static mxg_element group(mxg_edit *edit, const char *const *paths, const char *name)
{
    mxg_element nodes[MAX_NODES];
    uint32_t num = 0;
    for (; paths[num]; num++)
        nodes[num] = edited_at(edit, paths[num]);
    return mxg_edit_group_nodes(edit, nodes, num, name);
}

static void test_group(void)
{
    struct fixture f;
    mxg_edit *edit = NULL;
    mxg_document *grouped = NULL;
    open_fixture(&f, 0);
    mxg_edit_create(f.context, f.library, f.loose, NULL, &edit);
    mxg_element graph =
        group(edit, (const char *const[]){"wide", "spots", "in1", "parts", NULL}, "Pattern");
    REQUIRE(graph && graph == edited_at(edit, "Pattern"));
    REQUIRE(!edited_at(edit, "wide"));
    REQUIRE_EQ(commit(edit, &grouped), MXG_OK);
    REQUIRE_STR(mxg_document_xml(grouped, NULL), document_text("grouped.mtlx"));
    REQUIRE(draws_the_same(f.context, f.loose, grouped, "M"));
    mxg_document_destroy(grouped);
    close_fixture(&f);
}

/* The group of the nodes is none, for a reason, and the document stays as it is. */
static void expect_failure(const struct fixture *f, const char *const *paths, const char *name,
                           const char *reason)
{
    char said[256];
    mxg_edit *edit = NULL;
    mxg_document *after = NULL;
    mxg_edit_create(f->context, f->library, f->loose, NULL, &edit);
    REQUIRE_EQ(group(edit, paths, name), 0);
    mxg_edit_error(edit, said, sizeof said);
    if (!REQUIRE(strstr(said, reason)))
        printf("    %s: %s\n", reason, said);
    REQUIRE_EQ(commit(edit, &after), MXG_OK);
    REQUIRE_STR(mxg_document_xml(after, NULL), mxg_document_xml(f->loose, NULL));
    mxg_document_destroy(after);
}

static void test_failures(void)
{
    struct fixture f;
    open_fixture(&f, 34);
    expect_failure(&f, (const char *const[]){NULL}, "G", "there is no node");
    expect_failure(&f, (const char *const[]){"wide", "nothing", NULL}, "G", "no such element");
    expect_failure(&f, (const char *const[]){"wide", NULL}, "low", "an element 'low' already");
    expect_failure(&f, (const char *const[]){"wide", NULL}, "two words", "is no name");
    expect_failure(&f, (const char *const[]){"wide", NULL}, NULL, "the name is missing");
    expect_failure(&f, (const char *const[]){"wide", "wide", NULL}, "G", "'wide' stands twice");
    expect_failure(&f, (const char *const[]){"others", NULL}, "G",
                   "'others' is no node of the root");
    expect_failure(&f, (const char *const[]){"others/one", NULL}, "G",
                   "'one' is no node of the root");
    expect_failure(&f, (const char *const[]){"S", "M", NULL}, "G",
                   "'all' refers to 'M' by 'material'");
    expect_failure(&f, (const char *const[]){"wide", "spots", "in1", "parts", NULL}, "G",
                   "more elements than the context allows");
    REQUIRE_EQ(mxg_edit_group_nodes(NULL, NULL, 0, "G"), 0);
    close_fixture(&f);
}

int main(void)
{
    test_group();
    test_failures();
    return test_report("api-edit_group");
}
