// SPDX-License-Identifier: Apache-2.0
#include "program/markup.h"

#include "program/utf8.h"

#include <assert.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

static void put_text(FILE *out, const char *text)
{
    static const struct {
        char character;
        const char *entity;
    } entities[] = {{'<', "&lt;"}, {'>', "&gt;"}, {'&', "&amp;"}, {'"', "&quot;"}, {'\'', "&#39;"}};
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

/* An argument that is a number: `spec` is "%5.2f" or "%lu", which ends at its letter. */
static void put_number(FILE *out, const char *spec, size_t len, va_list *args)
{
    char one[16];
    char letter = spec[len - 1], length = len > 2 ? spec[len - 2] : '%';
    assert(len < sizeof one);
    memcpy(one, spec, len);
    one[len] = '\0';
    if (letter == 'f' || letter == 'g')
        fprintf(out, one, va_arg(*args, double));
    else if (letter == 'd')
        fprintf(out, one, va_arg(*args, int));
    else if (length == 'z')
        fprintf(out, one, va_arg(*args, size_t));
    else if (length == 'l')
        fprintf(out, one, va_arg(*args, unsigned long));
    else
        fprintf(out, one, va_arg(*args, unsigned));
}

void markup_put(struct markup *out, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    while (*format) {
        size_t plain = strcspn(format, "%");
        fwrite(format, 1, plain, out->file);
        format += plain;
        if (!*format)
            break;
        size_t len = strcspn(format + 1, "sudfg%") + 2;
        char letter = format[len - 1];
        assert(letter);
        if (letter == 's')
            put_text(out->file, va_arg(args, const char *));
        else if (letter == '%')
            putc('%', out->file);
        else
            put_number(out->file, format, len, &args);
        format += len;
    }
    va_end(args);
}

void markup_lines(struct markup *out, const char *const *lines)
{
    for (; *lines; ++lines)
        fputs(*lines, out->file);
}
