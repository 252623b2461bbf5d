// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen bake: a document whose inputs are values and images, from one with graphs. bake.c runs it,
 * bake_folder.c for many, bake_plan.c finds the inputs, bake_needs.c what they read, bake_draw.c
 * draws them, bake_image.c writes images, bake_keep.c keeps those that stay, bake_document.c writes
 * the document, and bake_looks.c its looks.
 */
#ifndef MXG_RENDER_BAKE_H
#define MXG_RENDER_BAKE_H

#include "program/bake_options.h"
#include "program/batch.h"
#include "render/bake_plan.h"
#include "render/bake_surface.h"
#include "render/picture.h"
#include "render/texel_spool.h"

struct baking {
    struct cli cli;
    struct bake_options options;
    const char *path; /* of the document */
    const mxg_document *document;
    const mxg_document *source; /* of which the document was made; NULL: it is the file itself */
    const char *const *spaces;  /* as in the plan */
    bool keeps_places;
    bool draws_missing;
    bool has_plain_tile; /* a set of the tile 1001 alone becomes an image that repeats */
    struct bake_plan plan;
    struct bake_surface surface;
    struct painter painter;
    struct outputs files;
    struct batch written;
    size_t num_images; /* files */
    const char *space; /* the working colour space */
    bool is_709;       /* it has the primaries of srgb_texture */
    bool has_told_overlap;
    uint32_t errors_before; /* of other documents */
};

int bake_main(int argc, char **argv);

/*
 * For programs that bake on their own: sets `path` and what baking needs of the options of
 * generation. baking->cli and baking->options are filled.
 */
void bake_begin(struct baking *baking, const char *path);
/*
 * Bakes a loaded document into the folder of the options, where the new one gets the name
 * bake_document_name. false after reporting an error; the folder is then as it was.
 */
bool bake_document(struct baking *baking, const mxg_document *document);
/* "flat/wall.mtlx". The caller frees it. */
char *bake_document_name(const struct baking *baking);
/*
 * Bakes all documents below a folder, each into the same place below the folder of the options;
 * those below the latter are none of them. A document that fails does not stop the others, and one
 * without renderables is left out.
 */
void bake_folder(struct baking *baking, const char *folder);
/* Frees all but baking->cli. */
void bake_finish(struct baking *baking);

/* Generates an element without its source. NULL: it has errors, which `tells` reports. */
mxg_result *bake_generate(struct baking *baking, const char *path, bool tells);
/* The components of a type; 0: no image has it. */
uint32_t bake_channels(const char *type);
/* The tiles for which a drawing is drawn. */
const struct bake_tiles *bake_tiles_of(const struct baking *baking,
                                       const struct bake_drawing *drawing);
/* Fills needs, largest and tiles; false after reporting an error. */
bool bake_find_needs(struct baking *baking, struct bake_drawing *drawing);
/* The side that an <output> asks for by width and height, if its image can have it; 0: none. */
uint32_t bake_asked_size(const struct baking *baking, const struct bake_drawing *drawing);
/* Draws all that the plan draws, and writes their images. false after reporting an error. */
bool bake_draw(struct baking *baking);

/*
 * Makes of a drawing, with one spool for each of its tiles, a value or images,
 * and writes these. false after reporting an error.
 */
bool bake_finish_drawing(struct baking *baking, struct bake_drawing *drawing,
                         const struct spool *spools, uint32_t num_spools);

/*
 * The place of an element in the file of the user: "wall.mtlx:3:5", or the file alone where it does
 * not have the element. The caller frees it.
 */
char *bake_place(const struct baking *baking, mxg_element element);
/*
 * Looks for the files of images that stay, and copies them where the user wants it. false after
 * reporting an error.
 */
bool bake_keep_files(struct baking *baking);

/*
 * Copies an element to the new document; names of files are relative to that. Changes no names.
 */
void bake_copy(const struct baking *baking, mxg_edit *edit, mxg_element element);
/* Adds the looks to the new document, which has its materials. */
void bake_add_looks(struct baking *baking, mxg_edit *edit);

/* The new document as XML. NULL after reporting an error. The caller frees it. */
char *bake_write_document(struct baking *baking, size_t *out_size);

#endif
