// SPDX-License-Identifier: Apache-2.0
/*
 * The check of an open document, which is that of `mxgen validate`. A check has a copy of all that
 * the editor has open and a context of its own, so it may run in another thread.
 */
#ifndef MXG_LSP_CHECK_DOCUMENT_H
#define MXG_LSP_CHECK_DOCUMENT_H

#include "lsp/disk.h"
#include "lsp/findings.h"
#include "lsp/session.h"

struct lsp_check {
    char *path;       /* of the document */
    uint64_t edition; /* of its text */
    struct disk disk;
    struct store texts;
    size_t index; /* of the document among disk.files */
    mxg_context_desc desc;
    mxg_library *library;
    /* after the check */
    mxg_context *context;
    mxg_document *read; /* NULL: there is none */
    bool is_xml;        /* so that its elements are those of the text */
    struct findings findings;
};

/* The folder of a document decides what it may read; NULL, and what is no file, the workspace. */
const char *check_origin(const struct lsp_document *document);

/* NULL: out of memory. */
struct lsp_check *check_create(const struct lsp_session *session,
                               const struct lsp_document *document);
void check_destroy(struct lsp_check *check);

#endif
