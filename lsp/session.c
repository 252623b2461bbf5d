// SPDX-License-Identifier: Apache-2.0
/* The life of a session, and the way of a message to its handler. */
#include "lsp/session.h"

#include "lsp/catalogue.h"
#include "lsp/disk.h"
#include "lsp/handlers.h"
#include "lsp/wire.h"
#include "program/cli.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_ERRORS = 1000 }; /* of a document; an editor shows all that it gets */

struct lsp_session *lsp_session_create(const struct lsp_desc *desc)
{
    struct lsp_session *session = memory_alloc(sizeof *session);
    session->desc = *desc;
    session->desc.library = mxg_library_ref(desc->library);
    session->desc.context.max_errors = MAX_ERRORS;
    if (mxg_context_create(&session->desc.context, &session->context) == MXG_OK)
        return session;
    lsp_session_destroy(session);
    return NULL;
}

static void free_folders(struct lsp_session *session)
{
    for (size_t i = 0; i < session->num_folders; ++i)
        free(session->folders[i]);
    free(session->folders);
    session->folders = NULL;
    session->num_folders = 0;
}

void lsp_session_destroy(struct lsp_session *session)
{
    if (!session)
        return;
    while (session->documents) {
        struct lsp_document *document = session->documents;
        session->documents = document->next;
        lsp_document_destroy(document);
    }
    free_folders(session);
    free(session->render_command);
    catalogue_destroy(session->catalogue);
    mxg_library_unref(session->desc.library);
    mxg_context_destroy(session->context);
    disk_close(&session->disk);
    free(session);
}

bool lsp_session_prepare(struct lsp_session *session)
{
    return session->is_initialised && catalogue_prepare(session);
}

bool lsp_session_is_over(const struct lsp_session *session, bool *out_is_clean)
{
    *out_is_clean = session->is_shut_down;
    return session->is_over;
}

/* ---- Messages ---- */

/* Takes ownership of the message. */
static void send_message(struct lsp_session *session, json_t *message)
{
    json_object_set_new(message, "jsonrpc", json_string("2.0"));
    char *bytes = json_dumps(message, JSON_STYLE);
    if (bytes)
        session->desc.send(session->desc.user_data, bytes, strlen(bytes));
    free(bytes);
    json_decref(message);
}

void lsp_notify(struct lsp_session *session, const char *method, json_t *params)
{
    json_t *message = json_object();
    json_object_set_new(message, "method", json_string(method));
    json_object_set_new(message, "params", params);
    send_message(session, message);
}

static void send_error(struct lsp_session *session, const json_t *id, struct lsp_error error)
{
    json_t *message = json_object(), *object = json_object();
    json_object_set_new(object, "code", json_integer(error.code));
    json_object_set_new(object, "message", json_text(error.message));
    json_object_set_new(message, "id", id ? json_deep_copy(id) : json_null());
    json_object_set_new(message, "error", object);
    send_message(session, message);
}

static const struct lsp_method *find_method(const char *name)
{
    for (size_t i = 0; i < lsp_num_methods; ++i)
        if (strcmp(lsp_methods[i].name, name) == 0)
            return &lsp_methods[i];
    return NULL;
}

/* Why a method has no answer now; code 0: it has one. */
static struct lsp_error refuse(const struct lsp_session *session, const char *name,
                               const struct lsp_method *method)
{
    if (!session->is_initialised && strcmp(name, "initialize") != 0)
        return (struct lsp_error){LSP_NOT_INITIALISED, "the first request is 'initialize'"};
    if (session->is_initialised && strcmp(name, "initialize") == 0)
        return (struct lsp_error){LSP_INVALID_REQUEST, "the session is initialised already"};
    if (session->is_shut_down)
        return (struct lsp_error){LSP_INVALID_REQUEST, "the session is shut down"};
    if (!method)
        return (struct lsp_error){LSP_UNKNOWN_METHOD, "the server has no such method"};
    return (struct lsp_error){0};
}

static void answer(struct lsp_session *session, const char *name, const json_t *id,
                   const json_t *params)
{
    const struct lsp_method *method = find_method(name);
    struct lsp_error error = refuse(session, name, method);
    bool is_exit = method && method->handle == handle_exit;
    json_t *result = NULL;
    if (!error.code || is_exit)
        result = method->handle(session, params, &error);
    if (!id) {
        json_decref(result);
        return;
    }
    if (error.code) {
        json_decref(result);
        send_error(session, id, error);
        return;
    }
    json_t *message = json_object();
    json_object_set_new(message, "id", json_deep_copy(id));
    json_object_set_new(message, "result", result ? result : json_null());
    send_message(session, message);
}

void lsp_session_handle(struct lsp_session *session, const char *message, size_t size)
{
    json_error_t fault;
    json_t *object = json_loadb(message, size, JSON_ALLOW_NUL, &fault);
    const json_t *id = json_object_get(object, "id");
    if (!object)
        send_error(session, NULL, (struct lsp_error){-32700, fault.text});
    else if (json_is_string(json_object_get(object, "method")))
        answer(session, json_text_of(object, "method"), id, json_object_get(object, "params"));
    else if (!json_is_object(object)
             || (!json_object_get(object, "result") && !json_object_get(object, "error")))
        send_error(session, id,
                   (struct lsp_error){LSP_INVALID_REQUEST, "the message has no method"});
    json_decref(object);
}

/* ---- The first and the last messages ---- */

static void add_folder(struct lsp_session *session, const char *uri)
{
    char *path = wire_path(uri);
    if (!path)
        return;
    MEMORY_PUSH(session->folders, session->num_folders, path);
}

static void read_folders(struct lsp_session *session, const json_t *params)
{
    const json_t *folders = json_object_get(params, "workspaceFolders"), *folder;
    size_t index;
    json_array_foreach(folders, index, folder) add_folder(session, json_text_of(folder, "uri"));
    if (!session->num_folders)
        add_folder(session, json_text_of(params, "rootUri"));
}

static bool has_encoding(const json_t *capabilities, const char *name)
{
    const json_t *encodings =
                     json_object_get(json_object_get(capabilities, "general"), "positionEncodings"),
                 *encoding;
    size_t index;
    bool has = false;
    json_array_foreach(encodings, index, encoding)
    {
        const char *text = json_string_value(encoding);
        has |= text && strcmp(text, name) == 0;
    }
    return has;
}

static json_t *list_capabilities(const struct lsp_session *session)
{
    json_t *capabilities = json_object();
    json_object_set_new(capabilities, "positionEncoding",
                        json_string(session->is_utf8 ? "utf-8" : "utf-16"));
    for (size_t i = 0; i < lsp_num_methods; ++i)
        if (lsp_methods[i].capability)
            json_object_set_new(capabilities, lsp_methods[i].capability,
                                json_loads(lsp_methods[i].options, JSON_DECODE_ANY, NULL));
    return capabilities;
}

json_t *handle_initialize(struct lsp_session *session, const json_t *params,
                          struct lsp_error *error)
{
    const json_t *capabilities = json_object_get(params, "capabilities"),
                 *completion = json_object_get(
                     json_object_get(json_object_get(capabilities, "textDocument"), "completion"),
                     "completionItem");
    session->is_utf8 = has_encoding(capabilities, "utf-8");
    const json_t *watching =
        json_object_get(json_object_get(capabilities, "workspace"), "didChangeWatchedFiles");
    session->can_watch = json_is_true(json_object_get(watching, "dynamicRegistration"));
    session->has_snippets = json_is_true(json_object_get(completion, "snippetSupport"));
    const char *render =
        json_text_of(json_object_get(params, "initializationOptions"), "renderCommand");
    session->render_command = render && *render ? cli_format("%s", render) : NULL;
    read_folders(session, params);
    if (!disk_open(&session->disk, &session->desc.context, session->folders,
                   session->num_folders)) {
        *error = (struct lsp_error){LSP_REQUEST_FAILED, "out of memory"};
        return NULL;
    }
    session->is_initialised = true;
    json_t *result = json_object(), *info = json_object();
    json_object_set_new(info, "name", json_string("mxgen"));
    json_object_set_new(info, "version", json_string(mxg_version_string()));
    json_object_set_new(result, "capabilities", list_capabilities(session));
    json_object_set_new(result, "serverInfo", info);
    return result;
}

/* The client tells changes of files on the disk: textures, included documents. */
json_t *handle_initialized(struct lsp_session *session, const json_t *params,
                           struct lsp_error *error)
{
    (void)params;
    (void)error;
    if (!session->can_watch)
        return NULL;
    json_t *message =
        json_pack("{s:s, s:s, s:{s:[{s:s, s:s, s:{s:[{s:s}]}}]}}", "id", "watch", "method",
                  "client/registerCapability", "params", "registrations", "id", "watch", "method",
                  "workspace/didChangeWatchedFiles", "registerOptions", "watchers", "globPattern",
                  "**/*.{mtlx,png,jpg,jpeg,exr,hdr,tif,tiff,tx,tga,bmp,ies,glsl}");
    send_message(session, message);
    return NULL;
}

json_t *handle_nothing(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    (void)session;
    (void)params;
    (void)error;
    return NULL;
}

json_t *handle_shutdown(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    (void)params;
    (void)error;
    session->is_shut_down = true;
    return NULL;
}

json_t *handle_exit(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    (void)params;
    *error = (struct lsp_error){0};
    session->is_over = true;
    return NULL;
}
