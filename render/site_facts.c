// SPDX-License-Identifier: Apache-2.0
#include "render/site_facts.h"

#include "program/cli.h"
#include "program/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The next fact of a kind; false: there is none. Begin with *index = 0. */
static bool next_fact(const struct site_facts *facts, uint32_t primitive, mxg_fact_kind kind,
                      uint32_t *index, mxg_fact *out)
{
    uint32_t num = mxg_bindings_num_facts(facts->bindings, primitive);
    while (*index < num) {
        *out = (mxg_fact){sizeof *out};
        mxg_bindings_fact(facts->bindings, primitive, (*index)++, out);
        if (out->kind == kind)
            return true;
    }
    return false;
}

static uint64_t hash_fact(uint64_t hash, const mxg_fact *fact)
{
    hash = names_hash(hash, fact->name);
    hash = names_hash(names_hash(hash, "\n"), fact->type);
    return names_hash(names_hash(names_hash(hash, "\n"), fact->value), "\n");
}

/* ---- Properties ---- */

/* The numbers of a value of a document; 0: its type has none. */
static unsigned components_of(const char *type)
{
    static const struct {
        const char *name;
        unsigned components;
    } types[] = {{"boolean", 1}, {"integer", 1}, {"float", 1},  {"vector2", 2},
                 {"color3", 3},  {"vector3", 3}, {"color4", 4}, {"vector4", 4}};
    for (size_t i = 0; i < sizeof types / sizeof *types; ++i)
        if (strcmp(types[i].name, type) == 0)
            return types[i].components;
    return 0;
}

/* Reads a value of a document; false: it has too few numbers. */
static bool read_value(const mxg_fact *fact, unsigned components, float out[4])
{
    const char *at = fact->value;
    if (strcmp(fact->type, "boolean") == 0) {
        out[0] = strcmp(at, "true") == 0;
        return true;
    }
    for (unsigned i = 0; i < components; ++i) {
        char *end;
        out[i] = (float)strtod(at, &end);
        if (end == at)
            return false;
        at = end + strspn(end, ", \t\r\n");
    }
    return true;
}

static bool is_of_object(const mxg_fact *fact, const struct scene_object *object)
{
    return components_of(fact->type) && !object_primvar(object, fact->name);
}

/* Adds the property to a list that has room for it. */
static void append(const mxg_fact *fact, struct site_primvars *list)
{
    unsigned components = components_of(fact->type);
    float(*value)[4] = memory_alloc(sizeof *value);
    if (!read_value(fact, components, *value)) {
        free(value);
        return;
    }
    list->num_own++;
    list->all.primvars[list->all.num_primvars++] =
        (struct primvar){.name = cli_format("%s", fact->name),
                         .components = components,
                         .is_integer = strcmp(fact->type, "integer") == 0,
                         .type = fact->type,
                         .type_len = (int)strlen(fact->type),
                         .file = fact->file,
                         .line = fact->line,
                         .num = 1,
                         .values = value};
}

/* A list of the object's primvars, and behind them its properties of the document. */
static struct site_primvars make_list(const struct site_facts *facts, uint32_t primitive,
                                      const struct scene_object *object, uint32_t num_added)
{
    struct site_primvars list = {.all.num_primvars = object->num_primvars};
    size_t num = object->num_primvars;
    list.all.primvars = memory_alloc((num + num_added) * sizeof *list.all.primvars);
    if (num)
        memcpy(list.all.primvars, object->primvars, num * sizeof *list.all.primvars);
    mxg_fact fact;
    for (uint32_t i = 0; next_fact(facts, primitive, MXG_FACT_GEOMPROP, &i, &fact);)
        if (is_of_object(&fact, object))
            append(&fact, &list);
    return list;
}

void site_add_geomprops(struct site_facts *facts, uint32_t primitive, struct scene_object *object)
{
    const uintptr_t own = object->num_primvars ? (uintptr_t)object->primvars : 0;
    uint64_t hash = NAMES_HASH_OF_NOTHING ^ (own * UINT64_C(31));
    uint32_t num_added = 0;
    mxg_fact fact;
    for (uint32_t i = 0; next_fact(facts, primitive, MXG_FACT_GEOMPROP, &i, &fact);)
        if (is_of_object(&fact, object)) {
            hash = hash_fact(hash, &fact);
            ++num_added;
        }
    if (!num_added)
        return;
    bool is_new;
    struct name_entry *entry = names_add_hash(&facts->known, hash, &is_new);
    if (is_new) {
        MEMORY_PUSH(facts->lists, facts->num_lists, make_list(facts, primitive, object, num_added));
        entry->value = facts->num_lists;
    }
    const struct scene_object *list = &facts->lists[entry->value - 1].all;
    object->num_primvars = list->num_primvars;
    object->primvars = list->primvars;
}

/* ---- Tokens ---- */

/* Marks the tokens in a name of files: "<id>" of "wood.<id>.png". */
static void mark_tokens(struct site_facts *facts, const char *file)
{
    for (const char *at = strchr(file, '<'); at; at = strchr(at + 1, '<')) {
        const char *end = strchr(at, '>');
        if (!end)
            return;
        bool is_new;
        char *name = cli_format("%.*s", (int)(end - at - 1), at + 1);
        names_add(&facts->read, name, &is_new);
        free(name);
    }
}

static void read_files(struct site_facts *facts, mxg_element element)
{
    mxg_element_info info = {sizeof info};
    mxg_document_element(facts->document, element, &info);
    for (mxg_element child = info.first_child; child;) {
        mxg_value value = {sizeof value};
        read_files(facts, child);
        mxg_document_element(facts->document, child, &info);
        if (strcmp(info.type, "filename") == 0
            && mxg_document_value(facts->document, child, &value) == MXG_OK)
            mark_tokens(facts, value.text);
        child = info.next;
    }
}

/* The next token of a primitive that a file reads. */
static bool next_token(struct site_facts *facts, uint32_t primitive, uint32_t *index, mxg_fact *out)
{
    while (next_fact(facts, primitive, MXG_FACT_TOKEN, index, out)) {
        if (!facts->knows_files)
            read_files(facts, mxg_document_find_element(facts->document, 0, ""));
        facts->knows_files = true;
        if (names_find(&facts->read, out->name))
            return true;
    }
    return false;
}

static struct bind_tokens make_tokens(struct site_facts *facts, uint32_t primitive)
{
    struct bind_tokens tokens = {.context = facts->context};
    mxg_fact fact;
    for (uint32_t i = 0; next_token(facts, primitive, &i, &fact);) {
        MEMORY_PUSH(tokens.items, tokens.num, (struct bind_token){fact.name, fact.value});
    }
    return tokens;
}

uint32_t site_tokens(struct site_facts *facts, uint32_t primitive)
{
    uint64_t hash = NAMES_HASH_OF_NOTHING;
    mxg_fact fact;
    for (uint32_t i = 0; next_token(facts, primitive, &i, &fact);)
        hash = hash_fact(hash, &fact);
    if (hash == NAMES_HASH_OF_NOTHING)
        return 0;
    bool is_new;
    struct name_entry *entry = names_add_hash(&facts->known, hash, &is_new);
    if (is_new) {
        MEMORY_PUSH(facts->tokens, facts->num_tokens, make_tokens(facts, primitive));
        entry->value = facts->num_tokens;
    }
    return (uint32_t)entry->value;
}

void site_facts_finish(struct site_facts *facts)
{
    for (size_t i = 0; i < facts->num_lists; ++i)
        object_finish_primvars(&facts->lists[i].all, facts->lists[i].num_own);
    for (size_t i = 0; i < facts->num_tokens; ++i)
        free(facts->tokens[i].items);
    free(facts->lists);
    free(facts->tokens);
    names_finish(&facts->known);
    names_finish(&facts->read);
}
