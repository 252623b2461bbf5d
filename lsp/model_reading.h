// SPDX-License-Identifier: Apache-2.0
/* Reading elements from a place of a text on, for the two files of the model. */
#ifndef MXG_LSP_MODEL_READING_H
#define MXG_LSP_MODEL_READING_H

#include "lsp/model.h"

/* A reading: where it is, and the innermost element that is open. */
struct reading {
    struct model *model;
    const char *bytes;
    uint32_t at, len, open;
    uint32_t reach; /* of the start tag that is being read */
};

/* Appends an element that begins at the offset, in the one that is open. */
uint32_t reading_add(struct reading *reading, uint32_t start);
/* Goes to the next '<'. False: there is none. */
bool reading_find(struct reading *reading);
/* Reads what begins with the '<': a tag, a comment, an instruction. */
void reading_take(struct reading *reading);
/* An element that the text ends inside of ends with it. */
void reading_close(struct reading *reading);

#endif
