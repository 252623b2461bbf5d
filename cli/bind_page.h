// SPDX-License-Identifier: Apache-2.0
/* The page of `mxgen bind --html`: the layers of all primitives in a tree. It needs no server. */
#ifndef MXG_CLI_BIND_PAGE_H
#define MXG_CLI_BIND_PAGE_H

#include <mxgen/mxgen.h>
#include <mxgen/scene.h>

#include <stdio.h>

/* `title` is the name of the look. */
void bind_page_write(FILE *out, const mxg_scene *scene, const mxg_bindings *bindings,
                     const char *title);

#endif
