// SPDX-License-Identifier: Apache-2.0
#include "check/record_io.h"

static void text(struct record_io *io, const char *key, const char **value)
{
    io->coding->text(io, key, value);
}

static void small_count(struct record_io *io, const char *key, uint32_t *value)
{
    uint64_t count = *value;
    io->coding->count(io, key, &count);
    *value = count > UINT32_MAX ? UINT32_MAX : (uint32_t)count;
}

/*
 * Begins an array; returns its items: the given items when writing, memory for new ones when
 * reading.
 */
static void *begin_array(struct record_io *io, const char *key, void *items, size_t *num,
                         size_t item_size)
{
    *num = io->coding->begin_array(io, key, *num);
    return io->store ? store_array(io->store, *num, item_size) : items;
}

/* An array of objects, each described by `members`; returns the items. */
static void *objects(struct record_io *io, const char *key, bool is_required, void *items,
                     size_t *num, size_t item_size,
                     void (*members)(struct record_io *io, void *item))
{
    items = begin_array(io, key, items, num, item_size);
    for (size_t i = 0; i < *num; ++i) {
        io->coding->begin_object(io);
        members(io, (char *)items + i * item_size);
        io->coding->end_object(io);
    }
    io->coding->end_array(io, key, is_required);
    return items;
}

static void texts(struct record_io *io, const char *key, bool is_required, const char ***items,
                  size_t *num)
{
    *items = begin_array(io, key, *items, num, sizeof **items);
    for (size_t i = 0; i < *num; ++i)
        text(io, NULL, &(*items)[i]);
    io->coding->end_array(io, key, is_required);
}

/* "status", and for failures "stage". */
static void outcome(struct record_io *io, enum check_stage *failed)
{
    static const char *const statuses[] = {"passed", "failed"};
    if (!io->coding->name(io, "status", *failed != CHECK_PASSED, statuses, 2)) {
        *failed = CHECK_PASSED;
        return;
    }
    *failed = (enum check_stage)io->coding->name(io, "stage", *failed, check_stage_names,
                                                 NUM_CHECK_STAGES);
    if (*failed == CHECK_PASSED) /* an unknown name */
        *failed = CHECK_LOAD;
}

static void note(struct record_io *io, void *item)
{
    struct check_note *note = item;
    text(io, "message", &note->text);
    text(io, "file", &note->file);
    small_count(io, "line", &note->line);
    small_count(io, "column", &note->column);
    small_count(io, "length", &note->length);
}

static void message(struct record_io *io, void *item)
{
    static const char *const severities[] = {"error", "warning", "note"};
    struct check_message *message = item;
    message->severity =
        (mxg_severity)io->coding->name(io, "severity", message->severity, severities, 3);
    text(io, "id", &message->id);
    text(io, "message", &message->text);
    text(io, "file", &message->file);
    small_count(io, "line", &message->line);
    small_count(io, "column", &message->column);
    small_count(io, "length", &message->length);
    text(io, "element", &message->element);
    text(io, "target", &message->target);
    text(io, "rendered", &message->rendered);
    message->notes = objects(io, "notes", false, message->notes, &message->num_notes,
                             sizeof *message->notes, note);
    text(io, "baselineState", &message->state);
}

static void shader(struct record_io *io, void *item)
{
    struct check_shader *shader = item;
    text(io, "target", &shader->target);
    outcome(io, &shader->failed);
    io->coding->flag(io, "compiled", &shader->compiled);
    text(io, "topology", &shader->topology);
    for (size_t i = 0; i < NUM_MEASURES; ++i)
        io->coding->count(io, measure_infos[i].key, &shader->measures[i]);
    io->coding->parts(io, shader);
    shader->messages = begin_array(io, "messages", shader->messages, &shader->num_messages,
                                   sizeof *shader->messages);
    for (size_t i = 0; i < shader->num_messages; ++i)
        small_count(io, NULL, &shader->messages[i]);
    io->coding->end_array(io, "messages", false);
    io->coding->time(io, "generateMs", &shader->generate_ms);
    io->coding->time(io, "compileMs", &shader->compile_ms);
}

static void step(struct record_io *io, void *item)
{
    struct check_step *step = item;
    text(io, "step", &step->text);
    small_count(io, "closuresBefore", &step->closures_before);
    small_count(io, "closuresAfter", &step->closures_after);
    small_count(io, "bytesBefore", &step->bytes_before);
    small_count(io, "bytesAfter", &step->bytes_after);
    text(io, "estimatedError", &step->estimated);
    text(io, "drawnError", &step->drawn);
}

static void element(struct record_io *io, void *item)
{
    struct check_element *element = item;
    text(io, "path", &element->path);
    text(io, "type", &element->type);
    element->shaders = objects(io, "shaders", true, element->shaders, &element->num_shaders,
                               sizeof *element->shaders, shader);
    io->coding->settings(io, "values", &element->values, &element->num_values);
    io->coding->settings(io, "textures", &element->textures, &element->num_textures);
    text(io, "signature", &element->signature);
    text(io, "picture", &element->picture);
    text(io, "slabsPicture", &element->slabs);
    text(io, "fullPicture", &element->full);
    text(io, "drawnError", &element->drawn_error);
    element->steps = objects(io, "steps", false, element->steps, &element->num_steps,
                             sizeof *element->steps, step);
}

static void change(struct record_io *io, void *item)
{
    struct check_change *change = item;
    change->kind = (enum check_change_kind)io->coding->name(io, "kind", change->kind,
                                                            check_change_names, NUM_CHECK_CHANGES);
    text(io, "element", &change->element);
    text(io, "target", &change->target);
    text(io, "text", &change->text);
}

/* Removes message indices that are out of range. */
static void drop_bad_indices(struct check_shader *shader, size_t num_messages)
{
    size_t kept = 0;
    for (size_t i = 0; i < shader->num_messages; ++i)
        if (shader->messages[i] < num_messages)
            shader->messages[kept++] = shader->messages[i];
    shader->num_messages = kept;
}

void record_members(struct record_io *io, struct check_document *document)
{
    text(io, "file", &document->file);
    text(io, "name", &document->name);
    outcome(io, &document->failed);
    document->messages = objects(io, "messages", true, document->messages, &document->num_messages,
                                 sizeof *document->messages, message);
    small_count(io, "hiddenErrors", &document->num_hidden);
    texts(io, "files", true, &document->files, &document->num_files);
    texts(io, "folders", false, &document->folders, &document->num_folders);
    texts(io, "images", false, &document->images, &document->num_images);
    document->elements = objects(io, "elements", true, document->elements, &document->num_elements,
                                 sizeof *document->elements, element);
    document->changes = objects(io, "changes", false, document->changes, &document->num_changes,
                                sizeof *document->changes, change);
    document->gone_messages =
        objects(io, "goneMessages", false, document->gone_messages, &document->num_gone_messages,
                sizeof *document->gone_messages, message);
    io->coding->time(io, "loadMs", &document->load_ms);
    io->coding->time(io, "validateMs", &document->validate_ms);
    io->coding->time(io, "renderMs", &document->render_ms);
    for (size_t i = 0; io->store && i < document->num_elements; ++i)
        for (size_t k = 0; k < document->elements[i].num_shaders; ++k)
            drop_bad_indices(&document->elements[i].shaders[k], document->num_messages);
}
