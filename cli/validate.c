// SPDX-License-Identifier: Apache-2.0
/* mxgen validate: checks documents against the library, without generation. */
#include "cli/commands.h"
#include "program/cli.h"
#include "program/folder.h"

static void validate(struct cli *cli, const char *path)
{
    mxg_document *document = cli_load(cli, path);
    if (!document)
        return;
    mxg_result *result = NULL;
    mxg_status status = mxg_validate(cli->context, document, &result);
    if (result)
        report_list(&cli->report, mxg_result_diagnostics(result));
    report_status(&cli->report, status);
    mxg_result_destroy(result);
    mxg_document_destroy(document);
}

int command_validate(const struct command *command, int argc, char **argv)
{
    struct cli cli;
    int code;
    if (cli_start(&cli, command, NULL, 0, CLI_NEEDS_INPUT, argc, argv, &code)) {
        struct arg_list documents = {0};
        const char *reason = NULL,
                   *empty = folder_documents(&cli.parser.inputs, &documents, &reason);
        if (empty)
            report_error(&cli.report, "file-unreadable", "'%s': %s", empty, reason);
        for (size_t i = 0; i < documents.len; ++i)
            validate(&cli, documents.items[i]);
        args_free(&documents);
        code = cli.report.errors ? EXIT_FAULT : EXIT_DONE;
    }
    cli_finish(&cli);
    return code;
}
