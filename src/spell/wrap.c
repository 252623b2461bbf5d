// SPDX-License-Identifier: Apache-2.0
/*
 * Breaks long lines where the expression nests least, and there where it binds most loosely: after
 * a comma, or before an operator. A long comment continues in the next line. Strings, preprocessor
 * directives and verbatim source stay unbroken. Of blank lines in a row one stays.
 */
#include "spell/spell.h"

#include <assert.h>
#include <ctype.h>

enum { MAX_COLUMNS = 120, MIN_COLUMNS = 40, INDENT = 4 };

struct wrapper {
    const struct spell *spell;
    struct text out;
    uint32_t next_mark; /* the first mark of the spell that is not in `marks` */
    VEC(struct spell_mark) marks;
    const char *copied; /* `out` has the text before this */
};

/* The role of a character in the search for a break. */
enum meaning { PLAIN, OPERATOR, OPENS, CLOSES, QUOTE, SLASH, SPACE };

/* How tightly operators bind, as the first character tells; a comma binds most loosely. */
enum binding { COMMA, CHOICE, LOR, LAND, BITS, COMPARISON, SHIFT, SUM, PRODUCT, ASSIGNMENT };

static const struct sign {
    uint8_t meaning, binding, doubled; /* doubled: the binding of "||" */
} signs[256] = {
    ['('] = {OPENS},
    ['['] = {OPENS},
    ['{'] = {OPENS},
    [')'] = {CLOSES},
    [']'] = {CLOSES},
    ['}'] = {CLOSES},
    ['"'] = {QUOTE},
    [' '] = {SPACE},
    ['?'] = {OPERATOR, CHOICE, CHOICE},
    [':'] = {OPERATOR, CHOICE, CHOICE},
    ['|'] = {OPERATOR, BITS, LOR},
    ['&'] = {OPERATOR, BITS, LAND},
    ['^'] = {OPERATOR, BITS, BITS},
    ['<'] = {OPERATOR, COMPARISON, SHIFT},
    ['>'] = {OPERATOR, COMPARISON, SHIFT},
    ['='] = {OPERATOR, COMPARISON, COMPARISON},
    ['!'] = {OPERATOR, COMPARISON, COMPARISON},
    ['+'] = {OPERATOR, SUM, SUM},
    ['-'] = {OPERATOR, SUM, SUM},
    ['*'] = {OPERATOR, PRODUCT, PRODUCT},
    ['%'] = {OPERATOR, PRODUCT, PRODUCT},
    ['/'] = {SLASH, PRODUCT, PRODUCT},
};

/* True for the space of "array<uint, 4>". */
static bool is_before_length(const char *at)
{
    at++;
    while (isdigit((unsigned char)*at))
        at++;
    return *at == '>' && isdigit((unsigned char)at[-1]);
}

/*
 * True if a line may break at this space, beside an operator or a comma. The break replaces the
 * space.
 */
static bool may_break(const char *at, const char *end)
{
    if (at + 2 >= end)
        return false;
    if (at[-1] == ',')
        return !is_before_length(at);
    if (signs[(unsigned char)at[1]].meaning != OPERATOR && at[1] != '/')
        return false;
    bool ends = at[2] == ' ' || (at + 3 < end && at[3] == ' ' && ispunct((unsigned char)at[2]));
    return ends && !(at[1] == '=' && at[2] == ' ');
}

/* How tightly the comma before this space binds, or the operator behind it. */
static enum binding binding_at(const char *at)
{
    const struct sign *sign = &signs[(unsigned char)at[1]];
    return at[-1] == ','                          ? COMMA
           : at[2] == '=' && sign->binding >= SUM ? ASSIGNMENT /* "+=" */
           : at[1] == at[2]                       ? sign->doubled
                                                  : sign->binding;
}

/* The closing quote of the string that starts at `at`. */
static const char *end_of_string(const char *at, const char *end)
{
    for (at++; at < end && (*at != '"' || at[-1] == '\\'); at++)
        ;
    return at;
}

/*
 * Finds the break of [from, end), which starts at column `column`. Among the places within
 * MAX_COLUMNS it is the last one that binds most loosely of those with the fewest open brackets;
 * where there is none, it is behind the sign of an assignment, or before MIN_COLUMNS. NULL: there
 * is no such place either.
 */
static const char *find_break(const char *from, const char *end, size_t column)
{
    const char *best = NULL, *assigned = NULL, *early = NULL,
               *first = column < MIN_COLUMNS ? from + (MIN_COLUMNS - column) : from;
    size_t room = column < MAX_COLUMNS ? MAX_COLUMNS - column + 1 : 0;
    const char *stop = (size_t)(end - from) < room ? end : from + room;
    int depth = 0, best_depth = 0;
    enum binding best_binding = COMMA;
    for (const char *at = from; at < stop; at++) {
        enum meaning meaning = signs[(unsigned char)*at].meaning;
        if (meaning <= OPERATOR)
            continue;
        if (meaning != SPACE) {
            depth += (meaning == OPENS) - (meaning == CLOSES);
            if (meaning == QUOTE)
                at = end_of_string(at, end);
            else if (meaning == SLASH && at + 1 < end && at[1] == '/')
                return NULL;
        } else if (at > from + 1 && at[-1] == '=' && at[-2] == ' ') {
            assigned = at;
        } else if (at > from && (at < first || !best || depth <= best_depth)
                   && may_break(at, end)) {
            enum binding level = at < first ? COMMA : binding_at(at);
            if (at < first) {
                early = at;
            } else if (!best || depth < best_depth || level <= best_binding) {
                best = at;
                best_depth = depth;
                best_binding = level;
            }
        }
    }
    return best ? best : assigned ? assigned : early;
}

/* Copies the text before `to` that is not copied yet. */
static void copy(struct wrapper *w, const char *to)
{
    assert(to >= w->copied);
    const struct spell *spell = w->spell;
    const char *base = spell->out->data;
    size_t start = (size_t)(w->copied - base);
    for (; w->next_mark < spell->marks.len; w->next_mark++) {
        size_t at = spell->marks.items[w->next_mark].at;
        if (at >= (size_t)(to - base))
            break;
        /* a mark may be at the space that the break replaced */
        struct spell_mark mark = {w->out.len + (at > start ? at - start : 0),
                                  spell->marks.items[w->next_mark].origin};
        vec_push(spell->scratch, &w->marks, mark);
    }
    text_mem(&w->out, w->copied, (size_t)(to - w->copied));
    w->copied = to;
}

/* Ends a line. The next line has the same origin. */
static void break_line(struct wrapper *w, size_t line_begin)
{
    const struct spell_mark *last = w->marks.len ? &w->marks.items[w->marks.len - 1] : NULL;
    text_char(&w->out, '\n');
    if (last && last->at >= line_begin) {
        struct spell_mark mark = {w->out.len, last->origin};
        vec_push(w->spell->scratch, &w->marks, mark);
    }
}

/* The break of a comment on a line of its own: a space that is not beside a sign of equality. */
static const char *comment_break(const char *from, const char *end, size_t indent)
{
    const char *at = from + MAX_COLUMNS - indent < end ? from + MAX_COLUMNS - indent : end;
    while (at > from + MIN_COLUMNS && (*at != ' ' || at[-1] == '=' || at[1] == '='))
        at--;
    return *at == ' ' ? at : NULL;
}

static void wrap_line(struct wrapper *w, const char *line, const char *end)
{
    size_t indent = 0, column = 0;
    while (line + indent < end && line[indent] == ' ')
        indent++;
    copy(w, line);
    const char *from = line;
    size_t line_begin = w->out.len;
    bool is_comment = end - line > (ptrdiff_t)indent + 2 && memcmp(line + indent, "//", 2) == 0;
    while (column + (size_t)(end - from) > MAX_COLUMNS && line[indent] != '#') {
        const char *at =
            is_comment ? comment_break(from, end, column) : find_break(from, end, column);
        if (!at || at <= line + indent)
            break;
        copy(w, at);
        break_line(w, line_begin);
        column = is_comment ? indent : indent + INDENT;
        for (size_t i = 0; i < column; i++)
            text_char(&w->out, ' ');
        if (is_comment)
            text_str(&w->out, "// ");
        column += is_comment ? strlen("// ") : 0;
        w->copied = from = at + 1;
        assert(from <= end);
    }
}

void spell_wrap(struct spell *spell, size_t begin)
{
    assert(spell->verbatim_begin <= spell->verbatim_end);
    const char *base = spell->out->data, *end = base + spell->out->len;
    struct wrapper w = {.spell = spell, .copied = base};
    text_init(&w.out, spell->out->arena);
    text_reserve(&w.out, spell->out->len + spell->out->len / 16);
    const char *kept = base + spell->verbatim_begin, *kept_end = base + spell->verbatim_end;
    bool was_blank = false;
    for (const char *line = base + begin; line < end;) {
        const char *newline = memchr(line, '\n', (size_t)(end - line));
        const char *stop = newline ? newline : end;
        bool is_kept = line >= kept && line < kept_end, is_blank = stop == line && newline;
        if (!is_kept && is_blank && was_blank) {
            copy(&w, line);
            w.copied = newline + 1;
        } else if (!is_kept && stop - line > MAX_COLUMNS) {
            wrap_line(&w, line, stop);
        }
        was_blank = is_blank;
        line = newline ? newline + 1 : end;
    }
    copy(&w, end);
    assert(w.next_mark == spell->marks.len && w.marks.len >= spell->marks.len);
    *spell->out = w.out;
    spell->marks.items = w.marks.items;
    spell->marks.len = w.marks.len;
}
