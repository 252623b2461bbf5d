// SPDX-License-Identifier: Apache-2.0
/* The attributes that a shader reads and objects lack. */
#include "render/bind_shader.h"

#include <stdio.h>
#include <string.h>

void bind_note_lack(struct bind *bind, uint32_t object, const mxg_variable *variable)
{
    static const char family[] = "geomprop";
    size_t len = sizeof family - 1;
    bool is_property = strncmp(variable->semantic, family, len) == 0;
    if (bind->num_lacking++)
        return;
    bind->lacking = bind->objects[object].path;
    bind->lacking_slot = variable->slot;
    if (is_property)
        snprintf(bind->lacked, sizeof bind->lacked, "%s", variable->semantic + len + 1);
    else
        scene_primvar_name(variable->name, bind->lacked);
}

bool bind_note_type(struct bind *bind, uint32_t object, const char *attribute, uint32_t num_read)
{
    const struct scene_object *from = &bind->objects[object];
    const struct primvar *primvar = scene_primvar(from, attribute);
    bool is_color = strncmp(attribute, "i_color_", 8) == 0 && num_read >= 3;
    if (!primvar)
        return false;
    if (primvar->components == num_read || (is_color && primvar->components >= 3)
        || bind->num_mistyped == BIND_MAX_MISTYPED)
        return true;
    bind->mistyped[bind->num_mistyped++] = (struct bind_mistyped){primvar, from->path, num_read};
    return true;
}
