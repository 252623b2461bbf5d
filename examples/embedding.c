// SPDX-License-Identifier: Apache-2.0
/*
 * The life of a material in a host, without a graphics API: build, generate, bind, change values,
 * edit, and handle errors. docs/embedding.md explains it step by step.
 *
 *     embedding
 */
#include <mxgen/mxgen.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct host {
    mxg_context *context;
    mxg_library *library;
    mxg_document *document;
    mxg_result *program; /* has the source that the host compiled */
    unsigned char *uniforms;
    size_t uniforms_size;
};

static void print_diagnostics(const mxg_diagnostics *list)
{
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); ++i) {
        char text[1024];
        mxg_diagnostics_format(list, i, NULL, 0, false, text, sizeof text);
        fprintf(stderr, "%s\n", text);
    }
}

/* ---- Documents ---- */

static mxg_status build(struct host *h)
{
    mxg_edit *edit;
    mxg_status status = mxg_edit_create(h->context, h->library, NULL, "copper", &edit);
    if (status != MXG_OK)
        return status;
    mxg_element wood = mxg_edit_add_element(edit, 0, "tiledimage", "Wood", "color3"),
                shader = mxg_edit_add_element(edit, 0, "standard_surface", "SR", "surfaceshader"),
                material = mxg_edit_add_element(edit, 0, "surfacematerial", "Copper", "material");
    const float tiling[] = {4, 4};
    mxg_edit_set_value(edit, wood, "file", NULL, "textures/wood_color.png");
    mxg_edit_set_numbers(edit, wood, "uvtiling", NULL, tiling, 2);
    mxg_edit_set_value(edit, shader, "metalness", NULL, "1");
    mxg_edit_connect_input(edit, shader, "base_color", wood, NULL);
    mxg_edit_connect_input(edit, material, "surfaceshader", shader, NULL);
    char reason[256];
    if (mxg_edit_error(edit, reason, sizeof reason))
        fprintf(stderr, "%s\n", reason);
    status = mxg_edit_commit(edit, &h->document);
    mxg_edit_destroy(edit);
    print_diagnostics(mxg_document_diagnostics(h->document));
    return status;
}

static void list_materials(const mxg_document *document)
{
    for (uint32_t i = 0; i < mxg_document_num_renderables(document); ++i) {
        mxg_renderable renderable = MXG_INIT(mxg_renderable);
        if (mxg_document_renderable(document, i, &renderable) == MXG_OK)
            printf("%s %s\n", renderable.category, renderable.path);
    }
}

static void list_inputs(const mxg_document *document, mxg_element node)
{
    mxg_element_info info = MXG_INIT(mxg_element_info);
    mxg_document_element(document, node, &info);
    printf("%s %s\n", info.category, info.name);
    for (mxg_element input = info.first_child; input; input = info.next) {
        mxg_value value = MXG_INIT(mxg_value);
        mxg_connection connection = MXG_INIT(mxg_connection);
        mxg_element_info source = MXG_INIT(mxg_element_info);
        mxg_document_element(document, input, &info);
        if (mxg_document_value(document, input, &value) == MXG_OK)
            printf("  %s = %s\n", info.name, value.text);
        else if (mxg_document_connection(document, input, &connection) == MXG_OK
                 && mxg_document_element(document, connection.source, &source) == MXG_OK)
            printf("  %s reads %s\n", info.name, source.name);
    }
}

/* ---- Programs ---- */

/* *out is set also after an error: it has the diagnostics. */
static mxg_status generate(struct host *h, const mxg_document *document, bool without_source,
                           mxg_result **out)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "vulkan";
    desc.element = "Copper";
    desc.without_source = without_source;
    mxg_status status = mxg_generate(h->context, document, &desc, out);
    print_diagnostics(mxg_result_diagnostics(*out));
    return status;
}

static void compile(const mxg_result *result)
{
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage) {
        size_t size;
        const char *source = mxg_result_source(result, (mxg_stage)stage, &size);
        if (source)
            printf("a host compiles %s\n", stage == MXG_STAGE_VERTEX ? "vertices" : "pixels");
    }
}

/* ---- Bindings ---- */

static void print_variables(const mxg_result *result, mxg_block number)
{
    mxg_block_info block = MXG_INIT(mxg_block_info);
    if (mxg_result_block(result, number, &block) != MXG_OK || !block.num_variables)
        return;
    printf("%s", block.name);
    if (block.byte_size)
        printf(": set %u, binding %u, %u bytes", block.set, block.binding, block.byte_size);
    puts("");
    for (uint32_t i = 0; i < block.num_variables; ++i) {
        mxg_variable v = MXG_INIT(mxg_variable);
        if (mxg_result_variable(result, block.first_variable + i, &v) != MXG_OK)
            continue;
        if (number == MXG_BLOCK_TEXTURES)
            printf("  binding %u: %s\n", v.binding, v.path[0] ? v.file : v.semantic);
        else if (number == MXG_BLOCK_APP_DATA)
            printf("  location %u: %s %s\n", v.location, v.type, v.semantic);
        else
            printf("  %u: %s %s\n", v.offset, v.type, v.path[0] ? v.path : v.name);
    }
}

static void print_bindings(const mxg_result *result)
{
    for (int block = 0; block < MXG_NUM_BLOCKS; ++block)
        if (block != MXG_BLOCK_VERTEX_DATA && block != MXG_BLOCK_OUTPUTS)
            print_variables(result, (mxg_block)block);
}

static void explain_private_uniforms(void)
{
    for (uint32_t i = 0; i < mxg_catalogue_num_semantics(); ++i) {
        mxg_semantic semantic = MXG_INIT(mxg_semantic);
        if (mxg_catalogue_semantic(i, &semantic) == MXG_OK
            && semantic.block == MXG_BLOCK_LIGHT_DATA)
            printf("  %s: %s\n", semantic.semantic, semantic.doc);
    }
}

/* A light of the first type, from above. */
static bool pack_light(const mxg_result *result, void *bytes, size_t size)
{
    const float down[] = {0, -1, 0};
    mxg_light_type light = MXG_INIT(mxg_light_type);
    if (mxg_result_light_type(result, 0, &light) != MXG_OK)
        return false;
    for (uint32_t member = 0; member < light.num_members; ++member) {
        mxg_variable v = MXG_INIT(mxg_variable);
        uint32_t variable = mxg_result_light_member(result, 0, member);
        if (mxg_result_variable(result, variable, &v) == MXG_OK && strcmp(v.name, "direction") == 0)
            return mxg_result_pack_value(result, variable, 0, down, 3, bytes, size) == MXG_OK;
    }
    return false;
}

static size_t size_of(const mxg_result *result, mxg_block block)
{
    mxg_block_info info = MXG_INIT(mxg_block_info);
    mxg_result_block(result, block, &info);
    return info.byte_size;
}

static bool upload(struct host *h)
{
    free(h->uniforms);
    h->uniforms_size = size_of(h->program, MXG_BLOCK_PUBLIC_UNIFORMS);
    h->uniforms = malloc(h->uniforms_size);
    if (!h->uniforms)
        return false;
    mxg_result_pack_block(h->program, NULL, MXG_BLOCK_PUBLIC_UNIFORMS, h->uniforms,
                          h->uniforms_size);
    size_t size = size_of(h->program, MXG_BLOCK_LIGHT_DATA);
    void *lights = malloc(size);
    if (!lights)
        return false;
    mxg_result_pack_block(h->program, NULL, MXG_BLOCK_LIGHT_DATA, lights, size);
    bool good = pack_light(h->program, lights, size);
    free(lights);
    return good;
}

/* ---- Changes ---- */

/* Takes the next document; compiles only if the old program cannot draw it. */
static bool follow(struct host *h, mxg_document *next)
{
    uint32_t changed[8], num = 0;
    mxg_result *result = NULL;
    if (generate(h, next, true, &result) != MXG_OK) {
        mxg_result_destroy(result);
        mxg_document_destroy(next);
        return false;
    }
    mxg_change change = mxg_result_change(h->program, result, changed, 8, &num);
    if (change == MXG_CHANGE_VALUES) {
        mxg_result_pack_block(result, NULL, MXG_BLOCK_PUBLIC_UNIFORMS, h->uniforms,
                              h->uniforms_size);
    } else if (change == MXG_CHANGE_SHADER) {
        mxg_result_destroy(result);
        generate(h, next, false, &result); /* cannot fail now, except for memory */
        compile(result);
    }
    printf("change %d, %u values\n", change, num);
    mxg_result_destroy(h->program);
    mxg_document_destroy(h->document);
    h->program = result;
    h->document = next;
    return change != MXG_CHANGE_SHADER || upload(h);
}

/* Sets a number, as a slider does. */
static bool set_number(struct host *h, const char *node, const char *input, float value)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", node, input);
    switch (mxg_result_input_state(h->program, path)) {
    case MXG_INPUT_UNIFORM:
        return mxg_result_pack_value(h->program, mxg_result_find_variable(h->program, path), 0,
                                     &value, 1, h->uniforms, h->uniforms_size)
               == MXG_OK;
    case MXG_INPUT_COMPILED: break; /* the document changes */
    case MXG_INPUT_CONNECTED: printf("%s is connected\n", path); return false;
    case MXG_INPUT_UNUSED: return true;
    default: printf("there is no %s\n", path); return false;
    }
    mxg_edit *edit;
    mxg_document *next;
    if (mxg_edit_create(h->context, h->library, h->document, NULL, &edit) != MXG_OK)
        return false;
    mxg_edit_set_numbers(edit, mxg_edit_find_element(edit, 0, node), input, NULL, &value, 1);
    mxg_status status = mxg_edit_commit(edit, &next);
    mxg_edit_destroy(edit);
    return status == MXG_OK && follow(h, next);
}

static void list_compiled(const mxg_result *result)
{
    for (uint32_t i = 0; i < mxg_result_num_compiled_inputs(result); ++i) {
        mxg_compiled_input input = MXG_INIT(mxg_compiled_input);
        if (mxg_result_compiled_input(result, i, &input) == MXG_OK && input.authored)
            printf("compiled in: %s %s = %s\n", input.type, input.path, input.value);
    }
}

/* A new tiling is compiled in; a new metalness that an edit sets is one value. */
static bool edit_document(struct host *h, const char *node, const char *input, const char *type,
                          const char *value)
{
    mxg_edit *edit;
    mxg_document *next = NULL;
    if (mxg_edit_create(h->context, h->library, h->document, NULL, &edit) != MXG_OK)
        return false;
    char reason[256];
    mxg_edit_set_value(edit, mxg_edit_find_element(edit, 0, node), input, type, value);
    bool good = !mxg_edit_error(edit, reason, sizeof reason);
    if (!good)
        fprintf(stderr, "%s\n", reason);
    else if (mxg_edit_commit(edit, &next) != MXG_OK) {
        print_diagnostics(mxg_document_diagnostics(next));
        mxg_document_destroy(next);
        good = false;
    }
    mxg_edit_destroy(edit);
    return good && follow(h, next);
}

/* ---- Errors ---- */

/* A broken document exists: it has the diagnostics. */
static bool reject_broken(struct host *h)
{
    static const char text[] = "<materialx version='1.39'><standard_surface name='S' "
                               "type='surfaceshader'><input name='base' type='float' "
                               "nodename='none'/></standard_surface></materialx>";
    mxg_document *broken = NULL;
    mxg_result *result = NULL;
    mxg_document_parse(h->context, h->library, "broken.mtlx", text, sizeof text - 1, &broken);
    mxg_status status = mxg_validate(h->context, broken, &result);
    mxg_diagnostic first = MXG_INIT(mxg_diagnostic);
    if (mxg_diagnostics_item(mxg_result_diagnostics(result), 0, &first) == MXG_OK)
        printf("%s:%u:%u: %s\n", first.file, first.line, first.column, first.id);
    mxg_result_destroy(result);
    mxg_document_destroy(broken);
    return status == MXG_ERROR_DOCUMENT;
}

static bool run(struct host *h)
{
    if (build(h) != MXG_OK || generate(h, h->document, false, &h->program) != MXG_OK)
        return false;
    list_materials(h->document);
    list_inputs(h->document, mxg_document_find_element(h->document, 0, "SR"));
    compile(h->program);
    print_bindings(h->program);
    explain_private_uniforms();
    list_compiled(h->program);
    return upload(h) && set_number(h, "SR", "metalness", 0.5f)
           && !set_number(h, "SR", "base_color", 0.5f) && !set_number(h, "SR", "metal", 0.5f)
           && edit_document(h, "SR", "coat", "float", "1")
           && edit_document(h, "Wood", "uvtiling", NULL, "8, 8")
           && !edit_document(h, "Wood", "not a name", "float", "1") && reject_broken(h);
}

int main(void)
{
    struct host h = {0};
    if (mxg_context_create(NULL, &h.context) != MXG_OK)
        return 1;
    h.library = mxg_library_builtin(h.context);
    bool good = run(&h);
    free(h.uniforms);
    mxg_result_destroy(h.program);
    mxg_document_destroy(h.document);
    mxg_library_unref(h.library);
    mxg_context_destroy(h.context);
    puts(good ? "done" : "failed");
    return good ? 0 : 1;
}
