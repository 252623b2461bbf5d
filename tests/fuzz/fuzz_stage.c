// SPDX-License-Identifier: Apache-2.0
/*
 * A stage of USD, or a list of paths, and a look: read, with its materials as a document, bound,
 * written in all forms, changed and bound again. What is written as USD can be read.
 */
#include "files.h"

enum { MAX_PRIMITIVES = 24, MAX_PROPERTIES = 24 };

static const char look[] =
    "<materialx version='1.39'><surface name='s' type='surfaceshader'/>"
    "<surfacematerial name='A' type='material'><input name='surfaceshader' type='surfaceshader' "
    "nodename='s'/></surfacematerial><nodegraph name='NG'><constant name='c' type='float'/>"
    "<output name='opacity' type='float' nodename='c'/></nodegraph>"
    "<collection name='C' includegeom='//a, /r' excludegeom='/r/b'/><look name='L'>"
    "<materialassign name='a' material='A' geom='/'/>"
    "<materialassign name='b' slot='050' material='A' collection='C'/>"
    "<materialassign name='c' slot='000::x' nodegraph='NG' geom='//*'/></look></materialx>";

struct sink {
    char *text;
    size_t len;
};

static bool append(void *user_data, const char *data, size_t size)
{
    struct sink *sink = user_data;
    char *grown = realloc(sink->text, sink->len + size + 1);
    if (!grown)
        return false;
    memcpy(grown + sink->len, data, size);
    sink->text = grown;
    sink->len += size;
    return true;
}

/* The layers as USD, in the place of the stage. */
static void read_again(mxg_context *context, struct fuzz_files *files, const struct sink *usda)
{
    mxg_scene *scene = NULL;
    files->items[0].data = usda->text;
    files->items[0].size = usda->len;
    snprintf(files->items[0].name, sizeof files->items[0].name, "again.usda");
    mxg_status status = mxg_scene_load(context, "again.usda", NULL, &scene);
    FUZZ_REQUIRE(fuzz_is_expected(status));
    const mxg_diagnostics *list = mxg_scene_diagnostics(scene);
    mxg_diagnostic item = {sizeof item};
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); i++) {
        mxg_diagnostics_item(list, i, &item);
        FUZZ_REQUIRE(strcmp(item.id, "usda-syntax") != 0);
    }
    mxg_scene_destroy(scene);
}

static void look_at(const mxg_scene *scene, uint32_t primitive)
{
    char word[64];
    double numbers[16];
    uint32_t targets[16], num = mxg_scene_num_properties(scene, primitive);
    mxg_primitive at = {sizeof at};
    mxg_scene_primitive(scene, primitive, &at);
    mxg_scene_primitive_path(scene, primitive, word, sizeof word);
    for (uint32_t i = 0; i < num && i < MAX_PROPERTIES; i++) {
        mxg_property property = {sizeof property};
        char name[64];
        FUZZ_REQUIRE(mxg_scene_property(scene, primitive, i, &property) == MXG_OK);
        snprintf(name, sizeof name, "%.*s", (int)(property.name_len < 63 ? property.name_len : 63),
                 property.name);
        mxg_scene_find_property(scene, primitive, name);
        mxg_scene_property_numbers(scene, primitive, name, numbers, 16);
        mxg_scene_property_word(scene, primitive, name, 1, word, sizeof word);
        mxg_scene_property_targets(scene, primitive, name, targets, 16);
    }
    mxg_property none = {sizeof none};
    FUZZ_REQUIRE(mxg_scene_property(scene, primitive, num, &none) != MXG_OK);
}

static void write_all(mxg_context *context, struct fuzz_files *files, const mxg_bindings *bindings)
{
    struct sink usda = {0};
    for (int format = 0; format <= MXG_BINDINGS_USDA; format++) {
        struct sink other = {0};
        struct sink *sink = format == MXG_BINDINGS_USDA ? &usda : &other;
        mxg_status status = mxg_bindings_write(bindings, (mxg_bindings_format)format, append, sink);
        FUZZ_REQUIRE(fuzz_is_expected(status) || status == MXG_ERROR_ARGUMENT);
        if (sink == &usda && status != MXG_ERROR_MEMORY && usda.len)
            read_again(context, files, &usda);
        free(other.text);
    }
    for (uint32_t i = 0; i < MAX_PRIMITIVES; i++) {
        struct sink reasons = {0};
        mxg_bindings_write_reasons(bindings, i, append, &reasons);
        free(reasons.text);
    }
    free(usda.text);
}

static void bind(mxg_context *context, struct fuzz_files *files, const mxg_document *document,
                 mxg_scene *scene)
{
    mxg_bindings *bindings = NULL;
    FUZZ_REQUIRE(fuzz_is_expected(mxg_bindings_create(context, document, scene, NULL, &bindings)));
    if (bindings)
        write_all(context, files, bindings);
    mxg_bindings_destroy(bindings);
}

/* Binds, removes some primitives, and binds again. */
static void use(mxg_context *context, struct fuzz_files *files, const mxg_document *document,
                mxg_scene *scene, unsigned choice)
{
    for (unsigned round = 0; round < 3; round++) {
        uint32_t num = mxg_scene_num_primitives(scene);
        for (uint32_t i = 0; i < num && i < MAX_PRIMITIVES; i++)
            look_at(scene, i);
        bind(context, files, document, scene);
        for (uint32_t i = 0; i < num && i < MAX_PRIMITIVES; i++)
            if ((choice >> (i + round) % 12 & 3) == 1)
                mxg_scene_remove_primitives(scene, &i, 1);
    }
}

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    unsigned choice = fuzz_choice(data, size, 4096);
    bool is_list = size && data[0] == '/';
    struct fuzz_files files = {.num = 1};
    files.items[0].data = data;
    files.items[0].size = size;
    snprintf(files.items[0].name, sizeof files.items[0].name, is_list ? "stage.txt" : "stage.usda");
    mxg_context_desc limits = {
        .max_memory = (size_t)256 << 20, .max_elements = 20000, .max_nodes = 50000};
    mxg_context *context = fuzz_files_context(&files, heap, limits);
    mxg_document *own = NULL, *document = NULL;
    mxg_scene *scene = NULL;
    if (!context)
        return;
    mxg_library *library = mxg_library_builtin(context);
    FUZZ_REQUIRE(fuzz_is_expected(
        mxg_document_parse(context, library, "look.mtlx", look, sizeof look - 1, &own)));
    FUZZ_REQUIRE(fuzz_is_expected(
        mxg_scene_load(context, files.items[0].name, choice % 2 ? "full" : NULL, &scene)));
    if (own && scene)
        FUZZ_REQUIRE(
            fuzz_is_expected(mxg_document_import(context, library, own, scene, &document)));
    if (document)
        use(context, &files, document, scene, choice);
    mxg_document_destroy(document);
    mxg_document_destroy(own);
    mxg_scene_destroy(scene);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    FUZZ_REQUIRE(files.num_open == 0);
}
