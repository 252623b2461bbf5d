// SPDX-License-Identifier: Apache-2.0
/*
 * Reports of a check as `mxgen check merge` reads them, in two shards where a line "====" stands
 * between them, and also as their own baseline. What it writes is whole: XML and JSON that can be
 * read.
 */
#define _GNU_SOURCE /* memmem */
#include "fuzz.h"

#include "check/check.h"
#include "cli/commands.h"
#include "program/json_values.h"
#include "program/scratch.h"

#include <libxml/parser.h>
#include <string.h>
#include <unistd.h>

static void require_xml(const char *path)
{
    xmlDoc *document = xmlReadFile(path, NULL, XML_PARSE_NONET | XML_PARSE_HUGE);
    FUZZ_REQUIRE(document);
    xmlFreeDoc(document);
}

static void require_json(const char *path)
{
    json_t *report = json_load_file(path, 0, NULL);
    FUZZ_REQUIRE(report);
    json_decref(report);
}

static void require_any(const char *path)
{
    FUZZ_REQUIRE(access(path, R_OK) == 0);
}

static const struct {
    const char *option;
    void (*require)(const char *path);
} outputs[] = {{"html", require_xml},
               {"junit", require_xml},
               {"sarif", require_json},
               {"json", require_json},
               {"depfile", require_any}};
enum { NUM_OUTPUTS = sizeof outputs / sizeof *outputs };

static char *write_part(const char *folder, const char *name, const char *data, size_t size)
{
    char *path = cli_format("%s/%s", folder, name);
    FUZZ_REQUIRE(!files_write(path, data, size));
    return path;
}

static void run(const char *folder, struct arg_list *args)
{
    static const struct command command = {"merge", "REPORT.json...", "", check_merge, NULL};
    size_t num = args->len;
    args_append(args, NULL);
    int code = check_merge(&command, (int)num, (char **)(uintptr_t)args->items);
    FUZZ_REQUIRE(code == EXIT_DONE || code == EXIT_FAULT);
    for (size_t i = 0; i < NUM_OUTPUTS; ++i) {
        char *path = cli_format("%s/out.%s", folder, outputs[i].option);
        if (access(path, F_OK) == 0)
            outputs[i].require(path);
        else
            FUZZ_REQUIRE(code == EXIT_FAULT);
        free(path);
    }
}

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    static const char line[] = "\n====\n";
    struct scratch scratch;
    struct arg_list args = {0};
    (void)heap; /* programs end where memory is exhausted */
    FUZZ_REQUIRE(scratch_make(&scratch));
    const char *second = memmem(data, size, line, sizeof line - 1);
    size_t first_size = second ? (size_t)(second - data) : size;
    args_append(&args, cli_format("merge"));
    args_append(&args, write_part(scratch.path, "first.json", data, first_size));
    if (second)
        args_append(&args, write_part(scratch.path, "second.json", second + sizeof line - 1,
                                      size - first_size - (sizeof line - 1)));
    for (size_t i = 0; i < NUM_OUTPUTS; ++i)
        args_append(&args, cli_format("--%s=%s/out.%s", outputs[i].option, scratch.path,
                                      outputs[i].option));
    args_append(&args, cli_format("-q"));
    if (fuzz_choice(data, size, 2)) {
        free(write_part(scratch.path, "baseline.json", data, first_size));
        args_append(&args, cli_format("--baseline=%s/baseline.json", scratch.path));
    }
    run(scratch.path, &args);
    args_free(&args);
    scratch_remove(&scratch);
}
