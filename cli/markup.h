// SPDX-License-Identifier: Apache-2.0
/* Text in XML and HTML. */
#ifndef MXG_CLI_MARKUP_H
#define MXG_CLI_MARKUP_H

#include <stdio.h>

/*
 * With <, >, & and quotes escaped. What XML 1.0 has no place for (control characters, bytes that
 * are no UTF-8) becomes '?'.
 */
void markup_text(FILE *out, const char *text);

/* Style and script of the pages that we write, lines that end with NULL (page.c.in). */
extern const char *const manual_style[], *const manual_script[];
extern const char *const gallery_style[], *const gallery_script[];
void markup_lines(FILE *out, const char *const *lines);

#endif
