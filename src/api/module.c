// SPDX-License-Identifier: Apache-2.0
/*
 * The module of a language with the functions of libraries that are the same in every shader, as a
 * result (docs/mdl.md).
 */
#include "api/generation.h"

/* A generation has an element: this one has no part in the module. */
static const char document_text[] =
    "<materialx version=\"1.39\"><constant name=\"module\" type=\"float\"/></materialx>";

static void generate(struct generation *g)
{
    struct shader *shader = &g->result->shader;
    if (!generation_start(g) || !generation_has_module(g) || !generation_finish(g))
        return;
    shader_become_module(shader);
    shader->reflection.name = shader->reflection.path =
        str_intern_z(shader->strings, shader->module.name);
    shader->reflection.element_type = str_intern_z(shader->strings, "module");
    g->result->has_shader = !g->desc.only_diagnostics && generation_spell(g);
}

mxg_status mxg_generate_module(mxg_context *context, mxg_library *library,
                               const mxg_generate_desc *desc, mxg_result **out_result)
{
    if (out_result)
        *out_result = NULL;
    mxg_generate_desc full;
    if (!context || !generation_names_target(desc) || !struct_read(&full, sizeof full, desc)
        || full.element || full.bindings || full.without_source)
        return MXG_ERROR_ARGUMENT;
    mxg_document *document;
    mxg_status status = mxg_document_parse(context, library, "module.mtlx", document_text,
                                           sizeof document_text - 1, &document);
    if (status == MXG_OK) {
        full.size = sizeof full;
        full.element = "module";
        status = generation_run(context, document, &full, generate, NULL, out_result);
    }
    mxg_document_destroy(document);
    return status;
}
