// SPDX-License-Identifier: Apache-2.0
#include "lsp/references.h"

/* The item of a value under the cursor, or all of it. */
static struct span item_at(const struct lsp_query *query, const struct model_attribute *attribute)
{
    const struct span value = attribute->value;
    for (struct span item = {value.start, value.start}; names_next_item(query, attribute, &item);)
        if (query->offset >= item.start && query->offset <= item.end)
            return item;
    return value;
}

uint32_t references_target(const struct lsp_query *query, struct span *out_name)
{
    struct place place = query_place(query);
    if (place.part != PLACE_VALUE)
        return MODEL_NONE;
    *out_name = item_at(query, place.attribute);
    uint32_t target = names_target_of(query, place.element, place.attribute, *out_name);
    bool is_own_name = query_equals(query->text, place.attribute->name, "name");
    return target == MODEL_NONE && is_own_name ? place.element : target;
}

void references_each(const struct lsp_query *query, uint32_t target,
                     void (*take)(void *user_data, uint32_t element,
                                  const struct model_attribute *attribute, struct span name),
                     void *user_data)
{
    const struct model *model = query->model;
    struct span name = query_value(query, target, "name");
    for (uint32_t i = 0; i < model->num_elements && name.start < name.end; ++i) {
        const struct model_element *element = &model->elements[i];
        for (uint32_t a = 0; a < element->num_attributes; ++a) {
            const struct model_attribute *attribute =
                &model->attributes[element->first_attribute + a];
            struct span item = {attribute->value.start, attribute->value.start};
            while (i != target && names_next_item(query, attribute, &item))
                if (query_is_same(query->text, item, name)
                    && names_target_of(query, i, attribute, item) == target)
                    take(user_data, i, attribute, item);
        }
    }
}
