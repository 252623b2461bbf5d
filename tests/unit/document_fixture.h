// SPDX-License-Identifier: Apache-2.0
/*
 * A document read from text, with files that exist only in a table, and its diagnostics as one line
 * of text.
 */
#ifndef MXG_TESTS_DOCUMENT_FIXTURE_H
#define MXG_TESTS_DOCUMENT_FIXTURE_H

#include "base/trap.h"
#include "xml/reader.h"

#include "test.h"

#include <stdlib.h>

struct fixture_file {
    const char *name, *text;
};

struct fixture {
    size_t allocations_left; /* the one after these fails */
    size_t held;
    unsigned num_open;
    const struct fixture_file *files; /* ends with a NULL name */
    struct mem mem;
    struct trap trap;
    struct arena arena;
    struct strpool strings;
    struct document doc;
    struct diag_list diags;
    bool read; /* what the reader returned */
};

static void *fixture_realloc(void *user_data, void *block, size_t old_size, size_t new_size)
{
    struct fixture *f = user_data;
    if (new_size && f->allocations_left == 0)
        return NULL;
    f->allocations_left -= new_size > 0;
    f->held = f->held - old_size + new_size;
    if (new_size)
        return realloc(block, new_size);
    free(block);
    return NULL;
}

/* Names are found as they are written, without folders. */
static bool fixture_open_file(void *user_data, const char *from, const char *ref,
                              const char **out_name, const char **out_data, size_t *out_size,
                              void **out_handle, const char **out_reason)
{
    struct fixture *f = user_data;
    (void)from;
    const struct fixture_file *file = f->files;
    while (file && file->name && strcmp(file->name, ref) != 0)
        file++;
    *out_reason = "no such file";
    if (!file || !file->name)
        return false;
    f->num_open++;
    *out_name = file->name;
    *out_data = file->text;
    *out_size = strlen(file->text);
    *out_handle = NULL;
    return true;
}

static void fixture_release(void *user_data, void *handle)
{
    (void)handle;
    ((struct fixture *)user_data)->num_open--;
}

static inline void fixture_init(struct fixture *f)
{
    memset(f, 0, sizeof *f);
    f->allocations_left = SIZE_MAX;
    mem_init(&f->mem, fixture_realloc, f);
    f->mem.trap = &f->trap;
    arena_init(&f->arena, &f->mem);
}

static inline void fixture_read_bytes(struct fixture *f, const char *bytes, size_t size,
                                      const struct xml_limits *limits)
{
    struct xml_files files = {f, fixture_open_file, fixture_release};
    strpool_init(&f->strings, &f->arena, NULL);
    diag_list_init(&f->diags, &f->arena);
    doc_init(&f->doc, &f->arena, &f->strings, NULL);
    f->read = xml_read_memory(&f->doc, &files, limits, "test.mtlx", bytes, size, &f->diags);
}

static inline void fixture_read(struct fixture *f, const char *text,
                                const struct fixture_file *files)
{
    fixture_init(f);
    f->files = files;
    fixture_read_bytes(f, text, strlen(text), NULL);
}

static inline void fixture_close(struct fixture *f)
{
    arena_finish(&f->arena);
    REQUIRE_EQ(f->held, 0);
    REQUIRE_EQ(f->num_open, 0);
}

/*
 * "3:7 type-mismatch, b.mtlx:1:1 version-missing": remarks left out, the file where it is not the
 * document itself.
 */
static inline const char *fixture_messages(struct fixture *f)
{
    struct text text;
    text_init(&text, &f->arena);
    for (uint32_t i = 0; i < f->diags.items.len; i++) {
        const struct diag *d = &f->diags.items.items[i];
        if (d->severity == DIAG_REMARK)
            continue;
        text_str(&text, text.len ? ", " : "");
        if (d->place.file && strcmp(d->place.file, "test.mtlx") != 0)
            text_fmt(&text, "%s:", d->place.file);
        text_fmt(&text, "%u:%u %s", d->place.line, d->place.column, diag_id_text(d->id));
    }
    return text_cstr(&text);
}

/* The tree as XML, without the declaration and <materialx> itself. */
static inline const char *fixture_tree(struct fixture *f)
{
    struct text text;
    text_init(&text, &f->arena);
    for (elem_id e = doc_element(&f->doc, f->doc.root)->first_child; e;
         e = doc_element(&f->doc, e)->next)
        doc_write(&f->doc, e, &text);
    return text_cstr(&text);
}

/* Reads a document and compares its messages. */
#define REQUIRE_MESSAGES(text, files, expected) \
    do { \
        struct fixture fixture_; \
        fixture_read(&fixture_, (text), (files)); \
        REQUIRE_STR(fixture_messages(&fixture_), (expected)); \
        fixture_close(&fixture_); \
    } while (0)

/* Reads a document and compares its tree. */
#define REQUIRE_TREE(text, files, expected) \
    do { \
        struct fixture fixture_; \
        fixture_read(&fixture_, (text), (files)); \
        REQUIRE_STR(fixture_tree(&fixture_), (expected)); \
        fixture_close(&fixture_); \
    } while (0)

#endif
