// SPDX-License-Identifier: Apache-2.0
/*
 * Boxes of colours, and values for colours that somebody picks. An editor shows sRGB; the document
 * has values in its colour space, which is linear where nothing names one.
 */
#include "lsp/handlers.h"
#include "lsp/query.h"
#include "lsp/wire.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* sRGB of a linear value (IEC 61966-2-1), and back. */
static double encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

static double decode(double srgb)
{
    return srgb <= 0.04045 ? srgb / 12.92 : pow((srgb + 0.055) / 1.055, 2.4);
}

static double same(double value)
{
    return value;
}

static double encode_22(double value)
{
    return encode(pow(value, 2.2));
}

static double decode_22(double srgb)
{
    return pow(decode(srgb), 1 / 2.2);
}

/* Spaces with the primaries of sRGB; others have no boxes. */
static const struct space {
    const char *name;
    double (*to_srgb)(double value);
    double (*from_srgb)(double srgb);
} spaces[] = {
    {"", encode, decode},
    {"none", encode, decode},
    {"lin_rec709", encode, decode},
    {"lin_srgb", encode, decode},
    {"srgb_texture", same, same},
    {"gamma22", encode_22, decode_22},
    {"g22_rec709", encode_22, decode_22},
};

static const struct space *space_of(const struct lsp_query *query, uint32_t element)
{
    char name[QUERY_NAME] = "";
    while (element != MODEL_NONE && !*query_text(query, element, "colorspace", name, sizeof name))
        element = query->model->elements[element].parent;
    for (size_t i = 0; i < sizeof spaces / sizeof *spaces; ++i)
        if (strcmp(spaces[i].name, element == MODEL_NONE ? "" : name) == 0)
            return &spaces[i];
    return NULL;
}

/* Reads numbers; returns how many. */
static int read_numbers(const char *text, double numbers[4])
{
    int num = 0;
    for (char *end; num < 4; ++num, text = end + strspn(end, " ,\t")) {
        double number = strtod(text, &end);
        if (end == text)
            break;
        numbers[num] = number;
    }
    return num;
}

/* The colour of a value; false: it is none. */
static bool read_colour(const struct lsp_query *query, uint32_t element, struct span *out_value,
                        double colour[4])
{
    char type[QUERY_NAME], value[QUERY_NAME];
    const struct space *space = space_of(query, element);
    query_text(query, element, "type", type, sizeof type);
    query_text(query, element, "value", value, sizeof value);
    int wanted = strcmp(type, "color3") == 0 ? 3 : strcmp(type, "color4") == 0 ? 4 : 0;
    colour[3] = 1;
    if (!space || !wanted || read_numbers(value, colour) != wanted)
        return false;
    for (int i = 0; i < 4; ++i) {
        double shown = i < 3 ? space->to_srgb(colour[i] > 0 ? colour[i] : 0) : colour[i];
        colour[i] = shown < 0 ? 0 : shown < 1 ? shown : 1;
    }
    *out_value = query_value(query, element, "value");
    return true;
}

json_t *handle_colours(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    if (!lsp_query(session, params, &query, error))
        return NULL;
    json_t *list = json_array();
    for (uint32_t i = 0; i < query.model->num_elements; ++i) {
        struct span value;
        double colour[4];
        if (!read_colour(&query, i, &value, colour))
            continue;
        json_array_append_new(list, json_pack("{s:o, s:{s:f, s:f, s:f, s:f}}", "range",
                                              wire_range(session, query.text, value), "color",
                                              "red", colour[0], "green", colour[1], "blue",
                                              colour[2], "alpha", colour[3]));
    }
    return list;
}

static double part_of(const json_t *colour, const char *key)
{
    double value = json_number_value(json_object_get(colour, key));
    return value >= 0 && value <= 1 ? value : 0;
}

/* The value for a colour that somebody picked in the place of another one. */
json_t *handle_presentations(struct lsp_session *session, const json_t *params,
                             struct lsp_error *error)
{
    struct lsp_query query;
    struct span range;
    const json_t *colour = json_object_get(params, "color");
    if (!lsp_query(session, params, &query, error)
        || !wire_read_range(session, query.text, json_object_get(params, "range"), &range))
        return NULL;
    query.offset = range.start;
    struct place place = query_place(&query);
    const struct space *space = place.part == PLACE_VALUE ? space_of(&query, place.element) : NULL;
    if (!space)
        return json_array();
    char value[QUERY_NAME];
    int len = snprintf(
        value, sizeof value, "%.4g, %.4g, %.4g", space->from_srgb(part_of(colour, "red")),
        space->from_srgb(part_of(colour, "green")), space->from_srgb(part_of(colour, "blue")));
    if (query_equals(query.text, query_value(&query, place.element, "type"), "color4"))
        snprintf(value + len, sizeof value - (size_t)len, ", %.4g", part_of(colour, "alpha"));
    return json_pack("[{s:s, s:o}]", "label", value, "textEdit",
                     wire_edit(session, query.text, range, value));
}
