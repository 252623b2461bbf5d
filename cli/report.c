// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "cli/report.h"

#include "cli/files.h"

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
    free(report->printed);
    free(report->text);
    *report = (struct report){0};
}

/* Makes `source` the text of the file, or NULL where it cannot be read (a file of the built-in library). */
static void load_source(struct report *report, const char *file)
{
    if (report->source_name && strcmp(report->source_name, file) == 0)
        return;
    free(report->source_name);
    free(report->source);
    report->source = NULL;
    report->source_size = 0;
    size_t len = strlen(file) + 1;
    report->source_name = malloc(len);
    if (report->source_name)
        memcpy(report->source_name, file, len);
    if (files_is_regular(file))
        report->source = files_read(file, &report->source_size);
}

/* Room for `size` bytes behind the text. */
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

/* Appends one message as it is printed. */
static void render(struct report *report, const mxg_diagnostics *list, uint32_t index, const char *file)
{
    if (file)
        load_source(report, file);
    const char *source = file ? report->source : NULL;
    size_t size = file ? report->source_size : 0, room = report->capacity - report->len;
    size_t len = mxg_diagnostics_format(list, index, source, size, report->colour, room ? report->text + report->len : NULL, room);
    if (!reserve(report, len + 2))
        return;
    if (len >= room)
        mxg_diagnostics_format(list, index, source, size, report->colour, report->text + report->len, report->capacity - report->len);
    report->len += len;
    if (len && report->text[report->len - 1] != '\n')
        report->text[report->len++] = '\n';
    report->text[report->len] = '\0';
}

const char *report_render(struct report *report, const mxg_diagnostics *list, uint32_t index)
{
    mxg_diagnostic part = {sizeof part};
    report->len = 0;
    for (uint32_t i = index; mxg_diagnostics_get(list, i, &part) == MXG_OK && part.parent == index; ++i)
        render(report, list, i, part.file);
    return report->text ? report->text : "";
}

/* Notes are shown where their message is; those about upgrades only when asked for. */
static bool is_shown(const struct report *report, const mxg_diagnostic *diagnostic)
{
    if (diagnostic->severity == MXG_SEVERITY_NOTE && strcmp(diagnostic->id, "upgraded") == 0)
        return report->verbose;
    return diagnostic->severity == MXG_SEVERITY_ERROR || !report->quiet;
}

static uint64_t hash_text(uint64_t hash, const char *text)
{
    for (; text && *text; ++text)
        hash = (hash ^ (unsigned char)*text) * 0x100000001b3u;
    return (hash ^ 0xff) * 0x100000001b3u;
}

/* Many materials of a document may meet the same fault: it is told once. */
static bool is_new(struct report *report, const mxg_diagnostic *diagnostic)
{
    uint64_t hash = 0xcbf29ce484222325u ^ ((uint64_t)diagnostic->line << 32 | diagnostic->column);
    hash = hash_text(hash_text(hash_text(hash, diagnostic->id), diagnostic->file), diagnostic->message);
    for (size_t i = 0; i < report->num_printed; ++i)
        if (report->printed[i] == hash)
            return false;
    uint64_t *more = realloc(report->printed, (report->num_printed + 1) * sizeof *more);
    if (more) {
        report->printed = more;
        report->printed[report->num_printed++] = hash;
    }
    return true;
}

void report_list(struct report *report, const mxg_diagnostics *list)
{
    uint32_t count = mxg_diagnostics_count(list);
    bool shown = false; /* the message that notes belong to */
    for (uint32_t i = 0; i < count; ++i) {
        mxg_diagnostic diagnostic = {sizeof diagnostic};
        mxg_diagnostics_get(list, i, &diagnostic);
        if (diagnostic.parent == i)
            shown = is_shown(report, &diagnostic) && is_new(report, &diagnostic);
        if (!shown || !is_shown(report, &diagnostic))
            continue;
        report->len = 0;
        render(report, list, i, diagnostic.file);
        fputs(report->text ? report->text : "", stderr);
    }
    report->errors += mxg_diagnostics_errors(list);
}

static void print_own(const struct report *report, const char *level, int colour, const char *id, const char *format, va_list args)
{
    if (report->colour)
        fprintf(stderr, "\033[1;%dm%s:\033[0m ", colour, level);
    else
        fprintf(stderr, "%s: ", level);
    vfprintf(stderr, format, args);
    fprintf(stderr, " [%s]\n", id);
}

void report_error(struct report *report, const char *id, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    print_own(report, "error", 31, id, format, args);
    va_end(args);
    ++report->errors;
}

void report_warning(struct report *report, const char *id, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    if (!report->quiet)
        print_own(report, "warning", 35, id, format, args);
    va_end(args);
}

bool report_status(struct report *report, mxg_status status)
{
    if (status != MXG_OK && status != MXG_ERROR_DOCUMENT)
        report_error(report, "failed", "%s", mxg_status_string(status));
    return status == MXG_OK;
}
