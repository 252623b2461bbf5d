// SPDX-License-Identifier: Apache-2.0
/* The list of targets, for callers. */
#include "api/api.h"

uint32_t mxg_catalogue_num_targets(void)
{
    uint32_t count = 0;
    while (targets[count])
        count++;
    return count;
}

bool target_exists(const void *context, const char *materialx_name)
{
    const mxg_context *known = context;
    for (uint32_t i = 0; i < known->num_dialects; i++)
        if (strcmp(known->dialects[i].target.name, materialx_name) == 0)
            return true;
    for (const struct target *const *target = targets; *target; target++)
        if (strcmp((*target)->materialx_name, materialx_name) == 0)
            return true;
    return false;
}

mxg_status mxg_catalogue_target(uint32_t index, mxg_target *out)
{
    if (index >= mxg_catalogue_num_targets())
        return MXG_ERROR_ARGUMENT;
    const struct target *target = targets[index];
    mxg_target full = {
        .name = target->name,
        .materialx_name = target->materialx_name,
        .brief = target->brief,
        .stage_suffix = {target->stage_suffix[STAGE_VERTEX], target->stage_suffix[STAGE_PIXEL]},
        .pass_suffix = {target->pass_suffix[0], target->pass_suffix[1]}};
    return struct_write(out, &full, sizeof full);
}
