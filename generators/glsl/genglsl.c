// SPDX-License-Identifier: Apache-2.0
/* Source for genglsl: the helpers and tokens that MaterialX's generators give it. */
#include "generators/glsl/glsl.h"

#include "shader/verbatim.h"

static const struct source_helper helpers[] = {
#define HELPER(name, text) {name, text, NULL},
#define HELPER_OF_1_38(name, text, text_1_38) {name, text, text_1_38},
#include "generators/glsl/helpers.def"
#undef HELPER
#undef HELPER_OF_1_38
};

/* Other tokens are the names of uniforms and streams. */
static const struct source_token tokens[] = {
    {"texSamplerSampler2D", "tex_sampler", NULL},
    {"texSamplerSignature", "sampler2D tex_sampler", NULL},
    {"closureDataConstructor", "ClosureData(closureType, L, V, N, P, occlusion)", NULL},
    {"envRadianceSampler2D", NULL, "envRadiance"},
    {"envIrradianceSampler2D", NULL, "envIrradiance"},
    /* of the albedo method that reads a table, which DIRECTIONAL_ALBEDO_METHOD leaves out */
    {"albedoTable", "u_albedoTable", NULL},
    {"albedoTableSize", "64", NULL},
    {"lightData", "u_lightData", NULL},
    {SOURCE_INSTANCE, "", NULL}, /* "$vd.$normalWorld": the name of a stream has its instance */
};

static const char *const derivatives[] = {"dFdx", "dFdy", "fwidth", "texture"};

_Static_assert(sizeof helpers / sizeof *helpers <= SOURCE_MAX_HELPERS, "a bit for each helper");

const struct source_language glsl_source = {
    .helpers = helpers,
    .num_helpers = sizeof helpers / sizeof *helpers,
    .tokens = tokens,
    .num_tokens = sizeof tokens / sizeof *tokens,
    .derivatives = derivatives,
    .num_derivatives = sizeof derivatives / sizeof *derivatives,
};
