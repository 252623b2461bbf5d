// SPDX-License-Identifier: Apache-2.0
/*
 * Files that have no final name yet. If a signal that a user, a terminal, a closed pipe or a limit
 * of file sizes sends ends the program, it removes them first.
 */
#ifndef MXG_PROGRAM_TEMPORARY_H
#define MXG_PROGRAM_TEMPORARY_H

/*
 * "BEFORE.", eight random digits, "AFTER": the name of a file that no other process makes, whatever
 * its number. The caller frees it. NULL: out of memory.
 */
char *temporary_name(const char *before, const char *after);

/* Notes a file before it exists; the caller keeps the name alive until temporary_forget. */
void temporary_note(const char *path);
/* After the file got its name, or was removed. */
void temporary_forget(const char *path);

#endif
