// SPDX-License-Identifier: Apache-2.0
/* Functions that wasi-libc lacks. WebAssembly has no files: every reference goes to the resolver.
 */
#define _XOPEN_SOURCE 700
#include "native/posix.h"

#include "native/host.h"

#include <errno.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The working directory is "/", and there are no links. The caller has removed "." and ".." between
 * names. */
char *realpath(const char *restrict path, char *restrict resolved)
{
    bool is_here = *path == '\0' || strcmp(path, ".") == 0;
    size_t len = is_here ? 0 : strlen(path);
    if (len + 2 > PATH_MAX) {
        errno = ENAMETOOLONG;
        return NULL;
    }
    char *real = resolved ? resolved : malloc(len + 2);
    if (!real)
        return NULL;
    snprintf(real, len + 2, "%s%s", *path == '/' ? "" : "/", is_here ? "" : path);
    for (size_t end = strlen(real); end > 1 && real[end - 1] == '/'; --end)
        real[end - 1] = '\0';
    return real;
}

/* Stands in for <assert.h>. That of wasi-libc writes to a stream, which would need input and
 * output. */
_Noreturn void __assert_fail(const char *condition, const char *file, int line,
                             const char *function);

void __assert_fail(const char *condition, const char *file, int line, const char *function)
{
    char message[512];
    snprintf(message, sizeof message, "%s:%d: %s: %s", file, line, function, condition);
    host_abort(message);
}
