// SPDX-License-Identifier: Apache-2.0
/*
 * The default resolver: it looks for files beside the referring file, then in the working
 * directory.
 */
#include "api/api.h"
#include "api/file_system.h"

#include <assert.h>
#include <errno.h>
#include <stdio.h>

enum { FIRST_READ = 32 << 10 };

const char stdio_no_memory[] = "out of memory";

/*
 * A block from the context's allocator that stores its size. It holds one file: its text, then its
 * name.
 */
struct block {
    size_t size;
    size_t len; /* bytes of text */
    char bytes[];
};

/* NULL if memory is exhausted; the old block stays valid. */
static struct block *resize(struct mxg_context *context, struct block *block, size_t capacity)
{
    size_t size = sizeof *block + capacity, old_size = block ? block->size : 0,
           used = atomic_load(&context->used);
    if (context->max_memory
        && (used > context->max_memory || size - old_size > context->max_memory - used))
        return NULL;
    struct block *resized = context->mem.realloc(context->mem.user_data, block, old_size, size);
    if (resized) {
        resized->len = block ? resized->len : 0;
        resized->size = size;
        atomic_fetch_add(&context->used, size - old_size);
    }
    return resized;
}

static void release(struct mxg_context *context, struct block *block)
{
    if (!block)
        return;
    assert(atomic_load(&context->used) >= block->size);
    atomic_fetch_sub(&context->used, block->size);
    context->mem.realloc(context->mem.user_data, block, block->size, 0);
}

static bool is_absolute(const char *path)
{
    return path[0] == '/' || path[0] == '\\' || (path[0] && path[1] == ':');
}

/* The path of `ref` beside the file `from`; leading "./" and "../" of `ref` are resolved. */
static struct block *join(struct mxg_context *context, const char *from, const char *ref)
{
    const char *slash = file_last_separator(from);
    size_t folder = slash && !is_absolute(ref) ? (size_t)(slash - from) + 1 : 0;
    struct block *name = resize(context, NULL, folder + strlen(ref) + 1);
    if (!name)
        return NULL;
    memcpy(name->bytes, from, folder);
    while (strncmp(ref, "./", 2) == 0)
        ref += 2;
    while (folder > 1 && strncmp(ref, "../", 3) == 0) {
        size_t parent = folder - 1;
        while (parent > 0 && !file_is_separator(name->bytes[parent - 1]))
            parent--;
        if (folder - parent == 3 && memcmp(name->bytes + parent, "..", 2) == 0)
            break; /* `ref` leads above the first folder of `from` */
        ref += folder - parent == 2 && name->bytes[parent] == '.'
                   ? 0
                   : 3; /* "./" is no folder to leave */
        folder = parent;
    }
    memcpy(name->bytes + folder, ref, strlen(ref) + 1);
    return name;
}

/* Stops past the size limit: then the reader of the file refuses it. */
static struct block *read_all(struct mxg_context *context, FILE *file, size_t room,
                              const char **out_reason)
{
    size_t limit = ((size_t)context->xml_limits.max_file_mib + 1) << 20;
    struct block *text = resize(context, NULL, FIRST_READ + room);
    while (text) {
        size_t free_bytes = text->size - sizeof *text - text->len - room;
        text->len += fread(text->bytes + text->len, 1, free_bytes, file);
        if (ferror(file)) {
            *out_reason = strerror(errno);
            release(context, text);
            return NULL;
        }
        if (text->len > limit || text->len + room < text->size - sizeof *text)
            return text;
        struct block *more = resize(context, text, 2 * (text->size - sizeof *text));
        if (!more)
            release(context, text);
        text = more;
    }
    *out_reason = stdio_no_memory;
    return NULL;
}

enum outcome { OPENED, MISSING, UNREADABLE };

static enum outcome open_at(struct mxg_context *context, const char *name, mxg_blob *out_blob,
                            const char **out_reason)
{
    FILE *file = fopen(name, "rb");
    if (!file) {
        int fault = errno;
        *out_reason = strerror(fault);
        return fault == ENOENT || fault == ENOTDIR ? MISSING : UNREADABLE;
    }
    size_t name_size = strlen(name) + 1;
    struct block *text = read_all(context, file, name_size, out_reason);
    fclose(file);
    if (!text)
        return UNREADABLE;
    char *kept = memcpy(text->bytes + text->len, name, name_size);
    *out_blob = (mxg_blob){.name = kept, .data = text->bytes, .size = text->len, .handle = text};
    return OPENED;
}

/* The place of a file that another one names: beside it (0), or in the working directory (1). */
static struct block *place_of(struct mxg_context *context, const char *from, const char *ref,
                              int place, const char **out_fault)
{
    struct block *name = join(context, place == 0 ? from : "", ref);
    *out_fault = name ? NULL : stdio_no_memory;
    if (name && *from) /* the sandbox does not apply to files that the caller names */
        *out_fault = sandbox_fault(context, name->bytes);
    return name;
}

/* The first of the places; the referring file may be in the working directory. */
static int first_place(const char *from, const char *ref)
{
    return !file_last_separator(from) || is_absolute(ref);
}

/*
 * If a file exists but cannot be read, the search stops: this file is the intended one.
 */
static bool open_file(void *user_data, const char *from, const char *ref, mxg_blob *out_blob,
                      const char **out_reason)
{
    struct mxg_context *context = user_data;
    enum outcome outcome = MISSING;
    for (int i = first_place(from, ref); i < 2 && outcome == MISSING; i++) {
        const char *fault;
        struct block *name = place_of(context, from, ref, i, &fault);
        if (fault)
            *out_reason = fault;
        outcome = fault ? UNREADABLE : open_at(context, name->bytes, out_blob, out_reason);
        release(context, name);
    }
    if (outcome == UNREADABLE)
        out_blob->name = ref;
    return outcome == OPENED;
}

bool stdio_is_resolver(const struct mxg_context *context)
{
    return context->resolver.open == open_file;
}

size_t stdio_begin(struct mxg_context *context, const char *from, const char *ref,
                   unsigned char *buffer, size_t capacity)
{
    size_t size = 0;
    for (int i = first_place(from, ref); i < 2 && !size; i++) {
        const char *fault;
        struct block *name = place_of(context, from, ref, i, &fault);
        FILE *file = fault ? NULL : fopen(name->bytes, "rb");
        size = file ? fread(buffer, 1, capacity, file) : 0;
        if (file)
            fclose(file);
        release(context, name);
    }
    return size;
}

static void release_file(void *user_data, mxg_blob *blob)
{
    release(user_data, blob->handle);
}

static size_t list_folder(void *user_data, const char *from, const char *folder, char *names,
                          size_t capacity)
{
    struct mxg_context *context = user_data;
    size_t size = 0;
    for (int i = 0; i < 2 && !size; i++) {
        struct block *name = join(context, i == 0 ? from : "", folder);
        if (name
            && !(*from && context->sandbox
                 && sandbox_fault(context, name->bytes[0] ? name->bytes : ".")))
            folder_names(name->bytes[0] ? name->bytes : ".", names, capacity, &size);
        release(context, name);
    }
    return size;
}

static const char *fault_of_path(struct mxg_context *context, const char *from, const char *file)
{
    struct block *name = join(context, from, file);
    const char *fault = name ? sandbox_texture_fault(context, name->bytes) : stdio_no_memory;
    release(context, name);
    return fault;
}

static unsigned digit_of(char c)
{
    const char *digits = "0123456789abcdef0123456789ABCDEF", *found = c ? strchr(digits, c) : NULL;
    return found ? (unsigned)(found - digits) % 16 : 16;
}

/* "a/../b" becomes "b" in place, whether there is a folder "a" or not. */
static void leave_folders(char *path)
{
    char *out = path + (*path == '/'), *least = out;
    const char *at = out;
    for (size_t len, step; *at; at += step) {
        len = strcspn(at, "/");
        step = len + (at[len] == '/');
        bool is_up = len == 2 && memcmp(at, "..", 2) == 0;
        if (is_up && out > least) {
            out--;
            while (out > least && out[-1] != '/')
                out--;
        } else if (len != 1 || *at != '.') {
            memmove(out, at, step);
            out += step;
            least = is_up ? out : least;
        }
    }
    *out = '\0';
}

/*
 * The path that a reader of URLs finds in a name, in place: it leaves line ends and tabs out, reads
 * '\\' as '/', decodes, and leaves folders (https://url.spec.whatwg.org, "URL parsing").
 */
static void read_as_url(char *name)
{
    char *first = name, *out = name;
    for (; *name; name++) {
        unsigned high = *name == '%' ? digit_of(name[1]) : 16,
                 low = high < 16 ? digit_of(name[2]) : 16;
        bool is_blank = *name == '\t' || *name == '\n' || *name == '\r';
        if (low < 16 && (high | low)) {
            *out++ = (char)(high << 4 | low);
            name += 2;
        } else if (!is_blank) {
            *out++ = *name;
        }
    }
    *out = '\0';
    for (char *at = first; (at = strchr(at, '\\')) != NULL;)
        *at = '/';
    leave_folders(first);
}

/* "file:", "https:"; one letter is a drive of Windows. */
static bool has_scheme(const char *name)
{
    static const char characters[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-.";
    size_t len = strspn(name += strspn(name, " "), characters);
    return len > 1 && name[len] == ':';
}

/* ---- Names that stand for several files ---- */

/* The length of "<UDIM>", "{frame}" and their like; 0: no token is there. */
static size_t token_length(const char *name)
{
    const char *end = *name == '<' ? strchr(name, '>') : *name == '{' ? strchr(name, '}') : NULL;
    return end ? (size_t)(end - name) + 1 : 0;
}

static bool has_token(const char *name, size_t len)
{
    for (size_t i = 0; i < len; i++)
        if (token_length(name + i))
            return true;
    return false;
}

/* True if a file of a folder fits a pattern, in which a token stands for any text. */
static bool fits(const char *pattern, const char *name)
{
    const char *behind = NULL, *from = NULL; /* the last token, and where its text ends so far */
    if (strcmp(name, ".") == 0 || strcmp(name, "..") == 0)
        return false;
    while (*name) {
        size_t token = token_length(pattern);
        if (token) {
            behind = pattern += token;
            from = name;
        } else if (*pattern == *name) {
            pattern++, name++;
        } else if (behind) {
            pattern = behind;
            name = ++from;
        } else {
            return false;
        }
    }
    for (size_t token; (token = token_length(pattern)) != 0;)
        pattern += token;
    return !*pattern;
}

/* The fault of a file in a folder, which may be that of a tile or a frame. */
static const char *fault_in_folder(struct mxg_context *context, const char *from,
                                   const char *folder, const char *name)
{
    size_t len = strlen(folder);
    struct block *path = resize(context, NULL, len + strlen(name) + 1);
    if (!path)
        return stdio_no_memory;
    memcpy(path->bytes, folder, len);
    memcpy(path->bytes + len, name, strlen(name) + 1);
    const char *fault = fault_of_path(context, from, path->bytes);
    release(context, path);
    return fault;
}

/* The fault of any file that a name with tokens may stand for: a link among them may lead out. */
static const char *fault_of_set(struct mxg_context *context, const char *from, const char *file)
{
    const char *slash = file_last_separator(file), *base = slash ? slash + 1 : file, *fault = NULL;
    size_t len = (size_t)(base - file), size;
    if (has_token(file, len))
        return "a token stands in the name of its folder, and in a sandbox only in that of the "
               "file";
    if (!has_token(base, strlen(base)))
        return NULL;
    struct block *folder = resize(context, NULL, len + 1), *names = NULL;
    if (folder) {
        memcpy(folder->bytes, file, len);
        folder->bytes[len] = '\0';
        size = list_folder(context, from, folder->bytes, NULL, 0);
        names = resize(context, NULL, size);
    }
    if (!names || list_folder(context, from, folder->bytes, names->bytes, size) > size)
        fault = stdio_no_memory;
    for (size_t at = 0; !fault && at < size; at += strlen(names->bytes + at) + 1)
        if (fits(base, names->bytes + at))
            fault = fault_in_folder(context, from, folder->bytes, names->bytes + at);
    release(context, names);
    release(context, folder);
    return fault;
}

const char *stdio_texture_fault(void *user_data, const char *from, const char *file)
{
    struct mxg_context *context = user_data;
    if (!context->sandbox || !stdio_is_resolver(context))
        return NULL;
    size_t size = strlen(file) + 1;
    struct block *url = resize(context, NULL, size);
    if (!url)
        return stdio_no_memory;
    memcpy(url->bytes, file, size);
    read_as_url(url->bytes);
    const char *fault = fault_of_path(context, from, file);
    if (!fault)
        fault = has_scheme(url->bytes) ? sandbox_outside : fault_of_path(context, from, url->bytes);
    if (!fault)
        fault = fault_of_set(context, from, file);
    release(context, url);
    return fault;
}

mxg_resolver stdio_resolver(struct mxg_context *context)
{
    return (mxg_resolver){.user_data = context,
                          .open = open_file,
                          .release = release_file,
                          .list_folder = list_folder};
}
