// SPDX-License-Identifier: Apache-2.0
#include "shader/names.h"

#include "base/hash.h"
#include "shader/shader.h"

#include <assert.h>

void names_init(struct name_set *names, struct arena *arena, const struct lang_syntax *syntax)
{
    *names = (struct name_set){.arena = arena, .syntax = syntax};
}

void names_take_frame(struct name_set *names, const struct shader *shader)
{
    static const char *const frame[] = {"main",           "scatter",         "vd",
                                        "u_lightData",    "LightData",       "LightData_block",
                                        "PublicUniforms", "PrivateUniforms", "VertexData"};
    for (size_t i = 0; i < sizeof frame / sizeof *frame; i++)
        names_take(names, frame[i], strlen(frame[i]));
    for (uint32_t i = 0; i < shader->num_reserved; i++)
        names_take(names, shader->reserved[i], strlen(shader->reserved[i]));
}

void names_open_scope(struct name_set *names)
{
    names->scope++;
    names->taken.len = 0;
}

uint32_t names_open_block(const struct name_set *names)
{
    return names->taken.len;
}

void names_close_block(struct name_set *names, uint32_t block)
{
    assert(block <= names->taken.len);
    while (names->taken.len > block)
        names->entries.items[vec_pop(&names->taken)].scope = UINT32_MAX;
}

/* 1 + index of the entry of a name, in any scope; 0: there is none. */
static uint32_t find(const struct name_set *names, const char *text, size_t len, uint32_t hash)
{
    for (uint32_t at = hash, found; (found = table_next(&names->table, hash, &at));) {
        assert(found <= names->entries.len);
        const struct name_entry *entry = &names->entries.items[found - 1];
        if (entry->len == len && memcmp(entry->text, text, len) == 0)
            return found;
    }
    return 0;
}

static bool is_over(const struct name_set *names, const struct name_entry *entry)
{
    return entry->scope != 0 && entry->scope != names->scope;
}

/* The index of a name in the current scope. *out_new: the name was free. */
static uint32_t take(struct name_set *names, const char *text, size_t len, bool *out_new)
{
    uint32_t hash = hash_bytes(text, len), found = find(names, text, len, hash);
    struct name_entry fresh = {text, (uint32_t)len, names->scope, 2};
    *out_new = !found || is_over(names, &names->entries.items[found - 1]);
    uint32_t index = found ? found - 1 : names->entries.len;
    if (!found) {
        vec_push(names->arena, &names->entries, fresh);
        table_add(&names->table, names->arena, hash, names->entries.len);
        assert(names->table.num == names->entries.len);
    } else if (*out_new) {
        names->entries.items[index] = fresh;
    }
    if (*out_new)
        vec_push(names->arena, &names->taken, index);
    return index;
}

bool names_take(struct name_set *names, const char *text, size_t len)
{
    bool is_new;
    take(names, text, len, &is_new);
    return is_new;
}

static bool is_reserved(const struct name_set *names, const char *text, size_t len)
{
    return names->syntax && lang_syntax_is_reserved(names->syntax, text, len);
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

enum { LONGEST_SUFFIX = sizeof "_4294967295" };

/* The name with an underscore as suffix, and room for a number. */
static char *with_underscore(const struct name_set *names, const char *text, size_t *len)
{
    assert(*len > 0);
    char *longer = arena_alloc(names->arena, *len + LONGEST_SUFFIX);
    memcpy(longer, text, *len);
    if (longer[*len - 1] != '_')
        longer[(*len)++] = '_';
    longer[*len] = '\0';
    return longer;
}

struct spell_name names_unique(struct name_set *names, const char *text, size_t text_len)
{
    size_t base_len, len;
    const char *base = identifier_from(text, text_len, names->arena, &base_len);
    bool is_new, is_word = is_reserved(names, base, base_len);
    uint32_t entry = take(names, base, base_len, &is_new);
    if (is_new && !is_word)
        return (struct spell_name){base, base_len};
    len = base_len;
    char *longer = with_underscore(names, base, &len);
    if (is_word && len > base_len && names_take(names, longer, len))
        return (struct spell_name){longer, len};
    for (size_t end;;) {
        end = len + put_number(longer + len, names->entries.items[entry].next++);
        longer[end] = '\0';
        if (!is_reserved(names, longer, end) && names_take(names, longer, end))
            return (struct spell_name){longer, end};
    }
}

bool names_is_free(const struct name_set *names, const char *text, size_t len)
{
    if (is_reserved(names, text, len))
        text = with_underscore(names, text, &len);
    uint32_t found = find(names, text, len, hash_bytes(text, len));
    return !found || is_over(names, &names->entries.items[found - 1]);
}
