// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "lines.h"

#include <stdlib.h>
#include <string.h>

void *lines_grow(void *items, size_t len, size_t size)
{
    bool is_full = (len & (len - 1)) == 0; /* room is the next power of two */
    void *grown = is_full ? realloc(items, (len ? 2 * len : 1) * size) : items;
    if (!grown) {
        fputs("out of memory\n", stderr);
        exit(1);
    }
    return grown;
}

char *lines_path(const char *folder, const char *inner, const char *name, const char *end)
{
    size_t size = strlen(folder) + strlen(inner) + strlen(name) + strlen(end) + 3;
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s/%s/%s%s", folder, inner, name, end);
    return path;
}

FILE *lines_open(const char *path)
{
    FILE *file = fopen(path, "r");
    if (!file)
        printf("cannot open '%s'\n", path);
    return file;
}

bool lines_next(FILE *file, char **line, size_t *room)
{
    ssize_t len = getline(line, room, file);
    if (len > 0 && (*line)[len - 1] == '\n')
        (*line)[len - 1] = '\0';
    return len >= 0;
}

char *lines_field(char **rest, char separator)
{
    char *field = *rest, *end = strchr(field, separator);
    *rest = end ? end + 1 : field + strlen(field);
    if (end)
        *end = '\0';
    return field;
}
