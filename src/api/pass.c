// SPDX-License-Identifier: Apache-2.0
/*
 * The passes of the deferred pipeline that belong to no material, as results. A lighting pass is
 * made from a document of its own, like any surface.
 */
#include "api/generation.h"

#include <assert.h>

uint32_t mxg_catalogue_num_passes(void)
{
    return NUM_PASSES;
}

const char *mxg_catalogue_pass(uint32_t index)
{
    return index < NUM_PASSES ? deferred_pass_name((enum deferred_pass)index) : NULL;
}

static bool is_bound(int block)
{
    return block != BLOCK_APP_DATA && block != BLOCK_VERTEX_DATA && block != BLOCK_OUTPUTS;
}

/* Leaves of the surface what the host binds. */
static void leave_bindings(struct shader *shader)
{
    uint32_t kept = 0;
    for (int block = 0; block < NUM_BLOCKS; block++) {
        uint32_t first = shader->interface.first_of_block[block],
                 end = shader->interface.first_of_block[block + 1];
        shader->interface.first_of_block[block] = kept;
        for (uint32_t i = first; i < end && is_bound(block); i++)
            shader->interface.used.items[kept++] = shader->interface.used.items[i];
    }
    shader->interface.first_of_block[NUM_BLOCKS] = shader->interface.used.len = kept;
    shader->reflection.closures.len = shader->reflection.compiled.len = 0;
}

/* Replaces the source of the surface by the text of the pass, in the language of the texts. */
static void write_text(struct generation *g)
{
    mxg_result *result = g->result;
    struct stage_source *stage = &result->stages[STAGE_PIXEL];
    struct text text;
    const char *version = g->options[OPTION_version].text;
    text_init(&text, &result->object.arena);
    deferred_write_pass(result->pass, &result->storage,
                        *version ? version : result->target->versions[0],
                        g->stored ? &result->shader : NULL, stage->text, &text);
    stage->text = text_cstr(&text);
    stage->size = text.len;
    source_find_lines(stage, &result->object.arena);
}

/* Makes the shader of the surface that the pass lights, or an empty one; false: without a shader.
 */
static bool make_surface(struct generation *g)
{
    return generation_start(g)
           && (g->stored ? generation_build(g) && generation_shade(g) : generation_finish(g));
}

static void generate(struct generation *g)
{
    const enum deferred_pass pass = *(const enum deferred_pass *)g->user_data;
    mxg_result *result = g->result;
    result->pass = pass;
    g->stored = deferred_pass_class(pass);
    g->role = &roles[pass == PASS_LIGHT_RAYS ? ROLE_lighting_rays : ROLE_lighting];
    if (!make_surface(g))
        return;
    result->storage = generation_storage(g);
    bool is_program = result->storage.parse != NULL;
    result->has_shader = deferred_has_pass(pass, &result->storage);
    if (!result->has_shader)
        return;
    if (is_program)
        deferred_add_pass(pass, &result->storage, &result->shader);
    if (is_program || g->stored)
        result->has_shader = generation_spell(g);
    if (!is_program && result->has_shader)
        write_text(g);
    leave_bindings(&result->shader);
}

/* The document of the lighting passes. */
static mxg_status parse_closures(mxg_context *context, mxg_document **out)
{
    const struct mem *mem = &context->mem;
    size_t size = deferred_closures_size();
    char *text = mem->realloc(mem->user_data, NULL, 0, size);
    *out = NULL;
    if (!text)
        return MXG_ERROR_MEMORY;
    deferred_copy_closures(text);
    mxg_status status =
        mxg_document_parse(context, mxg_library_builtin(context), "closures.mtlx", text, size, out);
    mem->realloc(mem->user_data, text, size, 0);
    return status;
}

mxg_status mxg_generate_pass(mxg_context *context, uint32_t index, const mxg_generate_desc *desc,
                             mxg_result **out_result)
{
    if (out_result)
        *out_result = NULL;
    mxg_generate_desc full;
    if (!context || index >= NUM_PASSES || !generation_names_target(desc)
        || !struct_read(&full, sizeof full, desc) || full.element || full.bindings
        || full.without_source)
        return MXG_ERROR_ARGUMENT;
    enum deferred_pass pass = (enum deferred_pass)index;
    mxg_document *document;
    mxg_status status = parse_closures(context, &document);
    if (status == MXG_OK) {
        enum deferred_class which = deferred_pass_class(pass);
        full.size = sizeof full;
        full.element = deferred_element(which ? which : CLASS_SIMPLE);
        status = generation_run(context, document, &full, generate, &pass, out_result);
    }
    mxg_document_destroy(document);
    return status;
}
