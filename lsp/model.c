// SPDX-License-Identifier: Apache-2.0
#include "lsp/model.h"

#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

/* A reading: where it is, and the innermost element that is open. */
struct reading {
    struct model *model;
    const char *bytes;
    uint32_t at, len, open;
};

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static bool is_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'
           || c == ':' || c == '-' || c == '.' || (unsigned char)c >= 0x80;
}

static bool begins(const struct reading *reading, const char *word)
{
    size_t len = strlen(word);
    return reading->len - reading->at >= len
           && memcmp(reading->bytes + reading->at, word, len) == 0;
}

static void skip_spaces(struct reading *reading)
{
    while (reading->at < reading->len && is_space(reading->bytes[reading->at]))
        ++reading->at;
}

static struct span read_name(struct reading *reading)
{
    struct span name = {reading->at, reading->at};
    while (name.end < reading->len && is_name(reading->bytes[name.end]))
        ++name.end;
    reading->at = name.end;
    return name;
}

/* Goes behind a word, or to the end of the text if it does not follow. */
static void skip_past(struct reading *reading, const char *word)
{
    size_t len = strlen(word);
    const char *at = reading->bytes + reading->at, *end = reading->bytes + reading->len;
    while ((at = memchr(at, word[0], (size_t)(end - at))) != NULL) {
        if ((size_t)(end - at) >= len && memcmp(at, word, len) == 0) {
            reading->at = (uint32_t)(at - reading->bytes + (ptrdiff_t)len);
            return;
        }
        ++at;
    }
    reading->at = reading->len;
}

/* ---- Attributes ---- */

static struct model_attribute *add_attribute(struct model *model)
{
    if (model->num_attributes == model->capacity_attributes) {
        model->capacity_attributes = model->capacity_attributes * 2 + 64;
        model->attributes = memory_resize(model->attributes,
                                          model->capacity_attributes * sizeof *model->attributes);
    }
    struct model_attribute *attribute = &model->attributes[model->num_attributes++];
    *attribute = (struct model_attribute){0};
    return attribute;
}

/* True if the text after a line end begins a tag, so the value before it has lost its quote. */
static bool has_tag_after(const struct reading *reading, uint32_t at)
{
    while (at < reading->len && is_space(reading->bytes[at]))
        ++at;
    return at == reading->len || reading->bytes[at] == '<';
}

static void read_value(struct reading *reading, struct model_attribute *attribute)
{
    char quote = reading->bytes[reading->at++];
    attribute->value = (struct span){reading->at, reading->at};
    for (uint32_t at = reading->at; at < reading->len; ++at) {
        char c = reading->bytes[at];
        attribute->is_closed = c == quote;
        if (c == quote || (c == '\n' && has_tag_after(reading, at)))
            break;
        attribute->value.end = at + 1;
    }
    reading->at = attribute->value.end + attribute->is_closed;
}

/* A name, which may have a value. */
static void read_attribute(struct reading *reading)
{
    struct model_attribute *attribute = add_attribute(reading->model);
    attribute->name = read_name(reading);
    uint32_t after_name = reading->at;
    skip_spaces(reading);
    if (reading->at < reading->len && reading->bytes[reading->at] == '=') {
        ++reading->at;
        after_name = reading->at;
        attribute->has_value = true;
        skip_spaces(reading);
        attribute->value = (struct span){after_name, after_name};
        if (reading->at < reading->len
            && (reading->bytes[reading->at] == '"' || reading->bytes[reading->at] == '\'')) {
            read_value(reading, attribute);
            after_name = reading->at;
        }
    }
    reading->at = after_name;
    attribute->end = after_name;
}

/* ---- Elements ---- */

static uint32_t add_element(struct reading *reading, uint32_t start)
{
    struct model *model = reading->model;
    if (model->num_elements == model->capacity_elements) {
        model->capacity_elements = model->capacity_elements * 2 + 64;
        model->elements =
            memory_resize(model->elements, model->capacity_elements * sizeof *model->elements);
    }
    uint32_t index = model->num_elements++, open = reading->open;
    model->elements[index] =
        (struct model_element){.start = start,
                               .parent = open,
                               .depth = open == MODEL_NONE ? 0 : model->elements[open].depth + 1,
                               .first_attribute = model->num_attributes};
    return index;
}

/* The element ends, and so does what is in it; its end tag begins at `close`. */
static void finish_element(struct reading *reading, uint32_t index, uint32_t close)
{
    struct model_element *element = &reading->model->elements[index];
    element->close = close;
    element->end = reading->at;
    element->after = reading->model->num_elements;
}

static void read_comment(struct reading *reading)
{
    uint32_t index = add_element(reading, reading->at);
    reading->at += 4;
    skip_past(reading, "-->");
    reading->model->elements[index].is_comment = true;
    reading->model->elements[index].tag_end = reading->at;
    reading->model->elements[index].name = (struct span){reading->at, reading->at};
    finish_element(reading, index, reading->at);
}

/* After the name of a start tag: its attributes, up to '>' or to the next '<'. */
static void read_attributes(struct reading *reading, struct model_element *element)
{
    element->is_broken = true;
    uint32_t end = reading->at;
    for (;;) {
        skip_spaces(reading);
        char c = reading->at < reading->len ? reading->bytes[reading->at] : '<';
        if (c == '<')
            break;
        if (c == '>' || begins(reading, "/>")) {
            element->is_empty = c == '/';
            element->is_broken = false;
            reading->at += c == '/' ? 2 : 1;
            end = reading->at;
            break;
        }
        if (is_name(c))
            read_attribute(reading);
        else
            ++reading->at;
        end = reading->at;
    }
    element->tag_end = end;
    element->num_attributes = reading->model->num_attributes - element->first_attribute;
}

static void read_start(struct reading *reading)
{
    uint32_t index = add_element(reading, reading->at);
    ++reading->at;
    struct model_element *element = &reading->model->elements[index];
    element->name = read_name(reading);
    read_attributes(reading, element);
    uint32_t next = reading->at;
    if (element->is_broken)
        reading->at = element->tag_end;
    if (element->is_broken || element->is_empty)
        finish_element(reading, index, reading->at);
    else
        reading->open = index;
    reading->at = next;
}

static bool is_equal(const struct reading *reading, struct span a, struct span b)
{
    uint32_t len = a.end - a.start;
    return len == b.end - b.start
           && memcmp(reading->bytes + a.start, reading->bytes + b.start, len) == 0;
}

/* An end tag closes the innermost element of its name with all in it; others mean nothing. */
static void read_end(struct reading *reading)
{
    uint32_t start = reading->at, match;
    reading->at += 2;
    struct span name = read_name(reading);
    skip_spaces(reading);
    if (reading->at < reading->len && reading->bytes[reading->at] == '>')
        ++reading->at;
    const struct model_element *elements = reading->model->elements;
    for (match = reading->open; match != MODEL_NONE; match = elements[match].parent)
        if (is_equal(reading, elements[match].name, name))
            break;
    if (match == MODEL_NONE)
        return;
    uint32_t end = reading->at;
    while (reading->open != match) {
        uint32_t inner = reading->open;
        reading->open = elements[inner].parent;
        reading->at = start;
        finish_element(reading, inner, start);
    }
    reading->open = elements[match].parent;
    reading->at = end;
    finish_element(reading, match, start);
}

/* "<?xml …?>" ends in its line. */
static void skip_instruction(struct reading *reading)
{
    while (reading->at < reading->len && reading->bytes[reading->at] != '\n'
           && !begins(reading, "?>"))
        ++reading->at;
    if (begins(reading, "?>"))
        reading->at += 2;
}

static void read_markup(struct reading *reading)
{
    if (begins(reading, "<!--"))
        read_comment(reading);
    else if (begins(reading, "<![CDATA["))
        skip_past(reading, "]]>");
    else if (begins(reading, "<!"))
        skip_past(reading, ">");
    else if (begins(reading, "<?"))
        skip_instruction(reading);
    else if (begins(reading, "</"))
        read_end(reading);
    else
        read_start(reading);
}

/* What the text ends inside of ends with it. */
static void close_all(struct reading *reading)
{
    while (reading->open != MODEL_NONE) {
        uint32_t index = reading->open;
        reading->open = reading->model->elements[index].parent;
        finish_element(reading, index, reading->at);
    }
}

/* Goes to the next '<'. False: there is none. */
static bool find_markup(struct reading *reading)
{
    const char *at =
        memchr(reading->bytes + reading->at, '<', (size_t)(reading->len - reading->at));
    reading->at = at ? (uint32_t)(at - reading->bytes) : reading->len;
    return at != NULL;
}

void model_read(struct model *model, const struct text *text)
{
    model->num_elements = model->num_attributes = 0;
    struct reading reading = {
        .model = model, .bytes = text->bytes, .len = text->len, .open = MODEL_NONE};
    while (find_markup(&reading))
        read_markup(&reading);
    close_all(&reading);
}

void model_finish(struct model *model)
{
    free(model->elements);
    free(model->attributes);
    *model = (struct model){0};
}

/* ---- Changes ---- */

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

/* What a change does to the elements behind it: where they are in the text, and their numbers. */
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
 * up to the next '<' at most, or to the end of the text if it swallows all of it. So what is before
 * the element with the change stays, and so does what begins after the change where only the root
 * is open.
 */
void model_update(struct model *model, const struct text *text, struct span old, uint32_t new_end)
{
    uint32_t first = last_before(model, old.start), from = first, by = new_end - old.end;
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
    reading.open = add_element(&reading, model->elements[root].start);
    read.elements[0].name = model->elements[root].name;
    bool is_there = false;
    while (!is_there && find_markup(&reading)) {
        is_there = reading.open == 0 && reading.at >= new_end
                   && find_old(model, reading.at - by, root, &from);
        if (!is_there)
            read_markup(&reading);
    }
    if (!is_there)
        from = model->num_elements;
    close_all(&reading);
    splice(model, &read, first, from, by);
    model_finish(&read);
}

/* ---- Looking ---- */

uint32_t model_element_at(const struct model *model, uint32_t offset)
{
    uint32_t low = 0, high = model->num_elements;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (model->elements[middle].start <= offset)
            low = middle + 1;
        else
            high = middle;
    }
    uint32_t found = low ? low - 1 : MODEL_NONE;
    while (found != MODEL_NONE && model->elements[found].end < offset)
        found = model->elements[found].parent;
    return found;
}

/* The element from an index on that is no comment, below `end`. */
static uint32_t skip_comments(const struct model *model, uint32_t index, uint32_t end)
{
    while (index < end && model->elements[index].is_comment)
        index = model->elements[index].after;
    return index < end ? index : MODEL_NONE;
}

uint32_t model_first(const struct model *model, uint32_t parent)
{
    uint32_t end = parent == MODEL_NONE ? model->num_elements : model->elements[parent].after;
    return skip_comments(model, parent == MODEL_NONE ? 0 : parent + 1, end);
}

uint32_t model_next(const struct model *model, uint32_t element)
{
    uint32_t parent = model->elements[element].parent,
             end = parent == MODEL_NONE ? model->num_elements : model->elements[parent].after;
    return skip_comments(model, model->elements[element].after, end);
}
