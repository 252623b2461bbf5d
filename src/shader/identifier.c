// SPDX-License-Identifier: Apache-2.0
#include "shader/shader.h"

#include <assert.h>

static bool is_digit(char c)
{
    return (unsigned char)(c - '0') < 10;
}

static bool is_letter(char c)
{
    return (unsigned char)((c | 0x20) - 'a') < 26;
}

/* GLSL 4.50, section 3.7: the implementation owns names with "__" or with the prefix "gl_". */
static bool is_reserved_prefix(const char *text, size_t len)
{
    return len >= 3 && memcmp(text, "gl_", 3) == 0;
}

/*
 * Compilers refuse names of more than 1,024 characters. A name may get a number as suffix, and the
 * name of a graph as prefix.
 */
enum { MAX_LENGTH = 240 };

bool identifier_is(const char *text, size_t len)
{
    if (len == 0 || len > MAX_LENGTH || is_digit(text[0]) || is_reserved_prefix(text, len))
        return false;
    for (size_t i = 0; i < len; i++) {
        bool is_word = is_letter(text[i]) || is_digit(text[i]);
        if (!is_word && (text[i] != '_' || (i > 0 && text[i - 1] == '_')))
            return false;
    }
    return true;
}

const char *identifier_from(const char *text, size_t len, struct arena *arena, size_t *out_len)
{
    *out_len = len;
    if (identifier_is(text, len))
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
    assert(n > 0 && n <= len + 1);
    out[n] = '\0';
    *out_len = n;
    return out;
}
