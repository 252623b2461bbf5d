// SPDX-License-Identifier: Apache-2.0
#include "shader/shader.h"

static bool is_digit(char c)
{
    return (unsigned char)(c - '0') < 10;
}

static bool is_letter(char c)
{
    return (unsigned char)((c | 0x20) - 'a') < 26;
}

/* GLSL 4.50, section 3.7: names with "__" or "gl_" in front are the implementation's. */
static bool is_reserved_prefix(const char *text, size_t len)
{
    return len >= 3 && memcmp(text, "gl_", 3) == 0;
}

/*
 * What may stand in an identifier: 1 for letters and digits, 2 for '_', which may not stand twice.
 */
#define ROW_OF(c) c, c, c, c, c, c, c, c, c, c, c, c, c
static const uint8_t word_characters[256] = {
    ['0'] = 1,         1,         1, 1, 1, 1, 1, 1, 1, 1, ['A'] = ROW_OF(1), ROW_OF(1), ['_'] = 2,
    ['a'] = ROW_OF(1), ROW_OF(1),
};

/*
 * Compilers refuse names of more than 1,024 characters; a number may come behind this, and the name
 * of a graph before it.
 */
enum { MAX_LENGTH = 240 };

/*
 * Eight characters at a time, of which each has a byte of a word: its highest bit says whether
 * something is true of it.
 */
#define EACH(byte) ((uint64_t)0x0101010101010101 * (byte))

static inline uint64_t which_are(uint64_t characters, unsigned first, unsigned last)
{
    return (characters + EACH(0x80 - first)) & ~(characters + EACH(0x7f - last)) & EACH(0x80);
}

static inline bool are_word_characters(const char *text)
{
    uint64_t c;
    memcpy(&c, text, sizeof c);
    uint64_t low = which_are(c, '_', '_'), letters = which_are(c | EACH(0x20), 'a', 'z'),
             digits = which_are(c, '0', '9');
    return !(c & EACH(0x80)) && (letters | digits | low) == EACH(0x80) && !(low & low << 8);
}

/* Each eight overlap those before, so that some hold both of any two in a row. */
static bool is_long_identifier(const char *text, size_t len)
{
    for (size_t i = 0; i + 8 < len; i += 7)
        if (!are_word_characters(text + i))
            return false;
    return are_word_characters(text + len - 8);
}

static bool is_identifier(const char *text, size_t len)
{
    if (len == 0 || len > MAX_LENGTH || is_digit(text[0]) || is_reserved_prefix(text, len))
        return false;
    if (len >= 8)
        return is_long_identifier(text, len);
    unsigned last = 1;
    for (size_t i = 0; i < len; i++) {
        unsigned kind = word_characters[(unsigned char)text[i]];
        if (!kind || (kind & last & 2))
            return false;
        last = kind;
    }
    return true;
}

const char *identifier_from(const char *text, size_t len, struct arena *arena, size_t *out_len)
{
    *out_len = len;
    if (is_identifier(text, len))
        return text;
    len = len < MAX_LENGTH ? len : MAX_LENGTH;
    char *out = arena_alloc(arena, len + 2);
    size_t n = 0;
    if (len == 0 || is_digit(text[0]) || is_reserved_prefix(text, len))
        out[n++] = 'x';
    for (size_t i = 0; i < len; i++) {
        char c = is_letter(text[i]) || is_digit(text[i]) ? text[i] : '_';
        if (c != '_' || n == 0 || out[n - 1] != '_')
            out[n++] = c;
    }
    out[n] = '\0';
    *out_len = n;
    return out;
}
