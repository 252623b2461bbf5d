// SPDX-License-Identifier: Apache-2.0
/* The slabs of an element as data: the view MXG_VIEW_SLABS_JSON, read. */
#ifndef MXG_PROGRAM_SLAB_VIEW_H
#define MXG_PROGRAM_SLAB_VIEW_H

#include "program/cli.h"

#include <jansson.h>

/* element NULL: the first one. The caller drops the value; NULL: there is no view. */
json_t *slab_view_read(const struct cli *cli, const mxg_document *document, const char *element,
                       const char *target, const mxg_options *options);

#endif
