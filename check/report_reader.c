// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#define _FILE_OFFSET_BITS 64
#include "check/report_reader.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const char damaged[] = "it is no report of mxgen check, or only a part of one";

static void append(struct report_reader *reader, int c)
{
    if (reader->size + 2 > reader->capacity) {
        size_t capacity = reader->capacity ? reader->capacity * 2 : 4096;
        char *more = realloc(reader->text, capacity);
        if (!more) {
            reader->fault = "out of memory";
            return;
        }
        reader->text = more;
        reader->capacity = capacity;
    }
    reader->text[reader->size++] = (char)c;
    reader->text[reader->size] = '\0';
}

static int next_char(struct report_reader *reader)
{
    int c = getc(reader->in);
    while (c != EOF && isspace(c))
        c = getc(reader->in);
    return c;
}

/* Copies a string whose first quote stands in the text already. */
static bool copy_string(struct report_reader *reader)
{
    for (int c; (c = getc(reader->in)) != EOF && !reader->fault;) {
        append(reader, c);
        if (c == '\\' && (c = getc(reader->in)) != EOF)
            append(reader, c);
        else if (c == '"')
            return true;
    }
    return false;
}

/* Copies an object whose first bracket stands in the text already. */
static bool copy_object(struct report_reader *reader)
{
    int depth = 1;
    for (int c; depth && !reader->fault;) {
        c = getc(reader->in);
        if (c == EOF)
            return false;
        append(reader, c);
        if (c == '"' && !copy_string(reader))
            return false;
        depth += (c == '{') + (c == '[');
        depth -= (c == '}') + (c == ']');
    }
    return !reader->fault;
}

/* Up to the documents: the text is then "{… "documents":[", which is closed to be read. */
static bool read_header(struct report_reader *reader)
{
    static const char key[] = "\"documents\":[";
    reader->size = 0;
    while (reader->size < sizeof key
           || memcmp(reader->text + reader->size - (sizeof key - 1), key, sizeof key - 1) != 0) {
        int c = next_char(reader);
        if (c == EOF || reader->fault || reader->size > 1u << 20)
            return false;
        append(reader, c);
        if (c == '"' && !copy_string(reader))
            return false;
    }
    append(reader, ']');
    append(reader, '}');
    if (reader->fault)
        return false;
    reader->header = json_parse(&reader->store, reader->text, reader->size);
    return reader->header && strcmp(json_get_text(reader->header, "format"), "mxgen-check") == 0;
}

bool reader_open(struct report_reader *reader, const char *path)
{
    *reader = (struct report_reader){.in = fopen(path, "r")};
    if (!reader->in)
        reader->fault = strerror(errno);
    else if (!read_header(reader) && !reader->fault)
        reader->fault = damaged;
    else if (reader->header && json_get_count(reader->header, "version") != CHECK_FORMAT_VERSION)
        reader->fault = "it is of another version of the format";
    return !reader->fault;
}

void reader_close(struct report_reader *reader)
{
    if (reader->in)
        fclose(reader->in);
    free(reader->text);
    store_finish(&reader->store);
}

bool reader_next(struct report_reader *reader)
{
    reader->size = 0;
    int c = reader->fault ? EOF : next_char(reader);
    if (c == ',')
        c = next_char(reader);
    if (c == ']' || reader->fault)
        return false;
    append(reader, c);
    if (c == '{' && copy_object(reader))
        return true;
    if (!reader->fault)
        reader->fault = damaged;
    return false;
}

uint64_t reader_offset(const struct report_reader *reader)
{
    off_t at = ftello(reader->in);
    return at < 0 ? 0 : (uint64_t)at - reader->size;
}

bool reader_read_at(struct report_reader *reader, uint64_t offset)
{
    return fseeko(reader->in, (off_t)offset, SEEK_SET) == 0 && reader_next(reader);
}
