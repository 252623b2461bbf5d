// SPDX-License-Identifier: Apache-2.0
/* Finds the parts of a look that change inputs of what a primitive wears. */
#ifndef MXG_RENDER_LOOK_PARTS_H
#define MXG_RENDER_LOOK_PARTS_H

#include <mxgen/document.h>

/*
 * Calls `tell` for each variant that a look assigns, and each layer of it that is a nodegraph, also
 * for those of looks that it inherits. `look` is the name of the look that has the part.
 */
void look_parts(const mxg_document *document, const char *look,
                void (*tell)(void *user_data, const char *look, const mxg_element_info *part),
                void *user_data);

#endif
