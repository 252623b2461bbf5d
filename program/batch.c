// SPDX-License-Identifier: Apache-2.0
#define _XOPEN_SOURCE 700
#include "program/batch.h"

#include "program/cli.h"
#include "program/memory.h"

#include <stdlib.h>
#include <sys/resource.h>

/* Files stay open until the end: a set of tiles is more than the usual limit of a shell. */
static void allow_many_files(void)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < limit.rlim_max) {
        limit.rlim_cur = limit.rlim_max;
        setrlimit(RLIMIT_NOFILE, &limit);
    }
}

const char *batch_begin(struct batch *batch, const char *path, const struct files_stream **out)
{
    struct batch_file file = {.path = NULL};
    if (!batch->num)
        allow_many_files();
    const char *reason = files_begin(&file.stream, path);
    if (reason)
        return reason;
    file.path = cli_format("%s", path);
    MEMORY_PUSH(batch->items, batch->num, file);
    *out = &batch->items[batch->num - 1].stream;
    return NULL;
}

const char *batch_write(struct batch *batch, const char *path, const void *data, size_t size)
{
    const struct files_stream *stream;
    const char *reason = batch_begin(batch, path, &stream);
    if (!reason)
        fwrite(data, 1, size, stream->out); /* batch_end tells of a fault */
    return reason;
}

bool batch_end(struct batch *batch, struct report *report, bool keep)
{
    for (size_t i = 0; i < batch->num; ++i) {
        struct batch_file *file = &batch->items[i];
        const char *reason = files_end(&file->stream, keep);
        if (reason) {
            report_error(report, "output-failed", "cannot write '%s': %s", file->path, reason);
            keep = false;
        }
        free(file->path);
    }
    free(batch->items);
    *batch = (struct batch){0};
    return keep;
}
