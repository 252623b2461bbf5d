// SPDX-License-Identifier: Apache-2.0
/*
 * --stage: the elements are the stacks of a scene under a look, each named after the first
 * primitive that has it.
 */
#include "check/examine.h"

#include <stdint.h>

/* Messages of the stage belong to the record of the document. */
static void take_list(void *user_data, const mxg_diagnostics *list)
{
    examine_diagnostics(user_data, list, NULL, NULL);
}

static void take_own(void *user_data, mxg_severity severity, const char *id, const char *text)
{
    examine_tell(user_data, NULL, severity, id, text);
}

/* The path of a primitive, in the store. */
static const char *path_of(struct examiner *examiner, const mxg_scene *scene, uint32_t primitive)
{
    size_t size = mxg_scene_primitive_path(scene, primitive, NULL, 0) + 1;
    char *path = store_alloc(&examiner->store, size);
    mxg_scene_primitive_path(scene, primitive, path, size);
    return path;
}

static void examine_each(struct examiner *examiner, const struct bound_scene *stage)
{
    struct check_document *record = examiner->document;
    uint32_t num_stacks = mxg_bindings_num_stacks(stage->bindings);
    bool *is_known = store_array(&examiner->store, num_stacks, sizeof *is_known);
    record->elements = store_array(&examiner->store, num_stacks, sizeof *record->elements);
    for (uint32_t i = 0; i < mxg_scene_num_primitives(stage->scene); ++i) {
        uint32_t stack = mxg_bindings_stack(stage->bindings, i);
        if (stack == MXG_NONE || is_known[stack])
            continue;
        is_known[stack] = true;
        struct check_element *element = &record->elements[record->num_elements++];
        element->path = path_of(examiner, stage->scene, i);
        element->type = "stack";
        const struct check_subject subject = {stage->document, stage->bindings, stack};
        examine_element(examiner, &subject, element);
    }
}

void examine_stage(struct examiner *examiner, const mxg_document *document)
{
    const struct report_receiver receiver = {take_list, take_own, examiner};
    struct cli *cli = examiner->cli;
    struct bound_scene stage;
    uint32_t errors = cli->report.errors;
    channel_mark(&examiner->channel, CHECK_LOAD, examiner->stage.file, "");
    check_add_file(&examiner->store, examiner->document, examiner->stage.file);
    cli->report.receiver = &receiver;
    bool is_bound = scene_file_bind(cli, &examiner->stage, document, &stage);
    cli->report.receiver = NULL;
    if (!is_bound || cli->report.errors > errors)
        check_fail(&examiner->document->failed, CHECK_LOAD);
    if (is_bound)
        examine_each(examiner, &stage);
    scene_file_unbind(&stage);
}
