// SPDX-License-Identifier: Apache-2.0
/* A contact sheet: many small pictures with names under them. */
#ifndef MXG_RENDER_CONTACT_SHEET_H
#define MXG_RENDER_CONTACT_SHEET_H

#include "render/image.h"

struct sheet {
    struct image image;     /* 8-bit */
    uint32_t width, height; /* of a picture */
    uint32_t columns, count;
};

/* Makes a sheet for `count` pictures. false: out of memory. */
bool sheet_init(struct sheet *sheet, uint32_t count, uint32_t width, uint32_t height);
void sheet_finish(struct sheet *sheet);

/* Places an 8-bit picture. NULL: draws a cross for a failed picture. */
void sheet_place(struct sheet *sheet, uint32_t index, const struct image *picture,
                 const char *name);

#endif
