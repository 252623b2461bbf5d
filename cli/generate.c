// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen FILE...: shaders of the renderable elements of documents, as files or on standard output.
 */
#include "cli/cli.h"
#include "cli/files.h"

#include <stdlib.h>
#include <string.h>

struct generate {
    struct cli cli;
    const char *target, *folder, *depfile;
    struct arg_list elements; /* empty: every renderable */
    bool to_stdout, reflect;
    bool several; /* several input files: each gets its own folder */

    mxg_target target_info;
    struct arg_list outputs, sources; /* for the depfile; items are allocated */
    struct arg_list folders;          /* output folders of several inputs */
};

/* Writes one file of an element, "<folder>/<element>.<suffix>", or prints it after its name. */
static void write_file(struct generate *gen, const char *folder, const char *element,
                       const char *suffix, const char *text, size_t size)
{
    char *name = cli_file_name(element);
    if (gen->to_stdout) {
        printf("// %s.%s\n", name, suffix);
        fwrite(text, 1, size, stdout);
    } else {
        char *path = cli_format("%s/%s.%s", folder, name, suffix);
        const char *tidy = strncmp(path, "./", 2) == 0 ? path + 2 : path;
        const char *reason = files_write(tidy, text, size);
        if (reason)
            report_error(&gen->cli.report, "output-failed", "cannot write '%s': %s", tidy, reason);
        args_append(&gen->outputs, cli_format("%s", tidy));
        free(path);
    }
    free(name);
}

static bool is_written(const struct generate *gen, const char *folder, const char *name)
{
    char *path = cli_format("%s/%s.osl", folder, name);
    const char *tidy = strncmp(path, "./", 2) == 0 ? path + 2 : path;
    bool found = false;
    for (size_t i = 0; i < gen->outputs.len && !found; ++i)
        found = strcmp(gen->outputs.items[i], tidy) == 0;
    free(path);
    return found;
}

/*
 * Writes the lists of a network's layers, and their shaders, which other elements may share.
 */
static void write_network(struct generate *gen, const char *folder, const char *element,
                          const mxg_result *result)
{
    static const char *const suffixes[MXG_NUM_STAGES] = {"displacement.oslgroup", "oslgroup"};
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage) {
        size_t size = 0;
        const char *text = mxg_result_source(result, (mxg_stage)stage, &size);
        if (text)
            write_file(gen, folder, element, suffixes[stage], text, size);
    }
    for (uint32_t i = 0; i < mxg_result_num_parts(result); ++i) {
        mxg_part part = {sizeof part};
        mxg_result_part(result, i, &part);
        if (!is_written(gen, folder, part.name))
            write_file(gen, folder, part.name, "osl", part.source, part.source_size);
    }
}

static void write_stages(struct generate *gen, const char *folder, const char *element,
                         const mxg_result *result)
{
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage) {
        size_t size = 0;
        const char *text = mxg_result_source(result, (mxg_stage)stage, &size);
        const char *suffix = gen->target_info.stage_suffix[stage];
        if (text && suffix)
            write_file(gen, folder, element, suffix, text, size);
    }
}

static void write_result(struct generate *gen, const char *folder, const char *element,
                         const mxg_result *result)
{
    if (mxg_result_num_parts(result))
        write_network(gen, folder, element, result);
    else
        write_stages(gen, folder, element, result);
    if (gen->reflect) {
        size_t size = 0;
        const char *text = mxg_result_reflection_json(result, &size);
        write_file(gen, folder, element, "json", text, size);
    }
}

static void add_source(struct generate *gen, const char *file)
{
    if (strcmp(file, CLI_STDIN_NAME) == 0)
        return;
    for (size_t i = 0; i < gen->sources.len; ++i)
        if (strcmp(gen->sources.items[i], file) == 0)
            return;
    args_append(&gen->sources, cli_format("%s", file));
}

static void generate_element(struct generate *gen, const mxg_document *document, const char *folder,
                             const char *element)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = gen->target;
    desc.element = element;
    desc.options = gen->cli.options;
    mxg_result *result = NULL;
    mxg_status status = mxg_generate(gen->cli.context, document, &desc, &result);
    if (result)
        report_list(&gen->cli.report, mxg_result_diagnostics(result));
    if (report_status(&gen->cli.report, status)) {
        /* only the path; computing the topology hash is expensive */
        mxg_shader_info info = {offsetof(mxg_shader_info, topology)};
        mxg_result_info(result, &info);
        write_result(gen, folder, info.path, result);
        for (uint32_t i = 0; i < mxg_result_num_files(result); ++i)
            add_source(gen, mxg_result_file(result, i));
    }
    mxg_result_destroy(result);
}

/* Generates the elements of the arguments; a look means its materials. */
static void generate_asked(struct generate *gen, const mxg_document *document, const char *folder,
                           const char *path)
{
    mxg_renderable material = {sizeof material};
    uint32_t count = 0;
    for (; mxg_document_look_material(document, path, count, &material) == MXG_OK; ++count)
        generate_element(gen, document, folder, material.path);
    if (count == 0)
        generate_element(gen, document, folder, path);
}

static void generate_elements(struct generate *gen, const mxg_document *document,
                              const char *folder)
{
    for (size_t i = 0; i < gen->elements.len; ++i)
        generate_asked(gen, document, folder, gen->elements.items[i]);
    if (gen->elements.len)
        return;
    uint32_t count = mxg_document_num_renderables(document);
    for (uint32_t i = 0; i < count; ++i) {
        mxg_renderable renderable = {sizeof renderable};
        mxg_document_renderable(document, i, &renderable);
        generate_element(gen, document, folder, renderable.path);
    }
    if (count == 0) /* generation reports the missing material */
        generate_element(gen, document, folder, NULL);
}

/* Makes the output folder of an input; the caller frees its name. NULL after an error. */
static char *output_folder(struct generate *gen, const char *input)
{
    const char *base = strcmp(input, "-") == 0 ? "stdin" : files_base_name(input);
    const char *dot = strrchr(base, '.');
    int len = (int)(dot && dot != base ? (size_t)(dot - base) : strlen(base));
    char *folder = gen->several ? cli_format("%s/%.*s", gen->folder, len, base)
                                : cli_format("%s", gen->folder);
    for (size_t i = 0; i < gen->folders.len; ++i) {
        if (strcmp(gen->folders.items[i], folder) == 0) {
            report_error(&gen->cli.report, "output-failed",
                         "'%s': another input writes to '%s' already", input, folder);
            free(folder);
            return NULL;
        }
    }
    const char *reason = gen->to_stdout ? NULL : files_make_folder(folder);
    if (reason) {
        report_error(&gen->cli.report, "output-failed", "cannot make the folder '%s': %s", folder,
                     reason);
        free(folder);
        return NULL;
    }
    args_append(&gen->folders, cli_format("%s", folder));
    return folder;
}

static void generate_file(struct generate *gen, const char *input)
{
    mxg_document *document = cli_load(&gen->cli, input);
    if (!document)
        return;
    for (uint32_t i = 0; i < mxg_document_num_files(document); ++i)
        add_source(gen, mxg_document_file(document, i));
    char *folder = output_folder(gen, input);
    if (folder)
        generate_elements(gen, document, folder);
    free(folder);
    mxg_document_destroy(document);
}

/* "out1 out2: in1 in2": the dependencies for make and ninja. */
static void write_depfile(struct generate *gen)
{
    struct files_stream stream;
    const char *reason = files_begin(&stream, gen->depfile);
    for (size_t i = 0; !reason && i < gen->outputs.len; ++i) {
        files_put_make_name(stream.out, gen->outputs.items[i]);
        putc(i + 1 < gen->outputs.len ? ' ' : ':', stream.out);
    }
    for (size_t i = 0; !reason && gen->outputs.len && i < gen->sources.len; ++i) {
        putc(' ', stream.out);
        files_put_make_name(stream.out, gen->sources.items[i]);
    }
    if (!reason && gen->outputs.len)
        putc('\n', stream.out);
    if (!reason)
        reason = files_end(&stream, true);
    if (reason)
        report_error(&gen->cli.report, "output-failed", "cannot write '%s': %s", gen->depfile,
                     reason);
}

static int generate_all(struct generate *gen)
{
    gen->several = gen->cli.parser.inputs.len > 1;
    for (uint32_t i = 0; i < mxg_library_num_files(gen->cli.library); ++i)
        add_source(gen, mxg_library_file(gen->cli.library, i));
    for (size_t i = 0; i < gen->cli.parser.inputs.len; ++i)
        generate_file(gen, gen->cli.parser.inputs.items[i]);
    if (gen->depfile && gen->cli.report.errors == 0)
        write_depfile(gen);
    return gen->cli.report.errors ? EXIT_FAULT : EXIT_DONE;
}

int command_generate(const struct command *command, int argc, char **argv)
{
    struct generate gen = {.target = "glsl", .folder = "."};
    const struct arg args[] = {
        {"target", 't', ARG_TEXT, "T", "target language (default: glsl)", &gen.target},
        {"element", 'e', ARG_LIST, "PATH",
         "path of an element to generate (default: all renderable elements)", &gen.elements},
        {"output", 'o', ARG_TEXT, "DIR", "output folder (default: the current folder)",
         &gen.folder},
        {"reflect", 0, ARG_FLAG, NULL, "also writes the reflection as JSON", &gen.reflect},
        {"stdout", 0, ARG_FLAG, NULL, "prints the files instead of writing them", &gen.to_stdout},
        {"depfile", 0, ARG_TEXT, "FILE",
         "writes the dependencies of the output, for make and ninja", &gen.depfile},
    };
    int code;
    if (cli_start(&gen.cli, command, args, sizeof args / sizeof *args,
                  CLI_GENERATES | CLI_NEEDS_INPUT, argc, argv, &code))
        code = cli_find_target(gen.target, strlen(gen.target), &gen.target_info)
                   ? generate_all(&gen)
                   : EXIT_USAGE;
    cli_finish(&gen.cli);
    free(gen.elements.items);
    args_free(&gen.outputs);
    args_free(&gen.sources);
    args_free(&gen.folders);
    return code;
}
