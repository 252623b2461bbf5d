// SPDX-License-Identifier: Apache-2.0
/* Targets and roles, found by name, and what a target lacks. */
#include "spell/spell.h"

#include <string.h>

const struct role roles[NUM_ROLES] = {
#define ROLE(id, ...) [ROLE_##id] = {.name = #id, __VA_ARGS__},
#include "spell/roles.def"
#undef ROLE
};

const struct role *role_find(const char *name)
{
    for (int i = 0; i < NUM_ROLES; i++)
        if (strcmp(roles[i].name, name) == 0)
            return &roles[i];
    return NULL;
}

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

uint64_t target_capabilities(const struct target *target)
{
    return target->caps
           | (target->closures ? CAP_CLOSURES : CAP_LIGHTING | CAP_PICKS | CAP_DERIVATIVES)
           | (target->network ? CAP_NETWORKS : 0u) | (target->modules ? CAP_MODULES : 0u);
}

uint64_t target_lacks(const struct target *target, const char *version, uint64_t wanted)
{
    uint64_t lacks = wanted & ~target_capabilities(target);
    bool is_early =
        version && *version && target->since.caps && strcmp(version, target->since.version) < 0;
    return is_early ? lacks | (wanted & target->since.caps) : lacks;
}
