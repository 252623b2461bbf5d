// SPDX-License-Identifier: Apache-2.0
#include "render/label.h"

#include <ctype.h>
#include <string.h>

/*
 * Rows from the top, five pixels each with the leftmost in bit 4; the last glyph is for what is not
 * in the list.
 */
static const char known[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./: ";
static const uint8_t glyphs[sizeof known][LABEL_HEIGHT] = {
    {14, 17, 17, 31, 17, 17, 17}, {30, 17, 17, 30, 17, 17, 30}, {14, 17, 16, 16, 16, 17, 14},
    {30, 17, 17, 17, 17, 17, 30}, {31, 16, 16, 30, 16, 16, 31}, {31, 16, 16, 30, 16, 16, 16},
    {14, 17, 16, 23, 17, 17, 14}, {17, 17, 17, 31, 17, 17, 17}, {14, 4, 4, 4, 4, 4, 14},
    {7, 2, 2, 2, 2, 18, 12},      {17, 18, 20, 24, 20, 18, 17}, {16, 16, 16, 16, 16, 16, 31},
    {17, 27, 21, 21, 17, 17, 17}, {17, 17, 25, 21, 19, 17, 17}, {14, 17, 17, 17, 17, 17, 14},
    {30, 17, 17, 30, 16, 16, 16}, {14, 17, 17, 17, 21, 18, 13}, {30, 17, 17, 30, 20, 18, 17},
    {15, 16, 16, 14, 1, 1, 30},   {31, 4, 4, 4, 4, 4, 4},       {17, 17, 17, 17, 17, 17, 14},
    {17, 17, 17, 17, 17, 10, 4},  {17, 17, 17, 21, 21, 27, 17}, {17, 17, 10, 4, 10, 17, 17},
    {17, 17, 10, 4, 4, 4, 4},     {31, 1, 2, 4, 8, 16, 31},     {14, 17, 19, 21, 25, 17, 14},
    {4, 12, 4, 4, 4, 4, 14},      {14, 17, 1, 2, 4, 8, 31},     {31, 2, 4, 2, 1, 17, 14},
    {2, 6, 10, 18, 31, 2, 2},     {31, 16, 30, 1, 1, 17, 14},   {6, 8, 16, 30, 17, 17, 14},
    {31, 1, 2, 4, 8, 8, 8},       {14, 17, 17, 14, 17, 17, 14}, {14, 17, 17, 15, 1, 2, 12},
    {0, 0, 0, 0, 0, 0, 31},       {0, 0, 0, 31, 0, 0, 0},       {0, 0, 0, 0, 0, 12, 12},
    {1, 1, 2, 4, 8, 16, 16},      {0, 12, 12, 0, 12, 12, 0},    {0, 0, 0, 0, 0, 0, 0},
    {31, 17, 17, 17, 17, 17, 31},
};

static const uint8_t *glyph(char c)
{
    const char *at = strchr(known, toupper((unsigned char)c));
    return glyphs[at ? (size_t)(at - known) : sizeof known - 1];
}

static void draw_glyph(uint8_t *rgba, uint32_t stride, uint32_t x, uint32_t y, unsigned scale,
                       const uint8_t *rows)
{
    for (uint32_t j = 0; j < LABEL_HEIGHT * scale; ++j)
        for (uint32_t i = 0; i < 5 * scale; ++i)
            if (rows[j / scale] >> (4 - i / scale) & 1)
                memset(rgba + ((size_t)(y + j) * stride + x + i) * 4, 255, 4);
}

void label_draw(uint8_t *rgba, uint32_t stride, uint32_t x, uint32_t y, uint32_t width,
                unsigned scale, const char *text)
{
    for (uint32_t end = x + width; *text && x + 5 * scale <= end;
         ++text, x += LABEL_ADVANCE * scale)
        draw_glyph(rgba, stride, x, y, scale, glyph(*text));
}
