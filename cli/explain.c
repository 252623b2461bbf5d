// SPDX-License-Identifier: Apache-2.0
/* mxgen explain: prints cause, cure and example of messages. */
#include "doc/explain.h"

#include <stdlib.h>
#include <string.h>

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

static void write_examples(struct cli *cli, const char *folder)
{
    for (uint32_t i = 0; i < mxg_num_diagnostic_kinds(); ++i) {
        mxg_diagnostic_kind kind = {sizeof kind};
        mxg_get_diagnostic_kind(i, &kind);
        example_write(cli, &kind, folder);
    }
}

static bool explain(struct cli *cli, const char *id, const char *folder, bool markdown)
{
    mxg_diagnostic_kind kind;
    if (!find_kind(id, &kind))
        return false;
    if (folder)
        example_write(cli, &kind, folder);
    else if (markdown)
        explain_section(&kind);
    else
        explain_kind(&kind);
    return true;
}

int command_explain(const struct command *command, int argc, char **argv)
{
    struct cli cli;
    const char *folder = NULL;
    bool markdown = false;
    const struct arg args[] = {
        {"output", 'o', ARG_TEXT, "DIR",
         "writes the examples instead, to DIR/ID/wrong and DIR/ID/right", &folder},
        {"markdown", 0, ARG_FLAG, NULL,
         "prints Markdown; without an ID, the document of all messages", &markdown},
    };
    int code;
    if (cli_start(&cli, command, args, sizeof args / sizeof *args, CLI_LIBRARY_IS_INPUT, argc, argv,
                  &code)) {
        bool found = !(folder && markdown);
        if (!found)
            fputs("mxgen: option '--output' does not apply: --markdown prints\n", stderr);
        else if (cli.parser.inputs.len == 0 && markdown)
            explain_all();
        else if (cli.parser.inputs.len == 0 && folder)
            write_examples(&cli, folder);
        else if (cli.parser.inputs.len == 0)
            explain_list();
        for (size_t i = 0; i < cli.parser.inputs.len && !(folder && markdown); ++i) {
            if (i && !folder && !markdown)
                putchar('\n');
            found = explain(&cli, cli.parser.inputs.items[i], folder, markdown) && found;
        }
        code = !found ? EXIT_USAGE : cli.report.errors ? EXIT_FAULT : EXIT_DONE;
    }
    cli_finish(&cli);
    return code;
}
