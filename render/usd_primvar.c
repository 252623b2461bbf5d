// SPDX-License-Identifier: Apache-2.0
/* Primvars of USD for the corners of triangles (UsdGeomPrimvar). */
#include "render/site.h"

#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

unsigned usd_components(const char *type, size_t len)
{
    static const struct {
        const char *name;
        unsigned components;
    } types[] = {{"bool", 1},       {"uchar", 1},      {"int", 1},        {"uint", 1},
                 {"int64", 1},      {"uint64", 1},     {"half", 1},       {"float", 1},
                 {"double", 1},     {"int2", 2},       {"int3", 3},       {"int4", 4},
                 {"half2", 2},      {"half3", 3},      {"half4", 4},      {"float2", 2},
                 {"float3", 3},     {"float4", 4},     {"double2", 2},    {"double3", 3},
                 {"double4", 4},    {"texCoord2h", 2}, {"texCoord2f", 2}, {"texCoord2d", 2},
                 {"texCoord3h", 3}, {"texCoord3f", 3}, {"texCoord3d", 3}, {"color3h", 3},
                 {"color3f", 3},    {"color3d", 3},    {"color4h", 4},    {"color4f", 4},
                 {"color4d", 4},    {"point3h", 3},    {"point3f", 3},    {"point3d", 3},
                 {"normal3h", 3},   {"normal3f", 3},   {"normal3d", 3},   {"vector3h", 3},
                 {"vector3f", 3},   {"vector3d", 3},   {"quath", 4},      {"quatf", 4},
                 {"quatd", 4}};
    len -= len > 2 && memcmp(type + len - 2, "[]", 2) == 0 ? 2 : 0;
    for (size_t i = 0; i < sizeof types / sizeof *types; ++i)
        if (strlen(types[i].name) == len && memcmp(types[i].name, type, len) == 0)
            return types[i].components;
    return 0;
}

static bool is_integer(const char *type)
{
    return strncmp(type, "int", 3) == 0 || strncmp(type, "uint", 4) == 0
           || strncmp(type, "bool", 4) == 0 || strncmp(type, "uchar", 5) == 0;
}

static bool is_word(const char *text, size_t len, const char *word)
{
    return strlen(word) == len && memcmp(text, word, len) == 0;
}

/* A primvar as the file has it. */
struct authored {
    uint32_t primitive;
    char *property; /* "primvars:st" */
    double *values;
    size_t num_values; /* of `components` numbers */
    double *indices;   /* NULL: value i is number i */
    size_t num_indices;
    unsigned components;
    const char *interpolation;
};

/* The index of a corner's value; SIZE_MAX: there is none. */
static size_t value_of(const struct authored *from, const struct usd_corners *corners, uint32_t i)
{
    size_t at = strcmp(from->interpolation, "constant") == 0      ? 0
                : strcmp(from->interpolation, "uniform") == 0     ? corners->faces[i]
                : strcmp(from->interpolation, "faceVarying") == 0 ? corners->numbers[i]
                                                                  : corners->points[i];
    if (from->indices) {
        if (at >= from->num_indices
            || !(from->indices[at] >= 0 && from->indices[at] < (double)from->num_values))
            return SIZE_MAX;
        at = (size_t)from->indices[at];
    }
    return at < from->num_values ? at : SIZE_MAX;
}

static void store(const struct authored *from, size_t at, float out[4])
{
    for (unsigned c = 0; c < from->components; ++c)
        out[c] = (float)from->values[at * from->components + c];
}

static bool fill(const struct authored *from, const struct usd_corners *corners,
                 struct primvar *out)
{
    for (uint32_t i = 0; i < out->num; ++i) {
        size_t at = value_of(from, corners, i);
        if (at == SIZE_MAX)
            return false;
        store(from, at, out->values[i]);
    }
    return true;
}

static void append(struct scene_object *object, struct primvar made)
{
    MEMORY_PUSH(object->primvars, object->num_primvars, made);
}

/* A primvar without values. */
static struct primvar begin_primvar(const char *name, const mxg_property *property)
{
    return (struct primvar){.name = cli_format("%s", name + strlen("primvars:")),
                            .components = usd_components(property->type, property->type_len),
                            .is_integer = is_integer(property->type),
                            .type = property->type,
                            .type_len = (int)property->type_len,
                            .file = property->file,
                            .line = property->line,
                            .column = property->column};
}

static void convert(struct site *site, struct authored *from, const mxg_property *property,
                    const struct usd_corners *corners, struct scene_object *object)
{
    bool is_constant = strcmp(from->interpolation, "constant") == 0;
    struct primvar made = begin_primvar(from->property, property);
    made.num = is_constant ? 1 : corners->count;
    made.values = memory_alloc(made.num * sizeof *made.values + 1);
    if (!fill(from, corners, &made)) {
        site_fail(site, from->primitive, from->property,
                  "has %zu values and %zu indices, too few for the interpolation '%s'",
                  from->num_values, from->num_indices, from->interpolation);
        free(made.name);
        free(made.values);
        return;
    }
    append(object, made);
}

const char *usd_interpolation(const mxg_property *property, const char *otherwise)
{
    static const char *const words[] = {"constant", "uniform", "vertex", "varying", "faceVarying"};
    if (!property->interpolation_len)
        return otherwise;
    for (size_t i = 0; i < sizeof words / sizeof *words; ++i)
        if (is_word(property->interpolation, property->interpolation_len, words[i]))
            return words[i];
    return NULL;
}

static void add_words(const char *name, const mxg_property *property, struct scene_object *object)
{
    if (object_primvar(object, name + strlen("primvars:")))
        return;
    struct primvar made = begin_primvar(name, property);
    made.num = 1;
    made.values = memory_alloc(sizeof *made.values);
    append(object, made);
}

static void add_primvar(struct site *site, uint32_t primitive, const mxg_property *property,
                        bool is_inherited, const struct usd_corners *corners,
                        struct scene_object *object)
{
    struct authored from = {.primitive = primitive,
                            .components = usd_components(property->type, property->type_len),
                            .interpolation = usd_interpolation(property, "constant")};
    from.property = cli_format("%.*s", (int)property->name_len, property->name);
    char *indices = cli_format("%s:indices", from.property);
    bool is_constant = from.interpolation && strcmp(from.interpolation, "constant") == 0;
    if (!from.components) /* no attribute has words; who reads it learns why */
        add_words(from.property, property, object);
    else if (!from.interpolation)
        site_fail(site, primitive, from.property, "has no interpolation of USD: '%.*s'",
                  (int)property->interpolation_len, property->interpolation);
    else if ((is_constant || (!is_inherited && corners->points))
             && !object_primvar(object, from.property + strlen("primvars:"))) {
        from.values = usd_numbers(site, primitive, from.property, &from.num_values);
        from.num_values /= from.components;
        from.indices = usd_numbers(site, primitive, indices, &from.num_indices);
        if (from.values)
            convert(site, &from, property, corners, object);
        free(from.values);
        free(from.indices);
    }
    free(from.property);
    free(indices);
}

static bool is_primvar(const mxg_property *property)
{
    static const char prefix[] = "primvars:";
    size_t len = strlen(prefix);
    if (property->name_len <= len || memcmp(property->name, prefix, len) != 0)
        return false;
    for (size_t i = len; i < property->name_len; ++i)
        if (property->name[i] == ':') /* "primvars:st:indices" */
            return strncmp(property->name + i, ":indices", property->name_len - i) != 0;
    return true;
}

void usd_add_primvars(struct site *site, uint32_t primitive, const struct usd_corners *corners,
                      struct scene_object *object)
{
    uint32_t own = primitive;
    while (primitive != UINT32_MAX) {
        uint32_t num = mxg_scene_num_properties(site->scene, primitive);
        for (uint32_t i = 0; i < num; ++i) {
            mxg_property property = {sizeof property};
            mxg_scene_property(site->scene, primitive, i, &property);
            if (is_primvar(&property))
                add_primvar(site, primitive, &property, primitive != own, corners, object);
        }
        mxg_primitive at = {sizeof at};
        mxg_scene_primitive(site->scene, primitive, &at);
        primitive = at.parent;
    }
}

/* ---- Instances ---- */

/* A list of its own for an object that shares that of another. */
static void own_primvars(struct site_object *site_object)
{
    struct scene_object *object = &site_object->object;
    size_t size = object->num_primvars * sizeof *object->primvars;
    struct primvar *own = memory_alloc(size + 1);
    if (size)
        memcpy(own, object->primvars, size);
    object->primvars = own;
}

/* Adds the value of a primvar for one instance. */
static void add_instance_primvar(struct site *site, uint32_t instancer, size_t instance,
                                 const mxg_property *property, struct site_object *to)
{
    const uint32_t number = (uint32_t)instance;
    const struct usd_corners one = {1, &number, &number, &number};
    struct scene_object made = {0};
    add_primvar(site, instancer, property, false, &one, &made);
    if (made.num_primvars && !object_primvar(&to->object, made.primvars->name)) {
        if (to->shares_primvars && !to->num_own_primvars)
            own_primvars(to);
        append(&to->object, *made.primvars);
        to->num_own_primvars++;
        free(made.primvars);
    } else {
        object_finish_primvars(&made, made.num_primvars);
    }
}

void usd_add_instance_primvars(struct site *site, uint32_t instancer, size_t instance,
                               struct site_object *object)
{
    uint32_t num = mxg_scene_num_properties(site->scene, instancer);
    for (uint32_t i = 0; i < num; ++i) {
        mxg_property property = {sizeof property};
        mxg_scene_property(site->scene, instancer, i, &property);
        if (is_primvar(&property))
            add_instance_primvar(site, instancer, instance, &property, object);
    }
}
