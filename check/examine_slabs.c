// SPDX-License-Identifier: Apache-2.0
/* The slabs of an element, and the steps of their budget, as `mxgen inspect --slabs` has them. */
#include "check/examine.h"
#include "program/json_values.h"

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

/* A view of the slabs; "": there is none. It lasts as long as the result, which the caller ends. */
static const char *inspect(struct examiner *examiner, const mxg_document *document,
                           const struct check_element *element, mxg_view view,
                           const mxg_options *options, mxg_result **out_result)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = element->shaders[0].target;
    desc.element = element->path;
    desc.options = options;
    mxg_inspect(examiner->cli->context, document, view, &desc, out_result);
    const char *text = mxg_result_text(*out_result, NULL);
    return text ? text : "";
}

/* The slabs as data, which the caller drops. NULL: there are none. */
static json_t *read_sheet(struct examiner *examiner, const mxg_document *document,
                          const struct check_element *element, const mxg_options *options)
{
    mxg_result *result = NULL;
    json_t *sheet = json_loads(
        inspect(examiner, document, element, MXG_VIEW_SLABS_JSON, options, &result), 0, NULL);
    mxg_result_destroy(result);
    return sheet;
}

static bool has_trees(const json_t *sheet)
{
    return json_array_size(json_object_get(sheet, "trees")) != 0;
}

/* True for slabs of the document's own. Without steps there are no estimates, which read textures.
 */
static bool has_own_slabs(struct examiner *examiner, const mxg_document *document,
                          const struct check_element *element)
{
    mxg_options *options = NULL;
    json_t *sheet = NULL;
    if (mxg_options_create(examiner->cli->context, &options) == MXG_OK
        && mxg_options_set(options, "max-steps", "0") == MXG_OK)
        sheet = read_sheet(examiner, document, element, options);
    bool has = has_trees(sheet) && !json_is_true(json_object_get(sheet, "recognised"));
    json_decref(sheet);
    mxg_options_destroy(options);
    return has;
}

/* Those of the budget. True if there are slabs. */
static bool read_steps(struct examiner *examiner, const mxg_document *document,
                       struct check_element *element)
{
    json_t *sheet = read_sheet(examiner, document, element, examiner->cli->options);
    const json_t *steps = json_object_get(sheet, "steps");
    bool has = has_trees(sheet);
    element->num_steps = json_array_size(steps);
    element->steps = store_array(&examiner->store, element->num_steps, sizeof *element->steps);
    for (size_t i = 0; i < element->num_steps; ++i)
        read_step(&examiner->store, json_array_get(steps, i), &element->steps[i]);
    json_decref(sheet);
    return has;
}

static void add_tree(struct examiner *examiner, const mxg_document *document,
                     struct check_element *element)
{
    mxg_result *result = NULL;
    const char *text =
        inspect(examiner, document, element, MXG_VIEW_SLABS, examiner->cli->options, &result);
    element->slabs = store_text(&examiner->store, text, strlen(text));
    mxg_result_destroy(result);
}

void examine_slabs(struct examiner *examiner, const mxg_document *document,
                   struct check_element *element)
{
    bool has = cli_has_budget(examiner->cli) ? read_steps(examiner, document, element)
                                             : has_own_slabs(examiner, document, element);
    if (has)
        add_tree(examiner, document, element);
}
