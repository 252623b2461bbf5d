// SPDX-License-Identifier: Apache-2.0
/*
 * A language server for MaterialX documents (LSP 3.17, docs/lsp.md). Messages come and go as texts,
 * without frames, so the host chooses how they travel. One thread at a time uses a session.
 */
#ifndef MXG_LSP_LSP_H
#define MXG_LSP_LSP_H

#include <mxgen/mxgen.h>

struct lsp_session;

struct lsp_desc {
    /* for the contexts of the session; checks replace `resolver`. The texts outlive the session */
    mxg_context_desc context;
    mxg_library *library; /* the session takes a reference */
    /* takes a message to the client: JSON, without a NUL */
    void (*send)(void *user_data, const char *message, size_t size);
    void *user_data;
    const char *messages_url; /* the page of all messages; NULL: messages have no links */
    /* the folder with the pictures of nodes, "noise2d.png": an absolute path; NULL: there are none
     */
    const char *pictures;
};

/* NULL: the context cannot be made. */
struct lsp_session *lsp_session_create(const struct lsp_desc *desc);
void lsp_session_destroy(struct lsp_session *session);

/* Takes a message of the client and answers it. A message that is no JSON has an error as answer.
 */
void lsp_session_handle(struct lsp_session *session, const char *message, size_t size);

/*
 * The check of a changed document; NULL: none waits. The session goes on while it runs; `run` may
 * be called in another thread. A check whose document changed meanwhile has no effect, and another
 * one waits. Each check that begins ends before the session does.
 */
struct lsp_check;
struct lsp_check *lsp_session_begin_check(struct lsp_session *session);
void lsp_check_run(struct lsp_check *check);
void lsp_session_end_check(struct lsp_session *session, struct lsp_check *check);

/* Does work that the first request would wait for. False: there is none. */
bool lsp_session_prepare(struct lsp_session *session);

/* True after the notification `exit`; *out_is_clean tells whether `shutdown` came before it. */
bool lsp_session_is_over(const struct lsp_session *session, bool *out_is_clean);

#endif
