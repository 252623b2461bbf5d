// SPDX-License-Identifier: Apache-2.0
/*
 * The code of a node in C that makes any calls of mxgen/node.h: each byte triple is a call with two
 * arguments, which choose earlier values, words and numbers. Memory may run out in every call.
 */
#include "fuzz.h"

#include <mxgen/mxgen.h>

#include <string.h>

static const char text[] =
    "<materialx version='1.39'>"
    "<nodedef name='ND_t' node='t'><input name='in' type='float' value='0.5'/>"
    "<input name='index' type='integer' value='1'/><input name='word' type='string' value='a'/>"
    "<input name='color' type='color3' value='1, 0.5, 0'/>"
    "<input name='file' type='filename' value='a.png'/>"
    "<input name='under' type='BSDF' value=''/><output name='out' type='float'/></nodedef>"
    "<nodedef name='ND_loop' node='loop'><input name='in' type='float' value='1'/>"
    "<output name='out' type='float'/></nodedef>"
    "<nodegraph name='NG_loop' nodedef='ND_loop'><t name='p' type='float'>"
    "<input name='in' type='float' interfacename='in'/></t>"
    "<output name='out' type='float' nodename='p'/></nodegraph>"
    "<t name='use' type='float'><input name='in' type='float' nodename='first'/></t>"
    "<t name='first' type='float'/><output name='M' type='float' nodename='use'/></materialx>";

enum { MAX_VALUES = 24 };

struct script {
    const unsigned char *data;
    size_t size;
};

struct values {
    mxg_ref items[MAX_VALUES];
    unsigned num;
};

static const char *const words[] = {
    "in",
    "index",
    "word",
    "color",
    "file",
    "under",
    "float",
    "vec2",
    "vec3",
    "vec4",
    "int",
    "mat3",
    "string",
    "BSDF",
    "add",
    "mul",
    "dot",
    "construct",
    "mix",
    "sin",
    "convert",
    "layer",
    "closure_scale",
    "dFdx",
    "texture",
    "select",
    "xyz",
    "x",
    "",
    "normalWorld",
    "texcoord_0",
    "geomprop_a",
    "u_mine",
    "u_worldMatrix",
    "ND_t",
    "ND_loop",
    "ND_add_float",
    "ND_oren_nayar_diffuse_bsdf",
    "in1",
    "roughness",
    "{{in}} * 2.0",
    "{{in}} + {{color}}.x",
    "texture({{file}}, vec2({{in}})).x",
    "1.0 +",
    "%s",
};
enum { NUM_WORDS = sizeof words / sizeof *words };

static const char *word_of(unsigned number)
{
    return number % (NUM_WORDS + 1) < NUM_WORDS ? words[number % (NUM_WORDS + 1)] : NULL;
}

static mxg_ref value_of(const struct values *values, unsigned number)
{
    return number >= 250 ? number * 7919u : values->num ? values->items[number % values->num] : 0;
}

static mxg_ref call_shader(mxg_build *build, const struct values *values, unsigned call, unsigned a,
                           unsigned b)
{
    const char *names[2] = {word_of(b), word_of(a + b)};
    const mxg_ref args[2] = {value_of(values, a), value_of(values, b)};
    const float numbers[4] = {(float)a, 1.0f, 0.5f, -1.0f};
    mxg_build_uniform uniform = {sizeof uniform, word_of(a), word_of(b), NULL, numbers, b % 5};
    mxg_ref results[2] = {0};
    switch (call) {
    case 0: return mxg_build_expression(build, word_of(a), word_of(b), names, args, a % 3);
    case 1: mxg_build_node(build, word_of(a), names, args, b % 3, results, 1); return results[0];
    case 2: return mxg_build_stream(build, word_of(a), word_of(b));
    case 3: return mxg_build_interpolation(build, word_of(a), args[1]);
    case 4: return mxg_build_add_uniform(build, &uniform);
    default: mxg_build_report_error(build, word_of(a), word_of(b)); return 0;
    }
}

static mxg_ref call_any(mxg_build *build, const struct values *values, unsigned call, unsigned a,
                        unsigned b)
{
    const mxg_ref args[3] = {value_of(values, a), value_of(values, b), value_of(values, a + b)};
    const float numbers[16] = {(float)a, (float)b / 3.0f, -0.25f, 1e30f};
    mxg_value value = MXG_INIT(mxg_value);
    switch (call) {
    case 0: return mxg_build_input(build, word_of(a));
    case 1: return mxg_build_number(build, word_of(a), numbers, b % 17);
    case 2: return mxg_build_string(build, word_of(a));
    case 3: return mxg_build_op(build, word_of(a), b & 1 ? word_of(b) : NULL, args, b % 4);
    case 4: return mxg_build_swizzle(build, args[0], word_of(b));
    case 5: mxg_build_value(build, args[0], &value); return args[0];
    case 6: mxg_build_require_constant(build, word_of(a), b & 1 ? &value : NULL); return 0;
    case 7: mxg_build_type(build, args[0]); return 0;
    default: return call_shader(build, values, call - 8, a, b);
    }
}

static bool run_script(void *user_data, mxg_build *build, mxg_ref *results)
{
    const struct script *script = user_data;
    struct values values = {{0}, 0};
    for (size_t i = 0; i + 3 <= script->size && i < 300; i += 3) {
        const unsigned char *step = script->data + i;
        mxg_ref made = call_any(build, &values, step[0] % 14, step[1], step[2]);
        if (made && values.num < MAX_VALUES)
            values.items[values.num++] = made;
    }
    results[0] = values.num ? values.items[values.num - 1] : 0;
    return script->size % 5 != 0;
}

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    struct script script = {(const unsigned char *)data, size};
    const mxg_node_code code = {sizeof code, "ND_t", NULL, 1, run_script, &script, NULL};
    const mxg_node_code *const codes[] = {&code};
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    mxg_generate_desc generate = MXG_GENERATE_DESC_INIT;
    mxg_context *context = NULL;
    mxg_document *document = NULL;
    mxg_result *result = NULL;
    desc.realloc = fuzz_realloc;
    desc.realloc_user_data = heap;
    desc.max_nodes = 20000;
    desc.node_codes = codes;
    desc.num_node_codes = 1;
    if (mxg_context_create(&desc, &context) != MXG_OK)
        return;
    mxg_library *library = mxg_library_builtin(context);
    generate.target = size & 1 ? "vulkan" : "osl";
    generate.element = "M";
    if (library
        && mxg_document_parse(context, library, "c.mtlx", text, sizeof text - 1, &document)
               == MXG_OK) {
        mxg_status status = mxg_generate(context, document, &generate, &result);
        FUZZ_REQUIRE(status != MXG_ERROR_ARGUMENT);
        FUZZ_REQUIRE(status != MXG_OK || mxg_result_source(result, MXG_STAGE_PIXEL, NULL));
    }
    mxg_result_destroy(result);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
}
