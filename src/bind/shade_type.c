// SPDX-License-Identifier: Apache-2.0
#include "bind/shade_type.h"

#include <assert.h>
#include <math.h>

enum shade_kind { OF_NUMBERS, OF_INTEGERS, OF_TRUTH, OF_TEXT, OF_FILE };

struct shade_row {
    const char *usd, *materialx;
    uint8_t kind; /* enum shade_kind */
    uint8_t components;
};

static const struct shade_row rows[] = {
    {"color3f", "color3", OF_NUMBERS, 3},     {"color3d", "color3", OF_NUMBERS, 3},
    {"color3h", "color3", OF_NUMBERS, 3},     {"color4f", "color4", OF_NUMBERS, 4},
    {"color4d", "color4", OF_NUMBERS, 4},     {"color4h", "color4", OF_NUMBERS, 4},
    {"float", "float", OF_NUMBERS, 1},        {"double", "float", OF_NUMBERS, 1},
    {"half", "float", OF_NUMBERS, 1},         {"float2", "vector2", OF_NUMBERS, 2},
    {"double2", "vector2", OF_NUMBERS, 2},    {"half2", "vector2", OF_NUMBERS, 2},
    {"texCoord2f", "vector2", OF_NUMBERS, 2}, {"texCoord2d", "vector2", OF_NUMBERS, 2},
    {"texCoord2h", "vector2", OF_NUMBERS, 2}, {"float3", "vector3", OF_NUMBERS, 3},
    {"double3", "vector3", OF_NUMBERS, 3},    {"half3", "vector3", OF_NUMBERS, 3},
    {"texCoord3f", "vector3", OF_NUMBERS, 3}, {"vector3f", "vector3", OF_NUMBERS, 3},
    {"vector3d", "vector3", OF_NUMBERS, 3},   {"normal3f", "vector3", OF_NUMBERS, 3},
    {"normal3d", "vector3", OF_NUMBERS, 3},   {"point3f", "vector3", OF_NUMBERS, 3},
    {"point3d", "vector3", OF_NUMBERS, 3},    {"float4", "vector4", OF_NUMBERS, 4},
    {"double4", "vector4", OF_NUMBERS, 4},    {"half4", "vector4", OF_NUMBERS, 4},
    {"matrix3d", "matrix33", OF_NUMBERS, 9},  {"matrix4d", "matrix44", OF_NUMBERS, 16},
    {"int", "integer", OF_INTEGERS, 1},       {"uint", "integer", OF_INTEGERS, 1},
    {"bool", "boolean", OF_TRUTH, 1},         {"string", "string", OF_TEXT, 1},
    {"token", "string", OF_TEXT, 1},          {"asset", "filename", OF_FILE, 1}};

static const struct shade_row *find(struct text_word type)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (usda_is(type, rows[i].usd))
            return &rows[i];
    return NULL;
}

/* The row of a type of MaterialX; NULL: USD has no values of it. */
static const struct shade_row *find_wanted(const char *type)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (strcmp(type, rows[i].materialx) == 0)
            return &rows[i];
    return NULL;
}

const char *shade_type(struct text_word type)
{
    const struct shade_row *row = find(type);
    return row ? row->materialx : NULL;
}

bool shade_type_agrees(struct text_word type, const char *wanted)
{
    const struct shade_row *row = find(type), *of_wanted = find_wanted(wanted);
    if (!of_wanted)
        return usda_is(type, "token");
    /* a name of a file may be written as a text */
    bool is_text = row && row->kind == OF_TEXT && of_wanted->kind == OF_FILE;
    return is_text
           || (row && row->kind == of_wanted->kind && row->components == of_wanted->components);
}

bool shade_value_fits(const struct usda_property *property)
{
    const struct shade_row *row = find(property->type);
    struct text_word value = usda_value(property), rest = value, word;
    if (!row || !value.len || usda_is(value, "None"))
        return true;
    if (row->kind == OF_TEXT)
        return strchr("\"'", *value.bytes) != NULL;
    if (row->kind == OF_FILE)
        return *value.bytes == '@';
    size_t num_words = 0, num_numbers = 0;
    double number = 0;
    bool are_whole = true;
    while (usda_next_item(&rest, &word))
        num_words++;
    for (rest = value; usda_next_number(&rest, &number); num_numbers++)
        are_whole = are_whole && number == floor(number);
    assert(num_numbers <= num_words);
    bool is_list = *value.bytes == '[';
    return !is_list && num_words == row->components && num_numbers == num_words
           && (row->kind == OF_NUMBERS || are_whole)
           && (row->kind != OF_TRUTH || number == 0 || number == 1);
}
