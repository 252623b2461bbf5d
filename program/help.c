// SPDX-License-Identifier: Apache-2.0
#include "program/help.h"

#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

enum { TEXT_COLUMN = 33, LAST_COLUMN = 100 };

/* Writes words in the text column, over as many lines as needed. */
static void print_wrapped(const char *text, FILE *out)
{
    for (size_t column = TEXT_COLUMN; *text; text += strspn(text, " ")) {
        size_t len = strcspn(text, " ");
        if (column > TEXT_COLUMN && column + 1 + len > LAST_COLUMN) {
            fprintf(out, "\n%*s", TEXT_COLUMN, "");
            column = TEXT_COLUMN;
        }
        column += (size_t)fprintf(out, "%s%.*s", column > TEXT_COLUMN ? " " : "", (int)len, text);
        text += len;
    }
    fputc('\n', out);
}

static void print_row(const struct arg *arg, FILE *out)
{
    char letter[] = {'-', arg->letter, ',', '\0'};
    char *left = cli_format("  %3s --%s%s%s", arg->letter ? letter : "", arg->name,
                            arg->value ? " " : "", arg->value ? arg->value : "");
    if (strlen(left) < TEXT_COLUMN)
        fprintf(out, "%-*s", TEXT_COLUMN, left);
    else
        fprintf(out, "%s\n%*s", left, TEXT_COLUMN, "");
    print_wrapped(arg->help, out);
    free(left);
}

/* False if the table has no option of the group. */
static bool print_group(const struct arg_parser *parser, enum arg_group group, const char *title)
{
    bool any = false;
    for (size_t i = 0; i < parser->num_args; ++i) {
        if (parser->args[i].group != group)
            continue;
        if (!any)
            printf("\n%s:\n", title);
        print_row(&parser->args[i], stdout);
        any = true;
    }
    return any;
}

struct arg help_generation_arg(uint32_t index)
{
    mxg_option option = {sizeof option};
    mxg_catalogue_option(index, &option);
    struct arg arg = {.name = option.key, .kind = ARG_TEXT, .value = "TEXT", .help = option.doc};
    if (option.type == MXG_OPTION_BOOL) {
        arg.kind = ARG_FLAG;
        arg.value = NULL;
    } else if (option.type == MXG_OPTION_INT || option.type == MXG_OPTION_FLOAT) {
        arg.value = "N";
    } else if (option.type == MXG_OPTION_ENUM) {
        arg.value = option.values;
    }
    return arg;
}

static void print_generation(void)
{
    puts("\nOptions of generation (--no-KEY switches a flag off):");
    for (uint32_t i = 0; i < mxg_catalogue_num_options(); ++i) {
        mxg_option option = {sizeof option};
        mxg_catalogue_option(i, &option);
        bool has_default = option.initial && *option.initial;
        struct arg arg = help_generation_arg(i);
        char *text = cli_format(has_default ? "%s (default: %s)" : "%s", arg.help, option.initial);
        arg.help = text;
        print_row(&arg, stdout);
        free(text);
    }
}

bool help_print(const struct command *command, const struct arg_parser *parser, const char *word)
{
    bool all = strcmp(word, "all") == 0;
    if (*word && !all) {
        fprintf(stderr, "mxgen: '--help %s': write --help or --help all\n", word);
        return false;
    }
    printf("Usage: mxgen%s%s\n%s\n", *command->usage == '-' ? "" : " ", command->usage,
           command->brief);
    print_group(parser, ARG_OWN, "Options");
    if (all)
        print_group(parser, ARG_MORE, "More options");
    print_group(parser, ARG_COMMON, "Common options");
    if (all)
        print_group(parser, ARG_LIMITS, "Limits and trust");
    if (all && parser->generation)
        print_generation();
    if (!all)
        printf("\n--help all also lists rare options%s.\n",
               parser->generation ? ", limits, and the options of generation" : " and limits");
    return true;
}

/* ---- The book ---- */

void help_add(struct help_book *book, const struct command *command,
              const struct arg_parser *parser)
{
    size_t size = parser->num_args * sizeof *parser->args;
    struct help_chapter chapter = {.command = *command,
                                   .args = memory_alloc(size),
                                   .num_args = parser->num_args,
                                   .generation = parser->generation};
    memcpy(chapter.args, parser->args, size);
    MEMORY_PUSH(book->chapters, book->len, chapter);
}

void help_finish(struct help_book *book)
{
    for (size_t i = 0; i < book->len; ++i)
        free(book->chapters[i].args);
    free(book->chapters);
    *book = (struct help_book){0};
}
