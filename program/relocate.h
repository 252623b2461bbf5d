// SPDX-License-Identifier: Apache-2.0
/* A document for another folder: the names of its files lead to the same files from there. */
#ifndef MXG_PROGRAM_RELOCATE_H
#define MXG_PROGRAM_RELOCATE_H

#include "program/cli.h"

/* The folder of a file as an absolute path with a '/' at its end; NULL with errno. The caller frees
 * it. */
char *relocate_folder(const char *file);
/* The way from one such folder to another: "../../textures/"; "" to itself. The caller frees it. */
char *relocate_way(const char *from, const char *to);

/* The path of a file as a document in a folder names it. The caller frees it. */
char *relocate_file(const char *folder, const char *path);

/*
 * `document`, whose files are relative to `from`, as a document at `to` (both are files); it stays
 * itself where both have one folder. Each relative `fileprefix` gets the way between the folders
 * before it. Ends `document` if it makes another one. NULL after a message.
 */
mxg_document *relocate(struct cli *cli, mxg_document *document, const char *from, const char *to);

#endif
