// SPDX-License-Identifier: Apache-2.0
/* How files are opened: the host's resolver as the readers of other rooms see it. */
#include "api/api.h"

void file_source_init(struct file_source *source, struct object *object)
{
    *source = (struct file_source){.resolver = &object->context->resolver, .arena = &object->arena};
    arena_init(&source->scratch, &object->mem);
}

static void close_file(struct file_source *source)
{
    if (source->is_open)
        source->resolver->release(source->resolver->user_data, &source->blob);
    source->is_open = false;
}

void file_source_finish(struct file_source *source)
{
    close_file(source);
    arena_finish(&source->scratch);
}

static const char *remember(struct file_source *source, const char *name)
{
    for (uint32_t i = 0; i < source->names.len; i++)
        if (strcmp(source->names.items[i], name) == 0)
            return source->names.items[i];
    vec_push(source->arena, &source->names, arena_strndup(source->arena, name, strlen(name)));
    return vec_last(&source->names);
}

static bool open_file(struct file_source *source, const char *from, const char *ref, const char **out_reason)
{
    const char *reason = NULL;
    source->blob = (mxg_blob){.name = ref};
    source->is_open = source->resolver->open(source->resolver->user_data, from, ref, &source->blob, &reason);
    if (!source->is_open)
        *out_reason = reason ? reason : "it was not found";
    return source->is_open;
}

static bool open_for_xml(void *user_data, const char *from, const char *ref, const char **out_name, const char **out_data,
                         size_t *out_size, void **out_handle, const char **out_reason)
{
    struct file_source *source = user_data;
    if (!open_file(source, from, ref, out_reason))
        return false;
    *out_name = remember(source, source->blob.name);
    *out_data = source->blob.data;
    *out_size = source->blob.size;
    *out_handle = NULL;
    return true;
}

static void release_for_xml(void *user_data, void *handle)
{
    (void)handle; /* one file is open at a time */
    close_file(user_data);
}

struct xml_files file_source_for_xml(struct file_source *source)
{
    return (struct xml_files){.user_data = source, .open = open_for_xml, .release = release_for_xml};
}

/* Sources include each other, so their texts are copied instead of being held open. */
static bool read_for_lang(void *user_data, const char *from, const char *ref, const char **out_name, const char **out_text,
                          size_t *out_len, const char **out_reason)
{
    struct file_source *source = user_data;
    if (!open_file(source, from, ref, out_reason))
        return false;
    *out_name = remember(source, source->blob.name);
    *out_text = arena_strndup(&source->scratch, source->blob.data, source->blob.size);
    *out_len = source->blob.size;
    close_file(source);
    return true;
}

struct lang_reader file_source_for_lang(struct file_source *source)
{
    return (struct lang_reader){.user_data = source, .read = read_for_lang};
}

bool file_source_read(struct file_source *source, const char *path, const char **out_data, size_t *out_size,
                      struct diag_list *diags)
{
    const char *reason;
    if (!open_file(source, "", path, &reason)) {
        diag_add(diags, DIAG_ID_file_missing, (struct diag_place){.file = path}, path, reason);
        return false;
    }
    remember(source, source->blob.name);
    *out_data = arena_strndup(source->arena, source->blob.data, source->blob.size);
    *out_size = source->blob.size;
    close_file(source);
    return true;
}
