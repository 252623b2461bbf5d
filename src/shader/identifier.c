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
size_t identifier_from(const char *text, size_t len, char *out)
{
    size_t n = 0;
    if (len == 0 || is_digit(text[0]) || (len >= 3 && memcmp(text, "gl_", 3) == 0))
        out[n++] = 'x';
    for (size_t i = 0; i < len; i++) {
        char c = is_letter(text[i]) || is_digit(text[i]) ? text[i] : '_';
        if (c != '_' || n == 0 || out[n - 1] != '_')
            out[n++] = c;
    }
    return n;
}
