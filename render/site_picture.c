// SPDX-License-Identifier: Apache-2.0
#include "render/site_picture.h"

#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

/* An object and what it has. */
struct dressed {
    uint32_t stack, tokens, object;
};

static bool is_same_subject(const struct dressed *a, const struct dressed *b)
{
    return a->stack == b->stack && a->tokens == b->tokens;
}

/* By stack and tokens, then in the order of the site. */
static int compare_dressed(const void *a, const void *b)
{
    const struct dressed *x = a, *y = b;
    if (x->stack != y->stack)
        return x->stack < y->stack ? -1 : 1;
    if (x->tokens != y->tokens)
        return x->tokens < y->tokens ? -1 : 1;
    return (x->object > y->object) - (x->object < y->object);
}

static char *stack_name(const mxg_bindings *bindings, uint32_t stack)
{
    size_t size = mxg_bindings_stack_name(bindings, stack, NULL, 0) + 1;
    char *name = memory_alloc(size);
    mxg_bindings_stack_name(bindings, stack, name, size);
    return name;
}

static void group(const struct site *site, const mxg_document *document, const char *path,
                  const struct dressed *dressed, uint32_t num, struct site_subjects *out)
{
    for (uint32_t i = 0; i < num; ++i) {
        const struct site_object *object = &site->objects[dressed[i].object];
        out->objects[i] = object->object;
        site_add_geomprops(&out->facts, site_bound_primitive(site, object), &out->objects[i]);
        if (i && is_same_subject(&dressed[i], &dressed[i - 1])) {
            ++out->items[out->len - 1].num_objects;
            continue;
        }
        out->items[out->len++] = (struct subject){
            .document = document,
            .path = path,
            .element = stack_name(out->bindings, dressed[i].stack),
            .bindings = out->bindings,
            .stack = dressed[i].stack,
            .objects = &out->objects[i],
            .num_objects = 1,
            .tokens = dressed[i].tokens ? &out->facts.tokens[dressed[i].tokens - 1] : NULL};
    }
}

bool site_is_visible(const mxg_bindings *bindings, uint32_t primitive)
{
    bool is_visible = true;
    for (uint32_t i = 0; i < mxg_bindings_num_facts(bindings, primitive); ++i) {
        mxg_fact fact = {sizeof fact};
        mxg_bindings_fact(bindings, primitive, i, &fact);
        bool is_of_camera = !*fact.name || strcmp(fact.name, "camera") == 0;
        if (fact.kind == MXG_FACT_VISIBILITY && is_of_camera && !*fact.target)
            is_visible &= strcmp(fact.value, "false") != 0;
    }
    return is_visible;
}

bool site_subjects_make(struct painter *painter, const struct site *site,
                        const mxg_document *document, const char *path,
                        const mxg_bindings_desc *desc, struct site_subjects *out)
{
    struct report *report = &painter->cli->report;
    *out = (struct site_subjects){0};
    mxg_status status =
        mxg_bindings_create(painter->cli->context, document, site->scene, desc, &out->bindings);
    if (out->bindings)
        report_list(report, mxg_bindings_diagnostics(out->bindings));
    if (!report_status(report, status))
        return false;
    out->facts = (struct site_facts){
        .context = painter->cli->context, .document = document, .bindings = out->bindings};
    struct dressed *dressed = memory_alloc(site->num_objects * sizeof *dressed);
    out->items = memory_alloc(site->num_objects * sizeof *out->items);
    out->objects = memory_alloc(site->num_objects * sizeof *out->objects);
    uint32_t num = 0;
    for (uint32_t i = 0; i < site->num_objects; ++i) {
        uint32_t primitive = site_bound_primitive(site, &site->objects[i]);
        if (site_is_visible(out->bindings, primitive))
            dressed[num++] = (struct dressed){mxg_bindings_stack(out->bindings, primitive),
                                              site_tokens(&out->facts, primitive), i};
    }
    qsort(dressed, num, sizeof *dressed, compare_dressed);
    group(site, document, path, dressed, num, out);
    if (!num)
        report_error(report, "empty-mesh", "the look hides all primitives of the stage");
    free(dressed);
    return num > 0;
}

void site_subjects_finish(struct site_subjects *subjects)
{
    for (size_t i = 0; i < subjects->len; ++i)
        free((void *)(uintptr_t)subjects->items[i].element);
    free(subjects->items);
    free(subjects->objects);
    site_facts_finish(&subjects->facts);
    mxg_bindings_destroy(subjects->bindings);
}
