// SPDX-License-Identifier: Apache-2.0
/*
 * Diagnostics on a terminal: what the library found is printed as compilers do, with the source
 * line read again.
 */
#ifndef MXG_CLI_REPORT_H
#define MXG_CLI_REPORT_H

#include <mxgen/mxgen.h>

#include <stdio.h>

struct report {
    bool quiet;   /* errors only */
    bool verbose; /* also what was upgraded in older documents */
    bool colour;
    uint32_t errors;        /* told so far, repeated ones and those behind the limit too */
    size_t max_errors;      /* that are printed of a document; 0: all */
    size_t document_errors; /* printed of the document at hand */
    bool is_rest_told;      /* that there are more */
    uint64_t *printed;      /* hashes of the messages printed, in a table; 0: free */
    size_t num_printed, capacity_printed;
    char *source_name, *source; /* the file read last */
    size_t source_size;
    const char **lines; /* of it, as far as they were looked for */
    size_t num_lines, capacity_lines;
    char *text; /* of the message at hand */
    size_t len, capacity;
};

void report_init(struct report *report); /* colour where stderr is a terminal */
void report_finish(struct report *report);

/* A message with its notes and source lines, as it is printed; lives until the next one. */
const char *report_render(struct report *report, const mxg_diagnostics *list, uint32_t index);

/*
 * The text of a file that messages are about, where it is no file to be read; it is freed by the
 * report.
 */
void report_source(struct report *report, const char *file, char *source, size_t size);

/* What follows is about another document: its errors are counted anew. */
void report_document(struct report *report);

/* Prints a list to stderr: what was not printed before, up to the limit of errors. */
void report_list(struct report *report, const mxg_diagnostics *list);

/* An error of the program itself: "error: message [id]". */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
void report_error(struct report *report, const char *id, const char *format, ...);

/* A warning of the program itself; a quiet report drops it. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
void report_warning(struct report *report, const char *id, const char *format, ...);

/*
 * What a status says beyond diagnostics: out of memory, cancelled, internal. Returns whether it is
 * MXG_OK.
 */
bool report_status(struct report *report, mxg_status status);

#endif
