// SPDX-License-Identifier: Apache-2.0
/*
 * The files that Assimp opens for a mesh or a stage: those that a document may read
 * (mxg_context_file_fault), and a limited number of them. While it reads them, the memory of the
 * program and its time are limited by their size, and a crash of Assimp ends the program with a
 * message.
 */
#ifndef MXG_RENDER_IMPORT_FILES_H
#define MXG_RENDER_IMPORT_FILES_H

#include <mxgen/mxgen.h>

#include <assimp/cfileio.h>

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

struct import_files {
    const mxg_context *context;
    const char *path; /* that the user names; it may be a link to anywhere */
    struct aiFileIO io;
    char fault[200]; /* why the first refused file was refused; "": none was */
    unsigned num_opened;
    uint64_t size, data_before; /* bytes of the files; of the program's data before */
};

/* Begins to import. The struct stays where it is until import_files_end. */
void import_files_begin(struct import_files *files, const mxg_context *context, const char *path);
/* Ends all limits. */
void import_files_end(struct import_files *files);

#endif
