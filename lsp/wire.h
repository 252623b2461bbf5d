// SPDX-License-Identifier: Apache-2.0
/* The types of the protocol as JSON. */
#ifndef MXG_LSP_WIRE_H
#define MXG_LSP_WIRE_H

#include "lsp/session.h"

json_t *wire_position(const struct lsp_session *session, const struct text *text, uint32_t offset);
json_t *wire_range(const struct lsp_session *session, const struct text *text, struct span span);
/* A `Location`. */
json_t *wire_location(const struct lsp_session *session, const char *uri, const struct text *text,
                      struct span span);
/* A `TextEdit`. */
json_t *wire_edit(const struct lsp_session *session, const struct text *text, struct span span,
                  const char *new_text);
/* A `WorkspaceEdit` without edits. */
json_t *wire_workspace_edit(void);
/* Adds edits of a document, if there are some, and takes ownership of them. Returns the whole. */
json_t *wire_add_edits(json_t *workspace_edit, const char *uri, json_t *edits);
/* The text of a span. */
json_t *wire_span(const struct text *text, struct span span);
/* A `MarkupContent`; the value is Markdown. */
json_t *wire_markdown(const char *value);

/* Reads a position, or the range `range` of an object, as offsets. False: it is none. */
bool wire_read_position(const struct lsp_session *session, const struct text *text,
                        const json_t *position, uint32_t *out);
bool wire_read_range(const struct lsp_session *session, const struct text *text,
                     const json_t *range, struct span *out);

/* The path of a file address; NULL: it is none. The caller frees it. */
char *wire_path(const char *uri);
/* The address of an absolute path. The caller frees it. */
char *wire_uri(const char *path);

#endif
