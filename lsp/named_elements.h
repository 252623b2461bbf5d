// SPDX-License-Identifier: Apache-2.0
/* Which names an attribute may have, and which element a name means. */
#ifndef MXG_LSP_NAMED_ELEMENTS_H
#define MXG_LSP_NAMED_ELEMENTS_H

#include "lsp/catalogue.h"
#include "lsp/query.h"

/* The parent of the nodes that `nodename` of the element may name. */
uint32_t names_scope(const struct lsp_query *query, uint32_t element);
/* The type that a connection of the element needs; "" if nothing tells. */
const char *names_type(const struct lsp_query *query, uint32_t element, char *buffer,
                       size_t capacity);
/* The type of a node, an input or an output; of a node with several outputs "multioutput". */
const char *names_own_type(const struct lsp_query *query, uint32_t element, char *buffer,
                           size_t capacity);
/* The attribute `fileprefix` of the element or of the nearest one around it. */
const char *names_file_prefix(const struct lsp_query *query, uint32_t element, char *buffer,
                              size_t capacity);

/*
 * The attribute of an element that names a file, with the prefix before its value; NULL: it names
 * none.
 */
const struct model_attribute *names_file(const struct lsp_query *query, uint32_t element,
                                         char *prefix, size_t capacity);

/*
 * The element of the text that `name`, the value of an attribute of `element` or an item of it,
 * names: of a connection, a reference to a definition, a material. MODEL_NONE: none in this text,
 * or the attribute names nothing.
 */
uint32_t names_target_of(const struct lsp_query *query, uint32_t element,
                         const struct model_attribute *attribute, struct span name);
/* names_target_of for the whole value. */
uint32_t names_target(const struct lsp_query *query, uint32_t element,
                      const struct model_attribute *attribute);
/*
 * The next item of a value with commas between its items, without blanks, or the next input in
 * source text; begin with an empty span at the begin of the value. False: there are no more.
 */
bool names_next_item(const struct lsp_query *query, const struct model_attribute *attribute,
                     struct span *item);
/* True for an attribute of an element whose value is the names of elements. */
bool names_is_reference(const struct lsp_query *query, uint32_t element,
                        const struct model_attribute *attribute);
/* As above, and these may stand at the root of another file. */
bool names_other_files(const struct lsp_query *query, uint32_t element,
                       const struct model_attribute *attribute);
/* As above, and elements of this category may be among them. */
bool names_category(const struct lsp_query *query, uint32_t element,
                    const struct model_attribute *attribute, const char *category);

/* The next element at the root of the document that stands in another file; begin with 0. */
mxg_element names_next_included(const struct lsp_query *query, mxg_element after,
                                mxg_element_info *out);
/* The element at the root of this name in another file; 0: there is none. */
mxg_element names_find_included(const struct lsp_query *query, struct span name,
                                mxg_element_info *out);

#endif
