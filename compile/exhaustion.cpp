// SPDX-License-Identifier: Apache-2.0
/* The compilers are C++: where they find no memory, they throw an exception that nobody catches. */
#include "compile/compile.h"

#include <new>

static void (*tell_exhaustion)();

static void handle()
{
    if (tell_exhaustion)
        tell_exhaustion();
    throw std::bad_alloc();
}

void compile_on_exhaustion(void (*tell)(void))
{
    tell_exhaustion = tell;
    std::set_new_handler(handle);
}
