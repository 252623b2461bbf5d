// SPDX-License-Identifier: Apache-2.0
/* Compiles OSL with the program oslc, where one is installed. */
#ifndef MXG_COMPILE_OSLC_H
#define MXG_COMPILE_OSLC_H

#include "compile/compile.h"

/* Whether an oslc is found where programs are (PATH). */
bool oslc_is_installed(void);

/*
 * compile_program for OSL: each stage is a shader of its own, and the number of its instructions
 * goes to body_instructions. Messages of oslc have a line, no column.
 */
bool oslc_compile_program(const char *const sources[MXG_NUM_STAGES], struct compiled *out);

#endif
