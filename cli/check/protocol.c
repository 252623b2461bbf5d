// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "cli/check/protocol.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool write_all(int fd, const char *data, size_t size)
{
    while (size) {
        ssize_t n = write(fd, data, size);
        if (n < 0 && errno != EINTR)
            return false;
        data += n > 0 ? n : 0;
        size -= n > 0 ? (size_t)n : 0;
    }
    return true;
}

static bool read_all(int fd, char *data, size_t size)
{
    while (size) {
        ssize_t n = read(fd, data, size);
        if (n == 0 || (n < 0 && errno != EINTR))
            return false;
        data += n > 0 ? n : 0;
        size -= n > 0 ? (size_t)n : 0;
    }
    return true;
}

bool frame_write(int fd, enum frame_kind kind, const void *body, size_t size)
{
    char small[512]; /* marks and tasks in one call of the system */
    struct frame_header header = {kind, (uint32_t)size};
    if (size > UINT32_MAX)
        return false;
    memcpy(small, &header, sizeof header);
    if (size > sizeof small - sizeof header)
        return write_all(fd, small, sizeof header) && write_all(fd, body, size);
    memcpy(small + sizeof header, body, size);
    return write_all(fd, small, sizeof header + size);
}

char *frame_read(int fd, struct frame_header *out_header)
{
    if (!read_all(fd, (char *)out_header, sizeof *out_header))
        return NULL;
    char *body = malloc((size_t)out_header->size + 1);
    if (!body || !read_all(fd, body, out_header->size)) {
        free(body);
        return NULL;
    }
    body[out_header->size] = '\0';
    return body;
}
