// SPDX-License-Identifier: Apache-2.0
#include "lsp/references.h"

uint32_t references_target(const struct lsp_query *query, struct span *out_name)
{
    struct place place = query_place(query);
    if (place.part != PLACE_VALUE)
        return MODEL_NONE;
    *out_name = place.attribute->value;
    uint32_t target = names_target(query, place.element, place.attribute);
    bool is_own_name = query_equals(query->text, place.attribute->name, "name");
    return target == MODEL_NONE && is_own_name ? place.element : target;
}

void references_each(const struct lsp_query *query, uint32_t target,
                     void (*take)(void *user_data, uint32_t element,
                                  const struct model_attribute *attribute),
                     void *user_data)
{
    const struct model *model = query->model;
    struct span name = query_value(query, target, "name");
    for (uint32_t i = 0; i < model->num_elements && name.start < name.end; ++i) {
        const struct model_element *element = &model->elements[i];
        for (uint32_t a = 0; a < element->num_attributes; ++a) {
            const struct model_attribute *attribute =
                &model->attributes[element->first_attribute + a];
            if (i != target && query_is_same(query->text, attribute->value, name)
                && names_target(query, i, attribute) == target)
                take(user_data, i, attribute);
        }
    }
}
