// SPDX-License-Identifier: Apache-2.0
#include "lsp/findings.h"

#include "program/name_table.h"

#include <string.h>

static const char *keep(struct findings *findings, const char *text)
{
    return store_text(&findings->store, text, strlen(text));
}

/* Files of the built-in library have names that are no paths. */
static bool has_file(const mxg_diagnostic *item)
{
    return item->file && item->file[0] == '/';
}

static void add_arguments(struct findings *findings, struct finding *finding,
                          const mxg_diagnostics *list, uint32_t index, uint32_t num)
{
    const char **arguments = store_alloc(&findings->store, (num + 1) * sizeof *arguments);
    for (uint32_t i = 0; i < num; ++i) {
        const char *argument = mxg_diagnostics_argument(list, index, i);
        arguments[i] = keep(findings, argument ? argument : "");
    }
    finding->arguments = arguments;
    finding->num_arguments = num;
}

static void add_note(struct findings *findings, struct finding *finding, const mxg_diagnostic *item)
{
    finding->notes =
        store_grow(&findings->store, finding->notes, finding->num_notes, sizeof *finding->notes);
    finding->notes[finding->num_notes++] =
        (struct finding_note){keep(findings, item->message),
                              has_file(item) && item->line ? keep(findings, item->file) : NULL,
                              item->line, item->column, item->length};
}

/* The finding of a message, which has no notes yet. */
static void add(struct findings *findings, const mxg_diagnostics *list, uint32_t index,
                const mxg_diagnostic *item, const char *path)
{
    findings->items =
        store_grow(&findings->store, findings->items, findings->len, sizeof *findings->items);
    struct finding *finding = &findings->items[findings->len++];
    bool has_place = has_file(item) || (item->file && strcmp(item->file, path) == 0);
    *finding = (struct finding){.id = item->id,
                                .message = keep(findings, item->message),
                                .severity = item->severity,
                                .path = keep(findings, has_place ? item->file : path)};
    if (has_place) {
        finding->line = item->line;
        finding->column = item->column;
        finding->length = item->length;
    }
    add_arguments(findings, finding, list, index, item->num_arguments);
}

static uint64_t hash_of(const mxg_diagnostic *item)
{
    uint64_t hash = names_hash(NAMES_HASH_OF_NOTHING, item->id);
    hash = names_hash(hash, item->file ? item->file : "");
    hash = names_hash(hash, item->message);
    return (hash ^ item->line) * 0x9e3779b97f4a7c15u ^ item->column;
}

void findings_add(struct findings *findings, const mxg_diagnostics *list, const char *path)
{
    struct name_table known = {0};
    for (size_t i = 0; i < findings->len; ++i) {
        const struct finding *finding = &findings->items[i];
        mxg_diagnostic item = {.id = finding->id,
                               .file = finding->path,
                               .message = finding->message,
                               .line = finding->line,
                               .column = finding->column};
        bool is_new;
        names_add_hash(&known, hash_of(&item), &is_new);
    }
    bool is_shown = false;
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); ++i) {
        mxg_diagnostic item = {sizeof item};
        mxg_diagnostics_item(list, i, &item);
        if (item.parent == i) {
            is_shown = item.severity != MXG_SEVERITY_NOTE;
            if (is_shown)
                names_add_hash(&known, hash_of(&item), &is_shown);
            if (is_shown)
                add(findings, list, i, &item, path);
        } else if (is_shown) {
            add_note(findings, &findings->items[findings->len - 1], &item);
        }
    }
    names_finish(&known);
}

void findings_clear(struct findings *findings)
{
    store_finish(&findings->store);
    findings->items = NULL;
    findings->len = 0;
}

struct span findings_span(const struct text *text, uint32_t line, uint32_t column, uint32_t length)
{
    if (!line)
        return (struct span){0, text_line_span(text, 0).end};
    uint32_t start = text_place(text, line, column);
    if (!column)
        return text_line_span(text, line - 1);
    return (struct span){start, text_skip(text, start, length ? length : 1)};
}
