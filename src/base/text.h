// SPDX-License-Identifier: Apache-2.0
/*
 * A growing text: mxgen writes all its output with it. The only failure of an append is out of
 * memory (mem.h).
 */
#ifndef MXG_BASE_TEXT_H
#define MXG_BASE_TEXT_H

#include "base/mem.h"

struct text {
    struct arena *arena;
    char *data; /* not NUL-terminated until text_cstr */
    size_t len, cap;
};

void text_init(struct text *text, struct arena *arena);

/* Reserves `more` bytes after the end, at text->data + text->len. */
void text_reserve(struct text *text, size_t more);

/* Words are short: two copies that overlap do for any length between theirs and twice theirs. */
static inline void text_copy(char *to, const char *from, size_t len)
{
    if (len > 16) {
        memcpy(to, from, len);
    } else if (len >= 8) {
        memcpy(to, from, 8);
        memcpy(to + len - 8, from + len - 8, 8);
    } else if (len >= 4) {
        memcpy(to, from, 4);
        memcpy(to + len - 4, from + len - 4, 4);
    } else if (len) {
        to[0] = from[0];
        to[len / 2] = from[len / 2];
        to[len - 1] = from[len - 1];
    }
}

static inline void text_mem(struct text *text, const char *bytes, size_t len)
{
    if (text->cap - text->len < len)
        text_reserve(text, len);
    text_copy(text->data + text->len, bytes, len);
    text->len += len;
}

/*
 * A word that is written often. It is copied in whole blocks, which costs less than to find out how
 * long it is: so many bytes may be read at `bytes`.
 */
enum { TEXT_BLOCK = 16 };
struct text_word {
    const char *bytes;
    uint32_t len;
};

static inline void text_put(struct text *text, struct text_word word)
{
    if (text->cap - text->len < (size_t)word.len + TEXT_BLOCK)
        text_reserve(text, (size_t)word.len + TEXT_BLOCK);
    char *to = text->data + text->len;
    memcpy(to, word.bytes, TEXT_BLOCK);
    for (uint32_t i = TEXT_BLOCK; i < word.len; i += TEXT_BLOCK)
        memcpy(to + i, word.bytes + i, TEXT_BLOCK);
    text->len += word.len;
}

static inline void text_char(struct text *text, char c)
{
    if (text->cap == text->len)
        text_reserve(text, 1);
    text->data[text->len++] = c;
}

static inline void text_str(struct text *text, const char *z)
{
    text_mem(text, z, strlen(z));
}

/* A word with a copy of these bytes. */
struct text_word text_word_of(struct arena *arena, const char *bytes, size_t len);

void text_u32(struct text *text, uint32_t value);
void text_i32(struct text *text, int32_t value);
void text_hex64(struct text *text, uint64_t value); /* 16 digits */

/*
 * Writes the shortest decimal that parses to the same float, always with '.' or an exponent; "inf",
 * "-inf", "nan".
 */
void text_other_float(struct text *text, float value);
static inline void text_float(struct text *text, float value)
{
    uint32_t bits; /* -0.0 is a float of its own */
    memcpy(&bits, &value, sizeof bits);
    bool is_small = bits >> 31 == 0 && value < 10.0f;
    int digit = is_small ? (int)value : 0;
    if (!is_small || value != (float)digit) {
        text_other_float(text, value);
        return;
    }
    const char small[3] = {(char)('0' + digit), '.', '0'}; /* most numbers of a shader */
    text_mem(text, small, sizeof small);
}

/* Like printf. For messages, not for floats: they would have the decimal point of the locale. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void text_fmt(struct text *text, const char *format, ...);

/* A JSON string literal with its quotes; invalid UTF-8 becomes U+FFFD. */
void text_json_string(struct text *text, const char *bytes, size_t len);

/* The text with a NUL; valid until the next append. */
const char *text_cstr(struct text *text);

#endif
