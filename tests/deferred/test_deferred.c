// SPDX-License-Identifier: Apache-2.0
/*
 * The deferred pipeline on a device: pictures beside those of the forward
 * pipeline, and the words that pixels really store. Arguments: the folder of
 * the examples, and that of other documents.
 */
#include "unit/test.h"

#include "deferred/drawing.h"
#include "render/matrix.h"

#include <math.h>
#include <stdlib.h>

/* ---- Rays ---- */

/*
 * A ray per pixel to the ball, without a mesh. OF_WORLD and TO_WORLD: matrices
 * of the object. The text of the payload function stands before.
 */
static const char hits_source[] =
    "layout(local_size_x = 8, local_size_y = 8) in;\n"
    "layout(set = 1, binding = 8, std140) uniform Frame { mat4 to_world; uvec4 "
    "size; };\n"
    "layout(set = 1, binding = 9, std430) buffer Payloads { Surface "
    "payloads[]; };\n"
    "struct Ray { vec4 point, view; };\n"
    "layout(set = 1, binding = 10, std430) buffer Rays { Ray rays[]; };\n"
    "bool hit(vec2 at, out vec3 point, out vec3 way)\n"
    "{\n"
    "    vec4 a = to_world * vec4(at, 0.0, 1.0), b = to_world * vec4(at, 1.0, "
    "1.0);\n"
    "    vec3 from = a.xyz / a.w, out_of = from - OF_OBJECT[3].xyz;\n"
    "    way = normalize(b.xyz / b.w - from);\n"
    "    float along = dot(out_of, way), inside = along * along - dot(out_of, "
    "out_of) + 1.0;\n"
    "    point = from - (along + sqrt(max(inside, 0.0))) * way;\n"
    "    return inside >= 0.0;\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    vec2 at = vec2(gl_GlobalInvocationID.xy) + 0.5;\n"
    "    vec3 point, way, dx, dy, ignored;\n"
    "    if (!hit(at, point, way))\n"
    "        return;\n"
    "    dx = hit(at + vec2(1.0, 0.0), dx, ignored) ? dx - point : vec3(0.0);\n"
    "    dy = hit(at + vec2(0.0, 1.0), dy, ignored) ? dy - point : vec3(0.0);\n"
    "    vec3 normal = point - OF_OBJECT[3].xyz, local = normal * "
    "mat3(OF_OBJECT);\n" /* rotates */
    "    vec3 tangent = mat3(OF_OBJECT) * normalize(vec3(local.z, 0.0, "
    "-local.x));\n"
    "    uint pixel = gl_GlobalInvocationID.y * size.x + "
    "gl_GlobalInvocationID.x;\n"
    "    rays[pixel] = Ray(vec4(point, 0.0), vec4(-way, 0.0));\n"
    "    payloads[pixel] = surface(";

/* Vertex data of a hit. */
static const char *hit_value(const char *name)
{
    static const char *const values[][2] = {{"positionWorld", "point"},
                                            {"normalWorld", "normal"},
                                            {"tangentWorld", "tangent"},
                                            {"viewWorld", "-way"},
                                            {"positionObject", "local"},
                                            {"dx_positionWorld", "dx"},
                                            {"dx_normalWorld", "dx"},
                                            {"dy_positionWorld", "dy"},
                                            {"dy_normalWorld", "dy"},
                                            {"texcoord_0",
                                             "vec2(fract(atan(local.x, local.z) / 6.2831853), "
                                             "acos(-local.y) / 3.1415927)"}};
    for (size_t i = 0; i < sizeof values / sizeof *values; ++i)
        if (strcmp(values[i][0], name) == 0)
            return values[i][1];
    return NULL;
}

static bool write_hits(struct bench *b, const mxg_result *result, char *out, size_t room)
{
    size_t len = (size_t)snprintf(out, room, "#version 450\n%s\nconst mat4 OF_OBJECT = mat4(",
                                  mxg_result_source(result, MXG_STAGE_PIXEL, NULL));
    for (size_t i = 0; i < 16 && len < room; ++i)
        len += (size_t)snprintf(out + len, room - len, "%s%.9g", i ? ", " : "",
                                b->scene.object.world.m[i / 4][i % 4]);
    if (len < room)
        len += (size_t)snprintf(out + len, room - len, ");\n%s", hits_source);
    const char *between = "";
    for (uint32_t i = 0; i < mxg_result_num_variables(result) && len < room; ++i) {
        mxg_variable variable = {sizeof variable};
        mxg_result_variable(result, i, &variable);
        if (variable.block != MXG_BLOCK_VERTEX_DATA)
            continue;
        const char *value = hit_value(variable.name);
        if (!REQUIRE(value))
            printf("    a hit has no %s\n", variable.name);
        len += (size_t)snprintf(out + len, room - len, "%s%s", between, value ? value : "vec3(0)");
        between = ", ";
    }
    if (len < room)
        len += (size_t)snprintf(out + len, room - len, ");\n}\n");
    return REQUIRE(len < room);
}

/* Draws an element by payloads alone: no mesh, no lights but those of the pass
 * over them. */
static bool draw_rays(struct bench *b, const char *element, struct drawing *d)
{
    static char text[1 << 17];
    *d = (struct drawing){.pixels = malloc(PIXELS * 4 * sizeof(float)), .count = 1};
    d->canvas = draw_open_canvas(&b->gpu, SIZE, SIZE);
    mxg_options_set(b->options, "form", "payload");
    bool good = drawing_generate(b, element, "forward", "dither", &d->results[0]);
    mxg_options_set(b->options, "form", "program");
    if (!good || !write_hits(b, d->results[0], text, sizeof text))
        return false;
    struct passes_setup setup = {.context = b->context,
                                 .options = b->options,
                                 .scene = &b->scene,
                                 .canvas = d->canvas,
                                 .shown = UINT32_MAX,
                                 .hits = text};
    good = passes_open(&setup, &d->passes);
    if (!good)
        printf("%s\n", d->passes.reason);
    for (size_t i = 0; good && i < PIXELS * PAYLOAD_WORDS; ++i)
        d->passes.payloads[i] = MARK;
    return REQUIRE(good && render_frame(NULL, 0, d->canvas, d->pixels));
}

/* ---- Pictures ---- */

static double displayed(float linear)
{
    double x = fmin(fmax(0.6 * linear, 0), 1);
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055);
}

/* Of the colours as a display shows them. */
static double psnr(const float *a, const float *b)
{
    double sum = 0;
    for (size_t i = 0; i < PIXELS * 4; ++i) {
        double error = i % 4 == 3 ? 0 : displayed(a[i]) - displayed(b[i]);
        sum += error * error;
    }
    return sum > 0 ? 10 * log10(255 * 255 / (sum / (PIXELS * 3))) : INFINITY;
}

static void test_picture(struct bench *b, const char *element)
{
    static const struct {
        const char *storage;
        double least;
    } kinds[] = {{"float", 45}, {"dither", 38}, {"round", 38}};
    struct drawing forward, deferred;
    bool good = drawing_open(b, element, NULL, UINT32_MAX, &forward);
    printf("%-12s", element);
    for (size_t i = 0; good && i < sizeof kinds / sizeof *kinds; ++i) {
        if (drawing_open(b, element, kinds[i].storage, UINT32_MAX, &deferred)) {
            double db = psnr(forward.pixels, deferred.pixels);
            printf(" %s %.1f dB", kinds[i].storage, db);
            REQUIRE(deferred.stored_words > 0);
            REQUIRE(db > kinds[i].least);
        }
        drawing_close(&deferred);
    }
    printf("\n");
    drawing_close(&forward);
}

/* ---- Bands ---- */

/* The error that areas of 8x8 pixels have in common: what an eye sees as bands.
 */
static double error_of_areas(const float *a, const float *b)
{
    enum { AREA = 8 };
    double sum = 0;
    size_t count = 0;
    for (size_t top = 0; top + AREA <= SIZE; top += AREA)
        for (size_t left = 0; left + AREA <= SIZE; left += AREA) {
            double mean[3] = {0};
            for (size_t i = 0; i < AREA * AREA; ++i) {
                size_t at = 4 * ((top + i / AREA) * SIZE + left + i % AREA);
                for (size_t c = 0; c < 3; ++c)
                    mean[c] += (displayed(a[at + c]) - displayed(b[at + c])) / (AREA * AREA);
            }
            for (size_t c = 0; c < 3; ++c, ++count)
                sum += mean[c] * mean[c];
        }
    return sqrt(sum / (double)count);
}

/* Noise hides the bands of few bits. */
static void test_bands(struct bench *b)
{
    static const char *const storages[] = {"dither", "round"};
    struct drawing forward, deferred;
    double errors[2] = {0};
    bool good = drawing_open(b, "Banded", NULL, UINT32_MAX, &forward);
    for (size_t i = 0; i < 2; ++i) {
        if (good && drawing_open(b, "Banded", storages[i], UINT32_MAX, &deferred))
            errors[i] = error_of_areas(forward.pixels, deferred.pixels);
        drawing_close(&deferred);
    }
    printf("bands: error of areas with dither %.3f, without %.3f of 255\n", errors[0], errors[1]);
    REQUIRE(errors[1] > 0 && errors[0] < 0.5 * errors[1]);
    drawing_close(&forward);
}

/* ---- Payloads ---- */

/* Pixels that face the viewer: edges differ, because a mesh has corners. */
static bool faces(size_t pixel)
{
    double x = (double)(pixel % SIZE) + 0.5 - SIZE / 2, y = (double)(pixel / SIZE) + 0.5 - SIZE / 2;
    return hypot(x, y) < 0.36 * SIZE;
}

/* The words of a payload, whose neighbours stay as they were. */
static void check_payload(struct drawing *d, size_t pixel)
{
    const uint32_t *words = d->passes.payloads + pixel * PAYLOAD_WORDS;
    enum { USED = 11 };
    for (size_t i = 0; i < PAYLOAD_WORDS; ++i)
        REQUIRE(words[i] != MARK);
    for (size_t i = USED; i < PAYLOAD_WORDS; ++i)
        REQUIRE_EQ(words[i], 0);               /* the host's */
    const uint32_t *none = d->passes.payloads; /* the corner has no hit */
    for (size_t i = 0; i < PAYLOAD_WORDS; ++i)
        REQUIRE_EQ(none[i], MARK);
}

/* One slab in 64 bytes draws what forward draws with one slab. */
static void test_payload(struct bench *b, const char *element, double least)
{
    struct drawing forward, rays;
    mxg_options_set(b->options, "max-closures", "1");
    if (drawing_open(b, element, NULL, UINT32_MAX, &forward) && draw_rays(b, element, &rays)) {
        mxg_shader_info info = {sizeof info};
        mxg_result_info(rays.results[0], &info);
        REQUIRE_EQ(info.stored_words, PAYLOAD_WORDS);
        check_payload(&rays, PIXELS / 2 + SIZE / 2);
        size_t differing = 0;
        for (size_t i = 0; i < PIXELS; ++i) {
            /* forward shows the inside of the ball through holes */
            bool is_hole = rays.pixels[4 * i + 3] < 0.5f;
            bool differs = faces(i) && !is_hole && forward.pixels[4 * i + 3] < 0.5f;
            differing += differs;
            for (size_t c = 0; (differs || is_hole || !faces(i)) && c < 4; ++c)
                forward.pixels[4 * i + c] = rays.pixels[4 * i + c] = 0;
        }
        if (!REQUIRE(differing < PIXELS / 20)) /* edges of holes */
            printf("    %zu pixels differ\n", differing);
        double db = psnr(forward.pixels, rays.pixels);
        printf("%-12s payload %.1f dB\n", element, db);
        REQUIRE(db > least);
    }
    drawing_close(&rays);
    drawing_close(&forward);
    mxg_options_set(b->options, "max-closures", "0");
}

/* ---- Sizes ---- */

/* The words of a pixel that the material wrote. */
static uint32_t written(struct drawing *d, uint32_t x, uint32_t y, uint32_t *words)
{
    uint32_t count = d->stored_words;
    if (!REQUIRE(count >= 3 && count <= MAX_WORDS)
        || !REQUIRE(stored_read(d->passes.stored, x, y, words, count)))
        return 0;
    while (count > 3 && words[count - 1] == MARK)
        --count;
    return count;
}

/* The passes that light a class of pixels; those of other classes are left out. */
static uint32_t num_lighting(const struct passes *passes)
{
    uint32_t num = 0;
    for (uint32_t i = 0; i < passes->num_parts; ++i) {
        mxg_shader_info info = {sizeof info};
        mxg_result_info(passes->parts[i].result, &info);
        num += info.stored_classes != 0;
    }
    return num;
}

/* docs/deferred.md has this table. */
static void test_sizes(struct bench *b)
{
    static const struct {
        const char *element;
        uint32_t bytes, top, closures; /* top: the highest four bits of word 0 */
        uint32_t passes;               /* that light a class */
    } rows[] = {{"Plain", 12, 1, 1, 1},  {"Wax", 16, 2, 1, 2},       {"Hazy", 20, 2, 1, 2},
                {"Downy", 24, 2, 1, 2},  {"Satin", 28, 3, 1, 3},     {"Lacquered", 40, 3, 2, 3},
                {"Pearly", 44, 5, 2, 4}, {"Glittering", 60, 7, 2, 4}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        struct drawing d;
        uint32_t words[MAX_WORDS] = {0};
        if (drawing_open(b, rows[i].element, "round", UINT32_MAX, &d)) {
            REQUIRE_EQ(4 * written(&d, SIZE / 2, SIZE / 2, words), rows[i].bytes);
            REQUIRE_EQ(4 * d.stored_words, rows[i].bytes);
            REQUIRE_EQ(words[0] >> 28, rows[i].top);
            REQUIRE_EQ(num_lighting(&d.passes), rows[i].passes);
            REQUIRE_EQ((words[1] >> 28) + 1, rows[i].closures);
            REQUIRE(stored_read(d.passes.stored, 0, 0, words, 3)); /* beside the sphere */
            REQUIRE_EQ(words[0], 0);
        }
        drawing_close(&d);
    }
}

/* A closure of weight 0 in a pixel is not there: the ends of the mix are one
 * slab each. */
static void test_culling(struct bench *b)
{
    enum { SIMPLE = 1, COMPLEX = 3 };
    static const uint32_t bytes[] = {[SIMPLE] = 12, [COMPLEX] = 32};
    uint32_t words[MAX_WORDS], seen[4] = {0};
    struct drawing d;
    if (drawing_open(b, "Chipped", "round", UINT32_MAX, &d))
        for (uint32_t y = 0; y < SIZE; y += 4) {
            uint32_t size = 4 * written(&d, SIZE / 2, y, words), which = words[0] >> 28;
            if (which == 0)
                continue;
            if (REQUIRE(which == SIMPLE || which == COMPLEX))
                REQUIRE_EQ(size, bytes[which]);
            ++seen[which & 3];
        }
    REQUIRE(seen[SIMPLE] > 0 && seen[COMPLEX] > 0);
    drawing_close(&d);
}

/* ---- Order ---- */

/*
 * A ball around another one hides it, in either order: the one whose words are all in targets has
 * no depth pass, the other one has layers of an image.
 */
static void test_order(struct bench *b)
{
    static const char *const pairs[][2] = {{"Plain", "Lacquered"}, {"Lacquered", "Plain"}};
    for (size_t i = 0; i < 4; ++i) {
        const char *const *pair = pairs[i / 2]; /* outside, inside */
        size_t first = i % 2;
        struct drawing_part parts[2] = {{pair[first], b->scene.object},
                                        {pair[1 - first], b->scene.object}};
        struct matrix *inside = &parts[1 - first].object.world;
        *inside = matrix_multiply(*inside, matrix_scale(0.9, 0.9, 0.9));
        struct drawing alone, both;
        if (drawing_open(b, pair[0], "round", UINT32_MAX, &alone)
            && drawing_open_both(b, parts, &both))
            REQUIRE(memcmp(alone.pixels, both.pixels, PIXELS * 4 * sizeof(float)) == 0);
        drawing_close(&alone);
        drawing_close(&both);
    }
}

/* ---- Debug views ---- */

static void test_views(struct bench *b)
{
    static const struct {
        const char *element;
        uint32_t view;
        float rgb[3];
    } rows[] = {{"Lacquered", 1, {40 / 255.0f, 40 / 255.0f, 40 / 255.0f}},
                {"Lacquered", 2, {2 / 255.0f, 2 / 255.0f, 2 / 255.0f}},
                {"Plain", 0, {0, 0.6f, 0}},
                {"Satin", 0, {0.8f, 0, 0}},
                {"Plain", 3, {1, 1, 1}},
                /* below the interface, f0 0.04, and twice through (0.95, 0.8, 0.6) */
                {"Lacquered", 4, {0.96f * 0.9025f, 0.96f * 0.64f, 0.96f * 0.36f}},
                {"Plain", 5, {0.6f, 0.2f, 0.1f}}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        struct drawing d;
        if (drawing_open(b, rows[i].element, "round", rows[i].view, &d)) {
            const float *pixel = d.pixels + 4 * (SIZE / 2 * SIZE + SIZE / 2);
            for (size_t c = 0; c < 3; ++c)
                if (!REQUIRE(fabsf(pixel[c] - rows[i].rgb[c]) < 0.02f))
                    printf("    %s, %s: %g\n", rows[i].element, pass_views[rows[i].view],
                           (double)pixel[c]);
            REQUIRE(d.pixels[3] == 0); /* nothing is stored beside the sphere */
        }
        drawing_close(&d);
    }
}

/* ---- Stacks ---- */

enum { NUM_LAYERS = 8 };

/* Eight layers of slabs, each with its colour, roughness and, but for the
 * first, mask. */
static void write_layers(char *text, size_t size)
{
    size_t len =
        (size_t)snprintf(text, size, "<materialx version='1.39'><normal name='n' type='vector3'/>");
    for (int i = 0; i < NUM_LAYERS; ++i)
        len +=
            (size_t)snprintf(text + len, size - len,
                             "<slab name='b%d' type='BSDF'><input name='diffuse_albedo' "
                             "type='color3' "
                             "value='0.%d, 0.%d, 0.%d'/><input name='roughness' type='float' "
                             "value='0.%d'/></slab>"
                             "<slab_surface name='s%d' type='surfaceshader'>"
                             "<input name='bsdf' type='BSDF' nodename='b%d'/></slab_surface>"
                             "<dotproduct name='d%d' type='float'><input name='in1' type='vector3' "
                             "nodename='n'/>"
                             "<input name='in2' type='vector3' value='0.%d, -0.%d, "
                             "0.%d'/></dotproduct>"
                             "<smoothstep name='k%d' type='float'><input name='in' type='float' "
                             "nodename='d%d'/>"
                             "<input name='low' type='float' value='-0.3'/></smoothstep>"
                             "<substance name='m%d' type='material'>"
                             "<input name='surfaceshader' type='surfaceshader' nodename='s%d'/>"
                             "<input name='mask' type='float' %s/></substance>",
                             i, i + 1, 3 * i % 8 + 1, 5 * i % 8 + 1, i + 2, i, i, i, 2 * i % 9,
                             4 * i % 9, 5 * i % 9, i, i, i, i,
                             i ? (const char[]){'n', 'o', 'd', 'e', 'n', 'a', 'm', 'e', '=', '\'',
                                                'k', (char)('0' + i), '\'', 0}
                               : "value='1'");
    len += (size_t)snprintf(text + len, size - len, "<look name='L'>");
    for (int i = 0; i < NUM_LAYERS; ++i)
        len += (size_t)snprintf(text + len, size - len,
                                "<materialassign name='a%d' slot='00%d' material='m%d' geom='/'/>",
                                i, i, i);
    snprintf(text + len, size - len, "</look></materialx>");
}

/* The most closures that a pixel of the middle column stores. */
static uint32_t most_closures(struct drawing *d)
{
    uint32_t words[MAX_WORDS] = {0}, most = 0;
    for (uint32_t y = 0; y < SIZE; y += 4)
        if (REQUIRE(stored_read(d->passes.stored, SIZE / 2, y, words, 3)) && words[0]
            && (words[1] >> 28) + 1 > most)
            most = (words[1] >> 28) + 1;
    return most;
}

/* Each layer is stored where its mask is not 0; a budget makes fewer slabs of
 * them. */
static void test_stack(struct bench *b)
{
    static const char *const path = "/ball";
    static char text[1 << 14];
    mxg_scene *scene = NULL;
    struct drawing d;
    write_layers(text, sizeof text);
    mxg_document_destroy(b->document);
    b->document = NULL;
    if (!REQUIRE_EQ(mxg_document_parse(b->context, mxg_library_builtin(b->context), "layers.mtlx",
                                       text, strlen(text), &b->document),
                    MXG_OK)
        || !REQUIRE_EQ(mxg_scene_create(b->context, &scene), MXG_OK)
        || !REQUIRE_EQ(mxg_scene_add(scene, &path, 1), MXG_OK)
        || !REQUIRE_EQ(mxg_bind(b->context, b->document, scene, NULL, &b->bindings), MXG_OK))
        return;
    REQUIRE_EQ(mxg_bindings_num_stacks(b->bindings), 1);
    test_picture(b, "eight layers");
    if (drawing_open(b, "eight layers", "round", UINT32_MAX, &d))
        REQUIRE_EQ(most_closures(&d), NUM_LAYERS);
    drawing_close(&d);
    mxg_options_set(b->options, "max-closures", "3");
    test_picture(b, "three slabs");
    if (drawing_open(b, "three slabs", "round", UINT32_MAX, &d)) {
        uint32_t most = most_closures(&d);
        REQUIRE(most > 0 && most <= 3);
    }
    drawing_close(&d);
    mxg_options_set(b->options, "max-closures", "0");
    mxg_bindings_destroy(b->bindings);
    b->bindings = NULL;
    mxg_scene_destroy(scene);
}

static bool open_document(struct bench *b, const char *folder, const char *name)
{
    snprintf(b->path, sizeof b->path, "%s/%s", folder, name);
    mxg_document_destroy(b->document);
    b->document = NULL;
    return REQUIRE_EQ(
        mxg_document_load(b->context, mxg_library_builtin(b->context), b->path, &b->document),
        MXG_OK);
}

int main(int argc, char **argv)
{
    static const char *const specials[] = {"Pearly", "Glittering"}, *const paints[] = {
                                                                        "FlakePaint", "PearlPaint"};
    static const char *const features[] = {"Plain", "Wax",       "Hazy",    "Downy",
                                           "Satin", "Lacquered", "Chipped", "Lantern"},
                             *const blends[] = {"CarbonAndMetal", "SkinIntoGold", "CoatedSkin",
                                                "MetalToPlastic", "Opal"},
                             *const helpers[] = {"HazyMetal", "DustyLacquer", "FlipFlop",
                                                 "AmberOnOak", "ScreenInVelvet"},
                             *const layers[] = {"CoatedMetal", "DustyFibre", "WrappedSilk",
                                                "CarPaint"},
                             *const others[] = {"Painted", "Brushed", "Cloth", "Toy",
                                                "Preview", "Disney",  "Wood"};
    struct bench b = {0};
    if (argc != 3)
        return 2;
    if (!bench_open(&b))
        return 77;
    REQUIRE(scene_init_sphere(&b.scene, 1));
    mxg_options_set(b.options, "texture-modes", "shared");
    if (open_document(&b, argv[1], "deferred.mtlx")) {
        test_sizes(&b);
        test_culling(&b);
        test_order(&b);
        test_views(&b);
        for (size_t i = 0; i < sizeof features / sizeof *features; ++i)
            test_picture(&b, features[i]);
        for (size_t i = 0; i < sizeof specials / sizeof *specials; ++i)
            test_picture(&b, specials[i]);
        for (size_t i = 0; i < sizeof features / sizeof *features; ++i)
            test_payload(&b, features[i], 38);
    }
    if (open_document(&b, argv[1], "slabs.mtlx"))
        for (size_t i = 0; i < sizeof layers / sizeof *layers; ++i)
            test_picture(&b, layers[i]);
    if (b.document)
        for (size_t i = 0; i < sizeof layers / sizeof *layers; ++i)
            test_payload(&b, layers[i], 38);
    if (open_document(&b, argv[1], "slab_blends.mtlx"))
        for (size_t i = 0; i < sizeof blends / sizeof *blends; ++i)
            test_picture(&b, blends[i]);
    if (open_document(&b, argv[1], "slab_helpers.mtlx"))
        for (size_t i = 0; i < sizeof helpers / sizeof *helpers; ++i)
            test_picture(&b, helpers[i]);
    if (open_document(&b, argv[1], "slab_glints.mtlx"))
        for (size_t i = 0; i < sizeof paints / sizeof *paints; ++i)
            test_picture(&b, paints[i]);
    mxg_options_set(b.options, "slabs", "true"); /* in both pipelines */
    if (open_document(&b, argv[2], "materials.mtlx"))
        for (size_t i = 0; i < sizeof others / sizeof *others; ++i)
            test_picture(&b, others[i]);
    if (b.document)
        test_bands(&b);
    test_stack(&b);
    bench_close(&b);
    return test_report("deferred");
}
