// SPDX-License-Identifier: Apache-2.0
/* mxgen explain: cause, example and cure of every message. */
#include "cli/cli.h"
#include "cli/memory.h"
#include "cli/files.h"
#include "cli/utf8.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 100 };

static const char *const severities[] = {"error", "warning", "note"};

/* ---- Examples: a line at a time (mxg_diagnostic_kind) ---- */

struct line {
    char side; /* '-', '+', ' ': of which side it is; '=': the name of a file; '$': arguments */
    char of;   /* of '$': the side */
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

/* Examples are written with apostrophes where XML has quotation marks. */
static void put(FILE *out, const char *text, size_t len)
{
    for (size_t i = 0; i < len; ++i)
        fputc(text[i] == '\'' ? '"' : text[i], out);
}

/* For people: bytes that are no UTF-8, which an example is about, by their number. */
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

/* What the wrong and the right side have as arguments differs, or is worth telling. */
static void print_example(const char *example, const char *indent, FILE *out)
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
    char *name, *text;
    size_t len;
    bool is_whole; /* it needs no <materialx> around it */
    bool is_there; /* on this side */
};

static void append(struct example_file *file, const char *text, size_t len)
{
    file->text = memory_resize(file->text, file->len + len + 1);
    memcpy(file->text + file->len, text, len);
    file->len += len;
}

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
        append(file, end, sizeof end - 1);
    if (file->is_there)
        write_text(cli, folder, file->name, file->text, file->len);
    free(file->name);
    free(file->text);
    *file = (struct example_file){0};
}

static void begin_file(struct example_file *file, const struct line *name)
{
    static const char begin[] = "<?xml version=\"1.0\"?>\n<materialx version=\"1.39\">\n";
    *file = (struct example_file){.name = name ? cli_format("%.*s", (int)name->len, name->text)
                                               : cli_format("example.mtlx"),
                                  .is_whole = name != NULL};
    append(file, begin, name ? 0 : sizeof begin - 1);
}

/* One side of an example as files in a folder, its arguments in "arguments". */
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
                append(&file, line.text[i] == '\'' ? "\"" : &line.text[i], 1);
            append(&file, "\n", 1);
            file.is_there = true;
        }
    }
    finish_file(cli, folder, &file);
}

/* ---- Texts ---- */

static void print_wrapped(const char *text, FILE *out)
{
    for (size_t column = 0; *text; text += strspn(text, " ")) {
        size_t len = strcspn(text, " ");
        if (column && column + 1 + len > WIDTH) {
            fputc('\n', out);
            column = 0;
        }
        fprintf(out, "%s%.*s", column ? " " : "", (int)len, text);
        column += len + (column ? 1 : 0);
        text += len;
    }
    fputc('\n', out);
}

static void print_kind(const mxg_diagnostic_kind *kind)
{
    printf("%s [%s]\n    %s\n\n", severities[kind->severity], kind->id, kind->message);
    print_wrapped(kind->cause, stdout);
    fputs("\nWhat to do: ", stdout);
    print_wrapped(kind->cure, stdout);
    if (*kind->example) {
        fputs("\nExample ('-' is wrong, '+' is right):\n\n", stdout);
        print_example(kind->example, "    ", stdout);
    }
}

static void print_section(const mxg_diagnostic_kind *kind)
{
    printf("\n## %s\n\n", kind->id);
    print_wrapped(kind->cause, stdout);
    fputs("\n*What to do:* ", stdout);
    print_wrapped(kind->cure, stdout);
    if (!*kind->example)
        return;
    fputs("\n```diff\n", stdout);
    print_example(kind->example, "", stdout);
    fputs("```\n", stdout);
}

static void print_markdown(void)
{
    fputs("# Messages\n\n"
          "Everything that mxgen can say, made by `mxgen explain --markdown`. `mxgen explain ID` "
          "prints one. Ids never change meaning. Warnings\n"
          "are switched by `-W`: `-Wno-ID` hides one, `-Werror=ID` makes it an error, `-Werror` "
          "all of them, `-Wno-error=ID` all but that one.\n\n"
          "| id | severity | message |\n| --- | --- | --- |\n",
          stdout);
    for (uint32_t i = 0; i < mxg_num_diagnostic_kinds(); ++i) {
        mxg_diagnostic_kind kind = {sizeof kind};
        mxg_get_diagnostic_kind(i, &kind);
        printf("| [%s](#%s) | %s | `%s` |\n", kind.id, kind.id, severities[kind.severity],
               kind.message);
    }
    for (uint32_t i = 0; i < mxg_num_diagnostic_kinds(); ++i) {
        mxg_diagnostic_kind kind = {sizeof kind};
        mxg_get_diagnostic_kind(i, &kind);
        print_section(&kind);
    }
}

static void print_list(void)
{
    for (uint32_t i = 0; i < mxg_num_diagnostic_kinds(); ++i) {
        mxg_diagnostic_kind kind = {sizeof kind};
        mxg_get_diagnostic_kind(i, &kind);
        printf("%-32s %-8s %s\n", kind.id, severities[kind.severity], kind.message);
    }
}

/* ---- The command ---- */

static bool find_kind(const char *id, mxg_diagnostic_kind *out)
{
    struct arg_list ids = {0};
    for (uint32_t i = 0; i < mxg_num_diagnostic_kinds(); ++i) {
        *out = (mxg_diagnostic_kind){sizeof *out};
        mxg_get_diagnostic_kind(i, out);
        if (strcmp(out->id, id) == 0) {
            free(ids.items);
            return true;
        }
        args_append(&ids, out->id);
    }
    const char *near = args_closest(id, ids.items, ids.len);
    fprintf(stderr,
            near ? "mxgen: there is no message '%s' (did you mean '%s'?)\n"
                 : "mxgen: there is no message '%s'\n",
            id, near);
    free(ids.items);
    return false;
}

static void write_example(struct cli *cli, const mxg_diagnostic_kind *kind, const char *folder)
{
    const char *const names[] = {"wrong", "right"};
    for (int i = 0; i < 2 && *kind->example; ++i) {
        char *path = cli_format("%s/%s/%s", folder, kind->id, names[i]);
        write_side(cli, kind->example, "-+"[i], path);
        free(path);
    }
}

static void write_examples(struct cli *cli, const char *folder)
{
    for (uint32_t i = 0; i < mxg_num_diagnostic_kinds(); ++i) {
        mxg_diagnostic_kind kind = {sizeof kind};
        mxg_get_diagnostic_kind(i, &kind);
        write_example(cli, &kind, folder);
    }
}

static bool explain(struct cli *cli, const char *id, const char *folder, bool markdown)
{
    mxg_diagnostic_kind kind;
    if (!find_kind(id, &kind))
        return false;
    if (folder)
        write_example(cli, &kind, folder);
    else if (markdown)
        print_section(&kind);
    else
        print_kind(&kind);
    return true;
}

int command_explain(const struct command *command, int argc, char **argv)
{
    struct cli cli;
    const char *folder = NULL;
    bool markdown = false;
    const struct arg args[] = {
        {"output", 'o', ARG_TEXT, "DIR",
         "writes the examples of the messages (default: of all) there instead: ID/wrong and "
         "ID/right",
         &folder},
        {"markdown", 0, ARG_FLAG, NULL,
         "prints Markdown: of all messages a document with a table of them", &markdown},
    };
    int code;
    if (cli_start(&cli, command, args, sizeof args / sizeof *args, CLI_LIBRARY_IS_INPUT, argc, argv,
                  &code)) {
        bool found = true;
        if (cli.parser.inputs.len == 0 && markdown)
            print_markdown();
        else if (cli.parser.inputs.len == 0 && folder)
            write_examples(&cli, folder);
        else if (cli.parser.inputs.len == 0)
            print_list();
        for (size_t i = 0; i < cli.parser.inputs.len; ++i) {
            if (i && !folder && !markdown)
                putchar('\n');
            found = explain(&cli, cli.parser.inputs.items[i], folder, markdown) && found;
        }
        code = !found ? EXIT_USAGE : cli.report.errors ? EXIT_FAULT : EXIT_DONE;
    }
    cli_finish(&cli);
    return code;
}
