// SPDX-License-Identifier: Apache-2.0
/*
 * A host that stores documents outside the file system (here: in a table) provides a resolver. The
 * resolver maps references to names and bytes, and releases them. The program prints the pixel
 * stage of a material that consists of three "files".
 */
#include <mxgen/mxgen.h>

#include <stdio.h>
#include <string.h>

static const struct asset {
    const char *name, *text;
} assets[] = {
    {"asset:material",
     "<materialx version='1.39' xmlns:xi='http://www.w3.org/2001/XInclude'>"
     "  <xi:include href='node'/>"
     "  <nodegraph name='NG'>"
     "    <texcoord name='uv' type='vector2'/>"
     "    <stripes name='s' type='float'><input name='in' type='vector2' nodename='uv'/></stripes>"
     "    <output name='out' type='float' nodename='s'/>"
     "  </nodegraph>"
     "</materialx>"},
    {"asset:node", "<materialx version='1.39'>"
                   "  <nodedef name='ND_stripes' node='stripes'>"
                   "    <input name='in' type='vector2'/><output name='out' type='float'/>"
                   "  </nodedef>"
                   "  <implementation name='IM_stripes' nodedef='ND_stripes' file='stripes.glsl' "
                   "function='stripes'/>"
                   "</materialx>"},
    {"asset:stripes.glsl", "float stripes(vec2 p) { return step(0.5, fract(10.0 * p.x)); }"},
};

/* All names are absolute, so `from` does not matter. */
static bool open_asset(void *user_data, const char *from, const char *ref, mxg_blob *out_blob,
                       const char **out_reason)
{
    int *num_open = user_data;
    (void)from;
    const char *name = strncmp(ref, "asset:", 6) == 0 ? ref + 6 : ref;
    for (size_t i = 0; i < sizeof assets / sizeof *assets; ++i) {
        if (strcmp(assets[i].name + 6, name) != 0)
            continue;
        *out_blob = (mxg_blob){assets[i].name, assets[i].text, strlen(assets[i].text), NULL};
        ++*num_open;
        return true;
    }
    *out_reason = "there is no such asset";
    return false;
}

static void release_asset(void *user_data, mxg_blob *blob)
{
    int *num_open = user_data;
    (void)blob;
    --*num_open;
}

int main(void)
{
    int num_open = 0;
    const mxg_resolver resolver = {&num_open, open_asset, release_asset, NULL};
    mxg_context_desc context_desc = MXG_CONTEXT_DESC_INIT;
    context_desc.resolver = &resolver;
    mxg_context *context = NULL;
    mxg_document *document = NULL;
    mxg_result *result = NULL;
    if (mxg_context_create(&context_desc, &context) != MXG_OK)
        return 1;
    mxg_library *library = mxg_library_builtin(context);
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "glsl";
    mxg_status status = mxg_document_load(context, library, "asset:material", &document);
    if (status == MXG_OK)
        status = mxg_generate(context, document, &desc, &result);
    const char *source = mxg_result_source(result, MXG_STAGE_PIXEL, NULL);
    puts(source ? source : mxg_status_string(status));
    mxg_result_destroy(result);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return status == MXG_OK && num_open == 0 ? 0 : 1;
}
