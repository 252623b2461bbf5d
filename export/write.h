// SPDX-License-Identifier: Apache-2.0
/* What a writer of a format has. */
#ifndef MXG_EXPORT_WRITE_H
#define MXG_EXPORT_WRITE_H

#include "export/flat.h"
#include "program/batch.h"
#include "program/outputs.h"
#include "render/bake_surface.h"

struct writing {
    struct report *report;
    const char *path;                   /* of the file */
    const char *scratch;                /* a folder for files that do not outlive the writer */
    const struct bake_surface *surface; /* whose objects have the materials */
    struct batch files;
    struct outputs *outputs;
};

/* Adds a file beside `path`. false after reporting an error. */
bool write_beside(struct writing *writing, const char *name, const void *data, size_t size);
/* The name of the file without folder and ending. The caller frees it. */
char *write_stem(const struct writing *writing);

/* Write a flat document, whose surfaces have the format's model, to files. false after reporting an
 * error. */
bool gltf_write(struct writing *writing, const struct flat *flat);
bool gltf_write_binary(struct writing *writing, const struct flat *flat);

#endif
