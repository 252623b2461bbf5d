// SPDX-License-Identifier: Apache-2.0
/*
 * Shader groups of a network: the layers for one result of the network, then a shader that takes
 * the result.
 */
#ifndef MXG_GENERATORS_OSL_GROUPS_H
#define MXG_GENERATORS_OSL_GROUPS_H

#include "spell/target.h"

enum { OSL_MAX_ENDS = 2 }; /* results that one group can take */

/* A kind of group, and its last shader. */
struct osl_end {
    enum shader_stage_id stage;
    const char *use;  /* "surface" */
    const char *name; /* name of the shader; NULL: the group ends with the layer of the result */
    const char *source;
    struct {
        enum network_result result;
        const char *parameter; /* NULL: end of the list */
    } inputs[OSL_MAX_ENDS];
};

struct osl_group {
    const struct osl_end *end;
    bool is_whole;      /* the last layer is the shader of the result: there is no other end */
    const bool *needed; /* per layer: the group contains it */
};

struct osl_program { /* network->program */
    struct osl_group groups[OSL_MAX_ENDS];
    unsigned num_groups;
};

static inline const struct osl_program *osl_program_of(const struct network *network)
{
    return (const struct osl_program *)network->program;
}

/* True if a shader of its own takes the result of the group. */
static inline bool osl_has_end(const struct osl_group *group)
{
    return group->end->name && !group->is_whole;
}

/* groups.c */
/* AOVs belong to the group of the surface: the number of those of a group with this end. */
uint32_t osl_num_aovs(const struct network *network, const struct osl_end *end);
void osl_plan_network(struct network *network);
void osl_add_network_parts(struct network *network);
uint64_t osl_network_topology(const struct network *network);

/* group_json.c */
void osl_reflect_network(const struct network *network, struct reflect *r);

#endif
