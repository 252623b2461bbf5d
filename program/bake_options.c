// SPDX-License-Identifier: Apache-2.0
#include "program/bake_options.h"

#include <stdint.h>
#include <string.h>

size_t bake_args(struct bake_options *options, struct arg args[MAX_BAKE_ARGS])
{
    const struct arg table[] = {
        {"output", 'o', ARG_PATH, "DIR", "folder for the document and its images",
         &options->output},
        {"element", 'e', ARG_TEXT, "PATH", "path of the material to bake (default: all materials)",
         &options->element},
        {"mesh", 'm', ARG_TEXT, "NAME|FILE",
         "the surface: its texture coordinates, positions, normals and properties; ball, sphere, "
         "plane, cube, cloth, or a file such as OBJ, glTF or .usda (default: texture coordinates "
         "from 0 to 1, and nothing else)",
         &options->mesh},
        {"size", 's', ARG_SIZE, "N",
         "side of an image in texels (default: that the <output> asks for, of the largest texture "
         "that the graph reads, or 1024)",
         &options->size, .low = BAKE_MIN_SIZE, .high = BAKE_MAX_SIZE},
        {"samples", 0, ARG_SIZE, "N", "samples of a texel along each axis (default: 1)",
         &options->samples, .low = 1, .high = 16},
        {"format", 'f', ARG_TEXT, "png|exr|jpg",
         "format of images (default: png for values from 0 to 1, otherwise exr)", &options->format},
        {"depth", 0, ARG_SIZE, "BITS",
         "bits of a number: 8 or 16 in png (default: 8); 16 or 32 in exr (default: 16 for colors "
         "up to 65504, otherwise 32); 8 in jpg",
         &options->depth, .low = 8, .high = 32},
        {"padding", 0, ARG_SIZE, "N",
         "texels around the triangles of a mesh that take the nearest color (default: 16)",
         &options->padding, .high = 256},
        {"copy", 0, ARG_FLAG, NULL, "copies the files of images that stay to DIR", &options->copy},
        {"missing-texture", 0, ARG_TEXT, "error|checker",
         "for a missing texture: fail, or bake a checker (default: error)",
         &options->missing_texture},
        {"frame", 0, ARG_SIZE, "N", "frame of what changes with time (default: 33)",
         &options->frame, .high = INT32_MAX},
    };
    _Static_assert(sizeof table / sizeof *table <= MAX_BAKE_ARGS, "more options than room");
    memcpy(args, table, sizeof table);
    return sizeof table / sizeof *table;
}
