// SPDX-License-Identifier: Apache-2.0
/* The list of targets. */
#include "generators/glsl/glsl.h"
#include "generators/hlsl/hlsl.h"
#include "generators/mdl/mdl.h"
#include "generators/msl/msl.h"
#include "generators/osl/osl.h"
#include "generators/slang/slang.h"
#include "generators/wgsl/wgsl.h"

const struct target *const targets[] = {&target_glsl, &target_vulkan, &target_essl, &target_essl310,
                                        &target_hlsl, &target_slang,  &target_msl,  &target_wgsl,
                                        &target_osl,  &target_mdl,    NULL};

const struct target *target_find(const char *name)
{
    for (const struct target *const *target = targets; *target; target++)
        if (strcmp((*target)->name, name) == 0 || strcmp((*target)->materialx_name, name) == 0)
            return *target;
    return NULL;
}

bool target_is_a(const struct target *target, const char *materialx_name)
{
    for (; target; target = target->base)
        if (strcmp(target->materialx_name, materialx_name) == 0)
            return true;
    return false;
}
