// SPDX-License-Identifier: Apache-2.0
#define _XOPEN_SOURCE 700 /* realpath */
#include "program/output_files.h"

#include "program/cli.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

struct output_use {
    char *owner; /* NULL: the file is read */
};

/* Appends the components of a path that does not exist; "." and "" are none. */
static char *append(char *folder, const char *rest)
{
    while (*rest) {
        size_t len = strcspn(rest, "/");
        if (len && !(len == 1 && *rest == '.')) {
            const char *slash = strcmp(folder, "/") == 0 ? "" : "/";
            char *longer = cli_format("%s%s%.*s", folder, slash, (int)len, rest);
            free(folder);
            folder = longer;
        }
        rest += len + (rest[len] == '/');
    }
    return folder;
}

char *outputs_resolve(const char *path)
{
    char *real = realpath(path, NULL), *folder = cli_format("%s", path);
    size_t len = strlen(path);
    while (!real && len) {
        while (len && folder[len - 1] != '/')
            --len;
        folder[len] = '\0';
        real = realpath(len ? folder : ".", NULL);
        if (real)
            real = append(real, path + len);
        else if (len)
            --len; /* the slash */
    }
    free(folder);
    return real ? real : cli_format("%s", path);
}

static struct name_entry *add(struct outputs *outputs, const char *path, const char *owner,
                              bool *out_is_new)
{
    char *key = strcmp(path, "-") == 0 ? cli_format("-") : outputs_resolve(path);
    struct name_entry *entry = names_add(&outputs->paths, key, out_is_new);
    free(key);
    if (!*out_is_new)
        return entry;
    entry->value = outputs->num_uses;
    MEMORY_PUSH(outputs->uses, outputs->num_uses,
                (struct output_use){owner ? cli_format("%s", owner) : NULL});
    return entry;
}

bool outputs_read(struct outputs *outputs, struct report *report, const char *path)
{
    bool is_new;
    const struct name_entry *entry = add(outputs, path, NULL, &is_new);
    const char *owner = outputs->uses[entry->value].owner;
    if (owner)
        report_error(report, "output-clash",
                     "%s would overwrite the input '%s'; choose another name", owner, path);
    return !owner;
}

bool outputs_write(struct outputs *outputs, struct report *report, const char *path,
                   const char *owner)
{
    bool is_new;
    if (strcmp(path, "/dev/null") == 0)
        return true;
    const struct name_entry *entry = add(outputs, path, owner, &is_new);
    const char *other = outputs->uses[entry->value].owner;
    if (!other)
        report_error(report, "output-clash",
                     "%s would overwrite the input '%s'; choose another name", owner, path);
    else if (strcmp(other, owner) != 0)
        report_error(report, "output-clash", "%s and %s would write one file, '%s'", other, owner,
                     path);
    return other && strcmp(other, owner) == 0;
}

bool outputs_has(const struct outputs *outputs, const char *path)
{
    if (!outputs->num_uses)
        return false;
    char *key = outputs_resolve(path);
    const struct name_entry *entry = names_find(&outputs->paths, key);
    free(key);
    return entry && outputs->uses[entry->value].owner;
}

void outputs_finish(struct outputs *outputs)
{
    for (size_t i = 0; i < outputs->num_uses; ++i)
        free(outputs->uses[i].owner);
    free(outputs->uses);
    names_finish(&outputs->paths);
    *outputs = (struct outputs){0};
}

bool outputs_claim(const struct arg_list *inputs, struct report *report, const char *output)
{
    struct outputs outputs = {0};
    for (size_t i = 0; i < inputs->len; ++i)
        outputs_read(&outputs, report, inputs->items[i]);
    bool good = !output || outputs_write(&outputs, report, output, "--output");
    outputs_finish(&outputs);
    return good;
}
