// SPDX-License-Identifier: Apache-2.0
/* What a worker does with a document: everything that a record tells. */
#ifndef MXG_CHECK_EXAMINE_H
#define MXG_CHECK_EXAMINE_H

#include "check/protocol.h"
#include "cli/cli.h"

struct examiner {
    struct cli *cli;
    struct arg_list targets;
    bool compile, render;
    struct channel channel;
    bool is_brief;    /* nobody asks for measures */
    bool errors_only; /* nobody reads how other messages are printed */

    struct store store; /* of the document at hand */
    struct check_document *document;
    uint32_t *messages;  /* of it, in a table by what they tell: indices from 1, 0: free */
    size_t capacity;     /* of the table */
    size_t num_errors;   /* that are told */
    uint32_t last_error; /* the message of the last of them */
    bool is_compiler_ready;
    char *folder; /* for pictures; NULL: not needed yet */
};

/* The record lives until the next call. */
const struct check_document *examine(struct examiner *examiner, const char *path);
void examiner_finish(struct examiner *examiner);

/* examine_shader.c: what was generated is measured and compiled. */
void examine_shader(struct examiner *examiner, const mxg_result *result,
                    struct check_shader *shader, const char *element);

/* examine_picture.c: which images its picture shows; draws an element. */
void examine_images(struct examiner *examiner, const mxg_result *result);
void examine_picture(struct examiner *examiner, struct check_element *element);

/* Adds a message of the current document for a shader; its text is copied. */
void examine_add(struct examiner *examiner, struct check_shader *shader,
                 struct check_message message);

/* Milliseconds of a clock that only goes forward. */
double examine_clock(void);

#endif
