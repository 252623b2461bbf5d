// SPDX-License-Identifier: Apache-2.0
#include "base/scan.h"

#include <assert.h>
#include <string.h>

void scan_begin(struct scan *scan, const char *text, size_t len)
{
    *scan = (struct scan){.start = text, .at = text, .end = text + len, .line_begins = true};
}

static bool is_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_next(const struct scan *scan, const char *two)
{
    return scan->end - scan->at >= 2 && memcmp(scan->at, two, 2) == 0;
}

static void skip_to_line_end(struct scan *scan)
{
    while (scan->at < scan->end && *scan->at != '\n')
        scan->at++;
}

static void skip_block_comment(struct scan *scan)
{
    const char *begin = scan->at;
    for (scan->at += 2; scan->at < scan->end && !is_next(scan, "*/"); scan->at++)
        ;
    bool ends = scan->end - scan->at >= 2;
    scan->at = ends ? scan->at + 2 : scan->end;
    if (!ends)
        scan->unended = begin;
}

/* A line that goes on. At the end of a file it would take a line of the text after it. */
static void skip_line_join(struct scan *scan)
{
    if (scan->end - scan->at == 2)
        scan->unended = scan->at;
    scan->at += 2;
}

/* Spaces and comments. */
static void skip(struct scan *scan)
{
    while (scan->at < scan->end) {
        if (is_next(scan, "//"))
            skip_to_line_end(scan);
        else if (is_next(scan, "/*"))
            skip_block_comment(scan);
        else if (*scan->at == '\n')
            scan->line_begins = scan->line_ended = true, scan->at++;
        else if (is_next(scan, "\\\n"))
            skip_line_join(scan);
        else if ((unsigned char)*scan->at <= ' ')
            scan->at++;
        else
            return;
    }
}

static void take_name(struct scan *scan, struct scan_word *out)
{
    out->text = scan->at;
    while (scan->at < scan->end && (is_name(*scan->at) || is_digit(*scan->at)))
        scan->at++;
    out->len = (size_t)(scan->at - out->text);
}

static void take_string(struct scan *scan, struct scan_word *out)
{
    out->text = ++scan->at;
    while (scan->at < scan->end && *scan->at != '"' && *scan->at != '\n')
        scan->at += *scan->at == '\\' && scan->end - scan->at > 1 ? 2 : 1;
    out->len = (size_t)(scan->at - out->text);
    if (scan->at < scan->end && *scan->at == '"')
        scan->at++;
}

/* Digits, exponents and suffixes: "1.5e-3f". */
static void take_number(struct scan *scan, struct scan_word *out)
{
    out->text = scan->at;
    while (scan->at < scan->end
           && (is_name(*scan->at) || is_digit(*scan->at) || *scan->at == '.'
               || ((*scan->at == '-' || *scan->at == '+')
                   && (scan->at[-1] == 'e' || scan->at[-1] == 'E'))))
        scan->at++;
    out->len = (size_t)(scan->at - out->text);
}

static bool begins_number(const struct scan *scan)
{
    return is_digit(*scan->at)
           || (*scan->at == '.' && scan->end - scan->at > 1 && is_digit(scan->at[1]));
}

bool scan_next(struct scan *scan, struct scan_word *out)
{
    scan->line_ended = false;
    skip(scan);
    assert(scan->at <= scan->end);
    if (scan->at == scan->end)
        return false;
    bool begins = scan->line_begins, has_name = scan->end - scan->at > 1 && is_name(scan->at[1]);
    scan->line_begins = false;
    *out = (struct scan_word){.kind = SCAN_MARK, .text = scan->at, .len = 1, .begin = scan->at};
    if (is_name(*scan->at)) {
        out->kind = SCAN_NAME;
        take_name(scan, out);
    } else if (*scan->at == '$' && has_name) {
        out->kind = SCAN_TOKEN;
        scan->at++;
        take_name(scan, out);
    } else if (*scan->at == '#' && begins) {
        out->kind = SCAN_DIRECTIVE;
        for (scan->at++; scan->at < scan->end && (*scan->at == ' ' || *scan->at == '\t');)
            scan->at++;
        take_name(scan, out);
    } else if (*scan->at == '"') {
        out->kind = SCAN_STRING;
        take_string(scan, out);
    } else if (begins_number(scan)) {
        out->kind = SCAN_NUMBER;
        take_number(scan, out);
    } else {
        scan->at++;
    }
    return true;
}

bool scan_is(const struct scan_word *word, const char *text)
{
    return strlen(text) == word->len && memcmp(word->text, text, word->len) == 0;
}

void scan_place(const struct scan *scan, const char *position, uint32_t *out_line,
                uint32_t *out_column)
{
    assert(position >= scan->start && position <= scan->end);
    uint32_t line = 1;
    const char *begin = scan->start;
    for (const char *p = scan->start; p < position; p++)
        if (*p == '\n') {
            line++;
            begin = p + 1;
        }
    *out_line = line;
    *out_column = 1;
    for (const char *p = begin; p < position; p++)
        *out_column += ((unsigned char)*p & 0xc0) != 0x80; /* code points */
}
