// SPDX-License-Identifier: Apache-2.0
/*
 * Definitions nested in definitions: those used often become functions of the shader, and the value
 * stays what it is when all are expanded. The IR of `mxgen inspect` is read back and evaluated.
 */
#include "base/text.h"
#include "ir/ir.h"
#include "unit/ir_text.h"
#include "unit/test.h"

#include <mxgen/mxgen.h>

#include <math.h>

/*
 * f0(x, k) = sin(k x) and, above it, fn(x, k) = fn-1(x, k) + fn-1(fn-1(x, k), k / 2): 2^n uses of
 * f0, and f1 to fn-1 with ever other arguments.
 */
static void write_definition(struct text *out, unsigned n)
{
    text_fmt(out,
             "<nodedef name=\"ND_f%u\" node=\"f%u\"><input name=\"x\" type=\"float\"/><input "
             "name=\"k\" type=\"float\"/>"
             "<output name=\"out\" type=\"float\"/></nodedef><nodegraph name=\"NG_f%u\" "
             "nodedef=\"ND_f%u\">",
             n, n, n, n);
    if (n == 0) {
        text_str(out, "<multiply name=\"kx\" type=\"float\"><input name=\"in1\" type=\"float\" "
                      "interfacename=\"k\"/>"
                      "<input name=\"in2\" type=\"float\" interfacename=\"x\"/></multiply>"
                      "<sin name=\"sum\" type=\"float\"><input name=\"in\" type=\"float\" "
                      "nodename=\"kx\"/></sin>");
    } else {
        text_fmt(
            out,
            "<divide name=\"half\" type=\"float\"><input name=\"in1\" type=\"float\" "
            "interfacename=\"k\"/>"
            "<input name=\"in2\" type=\"float\" value=\"2\"/></divide>"
            "<f%u name=\"a\" type=\"float\"><input name=\"x\" type=\"float\" interfacename=\"x\"/>"
            "<input name=\"k\" type=\"float\" interfacename=\"k\"/></f%u>",
            n - 1, n - 1);
        text_fmt(
            out,
            "<f%u name=\"b\" type=\"float\"><input name=\"x\" type=\"float\" nodename=\"a\"/>"
            "<input name=\"k\" type=\"float\" nodename=\"half\"/></f%u>"
            "<add name=\"sum\" type=\"float\"><input name=\"in1\" type=\"float\" nodename=\"a\"/>"
            "<input name=\"in2\" type=\"float\" nodename=\"b\"/></add>",
            n - 1, n - 1);
    }
    text_str(out, "<output name=\"out\" type=\"float\" nodename=\"sum\"/></nodegraph>\n");
}

static void write_document(struct text *out, unsigned depth)
{
    text_str(out, "<materialx version=\"1.39\">\n");
    for (unsigned n = 0; n <= depth; n++)
        write_definition(out, n);
    text_fmt(out,
             "<time name=\"t\" type=\"float\"/><f%u name=\"f\" type=\"float\"><input name=\"x\" "
             "type=\"float\" nodename=\"t\"/>"
             "<input name=\"k\" type=\"float\" value=\"1.5\"/></f%u><output name=\"out\" "
             "type=\"float\" nodename=\"f\"/></materialx>",
             depth, depth);
}

static float expanded(unsigned n, float x, float k)
{
    if (n == 0)
        return sinf(k * x);
    float a = expanded(n - 1, x, k);
    return a + expanded(n - 1, a, k / 2.0f);
}

static const float test_time = 0.625f;

static bool is_time(void *user_data, const struct ir_graph *graph, ir_ref ref, struct ir_value *out)
{
    (void)user_data;
    *out = ir_value_float(test_time);
    return ir_get(graph, ref)->op == IR_UNIFORM;
}

static void check_ir(const char *text, unsigned depth, struct mem *mem)
{
    struct arena arena;
    struct strpool strings;
    struct ir_graph graph;
    arena_init(&arena, mem);
    strpool_init(&strings, &arena, NULL);
    ir_graph_init(&graph, &arena, &strings);
    ir_ref *roots;
    uint32_t num_roots;
    struct ir_value value;
    struct ir_eval_env env = {.source = is_time};
    if (REQUIRE(!ir_text_read(&graph, text, &roots, &num_roots)) && REQUIRE(num_roots == 1)
        && REQUIRE(ir_eval(&graph, roots[0], &env, &arena, &value))) {
        float expected = expanded(depth, test_time, 1.5f);
        REQUIRE(fabsf(value.w[0].f - expected) <= 1e-5f * (1.0f + fabsf(expected)));
    }
    REQUIRE((graph.functions.len > 0) == (depth > 4)); /* 2^4 uses are not many */
    REQUIRE(graph.nodes.len < 1000);
    arena_finish(&arena);
}

int main(void)
{
    struct mem mem;
    mem_init(&mem, NULL, NULL);
    mxg_context *context;
    mxg_context_create(NULL, &context);
    mxg_library *library = mxg_library_builtin(context);
    mxg_options *options;
    mxg_options_create(context, &options);
    mxg_options_set(options, "interface", "reduced"); /* the time is the only variable */
    for (unsigned depth = 0; depth <= 12; depth++) {
        struct arena arena;
        struct text source;
        mxg_document *document = NULL;
        mxg_result *result = NULL;
        mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
        desc.target = "glsl";
        desc.element = "out";
        desc.options = options;
        arena_init(&arena, &mem);
        text_init(&source, &arena);
        write_document(&source, depth);
        REQUIRE_EQ(
            mxg_document_parse(context, library, "nested.mtlx", source.data, source.len, &document),
            MXG_OK);
        if (REQUIRE_EQ(mxg_inspect(context, document, MXG_VIEW_IR, &desc, &result), MXG_OK))
            check_ir(mxg_result_text(result, NULL), depth, &mem);
        mxg_result_destroy(result);
        mxg_document_destroy(document);
        arena_finish(&arena);
    }
    mxg_options_destroy(options);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return test_report("outline");
}
