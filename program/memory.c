// SPDX-License-Identifier: Apache-2.0
#include "program/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

void *memory_grow(void *items, size_t len, size_t item_size)
{
    return len & (len - 1) ? items : memory_resize(items, (len ? len * 2 : 1) * item_size);
}

void memory_append_number(struct memory_bytes *bytes, uint64_t number, size_t size)
{
    for (size_t i = 0; i < size; ++i, number >>= 8) {
        uint8_t byte = (uint8_t)number;
        memory_append(bytes, &byte, 1);
    }
}

void memory_append(struct memory_bytes *bytes, const void *data, size_t size)
{
    if (bytes->size + size >= bytes->capacity) {
        bytes->capacity = 2 * (bytes->size + size) + 1;
        bytes->data = memory_resize(bytes->data, bytes->capacity);
    }
    if (size)
        memcpy(bytes->data + bytes->size, data, size);
    bytes->size += size;
    bytes->data[bytes->size] = '\0';
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
