// SPDX-License-Identifier: Apache-2.0
/* mxgen explain: prints cause, cure and example of messages, and the interface of nodes. */
#include "cli/commands.h"
#include "cli/node_list.h"
#include "doc/messages.h"

#include <stdlib.h>
#include <string.h>

static bool find_kind(const char *id, mxg_diagnostic_kind *out)
{
    for (uint32_t i = 0; i < mxg_catalogue_num_diagnostic_kinds(); ++i) {
        *out = (mxg_diagnostic_kind){sizeof *out};
        mxg_catalogue_diagnostic_kind(i, out);
        if (strcmp(out->id, id) == 0)
            return true;
    }
    return false;
}

static void report_unknown(const struct cli *cli, const char *word)
{
    struct arg_list ids = {0};
    for (uint32_t i = 0; i < mxg_catalogue_num_diagnostic_kinds(); ++i) {
        mxg_diagnostic_kind kind = {sizeof kind};
        mxg_catalogue_diagnostic_kind(i, &kind);
        args_append(&ids, kind.id);
    }
    const char *near = args_closest(word, ids.items, ids.len);
    near = near ? near : nodes_closest(cli->library, word);
    fprintf(stderr,
            near ? "mxgen: there is no message and no node '%s' (did you mean '%s'?)\n"
                 : "mxgen: there is no message and no node '%s'\n",
            word, near);
    free(ids.items);
}

static void write_examples(struct cli *cli, const char *folder)
{
    for (uint32_t i = 0; i < mxg_catalogue_num_diagnostic_kinds(); ++i) {
        mxg_diagnostic_kind kind = {sizeof kind};
        mxg_catalogue_diagnostic_kind(i, &kind);
        example_write(cli, &kind, folder);
    }
}

static bool explain(struct cli *cli, const char *id, const char *folder, bool markdown)
{
    mxg_diagnostic_kind kind;
    if (!find_kind(id, &kind)) {
        bool is_node = !folder && nodes_explain(cli->library, id);
        if (!is_node)
            report_unknown(cli, id);
        return is_node;
    }
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
        {"output", 'o', ARG_PATH, "DIR",
         "writes the examples instead, to DIR/ID/wrong and DIR/ID/right", &folder},
        {"markdown", 0, ARG_FLAG, NULL,
         "prints Markdown; without an ID, the document of all messages", &markdown},
    };
    int code;
    if (cli_start(&cli, command, args, sizeof args / sizeof *args, 0, argc, argv, &code)) {
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
