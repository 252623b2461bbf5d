// SPDX-License-Identifier: Apache-2.0
/*
 * In place of compile.c where glslang is not installed: targets whose compilers are commands have
 * one.
 */
#include "compile/command.h"

#include <string.h>

void compile_begin(void)
{
}

void compile_end(void)
{
    command_end();
}

void compile_on_exhaustion(void (*tell)(void))
{
    (void)tell;
}

bool compile_knows_target(const char *target)
{
    return command_knows_target(target);
}

bool compile_program(const char *target, const char *const sources[MXG_NUM_STAGES],
                     struct compiled *out)
{
    *out = (struct compiled){0};
    return command_compile_program(target, sources, out);
}
