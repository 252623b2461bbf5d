// SPDX-License-Identifier: Apache-2.0
#include "check/below_root.h"

#include "program/cli.h"
#include "program/name_table.h"

#include <string.h>

/* The lengths of the parts of two texts before their common end, which begins a path member. */
static void split(const char *a, const char *b, size_t *out_a, size_t *out_b)
{
    size_t len_a = strlen(a), len_b = strlen(b);
    while (len_a && len_b && a[len_a - 1] == b[len_b - 1]) {
        --len_a;
        --len_b;
    }
    while (a[len_a] && (len_a ? a[len_a - 1] != '/' : len_b && b[len_b - 1] != '/')) {
        ++len_a;
        ++len_b;
    }
    *out_a = len_a;
    *out_b = len_b;
}

static char *join(struct store *store, const char *begin, size_t len, const char *end)
{
    size_t end_len = strlen(end);
    char *whole = store_alloc(store, len + end_len + 1);
    memcpy(whole, begin, len);
    memcpy(whole + len, end, end_len);
    return whole;
}

const char *place_name(struct store *store, const struct check_document *document, const char *path)
{
    size_t given, named;
    if (!document->name || !*document->name || !*path)
        return path;
    split(document->file, document->name, &given, &named);
    if (strncmp(path, document->file, given) != 0 || (given == 0 && *path == '/'))
        return path;
    return join(store, document->name, named, path + given);
}

const char *place_text(struct store *store, const struct check_document *document, const char *text)
{
    const char *file = document->file, *name = document->name, *at;
    if (!name || !*name || strcmp(file, name) == 0)
        return text;
    const char *whole = text;
    for (size_t done = 0; (at = strstr(whole + done, file)) != NULL;) {
        size_t before = (size_t)(at - whole);
        whole =
            join(store, join(store, whole, before, name), before + strlen(name), at + strlen(file));
        done = before + strlen(name);
    }
    return whole;
}

uint64_t place_hash(const struct check_document *document, const struct check_message *message)
{
    struct store store = {0};
    uint64_t hash = names_hash(NAMES_HASH_OF_NOTHING ^ (uint64_t)message->severity, message->id);
    hash = names_hash(hash, place_name(&store, document, message->file));
    hash = names_hash(hash, place_text(&store, document, message->text));
    store_finish(&store);
    return hash;
}
