// SPDX-License-Identifier: Apache-2.0
#include "program/render_options.h"

#include <stdint.h>
#include <string.h>

size_t render_args(struct render_options *options, struct arg args[MAX_RENDER_ARGS])
{
    const struct arg table[] = {
        {"output", 'o', ARG_PATH, "FILE", "output picture; the extension selects the format",
         &options->output},
        {"copy", 0, ARG_PATH, "FILE",
         "also writes a single picture to this file, in the format of its extension",
         &options->copy, ARG_MORE},
        {"size", 's', ARG_TEXT, "W[xH]",
         "size in pixels (default: 512, or 160 for each picture of a sheet)", &options->size},
        {"element", 'e', ARG_TEXT, "PATH",
         "path of the element to render (default: the first renderable)", &options->element},
        {"look", 0, ARG_TEXT, "NAME",
         "renders the materials that a look assigns; with --stage, the stage under the look",
         &options->look},
        {"solo", 0, ARG_LIST, "SLOT", "draws only this slot, layer or override of a stage",
         &options->solo, ARG_MORE},
        {"mute", 0, ARG_LIST, "SLOT", "leaves out this slot, layer or override of a stage",
         &options->mute, ARG_MORE},
        {"stage", 0, ARG_TEXT, "FILE",
         "renders a stage, each primitive with its material: a file of USD, glTF, OBJ, ...",
         &options->stage},
        {"list", 0, ARG_FLAG, NULL, "prints the primitives of the stage instead", &options->list,
         ARG_MORE},
        {"purpose", 0, ARG_TEXT, "full|preview",
         "also takes the bindings of the stage for this purpose", &options->purpose, ARG_MORE},
        {"mesh", 'm', ARG_TEXT, "NAME|FILE",
         "ball, sphere, plane, cube, cloth, or a file such as OBJ or glTF (default: ball)",
         &options->mesh},
        {"camera", 0, ARG_TEXT, "AZ,EL[,DIST[,FOV]]|PATH",
         "azimuth and elevation in degrees, distance, field of view (default: 25,16); or a camera "
         "of the stage (default: its first)",
         &options->camera},
        {"environment", 0, ARG_LIST, "FILE|MODE",
         "a latitude-longitude map, or a folder of --bake-environment (default: a sky with three "
         "lights); or a mode: none, prefiltered or importance",
         &options->environments},
        {"bake-environment", 0, ARG_TEXT, "FILE",
         "prefilters a map, or the built-in map 'sky', into the folder of -o", &options->baked,
         ARG_MORE},
        {"bake-occlusion", 0, ARG_PATH, "FILE.usda",
         "writes the ambient occlusion of the meshes of --stage as a layer of USD, and draws "
         "nothing; --paths is the rays of each corner (default: 64)",
         &options->occlusion, ARG_MORE},
        {"background", 0, ARG_TEXT, "NAME",
         "backdrop, environment, or none for transparency (default: backdrop)",
         &options->background},
        {"samples", 0, ARG_SIZE, "N", "samples of the environment for each lobe (default: 32)",
         &options->samples, .low = 1, .high = 65536},
        {"layer-sample", 0, ARG_TEXT, "NUMBER",
         "the number, from 0 to below 1, that picks a layer of each stack with --slots stochastic "
         "(default: another one at each point)",
         &options->layer_sample, ARG_MORE},
        {"set", 0, ARG_LIST, "PATH=VALUE", "sets an input to a value, or a texture to a file",
         &options->settings},
        {"missing-texture", 0, ARG_TEXT, "error|checker",
         "for a missing texture: fail, or draw a checker (default: error)",
         &options->missing_texture},
        {"translate", 0, ARG_TEXT, "MODEL",
         "draws the surfaces as another model: gltf_pbr and others (see mxgen translate)",
         &options->translate, ARG_MORE},
        {"frame", 0, ARG_SIZE, "N",
         "frame, also of images with {frame} in their names (default: 33)", &options->frame,
         .high = INT32_MAX},
        {"path-trace", 0, ARG_FLAG, NULL, "renders by path tracing, as a reference",
         &options->path_trace},
        {"paths", 0, ARG_SIZE, "N", "paths for each pixel (default: 256)", &options->paths,
         ARG_MORE, .low = 1, .high = UINT32_MAX / 256},
        {"bounces", 0, ARG_SIZE, "N", "limit of bounces of a path (default: 32)", &options->bounces,
         ARG_MORE, .low = 1, .high = 64},
        {"picks", 0, ARG_SIZE, "N",
         "how often a path picks a closure where it hits first, with the other random numbers as "
         "they are (default: 1)",
         &options->picks, ARG_MORE, .low = 1, .high = 256},
        {"as-drawn", 0, ARG_FLAG, NULL,
         "path tracing with one bounce and without shadows, for comparison with the raster",
         &options->as_drawn, ARG_MORE},
        {"show", 0, ARG_TEXT, "WHAT",
         "draws something else than the materials. Of a stage, colours by slot: slots, of the slot "
         "with the greatest weight; or weights, blended by weight. With --role deferred, what "
         "is stored: classes, bytes, closures, coverage, transmittance or properties",
         &options->show, ARG_MORE},
        {"turntable", 0, ARG_SIZE, "N",
         "renders N pictures from around, with a number before the extension of FILE",
         &options->frames, .low = 1, .high = 10000},
        {"scene", 0, ARG_TEXT, "studio|sphere|plane|grid",
         "studio; sphere; plane, for patterns; or grid, which prints the values of 4x4 pixels for "
         "each element (default: studio)",
         &options->scene, ARG_MORE},
    };
    _Static_assert(sizeof table / sizeof *table <= MAX_RENDER_ARGS, "more options than room");
    memcpy(args, table, sizeof table);
    return sizeof table / sizeof *table;
}
