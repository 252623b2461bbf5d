// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "check/cache.h"

#include "program/json_values.h"
#include "check/protocol.h"
#include "check/record_json.h"
#include "program/cli.h"
#include "program/files.h"
#include "program/name_table.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { NUM_FILES = 1024 }; /* capacity for remembered hashes: many documents share includes */

struct cached_file {
    char *path;
    struct cache_hash hash;
};

/* ---- Hashes ---- */

/* Hashes a text with its length before it, so that two texts never hash like one. */
static void add_text(SHA2_CTX *sha, const char *text)
{
    size_t len = strlen(text);
    SHA256Update(sha, (const uint8_t *)&len, sizeof len);
    SHA256Update(sha, (const uint8_t *)text, len);
}

static struct cache_hash end_hash(SHA2_CTX *sha)
{
    struct cache_hash hash;
    SHA256End(sha, hash.hex);
    return hash;
}

/* Adds the bytes of a file of at most the size of the limit, piece by piece; false: past a limit.
 */
static bool add_file(const struct cache *cache, SHA2_CTX *sha, int fd)
{
    uint8_t piece[64 << 10];
    struct stat info;
    uint64_t end = desk_clock() + cache->time_limit;
    if (fstat(fd, &info) != 0 || !S_ISREG(info.st_mode)
        || (uint64_t)info.st_size > cache->max_file_size)
        return false;
    ssize_t len = 0;
    for (uint64_t size = 0; (len = read(fd, piece, sizeof piece)) > 0;) {
        size += (uint64_t)len;
        if (size > cache->max_file_size || desk_clock() > end)
            return false;
        SHA256Update(sha, piece, (size_t)len);
    }
    return len == 0;
}

/* Hash of the bytes of a file; "" if it cannot be read, or exceeds a limit. */
static struct cache_hash hash_file(const struct cache *cache, const char *path)
{
    SHA2_CTX sha;
    /* no wait for the other end of a pipe, which is no regular file anyway */
    int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    SHA256Init(&sha);
    bool good = fd >= 0 && add_file(cache, &sha, fd);
    if (fd >= 0)
        close(fd);
    return good ? end_hash(&sha) : (struct cache_hash){""};
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* Hash of the names in a folder; a missing folder has no names. */
static struct cache_hash hash_folder(const char *path)
{
    SHA2_CTX sha;
    struct arg_list names = {0};
    DIR *folder = opendir(path);
    for (const struct dirent *entry; folder && (entry = readdir(folder)) != NULL;)
        args_append(&names, cli_format("%s", entry->d_name));
    if (folder)
        closedir(folder);
    if (names.len)
        qsort(names.items, names.len, sizeof *names.items, compare_names);
    SHA256Init(&sha);
    for (size_t i = 0; i < names.len; ++i)
        add_text(&sha, names.items[i]);
    args_free(&names);
    return end_hash(&sha);
}

static bool is_folder_name(const char *path)
{
    size_t len = strlen(path);
    return len && path[len - 1] == '/';
}

/* The hash of a file or folder, remembered for this run. */
static const char *remembered_hash(struct cache *cache, const char *path)
{
    struct cached_file *file = &cache->files[names_hash(NAMES_HASH_OF_NOTHING, path) % NUM_FILES];
    if (!file->path || strcmp(file->path, path) != 0) {
        free(file->path);
        file->path = cli_format("%s", path);
        file->hash = is_folder_name(path) ? hash_folder(path) : hash_file(cache, path);
    }
    return file->hash.hex;
}

/* Hashes version, size and time of a program: another build is another program. */
static void add_program(SHA2_CTX *sha, const char *path)
{
    struct stat info = {0};
    stat(path, &info);
    int64_t numbers[] = {info.st_size, info.st_mtim.tv_sec, info.st_mtim.tv_nsec};
    add_text(sha, mxg_version_string());
    SHA256Update(sha, (const uint8_t *)numbers, sizeof numbers);
}

static void add_renderer(SHA2_CTX *sha)
{
    char *program = cli_program("mxgen-render");
    add_program(sha, program);
    free(program);
}

#define PLUGIN "--plugin=" /* as args_forward writes it */

void cache_init(struct cache *cache, const struct arg_list *args, const mxg_library *library)
{
    cache->begin = time(NULL);
    if (!cache->folder)
        return;
    SHA2_CTX sha;
    const uint8_t version = CHECK_FORMAT_VERSION;
    cache->files = calloc(NUM_FILES, sizeof *cache->files);
    SHA256Init(&sha);
    SHA256Update(&sha, &version, sizeof version);
    add_program(&sha, args->items[0]);
    for (size_t i = 1; i < args->len && args->items[i]; ++i) {
        add_text(&sha, args->items[i]);
        if (strcmp(args->items[i], "--render") == 0)
            add_renderer(&sha);
        if (strncmp(args->items[i], PLUGIN, strlen(PLUGIN)) == 0)
            add_text(&sha, hash_file(cache, args->items[i] + strlen(PLUGIN)).hex);
    }
    for (uint32_t i = 0; i < mxg_library_num_files(library); ++i) {
        add_text(&sha, mxg_library_file(library, i));
        add_text(&sha, hash_file(cache, mxg_library_file(library, i)).hex);
    }
    cache->configuration = end_hash(&sha);
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

static struct cache_key make_key(const struct cache *cache, const char *path)
{
    SHA2_CTX sha;
    struct cache_key key = {.document = hash_file(cache, path)};
    if (!key.document.hex[0])
        return key;
    SHA256Init(&sha);
    add_text(&sha, cache->configuration.hex);
    add_text(&sha, path);
    add_text(&sha, key.document.hex);
    key.name = end_hash(&sha);
    return key;
}

static char *entry_path(const struct cache *cache, const struct cache_key *key)
{
    return cli_format("%s/%.2s/%s.entry", cache->folder, key->name.hex, key->name.hex + 2);
}

/* ---- The file of an entry: a line with the hash of the JSON after it ---- */

static struct cache_hash hash_bytes(const char *bytes, size_t size)
{
    SHA2_CTX sha;
    SHA256Init(&sha);
    SHA256Update(&sha, (const uint8_t *)bytes, size);
    return end_hash(&sha);
}

/* NULL if there is no entry, or a damaged one. */
static json_t *read_entry(const char *path)
{
    enum { LINE = sizeof(struct cache_hash) }; /* the newline is where the text has its NUL */
    size_t size = 0;
    char *data = files_is_regular(path) ? files_read(path, &size) : NULL;
    json_t *entry = NULL;
    if (data && size > LINE && data[LINE - 1] == '\n'
        && memcmp(data, hash_bytes(data + LINE, size - LINE).hex, LINE - 1) == 0)
        entry = json_loadb(data + LINE, size - LINE, 0, NULL);
    free(data);
    return entry;
}

/* Size and time stand for the content of an image, because images are large. */
static struct cache_hash stamp_image(const char *path)
{
    struct stat info;
    struct cache_hash stamp = {"none"};
    if (stat(path, &info) == 0)
        snprintf(stamp.hex, sizeof stamp.hex, "%jd %jd.%09ld", (intmax_t)info.st_size,
                 (intmax_t)info.st_mtim.tv_sec, info.st_mtim.tv_nsec);
    return stamp;
}

/*
 * True if an entry is valid. "files" has the hash of each file that the check read besides the
 * document, and of the names in each folder of textures; "images" has the stamp of each image in a
 * picture or budget; "record" is the record.
 */
static bool is_current(struct cache *cache, json_t *entry)
{
    const char *path;
    json_t *value;
    json_object_foreach(json_object_get(entry, "files"), path, value)
    {
        const char *hash = json_string_value(value);
        if (!hash || !*hash || strcmp(hash, remembered_hash(cache, path)) != 0)
            return false;
    }
    json_object_foreach(json_object_get(entry, "images"), path, value)
    {
        const char *stamp = json_string_value(value);
        if (!stamp || strcmp(stamp, stamp_image(path).hex) != 0)
            return false;
    }
    return json_object_get(entry, "files") && json_object_get(entry, "images");
}

json_t *cache_find(struct cache *cache, const char *path, struct cache_key *out_key)
{
    *out_key = (struct cache_key){0};
    if (!cache->folder)
        return NULL;
    *out_key = make_key(cache, path);
    if (!out_key->name.hex[0])
        return NULL;
    char *file = entry_path(cache, out_key);
    json_t *entry = read_entry(file), *record = NULL;
    free(file);
    if (is_current(cache, entry))
        record = json_incref(json_object_get(entry, "record"));
    json_decref(entry);
    return record;
}

/* True if a file has changed since the run began: a worker may have read the older content. */
static bool may_have_changed(const struct cache *cache, const char *path)
{
    struct stat info;
    return stat(path, &info) != 0 || info.st_mtim.tv_sec >= cache->begin;
}

/*
 * True for messages about missing files: these may appear later, and no folder listing shows this.
 */
static bool is_about_absence(const char *id)
{
    static const char *const ids[] = {"failed", "check-memory", "file-missing", "file-unreadable",
                                      "no-profile"};
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
        || document->failed == CHECK_MEMORY || document->num_files == 0)
        return false;
    for (size_t i = 0; i < document->num_messages; ++i)
        if (is_about_absence(document->messages[i].id))
            return false;
    return true;
}

static char *make_entry(struct cache *cache, const struct check_document *document)
{
    json_t *entry = json_object(), *files = json_object(), *images = json_object();
    for (size_t i = 1; i < document->num_files; ++i)
        json_set(files, document->files[i],
                 json_string(remembered_hash(cache, document->files[i])));
    for (size_t i = 0; i < document->num_folders; ++i)
        json_set(files, document->folders[i],
                 json_string(remembered_hash(cache, document->folders[i])));
    for (size_t i = 0; i < document->num_images; ++i)
        json_set(images, document->images[i], json_string(stamp_image(document->images[i]).hex));
    json_object_set_new(entry, "files", files);
    json_object_set_new(entry, "images", images);
    json_object_set_new(entry, "record", record_to_json(document, true));
    char *text = json_dumps(entry, JSON_STYLE), *file = NULL;
    if (text)
        file = cli_format("%s\n%s", hash_bytes(text, strlen(text)).hex, text);
    free(text);
    json_decref(entry);
    return file;
}

void cache_put(struct cache *cache, const struct cache_key *key,
               const struct check_document *document)
{
    if (!cache->folder || !key->name.hex[0] || cache->fault || !follows_from_files(cache, document))
        return;
    struct cache_key now = make_key(cache, document->file);
    if (strcmp(now.name.hex, key->name.hex) != 0)
        return;
    char *path = entry_path(cache, key), *slash = strrchr(path, '/');
    *slash = '\0';
    cache->fault = files_make_folder(path);
    *slash = '/';
    char *entry = make_entry(cache, document);
    if (entry && !cache->fault)
        cache->fault = files_write(path, entry, strlen(entry));
    free(entry);
    free(path);
}
