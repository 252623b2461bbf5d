// SPDX-License-Identifier: Apache-2.0
/*
 * Prints the bindings of a material: uniforms with their defaults and user interface, textures,
 * vertex attributes.
 *
 *     reflection MATERIAL.mtlx [TARGET]
 */
#include <mxgen/mxgen.h>

#include <stdio.h>

static const char *const block_names[MXG_NUM_BLOCKS] = {
    [MXG_BLOCK_PUBLIC_UNIFORMS] = "public uniforms",
    [MXG_BLOCK_PRIVATE_UNIFORMS] = "private uniforms",
    [MXG_BLOCK_LIGHT_DATA] = "light data",
    [MXG_BLOCK_TEXTURES] = "textures",
    [MXG_BLOCK_APP_DATA] = "vertex attributes",
    [MXG_BLOCK_VERTEX_DATA] = "vertex to pixel stage",
    [MXG_BLOCK_OUTPUTS] = "outputs",
    [MXG_BLOCK_OWN_1] = "first block of nodes in C",
    [MXG_BLOCK_OWN_2] = "second block of nodes in C",
    [MXG_BLOCK_OWN_3] = "third block of nodes in C",
    [MXG_BLOCK_OWN_4] = "fourth block of nodes in C",
};

static void print_variable(const mxg_variable *v)
{
    printf("  %s %s", v->type, v->name);
    if (v->array_length)
        printf("[%u]", v->array_length);
    for (uint32_t i = 0; i < v->num_values; ++i)
        printf("%s%g", i ? ", " : " = ", (double)v->values[i]);
    if (v->path[0])
        printf("   from %s", v->path);
    if (v->file[0])
        printf("   file '%s'", v->file);
    if (v->uiname[0])
        printf("   shown as '%s'", v->uiname);
    if (v->uimin[0] || v->uimax[0])
        printf(" from %s to %s", v->uimin[0] ? v->uimin : "…", v->uimax[0] ? v->uimax : "…");
    printf("\n");
}

static void print_block(const mxg_result *result, mxg_block block)
{
    bool any = false;
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_variable v = MXG_INIT(mxg_variable);
        if (mxg_result_variable(result, i, &v) != MXG_OK || v.block != block)
            continue;
        if (!any)
            printf("%s\n", block_names[block]);
        any = true;
        print_variable(&v);
    }
}

static void print_compiled(const mxg_result *result)
{
    for (uint32_t i = 0; i < mxg_result_num_compiled_inputs(result); ++i) {
        mxg_compiled_input input = MXG_INIT(mxg_compiled_input);
        if (mxg_result_compiled_input(result, i, &input) == MXG_OK)
            printf("%s%s %s = %s\n", i ? "  " : "compiled in, a change needs a new shader\n  ",
                   input.type, input.path, input.value);
    }
}

static void print_diagnostics(const mxg_diagnostics *list)
{
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); ++i) {
        char text[1024];
        mxg_diagnostics_format(list, i, NULL, 0, false, text, sizeof text);
        fprintf(stderr, "%s\n", text);
    }
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fputs("usage: reflection MATERIAL.mtlx [TARGET]\n", stderr);
        return 2;
    }
    mxg_context *context = NULL;
    mxg_document *document = NULL;
    mxg_result *result = NULL;
    if (mxg_context_create(NULL, &context) != MXG_OK)
        return 1;
    mxg_library *library = mxg_library_builtin(context);
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = argc > 2 ? argv[2] : "glsl";
    mxg_status status = mxg_document_load(context, library, argv[1], &document);
    print_diagnostics(mxg_document_diagnostics(document));
    if (status == MXG_OK) {
        status = mxg_generate(context, document, &desc, &result);
        print_diagnostics(mxg_result_diagnostics(result));
    }
    for (int block = 0; status == MXG_OK && block < MXG_NUM_BLOCKS; ++block)
        print_block(result, (mxg_block)block);
    if (status == MXG_OK)
        print_compiled(result);
    mxg_result_destroy(result);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return status == MXG_OK ? 0 : 1;
}
