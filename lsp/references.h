// SPDX-License-Identifier: Apache-2.0
/* The element that the cursor means, and all places of the text that name it. */
#ifndef MXG_LSP_REFERENCES_H
#define MXG_LSP_REFERENCES_H

#include "lsp/named_elements.h"

/*
 * The element whose name is under the cursor: in its own `name`, or in an attribute that names it.
 * MODEL_NONE: none of this text. *out_name is the place of the name under the cursor.
 */
uint32_t references_target(const struct lsp_query *query, struct span *out_name);

/* Calls `take` for each name of the element in an attribute, in the order of the text. */
void references_each(const struct lsp_query *query, uint32_t target,
                     void (*take)(void *user_data, uint32_t element,
                                  const struct model_attribute *attribute, struct span name),
                     void *user_data);

#endif
