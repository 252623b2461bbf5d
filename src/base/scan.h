// SPDX-License-Identifier: Apache-2.0
/*
 * Splits the source of a C-like language into words, without its grammar: GLSL and OSL alike.
 * Comments are left out.
 */
#ifndef MXG_BASE_SCAN_H
#define MXG_BASE_SCAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum scan_kind {
    SCAN_NAME,
    SCAN_TOKEN,     /* "$name"; the text is the name */
    SCAN_DIRECTIVE, /* "#word" at the begin of a line; the text is the word */
    SCAN_STRING,    /* in quotes; the text has none */
    SCAN_NUMBER,
    SCAN_MARK, /* one character */
};

struct scan_word {
    enum scan_kind kind;
    const char *text;
    size_t len;
    const char *begin; /* of the word in the source, with '$', '#' or a quote */
};

struct scan {
    const char *start, *at, *end;
    bool line_begins;
    bool line_ended; /* a line end precedes the last word */
    /* a comment, or a line that goes on, at which the source ends; NULL: there is none */
    const char *unended;
};

void scan_begin(struct scan *scan, const char *text, size_t len);
/* The next word; false at the end. */
bool scan_next(struct scan *scan, struct scan_word *out);

bool scan_is(const struct scan_word *word, const char *text); /* compares the text, of any kind */
static inline bool scan_is_mark(const struct scan_word *word, char mark)
{
    return word->kind == SCAN_MARK && *word->text == mark;
}

/* Line and column, from 1, of a position in the source. */
void scan_place(const struct scan *scan, const char *position, uint32_t *out_line,
                uint32_t *out_column);

#endif
