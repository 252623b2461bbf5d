// SPDX-License-Identifier: Apache-2.0
/*
 * Reflection: the interface of a shader, its values, and its lights (docs/reflection.md of the
 * project has the tables).
 */
#include <mxgen/mxgen.h>

#ifndef MXGEN_REFLECTION_H
#define MXGEN_REFLECTION_H

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Variables ---- */

typedef enum mxg_block {
    MXG_BLOCK_PUBLIC_UNIFORMS,
    MXG_BLOCK_PRIVATE_UNIFORMS,
    MXG_BLOCK_LIGHT_DATA,
    MXG_BLOCK_TEXTURES,
    MXG_BLOCK_APP_DATA,
    MXG_BLOCK_VERTEX_DATA,
    MXG_BLOCK_OUTPUTS,
    /*
     * The blocks that nodes in C declare (mxg_build_uniform.block), in the order of their
     * declaration. Their bindings follow those of the textures.
     */
    MXG_BLOCK_OWN_1,
    MXG_BLOCK_OWN_2,
    MXG_BLOCK_OWN_3,
    MXG_BLOCK_OWN_4,
    MXG_NUM_BLOCKS,
    MXG_BLOCK_MAX_ENUM = 0x7fffffff
} mxg_block;

typedef struct mxg_variable {
    size_t size;      /* in */
    const char *name; /* as in the source; a member does not include the name of its block */
    mxg_block block;
    uint32_t stages;           /* bit s: stage s reads the variable */
    const char *type;          /* a type of the shading language: "vec3", "sampler2D" */
    const char *document_type; /* "color3"; "" for private variables */
    const char *path;          /* "SR_gold/base_color"; "" for private variables */
    const char *semantic;      /* "worldMatrix", "geomprop:st"; "" for public variables */
    const char *colorspace, *unit;
    uint32_t array_length; /* 0: not an array */
    uint32_t set, binding, location;
    uint32_t offset, byte_size, array_stride, matrix_stride; /* in a block */
    uint32_t num_values; /* components of the default; 0: none */
    float values[16];    /* integers and booleans as numbers */
    /*
     * textures. `file` has the fileprefix of the document; a name that is not absolute is relative
     * to the folder of `origin`
     */
    const char *file, *uaddressmode, *vaddressmode, *filtertype;
    /* for user interfaces, from the definition; "" if absent */
    const char *uiname, *uifolder, *uimin, *uimax, *uisoftmin, *uisoftmax, *doc;
    /*
     * textures: the name of the file's layer; the frames of a sequence; the tiles of an image,
     * whose files are the layers of a texture array
     */
    const char *layer, *framerange, *frameendaction;
    int32_t frameoffset;
    uint32_t num_tiles;
    const char *unittype;
    /* for user interfaces; commas separate names and values */
    const char *uistep, *enum_names, *enum_values;
    bool advanced;   /* uiadvanced */
    bool flat;       /* not interpolated between vertices */
    int32_t integer; /* the exact default of an integer */
    /* of a stack: the slot or vertical layer that the input belongs to: "050", "000|010" */
    const char *slot;
    /* of the sampler beside a texture; equal to `binding` where both have one */
    uint32_t sampler_binding;
    /*
     * textures: the document, the include or the library that names `file`, as `from` of
     * mxg_resolver.open
     */
    const char *origin;
} mxg_variable;
MXG_API uint32_t mxg_result_num_variables(const mxg_result *result);
MXG_API mxg_status mxg_result_variable(const mxg_result *result, uint32_t index, mxg_variable *out);
/*
 * A tile of a texture. It covers the texture coordinates from (u, v) to (u + 1, v + 1) and is layer
 * `tile` of the texture array.
 */
typedef struct mxg_tile {
    size_t size; /* in */
    const char *file;
    int32_t u, v;
} mxg_tile;
MXG_API mxg_status mxg_result_tile(const mxg_result *result, uint32_t variable, uint32_t tile,
                                   mxg_tile *out);
/*
 * The file of a texture, or of one of its tiles, at a frame. Replaces {frame} and {04frame} and
 * applies the document's offset, range and end action. Length 0: the frame has no file, and the
 * host shows the default colour.
 */
MXG_API size_t mxg_result_texture_file(const mxg_result *result, uint32_t variable, uint32_t tile,
                                       int32_t frame, char *buffer, size_t capacity);

/*
 * The variable of a document path; MXG_NONE: no variable has it, because the input is unused or
 * compiled in.
 */
MXG_API uint32_t mxg_result_find_variable(const mxg_result *result, const char *path);

/* ---- Inputs ---- */

/*
 * Inputs of the document whose value is compiled in. A new value needs an edit (document.h) and a
 * new generation.
 */
typedef struct mxg_compiled_input {
    size_t size; /* in */
    const char *path, *type;
    const char *value; /* as written: "0.5", "oren_nayar"; "" for zero */
    bool authored;     /* the document has the value; otherwise it is the default */
    /* for user interfaces, like those of mxg_variable */
    bool advanced;
    const char *uiname, *uifolder, *uimin, *uimax, *uisoftmin, *uisoftmax, *uistep, *enum_names,
        *enum_values, *doc;
} mxg_compiled_input;
MXG_API uint32_t mxg_result_num_compiled_inputs(const mxg_result *result);
MXG_API mxg_status mxg_result_compiled_input(const mxg_result *result, uint32_t index,
                                             mxg_compiled_input *out);

/* The effect of a new value of an input on a shader. */
typedef enum mxg_input_state {
    MXG_INPUT_UNKNOWN,  /* the document has no input of this path */
    MXG_INPUT_UNUSED,   /* no effect: the shader does not need the input */
    MXG_INPUT_UNIFORM,  /* a variable has the value: mxg_result_find_variable */
    MXG_INPUT_COMPILED, /* needs a new generation: mxg_result_compiled_input */
    /* no value: the input is connected, or its default is a property of the geometry */
    MXG_INPUT_CONNECTED,
    MXG_INPUT_STATE_MAX_ENUM = 0x7fffffff
} mxg_input_state;
/*
 * The state of an input of a node ("SR_gold/base_color", whether the document writes the input or
 * not) or of a nodegraph ("NG_marble/scale"). UNKNOWN also without a shader, and in a network,
 * whose layers have the inputs as parameters.
 */
MXG_API mxg_input_state mxg_result_input_state(const mxg_result *result, const char *path);

/* ---- The shader ---- */

/*
 * How a host draws the shader. OPAQUE: without blending. MASK: with the depth test alone; the
 * shader discards pixels below u_alphaThreshold and writes alpha 1 for the others. BLEND: back to
 * front, blended over the pixels behind. Colours are premultiplied.
 */
typedef enum mxg_alpha {
    MXG_ALPHA_OPAQUE,
    MXG_ALPHA_MASK,
    MXG_ALPHA_BLEND,
    MXG_ALPHA_MAX_ENUM = 0x7fffffff
} mxg_alpha;

typedef struct mxg_shader_info {
    size_t size; /* in */
    const char *name, *path, *target;
    /*
     * A hash: equal for shaders that differ only in names and uniform values. mxg_result_info
     * computes it only if `size` includes this member.
     */
    uint64_t topology;
    uint32_t num_closures, num_textures, num_lights;
    bool transparent, lit;
    bool displaced; /* the vertex stage moves the surface: draw it with small triangles */
    mxg_alpha alpha;
    /*
     * With role=function: the names of the function and of the struct that it returns. Its
     * parameters are the variables of MXG_BLOCK_VERTEX_DATA, its members those of
     * MXG_BLOCK_OUTPUTS, both in order. With role=scatter: the name of the function, which returns
     * nothing, so the type is "". "": a program
     */
    const char *function, *function_type;
    /*
     * Features that the device must have, with commas between, or "". In WGSL: "shader-f16" with
     * precision=mediump, "dual-source-blending" with transparency=dual
     */
    const char *device_features;
} mxg_shader_info;
MXG_API mxg_status mxg_result_info(const mxg_result *result, mxg_shader_info *out);

/* ---- Values ---- */

typedef enum mxg_change {
    MXG_CHANGE_NOTHING, /* the program and its values stay */
    MXG_CHANGE_VALUES,  /* the program stays; some variables have other values */
    MXG_CHANGE_SHADER,  /* another program */
    MXG_CHANGE_MAX_ENUM = 0x7fffffff
} mxg_change;
/*
 * Tells what a host changes to draw `after` in place of `before`, for example after an edit. Both
 * come from the same target and options; `after` may have no source (without_source). A variable
 * has the same index in both results, unless the answer is SHADER.
 *
 * Writes the indices of the variables with other values, at most `capacity` of them, and returns
 * their number in *out_num (may be NULL). For a texture, another file, layer, tile, address mode or
 * colour of the border counts. Paths and texts for user interfaces may differ: take them from
 * `after`. SHADER also if one of the results has no shader, if the way of drawing differs
 * (mxg_shader_info), or if the values of a network differ.
 */
MXG_API mxg_change mxg_result_change(const mxg_result *before, const mxg_result *after,
                                     uint32_t *variables, uint32_t capacity, uint32_t *out_num);

/* A block of the interface. Its variables have consecutive indices. */
typedef struct mxg_block_info {
    size_t size;      /* in */
    const char *name; /* "PublicUniforms"; "" for an own block that the shader has not */
    uint32_t first_variable, num_variables;
    /*
     * For uniforms in a buffer; 0 if the target or the options declare single uniforms. LightData:
     * the bytes of the array u_lightData.
     */
    uint32_t byte_size;
    uint32_t set, binding;               /* of the buffer */
    uint32_t array_length, array_stride; /* LightData: the lights, and their distance in bytes */
} mxg_block_info;
MXG_API mxg_status mxg_result_block(const mxg_result *result, mxg_block block, mxg_block_info *out);

/*
 * Fills a buffer of uniforms, which has mxg_block_info.byte_size bytes, ready for upload: std140,
 * or the packing of constant buffers for HLSL. Numbers are 32 bits wide, a boolean is 0 or 1, a
 * matrix has its columns matrix_stride bytes apart, and bytes between members are 0. Lights are 0.
 * MXG_ERROR_ARGUMENT if the block is in no buffer, or `capacity` is too small.
 *
 * `document` NULL: the values that the result was made with. Otherwise those that another document
 * has for the program: the next document after an edit of inputs that are uniforms
 * (mxg_result_input_state). This reads these inputs and nothing else, so it is much faster than a
 * generation, which mxg_result_change needs. MXG_ERROR_DOCUMENT if the document has another node,
 * or no value there, for example because the input is connected or has a geometric property, or one
 * in another unit or colour space, whose conversion the program has compiled in; the buffer is then
 * not filled, and the host generates. MXG_ERROR_ARGUMENT if the document has another library.
 */
MXG_API mxg_status mxg_result_pack_block(const mxg_result *result, const mxg_document *document,
                                         mxg_block block, void *bytes, size_t capacity);
/*
 * Writes the value of one variable to its place in such a buffer; `element` is the light of a
 * member of LightData, or the element of an array, else 0. Integers and booleans come as numbers.
 * MXG_ERROR_ARGUMENT if the variable is in no buffer, the number of values is not that of its type,
 * an integer has a fraction or lies beyond 2^24 (mxg_result_pack_block writes all integers), or
 * `capacity` is too small.
 */
MXG_API mxg_status mxg_result_pack_value(const mxg_result *result, uint32_t variable,
                                         uint32_t element, const float *values, uint32_t num_values,
                                         void *bytes, size_t capacity);

/* ---- Lights ---- */

/* A light shader of the result: u_lightData[i].type selects it for light i. */
typedef struct mxg_light_type {
    size_t size; /* in */
    int32_t type;
    const char *name;     /* of its function, or of its node */
    bool is_shader;       /* made of nodes: also reads the members `position` and `direction` */
    uint32_t num_members; /* the members of LightData that it reads as its inputs */
} mxg_light_type;
MXG_API uint32_t mxg_result_num_light_types(const mxg_result *result);
MXG_API mxg_status mxg_result_light_type(const mxg_result *result, uint32_t index,
                                         mxg_light_type *out);
/* The variable of a member. MXG_NONE: there is none, or no stage reads it. */
MXG_API uint32_t mxg_result_light_member(const mxg_result *result, uint32_t light, uint32_t member);

/*
 * The variables, inputs and info above as JSON (docs/reflection.md). NULL without a shader or
 * without memory.
 */
MXG_API const char *mxg_result_reflection_json(const mxg_result *result, size_t *out_size);

#ifdef __cplusplus
}
#endif

#endif
