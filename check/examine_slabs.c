// SPDX-License-Identifier: Apache-2.0
/* The slabs of an element, and the steps of their budget, as `mxgen inspect --slabs` has them. */
#include "check/examine.h"
#include "check/json.h"
#include "check/picture.h"

#include <stdio.h>
#include <string.h>

static uint32_t count_of(const json_t *step, const char *when, const char *what)
{
    return (uint32_t)json_integer_value(json_object_get(json_object_get(step, when), what));
}

static void read_step(struct store *store, const json_t *from, struct check_step *out)
{
    const json_t *error = json_object_get(from, "estimatedError");
    const char *text = json_text_of(from, "step");
    char number[32] = "";
    if (json_is_number(error) && json_number_value(error) >= 0)
        snprintf(number, sizeof number, "%.2f", json_number_value(error));
    *out = (struct check_step){.text = store_text(store, text, strlen(text)),
                               .closures_before = count_of(from, "before", "closures"),
                               .closures_after = count_of(from, "after", "closures"),
                               .bytes_before = count_of(from, "before", "bytes"),
                               .bytes_after = count_of(from, "after", "bytes"),
                               .estimated = store_text(store, number, strlen(number)),
                               .drawn = ""};
}

static mxg_result *view(struct examiner *examiner, const mxg_document *document,
                        const struct check_element *element, mxg_view view)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_result *result = NULL;
    desc.target = element->shaders[0].target;
    desc.element = element->path;
    desc.options = examiner->cli->options;
    mxg_inspect(examiner->cli->context, document, view, &desc, &result);
    return result;
}

static json_t *read_sheet(struct examiner *examiner, const mxg_document *document,
                          const struct check_element *element)
{
    size_t size = 0;
    mxg_result *result = view(examiner, document, element, MXG_VIEW_SLABS_JSON);
    const char *text = result ? mxg_result_text(result, &size) : NULL;
    json_t *sheet = text ? json_loadb(text, size, 0, NULL) : NULL;
    mxg_result_destroy(result);
    return sheet;
}

void examine_slabs(struct examiner *examiner, const mxg_document *document,
                   struct check_element *element)
{
    size_t size = 0;
    json_t *sheet = read_sheet(examiner, document, element);
    bool has =
        json_array_size(json_object_get(sheet, "trees"))
        && (cli_has_budget(examiner->cli) || !json_is_true(json_object_get(sheet, "recognised")));
    mxg_result *result = has ? view(examiner, document, element, MXG_VIEW_SLABS_SVG) : NULL;
    const char *svg = result ? mxg_result_text(result, &size) : NULL;
    if (svg)
        element->slabs = picture_base64(&examiner->store, svg, size);
    mxg_result_destroy(result);
    json_decref(sheet);
}

void examine_steps(struct examiner *examiner, const mxg_document *document,
                   struct check_element *element)
{
    json_t *sheet = read_sheet(examiner, document, element);
    const json_t *steps = json_object_get(sheet, "steps");
    element->num_steps = json_array_size(steps);
    element->steps = store_array(&examiner->store, element->num_steps, sizeof *element->steps);
    for (size_t i = 0; i < element->num_steps; ++i)
        read_step(&examiner->store, json_array_get(steps, i), &element->steps[i]);
    json_decref(sheet);
}
