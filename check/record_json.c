// SPDX-License-Identifier: Apache-2.0
#include "check/record_json.h"

#include "program/json_values.h"
#include "program/utf8.h"

#include <math.h>
#include <string.h>

/* ---- The members ---- */

enum field_kind {
    TEXT,    /* const char *; omitted if it is empty */
    SMALL,   /* uint32_t; omitted if it is 0, as all numbers */
    COUNT,   /* uint64_t */
    TIME,    /* double, in milliseconds with three decimals */
    FLAG,    /* bool */
    NAME,    /* an enum: an index into `names`; another name is the first one */
    OUTCOME, /* enum check_failure: "status", and for failures "failure" */
    LIST,    /* an array of structs, or of what stands alone: TEXT or SMALL */
    PARTS,   /* of a shader: {"instructions": {"main": 12, …}, …} */
    SETTINGS /* {"SR/base": "0.5", …} */
};

struct record_type;

struct field {
    const char *key;
    enum field_kind kind;
    size_t at;     /* offset of the member */
    size_t num_at; /* of an array: offset of its length */
    const struct record_type *items;
    bool is_required; /* an empty array is written, too */
    const char *const *names;
    unsigned num_names;
};

/* A struct, or with a single field without a key what stands alone in an array. */
struct record_type {
    size_t size;
    const struct field *fields;
    size_t num_fields;
};

#define TYPE(name, type, fields) \
    static const struct record_type name = {sizeof(type), fields, sizeof fields / sizeof *fields}
#define FIELD(kind, type, key, member) \
    { \
        key, kind, offsetof(struct type, member) \
    }
#define NAMED(type, key, member, words, num) \
    { \
        key, NAME, offsetof(struct type, member), .names = words, .num_names = num \
    }
#define ARRAY(kind, type, key, member, is_required, items) \
    { \
        key, kind, offsetof(struct type, member), offsetof(struct type, num_##member), items, \
            is_required \
    }

static const char *const severities[] = {"error", "warning", "note"};

static const struct field text_fields[] = {{NULL, TEXT}}, number_fields[] = {{NULL, SMALL}};
TYPE(text_type, const char *, text_fields);
TYPE(number_type, uint32_t, number_fields);

static const struct field note_fields[] = {
    FIELD(TEXT, check_note, "message", text),   FIELD(TEXT, check_note, "file", file),
    FIELD(SMALL, check_note, "line", line),     FIELD(SMALL, check_note, "column", column),
    FIELD(SMALL, check_note, "length", length),
};
TYPE(note_type, struct check_note, note_fields);

static const struct field message_fields[] = {
    NAMED(check_message, "severity", severity, severities, 3),
    FIELD(TEXT, check_message, "id", id),
    FIELD(TEXT, check_message, "message", text),
    FIELD(TEXT, check_message, "file", file),
    FIELD(SMALL, check_message, "line", line),
    FIELD(SMALL, check_message, "column", column),
    FIELD(SMALL, check_message, "length", length),
    FIELD(TEXT, check_message, "element", element),
    FIELD(TEXT, check_message, "target", target),
    FIELD(TEXT, check_message, "rendered", rendered),
    ARRAY(LIST, check_message, "notes", notes, false, &note_type),
    FIELD(TEXT, check_message, "baselineState", state),
};
TYPE(message_type, struct check_message, message_fields);

static const struct field shader_fields[] = {
    FIELD(TEXT, check_shader, "target", target),
    FIELD(OUTCOME, check_shader, NULL, failed),
    FIELD(FLAG, check_shader, "compiled", compiled),
    FIELD(TEXT, check_shader, "topology", topology),
#define MEASURE(name, key, option, noun, meaning) \
    FIELD(COUNT, check_shader, key, measures[MEASURE_##name]),
#include "check/measures.def"
#undef MEASURE
    FIELD(PARTS, check_shader, "parts", parts),
    ARRAY(LIST, check_shader, "messages", messages, false, &number_type),
    FIELD(TIME, check_shader, "generateMs", generate_ms),
    FIELD(TIME, check_shader, "compileMs", compile_ms),
};
TYPE(shader_type, struct check_shader, shader_fields);

static const struct field step_fields[] = {
    FIELD(TEXT, check_step, "step", text),
    FIELD(SMALL, check_step, "closuresBefore", closures_before),
    FIELD(SMALL, check_step, "closuresAfter", closures_after),
    FIELD(SMALL, check_step, "bytesBefore", bytes_before),
    FIELD(SMALL, check_step, "bytesAfter", bytes_after),
    FIELD(TEXT, check_step, "estimatedError", estimated),
    FIELD(TEXT, check_step, "drawnError", drawn),
};
TYPE(step_type, struct check_step, step_fields);

static const struct field element_fields[] = {
    FIELD(TEXT, check_element, "path", path),
    FIELD(TEXT, check_element, "type", type),
    ARRAY(LIST, check_element, "shaders", shaders, true, &shader_type),
    ARRAY(SETTINGS, check_element, "values", values, false, NULL),
    ARRAY(SETTINGS, check_element, "textures", textures, false, NULL),
    FIELD(TEXT, check_element, "signature", signature),
    FIELD(TEXT, check_element, "picture", picture),
    FIELD(TEXT, check_element, "slabs", slabs),
    FIELD(TEXT, check_element, "fullPicture", full),
    FIELD(TEXT, check_element, "drawnError", drawn_error),
    ARRAY(LIST, check_element, "steps", steps, false, &step_type),
};
TYPE(element_type, struct check_element, element_fields);

static const struct field change_fields[] = {
    NAMED(check_change, "kind", kind, check_change_names, NUM_CHECK_CHANGES),
    FIELD(TEXT, check_change, "element", element),
    FIELD(TEXT, check_change, "target", target),
    FIELD(TEXT, check_change, "text", text),
};
TYPE(change_type, struct check_change, change_fields);

static const struct field document_fields[] = {
    FIELD(TEXT, check_document, "file", file),
    FIELD(TEXT, check_document, "name", name),
    FIELD(OUTCOME, check_document, NULL, failed),
    ARRAY(LIST, check_document, "messages", messages, true, &message_type),
    FIELD(SMALL, check_document, "hiddenErrors", num_hidden),
    ARRAY(LIST, check_document, "files", files, true, &text_type),
    ARRAY(LIST, check_document, "folders", folders, false, &text_type),
    ARRAY(LIST, check_document, "images", images, false, &text_type),
    ARRAY(LIST, check_document, "elements", elements, true, &element_type),
    ARRAY(LIST, check_document, "changes", changes, false, &change_type),
    ARRAY(LIST, check_document, "goneMessages", gone_messages, false, &message_type),
    FIELD(TIME, check_document, "loadMs", load_ms),
    FIELD(TIME, check_document, "validateMs", validate_ms),
    FIELD(TIME, check_document, "renderMs", render_ms),
};
TYPE(document_type, struct check_document, document_fields);

/* ---- Writing ---- */

static json_t *write_object(const struct record_type *type, const char *item, bool with_times);

static json_t *write_text(const char *text, bool is_required)
{
    return is_required || (text && *text) ? json_text(text) : NULL;
}

static json_t *write_count(uint64_t count, bool is_required)
{
    return is_required || count ? json_integer((json_int_t)count) : NULL;
}

static json_t *write_list(const struct field *field, const char *item, bool with_times)
{
    const struct record_type *type = field->items;
    const char *items = *(const char *const *)(const void *)(item + field->at);
    size_t num = *(const size_t *)(const void *)(item + field->num_at);
    if (!num && !field->is_required)
        return NULL;
    json_t *array = json_array();
    for (size_t i = 0; i < num; ++i) {
        const void *at = items + i * type->size;
        json_array_append_new(array, type->fields->key ? write_object(type, at, with_times)
                                     : type->fields->kind == TEXT
                                         ? write_text(*(const char *const *)at, true)
                                         : write_count(*(const uint32_t *)at, true));
    }
    return array;
}

static json_t *write_parts(const struct check_shader *shader)
{
    json_t *all = shader->num_parts ? json_object() : NULL;
    for (size_t i = 0; i < shader->num_parts; ++i) {
        const struct check_part *part = &shader->parts[i];
        const char *key = measure_infos[part->measure].key;
        if (!json_object_get(all, key))
            json_object_set_new(all, key, json_object());
        json_set(json_object_get(all, key), part->name, json_integer((json_int_t)part->count));
    }
    return all;
}

static json_t *write_settings(const struct check_setting *settings, size_t num)
{
    json_t *object = num ? json_object() : NULL;
    for (size_t i = 0; i < num; ++i)
        json_set(object, settings[i].path, json_text(settings[i].value));
    return object;
}

static void write_outcome(json_t *out, enum check_failure failed)
{
    json_object_set_new(out, "status", json_string(failed ? "failed" : "passed"));
    if (failed)
        json_object_set_new(out, "failure", json_string(check_failure_names[failed]));
}

/* NULL: the member is omitted. */
static json_t *write_member(const struct field *field, const char *item, bool with_times)
{
    const void *at = item + field->at;
    switch (field->kind) {
    case TEXT: return write_text(*(const char *const *)at, false);
    case SMALL: return write_count(*(const uint32_t *)at, false);
    case COUNT: return write_count(*(const uint64_t *)at, false);
    case TIME:
        return with_times && *(const double *)at != 0.0
                   ? json_real(round(*(const double *)at * 1e3) / 1e3)
                   : NULL;
    case FLAG: return json_boolean(*(const bool *)at);
    case NAME: return json_string(field->names[*(const unsigned *)at]);
    case LIST: return write_list(field, item, with_times);
    case PARTS: return write_parts((const void *)item);
    case SETTINGS:
        return write_settings(*(const struct check_setting *const *)at,
                              *(const size_t *)(const void *)(item + field->num_at));
    case OUTCOME: break;
    }
    return NULL;
}

static void write_members(json_t *out, const struct record_type *type, const char *item,
                          bool with_times)
{
    for (size_t i = 0; i < type->num_fields; ++i) {
        const struct field *field = &type->fields[i];
        json_t *value = write_member(field, item, with_times);
        if (field->kind == OUTCOME)
            write_outcome(out, *(const enum check_failure *)(const void *)(item + field->at));
        else if (value)
            json_object_set_new(out, field->key, value);
    }
}

static json_t *write_object(const struct record_type *type, const char *item, bool with_times)
{
    json_t *object = json_object();
    write_members(object, type, item, with_times);
    return object;
}

json_t *record_to_json(const struct check_document *document, bool with_times)
{
    json_t *object = json_object();
    json_object_set_new(object, "index", json_integer((json_int_t)document->index));
    write_members(object, &document_type, (const char *)document, with_times);
    return object;
}

char *record_to_text(const struct check_document *document, size_t *out_size)
{
    json_t *object = record_to_json(document, true);
    char *text = json_dumps(object, JSON_STYLE);
    *out_size = text ? strlen(text) : 0;
    json_decref(object);
    return text;
}

/* ---- Reading ---- */

struct reading {
    struct store *store;
    bool is_damaged; /* a member has another type, or a word that it cannot have */
};

static void read_object(struct reading *r, json_t *object, const struct record_type *type,
                        char *out);

/* A copy: records come from other machines. */
static const char *keep_text(struct store *store, const char *from)
{
    char *text = store_text(store, from, strlen(from));
    utf8_clean(text);
    return text;
}

/* A member may be missing, which is 0 or "". */
static void expect(struct reading *r, const json_t *value, bool fits)
{
    r->is_damaged |= value && !fits;
}

static const char *read_text(struct reading *r, const json_t *value)
{
    const char *text = json_string_value(value);
    expect(r, value, text);
    return text ? keep_text(r->store, text) : "";
}

static uint64_t read_count(struct reading *r, const json_t *value)
{
    bool is_count = json_is_integer(value) && json_integer_value(value) >= 0;
    expect(r, value, is_count);
    return is_count ? (uint64_t)json_integer_value(value) : 0;
}

static uint32_t read_small(struct reading *r, const json_t *value)
{
    uint64_t count = read_count(r, value);
    expect(r, value, count <= UINT32_MAX);
    return count > UINT32_MAX ? UINT32_MAX : (uint32_t)count;
}

static unsigned read_name(struct reading *r, const json_t *value, const char *const *names,
                          unsigned num_names)
{
    const char *name = json_string_value(value);
    for (unsigned i = 0; name && i < num_names; ++i)
        if (strcmp(names[i], name) == 0)
            return i;
    expect(r, value, false);
    return 0;
}

/* A failure has a reason, and nothing else has one. */
static enum check_failure read_outcome(struct reading *r, const json_t *object)
{
    static const char *const states[] = {"passed", "failed"};
    const json_t *status = json_object_get(object, "status");
    bool failed = read_name(r, status, states, 2) == 1;
    unsigned failure =
        read_name(r, json_object_get(object, "failure"), check_failure_names, NUM_CHECK_FAILURES);
    r->is_damaged |= !status || failed != (failure != CHECK_PASSED);
    return (enum check_failure)failure;
}

static void read_list(struct reading *r, json_t *array, const struct field *field, char *out)
{
    const struct record_type *type = field->items;
    size_t num = json_array_size(array);
    char *items = store_array(r->store, num, type->size);
    expect(r, array, json_is_array(array));
    for (size_t i = 0; i < num; ++i) {
        json_t *value = json_array_get(array, i);
        void *at = items + i * type->size;
        if (type->fields->key)
            read_object(r, value, type, at);
        else if (type->fields->kind == TEXT)
            *(const char **)at = read_text(r, value);
        else
            *(uint32_t *)at = read_small(r, value);
    }
    *(char **)(void *)(out + field->at) = items;
    *(size_t *)(void *)(out + field->num_at) = num;
}

static void read_parts(struct reading *r, json_t *parts, struct check_shader *shader)
{
    for (int measure = 0; measure < NUM_MEASURES; ++measure) {
        const char *name;
        json_t *value;
        json_object_foreach(json_object_get(parts, measure_infos[measure].key), name, value)
        {
            shader->parts =
                store_grow(r->store, shader->parts, shader->num_parts, sizeof *shader->parts);
            shader->parts[shader->num_parts++] = (struct check_part){
                (enum measure)measure, keep_text(r->store, name), read_count(r, value)};
        }
    }
}

static void read_settings(struct reading *r, json_t *object, const struct field *field, char *out)
{
    const char *path;
    json_t *value;
    struct check_setting *settings =
        store_array(r->store, json_object_size(object), sizeof *settings);
    size_t num = 0;
    expect(r, object, json_is_object(object));
    json_object_foreach(object, path, value)
    {
        settings[num++] = (struct check_setting){keep_text(r->store, path), read_text(r, value)};
    }
    *(struct check_setting **)(void *)(out + field->at) = settings;
    *(size_t *)(void *)(out + field->num_at) = num;
}

static void read_member(struct reading *r, json_t *object, const struct field *field, char *out)
{
    json_t *value = field->key ? json_object_get(object, field->key) : NULL;
    void *at = out + field->at;
    switch (field->kind) {
    case TEXT: *(const char **)at = read_text(r, value); break;
    case SMALL: *(uint32_t *)at = read_small(r, value); break;
    case COUNT: *(uint64_t *)at = read_count(r, value); break;
    case TIME:
        expect(r, value, json_is_number(value));
        *(double *)at = json_number_value(value);
        break;
    case FLAG:
        expect(r, value, json_is_boolean(value));
        *(bool *)at = json_is_true(value);
        break;
    case NAME: *(unsigned *)at = read_name(r, value, field->names, field->num_names); break;
    case OUTCOME: *(enum check_failure *)at = read_outcome(r, object); break;
    case LIST: read_list(r, value, field, out); break;
    case PARTS: read_parts(r, value, (void *)out); break;
    case SETTINGS: read_settings(r, value, field, out); break;
    }
}

static void read_object(struct reading *r, json_t *object, const struct record_type *type,
                        char *out)
{
    expect(r, object, json_is_object(object));
    for (size_t i = 0; i < type->num_fields; ++i)
        read_member(r, object, &type->fields[i], out);
}

static bool has_messages(const struct check_shader *shader, size_t num_messages)
{
    for (size_t i = 0; i < shader->num_messages; ++i)
        if (shader->messages[i] >= num_messages)
            return false;
    return true;
}

struct check_document *record_from_json(struct store *store, json_t *object)
{
    struct reading r = {.store = store};
    struct check_document *document = store_alloc(store, sizeof *document);
    document->index = json_count_of(object, "index");
    read_object(&r, object, &document_type, (char *)document);
    for (size_t i = 0; i < document->num_elements; ++i)
        for (size_t k = 0; k < document->elements[i].num_shaders; ++k)
            r.is_damaged |=
                !has_messages(&document->elements[i].shaders[k], document->num_messages);
    return *document->file && !r.is_damaged ? document : NULL;
}

struct check_document *record_from_text(struct store *store, const char *text, size_t size)
{
    json_t *object = json_loadb(text, size, 0, NULL);
    struct check_document *document = record_from_json(store, object);
    json_decref(object);
    return document;
}
