// SPDX-License-Identifier: Apache-2.0
/*
 * Materials of a flat document (docs/bake.md), whose surfaces have one model: each input is a
 * value, an image, or a map of normals. Writers of formats stand on this alone.
 */
#ifndef MXG_EXPORT_FLAT_H
#define MXG_EXPORT_FLAT_H

#include "program/cli.h"
#include "program/name_table.h"

#include <mxgen/mxgen.h>

/* How an image repeats outside of the texture coordinates from 0 to 1. */
enum flat_wrap { FLAT_REPEAT, FLAT_CLAMP, FLAT_MIRROR };

struct flat_image {
    char *path;          /* of the file; NULL: there is none */
    unsigned components; /* of its type */
    bool is_srgb;        /* its colours are encoded */
    bool is_closest;     /* its texels are squares */
    enum flat_wrap wrap[2];
    double scale[2], offset[2]; /* from texture coordinates, v upwards, to places in the image */
};

/* True for an image that lies where texture coordinates say. */
bool flat_is_unplaced(const struct flat_image *image);

/* An input that the document sets. */
struct flat_input {
    const char *name;
    mxg_element port;
    struct flat_image image; /* path NULL: `values` */
    float values[4];         /* colours are linear, with the primaries of Rec. 709 */
    unsigned num_values;
    double scale; /* of a map of normals */
};

struct flat_material {
    const char *name;
    mxg_element surface;
    struct flat_input *inputs;
    size_t num_inputs;
};

struct flat {
    struct report *report;
    const char *path;           /* of the document */
    const mxg_document *source; /* of which it was made, for places */
    const char *source_path;

    const mxg_document *document;
    struct flat_material *materials;
    size_t num_materials;
    struct name_table by_name; /* with the numbers of the materials */
};

/*
 * Reads the materials whose surfaces have the model, and surfaces without a material, into `flat`,
 * whose members down to `source_path` are set. What no format has is a warning. false after
 * reporting an error. Call flat_finish in any case.
 */
bool flat_read(struct flat *flat, const mxg_document *document, const char *model);
void flat_finish(struct flat *flat);

/* The number of the material of that name; flat->num_materials: NULL, or there is none. */
size_t flat_find_material(const struct flat *flat, const char *name);

/* The input of that name; NULL: the document does not set it. */
const struct flat_input *flat_find(const struct flat_material *material, const char *name);

/*
 * The place in the user's file of an element of the document, or of the one around it: its path as
 * the document has it. "wall.mtlx:3:5"; without a number where the file has neither. The caller
 * frees it.
 */
char *flat_place(const struct flat *flat, const char *path);
/* Returns the place of an input of a surface; the caller frees it. */
char *flat_input_place(const struct flat *flat, const struct flat_material *material,
                       const char *input);

/* Warns that an input of the material's surface, or a part of it, is not in the file, and why. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void flat_tell_loss(const struct flat *flat, const struct flat_material *material,
                    const char *input, const char *format, ...);

/* The spaces of colors that flat_read knows; NULL after the last. */
extern const char *const flat_spaces[];

/* IEC 61966-2-1 */
float flat_encode_srgb(float linear);
float flat_decode_srgb(float encoded);

#endif
