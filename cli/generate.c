// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen FILE|FOLDER...: shaders of the renderable elements of documents, as files or on standard
 * output.
 */
#include "cli/commands.h"
#include "program/cli_targets.h"
#include "program/file_name.h"
#include "program/files.h"
#include "program/folder.h"
#include "cli/generate.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* ---- Files ---- */

static const char *network_suffixes[MXG_NUM_STAGES] = {"displacement.oslgroup", "oslgroup"};

/* "<folder>/<name>.<suffix>", or the file of -o; the caller frees it. */
static char *file_path(const struct generate *gen, const char *folder, const char *element,
                       const char *suffix)
{
    if (gen->is_file)
        return cli_format("%s", gen->output);
    char *name = file_name_of_element(element),
         *path = cli_format("%s/%s.%s", folder, name, suffix);
    size_t skipped = strncmp(path, "./", 2) == 0 ? 2 : 0;
    memmove(path, path + skipped, strlen(path + skipped) + 1);
    free(name);
    return path;
}

static char *owner_of(const char *element)
{
    return cli_format("the element '%s'", element);
}

static bool claim(struct generate *gen, const char *folder, const char *element, const char *suffix)
{
    char *path = file_path(gen, folder, element, suffix), *owner = owner_of(element);
    bool good = outputs_write(&gen->files, &gen->cli.report, path, owner);
    free(owner);
    free(path);
    return good;
}

/* Writes one file of an element, or prints it after its name. */
static void write_file(struct generate *gen, const char *folder, const char *element,
                       const char *suffix, const char *text, size_t size)
{
    if (gen->to_stdout) {
        char *name = file_name_of_element(element);
        printf("// %s.%s\n", name, suffix);
        fwrite(text, 1, size, stdout);
        free(name);
        return;
    }
    char *path = file_path(gen, folder, element, suffix), *owner = owner_of(element);
    const char *reason = NULL;
    if (outputs_write(&gen->files, &gen->cli.report, path, owner))
        reason = files_write(path, text, size);
    if (reason)
        report_error(&gen->cli.report, "output-failed", "cannot write '%s': %s", path, reason);
    args_append(&gen->outputs, path);
    free(owner);
}

/*
 * Writes the lists of a network's layers, and their shaders, which other elements may share.
 */
static void write_network(struct generate *gen, const char *folder, const char *element,
                          const mxg_result *result)
{
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage) {
        size_t size = 0;
        const char *text = mxg_result_source(result, (mxg_stage)stage, &size);
        if (text)
            write_file(gen, folder, element, network_suffixes[stage], text, size);
    }
    for (uint32_t i = 0; i < mxg_result_num_parts(result); ++i) {
        mxg_part part = {sizeof part};
        mxg_result_part(result, i, &part);
        char *path = file_path(gen, folder, part.name, "osl");
        if (gen->to_stdout || !outputs_has(&gen->files, path))
            write_file(gen, folder, part.name, "osl", part.source, part.source_size);
        free(path);
    }
}

static void write_stages(struct generate *gen, const char *folder, const char *element,
                         const mxg_result *result)
{
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage) {
        size_t size = 0;
        const char *text = mxg_result_source(result, (mxg_stage)stage, &size);
        const char *suffix = gen->target_info.stage_suffix[stage];
        bool is_asked = !gen->is_file || (int)gen->stage == stage;
        if (text && suffix && is_asked)
            write_file(gen, folder, element, suffix, text, size);
        else if (gen->is_file && is_asked)
            report_error(&gen->cli.report, "output-failed",
                         "cannot write '%s': '%s' has no such stage", gen->output, element);
    }
}

void generate_write(struct generate *gen, const char *folder, const char *element,
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

void generate_write_cuts(struct generate *gen, const mxg_document *document, const char *folder,
                         const mxg_generate_desc *desc, const mxg_result *stored)
{
    mxg_result *result = NULL;
    mxg_shader_info info = {sizeof info};
    mxg_storage storage = {sizeof storage};
    if (!gen->is_deferred || mxg_result_info(stored, &info) != MXG_OK
        || mxg_result_storage(stored, &storage) != MXG_OK || !storage.words
        || info.alpha != MXG_ALPHA_MASK || gen->is_file)
        return;
    mxg_options_set(gen->cli.options, "role", "depth");
    mxg_status status = mxg_generate(gen->cli.context, document, desc, &result);
    mxg_options_set(gen->cli.options, "role", "deferred");
    if (report_status(&gen->cli.report, status)) {
        char *name = cli_format("%s.depth", info.path);
        generate_write(gen, folder, name, result);
        free(name);
    }
    mxg_result_destroy(result);
}

bool generate_add_source(struct generate *gen, const char *file)
{
    bool is_new = false;
    if (strcmp(file, CLI_STDIN_NAME) != 0)
        names_add(&gen->known_sources, file, &is_new);
    if (!is_new)
        return true;
    args_append(&gen->sources, cli_format("%s", file));
    return outputs_read(&gen->files, &gen->cli.report, file);
}

/* ---- Elements ---- */

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
        generate_write(gen, folder, info.path, result);
        generate_write_cuts(gen, document, folder, &desc, result);
        for (uint32_t i = 0; i < mxg_result_num_files(result); ++i)
            generate_add_source(gen, mxg_result_file(result, i));
    }
    mxg_result_destroy(result);
}

static void add_once(struct arg_list *list, struct name_table *known, const char *path)
{
    bool is_new;
    names_add(known, path, &is_new);
    if (is_new)
        args_append(list, cli_format("%s", path));
}

/*
 * The paths of the elements to generate, each once: those of the arguments, where a look means its
 * materials, or every renderable. The caller frees the list.
 */
static struct arg_list find_elements(const struct generate *gen, const mxg_document *document)
{
    struct arg_list list = {0};
    struct name_table known = {0};
    mxg_renderable renderable = {sizeof renderable};
    for (size_t i = 0; i < gen->elements.len; ++i) {
        const char *path = gen->elements.items[i];
        bool is_look = false;
        for (uint32_t k = 0; k < mxg_document_num_renderables(document); ++k)
            if (mxg_document_has_assignment(document, path, k)) {
                mxg_document_renderable(document, k, &renderable);
                add_once(&list, &known, renderable.path);
                is_look = true;
            }
        if (!is_look)
            add_once(&list, &known, path);
    }
    for (uint32_t i = 0; !gen->elements.len && i < mxg_document_num_renderables(document); ++i) {
        mxg_document_renderable(document, i, &renderable);
        add_once(&list, &known, renderable.path);
    }
    names_finish(&known);
    return list;
}

/*
 * False, after a message, for a material whose file would be that of the module which materials in
 * the folder import.
 */
static bool is_no_module(struct generate *gen, const char *folder, const char *element)
{
    const char *suffix = gen->target_info.stage_suffix[MXG_STAGE_PIXEL];
    char *path = file_path(gen, folder, element, suffix),
         *module = gen->module ? file_path(gen, gen->output, gen->module, suffix) : NULL;
    bool is_it = module && strcmp(path, module) == 0 && !gen->is_file;
    if (is_it)
        report_error(&gen->cli.report, "output-clash",
                     "the element '%s' and the module '%s' would write one file, '%s'", element,
                     gen->module, path);
    free(module);
    free(path);
    return !is_it;
}

bool generate_claim(struct generate *gen, const char *folder, const char *element)
{
    const char *const *suffixes =
        gen->is_network ? network_suffixes : gen->target_info.stage_suffix;
    bool good = is_no_module(gen, folder, element)
                && (!gen->reflect || claim(gen, folder, element, "json"));
    for (int stage = 0; stage < MXG_NUM_STAGES && good; ++stage)
        good = !suffixes[stage] || claim(gen, folder, element, suffixes[stage]);
    return good;
}

static bool claim_files(struct generate *gen, const mxg_document *document, const char *folder,
                        const struct arg_list *elements)
{
    bool good = true;
    for (uint32_t i = 0; i < mxg_document_num_files(document); ++i)
        good = generate_add_source(gen, mxg_document_file(document, i)) && good;
    if (gen->is_file && elements->len > 1) {
        report_error(&gen->cli.report, "output-clash",
                     "'%s' is one file, and the document has %zu elements; name one with -e, or a "
                     "folder with -o",
                     gen->output, elements->len);
        return false;
    }
    for (size_t i = 0; i < elements->len && !gen->to_stdout; ++i)
        good = generate_claim(gen, folder, elements->items[i]) && good;
    return good;
}

bool generate_make_folder(struct generate *gen, const char *folder)
{
    const char *reason = gen->to_stdout || gen->is_file ? NULL : files_make_folder(folder);
    if (reason)
        report_error(&gen->cli.report, "output-failed", "cannot make the folder '%s': %s", folder,
                     reason);
    return !reason;
}

/* Reports the errors that `mxgen check` finds, also in elements that give no shader. */
static void validate(struct generate *gen, const mxg_document *document)
{
    mxg_result *result = NULL;
    mxg_status status = mxg_validate(gen->cli.context, document, &result);
    if (result)
        report_errors(&gen->cli.report, mxg_result_diagnostics(result));
    report_status(&gen->cli.report, status);
    mxg_result_destroy(result);
}

static void generate_elements(struct generate *gen, const mxg_document *document,
                              const char *folder, const struct arg_list *elements)
{
    if (!generate_make_folder(gen, folder))
        return;
    if (gen->elements.len == 0)
        validate(gen, document);
    for (size_t i = 0; i < elements->len; ++i)
        generate_element(gen, document, folder, elements->items[i]);
    if (elements->len == 0) /* generation reports the missing material */
        generate_element(gen, document, folder, NULL);
}

static void generate_file(struct generate *gen, const char *input, const char *folder)
{
    mxg_document *document = cli_load(&gen->cli, input);
    if (!document)
        return;
    if (gen->scene_file) {
        generate_stacks(gen, document, folder);
        mxg_document_destroy(document);
        return;
    }
    struct arg_list elements = find_elements(gen, document);
    if (claim_files(gen, document, folder, &elements))
        generate_elements(gen, document, folder, &elements);
    args_free(&elements);
    mxg_document_destroy(document);
}

/* ---- Documents and their folders ---- */

/*
 * The output folder of a document: the folder of -o, and below it, if there are several documents,
 * the name of the document relative to the argument. The caller frees it.
 */
static char *output_folder(const struct generate *gen, const char *argument, const char *document)
{
    size_t len = strlen(argument);
    bool is_in_folder = files_is_folder(argument);
    const char *name = strcmp(document, "-") == 0 ? "stdin"
                       : is_in_folder             ? document + len + (document[len] == '/')
                                                  : files_base_name(document);
    const char *base = files_base_name(name), *dot = strrchr(base, '.');
    int name_len = (int)(dot && dot != base ? (size_t)(dot - name) : strlen(name));
    if (gen->cli.parser.inputs.len <= 1 && !is_in_folder)
        return cli_format("%s", gen->output);
    char *part = cli_format("%.*s", name_len, name), *clean = file_name_clean(part);
    char *folder = cli_format("%s/%s", gen->output, clean);
    free(clean);
    free(part);
    return folder;
}

/* Lists the documents of the arguments with their output folders, which must differ. */
static bool find_documents(struct generate *gen)
{
    struct name_table known = {0};
    bool good = true;
    for (size_t i = 0; i < gen->cli.parser.inputs.len; ++i) {
        const char *argument = gen->cli.parser.inputs.items[i], *reason = NULL;
        size_t first = gen->documents.len;
        if (folder_documents(&(struct arg_list){&argument, 1}, &gen->documents, &reason)) {
            report_error(&gen->cli.report, "file-unreadable", "'%s': %s", argument, reason);
            good = false;
        }
        for (size_t d = first; d < gen->documents.len; ++d) {
            bool is_new = true;
            const char *document = gen->documents.items[d];
            args_append(&gen->folders, output_folder(gen, argument, document));
            if (!gen->to_stdout)
                names_add(&known, gen->folders.items[d], &is_new);
            if (!is_new)
                report_error(&gen->cli.report, "output-clash",
                             "'%s': another input writes to '%s', too", document,
                             gen->folders.items[d]);
            good = good && is_new;
            good = (strcmp(document, "-") == 0
                    || outputs_read(&gen->files, &gen->cli.report, document))
                   && good;
        }
    }
    names_finish(&known);
    return good;
}

/* Writes names with a space between them. NULL, or the name that make cannot read. */
static const char *put_names(FILE *out, const struct arg_list *names, bool are_targets)
{
    for (size_t i = 0; i < names->len; ++i) {
        if (i)
            putc(' ', out);
        if (!file_name_put_make(out, names->items[i], are_targets))
            return names->items[i];
    }
    return NULL;
}

/* "out1 out2: in1 in2": the dependencies for make and ninja. */
static void write_depfile(struct generate *gen)
{
    struct files_stream stream;
    const char *reason = files_begin(&stream, gen->depfile), *unfit = NULL;
    if (!reason && gen->outputs.len) {
        unfit = put_names(stream.out, &gen->outputs, true);
        fputs(": ", stream.out);
        if (!unfit)
            unfit = put_names(stream.out, &gen->sources, false);
        putc('\n', stream.out);
    }
    if (!reason)
        reason = files_end(&stream, !unfit);
    if (unfit)
        report_error(&gen->cli.report, "depfile-name",
                     "a depfile cannot name '%s'; rename the file", unfit);
    if (reason)
        report_error(&gen->cli.report, "output-failed", "cannot write '%s': %s", gen->depfile,
                     reason);
}

static int generate_all(struct generate *gen)
{
    bool good =
        !gen->depfile || outputs_write(&gen->files, &gen->cli.report, gen->depfile, "--depfile");
    for (uint32_t i = 0; i < mxg_library_num_files(gen->cli.library); ++i)
        good = generate_add_source(gen, mxg_library_file(gen->cli.library, i)) && good;
    for (size_t i = 0; i < gen->cli.plugin_files.len; ++i)
        good = generate_add_source(gen, gen->cli.plugin_files.items[i]) && good;
    good = find_documents(gen) && good;
    for (size_t i = 0; i < gen->documents.len && good; ++i)
        generate_file(gen, gen->documents.items[i], gen->folders.items[i]);
    if (gen->depfile && gen->cli.report.errors == 0)
        write_depfile(gen);
    return gen->cli.report.errors ? EXIT_FAULT : EXIT_DONE;
}

/* ---- Arguments ---- */

/* The stage of a target whose files have the ending of this path; MXG_NUM_STAGES: none. */
static int find_stage(const mxg_target *target, const char *path)
{
    int stage = 0;
    for (; stage < MXG_NUM_STAGES; ++stage) {
        const char *suffix = target->stage_suffix[stage];
        size_t len = strlen(path), end = suffix ? strlen(suffix) : len;
        if (len > end && path[len - end - 1] == '.' && strcmp(path + len - end, suffix) == 0)
            break;
    }
    return stage;
}

/* True if the last setting of an option of generation has a value. */
/* The reason why -o cannot name a file; NULL if it can. */
static const char *find_file_misuse(const struct generate *gen)
{
    const struct arg_list *inputs = &gen->cli.parser.inputs;
    if (gen->stage == MXG_NUM_STAGES)
        return "this ending is of another target";
    if (gen->is_network)
        return "an OSL network has several files";
    if (gen->reflect)
        return "--reflect writes another file";
    return inputs->len > 1 || files_is_folder(inputs->items[0]) ? "there are several documents"
                                                                : NULL;
}

/* The reason why --stage cannot stand with the other arguments; NULL if it can. */
static const char *find_stage_misuse(const struct generate *gen)
{
    if (!gen->scene_file)
        return gen->look || gen->purpose ? "--look and --purpose need --stage" : NULL;
    if (gen->elements.len)
        return "--stage takes its materials from a look, so --element does not apply";
    if (gen->to_stdout || gen->is_file)
        return "--stage writes several files; name a folder with -o";
    return gen->cli.parser.inputs.len > 1 || files_is_folder(gen->cli.parser.inputs.items[0])
               ? "--stage takes one document"
               : NULL;
}

static bool check_stage(const struct generate *gen)
{
    const char *misuse = find_stage_misuse(gen);
    if (misuse)
        fprintf(stderr, "mxgen: %s\n", misuse);
    return !misuse;
}

/* Decides whether -o is a folder or, by its ending, a file. False after a message. */
static bool prepare_output(struct generate *gen)
{
    gen->is_network = args_has_setting(&gen->cli.parser, "osl-network", "true");
    gen->is_deferred = args_has_setting(&gen->cli.parser, "role", "deferred");
    gen->module = args_setting(&gen->cli.parser, "mdl-module");
    bool is_printed = strcmp(gen->output, "-") == 0;
    bool has_output = args_is_given(&gen->cli.parser, "output") && !is_printed;
    gen->to_stdout = gen->to_stdout || is_printed;
    if (gen->to_stdout && (has_output || gen->depfile)) {
        fprintf(stderr, "mxgen: option '--%s' does not apply: %s writes no file\n",
                gen->depfile ? "depfile" : "output", is_printed ? "-o -" : "--stdout");
        return false;
    }
    if (gen->to_stdout || files_is_folder(gen->output))
        return true;
    mxg_target target;
    for (uint32_t i = 0; !gen->is_file && cli_target(&gen->cli, i, &target); ++i)
        gen->is_file = find_stage(&target, gen->output) < MXG_NUM_STAGES;
    if (!gen->is_file)
        return true;
    gen->stage = (mxg_stage)find_stage(&gen->target_info, gen->output);
    const char *misuse = find_file_misuse(gen);
    if (misuse)
        fprintf(stderr, "mxgen: '-o %s' names a file, but %s; name a folder\n", gen->output,
                misuse);
    return !misuse;
}

int command_generate(const struct command *command, int argc, char **argv)
{
    struct generate gen = {.target = "glsl", .output = "."};
    const struct arg args[] = {
        {"target", 't', ARG_TEXT, "T", "target language (default: glsl)", &gen.target},
        {"element", 'e', ARG_LIST, "PATH",
         "path of an element to generate (default: all renderable elements)", &gen.elements},
        {"output", 'o', ARG_TEXT, "DIR|FILE",
         "output folder (default: the current folder), or one file with the ending of a stage, "
         "such "
         "as gold.frag",
         &gen.output},
        {"reflect", 0, ARG_FLAG, NULL, "also writes the reflection as JSON", &gen.reflect},
        {"stdout", 0, ARG_FLAG, NULL, "prints the files instead of writing them, as '-o -' does",
         &gen.to_stdout},
        {"stage", 0, ARG_TEXT, "FILE",
         "a scene; writes a shader for each distinct stack of its primitives, and bindings.json "
         "(docs/slots.md)",
         &gen.scene_file},
        {"look", 0, ARG_TEXT, "LOOK", "the look for --stage, or a look group with a default",
         &gen.look},
        {"purpose", 0, ARG_TEXT, "full|preview",
         "for --stage: also takes the bindings of the scene for this purpose", &gen.purpose},
        {"depfile", 0, ARG_TEXT, "FILE",
         "writes the dependencies of the output, for make and ninja", &gen.depfile},
    };
    int code;
    if (cli_start(&gen.cli, command, args, sizeof args / sizeof *args,
                  CLI_GENERATES | CLI_NEEDS_INPUT, argc, argv, &code))
        code = cli_find_target(&gen.cli, gen.target, strlen(gen.target), &gen.target_info)
                       && cli_options_apply(&gen.cli, &gen.target_info.name, 1)
                       && prepare_output(&gen) && check_stage(&gen)
                   ? generate_all(&gen)
                   : EXIT_USAGE;
    cli_finish(&gen.cli);
    free(gen.elements.items);
    args_free(&gen.documents);
    args_free(&gen.folders);
    args_free(&gen.outputs);
    args_free(&gen.sources);
    names_finish(&gen.known_sources);
    outputs_finish(&gen.files);
    return code;
}
