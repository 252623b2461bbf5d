// SPDX-License-Identifier: Apache-2.0
/* mxgen inspect: the state of the compiler after each stage, as text. */
#define _POSIX_C_SOURCE 200809L
#include "cli/commands.h"
#include "program/cli.h"
#include "program/cli_targets.h"
#include "program/scene_file.h"

#include <string.h>

struct inspect {
    bool views[MXG_VIEW_SLABS_JSON + 1];
    const char *target, *element, *format;
    struct scene_place place; /* file NULL: an element of the document */
    const mxg_bindings *bindings;
    uint32_t stack;
};

static bool print_view(struct cli *cli, const mxg_document *document, const struct inspect *inspect,
                       mxg_view view)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = inspect->target;
    desc.element = inspect->bindings ? NULL : inspect->element;
    desc.bindings = inspect->bindings;
    desc.stack = inspect->stack;
    desc.options = cli->options;
    mxg_result *result = NULL;
    mxg_status status = mxg_inspect(cli->context, document, view, &desc, &result);
    if (result) {
        size_t size = 0;
        const char *text = mxg_result_text(result, &size);
        report_list(&cli->report, mxg_result_diagnostics(result));
        if (text)
            fwrite(text, 1, size, stdout);
    }
    mxg_result_destroy(result);
    return report_status(&cli->report, status);
}

/* Replaces the view of slabs by the one in the wanted format. False after a message. */
static bool choose_format(struct inspect *inspect)
{
    if (!inspect->format)
        return true;
    if (!inspect->views[MXG_VIEW_SLABS])
        return fprintf(stderr, "mxgen: --format is a format of --slabs\n") < 0;
    bool is_json = strcmp(inspect->format, "json") == 0;
    if (!is_json && strcmp(inspect->format, "text") != 0)
        return fprintf(stderr, "mxgen: '%s' is no format; text or json\n", inspect->format) < 0;
    inspect->views[MXG_VIEW_SLABS] = !is_json;
    inspect->views[MXG_VIEW_SLABS_JSON] = is_json;
    return true;
}

/* Prints the requested views, or without any the elements. */
static void print_views(struct cli *cli, const mxg_document *document,
                        const struct inspect *inspect)
{
    bool any = false, good = true;
    for (int view = 0; view <= MXG_VIEW_SLABS_JSON && good; ++view) {
        if (!inspect->views[view])
            continue;
        any = true;
        good = print_view(cli, document, inspect, (mxg_view)view);
    }
    if (!any)
        print_view(cli, document, inspect, MXG_VIEW_ELEMENTS);
}

/* The primitive at the path; without one the first that is drawn. */
static uint32_t find_primitive(const struct bound_scene *stage, const char *path)
{
    uint32_t first = 0, num = mxg_scene_num_primitives(stage->scene);
    while (!path && first + 1 < num && mxg_bindings_stack(stage->bindings, first) == MXG_NONE)
        ++first;
    return path ? mxg_scene_find_primitive(stage->scene, path) : first;
}

/* The stack of a primitive of a stage. */
static void print_stack(struct cli *cli, const mxg_document *own, struct inspect *inspect)
{
    struct bound_scene stage;
    if (scene_file_bind(cli, &inspect->place, own, &stage)) {
        const char *path = inspect->element;
        uint32_t primitive = find_primitive(&stage, path);
        inspect->bindings = stage.bindings;
        inspect->stack = mxg_bindings_stack(stage.bindings, primitive);
        if (inspect->stack != MXG_NONE)
            print_views(cli, stage.document, inspect);
        else if (primitive < mxg_scene_num_primitives(stage.scene))
            report_error(&cli->report, "unknown-primitive",
                         "'%s' is a group, and nothing that is drawn has its layers",
                         path ? path : "/");
        else
            scene_file_report_unknown(&cli->report, stage.scene, path ? path : "/");
    }
    scene_file_unbind(&stage);
    inspect->bindings = NULL;
}

int command_inspect(const struct command *command, int argc, char **argv)
{
    struct inspect inspect = {.target = "glsl"};
    const struct arg args[] = {
        {"elements", 0, ARG_FLAG, NULL, "the element tree and the renderable elements (default)",
         &inspect.views[MXG_VIEW_ELEMENTS]},
        {"graph", 0, ARG_FLAG, NULL, "nodes and connections", &inspect.views[MXG_VIEW_GRAPH]},
        {"dot", 0, ARG_FLAG, NULL, "nodes and connections, for Graphviz",
         &inspect.views[MXG_VIEW_DOT]},
        {"ir", 0, ARG_FLAG, NULL, "the optimised IR", &inspect.views[MXG_VIEW_IR]},
        {"closures", 0, ARG_FLAG, NULL, "closure leaves and their weights",
         &inspect.views[MXG_VIEW_CLOSURES]},
        {"statistics", 0, ARG_FLAG, NULL, "counts", &inspect.views[MXG_VIEW_STATISTICS]},
        {"slabs", 0, ARG_FLAG, NULL,
         "slabs, their operators, media and features, and what budgets would do",
         &inspect.views[MXG_VIEW_SLABS]},
        {"format", 0, ARG_TEXT, "text|json", "of --slabs (default: text)", &inspect.format},
        {"element", 'e', ARG_TEXT, "PATH",
         "path of an element (default: the first renderable), or of a primitive of the stage",
         &inspect.element},
        {"stage", 0, ARG_TEXT, "FILE",
         "shows the stack of layers of a primitive, the first one without --element",
         &inspect.place.file},
        {"look", 0, ARG_TEXT, "NAME", "for --stage: the look", &inspect.place.look},
        {"purpose", 0, ARG_TEXT, "full|preview",
         "for --stage: also takes the bindings of the scene for this purpose",
         &inspect.place.purpose},
        {"target", 't', ARG_TEXT, "T", "target language (default: glsl)", &inspect.target},
    };
    struct cli cli;
    int code;
    if (cli_start(&cli, command, args, sizeof args / sizeof *args, CLI_NEEDS_INPUT | CLI_GENERATES,
                  argc, argv, &code)) {
        mxg_target target;
        bool good = cli_find_target(&cli, inspect.target, strlen(inspect.target), &target)
                    && cli_options_apply(&cli, &target.name, 1) && choose_format(&inspect);
        for (size_t i = 0; good && i < cli.parser.inputs.len; ++i) {
            mxg_document *document = cli_load(&cli, cli.parser.inputs.items[i]);
            if (document && inspect.place.file)
                print_stack(&cli, document, &inspect);
            else if (document)
                print_views(&cli, document, &inspect);
            mxg_document_destroy(document);
        }
        code = !good ? EXIT_USAGE : cli.report.errors ? EXIT_FAULT : EXIT_DONE;
    }
    cli_finish(&cli);
    return code;
}
