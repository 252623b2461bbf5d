// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "check/cache.h"

#include "cli/cli.h"
#include "cli/files.h"

#include <dirent.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { NUM_FILES = 1024 }; /* whose hashes are remembered: includes that many documents share */

struct cached_file {
    char *path;
    char hex[SHA256_HEX + 1];
};

/* ---- Hashes ---- */

static bool hash_file(const char *path, char out[SHA256_HEX + 1])
{
    struct sha256 sha;
    size_t size = 0;
    char *data = files_is_regular(path) ? files_read(path, &size) : NULL;
    if (!data)
        return false;
    sha256_init(&sha);
    sha256_add(&sha, data, size);
    sha256_hex(&sha, out);
    free(data);
    return true;
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* A folder by the names in it; one that is not there has none. */
static void hash_folder(const char *path, char out[SHA256_HEX + 1])
{
    struct sha256 sha;
    struct arg_list names = {0};
    DIR *folder = opendir(path);
    for (const struct dirent *entry; folder && (entry = readdir(folder)) != NULL;)
        args_append(&names, cli_format("%s", entry->d_name));
    if (folder)
        closedir(folder);
    if (names.len)
        qsort(names.items, names.len, sizeof *names.items, compare_names);
    sha256_init(&sha);
    for (size_t i = 0; i < names.len; ++i) {
        sha256_add_text(&sha, names.items[i]);
        free((void *)(uintptr_t)names.items[i]);
    }
    sha256_hex(&sha, out);
    free(names.items);
}

static bool is_folder_name(const char *path)
{
    size_t len = strlen(path);
    return len && path[len - 1] == '/';
}

/*
 * The hash of a file that may have been asked for before in this run; "" where it cannot be read.
 */
static const char *remembered_hash(struct cache *cache, const char *path)
{
    struct sha256 sha;
    char hex[SHA256_HEX + 1];
    sha256_init(&sha);
    sha256_add_text(&sha, path);
    sha256_hex(&sha, hex);
    struct cached_file *file = &cache->files[sha.state[0] % NUM_FILES];
    if (!file->path || strcmp(file->path, path) != 0) {
        free(file->path);
        file->path = cli_format("%s", path);
        if (is_folder_name(path))
            hash_folder(path, file->hex);
        else if (!hash_file(path, file->hex))
            file->hex[0] = '\0';
    }
    return file->hex;
}

static void add_file(struct sha256 *sha, const char *path)
{
    char hex[SHA256_HEX + 1] = "";
    hash_file(path, hex);
    sha256_add_text(sha, path);
    sha256_add_text(sha, hex);
}

/* A program by its version, size and time: another build is another program. */
static void add_program(struct sha256 *sha, const char *path)
{
    struct stat info = {0};
    stat(path, &info);
    int64_t numbers[] = {info.st_size, info.st_mtim.tv_sec, info.st_mtim.tv_nsec};
    sha256_add_text(sha, mxg_version_string());
    sha256_add(sha, numbers, sizeof numbers);
}

static void add_renderer(struct sha256 *sha)
{
    char *program = cli_program("mxgen-render");
    add_program(sha, program);
    free(program);
}

void cache_init(struct cache *cache, const char *folder, const struct arg_list *args,
                const mxg_library *library)
{
    *cache = (struct cache){.folder = folder, .begin = time(NULL)};
    if (!folder)
        return;
    struct sha256 sha;
    const uint32_t version = CHECK_FORMAT_VERSION;
    cache->files = calloc(NUM_FILES, sizeof *cache->files);
    sha256_init(&sha);
    sha256_add(&sha, &version, sizeof version);
    add_program(&sha, args->items[0]);
    for (size_t i = 1; i < args->len && args->items[i]; ++i) {
        sha256_add_text(&sha, args->items[i]);
        if (strcmp(args->items[i], "--render") == 0)
            add_renderer(&sha);
    }
    for (uint32_t i = 0; i < mxg_library_num_files(library); ++i)
        add_file(&sha, mxg_library_file(library, i));
    sha256_hex(&sha, cache->configuration);
    if (!cache->files)
        cache->folder = NULL;
}

void cache_finish(struct cache *cache)
{
    for (size_t i = 0; cache->files && i < NUM_FILES; ++i)
        free(cache->files[i].path);
    free(cache->files);
}

/* ---- Entries ---- */

static void make_key(const struct cache *cache, const char *path, struct cache_key *out)
{
    struct sha256 sha;
    *out = (struct cache_key){0};
    if (!hash_file(path, out->document))
        return;
    sha256_init(&sha);
    sha256_add_text(&sha, cache->configuration);
    sha256_add_text(&sha, path);
    sha256_add_text(&sha, out->document);
    sha256_hex(&sha, out->hex);
}

static char *entry_path(const struct cache *cache, const struct cache_key *key)
{
    return cli_format("%s/%.2s/%s.json", cache->folder, key->hex, key->hex + 2);
}

#define STAMP "stamp " /* what is said of an image begins with that */

/* Images are large: size and time stand for what is in them. */
static void stamp_image(const char *path, char out[SHA256_HEX + 1])
{
    struct stat info;
    if (stat(path, &info) == 0)
        snprintf(out, SHA256_HEX + 1, STAMP "%jd %jd.%09ld", (intmax_t)info.st_size,
                 (intmax_t)info.st_mtim.tv_sec, info.st_mtim.tv_nsec);
    else
        snprintf(out, SHA256_HEX + 1, STAMP "none");
}

static bool is_as_before(struct cache *cache, const char *path, const char *said)
{
    char stamp[SHA256_HEX + 1];
    if (strncmp(said, STAMP, strlen(STAMP)) != 0)
        return strcmp(said, remembered_hash(cache, path)) == 0;
    stamp_image(path, stamp);
    return strcmp(said, stamp) == 0;
}

/* The first line of an entry is an object: path and hash of each file that was read besides the
 * document, and of the names in each folder of textures; path and stamp of each image that a
 * picture shows. */
static bool is_current(struct cache *cache, const char *line, size_t len)
{
    struct store store = {0};
    const struct json_value *files = json_parse(&store, line, len);
    bool good = files && files->kind == JSON_OBJECT;
    for (const struct json_value *file = good ? files->first : NULL; file && good;
         file = file->next)
        good =
            file->kind == JSON_STRING && *file->text && is_as_before(cache, file->key, file->text);
    store_finish(&store);
    return good;
}

char *cache_find(struct cache *cache, const char *path, struct cache_key *out_key, size_t *out_size)
{
    *out_key = (struct cache_key){0};
    if (!cache->folder)
        return NULL;
    make_key(cache, path, out_key);
    if (!out_key->hex[0])
        return NULL;
    char *entry = entry_path(cache, out_key), *record = NULL;
    size_t size = 0;
    char *text = files_read(entry, &size);
    free(entry);
    const char *newline = text ? memchr(text, '\n', size) : NULL;
    if (newline && is_current(cache, text, (size_t)(newline - text))) {
        *out_size = size - (size_t)(newline + 1 - text);
        record = cli_format("%s", newline + 1);
    }
    free(text);
    return record;
}

/* Since the run began: a worker may have read what it was before. */
static bool may_have_changed(const struct cache *cache, const char *path)
{
    struct stat info;
    return stat(path, &info) != 0 || info.st_mtim.tv_sec >= cache->begin;
}

/* What was looked for and not found may be there next time, and no folder tells. */
static bool is_about_absence(const char *id)
{
    static const char *const ids[] = {"failed", "file-missing", "file-unreadable", "no-profile"};
    for (size_t i = 0; i < sizeof ids / sizeof *ids; ++i)
        if (strcmp(id, ids[i]) == 0)
            return true;
    return false;
}

static bool follows_from_files(const struct cache *cache, const struct check_document *document)
{
    for (size_t i = 1; i < document->num_files; ++i)
        if (may_have_changed(cache, document->files[i]))
            return false;
    for (size_t i = 0; i < document->num_images; ++i)
        if (files_is_regular(document->images[i]) && may_have_changed(cache, document->images[i]))
            return false;
    if (document->failed == CHECK_CRASH || document->failed == CHECK_TIMEOUT
        || document->num_files == 0)
        return false;
    for (size_t i = 0; i < document->num_messages; ++i)
        if (is_about_absence(document->messages[i].id))
            return false;
    return true;
}

static char *make_entry(struct cache *cache, const struct check_document *document,
                        size_t *out_size)
{
    char *text = NULL;
    FILE *out = open_memstream(&text, out_size);
    struct json_writer json = {.out = out};
    if (!out)
        return NULL;
    json_begin(&json, '{');
    for (size_t i = 1; i < document->num_files; ++i) {
        json_key(&json, document->files[i]);
        json_string(&json, remembered_hash(cache, document->files[i]));
    }
    for (size_t i = 0; i < document->num_folders; ++i) {
        json_key(&json, document->folders[i]);
        json_string(&json, remembered_hash(cache, document->folders[i]));
    }
    for (size_t i = 0; i < document->num_images; ++i) {
        char stamp[SHA256_HEX + 1];
        stamp_image(document->images[i], stamp);
        json_key(&json, document->images[i]);
        json_string(&json, stamp);
    }
    json_end(&json, '}');
    putc('\n', out);
    check_write_document(out, document, true);
    fclose(out);
    return text;
}

void cache_put(struct cache *cache, const struct cache_key *key,
               const struct check_document *document)
{
    struct cache_key now;
    if (!cache->folder || !key->hex[0] || cache->fault || !follows_from_files(cache, document))
        return;
    make_key(cache, document->file, &now);
    if (strcmp(now.hex, key->hex) != 0)
        return;
    char *path = entry_path(cache, key), *slash = strrchr(path, '/');
    *slash = '\0';
    cache->fault = files_make_folder(path);
    *slash = '/';
    size_t entry_size = 0;
    char *entry = make_entry(cache, document, &entry_size);
    if (entry && !cache->fault)
        cache->fault = files_write(path, entry, entry_size);
    free(entry);
    free(path);
}
