// SPDX-License-Identifier: Apache-2.0
/*
 * A document with looks over a fixed scene: bound by its look and by some names, with layers that
 * alone count or do not, asked for layers and facts, written, and its first stack generated.
 */
#include "files.h"
#include "mutate.h"

static const char *const paths[] = {"/r/a", "/r/b/c", "/r/b/c[3]", "/set/table/leg_1", "/r_2"};
static const char *const looks[] = {NULL, "L", "finished", "look1", "default"};
static const char *const slots[] = {"000", "050", "000::x", "A", "dust"};
enum { NUM_PATHS = sizeof paths / sizeof *paths, NUM_LOOKS = sizeof looks / sizeof *looks };

static bool swallow(void *user_data, const char *data, size_t size)
{
    size_t *left = user_data;
    FUZZ_REQUIRE(data || !size);
    *left -= size < *left ? size : *left;
    return *left > 0;
}

static void ask(const mxg_bindings *bindings, uint32_t primitive)
{
    uint32_t num = mxg_bindings_num_layers(bindings, primitive);
    for (uint32_t i = 0; i < num; i++) {
        mxg_layer layer = {sizeof layer};
        FUZZ_REQUIRE(mxg_bindings_layer(bindings, primitive, i, &layer) == MXG_OK);
    }
    mxg_layer none = {sizeof none};
    FUZZ_REQUIRE(mxg_bindings_layer(bindings, primitive, num, &none) != MXG_OK);
    num = mxg_bindings_num_facts(bindings, primitive);
    for (uint32_t i = 0; i < num; i++) {
        mxg_fact fact = {sizeof fact};
        FUZZ_REQUIRE(mxg_bindings_fact(bindings, primitive, i, &fact) == MXG_OK);
    }
}

static void write_all(const mxg_bindings *bindings, uint32_t num_primitives, unsigned choice)
{
    for (int format = 0; format <= MXG_BINDINGS_USDA; format++) {
        size_t left = choice % 7 ? (size_t)1 << 20 : choice;
        mxg_bindings_write(bindings, (mxg_bindings_format)format, swallow, &left);
    }
    for (uint32_t i = 0; i < num_primitives; i++) {
        size_t left = (size_t)1 << 20;
        mxg_bindings_write_reasons(bindings, i, swallow, &left);
    }
}

static void generate(const struct fuzz_document *opened, const mxg_bindings *bindings)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_result *result = NULL;
    desc.target = "glsl";
    desc.bindings = bindings;
    if (mxg_bindings_num_stacks(bindings))
        FUZZ_REQUIRE(
            fuzz_is_expected(mxg_generate(opened->context, opened->document, &desc, &result)));
    mxg_result_destroy(result);
}

static void bind(const struct fuzz_document *opened, unsigned choice)
{
    mxg_scene *scene = NULL;
    mxg_bindings *bindings = NULL, *again = NULL;
    const char *slot = slots[choice / 8 % NUM_PATHS];
    mxg_bindings_desc desc = MXG_BINDINGS_DESC_INIT;
    desc.look = looks[choice % NUM_LOOKS];
    desc.solo = desc.mute = &slot;
    desc.num_solo = choice % 11 == 0, desc.num_mute = choice % 7 == 0;
    if (mxg_scene_create(opened->context, &scene) == MXG_OK
        && mxg_scene_add_paths(scene, paths, NUM_PATHS) != MXG_ERROR_MEMORY)
        mxg_bindings_create(opened->context, opened->document, scene, &desc, &bindings);
    if (bindings) {
        uint32_t num = mxg_scene_num_primitives(scene);
        for (uint32_t i = 0; i < num; i++)
            ask(bindings, i);
        write_all(bindings, num, choice);
        generate(opened, bindings);
        desc.previous = bindings;
        mxg_bindings_create(opened->context, opened->document, scene, &desc, &again);
        FUZZ_REQUIRE(!again || mxg_bindings_num_stacks(again) == mxg_bindings_num_stacks(bindings));
    }
    mxg_bindings_destroy(again);
    mxg_bindings_destroy(bindings);
    mxg_scene_destroy(scene);
}

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    fuzz_files_open(data, size, heap, false, bind);
}
