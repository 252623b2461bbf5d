// SPDX-License-Identifier: Apache-2.0
/*
 * names: unique identifiers without a global counter: the second "roughness" of a function is
 * "roughness_2" whatever else there is, so that a small edit of the input gives a small difference
 * in the output. A word that the language has for itself gets an underscore.
 */
#include "base/hash.h"
#include "spell/spell.h"

void names_init(struct name_set *names, struct arena *arena, const struct lang_style *style)
{
    *names = (struct name_set){.arena = arena, .style = style};
}

void names_open_scope(struct name_set *names)
{
    names->scope++;
}

/* The entry of a name in the current scope; *out_new tells whether it was free. */
static struct name_entry *take(struct name_set *names, const char *text, uint32_t len,
                               bool *out_new)
{
    uint32_t hash = hash_bytes(text, len);
    for (uint32_t at = hash, found; (found = table_next(&names->table, hash, &at));) {
        struct name_entry *entry = &names->entries.items[found - 1];
        if (entry->len != len || memcmp(entry->text, text, len) != 0)
            continue;
        *out_new = entry->scope != 0 && entry->scope != names->scope;
        if (*out_new) {
            entry->scope = names->scope;
            entry->next = 2;
        }
        return entry;
    }
    *out_new = true;
    vec_push(names->arena, &names->entries, (struct name_entry){text, len, names->scope, 2});
    table_add(&names->table, names->arena, hash, names->entries.len);
    return &vec_last(&names->entries);
}

bool names_take(struct name_set *names, const char *text, size_t len)
{
    bool is_new;
    take(names, text, (uint32_t)len, &is_new);
    return is_new;
}

static size_t put_number(char *out, uint32_t number)
{
    size_t len = 1;
    for (uint32_t rest = number; rest >= 10; rest /= 10)
        len++;
    for (size_t i = len; i-- > 0; number /= 10)
        out[i] = (char)('0' + number % 10);
    return len;
}

/* A name that is taken, with the first number behind it that makes another one. */
static struct spell_name add_number(struct name_set *names, uint32_t first)
{
    const struct name_entry *base = &names->entries.items[first];
    size_t len = base->len;
    char *numbered = arena_alloc(names->arena, len + sizeof "_4294967295");
    memcpy(numbered, base->text, len);
    if (numbered[len - 1] != '_')
        numbered[len++] = '_';
    bool is_new;
    size_t end;
    do {
        end = len + put_number(numbered + len, names->entries.items[first].next++);
        numbered[end] = '\0';
        take(names, numbered, (uint32_t)end, &is_new);
    } while (!is_new);
    return (struct spell_name){numbered, end};
}

/* "normal_" of "normal", which is a word of the language; numbered where that is taken, too. */
static struct spell_name add_underscore(struct name_set *names, uint32_t reserved)
{
    const struct name_entry *base = &names->entries.items[reserved];
    size_t len = base->len;
    if (base->text[len - 1] == '_')
        return add_number(names, reserved);
    char *longer = arena_alloc(names->arena, len + sizeof "_");
    memcpy(longer, base->text, len);
    longer[len++] = '_';
    longer[len] = '\0';
    return names_take(names, longer, len) ? (struct spell_name){longer, len}
                                          : add_number(names, reserved);
}

struct spell_name names_unique(struct name_set *names, const char *text, size_t len)
{
    size_t base_len;
    const char *base = identifier_from(text, len, names->arena, &base_len);
    bool is_new;
    uint32_t entry =
        (uint32_t)(take(names, base, (uint32_t)base_len, &is_new) - names->entries.items);
    if (lang_syntax_is_reserved(names->style->syntax, base, base_len))
        return add_underscore(names, entry);
    return is_new ? (struct spell_name){base, base_len} : add_number(names, entry);
}
