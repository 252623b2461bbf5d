// SPDX-License-Identifier: Apache-2.0
/* The files that are outside of the server: on the disk, or in WebAssembly those of the host
 * (js/native/lsp.c). */
#ifndef MXG_LSP_SYSTEM_H
#define MXG_LSP_SYSTEM_H

#include <stdbool.h>
#include <stddef.h>

/*
 * The bytes of a regular file with a NUL after them, which the caller frees; NULL with errno. At
 * most `limit` bytes from its begin; 0: all.
 */
char *system_read(const char *path, size_t limit, size_t *out_size);

/*
 * Writes the names in a folder, each with its NUL; folders end with '/'. Returns the number of
 * bytes that all names need; `names` is undefined if they are more than `capacity`.
 */
size_t system_list(const char *folder, char *names, size_t capacity);

/* True if the path is a link, also one to nowhere. */
bool system_is_link(const char *path);

#endif
