// SPDX-License-Identifier: Apache-2.0
/*
 * Compilers that are commands, one process for each stage: oslc for OSL, mdlc for MDL. They are
 * used where they are installed.
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

/* Forgets the module of compile_import_module. */
void command_end(void);

#endif
