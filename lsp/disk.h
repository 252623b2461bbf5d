// SPDX-License-Identifier: Apache-2.0
/*
 * The files that documents name. What the editor has open stands for the file on the disk. Files
 * are in or below the folder of the document or the folders of the workspace; links are resolved
 * before paths are compared (mxg_context_file_fault).
 */
#ifndef MXG_LSP_DISK_H
#define MXG_LSP_DISK_H

#include "lsp/session.h"

/* The path of `ref` beside the file `from`, without "." and "..". The caller frees it. */
char *disk_join(const char *from, const char *ref);

/* Makes session->gate for the folders of the workspace. False: out of memory. */
bool disk_open_gate(struct lsp_session *session);

mxg_resolver disk_resolver(struct lsp_session *session);

/*
 * The file whose folder a document may read, for session->from. Documents of the editor that are no
 * files may read the workspace alone.
 */
const char *disk_origin(const struct lsp_document *document);

/* True if the document may read what `from`, one of its files, names, or if that does not exist. */
bool disk_may_read(struct lsp_session *session, const struct lsp_document *document,
                   const char *from, const char *ref);

/*
 * The bytes of a file that the document may read, with a NUL after them, which the caller frees;
 * NULL: there is none. At most `limit` bytes from its begin; 0: all.
 */
char *disk_read_beside(struct lsp_session *session, const struct lsp_document *document,
                       const char *path, size_t limit, size_t *out_size);

/* A list of names in a folder of the document, each with its NUL; folders end with '/'. */
char *disk_list_beside(struct lsp_session *session, const struct lsp_document *document,
                       const char *folder, size_t *out_size);

#endif
