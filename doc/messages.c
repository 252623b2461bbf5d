// SPDX-License-Identifier: Apache-2.0
/* Explanations of messages, as text and as Markdown. */
#include "doc/messages.h"

#include <string.h>

enum { WIDTH = 100 };

static const char *const severities[] = {"error", "warning", "note"};

/* A message whose words are not known yet: "cannot open '…': …". */
static void print_message(const char *format)
{
    for (; *format; ++format) {
        if (format[0] == '%' && (format[1] == 's' || format[1] == 'u' || format[1] == 'd')) {
            fputs("…", stdout);
            ++format;
        } else {
            putchar(*format);
        }
    }
}

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

void explain_kind(const mxg_diagnostic_kind *kind)
{
    printf("%s [%s]\n    ", severities[kind->severity], kind->id);
    print_message(kind->message);
    fputs("\n\n", stdout);
    print_wrapped(kind->cause, stdout);
    fputs("\nWhat to do: ", stdout);
    print_wrapped(kind->cure, stdout);
    if (*kind->example) {
        fputs("\nExample ('-' is wrong, '+' is right):\n\n", stdout);
        example_print(kind->example, "    ", stdout);
    }
}

void explain_section(const mxg_diagnostic_kind *kind)
{
    printf("\n## %s\n\n", kind->id);
    print_wrapped(kind->cause, stdout);
    fputs("\n*What to do:* ", stdout);
    print_wrapped(kind->cure, stdout);
    if (!*kind->example)
        return;
    fputs("\n```diff\n", stdout);
    example_print(kind->example, "", stdout);
    fputs("```\n", stdout);
}

void explain_all(void)
{
    fputs("# Messages\n\n"
          "Everything that mxgen can say, made by `mxgen explain --markdown`. `mxgen explain ID` "
          "prints one. Ids never change meaning. Warnings\n"
          "are switched by `-W`: `-Wno-ID` hides one, `-Werror=ID` makes it an error, `-Werror` "
          "all of them, `-Wno-error=ID` all but that one.\n\n"
          "| id | severity | message |\n| --- | --- | --- |\n",
          stdout);
    for (uint32_t i = 0; i < mxg_catalogue_num_diagnostic_kinds(); ++i) {
        mxg_diagnostic_kind kind = {sizeof kind};
        mxg_catalogue_diagnostic_kind(i, &kind);
        printf("| [%s](#%s) | %s | `", kind.id, kind.id, severities[kind.severity]);
        print_message(kind.message);
        fputs("` |\n", stdout);
    }
    for (uint32_t i = 0; i < mxg_catalogue_num_diagnostic_kinds(); ++i) {
        mxg_diagnostic_kind kind = {sizeof kind};
        mxg_catalogue_diagnostic_kind(i, &kind);
        explain_section(&kind);
    }
}

void explain_list(void)
{
    for (uint32_t i = 0; i < mxg_catalogue_num_diagnostic_kinds(); ++i) {
        mxg_diagnostic_kind kind = {sizeof kind};
        mxg_catalogue_diagnostic_kind(i, &kind);
        printf("%-32s %-8s ", kind.id, severities[kind.severity]);
        print_message(kind.message);
        putchar('\n');
    }
}
