// SPDX-License-Identifier: Apache-2.0
/*
 * The parts that tests of the public interface share: an allocator that counts and fails, edits,
 * files in memory, messages.
 */
#ifndef MXG_TESTS_API_FIXTURE_H
#define MXG_TESTS_API_FIXTURE_H

#include "tests/unit/test.h"

#include <mxgen/mxgen.h>
#include <mxgen/reflection.h>

#include <stdlib.h>

/* ---- Memory: each block knows its size, so that what mxgen says of it is checked ---- */

struct heap {
    size_t held, peak;
    unsigned calls;   /* that asked for memory */
    unsigned fail_at; /* this one fails, and ... */
    bool fails_from;  /* ... all behind it; 0: none */
    unsigned wrong_sizes;
};

union heap_header {
    size_t size;
    max_align_t align;
};

static inline void *heap_realloc(void *user_data, void *block, size_t old_size, size_t new_size)
{
    struct heap *heap = user_data;
    union heap_header *header = block ? (union heap_header *)block - 1 : NULL;
    heap->wrong_sizes += old_size != (header ? header->size : 0);
    if (new_size && ++heap->calls >= heap->fail_at && heap->fail_at
        && (heap->fails_from || heap->calls == heap->fail_at))
        return NULL;
    heap->held += new_size - old_size;
    heap->peak = heap->held > heap->peak ? heap->held : heap->peak;
    if (new_size == 0) {
        free(header);
        return NULL;
    }
    header = realloc(header, sizeof *header + new_size);
    if (!header)
        abort();
    header->size = new_size;
    return header + 1;
}

/* ---- Edits ---- */

static inline mxg_status commit(mxg_edit *edit, mxg_document **out_document)
{
    mxg_status status = mxg_edit_commit(edit, out_document);
    mxg_edit_destroy(edit);
    return status;
}

/* ---- Shaders ---- */

static inline mxg_result *generate_reduced(mxg_context *context, const mxg_document *document,
                                           const char *element)
{
    mxg_options *options = NULL;
    mxg_result *result = NULL;
    mxg_options_create(context, &options);
    mxg_options_set(options, "interface", "reduced");
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "glsl";
    desc.element = element;
    desc.options = options;
    REQUIRE_EQ(mxg_generate(context, document, &desc, &result), MXG_OK);
    mxg_options_destroy(options);
    return result;
}

/* True if the pixels of an element have the same program, with the same values. */
static inline bool draws_the_same(mxg_context *context, const mxg_document *a,
                                  const mxg_document *b, const char *element)
{
    mxg_result *before = generate_reduced(context, a, element),
               *after = generate_reduced(context, b, element);
    mxg_change change = mxg_result_change(before, after, NULL, 0, NULL);
    mxg_result_destroy(before);
    mxg_result_destroy(after);
    return change == MXG_CHANGE_NOTHING;
}

/* ---- Elements by their paths; 0: there is none ---- */

static inline mxg_element element_at(const mxg_document *document, const char *path)
{
    return mxg_document_find_element(document, 0, path);
}

static inline mxg_element edited_at(const mxg_edit *edit, const char *path)
{
    return mxg_edit_find_element(edit, 0, path);
}

/* ---- Texts ---- */

/* A `write` of the interface. user_data: a char *, NULL at first, which is to be freed. */
static inline bool append(void *user_data, const char *data, size_t size)
{
    char **text = user_data;
    size_t len = *text ? strlen(*text) : 0;
    char *grown = realloc(*text, len + size + 1);
    if (!grown)
        return false;
    memcpy(grown + len, data, size);
    grown[len + size] = '\0';
    *text = grown;
    return true;
}

/* A document on the built-in library; it must have no error. */
static inline mxg_document *parse_builtin(mxg_context *context, const char *text)
{
    mxg_document *document = NULL;
    mxg_library *library = mxg_library_builtin(context);
    REQUIRE_EQ(mxg_document_parse(context, library, "test.mtlx", text, strlen(text), &document),
               MXG_OK);
    mxg_library_unref(library);
    return document;
}

/* ---- Files in memory ---- */

struct memory_file {
    const char *name, *text; /* text NULL: it is there but cannot be read */
};

struct memory_files {
    const struct memory_file *files; /* up to one without name */
    unsigned num_open, num_opened, num_released;
    unsigned fail_at; /* this opening fails; 0: none */
};

static inline bool memory_open(void *user_data, const char *from, const char *ref,
                               mxg_blob *out_blob, const char **out_reason)
{
    struct memory_files *files = user_data;
    (void)from;
    if (files->fail_at && --files->fail_at == 0) {
        *out_reason = "this opening fails";
        return false;
    }
    for (const struct memory_file *file = files->files; file->name; file++) {
        if (strcmp(file->name, ref) != 0)
            continue;
        out_blob->name = file->name;
        if (!file->text) {
            *out_reason = "it is locked";
            return false;
        }
        out_blob->data = file->text;
        out_blob->size = strlen(file->text);
        out_blob->handle = files;
        files->num_open++;
        files->num_opened++;
        return true;
    }
    return false;
}

static inline void memory_release(void *user_data, mxg_blob *blob)
{
    struct memory_files *files = user_data;
    if (blob->handle != files || files->num_open == 0)
        abort();
    files->num_open--;
    files->num_released++;
}

static inline mxg_resolver memory_resolver(struct memory_files *files)
{
    return (mxg_resolver){files, memory_open, memory_release, NULL};
}

/* ---- Messages ---- */

static inline bool has_diagnostic(const mxg_diagnostics *list, const char *id)
{
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); i++) {
        mxg_diagnostic diagnostic = {sizeof diagnostic};
        if (mxg_diagnostics_item(list, i, &diagnostic) == MXG_OK && strcmp(diagnostic.id, id) == 0)
            return true;
    }
    return false;
}

#endif
