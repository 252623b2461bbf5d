// SPDX-License-Identifier: Apache-2.0
/*
 * Text in XML and HTML. What goes through a `struct markup` is a format that the program has, and
 * arguments, which are always escaped: no call can forget it.
 */
#ifndef MXG_PROGRAM_MARKUP_H
#define MXG_PROGRAM_MARKUP_H

#include <stdio.h>

/* A file of escaped text. Nothing else writes to the file as long as it has parts to come. */
struct markup {
    FILE *file;
};

/*
 * Writes a format, which is markup, with arguments, which are text: %s, and numbers as printf
 * writes them (%d, %u, %f, %g with any length and precision). In texts <, >, & and quotes are
 * escaped; characters that XML 1.0 does not allow (control characters, invalid UTF-8) become '?'.
 */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void markup_put(struct markup *out, const char *format, ...);

/* Style and script of the generated pages, as lists of lines that end with NULL (page.c.in). */
extern const char *const manual_style[], *const manual_script[];
extern const char *const gallery_style[], *const gallery_script[];
void markup_lines(struct markup *out, const char *const *lines);

#endif
