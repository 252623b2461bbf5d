// SPDX-License-Identifier: Apache-2.0
/* Options of generation: the table, and values by key. */
#include "api/api.h"

#include "base/hash.h"
#include "base/num.h"

#include <assert.h>

struct mxg_options {
    struct object object;
    struct option_value values[NUM_OPTIONS];
    const char *error;
};

static const mxg_option table[NUM_OPTIONS] = {
#define OPTION(id, key, type, caps, task, values, initial, doc) \
    {sizeof(mxg_option), key, MXG_OPTION_##type, values, initial, doc},
#include "api/options.def"

#undef OPTION
};

/* The capabilities that an option needs of a target, and the task of a role that it sets. */
static const struct need {
    uint64_t caps;
    enum role_task task;
} needs[NUM_OPTIONS] = {
#define OPTION(id, key, type, caps, task, values, initial, doc) {caps, TASK_##task},
#include "api/options.def"
#undef OPTION
};

enum role_task option_task(enum option_id option)
{
    return needs[option].task;
}

const char *option_key(enum option_id option)
{
    assert((unsigned)option < NUM_OPTIONS);
    return table[option].key;
}

uint32_t mxg_catalogue_num_options(void)
{
    return NUM_OPTIONS;
}

mxg_status mxg_catalogue_option(uint32_t index, mxg_option *out)
{
    return index < NUM_OPTIONS ? struct_write(out, &table[index], sizeof table[index])
                               : MXG_ERROR_ARGUMENT;
}

static bool option_applies(enum option_id option, const struct target *target)
{
    return target_lacks(target, NULL, needs[option].caps) == 0;
}

bool mxg_catalogue_has_option(uint32_t index, const char *target)
{
    const struct target *found = target ? target_find(target) : NULL;
    return found && index < NUM_OPTIONS && option_applies((enum option_id)index, found);
}

/* ---- Values from text ---- */

static bool parse_bool(const char *text, struct option_value *out)
{
    out->number = strcmp(text, "true") == 0;
    return out->number || strcmp(text, "false") == 0;
}

/* "0..1024" */
static bool parse_int(const mxg_option *option, const char *text, struct option_value *out)
{
    int64_t low = 0, high = 0, value = 0;
    size_t len = strlen(text),
           low_len = num_parse_int(option->values, strlen(option->values), &low);
    const char *rest = option->values + low_len + 2;
    num_parse_int(rest, strlen(rest), &high);
    assert(low_len > 0 && low < high);
    if (len == 0 || num_parse_int(text, len, &value) != len || value < low || value > high)
        return false;
    assert(value >= INT32_MIN && value <= INT32_MAX);
    out->number = (int32_t)value;
    return true;
}

/* "0..100"; an empty text is no value */
static bool parse_float(struct arena *arena, const mxg_option *option, const char *text,
                        struct option_value *out)
{
    float low = 0, high = 0, value = -1.0f;
    size_t len = strlen(text),
           low_len = num_parse_float(option->values, strcspn(option->values, "."), &low);
    const char *rest = option->values + low_len + 2;
    num_parse_float(rest, strlen(rest), &high);
    assert(low_len > 0 && low < high && low >= 0.0f);
    if (len && (num_parse_float(text, len, &value) != len || !(value >= low && value <= high)))
        return false;
    out->real = value;
    out->text = arena_strndup(arena, text, len);
    return true;
}

/* The number of a word of "a|b"; -1: it is none. */
static int32_t find_word(const char *words, const char *text, size_t len)
{
    for (int32_t number = 0; *words; number++) {
        size_t word_len = strcspn(words, "|");
        if (word_len == len && memcmp(words, text, len) == 0)
            return number;
        words += word_len + (words[word_len] == '|');
    }
    return -1;
}

static bool parse_enum(struct arena *arena, const mxg_option *option, const char *text,
                       struct option_value *out)
{
    assert(option->type == MXG_OPTION_ENUM);
    size_t len = strlen(text);
    out->number = find_word(option->values, text, len);
    out->text = arena_strndup(arena, text, len);
    return out->number >= 0;
}

/* The length of the first item that is no word of the option; 0: there is none. */
static size_t bad_item(const mxg_option *option, const char **text)
{
    for (size_t len; *option->values && **text; *text += len + ((*text)[len] == ',')) {
        len = strcspn(*text, ",");
        if (len && find_word(option->values, *text, len) < 0)
            return len;
    }
    return 0;
}

static bool parse_list(struct arena *arena, const mxg_option *option, const char *text,
                       struct option_value *out)
{
    const char *rest = text;
    if (bad_item(option, &rest))
        return false;
    if (!out->is_set)
        out->list.len = 0; /* the first setting replaces the default */
    while (*text) {
        size_t len = strcspn(text, ",");
        if (len)
            vec_push(arena, &out->list, arena_strndup(arena, text, len));
        text += len + (text[len] == ',');
    }
    return true;
}

enum { MAX_IDENTIFIER = 64 };

static bool parse_string(struct arena *arena, const mxg_option *option, const char *text,
                         struct option_value *out)
{
    size_t len = strlen(text);
    out->text = arena_strndup(arena, text, len);
    return !*option->values || !len || (len <= MAX_IDENTIFIER && identifier_is(text, len));
}

static bool parse(struct arena *arena, const mxg_option *option, const char *text,
                  struct option_value *out)
{
    switch (option->type) {
    case MXG_OPTION_BOOL: return parse_bool(text, out);
    case MXG_OPTION_INT: return parse_int(option, text, out);
    case MXG_OPTION_FLOAT: return parse_float(arena, option, text, out);
    case MXG_OPTION_ENUM: return parse_enum(arena, option, text, out);
    case MXG_OPTION_LIST: return parse_list(arena, option, text, out);
    default: return parse_string(arena, option, text, out);
    }
}

static void set_defaults(struct arena *arena, struct option_value *values)
{
    for (unsigned i = 0; i < NUM_OPTIONS; i++)
        parse(arena, &table[i], table[i].initial, &values[i]);
}

void option_reset(enum option_id option, struct arena *arena, struct option_value *value)
{
    *value = (struct option_value){0};
    parse(arena, &table[option], table[option].initial, value);
}

bool option_differs(enum option_id option, const struct option_value *value)
{
    const mxg_option *row = &table[option];
    if (row->type == MXG_OPTION_LIST)
        return true;
    struct option_value initial = {0};
    if (row->type == MXG_OPTION_BOOL)
        parse_bool(row->initial, &initial);
    else if (row->type == MXG_OPTION_INT)
        parse_int(row, row->initial, &initial);
    else
        return strcmp(row->initial, value->text) != 0;
    return initial.number != value->number;
}

uint64_t options_hash(const struct option_value *values)
{
    uint64_t h = HASH_STABLE_SEED;
    for (unsigned i = 0; i < NUM_OPTIONS; i++) {
        const struct option_value *value = &values[i];
        h = hash_stable(h, &value->number, sizeof value->number);
        if (value->text)
            h = hash_stable(h, value->text, strlen(value->text) + 1);
        for (uint32_t item = 0; item < value->list.len; item++)
            h = hash_stable(h, value->list.items[item], strlen(value->list.items[item]) + 1);
        h = hash_mix(h, value->list.len);
    }
    return h;
}

const struct option_value *options_values(const mxg_options *options)
{
    return options->values;
}

static unsigned find_key(const char *key)
{
    unsigned i = 0;
    while (i < NUM_OPTIONS && strcmp(table[i].key, key) != 0)
        i++;
    return i;
}

struct option_value *options_for(const struct target *target, const mxg_options *options,
                                 struct arena *arena, const struct dialect *dialect)
{
    struct option_value *values = ARENA_ARRAY(arena, struct option_value, NUM_OPTIONS);
    set_defaults(arena, values);
    for (unsigned i = 0; options && i < NUM_OPTIONS; i++)
        if (option_applies((enum option_id)i, target))
            values[i] = options->values[i];
    for (size_t i = 0; dialect && i < dialect->num_options; i++) {
        unsigned option = find_key(dialect->options[2 * i]);
        if (!values[option].is_set)
            parse(arena, &table[option], dialect->options[2 * i + 1], &values[option]);
    }
    return values;
}

/* ---- Faults ---- */

static const char *expected(struct arena *arena, const mxg_option *option)
{
    struct text text;
    text_init(&text, arena);
    if (option->type == MXG_OPTION_BOOL)
        return "true or false";
    if (option->type == MXG_OPTION_STRING)
        return "an identifier of at most 64 characters, without '__' and 'gl_'";
    if (option->type == MXG_OPTION_INT)
        text_str(&text, "an integer of ");
    if (option->type == MXG_OPTION_FLOAT)
        text_str(&text, "a number of ");
    for (const char *c = option->values; *c; c++) {
        if (*c == '|')
            text_str(&text, ", ");
        else
            text_char(&text, *c);
    }
    return text_cstr(&text);
}

static const char *unknown_key(struct arena *arena, const char *key)
{
    const char *keys[NUM_OPTIONS];
    for (unsigned i = 0; i < NUM_OPTIONS; i++)
        keys[i] = table[i].key;
    struct text text;
    struct diag_list list; /* for the suggestion; struct options holds its own message */
    text_init(&text, arena);
    diag_list_init(&list, arena);
    text_fmt(&text, "unknown option '%s'%s", key, diag_suggest(&list, key, keys, NUM_OPTIONS));
    return text_cstr(&text);
}

static const char *bad_value(struct arena *arena, const mxg_option *option, const char *value)
{
    struct text text;
    text_init(&text, arena);
    size_t len = option->type == MXG_OPTION_LIST ? bad_item(option, &value) : strlen(value);
    text_fmt(&text, "'%.*s' is not a value of option '%s'; expected %s", (int)len, value,
             option->key, expected(arena, option));
    return text_cstr(&text);
}

const char *option_fault(const struct target *target, const char *key, const char *value,
                         struct arena *arena)
{
    struct option_value out = {0};
    unsigned i = find_key(key);
    if (i == NUM_OPTIONS)
        return unknown_key(arena, key);
    if (parse(arena, &table[i], value, &out))
        return option_applies((enum option_id)i, target) ? NULL : "its base has no such option";
    return bad_value(arena, &table[i], value);
}

/* ---- The caller's options ---- */

static void init_options(void *arg)
{
    mxg_options *options = arg;
    set_defaults(&options->object.arena, options->values);
}

mxg_status mxg_options_create(mxg_context *context, mxg_options **out_options)
{
    if (out_options)
        *out_options = NULL;
    if (!context || !out_options)
        return MXG_ERROR_ARGUMENT;
    mxg_options *options = object_new(context, sizeof *options, NULL);
    if (!options)
        return MXG_ERROR_MEMORY;
    mxg_status status = object_run(&options->object, init_options, options);
    if (status == MXG_OK)
        *out_options = options;
    else
        object_unref(&options->object);
    return status;
}

void mxg_options_destroy(mxg_options *options)
{
    object_unref(options ? &options->object : NULL);
}

struct setting {
    mxg_options *options;
    const char *key, *value;
    bool good;
};

static void set(void *arg)
{
    struct setting *setting = arg;
    mxg_options *options = setting->options;
    struct arena *arena = &options->object.arena;
    unsigned i = find_key(setting->key);
    if (i == NUM_OPTIONS) {
        options->error = unknown_key(arena, setting->key);
        return;
    }
    struct option_value value = options->values[i];
    setting->good = parse(arena, &table[i], setting->value, &value);
    if (setting->good) {
        value.is_set = true;
        options->values[i] = value;
        return;
    }
    options->error = bad_value(arena, &table[i], setting->value);
}

mxg_status mxg_options_set(mxg_options *options, const char *key, const char *value)
{
    if (!options || !key || !value)
        return MXG_ERROR_ARGUMENT;
    struct setting setting = {options, key, value, false};
    options->error = NULL;
    mxg_status status = object_run(&options->object, set, &setting);
    return status == MXG_OK && !setting.good ? MXG_ERROR_ARGUMENT : status;
}

size_t mxg_options_error(const mxg_options *options, char *buffer, size_t capacity)
{
    const char *error = options && options->error ? options->error : "";
    return text_copy(error, strlen(error), buffer, capacity);
}
