// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen-compile: generates every renderable element of documents for several targets and interface
 * modes, compiles what came out, and prints a line for each with its sizes. Errors of the compiler
 * are shown at the line of the document that they come from.
 */
#include "program/cli.h"
#include "program/cli_targets.h"
#include "program/files.h"
#include "program/scene_file.h"
#include "compile/compile.h"

#include <stdlib.h>
#include <string.h>

struct check {
    struct cli cli;
    const char *targets, *interfaces, *roles; /* lists with commas; NULL: the role of the options */
    struct arg_list elements;
    bool no_compile;
    const char *input;
    char role[32];            /* "": that of the options */
    const char *stage, *look; /* of a scene */
    mxg_bindings *bindings;   /* NULL without a scene */
    mxg_result *waiting[COMPILE_MAX_RESULTS];
    size_t num_waiting;
};

/* The next word of a list with commas; false behind the last. */
static bool next_word(const char **list, char *word, size_t capacity)
{
    *list += strspn(*list, ",");
    size_t len = strcspn(*list, ",");
    if (len == 0 || len >= capacity)
        return false;
    memcpy(word, *list, len);
    word[len] = '\0';
    *list += len;
    return true;
}

static size_t count_lines(const char *text, size_t size)
{
    size_t lines = 0;
    for (size_t i = 0; i < size; ++i)
        lines += text[i] == '\n';
    return lines;
}

static void print_source_line(const char *source, uint32_t line)
{
    while (source && --line)
        source = strchr(source, '\n') ? strchr(source, '\n') + 1 : NULL;
    if (source)
        fprintf(stderr, "    %.*s\n", (int)strcspn(source, "\n"), source);
}

/* "gold.mtlx:12:9: error: glsl fragment stage, line 240: 'x' : undeclared identifier
 * [shader-invalid]", and the shader's line. */
static void print_message(struct check *check, const mxg_result *result, const char *element,
                          const char *target, const struct compile_message *message)
{
    static const char *const stages[MXG_NUM_STAGES] = {"vertex", "pixel"};
    mxg_place at = {sizeof at};
    if (message->line
        && mxg_result_source_place(result, message->stage, message->line, &at) == MXG_OK && at.file)
        fprintf(stderr, "%s:%u:%u: ", at.file, at.line, at.column);
    else
        fprintf(stderr, "%s: ", check->input);
    bool is_error = message->severity == MXG_SEVERITY_ERROR;
    fprintf(stderr, "%s: '%s', %s, %s%s%s stage", is_error ? "error" : "warning",
            at.path ? at.path : element, target, check->role, check->role[0] ? ", " : "",
            stages[message->stage]);
    if (message->line)
        fprintf(stderr, ", line %u", message->line);
    fprintf(stderr, ": %s [shader-invalid]\n", message->text);
    if (message->line)
        print_source_line(mxg_result_source(result, message->stage, NULL), message->line);
    check->cli.report.errors += is_error;
}

/* Columns: file, element, target, interface, bytes and lines of the pixel stage, body instructions
 * of pixel and vertex stage. */
static void print_sizes(const struct check *check, const char *element, const char *target,
                        const char *interface, const mxg_result *result,
                        const struct compiled *compiled)
{
    size_t size = 0;
    const char *source = mxg_result_source(result, MXG_STAGE_PIXEL, &size);
    printf("%s\t%s\t%s\t%s\t%zu\t%zu\t%u\t%u\n", check->input, element, target, interface, size,
           source ? count_lines(source, size) : 0,
           compiled->stages[MXG_STAGE_PIXEL].body_instructions,
           compiled->stages[MXG_STAGE_VERTEX].body_instructions);
}

static void print_result(struct check *check, const char *target, const char *interface,
                         const mxg_result *result, const struct compiled *compiled)
{
    mxg_shader_info info = {sizeof info};
    mxg_result_info(result, &info);
    for (size_t i = 0; i < compiled->num_messages; ++i)
        print_message(check, result, info.path, target, &compiled->messages[i]);
    print_sizes(check, info.path, target, interface, result, compiled);
}

/* Compiles the results that wait, together, and prints them. */
static void check_waiting(struct check *check, const char *target, const char *interface)
{
    struct compiled compiled[COMPILE_MAX_RESULTS] = {0};
    const char *base = cli_base_target(&check->cli, target);
    if (!check->no_compile && compile_knows_target(base))
        compile_results(base, (const mxg_result *const *)check->waiting, check->num_waiting,
                        compiled);
    for (size_t i = 0; i < check->num_waiting; ++i) {
        print_result(check, target, interface, check->waiting[i], &compiled[i]);
        compiled_finish(&compiled[i]);
        mxg_result_destroy(check->waiting[i]);
    }
    check->num_waiting = 0;
}

static void check_one(struct check *check, const mxg_document *document, mxg_generate_desc desc,
                      const char *target, const char *interface)
{
    desc.target = target;
    desc.options = check->cli.options;
    mxg_result *result = NULL;
    mxg_status status = mxg_generate(check->cli.context, document, &desc, &result);
    if (result)
        report_list(&check->cli.report, mxg_result_diagnostics(result));
    if (!report_status(&check->cli.report, status)) {
        mxg_result_destroy(result);
        return;
    }
    check->waiting[check->num_waiting++] = result;
    if (check->num_waiting == COMPILE_MAX_RESULTS)
        check_waiting(check, target, interface);
}

static void check_element(struct check *check, const mxg_document *document, const char *element,
                          const char *target, const char *interface)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.element = element;
    check_one(check, document, desc, target, interface);
}

/* The stacks of --stage, which stand for the elements. */
static void check_stacks(struct check *check, const mxg_document *document, const char *target,
                         const char *interface)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.bindings = check->bindings;
    for (; desc.stack < mxg_bindings_num_stacks(check->bindings); ++desc.stack)
        check_one(check, document, desc, target, interface);
}

static void check_elements(struct check *check, const mxg_document *document, const char *target,
                           const char *interface)
{
    if (check->bindings) {
        check_stacks(check, document, target, interface);
        return;
    }
    for (size_t i = 0; i < check->elements.len; ++i)
        check_element(check, document, check->elements.items[i], target, interface);
    for (uint32_t i = 0; check->elements.len == 0 && i < mxg_document_num_renderables(document);
         ++i) {
        mxg_renderable renderable = {sizeof renderable};
        mxg_document_renderable(document, i, &renderable);
        check_element(check, document, renderable.path, target, interface);
    }
}

/* Adds the materials of the stage to the document. False after a message. */
static bool bind_stage(struct check *check, mxg_document **document)
{
    mxg_bindings_desc desc = MXG_BINDINGS_DESC_INIT;
    desc.look = check->look;
    mxg_scene *scene = scene_file_load(&check->cli, check->stage, NULL);
    if (!scene)
        return false;
    mxg_document *own = *document;
    *document = scene_file_document(&check->cli, own, scene);
    mxg_document_destroy(own);
    if (!*document) {
        mxg_scene_destroy(scene);
        return false;
    }
    mxg_status status =
        mxg_bindings_create(check->cli.context, *document, scene, &desc, &check->bindings);
    if (check->bindings)
        report_list(&check->cli.report, mxg_bindings_diagnostics(check->bindings));
    report_status(&check->cli.report, status);
    mxg_scene_destroy(scene);
    return status == MXG_OK;
}

static bool set_option(struct check *check, const char *option, const char *value)
{
    if (mxg_options_set(check->cli.options, option, value) == MXG_OK)
        return true;
    char *reason = cli_option_error(check->cli.options);
    report_error(&check->cli.report, "bad-option", "%s", reason);
    free(reason);
    return false;
}

static void check_interfaces(struct check *check, const mxg_document *document, const char *target)
{
    char interface[32];
    for (const char *interfaces = check->interfaces;
         next_word(&interfaces, interface, sizeof interface);) {
        if (!set_option(check, "interface", interface))
            continue;
        check_elements(check, document, target, interface);
        check_waiting(check, target, interface);
    }
}

static void check_document(struct check *check)
{
    mxg_document *document = cli_load(&check->cli, check->input);
    if (document && check->stage && !bind_stage(check, &document)) {
        mxg_document_destroy(document);
        return;
    }
    char target[32];
    for (const char *targets = check->targets;
         document && next_word(&targets, target, sizeof target);) {
        if (!check->roles)
            check_interfaces(check, document, target);
        for (const char *roles = check->roles;
             roles && next_word(&roles, check->role, sizeof check->role);)
            if (set_option(check, "role", check->role))
                check_interfaces(check, document, target);
    }
    mxg_bindings_destroy(check->bindings);
    check->bindings = NULL;
    mxg_document_destroy(document);
}

static void note_missing_compilers(const struct check *check)
{
    char target[32];
    for (const char *targets = check->targets;
         !check->no_compile && next_word(&targets, target, sizeof target);)
        if (!compile_knows_target(cli_base_target(&check->cli, target)))
            fprintf(stderr,
                    "note: shaders for '%s' are not compiled: no compiler for it is installed\n",
                    target);
}

int main(int argc, char **argv)
{
    static const struct command command = {
        "compile",
        "-compile FILE... [--targets T,...] [--interfaces I,...] [--roles R,...] [options]",
        "Generates and compiles every renderable element. Prints: file, element, target, "
        "interface,\n"
        "bytes and lines of the pixel stage, SPIR-V body instructions of pixel and vertex stage.",
        NULL};
    struct check check = {.targets = "glsl,vulkan,essl", .interfaces = "complete,authored,reduced"};
    const struct arg args[] = {
        {"targets", 't', ARG_TEXT, "T,...", "targets (default: glsl,vulkan,essl)", &check.targets},
        {"interfaces", 'i', ARG_TEXT, "I,...",
         "interface modes (default: complete,authored,reduced)", &check.interfaces},
        {"roles", 0, ARG_TEXT, "R,...", "roles (default: that of --role)", &check.roles},
        {"element", 'e', ARG_LIST, "PATH", "path of an element (default: all renderable elements)",
         &check.elements},
        {"stage", 0, ARG_TEXT, "FILE", "a scene: the stacks of its primitives are the elements",
         &check.stage},
        {"look", 0, ARG_TEXT, "LOOK", "the look for --stage", &check.look},
        {"no-compile", 0, ARG_FLAG, NULL, "does not compile the shaders", &check.no_compile},
    };
    int code;
    if (cli_start(&check.cli, &command, args, sizeof args / sizeof *args,
                  CLI_GENERATES | CLI_NEEDS_INPUT, argc, argv, &code)) {
        compile_begin();
        note_missing_compilers(&check);
        if (args_is_given(&check.cli.parser, "mdl-module"))
            compile_import_module(check.cli.context, check.cli.library, check.cli.options);
        for (size_t i = 0; i < check.cli.parser.inputs.len; ++i) {
            check.input = check.cli.parser.inputs.items[i];
            check_document(&check);
        }
        compile_end();
        code = check.cli.report.errors ? EXIT_FAULT : EXIT_DONE;
    }
    cli_finish(&check.cli);
    free(check.elements.items);
    return code;
}
