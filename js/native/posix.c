// SPDX-License-Identifier: Apache-2.0
/* Functions that wasi-libc lacks. WebAssembly has no files: every reference goes to the resolver.
 */
#define _XOPEN_SOURCE 700
#include "native/posix.h"

#include "native/host.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

char *realpath(const char *restrict path, char *restrict resolved)
{
    (void)path;
    (void)resolved;
    errno = ENOENT;
    return NULL;
}

/* Of <assert.h>. That of wasi-libc writes to a stream, which would need input and output. */
_Noreturn void __assert_fail(const char *condition, const char *file, int line,
                             const char *function);

void __assert_fail(const char *condition, const char *file, int line, const char *function)
{
    char message[512];
    snprintf(message, sizeof message, "%s:%d: %s: %s", file, line, function, condition);
    host_abort(message);
}
