// SPDX-License-Identifier: Apache-2.0
/* Renders diagnostics for people, with the source line and a caret. */
#include "diag/diag.h"

#include <assert.h>

enum {
    LINE_SHOWN = 160, /* maximum of code points of a source line */
    LINE_BEFORE = 80, /* of these, before the column, if the line is longer */
    LINE_SEARCHED =
        1 << 15, /* a message further right shows no source: the way there is too long */
};

static const char *const colours[] = {[DIAG_ERROR] = "\x1b[1;31m",
                                      [DIAG_WARNING] = "\x1b[1;35m",
                                      [DIAG_NOTE] = "\x1b[1;36m",
                                      [DIAG_REMARK] = "\x1b[1;34m"};
static const char bold[] = "\x1b[1m", green[] = "\x1b[1;32m", plain[] = "\x1b[0m";

static void paint(struct text *out, bool colour, const char *escape)
{
    if (colour)
        text_str(out, escape);
}

/* Text of a document may contain anything, including terminal escapes. */
static void put_clean(struct text *out, const char *bytes, size_t len)
{
    size_t begin = out->len;
    text_mem(out, bytes, len);
    text_show(out, begin);
}

struct line {
    const char *text;
    size_t len;
};

static bool begins_code_point(char byte)
{
    return (byte & 0xc0) != 0x80;
}

/* How many of eight bytes begin a code point: the bytes other than 10xxxxxx. */
static unsigned begins_in(uint64_t bytes)
{
    uint64_t continues = bytes >> 7 & ~bytes >> 6 & 0x0101010101010101u;
    return 8 - (unsigned)(continues * 0x0101010101010101u >> 56);
}

/* The bytes of the first `count` code points, or all. */
static size_t bytes_of(struct line line, uint32_t count)
{
    size_t at = 0;
    for (uint64_t word; line.len - at >= sizeof word && count >= sizeof word; at += sizeof word) {
        memcpy(&word, line.text + at, sizeof word);
        count -= begins_in(word);
    }
    for (; at < line.len; at++)
        if (begins_code_point(line.text[at]) && count-- == 0)
            break;
    return at;
}

static struct line first(struct line line, uint32_t count)
{
    return (struct line){line.text, bytes_of(line, count)};
}

static struct line behind(struct line line, uint32_t count)
{
    size_t skipped = bytes_of(line, count);
    return (struct line){line.text + skipped, line.len - skipped};
}

static uint32_t code_points(struct line line)
{
    uint32_t count = 0;
    for (size_t i = 0; i < line.len; i++)
        count += begins_code_point(line.text[i]);
    return count;
}

/* White space as wide as `line`; tabs stay tabs. */
static void put_margin(struct text *out, struct line line)
{
    for (size_t i = 0, begin = 0; i < line.len; begin = i) {
        do
            i++;
        while (i < line.len && !begins_code_point(line.text[i]));
        size_t width = text_width(line.text + begin, i - begin);
        text_fmt(out, "%*s", (int)width, line.text[begin] == '\t' ? "\t" : "");
    }
}

static void render_source(const struct diag_place *place, struct line line, bool colour,
                          struct text *out)
{
    uint32_t before = place->column - 1, near = before > LINE_BEFORE ? before - LINE_BEFORE : 0;
    const char *ellipsis = "";
    if (near > LINE_SEARCHED)
        return;
    struct line rest = behind(line, near);
    if (line.len == 0 || before - near > code_points(first(rest, LINE_SHOWN)))
        return; /* the text does not match the diagnostic, or the line is empty */
    if (near && first(line, LINE_SHOWN).len < line.len) {
        line = rest;
        before = LINE_BEFORE;
        ellipsis = "...";
    }
    struct line shown = first(line, LINE_SHOWN);
    assert(before <= code_points(shown));
    text_fmt(out, "    %s", ellipsis);
    put_clean(out, shown.text, shown.len);
    text_str(out, shown.len < line.len ? "...\n    " : "\n    ");
    put_margin(out, (struct line){ellipsis, strlen(ellipsis)});
    put_margin(out, first(shown, before));
    paint(out, colour, green);
    text_char(out, '^');
    uint32_t room = code_points(shown) - before;
    for (uint32_t i = 1; i < place->length && i < room; i++)
        text_char(out, '~');
    paint(out, colour, plain);
    text_char(out, '\n');
}

static void render_place(const struct diag_place *place, struct text *out)
{
    if (!place->file)
        return;
    put_clean(out, place->file, strlen(place->file));
    text_char(out, ':');
    if (place->line)
        text_fmt(out, "%u:", (unsigned)place->line);
    else if (place->path && *place->path) {
        text_char(out, ' ');
        put_clean(out, place->path, strlen(place->path));
        text_char(out, ':');
    }
    if (place->line && place->column)
        text_fmt(out, "%u:", (unsigned)place->column);
    text_char(out, ' ');
}

void diag_render(const struct diag *diag, const char *line, size_t line_len, bool colour,
                 struct text *out)
{
    paint(out, colour, bold);
    render_place(&diag->place, out);
    paint(out, colour, colours[diag->severity]);
    text_fmt(out, "%s: ", diag_severity_text(diag->severity));
    paint(out, colour, plain);
    put_clean(out, diag->message, strlen(diag->message));
    if (diag->severity != DIAG_NOTE)
        text_fmt(out, " [%s]", diag_id_text(diag->id));
    text_char(out, '\n');
    if (line && diag->place.line && diag->place.column)
        render_source(&diag->place, (struct line){line, line_len}, colour, out);
}
