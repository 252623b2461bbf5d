// SPDX-License-Identifier: Apache-2.0
/*
 * Compiles shaders with glslang, to be sure that what mxgen writes is what it says: valid GLSL
 * whose stages fit together, and valid SPIR-V. Messages carry the line of the shader;
 * mxg_result_source_place maps it to the document.
 */
#ifndef MXG_COMPILE_COMPILE_H
#define MXG_COMPILE_COMPILE_H

#include <mxgen/mxgen.h>

#ifdef __cplusplus
extern "C" {
#endif

struct compile_message {
    mxg_stage stage;
    mxg_severity severity;
    uint32_t line; /* of the stage's source; 0 = none (linking, SPIR-V) */
    char *text;
};

struct compiled_stage {
    uint32_t *words; /* SPIR-V as glslang writes it, not optimised; NULL where it failed */
    size_t num_words;
    /* inside of functions: what an optimiser or driver has to go through */
    uint32_t body_instructions;
};

/*
 * Where a compiler that chooses places put a variable. A variable of both stages has several, and a
 * texture has one for itself and one for its sampler.
 */
struct compiled_place {
    char *name; /* "u_lightData.color": a member of each element of an array */
    uint32_t set;
    uint32_t index; /* the binding, or the location of a vertex attribute */
    uint32_t offset, byte_size, array_stride; /* in the buffer; 0 for textures and attributes */
};

struct compiled {
    struct compiled_stage stages[MXG_NUM_STAGES];
    struct compile_message *messages;
    size_t num_messages;
    struct compiled_place *places; /* none: they stand in the source, as the reflection has them */
    size_t num_places;
    uint32_t errors;
};

/* Sets the compilers up and down; once for the whole process. */
void compile_begin(void);
void compile_end(void);

/*
 * Makes the module that the options name for shaders of MDL, whose compiler then finds it beside
 * them; without one these shaders have faults. For all calls until compile_end.
 */
void compile_import_module(mxg_context *context, mxg_library *library, const mxg_options *options);

/* `tell` is called when a compiler finds no memory, which ends the program. */
void compile_on_exhaustion(void (*tell)(void));

/*
 * Whether shaders of the target can be compiled here: "glsl", "vulkan", "essl"; others where
 * their compilers are (command.h, compiler_process.h).
 */
bool compile_knows_target(const char *target);

/*
 * Compiles and links the stages of a program. True without errors. compiled_finish must follow in
 * both cases.
 */
bool compile_program(const char *target, const char *const sources[MXG_NUM_STAGES],
                     struct compiled *out);
void compiled_finish(struct compiled *compiled);

/*
 * compiled.c: the same of what was generated, the stages of a shader, or the shaders of a network
 * each by itself.
 */
bool compile_result(const char *target, const mxg_result *result, struct compiled *out);
enum { COMPILE_MAX_RESULTS = 64 };
/*
 * Compiles several, which is faster than one by one where compilers start slowly (command.h). Equal
 * code is compiled once (known.h), so `outs` may lack SPIR-V.
 */
void compile_results(const char *target, const mxg_result *const *results, size_t count,
                     struct compiled outs[COMPILE_MAX_RESULTS]);

/*
 * Compiles the source of a compute shader in the language of "vulkan", "hlsl" or a target of
 * compiler_process.h; code and messages stand in the place of the pixel stage.
 */
bool compile_compute(const char *target, const char *source, struct compiled *out);

/* compiled.c: the same of a pass, with functions of the host that it calls. */
bool compile_pass(const char *target, const char *source, struct compiled *out);

/* compiled.c: adds a message, for what compiles. */
void compiled_add(struct compiled *compiled, mxg_stage stage, mxg_severity severity, uint32_t line,
                  const char *text, size_t len);

#ifdef __cplusplus
}
#endif
#endif
