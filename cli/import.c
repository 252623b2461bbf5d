// SPDX-License-Identifier: Apache-2.0
/* mxgen import: the materials of a glTF file as a document. */
#include "cli/commands.h"
#include "import/import.h"

int command_import(const struct command *command, int argc, char **argv)
{
    const char *output = NULL;
    const struct arg args[] = {
        {"output", 'o', ARG_TEXT, "FILE", "the document: .mtlx", &output},
    };
    struct cli cli;
    int code;
    json_use_memory();
    if (cli_start(&cli, command, args, sizeof args / sizeof *args, CLI_NEEDS_INPUT, argc, argv,
                  &code)) {
        bool is_usage = cli.parser.inputs.len == 1 && output;
        if (is_usage)
            import_document(&cli, cli.parser.inputs.items[0], output);
        else
            fputs("usage: mxgen import FILE.glb|FILE.gltf -o FILE.mtlx\n", stderr);
        code = !is_usage ? EXIT_USAGE : cli.report.errors ? EXIT_FAULT : EXIT_DONE;
    }
    cli_finish(&cli);
    return code;
}
