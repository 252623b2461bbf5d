// SPDX-License-Identifier: Apache-2.0
#include "shader/names.h"

#include "base/hash.h"
#include "shader/shader.h"

#include <assert.h>

void names_init(struct name_set *names, struct arena *arena, const struct lang_syntax *syntax)
{
    *names = (struct name_set){.arena = arena, .syntax = syntax};
    table_reserve(&names->table, arena, 128); /* as many as a shading model has */
}

const char *names_renamed(const struct name_rules *rules, const char *text, size_t len)
{
    for (uint32_t i = 0; i < rules->num_renamed; i++)
        if (rules->renamed[i].from_len == len && memcmp(rules->renamed[i].from, text, len) == 0)
            return rules->renamed[i].to;
    return NULL;
}

static const char *with_prefix(const char *prefix, const char *text, size_t len,
                               struct arena *arena)
{
    size_t prefix_len = strlen(prefix);
    bool joins = prefix[prefix_len - 1] == '_' && *text == '_'; /* no "__" */
    text += joins;
    len -= joins;
    char *longer = arena_alloc(arena, prefix_len + len + 1);
    memcpy(longer, prefix, prefix_len);
    memcpy(longer + prefix_len, text, len);
    longer[prefix_len + len] = '\0';
    return longer;
}

static const char *of_frame(const struct name_rules *rules, const char *name, struct arena *arena)
{
    const char *renamed = names_renamed(rules, name, strlen(name));
    if (renamed || !*rules->prefix)
        return renamed ? renamed : name;
    return with_prefix(rules->prefix, name, strlen(name), arena);
}

const char *names_of_frame(const struct shader *shader, const char *name)
{
    return of_frame(&shader->interface.naming, name, shader->arena);
}

static const char *const frame_names[] = {"scatter",         "vd",
                                          "u_lightData",     "LightData",
                                          "LightData_block", "PublicUniforms",
                                          "PrivateUniforms", "VertexData",
                                          SHADER_FUNCTION,   SHADER_FUNCTION_RESULT};

/* The last two are of functions. */
static size_t num_frame_names(const struct role *role)
{
    return sizeof frame_names / sizeof *frame_names - (role->is_in_host_file ? 0 : 2);
}

bool names_frame_has(const struct name_rules *rules, const struct role *role, const char *name,
                     const char *but, struct arena *arena)
{
    for (size_t i = 0; i < num_frame_names(role); i++)
        if (strcmp(frame_names[i], but) != 0
            && strcmp(of_frame(rules, frame_names[i], arena), name) == 0)
            return true;
    return false;
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

/* name_entry.next of a name that waits for its use. */
enum { KEPT = 1 };

/* The index of a name in the current scope. *out_new: the name was free. */
static uint32_t take(struct name_set *names, const char *text, size_t len, bool *out_new)
{
    uint32_t hash = hash_bytes(text, len), found = find(names, text, len, hash);
    struct name_entry fresh = {text, (uint32_t)len, names->scope, 2};
    *out_new = !found || is_over(names, &names->entries.items[found - 1]);
    uint32_t index = found ? found - 1 : names->entries.len;
    bool is_kept = found && names->entries.items[index].next == KEPT && names->scope == 0;
    if (!found) {
        vec_push(names->arena, &names->entries, fresh);
        table_add(&names->table, names->arena, hash, names->entries.len);
        assert(names->table.num == names->entries.len);
    } else if (*out_new || is_kept) {
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

/* Takes a name for the first variable, function or type that the host renames to it. */
static void keep(struct name_set *names, const char *name)
{
    bool is_new;
    uint32_t entry = take(names, name, strlen(name), &is_new);
    names->entries.items[entry].next = KEPT;
}

void names_take_frame(struct name_set *names, const struct shader *shader)
{
    static const char *const fixed[] = {"main", "result", "mxg_light", "mxg_light_count"};
    size_t of_host = shader->role->is_in_host_file ? 0 : 3;
    for (uint32_t i = 0; i < shader->interface.naming.num_renamed; i++)
        keep(names, shader->interface.naming.renamed[i].to);
    for (size_t i = 0; i < num_frame_names(shader->role); i++) {
        const char *name = names_of_frame(shader, frame_names[i]);
        names_take(names, name, strlen(name));
    }
    for (size_t i = 0; i < sizeof fixed / sizeof *fixed - of_host; i++)
        names_take(names, fixed[i], strlen(fixed[i]));
    for (int i = 0; i < MAX_OWN_BLOCKS && shader->interface.own_blocks[i]; i++) {
        const char *name =
            names_of_frame(shader, shader_block_name(shader, (enum shader_block)(BLOCK_OWN + i)));
        names_take(names, name, strlen(name));
    }
    for (uint32_t i = 0; i < shader->interface.num_reserved; i++)
        names_take(names, shader->interface.reserved[i], strlen(shader->interface.reserved[i]));
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

/* The name with the beginning that it needs. */
static const char *well_begun(const struct name_set *names, const char *text, size_t *len)
{
    const char *beginning = names->syntax ? lang_syntax_beginning(names->syntax, text) : "";
    if (!*beginning)
        return text;
    text = with_prefix(beginning, text, *len, names->arena);
    *len = strlen(text);
    return text;
}

/* True if the name waits for its use, and this is it. */
static bool give(struct name_set *names, const char *name, size_t len)
{
    uint32_t found = find(names, name, len, hash_bytes(name, len));
    bool is_kept = found && names->entries.items[found - 1].next == KEPT;
    if (is_kept)
        names_take(names, name, len);
    return is_kept;
}

struct spell_name names_unique(struct name_set *names, const char *text, size_t text_len)
{
    size_t base_len, len;
    const char *base = identifier_from(text, text_len, names->arena, &base_len);
    const struct name_rules *rules = names->scope == 0 ? names->rules : NULL;
    const char *renamed = rules ? names_renamed(rules, base, base_len) : NULL;
    if (renamed) {
        base = renamed;
        base_len = strlen(renamed);
        if (give(names, base, base_len))
            return (struct spell_name){base, base_len};
    } else if (rules && *rules->prefix) {
        base = with_prefix(rules->prefix, base, base_len, names->arena);
        base_len = strlen(base);
    }
    base = well_begun(names, base, &base_len);
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
    text = well_begun(names, text, &len);
    if (is_reserved(names, text, len))
        text = with_underscore(names, text, &len);
    uint32_t found = find(names, text, len, hash_bytes(text, len));
    return !found || is_over(names, &names->entries.items[found - 1]);
}
