// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_DOCUMENT_VALIDATE_ELEMENTS_H
#define MXG_DOCUMENT_VALIDATE_ELEMENTS_H

#include "document/document.h"

struct validation {
    const struct document *doc;
    struct diag_list *diags;
    struct arena *arena;
    /* already reported that some elements are older than the document's version */
    bool has_age_note;
    /* per text: an <attributedef> declares it as an attribute; NULL until the first lookup */
    uint8_t *declared;
};

/* validate_attributes.c */
void validate_attributes(struct validation *v, elem_id element);

/* validate_geometry.c: checks lists of geometry names and patterns. */
void validate_geometry(struct validation *v, elem_id element);

/*
 * validate_links.c: checks that the targets of top-level references exist and that nodegraphs have
 * no cycles. library/validate_nodes.c checks connections.
 */
void validate_links(struct validation *v);

#endif
