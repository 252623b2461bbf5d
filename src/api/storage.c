// SPDX-License-Identifier: Apache-2.0
/* What reflections say about the storage of the deferred pipeline. */
#include "api/generation.h"
#include "base/json.h"

#include <string.h>

uint32_t mxg_num_pass_resources(void)
{
    struct deferred_resource resource;
    uint32_t count = 0;
    while (deferred_resource(count, &resource))
        count++;
    return count;
}

mxg_status mxg_get_pass_resource(uint32_t index, mxg_pass_resource *out)
{
    struct deferred_resource resource;
    if (!deferred_resource(index, &resource))
        return MXG_ERROR_ARGUMENT;
    mxg_pass_resource full = {.name = resource.name,
                              .kind = resource.kind,
                              .format = resource.format,
                              .doc = resource.doc};
    return struct_write(out, &full, sizeof full);
}

/* ---- Reflection ---- */

static void put_resource(const mxg_result *result, uint32_t index, struct json *json)
{
    struct deferred_resource resource;
    deferred_resource(index, &resource);
    json_item(json);
    json_open_flat(json, '{');
    json_put_text(json, "name", resource.name);
    json_put_text(json, "kind", resource.kind);
    json_put_text(json, "format", resource.format);
    if (result->storage.sets)
        json_put_number(json, "set", result->storage.set);
    json_put_number(json, "binding", index);
    json_close(json, '}');
}

static const char *name_of(const mxg_result *result)
{
    if (result->is_pass)
        return deferred_pass_name(result->pass);
    return result->storage.is_payload ? "payload" : "material";
}

/* A material writes the first one, and a payload is handed on by the host. */
static bool has_resource(const mxg_result *result, uint32_t index)
{
    return result->is_pass ? deferred_reads(result->pass, &result->storage, index)
                           : index == 0 && !result->storage.is_payload;
}

uint32_t result_classes(const mxg_result *result)
{
    if (!result->is_pass)
        return result->shader.stored_classes;
    enum deferred_class lit = deferred_pass_class(result->pass);
    return lit == CLASS_EMPTY || !deferred_is_indirect(result->pass) ? 0 : 1u << lit;
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

void result_storage(void *user_data, struct json *json)
{
    const mxg_result *result = user_data;
    uint32_t words = result->shader.stored_words;
    if (!result->is_pass && !words)
        return;
    json_key(json, "deferred");
    json_open(json, '{');
    json_put_text(json, "pass", name_of(result));
    json_put_number(json, "layout", deferred_layout_number(&result->storage));
    if (result->is_pass && deferred_is_indirect(result->pass))
        json_put_text(json, "class", deferred_element(deferred_pass_class(result->pass)));
    json_put_nonzero(json, "words", words);
    if (!result->is_pass && !result->storage.is_payload)
        put_classes(result->shader.stored_classes, json);
    json_key(json, "resources");
    json_open(json, '[');
    for (uint32_t i = 0; i < mxg_num_pass_resources(); i++)
        if (has_resource(result, i))
            put_resource(result, i, json);
    json_close(json, ']');
    json_close(json, '}');
}
