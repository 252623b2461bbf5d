// SPDX-License-Identifier: Apache-2.0
/* Opens files: the host's resolver, as an interface for the readers in other rooms. */
#include "api/api.h"
#include "api/file_system.h"

#include "base/hash.h"

#include <assert.h>

void file_source_init(struct file_source *source, struct object *object)
{
    *source = (struct file_source){.object = object, .resolver = &object->context->resolver};
    arena_init(&source->scratch, &object->mem);
}

static void close_file(struct file_source *source)
{
    if (!source->is_open)
        return;
    source->resolver->release(source->resolver->user_data, &source->blob);
    source->is_open = false;
    object_settle(source->object);
}

void file_source_finish(struct file_source *source)
{
    close_file(source);
    arena_finish(&source->scratch);
    object_settle(source->object);
}

const char *file_source_remember(struct file_source *source, const char *name)
{
    size_t len = strlen(name);
    uint32_t hash = hash_bytes(name, len);
    for (uint32_t at = hash, found; (found = table_next(&source->table, hash, &at));)
        if (strcmp(source->names.items[found - 1], name) == 0)
            return source->names.items[found - 1];
    struct arena *arena = &source->object->arena;
    vec_push(arena, &source->names, arena_strndup(arena, name, len));
    table_add(&source->table, arena, hash, source->names.len);
    return vec_last(&source->names);
}

static bool is_too_large(const struct file_source *source)
{
    return source->blob.size > (uint64_t)source->object->context->xml_limits.max_file_mib << 20;
}

/* With the default resolver, an open file counts towards the context's memory. */
static bool open_file(struct file_source *source, const char *from, const char *ref,
                      const char **out_reason)
{
    assert(!source->is_open);
    const char *reason = NULL;
    source->blob = (mxg_blob){0};
    object_settle(source->object);
    source->is_open =
        source->resolver->open(source->resolver->user_data, from, ref, &source->blob, &reason);
    object_settle(source->object);
    if (!source->is_open && reason == stdio_no_memory)
        mem_fail(&source->object->mem);
    if (source->is_open && !source->blob.name)
        source->blob.name = ref;
    if (source->is_open && source->digest && !is_too_large(source))
        source->digest = hash_long(source->digest, source->blob.data, source->blob.size);
    if (!source->is_open)
        *out_reason = reason              ? reason
                      : source->blob.name ? "it cannot be read"
                                          : "it was not found";
    return source->is_open;
}

/* ---- Search paths ---- */

struct source_path {
    struct source_path *next;
    size_t size;
    char folder[]; /* with a '/' at the end, so that it can stand for a file in the folder */
};

/* In the folders of the context. */
static bool open_in_paths(struct file_source *source, const char *ref, const char **out_reason)
{
    for (const struct source_path *path = source->object->context->source_paths; path;
         path = path->next)
        if (open_file(source, path->folder, ref, out_reason))
            return true;
    return false;
}

/* An include is beside the including file, or in a folder of the context. */
static bool open_for_xml(void *user_data, const char *from, const char *ref, const char **out_name,
                         const char **out_data, size_t *out_size, void **out_handle,
                         const char **out_reason)
{
    struct file_source *source = user_data;
    const char *unused;
    if (!open_file(source, from, ref, out_reason)) {
        bool is_include = from && *from, is_missing = !source->blob.name;
        *out_name = source->blob.name;
        if (!is_include || !is_missing || !open_in_paths(source, ref, &unused))
            return false;
    }
    *out_name = file_source_remember(source, source->blob.name);
    *out_data = source->blob.data;
    *out_size = source->blob.size;
    *out_handle = NULL;
    return true;
}

static void release_for_xml(void *user_data, void *handle)
{
    assert(((const struct file_source *)user_data)->is_open);
    (void)handle; /* one file is open at a time */
    close_file(user_data);
}

struct xml_files file_source_for_xml(struct file_source *source)
{
    return (struct xml_files){
        .user_data = source, .open = open_for_xml, .release = release_for_xml};
}

/*
 * Adds a path in front of the others. The sandbox admits its files.
 */
bool source_path_add(struct mxg_context *context, const char *folder)
{
    size_t len = strlen(folder), size = sizeof(struct source_path) + len + 2;
    struct source_path *path = context->mem.realloc(context->mem.user_data, NULL, 0, size);
    if (!path)
        return false;
    *path = (struct source_path){.next = context->source_paths, .size = size};
    memcpy(path->folder, folder, len);
    if (len && file_is_separator(folder[len - 1]))
        len--;
    memcpy(path->folder + len, "/", 2);
    context->source_paths = path;
    atomic_fetch_add(&context->used, size);
    return sandbox_admit_folder(context, folder);
}

void source_paths_finish(struct mxg_context *context)
{
    while (context->source_paths) {
        struct source_path *path = context->source_paths;
        context->source_paths = path->next;
        context->mem.realloc(context->mem.user_data, path, path->size, 0);
    }
}

/* ---- Source files ---- */

static const char *with_slash(struct arena *arena, const char *folder, size_t len)
{
    struct text text;
    text_init(&text, arena);
    text_mem(&text, folder, len);
    text_char(&text, '/');
    return text_cstr(&text);
}

void file_source_add_folder(struct file_source *source, const char *folder)
{
    struct arena *arena = &source->object->arena;
    size_t len = strlen(folder);
    while (len > 1 && file_is_separator(folder[len - 1]))
        len--;
    vec_push(arena, &source->folders, with_slash(arena, folder, len));
    size_t parent = len;
    while (parent > 0 && !file_is_separator(folder[parent - 1]))
        parent--;
    if (parent > 0)
        vec_push(arena, &source->folders, arena_strndup(arena, folder, parent));
}

/* Beside the referring file, then in the folders of libraries, then in those of the context. */
static bool open_source(struct file_source *source, const char *from, const char *ref,
                        const char **out_reason)
{
    if (open_file(source, from, ref, out_reason))
        return true;
    const char *unused;
    bool is_missing = !source->blob.name;
    for (uint32_t i = 0; i < source->folders.len && is_missing; i++)
        if (open_file(source, source->folders.items[i], ref, &unused))
            return true;
    return is_missing && open_in_paths(source, ref, &unused);
}

/*
 * Source files include each other, so the reader copies their text instead of holding files open.
 */
static bool read_for_lang(void *user_data, const char *from, const char *ref, const char **out_name,
                          const char **out_text, size_t *out_len, const char **out_reason)
{
    struct file_source *source = user_data;
    if (!open_source(source, from, ref, out_reason))
        return false;
    if (is_too_large(source)) {
        *out_reason = "it is too large; raise the limit 'max-file-size' if this is intended";
        close_file(source);
        return false;
    }
    *out_name = file_source_remember(source, source->blob.name);
    *out_text = arena_strndup(&source->scratch, source->blob.data, source->blob.size);
    *out_len = source->blob.size;
    close_file(source);
    return true;
}

struct lang_reader file_source_for_lang(struct file_source *source)
{
    return (struct lang_reader){.user_data = source, .read = read_for_lang};
}

size_t file_source_begin(struct file_source *source, const char *from, const char *ref,
                         unsigned char *buffer, size_t capacity)
{
    const char *unused;
    struct mxg_context *context = source->object->context;
    if (stdio_is_resolver(context))
        return stdio_begin(context, from, ref, buffer, capacity);
    if (!open_file(source, from, ref, &unused))
        return 0;
    size_t size = source->blob.size < capacity ? source->blob.size : capacity;
    memcpy(buffer, source->blob.data, size);
    close_file(source);
    return size;
}

bool file_source_read(struct file_source *source, const char *path, const char **out_data,
                      size_t *out_size, struct diag_list *diags)
{
    const char *reason;
    if (!open_file(source, "", path, &reason)) {
        enum diag_id id = source->blob.name ? DIAG_ID_file_unreadable : DIAG_ID_file_missing;
        diag_add(diags, id, (struct diag_place){.file = path}, path, reason);
        return false;
    }
    if (is_too_large(source)) {
        diag_add(diags, DIAG_ID_file_too_large, (struct diag_place){.file = path}, path,
                 (unsigned)source->object->context->xml_limits.max_file_mib);
        close_file(source);
        return false;
    }
    file_source_remember(source, source->blob.name);
    *out_data = arena_strndup(&source->object->arena, source->blob.data, source->blob.size);
    *out_size = source->blob.size;
    close_file(source);
    return true;
}
