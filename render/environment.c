// SPDX-License-Identifier: Apache-2.0
/*
 * A clear sky as formulas: smooth, with a bright and not too sharp sun, and different in every direction. Texel (u, v)
 * of a map is the direction of latitude pi(.5 - v) and longitude 2pi(u - .5), where longitude 0 looks along -z.
 */
#include "render/scene.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

static const double above[3] = {0.35, 0.55, 0.95}, below[3] = {0.22, 0.17, 0.12}, sun[3] = {1.0, 0.86, 0.62};
static const double sun_direction[3] = {0.36, 0.80, 0.48};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void environment_radiance(const double d[3], float out[3])
{
    double c = dot(d, sun_direction), height = 1.0 / (1.0 + exp(-6.0 * d[1]));
    for (size_t i = 0; i < 3; ++i)
        out[i] = (float)(below[i] + (above[i] - below[i]) * height + sun[i] * 12.0 * exp(24.0 * (c - 1.0)) +
                         0.05 * (1.0 + d[i]));
}

/* A smooth stand-in for the cosine-weighted average, not the exact one. */
static void irradiance_of(const double d[3], float out[3])
{
    double c = (1.0 + dot(d, sun_direction)) / 2.0;
    for (size_t i = 0; i < 3; ++i)
        out[i] = (float)(below[i] + (above[i] - below[i]) * (0.5 + 0.35 * d[1]) + sun[i] * 0.9 * c * c +
                         0.025 * (1.0 + d[i]));
}

static bool make_map(struct image *out, uint32_t width, uint32_t height, void (*value)(const double d[3], float out[3]))
{
    *out = (struct image){width, height, true, malloc((size_t)width * height * 4 * sizeof(float))};
    float *texel = out->pixels;
    for (uint32_t y = 0; texel && y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x, texel += 4) {
            double latitude = PI * (0.5 - (y + 0.5) / height), longitude = 2.0 * PI * ((x + 0.5) / width - 0.5);
            const double d[3] = {cos(latitude) * sin(longitude), sin(latitude), -cos(latitude) * cos(longitude)};
            value(d, texel);
            texel[3] = 1.0f;
        }
    }
    return out->pixels != NULL;
}

bool environment_make(struct image *radiance, struct image *irradiance)
{
    return make_map(radiance, 256, 128, environment_radiance) && make_map(irradiance, 64, 32, irradiance_of);
}

bool environment_make_test_texture(struct image *out)
{
    enum { SIZE = 64 };
    *out = (struct image){SIZE, SIZE, true, malloc(SIZE * SIZE * 4 * sizeof(float))};
    float *texel = out->pixels;
    for (int y = 0; texel && y < SIZE; ++y) {
        for (int x = 0; x < SIZE; ++x, texel += 4) {
            double u = 2.0 * PI * (x + 0.5) / SIZE, v = 2.0 * PI * (SIZE - y - 0.5) / SIZE; /* rows from the top */
            texel[0] = (float)(0.5 + 0.4 * sin(u) * cos(v));
            texel[1] = (float)(0.45 + 0.35 * cos(u + 2.0 * v));
            texel[2] = (float)(0.55 + 0.25 * sin(2.0 * u - v + 0.7) + 0.15 * cos(v));
            texel[3] = (float)(0.6 + 0.3 * cos(u + 0.4) * sin(v + 1.1));
        }
    }
    return out->pixels != NULL;
}
