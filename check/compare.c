// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "check/compare.h"

#include "check/signature.h"
#include "check/below_root.h"
#include "program/cli.h"
#include "program/name_table.h"

#include <assert.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

struct comparison {
    struct store *store;
    struct check_document *document;
    const char *element, *target; /* the current pair */
};

static const char *copy(struct comparison *c, const char *text)
{
    return store_text(c->store, text, strlen(text));
}

/* Appends a change and frees the text. */
static struct check_change *add(struct comparison *c, enum check_change_kind kind, char *text)
{
    struct check_document *document = c->document;
    document->changes =
        store_grow(c->store, document->changes, document->num_changes, sizeof *document->changes);
    struct check_change *change = &document->changes[document->num_changes++];
    *change = (struct check_change){kind, c->element, c->target, copy(c, text), NULL};
    free(text);
    return change;
}

static void compare_verdicts(struct comparison *c, enum check_failure before,
                             enum check_failure now)
{
    if (now && !before)
        add(c, CHANGE_FAILS, cli_format("fails at %s, where it passed", check_failure_names[now]));
    else if (before && !now)
        add(c, CHANGE_FIXED,
            cli_format("passes, where it failed at %s", check_failure_names[before]));
}

/* ---- Messages ---- */

/* A message by its hash and place, for a walk over two lists in one order. */
struct entry {
    uint64_t hash;
    uint32_t line, column;
    size_t index;
};

static int compare_entries(const void *a, const void *b)
{
    const struct entry *left = a, *right = b;
    if (left->hash != right->hash)
        return left->hash < right->hash ? -1 : 1;
    if (left->line != right->line)
        return left->line < right->line ? -1 : 1;
    if (left->column != right->column)
        return left->column < right->column ? -1 : 1;
    return left->index < right->index ? -1 : left->index > right->index;
}

static struct entry *sort_messages(struct store *store, const struct check_document *document)
{
    struct entry *entries = store_array(store, document->num_messages, sizeof *entries);
    for (size_t i = 0; i < document->num_messages; ++i) {
        const struct check_message *message = &document->messages[i];
        entries[i] =
            (struct entry){place_hash(document, message), message->line, message->column, i};
    }
    if (document->num_messages)
        qsort(entries, document->num_messages, sizeof *entries, compare_entries);
    return entries;
}

/* "a.mtlx:4:7: 'x' is no number [bad-value]" */
static char *describe(const struct check_message *message)
{
    char *place = message->line && message->column
                      ? cli_format("%s:%u:%u: ", message->file, message->line, message->column)
                  : *message->file ? cli_format("%s: ", message->file)
                                   : cli_format("%s", "");
    char *text = cli_format("%s%s [%s]", place, message->text, message->id);
    free(place);
    return text;
}

static void tell_new(struct comparison *c, struct check_message *message)
{
    enum check_change_kind kind = message->severity == MXG_SEVERITY_ERROR     ? CHANGE_NEW_ERRORS
                                  : message->severity == MXG_SEVERITY_WARNING ? CHANGE_NEW_WARNINGS
                                                                              : NUM_CHECK_CHANGES;
    message->state = "new";
    if (kind == NUM_CHECK_CHANGES)
        return;
    c->element = message->element;
    c->target = message->target;
    add(c, kind, describe(message))->message = message;
    c->element = c->target = "";
}

/* A copy in the store, of a document that has another path now. */
static void copy_gone(struct comparison *c, const struct check_document *before,
                      const struct check_message *message)
{
    struct check_document *document = c->document;
    bool is_own = strcmp(message->file, before->file) == 0;
    document->gone_messages =
        store_grow(c->store, document->gone_messages, document->num_gone_messages, sizeof *message);
    document->gone_messages[document->num_gone_messages++] =
        (struct check_message){.severity = message->severity,
                               .id = copy(c, message->id),
                               .text = copy(c, message->text),
                               .file = is_own ? document->file : copy(c, message->file),
                               .line = message->line,
                               .column = message->column,
                               .length = message->length,
                               .element = copy(c, message->element),
                               .target = copy(c, message->target),
                               .rendered = "",
                               .state = "absent"};
}

static void tell_gone(struct comparison *c, const struct check_document *before,
                      const struct check_message *message)
{
    struct check_document *document = c->document;
    copy_gone(c, before, message);
    if (message->severity == MXG_SEVERITY_NOTE)
        return;
    const struct check_message *gone = &document->gone_messages[document->num_gone_messages - 1];
    c->element = gone->element;
    c->target = gone->target;
    add(c, gone->severity == MXG_SEVERITY_ERROR ? CHANGE_GONE_ERRORS : CHANGE_GONE_WARNINGS,
        describe(gone));
    c->element = c->target = "";
}

/*
 * Pairs the messages of one hash: those at the same place first, then the others in order. `was`
 * and `is` are the numbers of entries.
 */
static void pair_messages(struct comparison *c, const struct check_document *before,
                          struct entry *old, size_t was, struct entry *new, size_t is)
{
    size_t num_old = 0, num_new = 0; /* entries without a partner, moved to the front */
    for (size_t i = 0, k = 0; i < was || k < is;) {
        bool is_pair =
            i < was && k < is && old[i].line == new[k].line &&old[i].column == new[k].column;
        bool old_first = i < was
                         && (k == is || old[i].line < new[k].line
                             || (old[i].line == new[k].line &&old[i].column < new[k].column));
        if (is_pair)
            c->document->messages[new[k].index].state = "unchanged";
        else if (old_first)
            old[num_old++] = old[i];
        else
            new[num_new++] = new[k];
        i += is_pair || old_first;
        k += is_pair || !old_first;
    }
    size_t num_pairs = num_old < num_new ? num_old : num_new;
    for (size_t i = 0; i < num_new; ++i)
        c->document->messages[new[i].index].state = i < num_pairs ? "unchanged" : "new";
    for (size_t i = num_pairs; i < num_old; ++i)
        tell_gone(c, before, &before->messages[old[i].index]);
}

static void compare_messages(struct comparison *c, const struct check_document *before)
{
    static const struct check_document nothing = {.file = "", .name = ""};
    struct store scratch = {0};
    struct check_document *now = c->document;
    before = before ? before : &nothing;
    struct entry *old = sort_messages(&scratch, before), *new = sort_messages(&scratch, now);
    for (size_t i = 0, k = 0; i < before->num_messages || k < now->num_messages;) {
        uint64_t hash =
            i == before->num_messages || (k < now->num_messages && new[k].hash < old[i].hash)
                ? new[k].hash
                : old[i].hash;
        size_t was = 0, is = 0;
        while (i + was < before->num_messages && old[i + was].hash == hash)
            ++was;
        while (k + is < now->num_messages && new[k + is].hash == hash)
            ++is;
        assert(was + is > 0);
        pair_messages(c, before, old + i, was, new + k, is);
        i += was;
        k += is;
    }
    for (size_t i = 0; i < now->num_messages; ++i) /* in the document's order */
        if (strcmp(now->messages[i].state, "new") == 0)
            tell_new(c, &now->messages[i]);
    if (now->num_hidden > before->num_hidden)
        add(c, CHANGE_NEW_ERRORS,
            cli_format("%u errors beyond --max-errors, before %u", now->num_hidden,
                       before->num_hidden));
    store_finish(&scratch);
}

/* ---- Settings ---- */

/* Appends "; " or nothing, and one difference. */
static void list(FILE *out, bool *has_any, const char *path, const char *now, const char *before)
{
    fputs(*has_any ? "; " : "", out);
    *has_any = true;
    if (now && before)
        fprintf(out, "'%s' is %s, before %s", path, *now ? now : "empty",
                *before ? before : "empty");
    else
        fprintf(out, now ? "'%s' is new: %s" : "'%s' is gone: %s", path, now ? now : before);
}

static void compare_settings(struct comparison *c, enum check_change_kind kind,
                             const struct check_setting *old, size_t num_old,
                             const struct check_setting *new, size_t num_new)
{
    struct name_table places = {0}; /* indices in `old`; a mark: `new` has the path */
    char *text = NULL;
    size_t size = 0;
    bool is_new, has_any = false;
    FILE *out = open_memstream(&text, &size);
    for (size_t i = 0; out && i < num_old; ++i)
        names_add(&places, old[i].path, &is_new)->value = i;
    for (size_t i = 0; out && i < num_new; ++i) {
        struct name_entry *entry = names_find(&places, new[i].path);
        const char *before = entry ? old[entry->value].value : NULL;
        if (entry)
            entry->is_marked = true;
        if (!before || strcmp(before, new[i].value) != 0)
            list(out, &has_any, new[i].path, new[i].value, before);
    }
    for (size_t i = 0; out && i < num_old; ++i)
        if (!names_find(&places, old[i].path)->is_marked)
            list(out, &has_any, old[i].path, NULL, old[i].value);
    if (out)
        fclose(out);
    if (has_any)
        add(c, kind, text);
    else
        free(text);
    names_finish(&places);
}

/* ---- Shaders ---- */

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
    if (before->compiled && !now->compiled && now->failed != CHECK_GENERATE)
        add(c, CHANGE_UNCOMPILED, cli_format("was compiled, but no compiler is installed now"));
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

/* True if a target of the element has a shader, so that its settings are known. */
static bool has_shader(const struct check_element *element)
{
    for (size_t i = 0; i < element->num_shaders; ++i)
        if (*element->shaders[i].topology)
            return true;
    return false;
}

/* `before` NULL: the element is new; an element of a new document gets no change of its own. */
static void compare_element(struct comparison *c, const struct check_element *before,
                            const struct check_element *now, bool is_known_document)
{
    c->element = now->path;
    if (!before && is_known_document)
        add(c, CHANGE_NEW, cli_format("is new"));
    for (size_t i = 0; i < now->num_shaders; ++i) {
        const struct check_shader *shader = &now->shaders[i],
                                  *old = find_shader(before, shader->target);
        c->target = shader->target;
        if (old)
            compare_shader(c, old, shader);
        else if (shader->failed)
            add(c, CHANGE_FAILS,
                cli_format("is new and fails at %s", check_failure_names[shader->failed]));
    }
    c->target = "";
    if (before && has_shader(before) && has_shader(now)) {
        compare_settings(c, CHANGE_VALUES, before->values, before->num_values, now->values,
                         now->num_values);
        compare_settings(c, CHANGE_TEXTURES, before->textures, before->num_textures, now->textures,
                         now->num_textures);
    }
    if (before)
        compare_pictures(c, before, now);
    c->element = "";
}

static void compare_elements(struct comparison *c, const struct check_document *before)
{
    struct name_table places = {0}; /* indices in `before`; a mark: the document has the element */
    bool is_new;
    for (size_t i = 0; before && i < before->num_elements; ++i)
        names_add(&places, before->elements[i].path, &is_new)->value = i;
    for (size_t i = 0; i < c->document->num_elements; ++i) {
        struct name_entry *entry = names_find(&places, c->document->elements[i].path);
        if (entry)
            entry->is_marked = true;
        compare_element(c, entry ? &before->elements[entry->value] : NULL,
                        &c->document->elements[i], before != NULL);
    }
    for (size_t i = 0; before && i < before->num_elements; ++i) {
        if (names_find(&places, before->elements[i].path)->is_marked)
            continue;
        c->element = copy(c, before->elements[i].path);
        add(c, CHANGE_GONE, cli_format("is no longer there"));
        c->element = "";
    }
    names_finish(&places);
}

/* ---- Documents ---- */

void compare_documents(struct store *store, struct check_document *now,
                       const struct check_document *before)
{
    struct comparison c = {.store = store, .document = now, .element = "", .target = ""};
    now->num_changes = now->num_gone_messages = 0;
    if (before) {
        compare_verdicts(&c, check_own_failure(before), check_own_failure(now));
    } else {
        add(&c, CHANGE_NEW, cli_format("is new"));
        if (check_own_failure(now))
            add(&c, CHANGE_FAILS,
                cli_format("is new and fails at %s", check_failure_names[now->failed]));
    }
    compare_messages(&c, before);
    compare_elements(&c, before);
}

void compare_gone(struct store *store, struct check_document *before)
{
    struct comparison c = {.store = store, .document = before, .element = "", .target = ""};
    before->num_changes = 0;
    add(&c, CHANGE_GONE, cli_format("is in the baseline, but not in this run"));
    for (size_t i = 0; i < before->num_messages; ++i)
        before->messages[i].state = "absent";
}
