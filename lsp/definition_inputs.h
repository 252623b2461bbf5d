// SPDX-License-Identifier: Apache-2.0
/*
 * The inputs of the document's own definitions, and who names them. An input that several
 * definitions inherit from each other is that of the first one, so that one name means one element.
 */
#ifndef MXG_LSP_DEFINITION_INPUTS_H
#define MXG_LSP_DEFINITION_INPUTS_H

#include "lsp/query.h"

/* The input that `interfacename` means: the nodegraph's own, or one of what it implements. */
uint32_t inputs_of_graph(const struct lsp_query *query, uint32_t element, struct span name);
/* The input that an <input> of a node, an heir, an <implementation> or a <variant> means. */
uint32_t inputs_of_owner(const struct lsp_query *query, uint32_t element, struct span name);
/* The input that `sourcecode` of an <implementation> means. */
uint32_t inputs_of_source(const struct lsp_query *query, uint32_t element, struct span name);
/* The input that `defaultinput` means. */
uint32_t inputs_passed_through(const struct lsp_query *query, uint32_t element, struct span name);
/*
 * True for an input of a definition whose nodegraph also implements another definition with an
 * input of this name.
 */
bool inputs_share_graph(const struct lsp_query *query, uint32_t target);

#endif
