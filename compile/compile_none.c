// SPDX-License-Identifier: Apache-2.0
/*
 * In place of compile.c where glslang is not installed: there is no compiler for any target but
 * OSL.
 */
#include "compile/oslc.h"

#include <string.h>

void compile_begin(void)
{
}

void compile_end(void)
{
}

void compile_on_exhaustion(void (*tell)(void))
{
    (void)tell;
}

bool compile_knows_target(const char *target)
{
    return strcmp(target, "osl") == 0 && oslc_is_installed();
}

bool compile_program(const char *target, const char *const sources[MXG_NUM_STAGES],
                     struct compiled *out)
{
    (void)target;
    *out = (struct compiled){0};
    return oslc_compile_program(sources, out);
}
