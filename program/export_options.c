// SPDX-License-Identifier: Apache-2.0
#include "program/export_options.h"

#include <string.h>

/* True for an option of bake that export has, too. */
static bool is_shared(const struct arg *arg)
{
    static const char *const shared[] = {"element",         "mesh",  "size", "samples", "padding",
                                         "missing-texture", "frame", NULL};
    return args_is_one_of(arg->name, shared);
}

size_t export_args(struct export_options *options, struct arg args[MAX_EXPORT_ARGS])
{
    struct arg of_bake[MAX_BAKE_ARGS];
    size_t num_of_bake = bake_args(&options->bake, of_bake), num = 0;
    args[num++] = (struct arg){
        "output", 'o', ARG_PATH, "FILE", "the file: .glb, .gltf, .usda or .usdz", &options->output};
    args[num++] = (struct arg){
        "stage",
        0,
        ARG_TEXT,
        "FILE",
        "the objects of a stage, each with the material that looks give it, in place of an object "
        "for each material; .usda, or a file such as glTF",
        &options->stage};
    args[num++] = (struct arg){"look",
                               0,
                               ARG_TEXT,
                               "NAME",
                               "the look for --stage (default: all; glTF has them as variants)",
                               &options->look};
    for (size_t i = 0; i < num_of_bake; ++i)
        if (num < MAX_EXPORT_ARGS && is_shared(&of_bake[i]))
            args[num++] = of_bake[i];
    return num;
}
