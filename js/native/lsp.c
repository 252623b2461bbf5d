// SPDX-License-Identifier: Apache-2.0
/* The language server for JavaScript. Its messages go to the import `write`, a piece each. */
#include "lsp/lsp.h"

#include "lsp/system.h"
#include "native/host.h"
#include "program/json_values.h"
#include "program/memory.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* The number of the callbacks of the session that works. */
static void *host;

static void send_message(void *user_data, const char *message, size_t size)
{
    (void)user_data;
    host_write(NULL, message, size);
}

/* The texts of `desc` outlive the session. NULL: `desc` has an unknown word or value. */
MXG_API struct lsp_session *mxgen_js_lsp_create(const mxg_context_desc *desc, mxg_library *library,
                                                const char *messages_url);
MXG_API void mxgen_js_lsp_destroy(struct lsp_session *session);
MXG_API void mxgen_js_lsp_handle(struct lsp_session *session, void *session_host,
                                 const char *message, size_t size);
/* Does a part of the work that no message waits for. False: there is no more. */
MXG_API bool mxgen_js_lsp_work(struct lsp_session *session, void *session_host);

struct lsp_session *mxgen_js_lsp_create(const mxg_context_desc *desc, mxg_library *library,
                                        const char *messages_url)
{
    json_use_memory();
    return lsp_session_create(&(struct lsp_desc){
        .context = *desc, .library = library, .send = send_message, .messages_url = messages_url});
}

void mxgen_js_lsp_destroy(struct lsp_session *session)
{
    lsp_session_destroy(session);
}

void mxgen_js_lsp_handle(struct lsp_session *session, void *session_host, const char *message,
                         size_t size)
{
    host = session_host;
    lsp_session_handle(session, message, size);
}

bool mxgen_js_lsp_work(struct lsp_session *session, void *session_host)
{
    host = session_host;
    struct lsp_check *check = lsp_session_begin_check(session);
    if (!check)
        return lsp_session_prepare(session);
    lsp_check_run(check);
    lsp_session_end_check(session, check);
    return true;
}

/* ---- lsp/system.h ---- */

char *system_read(const char *path, size_t limit, size_t *out_size)
{
    mxg_blob blob = {0};
    const char *reason;
    if (!host_open(host, "", path, &blob, &reason)) {
        errno = ENOENT;
        return NULL;
    }
    size_t size = limit && blob.size > limit ? limit : blob.size;
    char *data = memory_alloc(size + 1);
    memcpy(data, blob.data, size);
    host_release(host, &blob);
    *out_size = size;
    return data;
}

size_t system_list(const char *folder, char *names, size_t capacity)
{
    return host_list_folder(host, "", folder, names, capacity);
}

bool system_is_link(const char *path)
{
    (void)path;
    return false;
}
