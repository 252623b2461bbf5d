// SPDX-License-Identifier: Apache-2.0
/* The parts of a completion: what fits where the cursor is. */
#ifndef MXG_LSP_COMPLETION_H
#define MXG_LSP_COMPLETION_H

#include "lsp/query.h"

/* `CompletionItemKind` of the protocol. */
enum completion_kind {
    COMPLETE_FUNCTION = 3,
    COMPLETE_FIELD = 5,
    COMPLETE_CLASS = 7,
    COMPLETE_MODULE = 9,
    COMPLETE_PROPERTY = 10,
    COMPLETE_UNIT = 11,
    COMPLETE_VALUE = 12,
    COMPLETE_ENUM = 13,
    COMPLETE_FILE = 17,
    COMPLETE_REFERENCE = 18,
    COMPLETE_FOLDER = 19,
    COMPLETE_TYPE = 25,
};

struct completion {
    struct lsp_query query;
    struct place place;
    struct span replaced; /* the word that an item takes the place of */
    json_t *items;
    json_t *range; /* of the span `ranged`; NULL: none yet */
    struct span ranged;
    bool is_cut; /* there are more items */
};

/* An item has these beside its label; each may be NULL. */
struct completion_item {
    const char *label;
    enum completion_kind kind;
    const char *detail, *doc;
    const char *text;    /* NULL: the label */
    const char *snippet; /* for clients that have snippets; NULL: none */
    const char *filter;  /* what the typed word is compared with; NULL: the label */
    bool is_first;       /* stands before the others */
};
/* Adds an item if it fits what is typed so far. */
void completion_add(struct completion *completion, struct completion_item item);

/* The text of a snippet for a value, with what a snippet reads as its own escaped; freed by the
 * caller. */
char *completion_escape(const char *value);

/* completion_elements.c: elements that fit the place; in a node its inputs. */
void complete_elements(struct completion *completion);
/* completion_attributes.c: attributes that the element lacks. */
void complete_attributes(struct completion *completion);
/* completion_values.c: values of the attribute. */
void complete_values(struct completion *completion);
/* completion_names.c: names of elements, for the attribute of a connection or reference. */
void complete_nodes(struct completion *completion);
void complete_graphs(struct completion *completion);
void complete_outputs(struct completion *completion);
void complete_interface(struct completion *completion);
void complete_materials(struct completion *completion);
/* The elements at the root that the attribute may name. */
void complete_named(struct completion *completion);

#endif
