// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_BIND_MATERIALS_H
#define MXG_BIND_MATERIALS_H

#include "bind/primitives.h"
#include "library/library.h"

/* How the bytes at the beginning of an image are read. */
struct bind_images {
    void *user_data;
    /* Fills the buffer from a file, named as in the layer; the number of bytes, 0: none. */
    size_t (*read)(void *user_data, const char *file, unsigned char *buffer, size_t capacity);
};

/*
 * image_kind.c: true if an image has colours in sRGB where nobody says so. Without data, the end of
 * its name decides.
 */
bool bind_image_is_srgb(const char *file, const void *data, size_t size);

/*
 * Adds the Materials of a stage to the document of a library layer, which is not complete yet. The
 * document's own elements stay: a Material whose name one of them has is left out. Shaders without
 * a definition are reported, and left out.
 */
void bind_add_materials(const struct scene *scene, struct library *lib,
                        const struct bind_images *images, struct arena *scratch,
                        struct diag_list *diags);

#endif
