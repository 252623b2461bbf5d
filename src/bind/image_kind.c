// SPDX-License-Identifier: Apache-2.0
/*
 * Whether an image has colours in sRGB, as USD's sourceColorSpace "auto" asks: it has 8 bits and
 * three or four channels (the specification "UsdPreviewSurface", UsdUVTexture).
 */
#include "bind/materials.h"

#include <string.h>

enum answer { NO, YES, UNKNOWN };

/* PNG, section 11.2.2: the depth and the type of colour stand in the first chunk. */
static enum answer ask_png(const unsigned char *data, size_t size)
{
    static const unsigned char magic[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    enum { DEPTH = 24, COLOR = 25, RGB = 2, PALETTE = 3, RGBA = 6 };
    if (size <= COLOR || memcmp(data, magic, sizeof magic) != 0)
        return UNKNOWN;
    if (data[COLOR] == PALETTE) /* of colours of 8 bits */
        return YES;
    return data[DEPTH] == 8 && (data[COLOR] == RGB || data[COLOR] == RGBA) ? YES : NO;
}

/* JPEG, section B.2.2: the header of the frame has the precision and the number of components. */
static enum answer ask_jpeg(const unsigned char *data, size_t size)
{
    enum { HEADER = 10, DHT = 0xc4, JPG = 0xc8, DAC = 0xcc };
    size_t at = 2;
    if (size < 2 || data[0] != 0xff || data[1] != 0xd8)
        return UNKNOWN;
    while (at + HEADER <= size && data[at] == 0xff) {
        unsigned char marker = data[at + 1];
        if (marker >= 0xc0 && marker <= 0xcf && marker != DHT && marker != JPG && marker != DAC)
            return data[at + 4] == 8 && data[at + 9] >= 3 ? YES : NO;
        at += 2 + ((size_t)data[at + 2] << 8 | data[at + 3]);
    }
    return YES; /* its frame stands behind large metadata */
}

/* The formats of 8 bits, by the end of a name. */
static bool is_of_8_bits(const char *file)
{
    static const char *const ends[] = {".png", ".jpg", ".jpeg", ".bmp", ".tga", ".gif", ".webp"};
    size_t len = strlen(file);
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        size_t end = strlen(ends[i]), same = 0;
        while (len > end && same < end && (file[len - end + same] | 0x20) == ends[i][same])
            same++;
        if (same == end)
            return true;
    }
    return false;
}

bool bind_image_is_srgb(const char *file, const void *data, size_t size)
{
    enum answer answer = ask_png(data, size);
    if (answer == UNKNOWN)
        answer = ask_jpeg(data, size);
    return answer == UNKNOWN ? is_of_8_bits(file) : answer == YES;
}
