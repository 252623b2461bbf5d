// SPDX-License-Identifier: Apache-2.0
/* Reflections describe the storage of the deferred pipeline here. */
#include "api/generation.h"
#include "base/json.h"

#include <string.h>

static uint32_t classes_of(const mxg_result *result)
{
    if (!role_is_pass(result->shader.role))
        return result->shader.reflection.stored_classes;
    enum deferred_class lit = deferred_pass_class(result->pass);
    return lit == CLASS_EMPTY || !deferred_is_indirect(result->pass) ? 0 : 1u << lit;
}

mxg_status mxg_result_storage(const mxg_result *result, mxg_storage *out)
{
    if (!result || !result->has_shader)
        return MXG_ERROR_ARGUMENT;
    uint32_t words = result->shader.reflection.stored_words;
    mxg_storage full = {.words = words,
                        .layout = role_is_pass(result->shader.role) || words
                                      ? deferred_layout_number(&result->storage)
                                      : 0,
                        .classes = classes_of(result)};
    return struct_write(out, &full, sizeof full);
}

uint32_t mxg_catalogue_num_pass_resources(void)
{
    return NUM_RESOURCES;
}

mxg_status mxg_catalogue_pass_resource(uint32_t index, mxg_pass_resource *out)
{
    if (index >= NUM_RESOURCES)
        return MXG_ERROR_ARGUMENT;
    const struct deferred_resource *r = deferred_resource((enum deferred_binding)index);
    mxg_pass_resource full = {.name = r->name,
                              .kind = r->kind,
                              .format = r->format,
                              .doc = r->doc,
                              .num_layers = r->layers,
                              .byte_size = r->size,
                              .num_members = r->num_members};
    return struct_write(out, &full, sizeof full);
}

mxg_status mxg_catalogue_pass_member(uint32_t resource, uint32_t index, mxg_pass_member *out)
{
    if (resource >= NUM_RESOURCES
        || index >= deferred_resource((enum deferred_binding)resource)->num_members)
        return MXG_ERROR_ARGUMENT;
    const struct deferred_member *m =
        &deferred_resource((enum deferred_binding)resource)->members[index];
    mxg_pass_member full = {.name = m->name,
                            .type = m->type,
                            .values = m->values ? m->values : "",
                            .doc = m->doc,
                            .offset = m->offset,
                            .array_length = m->array_length,
                            .array_stride = m->array_stride,
                            .matrix_stride = m->matrix_stride,
                            .per = m->per ? m->per : "",
                            .is_nested = m->is_nested};
    return struct_write(out, &full, sizeof full);
}

mxg_status mxg_result_pass(const mxg_result *result, mxg_pass *out)
{
    if (!result || !result->has_shader || !role_is_pass(result->shader.role))
        return MXG_ERROR_ARGUMENT;
    mxg_pass full = {.name = deferred_pass_name(result->pass),
                     .group_size = {DEFERRED_TILE, DEFERRED_TILE, 1},
                     .is_indirect = deferred_is_indirect(result->pass),
                     .reads = deferred_reads(result->pass, &result->storage),
                     .writes = deferred_writes(result->pass, &result->storage)};
    if (deferred_is_part(result->pass))
        memset(full.group_size, 0, sizeof full.group_size);
    if (full.is_indirect)
        full.dispatch_offset = deferred_dispatch_offset(result->pass);
    return struct_write(out, &full, sizeof full);
}

/* ---- Reflection ---- */

static void put_member(const struct deferred_member *m, struct json *json)
{
    json_put_text(json, "name", m->name);
    json_put_text(json, "type", m->type);
    json_put_number(json, "offset", m->offset);
    json_put_nonzero(json, "arrayLength", m->array_length);
    json_put_nonzero(json, "arrayStride", m->array_stride);
    json_put_text(json, "per", m->per);
    json_put_nonzero(json, "matrixStride", m->matrix_stride);
    json_put_text(json, "values", m->values);
    json_put_text(json, "doc", m->doc);
}

/* Members from `first` on: of the buffer, or of a struct. Returns the first that is not among them.
 */
static uint32_t put_members(const struct deferred_resource *r, uint32_t first, struct json *json)
{
    uint32_t i = first;
    bool is_nested = r->members[first].is_nested;
    json_key(json, "members");
    json_open(json, '[');
    while (i < r->num_members && r->members[i].is_nested == is_nested) {
        json_item(json);
        json_open_flat(json, '{');
        put_member(&r->members[i++], json);
        if (!is_nested && i < r->num_members && r->members[i].is_nested)
            i = put_members(r, i, json);
        json_close(json, '}');
    }
    json_close(json, ']');
    return i;
}

/* Describes a resource; the description is equal for all who use it. */
static void put_storage(const struct deferred_layout *layout, enum deferred_binding binding,
                        struct json *json)
{
    const struct deferred_resource *r = deferred_resource(binding);
    json_put_text(json, "name", r->name);
    json_put_text(json, "kind", r->kind);
    bool is_any = strcmp(r->format, DEFERRED_ANY_FORMAT) == 0;
    json_put_text(json, "format", is_any && layout->any_format ? layout->any_format : r->format);
    if (layout->sets)
        json_put_number(json, "set", layout->set);
    if (layout->has_bindings)
        json_put_number(json, "binding", layout->first + binding);
    json_put_nonzero(json, "layers", r->layers);
    json_put_nonzero(json, "size", r->size);
}

static void put_resource(const struct deferred_layout *layout, enum deferred_binding binding,
                         bool reads, bool writes, struct json *json)
{
    const struct deferred_resource *r = deferred_resource(binding);
    json_item(json);
    json_open(json, '{');
    put_storage(layout, binding, json);
    json_put_text(json, "access", !writes ? "read" : !reads ? "write" : "read-write");
    json_put_text(json, "doc", r->doc);
    if (r->num_members)
        put_members(r, 0, json);
    json_close(json, '}');
}

static const char *name_of(const mxg_result *result)
{
    if (role_is_pass(result->shader.role))
        return deferred_pass_name(result->pass);
    const struct role *role = result->shader.role;
    return role->returns == RETURNS_SLABS ? "material" : role->name;
}

/* The classes of a material by name. */
static void put_classes(uint32_t classes, struct json *json)
{
    json_key(json, "classes");
    json_open_flat(json, '[');
    for (unsigned i = 0; i < NUM_CLASSES; i++)
        if (classes >> i & 1u) {
            const char *name = deferred_element((enum deferred_class)i);
            json_item(json);
            text_json_string(json->out, name, strlen(name));
        }
    json_close(json, ']');
}

/* Lists the resources that a pass reads and writes. A material writes its further words, if it has
 * any. */
static void put_resources(const mxg_result *result, struct json *json)
{
    const struct deferred_layout *layout = &result->storage;
    const struct source_resources material =
        deferred_of_material(layout, result->shader.reflection.stored_words);
    uint32_t reads = role_is_pass(result->shader.role) ? deferred_reads(result->pass, layout)
                                                       : material.reads,
             writes = role_is_pass(result->shader.role) ? deferred_writes(result->pass, layout)
                                                        : material.writes;
    json_key(json, "resources");
    json_open(json, '[');
    for (uint32_t i = 0; i < NUM_RESOURCES; i++)
        if ((reads | writes) >> i & 1)
            put_resource(layout, (enum deferred_binding)i, reads >> i & 1, writes >> i & 1, json);
    json_close(json, ']');
}

/* The resources that are targets, by location: of a material, or of the host's stage of a decal. */
static void put_targets(bool is_decal, struct json *json)
{
    enum { NUM = 4 };
    static const enum deferred_binding sets[2][NUM] = {
        {RESOURCE_COLOR, RESOURCE_WORD0, RESOURCE_WORD1, RESOURCE_WORD2},
        {RESOURCE_DECAL_ALBEDO, RESOURCE_DECAL_F0, RESOURCE_DECAL_NORMAL,
         RESOURCE_DECAL_ROUGHNESS}};
    json_key(json, "targets");
    json_open(json, '[');
    for (uint32_t i = 0; i < NUM; i++) {
        const struct deferred_resource *r = deferred_resource(sets[is_decal][i]);
        json_item(json);
        json_open_flat(json, '{');
        json_put_text(json, "name", r->name);
        json_put_text(json, "format", r->format);
        json_put_number(json, "location", i);
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void put_pass(enum deferred_pass pass, struct json *json)
{
    if (deferred_is_part(pass))
        return;
    json_key(json, "groupSize");
    text_fmt(json->out, "[%u, %u, 1]", (unsigned)DEFERRED_TILE, (unsigned)DEFERRED_TILE);
    if (!deferred_is_indirect(pass))
        return;
    json_put_text(json, "class", deferred_element(deferred_pass_class(pass)));
    json_put_number(json, "dispatchOffset", deferred_dispatch_offset(pass));
}

/* A decal for images stores no words, and reads nothing. */
static void put_decal(struct json *json)
{
    json_key(json, "deferred");
    json_open(json, '{');
    json_put_text(json, "pass", "decal");
    put_targets(true, json);
    json_close(json, '}');
}

void result_storage(void *user_data, struct json *json)
{
    const mxg_result *result = user_data;
    uint32_t words = result->shader.reflection.stored_words;
    if (!role_is_pass(result->shader.role) && deferred_is_decal(&result->storage))
        put_decal(json);
    if (!role_is_pass(result->shader.role) && !words)
        return;
    json_key(json, "deferred");
    json_open(json, '{');
    json_put_text(json, "pass", name_of(result));
    json_put_number(json, "layout", deferred_layout_number(&result->storage));
    if (role_is_pass(result->shader.role))
        put_pass(result->pass, json);
    json_put_nonzero(json, "words", words);
    if (!role_is_pass(result->shader.role) && role_packs_pixel(result->shader.role)) {
        put_classes(result->shader.reflection.stored_classes, json);
        if (result->shader.role->returns == RETURNS_SLABS)
            put_targets(false, json);
    }
    put_resources(result, json);
    json_close(json, '}');
}
