// SPDX-License-Identifier: Apache-2.0
#include "mutate.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum { MAX_ELEMENTS = 1024, MAX_ATTRIBUTES = 4096, MAX_OPEN = 64 };

struct span {
    size_t begin, end;
};

struct attribute {
    struct span name, value;
};

struct mutator {
    char *data;
    size_t size, capacity;
    unsigned state;
    struct span elements[MAX_ELEMENTS]; /* from '<' to behind the '>' of the end tag */
    struct span tags[MAX_ELEMENTS];     /* the name in the start tag */
    unsigned num_elements;
    struct attribute attributes[MAX_ATTRIBUTES];
    unsigned num_attributes;
};

static unsigned below(struct mutator *m, unsigned limit)
{
    m->state = m->state * 1664525u + 1013904223u;
    return limit ? (m->state >> 8) % limit : 0;
}

static bool is_name(char c)
{
    return isalnum((unsigned char)c) || c == '_' || c == ':' || c == '-' || c == '.';
}

/* Reads the attributes behind a tag's name; returns the offset of its '>'. */
static size_t scan_attributes(struct mutator *m, size_t at)
{
    while (at < m->size && m->data[at] != '>') {
        if (!is_name(m->data[at])) {
            at++;
            continue;
        }
        struct attribute attribute = {.name = {at, at}};
        while (at < m->size && is_name(m->data[at]))
            at++;
        attribute.name.end = at;
        if (at + 1 >= m->size || m->data[at] != '=' || !strchr("'\"", m->data[at + 1]))
            continue;
        const char *end = memchr(m->data + at + 2, m->data[at + 1], m->size - at - 2);
        if (!end)
            return m->size;
        attribute.value = (struct span){at + 2, (size_t)(end - m->data)};
        if (m->num_attributes < MAX_ATTRIBUTES)
            m->attributes[m->num_attributes++] = attribute;
        at = attribute.value.end + 1;
    }
    return at;
}

static void scan(struct mutator *m)
{
    unsigned open[MAX_OPEN], depth = 0;
    m->num_elements = m->num_attributes = 0;
    for (size_t at = 0; at + 1 < m->size; at++) {
        if (m->data[at] != '<')
            continue;
        if (m->data[at + 1] == '/' && depth) {
            const char *end = memchr(m->data + at, '>', m->size - at);
            m->elements[open[--depth]].end = end ? (size_t)(end - m->data) + 1 : m->size;
        }
        if (!is_name(m->data[at + 1]) || m->num_elements == MAX_ELEMENTS)
            continue;
        unsigned element = m->num_elements++;
        size_t name = at + 1, end = name;
        while (end < m->size && is_name(m->data[end]))
            end++;
        m->tags[element] = (struct span){name, end};
        end = scan_attributes(m, end);
        m->elements[element] = (struct span){at, end < m->size ? end + 1 : m->size};
        if (end < m->size && m->data[end - 1] != '/' && depth < MAX_OPEN)
            open[depth++] = element;
        at = end;
    }
}

/* Puts text, which may be a part of the document, in the place of a span. */
static void replace(struct mutator *m, struct span span, const char *text, size_t len)
{
    char copy[8192];
    size_t rest = m->size - span.end;
    if (len > sizeof copy || span.begin + len + rest > m->capacity)
        return;
    memcpy(copy, text, len);
    memmove(m->data + span.begin + len, m->data + span.end, rest);
    memcpy(m->data + span.begin, copy, len);
    m->size = span.begin + len + rest;
}

static bool is_named(const struct mutator *m, const struct attribute *attribute, const char *name)
{
    size_t len = strlen(name);
    return attribute->name.end - attribute->name.begin == len
           && memcmp(m->data + attribute->name.begin, name, len) == 0;
}

/* Any attribute of this name; NULL: there is none. */
static const struct attribute *pick(struct mutator *m, const char *name)
{
    unsigned first = below(m, m->num_attributes);
    for (unsigned i = 0; i < m->num_attributes; i++) {
        const struct attribute *at = &m->attributes[(first + i) % m->num_attributes];
        if (is_named(m, at, name))
            return at;
    }
    return NULL;
}

static const char *const extremes[] = {
    "1e39",
    "-1e39",
    "nan",
    "inf",
    "-0.0",
    "1e-45",
    "0",
    "1",
    "-1",
    "2",
    "0.5",
    "3.4028235e38",
    "2147483647",
    "2147483648",
    "-2147483648",
    "4000000000",
    "",
    "true",
    "false",
    "1, 2, 3, 4, 5",
    "1e39, 1e39, 1e39",
    "0, 0, 0",
    "-1, 0, 1e39, 0",
    "1001,1002,1002,1999",
    "a.<UDIM>.png",
    "../../x.png",
    "0, 0, 0, 0, 0, 0, 0, 0, 0",
    "periodic",
    "tangent",
    "world",
    "..",
    "/",
    "a/b",
};
static const char *const types[] = {
    "float",       "integer",      "boolean",
    "color3",      "color4",       "vector2",
    "vector3",     "vector4",      "matrix33",
    "matrix44",    "string",       "filename",
    "BSDF",        "EDF",          "VDF",
    "material",    "multioutput",  "surfaceshader",
    "lightshader", "volumeshader", "displacementshader",
    "floatarray",  "stringarray",
};
static const char *const references[] = {"nodename", "nodegraph", "interfacename", "output",
                                         "nodedef",  "inherit",   "node",          "name",
                                         "target",   "function",  "sourcecode",    "type",
                                         "file",     "channels",  "colorspace",    "implname"};
#define NUM(array) (unsigned)(sizeof(array) / sizeof *(array))

static void set_from(struct mutator *m, const char *name, const char *const *words, unsigned num)
{
    const struct attribute *at = pick(m, name);
    const char *word = words[below(m, num)];
    if (at)
        replace(m, at->value, word, strlen(word));
}

/* A reference gets the value of another attribute of its kind, or the name of an element. */
static void connect(struct mutator *m)
{
    const char *name = references[below(m, NUM(references))];
    const struct attribute *to = pick(m, name), *from = pick(m, below(m, 2) ? name : "name");
    if (to && from)
        replace(m, to->value, m->data + from->value.begin, from->value.end - from->value.begin);
}

static void remove_attribute(struct mutator *m)
{
    if (!m->num_attributes)
        return;
    const struct attribute *at = &m->attributes[below(m, m->num_attributes)];
    replace(m, (struct span){at->name.begin, at->value.end + 1}, "", 0);
}

/* A value becomes a connection, and the other way round. */
static void rename_attribute(struct mutator *m)
{
    static const char *const names[] = {"value",  "nodename", "interfacename",   "nodegraph",
                                        "output", "channels", "defaultgeomprop", "uniform",
                                        "enum",   "unit"};
    const char *name = names[below(m, NUM(names))];
    if (m->num_attributes)
        replace(m, m->attributes[below(m, m->num_attributes)].name, name, strlen(name));
}

static void copy_element(struct mutator *m)
{
    if (!m->num_elements)
        return;
    struct span from = m->elements[below(m, m->num_elements)];
    size_t to = m->elements[below(m, m->num_elements)].begin;
    if (below(m, 2)) /* inside, behind the start tag */
        to = m->tags[below(m, m->num_elements)].end;
    const char *end = memchr(m->data + to, '>', m->size - to);
    if (end && end > m->data && end[-1] != '/' && m->data[to] != '<')
        to = (size_t)(end - m->data) + 1;
    if (m->data[to < m->size ? to : 0] == '<' || to == m->size)
        replace(m, (struct span){to, to}, m->data + from.begin, from.end - from.begin);
}

static void remove_element(struct mutator *m)
{
    if (m->num_elements > 1)
        replace(m, m->elements[1 + below(m, m->num_elements - 1)], "", 0);
}

/* Only tags without children, which have no end tag. */
static void change_tag(struct mutator *m)
{
    if (!m->num_elements)
        return;
    unsigned element = below(m, m->num_elements), other = below(m, m->num_elements);
    struct span span = m->elements[element];
    if (span.end >= 2 && m->data[span.end - 2] == '/')
        replace(m, m->tags[element], m->data + m->tags[other].begin,
                m->tags[other].end - m->tags[other].begin);
}

static struct mutator m; /* too large for the stack */

size_t mutate_document(char *data, size_t size, size_t capacity, unsigned seed)
{
    m.data = data;
    m.size = size;
    m.capacity = capacity;
    m.state = seed;
    for (unsigned n = 1 + below(&m, 4); n; n--) {
        scan(&m);
        switch (below(&m, 12)) {
        case 0:
        case 1:
        case 2: set_from(&m, "value", extremes, NUM(extremes)); break;
        case 3:
        case 4:
        case 5: connect(&m); break;
        case 6: set_from(&m, "type", types, NUM(types)); break;
        case 7: rename_attribute(&m); break;
        case 8: remove_attribute(&m); break;
        case 9: remove_element(&m); break;
        case 10: change_tag(&m); break;
        default: copy_element(&m);
        }
    }
    return m.size;
}

size_t mutate_cross(const char *data, size_t size, const char *other, size_t other_size, char *out,
                    size_t capacity, unsigned seed)
{
    static char piece[8192];
    m.data = (char *)(size_t)other; /* only read */
    m.size = other_size;
    m.state = seed;
    scan(&m);
    if (m.num_elements < 2 || size > capacity)
        return 0;
    struct span from = m.elements[1 + below(&m, m.num_elements - 1)];
    size_t len = from.end - from.begin;
    if (len > sizeof piece)
        return 0;
    memcpy(piece, other + from.begin, len);
    memcpy(out, data, size);
    m.data = out;
    m.size = size;
    m.capacity = capacity;
    scan(&m);
    if (m.num_elements < 2)
        return 0;
    size_t to = m.elements[1 + below(&m, m.num_elements - 1)].begin;
    replace(&m, (struct span){to, to}, piece, len);
    return m.size;
}

/* ---- Mutation, which libFuzzer calls ---- */

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);
size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size,
                                 uint8_t *out, size_t max_size, unsigned seed);

#ifdef MXG_FUZZ
enum { BYTES = 8 }; /* one mutation of so many is of bytes */

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed)
{
    return seed % BYTES == 0 ? LLVMFuzzerMutate(data, size, max_size)
                             : mutate_document((char *)data, size, max_size, seed);
}

size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size,
                                 uint8_t *out, size_t max_size, unsigned seed)
{
    return mutate_cross((const char *)a, a_size, (const char *)b, b_size, (char *)out, max_size,
                        seed);
}
#endif
