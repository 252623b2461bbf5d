// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen library doc: writes the reference of every node of a library, as a page of HTML and as
 * Markdown.
 */
#define _POSIX_C_SOURCE 200809L
#include "doc/reference.h"
#include "doc/manual.h"
#include "program/files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static void write_page(const struct manual *manual, struct cli *cli, const char *folder,
                       const char *name, void (*write)(const struct manual *, FILE *))
{
    char *data = NULL, *path = cli_format("%s/%s", folder, name);
    size_t size = 0;
    FILE *out = open_memstream(&data, &size);
    if (out)
        write(manual, out);
    const char *reason = out && fclose(out) == 0 ? files_write(path, data, size) : strerror(errno);
    if (reason)
        report_error(&cli->report, "output-failed", "cannot write '%s': %s", path, reason);
    free(data);
    free(path);
}

/* For a library that extends the built-in one, the reference contains only its own definitions. */
static uint32_t first_nodedef(const struct cli *cli)
{
    if (cli->no_builtin_library || cli->parser.inputs.len == 1)
        return 0;
    mxg_library *builtin = mxg_library_builtin(cli->context);
    uint32_t count = mxg_library_num_nodedefs(builtin);
    mxg_library_unref(builtin);
    return count;
}

void library_doc(struct cli *cli, const struct library_args *args)
{
    const char *folder = args->output ? args->output : ".";
    const char *reason = files_make_folder(folder);
    if (reason) {
        report_error(&cli->report, "output-failed", "cannot make the folder '%s': %s", folder,
                     reason);
        return;
    }
    struct manual manual;
    manual_init(&manual, cli->library, first_nodedef(cli));
    if (args->pictures)
        manual_draw(&manual, cli, folder);
    bool both = !args->html && !args->markdown;
    if (args->html || both)
        write_page(&manual, cli, folder, "index.html", manual_write_html);
    if (args->markdown || both)
        write_page(&manual, cli, folder, "index.md", manual_write_markdown);
    store_finish(&manual.store);
    names_finish(&manual.names);
}
