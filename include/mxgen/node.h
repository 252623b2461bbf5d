// SPDX-License-Identifier: Apache-2.0
/*
 * Nodes in C: a host or a plug-in implements a definition by a function that builds the values of
 * its outputs. The values are no text of one target, so the node works for every target.
 *
 *     static bool build_gain(void *user_data, mxg_build *build, mxg_ref *results)
 *     {
 *         const char *const names[] = {"x", "gain"};
 *         const mxg_ref args[] = {mxg_build_input(build, "in"), mxg_build_input(build, "gain")};
 *         results[0] = mxg_build_expression(build, "float", "pow({{x}}, {{gain}})", names, args,
 * 2); return true;
 *     }
 *     static const mxg_node_code gain = {sizeof gain, "ND_gain_float", NULL, 1, build_gain};
 *
 * The definition itself, with its inputs and outputs, is a <nodedef> of a library or document.
 * docs/nodes.md explains an example.
 */
#include <mxgen/mxgen.h>

#ifndef MXGEN_NODE_H
#define MXGEN_NODE_H

#ifdef __cplusplus
extern "C" {
#endif

struct mxg_value; /* document.h */

/* The use of a definition for which the function builds values; valid during the call. */
typedef struct mxg_build mxg_build;

/*
 * A value of the shader; valid in the call of the function that made it. 0: a closure or shader
 * that is absent, and the result of a call that failed. Types have the names of the portable
 * language: bool, int, uint, float, ivec2, vec2 to vec4, mat2 to mat4, string, sampler2D; and BSDF,
 * EDF, VDF, surfaceshader, volumeshader, displacementshader, lightshader, material. Colours are
 * vec3 and vec4.
 */
typedef uint32_t mxg_ref;

/*
 * Writes a value for each output, in the order of the definition. Returns false if it reported an
 * error (mxg_build_report_error). mxgen calls the function for each use with other arguments, and
 * may keep the results for equal ones: they may only depend on the arguments, on the options of
 * generation and on `version`. Several threads may call it at once.
 *
 * A call below that fails reports the reason, or the memory or the number of nodes has reached the
 * limit of the context. Every later call then returns 0 or false at once, so a function may test
 * once at its end; a loop must end when a call returns 0.
 */
typedef bool (*mxg_build_fn)(void *user_data, mxg_build *build, mxg_ref *results);

typedef struct mxg_node_code {
    size_t size; /* sizeof(mxg_node_code) */
    /* the definition, "ND_gain_float"; or a node, "gain": all its definitions without an own code
     */
    const char *name;
    /* a target by its MaterialX name, "genglsl", and all that inherit from it; NULL: every target
     */
    const char *target;
    uint64_t version; /* enters the topology of shaders; a change of the code needs another one */
    mxg_build_fn build;
    void *user_data;
    /*
     * Without `build`: another definition, for example a cheaper one for a target. It gets the
     * inputs by name, and its own defaults for other inputs. Its outputs must have the same types.
     */
    const char *instead;
} mxg_node_code;

typedef struct mxg_build_info {
    size_t size;         /* in */
    const char *nodedef; /* "ND_gain_float" */
    const char *node;    /* "gain" */
    const char *target;  /* MaterialX name, "genglsl" */
    uint32_t num_inputs, num_outputs;
    bool has_vertex_stage; /* otherwise mxg_build_interpolation changes nothing */
} mxg_build_info;
MXG_API mxg_status mxg_build_use(mxg_build *build, mxg_build_info *out);
/* Name and type of an input, or after the inputs of an output. NULL: there is none. */
MXG_API const char *mxg_build_port(mxg_build *build, uint32_t index, const char **out_type);

/* ---- Arguments ---- */

/*
 * The value of an input: a constant, a uniform, or anything that varies. 0 for an absent closure
 * or shader.
 */
MXG_API mxg_ref mxg_build_input(mxg_build *build, const char *name);
/* NULL for 0. */
MXG_API const char *mxg_build_type(mxg_build *build, mxg_ref value);
/*
 * True if the value is a constant; *out, which may be NULL, receives it. `text` is set for strings
 * and lives until the generation ends.
 */
MXG_API bool mxg_build_value(mxg_build *build, mxg_ref value, struct mxg_value *out);
/*
 * The value of an input on which the result depends in another way than by ops, such as an index or
 * a list in a string. If a uniform has it, the input becomes one that is compiled in. False after
 * the message that the input must be a constant. In networks of OSL, only strings and inputs with
 * uniform="true" in the definition are constants.
 */
MXG_API bool mxg_build_require_constant(mxg_build *build, const char *input, struct mxg_value *out);

/* ---- Values ---- */

/* `values` has the components of `type`; integers and booleans come as numbers. */
MXG_API mxg_ref mxg_build_number(mxg_build *build, const char *type, const float *values,
                                 uint32_t num_values);
MXG_API mxg_ref mxg_build_string(mxg_build *build, const char *text);
/*
 * An op by its name in docs/ir.md: "add", "dot", "layer", "surface". `type` NULL derives the type
 * from the operands; "construct" and "convert" need one. Ops of closures accept absent operands
 * and keep no useless node: a layer without top is its base.
 */
MXG_API mxg_ref mxg_build_op(mxg_build *build, const char *op, const char *type,
                             const mxg_ref *args, uint32_t num_args);
/* Components by their names: "x", "xyz". */
MXG_API mxg_ref mxg_build_swizzle(mxg_build *build, mxg_ref value, const char *components);
/*
 * An expression of the portable language (docs/shading-language.md), converted to `type`.
 * {{NAME}} stands for the value of this name; `names` and `args` have `num_args` items.
 */
MXG_API mxg_ref mxg_build_expression(mxg_build *build, const char *type, const char *source,
                                     const char *const *names, const mxg_ref *args,
                                     uint32_t num_args);
/*
 * Applies a definition of the library or document. Inputs that `names` does not list have their
 * defaults. `results` has room for the outputs; `num_results` is their number. A function that
 * applies its own definition gets the implementation that it replaces.
 */
MXG_API bool mxg_build_node(mxg_build *build, const char *nodedef, const char *const *names,
                            const mxg_ref *args, uint32_t num_args, mxg_ref *results,
                            uint32_t num_results);

/* ---- The shader around the node ---- */

/*
 * A geometric stream in the pixel stage: "normalWorld", "texcoord_0", "geomprop_NAME"
 * (docs/reflection.md). `type` NULL: the type of the stream; geomprop_ needs one.
 */
MXG_API mxg_ref mxg_build_stream(mxg_build *build, const char *name, const char *type);
/*
 * Computes a value at the vertices and interpolates it between them, which is cheaper where it
 * varies little. At the vertices, derivatives are 0 and textures have level 0. Integers and vectors
 * of integers are not interpolated: a pixel has the value of one vertex. `name` names the variable.
 */
MXG_API mxg_ref mxg_build_interpolation(mxg_build *build, const char *name, mxg_ref value);

/* A uniform or texture that the host sets; equal names are one variable. */
typedef struct mxg_build_uniform {
    size_t size;          /* in: sizeof(mxg_build_uniform) */
    const char *name;     /* "u_studioExposure" */
    const char *type;     /* "float"; "sampler2D" for a texture */
    const char *semantic; /* mxg_variable.semantic; NULL: the name without "u_" */
    const float *values;  /* default; NULL: 0 */
    uint32_t num_values;
    /*
     * A block of the host's own, "StudioFrame", which it can fill once for many shaders; NULL: the
     * block of private uniforms. A shader has up to four such blocks (MXG_BLOCK_OWN_1). A texture
     * is in no block.
     */
    const char *block;
} mxg_build_uniform;
MXG_API mxg_ref mxg_build_add_uniform(mxg_build *build, const mxg_build_uniform *uniform);

/*
 * Reports an error of the node, or of one of its inputs; `input` may be NULL. The function then
 * returns false.
 */
MXG_API void mxg_build_report_error(mxg_build *build, const char *input, const char *text);

/* ---- Plug-ins ---- */

/*
 * The version of this interface. A plug-in of another version is refused, because structs and
 * meanings may differ.
 */
#define MXG_PLUGIN_VERSION 2

/*
 * A shared object with nodes and targets, for `mxgen --plugin FILE`. It has one entry point:
 *
 *     MXG_API const mxg_plugin *mxgen_plugin(void);
 *
 * It needs no library: the program that loads it has the functions of this header.
 */
typedef struct mxg_plugin {
    uint32_t version; /* MXG_PLUGIN_VERSION */
    const char *name; /* for messages */
    const mxg_node_code *const *nodes;
    size_t num_nodes;
    /* files with definitions, relative to the folder of the plug-in; they extend the library */
    const char *const *libraries;
    size_t num_libraries;
    const struct mxg_dialect *const *dialects; /* targets (dialect.h) */
    size_t num_dialects;
} mxg_plugin;

#ifdef __cplusplus
}
#endif

#endif
