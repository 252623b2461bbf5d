// SPDX-License-Identifier: Apache-2.0
/* Reading a model by names: attributes, children, and what is under the cursor. */
#ifndef MXG_LSP_QUERY_H
#define MXG_LSP_QUERY_H

#include "lsp/session.h"

/* True if the text of a span is the word. */
bool query_equals(const struct text *text, struct span span, const char *word);
bool query_is_same(const struct text *text, struct span a, struct span b);

/* MODEL_NONE of MODEL_NONE. */
uint32_t query_parent(const struct lsp_query *query, uint32_t element);
/* True if the element has this category. */
bool query_is(const struct lsp_query *query, uint32_t element, const char *category);
/* The attribute; NULL: the element, which may be MODEL_NONE, has none of this name. */
const struct model_attribute *query_attribute(const struct lsp_query *query, uint32_t element,
                                              const char *name);
/* Its value; empty if there is none. */
struct span query_value(const struct lsp_query *query, uint32_t element, const char *name);
/* Its value as a text in a buffer, cut to its size. */
const char *query_text(const struct lsp_query *query, uint32_t element, const char *name,
                       char *buffer, size_t capacity);
const char *query_category(const struct lsp_query *query, uint32_t element, char *buffer,
                           size_t capacity);

/* The child of this name; MODEL_NONE: there is none. `parent` may be MODEL_NONE. */
uint32_t query_child(const struct lsp_query *query, uint32_t parent, struct span name);
/* The child of this category and name. */
uint32_t query_child_of(const struct lsp_query *query, uint32_t parent, const char *category,
                        struct span name);
/* The element of this name at the root of the document. */
uint32_t query_at_root(const struct lsp_query *query, struct span name);
/* <materialx>; MODEL_NONE: there is none. */
uint32_t query_root(const struct lsp_query *query);
/* The element itself or the innermost one around it of this category. */
uint32_t query_around(const struct lsp_query *query, uint32_t element, const char *category);
/* True if the category is none of MaterialX's own elements (elements.def), so it names a node. */
bool query_is_node(const struct lsp_query *query, uint32_t element);

/* The thing at an offset. */
enum place_part {
    PLACE_CONTENT,   /* between elements; `element` is the parent */
    PLACE_CATEGORY,  /* behind '<' or in the name of an element */
    PLACE_TAG,       /* between attributes */
    PLACE_ATTRIBUTE, /* in the name of an attribute */
    PLACE_VALUE,     /* between the quotes of a value */
    PLACE_END_TAG,
    PLACE_COMMENT,
};
struct place {
    enum place_part part;
    uint32_t element; /* MODEL_NONE: none */
    const struct model_attribute *attribute;
};
struct place query_place(const struct lsp_query *query);

/* The length of names and values that the server compares; longer ones are cut. */
enum { QUERY_NAME = 256 };

#endif
