// SPDX-License-Identifier: Apache-2.0
/*
 * A clear sky as formulas: smooth, with a bright and not too sharp sun, and different in every
 * direction. Texel (u, v) of a map is the direction of latitude pi(.5 - v) and longitude 2pi(u -
 * .5), where longitude 0 looks along -z.
 */
#include "render/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

static const double above[3] = {0.35, 0.55, 0.95}, below[3] = {0.22, 0.17, 0.12},
                    sun[3] = {1.0, 0.86, 0.62};
static const double sun_direction[3] = {0.36, 0.80, 0.48};

void environment_radiance(const double d[3], float out[3])
{
    double c = vector_dot(d, sun_direction), height = 1.0 / (1.0 + exp(-6.0 * d[1]));
    for (size_t i = 0; i < 3; ++i)
        out[i] = (float)(below[i] + (above[i] - below[i]) * height
                         + sun[i] * 12.0 * exp(24.0 * (c - 1.0)) + 0.05 * (1.0 + d[i]));
}

/* A smooth stand-in for the cosine-weighted average, not the exact one. */
static void irradiance_of(const double d[3], float out[3])
{
    double c = (1.0 + vector_dot(d, sun_direction)) / 2.0;
    for (size_t i = 0; i < 3; ++i)
        out[i] = (float)(below[i] + (above[i] - below[i]) * (0.5 + 0.35 * d[1])
                         + sun[i] * 0.9 * c * c + 0.025 * (1.0 + d[i]));
}

void environment_direction(const struct image *map, uint32_t x, uint32_t y, double out[3])
{
    double latitude = PI * (0.5 - (y + 0.5) / map->height),
           longitude = 2.0 * PI * ((x + 0.5) / map->width - 0.5);
    out[0] = cos(latitude) * sin(longitude);
    out[1] = sin(latitude);
    out[2] = -cos(latitude) * cos(longitude);
}

static bool make_map(struct image *out, uint32_t width, uint32_t height,
                     void (*value)(const double d[3], float out[3]))
{
    *out = (struct image){.width = width,
                          .height = height,
                          .is_float = true,
                          .pixels = malloc((size_t)width * height * 4 * sizeof(float))};
    float *texel = out->pixels;
    for (uint32_t y = 0; texel && y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x, texel += 4) {
            double d[3];
            environment_direction(out, x, y, d);
            value(d, texel);
            texel[3] = 1.0f;
        }
    }
    return out->pixels != NULL;
}

bool environment_make_plain(float value, struct image *out)
{
    *out = (struct image){.width = 4, .height = 2, .is_float = true};
    float *texel = out->pixels = malloc(8 * 4 * sizeof *texel);
    for (size_t i = 0; texel && i < 8 * 4; ++i)
        texel[i] = i % 4 == 3 ? 1 : value;
    return texel != NULL;
}

bool environment_make(struct image *radiance, struct image *irradiance)
{
    return make_map(radiance, 256, 128, environment_radiance)
           && make_map(irradiance, 64, 32, irradiance_of);
}

/* ---- Maps ---- */

static const float *texel_at(const struct image *map, int64_t x, int64_t y)
{
    y = y < 0 ? 0 : y >= map->height ? map->height - 1 : y;
    x = (x % map->width + map->width) % map->width;
    return (const float *)map->pixels + (y * map->width + x) * 4;
}

void environment_lookup(const struct image *map, const double d[3], double out[3])
{
    double u = (atan2(d[0], -d[2]) / (2 * PI) + 0.5) * map->width - 0.5;
    double v = (0.5 - asin(fmax(-1, fmin(1, d[1]))) / PI) * map->height - 0.5;
    int64_t x = (int64_t)floor(u), y = (int64_t)floor(v);
    double s = u - floor(u), t = v - floor(v);
    const float *a = texel_at(map, x, y), *b = texel_at(map, x + 1, y),
                *c = texel_at(map, x, y + 1), *e = texel_at(map, x + 1, y + 1);
    for (size_t i = 0; i < 3; ++i)
        out[i] = (1 - t) * ((1 - s) * a[i] + s * b[i]) + t * ((1 - s) * c[i] + s * e[i]);
}

static uint32_t most(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

/* Averages boxes of texels, or repeats them, so that an integral over the sphere takes neither many
 * nor too few. */
static bool resample(const struct image *map, uint32_t width, uint32_t height, struct image *out)
{
    *out = (struct image){.width = width,
                          .height = height,
                          .is_float = true,
                          .pixels = calloc((size_t)width * height * 4, sizeof(float))};
    for (uint32_t y = 0; out->pixels && y < height; ++y) {
        uint32_t y0 = y * map->height / height, y1 = most(y0 + 1, (y + 1) * map->height / height);
        for (uint32_t x = 0; x < width; ++x) {
            uint32_t x0 = x * map->width / width, x1 = most(x0 + 1, (x + 1) * map->width / width);
            double sum[3] = {0};
            for (uint32_t j = y0; j < y1; ++j)
                for (uint32_t i = x0; i < x1; ++i)
                    for (size_t c = 0; c < 3; ++c)
                        sum[c] +=
                            ((const float *)map->pixels)[((size_t)j * map->width + i) * 4 + c];
            for (size_t c = 0; c < 3; ++c)
                ((float *)out->pixels)[((size_t)y * width + x) * 4 + c] =
                    (float)(sum[c] / ((y1 - y0) * (double)(x1 - x0)));
        }
    }
    return out->pixels != NULL;
}

/* A texel of a map as a light. */
struct texel_light {
    float direction[3], light[3], solid; /* the solid angle, up to a factor */
};

static struct texel_light *make_lights(const struct image *map)
{
    struct texel_light *lights = malloc((size_t)map->width * map->height * sizeof *lights);
    for (uint32_t y = 0; lights && y < map->height; ++y) {
        double top = PI * (0.5 - (double)y / map->height),
               bottom = PI * (0.5 - (y + 1.0) / map->height);
        double solid = sin(top) - sin(bottom);
        for (uint32_t x = 0; x < map->width; ++x) {
            struct texel_light *light = &lights[(size_t)y * map->width + x];
            double d[3];
            environment_direction(map, x, y, d);
            for (size_t c = 0; c < 3; ++c) {
                light->direction[c] = (float)d[c];
                light->light[c] =
                    ((const float *)map->pixels)[((size_t)y * map->width + x) * 4 + c];
            }
            light->solid = (float)solid;
        }
    }
    return lights;
}

enum { IRRADIANCE_WIDTH = 64, IRRADIANCE_HEIGHT = 32 };

/* Sums of a row, by texel, so that the compiler computes several texels at once. */
struct irradiance_row {
    float normal[3][IRRADIANCE_WIDTH], sum[3][IRRADIANCE_WIDTH], weight[IRRADIANCE_WIDTH];
};

static void add_light(struct irradiance_row *row, struct texel_light light)
{
    const float *d = light.direction, *color = light.light;
    for (int x = 0; x < IRRADIANCE_WIDTH; ++x) {
        float cosine =
            row->normal[0][x] * d[0] + row->normal[1][x] * d[1] + row->normal[2][x] * d[2];
        float weight = (cosine > 0 ? cosine : 0) * light.solid;
        row->weight[x] += weight;
        row->sum[0][x] += weight * color[0];
        row->sum[1][x] += weight * color[1];
        row->sum[2][x] += weight * color[2];
    }
}

static void fill_row(struct image *out, uint32_t y, const struct texel_light *lights, size_t count)
{
    struct irradiance_row row = {0};
    for (uint32_t x = 0; x < IRRADIANCE_WIDTH; ++x) {
        double n[3];
        environment_direction(out, x, y, n);
        for (int c = 0; c < 3; ++c)
            row.normal[c][x] = (float)n[c];
    }
    for (size_t i = 0; i < count; ++i)
        add_light(&row, lights[i]);
    float *texel = (float *)out->pixels + (size_t)y * IRRADIANCE_WIDTH * 4;
    for (uint32_t x = 0; x < IRRADIANCE_WIDTH; ++x, texel += 4) {
        for (int c = 0; c < 3; ++c)
            texel[c] = row.sum[c][x] / row.weight[x];
        texel[3] = 1.0f;
    }
}

bool environment_irradiance(const struct image *radiance, struct image *out)
{
    struct image small;
    *out =
        (struct image){.width = IRRADIANCE_WIDTH,
                       .height = IRRADIANCE_HEIGHT,
                       .is_float = true,
                       .pixels = malloc(IRRADIANCE_WIDTH * IRRADIANCE_HEIGHT * 4 * sizeof(float))};
    bool good = resample(radiance, 128, 64, &small);
    struct texel_light *lights = good ? make_lights(&small) : NULL;
    for (uint32_t y = 0; lights && out->pixels && y < IRRADIANCE_HEIGHT; ++y)
        fill_row(out, y, lights, (size_t)small.width * small.height);
    good = lights && out->pixels;
    free(lights);
    image_finish(&small);
    return good;
}

bool environment_make_test_texture(struct image *out)
{
    enum { SIZE = 64 };
    *out = (struct image){.width = SIZE,
                          .height = SIZE,
                          .is_float = true,
                          .pixels = malloc(SIZE * SIZE * 4 * sizeof(float))};
    float *texel = out->pixels;
    for (int y = 0; texel && y < SIZE; ++y) {
        for (int x = 0; x < SIZE; ++x, texel += 4) {
            /* rows from the top */
            double u = 2.0 * PI * (x + 0.5) / SIZE, v = 2.0 * PI * (SIZE - y - 0.5) / SIZE;
            texel[0] = (float)(0.5 + 0.4 * sin(u) * cos(v));
            texel[1] = (float)(0.45 + 0.35 * cos(u + 2.0 * v));
            texel[2] = (float)(0.55 + 0.25 * sin(2.0 * u - v + 0.7) + 0.15 * cos(v));
            texel[3] = (float)(0.6 + 0.3 * cos(u + 0.4) * sin(v + 1.1));
        }
    }
    return out->pixels != NULL;
}
