// SPDX-License-Identifier: Apache-2.0
/* mxgen help --completion SHELL: scripts that complete commands, options and their values. */
#include "program/help.h"

#include <stdlib.h>
#include <string.h>

/*
 * Calls `put` for each option of a chapter, then for each option of generation if the command has
 * them.
 */
static void for_each(const struct help_chapter *chapter, FILE *out,
                     void (*put)(const struct help_chapter *chapter, const struct arg *arg,
                                 FILE *out))
{
    for (size_t i = 0; i < chapter->num_args; ++i)
        put(chapter, &chapter->args[i], out);
    for (uint32_t i = 0; chapter->generation && i < mxg_catalogue_num_options(); ++i) {
        struct arg arg = help_generation_arg(i);
        put(chapter, &arg, out);
    }
}

static bool takes_value(const struct arg *arg)
{
    return arg->kind != ARG_FLAG && arg->kind != ARG_HELP;
}

static bool takes_file(const struct arg *arg)
{
    return takes_value(arg)
           && (strstr(arg->value, "FILE") || strstr(arg->value, "DIR")
               || strstr(arg->value, "PATH"));
}

/* The names of all targets; the caller frees the text. */
static char *target_names(void)
{
    char *names = cli_format("%s", "");
    for (uint32_t i = 0; i < mxg_catalogue_num_targets(); ++i) {
        mxg_target target = {sizeof target};
        mxg_catalogue_target(i, &target);
        char *more = cli_format("%s%s%s", names, i ? " " : "", target.name);
        free(names);
        names = more;
    }
    return names;
}

/*
 * The values of an option, separated by spaces; the caller frees the text. NULL if any value is
 * allowed.
 */
static char *values_of(const struct arg *arg)
{
    if (!takes_value(arg))
        return NULL;
    if (strcmp(arg->name, "target") == 0 || strcmp(arg->name, "targets") == 0)
        return target_names();
    if (!strchr(arg->value, '|') || strpbrk(arg->value, " ABCDEFGHIJKLMNOPQRSTUVWXYZ"))
        return NULL;
    char *words = cli_format("%s", arg->value);
    for (char *c = words; *c; ++c)
        if (*c == '|')
            *c = ' ';
    return words;
}

/* ---- bash ---- */

static void put_bash_name(const struct help_chapter *chapter, const struct arg *arg, FILE *out)
{
    (void)chapter;
    fprintf(out, " --%s", arg->name);
}

static void put_bash_values(const struct help_chapter *chapter, const struct arg *arg, FILE *out)
{
    char *values = values_of(arg);
    const char *command = chapter->command.name;
    if (values && arg->letter)
        fprintf(out, "    %s:--%s | %s:-%c) values='%s' ;;\n", command, arg->name, command,
                arg->letter, values);
    else if (values)
        fprintf(out, "    %s:--%s) values='%s' ;;\n", command, arg->name, values);
    free(values);
}

static void put_bash(const struct help_book *book, FILE *out)
{
    fputs("# bash completion for mxgen\n_mxgen() {\n"
          "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}\n"
          "    local command=generate options= values= commands='help",
          out);
    for (size_t i = 0; i < book->len; ++i)
        fprintf(out, " %s", book->chapters[i].command.name);
    fputs("'\n"
          "    [[ \" $commands \" != *\" ${COMP_WORDS[1]} \"* ]] || command=${COMP_WORDS[1]}\n"
          "    if [[ $before == = ]]; then before=${COMP_WORDS[COMP_CWORD - 2]}; fi\n"
          "    if [[ $word == = ]]; then word= before=${COMP_WORDS[COMP_CWORD - 1]}; fi\n"
          "    case $command in\n",
          out);
    for (size_t i = 0; i < book->len; ++i) {
        fprintf(out, "    %s) options='", book->chapters[i].command.name);
        for_each(&book->chapters[i], out, put_bash_name);
        fputs("' ;;\n", out);
    }
    fputs("    help) options='--man --completion' values=$commands ;;\n    esac\n"
          "    case $command:$before in\n",
          out);
    for (size_t i = 0; i < book->len; ++i)
        for_each(&book->chapters[i], out, put_bash_values);
    fputs(
        "    esac\n"
        "    if [[ $word == -* ]]; then\n"
        "        COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
        "    elif [[ -n $values ]]; then\n"
        "        COMPREPLY=($(compgen -W \"$values\" -- \"$word\"))\n"
        "    else\n"
        "        COMPREPLY=($(compgen -f -- \"$word\"))\n"
        "        [[ $COMP_CWORD -gt 1 ]] || COMPREPLY+=($(compgen -W \"$commands\" -- \"$word\"))\n"
        "    fi\n"
        "}\n"
        "complete -o filenames -F _mxgen mxgen\n",
        out);
}

/* ---- zsh ---- */

/* Text in single quotes, in which `special` characters have a backslash. */
static void put_quoted(const char *text, const char *special, FILE *out)
{
    for (; *text; ++text) {
        if (*text == '\'')
            fputs("'\\''", out);
        else if (strchr(special, *text))
            fprintf(out, "\\%c", *text);
        else
            putc(*text, out);
    }
}

static void put_zsh_option(const struct help_chapter *chapter, const struct arg *arg, FILE *out)
{
    (void)chapter;
    char *values = values_of(arg);
    fprintf(out, "        '%s--%s%s[", arg->kind == ARG_LIST ? "*" : "", arg->name,
            takes_value(arg) ? "=" : "");
    put_quoted(arg->help, "[]\\:", out);
    putc(']', out);
    if (values)
        fprintf(out, ":value:(%s)", values);
    else if (takes_value(arg))
        fputs(takes_file(arg) ? ":file:_files" : ":value: ", out);
    fputs("' \\\n", out);
    free(values);
}

static void put_zsh(const struct help_book *book, FILE *out)
{
    fputs("#compdef mxgen\n_mxgen() {\n    local -a commands\n    commands=(\n", out);
    for (size_t i = 0; i < book->len; ++i) {
        fprintf(out, "        '%s:", book->chapters[i].command.name);
        put_quoted(book->chapters[i].command.brief, "\\:", out);
        fputs("'\n", out);
    }
    fputs("    )\n    if (( CURRENT == 2 )); then _describe command commands; fi\n"
          "    case $words[2] in\n",
          out);
    for (size_t i = book->len; i-- > 0;) { /* the first chapter is the default without a command */
        fprintf(out, i ? "    %s) _arguments \\\n" : "    *) _arguments \\\n",
                book->chapters[i].command.name);
        for_each(&book->chapters[i], out, put_zsh_option);
        fputs("        '*:file:_files' ;;\n", out);
    }
    fputs("    esac\n}\n_mxgen \"$@\"\n", out);
}

/* ---- fish ---- */

static void put_fish_option(const struct help_chapter *chapter, const struct arg *arg, FILE *out)
{
    char *values = values_of(arg);
    fprintf(out, "complete -c mxgen -n '__mxgen_uses %s' -l %s", chapter->command.name, arg->name);
    if (arg->letter)
        fprintf(out, " -s %c", arg->letter);
    if (values)
        fprintf(out, " -x -a '%s'", values);
    else if (takes_value(arg))
        fputs(takes_file(arg) ? " -r" : " -x", out);
    fputs(" -d '", out);
    for (const char *c = arg->help; *c; ++c)
        fprintf(out, *c == '\'' || *c == '\\' ? "\\%c" : "%c", *c);
    fputs("'\n", out);
    free(values);
}

static void put_fish(const struct help_book *book, FILE *out)
{
    fputs("# fish completion for mxgen\nfunction __mxgen_uses\n"
          "    set -l words (commandline -opc)\n"
          "    set -l command generate\n"
          "    if contains -- \"$words[2]\"",
          out);
    for (size_t i = 0; i < book->len; ++i)
        fprintf(out, " %s", book->chapters[i].command.name);
    fputs("\n        set command $words[2]\n    end\n    test $command = $argv[1]\nend\n", out);
    for (size_t i = 0; i < book->len; ++i)
        fprintf(out, "complete -c mxgen -n __fish_use_subcommand -a %s -d '%s'\n",
                book->chapters[i].command.name, book->chapters[i].command.brief);
    for (size_t i = 0; i < book->len; ++i)
        for_each(&book->chapters[i], out, put_fish_option);
}

bool help_write_completion(const struct help_book *book, const char *shell, FILE *out)
{
    static const struct {
        const char *name;
        void (*put)(const struct help_book *book, FILE *out);
    } shells[] = {{"bash", put_bash}, {"zsh", put_zsh}, {"fish", put_fish}};
    for (size_t i = 0; i < sizeof shells / sizeof *shells; ++i)
        if (strcmp(shells[i].name, shell) == 0) {
            shells[i].put(book, out);
            return true;
        }
    return false;
}
