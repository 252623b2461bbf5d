// SPDX-License-Identifier: Apache-2.0
/* Checks one document in a worker and fills its record. */
#ifndef MXG_CHECK_EXAMINE_H
#define MXG_CHECK_EXAMINE_H

#include "check/protocol.h"
#include "program/cli.h"
#include "program/name_table.h"

struct examiner {
    struct cli *cli;
    struct arg_list targets;
    bool compile, render;
    size_t memory_limit; /* of this process, in MiB; 0: none */
    struct channel channel;
    bool is_brief;    /* no report needs measures */
    bool errors_only; /* only errors need their printed form */

    struct store store; /* memory for the current document */
    struct check_document *document;
    struct name_table messages; /* indices of the document's messages */
    size_t num_errors;          /* number of reported errors */
    uint32_t last_error;        /* message index of the last one */
    bool is_compiler_ready;
    char *folder; /* folder for pictures; NULL: not needed yet */
};

/* The record lives until the next call. */
const struct check_document *examine(struct examiner *examiner, const char *path);
void examiner_finish(struct examiner *examiner);

/* examine_shader.c: measures and compiles a generated shader. */
void examine_shader(struct examiner *examiner, const mxg_result *result,
                    struct check_shader *shader, const char *element);

/* Records the published inputs and textures of an element, unless another target has done so. */
void examine_settings(struct examiner *examiner, const mxg_result *result,
                      struct check_element *element);

/* examine_picture.c: lists the images of an element; draws its picture. */
void examine_images(struct examiner *examiner, const mxg_result *result);
void examine_picture(struct examiner *examiner, const mxg_document *document,
                     struct check_element *element);
/*
 * examine_slabs.c: the tree of slabs, of a material that has some or that options make slabs of;
 * with a budget its steps, without drawn errors.
 */
void examine_slabs(struct examiner *examiner, const mxg_document *document,
                   struct check_element *element);

/* Adds a message of the current document for a shader and copies its text. */
void examine_add(struct examiner *examiner, struct check_shader *shader,
                 struct check_message message);

/* Milliseconds of a monotonic clock. */
double examine_clock(void);

#endif
