// SPDX-License-Identifier: Apache-2.0
/* A check found this in a document and in the files that it includes. */
#ifndef MXG_LSP_FINDINGS_H
#define MXG_LSP_FINDINGS_H

#include "lsp/edited_text.h"
#include "program/store.h"

#include <mxgen/mxgen.h>

struct finding_note {
    const char *message;
    const char *path; /* of the file; NULL: the note has no place */
    uint32_t line, column, length;
};

struct finding {
    const char *id, *message;
    mxg_severity severity;
    const char *path;              /* of the file that has the fault */
    uint32_t line, column, length; /* as in mxg_diagnostic */
    const char *const *arguments;
    size_t num_arguments;
    struct finding_note *notes;
    size_t num_notes;
};

struct findings {
    struct store store;
    struct finding *items;
    size_t len;
};

/*
 * Appends the messages of a list, each once, with its notes; `path` is the document, which has the
 * messages without a file. Remarks are left out, as `mxgen validate` leaves them out.
 */
void findings_add(struct findings *findings, const mxg_diagnostics *list, const char *path);
void findings_clear(struct findings *findings);

/* The part of the text, which is that of the file. */
struct span findings_span(const struct text *text, uint32_t line, uint32_t column, uint32_t length);

#endif
