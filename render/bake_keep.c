// SPDX-License-Identifier: Apache-2.0
/* Files of images that stay: they must exist, and can be copied. */
#define _POSIX_C_SOURCE 200809L
#include "render/bake.h"

#include "program/files.h"
#include "program/memory.h"

#include <errno.h>
#include <glob.h>
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
static const char *copy(struct batch *batch, const char *from, const char *to)
{
    size_t size = 0;
    char *data = files_read(from, &size);
    const char *reason = data ? batch_write(batch, to, data, size) : strerror(errno);
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

/* ---- Sets of files: tiles and frames ---- */

/* The patterns of glob(7) for tokens in file names. */
static const struct {
    const char *token, *pattern;
} tokens[] = {{"<UDIM>", "[0-9][0-9][0-9][0-9]"}, {"<UVTILE>", "u[0-9]*_v[0-9]*"}, {"{", "[0-9]*"}};

/* Length of the token at the start of a name, with its pattern; 0: there is none. */
static size_t read_token(const char *name, const char **out_pattern)
{
    for (size_t i = 0; i < sizeof tokens / sizeof *tokens; ++i) {
        const char *end = strchr(name, '}');
        size_t len = strlen(tokens[i].token);
        if (strncmp(name, tokens[i].token, len) != 0 || (*name == '{' && !end))
            continue;
        *out_pattern = tokens[i].pattern;
        return *name == '{' ? (size_t)(end - name) + 1 : len;
    }
    return 0;
}

/* The pattern of the files that a path stands for. The caller frees it. */
static char *pattern_of(const char *path)
{
    static const char special[] = "*?[]\\";
    char *out = NULL;
    size_t size;
    FILE *text = open_memstream(&out, &size);
    while (text && *path) {
        const char *pattern = NULL;
        size_t len = read_token(path, &pattern);
        if (len)
            fputs(pattern, text);
        else
            fprintf(text, "%s%c", strchr(special, *path) ? "\\" : "", *path);
        path += len ? len : 1;
    }
    if (!text || fclose(text) != 0)
        memory_fail();
    return out;
}

static bool copy_to(struct baking *baking, const char *from, const char *name)
{
    char *to = cli_format("%s/%s", baking->options.output, name);
    bool is_free = outputs_read(&baking->files, &baking->cli.report, from)
                   && outputs_write(&baking->files, &baking->cli.report, to, "a copy");
    const char *reason =
        is_free ? mxg_context_file_fault(baking->cli.context, baking->path, from) : NULL;
    if (is_free && !reason)
        reason = copy(&baking->written, from, to);
    if (reason)
        report_error(&baking->cli.report, "output-failed", "cannot copy '%s' to '%s': %s", from, to,
                     reason);
    free(to);
    return is_free && !reason;
}

/*
 * Copies the files of a set. Their names keep what stands for the tile or the frame, and what
 * follows; before it stands a name that is free.
 */
static bool copy_set(struct baking *baking, struct bake_input *input, const char *path)
{
    const char *base = files_base_name(path);
    size_t len = strcspn(base, "<{"), stem_len = len;
    while (stem_len && strchr("._", base[stem_len - 1]))
        --stem_len;
    char *pattern = pattern_of(path), *stem = cli_copy(base, stem_len),
         *free_stem = bake_plan_file(&baking->plan, stem);
    glob_t found = {0};
    bool good = glob(pattern, 0, NULL, &found) == 0 || tell_missing(baking, input->origin, path);
    for (size_t i = 0; good && i < found.gl_pathc; ++i) {
        char *name = cli_format("%s%s", free_stem, files_base_name(found.gl_pathv[i]) + stem_len);
        good = copy_to(baking, found.gl_pathv[i], name);
        free(name);
    }
    input->copy = cli_format("%s%s", free_stem, base + stem_len);
    globfree(&found);
    free(pattern);
    free(stem);
    free(free_stem);
    return good;
}

/* ---- Files that stay ---- */

static bool copy_file(struct baking *baking, struct bake_input *input, const char *path)
{
    input->copy = name_copy(baking, path);
    return copy_to(baking, path, input->copy);
}

/*
 * True if an earlier input has the file, whose copy then serves both. copied: the files so far; the
 * value is the first input that has the file.
 */
static bool shares_copy(struct name_table *copied, struct bake_input *input, const char *path)
{
    bool is_new;
    char *real = outputs_resolve(path);
    struct name_entry *entry = names_add(copied, real, &is_new);
    free(real);
    const struct bake_input *first = (const struct bake_input *)(uintptr_t)entry->value;
    if (is_new)
        entry->value = (uintptr_t)input;
    else if (first->copy)
        input->copy = cli_format("%s", first->copy);
    return !is_new;
}

static bool keep_file(struct baking *baking, struct name_table *copied, struct bake_input *input)
{
    const char *file = bake_attribute(baking->document, input->origin, "value");
    if (!*file)
        return true;
    char *path = bake_file_path(baking->document, baking->path, input->origin, file);
    bool is_set = bake_is_set(path), copies = baking->options.copy, good = true;
    if (copies && shares_copy(copied, input, path))
        good = true;
    else if (is_set && copies && !bake_is_set(files_base_name(path)) && !baking->cli.quiet)
        fprintf(stderr, "note: '%s' stands for files of several folders, which stay there\n", path);
    else if (is_set)
        good = !copies || copy_set(baking, input, path);
    else if (!files_is_regular(path))
        good = tell_missing(baking, input->origin, path);
    else
        good = copies ? copy_file(baking, input, path)
                      : outputs_read(&baking->files, &baking->cli.report, path);
    free(path);
    return good;
}

bool bake_keep_files(struct baking *baking)
{
    bool good = true;
    struct name_table copied = {0};
    for (size_t i = 0; i < baking->plan.num_nodes; ++i)
        for (size_t k = 0; k < baking->plan.nodes[i].num_inputs; ++k) {
            struct bake_input *input = &baking->plan.nodes[i].inputs[k];
            if (input->way == BAKE_KEEPS && strcmp(input->type, "filename") == 0)
                good = keep_file(baking, &copied, input) && good;
        }
    names_finish(&copied);
    return good;
}
