// SPDX-License-Identifier: Apache-2.0
#include "check/record.h"

#include <string.h>

static const char *const stage_names[NUM_CHECK_STAGES] = {
#define STAGE(name, text) text,
    CHECK_STAGES(STAGE)
#undef STAGE
};

const struct measure_info measure_infos[NUM_MEASURES] = {
#define MEASURE(name, key, option, noun, meaning) {key, option, noun, meaning},
#include "check/measures.def"
#undef MEASURE
};

static const char *const change_names[NUM_CHECK_CHANGES] = {
#define CHANGE(name, text) text,
    CHECK_CHANGES(CHANGE)
#undef CHANGE
};

static const char *const severities[] = {"error", "warning", "note"};

const char *check_stage_name(enum check_stage stage)
{
    return stage_names[stage];
}

const char *check_change_name(enum check_change_kind kind)
{
    return change_names[kind];
}

void check_fail(enum check_stage *failed, enum check_stage stage)
{
    if (stage != CHECK_PASSED && (*failed == CHECK_PASSED || stage < *failed))
        *failed = stage;
}

bool check_is_same_message(const struct check_message *a, const struct check_message *b)
{
    return a->line == b->line && a->column == b->column && strcmp(a->id, b->id) == 0
           && strcmp(a->text, b->text) == 0 && strcmp(a->file, b->file) == 0;
}

uint32_t check_add_message(struct store *store, struct check_document *document,
                           const struct check_message *message)
{
    document->messages =
        store_grow(store, document->messages, document->num_messages, sizeof *message);
    document->messages[document->num_messages] = *message;
    return (uint32_t)document->num_messages++;
}

static bool has_text(const char *const *texts, size_t count, const char *text)
{
    for (size_t i = 0; i < count; ++i)
        if (strcmp(texts[i], text) == 0)
            return true;
    return false;
}

static void add_folder(struct store *store, struct check_document *document, const char *folder)
{
    if (has_text(document->folders, document->num_folders, folder))
        return;
    document->folders =
        store_grow(store, document->folders, document->num_folders, sizeof *document->folders);
    document->folders[document->num_folders++] = folder;
}

void check_add_file(struct store *store, struct check_document *document, const char *path)
{
    if (has_text(document->files, document->num_files, path))
        return;
    document->files =
        store_grow(store, document->files, document->num_files, sizeof *document->files);
    document->files[document->num_files++] = store_text(store, path, strlen(path));
}

void check_add_image(struct store *store, struct check_document *document, const char *path)
{
    if (has_text(document->images, document->num_images, path))
        return;
    document->images =
        store_grow(store, document->images, document->num_images, sizeof *document->images);
    document->images[document->num_images++] = store_text(store, path, strlen(path));
}

/* The part of a path that ends with its last '/'. */
static size_t folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

void check_add_place(struct store *store, struct check_document *document, const char *from,
                     const char *file)
{
    size_t len = folder_length(file), from_len = file[0] == '/' ? 0 : folder_length(from);
    char *folder = store_alloc(store, from_len + len + 3);
    memcpy(folder, from, from_len);
    memcpy(folder + from_len, file, len);
    add_folder(store, document, *folder ? folder : "./");
    if (from_len && len)
        add_folder(store, document, store_text(store, file, len));
}

/* ---- Writing ---- */

static void put_outcome(struct json_writer *json, enum check_stage failed)
{
    json_put_string(json, "status", failed ? "failed" : "passed");
    json_put_string(json, "stage", failed ? stage_names[failed] : "");
}

static void write_message(struct json_writer *json, const struct check_message *message)
{
    json_begin(json, '{');
    json_put_string(json, "severity", severities[message->severity]);
    json_put_string(json, "id", message->id);
    json_put_string(json, "message", message->text);
    json_put_string(json, "file", message->file);
    json_put_count(json, "line", message->line);
    json_put_count(json, "column", message->column);
    json_put_count(json, "length", message->length);
    json_put_string(json, "element", message->element);
    json_put_string(json, "target", message->target);
    json_put_string(json, "rendered", message->rendered);
    json_end(json, '}');
}

/* "parts": {"instructions": {"main": 12, …}, …} */
static void write_parts(struct json_writer *json, const struct check_shader *shader)
{
    if (shader->num_parts == 0)
        return;
    json_key(json, "parts");
    json_begin(json, '{');
    for (size_t i = 0; i < shader->num_parts; ++i) {
        const struct check_part *part = &shader->parts[i];
        if (i == 0 || part->measure != part[-1].measure) {
            if (i)
                json_end(json, '}');
            json_key(json, measure_infos[part->measure].key);
            json_begin(json, '{');
        }
        json_key(json, part->name);
        json_count(json, part->count);
    }
    json_end(json, '}');
    json_end(json, '}');
}

static void write_shader(struct json_writer *json, const struct check_shader *shader,
                         bool with_times)
{
    json_begin(json, '{');
    json_put_string(json, "target", shader->target);
    put_outcome(json, shader->failed);
    json_key(json, "compiled");
    json_bool(json, shader->compiled);
    json_put_string(json, "topology", shader->topology);
    for (size_t i = 0; i < NUM_MEASURES; ++i)
        json_put_count(json, measure_infos[i].key, shader->measures[i]);
    write_parts(json, shader);
    if (shader->num_messages) {
        json_key(json, "messages");
        json_begin(json, '[');
        for (size_t i = 0; i < shader->num_messages; ++i)
            json_count(json, shader->messages[i]);
        json_end(json, ']');
    }
    json_put_number(json, "generateMs", with_times ? shader->generate_ms : 0.0);
    json_put_number(json, "compileMs", with_times ? shader->compile_ms : 0.0);
    json_end(json, '}');
}

static void write_element(struct json_writer *json, const struct check_element *element,
                          bool with_times)
{
    json_begin(json, '{');
    json_put_string(json, "path", element->path);
    json_put_string(json, "type", element->type);
    json_key(json, "shaders");
    json_begin(json, '[');
    for (size_t i = 0; i < element->num_shaders; ++i)
        write_shader(json, &element->shaders[i], with_times);
    json_end(json, ']');
    json_put_string(json, "signature", element->signature);
    json_put_string(json, "picture", element->picture);
    json_end(json, '}');
}

static void write_texts(struct json_writer *json, const char *key, const char *const *texts,
                        size_t count)
{
    json_key(json, key);
    json_begin(json, '[');
    for (size_t i = 0; i < count; ++i)
        json_string(json, texts[i]);
    json_end(json, ']');
}

static void write_changes(struct json_writer *json, const struct check_document *document)
{
    if (document->num_changes == 0)
        return;
    json_key(json, "changes");
    json_begin(json, '[');
    for (size_t i = 0; i < document->num_changes; ++i) {
        const struct check_change *change = &document->changes[i];
        json_begin(json, '{');
        json_put_string(json, "kind", change_names[change->kind]);
        json_put_string(json, "element", change->element);
        json_put_string(json, "target", change->target);
        json_put_string(json, "text", change->text);
        json_end(json, '}');
    }
    json_end(json, ']');
}

void check_write_document(FILE *out, const struct check_document *document, bool with_times)
{
    struct json_writer json = {.out = out};
    json_begin(&json, '{');
    json_key(&json, "index");
    json_count(&json, document->index);
    json_put_string(&json, "file", document->file);
    put_outcome(&json, document->failed);
    json_key(&json, "messages");
    json_begin(&json, '[');
    for (size_t i = 0; i < document->num_messages; ++i)
        write_message(&json, &document->messages[i]);
    json_end(&json, ']');
    write_texts(&json, "files", document->files, document->num_files);
    if (document->num_folders)
        write_texts(&json, "folders", document->folders, document->num_folders);
    if (document->num_images)
        write_texts(&json, "images", document->images, document->num_images);
    json_key(&json, "elements");
    json_begin(&json, '[');
    for (size_t i = 0; i < document->num_elements; ++i)
        write_element(&json, &document->elements[i], with_times);
    json_end(&json, ']');
    write_changes(&json, document);
    json_put_number(&json, "loadMs", with_times ? document->load_ms : 0.0);
    json_put_number(&json, "validateMs", with_times ? document->validate_ms : 0.0);
    json_put_number(&json, "renderMs", with_times ? document->render_ms : 0.0);
    json_end(&json, '}');
}

/* ---- Reading ---- */

static size_t count_items(const struct json_value *array)
{
    size_t count = 0;
    for (const struct json_value *item = array->first; item; item = item->next)
        ++count;
    return count;
}

static unsigned find_name(const char *name, const char *const *names, unsigned num_names)
{
    for (unsigned i = 0; i < num_names; ++i)
        if (strcmp(names[i], name) == 0)
            return i;
    return 0;
}

static enum check_stage read_outcome(const struct json_value *value)
{
    if (strcmp(json_get_text(value, "status"), "failed") != 0)
        return CHECK_PASSED;
    enum check_stage stage =
        (enum check_stage)find_name(json_get_text(value, "stage"), stage_names, NUM_CHECK_STAGES);
    return stage ? stage : CHECK_LOAD;
}

static uint32_t get_u32(const struct json_value *value, const char *key)
{
    uint64_t count = json_get_count(value, key);
    return count > UINT32_MAX ? UINT32_MAX : (uint32_t)count;
}

static void read_message(struct check_message *out, const struct json_value *value)
{
    out->severity = (mxg_severity)find_name(json_get_text(value, "severity"), severities, 3);
    out->id = json_get_text(value, "id");
    out->text = json_get_text(value, "message");
    out->file = json_get_text(value, "file");
    out->line = get_u32(value, "line");
    out->column = get_u32(value, "column");
    out->length = get_u32(value, "length");
    out->element = json_get_text(value, "element");
    out->target = json_get_text(value, "target");
    out->rendered = json_get_text(value, "rendered");
}

static void read_parts(struct store *store, struct check_shader *out,
                       const struct json_value *parts)
{
    for (int measure = 0; measure < NUM_MEASURES; ++measure) {
        for (const struct json_value *item = json_get(parts, measure_infos[measure].key)->first;
             item; item = item->next) {
            if (!item->key)
                continue;
            out->parts = store_grow(store, out->parts, out->num_parts, sizeof *out->parts);
            out->parts[out->num_parts++] = (struct check_part){
                (enum measure)measure, item->key, item->number > 0.0 ? (uint64_t)item->number : 0};
        }
    }
}

/* Only indices of messages that are there. */
static void read_indices(struct store *store, struct check_shader *out,
                         const struct json_value *indices, size_t num_messages)
{
    out->messages = store_array(store, count_items(indices), sizeof *out->messages);
    for (const struct json_value *item = indices->first; item; item = item->next)
        if (item->number >= 0.0 && item->number < (double)num_messages)
            out->messages[out->num_messages++] = (uint32_t)item->number;
}

static void read_shader(struct store *store, struct check_shader *out,
                        const struct json_value *value, size_t num_messages)
{
    out->target = json_get_text(value, "target");
    out->failed = read_outcome(value);
    out->compiled = json_get(value, "compiled")->kind == JSON_TRUE;
    out->topology = json_get_text(value, "topology");
    for (size_t i = 0; i < NUM_MEASURES; ++i)
        out->measures[i] = json_get_count(value, measure_infos[i].key);
    read_parts(store, out, json_get(value, "parts"));
    read_indices(store, out, json_get(value, "messages"), num_messages);
    out->generate_ms = json_get_number(value, "generateMs");
    out->compile_ms = json_get_number(value, "compileMs");
}

static void read_element(struct store *store, struct check_element *out,
                         const struct json_value *value, size_t num_messages)
{
    const struct json_value *shaders = json_get(value, "shaders");
    out->path = json_get_text(value, "path");
    out->type = json_get_text(value, "type");
    out->picture = json_get_text(value, "picture");
    out->signature = json_get_text(value, "signature");
    out->shaders = store_array(store, count_items(shaders), sizeof *out->shaders);
    for (const struct json_value *item = shaders->first; item; item = item->next)
        read_shader(store, &out->shaders[out->num_shaders++], item, num_messages);
}

static const char **read_texts(struct store *store, const struct json_value *array,
                               size_t *out_count)
{
    const char **texts = store_array(store, count_items(array), sizeof *texts);
    for (const struct json_value *item = array->first; item; item = item->next)
        texts[(*out_count)++] = item->kind == JSON_STRING ? item->text : "";
    return texts;
}

static void read_changes(struct store *store, struct check_document *out,
                         const struct json_value *changes)
{
    out->changes = store_array(store, count_items(changes), sizeof *out->changes);
    for (const struct json_value *item = changes->first; item; item = item->next)
        out->changes[out->num_changes++] =
            (struct check_change){(enum check_change_kind)find_name(
                                      json_get_text(item, "kind"), change_names, NUM_CHECK_CHANGES),
                                  json_get_text(item, "element"), json_get_text(item, "target"),
                                  json_get_text(item, "text")};
}

struct check_document *check_read_document(struct store *store, const char *text, size_t len)
{
    const struct json_value *value = json_parse(store, text, len);
    if (!value || !*json_get_text(value, "file"))
        return NULL;
    struct check_document *document = store_alloc(store, sizeof *document);
    const struct json_value *messages = json_get(value, "messages"),
                            *elements = json_get(value, "elements");
    document->index = json_get_count(value, "index");
    document->file = json_get_text(value, "file");
    document->failed = read_outcome(value);
    document->messages = store_array(store, count_items(messages), sizeof *document->messages);
    for (const struct json_value *item = messages->first; item; item = item->next)
        read_message(&document->messages[document->num_messages++], item);
    document->files = read_texts(store, json_get(value, "files"), &document->num_files);
    document->folders = read_texts(store, json_get(value, "folders"), &document->num_folders);
    document->images = read_texts(store, json_get(value, "images"), &document->num_images);
    document->elements = store_array(store, count_items(elements), sizeof *document->elements);
    for (const struct json_value *item = elements->first; item; item = item->next)
        read_element(store, &document->elements[document->num_elements++], item,
                     document->num_messages);
    read_changes(store, document, json_get(value, "changes"));
    document->load_ms = json_get_number(value, "loadMs");
    document->validate_ms = json_get_number(value, "validateMs");
    document->render_ms = json_get_number(value, "renderMs");
    return document;
}
