// SPDX-License-Identifier: Apache-2.0
/*
 * Records as bytes: numbers in the machine's form, texts with their length and a NUL after them.
 * Members have no names, so both sides must come from one build.
 */
#include "check/record_io.h"
#include "program/utf8.h"

#include <stdlib.h>
#include <string.h>

struct bytes_io {
    struct record_io io;
    char *data;
    size_t at, size; /* size of the buffer or of the input */
    bool failed;
};

static struct bytes_io *self(struct record_io *io)
{
    return (struct bytes_io *)io;
}

static bool make_room(struct bytes_io *bytes, size_t size)
{
    size_t room = (bytes->size + size) * 2 + 4096;
    char *data = bytes->io.store ? NULL : realloc(bytes->data, room);
    if (!data)
        return false;
    bytes->data = data;
    bytes->size = room;
    return true;
}

/*
 * The next `size` bytes. NULL if there are fewer; then later calls fail too.
 */
static char *claim(struct bytes_io *bytes, size_t size)
{
    bool is_there = bytes->size - bytes->at >= size || (!bytes->failed && make_room(bytes, size));
    if (bytes->failed || !is_there) {
        bytes->failed = true;
        return NULL;
    }
    bytes->at += size;
    return bytes->data + bytes->at - size;
}

static void plain(struct record_io *io, void *value, size_t size)
{
    char *place = claim(self(io), size);
    if (place && io->store)
        memcpy(value, place, size);
    else if (place)
        memcpy(place, value, size);
    else
        memset(value, 0, size);
}

/* ---- The coding ---- */

static void count(struct record_io *io, const char *key, uint64_t *value)
{
    (void)key;
    plain(io, value, sizeof *value);
}

static void write_text(struct record_io *io, const char *value)
{
    char *repaired = utf8_is_valid(value) ? NULL : utf8_repair(value);
    const char *text = repaired ? repaired : value;
    uint64_t len = strlen(text);
    count(io, NULL, &len);
    char *place = claim(self(io), (size_t)len + 1);
    if (place)
        memcpy(place, text, (size_t)len + 1);
    free(repaired);
}

static void text(struct record_io *io, const char *key, const char **value)
{
    struct bytes_io *bytes = self(io);
    uint64_t len = 0;
    (void)key;
    if (!io->store) {
        write_text(io, *value ? *value : "");
        return;
    }
    count(io, NULL, &len);
    const char *place = len < bytes->size ? claim(bytes, (size_t)len + 1) : NULL;
    bytes->failed = bytes->failed || !place || place[len] != '\0';
    *value = bytes->failed ? "" : place;
}

static unsigned name(struct record_io *io, const char *key, unsigned value,
                     const char *const *names, unsigned num_names)
{
    uint64_t index = value;
    (void)names;
    count(io, key, &index);
    self(io)->failed = self(io)->failed || index >= num_names;
    return self(io)->failed ? 0 : (unsigned)index;
}

static void flag(struct record_io *io, const char *key, bool *value)
{
    static const char *const names[] = {"false", "true"};
    *value = name(io, key, *value, names, 2) == 1;
}

static void write_time(struct record_io *io, const char *key, double *milliseconds)
{
    (void)key;
    plain(io, milliseconds, sizeof *milliseconds);
}

/* Each item has at least one byte. */
static size_t begin_array(struct record_io *io, const char *key, size_t num)
{
    struct bytes_io *bytes = self(io);
    uint64_t len = num;
    count(io, key, &len);
    bytes->failed = bytes->failed || (io->store && len > bytes->size - bytes->at);
    return bytes->failed ? 0 : (size_t)len;
}

static void end_array(struct record_io *io, const char *key, bool is_required)
{
    (void)io, (void)key, (void)is_required;
}

static void begin_or_end_object(struct record_io *io)
{
    (void)io;
}

static void parts(struct record_io *io, struct check_shader *shader)
{
    shader->num_parts = begin_array(io, NULL, shader->num_parts);
    if (io->store)
        shader->parts = store_array(io->store, shader->num_parts, sizeof *shader->parts);
    for (size_t i = 0; i < shader->num_parts; ++i) {
        struct check_part *part = &shader->parts[i];
        part->measure = (enum measure)name(io, NULL, part->measure, NULL, NUM_MEASURES);
        text(io, NULL, &part->name);
        count(io, NULL, &part->count);
    }
}

static void settings(struct record_io *io, const char *key, struct check_setting **settings,
                     size_t *num_settings)
{
    *num_settings = begin_array(io, key, *num_settings);
    if (io->store)
        *settings = store_array(io->store, *num_settings, sizeof **settings);
    for (size_t i = 0; i < *num_settings; ++i) {
        text(io, NULL, &(*settings)[i].path);
        text(io, NULL, &(*settings)[i].value);
    }
}

static const struct record_coding coding = {
    text,
    count,
    flag,
    write_time,
    name,
    parts,
    settings,
    begin_array,
    end_array,
    begin_or_end_object,
    begin_or_end_object,
};

void record_to_bytes(struct record_bytes *out, const struct check_document *document)
{
    struct bytes_io bytes = {{.coding = &coding}, out->data, .size = out->capacity};
    struct check_document copy = *document; /* the arrays are shared */
    record_members(&bytes.io, &copy);
    *out = (struct record_bytes){bytes.data, bytes.failed ? 0 : bytes.at, bytes.size};
}

struct check_document *record_from_bytes(struct store *store, const char *data, size_t size)
{
    struct bytes_io bytes = {{&coding, store}, (char *)(uintptr_t)data, .size = size};
    struct check_document *document = store_alloc(store, sizeof *document);
    record_members(&bytes.io, document);
    return bytes.failed || bytes.at != size || !*document->file ? NULL : document;
}
