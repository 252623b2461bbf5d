// SPDX-License-Identifier: Apache-2.0
/* Capabilities say what a target can do. Targets have them; roles and options ask for them. */
#ifndef MXG_SHADER_CAPABILITIES_H
#define MXG_SHADER_CAPABILITIES_H

#include <stdint.h>

enum target_caps {
    /* a vertex stage computes the inputs of the pixel stage; otherwise shaders read the geometry */
    CAP_VERTEX_STAGE = 1 << 0,
    CAP_UNIFORM_BLOCKS = 1 << 1,   /* uniforms must be in blocks */
    CAP_BLOCK_OPTION = 1 << 2,     /* uniforms can be in blocks: --uniform-blocks */
    CAP_UNIFORM_DEFAULTS = 1 << 3, /* uniforms can have initial values */
    CAP_BINDINGS = 1 << 4,         /* layout(binding) and locations */
    CAP_BLOCK_STAGE_IO = 1 << 5,   /* stage inputs and outputs can be in an interface block */
    CAP_PRECISION = 1 << 6,        /* needs default precision statements */
    CAP_OVERLOADS = 1 << 7,        /* functions may be overloaded */
    CAP_BITWISE = 1 << 8,          /* unsigned integers and bit operators */
    CAP_IMPLICIT_LOD = 1 << 9,     /* texture() in pixel stages */
    CAP_STRINGS = 1 << 10,         /* the language has strings */
    /* the tiles of an image are array layers; otherwise the host or texture() selects the tile */
    CAP_TEXTURE_ARRAYS = 1 << 11,
    CAP_NAMED_WHOLES = 1 << 12, /* only variables have parts: v.x, but not (a + b).x */
    /* texture() returns the required number of channels: one, three or four */
    CAP_TYPED_TEXTURES = 1 << 13,
    /* texture() takes the default of a missing image as an argument */
    CAP_MISSING_COLORS = 1 << 14,
    /*
     * textures have samplers, which the host makes; otherwise texture() takes address modes and
     * filters, but no border colours
     */
    CAP_SAMPLERS = 1 << 15,
    /* each shader has its own scope of parameters, so names need no prefix */
    CAP_SCOPED_PARAMETERS = 1 << 16,
    /*
     * a tangent belongs to the texture coordinates of its index, by derivatives; otherwise to the
     * first ones, as in MaterialX
     */
    CAP_INDEXED_TANGENTS = 1 << 17,
    CAP_SETS = 1 << 18,              /* with CAP_BINDINGS: layout(set, binding) */
    CAP_METADATA = 1 << 19,          /* parameters have metadata */
    CAP_VULKAN_ATTRIBUTES = 1 << 20, /* can write bindings of Vulkan beside its own */
    CAP_STORES = 1 << 21,            /* pixel stages can write images; functions pack slabs */
    CAP_MEDIUMP = 1 << 22,           /* colours can be half floats: --precision */
    CAP_TWO_SOURCES = 1 << 23,       /* a pixel stage has a second source for blending */
    CAP_SAMPLER_BINDINGS = 1 << 24, /* with CAP_BINDINGS: a texture and its sampler have one each */
    CAP_HOST_FILES = 1 << 25,  /* a shader can be a function in a file that has other functions */
    CAP_OWN_NUMBERS = 1 << 26, /* with CAP_BINDINGS: blocks and textures are numbered apart */
    CAP_PASSES = 1 << 27,      /* compute stages: the passes of the deferred pipeline */
    /* not in the tables of targets, because they follow from their members */
    CAP_CLOSURES = 1 << 28, /* the language has closures: its renderer computes lights and layers */
    CAP_LIGHTING = 1 << 29, /* the shader computes lights and layers: it has no closures */
    CAP_NETWORKS = 1 << 30, /* has `network` */
};

/* No enumerators, because an int has no bits for them. */
/* the language has modules: --mdl-module. It follows from `modules` of the target, too */
#define CAP_MODULES (UINT64_C(1) << 31)
/* without CAP_BINDINGS: programs say where Vulkan binds their own images and buffers */
#define CAP_PROGRAM_BINDINGS (UINT64_C(1) << 32)
/* what computes light has these, too */
/* a number picks one layer of a stack */
#define CAP_PICKS (UINT64_C(1) << 33)
/* how a value changes from a point to the points beside it */
#define CAP_DERIVATIVES (UINT64_C(1) << 34)

#endif
