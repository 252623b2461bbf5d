// SPDX-License-Identifier: Apache-2.0
/*
 * The role of a shader: what it is for. A role is a row of constant traits (spell/roles.def).
 * Everything that follows from what a shader is for follows from a trait of its role.
 */
#ifndef MXG_SHADER_ROLE_H
#define MXG_SHADER_ROLE_H

#include "shader/capabilities.h"

#include <stdbool.h>
#include <stdint.h>

/* The stages of the GPU's pipeline that the shader is. */
enum role_stages {
    STAGES_OF_PROGRAM, /* a vertex and a pixel stage, if the target has both */
    STAGES_OF_PASS, /* the same; several programs draw a surface, so positions agree to the bit */
    STAGES_NONE,    /* a function: other code calls it and gives it the vertex data */
};

/* Who has the lights that a bound light shader describes. */
enum role_lights {
    LIGHTS_IN_SHADER, /* a loop over u_lightData */
    LIGHTS_OF_HOST,   /* a loop over functions of the host */
    LIGHTS_ELSEWHERE, /* nothing in the shader reads a light */
};

/* How a value changes from a point to the points beside it. */
enum role_derivatives {
    DERIVATIVES_OF_SCREEN, /* dFdx and its like */
    DERIVATIVES_OF_RAYS,   /* the caller gives them with the vertex data, as it gives the view */
    DERIVATIVES_NONE,      /* 0, and textures are read at their first level */
};

/* The result of the shader. */
enum role_returns {
    RETURNS_LIGHT,    /* a colour and an alpha, lit */
    RETURNS_PATH,     /* emission, the response to a direction, and a sampled direction */
    RETURNS_SLABS,    /* packed slabs of a pixel; light where a surface cannot be stored */
    RETURNS_WORDS,    /* the same as numbers, without a pixel stage around it */
    RETURNS_PAYLOAD,  /* one slab, packed for a ray */
    RETURNS_HOLES,    /* the holes that an opacity cuts */
    RETURNS_CLOSURES, /* closures of the language, which its renderer evaluates */
};

/* Where the surfaces come from. */
enum role_reads { READS_DOCUMENT, READS_PIXELS, READS_PAYLOADS };

/* Where <ambientocclusion> comes from. */
enum role_occlusion {
    OCCLUSION_OF_OPTION, /* the option `ambient-occlusion` says it */
    OCCLUSION_TRACED,    /* the caller traces it */
    OCCLUSION_OF_PRIMVAR,
};

/* Parts of the way to a picture that a role may leave to others. Options say which part they set.
 */
enum role_task {
    TASK_ANY,         /* of all roles */
    TASK_LIGHTS,      /* the light of bound light shaders */
    TASK_SHADOWS,     /* what hides lights */
    TASK_OCCLUSION,   /* what hides the environment */
    TASK_CAVITIES,    /* the occlusion that nodes read */
    TASK_ENVIRONMENT, /* light from the environment */
    TASK_OPACITY,     /* what an opacity does to the pixel */
    TASK_BACKGROUND,  /* what is seen through a surface */
    TASK_BODY,        /* the way of light through a body */
    TASK_OUTPUT,      /* the encoding of colours */
    TASK_BELOW,       /* blur of what lies below rough interfaces */
    TASK_STORAGE,     /* the form of stored slabs */
    TASK_DIFFUSION,   /* light that spreads over the picture */
    TASK_DECALS,      /* what decals change of a surface that is stored */
    NUM_TASKS
};

struct target_frame; /* spell/target.h */

struct role {
    const char *name; /* a word of the option `role`, or a name that no option has */
    uint64_t caps;    /* enum target_caps that it asks a target for */
    enum role_stages stages;
    enum role_lights lights;
    enum role_derivatives derivatives;
    enum role_returns returns;
    enum role_reads reads;
    bool is_on_path; /* the caller traces paths, which come from inside bodies, too */
    enum role_occlusion occlusion;
    /* it stands in a file of the host, which has declarations of its own */
    bool is_in_host_file;
    /* the text around the statements of the pixel stage; NULL: that of the target */
    const struct target_frame *frame;
    const char *entry; /* the function of the pixel stage, before the host renames it */
    /* who does a task instead, as the reason of a message; NULL: the shader does it */
    const char *lacks[NUM_TASKS];
};

/* True if it packs slabs: each has a mark (ND_slab_mark) whose inputs are the packed values. */
static inline bool role_stores(const struct role *role)
{
    return role->returns == RETURNS_SLABS || role->returns == RETURNS_WORDS
           || role->returns == RETURNS_PAYLOAD;
}

/* True if it packs all slabs of a pixel, which has room for whole surfaces only. */
static inline bool role_packs_pixel(const struct role *role)
{
    return role->returns == RETURNS_SLABS || role->returns == RETURNS_WORDS;
}

/* True if it packs surfaces that rays hit, or lights them. */
static inline bool role_is_of_rays(const struct role *role)
{
    return role->returns == RETURNS_PAYLOAD || role->reads == READS_PAYLOADS;
}

/* True for a pass over what others stored: a compute stage in the place of the pixel stage. */
static inline bool role_is_pass(const struct role *role)
{
    return role->reads != READS_DOCUMENT;
}

#endif
