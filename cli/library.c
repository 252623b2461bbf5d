// SPDX-License-Identifier: Apache-2.0
/* mxgen library: packs libraries into images, lists their definitions, expands their templates. */
#include "cli/cli.h"
#include "cli/files.h"

#include <string.h>

static bool write_output(struct cli *cli, const char *path, const void *data, size_t size)
{
    if (!path) {
        fwrite(data, 1, size, stdout);
        return true;
    }
    const char *reason = files_write(path, data, size);
    if (reason)
        report_error(&cli->report, "output-failed", "cannot write '%s': %s", path, reason);
    return !reason;
}

static void pack(struct cli *cli, const char *output)
{
    const void *data;
    size_t size;
    if (report_status(&cli->report, mxg_library_image(cli->library, &data, &size)))
        write_output(cli, output, data, size);
}

static void expand(struct cli *cli, const char *output)
{
    const char *text;
    size_t size;
    if (report_status(&cli->report, mxg_library_expand(cli->library, &text, &size)))
        write_output(cli, output, text, size);
}

static void print_ports(const mxg_library *library, uint32_t nodedef, uint32_t first, uint32_t num)
{
    for (uint32_t i = 0; i < num; ++i) {
        mxg_port port = {sizeof port};
        if (mxg_library_port(library, nodedef, first + i, &port) == MXG_OK)
            printf("%s%s:%s", i ? ", " : "", port.name, port.type);
    }
}

/* A line for each definition: "ND_mix_float  mix(fg:float, bg:float, mix:float) -> out:float". */
static void list(struct cli *cli, const char *output)
{
    (void)output;
    for (uint32_t i = 0; i < mxg_library_num_nodedefs(cli->library); ++i) {
        mxg_nodedef nodedef = {sizeof nodedef};
        if (mxg_library_nodedef(cli->library, i, &nodedef) != MXG_OK)
            continue;
        printf("%s  %s(", nodedef.name, nodedef.node);
        print_ports(cli->library, i, 0, nodedef.num_inputs);
        fputs(") -> ", stdout);
        print_ports(cli->library, i, nodedef.num_inputs, nodedef.num_outputs);
        puts(nodedef.has_implementation ? "" : "  (no implementation)");
    }
}

static const struct {
    const char *name;
    void (*run)(struct cli *cli, const char *output);
    bool on_builtin; /* extends the library that is built in, where there are no paths or they extend it */
} actions[] = {{"pack", pack, false}, {"list", list, true}, {"expand", expand, false}};
#define NUM_ACTIONS (sizeof actions / sizeof *actions)

/* The library of the paths alone, which is what can be packed; the built-in one where there are none. */
static bool load(struct cli *cli)
{
    const struct arg_list *inputs = &cli->parser.inputs;
    if (inputs->len == 1 && !cli->no_builtin_library) {
        cli->library = mxg_library_builtin(cli->context);
        return true;
    }
    mxg_status status = mxg_library_load(cli->context, NULL, inputs->items + 1, inputs->len - 1, &cli->library);
    if (cli->library)
        report_list(&cli->report, mxg_library_diagnostics(cli->library));
    return report_status(&cli->report, status);
}

int command_library(const struct command *command, int argc, char **argv)
{
    const char *output = NULL;
    const struct arg args[] = {{"output", 'o', ARG_TEXT, "FILE", "where to write (default: standard output)", &output}};
    struct cli cli;
    int code;
    if (cli_start(&cli, command, args, 1, CLI_NEEDS_INPUT | CLI_LIBRARY_IS_INPUT, argc, argv, &code)) {
        const char *word = cli.parser.inputs.items[0];
        size_t i = 0;
        while (i < NUM_ACTIONS && strcmp(word, actions[i].name) != 0)
            ++i;
        if (i == NUM_ACTIONS) {
            fprintf(stderr, "mxgen: 'library %s' is none of pack, list, expand\n", word);
            code = EXIT_USAGE;
        } else {
            if (load(&cli))
                actions[i].run(&cli, output);
            code = cli.report.errors ? EXIT_FAULT : EXIT_DONE;
        }
    }
    cli_finish(&cli);
    return code;
}
