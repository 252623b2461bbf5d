// SPDX-License-Identifier: Apache-2.0
/* The images and buffers of a stage's programs (deferred/deferred.h). */
#include "spell/spell.h"

bool spell_resource_from(const struct spell *spell, uint32_t binding, struct spell_resource *out)
{
    for (; binding < NUM_RESOURCES; binding++)
        for (uint32_t i = 0; i < spell->programs.len; i++) {
            const struct source_resources *of = spell->programs.items[i].resources;
            unsigned access = (of->reads >> binding & 1) * SPELL_READS
                              | (of->writes >> binding & 1) * SPELL_WRITES;
            *out = (struct spell_resource){.resource =
                                               deferred_resource((enum deferred_binding)binding),
                                           .binding = binding,
                                           .set = of->set,
                                           .access = access};
            if (access)
                return true;
        }
    return false;
}

const struct target_image *spell_image(const struct spell *spell, const struct spell_resource *r)
{
    const struct target *target = spell->target;
    while (!target->images && target->base)
        target = target->base;
    const struct target_image *image = target->images;
    while (strcmp(image->kind, r->resource->kind) != 0
           || strcmp(image->format, r->resource->format) != 0 || image->access != r->access)
        image++;
    return image;
}

ir_type_id spell_member_type(const struct deferred_member *member)
{
    ir_type_id type = 0;
    while (strcmp(ir_type_text(type), member->type) != 0)
        type++;
    return type;
}

bool spell_reads_position(const struct spell *spell)
{
    str_id name = str_find(spell->shader->strings, "gl_FragCoord", strlen("gl_FragCoord"));
    for (uint32_t i = 0; i < spell->programs.len; i++) {
        const struct spell_program *program = &spell->programs.items[i];
        for (uint32_t k = 0; k < program->reach.globals.len; k++)
            if (lang_global(program->unit, program->reach.globals.items[k], NULL)->name == name)
                return true;
    }
    return false;
}

bool spell_tests_early(const struct spell *spell)
{
    return spell->programs.len && spell->stage_id == STAGE_PIXEL
           && spell->shader->role->returns == RETURNS_SLABS;
}
