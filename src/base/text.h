// SPDX-License-Identifier: Apache-2.0
/*
 * A growing text: mxgen writes all its output with it. The only failure of an append is out of
 * memory (mem.h).
 */
#ifndef MXG_BASE_TEXT_H
#define MXG_BASE_TEXT_H

#include "base/mem.h"

#include <stdarg.h>

struct text {
    struct arena *arena;
    char *data; /* not NUL-terminated until text_cstr */
    size_t len, cap;
};

void text_init(struct text *text, struct arena *arena);

/* Reserves `more` bytes after the end, at text->data + text->len. */
void text_reserve(struct text *text, size_t more);

static inline void text_mem(struct text *text, const char *bytes, size_t len)
{
    if (text->cap - text->len < len)
        text_reserve(text, len);
    if (len)
        memcpy(text->data + text->len, bytes, len);
    text->len += len;
}

/* A text with its length, which lives elsewhere. */
struct text_word {
    const char *bytes;
    size_t len;
};

bool text_ends_with(const char *text, const char *end);
/*
 * Takes the next word of a list with commas, without the blanks around it; false: the list ends.
 * `rest` is what follows.
 */
bool text_next_item(const char **rest, struct text_word *out);

static inline void text_put(struct text *text, struct text_word word)
{
    text_mem(text, word.bytes, word.len);
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

void text_u32(struct text *text, uint32_t value);
void text_i32(struct text *text, int32_t value);
void text_hex64(struct text *text, uint64_t value); /* 16 digits */

/*
 * Writes the shortest decimal that parses to the same float, always with '.' or an exponent; "inf",
 * "-inf", "nan".
 */
void text_float(struct text *text, float value);

/* Like printf. For messages, not for floats: they would have the decimal point of the locale. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void text_fmt(struct text *text, const char *format, ...);
void text_vfmt(struct text *text, const char *format, va_list args);
/* "1 slab" or "3 slabs" */
void text_count(struct text *text, uint32_t n, const char *one, const char *many);

/*
 * Copies a text to the buffer of a caller as far as it fits, with a NUL; returns `len`. The buffer
 * may be NULL.
 */
size_t text_copy(const char *text, size_t len, char *buffer, size_t capacity);

/* True if all bytes are valid UTF-8 (RFC 3629). */
bool text_is_utf8(const char *bytes, size_t len);

/*
 * The columns of a terminal that a text in UTF-8 takes: 2 for wide characters of East Asia and
 * pictures, 0 for marks on others (Unicode, UAX #11), 1 otherwise, as for a hidden character.
 */
size_t text_width(const char *bytes, size_t len);

/*
 * Makes fit for people what was appended from `begin`: '?' stands for hidden characters
 * (hidden_chars.h) but tabs, for line ends, and for bytes that are no UTF-8.
 */
void text_show(struct text *text, size_t begin);

/*
 * A JSON string literal with its quotes; invalid UTF-8 becomes U+FFFD, hidden characters are
 * escaped.
 */
void text_json_string(struct text *text, const char *bytes, size_t len);

/* The text with a NUL; valid until the next append. */
const char *text_cstr(struct text *text);

#endif
