// SPDX-License-Identifier: Apache-2.0
/* The parts of the server share this: the session, its documents, and how a method is answered. */
#ifndef MXG_LSP_SESSION_H
#define MXG_LSP_SESSION_H

#include "lsp/disk.h"
#include "lsp/findings.h"
#include "lsp/lsp.h"
#include "lsp/model.h"
#include "lsp/edited_text.h"
#include "program/args.h"
#include "program/json_values.h"

struct catalogue;

/* A document that the editor has open. */
struct lsp_document {
    struct lsp_document *next;
    char *uri, *path; /* path: absolute, without "." and ".."; the address if it is no file */
    json_int_t version;
    struct text text;
    struct model model;
    bool is_file;
    bool is_dirty;           /* its check waits */
    uint64_t edition;        /* of all that it depends on */
    struct lsp_check *check; /* of the last text that was XML, or else of the first; may be NULL */
    mxg_document *parsed;    /* what that check read; NULL: nothing yet */
    struct findings findings;
    struct arg_list told; /* the files of which the client has messages of this document */
};

struct lsp_session {
    struct lsp_desc desc;
    mxg_context *context; /* reads no files */
    struct disk disk;
    uint64_t num_editions;
    struct catalogue *catalogue;
    struct lsp_document *documents;
    char **folders; /* of the workspace */
    size_t num_folders;
    char *render_command;                  /* of the client, for lenses; NULL: it has none */
    bool is_utf8, has_snippets, can_watch; /* of the client */
    bool is_initialised, is_shut_down, is_over;
};

/* An error of the protocol. */
struct lsp_error {
    int code; /* 0: there is none */
    const char *message;
};

enum {
    LSP_INVALID_REQUEST = -32600,
    LSP_UNKNOWN_METHOD = -32601,
    LSP_INVALID_PARAMS = -32602,
    LSP_NOT_INITIALISED = -32002,
    LSP_REQUEST_FAILED = -32803,
};

/* Answers a request: a new value, NULL for `null`. Of a notification the answer is NULL. */
typedef json_t *lsp_handler(struct lsp_session *session, const json_t *params,
                            struct lsp_error *error);

/* A row of the table of methods (methods.c). */
struct lsp_method {
    const char *name;
    lsp_handler *handle;
    const char *capability; /* key of the server's capabilities; NULL: it has none */
    const char *options;    /* its value as JSON */
};
extern const struct lsp_method lsp_methods[];
extern const size_t lsp_num_methods;

void lsp_notify(struct lsp_session *session, const char *method, json_t *params);

/* ---- documents.c ---- */

/* The open document of an address or a path; NULL: it is not open. */
struct lsp_document *lsp_find_document(const struct lsp_session *session, const char *uri);
struct lsp_document *lsp_find_path(const struct lsp_session *session, const char *path);
void lsp_document_destroy(struct lsp_document *document);

/* The text of a file: that of the editor, or that on the disk, which `out_own` has to finish. */
const struct text *lsp_file_text(struct lsp_session *session, const struct lsp_document *reader,
                                 const char *path, struct text *out_own);
/* The address of a file, as the editor knows it. The caller frees it. */
char *lsp_file_uri(const struct lsp_session *session, const char *path);

/* A request at a place of an open document. */
struct lsp_query {
    struct lsp_session *session;
    struct lsp_document *document;
    const struct text *text;
    const struct model *model;
    uint32_t offset;
};
/* Reads `textDocument` and, if there is one, `position`. False: the document is not open. */
bool lsp_query(struct lsp_session *session, const json_t *params, struct lsp_query *out,
               struct lsp_error *error);

#endif
