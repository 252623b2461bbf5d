// SPDX-License-Identifier: Apache-2.0
/* Documents with their surfaces as another model (docs/translate.md), for programs that draw or
 * check them. */
#ifndef MXG_PROGRAM_TRANSLATED_H
#define MXG_PROGRAM_TRANSLATED_H

#include "program/cli.h"

/* cli_load, then with the surfaces as `model`; model NULL: cli_load alone. NULL after a message. */
mxg_document *translated_load(struct cli *cli, const char *path, const char *model);

/* A loaded document with its surfaces as `model`; `path` is its name. NULL after a message. */
mxg_document *translated_make(struct cli *cli, const mxg_document *from, const char *path,
                              const char *model);

#endif
