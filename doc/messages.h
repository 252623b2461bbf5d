// SPDX-License-Identifier: Apache-2.0
/* Explanations of messages, on standard output, and their examples as files. */
#ifndef MXG_DOC_MESSAGES_H
#define MXG_DOC_MESSAGES_H

#include "program/cli.h"

/*
 * messages.c: a message with its cause, its cure and its example, as text; then as a section of
 * Markdown.
 */
void explain_kind(const mxg_diagnostic_kind *kind);
void explain_section(const mxg_diagnostic_kind *kind);
/* All messages: one line each, or a document in Markdown. */
void explain_list(void);
void explain_all(void);

/* example.c: prints an example; each line begins with `indent`. */
void example_print(const char *example, const char *indent, FILE *out);
/*
 * Writes the example of a message, if any, to the folders ID/wrong and ID/right. Each has the
 * arguments of mxgen in a file "arguments".
 */
void example_write(struct cli *cli, const mxg_diagnostic_kind *kind, const char *folder);

#endif
