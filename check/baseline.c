// SPDX-License-Identifier: Apache-2.0
#include "check/baseline.h"

#include "check/picture.h"
#include "check/record_io.h"
#include "cli/cli.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- The index ---- */

static bool add_entry(struct baseline *baseline, uint64_t offset)
{
    bool is_new;
    const char *file = json_text_of(baseline->reader.document, "file");
    if (!*file) {
        baseline->reader.fault = "a document in it cannot be read";
        return false;
    }
    names_add(&baseline->offsets, file, &is_new)->value = offset;
    return true;
}

bool baseline_open(struct baseline *baseline, const char *path)
{
    *baseline = (struct baseline){.is_open = true};
    if (!reader_open(&baseline->reader, path))
        return false;
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

static int compare_offsets(const void *a, const void *b)
{
    const struct name_entry *left = a, *right = b;
    return left->value < right->value ? -1 : left->value > right->value;
}

/* This sorts the entries in place; lookups do not work afterwards. */
uint64_t baseline_list_gone(struct baseline *baseline, FILE *out)
{
    uint64_t count = 0;
    struct name_table *table = &baseline->offsets;
    if (table->capacity)
        qsort(table->entries, table->capacity, sizeof *table->entries, compare_offsets);
    for (size_t i = 0; i < table->capacity; ++i) {
        const struct name_entry *entry = &table->entries[i];
        if (!entry->hash || entry->is_marked || !reader_read_at(&baseline->reader, entry->value))
            continue;
        fprintf(out, "changed %s (gone): it is no longer there\n",
                json_text_of(baseline->reader.document, "file"));
        ++count;
    }
    return count;
}

static const struct check_document *find_document(struct baseline *baseline, struct store *store,
                                                  const char *file)
{
    struct name_entry *entry = names_find(&baseline->offsets, file);
    if (!entry || !reader_read_at(&baseline->reader, entry->value))
        return NULL;
    entry->is_marked = true;
    return record_from_json(store, baseline->reader.document);
}

/* ---- Differences ---- */

struct comparison {
    struct store *store;
    struct check_document *document;
    const char *element, *target; /* the current pair */
};

/* Appends a change and frees the text. */
static void add(struct comparison *c, enum check_change_kind kind, char *text)
{
    struct check_document *document = c->document;
    document->changes =
        store_grow(c->store, document->changes, document->num_changes, sizeof *document->changes);
    document->changes[document->num_changes++] = (struct check_change){
        kind, c->element, c->target, store_text(c->store, text, strlen(text))};
    free(text);
}

static void compare_verdicts(struct comparison *c, enum check_stage before, enum check_stage now)
{
    if (now && !before)
        add(c, CHANGE_FAILS, cli_format("fails at %s, where it passed", check_stage_names[now]));
    else if (before && !now)
        add(c, CHANGE_FIXED,
            cli_format("passes, where it failed at %s", check_stage_names[before]));
}

static void compare_measures(struct comparison *c, const struct check_shader *before,
                             const struct check_shader *now)
{
    for (int i = 0; i < NUM_MEASURES; ++i) {
        double old = (double)before->measures[i], new = (double)now->measures[i];
        if (old == new || (i == MEASURE_INSTRUCTIONS && before->compiled != now->compiled))
            continue;
        char *share =
            old > 0.0 ? cli_format(" (%+.1f %%)", 100.0 * (new - old) / old) : cli_format("%s", "");
        add(c, CHANGE_SIZE,
            cli_format("%" PRIu64 " %s, before %" PRIu64 "%s", now->measures[i],
                       measure_infos[i].noun, before->measures[i], share));
        free(share);
    }
}

static void compare_shader(struct comparison *c, const struct check_shader *before,
                           const struct check_shader *now)
{
    compare_verdicts(c, before->failed, now->failed);
    if (!*before->topology || !*now->topology)
        return; /* the verdict already shows it */
    if (strcmp(before->topology, now->topology) != 0)
        add(c, CHANGE_TOPOLOGY,
            cli_format("another shader: topology %s, before %s", now->topology, before->topology));
    compare_measures(c, before, now);
}

static void compare_pictures(struct comparison *c, const struct check_element *before,
                             const struct check_element *now)
{
    if (!*before->signature || !*now->signature)
        return;
    double difference = picture_difference(before->signature, now->signature);
    if (difference >= PICTURE_NOTICEABLE)
        add(c, CHANGE_PICTURE,
            cli_format("it looks different: delta E %.1f where it differs most", difference));
}

static const struct check_shader *find_shader(const struct check_element *element,
                                              const char *target)
{
    for (size_t i = 0; element && i < element->num_shaders; ++i)
        if (strcmp(element->shaders[i].target, target) == 0)
            return &element->shaders[i];
    return NULL;
}

static const struct check_element *find_element(const struct check_document *document,
                                                const char *path)
{
    for (size_t i = 0; i < document->num_elements; ++i)
        if (strcmp(document->elements[i].path, path) == 0)
            return &document->elements[i];
    return NULL;
}

static void compare_element(struct comparison *c, const struct check_element *before,
                            const struct check_element *now)
{
    c->element = now->path;
    for (size_t i = 0; i < now->num_shaders; ++i) {
        const struct check_shader *shader = &now->shaders[i],
                                  *old = find_shader(before, shader->target);
        c->target = shader->target;
        if (old)
            compare_shader(c, old, shader);
        else if (shader->failed)
            add(c, CHANGE_FAILS,
                cli_format("is new and fails at %s", check_stage_names[shader->failed]));
        else
            add(c, CHANGE_NEW, cli_format("is new"));
    }
    c->target = "";
    if (before)
        compare_pictures(c, before, now);
}

static void find_gone(struct comparison *c, const struct check_document *before)
{
    for (size_t i = 0; i < before->num_elements; ++i) {
        const char *path = before->elements[i].path;
        c->element = store_text(c->store, path, strlen(path));
        if (!find_element(c->document, path))
            add(c, CHANGE_GONE, cli_format("is no longer there"));
    }
}

/* The stage at which the document itself failed, without failures of its elements. */
static enum check_stage own_failure(const struct check_document *document)
{
    bool is_own = document->failed == CHECK_LOAD || document->failed == CHECK_VALIDATE
                  || document->failed >= CHECK_CRASH;
    return is_own ? document->failed : CHECK_PASSED;
}

void baseline_compare(struct baseline *baseline, struct store *store,
                      struct check_document *document)
{
    struct store scratch = {0};
    struct comparison c = {.store = store, .document = document, .element = "", .target = ""};
    const struct check_document *before = find_document(baseline, &scratch, document->file);
    if (before)
        compare_verdicts(&c, own_failure(before), own_failure(document));
    else if (own_failure(document))
        add(&c, CHANGE_FAILS,
            cli_format("is new and fails at %s", check_stage_names[document->failed]));
    for (size_t i = 0; i < document->num_elements; ++i)
        compare_element(&c, before ? find_element(before, document->elements[i].path) : NULL,
                        &document->elements[i]);
    if (before)
        find_gone(&c, before);
    store_finish(&scratch);
}
