// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#define _FILE_OFFSET_BITS 64
#include "check/report_reader.h"

#include "check/record.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_HEADER = 1 << 20 };

static const char damaged[] = "it is no report of mxgen check, or only a part of one";

static int next_char(FILE *in)
{
    int c = getc(in);
    while (c != EOF && isspace(c))
        c = getc(in);
    return c;
}

/*
 * Reads the report up to the documents, without white space, and closes the open braces, so that
 * the text is complete JSON. False: there are no documents.
 */
static bool read_header(FILE *in, char *text)
{
    static const char key[] = "\"documents\":[";
    const size_t len = sizeof key - 1;
    bool in_string = false;
    size_t size = 0;
    while (size < len || memcmp(text + size - len, key, len) != 0) {
        int c = in_string ? getc(in) : next_char(in);
        if (c == EOF || size + sizeof "x]}" > MAX_HEADER)
            return false;
        text[size++] = (char)c;
        if (in_string && c == '\\')
            text[size++] = (char)getc(in);
        else if (c == '"')
            in_string = !in_string;
    }
    strcpy(text + size, "]}");
    return true;
}

bool reader_open(struct report_reader *reader, const char *path)
{
    *reader = (struct report_reader){.in = fopen(path, "r")};
    char *text = malloc(MAX_HEADER);
    if (!reader->in || !text)
        reader->fault = strerror(errno);
    else if (read_header(reader->in, text))
        reader->header = json_loads(text, 0, NULL);
    free(text);
    if (!reader->fault && strcmp(json_text_of(reader->header, "format"), "mxgen-check") != 0)
        reader->fault = damaged;
    else if (!reader->fault && json_count_of(reader->header, "version") != CHECK_FORMAT_VERSION)
        reader->fault = "it is of another version of the format";
    return !reader->fault;
}

void reader_close(struct report_reader *reader)
{
    if (reader->in)
        fclose(reader->in);
    json_decref(reader->header);
    json_decref(reader->document);
    json_decref(reader->tail);
}

static void count_document(struct report_reader *reader)
{
    ++reader->documents;
    reader->failed += strcmp(json_text_of(reader->document, "status"), "failed") == 0;
    reader->elements += json_array_size(json_object_get(reader->document, "elements"));
}

/* Reads what stands behind the documents: ',"summary":{…}}'. */
static void read_tail(struct report_reader *reader)
{
    if (reader->fault || reader->tail)
        return;
    if (next_char(reader->in) == ',') {
        ungetc('{', reader->in);
        reader->tail = json_loadf(reader->in, 0, NULL);
    }
    const json_t *summary = json_object_get(reader->tail, "summary");
    if (!summary)
        reader->fault = damaged;
    else if (json_count_of(summary, "documents") != reader->documents
             || json_count_of(summary, "failed") != reader->failed
             || json_count_of(summary, "elements") != reader->elements)
        reader->fault = "its summary counts other documents than those in it";
}

bool reader_next(struct report_reader *reader, uint64_t *out_offset)
{
    json_decref(reader->document);
    reader->document = NULL;
    int c = reader->fault ? ']' : next_char(reader->in);
    if (c == ',')
        c = next_char(reader->in);
    if (c == ']') {
        read_tail(reader);
        return false;
    }
    ungetc(c, reader->in);
    off_t at = ftello(reader->in);
    if (out_offset)
        *out_offset = at < 0 ? 0 : (uint64_t)at;
    reader->document = c == '{' ? json_loadf(reader->in, JSON_DISABLE_EOF_CHECK, NULL) : NULL;
    if (reader->document)
        count_document(reader);
    else
        reader->fault = damaged;
    return reader->document != NULL;
}

bool reader_read_at(struct report_reader *reader, uint64_t offset)
{
    return fseeko(reader->in, (off_t)offset, SEEK_SET) == 0 && reader_next(reader, NULL);
}
