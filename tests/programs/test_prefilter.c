// SPDX-License-Identifier: Apache-2.0
/*
 * Baked environments: light is neither lost nor made, a lobe's level shows what the lobe would,
 * files come back as they were.
 */
#include "unit/test.h"

#include "render/prefilter.h"
#include "render/scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define PI 3.14159265358979323846

static size_t num_floats(const struct image *map)
{
    size_t texels = 0;
    for (uint32_t i = 0; i < (map->levels ? map->levels : 1); ++i)
        texels += (size_t)image_level_size(map->width, i) * image_level_size(map->height, i);
    return texels * 4;
}

static void check_constant(const struct image *map, float value)
{
    const float *x = map->pixels;
    float worst = 0;
    bool is_number = true;
    for (size_t i = 0; i < num_floats(map); ++i) {
        worst = fmaxf(worst, i % 4 == 3 ? 0 : fabsf(x[i] - value));
        is_number &= isfinite(x[i]);
    }
    REQUIRE(is_number && worst < 2e-3f * value);
}

static void test_constant(void)
{
    struct image map = {
        .width = 64, .height = 32, .is_float = true, .pixels = malloc(64 * 32 * 4 * sizeof(float))};
    for (size_t i = 0; i < 64 * 32 * 4; ++i)
        ((float *)map.pixels)[i] = 2.5f;
    struct baked baked;
    REQUIRE(bake_environment(&map, &baked));
    check_constant(&baked.radiance, 2.5f);
    check_constant(&baked.irradiance, 2.5f);
    baked_finish(&baked);
    image_finish(&map);
}

/* A texel is the light of all directions, also of those that face away from its middle. */
static void test_one_texel(void)
{
    float texel[4] = {2.5f, 2.5f, 2.5f, 1.0f};
    struct image out, map = {.width = 1, .height = 1, .is_float = true, .pixels = texel};
    REQUIRE(environment_irradiance(&map, &out));
    check_constant(&out, 2.5f);
    image_finish(&out);
}

/*
 * Radiance 1 + y: its irradiance over pi is 1 + 2/3 y (Ramamoorthi and Hanrahan 2001, A_1 / A_0 =
 * 2/3).
 */
static void test_gradient(void)
{
    struct image map = {.width = 128,
                        .height = 64,
                        .is_float = true,
                        .pixels = malloc(128 * 64 * 4 * sizeof(float))},
                 out;
    for (uint32_t i = 0; i < 128 * 64; ++i) {
        double d[3];
        environment_direction(&map, i % 128, i / 128, d);
        for (size_t c = 0; c < 4; ++c)
            ((float *)map.pixels)[i * 4 + c] = (float)(1 + d[1]);
    }
    REQUIRE(environment_irradiance(&map, &out));
    for (uint32_t i = 0; i < out.width * out.height; i += 37) {
        double n[3];
        environment_direction(&out, i % out.width, i / out.width, n);
        REQUIRE(fabs(((float *)out.pixels)[i * 4] - (1 + 2 * n[1] / 3)) < 4e-3);
    }
    image_finish(&map);
    image_finish(&out);
}

/*
 * GGX with height-correlated masking over a uniform grid of directions: Heitz 2014, equations 71,
 * 72 and 99.
 */
static void integrate(double cosine, double alpha, double *out_a, double *out_b)
{
    enum { N = 1200 };
    const double v[3] = {sqrt(1 - cosine * cosine), 0, cosine};
    *out_a = *out_b = 0;
    for (int i = 0; i < N; ++i) {
        for (int j = 0; j < N; ++j) {
            double z = (i + 0.5) / N, phi = PI * (j + 0.5) / N, r = sqrt(1 - z * z);
            double h[3] = {v[0] + r * cos(phi), v[1] + r * sin(phi), v[2] + z};
            double len = sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]), hz = h[2] / len;
            double k = hz * hz * (alpha * alpha - 1) + 1, d = alpha * alpha / (PI * k * k);
            double lv = sqrt(1 + alpha * alpha * (1 / (cosine * cosine) - 1)),
                   ll = sqrt(1 + alpha * alpha * (1 / (z * z) - 1));
            /* f cos, times the solid angle */
            double value = d * 2 / (lv + ll) / (4 * cosine) * 2 * PI / ((double)N * N);
            double facing = (v[0] * h[0] + v[2] * h[2]) / len, curve = pow(1 - facing, 5);
            *out_a += (1 - curve) * value;
            *out_b += curve * value;
        }
    }
}

static void test_albedo(void)
{
    static const double points[][2] = {{0.9, 0.5}, {0.5, 0.3}, {0.3, 0.8}, {0.7, 1.0}};
    for (size_t i = 0; i < sizeof points / sizeof *points; ++i) {
        double a, b, exact_a, exact_b;
        bake_albedo(points[i][0], points[i][1], &a, &b);
        integrate(points[i][0], points[i][1], &exact_a, &exact_b);
        REQUIRE(fabs(a - exact_a) < 0.005 && fabs(b - exact_b) < 0.005);
    }
}

static void test_files(const char *folder)
{
    struct image map, stand_in;
    struct baked made, read;
    char reason[256] = "", path[4096];
    REQUIRE(environment_make(&map, &stand_in) && bake_environment(&map, &made));
    REQUIRE(baked_write(&made, folder, reason, sizeof reason));
    REQUIRE(baked_read(folder, &read, reason, sizeof reason));
    REQUIRE(read.radiance.levels == made.radiance.levels && read.radiance.levels == 10);
    REQUIRE(memcmp(read.radiance.pixels, made.radiance.pixels,
                   num_floats(&made.radiance) * sizeof(float))
            == 0);
    REQUIRE(memcmp(read.albedo.pixels, made.albedo.pixels, num_floats(&made.albedo) * sizeof(float))
            == 0);
    baked_finish(&read);
    REQUIRE(!baked_read("no-such-folder", &read, reason, sizeof reason) && reason[0]);
    baked_finish(&read);
    baked_finish(&made);
    image_finish(&map);
    image_finish(&stand_in);
    for (size_t i = 0; i < 3; ++i) {
        snprintf(path, sizeof path, "%s/%s.exr", folder,
                 (const char *const[]){"radiance", "irradiance", "albedo"}[i]);
        REQUIRE(remove(path) == 0);
    }
}

int main(int argc, char **argv)
{
    test_constant();
    test_one_texel();
    test_gradient();
    test_albedo();
    test_files(argc > 1 ? argv[1] : ".");
    return test_report("bake");
}
