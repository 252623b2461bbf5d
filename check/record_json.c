// SPDX-License-Identifier: Apache-2.0
#include "check/json.h"
#include "check/record_io.h"

#include <assert.h>
#include <math.h>
#include <string.h>

enum { MAX_DEPTH = 8 }; /* depth of arrays and objects in a record */

struct json_io {
    struct record_io io;
    bool with_times;
    /* the open arrays and objects; the last is the current one */
    struct {
        json_t *value;
        size_t num_read; /* number of items read */
    } open[MAX_DEPTH];
    unsigned depth;
};

static struct json_io *self(struct record_io *io)
{
    return (struct json_io *)io;
}

static json_t *at_hand(struct record_io *io)
{
    assert(self(io)->depth > 0);
    return self(io)->open[self(io)->depth - 1].value;
}

static json_t *get(struct record_io *io, const char *key)
{
    return key ? json_object_get(at_hand(io), key)
               : json_array_get(at_hand(io), self(io)->open[self(io)->depth - 1].num_read++);
}

static void put(struct record_io *io, const char *key, json_t *value)
{
    if (key)
        json_object_set_new(at_hand(io), key, value);
    else
        json_array_append_new(at_hand(io), value);
}

static void enter(struct record_io *io, json_t *value)
{
    struct json_io *json = self(io);
    assert(json->depth < MAX_DEPTH);
    json->open[json->depth].value = value;
    json->open[json->depth++].num_read = 0;
}

static json_t *leave(struct record_io *io)
{
    json_t *value = at_hand(io);
    --self(io)->depth;
    return value;
}

/* ---- The coding ---- */

static void text(struct record_io *io, const char *key, const char **value)
{
    if (io->store) {
        const char *read = json_string_value(get(io, key));
        *value = read ? store_text(io->store, read, strlen(read)) : "";
    } else if (!key || (*value && **value)) {
        put(io, key, json_text(*value));
    }
}

static void count(struct record_io *io, const char *key, uint64_t *value)
{
    if (io->store) {
        const json_t *read = get(io, key);
        /* any other value is no valid index either */
        *value = json_is_integer(read) && json_integer_value(read) >= 0
                     ? (uint64_t)json_integer_value(read)
                 : key ? 0
                       : UINT64_MAX;
    } else if (!key || *value) {
        put(io, key, json_integer((json_int_t)*value));
    }
}

static void flag(struct record_io *io, const char *key, bool *value)
{
    if (io->store)
        *value = json_is_true(get(io, key));
    else
        put(io, key, json_boolean(*value));
}

/* With at most three decimals. */
static void write_time(struct record_io *io, const char *key, double *milliseconds)
{
    if (io->store)
        *milliseconds = json_number_value(get(io, key));
    else if (self(io)->with_times && *milliseconds != 0.0)
        put(io, key, json_real(round(*milliseconds * 1e3) / 1e3));
}

static unsigned name(struct record_io *io, const char *key, unsigned value,
                     const char *const *names, unsigned num_names)
{
    if (!io->store)
        put(io, key, json_string(names[value]));
    for (unsigned i = 0; io->store && i < num_names; ++i)
        if (strcmp(names[i], json_text_of(at_hand(io), key)) == 0)
            return i;
    return io->store ? 0 : value;
}

static void read_parts(struct record_io *io, json_t *parts, struct check_shader *shader)
{
    for (int measure = 0; measure < NUM_MEASURES; ++measure) {
        const char *part;
        json_t *value;
        json_object_foreach(json_object_get(parts, measure_infos[measure].key), part, value)
        {
            json_int_t size = json_integer_value(value);
            shader->parts =
                store_grow(io->store, shader->parts, shader->num_parts, sizeof *shader->parts);
            shader->parts[shader->num_parts++] = (struct check_part){
                (enum measure)measure, store_text(io->store, part, strlen(part)),
                size > 0 ? (uint64_t)size : 0};
        }
    }
}

/* "parts": {"instructions": {"main": 12, …}, …} */
static void parts(struct record_io *io, struct check_shader *shader)
{
    if (io->store) {
        read_parts(io, get(io, "parts"), shader);
        return;
    }
    json_t *all = json_object();
    for (size_t i = 0; i < shader->num_parts; ++i) {
        const struct check_part *part = &shader->parts[i];
        const char *key = measure_infos[part->measure].key;
        if (!json_object_get(all, key))
            json_object_set_new(all, key, json_object());
        json_set(json_object_get(all, key), part->name, json_integer((json_int_t)part->count));
    }
    if (shader->num_parts)
        put(io, "parts", all);
    else
        json_decref(all);
}

static void read_settings(struct record_io *io, json_t *object, struct check_setting **settings,
                          size_t *num_settings)
{
    const char *path;
    json_t *value;
    *num_settings = 0;
    *settings = store_array(io->store, json_object_size(object), sizeof **settings);
    json_object_foreach(object, path, value)
    {
        const char *text = json_string_value(value);
        if (text)
            (*settings)[(*num_settings)++] =
                (struct check_setting){store_text(io->store, path, strlen(path)),
                                       store_text(io->store, text, strlen(text))};
    }
}

/* "values": {"SR/base": "0.5", …} */
static void settings(struct record_io *io, const char *key, struct check_setting **settings,
                     size_t *num_settings)
{
    if (io->store) {
        read_settings(io, get(io, key), settings, num_settings);
        return;
    }
    json_t *object = *num_settings ? json_object() : NULL;
    for (size_t i = 0; i < *num_settings; ++i)
        json_set(object, (*settings)[i].path, json_text((*settings)[i].value));
    if (object)
        put(io, key, object);
}

static size_t begin_array(struct record_io *io, const char *key, size_t num)
{
    enter(io, io->store ? get(io, key) : json_array());
    return io->store ? json_array_size(at_hand(io)) : num;
}

static void end_array(struct record_io *io, const char *key, bool is_required)
{
    json_t *array = leave(io);
    if (io->store)
        return;
    if (json_array_size(array) || is_required)
        put(io, key, array);
    else
        json_decref(array);
}

static void begin_object(struct record_io *io)
{
    enter(io, io->store ? get(io, NULL) : json_object());
}

static void end_object(struct record_io *io)
{
    json_t *object = leave(io);
    if (!io->store)
        put(io, NULL, object);
}

static const struct record_coding coding = {
    text,     count,       flag,      write_time,   name,       parts,
    settings, begin_array, end_array, begin_object, end_object,
};

json_t *record_to_json(const struct check_document *document, bool with_times)
{
    struct json_io json = {.io = {.coding = &coding}, .with_times = with_times};
    struct check_document copy = *document; /* the arrays are shared */
    json_t *object = json_object();
    enter(&json.io, object);
    put(&json.io, "index", json_integer((json_int_t)document->index));
    record_members(&json.io, &copy);
    assert(json.depth == 1);
    return object;
}

struct check_document *record_from_json(struct store *store, json_t *object)
{
    struct json_io json = {.io = {&coding, store}};
    struct check_document *document = store_alloc(store, sizeof *document);
    enter(&json.io, object);
    document->index = json_count_of(object, "index");
    record_members(&json.io, document);
    assert(json.depth == 1);
    return *document->file ? document : NULL;
}
