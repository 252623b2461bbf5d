// SPDX-License-Identifier: Apache-2.0
/* The methods that the server answers. */
#include "lsp/handlers.h"

const struct lsp_method lsp_methods[] = {
    {"initialize", handle_initialize, NULL, NULL},
    {"initialized", handle_nothing, NULL, NULL},
    {"shutdown", handle_shutdown, NULL, NULL},
    {"exit", handle_exit, NULL, NULL},
    {"textDocument/didOpen", handle_open, "textDocumentSync",
     "{\"openClose\":true,\"change\":2,\"save\":true}"},
    {"textDocument/didChange", handle_change, NULL, NULL},
    {"textDocument/didClose", handle_close, NULL, NULL},
    {"textDocument/didSave", handle_save, NULL, NULL},
    {"workspace/didChangeWatchedFiles", handle_watched_files, NULL, NULL},
    {"workspace/didChangeConfiguration", handle_nothing, NULL, NULL},
};
const size_t lsp_num_methods = sizeof lsp_methods / sizeof *lsp_methods;
