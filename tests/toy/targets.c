// SPDX-License-Identifier: Apache-2.0
/* The list of targets with the toy: the linker takes it in place of the library's own. */
#include "generators/glsl/glsl.h"

extern const struct target target_toy;

const struct target *const targets[] = {&target_glsl, &target_toy, NULL};

const struct target *target_find(const char *name)
{
    for (const struct target *const *target = targets; *target; target++)
        if (strcmp((*target)->name, name) == 0 || strcmp((*target)->materialx_name, name) == 0)
            return *target;
    return NULL;
}

bool target_is_a(const struct target *target, const char *materialx_name)
{
    return strcmp(target->materialx_name, materialx_name) == 0;
}
