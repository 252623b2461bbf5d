// SPDX-License-Identifier: Apache-2.0
/*
 * Inputs that do nothing: the new surface is built with one input after the other as a uniform. An
 * input whose uniform the surface does not read goes, before the next one is tried, because two
 * inputs may each be idle only beside the other. One that the nodegraph of the model never reads
 * stays: it is for renderers that know more of the model, as the volume of glTF is, unless its
 * weight is 0.
 */
#include "api/translate.h"

/* The draft's node of the new surface. */
static const char *node_name(const struct translation *t)
{
    return translate_step_name(t, t->chain.len + 1);
}

static void begin(struct translation *t)
{
    translate_expect(t, mxg_edit_create(t->context, t->library, t->draft, NULL, &t->draft_edit)
                            == MXG_OK);
}

static void add_surface(struct translation *t)
{
    begin(t);
    mxg_element node =
        mxg_edit_add_element(t->draft_edit, 0, t->model, node_name(t), "surfaceshader");
    translate_expect(t, node != 0);
    for (uint32_t i = 0; i < t->inputs.len; i++) {
        const struct translated_input *input = &t->inputs.items[i];
        struct operand value =
            input->value.kind == OPERAND_CONSTANT ? input->value : value_zero(input->value.type);
        struct text text;
        if (!input->is_set || *input->port.defaultgeomprop)
            continue;
        text_init(&text, t->arena);
        value_write(&value, &text);
        translate_expect(t, mxg_edit_set_value(t->draft_edit, node, input->port.name,
                                               input->port.type, text_cstr(&text))
                                == MXG_OK);
    }
    translate_commit_draft(t);
}

static bool varies(const struct translated_input *input)
{
    return input->is_set && input->value.kind != OPERAND_CONSTANT;
}

/* The inputs that vary, and one more. */
static const char *uniforms(const struct translation *t, uint32_t more)
{
    struct text list;
    text_init(&list, t->arena);
    for (uint32_t i = 0; i < t->inputs.len; i++)
        if (varies(&t->inputs.items[i]) || i == more)
            text_fmt(&list, "%s%s/%s", list.len ? "," : "", node_name(t),
                     t->inputs.items[i].port.name);
    return text_cstr(&list);
}

static bool reads(struct translation *t, uint32_t index)
{
    return translate_surface_reads(t, t->chain.len + 1, t->inputs.items[index].port.name,
                                   uniforms(t, index));
}

/* True for 0 at an input without a default, such as a distance that is endless. */
static bool says_nothing(const struct translated_input *input)
{
    const struct operand zero = value_zero(input->value.type);
    return !*input->port.value && input->value.kind == OPERAND_CONSTANT
           && ir_value_equal(&input->value.value, &zero.value);
}

void translate_keep_for_others(struct translation *t)
{
    uint32_t from = mxg_document_find_nodedef(t->document, t->surface);
    for (uint32_t i = 0; i < t->inputs.len; i++) {
        struct translated_input *input = &t->inputs.items[i];
        const char *name = input->port.name;
        if (input->is_set || !translate_is_for_others(t, t->definition, name))
            continue;
        for (uint32_t k = 0; k < t->sources.len; k++) {
            struct source_input *source = &t->sources.items[k];
            bool fits = translate_is_authored(t, source) && strcmp(source->port.name, name) == 0
                        && strcmp(source->port.type, input->port.type) == 0
                        && (!source->is_connected || !input->port.uniform)
                        && translate_is_for_others(t, from, name);
            if (!fits)
                continue;
            input->value = (struct operand){.kind = OPERAND_LEAF, .type = source->type, .index = k};
            input->is_set = source->is_used = true;
        }
    }
}

static void drop(struct translation *t, struct translated_input *input)
{
    input->is_set = false;
    begin(t);
    mxg_element node = mxg_edit_find_element(t->draft_edit, 0, node_name(t));
    mxg_element element = mxg_edit_find_element(t->draft_edit, node, input->port.name);
    translate_expect(t, mxg_edit_remove_element(t->draft_edit, element) == MXG_OK);
    translate_commit_draft(t);
}

/* The value that the new surface has. */
static const char *value_of(struct translation *t, const char *name)
{
    const struct translated_input *input = t->inputs.items;
    while (strcmp(input->port.name, name) != 0)
        input++;
    if (!input->is_set)
        return input->port.value;
    struct text text;
    text_init(&text, t->arena);
    value_write(&input->value, &text);
    return input->value.kind == OPERAND_CONSTANT ? text_cstr(&text) : NULL;
}

static bool is_for_others(struct translation *t, const struct translated_input *input)
{
    return !says_nothing(input) && translate_is_for_others(t, t->definition, input->port.name)
           && !translate_is_off(t, t->definition, input->port.name, value_of);
}

void translate_drop_idle(struct translation *t)
{
    add_surface(t);
    for (uint32_t i = 0; i < t->inputs.len; i++) {
        struct translated_input *input = &t->inputs.items[i];
        if (input->is_set && !*input->port.defaultgeomprop && !is_for_others(t, input)
            && !reads(t, i))
            drop(t, input);
    }
}
