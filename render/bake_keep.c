// SPDX-License-Identifier: Apache-2.0
/* Files of images that stay: they must exist, and can be copied. */
#include "render/bake.h"

#include "program/files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

char *bake_place(const struct baking *baking, mxg_element element)
{
    char *path = bake_path(baking->document, element);
    const mxg_document *source = baking->source ? baking->source : baking->document;
    mxg_element there = baking->source ? mxg_document_find_element(source, 0, path) : element;
    mxg_element_info info = bake_element(source, there);
    const char *file = info.file ? info.file : baking->path;
    free(path);
    return there ? cli_format("%s:%u:%u", file, info.line, info.column) : cli_format("%s", file);
}

static bool tell_missing(struct baking *baking, mxg_element origin, const char *path)
{
    void (*tell)(struct report * report, const char *id, const char *format, ...) =
        baking->painter.checker ? report_warning : report_error;
    char *place = bake_place(baking, origin);
    tell(&baking->cli.report, "missing-texture", "there is no file '%s' (%s)", path, place);
    free(place);
    return baking->painter.checker;
}

/* Returns NULL, or the reason for a failure. */
static const char *copy(const char *from, const char *to)
{
    size_t size = 0;
    char *data = files_read(from, &size);
    const char *reason = data ? files_write(to, data, size) : strerror(errno);
    free(data);
    return reason;
}

/* The name of the copy: that of the file, or with a number before it. The caller frees it. */
static char *name_copy(struct baking *baking, const char *path)
{
    const char *base = files_base_name(path), *dot = strrchr(base, '.');
    char *stem = cli_copy(base, dot ? (size_t)(dot - base) : strlen(base));
    char *free_stem = bake_plan_file(&baking->plan, stem);
    char *name = cli_format("%s%s", free_stem, dot ? dot : "");
    free(stem);
    free(free_stem);
    return name;
}

static bool copy_file(struct baking *baking, struct bake_input *input, const char *path)
{
    char *name = name_copy(baking, path), *to = cli_format("%s/%s", baking->options.output, name);
    bool is_free = outputs_write(&baking->files, &baking->cli.report, to, "a copy");
    const char *reason =
        is_free ? copy(path, batch_begin(&baking->written, baking->options.output, name)) : NULL;
    if (reason)
        report_error(&baking->cli.report, "output-failed", "cannot copy '%s' to '%s': %s", path, to,
                     reason);
    input->copy = name;
    free(to);
    return is_free && !reason;
}

static bool keep_file(struct baking *baking, struct bake_input *input)
{
    const char *file = bake_attribute(baking->document, input->origin, "value");
    bool good = true;
    if (!*file)
        return true;
    char *path = bake_file_path(baking->document, baking->path, input->origin, file);
    bool is_there = files_is_regular(path);
    if (bake_is_set(file) && baking->options.copy && !baking->cli.quiet)
        fprintf(stderr, "note: '%s' stands for several files, which stay where they are\n", path);
    if (!bake_is_set(file) && !is_there)
        good = tell_missing(baking, input->origin, path);
    else if (!bake_is_set(file))
        good = outputs_read(&baking->files, &baking->cli.report, path)
               && (!baking->options.copy || copy_file(baking, input, path));
    free(path);
    return good;
}

bool bake_keep_files(struct baking *baking)
{
    bool good = true;
    for (size_t i = 0; i < baking->plan.num_nodes; ++i)
        for (size_t k = 0; k < baking->plan.nodes[i].num_inputs; ++k) {
            struct bake_input *input = &baking->plan.nodes[i].inputs[k];
            if (input->way == BAKE_KEEPS && strcmp(input->type, "filename") == 0)
                good = keep_file(baking, input) && good;
        }
    return good;
}
