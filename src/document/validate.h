// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_DOCUMENT_VALIDATE_H
#define MXG_DOCUMENT_VALIDATE_H

#include "document/document.h"

enum { VALIDATION_REMEMBERED = 256 };

struct validation {
    const struct document *doc;
    struct diag_list *diags;
    struct arena *arena;
    bool is_age_told; /* that there are elements older than the version that the document says */
    /* per text: an <attributedef> says that it is an attribute; made when the first is asked for */
    uint8_t *declared;
    /* kinds of elements on which an attribute was found to mean something */
    struct good_attribute {
        str_id name;
        uint64_t kinds;
    } good[VALIDATION_REMEMBERED];
};

/* validate_attributes.c */
void validate_attributes(struct validation *v, elem_id element);

/* validate_geometry.c: lists of names and patterns of geometry. */
void validate_geometry(struct validation *v, elem_id element);

/*
 * validate_links.c: top-level elements that others refer to are there; graphs have no cycles.
 * Connections are library/validate.c's.
 */
void validate_links(struct validation *v);

#endif
