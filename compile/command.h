// SPDX-License-Identifier: Apache-2.0
/*
 * Compilers that are commands: oslc for OSL, one process for each shader, and mdlc for MDL, one for
 * several. They are used where they are installed.
 */
#ifndef MXG_COMPILE_COMMAND_H
#define MXG_COMPILE_COMMAND_H

#include "compile/compile.h"

/* Whether the target's compiler is found where programs are (PATH). */
bool command_knows_target(const char *target);

/*
 * compile_program for such a target: each stage is a shader of its own. Where the compiler writes
 * instructions, their number goes to body_instructions. Messages have a line, no column.
 */
bool command_compile_program(const char *target, const char *const sources[MXG_NUM_STAGES],
                             struct compiled *out);

/*
 * Whether the compiler of the target is here and takes several shaders, each a module, in one
 * process; then command_compile_modules compiles the pixel stages of `count` programs into `outs`,
 * which are zeroed before.
 */
bool command_takes_modules(const char *target);
void command_compile_modules(const char *target, const char *const *sources, size_t count,
                             struct compiled *outs);

/* Forgets the module of compile_import_module. */
void command_end(void);

#endif
