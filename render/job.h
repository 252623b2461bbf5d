// SPDX-License-Identifier: Apache-2.0
/*
 * A run of mxgen-render: its arguments, its files, the scene that it draws, and the elements. The
 * functions report errors to job->cli.report.
 */
#ifndef MXG_RENDER_JOB_H
#define MXG_RENDER_JOB_H

#include "program/cli.h"
#include "program/output_files.h"
#include "program/render_options.h"
#include "render/picture.h"
#include "render/site.h"

/* The studio takes any mesh. The other scenes are fixed, for tests and patterns. */
enum scene_kind { SCENE_STUDIO, SCENE_SPHERE, SCENE_PLANE, SCENE_GRID, NUM_SCENES };

struct job {
    struct cli cli;
    struct render_options options;
    struct painter painter;
    enum scene_kind scene_kind;
    double layer_sample; /* below 0: not given */
    struct site site;
    struct bind_value *values;
    struct arg_list found; /* documents, including those in folders; allocated */
    struct outputs files;  /* files that the command reads or writes */
};

/* ---- job_arguments.c ---- */

/* Takes the options to the painter and to generation; false after printing an error. */
bool job_parse(struct job *job);
void job_free_values(struct bind_value *values, size_t count);
/* The facts that decide which options apply: bits of enum render_fact. */
unsigned job_find_facts(const struct job *job, bool is_grid, bool is_one);
/* True if a file of one picture has channels for AOVs. */
bool job_writes_channels(const struct job *job);
/* True if --camera is the path of a camera on the stage. */
bool job_names_camera(const struct job *job);
/* True if --show draws colours by slot, and not a view of what is stored. */
bool job_shows_slots(const struct job *job);

/* ---- job_scene.c ---- */

/* Makes the scene or the stage, and opens the device. */
bool job_prepare(struct job *job);
void job_tell_bad_environment(struct job *job, const char *name, const struct image *map);

/* ---- job_files.c ---- */

/* Finds the documents, and notes all files; false if a picture would overwrite one of them. */
bool job_claim_files(struct job *job);
/* Loads a document and notes its files. NULL after an error; the caller destroys it. */
mxg_document *job_load(struct job *job, const char *path);
/* "turn.png" becomes "turn.0007.png". The caller frees it. */
char *job_frame_name(const char *output, size_t frame);

/* ---- job_elements.c ---- */

/* Renders one picture of the first element, or of the requested one; or a turntable of it. */
void job_render_file(struct job *job, const char *path);
/* Renders all elements of the found documents, as one picture or as a contact sheet. */
void job_render_all(struct job *job);

#endif
