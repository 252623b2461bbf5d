// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen: the command line. The first argument may name a command; without one, mxgen generates
 * shaders.
 */
#define _POSIX_C_SOURCE 200809L
#include "check/check.h"
#include "cli/commands.h"
#include "program/cli.h"
#include "program/files.h"
#include "program/help.h"

#include <string.h>
#include <unistd.h>

static const struct command commands[] = {
    {"generate", "[generate] FILE... [--target T] [-o DIR] [options]",
     "Writes shaders for the renderable elements of documents.", command_generate},
    {"check",
     "check PATH... [--target T,...] [-j N] [--json FILE] [options]  |  check merge REPORT.json... "
     "[options]",
     "Validates, generates and compiles the documents of files, folders, patterns and @lists.",
     command_check},
    {"inspect", "inspect FILE [--graph | --dot | --ir | --closures | --statistics] [options]",
     "Prints elements, graph, IR, closures or statistics of a document.", command_inspect},
    {"bind", "bind FILE --stage PATHS [--look LOOK] [--json FILE | --geom PATH] [options]",
     "Finds the layers of materials of each primitive of a scene under a look.", command_bind},
    {"validate", "validate FILE...",
     "Checks documents against the specification and the node library.", command_validate},
    {"format", "format FILE... [--in-place | --check | -o FILE]",
     "Writes documents in one layout; comments and includes stay.", command_format},
    {"upgrade", "upgrade FILE... [--in-place | --check | -o FILE]",
     "Writes documents of older versions as version 1.39; comments and includes stay.",
     command_upgrade},
    {"explain", "explain [ID|NODE...] [-o DIR | --markdown]",
     "Prints cause, cure and example of a message, the inputs of a node, or a list of all "
     "messages.",
     command_explain},
    {"render", "render FILE|FOLDER... -o PICTURE.png [options]",
     "Renders materials without a display: one picture, or a sheet of several.", command_render},
    {"bake", "bake FILE|FOLDER -o DIR [--mesh FILE] [options]",
     "Bakes what varies over the surface of a material into images, with a flat document.",
     command_bake},
    {"export", "export FILE -o FILE.glb|.gltf|.usda|.usdz [--mesh FILE] [options]",
     "Writes materials in a format of other programs, with images of what varies.", command_export},
    {"import", "import FILE.glb|FILE.gltf -o FILE.mtlx",
     "Writes the materials of a glTF file as a document, with its images.", command_import},
    {"pipeline", "pipeline FOLDER [--target T] [options]",
     "Writes what belongs to no material: the passes of the deferred pipeline, or the module of "
     "MDL.",
     command_pipeline},
    {"translate", "translate FILE --to MODEL [-o FILE]",
     "Writes a document with its surfaces as another shading model.", command_translate},
    {"library", "library pack|list|expand|doc [PATH...] [-o PATH]  |  library list WORD...",
     "Packs, lists, expands or documents node libraries; finds nodes by a part of their name.",
     command_library},
    {"lsp", "lsp [options]", "Runs a language server for editors (docs/lsp.md).", command_lsp},
};
#define NUM_COMMANDS (sizeof commands / sizeof *commands)

static void print_overview(void)
{
    puts("mxgen compiles MaterialX documents to shaders.\n\nUsage:");
    for (size_t i = 0; i < NUM_COMMANDS; ++i)
        printf("  mxgen %s\n      %s\n", commands[i].usage, commands[i].brief);
    puts("\nTargets:");
    for (uint32_t i = 0; i < mxg_catalogue_num_targets(); ++i) {
        mxg_target target = {sizeof target};
        mxg_catalogue_target(i, &target);
        printf("  %-8s %s\n", target.name, target.brief);
    }
    puts("\n'mxgen COMMAND --help' prints the options of a command. A FILE '-' is standard input.");
}

static const struct command *find_command(const char *name)
{
    for (size_t i = 0; i < NUM_COMMANDS; ++i) {
        if (strcmp(name, commands[i].name) == 0)
            return &commands[i];
    }
    return NULL;
}

/*
 * True if a first word is no option, no file and no file name: probably a misspelt command.
 */
static bool is_unknown_command(const char *word)
{
    return word[0] != '-' && !strpbrk(word, "./") && access(word, F_OK) != 0;
}

/* `kind` is what the word could be. */
static int fail_unknown_word(const char *kind, const char *word)
{
    const char *names[NUM_COMMANDS];
    for (size_t i = 0; i < NUM_COMMANDS; ++i)
        names[i] = commands[i].name;
    const char *near = args_closest(word, names, NUM_COMMANDS);
    if (near)
        fprintf(stderr, "mxgen: unknown %s '%s' (did you mean '%s'?)\n", kind, word, near);
    else
        fprintf(stderr, "mxgen: unknown %s '%s'; see --help\n", kind, word);
    return EXIT_USAGE;
}

/* Output lost to a full disk or a closed pipe is an error. */
static int flush(int code)
{
    if (fflush(stdout) == 0 && !ferror(stdout))
        return code;
    fputs("error: cannot write standard output [output-failed]\n", stderr);
    return code == EXIT_DONE ? EXIT_FAULT : code;
}

static bool is_help_word(const char *word)
{
    return strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 || strcmp(word, "help") == 0;
}

/* Runs a command only to get its table of options. */
static void read_options(struct help_book *book, const struct command *command)
{
    char name[] = "mxgen", *argv[] = {name, NULL};
    struct command reader = *command;
    reader.book = book;
    reader.run(&reader, 1, argv);
}

/* "--man", or "--completion" with the name of a shell. */
static int write_book(const char *option, const char *shell)
{
    struct help_book book = {0};
    int code = EXIT_DONE;
    for (size_t i = 0; i < NUM_COMMANDS; ++i)
        read_options(&book, &commands[i]);
    if (strcmp(option, "--man") == 0) {
        help_write_man(&book, stdout);
    } else if (!shell || !help_write_completion(&book, shell, stdout)) {
        fputs("usage: mxgen help --completion bash|zsh|fish\n", stderr);
        code = EXIT_USAGE;
    }
    help_finish(&book);
    return flush(code);
}

/* "mxgen help check" is "mxgen check --help". */
static int help_command(int argc, char **argv)
{
    if (strcmp(argv[0], "--man") == 0 || strcmp(argv[0], "--completion") == 0)
        return write_book(argv[0], argv[1]);
    char option[] = "--help", *arguments[] = {option, option, argc > 1 ? argv[1] : NULL, NULL};
    const struct command *command = find_command(argv[0]);
    return command ? flush(command->run(command, argc > 1 ? 3 : 2, arguments))
                   : fail_unknown_word("command", argv[0]);
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fputs("usage: mxgen FILE... --target T; see --help\n", stderr);
        return EXIT_USAGE;
    }
    if (argc == 2 && is_help_word(argv[1])) {
        print_overview();
        return flush(EXIT_DONE);
    }
    if (strcmp(argv[1], "help") == 0)
        return help_command(argc - 2, argv + 2);
    const struct command *command = find_command(argv[1]);
    if (command)
        return flush(command->run(command, argc - 1, argv + 1));
    if (is_unknown_command(argv[1]))
        return fail_unknown_word("command or file", argv[1]);
    return flush(commands[0].run(&commands[0], argc, argv));
}
