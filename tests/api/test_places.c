// SPDX-License-Identifier: Apache-2.0
/*
 * Elements where they do not belong: every kind of element at the top of a document, and in every
 * other kind, with connections of every kind, to something and to nothing. Each document is told
 * what is wrong, or is right; none is a crash, in validation or in generation.
 */
#include <mxgen/mxgen.h>

#include <stdio.h>
#include <string.h>

static const char *const kinds[] = {
#define KIND(name, text) #text,
#include "src/document/kinds.def"
#undef KIND
    "constant",
    "surfacematerial",
    "standard_surface",
    "unheard_of",
};
enum { NUM_KINDS = sizeof kinds / sizeof *kinds };

static const char *const connections[] = {
    "value='1'",        "nodename='n'",      "nodename='none'",      "nodegraph='g' output='out'",
    "nodegraph='none'", "interfacename='i'", "interfacename='none'", "output='o'",
    "output='none'",    "nodedef='D'",       "inherit='x'",          "nodename='x'",
};
enum { NUM_CONNECTIONS = sizeof connections / sizeof *connections };

static unsigned documents, silent;

/* The sound part of a document is generated; errors of the rest are told. */
static void generate_all(mxg_context *context, const mxg_document *document)
{
    for (uint32_t i = 0; i < mxg_document_num_renderables(document); ++i) {
        mxg_renderable renderable = {sizeof renderable};
        mxg_document_renderable(document, i, &renderable);
        mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
        mxg_result *result = NULL;
        desc.target = "glsl";
        desc.element = renderable.path;
        mxg_status status = mxg_generate(context, document, &desc, &result);
        silent +=
            status != MXG_OK && mxg_diagnostics_num_items(mxg_result_diagnostics(result)) == 0;
        mxg_result_destroy(result);
    }
}

static void try_document(mxg_context *context, mxg_library *library, const char *text)
{
    mxg_document *document = NULL;
    mxg_result *result = NULL;
    mxg_status status =
        mxg_document_parse(context, library, "places.mtlx", text, strlen(text), &document);
    bool told = mxg_diagnostics_num_items(mxg_document_diagnostics(document)) > 0;
    if (document) {
        told |= mxg_validate(context, document, &result) == MXG_OK;
        told |= mxg_diagnostics_num_items(mxg_result_diagnostics(result)) > 0;
        mxg_result_destroy(result);
        generate_all(context, document);
    }
    ++documents;
    silent += status != MXG_OK && !told;
    mxg_document_destroy(document);
}

int main(void)
{
    static const char around[] =
        "<materialx version='1.39'><constant name='n' type='float'/><output name='o' type='float' "
        "nodename='n'/>"
        "<nodegraph name='g'><constant name='n' type='float'/><output name='out' type='float' "
        "nodename='n'/></nodegraph>"
        "<nodedef name='D' node='d'><input name='i' type='float' value='1'/><output name='out' "
        "type='float'/></nodedef>%s</materialx>";
    mxg_context *context = NULL;
    char inner[512], outer[1024], text[2048];
    mxg_context_create(NULL, &context);
    mxg_library *library = mxg_library_builtin(context);
    for (int parent = -1; parent < NUM_KINDS; ++parent)
        for (int child = 0; child < NUM_KINDS; ++child)
            for (int with = 0; with < NUM_CONNECTIONS; ++with) {
                snprintf(inner, sizeof inner, "<%s name='x' type='float' %s/>", kinds[child],
                         connections[with]);
                if (parent >= 0)
                    snprintf(outer, sizeof outer,
                             "<%s name='p' type='float' node='q' nodedef='D'>%s</%s>",
                             kinds[parent], inner, kinds[parent]);
                snprintf(text, sizeof text, around, parent >= 0 ? outer : inner);
                try_document(context, library, text);
            }
    mxg_library_unref(library);
    mxg_context_destroy(context);
    printf("places: %u passed, %u failed, 0 skipped\n", documents - silent, silent);
    return silent ? 1 : 0;
}
