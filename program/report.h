// SPDX-License-Identifier: Apache-2.0
/*
 * Diagnostics on a terminal: prints messages like a compiler does, with source lines.
 */
#ifndef MXG_PROGRAM_REPORT_H
#define MXG_PROGRAM_REPORT_H

#include "program/args.h"
#include "program/name_table.h"

#include <mxgen/mxgen.h>

#include <stdio.h>

struct profile;

/* Takes messages in place of standard error. */
struct report_receiver {
    void (*list)(void *user_data, const mxg_diagnostics *list);
    /* a message of the program itself */
    void (*own)(void *user_data, mxg_severity severity, const char *id, const char *text);
    void *user_data;
};

struct report {
    const struct report_receiver *receiver; /* NULL: messages are printed */
    bool quiet;                             /* errors only */
    bool verbose;                           /* also reports upgrades of older documents */
    bool colour;
    /* The profile of the options, and profile_line; NULL: none. */
    const struct profile *profile;
    uint32_t (*profile_line)(const struct profile *profile, const char *key, const char *value);
    const struct arg_list *warnings; /* words of -W, for those of the program; NULL: none */
    uint32_t errors;        /* number of errors, including repeated ones and those past the limit */
    size_t max_errors;      /* limit per document; 0: no limit */
    size_t document_errors; /* errors printed for the current document */
    size_t document_warnings;   /* other messages for it, including those that were not printed */
    bool has_cut_note;          /* the hint that more errors exist was printed */
    bool is_cause_told;         /* the note about consequences was printed for the document */
    struct name_table printed;  /* hashes of printed messages */
    char *source_name, *source; /* the last file that was read */
    size_t source_size;
    size_t max_source_size; /* of larger files no lines are shown; 0: no limit */
    size_t *lines;          /* where its lines begin, as far as the report has found them */
    size_t num_lines, capacity_lines;
    char *text; /* text of the current message */
    size_t len, capacity;
};

void report_init(struct report *report); /* uses colour if stderr is a terminal */
void report_finish(struct report *report);

/*
 * Reads a message of a list. A value of an option that the library refuses has the place where the
 * profile sets it.
 */
bool report_item(const struct report *report, const mxg_diagnostics *list, uint32_t index,
                 mxg_diagnostic *out);

/* The printed form of a message with its notes and source lines; valid until the next call. */
const char *report_render(struct report *report, const mxg_diagnostics *list, uint32_t index);

/*
 * Sets the source text for messages about a name that is no file; the report frees it.
 */
void report_source(struct report *report, const char *file, char *source, size_t size);

/* Starts another document: its errors count from 0. */
void report_document(struct report *report);

/* Prints a list to stderr, without repeated messages, up to the limit of errors. */
void report_list(struct report *report, const mxg_diagnostics *list);

/* Reports the errors of a list alone; counts only these. */
void report_errors(struct report *report, const mxg_diagnostics *list);

/* An error of the program itself: "error: message [id]". */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
void report_error(struct report *report, const char *id, const char *format, ...);

/* A warning of the program itself; a quiet report drops it, and -W may make it an error. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
void report_warning(struct report *report, const char *id, const char *format, ...);

/*
 * Reports a status without a diagnostic: out of memory, cancelled, internal. Returns true for
 * MXG_OK.
 */
bool report_status(struct report *report, mxg_status status);

#endif
