// SPDX-License-Identifier: Apache-2.0
/* mxg_edit_define_nodegraph: what the document is afterwards, and that it draws as before. */
#include "documents.h"

#include <mxgen/document.h>

struct fixture {
    mxg_context *context;
    mxg_library *library;
    mxg_document *document;
};

static void open_fixture(struct fixture *f, const char *name, uint32_t max_elements)
{
    const char *text = document_text(name);
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.max_elements = max_elements;
    REQUIRE_EQ(mxg_context_create(&desc, &f->context), MXG_OK);
    f->library = mxg_library_builtin(f->context);
    REQUIRE_EQ(mxg_document_parse(f->context, f->library, name, text, strlen(text), &f->document),
               MXG_OK);
}

static void close_fixture(struct fixture *f)
{
    mxg_document_destroy(f->document);
    mxg_library_unref(f->library);
    mxg_context_destroy(f->context);
}

static mxg_element define(mxg_edit *edit, const char *path, const char *name, const char *node)
{
    return mxg_edit_define_nodegraph(edit, edited_at(edit, path), name, node);
}

static void check_definition(const char *before, const char *path, const char *name,
                             const char *node, const char *after)
{
    struct fixture f;
    mxg_edit *edit = NULL;
    mxg_document *defined = NULL;
    open_fixture(&f, before, 0);
    mxg_edit_create(f.context, f.library, f.document, NULL, &edit);
    mxg_element nodedef = define(edit, path, name, node);
    REQUIRE(nodedef && nodedef == edited_at(edit, name));
    REQUIRE_EQ(commit(edit, &defined), MXG_OK);
    REQUIRE_STR(mxg_document_xml(defined, NULL), document_text(after));
    REQUIRE(draws_the_same(f.context, f.document, defined, "M"));
    mxg_document_destroy(defined);
    close_fixture(&f);
}

/* Nothing reads it and its inputs read nothing, so there is no node of it. */
static void test_unused(void)
{
    struct fixture f;
    mxg_edit *edit = NULL;
    mxg_document *defined = NULL;
    open_fixture(&f, "wood.mtlx", 0);
    mxg_edit_create(f.context, f.library, f.document, NULL, &edit);
    mxg_edit_copy_element(edit, 0, f.document, edited_at(edit, "NG_wood"), "NG_copy");
    REQUIRE(define(edit, "NG_copy", "ND_wood", "wood"));
    REQUIRE(!edited_at(edit, "wood2"));
    REQUIRE(edited_at(edit, "ND_wood/tint") && !edited_at(edit, "NG_copy/tint"));
    REQUIRE_EQ(commit(edit, &defined), MXG_OK);
    mxg_document_destroy(defined);
    close_fixture(&f);
}

/* There is no definition, for a reason, and the document stays as it is. */
static void expect_failure(const struct fixture *f, const char *path, const char *name,
                           const char *node, const char *reason)
{
    char said[256];
    mxg_edit *edit = NULL;
    mxg_document *after = NULL;
    mxg_edit_create(f->context, f->library, f->document, NULL, &edit);
    REQUIRE_EQ(define(edit, path, name, node), 0);
    mxg_edit_error(edit, said, sizeof said);
    if (!REQUIRE(strstr(said, reason)))
        printf("    %s: %s\n", reason, said);
    REQUIRE_EQ(commit(edit, &after), MXG_OK);
    REQUIRE_STR(mxg_document_xml(after, NULL), mxg_document_xml(f->document, NULL));
    mxg_document_destroy(after);
}

static void test_failures(void)
{
    struct fixture f;
    open_fixture(&f, "wood_defined.mtlx", 0);
    expect_failure(&f, "NG_wood", "ND", "wood", "'NG_wood' implements 'ND_wood' already");
    expect_failure(&f, "none", "ND", "wood", "no such element");
    expect_failure(&f, "wood", "ND", "wood", "'wood' is no nodegraph of the root");
    expect_failure(&f, "NG_wood", "wood", "wood", "an element 'wood' already");
    expect_failure(&f, "NG_wood", NULL, "wood", "the name is missing");
    expect_failure(&f, "NG_wood", "ND", "two words", "is no name");
    expect_failure(&f, "NG_wood", "ND", "input", "'input' is an element of MaterialX");
    close_fixture(&f);
    open_fixture(&f, "wood.mtlx", 23);
    expect_failure(&f, "NG_wood", "ND", "wood", "more elements than the context allows");
    close_fixture(&f);
    open_fixture(&f, "references.mtlx", 0);
    expect_failure(&f, "NG", "ND", "kind", "'IM' refers to 'NG' by 'nodegraph'");
    expect_failure(&f, "empty", "ND", "kind", "'empty' has no output");
    close_fixture(&f);
    open_fixture(&f, "reads_itself.mtlx", 0);
    expect_failure(&f, "NG", "ND", "kind", "'NG' reads its own output through 'beside'");
    close_fixture(&f);
    REQUIRE_EQ(mxg_edit_define_nodegraph(NULL, 1, "ND", "wood"), 0);
}

int main(void)
{
    check_definition("grouped.mtlx", "Pattern", "ND_pattern", "pattern", "defined.mtlx");
    check_definition("wood.mtlx", "NG_wood", "ND_wood", "wood", "wood_defined.mtlx");
    test_unused();
    test_failures();
    return test_report("api-edit_define");
}
