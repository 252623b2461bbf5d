// SPDX-License-Identifier: Apache-2.0
#include "lsp/edited_text.h"

#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

/* True if a line begins at the offset, which is not 0. */
static bool begins_line(const struct text *text, uint32_t offset)
{
    char before = text->bytes[offset - 1];
    return before == '\n' || (before == '\r' && text->bytes[offset] != '\n');
}

static void reserve_lines(struct text *text, uint32_t count)
{
    if (count <= text->capacity_lines)
        return;
    text->capacity_lines = count + count / 2 + 16;
    text->lines = memory_resize(text->lines, text->capacity_lines * sizeof *text->lines);
}

/* Where the next line begins from an offset on, at most `to`; 0: none does. */
static uint32_t next_line(const struct text *text, uint32_t from, uint32_t to)
{
    for (uint32_t at = from ? from : 1; at <= to; ++at) {
        at += (uint32_t)strcspn(text->bytes + at - 1, "\r\n");
        if (at > to || at > text->len)
            return 0;
        if (begins_line(text, at))
            return at;
    }
    return 0;
}

static void reserve(struct text *text, size_t len)
{
    if (len < text->capacity)
        return;
    text->capacity = (uint32_t)(len + len / 2 + 256);
    text->bytes = memory_resize(text->bytes, text->capacity);
}

void text_set(struct text *text, const char *bytes, size_t len)
{
    reserve(text, len);
    memcpy(text->bytes, bytes, len);
    text->bytes[len] = '\0';
    text->len = (uint32_t)len;
    reserve_lines(text, 1);
    text->lines[0] = 0;
    text->num_lines = 1;
    text->last = text->last ? text->last : memory_alloc(sizeof *text->last);
    *text->last = (struct text_count){0};
    for (uint32_t at = 0; (at = next_line(text, at + 1, text->len)) != 0;) {
        reserve_lines(text, text->num_lines + 1);
        text->lines[text->num_lines++] = at;
    }
}

void text_finish(struct text *text)
{
    free(text->bytes);
    free(text->lines);
    free(text->last);
    *text = (struct text){0};
}

/* The number of lines that begin before the offset. */
static uint32_t lines_before(const struct text *text, uint32_t offset)
{
    uint32_t low = 0, high = text->num_lines;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (text->lines[middle] < offset)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/*
 * Whether a line begins at an offset depends on the bytes before and at it, so the lines from the
 * begin of the change to one byte after it are found anew.
 */
bool text_replace(struct text *text, struct span part, const char *bytes, size_t len)
{
    size_t new_len = text->len - (part.end - part.start) + len;
    if (new_len > TEXT_MAX)
        return false;
    uint32_t kept = lines_before(text, part.start), rest = lines_before(text, part.end + 1),
             num_rest = text->num_lines - rest;
    kept = kept ? kept : 1; /* the first line */
    reserve(text, new_len);
    memmove(text->bytes + part.start + len, text->bytes + part.end, text->len - part.end);
    memcpy(text->bytes + part.start, bytes, len);
    text->len = (uint32_t)new_len;
    text->bytes[new_len] = '\0';
    uint32_t end = part.start + (uint32_t)len, num = 0;
    for (uint32_t at = part.start; (at = next_line(text, at, end)) != 0; ++at)
        ++num;
    reserve_lines(text, kept + num + num_rest);
    memmove(text->lines + kept + num, text->lines + rest, num_rest * sizeof *text->lines);
    for (uint32_t at = part.start, i = kept; (at = next_line(text, at, end)) != 0; ++at)
        text->lines[i++] = at;
    text->num_lines = kept + num + num_rest;
    *text->last = (struct text_count){0};
    for (uint32_t i = kept + num; i < text->num_lines; ++i)
        text->lines[i] = text->lines[i] - part.end + end;
    return true;
}

uint32_t text_line(const struct text *text, uint32_t offset)
{
    return lines_before(text, offset + 1) - 1;
}

struct span text_line_span(const struct text *text, uint32_t line)
{
    if (line >= text->num_lines)
        return (struct span){text->len, text->len};
    uint32_t start = text->lines[line],
             end = line + 1 < text->num_lines ? text->lines[line + 1] : text->len;
    if (end > start && line + 1 < text->num_lines && text->bytes[end - 1] == '\n')
        --end;
    if (end > start && line + 1 < text->num_lines && text->bytes[end - 1] == '\r')
        --end;
    return (struct span){start, end};
}

/* Bytes of the character that begins here. The text is UTF-8; other bytes count as one each. */
static uint32_t length_of(const struct text *text, uint32_t offset)
{
    unsigned char lead = (unsigned char)text->bytes[offset];
    uint32_t len = lead < 0xc0 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    return len <= text->len - offset ? len : 1;
}

static uint32_t units_of(uint32_t len, bool is_utf8)
{
    return is_utf8 ? len : len == 4 ? 2 : 1;
}

uint32_t text_offset(const struct text *text, struct position position, bool is_utf8)
{
    struct span line = text_line_span(text, position.line);
    uint32_t at = line.start, column = 0;
    while (at < line.end && column < position.column) {
        uint32_t len = length_of(text, at);
        column += units_of(len, is_utf8);
        if (column <= position.column)
            at += len;
    }
    return at < line.end ? at : line.end;
}

struct position text_position(const struct text *text, uint32_t offset, bool is_utf8)
{
    offset = offset < text->len ? offset : text->len;
    const uint32_t line = text_line(text, offset);
    struct text_count count = *text->last;
    if (count.line != line || count.offset > offset || count.is_utf8 != is_utf8
        || count.offset < text->lines[line])
        count = (struct text_count){line, text->lines[line], 0, is_utf8};
    while (count.offset < offset) {
        uint32_t len = length_of(text, count.offset);
        if (count.offset + len > offset)
            break;
        count.offset += len;
        count.column += units_of(len, is_utf8);
    }
    *text->last = count;
    return (struct position){line, count.column};
}

uint32_t text_skip(const struct text *text, uint32_t offset, uint32_t code_points)
{
    uint32_t end = text_line_span(text, text_line(text, offset)).end;
    for (; offset < end && code_points; --code_points)
        offset += length_of(text, offset);
    return offset < end ? offset : end;
}

uint32_t text_place(const struct text *text, uint32_t line, uint32_t column)
{
    struct span span = text_line_span(text, line ? line - 1 : 0);
    return column > 1 ? text_skip(text, span.start, column - 1) : span.start;
}
