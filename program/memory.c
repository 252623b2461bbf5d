// SPDX-License-Identifier: Apache-2.0
#include "program/memory.h"

#include <stdio.h>
#include <stdlib.h>

static void (*tell_exhaustion)(void);

void memory_on_exhaustion(void (*tell)(void))
{
    tell_exhaustion = tell;
}

_Noreturn void memory_fail(void)
{
    if (tell_exhaustion)
        tell_exhaustion();
    fputs("mxgen: out of memory\n", stderr);
    exit(1);
}

static void *require(void *memory)
{
    if (!memory)
        memory_fail();
    return memory;
}

void *memory_alloc(size_t size)
{
    return require(calloc(1, size ? size : 1));
}

void *memory_resize(void *memory, size_t size)
{
    return require(realloc(memory, size ? size : 1));
}
