// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_DOCUMENT_VALIDATE_H
#define MXG_DOCUMENT_VALIDATE_H

#include "document/document.h"

/* Errors that get a suggestion: a document that is wrong throughout is reported in linear time. */
enum { MAX_SUGGESTIONS = 64 };

struct validation {
    const struct document *doc;
    struct diag_list *diags;
    struct arena *arena;
};

/* validate_links.c: what names refer to is there and has the right type; graphs have no cycles. */
void validate_links(struct validation *v);

#endif
