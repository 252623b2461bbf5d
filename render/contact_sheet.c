// SPDX-License-Identifier: Apache-2.0
#include "render/contact_sheet.h"

#include "render/label.h"

#include <math.h>
#include <string.h>

enum { GAP = 4 };

/* The letters scale with the pictures, so that about 24 fit below one. */
static unsigned label_scale(const struct sheet *sheet)
{
    unsigned scale = sheet->width / (LABEL_ADVANCE * 24);
    return scale ? scale : 1;
}

static uint32_t cell_width(const struct sheet *sheet)
{
    return sheet->width + GAP;
}

static uint32_t cell_height(const struct sheet *sheet)
{
    return sheet->height + (LABEL_HEIGHT + 4) * label_scale(sheet) + GAP;
}

bool sheet_init(struct sheet *sheet, uint32_t count, uint32_t width, uint32_t height)
{
    *sheet = (struct sheet){.width = width, .height = height, .count = count};
    /* somewhat wider than high */
    sheet->columns = (uint32_t)ceil(sqrt(1.4 * count * height / width));
    if (sheet->columns > count)
        sheet->columns = count;
    uint32_t rows = (count + sheet->columns - 1) / sheet->columns;
    struct image *image = &sheet->image;
    image->width = cell_width(sheet) * sheet->columns + GAP;
    image->height = cell_height(sheet) * rows + GAP;
    image->pixels = malloc((size_t)image->width * image->height * 4);
    uint8_t *pixel = image->pixels;
    for (size_t i = 0; pixel && i < (size_t)image->width * image->height; ++i)
        memcpy(pixel + i * 4, (const uint8_t[4]){32, 32, 34, 255}, 4);
    return pixel != NULL;
}

void sheet_finish(struct sheet *sheet)
{
    image_finish(&sheet->image);
}

static void draw_cross(uint8_t *pixels, uint32_t stride, uint32_t width, uint32_t height)
{
    for (uint32_t y = 0; y < height; ++y) {
        uint32_t x = y * width / height;
        memcpy(pixels + ((size_t)y * stride + x) * 4, (const uint8_t[4]){255, 0, 255, 255}, 4);
        memcpy(pixels + ((size_t)y * stride + width - 1 - x) * 4,
               (const uint8_t[4]){255, 0, 255, 255}, 4);
    }
}

void sheet_place(struct sheet *sheet, uint32_t index, const struct image *picture, const char *name)
{
    uint32_t stride = sheet->image.width, x = index % sheet->columns * cell_width(sheet) + GAP;
    uint32_t y = index / sheet->columns * cell_height(sheet) + GAP;
    uint8_t *corner = (uint8_t *)sheet->image.pixels + ((size_t)y * stride + x) * 4;
    for (uint32_t row = 0; picture && row < sheet->height; ++row)
        memcpy(corner + (size_t)row * stride * 4,
               (const uint8_t *)picture->pixels + (size_t)row * sheet->width * 4,
               (size_t)sheet->width * 4);
    if (!picture)
        draw_cross(corner, stride, sheet->width, sheet->height);
    unsigned scale = label_scale(sheet);
    label_draw(sheet->image.pixels, stride, x + scale, y + sheet->height + 2 * scale,
               sheet->width - scale, scale, name);
}
