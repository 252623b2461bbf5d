// SPDX-License-Identifier: Apache-2.0
/* The model after a change: what the change does not touch stays. */
#include "lsp/model_reading.h"

#include "program/memory.h"

#include <string.h>

/* The last element below the root that begins before the offset; MODEL_NONE: there is none. */
static uint32_t last_before(const struct model *model, uint32_t offset)
{
    uint32_t found = MODEL_NONE, low = 0, high = model->num_elements;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (model->elements[middle].start < offset)
            low = middle + 1;
        else
            high = middle;
    }
    for (found = low; found-- > 0;)
        if (model->elements[found].depth == 1)
            return found;
    return MODEL_NONE;
}

/*
 * The first element below the root that has to be read again for a change: what is before it did
 * not look at the text from there on.
 */
static uint32_t first_changed(const struct model *model, uint32_t offset)
{
    uint32_t first = last_before(model, offset);
    for (uint32_t i = 0; model->has_reach && first != MODEL_NONE && i < first; ++i)
        if (model->elements[i].reach > model->elements[first].start)
            first = last_before(model, model->elements[i].start + 1);
    return first;
}

static struct span shift(struct span span, uint32_t by)
{
    return (struct span){span.start + by, span.end + by};
}

/* The old element below the root that begins at the offset; `*from` only grows. */
static bool find_old(const struct model *old, uint32_t offset, uint32_t root, uint32_t *from)
{
    while (*from < old->num_elements && old->elements[*from].start < offset)
        ++*from;
    return *from < old->num_elements && old->elements[*from].start == offset
           && old->elements[*from].depth == 1 && old->elements[*from].parent == root;
}

static void reserve_elements(struct model *model, uint32_t count)
{
    if (count <= model->capacity_elements)
        return;
    model->capacity_elements = count + count / 2;
    model->elements =
        memory_resize(model->elements, model->capacity_elements * sizeof *model->elements);
}

static void reserve_attributes(struct model *model, uint32_t count)
{
    if (count <= model->capacity_attributes)
        return;
    model->capacity_attributes = count + count / 2;
    model->attributes =
        memory_resize(model->attributes, model->capacity_attributes * sizeof *model->attributes);
}

/* A change moves the elements behind it: where they are in the text, and their numbers. */
struct move {
    uint32_t root, from; /* elements from `from` on move */
    uint32_t by, elements, attributes;
};

static void move_rest(struct model *model, const struct move *move)
{
    uint32_t first = move->from + move->elements;
    for (uint32_t i = first; i < model->num_elements; ++i) {
        struct model_element *element = &model->elements[i];
        element->name = shift(element->name, move->by);
        element->start += move->by;
        element->tag_end += move->by;
        element->close += move->by;
        element->end += move->by;
        element->reach += element->reach ? move->by : 0;
        element->after += move->elements;
        element->first_attribute += move->attributes;
        if (element->parent != MODEL_NONE && element->parent != move->root)
            element->parent += move->elements;
    }
    uint32_t attribute = first < model->num_elements ? model->elements[first].first_attribute
                                                     : model->num_attributes;
    for (; attribute < model->num_attributes; ++attribute) {
        struct model_attribute *moved = &model->attributes[attribute];
        moved->name = shift(moved->name, move->by);
        if (moved->has_value)
            moved->value = shift(moved->value, move->by);
        moved->end += move->by;
    }
}

/* Elements that were read apart, behind a copy of the root, take their place in the model. */
static void take_read(struct model *model, const struct model *read, uint32_t root, uint32_t first,
                      uint32_t first_attribute)
{
    for (uint32_t i = 1; i < read->num_elements; ++i) {
        struct model_element element = read->elements[i];
        element.first_attribute += first_attribute;
        element.after += first - 1;
        if (element.parent == 0)
            element.parent = root;
        else if (element.parent != MODEL_NONE)
            element.parent += first - 1;
        model->elements[first + i - 1] = element;
    }
    if (read->num_attributes)
        memcpy(model->attributes + first_attribute, read->attributes,
               read->num_attributes * sizeof *read->attributes);
}

/* Replaces the elements from `first` to `from` by those that were read. */
static void splice(struct model *model, const struct model *read, uint32_t first, uint32_t from,
                   uint32_t by)
{
    uint32_t root = model->elements[first].parent,
             first_attribute = model->elements[first].first_attribute,
             rest_attribute = from < model->num_elements ? model->elements[from].first_attribute
                                                         : model->num_attributes,
             num = read->num_elements - 1;
    struct move move = {root, from, by, first + num - from,
                        first_attribute + read->num_attributes - rest_attribute};
    bool has_rest = from < model->num_elements;
    reserve_elements(model, model->num_elements + num + 1);
    reserve_attributes(model, model->num_attributes + read->num_attributes + 1);
    memmove(model->elements + first + num, model->elements + from,
            (model->num_elements - from) * sizeof *model->elements);
    memmove(model->attributes + first_attribute + read->num_attributes,
            model->attributes + rest_attribute,
            (model->num_attributes - rest_attribute) * sizeof *model->attributes);
    model->has_reach |= read->has_reach;
    model->num_elements += move.elements;
    model->num_attributes += move.attributes;
    take_read(model, read, root, first, first_attribute);
    move_rest(model, &move);
    struct model_element *top = &model->elements[root];
    top->close = has_rest ? top->close + by : read->elements[0].close;
    top->end = has_rest ? top->end + by : read->elements[0].end;
    top->after = has_rest ? top->after + move.elements : read->elements[0].after + first - 1;
}

/*
 * A reading depends on the text from where it is, and on the elements that are open. It looks ahead
 * up to the next '<' at most, or to the end of the text if it swallows all of it; `reach` has the
 * exception. So what is before the element with the change stays, and so does what begins after the
 * change where only the root is open.
 */
void model_update(struct model *model, const struct text *text, struct span old, uint32_t new_end)
{
    uint32_t first = first_changed(model, old.start), from = first, by = new_end - old.end;
    if (first == MODEL_NONE) {
        model_read(model, text);
        return;
    }
    uint32_t root = model->elements[first].parent;
    struct model read = {0};
    struct reading reading = {.model = &read,
                              .bytes = text->bytes,
                              .len = text->len,
                              .at = model->elements[first].start,
                              .open = MODEL_NONE};
    reading.open = reading_add(&reading, model->elements[root].start);
    read.elements[0].name = model->elements[root].name;
    bool is_there = false;
    while (!is_there && reading_find(&reading)) {
        is_there = reading.open == 0 && reading.at >= new_end
                   && find_old(model, reading.at - by, root, &from);
        if (!is_there)
            reading_take(&reading);
    }
    if (!is_there)
        from = model->num_elements;
    reading_close(&reading);
    splice(model, &read, first, from, by);
    model_finish(&read);
}
