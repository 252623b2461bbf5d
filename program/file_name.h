// SPDX-License-Identifier: Apache-2.0
/*
 * File names from names in documents, and file names in the syntax of make. A document may come
 * from an attacker, so no control character leaves in either.
 */
#ifndef MXG_PROGRAM_FILE_NAME_H
#define MXG_PROGRAM_FILE_NAME_H

#include <stdbool.h>
#include <stdio.h>

/*
 * A path with '_' for each character that no file name should have: controls (C0, C1, DEL, line
 * separators, changes of direction), bytes that are no UTF-8, and characters that make cannot read
 * in a name (; = | \ and a first ~) or reads as a pattern (% * ? [). If one was replaced, a hash of
 * the whole name stands at the end, so that names stay distinct. The caller frees it.
 */
char *file_name_clean(const char *path);

/*
 * The file name for an element: its path with dots, clean, and no longer than file systems allow.
 * The caller frees it.
 */
char *file_name_of_element(const char *element_path);

/*
 * Writes a file name in make's syntax: spaces, '#' and ':' escaped, '$' doubled. False, and writes
 * nothing, if make or ninja cannot read such a name, or if a target is a pattern to make.
 */
bool file_name_put_make(FILE *out, const char *name, bool is_target);

#endif
