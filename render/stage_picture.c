// SPDX-License-Identifier: Apache-2.0
#include "render/stage_picture.h"

#include "cli/memory.h"

#include <stdlib.h>
#include <string.h>

/* An object and what it has. */
struct dressed {
    uint32_t stack, object;
};

/* By stack, then in the order of the stage. */
static int compare_dressed(const void *a, const void *b)
{
    const struct dressed *x = a, *y = b;
    if (x->stack != y->stack)
        return x->stack < y->stack ? -1 : 1;
    return (x->object > y->object) - (x->object < y->object);
}

static char *stack_name(const mxg_bindings *bindings, uint32_t stack)
{
    size_t size = mxg_bindings_stack_name(bindings, stack, NULL, 0) + 1;
    char *name = memory_alloc(size);
    mxg_bindings_stack_name(bindings, stack, name, size);
    return name;
}

static void group(const struct stage *stage, const mxg_document *document, const char *path,
                  const struct dressed *dressed, struct stage_subjects *out)
{
    for (uint32_t i = 0; i < stage->num_objects; ++i) {
        out->objects[i] = stage->objects[dressed[i].object].object;
        if (i && dressed[i].stack == dressed[i - 1].stack) {
            ++out->items[out->len - 1].num_objects;
            continue;
        }
        out->items[out->len++] =
            (struct subject){.document = document,
                             .path = path,
                             .element = stack_name(out->bindings, dressed[i].stack),
                             .bindings = out->bindings,
                             .stack = dressed[i].stack,
                             .objects = &out->objects[i],
                             .num_objects = 1};
    }
}

bool stage_subjects_make(struct painter *painter, const struct stage *stage,
                         const mxg_document *document, const char *path, const char *look,
                         struct stage_subjects *out)
{
    struct report *report = &painter->cli->report;
    mxg_bind_desc desc = MXG_BIND_DESC_INIT;
    *out = (struct stage_subjects){0};
    desc.look = look;
    mxg_status status =
        mxg_bind(painter->cli->context, document, stage->scene, &desc, &out->bindings);
    if (out->bindings)
        report_list(report, mxg_bindings_diagnostics(out->bindings));
    if (!report_status(report, status))
        return false;
    struct dressed *dressed = memory_alloc(stage->num_objects * sizeof *dressed);
    out->items = memory_alloc(stage->num_objects * sizeof *out->items);
    out->objects = memory_alloc(stage->num_objects * sizeof *out->objects);
    for (uint32_t i = 0; i < stage->num_objects; ++i)
        dressed[i] =
            (struct dressed){mxg_bindings_stack(out->bindings, stage->objects[i].primitive), i};
    qsort(dressed, stage->num_objects, sizeof *dressed, compare_dressed);
    group(stage, document, path, dressed, out);
    free(dressed);
    return true;
}

void stage_subjects_finish(struct stage_subjects *subjects)
{
    for (size_t i = 0; i < subjects->len; ++i)
        free((void *)(uintptr_t)subjects->items[i].element);
    free(subjects->items);
    free(subjects->objects);
    mxg_bindings_destroy(subjects->bindings);
}
