// SPDX-License-Identifier: Apache-2.0
/*
 * The text of a document while it is edited: bytes with an index of lines. Positions of the
 * protocol count lines from 0, and columns in UTF-16 code units or in bytes.
 */
#ifndef MXG_LSP_EDITED_TEXT_H
#define MXG_LSP_EDITED_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A part of a text, as offsets of bytes. */
struct span {
    uint32_t start, end;
};

/* Where columns were counted last: parts of a long line are asked for one after the other. */
struct text_count {
    uint32_t line, offset, column;
    bool is_utf8;
};

struct text {
    char *bytes; /* with a NUL after them */
    uint32_t len, capacity;
    uint32_t *lines; /* where each line begins; the first one at 0 */
    uint32_t num_lines, capacity_lines;
    struct text_count *last; /* text_position keeps it */
};

struct position {
    uint32_t line, column;
};

/* The largest text, in bytes. */
#define TEXT_MAX 0x3fffffffu

/* Replaces the whole text. */
void text_set(struct text *text, const char *bytes, size_t len);
void text_finish(struct text *text);

/* Replaces a part, which is inside of the text. False: the text would be too large. */
bool text_replace(struct text *text, struct span part, const char *bytes, size_t len);

/* The offset of a position; a position after the end of its line is the end of the line. */
uint32_t text_offset(const struct text *text, struct position position, bool is_utf8);
/*
 * The position of an offset; one inside of a character is that of the character. Positions in the
 * order of the text take time linear in its length, in any lines. Of one thread at a time.
 */
struct position text_position(const struct text *text, uint32_t offset, bool is_utf8);

/* The number of the line, from 0, that has the offset. */
uint32_t text_line(const struct text *text, uint32_t offset);
/* A line, from 0, without its end. A line after the last one is empty, at the end of the text. */
struct span text_line_span(const struct text *text, uint32_t line);
/* The offset of a line and a column, which count from 1, the column in code points. */
uint32_t text_place(const struct text *text, uint32_t line, uint32_t column);
/* The end of so many code points, at most that of the line. */
uint32_t text_skip(const struct text *text, uint32_t offset, uint32_t code_points);

#endif
