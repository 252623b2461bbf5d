// SPDX-License-Identifier: Apache-2.0
/* Which open documents wait for a check, and the messages of checks at the client. */
#ifndef MXG_LSP_DIAGNOSTICS_H
#define MXG_LSP_DIAGNOSTICS_H

#include "lsp/session.h"

/* A file changed: it will be checked, and so will each open document that reads it. */
void diagnostics_expect(struct lsp_session *session, const char *path);

/* Checks a document now if its check waits, for requests that need its findings. */
void diagnostics_settle(struct lsp_session *session, struct lsp_document *document);

/* Takes the messages of a document, which no list has any more, from the client. */
void diagnostics_forget(struct lsp_session *session, struct lsp_document *document);

/* A finding as a `Diagnostic`; the text is that of its file, and `reader` the document that reads
 * it. */
json_t *diagnostics_json(struct lsp_session *session, const struct lsp_document *reader,
                         const struct text *text, const struct finding *finding);

#endif
