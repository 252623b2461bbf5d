// SPDX-License-Identifier: Apache-2.0
/*
 * Budgets: upper limits for the measures of a shader (measures.def), from the command line or from
 * the nearest mxgen.toml in a document's folder or its parents. A limit on the command line
 * overrides the file; a limit for one target overrides a limit for all.
 */
#ifndef MXG_CHECK_MEASURE_BUDGET_H
#define MXG_CHECK_MEASURE_BUDGET_H

#include "check/record.h"

struct cli;

struct budget_rule {
    enum measure measure;
    const char *target; /* "": all targets */
    uint64_t limit;
};

struct budget_rules {
    struct budget_rule *items;
    size_t len;
};

enum { NUM_BUDGET_FOLDERS = 256 };

struct budget {
    struct store store;
    const struct cli *cli; /* whose targets, sandbox and limits hold for mxgen.toml */
    uint64_t num_unjudged; /* shaders with a budget of instructions that were not compiled */
    struct budget_folder {
        char *name; /* NULL: free entry */
        char *file; /* the nearest file in or above the folder; NULL: none */
        /*
         * recently used folders, at the index from their hash; a run assumes that they do not
         * change
         */
    } folders[NUM_BUDGET_FOLDERS];
    struct budget_rules command_line;
    struct budget_file {
        struct store store;
        char *folder;     /* the folder of its documents; NULL: no search yet */
        const char *path; /* NULL: no file */
        struct budget_rules rules;
        struct check_message fault; /* id: NULL without a fault */
        /*
         * files for the last document that went to a worker, and for the last one that was judged
         */
    } given, judged;
};

/* Parses "2000" or "glsl=2000,essl=1500". False after a message. */
bool budget_add(struct budget *budget, enum measure measure, const char *text);
void budget_finish(struct budget *budget);

/* True if a document has a budget file, even a faulty one. */
bool budget_has_file(struct budget *budget, const char *document);

/* Fails shaders that exceed their budget, with a message that names their largest parts. */
void budget_judge(struct budget *budget, struct store *store, struct check_document *document);

/* budget_file.c: reports that a file cannot be read. */
void budget_refuse_toml(struct store *store, const char *path, const char *reason,
                        struct check_message *fault);
/* budget_file.c: reads rules from the text of a file; *fault receives the first error, in the
 * store. */
void budget_read_toml(const struct cli *cli, struct store *store, const char *path,
                      const char *text, struct budget_rules *out, struct check_message *fault);

void budget_add_rule(struct store *store, struct budget_rules *rules, struct budget_rule rule);

#endif
