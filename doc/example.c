// SPDX-License-Identifier: Apache-2.0
/* Examples of messages (mxg_diagnostic_kind): text with a mark at the start of each line. */
#include "program/files.h"
#include "program/memory.h"
#include "program/utf8.h"
#include "doc/messages.h"

#include <stdlib.h>
#include <string.h>

struct line {
    char side; /* '-', '+', ' ': the side; '=': the name of a file; '$': arguments */
    char of;   /* for '$': the side */
    const char *text;
    size_t len;
};

static bool next_line(const char **at, struct line *out)
{
    const char *text = *at;
    if (!*text)
        return false;
    size_t len = strcspn(text, "\n");
    *at = text + len + (text[len] == '\n');
    size_t skip = text[0] == '=' || text[1] == '$' ? 3 : 2;
    *out = (struct line){.side = text[1] == '$' || text[0] == '$' ? '$' : text[0],
                         .of = text[1] == '$' ? text[0] : ' '};
    out->text = text + (skip < len ? skip : len);
    out->len = len - (skip < len ? skip : len);
    return true;
}

/* Examples contain apostrophes for the quotation marks of XML. */
static void put(FILE *out, const char *text, size_t len)
{
    for (size_t i = 0; i < len; ++i)
        fputc(text[i] == '\'' ? '"' : text[i], out);
}

/*
 * Prints a text for people; invalid UTF-8 bytes, which some examples contain on purpose, appear as
 * numbers.
 */
static void put_shown(FILE *out, const char *text, size_t len)
{
    for (size_t i = 0, part; i < len; i += part ? part : 1) {
        part = utf8_length(text + i);
        if (part)
            put(out, text + i, part);
        else
            fprintf(out, "\\x%02X", (unsigned)(unsigned char)text[i]);
    }
}

/* Prints arguments only if the two sides differ, or if they matter. */
void example_print(const char *example, const char *indent, FILE *out)
{
    struct line line;
    while (next_line(&example, &line)) {
        if (line.side == '$')
            fprintf(out, "%s%c mxgen ", indent, line.of);
        else if (line.side == '=')
            fprintf(out, "%s== ", indent);
        else
            fprintf(out, "%s%c ", indent, line.side);
        put_shown(out, line.text, line.len);
        fputc('\n', out);
    }
}

static bool is_on(const struct line *line, char side)
{
    char of = line->side == '$' ? line->of : line->side;
    return of == ' ' || of == side;
}

/* The arguments of one side. */
static char *arguments_of(const char *example, char side)
{
    struct line line;
    while (next_line(&example, &line))
        if (line.side == '$' && is_on(&line, side))
            return cli_format("%.*s\n", (int)line.len, line.text);
    return cli_format("validate example.mtlx\n");
}

struct example_file {
    char *name;
    struct memory_bytes text;
    bool is_whole; /* the file has its own <materialx> element */
    bool is_there; /* the file exists on this side */
};

static void write_text(struct cli *cli, const char *folder, const char *name, const char *text,
                       size_t len)
{
    char *path = cli_format("%s/%s", folder, name);
    const char *fault = files_write(path, text, len);
    if (fault)
        report_error(&cli->report, "output-failed", "cannot write '%s': %s", path, fault);
    free(path);
}

static void finish_file(struct cli *cli, const char *folder, struct example_file *file)
{
    static const char end[] = "</materialx>\n";
    if (file->is_there && !file->is_whole)
        memory_append(&file->text, end, sizeof end - 1);
    if (file->is_there)
        write_text(cli, folder, file->name, file->text.data, file->text.size);
    free(file->name);
    free(file->text.data);
    *file = (struct example_file){0};
}

static void begin_file(struct example_file *file, const struct line *name)
{
    static const char begin[] = "<?xml version=\"1.0\"?>\n<materialx version=\"1.39\">\n";
    *file = (struct example_file){.name = name ? cli_format("%.*s", (int)name->len, name->text)
                                               : cli_format("example.mtlx"),
                                  .is_whole = name != NULL};
    memory_append(&file->text, begin, name ? 0 : sizeof begin - 1);
}

/* Writes one side of an example as files in a folder, with its arguments in "arguments". */
static void write_side(struct cli *cli, const char *example, char side, const char *folder)
{
    struct example_file file = {0};
    struct line line;
    const char *fault = files_make_folder(folder);
    if (fault) {
        report_error(&cli->report, "output-failed", "cannot make the folder '%s': %s", folder,
                     fault);
        return;
    }
    char *arguments = arguments_of(example, side);
    write_text(cli, folder, "arguments", arguments, strlen(arguments));
    free(arguments);
    while (next_line(&example, &line)) {
        if (line.side == '=') {
            finish_file(cli, folder, &file);
            begin_file(&file, &line);
        } else if (line.side != '$' && is_on(&line, side)) {
            if (!file.name)
                begin_file(&file, NULL);
            for (size_t i = 0; i < line.len; ++i)
                memory_append(&file.text, line.text[i] == '\'' ? "\"" : &line.text[i], 1);
            memory_append(&file.text, "\n", 1);
            file.is_there = true;
        }
    }
    finish_file(cli, folder, &file);
}

void example_write(struct cli *cli, const mxg_diagnostic_kind *kind, const char *folder)
{
    const char *const names[] = {"wrong", "right"};
    for (int i = 0; i < 2 && *kind->example; ++i) {
        char *path = cli_format("%s/%s/%s", folder, kind->id, names[i]);
        write_side(cli, kind->example, "-+"[i], path);
        free(path);
    }
}
