// SPDX-License-Identifier: Apache-2.0
/*
 * Passes that ask their host for lights, shadows, occlusion and environment. Argument: the root of
 * the sources.
 */
#include "deferred/pictures.h"
#include "unit/test.h"

#include <math.h>
#include <stdlib.h>

enum { CENTER = PIXELS / 2 + SIZE / 2 };

static const char *const materials[] = {"Plain", "Downy", "Lacquered"};
enum { NUM_MATERIALS = sizeof materials / sizeof *materials };

static bool is_glsl(const struct bench *b)
{
    return strcmp(b->target, "vulkan") == 0;
}

/* Draws with the functions of a host, or NULL. They are as good for HLSL, but for a name. */
static bool draw(struct bench *b, const char *element, const char *host, struct drawing *out)
{
    char text[8192];
    snprintf(text, sizeof text, "%s%s", is_glsl(b) ? "" : "#define vec3 float3\n",
             host ? host : "");
    b->host = host ? text : NULL;
    bool good = drawing_open(b, element, "float", UINT32_MAX, out);
    b->host = NULL;
    return good;
}

/* ---- Lights ---- */

/* "vec3(1, 2, 3)" */
static const char *vector(const struct scene *scene, uint32_t light, const char *member, char *out)
{
    float v[3] = {0};
    scene_light(scene, light, member, v);
    snprintf(out, 128, "vec3(%.9g, %.9g, %.9g)", v[0], v[1], v[2]);
    return out;
}

static float number(const struct scene *scene, uint32_t light, const char *member)
{
    float v[3] = {0};
    scene_light(scene, light, member, v);
    return v[0];
}

/* The lights of the scene as functions. */
static void write_lights(const struct scene *scene, char *out, size_t size)
{
    char v[2][128];
    size_t len = (size_t)snprintf(out, size,
                                  "int mxg_light_count() { return %u; }\n"
                                  "void mxg_light(int i, vec3 P, out vec3 L, out vec3 radiance)\n"
                                  "{\n    L = radiance = vec3(0.0, 0.0, 0.0);\n",
                                  (unsigned)scene->num_lights);
    for (uint32_t i = 0; i < scene->num_lights; ++i) {
        bool is_far = number(scene, i, "type") == (float)LIGHT_DIRECTIONAL;
        len += (size_t)snprintf(out + len, size - len, "    if (i == %u) { L = %s%s%s; ",
                                (unsigned)i, is_far ? "-" : "",
                                vector(scene, i, is_far ? "direction" : "position", v[0]),
                                is_far ? "" : " - P");
        len += (size_t)snprintf(out + len, size - len,
                                "radiance = %s * %.9g / pow(%s, %.9g); L = normalize(L); }\n",
                                vector(scene, i, "color", v[1]), number(scene, i, "intensity"),
                                is_far ? "1.0" : "length(L) + 1.0", number(scene, i, "decay_rate"));
    }
    snprintf(out + len, size - len, "}\n");
}

/* The lights of the scene draw the same picture from either side. */
static void test_lights(struct bench *b)
{
    char host[4096];
    write_lights(&b->scene, host, sizeof host);
    for (size_t i = 0; i < NUM_MATERIALS; ++i) {
        struct drawing own, hosts;
        mxg_options_set(b->options, "host-lights", "false");
        bool good = draw(b, materials[i], NULL, &own);
        mxg_options_set(b->options, "host-lights", "true");
        if (draw(b, materials[i], host, &hosts) && good) {
            double db = picture_psnr(own.pixels, hosts.pixels);
            printf("%s, lights: %.0f dB\n", materials[i], db);
            REQUIRE(own.pixels[4 * CENTER] > 0.02f && db > 100);
        }
        drawing_close(&hosts);
        drawing_close(&own);
    }
    mxg_options_set(b->options, "host-lights", "false");
}

/* ---- What darkens light ---- */

/* The light of every second column is `part` of what it is without the function; others keep it. */
static void test_darkening(struct bench *b, const char *option, const char *host, float part)
{
    for (size_t i = 0; i < NUM_MATERIALS; ++i) {
        struct drawing all, some;
        float most[2] = {0, 0};
        bool good = draw(b, materials[i], NULL, &all);
        mxg_options_set(b->options, option, "true");
        if (draw(b, materials[i], host, &some) && good) {
            for (size_t k = 0; k < PIXELS * 4; ++k) {
                size_t column = k / 4 % SIZE % 2;
                float expected = all.pixels[k] * (column || k % 4 == 3 ? 1 : part);
                most[column] = fmaxf(most[column], fabsf(some.pixels[k] - expected));
            }
            printf("%s, %s: %g %g\n", materials[i], option, most[0], most[1]);
            REQUIRE(all.pixels[4 * CENTER] > 0.01f && most[0] < 2e-3f && most[1] < 2e-3f);
        }
        mxg_options_set(b->options, option, "false");
        drawing_close(&some);
        drawing_close(&all);
    }
}

/*
 * A map of the option: forward shaders draw the same picture, and another one without the map.
 * Occlusion lies by texture coordinates, which the passes do not have: the material pass reads it.
 * Shadows of the first light lie by position, so the passes read them.
 */
static void test_map(struct bench *b, const char *option, size_t num_materials)
{
    REQUIRE(environment_make_test_texture(&b->scene.texture));
    for (size_t i = 0; i < num_materials; ++i) {
        struct drawing bright, forward, stored;
        bool good = draw(b, materials[i], NULL, &bright);
        mxg_options_set(b->options, option, "true");
        good &= drawing_open(b, materials[i], NULL, UINT32_MAX, &forward);
        if (draw(b, materials[i], NULL, &stored) && good) {
            double db = picture_psnr(forward.pixels, stored.pixels),
                   of_map = picture_psnr(bright.pixels, stored.pixels);
            printf("%s, %s: %.0f dB, of the map %.0f dB\n", materials[i], option, db, of_map);
            REQUIRE(db > LIMIT_FLOAT && of_map < 40);
            REQUIRE(stored.pixels[4 * CENTER + 3] == 1);
        }
        mxg_options_set(b->options, option, "false");
        drawing_close(&stored);
        drawing_close(&forward);
        drawing_close(&bright);
    }
    image_finish(&b->scene.texture);
    b->scene.texture = (struct image){0};
}

/* ---- Environment ---- */

/* Draws in an environment of functions, and copies the colour of the middle of the ball. */
static bool draw_center(struct bench *b, const char *element, const char *host, float out[3])
{
    struct drawing d;
    bool good = draw(b, element, host, &d);
    for (int i = 0; i < 3; ++i)
        out[i] = good ? d.pixels[4 * CENTER + i] : 0;
    drawing_close(&d);
    return good;
}

#define NO_IRRADIANCE "vec3 mxg_irradiance(vec3 P, vec3 N) { return vec3(0.0, 0.0, 0.0); }\n"
#define NO_RADIANCE \
    "vec3 mxg_radiance(vec3 P, vec3 L, float roughness) { return vec3(0.0, 0.0, 0.0); }\n"
#define RADIANCE(value) \
    NO_IRRADIANCE "vec3 mxg_radiance(vec3 P, vec3 L, float roughness) { return " value "; }\n"
#define IRRADIANCE(value) NO_RADIANCE "vec3 mxg_irradiance(vec3 P, vec3 N) { return " value "; }\n"

/* Quotients of colours tell what the functions get: it stands in front of the viewer there. */
static void test_arguments(struct bench *b)
{
    float one[3], value[3], point[3], way[3], diffuse[3], normal[3];
    if (!draw_center(b, "Plain", RADIANCE("vec3(1.0, 1.0, 1.0)"), one)
        || !draw_center(b, "Plain", RADIANCE("roughness * vec3(1.0, 1.0, 1.0)"), value)
        || !draw_center(b, "Plain", RADIANCE("P + 8.0"), point)
        || !draw_center(b, "Plain", RADIANCE("L + 8.0"), way)
        || !draw_center(b, "Plain", IRRADIANCE("vec3(1.0, 1.0, 1.0)"), diffuse)
        || !draw_center(b, "Plain", IRRADIANCE("N + 8.0"), normal))
        return;
    double distance = 0, is_near = 0;
    for (int i = 0; i < 3; ++i)
        distance += pow(b->scene.eye[i] - b->scene.target[i], 2);
    for (int i = 0; i < 3; ++i) { /* the pixel is half a pixel beside the middle */
        double facing = (b->scene.eye[i] - b->scene.target[i]) / sqrt(distance);
        REQUIRE(one[i] > 0.01f && diffuse[i] > 0.01f);
        REQUIRE(fabs(value[i] / one[i] - 0.3f) < 1e-3);
        is_near = fmax(is_near, fabs(point[i] / one[i] - 8 - facing - b->scene.target[i]));
        is_near = fmax(is_near, fabs(way[i] / one[i] - 8 - facing));
        is_near = fmax(is_near, fabs(normal[i] / diffuse[i] - 8 - facing));
    }
    printf("arguments of the environment: %g\n", is_near);
    REQUIRE(is_near < 0.03);
}

/*
 * Functions of a host may read what the pixel stores, in GLSL, whose passes have all readers. The
 * interface of the top is that of the lacquer, by quotients of colours.
 */
static void test_top(struct bench *b)
{
#define TOP \
    "MxClosure mxg_top()\n{\n    MxClosure c;\n    mx_read_top(mxg_pixel, c);\n    return c;\n}\n"
    float one[3], roughness[3], f0[3], normal[3];
    double distance = 0;
    if (!draw_center(b, "Lacquered", RADIANCE("vec3(1.0, 1.0, 1.0)"), one)
        || !draw_center(b, "Lacquered", TOP RADIANCE("mxg_top().roughness * vec3(1.0, 1.0, 1.0)"),
                        roughness)
        || !draw_center(b, "Lacquered", TOP RADIANCE("mxg_top().f0"), f0)
        || !draw_center(b, "Lacquered", TOP RADIANCE("mxg_top().normal + 8.0"), normal))
        return;
    for (int i = 0; i < 3; ++i)
        distance += pow(b->scene.eye[i] - b->scene.target[i], 2);
    for (int i = 0; i < 3; ++i) {
        double facing = (b->scene.eye[i] - b->scene.target[i]) / sqrt(distance);
        REQUIRE(fabs(roughness[i] / one[i] - 0.05) < 1e-3);
        REQUIRE(fabs(f0[i] / one[i] - 0.04) < 2e-3);
        REQUIRE(fabs(normal[i] / one[i] - 8 - facing) < 0.03);
    }
}

/* A white sky of the host draws what a white map draws. */
static void test_environment(struct bench *b)
{
    static const char host[] =
        "vec3 mxg_irradiance(vec3 P, vec3 N) { return vec3(1.0, 1.0, 1.0); }\n"
        "vec3 mxg_radiance(vec3 P, vec3 L, float roughness) { return vec3(1.0, 1.0, 1.0); }\n";
    struct image *const maps[] = {&b->scene.radiance, &b->scene.irradiance};
    struct image kept[2];
    for (int i = 0; i < 2; ++i) {
        kept[i] = *maps[i];
        REQUIRE(environment_make_plain(1, maps[i]));
    }
    mxg_options_set(b->options, "environment", "prefiltered");
    for (size_t i = 0; i < NUM_MATERIALS; ++i) {
        struct drawing own, hosts;
        bool good = draw(b, materials[i], NULL, &own);
        mxg_options_set(b->options, "host-environment", "true");
        if (draw(b, materials[i], host, &hosts) && good) {
            double db = picture_psnr(own.pixels, hosts.pixels);
            printf("%s, environment: %.0f dB\n", materials[i], db);
            REQUIRE(own.pixels[4 * CENTER] > 0.02f && db > 100);
        }
        mxg_options_set(b->options, "host-environment", "false");
        drawing_close(&hosts);
        drawing_close(&own);
    }
    for (int i = 0; i < 2; ++i) {
        image_finish(maps[i]);
        *maps[i] = kept[i];
    }
}

int main(int argc, char **argv)
{
    struct bench b = {0};
    if (argc != 2)
        return EXIT_FAILURE;
    if (!bench_open_ball(&b))
        return 77;
    mxg_options_set(b.options, "quality", "good"); /* an environment of the host has no samples */
    if (bench_load(&b, argv[1], "examples/deferred.mtlx")) {
        mxg_options_set(b.options, "environment", "none");
        test_lights(&b);
        test_darkening(&b, "host-shadows",
                       "float mxg_shadow(int i, vec3 P, vec3 N, vec3 L)\n"
                       "{\n    return mxg_pixel.x % 2 == 0 && dot(N, N) > 0.9 ? 0.25 : 1.0;\n}\n",
                       0.25f);
        test_map(&b, "shadow-map", 1);
        mxg_options_set(b.options, "environment", "prefiltered");
        b.scene.num_lights = 0;
        test_darkening(&b, "host-occlusion",
                       "float mxg_ambient_occlusion(vec3 P, vec3 N)\n"
                       "{\n    return mxg_pixel.x % 2 == 0 ? 0.25 : 1.0;\n}\n",
                       0.25f);
        test_map(&b, "occlusion-map", NUM_MATERIALS);
        test_environment(&b);
        mxg_options_set(b.options, "host-environment", "true");
        test_arguments(&b);
        if (is_glsl(&b))
            test_top(&b);
    }
    bench_close(&b);
    return test_report("deferred-host");
}
