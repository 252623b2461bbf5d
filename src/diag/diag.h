// SPDX-License-Identifier: Apache-2.0
/*
 * Diagnostics: what mxgen says to the author of a document. A catalogue of messages with stable ids
 * (catalogue.def), a list that collects them, and renderers. Nothing here prints: a list is data
 * until somebody renders it.
 */
#ifndef MXG_DIAG_DIAG_H
#define MXG_DIAG_DIAG_H

#include "base/mem.h"
#include "base/text.h"

enum diag_severity {
    DIAG_ERROR,
    DIAG_WARNING,
    DIAG_NOTE,    /* belongs to the message before it */
    DIAG_REMARK,  /* stands alone; of interest to who asks for it */
    DIAG_IGNORED, /* not added at all: what a policy makes of others */
};

enum diag_id {
#define DIAG(id, severity, stable, format) DIAG_ID_##id,
#include "diag/catalogue.def"
#undef DIAG
    DIAG_NUM_IDS
};

/*
 * A place in a source file. Lines and columns count from 1, columns in code points; line 0: the
 * file as a whole.
 */
struct diag_place {
    const char *file; /* as the user named it; NULL: no file */
    uint32_t line, column;
    uint32_t length; /* code points to underline; 0 = 1 */
};

struct diag {
    enum diag_id id;
    enum diag_severity severity;
    const char *message; /* one line, no location inside */
    struct diag_place place;
    uint32_t parent; /* for notes: index of the message they belong to; else its own index */
};

/*
 * What the author wants to hear of warnings and remarks: by -W. Errors and notes are what they are.
 */
struct diag_policy {
    uint8_t severities[DIAG_NUM_IDS]; /* enum diag_severity */
};

struct diag_list {
    struct arena *arena;              /* owns messages and file names */
    const struct diag_policy *policy; /* NULL: the catalogue's severities */
    /*
     * Called behind each message, not notes: adds notes that tell how the work came there. May be
     * NULL.
     */
    void (*trace)(void *user_data, struct diag_list *list);
    void *trace_data;
    VEC(struct diag) items;
    uint32_t num_errors, num_warnings;
    uint32_t num_guesses; /* that were made: diag_guess_begin */
    uint32_t max_errors;  /* further errors are counted but not kept; 0 = unlimited */
    uint32_t last;        /* index of the last message that is not a note */
    bool muted_notes;     /* the last message was dropped: so are its notes */
};

void diag_list_init(struct diag_list *list, struct arena *arena);

/*
 * Adds a message; the arguments are those of the id's format. Notes attach to the message before
 * them, and are dropped with it. The place's file name is copied.
 */
void diag_add(struct diag_list *list, enum diag_id id, struct diag_place place, ...);

/* Adds a copy of a message of another list; notes attach to the message before them. */
void diag_repeat(struct diag_list *list, const struct diag *diag);

/*
 * A policy from words as -W has them, separated by commas: "error" makes errors of all warnings,
 * "error=ID" of one, "no-error=ID" none of that one; "no-ID" switches one off, "ID" on (a remark
 * becomes a warning). Their order does not count. Returns NULL, or the first word that is none of
 * these or names what is not a warning.
 */
const char *diag_policy_parse(struct diag_policy *policy, const char *words);

/* The stable id: "type-mismatch". */
const char *diag_id_text(enum diag_id id);
bool diag_id_find(const char *stable, size_t len, enum diag_id *out_id);
enum diag_severity diag_id_severity(enum diag_id id); /* the catalogue's */
const char *diag_id_format(enum diag_id id);
const char *diag_severity_text(enum diag_severity severity); /* "error" … */

/* explain.def: what is behind an id. All are "" rather than NULL. */
struct diag_explanation {
    const char *cause, *cure;
    const char *example; /* see mxg_diagnostic_kind in mxgen.h */
};
const struct diag_explanation *diag_explain(enum diag_id id);

/*
 * Renders one message as compilers do:
 *     file:line:col: error: message [id]
 *         <source line>
 *         ^~~~
 * `source` (the file's text, may be NULL) gives the line, of which a long one is cut around the
 * column. Control characters are replaced, tabs kept. Notes are printed without their id; `colour`
 * adds terminal escapes.
 */
void diag_render_text(const struct diag *diag, const char *source, size_t source_len, bool colour,
                      struct text *out);

/* The same with the source line at hand, without its end; NULL: unknown. */
void diag_render_line(const struct diag *diag, const char *line, size_t line_len, bool colour,
                      struct text *out);

/*
 * What was probably meant by a word that means nothing: " (did you mean 'x'?)" for the candidate
 * that is closest by edit distance, "" where none is near; the first of equally close ones. It
 * lives in the list's arena. A list gets some suggestions only, so that a document which is wrong
 * throughout is reported in linear time: where diag_guess_begin returns false, candidates need not
 * be looked for.
 *
 *     struct diag_guess guess;
 *     if (diag_guess_begin(&guess, diags, word))
 *         for (…)
 *             diag_guess_add(&guess, name);
 *     diag_add(diags, …, diag_guess_text(&guess));
 */
struct diag_guess {
    struct diag_list *list;
    const char *word, *best;
    size_t len, best_distance;
    uint64_t places[256]; /* where each byte stands in it */
};
bool diag_may_guess(const struct diag_list *list);
bool diag_guess_begin(struct diag_guess *guess, struct diag_list *list, const char *word);
void diag_guess_add(struct diag_guess *guess, const char *candidate);
const char *diag_guess_text(struct diag_guess *guess);

/* The same where the candidates are at hand. */
const char *diag_suggest(struct diag_list *list, const char *word, const char *const *candidates,
                         size_t num_candidates);

#endif
