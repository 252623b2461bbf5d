// SPDX-License-Identifier: Apache-2.0
/* mxgen help --man: the manual page mxgen(1), with the macros of man(7). */
#include "program/help.h"

#include <string.h>

/* A hyphen of a command line is "\-"; a line must not begin with '.' or "'". */
static void put_text(const char *text, FILE *out)
{
    if (*text == '.' || *text == '\'')
        fputs("\\&", out);
    for (; *text; ++text) {
        if (*text == '\\')
            fputs("\\e", out);
        else if (*text == '-')
            fputs("\\-", out);
        else if (*text == '\n')
            putc(' ', out);
        else
            putc(*text, out);
    }
}

static void put_option(const struct arg *arg, FILE *out)
{
    fputs(".TP\n", out);
    if (arg->letter)
        fprintf(out, "\\fB\\-%c\\fR, ", arg->letter);
    fputs("\\fB\\-\\-", out);
    put_text(arg->name, out);
    fputs("\\fR", out);
    if (arg->value) {
        fputs(" \\fI", out);
        put_text(arg->value, out);
        fputs("\\fR", out);
    }
    putc('\n', out);
    put_text(arg->help, out);
    putc('\n', out);
}

static void put_group(const struct help_chapter *chapter, enum arg_group group, FILE *out)
{
    for (size_t i = 0; i < chapter->num_args; ++i)
        if (chapter->args[i].group == group)
            put_option(&chapter->args[i], out);
}

static void put_chapter(const struct help_chapter *chapter, FILE *out)
{
    fprintf(out, ".SS \"mxgen %s\"\n.B mxgen\n", chapter->command.name);
    put_text(chapter->command.usage, out);
    fputs("\n.PP\n", out);
    put_text(chapter->command.brief, out);
    putc('\n', out);
    put_group(chapter, ARG_OWN, out);
    put_group(chapter, ARG_MORE, out);
}

static void put_generation(FILE *out)
{
    fputs(".SH OPTIONS OF GENERATION\n\\fB\\-\\-no\\-\\fIkey\\fR switches a flag off.\n", out);
    for (uint32_t i = 0; i < mxg_catalogue_num_options(); ++i) {
        struct arg arg = help_generation_arg(i);
        put_option(&arg, out);
    }
}

static void put_targets(FILE *out)
{
    fputs(".SH TARGETS\n", out);
    for (uint32_t i = 0; i < mxg_catalogue_num_targets(); ++i) {
        mxg_target target = {sizeof target};
        mxg_catalogue_target(i, &target);
        fprintf(out, ".TP\n\\fB%s\\fR\n", target.name);
        put_text(target.brief, out);
        putc('\n', out);
    }
}

void help_write_man(const struct help_book *book, FILE *out)
{
    fprintf(out, ".TH MXGEN 1 \"\" \"mxgen %s\" \"User Commands\"\n", mxg_version_string());
    fputs(".SH NAME\nmxgen \\- compile MaterialX documents to shaders\n.SH SYNOPSIS\n", out);
    for (size_t i = 0; i < book->len; ++i) {
        fputs(i ? ".br\n.B mxgen\n" : ".B mxgen\n", out);
        put_text(book->chapters[i].command.usage, out);
        putc('\n', out);
    }
    fputs(
        ".SH DESCRIPTION\nA file \\- is standard input. Without a command, shaders are generated.\n"
        ".SH COMMANDS\n",
        out);
    for (size_t i = 0; i < book->len; ++i)
        put_chapter(&book->chapters[i], out);
    if (book->len) {
        fputs(".SH COMMON OPTIONS\n", out);
        put_group(&book->chapters[0], ARG_COMMON, out);
        fputs(".SH LIMITS AND TRUST\n", out);
        put_group(&book->chapters[0], ARG_LIMITS, out);
    }
    put_generation(out);
    put_targets(out);
    fputs(".SH EXIT STATUS\n.TP\n0\nSuccess.\n.TP\n1\nErrors in the input, or while writing.\n"
          ".TP\n2\nBad usage.\n",
          out);
}
