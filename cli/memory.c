// SPDX-License-Identifier: Apache-2.0
#include "cli/memory.h"

#include <stdio.h>
#include <stdlib.h>

static void *require(void *memory)
{
    if (memory)
        return memory;
    fputs("mxgen: out of memory\n", stderr);
    exit(1);
}

void *memory_alloc(size_t size)
{
    return require(calloc(1, size ? size : 1));
}

void *memory_resize(void *memory, size_t size)
{
    return require(realloc(memory, size ? size : 1));
}
