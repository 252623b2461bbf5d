// SPDX-License-Identifier: Apache-2.0
/* The properties that the primitives of a USD layer have. */
#include "api/scene.h"

#include "base/num.h"

static const struct usda_prim *prim_of(const struct scene *scene, uint32_t source)
{
    return &scene->layer.prims.items[scene->sources.items[source - 1].prim];
}

/* A word of the layer, or "". */
static void set_text(struct text_word word, const char **out, size_t *out_len)
{
    *out = word.len ? word.bytes : "";
    *out_len = word.len;
}

static mxg_property describe(const struct scene *scene, const struct usda_property *property)
{
    mxg_property full = {
        .file = scene->layer.file, .line = property->line, .column = property->column};
    struct text_word name = property->name, value = usda_value(property);
    if (value.bytes != property->value.bytes)
        name.len -= strlen(USDA_SAMPLES);
    set_text(name, &full.name, &full.name_len);
    set_text(property->type, &full.type, &full.type_len);
    set_text(property->interpolation, &full.interpolation, &full.interpolation_len);
    set_text(value, &full.value, &full.value_len);
    return full;
}

/* True if a stronger source than this one has a property of the name. */
static bool is_hidden(const struct scene *scene, prim_id prim, uint32_t source,
                      struct text_word name)
{
    for (uint32_t i = scene_source(scene, prim); i != source;
         i = scene->sources.items[i - 1].next) {
        const struct usda_named *named =
            usda_find_named(&scene->layer, scene->sources.items[i - 1].prim, name);
        if (named && named->first)
            return true;
    }
    return false;
}

/* The properties of a source that no stronger one hides: `index` counts down to the wanted one. */
static const struct usda_property *find_in(const struct scene *scene, prim_id prim, uint32_t source,
                                           uint32_t *index, const struct usda_property *wanted,
                                           uint32_t *num)
{
    const struct usda_prim *from = prim_of(scene, source);
    const struct usda_property *all = scene->layer.properties.items + from->first_property;
    if (source == scene_source(scene, prim) && !wanted) { /* none is hidden */
        uint32_t skipped = *index < from->num_properties ? *index : from->num_properties;
        *num += skipped;
        *index -= skipped;
        return skipped < from->num_properties ? &all[skipped] : NULL;
    }
    for (uint32_t k = 0; k < from->num_properties; k++) {
        if (is_hidden(scene, prim, source, all[k].name))
            continue;
        if (wanted ? &all[k] == wanted : !*index)
            return &all[k];
        *index -= !wanted;
        ++*num;
    }
    return NULL;
}

/*
 * Property `index` of a primitive, or the one that is `wanted`, with its index; NULL with their
 * number.
 */
static const struct usda_property *find(const struct scene *scene, prim_id prim, uint32_t index,
                                        const struct usda_property *wanted, uint32_t *out_num)
{
    const struct usda_property *found = NULL;
    *out_num = 0;
    for (uint32_t i = scene_source(scene, prim); i && !found; i = scene->sources.items[i - 1].next)
        found = find_in(scene, prim, i, &index, wanted, out_num);
    return found;
}

uint32_t mxg_scene_num_properties(const mxg_scene *scene, uint32_t primitive)
{
    uint32_t num = 0;
    if (has_primitive(scene, primitive))
        find(&scene->scene, primitive + 1, MXG_NONE, NULL, &num);
    return num;
}

mxg_status mxg_scene_property(const mxg_scene *scene, uint32_t primitive, uint32_t index,
                              mxg_property *out)
{
    uint32_t num;
    const struct usda_property *found = has_primitive(scene, primitive)
                                            ? find(&scene->scene, primitive + 1, index, NULL, &num)
                                            : NULL;
    if (!found)
        return MXG_ERROR_ARGUMENT;
    mxg_property full = describe(&scene->scene, found);
    return struct_write(out, &full, sizeof full);
}

uint32_t mxg_scene_find_property(const mxg_scene *scene, uint32_t primitive, const char *name)
{
    const struct usda_property *wanted =
        has_primitive(scene, primitive) && name
            ? scene_property(&scene->scene, primitive + 1, name, NULL)
            : NULL;
    uint32_t index = MXG_NONE;
    if (wanted)
        find(&scene->scene, primitive + 1, MXG_NONE, wanted, &index);
    return index;
}

/* The value of a property; len 0: none. */
static struct text_word value_of(const mxg_scene *scene, uint32_t primitive, const char *name,
                                 uint32_t *out_source)
{
    const struct usda_property *found =
        has_primitive(scene, primitive) && name
            ? scene_property(&scene->scene, primitive + 1, name, out_source)
            : NULL;
    return found ? usda_value(found) : (struct text_word){0};
}

size_t mxg_scene_property_numbers(const mxg_scene *scene, uint32_t primitive, const char *name,
                                  double *out, size_t capacity)
{
    struct text_word rest = value_of(scene, primitive, name, NULL);
    size_t num = 0;
    for (double number; usda_next_number(&rest, &number); num++)
        if (out && num < capacity)
            out[num] = number;
    return num;
}

/* Word `index` of a value. */
static bool find_word(struct text_word value, uint32_t index, struct text_word *out)
{
    bool good = !usda_is(value, "None") && usda_next_item(&value, out);
    for (; good && index; index--)
        good = usda_next_item(&value, out);
    return good;
}

size_t mxg_scene_property_word(const mxg_scene *scene, uint32_t primitive, const char *name,
                               uint32_t index, char *buffer, size_t capacity)
{
    struct text_word word;
    return find_word(value_of(scene, primitive, name, NULL), index, &word)
               ? text_copy(word.bytes, word.len, buffer, capacity)
               : 0;
}

size_t mxg_scene_property_targets(const mxg_scene *scene, uint32_t primitive, const char *name,
                                  uint32_t *out, size_t capacity)
{
    uint32_t source = 0;
    struct text_word rest = value_of(scene, primitive, name, &source), path;
    size_t num = 0;
    for (; !usda_is(rest, "None") && usda_next_item(&rest, &path); num++)
        if (out && num < capacity)
            out[num] = scene_number(scene_target(&scene->scene, source, path));
    return num;
}

char mxg_scene_up_axis(const mxg_scene *scene)
{
    return scene && usda_is(scene->scene.layer.up_axis, "Z") ? 'Z' : 'Y';
}

double mxg_scene_meters_per_unit(const mxg_scene *scene)
{
    enum { CENTIMETERS = 100 }; /* UsdGeomGetStageMetersPerUnit's fallback */
    float unit;
    if (!scene || !scene->scene.layer.prims.len)
        return 0;
    struct text_word word = scene->scene.layer.meters_per_unit;
    return word.len && num_parse_float(word.bytes, word.len, &unit) ? (double)unit
                                                                    : 1.0 / CENTIMETERS;
}
