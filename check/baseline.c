// SPDX-License-Identifier: Apache-2.0
#include "check/baseline.h"

#include "check/compare.h"
#include "program/json_values.h"
#include "check/record_json.h"
#include "program/cli.h"
#include "program/files.h"

#include <stdlib.h>
#include <string.h>

static bool is_readable(json_t *document)
{
    struct store store = {0};
    bool good = record_from_json(&store, document) != NULL;
    store_finish(&store);
    return good;
}

static bool add_entry(struct baseline *baseline, uint64_t offset)
{
    bool is_new;
    const char *name = json_text_of(baseline->reader.document, "name");
    if (!is_readable(baseline->reader.document))
        baseline->reader.fault = REPORT_DOCUMENT_DAMAGED;
    else if (!*name)
        baseline->reader.fault = "a document in it is outside the root of its run";
    else
        names_add(&baseline->offsets, name, &is_new)->value = offset;
    return !baseline->reader.fault;
}

bool baseline_open(struct baseline *baseline, const char *path)
{
    *baseline = (struct baseline){.is_open = true};
    if (!reader_open(&baseline->reader, path))
        return false;
    if (json_object_get(baseline->reader.header, "shard"))
        baseline->reader.fault = "it is only a shard; 'mxgen check merge' joins shards";
    uint64_t offset;
    while (reader_next(&baseline->reader, &offset) && add_entry(baseline, offset)) {
    }
    return !baseline->reader.fault;
}

void baseline_close(struct baseline *baseline)
{
    if (baseline->is_open)
        reader_close(&baseline->reader);
    names_finish(&baseline->offsets);
}

/* ---- The same subject ---- */

static bool has_target(const json_t *targets, const char *name)
{
    for (size_t i = 0; i < json_array_size(targets); ++i) {
        const char *target = json_string_value(json_array_get(targets, i));
        if (target && strcmp(target, name) == 0)
            return true;
    }
    return false;
}

static char *list_targets(const json_t *targets)
{
    char *list = cli_format("%s", "");
    for (size_t i = 0; i < json_array_size(targets); ++i) {
        const char *name = json_string_value(json_array_get(targets, i));
        char *longer = cli_format("%s%s%s", list, i ? "," : "", name ? name : "");
        free(list);
        list = longer;
    }
    return list;
}

char *baseline_find_mismatch(const struct baseline *baseline, const char *const *targets,
                             size_t num_targets, bool compiles)
{
    const json_t *header = baseline->reader.header, *old = json_object_get(header, "targets");
    bool is_same = json_array_size(old) == num_targets, had_compilers;
    for (size_t i = 0; i < num_targets; ++i)
        is_same = is_same && has_target(old, targets[i]);
    if (!is_same) {
        char *list = list_targets(old);
        char *text = cli_format("it has the targets %s: use --target %s", list, list);
        free(list);
        return text;
    }
    had_compilers = json_is_true(json_object_get(header, "compiles"));
    if (had_compilers != compiles)
        return cli_format(had_compilers ? "its shaders were compiled: leave out --no-compile"
                                        : "its shaders were not compiled: use --no-compile");
    return NULL;
}

static int compare_offsets(const void *a, const void *b)
{
    const struct name_entry *left = a, *right = b;
    return left->value < right->value ? -1 : left->value > right->value;
}

char *baseline_find_other_root(struct baseline *baseline, const char *root)
{
    const struct name_table *table = &baseline->offsets;
    char *first = NULL;
    bool found = table->num_entries == 0;
    for (size_t i = 0; i < table->capacity && !found; ++i) {
        if (!table->entries[i].hash || !reader_read_at(&baseline->reader, table->entries[i].value))
            continue;
        const char *name = json_text_of(baseline->reader.document, "name");
        char *path = cli_format("%s/%s", root, name);
        found = files_is_regular(path);
        free(path);
        if (!first)
            first = cli_format("%s", name);
    }
    char *text = found ? NULL
                       : cli_format("none of its documents, such as '%s', is below the root '%s': "
                                    "name its root with --root DIR",
                                    first ? first : "", root);
    free(first);
    return text;
}

/* ---- Documents ---- */

void baseline_compare(struct baseline *baseline, struct store *store,
                      struct check_document *document)
{
    struct store scratch = {0};
    const struct check_document *before = NULL;
    struct name_entry *entry = names_find(&baseline->offsets, document->name);
    if (entry && reader_read_at(&baseline->reader, entry->value)) {
        baseline->num_compared += !entry->is_marked;
        entry->is_marked = true;
        before = record_from_json(&scratch, baseline->reader.document);
    }
    compare_documents(store, document, before);
    store_finish(&scratch);
}

struct check_document *baseline_next_gone(struct baseline *baseline, struct store *store)
{
    struct name_table *table = &baseline->offsets;
    if (!baseline->is_sorted && table->capacity)
        qsort(table->entries, table->capacity, sizeof *table->entries, compare_offsets);
    baseline->is_sorted = true; /* look-ups by name do not work any more */
    while (baseline->next_gone < table->capacity) {
        const struct name_entry *entry = &table->entries[baseline->next_gone++];
        if (!entry->hash || entry->is_marked || !reader_read_at(&baseline->reader, entry->value))
            continue;
        struct check_document *document = record_from_json(store, baseline->reader.document);
        if (document) {
            compare_gone(store, document);
            return document;
        }
    }
    return NULL;
}
