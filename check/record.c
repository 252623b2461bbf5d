// SPDX-License-Identifier: Apache-2.0
#include "check/record.h"

#include <string.h>

const char *const check_failure_names[NUM_CHECK_FAILURES] = {
#define FAILURE(name, text) text,
    CHECK_FAILURES(FAILURE)
#undef FAILURE
};

const struct measure_info measure_infos[NUM_MEASURES] = {
#define MEASURE(name, key, option, noun, meaning) {key, option, noun, meaning},
#include "check/measures.def"
#undef MEASURE
};

const char *const check_change_names[NUM_CHECK_CHANGES] = {
#define CHANGE(name, text, meaning, fails) text,
    CHECK_CHANGES(CHANGE)
#undef CHANGE
};

const char *const check_change_meanings[NUM_CHECK_CHANGES] = {
#define CHANGE(name, text, meaning, fails) meaning,
    CHECK_CHANGES(CHANGE)
#undef CHANGE
};

const check_change_set check_failing_changes =
#define CHANGE(name, text, meaning, fails) (fails ? 1u << CHANGE_##name : 0u) |
    CHECK_CHANGES(CHANGE)
#undef CHANGE
        0u;

void check_fail(enum check_failure *failed, enum check_failure failure)
{
    if (failure != CHECK_PASSED && (*failed == CHECK_PASSED || failure < *failed))
        *failed = failure;
}

/* True if a shader has this failure. */
static bool has_failed_shader(const struct check_document *document, enum check_failure failure)
{
    for (size_t i = 0; i < document->num_elements; ++i)
        for (size_t k = 0; k < document->elements[i].num_shaders; ++k)
            if (document->elements[i].shaders[k].failed == failure)
                return true;
    return false;
}

enum check_failure check_own_failure(const struct check_document *document)
{
    return has_failed_shader(document, document->failed) ? CHECK_PASSED : document->failed;
}

bool check_has_change(const struct check_document *document, check_change_set kinds)
{
    for (size_t i = 0; i < document->num_changes; ++i)
        if (kinds >> document->changes[i].kind & 1u)
            return true;
    return false;
}

uint32_t check_add_message(struct store *store, struct check_document *document,
                           const struct check_message *message)
{
    document->messages =
        store_grow(store, document->messages, document->num_messages, sizeof *message);
    document->messages[document->num_messages] = *message;
    if (!message->state)
        document->messages[document->num_messages].state = "";
    return (uint32_t)document->num_messages++;
}

/* Appends a text if it is new; the text must live in the store. */
static void add_once(struct store *store, const char ***texts, size_t *num_texts, const char *text)
{
    for (size_t i = 0; i < *num_texts; ++i)
        if (strcmp((*texts)[i], text) == 0)
            return;
    *texts = store_grow(store, *texts, *num_texts, sizeof **texts);
    (*texts)[(*num_texts)++] = text;
}

void check_add_file(struct store *store, struct check_document *document, const char *path)
{
    add_once(store, &document->files, &document->num_files, store_text(store, path, strlen(path)));
}

void check_add_image(struct store *store, struct check_document *document, const char *path)
{
    add_once(store, &document->images, &document->num_images,
             store_text(store, path, strlen(path)));
}

/* The length of a path up to its last '/'. */
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
    add_once(store, &document->folders, &document->num_folders, *folder ? folder : "./");
    if (from_len && len)
        add_once(store, &document->folders, &document->num_folders, store_text(store, file, len));
}
