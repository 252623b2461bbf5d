// SPDX-License-Identifier: Apache-2.0
/*
 * Documents of the materials of glTF files: the way back from export/. import.c has the whole,
 * material.c the surfaces, members.c the types of their JSON, texture_nodes.c the nodes of
 * textures, images.c their files, variants.c looks. The table program/gltf_inputs.h says where each
 * input comes from.
 */
#ifndef MXG_IMPORT_IMPORT_H
#define MXG_IMPORT_IMPORT_H

#include "import/gltf_source.h"
#include "program/batch.h"
#include "program/gltf_inputs.h"
#include "program/name_table.h"
#include "program/output_files.h"

#include <mxgen/document.h>

struct importing {
    struct cli *cli;
    struct gltf_source source;
    const char *output; /* the path of the document */
    char *folder;       /* its folder, as relocate_folder gives it */
    mxg_edit *edit;
    struct batch files; /* the document and its images */
    struct outputs outputs;
    struct import_image {
        char *name; /* as the document names it; NULL: it cannot be used */
        bool is_tried;
    } * images; /* by index */
    size_t num_images;
    char **materials; /* names of their elements, by index */
    size_t num_materials;
    struct name_table numbers; /* the last number behind each name that is wanted more than once */
};

/* A material while it is made. */
struct import_material {
    struct importing *importing;
    const json_t *json;
    const char *name;  /* of its element, for messages */
    mxg_element graph; /* a nodegraph for its textures; 0: there is none yet */
};

/*
 * Writes a document with the materials of a file of glTF, and its images beside it. Errors and
 * losses go to the report.
 */
void import_document(struct cli *cli, const char *path, const char *output);

/* Tells that the document lacks something: "'Glass' of 'a.glb' …". */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
void import_tell_loss(struct importing *importing, const char *of, const char *format, ...);

/*
 * `wanted`, or with a number behind it, as long as that is taken. Names of one `scope` are taken
 * together. The next of many equal names continues with the next number. The caller frees it.
 */
char *import_free_name(struct importing *importing, const char *scope, const char *wanted,
                       bool (*is_taken)(void *user_data, const char *name), void *user_data);
/* A valid name that no element below `parent` has. The caller frees it. */
char *import_name(struct importing *importing, mxg_element parent, const char *wanted);

/* Writes a file of the folder. false after reporting an error. */
bool import_write_file(struct importing *importing, const char *name, const void *data,
                       size_t size);

/* images.c: the file of an image as the document names it; NULL after telling a loss, once. */
const char *import_image(struct importing *importing, size_t index);

/* The sets of texture coordinates that a document may name. */
enum { IMPORT_MAX_TEXCOORD = 255 };
/* members.c: tells what is not as glTF has it, and so does not count. */
void import_check_members(struct importing *importing, const char *of, const json_t *material);

/* material.c: adds a material. Returns its name, which the caller frees. */
char *import_add_material(struct importing *importing, size_t index);
/* variants.c: looks, if the file has variants. */
void import_add_looks(struct importing *importing);

/* ---- texture_nodes.c: the nodes of a texture, which stand in the graph of the material ---- */

/* An output of a node; NULL: the only one. */
struct import_port {
    mxg_element node; /* 0: nothing */
    const char *output;
};

/*
 * The texels of a texture as the row wants them, times `factor`, which has row->count numbers.
 * `info` refers to the texture: "baseColorTexture". `color` is that of baseColorFactor. A node of 0
 * after telling a loss.
 */
struct import_port import_texture(struct import_material *material, const struct gltf_input *row,
                                  const json_t *info, const float *factor, const float color[4]);
/* A node of the graph. */
mxg_element import_node(struct import_material *material, const char *category, const char *name,
                        const char *type);

#endif
