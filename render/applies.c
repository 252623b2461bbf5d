// SPDX-License-Identifier: Apache-2.0
#include "render/applies.h"

#include "program/render_options.h"

#include <stdlib.h>
#include <string.h>

static const struct {
    const char *option;
    unsigned facts;     /* one of them must be true */
    const char *reason; /* the reason if none is */
} rules[] = {
    {"mesh", FACT_STUDIO, "only the scene 'studio' takes a mesh"},
    {"camera", FACT_STUDIO, "only the scene 'studio' has a camera that moves"},
    {"turntable", FACT_STUDIO, "only the scene 'studio' has a camera that moves"},
    {"path-trace", FACT_STUDIO, "paths are traced only in the scene 'studio'"},
    {"environment", FACT_STUDIO | FACT_NO_MAP, "only the scene 'studio' takes a map"},
    {"environment", FACT_RASTER | FACT_NOT_PREFILTERED,
     "--path-trace traces the environment as it is, not prefiltered"},
    {"background", FACT_PICTURE, "a grid prints values and has no background"},
    {"background", FACT_DISPLAY, "EXR and HDR files have no background"},
    {"output", FACT_PICTURE, "a grid prints its values to standard output"},
    {"copy", FACT_PICTURE, "a grid prints its values to standard output"},
    {"copy", FACT_ONE_PICTURE, "it copies a single picture, not a sheet or a turntable"},
    {"turntable", FACT_ONE_FILE, "a turntable shows one element of one document"},
    {"scene", FACT_ONE_FILE | FACT_PICTURE, "a grid has the values of one document"},
    {"path-trace", FACT_STILL, "a turntable is a raster"},
    {"role", FACT_RASTER, "--path-trace selects the role"},
    {"role", FACT_DRAWN,
     "the roles raster, path and deferred are drawn; --path-trace traces paths"},
    {"paths", FACT_TRACED, "it needs --path-trace"},
    {"bounces", FACT_TRACED, "it needs --path-trace"},
    {"picks", FACT_TRACED, "it needs --path-trace"},
    {"as-drawn", FACT_TRACED, "it needs --path-trace"},
    {"samples", FACT_SAMPLED,
     "only a raster with --environment importance samples the environment"},
    {"quality", FACT_SAMPLED,
     "only a raster with --environment importance samples the environment"},
    {"element", FACT_NO_STAGE, "the look selects the materials of a stage"},
    {"element", FACT_NO_LOOK, "--look selects the elements"},
    {"stage", FACT_STUDIO, "only the scene 'studio' takes a stage"},
    {"stage", FACT_ONE_FILE, "a stage takes one document"},
    {"mesh", FACT_NO_STAGE, "the stage has the meshes"},
    {"turntable", FACT_NO_STAGE, "a turntable shows one element"},
    {"set", FACT_NO_STAGE, "a stage has many shaders; change the document"},
    {"show", FACT_SHOWN, "slots and weights need --stage, the other views --role deferred"},
    {"layer-sample", FACT_STAGE, "only a stage has stacks of layers"},
    {"layer-sample", FACT_RASTER, "--path-trace picks layers by itself"},
    {"mattes", FACT_STAGE, "only a stage has slots"},
    {"mattes", FACT_CHANNELS, "only EXR files have channels for the AOVs"},
    {"aovs", FACT_CHANNELS, "only EXR files have channels for the AOVs"},
    {"aovs", FACT_ONE_PICTURE, "sheets and turntables have no AOVs"},
    {"max-outputs", 0, "AOVs are drawn as many as the device has attachments for"},
    {"ambient-occlusion", FACT_RASTER, "--path-trace traces it"},
    {"solo", FACT_STAGE, "only a stage has slots"},
    {"mute", FACT_STAGE, "only a stage has slots"},
    {"purpose", FACT_STAGE, "only a stage has bindings for purposes"},
};

bool applies_all(const struct arg_parser *parser, unsigned facts)
{
    for (size_t i = 0; i < sizeof rules / sizeof *rules; ++i) {
        if ((facts & rules[i].facts) || !args_is_given(parser, rules[i].option))
            continue;
        fprintf(stderr, "mxgen: option '--%s' does not apply: %s\n", rules[i].option,
                rules[i].reason);
        return false;
    }
    return true;
}

bool applies_alone(const struct arg_parser *parser, const char *const *used)
{
    struct render_options options = RENDER_OPTIONS_DEFAULTS;
    struct arg args[MAX_RENDER_ARGS];
    struct arg_list names = {0};
    size_t num_args = render_args(&options, args);
    for (size_t i = 0; i < num_args; ++i)
        if (!args_is_one_of(args[i].name, used))
            args_append(&names, args[i].name);
    for (size_t i = 0; i < parser->num_settings; ++i)
        args_append(&names, parser->settings[i].key);
    size_t at = 0;
    while (at < names.len && !args_is_given(parser, names.items[at]))
        ++at;
    if (at < names.len)
        fprintf(stderr, "mxgen: option '--%s' does not apply: --%s renders nothing\n",
                names.items[at], used[0]);
    bool good = at == names.len;
    free(names.items);
    return good;
}
