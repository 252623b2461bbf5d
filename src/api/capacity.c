// SPDX-License-Identifier: Apache-2.0
/* Reports textures and AOVs for which a host has too little room; features that a device must have.
 */
#include "api/generation.h"

#include "shader/shader.h"

void generation_tell_lost_aovs(struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    const char *lacks = g->result->target->lacks_aovs;
    for (uint32_t i = 0; i < shader->interface.aovs.len; i++) {
        const struct shader_aov *aov = &shader->interface.aovs.items[i];
        bool is_lost = lacks || (aov->is_output && g->role->returns == RETURNS_PAYLOAD);
        elem_id place = lacks && !aov->element ? g->element : aov->element;
        if (is_lost && place)
            diag_add(diags_of(g), DIAG_ID_aov_left_out, doc_place(&g->document->layer.doc, place),
                     str_text(shader->strings, aov->name),
                     lacks ? lacks : "a payload holds one closure");
    }
}

/* "; these layers read some: 'a', 'b'": the slots of textures that the shader reads, each once. */
static const char *list_slots(struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    struct text list;
    str_id last = 0;
    text_init(&list, &g->scratch);
    for (uint32_t i = 0; i < shader->interface.used.len; i++) {
        const struct shader_variable *v = shader_interface_variable(shader, i);
        if (v->block != BLOCK_TEXTURES || !v->slot || v->slot == last)
            continue;
        last = v->slot;
        text_fmt(&list, "%s'%s'",
                 list.len ? ", " : "; these layers read some: ", str_text(shader->strings, last));
    }
    return text_cstr(&list);
}

bool generation_keeps_textures(struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    const struct target *target = g->result->target;
    uint32_t first = shader->interface.first_of_block[BLOCK_TEXTURES],
             num = shader->interface.first_of_block[BLOCK_TEXTURES + 1] - first;
    while (target && !target->max_textures)
        target = target->base;
    if (!target || num <= target->max_textures)
        return true;
    diag_add(diags_of(g), DIAG_ID_texture_limit, doc_place(&g->document->layer.doc, g->element),
             (unsigned)num, (unsigned)target->max_textures, g->result->target->name, list_slots(g));
    return false;
}

bool generation_keeps_attributes(struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    const struct shader_interface *interface = &shader->interface;
    const struct target *target = g->result->target;
    uint32_t num = 0;
    struct text why;
    for (uint32_t i = interface->first_of_block[BLOCK_APP_DATA];
         i < interface->first_of_block[BLOCK_APP_DATA + 1]; i++)
        num += ir_type_info(shader_interface_variable(shader, i)->type)->columns;
    if (!target->max_attributes || num <= target->max_attributes)
        return true;
    text_init(&why, &g->scratch);
    text_fmt(&why, "it reads %u vertex attributes, and a stage has %u at most in %s", (unsigned)num,
             (unsigned)target->max_attributes, target->name);
    const struct document *doc = &g->document->layer.doc;
    diag_add(diags_of(g), DIAG_ID_not_renderable, doc_place(doc, g->element),
             doc_name(doc, g->element), text_cstr(&why));
    return false;
}

/* A path tracer has no attachments. */
bool generation_keeps_outputs(struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    uint32_t num = shader->interface.first_of_block[BLOCK_OUTPUTS + 1]
                   - shader->interface.first_of_block[BLOCK_OUTPUTS],
             limit = (uint32_t)g->options[OPTION_max_outputs].number;
    bool has_one_attachment = shader->has_two_sources && !g->role->is_in_host_file;
    bool has_attachments = g->role->returns == RETURNS_LIGHT || g->role->returns == RETURNS_SLABS;
    struct text list;
    if (!shader->interface.aovs.len || !has_attachments || num <= (has_one_attachment ? 2 : limit))
        return true;
    text_init(&list, &g->scratch);
    uint32_t last = g->element;
    for (uint32_t i = 0; i < shader->interface.aovs.len; i++) {
        if (!shader->interface.aovs.items[i].is_output)
            continue;
        text_fmt(&list, "%s'%s'", list.len ? ", " : "",
                 str_text(shader->strings, shader->interface.aovs.items[i].name));
        last = shader->interface.aovs.items[i].element ? shader->interface.aovs.items[i].element
                                                       : last;
    }
    if (has_one_attachment) {
        diag_add(diags_of(g), DIAG_ID_options_clash, doc_place(&g->document->layer.doc, last),
                 option_key(OPTION_transparency), "dual", "aov",
                 str_text(&g->result->strings, shader->interface.aovs.items[0].name),
                 "a blend with two sources has one attachment");
        return false;
    }
    diag_add(diags_of(g), DIAG_ID_aov_limit, doc_place(&g->document->layer.doc, last),
             (unsigned)num, (unsigned)limit, text_cstr(&list));
    return false;
}

void generation_tell_features(struct generation *g, bool has_halves)
{
    const struct target *target = g->result->target;
    struct shader *shader = &g->result->shader;
    bool blends = shader->has_two_sources && shader->role->stages != STAGES_NONE;
    const char *features[] = {has_halves ? target->half_feature : NULL,
                              blends ? target->sources_feature : NULL};
    struct text list;
    text_init(&list, &g->result->object.arena);
    for (size_t i = 0; i < sizeof features / sizeof *features; ++i)
        if (features[i])
            text_fmt(&list, "%s%s", list.len ? "," : "", features[i]);
    shader->reflection.device_features = text_cstr(&list);
}
