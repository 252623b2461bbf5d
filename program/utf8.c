// SPDX-License-Identifier: Apache-2.0
#include "program/utf8.h"

#include "program/memory.h"

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

void utf8_clean(char *text)
{
    char *out = text;
    for (const char *at = text; *at; ++at) {
        unsigned char byte = (unsigned char)*at, next = (unsigned char)at[1];
        bool is_c0 = (byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7f,
             is_c1 = byte == 0xc2 && next >= 0x80 && next < 0xa0; /* two bytes in UTF-8 */
        *out++ = is_c0 || is_c1 ? '?' : *at;
        at += is_c1;
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
