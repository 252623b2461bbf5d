// SPDX-License-Identifier: Apache-2.0
/*
 * Places of variables that a compiler chose, not mxgen: Slang's. Sources and reflection share the
 * names.
 */
#include "compile/compile.h"
#include "render/bind_shader.h"

#include <stdio.h>
#include <string.h>

enum { ROW_STRIDE = 16 }; /* of a matrix in a constant buffer */

static const char lights[] = "u_lightData.";

/* The next place of the variable from *at on, which goes behind it; NULL: there is none. */
static const struct compiled_place *next_place(const struct bind *bind,
                                               const mxg_variable *variable, size_t *at)
{
    size_t prefix = variable->block == MXG_BLOCK_LIGHT_DATA ? sizeof lights - 1 : 0;
    while (*at < bind->num_places) {
        const struct compiled_place *place = &bind->places[(*at)++];
        if (strncmp(place->name, lights, prefix) == 0
            && strcmp(place->name + prefix, variable->name) == 0)
            return place;
    }
    return NULL;
}

static void put(struct bind *bind, const struct compiled_place *place, mxg_variable *variable)
{
    variable->set = place->set;
    variable->binding = variable->location = place->index;
    variable->offset = place->offset;
    variable->byte_size = place->byte_size;
    variable->matrix_stride = ROW_STRIDE;
    if (variable->block == MXG_BLOCK_LIGHT_DATA)
        bind->light_stride = place->array_stride;
}

/* Variables that hosts do not bind have no place. */
static bool is_bound(const mxg_variable *variable)
{
    return variable->block != MXG_BLOCK_VERTEX_DATA && variable->block != MXG_BLOCK_OUTPUTS;
}

bool bind_place_variables(struct bind *bind)
{
    const uint32_t num = bind->num_variables;
    for (uint32_t i = 0; i < num; ++i) {
        mxg_variable *variable = &bind->variables[i];
        size_t at = 0;
        if (!is_bound(variable))
            continue;
        const struct compiled_place *place = next_place(bind, variable, &at);
        if (!place)
            return bind_fail(bind, "the compiler tells no place of '%s'", variable->name);
        put(bind, place, variable);
        while (variable->block != MXG_BLOCK_TEXTURES
               && (place = next_place(bind, variable, &at)) != NULL) {
            bind->variables[bind->num_variables] = *variable;
            put(bind, place, &bind->variables[bind->num_variables++]);
        }
    }
    return true;
}

bool bind_place_texture(struct bind *bind, const mxg_variable *variable)
{
    struct draw *draw = &bind->draw;
    struct draw_texture texture = draw->textures[draw->num_textures - 1];
    const struct compiled_place *place;
    size_t at = 0;
    next_place(bind, variable, &at); /* the variable's own */
    while ((place = next_place(bind, variable, &at)) != NULL) {
        if (draw->num_textures == DRAW_MAX_TEXTURES)
            return bind_fail(bind, "there is no room for the sampler of '%s'", variable->name);
        texture.set = place->set;
        texture.binding = place->index;
        draw->textures[draw->num_textures++] = texture;
    }
    return true;
}
