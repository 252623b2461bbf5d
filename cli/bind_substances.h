// SPDX-License-Identifier: Apache-2.0
/* What the page of `mxgen bind --html` shows of substances and overrides: graphs and pictures. */
#ifndef MXG_CLI_BIND_SUBSTANCES_H
#define MXG_CLI_BIND_SUBSTANCES_H

#include "program/cli.h"

struct bind_substances {
    struct cli *cli;
    const mxg_document *document; /* with the materials of the stage */
    const char *file;             /* a document with the same elements; NULL: there is none */
    bool has_pictures;
};

/*
 * The graph of a material or nodegraph of the document, as `mxgen inspect --graph` writes it; nodes
 * of several outputs may come again. The caller frees it.
 */
char *substance_graph(const struct bind_substances *substances, const char *name);

/*
 * A picture of a material in base64, which mxgen-render draws; the caller frees it. NULL: it is no
 * material, pictures are not wanted, or after a message.
 */
char *substance_picture(struct bind_substances *substances, const char *name);

#endif
