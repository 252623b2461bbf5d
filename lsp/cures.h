// SPDX-License-Identifier: Apache-2.0
/* The table of cures (cures.def): what an editor can do about a message. */
#ifndef MXG_LSP_CURES_H
#define MXG_LSP_CURES_H

#include "lsp/named_elements.h"
#include "lsp/findings.h"

/* How an editor shows what a message is about: `DiagnosticTag`. */
enum lsp_tag { LSP_NO_TAG = 0, LSP_UNNECESSARY = 1, LSP_DEPRECATED = 2 };

enum lsp_tag cures_tag(const char *id);

/* A finding of a document, what is at its place, and the actions that cure it. */
struct cure {
    struct lsp_query query; /* the offset is that of the place */
    const struct finding *finding;
    struct span span;
    struct place place;
    json_t *diagnostic;
    json_t *actions; /* `CodeAction`s */
    json_t *edits;   /* of the action that is being made */
};

/* Appends the actions for the finding. */
void cures_add(struct cure *cure);

/* ---- For those who make edits (cure_edits.c) ---- */

/* Replaces a part of the text. */
void cure_replace(struct cure *cure, struct span span, const char *text);
/* Removes an attribute with the space before it. */
void cure_remove_attribute(struct cure *cure, const struct model_attribute *attribute);
/* Removes an element, with its line if nothing else is in it. */
void cure_remove_element(struct cure *cure, uint32_t element);
/* Appends an attribute to a start tag, or sets its value. */
void cure_set_attribute(struct cure *cure, uint32_t element, const char *name, const char *value);
/* Gives an element another category, in both of its tags. */
void cure_rename_element(struct cure *cure, uint32_t element, const char *category);
/* Makes an action of the edits since the last one; of none it makes none. */
void cure_finish(struct cure *cure, const char *title, bool is_preferred);

/* An argument of the message, from 0; "" if there is none. */
const char *cure_argument(const struct cure *cure, size_t index);

/* ---- Cures of several elements (cure_graph.c) ---- */

/* Inserts a <convert> between a port and its source. */
void cure_convert(struct cure *cure);
/* Keeps one connection of several: an action for each. */
void cure_keep_one(struct cure *cure);
/* A valid name in place of another one, in all references, too. */
void cure_bad_name(struct cure *cure);

#endif
