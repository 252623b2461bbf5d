// SPDX-License-Identifier: Apache-2.0
/*
 * Prefiltering for GGX as Karis 2013, "Real Shading in Unreal Engine 4", splits the sum: the light
 * around a reflection, seen along the normal, and the lobe's albedo.
 */
#include "render/prefilter.h"

#include "render/scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define PI 3.14159265358979323846

enum {
    MIN_WIDTH = 512,
    MAX_WIDTH = 2048,
    MAX_LEVELS = 16,
    NUM_SAMPLES = 128,
    ALBEDO_SIZE = 64,
    ALBEDO_SAMPLES = 1024
};

/* ---- Levels ---- */

static size_t level_texels(const struct image *map, uint32_t level)
{
    return (size_t)image_level_size(map->width, level) * image_level_size(map->height, level);
}

static bool allocate_levels(struct image *map, uint32_t width)
{
    *map = (struct image){.width = width, .height = width / 2, .is_float = true};
    map->levels = image_num_mips(map);
    size_t texels = 0;
    for (uint32_t i = 0; i < map->levels; ++i)
        texels += level_texels(map, i);
    map->pixels = malloc(texels * 4 * sizeof(float));
    return map->pixels != NULL;
}

/* A level as an image of its own, which it does not own. */
static struct image level_of(const struct image *map, uint32_t level)
{
    float *pixels = map->pixels;
    for (uint32_t i = 0; i < level; ++i)
        pixels += level_texels(map, i) * 4;
    return (struct image){.width = image_level_size(map->width, level),
                          .height = image_level_size(map->height, level),
                          .is_float = true,
                          .pixels = pixels};
}

/* The map in the size of level 0, and below it the averages of boxes. */
static void fill_boxes(const struct image *map, struct image *out)
{
    struct image top = level_of(out, 0);
    float *texel = top.pixels;
    for (uint32_t y = 0; y < top.height; ++y)
        for (uint32_t x = 0; x < top.width; ++x, texel += 4) {
            double d[3], light[3];
            environment_direction(&top, x, y, d);
            environment_lookup(map, d, light);
            for (size_t c = 0; c < 3; ++c)
                texel[c] = (float)light[c];
            texel[3] = 1;
        }
    for (uint32_t level = 1; level < out->levels; ++level) {
        struct image from = level_of(out, level - 1), to = level_of(out, level);
        for (size_t i = 0; i < (size_t)to.width * to.height * 4; ++i) {
            size_t c = i % 4, x = i / 4 % to.width, y = i / 4 / to.width;
            const float *a = (const float *)from.pixels
                             + (y * 2 % from.height * from.width + x * 2 % from.width) * 4 + c;
            size_t right = from.width > 1 ? 4 : 0,
                   down = from.height > 1 ? (size_t)from.width * 4 : 0;
            ((float *)to.pixels)[i] = 0.25f * (a[0] + a[right] + a[down] + a[down + right]);
        }
    }
}

/* ---- Sampling ---- */

/* Point i of a Hammersley set. */
static void hammersley(uint32_t i, uint32_t count, double out[2])
{
    uint32_t bits = i;
    bits = (bits << 16) | (bits >> 16);
    bits = ((bits & 0x00ff00ffu) << 8) | ((bits & 0xff00ff00u) >> 8);
    bits = ((bits & 0x0f0f0f0fu) << 4) | ((bits & 0xf0f0f0f0u) >> 4);
    bits = ((bits & 0x33333333u) << 2) | ((bits & 0xccccccccu) >> 2);
    bits = ((bits & 0x55555555u) << 1) | ((bits & 0xaaaaaaaau) >> 1);
    out[0] = (i + 0.5) / count;
    out[1] = bits / 4294967296.0;
}

/* The distribution of normals of GGX: Walter et al. 2007, equation 33. */
static double distribution(double cosine, double alpha)
{
    double k = cosine * cosine * (alpha * alpha - 1) + 1;
    return alpha * alpha / (PI * k * k);
}

/*
 * A direction seen along the normal, in its frame, how much it counts, and the level that holds its
 * part of the light.
 */
struct lobe_sample {
    double direction[3], weight, level;
};

/* Normals by Walter et al. 2007, equations 35 and 36; levels by Krivanek and Colbert 2008. */
static uint32_t sample_lobe(double alpha, uint32_t width, struct lobe_sample samples[NUM_SAMPLES])
{
    uint32_t count = 0;
    double texel = 4 * PI / ((double)width * width / 2);
    for (uint32_t i = 0; i < NUM_SAMPLES; ++i) {
        double xi[2];
        hammersley(i, NUM_SAMPLES, xi);
        double cosine = sqrt((1 - xi[0]) / (1 + (alpha * alpha - 1) * xi[0])),
               sine = sqrt(fmax(1 - cosine * cosine, 0));
        double z = 2 * cosine * cosine - 1;
        if (z <= 0)
            continue;
        double around = 2 * PI * xi[1], solid = 4 / (NUM_SAMPLES * distribution(cosine, alpha));
        samples[count++] = (struct lobe_sample){
            {2 * cosine * sine * cos(around), 2 * cosine * sine * sin(around), z},
            z,
            fmax(0.5 * log2(solid / texel) + 1, 0)};
    }
    return count;
}

static void frame_around(const double n[3], double x[3], double y[3])
{
    const double up[3] = {0, 1, 0}, right[3] = {1, 0, 0};
    vector_cross(fabs(n[1]) < 0.9 ? up : right, n, x);
    vector_normalize(x);
    vector_cross(n, x, y);
}

static void look_up(const struct image *levels, uint32_t num_levels, double level,
                    const double d[3], double out[3])
{
    double low[3], high[3], t = level - floor(level);
    uint32_t first = level < num_levels - 1 ? (uint32_t)level : num_levels - 1;
    environment_lookup(&levels[first], d, low);
    environment_lookup(&levels[first + 1 < num_levels ? first + 1 : first], d, high);
    for (size_t c = 0; c < 3; ++c)
        out[c] = low[c] + t * (high[c] - low[c]);
}

/*
 * The roughness squared that a level is for, as shaders choose it: MaterialX,
 * mx_latlong_lod_to_alpha.
 */
static double level_alpha(uint32_t level, uint32_t num_levels)
{
    double t = (double)level / (num_levels - 1);
    return fmin(t < 0.5 ? t * t : 2 * (t - 0.375), 1);
}

static void filter_level(const struct image *boxes, double alpha, struct image *out)
{
    struct lobe_sample samples[NUM_SAMPLES];
    struct image levels[MAX_LEVELS];
    for (uint32_t i = 0; i < boxes->levels; ++i)
        levels[i] = level_of(boxes, i);
    uint32_t count = sample_lobe(alpha, boxes->width, samples);
    float *texel = out->pixels;
    for (uint32_t y = 0; y < out->height; ++y) {
        for (uint32_t x = 0; x < out->width; ++x, texel += 4) {
            double n[3], a[3], b[3], sum[3] = {0}, weights = 0;
            environment_direction(out, x, y, n);
            frame_around(n, a, b);
            for (uint32_t i = 0; i < count; ++i) {
                const struct lobe_sample *s = &samples[i];
                double d[3], light[3];
                for (size_t c = 0; c < 3; ++c)
                    d[c] = s->direction[0] * a[c] + s->direction[1] * b[c] + s->direction[2] * n[c];
                look_up(levels, boxes->levels, s->level, d, light);
                for (size_t c = 0; c < 3; ++c)
                    sum[c] += s->weight * light[c];
                weights += s->weight;
            }
            for (size_t c = 0; c < 3; ++c)
                texel[c] = (float)(sum[c] / weights);
            texel[3] = 1;
        }
    }
}

static bool filter(const struct image *map, struct image *out)
{
    uint32_t width = MIN_WIDTH;
    while (width < map->width && width < MAX_WIDTH)
        width *= 2;
    struct image boxes;
    bool good = allocate_levels(&boxes, width) && allocate_levels(out, width);
    if (good) {
        fill_boxes(map, &boxes);
        memcpy(out->pixels, boxes.pixels, level_texels(out, 0) * 4 * sizeof(float));
        for (uint32_t level = 1; level < out->levels; ++level) {
            struct image filtered = level_of(out, level);
            filter_level(&boxes, level_alpha(level, out->levels), &filtered);
        }
    }
    image_finish(&boxes);
    return good;
}

/* ---- Albedo ---- */

/* Heitz 2014, equation 72 */
static double lambda(double cosine, double alpha)
{
    double tangent2 = (1 - cosine * cosine) / (cosine * cosine);
    return (sqrt(1 + alpha * alpha * tangent2) - 1) / 2;
}

/*
 * With normals drawn by their distribution a sample weighs G2 (v·h) / ((n·v)(n·h)), and Schlick's
 * curve splits it.
 */
void bake_albedo(double cosine, double alpha, double *out_a, double *out_b)
{
    const double v[3] = {sqrt(fmax(1 - cosine * cosine, 0)), 0, cosine};
    *out_a = *out_b = 0;
    for (uint32_t i = 0; i < ALBEDO_SAMPLES; ++i) {
        double xi[2];
        hammersley(i, ALBEDO_SAMPLES, xi);
        double z = sqrt((1 - xi[0]) / (1 + (alpha * alpha - 1) * xi[0])),
               r = sqrt(fmax(1 - z * z, 0));
        double x = r * cos(2 * PI * xi[1]), facing = v[0] * x + v[2] * z, l = 2 * facing * z - v[2];
        if (l <= 0 || facing <= 0)
            continue;
        double weight = facing / (cosine * z * (1 + lambda(cosine, alpha) + lambda(l, alpha)));
        double curve = pow(1 - facing, 5);
        *out_a += (1 - curve) * weight / ALBEDO_SAMPLES;
        *out_b += curve * weight / ALBEDO_SAMPLES;
    }
}

bool bake_albedo_table(struct image *out)
{
    *out = (struct image){.width = ALBEDO_SIZE,
                          .height = ALBEDO_SIZE,
                          .is_float = true,
                          .pixels = calloc(ALBEDO_SIZE * ALBEDO_SIZE * 4, sizeof(float))};
    float *texel = out->pixels;
    for (uint32_t y = 0; texel && y < ALBEDO_SIZE; ++y)
        for (uint32_t x = 0; x < ALBEDO_SIZE; ++x, texel += 4) {
            double a, b;
            bake_albedo((x + 0.5) / ALBEDO_SIZE, (y + 0.5) / ALBEDO_SIZE, &a, &b);
            texel[0] = (float)a;
            texel[1] = (float)b;
            texel[3] = 1;
        }
    return out->pixels != NULL;
}

/* ---- The whole ---- */

bool bake_environment(const struct image *map, struct baked *out)
{
    *out = (struct baked){0};
    return filter(map, &out->radiance) && environment_irradiance(map, &out->irradiance)
           && bake_albedo_table(&out->albedo);
}

struct part {
    const char *name;
    size_t image; /* offset in struct baked */
};
static const struct part parts[] = {{"radiance.exr", offsetof(struct baked, radiance)},
                                    {"irradiance.exr", offsetof(struct baked, irradiance)},
                                    {"albedo.exr", offsetof(struct baked, albedo)}};
enum { NUM_PARTS = sizeof parts / sizeof *parts, MAX_PATH = 4096 };

bool baked_write(const struct baked *baked, const char *folder, char *reason, size_t capacity)
{
    char path[MAX_PATH];
    bool good = true;
    for (size_t i = 0; good && i < NUM_PARTS; ++i) {
        snprintf(path, sizeof path, "%s/%s", folder, parts[i].name);
        good = image_write(
            path, (const struct image *)(const void *)((const char *)baked + parts[i].image),
            reason, capacity);
    }
    return good;
}

bool baked_read(const char *folder, struct baked *out, char *reason, size_t capacity)
{
    *out = (struct baked){0};
    char path[MAX_PATH];
    bool good = true;
    for (size_t i = 0; good && i < NUM_PARTS; ++i) {
        struct image *image = (struct image *)(void *)((char *)out + parts[i].image);
        snprintf(path, sizeof path, "%s/%s", folder, parts[i].name);
        good = image_read_levels(path, image, reason, capacity);
        if (good && !image->is_float) {
            snprintf(reason, capacity, "%s does not hold floats", parts[i].name);
            good = false;
        }
    }
    return good;
}

void baked_finish(struct baked *baked)
{
    image_finish(&baked->radiance);
    image_finish(&baked->irradiance);
    image_finish(&baked->albedo);
}
