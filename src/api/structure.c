// SPDX-License-Identifier: Apache-2.0
/*
 * What a program will be, before it is generated: the structure of an element (build/structure.c),
 * for a target with options.
 */
#include "api/api.h"

#include "base/hash.h"

struct question {
    const mxg_document *document;
    mxg_generate_desc desc;
    uint64_t answer;
};

static uint64_t add_text(uint64_t hash, const char *text)
{
    return hash_long(hash, text, strlen(text));
}

/* Options count as they were set: the default, when it is set, is another number. */
static uint64_t hash_options(uint64_t hash, const struct option_value *values)
{
    for (unsigned i = 0; values && i < NUM_OPTIONS; i++) {
        if (!values[i].is_set)
            continue;
        hash = hash_mix(hash, (uint64_t)i << 32 | (uint32_t)values[i].number);
        hash = add_text(hash, values[i].text ? values[i].text : "");
        hash = hash_mix(hash, values[i].list.len);
        for (uint32_t k = 0; k < values[i].list.len; k++)
            hash = add_text(hash, values[i].list.items[k]);
    }
    return hash;
}

/* Globs choose inputs by name, and networks have values in their code. */
static bool is_covered(const struct option_value *values)
{
    return !values
           || (!values[OPTION_uniform].list.len && !values[OPTION_constant].list.len
               && !values[OPTION_network].number);
}

static void find_structure(void *arg, struct arena *scratch)
{
    struct question *question = arg;
    const struct option_value *values =
        question->desc.options ? options_values(question->desc.options) : NULL;
    const struct library *layer = &question->document->layer;
    str_id output_name;
    unsigned output;
    if (!target_find(question->desc.target) || !is_covered(values))
        return;
    struct diag_list faults; /* a generation tells them */
    diag_list_init(&faults, scratch);
    elem_id element = document_find_element(question->document, question->desc.element, &faults,
                                            &output_name, &output);
    if (!element || faults.items.len)
        return;
    struct structure_options options = {
        .interface =
            values ? (enum build_interface)values[OPTION_interface].number : INTERFACE_COMPLETE,
        .colorspace = values ? values[OPTION_colorspace].text : library_color_hub,
        .seed = hash_options(add_text(layer->base->digest, question->desc.target), values),
    };
    question->answer = build_structure(layer, &options, element, output, scratch);
}

mxg_status mxg_document_structure(mxg_context *context, const mxg_document *document,
                                  const mxg_generate_desc *desc, uint64_t *out_structure)
{
    struct question question = {.document = document};
    if (out_structure)
        *out_structure = 0;
    if (!context || !document || !out_structure || !desc
        || !struct_read(&question.desc, sizeof question.desc, desc) || !question.desc.target)
        return MXG_ERROR_ARGUMENT;
    mxg_status status = context_run(context, find_structure, &question);
    *out_structure = status == MXG_OK ? question.answer : 0;
    return status;
}
