// SPDX-License-Identifier: Apache-2.0
#include "program/warning_groups.h"

#include "program/memory.h"
#include "program/name_table.h"

#include <stdlib.h>
#include <string.h>

static uint64_t add_text(uint64_t hash, const char *text)
{
    return (names_hash(hash, text ? text : "") ^ 0xff) * 0x100000001b3u;
}

static uint64_t hash_of(const struct group_key *key)
{
    uint64_t hash = add_text(add_text(NAMES_HASH_OF_NOTHING, key->id), key->file);
    return add_text(add_text(hash, key->text), key->state);
}

uint64_t group_key_hash_at(const struct group_key *key, uint32_t line, uint32_t column)
{
    uint64_t hash = hash_of(key) ^ ((uint64_t)line << 32 | column);
    hash *= 0x9e3779b97f4a7c15u;
    return hash ^ hash >> 32;
}

struct groups groups_make(const void *messages, uint32_t count,
                          bool (*key_of)(const void *messages, uint32_t index,
                                         struct group_key *out_key))
{
    struct groups groups = {memory_alloc(count * sizeof *groups.first),
                            memory_alloc(count * sizeof *groups.next),
                            memory_alloc(count * sizeof *groups.is_told)};
    uint32_t *last = memory_alloc(count * sizeof *last); /* per first message */
    struct name_table table = {0};                       /* indices of first messages */
    for (uint32_t i = 0; i < count; ++i) {
        struct group_key key = {NULL, NULL, NULL};
        groups.first[i] = i;
        if (!key_of(messages, i, &key))
            continue;
        bool is_new;
        struct name_entry *entry = names_add_hash(&table, hash_of(&key), &is_new);
        if (is_new)
            entry->value = i;
        else
            groups.next[last[entry->value]] = i;
        last[entry->value] = i;
        groups.first[i] = (uint32_t)entry->value;
    }
    free(last);
    names_finish(&table);
    return groups;
}

void groups_finish(struct groups *groups)
{
    free(groups->first);
    free(groups->next);
    free(groups->is_told);
    *groups = (struct groups){NULL, NULL, NULL};
}

void group_rest_add(struct group_rest *rest, uint32_t line)
{
    ++rest->count;
    bool is_new = line && line != rest->previous && rest->num_lines < MAX_REST_LINES;
    rest->previous = line;
    if (!is_new)
        return;
    size_t len = strlen(rest->lines);
    snprintf(rest->lines + len, sizeof rest->lines - len, "%s%u", rest->num_lines ? ", " : "",
             (unsigned)line);
    ++rest->num_lines;
}

void group_rest_print(const struct group_rest *rest, FILE *out)
{
    if (!rest->count)
        return;
    fprintf(out, "note: and %u more%s%s%s\n", (unsigned)rest->count,
            rest->num_lines > 1 ? ", in the lines "
            : rest->num_lines   ? ", in line "
                                : "",
            rest->lines,
            rest->num_lines == MAX_REST_LINES && rest->count > rest->num_lines ? ", …" : "");
}
