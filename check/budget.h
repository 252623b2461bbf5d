// SPDX-License-Identifier: Apache-2.0
/*
 * Budgets: how much a shader may have of what is measured (measures.def), by the command line or by
 * the file mxgen.toml that lies nearest above a document. What the command line says about a
 * measure holds; otherwise what the file says; for a target before what is said for all.
 */
#ifndef MXG_CHECK_BUDGET_H
#define MXG_CHECK_BUDGET_H

#include "check/record.h"

struct budget_rule {
    enum measure measure;
    const char *target; /* "": all */
    uint64_t limit;
};

struct budget_rules {
    struct budget_rule *items;
    size_t len;
};

enum { NUM_BUDGET_FOLDERS = 256 };

struct budget {
    struct store store;
    struct budget_folder {
        char *name; /* NULL: free */
        char *file; /* the nearest in it and above it; NULL: there is none */
        /* that were looked into lately, each where its hash says: nothing changes during a run */
    } folders[NUM_BUDGET_FOLDERS];
    struct budget_rules command_line;
    struct budget_file {
        struct store store;
        char *folder;     /* of the documents that it is for; NULL: none was looked for yet */
        const char *path; /* NULL: there is none */
        struct budget_rules rules;
        struct check_message fault; /* id: NULL where there is none */
        /* those of the folders of the last document that was given out, and that was judged */
    } given, judged;
};

/* Takes "2000" or "glsl=2000,essl=1500". False after telling what is wrong. */
bool budget_add(struct budget *budget, enum measure measure, const char *text);
void budget_finish(struct budget *budget);

/* Whether a file has budgets, or a fault, for a document. */
bool budget_has_file(struct budget *budget, const char *document);

/* Fails what is over its budget, with a message that names what it is made of. */
void budget_judge(struct budget *budget, struct store *store, struct check_document *document);

/* toml.c: the fault of a file that cannot be read. */
void budget_refuse_toml(struct store *store, const char *path, const char *reason,
                        struct check_message *fault);
/* toml.c: reads rules from the text of a file; *fault gets the first error, in the store. */
void budget_read_toml(struct store *store, const char *path, const char *text,
                      struct budget_rules *out, struct check_message *fault);

void budget_add_rule(struct store *store, struct budget_rules *rules, struct budget_rule rule);

#endif
