// SPDX-License-Identifier: Apache-2.0
/*
 * The elements of a text that is being written, so it may be broken anywhere: a tag without an end,
 * an attribute without a value, an element that nothing closes. The reader keeps what it can read
 * before and after a fault. It is no check: the library reports faults.
 */
#ifndef MXG_LSP_MODEL_H
#define MXG_LSP_MODEL_H

#include "lsp/edited_text.h"

#define MODEL_NONE 0xffffffffu

struct model_attribute {
    struct span name;
    struct span value; /* without quotes; empty if there is none */
    uint32_t end;      /* after the closing quote, or where it is missing */
    bool has_value;
    bool is_closed; /* the closing quote is there */
};

struct model_element {
    struct span name; /* empty while only '<' is written; of a comment empty */
    uint32_t start;   /* of the '<' */
    uint32_t tag_end; /* after the '>' of the start tag, or where it is missing */
    uint32_t close;   /* of the '</', or `end` if there is none */
    uint32_t end;     /* after the element with its end tag */
    uint32_t parent;  /* MODEL_NONE: it is at the top */
    uint32_t after;   /* the element after this one and all in it */
    uint32_t first_attribute, num_attributes;
    uint32_t depth; /* 0 at the top */
    uint32_t reach; /* how far its start tag looked for a quote that is missing; 0: none is */
    bool is_comment;
    bool is_empty;  /* "<a/>" */
    bool is_broken; /* its start tag has no '>' */
};

/* Elements in the order of the text, so those in an element follow it, up to `after`. */
struct model {
    struct model_element *elements;
    uint32_t num_elements, capacity_elements;
    struct model_attribute *attributes;
    uint32_t num_attributes, capacity_attributes;
    bool has_reach; /* an element may have one */
};

void model_read(struct model *model, const struct text *text);
/*
 * Reads a text again after a change: `old` is what was there, before the change, and new_end is
 * where the new text ends. The result is that of model_read; the time is mostly that of the element
 * below the root that has the change.
 */
void model_update(struct model *model, const struct text *text, struct span old, uint32_t new_end);
void model_finish(struct model *model);

/* The innermost element at an offset, at its begin or inside; MODEL_NONE: there is none. */
uint32_t model_element_at(const struct model *model, uint32_t offset);

/* The first element in another one, and the next beside it, without comments; MODEL_NONE: none. */
uint32_t model_first(const struct model *model, uint32_t parent);
uint32_t model_next(const struct model *model, uint32_t element);

#endif
