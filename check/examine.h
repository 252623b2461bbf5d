// SPDX-License-Identifier: Apache-2.0
/* Checks one document in a worker and fills its record. */
#ifndef MXG_CHECK_EXAMINE_H
#define MXG_CHECK_EXAMINE_H

#include "check/protocol.h"
#include "program/cli.h"
#include "program/name_table.h"
#include "program/scene_file.h"
#include "program/scratch.h"

struct examiner {
    struct cli *cli;
    struct arg_list targets;
    bool compile, render;
    const char *translate;    /* the model to which surfaces are translated; NULL: none */
    double accept;            /* how far they may look from before; below 0: any distance */
    struct scene_place stage; /* its stacks are the elements; without a file: materials are */
    size_t memory_limit;      /* of this process, in MiB; 0: none */
    struct channel channel;
    bool is_brief;    /* no report needs measures */
    bool errors_only; /* only errors need their printed form */

    struct store store; /* memory for the current document */
    struct check_document *document;
    struct name_table messages; /* indices of the document's messages */
    size_t num_errors;          /* number of reported errors */
    uint32_t last_error;        /* message index of the last one */
    bool is_compiler_ready;
    struct scratch scratch; /* for pictures; empty: not needed yet */
};

/* The record lives until the next call. */
const struct check_document *examine(struct examiner *examiner, const char *path);
void examiner_finish(struct examiner *examiner);

/* The shaders of an element are made of this. */
struct check_subject {
    const mxg_document *document;
    const mxg_bindings *bindings; /* NULL: the element of the document, otherwise a stack */
    uint32_t stack;
};

/* Makes the shaders of an element that has its path and type. */
void examine_element(struct examiner *examiner, const struct check_subject *subject,
                     struct check_element *element);

/* examine_stage.c: binds the stage to the document, and examines the stacks. */
void examine_stage(struct examiner *examiner, const mxg_document *document);

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

/*
 * examine_translation.c: the document with its surfaces as examiner->translate; takes `document`.
 * NULL after a message.
 */
mxg_document *examine_translated(struct examiner *examiner, mxg_document *document);
/* Compares pictures of an element before and after. */
void examine_likeness(struct examiner *examiner, const struct check_element *element);

/* Adds the messages of a list, for a shader or an element. */
void examine_diagnostics(struct examiner *examiner, const mxg_diagnostics *list,
                         struct check_shader *shader, const char *element);
/* Adds a message for a status without a diagnostic. */
void examine_status(struct examiner *examiner, mxg_status status, struct check_shader *shader,
                    const char *element);
/* Adds a message about the current document, or an element of it. */
void examine_tell(struct examiner *examiner, const char *element, mxg_severity severity,
                  const char *id, const char *text);
/* Adds an error in this way, and fails the document. */
void examine_fault(struct examiner *examiner, const char *element, enum check_failure failure,
                   const char *id, const char *text);
/* The folder for pictures, which is made once; NULL: it cannot be made. */
const char *examine_folder(struct examiner *examiner);

/* Adds a message of the current document for a shader and copies its text. */
void examine_add(struct examiner *examiner, struct check_shader *shader,
                 struct check_message message);

/* Milliseconds of a monotonic clock. */
double examine_clock(void);

#endif
