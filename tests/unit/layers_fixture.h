// SPDX-License-Identifier: Apache-2.0
/*
 * Two layers read from text: a library, and a document that stands on it; source files exist in a
 * table only.
 */
#ifndef MXG_TESTS_LAYERS_FIXTURE_H
#define MXG_TESTS_LAYERS_FIXTURE_H

#include "base/trap.h"
#include "library/library.h"
#include "xml/reader.h"

#include "test.h"

#include <stdlib.h>

struct layer_file {
    const char *name, *text;
};

struct layers {
    struct mem mem;
    unsigned char dirt; /* new memory is filled with it */
    struct trap trap;
    struct arena arena;
    struct diag_list diags;         /* of both layers */
    const struct layer_file *files; /* ends with a NULL name */
    struct library base, lib;
};

static bool layers_open_xml(void *user_data, const char *from, const char *ref,
                            const char **out_name, const char **out_data, size_t *out_size,
                            void **out_handle, const char **out_reason)
{
    (void)user_data, (void)from, (void)ref, (void)out_data, (void)out_size, (void)out_handle;
    *out_name = NULL;
    *out_reason = "no such file";
    return false;
}

static bool layers_read_source(void *user_data, const char *from, const char *ref,
                               const char **out_name, const char **out_text, size_t *out_len,
                               const char **out_reason)
{
    const struct layers *l = user_data;
    (void)from;
    const struct layer_file *file = l->files;
    while (file && file->name && strcmp(file->name, ref) != 0)
        file++;
    *out_reason = "no such file";
    if (!file || !file->name)
        return false;
    *out_name = file->name;
    *out_text = file->text;
    *out_len = strlen(file->text);
    return true;
}

static inline struct lang_reader layers_reader(struct layers *l)
{
    return (struct lang_reader){l, layers_read_source};
}

static inline void layers_index(struct layers *l, struct library *layer)
{
    struct lang_reader reader = layers_reader(l);
    library_index(layer, &reader, &l->diags);
}

/* Fills a layer that library_init has made from the children of <materialx>. */
static inline void layers_read(struct layers *l, struct library *layer, const char *name,
                               const char *children)
{
    struct text text;
    struct xml_files files = {.open = layers_open_xml};
    text_init(&text, &l->arena);
    text_fmt(&text, "<materialx version=\"1.39\">%s</materialx>", children);
    xml_read_memory(&layer->doc, &files, NULL, name, text.data, text.len, &l->diags);
    layers_index(l, layer);
}

/* Memory that is not clean, and differs from one pair of layers to the next. */
static inline void *layers_realloc(void *user_data, void *block, size_t old_size, size_t new_size)
{
    const struct layers *l = user_data;
    if (new_size == 0) {
        free(block);
        return NULL;
    }
    block = realloc(block, new_size);
    if (block && new_size > old_size)
        memset((char *)block + old_size, l->dirt, new_size - old_size);
    return block;
}

static inline void layers_begin(struct layers *l, const struct layer_file *files)
{
    static unsigned char dirt = 0x5a;
    memset(l, 0, sizeof *l);
    l->files = files;
    l->dirt = dirt = (unsigned char)(dirt + 53);
    mem_init(&l->mem, layers_realloc, l);
    l->mem.trap = &l->trap;
    arena_init(&l->arena, &l->mem);
    diag_list_init(&l->diags, &l->arena);
}

/* The children of <materialx> of both layers. */
static inline void layers_open(struct layers *l, const struct layer_file *files, const char *base,
                               const char *document)
{
    layers_begin(l, files);
    library_init(&l->base, &l->arena, NULL);
    layers_read(l, &l->base, "base.mtlx", base);
    library_resolve_graphs(&l->base, &l->diags);
    library_init(&l->lib, &l->arena, &l->base);
    layers_read(l, &l->lib, "document.mtlx", document);
}

static inline void layers_close(struct layers *l)
{
    arena_finish(&l->arena);
}

/* "unknown-node, type-mismatch": ids of what was reported since the last call; no remarks. */
static inline const char *layers_messages(struct layers *l)
{
    struct text text;
    text_init(&text, &l->arena);
    for (uint32_t i = 0; i < l->diags.items.len; i++)
        if (l->diags.items.items[i].severity != DIAG_REMARK)
            text_fmt(&text, "%s%s", text.len ? ", " : "", diag_id_text(l->diags.items.items[i].id));
    diag_list_init(&l->diags, &l->arena);
    return text_cstr(&text);
}

static inline str_id layers_word(struct layers *l, const char *text)
{
    return str_intern_z(&l->lib.strings, text);
}

static inline elem_id layers_element(const struct layers *l, const char *path)
{
    elem_id found = doc_find(&l->lib.doc, path, strlen(path));
    if (!REQUIRE(found != 0))
        printf("    there is no element %s\n", path);
    return found;
}

static inline const char *layers_text(const struct layers *l, str_id id)
{
    return id ? str_text(&l->lib.strings, id) : "-";
}

#endif
