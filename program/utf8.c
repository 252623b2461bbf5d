// SPDX-License-Identifier: Apache-2.0
#include "program/utf8.h"

#include "program/memory.h"
#include "src/base/hidden_chars.h"

#include <stdint.h>
#include <string.h>

size_t utf8_length(const char *bytes)
{
    const unsigned char *text = (const unsigned char *)bytes;
    unsigned char lead = text[0], low = 0x80, high = 0xbf;
    if (lead < 0x80)
        return 1;
    size_t len = lead >= 0xc2 && lead <= 0xdf   ? 2
                 : lead >= 0xe0 && lead <= 0xef ? 3
                 : lead >= 0xf0 && lead <= 0xf4 ? 4
                                                : 0;
    if (lead == 0xe0)
        low = 0xa0;
    else if (lead == 0xed)
        high = 0x9f;
    else if (lead == 0xf0)
        low = 0x90;
    else if (lead == 0xf4)
        high = 0x8f;
    for (size_t i = 1; i < len; ++i) {
        if (text[i] < low || text[i] > high)
            return 0;
        low = 0x80;
        high = 0xbf;
    }
    return len;
}

/* `len` 1 to 4. */
static uint32_t decode(const char *text, size_t len)
{
    static const unsigned char lead_bits[] = {0, 0x7f, 0x1f, 0x0f, 0x07};
    uint32_t code = (unsigned char)text[0] & lead_bits[len];
    for (size_t i = 1; i < len; ++i)
        code = code << 6 | ((unsigned char)text[i] & 0x3f);
    return code;
}

bool utf8_is_hidden(const char *text, size_t len)
{
    return hidden_code(len ? decode(text, len) : 0);
}

void utf8_clean(char *text)
{
    char *out = text;
    for (size_t len, step; *text; text += step) {
        len = utf8_length(text);
        step = len ? len : 1;
        bool is_hidden = utf8_is_hidden(text, len) && *text != '\n' && *text != '\t';
        if (is_hidden)
            *out++ = '?';
        else
            memmove(out, text, step);
        out += is_hidden ? 0 : step;
    }
    *out = '\0';
}

char *utf8_repair(const char *text)
{
    static const char replacement[] = "\xef\xbf\xbd";
    char *repaired = memory_alloc(strlen(text) * 3 + 1), *out = repaired;
    while (*text) {
        size_t len = utf8_length(text);
        memcpy(out, len ? text : replacement, len ? len : 3);
        out += len ? len : 3;
        text += len ? len : 1;
    }
    return repaired;
}
