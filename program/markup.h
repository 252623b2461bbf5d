// SPDX-License-Identifier: Apache-2.0
/* Text in XML and HTML. */
#ifndef MXG_PROGRAM_MARKUP_H
#define MXG_PROGRAM_MARKUP_H

#include <stdio.h>

/*
 * Escapes <, >, & and quotes. Characters that XML 1.0 does not allow (control characters, invalid
 * UTF-8) become '?'.
 */
void markup_text(FILE *out, const char *text);

/* Style and script of the generated pages, as lists of lines that end with NULL (page.c.in). */
extern const char *const manual_style[], *const manual_script[];
extern const char *const gallery_style[], *const gallery_script[];
void markup_lines(FILE *out, const char *const *lines);

#endif
