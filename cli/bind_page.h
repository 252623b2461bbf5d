// SPDX-License-Identifier: Apache-2.0
/* The page of `mxgen bind --html`: the layers of all primitives in a tree. It needs no server. */
#ifndef MXG_CLI_BIND_PAGE_H
#define MXG_CLI_BIND_PAGE_H

#include "cli/bind_substances.h"

#include <stdio.h>

/* `title` is the name of the look. */
void bind_page_write(FILE *out, const mxg_scene *scene, const mxg_bindings *bindings,
                     struct bind_substances *substances, const char *title);

#endif
