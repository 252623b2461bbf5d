// SPDX-License-Identifier: Apache-2.0
/*
 * Both ways follow one description: each function below writes the member that it is given, or
 * reads it.
 */
#include "check/packed.h"

#include "cli/utf8.h"

#include <stdlib.h>
#include <string.h>

struct packer {
    struct store *store;
    char *bytes;
    size_t at, size; /* of room, or of what is there */
    bool reads, failed;
};

static bool make_room(struct packer *packer, size_t size)
{
    size_t room = (packer->size + size) * 2 + 4096;
    char *bytes = packer->reads ? NULL : realloc(packer->bytes, room);
    if (!bytes)
        return false;
    packer->bytes = bytes;
    packer->size = room;
    return true;
}

/*
 * The place of `size` bytes, behind which it goes on; NULL: there are not so many, and never will
 * be.
 */
static inline char *claim(struct packer *packer, size_t size)
{
    bool is_there =
        packer->size - packer->at >= size || (!packer->failed && make_room(packer, size));
    if (packer->failed || !is_there) {
        packer->failed = true;
        return NULL;
    }
    packer->at += size;
    return packer->bytes + packer->at - size;
}

static void plain(struct packer *packer, void *value, size_t size)
{
    char *place = claim(packer, size);
    if (place && packer->reads)
        memcpy(value, place, size);
    else if (place)
        memcpy(place, value, size);
}

static void number(struct packer *packer, uint32_t *value)
{
    plain(packer, value, sizeof *value);
}

static void real(struct packer *packer, double *value)
{
    plain(packer, value, sizeof *value);
}

/* One of `end` values from 0; returns it. */
static uint32_t choice(struct packer *packer, uint32_t value, uint32_t end)
{
    number(packer, &value);
    packer->failed = packer->failed || value >= end;
    return packer->failed ? 0 : value;
}

static bool is_ascii(const char *text, size_t size)
{
    uint64_t all = 0, word;
    for (; size >= sizeof word; text += sizeof word, size -= sizeof word) {
        memcpy(&word, text, sizeof word);
        all |= word;
    }
    for (; size; text++, size--)
        all |= (unsigned char)*text;
    return (all & 0x8080808080808080u) == 0;
}

static bool is_utf8(const char *text)
{
    size_t len = 1;
    for (; *text && len; text += len)
        len = utf8_length(text);
    return len > 0;
}

static const char *repair(struct packer *packer, const char *text)
{
    static const char replacement[] = "\xef\xbf\xbd";
    char *repaired = store_alloc(packer->store, strlen(text) * 3 + 1), *out = repaired;
    while (*text) {
        size_t len = utf8_length(text);
        memcpy(out, len ? text : replacement, len ? len : 3);
        out += len ? len : 3;
        text += len ? len : 1;
    }
    return repaired;
}

static void put_text(struct packer *packer, const char *value)
{
    value = value ? value : "";
    size_t size = strlen(value);
    if (!is_ascii(value, size) && !is_utf8(value)) {
        value = repair(packer, value);
        size = strlen(value);
    }
    uint32_t len = (uint32_t)size;
    packer->failed = packer->failed || size >= UINT32_MAX;
    number(packer, &len);
    char *place = claim(packer, size + 1);
    if (place && size)
        memcpy(place, value, size);
    if (place)
        place[size] = '\0';
}

static void text(struct packer *packer, const char **value)
{
    uint32_t len = 0;
    if (!packer->reads) {
        put_text(packer, *value);
        return;
    }
    number(packer, &len);
    const char *place = claim(packer, (size_t)len + 1);
    packer->failed = packer->failed || place[len] != '\0';
    *value = packer->failed ? "" : place;
}

/* The number of items, and where it reads, room for them. Each has a byte at least. */
static void *array(struct packer *packer, void *items, size_t *count, size_t item_size)
{
    uint64_t len = *count;
    plain(packer, &len, sizeof len);
    if (!packer->reads)
        return items;
    if (packer->failed || len > packer->size - packer->at) {
        packer->failed = true;
        len = 0;
    }
    *count = (size_t)len;
    return store_array(packer->store, *count, item_size);
}

static void texts(struct packer *packer, const char ***items, size_t *count)
{
    *items = array(packer, *items, count, sizeof **items);
    for (size_t i = 0; i < *count; ++i)
        text(packer, &(*items)[i]);
}

/* ---- The description ---- */

static void stage(struct packer *packer, enum check_stage *value)
{
    *value = (enum check_stage)choice(packer, *value, NUM_CHECK_STAGES);
}

static void message(struct packer *packer, struct check_message *message)
{
    message->severity = (mxg_severity)choice(packer, message->severity, MXG_SEVERITY_NOTE + 1);
    text(packer, &message->id);
    text(packer, &message->text);
    text(packer, &message->file);
    number(packer, &message->line);
    number(packer, &message->column);
    number(packer, &message->length);
    text(packer, &message->element);
    text(packer, &message->target);
    text(packer, &message->rendered);
}

static void part(struct packer *packer, struct check_part *part)
{
    part->measure = (enum measure)choice(packer, part->measure, NUM_MEASURES);
    text(packer, &part->name);
    plain(packer, &part->count, sizeof part->count);
}

static void shader(struct packer *packer, struct check_shader *shader, size_t num_messages)
{
    text(packer, &shader->target);
    stage(packer, &shader->failed);
    shader->compiled = choice(packer, shader->compiled, 2) == 1;
    text(packer, &shader->topology);
    plain(packer, shader->measures, sizeof shader->measures);
    shader->parts = array(packer, shader->parts, &shader->num_parts, sizeof *shader->parts);
    for (size_t i = 0; i < shader->num_parts; ++i)
        part(packer, &shader->parts[i]);
    shader->messages =
        array(packer, shader->messages, &shader->num_messages, sizeof *shader->messages);
    for (size_t i = 0; i < shader->num_messages; ++i)
        shader->messages[i] = choice(packer, shader->messages[i], (uint32_t)num_messages);
    real(packer, &shader->generate_ms);
    real(packer, &shader->compile_ms);
}

static void element(struct packer *packer, struct check_element *element, size_t num_messages)
{
    text(packer, &element->path);
    text(packer, &element->type);
    element->shaders =
        array(packer, element->shaders, &element->num_shaders, sizeof *element->shaders);
    for (size_t i = 0; i < element->num_shaders; ++i)
        shader(packer, &element->shaders[i], num_messages);
    text(packer, &element->picture);
    text(packer, &element->signature);
}

/* Without what is found out later: index and changes. */
static void document(struct packer *packer, struct check_document *document)
{
    text(packer, &document->file);
    stage(packer, &document->failed);
    document->messages =
        array(packer, document->messages, &document->num_messages, sizeof *document->messages);
    for (size_t i = 0; i < document->num_messages; ++i)
        message(packer, &document->messages[i]);
    texts(packer, &document->files, &document->num_files);
    texts(packer, &document->folders, &document->num_folders);
    texts(packer, &document->images, &document->num_images);
    document->elements =
        array(packer, document->elements, &document->num_elements, sizeof *document->elements);
    for (size_t i = 0; i < document->num_elements; ++i)
        element(packer, &document->elements[i], document->num_messages);
    real(packer, &document->load_ms);
    real(packer, &document->validate_ms);
    real(packer, &document->render_ms);
}

void check_pack_document(struct packed *out, struct store *store,
                         const struct check_document *record)
{
    struct packer packer = {.store = store, .bytes = out->bytes, .size = out->capacity};
    struct check_document copy = *record; /* arrays stay as they are */
    document(&packer, &copy);
    *out = (struct packed){packer.bytes, packer.failed ? 0 : packer.at, packer.size};
}

struct check_document *check_unpack_document(struct store *store, const char *bytes, size_t size)
{
    struct packer packer = {
        .store = store, .bytes = (char *)(uintptr_t)bytes, .size = size, .reads = true};
    struct check_document *read = store_alloc(store, sizeof *read);
    document(&packer, read);
    return packer.failed || packer.at != size || !*read->file ? NULL : read;
}
