// SPDX-License-Identifier: Apache-2.0
/* The actions of `mxgen library`, and their options. */
#ifndef MXG_DOC_REFERENCE_H
#define MXG_DOC_REFERENCE_H

#include "program/cli.h"

struct library_args {
    const char *output; /* a file; for `doc` a folder; NULL: none */
    bool html, markdown, pictures;
};

void library_doc(struct cli *cli, const struct library_args *args);

#endif
