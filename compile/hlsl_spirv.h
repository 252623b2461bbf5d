// SPDX-License-Identifier: Apache-2.0
/* HLSL to SPIR-V. glslang's C interface has no way to name the entry point, which its HLSL needs.
 */
#ifndef MXG_COMPILE_HLSL_SPIRV_H
#define MXG_COMPILE_HLSL_SPIRV_H

#include <mxgen/mxgen.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct hlsl_module { /* of one stage; hlsl_module_free */
    uint32_t *words; /* NULL: there is none */
    size_t num_words;
    char *log; /* messages, as glslang writes them; NULL: there are none */
};

/*
 * Compiles the function main of each stage that is not NULL for Vulkan 1.1, as `glslangValidator -D
 * -V -Od` does; is_compute: the source in the place of the pixel stage is a compute stage. False
 * after errors, which are in the logs. Between compile_begin and compile_end.
 */
bool hlsl_compile(const char *const sources[MXG_NUM_STAGES], bool is_compute,
                  struct hlsl_module out_modules[MXG_NUM_STAGES]);
void hlsl_module_free(struct hlsl_module *module);

#ifdef __cplusplus
}
#endif

#endif
