// SPDX-License-Identifier: Apache-2.0
/*
 * Layers of OpenUSD of a flat document whose surfaces are UsdPreviewSurface. usd.c has the stage
 * and its files, usd_mesh.c the geometry, usd_preview.c the network of UsdPreviewSurface
 * (openusd.org/release/spec_usdpreviewsurface.html), usd_network.c that of MaterialX: the graph of
 * the user's document.
 */
#ifndef MXG_EXPORT_USD_H
#define MXG_EXPORT_USD_H

#include "export/flat.h"
#include "export/texture_image.h"
#include "export/write.h"

#include <stdio.h>

struct usd_file {
    char *key;  /* what equal files share */
    char *name; /* beside the layer */
    void *data;
    size_t size;
};

struct usd {
    const struct flat *flat;
    struct writing *writing;
    bool is_package; /* all files are in it */
    FILE *out;
    unsigned depth;
    struct usd_file *files;
    size_t num_files;
};

/* Writes a line, indented. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void usd_put(struct usd *usd, const char *format, ...);
/* Writes "def TYPE "NAME"" and an opening brace, which usd_close closes. */
void usd_open(struct usd *usd, const char *type, const char *name);
void usd_close(struct usd *usd);
/* A number with the digits that tell a float. */
void usd_put_numbers(struct usd *usd, const float *values, unsigned num);

/* A name of a prim that `names` does not have yet: letters, digits and '_'. The caller frees it. */
char *usd_name(struct name_table *names, const char *wanted);
/* A text in quotes, or a path between '@', relative to the layer. The caller frees it. */
char *usd_quote(const char *text);
char *usd_asset(const char *path);

/* Finds a file that was added; NULL: there is none. */
const struct usd_file *usd_find_file(const struct usd *usd, const char *key);
/* Adds a file, which takes `data`; its name is free, and ends with `name`. */
const struct usd_file *usd_add_file(struct usd *usd, const char *key, const char *name, void *data,
                                    size_t size);

/* Writes the shaders of a material into its prim, whose path is `path`, and its output. false after
 * reporting an error. */
bool usd_put_preview(struct usd *usd, const struct flat_material *material, const char *path,
                     struct name_table *names);
/* Writes the graph of the user's document in this way; nothing of it, with a warning, where USD
 * cannot have all. */
void usd_put_network(struct usd *usd, const struct flat_material *material, const char *path,
                     struct name_table *names);

/* Writes a prim for each material, side by side, with the objects of the surface; `paths` are of
 * the material prims. */
void usd_put_objects(struct usd *usd, char *const *paths);

#endif
