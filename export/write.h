// SPDX-License-Identifier: Apache-2.0
/* The run of a writer of a format. */
#ifndef MXG_EXPORT_WRITE_H
#define MXG_EXPORT_WRITE_H

#include "export/flat.h"
#include "export/dressed_site.h"
#include "program/batch.h"
#include "program/output_files.h"
#include "render/bake_surface.h"

struct writing {
    struct cli *cli;
    const char *path;                   /* of the file */
    const struct bake_surface *surface; /* whose objects have each material; NULL: */
    const struct dressed_site *stage;   /* its objects have materials of their own */
    const mxg_document *source;         /* the document of the user, with its graphs */
    const char *source_path;
    struct batch files;
    struct outputs *outputs;
};

/* Adds a file beside `path`. false after reporting an error. */
bool write_beside(struct writing *writing, const char *name, const void *data, size_t size);
/* The name of the file without folder and ending. The caller frees it. */
char *write_stem(const struct writing *writing);
/* The objects of the surface or the stage. */
uint32_t write_num_objects(const struct writing *writing);
const struct scene_object *write_object(const struct writing *writing, uint32_t index);
/* From an object to a world in metres with y upwards. */
struct matrix write_world(const struct writing *writing, const struct scene_object *object);
/* The folder of a file. The caller frees it. */
char *write_folder(const char *path);

/* Each writes a flat document, whose surfaces have the format's model. false after reporting an
 * error. */
bool gltf_write(struct writing *writing, const struct flat *flat);
bool gltf_write_binary(struct writing *writing, const struct flat *flat);
bool usd_write(struct writing *writing, const struct flat *flat);
bool usd_write_package(struct writing *writing, const struct flat *flat);

#endif
