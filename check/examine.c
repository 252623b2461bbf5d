// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "check/examine.h"

#include "compile/compile.h"
#include "program/warning_groups.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

double examine_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

/* ---- Messages ---- */

static const char *copy(struct examiner *examiner, const char *text)
{
    return text ? store_text(&examiner->store, text, strlen(text)) : "";
}

static uint64_t hash_of(const struct check_message *message)
{
    struct group_key key = {.id = message->id, .file = message->file, .text = message->text};
    return group_key_hash_at(&key, message->line, message->column);
}

/* The index of an equal message; the number of messages if there is none. */
static uint32_t find_message(const struct examiner *examiner, const struct check_message *message)
{
    const struct name_entry *entry = names_find_hash(&examiner->messages, hash_of(message));
    return entry ? (uint32_t)entry->value : (uint32_t)examiner->document->num_messages;
}

static void add_message(struct examiner *examiner, const struct check_message *message)
{
    bool is_new;
    uint32_t index = check_add_message(&examiner->store, examiner->document, message);
    names_add_hash(&examiner->messages, hash_of(message), &is_new)->value = index;
}

static void refer(struct examiner *examiner, struct check_shader *shader, uint32_t index)
{
    for (size_t i = 0; i < shader->num_messages; ++i)
        if (shader->messages[i] == index)
            return;
    shader->messages =
        store_grow(&examiner->store, shader->messages, shader->num_messages, sizeof index);
    shader->messages[shader->num_messages++] = index;
}

static bool is_beyond_limit(const struct examiner *examiner, const struct check_message *message)
{
    size_t most = examiner->cli->max_errors;
    return message->severity == MXG_SEVERITY_ERROR && most && examiner->num_errors >= most;
}

static void count_error(struct examiner *examiner, const struct check_message *message,
                        uint32_t index)
{
    if (message->severity != MXG_SEVERITY_ERROR)
        return;
    ++examiner->num_errors;
    examiner->last_error = index;
}

/* Adds the number of further errors to the last one. */
static void note_limit(struct examiner *examiner, struct check_message *last)
{
    if (strstr(last->rendered, "the rest is not shown"))
        return;
    char *text = cli_format("%snote: more than %zu errors; the rest is not shown\n", last->rendered,
                            examiner->cli->max_errors);
    last->rendered = copy(examiner, text);
    free(text);
}

/* Copies the notes of a message into the store. */
static void copy_notes(struct examiner *examiner, struct check_message *message)
{
    struct check_note *notes =
        store_array(&examiner->store, message->num_notes, sizeof *message->notes);
    for (size_t i = 0; i < message->num_notes; ++i) {
        notes[i] = message->notes[i];
        notes[i].text = copy(examiner, notes[i].text);
        notes[i].file = copy(examiner, notes[i].file);
    }
    message->notes = notes;
}

void examine_add(struct examiner *examiner, struct check_shader *shader,
                 struct check_message message)
{
    message.file = message.file ? message.file : "";
    uint32_t index = find_message(examiner, &message);
    if (index == examiner->document->num_messages && is_beyond_limit(examiner, &message)) {
        index = examiner->last_error;
        ++examiner->document->num_hidden;
        note_limit(examiner, &examiner->document->messages[index]);
    } else if (index == examiner->document->num_messages) {
        message.id = copy(examiner, message.id);
        message.text = copy(examiner, message.text);
        message.file = copy(examiner, message.file);
        message.element = copy(examiner, message.element);
        message.target = copy(examiner, message.target);
        message.rendered = copy(examiner, message.rendered);
        copy_notes(examiner, &message);
        add_message(examiner, &message);
        count_error(examiner, &message, index);
    }
    if (shader)
        refer(examiner, shader, index);
}

static bool is_shown(const struct examiner *examiner, const mxg_diagnostic *diagnostic,
                     uint32_t index)
{
    if (diagnostic->parent != index)
        return false; /* it belongs to the message before it */
    return diagnostic->severity != MXG_SEVERITY_NOTE || examiner->cli->verbose;
}

static bool is_about_absence(const char *id)
{
    static const char *const ids[] = {"missing-texture", "missing-tiles", "include-missing",
                                      "missing-source-file"};
    for (size_t i = 0; i < sizeof ids / sizeof *ids; ++i)
        if (strcmp(id, ids[i]) == 0)
            return true;
    return false;
}

/* Notes the place of a file that is absent, because the message ends when the file appears. */
static void add_absent_place(struct examiner *examiner, const char *file, const char *path)
{
    if (file)
        check_add_place(&examiner->store, examiner->document, file,
                        store_text(&examiner->store, path, strlen(path)));
}

/* The notes of a diagnostic; NULL without one. The caller frees them; they borrow the texts. */
static struct check_note *take_notes(const mxg_diagnostics *list, uint32_t index, size_t *out_num)
{
    mxg_diagnostic note = {sizeof note};
    struct check_note *notes = NULL;
    *out_num = 0;
    for (uint32_t i = index + 1;
         mxg_diagnostics_item(list, i, &note) == MXG_OK && note.parent == index; ++i) {
        MEMORY_PUSH(notes, *out_num,
                    (struct check_note){note.message, note.file ? note.file : "", note.line,
                                        note.column, note.length});
    }
    return notes;
}

void examine_diagnostics(struct examiner *examiner, const mxg_diagnostics *list,
                         struct check_shader *shader, const char *element)
{
    examiner->document->num_hidden += mxg_diagnostics_num_errors(list);
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); ++i) {
        mxg_diagnostic diagnostic = {sizeof diagnostic};
        report_item(&examiner->cli->report, list, i, &diagnostic);
        examiner->document->num_hidden -= diagnostic.severity == MXG_SEVERITY_ERROR;
        if (!is_shown(examiner, &diagnostic, i))
            continue;
        if (is_about_absence(diagnostic.id))
            add_absent_place(examiner, diagnostic.file, mxg_diagnostics_argument(list, i, 0));
        struct check_message message = {.severity = diagnostic.severity,
                                        .id = diagnostic.id,
                                        .text = diagnostic.message,
                                        .file = diagnostic.file ? diagnostic.file : "",
                                        .line = diagnostic.line,
                                        .column = diagnostic.column,
                                        .length = diagnostic.length,
                                        .element = element,
                                        .target = shader ? shader->target : NULL};
        bool is_read = message.severity == MXG_SEVERITY_ERROR || !examiner->errors_only;
        if (is_read && find_message(examiner, &message) == examiner->document->num_messages) {
            message.rendered = report_render(&examiner->cli->report, list, i);
            message.notes = take_notes(list, i, &message.num_notes);
        }
        examine_add(examiner, shader, message);
        free(message.notes);
    }
}

void examine_status(struct examiner *examiner, mxg_status status, struct check_shader *shader,
                    const char *element)
{
    if (status == MXG_OK || status == MXG_ERROR_DOCUMENT)
        return;
    bool is_limit =
        status == MXG_ERROR_MEMORY && examiner->memory_limit && !examiner->cli->max_memory;
    const char *id = is_limit ? "check-memory" : "failed";
    char *text = is_limit ? cli_format("a worker needs more than %zu MiB of memory: %s",
                                       examiner->memory_limit, element ? element : "the document")
                          : cli_format("%s", mxg_status_string(status));
    char *rendered = cli_format("%s: error: %s [%s]\n", examiner->document->file, text, id);
    examine_add(examiner, shader,
                (struct check_message){.id = id,
                                       .text = text,
                                       .file = examiner->document->file,
                                       .element = element,
                                       .target = shader ? shader->target : NULL,
                                       .rendered = rendered});
    free(rendered);
    free(text);
}

void examine_tell(struct examiner *examiner, const char *element, mxg_severity severity,
                  const char *id, const char *text)
{
    char *rendered = cli_format("%s: %s: %s [%s]\n", examiner->document->file,
                                severity == MXG_SEVERITY_ERROR ? "error" : "warning", text, id);
    examine_add(examiner, NULL,
                (struct check_message){.severity = severity,
                                       .id = id,
                                       .text = text,
                                       .file = examiner->document->file,
                                       .element = element,
                                       .rendered = rendered});
    free(rendered);
}

void examine_fault(struct examiner *examiner, const char *element, enum check_failure failure,
                   const char *id, const char *text)
{
    examine_tell(examiner, element, MXG_SEVERITY_ERROR, id, text);
    check_fail(&examiner->document->failed, failure);
}

/* ---- Stages ---- */

static mxg_document *load(struct examiner *examiner, const char *path)
{
    double begin = examine_clock();
    mxg_document *document = NULL;
    channel_mark(&examiner->channel, CHECK_LOAD, "", "");
    mxg_status status =
        mxg_document_load(examiner->cli->context, examiner->cli->library, path, &document);
    examine_diagnostics(examiner, mxg_document_diagnostics(document), NULL, NULL);
    examine_status(examiner, status, NULL, NULL);
    if (status != MXG_OK)
        check_fail(&examiner->document->failed, CHECK_LOAD);
    uint32_t count = mxg_document_num_files(document);
    for (uint32_t i = 0; i < count; ++i)
        check_add_file(&examiner->store, examiner->document, mxg_document_file(document, i));
    examiner->document->load_ms = examine_clock() - begin;
    return document;
}

static void validate(struct examiner *examiner, const mxg_document *document)
{
    double begin = examine_clock();
    mxg_result *result = NULL;
    channel_mark(&examiner->channel, CHECK_VALIDATE, "", "");
    mxg_status status = mxg_validate(examiner->cli->context, document, &result);
    examine_diagnostics(examiner, mxg_result_diagnostics(result), NULL, NULL);
    examine_status(examiner, status, NULL, NULL);
    if (status != MXG_OK)
        check_fail(&examiner->document->failed, CHECK_VALIDATE);
    mxg_result_destroy(result);
    examiner->document->validate_ms = examine_clock() - begin;
}

static void generate(struct examiner *examiner, const struct check_subject *subject,
                     struct check_element *element, struct check_shader *shader)
{
    double begin = examine_clock();
    /* pictures show them, and estimates of budgets read them */
    bool reads_images = examiner->render || cli_has_budget(examiner->cli);
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = shader->target;
    desc.element = subject->bindings ? NULL : element->path;
    desc.bindings = subject->bindings;
    desc.stack = subject->stack;
    desc.options = examiner->cli->options;
    /* no report needs the source */
    desc.without_source =
        examiner->is_brief && !examiner->compile && !examiner->cli->max_output_size;
    desc.only_diagnostics = desc.without_source && !reads_images;
    mxg_result *result = NULL;
    channel_mark(&examiner->channel, CHECK_GENERATE, element->path, shader->target);
    mxg_status status = mxg_generate(examiner->cli->context, subject->document, &desc, &result);
    examine_diagnostics(examiner, mxg_result_diagnostics(result), shader, element->path);
    examine_status(examiner, status, shader, element->path);
    if (status != MXG_OK)
        check_fail(&shader->failed, CHECK_GENERATE);
    shader->generate_ms = examine_clock() - begin;
    if (status == MXG_OK) {
        examine_shader(examiner, result, shader, element->path);
        examine_settings(examiner, result, element);
    }
    if (status == MXG_OK && reads_images)
        examine_images(examiner, result);
    check_fail(&examiner->document->failed, shader->failed);
    mxg_result_destroy(result);
}

void examine_element(struct examiner *examiner, const struct check_subject *subject,
                     struct check_element *element)
{
    element->picture = element->signature = element->full = element->drawn_error = "";
    element->slabs = "";
    element->shaders =
        store_array(&examiner->store, examiner->targets.len, sizeof *element->shaders);
    for (size_t i = 0; i < examiner->targets.len; ++i) {
        struct check_shader *shader = &element->shaders[element->num_shaders++];
        shader->target = examiner->targets.items[i];
        shader->topology = "";
        generate(examiner, subject, element, shader);
    }
    if (examiner->render && element->num_shaders && element->shaders[0].failed != CHECK_GENERATE)
        examine_picture(examiner, subject->document, element);
    if (examiner->accept >= 0 && element->num_shaders)
        examine_likeness(examiner, element);
}

static void examine_renderables(struct examiner *examiner, const mxg_document *document)
{
    struct check_document *record = examiner->document;
    const struct check_subject subject = {.document = document};
    uint32_t count = mxg_document_num_renderables(document);
    record->elements = store_array(&examiner->store, count, sizeof *record->elements);
    for (uint32_t i = 0; i < count; ++i) {
        mxg_renderable renderable = {sizeof renderable};
        mxg_document_renderable(document, i, &renderable);
        struct check_element *element = &record->elements[record->num_elements++];
        element->path = copy(examiner, renderable.path);
        element->type = copy(examiner, renderable.type);
        examine_element(examiner, &subject, element);
    }
}

const struct check_document *examine(struct examiner *examiner, const char *path)
{
    store_finish(&examiner->store);
    struct check_document *record = examiner->document =
        store_alloc(&examiner->store, sizeof *record);
    record->file = copy(examiner, path);
    examiner->num_errors = 0;
    names_finish(&examiner->messages);
    mxg_document *document = load(examiner, path);
    if (document && record->num_files)
        validate(examiner, document);
    if (document && examiner->translate)
        document = examine_translated(examiner, document);
    if (document && examiner->stage.file)
        examine_stage(examiner, document);
    else
        examine_renderables(examiner, document);
    mxg_document_destroy(document);
    return record;
}

void examiner_finish(struct examiner *examiner)
{
    store_finish(&examiner->store);
    names_finish(&examiner->messages);
    if (examiner->is_compiler_ready)
        compile_end();
    scratch_remove(&examiner->scratch);
}
