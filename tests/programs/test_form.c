// SPDX-License-Identifier: Apache-2.0
/*
 * Choices of hosts, as pictures of a square on a Vulkan device: two functions in one file of a
 * host draw what the programs of their documents draw; and shadow, occlusion, encoding and
 * transparency have the values that docs/hosts.md promises.
 */
#include "unit/test.h"

#include "compile/compile.h"
#include "render/draw.h"

#include <math.h>
#include <stdlib.h>

enum { SIZE = 32, NUM_FLOATS = SIZE * SIZE * 4, EXIT_SKIPPED = 77, NUM_VERTICES = 4 };

struct test {
    mxg_context *context;
    mxg_library *library;
    mxg_document *document;
    struct gpu gpu;
    struct draw_canvas *canvas;
    struct image around, shadow, open; /* the maps of the host */
};

static const char text[] =
    "<materialx version='1.39'>"
    "<standard_surface name='A' type='surfaceshader'>"
    "<input name='base_color' type='color3' value='0.8, 0.3, 0.1'/>"
    "<input name='specular_roughness' type='float' value='0.4'/>"
    "<input name='opacity' type='color3' value='0.5, 0.5, 0.5'/></standard_surface>"
    "<surfacematerial name='MA' type='material'>"
    "<input name='surfaceshader' type='surfaceshader' nodename='A'/></surfacematerial>"
    "<texcoord name='uv' type='vector2'/>"
    "<separate2 name='xy' type='multioutput'><input name='in' type='vector2' nodename='uv'/>"
    "</separate2>"
    "<mix name='stripes' type='color3'><input name='bg' type='color3' value='0.1, 0.6, 0.2'/>"
    "<input name='fg' type='color3' value='0.9, 0.9, 0.2'/>"
    "<input name='mix' type='float' nodename='xy' output='outx'/></mix>"
    "<standard_surface name='B' type='surfaceshader'>"
    "<input name='base_color' type='color3' nodename='stripes'/>"
    "<input name='metalness' type='float' value='1'/></standard_surface>"
    "<surfacematerial name='MB' type='material'>"
    "<input name='surfaceshader' type='surfaceshader' nodename='B'/></surfacematerial>"
    "<oren_nayar_diffuse_bsdf name='white' type='BSDF'>"
    "<input name='color' type='color3' value='1, 1, 1'/></oren_nayar_diffuse_bsdf>"
    "<surface name='C' type='surfaceshader'><input name='bsdf' type='BSDF' nodename='white'/>"
    "<input name='opacity' type='float' value='0.25'/></surface>"
    "<surface name='D' type='surfaceshader'><input name='bsdf' type='BSDF' nodename='white'/>"
    "</surface>"
    "<anisotropic_vdf name='mist' type='VDF'>"
    "<input name='absorption' type='vector3' value='0.5, 1, 2'/>"
    "<input name='scattering' type='vector3' value='1, 0.7, 0.4'/></anisotropic_vdf>"
    "<volume name='V' type='volumeshader'><input name='vdf' type='VDF' nodename='mist'/></volume>"
    "<slab name='amber' type='BSDF'>"
    "<input name='diffuse_albedo' type='color3' value='0, 0, 0'/>"
    "<input name='mean_free_path' type='vector3' value='4, 1.2, 0.3'/></slab>"
    "<slab_surface name='S' type='surfaceshader'><input name='bsdf' type='BSDF' nodename='amber'/>"
    "</slab_surface>"
    "<constant name='grey' type='color3'><input name='value' type='color3' value='0.5, 0.001, 1'/>"
    "</constant><output name='Grey' type='color3' nodename='grey'/>"
    "</materialx>";

static const float directional[3] = {0.36f, -0.48f, -0.8f}, radiance[3] = {2.0f, 1.5f, 1.0f};

/* ---- Generation ---- */

/* `options`: pairs of keys and values, then NULL. */
static mxg_result *generate(struct test *t, const char *element, const char *const *options)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_options *set = NULL;
    mxg_result *result = NULL;
    mxg_options_create(t->context, &set);
    for (; *options; options += 2)
        REQUIRE(mxg_options_set(set, options[0], options[1]) == MXG_OK);
    desc.target = "vulkan";
    desc.element = element;
    desc.options = set;
    if (!REQUIRE(mxg_generate(t->context, t->document, &desc, &result) == MXG_OK)) {
        char message[512];
        mxg_diagnostics_format(mxg_result_diagnostics(result), 0, NULL, 0, false, message,
                               sizeof message);
        puts(message);
    }
    mxg_options_destroy(set);
    return result;
}

static mxg_variable variable_of(const mxg_result *result, uint32_t index)
{
    mxg_variable v = MXG_INIT(mxg_variable);
    mxg_result_variable(result, index, &v);
    return v;
}

static mxg_block_info block_of(const mxg_result *result, mxg_block number)
{
    mxg_block_info block = MXG_INIT(mxg_block_info);
    mxg_result_block(result, number, &block);
    return block;
}

/* ---- The square ---- */

static const float square[NUM_VERTICES][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

/* Normals lean outwards, so that every pixel differs. */
static void write_attribute(const char *semantic, float out[NUM_VERTICES][4])
{
    for (int i = 0; i < NUM_VERTICES; ++i) {
        float x = square[i][0], y = square[i][1];
        bool is_position = strcmp(semantic, "position:object") == 0,
             is_normal = strcmp(semantic, "normal:object") == 0,
             is_tangent = strcmp(semantic, "tangent:object") == 0;
        out[i][0] = is_position ? x : is_normal ? 0.5f * x : is_tangent ? 1.0f : x * 0.5f + 0.5f;
        out[i][1] = is_position ? y : is_normal ? 0.5f * y : is_tangent ? 0.0f : y * 0.5f + 0.5f;
        out[i][2] = is_position ? 0.5f : is_normal ? 1.0f : 0.0f;
        out[i][3] = 1;
    }
}

static void add_attribute(struct draw *draw, uint32_t location, const char *type,
                          const char *semantic)
{
    float(*data)[4] = malloc(NUM_VERTICES * sizeof *data);
    write_attribute(semantic, data);
    draw->attributes[draw->num_attributes] = (struct draw_attribute){
        location, strcmp(type, "vec2") == 0 ? VK_FORMAT_R32G32_SFLOAT : VK_FORMAT_R32G32B32_SFLOAT};
    draw->objects[0].attributes[draw->num_attributes++] = data;
}

static void set_value(const mxg_result *result, uint32_t index, unsigned char *bytes, size_t size)
{
    mxg_variable v = variable_of(result, index);
    const float eye[3] = {0, 0, 3}, one = 1, gain = 0.5f;
    const float *value = strcmp(v.semantic, "viewPosition") == 0            ? eye
                         : strcmp(v.semantic, "numActiveLightSources") == 0 ? &one
                         : strcmp(v.semantic, "ambOccGain") == 0            ? &gain
                                                                            : NULL;
    if (value)
        REQUIRE(mxg_result_pack_value(result, index, 0, value, value == eye ? 3 : 1, bytes, size)
                == MXG_OK);
}

static void set_light(const mxg_result *result, uint32_t index, unsigned char *bytes, size_t size)
{
    mxg_variable v = variable_of(result, index);
    const float one = 1;
    const float *value = strcmp(v.name, "direction") == 0 ? directional
                         : strcmp(v.name, "color") == 0   ? radiance
                         : strcmp(v.name, "type") == 0 || strcmp(v.name, "intensity") == 0 ? &one
                                                                                           : NULL;
    if (value)
        REQUIRE(mxg_result_pack_value(result, index, 0, value, value == &one ? 1 : 3, bytes, size)
                == MXG_OK);
}

static void add_block(struct draw *draw, const mxg_result *result, mxg_block number)
{
    mxg_block_info block = block_of(result, number);
    if (!block.byte_size)
        return;
    unsigned char *bytes = malloc(block.byte_size);
    mxg_result_pack_block(result, NULL, number, bytes, block.byte_size);
    for (uint32_t i = 0; i < block.num_variables; ++i)
        (number == MXG_BLOCK_LIGHT_DATA ? set_light : set_value)(result, block.first_variable + i,
                                                                 bytes, block.byte_size);
    draw->blocks[draw->num_blocks] = (struct draw_block){block.set, block.binding, block.byte_size};
    draw->objects[0].blocks[draw->num_blocks++] = bytes;
}

static void add_textures(struct test *t, struct draw *draw, const mxg_result *result)
{
    mxg_block_info block = block_of(result, MXG_BLOCK_TEXTURES);
    for (uint32_t i = 0; i < block.num_variables; ++i) {
        mxg_variable v = variable_of(result, block.first_variable + i);
        draw->textures[draw->num_textures++] =
            (struct draw_texture){.set = v.set,
                                  .binding = v.binding,
                                  .image = strcmp(v.semantic, "shadowMap") == 0   ? &t->shadow
                                           : strcmp(v.semantic, "ambOccMap") == 0 ? &t->open
                                                                                  : &t->around,
                                  .u = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                  .v = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                  .filter = VK_FILTER_NEAREST};
    }
}

static void add_interface(struct test *t, struct draw *draw, const mxg_result *result)
{
    mxg_block_info streams = block_of(result, MXG_BLOCK_APP_DATA);
    for (uint32_t i = 0; i < streams.num_variables; ++i) {
        mxg_variable v = variable_of(result, streams.first_variable + i);
        add_attribute(draw, v.location, v.type, v.semantic);
    }
    add_block(draw, result, MXG_BLOCK_PRIVATE_UNIFORMS);
    add_block(draw, result, MXG_BLOCK_PUBLIC_UNIFORMS);
    add_block(draw, result, MXG_BLOCK_LIGHT_DATA);
    add_textures(t, draw, result);
}

static void begin(struct draw *draw)
{
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    *draw = (struct draw){.objects = calloc(1, sizeof *draw->objects), .num_objects = 1};
    draw->objects[0].num_vertices = NUM_VERTICES;
    draw->objects[0].num_indices = 6;
    draw->objects[0].indices = indices;
}

/* Compiles, draws, and frees what `begin` and the other functions made. */
static void end(struct test *t, struct draw *draw, const char *const sources[MXG_NUM_STAGES],
                float *out)
{
    struct compiled compiled;
    memset(out, 0, NUM_FLOATS * sizeof *out);
    bool good = compile_program("vulkan", sources, &compiled);
    for (size_t i = 0; i < compiled.num_messages; ++i)
        printf("line %u: %s\n", compiled.messages[i].line, compiled.messages[i].text);
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage) {
        draw->code[stage] = compiled.stages[stage].words;
        draw->code_words[stage] = compiled.stages[stage].num_words;
    }
    struct draw_program *program = REQUIRE(good) ? draw_open(t->canvas, draw) : NULL;
    REQUIRE(program && draw_frame(t->canvas, &program, 1, out));
    draw_close(program);
    for (uint32_t i = 0; i < draw->num_attributes; ++i)
        free(draw->objects[0].attributes[i]);
    for (uint32_t i = 0; i < draw->num_blocks; ++i)
        free(draw->objects[0].blocks[i]);
    free(draw->objects);
    compiled_finish(&compiled);
}

/* With functions of the host behind the pixel stage. */
static mxg_alpha draw_hosted(struct test *t, const char *element, const char *const *options,
                             const char *host, float *out)
{
    struct draw draw;
    mxg_result *result = generate(t, element, options);
    const char *pixel = mxg_result_source(result, MXG_STAGE_PIXEL, NULL);
    char *text_of_stage = malloc(strlen(pixel) + strlen(host) + 1);
    sprintf(text_of_stage, "%s%s", pixel, host);
    const char *sources[] = {mxg_result_source(result, MXG_STAGE_VERTEX, NULL), text_of_stage};
    mxg_shader_info info = MXG_INIT(mxg_shader_info);
    mxg_result_info(result, &info);
    begin(&draw);
    add_interface(t, &draw, result);
    end(t, &draw, sources, out);
    free(text_of_stage);
    mxg_result_destroy(result);
    return info.alpha;
}

static mxg_alpha draw_program_of(struct test *t, const char *element, const char *const *options,
                                 float *out)
{
    return draw_hosted(t, element, options, "", out);
}

/* ---- Functions in a file of a host ---- */

static const char host_vertex[] =
    "#version 450\n"
    "layout(location = 0) in vec3 position;\nlayout(location = 1) in vec3 normal;\n"
    "layout(location = 2) in vec3 tangent;\nlayout(location = 3) in vec2 uv;\n"
    "layout(location = 0) out vec3 P;\nlayout(location = 1) out vec3 N;\n"
    "layout(location = 2) out vec3 T;\nlayout(location = 3) out vec2 UV;\n"
    "void main()\n{\n    P = position;\n    N = normalize(normal);\n    T = tangent;\n    UV = "
    "uv;\n"
    "    gl_Position = vec4(position, 1.0);\n}\n";

static const char host_head[] =
    "#version 450\n"
    "layout(location = 0) in vec3 P;\nlayout(location = 1) in vec3 N;\n"
    "layout(location = 2) in vec3 T;\nlayout(location = 3) in vec2 UV;\n"
    "layout(location = 0) out vec4 host_color;\n"
    "const vec3 host_eye = vec3(0.0, 0.0, 3.0);\n";

static const char host_lights[] =
    "int mxg_light_count() { return 1; }\n"
    "void mxg_light(int i, vec3 at, out vec3 L, out vec3 radiance)\n{\n"
    "    L = vec3(-0.36, 0.48, 0.8);\n    radiance = vec3(2.0, 1.5, 1.0);\n}\n";

/* "gold_surface(P, N, T)" */
static void write_call(const mxg_result *result, char *out, size_t capacity)
{
    static const char *const streams[][2] = {{"position:world", "P"},
                                             {"normal:world", "N"},
                                             {"tangent:world", "T"},
                                             {"texcoord:0", "UV"}};
    mxg_shader_info info = MXG_INIT(mxg_shader_info);
    mxg_block_info block = block_of(result, MXG_BLOCK_VERTEX_DATA);
    mxg_result_info(result, &info);
    size_t len = (size_t)snprintf(out, capacity, "%s s = %s(", info.function_type, info.function);
    for (uint32_t i = 0; i < block.num_variables; ++i) {
        mxg_variable v = variable_of(result, block.first_variable + i);
        const char *argument = NULL;
        for (size_t k = 0; k < sizeof streams / sizeof *streams; ++k)
            if (strcmp(streams[k][0], v.semantic) == 0)
                argument = streams[k][1];
        REQUIRE(argument);
        len += (size_t)snprintf(out + len, capacity - len, "%s%s", i ? ", " : "", argument);
    }
    snprintf(out + len, capacity - len, ");");
}

/* Left the first function, right the second. */
static void draw_functions(struct test *t, const mxg_result *const functions[2], float *out)
{
    const char *source[2] = {mxg_result_source(functions[0], MXG_STAGE_PIXEL, NULL),
                             mxg_result_source(functions[1], MXG_STAGE_PIXEL, NULL)};
    char calls[2][256];
    size_t capacity = strlen(source[0]) + strlen(source[1]) + 8192;
    char *file = malloc(capacity);
    struct draw draw;
    begin(&draw);
    add_attribute(&draw, 0, "vec3", "position:object");
    add_attribute(&draw, 1, "vec3", "normal:object");
    add_attribute(&draw, 2, "vec3", "tangent:object");
    add_attribute(&draw, 3, "vec2", "texcoord:0");
    for (int i = 0; i < 2; ++i) {
        write_call(functions[i], calls[i], sizeof calls[i]);
        add_interface(t, &draw, functions[i]);
    }
    snprintf(file, capacity,
             "%s%s%s%svoid main()\n{\n    if (gl_FragCoord.x < %d.0) {\n        %s\n"
             "        host_color = vec4(s.color, s.alpha);\n    } else {\n        %s\n"
             "        host_color = vec4(s.color, s.alpha);\n    }\n}\n",
             host_head, source[0], source[1], host_lights, SIZE / 2, calls[0], calls[1]);
    end(t, &draw, (const char *const[]){host_vertex, file}, out);
    free(file);
}

/* The largest difference of two pictures in one half of the columns, and the brightest value. */
static float difference(const float *a, const float *b, int half, float *out_most)
{
    float most = 0, worst = 0;
    for (int i = 0; i < NUM_FLOATS; ++i) {
        if (i / 4 % SIZE / (SIZE / 2) != half)
            continue;
        worst = fmaxf(worst, fabsf(a[i] - b[i]));
        most = fmaxf(most, fabsf(a[i]));
    }
    *out_most = most;
    return worst;
}

static void test_functions(struct test *t)
{
    static float a[NUM_FLOATS], b[NUM_FLOATS], both[NUM_FLOATS];
    static const char *const none[] = {NULL},
                             *const of_a[] = {"role", "function", "prefix", "left_", NULL},
                             *const of_b[] = {"role",
                                              "function",
                                              "prefix",
                                              "right_",
                                              "first-binding",
                                              "20",
                                              "rename",
                                              "u_viewPosition=host_eye,surface=shade_b",
                                              NULL};
    draw_program_of(t, "MA", none, a);
    draw_program_of(t, "MB", none, b);
    mxg_result *functions[2] = {generate(t, "MA", of_a), generate(t, "MB", of_b)};
    draw_functions(t, (const mxg_result *const *)functions, both);
    float most;
    REQUIRE(difference(a, both, 0, &most) < 1e-4f && most > 0.2f);
    REQUIRE(difference(b, both, 1, &most) < 1e-4f && most > 0.2f);
    REQUIRE(difference(a, b, 0, &most) > 0.1f); /* the documents look different */
    for (int i = 0; i < 2; ++i)
        mxg_result_destroy(functions[i]);
}

/* ---- Options ---- */

static void draw_both(struct test *t, const char *element, const char *const *without,
                      const char *const *with, float *out_without, float *out_with)
{
    draw_program_of(t, element, without, out_without);
    draw_program_of(t, element, with, out_with);
}

/* The map has depth 0.25 on the left, so the square at 0.75 is in the shadow there. */
static void test_shadow(struct test *t)
{
    static float lit[NUM_FLOATS], dark[NUM_FLOATS];
    static const char *const without[] = {"environment", "none", NULL}, *const with[] = {
                                                                            "environment", "none",
                                                                            "shadow-map", "true",
                                                                            NULL};
    draw_both(t, "D", without, with, lit, dark);
    for (int i = 0; i < NUM_FLOATS; ++i) {
        bool is_left = i / 4 % SIZE < SIZE / 2, is_alpha = i % 4 == 3;
        float expected = is_left && !is_alpha ? 0.0f : lit[i];
        if (fabsf(dark[i] - expected) > 1e-3f * fmaxf(lit[i], 0.01f)) {
            REQUIRE(dark[i] == expected);
            printf("    at %d: %g instead of %g\n", i, (double)dark[i], (double)expected);
            return;
        }
    }
    REQUIRE(lit[0] > 0.05f);
}

/* The map has 0.25, and the gain is a half: a mean of 1 and 0.25. */
static void test_occlusion(struct test *t)
{
    static float bright[NUM_FLOATS], dark[NUM_FLOATS];
    static const char *const without[] = {"lights", "none", NULL}, *const with[] = {"lights",
                                                                                    "none",
                                                                                    "occlusion-map",
                                                                                    "true", NULL};
    draw_both(t, "D", without, with, bright, dark);
    bool holds = bright[0] > 0.05f;
    for (int i = 0; i < NUM_FLOATS; ++i)
        holds &=
            fabsf(dark[i] - bright[i] * (i % 4 == 3 ? 1.0f : 0.625f)) < 2e-3f * bright[i] + 1e-5f;
    REQUIRE(holds);
}

/* A body is as thick as the host says: a ball of diameter 1 and 1 mm of amber, as by default, or
 * more. */
static void test_thickness(struct test *t)
{
    static float plain[NUM_FLOATS], asked[NUM_FLOATS], thick[NUM_FLOATS];
    static const char *const own[] = {NULL}, *const hosted[] = {"host-thickness", "true", NULL};
    static const struct {
        const char *element, *same, *more;
    } bodies[] = {{"V",
                   "float mxg_thickness(vec3 P, vec3 D)\n{\n"
                   "    return dot(normalize(vec3(0.5 * P.xy, 1.0)), -D);\n}\n",
                   "float mxg_thickness(vec3 P, vec3 D) { return 9.0; }\n"},
                  {"S", "float mxg_thickness(vec3 P, vec3 D) { return 0.1; }\n",
                   "float mxg_thickness(vec3 P, vec3 D) { return D.z < 0.0 ? 9.0 : 0.1; }\n"}};
    for (size_t i = 0; i < sizeof bodies / sizeof *bodies; ++i) {
        float most, same = 0, more = 0;
        draw_program_of(t, bodies[i].element, own, plain);
        draw_hosted(t, bodies[i].element, hosted, bodies[i].same, asked);
        draw_hosted(t, bodies[i].element, hosted, bodies[i].more, thick);
        for (int half = 0; half < 2; ++half) {
            same = fmaxf(same, difference(plain, asked, half, &most));
            more = fmaxf(more, difference(plain, thick, half, &most));
        }
        if (!REQUIRE(same < 1e-4f && more > 0.02f))
            printf("    %s: %g and %g\n", bodies[i].element, (double)same, (double)more);
    }
}

/* IEC 61966-2-1 */
static float encoded(float linear)
{
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * powf(linear, 1 / 2.4f) - 0.055f;
}

static void test_encoding(struct test *t)
{
    static float linear[NUM_FLOATS], srgb[NUM_FLOATS];
    static const char *const without[] = {NULL}, *const with[] = {"encode", "srgb", NULL};
    static const char *const elements[] = {"Grey", "MB"};
    for (size_t e = 0; e < 2; ++e) {
        bool holds = true;
        draw_both(t, elements[e], without, with, linear, srgb);
        for (int i = 0; i < NUM_FLOATS; ++i) {
            float expected = i % 4 == 3 ? linear[i] : encoded(linear[i]);
            holds &= fabsf(srgb[i] - expected) < 1e-3f * fmaxf(1.0f, expected);
        }
        REQUIRE(holds && linear[0] > 0.01f);
    }
}

static void test_transparency(struct test *t)
{
    static float whole[NUM_FLOATS], picture[NUM_FLOATS];
    static const struct {
        const char *value;
        mxg_alpha drawn;
        float color, alpha;
    } modes[] = {{"auto", MXG_ALPHA_BLEND, 0.25f, 0.25f},
                 {"blend", MXG_ALPHA_BLEND, 0.25f, 0.25f},
                 {"mask", MXG_ALPHA_MASK, 1.0f, 1.0f},
                 {"opaque", MXG_ALPHA_OPAQUE, 1.0f, 1.0f}};
    static const char *const none[] = {NULL};
    draw_program_of(t, "D", none, whole);
    REQUIRE(whole[0] > 0.05f);
    for (size_t m = 0; m < sizeof modes / sizeof *modes; ++m) {
        const char *const options[] = {"transparency", modes[m].value, NULL};
        REQUIRE_EQ(draw_program_of(t, "C", options, picture), modes[m].drawn);
        bool holds = true;
        for (int i = 0; i < NUM_FLOATS; ++i) {
            float expected = i % 4 == 3 ? modes[m].alpha : modes[m].color * whole[i];
            holds &= fabsf(picture[i] - expected) < 2e-3f * expected + 1e-5f;
        }
        if (!REQUIRE(holds))
            printf("    transparency %s\n", modes[m].value);
    }
}

/* ---- Maps ---- */

static float *pixels_of(struct image *out, uint32_t width, uint32_t height)
{
    *out = (struct image){.width = width,
                          .height = height,
                          .is_float = true,
                          .pixels = calloc((size_t)width * height * 4, sizeof(float))};
    return out->pixels;
}

static void make_maps(struct test *t)
{
    float *around = pixels_of(&t->around, 8, 4), *shadow = pixels_of(&t->shadow, 2, 1),
          *open = pixels_of(&t->open, 1, 1);
    for (int i = 0; i < 8 * 4 * 4; ++i)
        around[i] = 0.2f + 0.02f * (float)(i / 4) + 0.1f * (float)(i % 4);
    shadow[0] = 0.25f; /* mean depth, and mean square */
    shadow[1] = 0.0625f;
    shadow[4] = shadow[5] = 1.0f;
    open[0] = 0.25f;
}

int main(void)
{
    struct test t = {0};
    if (!gpu_open(&t.gpu)) {
        printf("skip: there is no Vulkan device: %s\nform: 0 passed, 0 failed, 1 skipped\n",
               t.gpu.reason);
        return EXIT_SKIPPED;
    }
    compile_begin();
    make_maps(&t);
    REQUIRE(mxg_context_create(NULL, &t.context) == MXG_OK);
    t.library = mxg_library_builtin(t.context);
    REQUIRE(
        mxg_document_parse(t.context, t.library, "form.mtlx", text, sizeof text - 1, &t.document)
        == MXG_OK);
    t.canvas = draw_open_canvas(&t.gpu, SIZE, SIZE);
    if (REQUIRE(t.canvas)) {
        test_functions(&t);
        test_shadow(&t);
        test_occlusion(&t);
        test_thickness(&t);
        test_encoding(&t);
        test_transparency(&t);
    }
    draw_close_canvas(t.canvas);
    gpu_close(&t.gpu);
    free(t.around.pixels);
    free(t.shadow.pixels);
    free(t.open.pixels);
    mxg_document_destroy(t.document);
    mxg_library_unref(t.library);
    mxg_context_destroy(t.context);
    compile_end();
    return test_report("form");
}
