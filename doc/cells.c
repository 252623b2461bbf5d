// SPDX-License-Identifier: Apache-2.0
/* The texts of a port: type, default, values, meaning. */
#include "doc/manual.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_COMPONENTS = 16 };

/* The numbers of a comma-separated value; 0 if it is no such value. */
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

/*
 * Numbers without needless digits, and one for all components if they are equal, so that variants
 * of a node get equal texts.
 */
static const char *shorten(struct manual *manual, const char *value)
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
    return manual_keep(manual, text);
}

static bool is_text(const mxg_port *port)
{
    return strcmp(port->type, "string") == 0 || strcmp(port->type, "filename") == 0;
}

static const char *default_of(struct manual *manual, const mxg_port *port)
{
    if (*port->defaultgeomprop)
        return port->defaultgeomprop;
    return is_text(port) ? port->value : shorten(manual, port->value);
}

static const char *join(struct manual *manual, const char *a, const char *between, const char *b)
{
    return *a && *b ? manual_keep(manual, cli_format("%s%s%s", a, between, b)) : *a ? a : b;
}

/* "0 to 1", "from 0", "up to 1", "" */
static const char *range(struct manual *manual, const char *min, const char *max)
{
    if (*min && *max)
        return join(manual, shorten(manual, min), " to ", shorten(manual, max));
    return *min   ? join(manual, "from ", "", shorten(manual, min))
           : *max ? join(manual, "up to ", "", shorten(manual, max))
                  : "";
}

/* The part of a list up to its next comma, without spaces around it; *list moves past the comma. */
static const char *next_item(struct manual *manual, const char **list)
{
    const char *item = *list + strspn(*list, " ");
    size_t len = strcspn(item, ",");
    *list = item + len + (item[len] == ',');
    while (len > 0 && item[len - 1] == ' ')
        --len;
    return manual_keep(manual, cli_format("%.*s", (int)len, item));
}

/* "ggx, beckmann"; "linear = 0, smooth = 1" if names stand for other values */
static const char *choices(struct manual *manual, const mxg_port *port)
{
    const char *names = port->enum_names, *values = port->enum_values, *text = "";
    bool paired = *values && cli_count_items(names) == cli_count_items(values);
    while (*names) {
        const char *name = next_item(manual, &names);
        const char *value = paired ? next_item(manual, &values) : "";
        text = join(manual, text, ", ",
                    strcmp(name, value) == 0 ? name : join(manual, name, " = ", value));
    }
    return text;
}

static const char *values_of(struct manual *manual, const mxg_port *port)
{
    const char *soft = range(manual, port->uisoftmin, port->uisoftmax);
    const char *text = range(manual, port->uimin, port->uimax);
    if (*soft)
        text = join(manual, text, ", ", join(manual, "usually ", "", soft));
    text = join(manual, text, "; ", choices(manual, port));
    const char *unit = *port->unit       ? port->unit
                       : *port->unittype ? join(manual, port->unittype, " ", "unit")
                                         : "";
    return *unit ? join(manual, text, "; ", join(manual, "in ", "", unit)) : text;
}

const char *manual_cell(struct manual *manual, const mxg_port *port, enum manual_column column)
{
    switch (column) {
    case MANUAL_TYPE: return port->type;
    case MANUAL_DEFAULT: return default_of(manual, port);
    case MANUAL_VALUES: return values_of(manual, port);
    case MANUAL_MEANING:
    default: return port->doc;
    }
}
