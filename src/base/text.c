// SPDX-License-Identifier: Apache-2.0
#include "base/text.h"

#include "base/hidden_chars.h"
#include "base/num.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>

void text_init(struct text *text, struct arena *arena)
{
    *text = (struct text){.arena = arena};
}

void text_reserve(struct text *text, size_t more)
{
    if (text->cap - text->len >= more)
        return;
    if (more > SIZE_MAX / 4 || text->cap > SIZE_MAX / 4)
        mem_fail(text->arena->mem);
    size_t cap = text->cap ? text->cap * 2 : 256;
    while (cap - text->len < more)
        cap *= 2;
    text->data = arena_grow(text->arena, text->data, text->cap, cap);
    text->cap = cap;
    assert(text->cap - text->len >= more);
}

bool text_ends_with(const char *text, const char *end)
{
    size_t len = strlen(text), end_len = strlen(end);
    return len >= end_len && strcmp(text + len - end_len, end) == 0;
}

bool text_next_item(const char **rest, struct text_word *out)
{
    const char *item = *rest + strspn(*rest, " ");
    size_t len = strcspn(item, ",");
    if (!*item)
        return false;
    *rest = item + len + (item[len] == ',');
    while (len && item[len - 1] == ' ')
        len--;
    *out = (struct text_word){item, len};
    return true;
}

void text_u32(struct text *text, uint32_t value)
{
    char digits[10];
    size_t n = sizeof digits;
    do
        digits[--n] = (char)('0' + value % 10);
    while ((value /= 10) != 0);
    text_mem(text, digits + n, sizeof digits - n);
}

void text_i32(struct text *text, int32_t value)
{
    if (value < 0)
        text_char(text, '-');
    text_u32(text, value < 0 ? 0u - (uint32_t)value : (uint32_t)value);
}

void text_hex64(struct text *text, uint64_t value)
{
    for (int shift = 60; shift >= 0; shift -= 4)
        text_char(text, "0123456789abcdef"[value >> shift & 15]);
}

void text_float(struct text *text, float value)
{
    text_reserve(text, NUM_FLOAT_MAX);
    text->len += num_print_float(text->data + text->len, value);
}

void text_vfmt(struct text *text, const char *format, va_list args)
{
    va_list again;
    va_copy(again, args);
    size_t room = text->cap - text->len;
    int len = vsnprintf(room ? text->data + text->len : NULL, room, format, args);
    if (len > 0 && (size_t)len >= room) {
        text_reserve(text, (size_t)len + 1);
        vsnprintf(text->data + text->len, (size_t)len + 1, format, again);
    }
    text->len += len > 0 ? (size_t)len : 0;
    va_end(again);
}

void text_fmt(struct text *text, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    text_vfmt(text, format, args);
    va_end(args);
}

void text_count(struct text *text, uint32_t n, const char *one, const char *many)
{
    text_u32(text, n);
    text_char(text, ' ');
    text_str(text, n == 1 ? one : many);
}

/*
 * Length of the UTF-8 sequence at p (1 to 4), and its code point; 0 if it is invalid (RFC 3629).
 */
static size_t utf8_read(const unsigned char *p, size_t len, uint32_t *out_code)
{
    static const uint32_t least[5] = {0, 0, 0x80, 0x800, 0x10000};
    *out_code = p[0];
    if (p[0] < 0x80)
        return 1;
    size_t n = p[0] >= 0xf0 && p[0] < 0xf5   ? 4
               : p[0] >= 0xe0 && p[0] < 0xf0 ? 3
               : p[0] >= 0xc2 && p[0] < 0xe0 ? 2
                                             : 0;
    if (n == 0 || n > len)
        return 0;
    uint32_t code = p[0] & (0x7fu >> n);
    for (size_t i = 1; i < n; i++) {
        if ((p[i] & 0xc0) != 0x80)
            return 0;
        code = code << 6 | (p[i] & 0x3fu);
    }
    *out_code = code;
    return code < least[n] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000) ? 0 : n;
}

size_t text_copy(const char *text, size_t len, char *buffer, size_t capacity)
{
    if (!buffer || !capacity)
        return len;
    size_t copied = len < capacity ? len : capacity - 1;
    if (copied)
        memcpy(buffer, text, copied);
    buffer[copied] = '\0';
    return len;
}

bool text_is_utf8(const char *bytes, size_t len)
{
    const unsigned char *p = (const unsigned char *)bytes;
    for (uint32_t code; len;) {
        size_t n = utf8_read(p, len, &code);
        if (!n)
            return false;
        p += n;
        len -= n;
    }
    return true;
}

/* Most characters are of ASCII. */
static bool is_hidden(uint32_t code)
{
    return (code < ' ' || code >= 0x7f) && hidden_code(code);
}

void text_show(struct text *text, size_t begin)
{
    char *out = text->data + begin;
    for (size_t i = begin, n; i < text->len; i += n ? n : 1) {
        uint32_t code;
        n = utf8_read((const unsigned char *)text->data + i, text->len - i, &code);
        if (n == 0 || (is_hidden(code) && code != '\t')) {
            *out++ = '?';
            continue;
        }
        memmove(out, text->data + i, n);
        out += n;
    }
    text->len = (size_t)(out - text->data);
}

/* A code point in a JSON string, beyond 16 bits as two surrogates (RFC 8259, section 7). */
static void put_escape(struct text *text, uint32_t code)
{
    if (code >= 0x10000) {
        text_fmt(text, "\\u%04x", (unsigned)(0xd800 + ((code - 0x10000) >> 10)));
        code = 0xdc00 + ((code - 0x10000) & 0x3ff);
    }
    text_fmt(text, "\\u%04x", (unsigned)code);
}

void text_json_string(struct text *text, const char *bytes, size_t len)
{
    const unsigned char *p = (const unsigned char *)bytes, *end = p + len;
    text_char(text, '"');
    for (uint32_t code; p < end;) {
        size_t n = utf8_read(p, (size_t)(end - p), &code);
        if (*p == '"' || *p == '\\') {
            text_char(text, '\\');
            text_char(text, (char)*p);
        } else if (n && is_hidden(code)) {
            put_escape(text, code);
        } else if (n == 0) {
            text_str(text, "\xef\xbf\xbd");
        } else {
            text_mem(text, (const char *)p, n);
        }
        p += n ? n : 1;
    }
    text_char(text, '"');
}

const char *text_cstr(struct text *text)
{
    text_reserve(text, 1);
    text->data[text->len] = '\0';
    return text->data;
}

size_t text_width(const char *bytes, size_t len)
{
    static const struct {
        uint32_t first, last;
        size_t width;
    } ranges[] = {{0x0300, 0x036f, 0},   {0x1100, 0x115f, 2},   {0x200b, 0x200f, 0},
                  {0x20d0, 0x20ff, 0},   {0x2e80, 0x303e, 2},   {0x3041, 0xa4cf, 2},
                  {0xac00, 0xd7a3, 2},   {0xf900, 0xfaff, 2},   {0xfe00, 0xfe0f, 0},
                  {0xfe30, 0xfe6f, 2},   {0xff00, 0xff60, 2},   {0xffe0, 0xffe6, 2},
                  {0x1f300, 0x1f64f, 2}, {0x1f900, 0x1f9ff, 2}, {0x20000, 0x3fffd, 2}};
    size_t width = 0;
    for (size_t i = 0, n; i < len; i += n ? n : 1) {
        uint32_t point;
        n = utf8_read((const unsigned char *)bytes + i, len - i, &point);
        size_t one = 1;
        for (size_t k = 0; n && !is_hidden(point) && k < sizeof ranges / sizeof *ranges; k++)
            if (point >= ranges[k].first && point <= ranges[k].last)
                one = ranges[k].width;
        width += one;
    }
    return width;
}
