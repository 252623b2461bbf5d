// SPDX-License-Identifier: Apache-2.0
/* The catalogue and the list of diagnostics. */
#include "diag/diag.h"

#include "base/hash.h"

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

/* Returns what a format leaves open, as texts: strings, and numbers in decimal. */
static const char *const *keep_arguments(struct arena *arena, const char *format, va_list args,
                                         uint32_t *out_num)
{
    uint32_t num = 0;
    for (const char *at = format; (at = strchr(at, '%')) != NULL; at++)
        num++;
    const char **texts = num ? ARENA_ARRAY(arena, const char *, num) : NULL;
    *out_num = 0;
    for (const char *at = format; (at = strchr(at, '%')) != NULL; at++) {
        char number[16];
        const char *text = number;
        if (at[1] == 's')
            text = va_arg(args, const char *);
        else if (at[1] == 'u')
            snprintf(number, sizeof number, "%u", va_arg(args, unsigned));
        else
            snprintf(number, sizeof number, "%d", va_arg(args, int));
        texts[(*out_num)++] = arena_strndup(arena, text, strlen(text));
    }
    assert(*out_num == num);
    return texts;
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

static struct diag_place keep_place(const struct diag_list *list, struct diag_place place)
{
    place.file = keep_file(list, place.file);
    if (place.path)
        place.path = arena_strndup(list->arena, place.path, strlen(place.path));
    return place;
}

void diag_move(struct diag_list *list, struct diag_place place)
{
    assert(list->last < list->items.len);
    list->items.items[list->last].place = keep_place(list, place);
}

static bool is_same_text(const char *a, const char *b)
{
    return strcmp(a ? a : "", b ? b : "") == 0;
}

bool diag_is_same_place(const struct diag_place *a, const struct diag_place *b)
{
    return a->line == b->line && a->column == b->column && a->spot == b->spot
           && is_same_text(a->file, b->file) && is_same_text(a->path, b->path);
}

uint32_t diag_hash_place(const struct diag_place *place)
{
    const char *path = place->line || !place->path ? "" : place->path; /* of edited elements */
    return hash_pair(hash_pair(place->line, place->column), hash_bytes(path, strlen(path)));
}

/* True if the list has the last diagnostic twice. */
static bool is_repeated(struct diag_list *list)
{
    const struct diag *last = &list->items.items[list->last], *known;
    uint32_t text = hash_bytes(last->message, strlen(last->message)),
             hash = hash_pair(diag_hash_place(&last->place), text), found;
    for (uint32_t at = hash; (found = table_next(&list->told, hash, &at));) {
        known = &list->items.items[found - 1];
        if (known->id == last->id && strcmp(known->message, last->message) == 0
            && diag_is_same_place(&known->place, &last->place))
            return true;
    }
    table_add(&list->told, list->arena, hash, list->last + 1);
    return false;
}

/* Adds a diagnostic whose texts the list has. Sets its severity, parent and place. */
static void append(struct diag_list *list, struct diag diag)
{
    uint32_t last = list->last;
    diag.severity = severity_in(list, diag.id);
    assert(diag.severity != DIAG_IGNORED);
    bool is_note = diag.severity == DIAG_NOTE && list->items.len > 0;
    if (!is_note)
        list->last = list->items.len;
    diag.parent = list->last;
    diag.place = keep_place(list, diag.place);
    vec_push(list->arena, &list->items, diag);
    if (diag.id == DIAG_ID_include_missing && !list->cause)
        list->cause = list->items.len;
    assert(list->last < list->items.len);
    if (!is_note && list->trace) /* it may move the diagnostic */
        list->trace(list->trace_data, list);
    if (is_note || !is_repeated(list))
        return;
    list->num_repeated += diag.severity == DIAG_ERROR;
    list->items.len = list->last;
    list->last = last;
    list->muted_notes = true;
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

/* The texts of the note that counts, which each consequence changes. */
struct diag_note {
    char message[128], number[16];
    const char *arguments[3];
};

/* Adds the note behind the notes of the cause. */
static void insert_note(struct diag_list *list)
{
    uint32_t cause = list->cause - 1, at = cause + 1;
    while (at < list->items.len && list->items.items[at].parent == cause)
        at++;
    list->note = arena_alloc(list->arena, sizeof *list->note);
    struct diag note = {.id = DIAG_ID_consequences,
                        .severity = DIAG_NOTE,
                        .message = list->note->message,
                        .arguments = list->note->arguments,
                        .num_arguments = 3,
                        .place = list->items.items[cause].place,
                        .parent = cause};
    vec_push(list->arena, &list->items, note);
    memmove(list->items.items + at + 1, list->items.items + at,
            (list->items.len - 1 - at) * sizeof note);
    list->items.items[at] = note;
    for (uint32_t i = at + 1; i < list->items.len; i++)
        list->items.items[i].parent++; /* they follow the cause, so their parents do, too */
    table_make_room(&list->told, at + 1);
    list->last += list->last > cause;
}

static void count_consequence(struct diag_list *list)
{
    if (!list->cause)
        diag_repeat(list, list->cause_below);
    if (!list->note && list->cause)
        insert_note(list);
    struct diag_note *note = list->note;
    if (!note) /* beyond the limit of errors */
        return;
    bool is_one = ++list->num_consequences == 1;
    const char *const arguments[] = {note->number, is_one ? "" : "s",
                                     is_one ? "it is" : "they are"};
    snprintf(note->number, sizeof note->number, "%u", (unsigned)list->num_consequences);
    memcpy(note->arguments, arguments, sizeof arguments);
    snprintf(note->message, sizeof note->message, catalogue[DIAG_ID_consequences].format,
             list->num_consequences, arguments[1], arguments[2]);
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
    bool is_too_many = severity == DIAG_ERROR && list->max_errors
                       && list->num_errors - list->num_repeated > list->max_errors;
    list->muted_notes = is_too_many || severity == DIAG_IGNORED;
    return !list->muted_notes;
}

void diag_add(struct diag_list *list, enum diag_id id, struct diag_place place, ...)
{
    enum diag_severity severity = severity_in(list, id);
    if (is_consequence(list, id)) {
        count_consequence(list);
    } else if (is_kept(list, severity)) {
        struct diag diag = {.id = id, .place = place};
        const char *format = catalogue[id].format;
        va_list args, again;
        va_start(args, place);
        va_copy(again, args);
        diag.message = format_message(list->arena, format, args);
        diag.arguments = keep_arguments(list->arena, format, again, &diag.num_arguments);
        va_end(again);
        va_end(args);
        append(list, diag);
    } else if (severity == DIAG_ERROR
               && list->num_errors - list->num_repeated == list->max_errors + 1) {
        list->muted_notes = false;
        diag_add(list, DIAG_ID_too_many_errors, (struct diag_place){0}, list->max_errors);
        list->muted_notes = true;
    }
}

void diag_repeat(struct diag_list *list, const struct diag *diag)
{
    if (is_consequence(list, diag->id)) {
        count_consequence(list);
        return;
    }
    if (!is_kept(list, severity_in(list, diag->id)))
        return;
    struct diag copy = *diag;
    const char **texts = ARENA_ARRAY(list->arena, const char *, diag->num_arguments + 1);
    for (uint32_t i = 0; i < diag->num_arguments; i++)
        texts[i] = arena_strndup(list->arena, diag->arguments[i], strlen(diag->arguments[i]));
    copy.arguments = texts;
    copy.message = arena_strndup(list->arena, diag->message, strlen(diag->message));
    append(list, copy);
}
