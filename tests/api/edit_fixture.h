// SPDX-License-Identifier: Apache-2.0
/* Tests of documents as objects share main.mtlx and short forms of calls. */
#ifndef MXG_TESTS_API_EDIT_FIXTURE_H
#define MXG_TESTS_API_EDIT_FIXTURE_H

#include "documents.h"

static inline mxg_context *open_context(struct heap *heap, struct memory_files *files)
{
    mxg_context *context = NULL;
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.realloc = heap_realloc;
    desc.realloc_user_data = heap;
    mxg_resolver resolver = memory_resolver(files);
    desc.resolver = &resolver;
    REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_OK);
    return context;
}

struct fixture {
    struct heap heap;
    struct memory_files files;
    mxg_context *context;
    mxg_library *library;
    mxg_document *document; /* main.mtlx */
};

static inline void open_fixture(struct fixture *f)
{
    memset(f, 0, sizeof *f);
    f->files.files = documents;
    f->context = open_context(&f->heap, &f->files);
    f->library = mxg_library_builtin(f->context);
    REQUIRE_EQ(mxg_document_load(f->context, f->library, "main.mtlx", &f->document), MXG_OK);
}

static inline void close_fixture(struct fixture *f)
{
    mxg_document_destroy(f->document);
    mxg_library_unref(f->library);
    mxg_context_destroy(f->context);
    REQUIRE_EQ(f->heap.held, 0);
    REQUIRE_EQ(f->heap.wrong_sizes, 0);
}

static inline mxg_document *parse(struct fixture *f, const char *text)
{
    mxg_document *document = NULL;
    mxg_document_parse(f->context, f->library, "text.mtlx", text, strlen(text), &document);
    return document;
}

static inline mxg_edit *begin(struct fixture *f, const mxg_document *from)
{
    mxg_edit *edit = NULL;
    REQUIRE_EQ(mxg_edit_create(f->context, f->library, from, NULL, &edit), MXG_OK);
    return edit;
}

static inline const char *xml_below(const mxg_document *document)
{
    const char *xml = mxg_document_xml(document, NULL);
    const char *root = xml ? strstr(xml, "<materialx") : NULL;
    return root ? root : "";
}

/* NULL: the element has no such attribute. */
static inline const char *attribute_of(const mxg_document *document, mxg_element element,
                                       const char *name)
{
    mxg_attribute found = {sizeof found};
    uint32_t index = mxg_document_find_attribute(document, element, name);
    return mxg_document_attribute(document, element, index, &found) == MXG_OK ? found.value : NULL;
}

/* True if the reason of the last failure contains the text. */
static inline bool failed_for(const mxg_edit *edit, const char *text)
{
    char reason[256];
    size_t len = mxg_edit_error(edit, reason, sizeof reason);
    bool good = REQUIRE_EQ(len, strlen(reason)) && REQUIRE(strstr(reason, text));
    if (!good)
        printf("    %s\n", reason);
    return good;
}

static inline const char *generate(struct fixture *f, const mxg_document *document,
                                   const char *element, mxg_result **out)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "glsl";
    desc.element = element;
    mxg_generate(f->context, document, &desc, out);
    const char *source = mxg_result_source(*out, MXG_STAGE_PIXEL, NULL);
    return source ? source : "";
}

#endif
