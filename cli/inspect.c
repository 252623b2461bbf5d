// SPDX-License-Identifier: Apache-2.0
/* mxgen inspect: the state of the compiler after each stage, as text. */
#define _POSIX_C_SOURCE 200809L
#include "cli/commands.h"
#include "program/cli.h"
#include "program/drawn.h"
#include "program/scratch.h"
#include "program/slab_view.h"
#include "program/scene_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct inspect {
    bool views[MXG_VIEW_SLABS_SVG + 1];
    const char *target, *element, *format;
    bool is_drawn;
    struct scene_place place; /* file NULL: an element of the document */
    const mxg_bindings *bindings;
    uint32_t stack;
    struct drawn_comparison drawn; /* of the current document; without steps: nothing was drawn */
};

/* The slabs as JSON, with the errors of pictures in their steps. */
static void print_drawn_json(const char *text, size_t size, const struct drawn_comparison *drawn)
{
    json_t *view = json_loadb(text, size, 0, NULL);
    for (size_t i = 0; i < drawn->num_steps; ++i)
        json_object_set_new(json_array_get(json_object_get(view, "steps"), i), "drawnError",
                            json_real(drawn->errors[i]));
    json_dumpf(view, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(4));
    putchar('\n');
    json_decref(view);
}

static void print_text(const struct inspect *inspect, mxg_view view, const char *text, size_t size)
{
    bool is_json = view == MXG_VIEW_SLABS_JSON && inspect->drawn.num_steps;
    if (is_json)
        print_drawn_json(text, size, &inspect->drawn);
    else
        fwrite(text, 1, size, stdout);
    for (size_t i = 0; view == MXG_VIEW_SLABS && i < inspect->drawn.num_steps; ++i)
        printf("  after %zu step%s, drawn %.4g\n", i + 1, i ? "s" : "", inspect->drawn.errors[i]);
}

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
            print_text(inspect, view, text, size);
    }
    mxg_result_destroy(result);
    return report_status(&cli->report, status);
}

/* Replaces the view of slabs by the one in the wanted format. False after a message. */
static bool choose_format(struct inspect *inspect)
{
    static const struct {
        const char *name;
        mxg_view view;
    } formats[] = {
        {"text", MXG_VIEW_SLABS}, {"json", MXG_VIEW_SLABS_JSON}, {"svg", MXG_VIEW_SLABS_SVG}};
    if (!inspect->format)
        return true;
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i) {
        if (strcmp(formats[i].name, inspect->format) != 0)
            continue;
        bool is_wanted = inspect->views[MXG_VIEW_SLABS];
        inspect->views[MXG_VIEW_SLABS] = false;
        inspect->views[formats[i].view] = is_wanted;
        return is_wanted || fprintf(stderr, "mxgen: --format is a format of --slabs\n") < 0;
    }
    fprintf(stderr, "mxgen: '%s' is no format; text, json or svg\n", inspect->format);
    return false;
}

/* Prints the requested views, or without any the elements. */
static void print_views(struct cli *cli, const mxg_document *document,
                        const struct inspect *inspect)
{
    bool any = false, good = true;
    for (int view = 0; view <= MXG_VIEW_SLABS_SVG && good; ++view) {
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

/* Draws a material that has steps; after a failure the reports have no drawn errors. */
static void add_drawn(struct cli *cli, const mxg_document *document, const char *file,
                      struct inspect *inspect)
{
    static const char *const look[] = {"--size=48", "--mesh=sphere", NULL};
    json_t *view = slab_view_read(cli, document, inspect->element, inspect->target, cli->options);
    size_t num_steps = json_array_size(json_object_get(view, "steps"));
    bool is_asked = json_is_true(json_object_get(view, "toBudget"));
    json_decref(view);
    struct scratch scratch = {0};
    const char *fault = num_steps && !scratch_make(&scratch) ? strerror(errno) : NULL;
    if (scratch.path) {
        const struct drawn_subject subject = {.cli = cli,
                                              .file = file,
                                              .element = inspect->element,
                                              .look = look,
                                              .folder = scratch.path,
                                              .is_to_one_slab = !is_asked};
        if (drawn_begin(&subject, &inspect->drawn))
            drawn_compare(&subject, num_steps, &inspect->drawn);
        fault = inspect->drawn.fault;
    }
    if (fault) {
        report_error(&cli->report, "no-picture", "there are no drawn errors of '%s': %s",
                     inspect->element ? inspect->element : file, fault);
        drawn_finish(&inspect->drawn);
    }
    scratch_remove(&scratch);
}

/* False after a message: pictures are of a document, for its slabs. */
static bool check_drawn(const struct inspect *inspect)
{
    bool fits = !inspect->place.file
                && (inspect->views[MXG_VIEW_SLABS] || inspect->views[MXG_VIEW_SLABS_JSON]);
    if (inspect->is_drawn && !fits)
        fprintf(stderr, "mxgen: --drawn is for --slabs as text or JSON, without --stage\n");
    return fits || !inspect->is_drawn;
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
        {"format", 0, ARG_TEXT, "text|json|svg", "of --slabs (default: text)", &inspect.format},
        {"drawn", 0, ARG_FLAG, NULL,
         "of --slabs: draws the material, full and after each step, and shows the errors",
         &inspect.is_drawn},
        {"element", 'e', ARG_TEXT, "PATH",
         "path of an element (default: the first renderable), or of a primitive of the stage",
         &inspect.element},
        {"stage", 0, ARG_TEXT, "FILE",
         "shows the stack of layers of a primitive, the first one without --element",
         &inspect.place.file},
        {"look", 0, ARG_TEXT, "NAME", "for --stage: the look (default: the first one)",
         &inspect.place.look},
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
        bool good = cli_find_target(inspect.target, strlen(inspect.target), &target)
                    && cli_options_apply(&cli, &target.name, 1) && choose_format(&inspect)
                    && check_drawn(&inspect);
        for (size_t i = 0; good && i < cli.parser.inputs.len; ++i) {
            mxg_document *document = cli_load(&cli, cli.parser.inputs.items[i]);
            if (document && inspect.is_drawn)
                add_drawn(&cli, document, cli.parser.inputs.items[i], &inspect);
            if (document && inspect.place.file)
                print_stack(&cli, document, &inspect);
            else if (document)
                print_views(&cli, document, &inspect);
            drawn_finish(&inspect.drawn);
            mxg_document_destroy(document);
        }
        code = !good ? EXIT_USAGE : cli.report.errors ? EXIT_FAULT : EXIT_DONE;
    }
    cli_finish(&cli);
    return code;
}
