// SPDX-License-Identifier: Apache-2.0
#include "bind/preview.h"

static const struct preview_shader shaders[] = {
    {"UsdPreviewSurface", "ND_UsdPreviewSurface_surfaceshader"},
    {"UsdUVTexture", "ND_image_color4"},
    {"UsdTransform2d", "ND_UsdTransform2d"},
    {"UsdPrimvarReader_float", "ND_UsdPrimvarReader_float"},
    {"UsdPrimvarReader_float2", "ND_UsdPrimvarReader_vector2"},
    {"UsdPrimvarReader_float3", "ND_UsdPrimvarReader_vector3"},
    {"UsdPrimvarReader_float4", "ND_UsdPrimvarReader_vector4"},
    {"UsdPrimvarReader_int", "ND_UsdPrimvarReader_integer"},
    {"UsdPrimvarReader_string", "ND_UsdPrimvarReader_string"},
    {"UsdPrimvarReader_normal", "ND_UsdPrimvarReader_vector3"},
    {"UsdPrimvarReader_point", "ND_UsdPrimvarReader_vector3"},
    {"UsdPrimvarReader_vector", "ND_UsdPrimvarReader_vector3"},
};

/* A texture is an image, whose colours are decoded before the scale and bias of usd_shaders.c. */
static const struct preview_input inputs[] = {
    {"UsdPreviewSurface", "opacityMode", "opacityMode", NULL, true, NULL},
    {"UsdPreviewSurface", "displacement", NULL, NULL, false, NULL}, /* a node of its own */
    /* without a connection the input of MaterialX is a property of the geometry */
    {"UsdUVTexture", "st", "texcoord", NULL, false, "ND_constant_vector2"},
    {"UsdUVTexture", "wrapS", "uaddressmode", "constant", true, NULL},
    {"UsdUVTexture", "wrapT", "vaddressmode", "constant", true, NULL},
    {"UsdUVTexture", "fallback", "default", "0, 0, 0, 1", false, NULL},
    {"UsdUVTexture", "scale", NULL, NULL, false, NULL},
    {"UsdUVTexture", "bias", NULL, NULL, false, NULL},
    {"UsdUVTexture", "sourceColorSpace", NULL, NULL, true, NULL},
};

/* Nobody reads the wrapping that a file may have, so useMetadata is black, as without metadata. */
static const struct preview_token tokens[] = {
    {"opacityMode", "transparent", "0"},
    {"opacityMode", "presence", "1"},
    {"wrapS", "black", "constant"},
    {"wrapS", "clamp", "clamp"},
    {"wrapS", "repeat", "periodic"},
    {"wrapS", "mirror", "mirror"},
    {"wrapS", "useMetadata", "constant"},
    {"wrapT", "black", "constant"},
    {"wrapT", "clamp", "clamp"},
    {"wrapT", "repeat", "periodic"},
    {"wrapT", "mirror", "mirror"},
    {"wrapT", "useMetadata", "constant"},
    {"sourceColorSpace", "auto", ""},
    {"sourceColorSpace", "raw", "none"},
    {"sourceColorSpace", "sRGB", "srgb_texture"},
};

const struct preview_shader *preview_find(struct text_word id)
{
    for (size_t i = 0; i < sizeof shaders / sizeof *shaders; i++)
        if (usda_is(id, shaders[i].id))
            return &shaders[i];
    return NULL;
}

const struct preview_input *preview_next_input(const struct preview_shader *shader,
                                               const struct preview_input *at)
{
    const struct preview_input *end = inputs + sizeof inputs / sizeof *inputs;
    for (at = at ? at + 1 : inputs; at < end; at++)
        if (strcmp(at->id, shader->id) == 0)
            return at;
    return NULL;
}

const struct preview_input *preview_find_input(const struct preview_shader *shader,
                                               struct text_word name)
{
    const struct preview_input *at = NULL;
    while ((at = preview_next_input(shader, at)) && !usda_is(name, at->input))
        continue;
    return at;
}

const struct preview_token *preview_next_token(const char *input, const struct preview_token *at)
{
    const struct preview_token *end = tokens + sizeof tokens / sizeof *tokens;
    for (at = at ? at + 1 : tokens; at < end; at++)
        if (strcmp(at->input, input) == 0)
            return at;
    return NULL;
}
