// SPDX-License-Identifier: Apache-2.0
/* The catalogue and the list of diagnostics. */
#include "diag/diag.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>

static const struct {
    const char *stable;
    const char *format;
    enum diag_severity severity;
} catalogue[DIAG_NUM_IDS] = {
#define DIAG(id, severity, stable, format) {stable, format, DIAG_##severity},
#include "diag/catalogue.def"
#undef DIAG
};

const char *diag_id_text(enum diag_id id)
{
    assert((unsigned)id < DIAG_NUM_IDS);
    return catalogue[id].stable;
}

bool diag_id_find(const char *stable, size_t len, enum diag_id *out_id)
{
    for (int id = 0; id < DIAG_NUM_IDS; id++) {
        if (strlen(catalogue[id].stable) == len && memcmp(catalogue[id].stable, stable, len) == 0) {
            *out_id = (enum diag_id)id;
            return true;
        }
    }
    return false;
}

const char *diag_severity_text(enum diag_severity severity)
{
    static const char *const texts[] = {[DIAG_ERROR] = "error",
                                        [DIAG_WARNING] = "warning",
                                        [DIAG_NOTE] = "note",
                                        [DIAG_REMARK] = "note",
                                        [DIAG_IGNORED] = "ignored"};
    assert((unsigned)severity < sizeof texts / sizeof *texts);
    return texts[severity];
}

void diag_list_init(struct diag_list *list, struct arena *arena)
{
    *list = (struct diag_list){.arena = arena};
}

static const char *format_message(struct arena *arena, const char *format, va_list args)
{
    va_list again;
    va_copy(again, args);
    int len = vsnprintf(NULL, 0, format, again);
    va_end(again);
    if (len < 0)
        return format;
    char *message = arena_alloc(arena, (size_t)len + 1);
    vsnprintf(message, (size_t)len + 1, format, args);
    return message;
}

/* Consecutive diagnostics often share a file. */
static const char *keep_file(const struct diag_list *list, const char *file)
{
    if (!file)
        return NULL;
    if (list->items.len) {
        const char *previous = vec_last(&list->items).place.file;
        if (previous && strcmp(previous, file) == 0)
            return previous;
    }
    return arena_strndup(list->arena, file, strlen(file));
}

enum diag_severity diag_id_severity(enum diag_id id)
{
    return catalogue[id].severity;
}

const char *diag_id_format(enum diag_id id)
{
    return catalogue[id].format;
}

static enum diag_severity severity_in(const struct diag_list *list, enum diag_id id)
{
    return list->policy ? (enum diag_severity)list->policy->severities[id] : catalogue[id].severity;
}

bool diag_is_shown(const struct diag_list *list, enum diag_id id)
{
    return severity_in(list, id) < DIAG_REMARK;
}

static void append(struct diag_list *list, enum diag_id id, struct diag_place place,
                   const char *message)
{
    enum diag_severity severity = severity_in(list, id);
    assert(severity != DIAG_IGNORED);
    bool is_note = severity == DIAG_NOTE && list->items.len > 0;
    if (!is_note)
        list->last = list->items.len;
    place.file = keep_file(list, place.file);
    if (place.path)
        place.path = arena_strndup(list->arena, place.path, strlen(place.path));
    vec_push(list->arena, &list->items,
             (struct diag){.id = id,
                           .severity = severity,
                           .message = message,
                           .place = place,
                           .parent = list->last});
    if (id == DIAG_ID_include_missing && !list->cause)
        list->cause = list->items.len;
    assert(list->last < list->items.len);
    if (!is_note && list->trace)
        list->trace(list->trace_data, list);
}

/* ---- Consequences ---- */

static bool is_consequence(const struct diag_list *list, enum diag_id id)
{
    static const enum diag_id ids[] = {
        DIAG_ID_unknown_node,      DIAG_ID_unknown_nodedef,
        DIAG_ID_unknown_type,      DIAG_ID_inherit_missing,
        DIAG_ID_dangling_nodename, DIAG_ID_implementation_unknown_nodedef,
        DIAG_ID_unknown_geomprop,  DIAG_ID_dangling_nodegraph,
        DIAG_ID_unknown_unit,      DIAG_ID_dangling_reference,
        DIAG_ID_unknown_unittype,  DIAG_ID_nothing_to_render,
        DIAG_ID_unknown_token,     DIAG_ID_unknown_element,
    };
    bool has_cause = list->cause || list->cause_below;
    for (size_t i = 0; has_cause && i < sizeof ids / sizeof *ids; i++)
        if (ids[i] == id)
            return true;
    return false;
}

enum { CONSEQUENCES_SIZE = 128 };

/* Adds the note behind the notes of the cause. */
static void insert_note(struct diag_list *list)
{
    uint32_t cause = list->cause - 1, at = cause + 1;
    while (at < list->items.len && list->items.items[at].parent == cause)
        at++;
    list->consequences = arena_alloc(list->arena, CONSEQUENCES_SIZE);
    struct diag note = {.id = DIAG_ID_consequences,
                        .severity = DIAG_NOTE,
                        .message = list->consequences,
                        .place = list->items.items[cause].place,
                        .parent = cause};
    vec_push(list->arena, &list->items, note);
    memmove(list->items.items + at + 1, list->items.items + at,
            (list->items.len - 1 - at) * sizeof note);
    list->items.items[at] = note;
    for (uint32_t i = at + 1; i < list->items.len; i++)
        list->items.items[i].parent++; /* they follow the cause, so their parents do, too */
    list->last += list->last > cause;
}

static void count_consequence(struct diag_list *list)
{
    if (!list->cause)
        diag_repeat(list, list->cause_below);
    if (!list->consequences && list->cause)
        insert_note(list);
    if (!list->consequences) /* beyond the limit of errors */
        return;
    list->num_consequences++;
    snprintf(list->consequences, CONSEQUENCES_SIZE, catalogue[DIAG_ID_consequences].format,
             list->num_consequences, list->num_consequences == 1 ? "" : "s",
             list->num_consequences == 1 ? "it is" : "they are");
    list->muted_notes = true;
}

void diag_list_follow(struct diag_list *list, const struct diag_list *document)
{
    if (document->cause)
        list->cause_below = &document->items.items[document->cause - 1];
}

/* ---- Adding ---- */

/* Counts the diagnostic; false if it is dropped. */
static bool is_kept(struct diag_list *list, enum diag_severity severity)
{
    if (severity == DIAG_NOTE)
        return !list->muted_notes;
    list->num_errors += severity == DIAG_ERROR;
    bool is_too_many =
        severity == DIAG_ERROR && list->max_errors && list->num_errors > list->max_errors;
    list->muted_notes = is_too_many || severity == DIAG_IGNORED;
    return !list->muted_notes;
}

void diag_add(struct diag_list *list, enum diag_id id, struct diag_place place, ...)
{
    enum diag_severity severity = severity_in(list, id);
    if (is_consequence(list, id)) {
        count_consequence(list);
    } else if (is_kept(list, severity)) {
        va_list args;
        va_start(args, place);
        append(list, id, place, format_message(list->arena, catalogue[id].format, args));
        va_end(args);
    } else if (severity == DIAG_ERROR && list->num_errors == list->max_errors + 1) {
        list->muted_notes = false;
        diag_add(list, DIAG_ID_too_many_errors, (struct diag_place){0}, list->max_errors);
        list->muted_notes = true;
    }
}

void diag_repeat(struct diag_list *list, const struct diag *diag)
{
    if (is_consequence(list, diag->id))
        count_consequence(list);
    else if (is_kept(list, severity_in(list, diag->id)))
        append(list, diag->id, diag->place,
               arena_strndup(list->arena, diag->message, strlen(diag->message)));
}
