// SPDX-License-Identifier: Apache-2.0
/*
 * The judge of shaders must itself be right: it accepts what is valid, and tells stage and line of
 * what is not.
 */
#include "compile/command.h"
#include "compile/compile.h"

#include "unit/test.h"

#define VERTEX(version) \
    "#version " version \
    "\nlayout(location = 0) in vec3 p;\nvoid main()\n{\n    gl_Position = vec4(p, 1.0);\n}\n"

static const char *const desktop_vertex = VERTEX("450"), *const es_vertex = VERTEX("300 es");
static const char *const desktop_pixel =
    "#version 450\nuniform vec3 u_color;\nlayout(location = 0) out vec4 o;\n"
    "void main()\n{\n    o = vec4(u_color * 2.0, 1.0);\n}\n";
static const char *const vulkan_pixel =
    "#version 450\nlayout(set = 0, binding = 0, std140) uniform B { vec3 u_color; };\n"
    "layout(location = 0) out vec4 o;\nvoid main()\n{\n    o = vec4(u_color * 2.0, 1.0);\n}\n";
static const char *const es_pixel = "#version 300 es\nprecision highp float;\nuniform vec3 "
                                    "u_color;\nlayout(location = 0) out vec4 o;\n"
                                    "void main()\n{\n    o = vec4(u_color * 2.0, 1.0);\n}\n";
static const char *const broken_pixel = "#version 450\nlayout(location = 0) out vec4 o;\nvoid "
                                        "main()\n{\n    o = vec4(missing, 1.0);\n}\n";
static const char *const hlsl_vertex = "void main(float3 p : POSITION, out float4 position : "
                                       "SV_Position)\n{\n    position = float4(p, "
                                       "1.0);\n}\n";
static const char *const hlsl_pixel =
    "cbuffer B : register(b0) { float gain : packoffset(c0); float3 tint : packoffset(c0.y); };\n"
    "void main(out float4 o : SV_Target0)\n{\n    o = float4(tint * gain, 1.0);\n}\n";
static const char *const broken_hlsl =
    "void main(out float4 o : SV_Target0)\n{\n    o = float4(missing, 1.0);\n}\n";
static struct compiled compile(const char *target, const char *vertex, const char *pixel)
{
    struct compiled compiled;
    const char *sources[MXG_NUM_STAGES] = {vertex, pixel};
    compile_program(target, sources, &compiled);
    return compiled;
}

static void accepts(const char *target, const char *vertex, const char *pixel,
                    uint32_t instructions)
{
    struct compiled compiled = compile(target, vertex, pixel);
    REQUIRE_EQ(compiled.errors, 0);
    for (size_t i = 0; i < compiled.num_messages; ++i)
        printf("    %s: %s\n", target, compiled.messages[i].text);
    REQUIRE_EQ(compiled.stages[MXG_STAGE_PIXEL].body_instructions, instructions);
    REQUIRE(compiled.stages[MXG_STAGE_VERTEX].body_instructions > 0);
    compiled_finish(&compiled);
}

static void refuses(const char *target, const char *vertex, const char *pixel, uint32_t line,
                    const char *word)
{
    struct compiled compiled = compile(target, vertex, pixel);
    REQUIRE(compiled.errors > 0);
    if (REQUIRE(compiled.num_messages > 0)) {
        REQUIRE_EQ(compiled.messages[0].stage, MXG_STAGE_PIXEL);
        REQUIRE_EQ(compiled.messages[0].line, line);
        if (!REQUIRE(strstr(compiled.messages[0].text, word) != NULL))
            printf("    %s\n", compiled.messages[0].text);
    }
    compiled_finish(&compiled);
}

/* Compilers that are installed apart: a good and a wrong pixel stage, and its message. */
static void test_installed(void)
{
    static const struct {
        const char *target, *good, *wrong, *word;
        uint32_t line;
    } rows[] = {
        {"slang", "[shader(\"fragment\")]\nfloat4 main() : SV_Target\n{\n    return 1.0;\n}\n",
         "[shader(\"fragment\")]\nfloat4 main() : SV_Target\n{\n    return missing;\n}\n",
         "missing", 4},
        {"wgsl", "@fragment\nfn main() -> @location(0) vec4f\n{\n    return vec4f(1.0);\n}\n",
         "@fragment\nfn main() -> @location(0) vec4f\n{\n    return missing;\n}\n", "missing", 4},
        /* derivatives stand in uniform control flow */
        {"wgsl", "fn f(x: f32) -> f32\n{\n    return dpdx(x);\n}\n",
         "@fragment\nfn main(@location(0) x: f32) -> @location(0) vec4f\n{\n    if (x > 0.0) {\n"
         "        return vec4f(dpdx(x));\n    }\n    return vec4f();\n}\n",
         "uniform control flow", 5},
        {"msl",
         "#include <metal_stdlib>\nusing namespace metal;\nfloat2 f(float2 v) { return v; }\n",
         "#include <metal_stdlib>\nusing namespace metal;\nfloat3 f(float2 v) { return v; }\n",
         "return object", 3},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        if (!compile_knows_target(rows[i].target)) {
            printf("skip: no compiler for %s is installed\n", rows[i].target);
            continue;
        }
        struct compiled compiled = compile(rows[i].target, NULL, rows[i].good);
        REQUIRE_EQ(compiled.errors, 0);
        compiled_finish(&compiled);
        refuses(rows[i].target, NULL, rows[i].wrong, rows[i].line, rows[i].word);
    }
}

/* Modules that one process compiles: a message is told of the shader that it is in. */
static void test_modules(void)
{
    enum { COUNT = 40, WRONG = 35 }; /* more than one process takes */
    static const char good[] = "mdl 1.8;\nexport float f() { return 1.0; }\n";
    const char *sources[COUNT];
    struct compiled compiled[COUNT] = {0};
    if (!command_takes_modules("mdl")) {
        printf("skip: mdlc is not installed\n");
        return;
    }
    for (int i = 0; i < COUNT; ++i)
        sources[i] = good;
    sources[WRONG] = "mdl 1.8;\n\nexport float f() { return missing; }\n";
    command_compile_modules("mdl", sources, COUNT, compiled);
    for (int i = 0; i < COUNT; ++i)
        REQUIRE_EQ(compiled[i].errors, i == WRONG ? 1 : 0);
    if (REQUIRE(compiled[WRONG].num_messages == 1)) {
        REQUIRE_EQ(compiled[WRONG].messages[0].line, 3);
        REQUIRE(strstr(compiled[WRONG].messages[0].text, "missing"));
    }
    for (int i = 0; i < COUNT; ++i)
        compiled_finish(&compiled[i]);
}

int main(void)
{
    compile_begin();
    /*
     * label, load, multiply, 3 extracts, construct, store, return; a member of a block needs an
     * access chain too
     */
    accepts("glsl", desktop_vertex, desktop_pixel, 9);
    accepts("vulkan", desktop_vertex, vulkan_pixel, 10);
    accepts("essl", es_vertex, es_pixel, 9);
    /* main calls the source's main, and a tint that is not aligned to 16 bytes is valid */
    accepts("hlsl", hlsl_vertex, hlsl_pixel, 22);
    refuses("hlsl", hlsl_vertex, broken_hlsl, 3, "missing");
    refuses("glsl", desktop_vertex, broken_pixel, 5, "missing");
    refuses("vulkan", desktop_vertex, broken_pixel, 5, "missing");
    /* loose uniforms are not Vulkan's */
    refuses("vulkan", desktop_vertex, desktop_pixel, 2, "outside a block");
    REQUIRE(compile_knows_target("essl") && compile_knows_target("hlsl"));
    REQUIRE(!compile_knows_target("metal"));
    test_installed();
    test_modules();
    compile_end();
    return test_report("compile");
}
