// SPDX-License-Identifier: Apache-2.0
/* The handlers of all methods, each with the file that has it. */
#ifndef MXG_LSP_HANDLERS_H
#define MXG_LSP_HANDLERS_H

#include "lsp/session.h"

/* session.c */
lsp_handler handle_initialize, handle_nothing, handle_shutdown, handle_exit;
/* documents.c */
lsp_handler handle_open, handle_change, handle_close, handle_save, handle_watched_files;

#endif
