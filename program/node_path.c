// SPDX-License-Identifier: Apache-2.0
#include "program/node_path.h"

#include "program/cli.h"

#include <stdlib.h>
#include <string.h>

char *node_path_add(struct name_table *paths, const char *parent, const char *name)
{
    char *base = cli_format("%s/%s", parent, *name ? name : "_"), *path;
    for (char *c = base + strlen(parent) + 1; *c; ++c)
        if (!strchr("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_", *c))
            *c = '_';
    bool is_new;
    struct name_entry *taken = names_add(paths, base, &is_new);
    taken->value += is_new;
    path = cli_format("%s", base);
    for (uint64_t number = taken->value; !is_new;) {
        free(path);
        path = cli_format("%s_%llu", base, (unsigned long long)++number);
        names_find(paths, base)->value = number;
        names_add(paths, path, &is_new)->value += is_new;
    }
    free(base);
    return path;
}
