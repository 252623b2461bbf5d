// SPDX-License-Identifier: Apache-2.0
/* What is said of a port, in words: type, default, values, meaning. */
#include "cli/doc/doc.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_COMPONENTS = 16 };

/* The numbers of a value, separated by commas; 0 where it is something else. */
static size_t read_numbers(const char *text, double numbers[MAX_COMPONENTS])
{
    for (size_t i = 0; i < MAX_COMPONENTS; ++i) {
        char *end;
        numbers[i] = strtod(text, &end);
        if (end == text)
            return 0;
        end += strspn(end, " ");
        if (*end == '\0')
            return i + 1;
        if (*end != ',')
            return 0;
        text = end + 1;
    }
    return 0;
}

static bool are_equal(const double *numbers, size_t count)
{
    for (size_t i = 1; i < count; ++i)
        if (numbers[i] != numbers[0])
            return false;
    return true;
}

static bool is_identity(const double *numbers, size_t count)
{
    size_t order = count == 9 ? 3 : count == 16 ? 4 : 0;
    for (size_t i = 0; i < order * order; ++i)
        if (numbers[i] != (i % (order + 1) == 0 ? 1.0 : 0.0))
            return false;
    return order > 0;
}

/* Numbers without needless digits, one for all components where they are equal: so the variants of a node agree. */
static const char *shorten(struct doc *doc, const char *value)
{
    double numbers[MAX_COMPONENTS];
    size_t count = read_numbers(value, numbers);
    if (count == 0)
        return value;
    if (is_identity(numbers, count))
        return "identity";
    if (are_equal(numbers, count))
        count = 1;
    char *text = cli_format("%g", numbers[0]);
    for (size_t i = 1; i < count; ++i) {
        char *longer = cli_format("%s, %g", text, numbers[i]);
        free(text);
        text = longer;
    }
    return doc_keep(doc, text);
}

static bool is_text(const mxg_port *port)
{
    return strcmp(port->type, "string") == 0 || strcmp(port->type, "filename") == 0;
}

static const char *default_of(struct doc *doc, const mxg_port *port)
{
    if (*port->defaultgeomprop)
        return port->defaultgeomprop;
    return is_text(port) ? port->value : shorten(doc, port->value);
}

static const char *join(struct doc *doc, const char *a, const char *between, const char *b)
{
    return *a && *b ? doc_keep(doc, cli_format("%s%s%s", a, between, b)) : *a ? a : b;
}

/* "0 to 1", "from 0", "up to 1", "" */
static const char *range(struct doc *doc, const char *min, const char *max)
{
    if (*min && *max)
        return join(doc, shorten(doc, min), " to ", shorten(doc, max));
    return *min ? join(doc, "from ", "", shorten(doc, min)) : *max ? join(doc, "up to ", "", shorten(doc, max)) : "";
}

static size_t count_items(const char *list)
{
    size_t count = *list != '\0';
    for (; *list; ++list)
        count += *list == ',';
    return count;
}

/* The part of a list up to its next comma, without spaces around; *list moves behind the comma. */
static const char *next_item(struct doc *doc, const char **list)
{
    const char *item = *list + strspn(*list, " ");
    size_t len = strcspn(item, ",");
    *list = item + len + (item[len] == ',');
    while (len > 0 && item[len - 1] == ' ')
        --len;
    return doc_keep(doc, cli_format("%.*s", (int)len, item));
}

/* "ggx, beckmann"; "linear = 0, smooth = 1" where a name stands for another value */
static const char *choices(struct doc *doc, const mxg_port *port)
{
    const char *names = port->enum_names, *values = port->enum_values, *text = "";
    bool paired = *values && count_items(names) == count_items(values);
    while (*names) {
        const char *name = next_item(doc, &names);
        const char *value = paired ? next_item(doc, &values) : "";
        text = join(doc, text, ", ", strcmp(name, value) == 0 ? name : join(doc, name, " = ", value));
    }
    return text;
}

static const char *values_of(struct doc *doc, const mxg_port *port)
{
    const char *soft = range(doc, port->uisoftmin, port->uisoftmax);
    const char *text = range(doc, port->uimin, port->uimax);
    if (*soft)
        text = join(doc, text, ", ", join(doc, "usually ", "", soft));
    text = join(doc, text, "; ", choices(doc, port));
    const char *unit = *port->unit ? port->unit : *port->unittype ? join(doc, port->unittype, " ", "unit") : "";
    return *unit ? join(doc, text, "; ", join(doc, "in ", "", unit)) : text;
}

const char *doc_cell(struct doc *doc, const mxg_port *port, enum doc_column column)
{
    switch (column) {
    case DOC_TYPE:
        return port->type;
    case DOC_DEFAULT:
        return default_of(doc, port);
    case DOC_VALUES:
        return values_of(doc, port);
    case DOC_MEANING:
    default:
        return port->doc;
    }
}
