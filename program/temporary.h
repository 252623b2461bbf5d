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

/* The end of the names of files that replace others: only mxgen makes files that end so. */
#define TEMPORARY_SUFFIX ".mxgen.tmp"

/*
 * Opens a file or folder of this user and locks it: `flags` of open(2), `mode` of flock(2). Whoever
 * ends the process ends the lock. -1: another process has it, or has removed it.
 */
int temporary_lock(const char *path, int flags, int mode);
/*
 * Removes files in a folder that end with TEMPORARY_SUFFIX and that nobody locks: their processes
 * were killed. Looks at a folder about once in a process.
 */
void temporary_sweep(const char *folder);

/* Notes a file before it exists; the caller keeps the name alive until temporary_forget. */
void temporary_note(const char *path);
/* After the file got its name, or was removed. */
void temporary_forget(const char *path);

#endif
