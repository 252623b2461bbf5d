// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "program/report.h"

#include "program/files.h"
#include "program/memory.h"
#include "program/profile.h"
#include "program/utf8.h"
#include "program/warning_groups.h"
#include "program/warnings.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void report_init(struct report *report)
{
    *report = (struct report){.colour = isatty(STDERR_FILENO) != 0};
}

void report_finish(struct report *report)
{
    free(report->source_name);
    free(report->source);
    names_finish(&report->printed);
    free(report->text);
    free(report->lines);
    *report = (struct report){0};
}

void report_source(struct report *report, const char *file, char *source, size_t size)
{
    free(report->source_name);
    free(report->source);
    report->source = source;
    report->source_size = size;
    report->num_lines = 0;
    size_t len = strlen(file) + 1;
    report->source_name = malloc(len);
    if (report->source_name)
        memcpy(report->source_name, file, len);
}

/*
 * Sets `source` to the text of the file, or to NULL if it cannot be read (files of the built-in
 * library).
 */
static void load_source(struct report *report, const char *file)
{
    if (report->source_name && strcmp(report->source_name, file) == 0)
        return;
    size_t size = 0;
    char *source = files_is_regular(file) && files_is_within(file, report->max_source_size)
                       ? files_read(file, &size)
                       : NULL;
    report_source(report, file, source, size);
}

/* Reserves `size` bytes after the text. */
static bool reserve(struct report *report, size_t size)
{
    if (report->capacity - report->len >= size)
        return true;
    size_t capacity = (report->len + size) * 2 + 1024;
    char *text = realloc(report->text, capacity);
    if (text) {
        report->text = text;
        report->capacity = capacity;
    }
    return text != NULL;
}

/*
 * A line of the source, from 1, without its end; NULL if there is none. The report stores the begin
 * of each line that it has found, and at last the place of a line behind the source.
 */
static const char *find_line(struct report *report, uint32_t number, size_t *out_len)
{
    while (report->source && report->num_lines <= number) {
        size_t last = report->num_lines ? report->lines[report->num_lines - 1] : 0, next = 0;
        if (last > report->source_size)
            break;
        if (report->num_lines) {
            const char *newline = memchr(report->source + last, '\n', report->source_size - last);
            next = newline ? (size_t)(newline - report->source) + 1 : report->source_size + 1;
        }
        if (report->num_lines == report->capacity_lines) {
            size_t capacity = report->capacity_lines ? report->capacity_lines * 2 : 256;
            size_t *lines = realloc(report->lines, capacity * sizeof *lines);
            if (!lines)
                return NULL;
            report->lines = lines;
            report->capacity_lines = capacity;
        }
        report->lines[report->num_lines++] = next;
    }
    if (!number || number >= report->num_lines)
        return NULL;
    const char *line = report->source + report->lines[number - 1];
    size_t len = report->lines[number] - report->lines[number - 1] - 1;
    *out_len = len && line[len - 1] == '\r' ? len - 1 : len;
    return line;
}

bool report_item(const struct report *report, const mxg_diagnostics *list, uint32_t index,
                 mxg_diagnostic *out)
{
    *out = (mxg_diagnostic){sizeof *out};
    if (mxg_diagnostics_item(list, index, out) != MXG_OK)
        return false;
    bool is_option = report->profile && !out->file && strcmp(out->id, "bad-option") == 0;
    const char *value = is_option ? mxg_diagnostics_argument(list, index, 0) : NULL,
               *key = is_option ? mxg_diagnostics_argument(list, index, 1) : NULL;
    uint32_t line = value && key ? report->profile_line(report->profile, key, value) : 0;
    if (line) {
        out->file = report->profile->name;
        out->line = line;
    }
    return true;
}

/* Appends the place of a message that has none in its list. */
static void render_profile(struct report *report, const mxg_diagnostic *diagnostic)
{
    size_t size = strlen(diagnostic->file) + 16;
    if (!reserve(report, size))
        return;
    char *place = report->text + report->len;
    report->len += (size_t)snprintf(place, size, "%s:%u: ", diagnostic->file, diagnostic->line);
    utf8_clean(place);
    report->len = (size_t)(place - report->text) + strlen(place);
}

/* Appends the printed form of one message. */
static void render(struct report *report, const mxg_diagnostics *list, uint32_t index,
                   const mxg_diagnostic *diagnostic)
{
    bool is_profile =
             report->profile && diagnostic->file && diagnostic->file == report->profile->name,
         has_line = diagnostic->file && diagnostic->line && !is_profile;
    if (is_profile)
        render_profile(report, diagnostic);
    if (has_line)
        load_source(report, diagnostic->file);
    size_t size = 0, room = report->capacity - report->len;
    const char *line = has_line ? find_line(report, diagnostic->line, &size) : NULL;
    size_t len = mxg_diagnostics_format(list, index, line, size, report->colour,
                                        room ? report->text + report->len : NULL, room);
    if (!reserve(report, len + 2))
        return;
    if (len >= room)
        mxg_diagnostics_format(list, index, line, size, report->colour, report->text + report->len,
                               report->capacity - report->len);
    report->len += len;
    if (len)
        report->text[report->len++] = '\n';
    report->text[report->len] = '\0';
}

const char *report_render(struct report *report, const mxg_diagnostics *list, uint32_t index)
{
    mxg_diagnostic part = {sizeof part};
    report->len = 0;
    for (uint32_t i = index; report_item(report, list, i, &part) && part.parent == index; ++i)
        render(report, list, i, &part);
    return report->text ? report->text : "";
}

/* Notes appear with their message; a note without one, for example of an upgrade, with --verbose.
 */
static bool is_shown(const struct report *report, const mxg_diagnostic *diagnostic, uint32_t index)
{
    if (diagnostic->severity == MXG_SEVERITY_NOTE && diagnostic->parent == index)
        return report->verbose;
    return diagnostic->severity == MXG_SEVERITY_ERROR || !report->quiet;
}

/*
 * True if the message is new: many materials of a document can have the same fault, which is
 * reported once.
 */
static bool is_new(struct report *report, const mxg_diagnostic *diagnostic)
{
    struct group_key key = {
        .id = diagnostic->id, .file = diagnostic->file, .text = diagnostic->message};
    bool is_new;
    names_add_hash(&report->printed, group_key_hash_at(&key, diagnostic->line, diagnostic->column),
                   &is_new);
    return is_new;
}

void report_document(struct report *report)
{
    report->document_errors = report->document_warnings = 0;
    report->has_cut_note = false;
    report->is_cause_told = false;
}

enum { MAX_WARNINGS = 1000 }; /* printed for a document, as long as errors have a limit */

/* Counts a message that is no error; false if there are too many. The first that is cut is told. */
static bool admit_warning(struct report *report)
{
    if (report->document_warnings++ == MAX_WARNINGS)
        fprintf(
            stderr,
            "note: more than %d warnings; the rest is not shown, but '--max-errors 0' shows all\n",
            MAX_WARNINGS);
    return report->document_warnings <= MAX_WARNINGS;
}

/* True if a message and its notes may be printed; limits their number. */
static bool admit(struct report *report, const mxg_diagnostic *diagnostic, uint32_t index)
{
    if (!is_shown(report, diagnostic, index) || !is_new(report, diagnostic))
        return false;
    if (!report->max_errors)
        return true;
    if (diagnostic->severity != MXG_SEVERITY_ERROR)
        return admit_warning(report);
    if (report->document_errors < report->max_errors) {
        ++report->document_errors;
        return true;
    }
    if (!report->has_cut_note)
        fprintf(stderr, "note: more than %zu errors; the rest is not shown\n", report->max_errors);
    report->has_cut_note = true;
    return false;
}

/* True if the message repeats the hint that more errors exist. */
static bool is_about_rest(struct report *report, const mxg_diagnostic *diagnostic)
{
    bool is_note = strcmp(diagnostic->id, "too-many-errors") == 0, was_noted = report->has_cut_note;
    report->has_cut_note = was_noted || is_note;
    return is_note && was_noted;
}

/* True for the first note of a document about consequences, which repeats with its error. */
static bool is_about_cause(struct report *report, const mxg_diagnostic *diagnostic)
{
    bool is_note = strcmp(diagnostic->id, "consequences") == 0, is_told = report->is_cause_told;
    report->is_cause_told = is_told || is_note;
    return is_note && !is_told;
}

/* ---- Lists ---- */

static bool key_of_warning(const void *messages, uint32_t index, struct group_key *out_key)
{
    mxg_diagnostic diagnostic = {sizeof diagnostic};
    mxg_diagnostics_item(messages, index, &diagnostic);
    *out_key = (struct group_key){
        .id = diagnostic.id, .file = diagnostic.file, .text = diagnostic.message};
    return diagnostic.severity == MXG_SEVERITY_WARNING && diagnostic.parent == index;
}

/* Notes the further messages of the group of `told`, except those that were printed before. */
static void print_rest(struct report *report, const struct groups *groups,
                       const mxg_diagnostics *list, uint32_t told)
{
    struct group_rest rest = {0};
    for (uint32_t i = groups->next[told]; i; i = groups->next[i]) {
        mxg_diagnostic diagnostic = {sizeof diagnostic};
        mxg_diagnostics_item(list, i, &diagnostic);
        if (is_new(report, &diagnostic))
            group_rest_add(&rest, diagnostic.line);
    }
    group_rest_print(&rest, stderr);
}

static void print_list(struct report *report, const mxg_diagnostics *list, bool only_errors)
{
    if (report->receiver) {
        report->receiver->list(report->receiver->user_data, list);
        report->errors += mxg_diagnostics_num_errors(list);
        return;
    }
    uint32_t count = mxg_diagnostics_num_items(list), open = count;
    bool shown = false; /* the message of the notes was printed */
    struct groups groups = groups_make(list, count, key_of_warning);
    for (uint32_t i = 0; i < count; ++i) {
        mxg_diagnostic diagnostic = {sizeof diagnostic};
        report_item(report, list, i, &diagnostic);
        if (diagnostic.parent == i) {
            if (open < count)
                print_rest(report, &groups, list, open);
            bool *is_told = &groups.is_told[groups.first[i]];
            shown = !*is_told && (!only_errors || diagnostic.severity == MXG_SEVERITY_ERROR)
                    && admit(report, &diagnostic, i);
            *is_told = *is_told || shown;
            open = shown ? i : count;
        }
        bool is_cause = is_about_cause(report, &diagnostic);
        if ((!shown && !is_cause) || !is_shown(report, &diagnostic, i)
            || is_about_rest(report, &diagnostic))
            continue;
        report->len = 0;
        render(report, list, i, &diagnostic);
        fputs(report->text ? report->text : "", stderr);
    }
    if (open < count)
        print_rest(report, &groups, list, open);
    groups_finish(&groups);
    report->errors += mxg_diagnostics_num_errors(list);
}

void report_list(struct report *report, const mxg_diagnostics *list)
{
    print_list(report, list, false);
}

void report_errors(struct report *report, const mxg_diagnostics *list)
{
    print_list(report, list, true);
}

static void print_own(const struct report *report, mxg_severity severity, const char *id,
                      const char *text)
{
    bool is_error = severity == MXG_SEVERITY_ERROR;
    const char *level = is_error ? "error" : "warning";
    if (report->colour)
        fprintf(stderr, "\033[1;%dm%s:\033[0m ", is_error ? 31 : 35, level);
    else
        fprintf(stderr, "%s: ", level);
    fprintf(stderr, "%s [%s]\n", text, id);
}

#if defined(__GNUC__)
__attribute__((format(printf, 4, 0)))
#endif
static void
tell_own(const struct report *report, mxg_severity severity, const char *id, const char *format,
         va_list args)
{
    char *text = memory_format(format, args);
    utf8_clean(text);
    if (report->receiver)
        report->receiver->own(report->receiver->user_data, severity, id, text);
    else
        print_own(report, severity, id, text);
    free(text);
}

void report_error(struct report *report, const char *id, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    tell_own(report, MXG_SEVERITY_ERROR, id, format, args);
    va_end(args);
    ++report->errors;
}

void report_warning(struct report *report, const char *id, const char *format, ...)
{
    const struct arg_list none = {0};
    const enum warning_way way = warnings_way(report->warnings ? report->warnings : &none, id);
    va_list args;
    va_start(args, format);
    if (way == WARNING_IS_ERROR)
        tell_own(report, MXG_SEVERITY_ERROR, id, format, args);
    else if (way == WARNING_SHOWN && !report->quiet)
        tell_own(report, MXG_SEVERITY_WARNING, id, format, args);
    va_end(args);
    report->errors += way == WARNING_IS_ERROR;
}

bool report_status(struct report *report, mxg_status status)
{
    if (status != MXG_OK && status != MXG_ERROR_DOCUMENT)
        report_error(report, "failed", "%s", mxg_status_string(status));
    return status == MXG_OK;
}
