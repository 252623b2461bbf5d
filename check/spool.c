// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "check/spool.h"

#include "program/files.h"
#include "program/scratch.h"

#include <errno.h>
#include <string.h>

FILE *spool_begin(void)
{
    int fd = files_open_unnamed(scratch_root());
    return fd >= 0 ? fdopen(fd, "w+") : NULL;
}

const char *spool_end(FILE *spool, FILE *out)
{
    char buffer[1 << 14];
    size_t size;
    if (!spool)
        return NULL;
    errno = 0;
    bool good = fflush(spool) == 0 && !ferror(spool);
    rewind(spool);
    while (good && (size = fread(buffer, 1, sizeof buffer, spool)) > 0)
        fwrite(buffer, 1, size, out);
    good = good && !ferror(spool);
    const char *reason = good ? NULL : strerror(errno ? errno : EIO);
    fclose(spool);
    return reason;
}
