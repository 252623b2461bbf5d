// SPDX-License-Identifier: Apache-2.0
#include "program/batch.h"

#include "program/cli.h"
#include "program/memory.h"
#include "program/temporary.h"

#include <stdio.h>
#include <stdlib.h>

const char *batch_begin(struct batch *batch, const char *folder, const char *name)
{
    char *stem = cli_format("%s/.tmp", folder), *after = cli_format("-%s", name);
    struct batch_file file = {temporary_name(stem, after), cli_format("%s/%s", folder, name)};
    free(stem);
    free(after);
    if (!file.temporary)
        memory_fail();
    temporary_note(file.temporary);
    batch->items = memory_resize(batch->items, (batch->num + 1) * sizeof *batch->items);
    batch->items[batch->num++] = file;
    return file.temporary;
}

bool batch_end(struct batch *batch, struct report *report, bool keep)
{
    for (size_t i = 0; i < batch->num; ++i) {
        struct batch_file *file = &batch->items[i];
        if (keep && rename(file->temporary, file->path) != 0) {
            report_error(report, "output-failed", "cannot write '%s'", file->path);
            keep = false;
        }
        if (!keep)
            remove(file->temporary);
        temporary_forget(file->temporary);
        free(file->temporary);
        file->temporary = NULL;
    }
    return keep;
}

void batch_remove(struct batch *batch)
{
    for (size_t i = 0; i < batch->num; ++i) {
        const struct batch_file *file = &batch->items[i];
        remove(file->temporary ? file->temporary : file->path);
        if (file->temporary)
            temporary_forget(file->temporary);
    }
    batch_finish(batch);
}

void batch_finish(struct batch *batch)
{
    for (size_t i = 0; i < batch->num; ++i) {
        free(batch->items[i].temporary);
        free(batch->items[i].path);
    }
    free(batch->items);
    *batch = (struct batch){0};
}
