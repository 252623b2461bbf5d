// SPDX-License-Identifier: Apache-2.0
#include "program/groups.h"

#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

static uint64_t hash_text(uint64_t hash, const char *text)
{
    for (; text && *text; ++text)
        hash = (hash ^ (unsigned char)*text) * 0x100000001b3u;
    return (hash ^ 0xff) * 0x100000001b3u;
}

uint64_t group_key_hash(const struct group_key *key)
{
    uint64_t hash = hash_text(0xcbf29ce484222325u, key->id);
    hash = hash_text(hash_text(hash_text(hash, key->file), key->text), key->state);
    return hash ? hash : 1;
}

/* A group in the hash table. */
struct entry {
    uint64_t hash; /* 0: free */
    uint32_t first, last;
};

static struct entry *find(struct entry *entries, size_t capacity, uint64_t hash)
{
    size_t at = hash & (capacity - 1);
    while (entries[at].hash && entries[at].hash != hash)
        at = (at + 1) & (capacity - 1);
    return &entries[at];
}

struct groups groups_make(const void *messages, uint32_t count,
                          bool (*key_of)(const void *messages, uint32_t index,
                                         struct group_key *out_key))
{
    size_t capacity = 64;
    while (capacity < (size_t)count * 2)
        capacity *= 2;
    struct groups groups = {memory_alloc(count * sizeof *groups.first),
                            memory_alloc(count * sizeof *groups.next),
                            memory_alloc(count * sizeof *groups.is_told)};
    struct entry *entries = memory_alloc(capacity * sizeof *entries);
    for (uint32_t i = 0; i < count; ++i) {
        struct group_key key = {NULL, NULL, NULL};
        groups.first[i] = i;
        if (!key_of(messages, i, &key))
            continue;
        uint64_t hash = group_key_hash(&key);
        struct entry *entry = find(entries, capacity, hash);
        if (entry->hash)
            groups.next[entry->last] = i;
        else
            *entry = (struct entry){hash, i, i};
        entry->last = i;
        groups.first[i] = entry->first;
    }
    free(entries);
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
