// SPDX-License-Identifier: Apache-2.0
#include "base/structs.h"

#include <assert.h>
#include <string.h>

static size_t size_of(const void *with_size)
{
    size_t size;
    memcpy(&size, with_size, sizeof size);
    return size;
}

bool struct_read(void *out, size_t out_size, const void *in)
{
    assert(out_size > sizeof(size_t));
    size_t size = size_of(in);
    if (size <= sizeof size)
        return false;
    memset(out, 0, out_size);
    memcpy(out, in, size < out_size ? size : out_size);
    for (size_t i = out_size; i < size; i++)
        if (((const char *)in)[i])
            return false;
    return true;
}

mxg_status struct_write(void *out, const void *from, size_t from_size)
{
    if (!out || size_of(out) <= sizeof(size_t))
        return MXG_ERROR_ARGUMENT;
    size_t size = size_of(out), known = size < from_size ? size : from_size;
    assert(known >= sizeof size && known <= from_size);
    memcpy((char *)out + sizeof size, (const char *)from + sizeof size, known - sizeof size);
    memset((char *)out + known, 0, size - known);
    return MXG_OK;
}
