// SPDX-License-Identifier: Apache-2.0
#include "program/markup.h"

#include "program/utf8.h"

#include <stdbool.h>

void markup_text(FILE *out, const char *text)
{
    static const struct {
        char character;
        const char *entity;
    } entities[] = {{'<', "&lt;"}, {'>', "&gt;"}, {'&', "&amp;"}, {'"', "&quot;"}};
    while (*text) {
        size_t len = utf8_length(text), i = 0;
        bool is_control = (unsigned char)*text < 0x20 && *text != '\t' && *text != '\n';
        while (i < sizeof entities / sizeof *entities && entities[i].character != *text)
            ++i;
        if (i < sizeof entities / sizeof *entities)
            fputs(entities[i].entity, out);
        else if (len == 0 || is_control)
            putc('?', out);
        else
            fwrite(text, 1, len, out);
        text += len ? len : 1;
    }
}

void markup_lines(FILE *out, const char *const *lines)
{
    for (; *lines; ++lines)
        fputs(*lines, out);
}
