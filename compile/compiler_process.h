// SPDX-License-Identifier: Apache-2.0
/*
 * Compilers that are processes and answer requests (answer.mjs). An environment variable is the
 * path of each: MXGEN_SLANG of slang-wasm.js and MXGEN_DAWN of index.js of the package "webgpu",
 * which Node runs, and MXGEN_MSLCHECK of mslcheck.py (tests/msl).
 */
#ifndef MXG_COMPILE_COMPILER_PROCESS_H
#define MXG_COMPILE_COMPILER_PROCESS_H

#include "compile/compile.h"

/* Whether the variable of the target's compiler names a file. */
bool worker_knows_target(const char *target);

/*
 * compile_program for such a target; code is SPIR-V that is not validated, with the places of its
 * variables, or none. The first call for a target starts a process, which takes about a second and
 * waits for more programs until workers_end.
 */
bool worker_compile_program(const char *target, const char *const sources[MXG_NUM_STAGES],
                            struct compiled *out);
void workers_end(void);

#endif
