// SPDX-License-Identifier: Apache-2.0
/* The handlers of all methods, each with the file that has it. */
#ifndef MXG_LSP_HANDLERS_H
#define MXG_LSP_HANDLERS_H

#include "lsp/session.h"

/* session.c */
lsp_handler handle_initialize, handle_initialized, handle_nothing, handle_shutdown, handle_exit;
/* documents.c */
lsp_handler handle_open, handle_change, handle_close, handle_save, handle_watched_files;
/* completion.c, hover.c */
lsp_handler handle_completion, handle_hover;
/* navigation.c */
lsp_handler handle_definition, handle_references, handle_highlight, handle_rename,
    handle_prepare_rename;
/* file_names.c */
lsp_handler handle_will_rename;
/* outline.c */
lsp_handler handle_symbols, handle_folding, handle_links;
/* tokens.c, colours.c, hints.c, formatting.c */
lsp_handler handle_tokens, handle_colours, handle_presentations, handle_hints, handle_formatting;
/* actions.c, lenses.c */
lsp_handler handle_actions, handle_lenses, handle_lens;
/* call_hierarchy.c */
lsp_handler handle_prepare_calls, handle_incoming_calls, handle_outgoing_calls;

#endif
