// SPDX-License-Identifier: Apache-2.0
/* The files of the command `mxgen FILE` share these declarations. */
#ifndef MXG_CLI_GENERATE_H
#define MXG_CLI_GENERATE_H

#include "program/cli.h"
#include "program/output_files.h"

struct generate {
    struct cli cli;
    const char *target, *output, *depfile;
    const char *scene_file, *look, *purpose; /* of a scene */
    struct arg_list elements;                /* empty: every renderable */
    bool to_stdout, reflect;

    mxg_target target_info;
    bool is_network;                    /* --osl-network */
    bool is_deferred;                   /* --role deferred */
    const char *module;                 /* --mdl-module; NULL: not given */
    bool is_file;                       /* -o names one file: a stage of one element */
    mxg_stage stage;                    /* this stage */
    struct arg_list documents, folders; /* each document with its output folder; allocated */
    struct outputs files;               /* all files that the command reads or writes */
    struct arg_list outputs, sources;   /* for the depfile; items are allocated */
    struct name_table known_sources;    /* the names in `sources` */
};

/* Writes the files of a shader. */
void generate_write(struct generate *gen, const char *folder, const char *element,
                    const mxg_result *result);
/* Notes a file that output depends on. False after an error: an output has its name. */
/* Writes the depth pass of a cut-out that stores: "Leaf.depth.frag". */
void generate_write_cuts(struct generate *gen, const mxg_document *document, const char *folder,
                         const mxg_generate_desc *desc, const mxg_result *stored);
bool generate_add_source(struct generate *gen, const char *file);
/*
 * Claims every file that an element may have, so that no name clashes after the first is written.
 */
bool generate_claim(struct generate *gen, const char *folder, const char *element);
bool generate_make_folder(struct generate *gen, const char *folder);

/* stacks.c: the shaders of a scene's stacks, and bindings.json. */
void generate_stacks(struct generate *gen, const mxg_document *document, const char *folder);

#endif
