// SPDX-License-Identifier: Apache-2.0
#include "import/gltf_accessor.h"

#include <math.h>
#include <string.h>

/* An accessor without bytes costs nothing in the file: it may have so many elements. */
enum { MAX_ZEROS = 1 << 20 };

/* ---- Types ---- */

/* glTF 2.0, 3.6.2.2: types of numbers; `most` divides those that are normalized. */
static const struct kind {
    uint64_t number;
    unsigned size;
    double most;
    bool is_signed, is_float;
} kinds[] = {{5120, 1, 127, true, false},           {5121, 1, 255, false, false},
             {5122, 2, 32767, true, false},         {5123, 2, 65535, false, false},
             {5125, 4, 4294967295.0, false, false}, {5126, 4, 1, true, true}};
enum { NUM_KINDS = sizeof kinds / sizeof *kinds };

static const struct shape {
    const char *name;
    unsigned width;
} shapes[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
enum { NUM_SHAPES = sizeof shapes / sizeof *shapes };

static const char *name_of(unsigned width)
{
    for (size_t i = 0; i < NUM_SHAPES; ++i)
        if (shapes[i].width == width)
            return shapes[i].name;
    return "";
}

static unsigned find_kind(const json_t *object)
{
    uint64_t number = json_count_of(object, "componentType");
    unsigned kind = 0;
    while (kind < NUM_KINDS && kinds[kind].number != number)
        ++kind;
    return kind;
}

/* ---- Opening ---- */

/*
 * The first of `count` elements of `size` bytes in a view. NULL after a fault. `path` is the place
 * of the view's user in the JSON.
 */
static const uint8_t *find_elements(struct gltf_source *source, const json_t *user,
                                    const char *path, size_t count, size_t size, size_t *out_stride)
{
    size_t view = gltf_index_of(user, "bufferView"), begin = json_count_of(user, "byteOffset"),
           view_size;
    const uint8_t *data = gltf_source_view(source, view, &view_size);
    size_t stride = json_count_of(gltf_source_item(source, "bufferViews", view), "byteStride");
    *out_stride = stride ? stride : size;
    if (!data)
        return NULL;
    if (*out_stride < size) {
        gltf_source_fail(source,
                         "bufferViews[%zu].byteStride is %zu; an element of %s has %zu bytes", view,
                         stride, path, size);
        return NULL;
    }
    if (begin > view_size || size > view_size - begin
        || (count - 1) > (view_size - begin - size) / *out_stride) {
        gltf_source_fail(source, "%s has %zu elements, which end behind bufferViews[%zu]", path,
                         count, view);
        return NULL;
    }
    return data + begin;
}

static uint64_t read_count(const uint8_t *from, unsigned size)
{
    uint64_t number = 0;
    for (unsigned i = size; i-- > 0;)
        number = number << 8 | from[i];
    return number;
}

static uint64_t sparse_index(const struct gltf_sparse *sparse, size_t at)
{
    unsigned size = kinds[sparse->index_kind].size;
    return read_count(sparse->indices + at * size, size);
}

/* The indices rise, so that an element is found by halves. */
static bool check_sparse(struct gltf_source *source, const struct gltf_accessor *accessor)
{
    const struct gltf_sparse *sparse = &accessor->sparse;
    for (size_t i = 0; i < sparse->count; ++i) {
        uint64_t index = sparse_index(sparse, i);
        if (index >= accessor->count || (i && index <= sparse_index(sparse, i - 1)))
            return gltf_source_fail(
                source,
                "accessors[%zu].sparse.indices has %llu as number %zu; expected "
                "rising indices below %zu",
                accessor->index, (unsigned long long)index, i, accessor->count);
    }
    return true;
}

static bool open_sparse(struct gltf_source *source, const json_t *sparse, struct gltf_accessor *out)
{
    const json_t *indices = json_object_get(sparse, "indices"),
                 *values = json_object_get(sparse, "values");
    size_t count = json_count_of(sparse, "count"), stride,
           size = out->width * kinds[out->kind].size;
    char path[64];
    unsigned kind = find_kind(indices);
    if (kind == NUM_KINDS || kinds[kind].is_signed)
        return gltf_source_fail(source,
                                "accessors[%zu].sparse.indices.componentType is none of 5121, 5123 "
                                "and 5125",
                                out->index);
    if (!count || count > out->count)
        return gltf_source_fail(source,
                                "accessors[%zu].sparse.count is %zu; expected 1 to %zu, the count "
                                "of the accessor",
                                out->index, count, out->count);
    snprintf(path, sizeof path, "accessors[%zu].sparse", out->index);
    out->sparse = (struct gltf_sparse){.count = count, .index_kind = kind};
    out->sparse.indices = find_elements(source, indices, path, count, kinds[kind].size, &stride);
    out->sparse.values =
        out->sparse.indices ? find_elements(source, values, path, count, size, &stride) : NULL;
    return out->sparse.values && gltf_source_spend(source, count) && check_sparse(source, out);
}

static bool read_types(struct gltf_source *source, const json_t *json, unsigned least,
                       unsigned most, struct gltf_accessor *out)
{
    const char *type = json_text_of(json, "type");
    for (size_t i = 0; i < NUM_SHAPES; ++i)
        if (strcmp(type, shapes[i].name) == 0)
            out->width = shapes[i].width;
    if (out->width < least || out->width > most)
        return gltf_source_fail(source, "accessors[%zu].type is '%.20s'; expected %s%s%s",
                                out->index, type, name_of(least), most > least ? " to " : "",
                                most > least ? name_of(most) : "");
    out->kind = find_kind(json);
    if (out->kind == NUM_KINDS)
        return gltf_source_fail(source,
                                "accessors[%zu].componentType is %llu; expected 5120 to 5123, 5125 "
                                "or 5126",
                                out->index,
                                (unsigned long long)json_count_of(json, "componentType"));
    out->is_normalized =
        !kinds[out->kind].is_float && json_is_true(json_object_get(json, "normalized"));
    return true;
}

bool gltf_accessor_open(struct gltf_source *source, size_t index, unsigned least, unsigned most,
                        struct gltf_accessor *out)
{
    const json_t *json = gltf_source_item(source, "accessors", index),
                 *sparse = json_object_get(json, "sparse");
    char path[64];
    *out = (struct gltf_accessor){.index = index, .count = json_count_of(json, "count")};
    if (!json)
        return gltf_source_fail(source, "there are no accessors[%zu]; the file has %zu", index,
                                json_array_size(json_object_get(source->root, "accessors")));
    if (!out->count)
        return gltf_source_fail(source, "accessors[%zu] has no elements", index);
    if (!read_types(source, json, least, most, out))
        return false;
    snprintf(path, sizeof path, "accessors[%zu]", index);
    if (json_object_get(json, "bufferView")) {
        out->data = find_elements(source, json, path, out->count,
                                  out->width * kinds[out->kind].size, &out->stride);
        if (!out->data)
            return false;
    } else if (out->count > MAX_ZEROS) {
        return gltf_source_fail(source,
                                "accessors[%zu] has %zu elements, and no bufferView; the limit is "
                                "%d",
                                index, out->count, MAX_ZEROS);
    }
    return !sparse || open_sparse(source, sparse, out);
}

/* ---- Reading ---- */

static double read_number(const uint8_t *from, const struct kind *kind, bool is_normalized)
{
    uint64_t bits = read_count(from, kind->size);
    double number = (double)bits;
    if (kind->is_float) {
        const uint32_t word = (uint32_t)bits;
        float value;
        memcpy(&value, &word, sizeof value);
        return (double)value;
    }
    if (kind->is_signed && bits >> (8 * kind->size - 1))
        number -= (double)((uint64_t)1 << (8 * kind->size));
    return is_normalized ? fmax(number / kind->most, -1) : number;
}

/* The bytes of an element in the list of sparse ones; NULL: it is not there. */
static const uint8_t *find_sparse(const struct gltf_accessor *accessor, size_t at)
{
    const struct gltf_sparse *sparse = &accessor->sparse;
    size_t low = 0, high = sparse->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (sparse_index(sparse, middle) < at)
            low = middle + 1;
        else
            high = middle;
    }
    return low < sparse->count && sparse_index(sparse, low) == at
               ? sparse->values + low * accessor->width * kinds[accessor->kind].size
               : NULL;
}

void gltf_accessor_read(const struct gltf_accessor *accessor, size_t at, double out[GLTF_MAX_WIDTH])
{
    const struct kind *kind = &kinds[accessor->kind];
    const uint8_t *from = find_sparse(accessor, at);
    if (!from && accessor->data)
        from = accessor->data + at * accessor->stride;
    for (unsigned i = 0; i < accessor->width; ++i)
        out[i] = from ? read_number(from + i * kind->size, kind, accessor->is_normalized) : 0;
}

bool gltf_accessor_floats(struct gltf_source *source, const struct gltf_accessor *accessor,
                          size_t at, float *out)
{
    double numbers[GLTF_MAX_WIDTH];
    gltf_accessor_read(accessor, at, numbers);
    for (unsigned i = 0; i < accessor->width; ++i) {
        if (!isfinite(numbers[i]))
            return gltf_source_fail(source,
                                    "element %zu of accessors[%zu] has numbers that are NaN or "
                                    "infinite",
                                    at, accessor->index);
        out[i] = (float)numbers[i];
    }
    return true;
}

bool gltf_accessor_has_counts(const struct gltf_accessor *accessor)
{
    return !kinds[accessor->kind].is_signed && !accessor->is_normalized;
}
