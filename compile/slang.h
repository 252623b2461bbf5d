// SPDX-License-Identifier: Apache-2.0
/*
 * Compiles Slang with slang-wasm, which Node runs: the environment variable MXGEN_SLANG is the path
 * of slang-wasm.js.
 */
#ifndef MXG_COMPILE_SLANG_H
#define MXG_COMPILE_SLANG_H

#include "compile/compile.h"

/* Whether MXGEN_SLANG names a file. */
bool slang_is_installed(void);

/*
 * compile_program for Slang, to SPIR-V that is not validated. The first call starts Node, which
 * takes about a second and waits for more programs until slang_end.
 */
bool slang_compile_program(const char *const sources[MXG_NUM_STAGES], struct compiled *out);
void slang_end(void);

#endif
