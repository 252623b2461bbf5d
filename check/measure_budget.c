// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "check/measure_budget.h"

#include "program/cli.h"
#include "program/cli_targets.h"
#include "program/files.h"
#include "program/name_table.h"
#include "program/toml.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define FILE_NAME "mxgen.toml"
enum { NUM_PARTS = 5 }; /* number of parts in a message */

void budget_add_rule(struct store *store, struct budget_rules *rules, struct budget_rule rule)
{
    rules->items = store_grow(store, rules->items, rules->len, sizeof rule);
    rules->items[rules->len++] = rule;
}

bool budget_add(struct budget *budget, enum measure measure, const char *text)
{
    for (const char *at = text; *at;) {
        size_t len = strcspn(at, ",");
        const char *equals = memchr(at, '=', len), *digits = equals ? equals + 1 : at;
        char *end = NULL;
        unsigned long long limit = strtoull(digits, &end, 10);
        if (end != at + len || *digits < '0' || *digits > '9') {
            fprintf(stderr, "mxgen: '%s' is no budget; write --%s N, or TARGET=N,...\n", text,
                    measure_infos[measure].option);
            return false;
        }
        mxg_target known = {.name = ""};
        if (equals && !cli_find_target(budget->cli, at, (size_t)(equals - at), &known))
            return false;
        const char *target = store_text(&budget->store, known.name, strlen(known.name));
        budget_add_rule(&budget->store, &budget->command_line,
                        (struct budget_rule){measure, target, limit});
        at += len + (at[len] == ',');
    }
    return true;
}

void budget_finish(struct budget *budget)
{
    store_finish(&budget->store);
    store_finish(&budget->given.store);
    store_finish(&budget->judged.store);
    free(budget->given.folder);
    free(budget->judged.folder);
    for (size_t i = 0; i < NUM_BUDGET_FOLDERS; ++i) {
        free(budget->folders[i].name);
        free(budget->folders[i].file);
    }
}

/* ---- The file ---- */

static bool is_same_folder(const char *a, const char *b)
{
    struct stat first, second;
    return stat(*a ? a : ".", &first) != 0 || stat(b, &second) != 0
           || (first.st_dev == second.st_dev && first.st_ino == second.st_ino);
}

/* The parent folder, "" for the current one; NULL above the root. */
static char *folder_above(const char *folder)
{
    const char *slash = strrchr(folder, '/'), *name = slash ? slash + 1 : folder;
    if (*name && strcmp(name, ".") != 0 && strcmp(name, "..") != 0)
        return cli_copy(folder, slash ? (slash > folder ? (size_t)(slash - folder) : 1) : 0);
    char *above = *folder ? cli_format("%s/..", folder) : cli_format("..");
    if (!is_same_folder(folder, above))
        return above;
    free(above);
    return NULL;
}

static struct budget_folder *place_of(struct budget *budget, const char *folder)
{
    uint64_t hash = names_hash(NAMES_HASH_OF_NOTHING, folder);
    return &budget->folders[(hash ^ hash >> 32) % NUM_BUDGET_FOLDERS];
}

/*
 * The nearest file in the folder or its parents, valid until the next call; NULL if there is none.
 */
static const char *find_file(struct budget *budget, const char *folder)
{
    struct budget_folder *known = place_of(budget, folder);
    if (known->name && strcmp(known->name, folder) == 0)
        return known->file;
    char *path = *folder ? cli_format("%s/" FILE_NAME, folder) : cli_format(FILE_NAME);
    if (!files_is_regular(path)) {
        free(path);
        char *above = folder_above(folder);
        const char *found = above ? find_file(budget, above) : NULL;
        path = found ? cli_format("%s", found) : NULL;
        free(above);
    }
    free(known->name);
    free(known->file);
    *known = (struct budget_folder){cli_format("%s", folder), path};
    return path;
}

static void load_file(struct budget *budget, struct budget_file *file)
{
    const char *path = find_file(budget, file->folder);
    size_t size = 0;
    const char *refused = path ? mxg_context_file_fault(budget->cli->context, path, path) : NULL;
    char *text = path && !refused ? files_read(path, &size) : NULL;
    if (path)
        file->path = store_text(&file->store, path, strlen(path));
    const char *reason = refused ? refused
                         : text  ? toml_fault(text, size)
                         : path  ? strerror(errno)
                                 : NULL;
    if (reason)
        budget_refuse_toml(&file->store, file->path, reason, &file->fault);
    else if (text)
        budget_read_toml(budget->cli, &file->store, file->path, text, &file->rules, &file->fault);
    free(text);
}

/* Documents come folder by folder, so `file` is usually the right one already. */
static const struct budget_file *file_of(struct budget *budget, struct budget_file *file,
                                         const char *document)
{
    const char *slash = strrchr(document, '/');
    size_t len = slash ? (size_t)(slash - document) + (slash == document) : 0;
    if (file->folder && strncmp(file->folder, document, len) == 0 && !file->folder[len])
        return file;
    free(file->folder);
    store_finish(&file->store);
    *file = (struct budget_file){.folder = cli_copy(document, len)};
    load_file(budget, file);
    return file;
}

bool budget_has_file(struct budget *budget, const char *document)
{
    const struct budget_file *file = file_of(budget, &budget->given, document);
    return file->rules.len || file->fault.id;
}

/* ---- Verdicts ---- */

/* The last rule about a measure for this target, else the last rule for all targets. */
static const struct budget_rule *find_rule(const struct budget_rules *rules, enum measure measure,
                                           const char *target)
{
    const struct budget_rule *found = NULL;
    for (size_t i = 0; i < rules->len; ++i) {
        const struct budget_rule *rule = &rules->items[i];
        bool is_own = strcmp(rule->target, target) == 0;
        if (rule->measure == measure && (is_own || (!*rule->target && (!found || !*found->target))))
            found = rule;
    }
    return found;
}

static char *describe_parts(const struct check_shader *shader, enum measure measure)
{
    char *text = NULL;
    size_t size = 0, count = 0;
    FILE *out = open_memstream(&text, &size);
    for (size_t i = 0; out && i < shader->num_parts && count < NUM_PARTS; ++i) {
        const struct check_part *part = &shader->parts[i];
        if (part->measure != measure)
            continue;
        fprintf(out, "%s%s %" PRIu64, count++ ? ", " : ": ", part->name, part->count);
    }
    if (out)
        fclose(out);
    return text;
}

static void fail(struct store *store, struct check_document *document,
                 const struct check_element *element, struct check_shader *shader,
                 const struct budget_rule *rule)
{
    const struct measure_info *info = &measure_infos[rule->measure];
    char *parts = describe_parts(shader, rule->measure);
    char *text = cli_format("'%s' for %s has %" PRIu64 " %s; the budget allows %" PRIu64 "%s",
                            element->path, shader->target, shader->measures[rule->measure],
                            info->noun, rule->limit, parts ? parts : "");
    char *rendered = cli_format("%s: error: %s [over-budget]\n", document->file, text);
    struct check_message message = {.id = "over-budget",
                                    .text = store_text(store, text, strlen(text)),
                                    .file = document->file,
                                    .element = element->path,
                                    .target = shader->target,
                                    .rendered = store_text(store, rendered, strlen(rendered))};
    uint32_t index = check_add_message(store, document, &message);
    shader->messages = store_grow(store, shader->messages, shader->num_messages, sizeof index);
    shader->messages[shader->num_messages++] = index;
    check_fail(&shader->failed, CHECK_BUDGET);
    check_fail(&document->failed, CHECK_BUDGET);
    free(rendered);
    free(text);
    free(parts);
}

static void judge_shader(struct budget *budget, const struct budget_file *file, struct store *store,
                         struct check_document *document, const struct check_element *element,
                         struct check_shader *shader)
{
    for (int measure = 0; measure < NUM_MEASURES; ++measure) {
        const struct budget_rule *rule =
            find_rule(&budget->command_line, (enum measure)measure, shader->target);
        if (!rule)
            rule = find_rule(&file->rules, (enum measure)measure, shader->target);
        if (rule && measure == MEASURE_INSTRUCTIONS && !shader->compiled)
            budget->num_unjudged++;
        else if (rule && shader->measures[measure] > rule->limit)
            fail(store, document, element, shader, rule);
    }
}

static const char *copy(struct store *store, const char *text)
{
    return store_text(store, text, strlen(text));
}

void budget_judge(struct budget *budget, struct store *store, struct check_document *document)
{
    const struct budget_file *file = file_of(budget, &budget->judged, document->file);
    if (file->path && document->num_files)
        check_add_file(store, document, file->path);
    if (file->fault.id) {
        struct check_message message = file->fault;
        message.text = copy(store, message.text);
        message.file = copy(store, message.file);
        message.rendered = copy(store, message.rendered);
        check_add_message(store, document, &message);
        check_fail(&document->failed, CHECK_BUDGET);
    }
    for (size_t i = 0; i < document->num_elements; ++i)
        for (size_t k = 0; k < document->elements[i].num_shaders; ++k)
            judge_shader(budget, file, store, document, &document->elements[i],
                         &document->elements[i].shaders[k]);
}
