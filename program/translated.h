// SPDX-License-Identifier: Apache-2.0
/* Documents with their surfaces as another model (docs/translate.md), for programs that draw or
 * check them. */
#ifndef MXG_PROGRAM_TRANSLATED_H
#define MXG_PROGRAM_TRANSLATED_H

#include "program/cli.h"

/* cli_load, then with the surfaces as `model`; model NULL: cli_load alone. NULL after a message. */
mxg_document *translated_load(struct cli *cli, const char *path, const char *model);

typedef mxg_status translated_way(mxg_context *context, const mxg_document *document,
                                  const char *model, mxg_result **out_result);

/*
 * A loaded document with its surfaces as `model`, by mxg_translate or mxg_translate_joined; `path`
 * is its name. NULL: *out_status is the fault. *out_result has the messages.
 */
mxg_document *translated_parse(struct cli *cli, const mxg_document *from, const char *path,
                               const char *model, translated_way *translate,
                               mxg_result **out_result, mxg_status *out_status);
/* As above, and reports the messages. NULL after one. */
mxg_document *translated_make(struct cli *cli, const mxg_document *from, const char *path,
                              const char *model, translated_way *translate);

/*
 * translated_drawn.c: how far an element of a file looks from its translation: the mean CIEDE2000
 * of three views of a ball. `folder` is for files that do not outlive the call. Below 0: *out_fault
 * has the reason, which the caller frees.
 */
double translated_difference(struct cli *cli, const char *path, const char *element,
                             const char *model, const char *folder, char **out_fault);

#endif
