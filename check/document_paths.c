// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "check/document_paths.h"

#include "program/cli.h"
#include "program/files.h"
#include "program/memory.h"

#include <dirent.h>
#include <errno.h>
#include <glob.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* A source of paths: names in memory, or the lines of a file. */
struct input_source {
    struct input_source *outer;
    const char *const *items;
    size_t num_items, at;
    const char *mark; /* prefix of each item: '@' for a list of lists */
    char **owned;     /* the items, if the source must free them */
    FILE *lines;
    char *line;
    size_t capacity;
};

static struct input_source *push(struct check_inputs *inputs)
{
    struct input_source *source = memory_alloc(sizeof *source);
    source->outer = inputs->sources;
    source->mark = "";
    return inputs->sources = source;
}

static void pop(struct check_inputs *inputs)
{
    struct input_source *source = inputs->sources;
    inputs->sources = source->outer;
    for (size_t i = 0; source->owned && i < source->num_items; ++i)
        free(source->owned[i]);
    free(source->owned);
    free(source->line);
    if (source->lines && source->lines != stdin)
        fclose(source->lines);
    free(source);
}

void inputs_init(struct check_inputs *inputs, const struct arg_list *paths,
                 const struct arg_list *files_from)
{
    *inputs = (struct check_inputs){0};
    const struct arg_list *lists[] = {files_from, paths};
    for (int i = 0; i < 2; ++i) {
        struct input_source *source = push(inputs);
        source->items = lists[i]->items;
        source->num_items = lists[i]->len;
        source->mark = i == 0 ? "@" : "";
    }
}

void inputs_finish(struct check_inputs *inputs)
{
    while (inputs->sources)
        pop(inputs);
    names_finish(&inputs->seen);
    free(inputs->path);
}

/* ---- Each once ---- */

static bool is_new(struct check_inputs *inputs, const char *path)
{
    bool is_new;
    names_add(&inputs->seen, path, &is_new);
    return is_new;
}

/* ---- Expansion of paths ---- */

/* True for folders, pipes and devices; a link that leads nowhere is a missing document. */
static bool is_special(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && !S_ISREG(info.st_mode);
}

static bool is_folder(const char *path)
{
    struct stat info;
    return lstat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

static int compare_texts(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Reports an unreadable path. */
static void fail(struct check_inputs *inputs, const char *what, const char *name)
{
    fprintf(stderr, "error: cannot read %s '%s': %s [file-unreadable]\n", what, name,
            strerror(errno));
    inputs->failed = true;
}

/*
 * Adds the documents and folders in a folder. It does not follow links to folders, because they may
 * form a cycle.
 */
static void push_folder(struct check_inputs *inputs, const char *path)
{
    struct input_source *source = push(inputs);
    DIR *folder = opendir(path);
    struct arg_list names = {0};
    size_t len = strlen(path);
    if (!folder)
        fail(inputs, "the folder", path);
    for (struct dirent *entry; folder && (entry = readdir(folder)) != NULL;) {
        if (entry->d_name[0] == '.')
            continue;
        char *name =
            cli_format("%s%s%s", path, len && path[len - 1] == '/' ? "" : "/", entry->d_name);
        bool is_document = files_ends_with(name, ".mtlx") && !is_special(name);
        if (is_document || is_folder(name))
            args_append(&names, name);
        else
            free(name);
    }
    if (folder)
        closedir(folder);
    if (names.len)
        qsort(names.items, names.len, sizeof *names.items, compare_texts);
    source->items = names.items;
    source->owned = (char **)names.items;
    source->num_items = names.len;
}

static void push_list(struct check_inputs *inputs, const char *name)
{
    FILE *lines = strcmp(name, "-") == 0 ? stdin : fopen(name, "r");
    if (lines)
        push(inputs)->lines = lines;
    else
        fail(inputs, "the list", name);
}

/* False if the name is no pattern. */
static bool push_pattern(struct check_inputs *inputs, const char *pattern)
{
    glob_t found;
    if (!strpbrk(pattern, "*?["))
        return false;
    if (glob(pattern, 0, NULL, &found) != 0) {
        fprintf(stderr, "error: no file matches '%s' [file-missing]\n", pattern);
        inputs->failed = true;
        return true;
    }
    struct input_source *source = push(inputs);
    source->owned = memory_alloc((found.gl_pathc + 1) * sizeof *source->owned);
    for (; source->num_items < found.gl_pathc; ++source->num_items)
        source->owned[source->num_items] = cli_format("%s", found.gl_pathv[source->num_items]);
    source->items = (const char *const *)source->owned;
    globfree(&found);
    return true;
}

/* True if the path is a document; otherwise adds sources for it. */
static bool expand(struct check_inputs *inputs, const char *path)
{
    struct stat info;
    if (path[0] == '@') {
        push_list(inputs, path + 1);
        return false;
    }
    if (stat(path, &info) != 0)
        return !push_pattern(inputs, path);
    if (!S_ISDIR(info.st_mode))
        return true;
    push_folder(inputs, path);
    return false;
}

/* ---- Iteration ---- */

/* The next item of the innermost source; NULL at the end. */
static char *next_item(struct input_source *source)
{
    if (!source->lines && source->at == source->num_items)
        return NULL;
    const char *item = source->lines ? NULL : source->items[source->at++];
    if (item)
        return *source->mark ? cli_format("%s%s", source->mark, item)
                             : cli_copy(item, strlen(item));
    ssize_t len = getline(&source->line, &source->capacity, source->lines);
    while (len > 0 && (source->line[len - 1] == '\n' || source->line[len - 1] == '\r'))
        source->line[--len] = '\0';
    return len < 0 ? NULL : cli_copy(source->line, (size_t)len);
}

const char *inputs_next(struct check_inputs *inputs)
{
    while (inputs->sources) {
        char *item = next_item(inputs->sources);
        if (!item) {
            pop(inputs);
            continue;
        }
        const char *tidy = strncmp(item, "./", 2) == 0 && item[2] ? item + 2 : item;
        if (*tidy && expand(inputs, tidy) && is_new(inputs, tidy)) {
            char *path = cli_copy(tidy, strlen(tidy));
            free(item);
            free(inputs->path);
            return inputs->path = path;
        }
        free(item);
    }
    return NULL;
}
