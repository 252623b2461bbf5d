// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen: the command line. The first argument may name a command; without one, shaders are
 * generated.
 */
#define _POSIX_C_SOURCE 200809L
#include "cli/cli.h"
#include "cli/files.h"

#include <string.h>
#include <unistd.h>

static const struct command commands[] = {
    {"generate", "[generate] FILE... [--target T] [-o DIR] [options]",
     "Writes shaders for the renderable elements of documents.", command_generate},
    {"check",
     "check PATH... [--target T,...] [-j N] [--json FILE] [options]  |  check merge REPORT.json... "
     "[options]",
     "Validates, generates and compiles every document in files, folders, patterns and @lists.",
     command_check},
    {"inspect", "inspect FILE [--graph | --dot | --ir | --closures | --statistics] [options]",
     "Prints what mxgen sees: elements, graph, IR, closures with weights, statistics.",
     command_inspect},
    {"validate", "validate FILE...",
     "Checks documents against the library: every node, connection and value.", command_validate},
    {"explain", "explain [ID...] [-o DIR | --markdown]",
     "Tells cause, cure and example of a message; without an id, lists them all.", command_explain},
    {"render", "render FILE|FOLDER... -o PICTURE.png [options]",
     "Draws materials, without a display.", command_render},
    {"library", "library pack|list|expand|doc [PATH...] [-o PATH]",
     "Packs, lists, expands and documents node libraries.", command_library},
};
#define NUM_COMMANDS (sizeof commands / sizeof *commands)

static void print_overview(void)
{
    puts("mxgen compiles MaterialX documents to shaders.\n\nUsage:");
    for (size_t i = 0; i < NUM_COMMANDS; ++i)
        printf("  mxgen %s\n      %s\n", commands[i].usage, commands[i].brief);
    puts("\nTargets:");
    for (uint32_t i = 0; i < mxg_num_targets(); ++i) {
        mxg_target target = {sizeof target};
        mxg_get_target(i, &target);
        printf("  %-8s %s\n", target.name, target.brief);
    }
    puts(
        "\n'mxgen COMMAND --help' tells the options of a command. The FILE '-' is standard input.");
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
 * A first word which is neither an option nor a file, nor looks like one, was meant as a command.
 */
static bool is_unknown_command(const char *word)
{
    return word[0] != '-' && !strpbrk(word, "./") && access(word, F_OK) != 0;
}

static int fail_unknown_command(const char *word)
{
    const char *names[NUM_COMMANDS];
    for (size_t i = 0; i < NUM_COMMANDS; ++i)
        names[i] = commands[i].name;
    const char *near = args_closest(word, names, NUM_COMMANDS);
    if (near)
        fprintf(stderr, "mxgen: unknown command '%s' (did you mean '%s'?)\n", word, near);
    else
        fprintf(stderr, "mxgen: unknown command '%s'; see --help\n", word);
    return EXIT_USAGE;
}

/* Output lost in a full disk or closed pipe must not look like success. */
static int flush(int code)
{
    if (fflush(stdout) == 0 && !ferror(stdout))
        return code;
    fputs("error: cannot write standard output [output-failed]\n", stderr);
    return code == EXIT_DONE ? EXIT_FAULT : code;
}

static bool asks_for_help(const char *word)
{
    return strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 || strcmp(word, "help") == 0;
}

/* "mxgen help check" is "mxgen check --help". */
static int help_command(const char *name)
{
    char option[] = "--help", *argv[] = {option, option, NULL};
    const struct command *command = find_command(name);
    return command ? flush(command->run(command, 2, argv)) : fail_unknown_command(name);
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fputs("usage: mxgen FILE... --target T; see --help\n", stderr);
        return EXIT_USAGE;
    }
    if (argc == 2 && asks_for_help(argv[1])) {
        print_overview();
        return flush(EXIT_DONE);
    }
    if (strcmp(argv[1], "help") == 0)
        return help_command(argv[2]);
    const struct command *command = find_command(argv[1]);
    if (command)
        return flush(command->run(command, argc - 1, argv + 1));
    if (is_unknown_command(argv[1]))
        return fail_unknown_command(argv[1]);
    return flush(commands[0].run(&commands[0], argc, argv));
}
