// SPDX-License-Identifier: Apache-2.0
#include "lsp/image_header.h"

#include <stdio.h>
#include <string.h>

static uint32_t big(const unsigned char *bytes, int num)
{
    uint32_t value = 0;
    for (int i = 0; i < num; ++i)
        value = value << 8 | bytes[i];
    return value;
}

static uint32_t little(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16
           | (uint32_t)bytes[3] << 24;
}

/* PNG (ISO/IEC 15948, 11.2.1): the first chunk is IHDR. */
static bool read_png(const unsigned char *bytes, size_t size, struct image_header *out)
{
    if (size < 24 || memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) != 0)
        return false;
    *out = (struct image_header){"PNG", big(bytes + 16, 4), big(bytes + 20, 4)};
    return true;
}

/* JPEG (ITU-T T.81, B.2.2): segments up to the one that begins a frame. */
static bool read_jpeg(const unsigned char *bytes, size_t size, struct image_header *out)
{
    if (size < 4 || bytes[0] != 0xff || bytes[1] != 0xd8)
        return false;
    for (size_t at = 2; at + 9 < size && bytes[at] == 0xff; at += 2 + big(bytes + at + 2, 2)) {
        unsigned char marker = bytes[at + 1];
        bool is_frame =
            marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (!is_frame)
            continue;
        *out = (struct image_header){"JPEG", big(bytes + at + 7, 2), big(bytes + at + 5, 2)};
        return true;
    }
    return false;
}

/* OpenEXR (file layout): the attribute dataWindow, a box of four integers. */
static bool read_exr(const unsigned char *bytes, size_t size, struct image_header *out)
{
    static const char key[] = "dataWindow\0box2i";
    if (size < 8 || memcmp(bytes, "\x76\x2f\x31\x01", 4) != 0)
        return false;
    for (size_t at = 8; at + sizeof key + 20 < size; ++at) {
        if (memcmp(bytes + at, key, sizeof key) != 0)
            continue;
        const unsigned char *box = bytes + at + sizeof key + 4;
        *out = (struct image_header){"OpenEXR", little(box + 8) - little(box) + 1,
                                     little(box + 12) - little(box + 4) + 1};
        return true;
    }
    return false;
}

/* Radiance: a line "-Y height +X width" behind the header. */
static bool read_hdr(const unsigned char *bytes, size_t size, struct image_header *out)
{
    unsigned width, height;
    if (size < 10 || memcmp(bytes, "#?", 2) != 0)
        return false;
    const char *line = strstr((const char *)bytes, "\n-Y ");
    if (!line || sscanf(line, "\n-Y %9u +X %9u", &height, &width) != 2)
        return false;
    *out = (struct image_header){"Radiance", width, height};
    return true;
}

bool image_header_read(const char *bytes, size_t size, struct image_header *out)
{
    const unsigned char *data = (const unsigned char *)bytes;
    return read_png(data, size, out) || read_jpeg(data, size, out) || read_exr(data, size, out)
           || read_hdr(data, size, out);
}
