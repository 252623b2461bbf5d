// SPDX-License-Identifier: Apache-2.0
/* The source of a result, and the places in the document that its lines come from. */
#include "api/generation.h"

#include <assert.h>
#include <stdio.h>

const char *mxg_result_source(const mxg_result *result, mxg_stage stage, size_t *out_size)
{
    bool known = result && (unsigned)stage < NUM_STAGES;
    if (out_size)
        *out_size = known ? result->stages[stage].size : 0;
    return known ? result->stages[stage].text : NULL;
}

void source_find_lines(struct stage_source *source, struct arena *arena)
{
    VEC(uint32_t) lines = {0};
    const char *at = source->text, *end = at + source->size;
    while (at && at < end) {
        vec_push(arena, &lines, (uint32_t)(at - source->text));
        at = memchr(at, '\n', (size_t)(end - at));
        at = at ? at + 1 : end;
    }
    source->lines = lines.items;
    source->num_lines = lines.len;
}

/* The offset where a line (from 1) begins; the end of the source if it has fewer lines. */
static size_t start_of_line(const struct stage_source *source, uint32_t line)
{
    assert(line > 0);
    return line <= source->num_lines ? source->lines[line - 1] : source->size;
}

/* The first origin that a line has; 0: none. */
static uint32_t origin_of_line(const mxg_result *result, mxg_stage stage, uint32_t line)
{
    const struct stage_source *source = &result->stages[stage];
    if (line == 0 || !source->text)
        return 0;
    size_t start = start_of_line(source, line),
           end = line < UINT32_MAX ? start_of_line(source, line + 1) : source->size;
    assert(start <= end && end <= source->size);
    uint32_t low = 0, high = source->num_marks;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (source->marks[middle].at < start)
            low = middle + 1;
        else
            high = middle;
    }
    assert(low == source->num_marks || source->marks[low].at >= start);
    assert(low == 0 || source->marks[low - 1].at < start);
    return low < source->num_marks && source->marks[low].at < end ? source->marks[low].origin : 0;
}

elem_id result_element_of(const mxg_result *result, uint32_t origin)
{
    assert(origin < result->graph.origins.len || origin == 0);
    const struct ir_origin *origins = result->graph.origins.items;
    while (origin && origins[origin].element < result->document->layer.doc.first_element)
        origin = origins[origin].parent;
    return origin ? origins[origin].element : 0;
}

mxg_status mxg_result_source_place(const mxg_result *result, mxg_stage stage, uint32_t line,
                                   mxg_place *out)
{
    uint32_t origin =
        result && (unsigned)stage < NUM_STAGES ? origin_of_line(result, stage, line) : 0;
    elem_id element = origin ? result_element_of(result, origin) : 0;
    if (!element)
        return MXG_ERROR_ARGUMENT;
    struct diag_place place = doc_place(&result->document->layer.doc, element);
    const char *path = result->origin_paths[origin];
    mxg_place full = {
        .file = place.file, .line = place.line, .column = place.column, .path = path ? path : ""};
    return struct_write(out, &full, sizeof full);
}

enum { MAX_NAMES = 64 }; /* in a path; names of outer elements beyond this number are missing */

struct names {
    const char *items[MAX_NAMES]; /* the innermost first */
    uint32_t len;
};

static void add_name(struct names *names, const struct document *doc, elem_id element)
{
    assert(names->len <= MAX_NAMES);
    const char *name = doc_name(doc, element);
    if (names->len < MAX_NAMES && *name)
        names->items[names->len++] = name;
}

/* Collects the names of nested uses, then the names of the elements around the outermost use. */
static void collect_names(const mxg_result *result, uint32_t origin, struct names *out)
{
    const struct document *doc = origin ? &result->document->layer.doc : NULL;
    const struct ir_origin *origins = origin ? result->graph.origins.items : NULL;
    for (; origin; origin = origins[origin].parent) {
        elem_id element = origins[origin].element;
        if (element)
            add_name(out, doc, element);
        for (;
             element && !origins[origin].parent && doc_element(doc, element)->parent != doc->root;)
            if ((element = doc_element(doc, element)->parent) != 0)
                add_name(out, doc, element);
    }
}

static size_t write_path(const mxg_result *result, uint32_t origin, char *buffer, size_t capacity)
{
    struct names names = {.len = 0};
    size_t len = 0;
    if (!buffer)
        capacity = 0;
    if (capacity)
        *buffer = '\0';
    collect_names(result, origin, &names);
    while (names.len--) {
        const char *name = names.items[names.len];
        int n = snprintf(len < capacity ? buffer + len : NULL, len < capacity ? capacity - len : 0,
                         "%s%s", len ? "/" : "", name);
        len += n > 0 ? (size_t)n : 0;
    }
    return len;
}

size_t mxg_result_source_path(const mxg_result *result, mxg_stage stage, uint32_t line,
                              char *buffer, size_t capacity)
{
    bool is_there = result && (unsigned)stage < NUM_STAGES && result->has_shader;
    return write_path(result, is_there ? origin_of_line(result, stage, line) : 0, buffer, capacity);
}

size_t mxg_result_closure_path(const mxg_result *result, uint32_t index, char *buffer,
                               size_t capacity)
{
    bool is_there = result && result->has_shader && index < result->shader.reflection.closures.len;
    return write_path(result, is_there ? result->shader.reflection.closures.items[index] : 0,
                      buffer, capacity);
}
