// SPDX-License-Identifier: Apache-2.0
#include "material/texels.h"

#include "slabs/slabs.h"

struct texels {
    struct texels *next;
    uint32_t variable;
    bool is_read;
    float values[SLABS_TEXELS * SLABS_TEXELS * 4];
};

static bool read_texels(const struct builder *b, const struct shader_variable *variable,
                        float *out_texels)
{
    const struct build_options *o = b->options;
    if (!variable->file || variable->num_tiles
        || build_texture_fault(b, variable->file, variable->element))
        return false;
    return o->read_texels(o->texels_user_data, build_file_of(b, variable->element),
                          build_text(b, variable->file), build_text(b, variable->sampling.layer),
                          SLABS_TEXELS, out_texels);
}

const float *build_texels(struct builder *b, uint32_t variable)
{
    struct texels *known = b->texels;
    if (!b->options->read_texels)
        return NULL;
    while (known && known->variable != variable)
        known = known->next;
    if (!known) {
        known = ARENA_ARRAY(b->arena, struct texels, 1);
        known->next = b->texels;
        known->variable = variable;
        known->is_read =
            read_texels(b, &b->shader->interface.variables.items[variable], known->values);
        b->texels = known;
    }
    return known->is_read ? known->values : NULL;
}
