// SPDX-License-Identifier: Apache-2.0
#include "render/site_picture.h"

#include "program/memory.h"
#include "program/scene_file.h"

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

/*
 * A visibility for all kinds of rays counts before that for the camera, unless this one stands at a
 * deeper primitive, which has a higher number.
 */
bool site_is_visible(const mxg_bindings *bindings, uint32_t primitive)
{
    mxg_fact all = {.value = ""}, camera = {.value = ""};
    for (uint32_t i = 0; i < mxg_bindings_num_facts(bindings, primitive); ++i) {
        mxg_fact fact = {sizeof fact};
        mxg_bindings_fact(bindings, primitive, i, &fact);
        bool is_for_all = fact.kind == MXG_FACT_VISIBILITY && !*fact.target;
        if (is_for_all && !*fact.name)
            all = fact;
        else if (is_for_all && strcmp(fact.name, "camera") == 0)
            camera = fact;
    }
    bool is_hidden = strcmp(camera.value, "false") == 0,
         is_deeper = !*all.value || all.from + 1 < camera.from + 1; /* MXG_NONE + 1 is 0 */
    return strcmp(all.value, "false") != 0 && !(is_hidden && is_deeper);
}

/* True if pictures do not follow a fact: they see and light all, from both sides. */
static bool is_unread(const mxg_fact *fact)
{
    bool is_true = strcmp(fact->value, "true") == 0;
    if (fact->kind == MXG_FACT_VISIBILITY)
        return !is_true && (*fact->target || (*fact->name && strcmp(fact->name, "camera") != 0));
    return fact->kind == MXG_FACT_PROPERTY && !*fact->target
           && strcmp(fact->name, is_true ? "matte" : "twosided") == 0;
}

/* Tells each kind of them once, of the first primitive that has it. */
static void tell_unread(struct report *report, const struct site *site,
                        const mxg_bindings *bindings, uint32_t primitive, struct name_table *told)
{
    for (uint32_t i = 0; i < mxg_bindings_num_facts(bindings, primitive); ++i) {
        mxg_fact fact = {sizeof fact};
        mxg_bindings_fact(bindings, primitive, i, &fact);
        if (!is_unread(&fact))
            continue;
        bool is_new, is_property = fact.kind == MXG_FACT_PROPERTY;
        const char *kind = is_property    ? "property"
                           : *fact.target ? "viewer of a visibility"
                                          : "visibility",
                   *word = *fact.target ? fact.target : fact.name;
        char *key = cli_format("%s %s", kind, word);
        names_add(told, key, &is_new);
        free(key);
        if (!is_new)
            continue;
        char *path = scene_file_path(site->scene, primitive);
        report_warning(report, "look-unread",
                       "'%s' (%s:%u): the %s '%s' of the look has no effect on the picture", path,
                       fact.file, fact.line, kind, word);
        free(path);
    }
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
    struct name_table told = {0};
    for (uint32_t i = 0; i < site->num_objects; ++i) {
        uint32_t primitive = site_bound_primitive(site, &site->objects[i]);
        tell_unread(report, site, out->bindings, primitive, &told);
        if (site_is_visible(out->bindings, primitive))
            dressed[num++] = (struct dressed){mxg_bindings_stack(out->bindings, primitive),
                                              site_tokens(&out->facts, primitive), i};
    }
    names_finish(&told);
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
