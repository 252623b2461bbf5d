// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_LSP_FORMATTING_H
#define MXG_LSP_FORMATTING_H

#include "lsp/session.h"

/* The edits that rewrite a document; none if it stays as it is; NULL: it cannot be read. */
json_t *formatting_edits(const struct lsp_query *query, mxg_rewriting rewriting);

#endif
