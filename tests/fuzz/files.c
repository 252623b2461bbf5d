// SPDX-License-Identifier: Apache-2.0
#include "files.h"

#include <string.h>

static const char *find_part(const char *at, const char *end)
{
    for (; at && end - at > 3; at = memchr(at, '\n', (size_t)(end - at)), at = at ? at + 1 : NULL)
        if (memcmp(at, "== ", 3) == 0)
            return at;
    return end;
}

void fuzz_files_split(struct fuzz_files *files, const char *data, size_t size)
{
    const char *end = data + size, *at = data;
    *files = (struct fuzz_files){.num = 1};
    snprintf(files->items[0].name, sizeof files->items[0].name, "main.mtlx");
    for (unsigned i = 0; i < FUZZ_MAX_FILES; i++) {
        const char *next = find_part(at, end);
        files->items[i].data = at;
        files->items[i].size = (size_t)(next - at);
        files->num = i + 1;
        const char *line = next < end ? memchr(next, '\n', (size_t)(end - next)) : NULL;
        if (!line || i + 1 == FUZZ_MAX_FILES)
            return;
        size_t len = (size_t)(line - next) - 3;
        char *name = files->items[i + 1].name;
        len = len < sizeof files->items[0].name - 1 ? len : sizeof files->items[0].name - 1;
        memcpy(name, next + 3, len);
        name[len] = '\0';
        at = line + 1;
    }
}

static bool open_part(void *user_data, const char *from, const char *ref, mxg_blob *out_blob,
                      const char **out_reason)
{
    struct fuzz_files *files = user_data;
    (void)from, (void)out_reason;
    for (unsigned i = 0; i < files->num; i++) {
        if (strcmp(files->items[i].name, ref) != 0)
            continue;
        out_blob->name = files->items[i].name;
        out_blob->data = files->items[i].data;
        out_blob->size = files->items[i].size;
        files->num_open++;
        return true;
    }
    return false;
}

static void release_part(void *user_data, mxg_blob *blob)
{
    struct fuzz_files *files = user_data;
    (void)blob;
    FUZZ_REQUIRE(files->num_open > 0);
    files->num_open--;
}

mxg_context *fuzz_files_context(struct fuzz_files *files, struct fuzz_heap *heap,
                                mxg_context_desc desc)
{
    mxg_resolver resolver = {files, open_part, release_part};
    mxg_context *context = NULL;
    desc.size = sizeof desc;
    desc.realloc = heap ? fuzz_realloc : NULL;
    desc.realloc_user_data = heap;
    desc.resolver = &resolver;
    return mxg_context_create(&desc, &context) == MXG_OK ? context : NULL;
}

bool fuzz_is_expected(mxg_status status)
{
    return status == MXG_OK || status == MXG_ERROR_DOCUMENT || status == MXG_ERROR_MEMORY;
}

void fuzz_files_open(const char *data, size_t size, struct fuzz_heap *heap, bool trust,
                     void (*work)(const struct fuzz_document *opened, unsigned choice))
{
    struct fuzz_files files;
    fuzz_files_split(&files, data, size);
    mxg_context_desc limits = {.max_memory = (size_t)256 << 20,
                               .max_elements = 20000,
                               .max_nodes = 50000,
                               .max_output_mib = 4,
                               .trust = trust};
    mxg_context *context = fuzz_files_context(&files, heap, limits);
    mxg_document *document = NULL;
    if (!context)
        return;
    mxg_library *library = mxg_library_builtin(context);
    FUZZ_REQUIRE(fuzz_is_expected(mxg_document_load(context, library, "main.mtlx", &document)));
    if (document)
        work(&(struct fuzz_document){context, library, document, &files},
             fuzz_choice(data, size, 4096));
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    FUZZ_REQUIRE(files.num_open == 0);
}
