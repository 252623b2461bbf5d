// SPDX-License-Identifier: Apache-2.0
/*
 * Diagnostics: the catalogue of messages with stable ids (catalogue.def), a list that collects
 * them, and renderers. Nothing in this room prints.
 */
#ifndef MXG_DIAG_DIAG_H
#define MXG_DIAG_DIAG_H

#include "base/mem.h"
#include "base/table.h"
#include "base/text.h"

enum diag_severity {
    DIAG_ERROR,
    DIAG_WARNING,
    DIAG_NOTE,    /* explains the diagnostic before it */
    DIAG_REMARK,  /* hidden by default */
    DIAG_IGNORED, /* suppressed by a policy */
};

enum diag_id {
#define DIAG(id, severity, stable, format) DIAG_ID_##id,
#include "diag/catalogue.def"
#undef DIAG
    DIAG_NUM_IDS
};

/*
 * A place in a source file. Lines and columns count from 1, columns in code points. Line 0 is the
 * whole file.
 */
struct diag_place {
    const char *file; /* as the user wrote it; NULL: no file */
    uint32_t line, column;
    uint32_t length;  /* code points to underline; 0 means 1 */
    const char *path; /* of the element in its document, if it has no line; otherwise NULL */
    /* different for what a text has in different places, and this place does not; otherwise 0 */
    uint64_t spot;
};

struct diag {
    enum diag_id id;
    enum diag_severity severity;
    const char *message;          /* one line, without the location */
    const char *const *arguments; /* texts of what the format of the id leaves open, in its order */
    uint32_t num_arguments;
    struct diag_place place;
    /* for a note: index of the diagnostic that it explains; otherwise its own index */
    uint32_t parent;
};

/* The severities that -W selects for warnings and remarks. Errors and notes keep their severity. */
struct diag_policy {
    uint8_t severities[DIAG_NUM_IDS]; /* enum diag_severity */
};

struct diag_list {
    struct arena *arena;              /* owns messages and file names */
    const struct diag_policy *policy; /* NULL: the severities of the catalogue */
    /*
     * Called after each diagnostic except notes, to add notes with the path of expansion. May be
     * NULL.
     */
    void (*trace)(void *user_data, struct diag_list *list);
    void *trace_data;
    VEC(struct diag) items;
    struct table told; /* by place and text: indices of `items` + 1, without notes */
    uint32_t num_errors;
    uint32_t num_repeated; /* errors among them that are in the list already, for the limit */
    uint32_t num_guesses;  /* number of suggestions so far: diag_guess_begin */
    uint32_t max_errors; /* the list counts further errors but does not keep them; 0 = unlimited */
    /*
     * A missing include makes the names of its elements unknown. The list counts such errors
     * in a note, instead of keeping them.
     */
    uint32_t cause; /* 1 + index of the missing include; 0: none */
    /* the missing include of the list below, which this list repeats before the first consequence
     */
    const struct diag *cause_below;
    uint32_t num_consequences; /* errors that follow from the cause */
    struct diag_note *note;    /* that says so; NULL: there is none yet */
    uint32_t last;             /* index of the last diagnostic that is not a note */
    bool muted_notes;          /* the last diagnostic was dropped, so its notes are dropped, too */
};

void diag_list_init(struct diag_list *list, struct arena *arena);
/* A list whose messages nobody reads: it has no suggestions, whose search takes time. */
void diag_list_init_unheard(struct diag_list *list, struct arena *arena);

/*
 * Adds a diagnostic; the arguments match the format of the id. A note belongs to the diagnostic
 * before it and is dropped with it. The list counts one that it has already, of the same place and
 * text, and drops it. Copies the name of the file.
 */
void diag_add(struct diag_list *list, enum diag_id id, struct diag_place place, ...);

bool diag_is_same_place(const struct diag_place *a, const struct diag_place *b);
uint32_t diag_hash_place(const struct diag_place *place);

/* Moves the last diagnostic that is no note to another place. Copies the name of the file. */
void diag_move(struct diag_list *list, struct diag_place place);

/*
 * Lets the errors of a list be consequences of a missing include in the list of its document, which
 * outlives it.
 */
void diag_list_follow(struct diag_list *list, const struct diag_list *document);

/* True if the list shows diagnostics of this id: it is neither a remark nor switched off. */
bool diag_is_shown(const struct diag_list *list, enum diag_id id);

/* Adds a copy of a diagnostic of another list. A note belongs to the diagnostic before it. */
void diag_repeat(struct diag_list *list, const struct diag *diag);

/*
 * Makes a policy from the words of -W, separated by commas: "error" makes all warnings errors,
 * "error=ID" one of them, "no-error=ID" none of that id; "no-ID" disables a warning, "ID" enables
 * it (a remark becomes a warning). The order does not matter. Returns NULL, or the first word that
 * is invalid or names no warning.
 */
const char *diag_policy_parse(struct diag_policy *policy, const char *words);

/* The stable id, for example "type-mismatch". */
const char *diag_id_text(enum diag_id id);
bool diag_id_find(const char *stable, size_t len, enum diag_id *out_id);
enum diag_severity diag_id_severity(enum diag_id id); /* in the catalogue */
const char *diag_id_format(enum diag_id id);
const char *diag_severity_text(enum diag_severity severity); /* "error" … */

/* An entry of explain.def. Missing texts are "", not NULL. */
struct diag_explanation {
    const char *cause, *cure;
    const char *example; /* see mxg_diagnostic_kind in catalogue.h */
};
const struct diag_explanation *diag_explain(enum diag_id id);

/*
 * Renders one diagnostic as compilers do:
 *     file:line:col: error: message [id]
 *         <source line>
 *         ^~~~
 * `line`, the source line without its end, may be NULL; a long one is cut around the column.
 * Replaces control characters except tabs. Notes have no id. `colour` adds terminal escapes.
 */
void diag_render(const struct diag *diag, const char *line, size_t line_len, bool colour,
                 struct text *out);

/*
 * A suggestion " (did you mean 'x'?)" for an unknown word: the best candidate, the first of
 * several, or "" if none is close. An alias (aliases.def) is best, then a misspelling, then a name
 * that begins with the word, then a name with the same words and others. It lives in the arena of
 * the list. Each list has a limited number of suggestions, so that the report of a document with
 * many errors takes linear time: if diag_guess_begin returns false, the caller skips the
 * candidates.
 *
 *     struct diag_guess guess;
 *     if (diag_guess_begin(&guess, diags, word))
 *         for (…)
 *             diag_guess_add(&guess, name);
 *     diag_add(diags, …, diag_guess_text(&guess));
 */
enum { DIAG_MAX_ALIASES = 4 }; /* of one word */
struct diag_guess {
    struct diag_list *list;
    const char *word, *best;
    const struct diag_alias *aliases[DIAG_MAX_ALIASES]; /* NULL after the last */
    size_t len, best_distance, best_score;
};
bool diag_may_guess(const struct diag_list *list);
bool diag_guess_begin(struct diag_guess *guess, struct diag_list *list, const char *word);
void diag_guess_add(struct diag_guess *guess, const char *candidate);
const char *diag_guess_text(struct diag_guess *guess);

/* Suggests one of an array of candidates. */
const char *diag_suggest(struct diag_list *list, const char *word, const char *const *candidates,
                         size_t num_candidates);

#endif
