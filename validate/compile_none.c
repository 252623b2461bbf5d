// SPDX-License-Identifier: Apache-2.0
/* In place of compile.c where glslang is not installed: there is no compiler for any target. */
#include "validate/compile.h"

void compile_begin(void)
{
}

void compile_end(void)
{
}

bool compile_knows_target(const char *target)
{
    (void)target;
    return false;
}

bool compile_program(const char *target, const char *const sources[MXG_NUM_STAGES], struct compiled *out)
{
    (void)target;
    (void)sources;
    *out = (struct compiled){0};
    return false;
}

void compiled_finish(struct compiled *compiled)
{
    (void)compiled;
}
