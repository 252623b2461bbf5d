// SPDX-License-Identifier: Apache-2.0
/*
 * Rows without a GPU: the graph of an output is computed at the grid's points by the IR's
 * evaluator, and what it calls by the portable language's. Vertex data is computed as the vertex
 * stage does. Rows that need textures, derivatives or functions that read uniforms are not
 * computed.
 *
 *     test_evaluator FOLDER
 */
#include "api/generation.h"
#include "render/scene.h"
#include "lower/lower.h"
#include "rows.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { INTEGER_ATTRIBUTE = 3, MIN_COMPUTED_PERCENT = 75 };

struct run {
    struct suite suite;
    struct scene scene;
    const struct row *row;
    uint32_t vertex; /* where the evaluator is */
    struct generation *generation;
    bool is_computed; /* the row has values */
    float values[ROW_PIXELS * ROW_MAX_COMPONENTS];
};

/* ---- Sources ---- */

static void from_floats(ir_type_id type, const float *values, struct ir_value *out)
{
    const struct ir_type_info *info = ir_type_info(type);
    out->type = type;
    for (unsigned i = 0; i < info->components; ++i) {
        if (info->scalar == IR_TYPE_FLOAT)
            out->w[i].f = values[i];
        else
            out->w[i].i = (int32_t)values[i];
    }
}

static bool uniform_value(const struct run *run, const struct shader_variable *variable,
                          const char *name, struct ir_value *out)
{
    float values[16] = {0};
    *out = variable->value;
    if (variable->block == BLOCK_PUBLIC_UNIFORMS)
        return variable->has_default;
    if (!scene_uniform(&run->scene, &run->scene.object, name, values))
        return variable->has_default;
    from_floats(variable->type, values, out);
    return true;
}

static bool attribute_value(const struct run *run, const struct shader_variable *variable,
                            const char *name, struct ir_value *out)
{
    float values[4] = {INTEGER_ATTRIBUTE, INTEGER_ATTRIBUTE, INTEGER_ATTRIBUTE, INTEGER_ATTRIBUTE};
    bool is_float = ir_type_info(variable->type)->scalar == IR_TYPE_FLOAT;
    if (is_float && variable->type != IR_TYPE_FLOAT && strncmp(name, "i_texcoord", 10) == 0)
        values[2] = 0.0f; /* the third component, which the grid does not have */
    if (is_float && !scene_attribute(&run->scene.object, name, run->vertex, values))
        return false;
    from_floats(variable->type, values, out);
    return true;
}

static bool evaluate(struct run *run, ir_ref ref, struct ir_value *out);

/* The value that the vertex stage writes to vertex data `index`. */
static bool vertex_data(struct run *run, uint32_t index, struct ir_value *out)
{
    const struct effect_list *effects =
        &run->generation->result->shader.stages[STAGE_VERTEX].effects;
    for (uint32_t i = 0; i < effects->len; ++i)
        if (effects->items[i].kind == EFFECT_OUTPUT && effects->items[i].index == index)
            return evaluate(run, effects->items[i].value, out);
    return false;
}

static bool source(void *user_data, const struct ir_graph *graph, ir_ref ref, struct ir_value *out)
{
    struct run *run = user_data;
    const struct shader *shader = &run->generation->result->shader;
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op != IR_UNIFORM && node->op != IR_STREAM)
        return false;
    const struct shader_variable *variable = &shader->interface.variables.items[node->attr];
    const char *name = str_text(shader->strings, variable->name);
    if (node->op == IR_UNIFORM)
        return uniform_value(run, variable, name, out);
    if (variable->block == BLOCK_APP_DATA)
        return attribute_value(run, variable, name, out);
    return vertex_data(run, node->attr, out);
}

static uint32_t call(void *user_data, const struct ir_graph *graph, ir_ref ref,
                     const struct ir_value *args, struct ir_value *out)
{
    struct run *run = user_data;
    return lang_eval_node(&run->generation->result->unit, graph, ref, args,
                          &(uint32_t){LANG_MAX_STEPS}, &run->generation->scratch, out);
}

/* ---- Rows ---- */

static bool evaluate(struct run *run, ir_ref ref, struct ir_value *out)
{
    const struct ir_eval_env env = {.user_data = run, .source = source, .call = call};
    return ir_eval(&run->generation->result->graph, ref, &env, &run->generation->scratch, out);
}

/* The grid's last vertices are the centres of its pixels. */
static void compute(struct generation *generation)
{
    struct run *run = generation->user_data;
    run->generation = generation;
    if (!generation_start(generation) || !generation_build(generation))
        return;
    float *out = run->values;
    for (uint32_t pixel = 0; pixel < ROW_PIXELS; ++pixel) {
        struct ir_value value;
        run->vertex = run->scene.object.mesh.num_vertices - ROW_PIXELS + pixel;
        if (!evaluate(run, generation->root, &value)
            || ir_type_info(value.type)->components != run->row->components)
            return;
        for (unsigned c = 0; c < run->row->components; ++c)
            *out++ = value.w[c].f;
    }
    run->is_computed = true;
}

static void check_document(struct run *run, mxg_context *context, mxg_library *library,
                           size_t index)
{
    struct row_list list;
    char *path = suite_case_file(&run->suite, index);
    mxg_document *document = NULL;
    bool good = path && mxg_document_load(context, library, path, &document) == MXG_OK;
    if (!suite_read(&run->suite, index, &list))
        ++run->suite.failed;
    for (size_t i = 0; i < list.len; ++i) {
        mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
        mxg_result *result = NULL;
        desc.target = "glsl";
        desc.element = list.items[i].name;
        run->row = &list.items[i];
        run->is_computed = false;
        mxg_status status = good ? generation_run(context, document, &desc, compute, run, &result)
                                 : MXG_ERROR_DOCUMENT;
        if (status == MXG_OK && !run->is_computed)
            suite_skip(&run->suite, &list, run->row);
        else
            suite_judge(&run->suite, &list, run->row, run->is_computed ? run->values : NULL,
                        "the graph cannot be built");
        mxg_result_destroy(result);
    }
    row_list_free(&list);
    mxg_document_destroy(document);
    free(path);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
        return 2;
    }
    struct run run = {.suite = {.folder = argv[1]}};
    mxg_context *context = NULL;
    mxg_library *library = NULL;
    int code = 1;
    if (mxg_context_create(NULL, &context) == MXG_OK
        && (library = mxg_library_builtin(context)) != NULL && scene_init_grid(&run.scene)
        && suite_open(&run.suite, argv[1], NULL)) {
        for (size_t i = 0; i < run.suite.num_documents; ++i)
            check_document(&run, context, library, i);
        size_t computed = run.suite.agree + run.suite.deviate + run.suite.undefined;
        if (computed * 100 < MIN_COMPUTED_PERCENT * (computed + run.suite.skipped)) {
            puts("too few rows are computed");
            ++run.suite.failed;
        }
        code = suite_report(&run.suite, "conformance-evaluator", true);
    }
    suite_close(&run.suite);
    scene_finish(&run.scene);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return code;
}
