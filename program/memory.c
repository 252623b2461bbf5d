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

char *memory_format(const char *format, va_list args)
{
    va_list again;
    va_copy(again, args);
    int len = vsnprintf(NULL, 0, format, args);
    char *text = memory_alloc(len < 0 ? 1 : (size_t)len + 1);
    *text = '\0';
    if (len > 0)
        vsnprintf(text, (size_t)len + 1, format, again);
    va_end(again);
    return text;
}
