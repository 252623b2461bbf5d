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
    {"textDocument/completion", handle_completion, "completionProvider",
     "{\"triggerCharacters\":[\"<\",\"\\\"\",\"/\",\" \"]}"},
    {"textDocument/hover", handle_hover, "hoverProvider", "true"},
    {"textDocument/definition", handle_definition, "definitionProvider", "true"},
    {"textDocument/references", handle_references, "referencesProvider", "true"},
    {"textDocument/documentHighlight", handle_highlight, "documentHighlightProvider", "true"},
    {"textDocument/rename", handle_rename, "renameProvider", "{\"prepareProvider\":true}"},
    {"textDocument/prepareRename", handle_prepare_rename, NULL, NULL},
    {"textDocument/documentSymbol", handle_symbols, "documentSymbolProvider", "true"},
    {"textDocument/foldingRange", handle_folding, "foldingRangeProvider", "true"},
    {"textDocument/documentLink", handle_links, "documentLinkProvider", "{}"},
    {"textDocument/semanticTokens/full", handle_tokens, "semanticTokensProvider",
     "{\"full\":true,\"legend\":{\"tokenTypes\":[\"function\",\"type\",\"variable\",\"parameter\","
     "\"number\",\"keyword\"],\"tokenModifiers\":[\"declaration\"]}}"},
    {"textDocument/documentColor", handle_colours, "colorProvider", "true"},
    {"textDocument/colorPresentation", handle_presentations, NULL, NULL},
    {"textDocument/codeAction", handle_actions, "codeActionProvider",
     "{\"codeActionKinds\":[\"quickfix\",\"source.upgrade\"]}"},
    {"textDocument/inlayHint", handle_hints, "inlayHintProvider", "true"},
    {"textDocument/formatting", handle_formatting, "documentFormattingProvider", "true"},
    {"textDocument/prepareCallHierarchy", handle_prepare_calls, "callHierarchyProvider", "true"},
    {"callHierarchy/incomingCalls", handle_incoming_calls, NULL, NULL},
    {"callHierarchy/outgoingCalls", handle_outgoing_calls, NULL, NULL},
};
const size_t lsp_num_methods = sizeof lsp_methods / sizeof *lsp_methods;
