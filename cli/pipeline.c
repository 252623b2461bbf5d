// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen pipeline: what belongs to no material: the passes of the deferred pipeline
 * (docs/deferred.md), or the module of the materials of MDL (docs/mdl.md).
 */
#include "cli/commands.h"
#include "program/cli.h"
#include "program/cli_targets.h"
#include "program/files.h"

#include <stdlib.h>
#include <string.h>

static bool write_file(struct report *report, const char *folder, const char *name,
                       const char *suffix, const char *text, size_t size)
{
    char *path = cli_format("%s/%s.%s", folder, name, suffix);
    const char *reason = files_write(path, text, size);
    if (reason)
        report_error(report, "output-failed", "cannot write '%s': %s", path, reason);
    free(path);
    return !reason;
}

static bool write_pass(struct cli *cli, uint32_t index, const mxg_target *target,
                       const char *folder)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = target->name;
    desc.options = cli->options;
    mxg_result *result;
    mxg_status status = mxg_generate_pass(cli->context, index, &desc, &result);
    if (result)
        report_list(&cli->report, mxg_result_diagnostics(result));
    bool good = report_status(&cli->report, status);
    if (good) {
        size_t size = 0, json_size = 0;
        mxg_pass pass = {sizeof pass};
        mxg_result_pass(result, &pass);
        const char *name = mxg_catalogue_pass(index),
                   *text = mxg_result_source(result, MXG_STAGE_PIXEL, &size),
                   *json = mxg_result_reflection_json(result, &json_size);
        good = !text /* the options do not ask for it */
               || (write_file(&cli->report, folder, name, target->pass_suffix[!pass.group_size[0]],
                              text, size)
                   && write_file(&cli->report, folder, name, "json", json, json_size));
    }
    mxg_result_destroy(result);
    return good;
}

static bool write_module(struct cli *cli, const mxg_target *target, const char *folder)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = target->name;
    desc.options = cli->options;
    mxg_result *result;
    mxg_status status = mxg_generate_module(cli->context, cli->library, &desc, &result);
    if (result)
        report_list(&cli->report, mxg_result_diagnostics(result));
    bool good = report_status(&cli->report, status);
    if (good) {
        size_t size = 0;
        mxg_shader_info info = MXG_INIT(mxg_shader_info);
        mxg_result_info(result, &info);
        const char *text = mxg_result_source(result, MXG_STAGE_PIXEL, &size);
        good = write_file(&cli->report, folder, info.name, target->stage_suffix[MXG_STAGE_PIXEL],
                          text, size);
    }
    mxg_result_destroy(result);
    return good;
}

static bool write_all(struct cli *cli, const mxg_target *target, const char *folder)
{
    const char *reason = files_make_folder(folder);
    bool good = !reason;
    if (reason)
        report_error(&cli->report, "output-failed", "cannot make the folder '%s': %s", folder,
                     reason);
    if (good && args_is_given(&cli->parser, "mdl-module"))
        return write_module(cli, target, folder);
    for (uint32_t i = 0; good && i < mxg_catalogue_num_passes(); ++i)
        good = write_pass(cli, i, target, folder);
    return good;
}

/* Whether the target has passes, or the command asks for a module. */
static bool has_files(const struct cli *cli, const mxg_target *target)
{
    if (target->pass_suffix[0] || args_is_given(&cli->parser, "mdl-module"))
        return true;
    fprintf(stderr,
            "mxgen: '%s' has no passes (docs/deferred.md); with '--target mdl', "
            "'--mdl-module NAME' writes the module of the materials\n",
            target->name);
    return false;
}

int command_pipeline(const struct command *command, int argc, char **argv)
{
    const char *name = "vulkan";
    const struct arg args[] = {
        {"target", 't', ARG_TEXT, "T",
         "target language: vulkan (default), glsl, hlsl, slang, msl or wgsl; mdl with --mdl-module",
         &name},
    };
    struct cli cli;
    mxg_target target;
    int code;
    if (cli_start(&cli, command, args, sizeof args / sizeof *args, CLI_NEEDS_INPUT | CLI_GENERATES,
                  argc, argv, &code)) {
        bool is_usage = cli_find_target(&cli, name, strlen(name), &target)
                        && cli_options_apply(&cli, &target.name, 1) && has_files(&cli, &target);
        if (cli.parser.inputs.len != 1) {
            fprintf(stderr, "mxgen: 'mxgen pipeline' takes one folder\n");
            is_usage = false;
        }
        code = !is_usage                                              ? EXIT_USAGE
               : write_all(&cli, &target, cli.parser.inputs.items[0]) ? EXIT_DONE
                                                                      : EXIT_FAULT;
    }
    cli_finish(&cli);
    return code;
}
