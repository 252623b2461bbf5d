// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "deviations.h"

#include "lines.h"

#include <stdlib.h>
#include <string.h>

bool deviations_read(struct deviations *list, const char *path, size_t num_numbers)
{
    char *line = NULL;
    size_t room = 0;
    FILE *file = lines_open(path);
    while (file && lines_next(file, &line, &room)) {
        char *rest = line;
        if (!*line || *line == '#')
            continue;
        list->items = lines_grow(list->items, list->len, sizeof *list->items);
        struct deviation *d = &list->items[list->len++];
        *d = (struct deviation){0};
        d->whole = strdup(lines_field(&rest, '\t'));
        d->part = strdup(lines_field(&rest, '\t'));
        for (size_t i = 0; i < num_numbers; ++i)
            d->numbers[i] = strtod(lines_field(&rest, '\t'), NULL);
        d->is_open = strncmp(rest, "open: ", 6) == 0;
    }
    if (file)
        fclose(file);
    free(line);
    return file != NULL;
}

void deviations_finish(struct deviations *list)
{
    for (size_t i = 0; i < list->len; ++i) {
        free(list->items[i].whole);
        free(list->items[i].part);
    }
    free(list->items);
}

struct deviation *deviations_find(struct deviations *list, const char *whole, const char *part)
{
    for (size_t i = 0; i < list->len; ++i) {
        struct deviation *d = &list->items[i];
        if (strcmp(d->whole, whole) != 0 || strcmp(d->part, part) != 0)
            continue;
        d->is_found = true;
        return d;
    }
    return NULL;
}

size_t deviations_list_lost(const struct deviations *list)
{
    size_t count = 0;
    for (size_t i = 0; i < list->len; ++i) {
        if (list->items[i].is_found)
            continue;
        printf("deviations: there is no '%s' of '%s'\n", list->items[i].part, list->items[i].whole);
        ++count;
    }
    return count;
}
