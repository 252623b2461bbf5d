// SPDX-License-Identifier: Apache-2.0
/*
 * The checks of open documents, which are those of `mxgen validate`, and their messages at the
 * client. A check has steps, between which the session answers requests.
 */
#ifndef MXG_LSP_DIAGNOSTICS_H
#define MXG_LSP_DIAGNOSTICS_H

#include "lsp/session.h"

/* A file changed: it will be checked, and so will each open document that reads it. */
void diagnostics_expect(struct lsp_session *session, const char *path);

/* A step of the checks that wait. False: none waits. */
bool diagnostics_work(struct lsp_session *session);

/* Ends the checks of a document now, for requests that need its findings. */
void diagnostics_settle(struct lsp_session *session, struct lsp_document *document);

/* Takes the messages of a document, which no list has any more, from the client. */
void diagnostics_forget(struct lsp_session *session, struct lsp_document *document);

#endif
