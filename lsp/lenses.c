// SPDX-License-Identifier: Apache-2.0
/*
 * A line over each material: figures of its shader, which the editor asks for when it shows them,
 * and the client's command that renders.
 */
#include "lsp/check_document.h"
#include "lsp/handlers.h"
#include "lsp/query.h"
#include "lsp/wire.h"

#include <mxgen/reflection.h>
#include <string.h>

static void add_lenses(const struct lsp_query *query, uint32_t material, json_t *list)
{
    struct lsp_session *session = query->session;
    json_t *name = wire_span(query->text, query_value(query, material, "name")),
           *range = wire_range(session, query->text, query->model->elements[material].name);
    json_array_append_new(list, json_pack("{s:O, s:{s:s, s:O}}", "range", range, "data", "uri",
                                          query->document->uri, "name", name));
    if (session->render_command)
        json_array_append_new(list,
                              json_pack("{s:O, s:{s:s, s:s, s:[s, O]}}", "range", range, "command",
                                        "title", "render", "command", session->render_command,
                                        "arguments", query->document->uri, name));
    json_decref(range);
    json_decref(name);
}

json_t *handle_lenses(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    if (!lsp_query(session, params, &query, error))
        return NULL;
    uint32_t root = query_root(&query);
    json_t *list = json_array();
    for (uint32_t child = root == MODEL_NONE ? root : model_first(query.model, root);
         child != MODEL_NONE; child = model_next(query.model, child)) {
        struct span name = query_value(&query, child, "name");
        if (!query_equals(query.text, query_value(&query, child, "type"), "material")
            || name.start == name.end)
            continue;
        add_lenses(&query, child, list);
    }
    return list;
}

/* The textures of the document: those of the environment belong to no element. */
static uint32_t count_textures(const mxg_result *result)
{
    uint32_t num = 0;
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_variable variable = MXG_INIT(mxg_variable);
        num += mxg_result_variable(result, i, &variable) == MXG_OK
               && variable.block == MXG_BLOCK_TEXTURES && *variable.path;
    }
    return num;
}

/* The figures of the shader in GLSL with the values of the document, or why there are none. */
static json_t *describe(const struct lsp_document *document, const char *name)
{
    mxg_result *result = NULL;
    mxg_options *options = NULL;
    mxg_shader_info info = MXG_INIT(mxg_shader_info);
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "glsl";
    desc.element = name;
    desc.without_source = true;
    bool is_made = document && document->check && document->parsed
                   && mxg_options_create(document->check->context, &options) == MXG_OK
                   && mxg_options_set(options, "interface", "reduced") == MXG_OK;
    desc.options = options;
    is_made = is_made
              && mxg_generate(document->check->context, document->parsed, &desc, &result) == MXG_OK
              && mxg_result_info(result, &info) == MXG_OK;
    uint32_t num_textures = is_made ? count_textures(result) : 0;
    json_t *title =
        is_made ? json_sprintf("shader: %u closure%s, %u texture%s", (unsigned)info.num_closures,
                               info.num_closures == 1 ? "" : "s", (unsigned)num_textures,
                               num_textures == 1 ? "" : "s")
                : json_string("shader: none, because of errors");
    mxg_result_destroy(result);
    mxg_options_destroy(options);
    return title;
}

json_t *handle_lens(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    const json_t *data = json_object_get(params, "data"), *range = json_object_get(params, "range");
    const struct lsp_document *document = lsp_find_document(session, json_text_of(data, "uri"));
    if (!document || !range) {
        *error = (struct lsp_error){LSP_INVALID_PARAMS, "the lens belongs to no open document"};
        return NULL;
    }
    return json_pack("{s:O, s:{s:o, s:s}}", "range", range, "command", "title",
                     describe(document, json_text_of(data, "name")), "command", "");
}
