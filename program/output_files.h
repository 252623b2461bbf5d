// SPDX-License-Identifier: Apache-2.0
/*
 * The files that a command reads and writes. A file that would be both, or that two outputs would
 * write, is an error before the command writes anything.
 */
#ifndef MXG_PROGRAM_OUTPUT_FILES_H
#define MXG_PROGRAM_OUTPUT_FILES_H

#include "program/args.h"
#include "program/name_table.h"
#include "program/report.h"

/* Zero-initialise it. */
struct outputs {
    struct name_table paths; /* absolute paths without links; the values count the uses */
    struct output_use *uses;
    size_t num_uses;
};

/*
 * The absolute path without links; of a missing file, the path of its closest existing folder and
 * the rest. The caller frees it.
 */
char *outputs_resolve(const char *path);

/*
 * Notes that the command reads a file. False after an error: an output has the same path.
 */
bool outputs_read(struct outputs *outputs, struct report *report, const char *path);

/*
 * Notes that the command writes a file for `owner`: "--json", "element 'Gold'". False after an
 * error: the command reads the file, or another owner writes it. Standard output is "-". Only
 * /dev/null can have several owners.
 */
bool outputs_write(struct outputs *outputs, struct report *report, const char *path,
                   const char *owner);

/* True if outputs_write has noted the path. */
bool outputs_has(const struct outputs *outputs, const char *path);

void outputs_finish(struct outputs *outputs);

/* For a command with one output, or NULL: false after an error, because it is an input. */
bool outputs_claim(const struct arg_list *inputs, struct report *report, const char *output);

#endif
