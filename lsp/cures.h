// SPDX-License-Identifier: Apache-2.0
/* The table of cures (cures.def): what an editor can do about a message. */
#ifndef MXG_LSP_CURES_H
#define MXG_LSP_CURES_H

#include "lsp/session.h"

/* How an editor shows what a message is about: `DiagnosticTag`. */
enum lsp_tag { LSP_NO_TAG = 0, LSP_UNNECESSARY = 1, LSP_DEPRECATED = 2 };

enum lsp_tag cures_tag(const char *id);

#endif
