// SPDX-License-Identifier: Apache-2.0
/*
 * Walks at random through plane layers that scatter evenly, and fits the light that they reflect
 * and let through, for mx_medium_layer in libraries/slabs/medium.glsl. Prints the constants of the
 * function.
 */
#include "fit.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { ALBEDOS = 9, DEPTHS = 11, ANGLES = 4, CELLS = ALBEDOS * DEPTHS * ANGLES, WALKS = 1 << 18 };

static const double albedos[ALBEDOS] = {0.1, 0.3, 0.5, 0.7, 0.85, 0.94, 0.98, 0.995, 1.0};
static const double depths[DEPTHS] = {0.05, 0.15, 0.4, 0.8, 1.5, 2.5, 4.0, 7.0, 12.0, 25.0, 60.0};

struct cell {
    double albedo, depth, way; /* way: 1 / cosine inside */
    double reflected, transmitted;
};

static uint64_t state = 0x853c49e6748fea9bULL;

/* PCG (O'Neill 2014): a number in (0, 1). */
static double random_number(void)
{
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    uint32_t word = (uint32_t)(((state >> 18) ^ state) >> 27), turn = (uint32_t)(state >> 59);
    word = (word >> turn) | (word << ((0u - turn) & 31u));
    return (word + 0.5) / 4294967296.0;
}

/*
 * One walk serves all albedos: a path of n collisions carries albedo^n. Light enters at depth 0
 * with the cosine 1 / way.
 */
static void walk(struct cell *cells)
{
    double depth = 0.0, cosine = 1.0 / cells[0].way, carried[ALBEDOS];
    for (int a = 0; a < ALBEDOS; ++a)
        carried[a] = 1.0 / WALKS;
    for (;;) {
        depth -= log(random_number()) * cosine;
        if (depth <= 0.0 || depth >= cells[0].depth)
            break;
        cosine = 2.0 * random_number() - 1.0;
        for (int a = 0; a < ALBEDOS; ++a)
            carried[a] *= albedos[a];
    }
    for (int a = 0; a < ALBEDOS; ++a)
        *(depth <= 0.0 ? &cells[a].reflected : &cells[a].transmitted) += carried[a];
}

/*
 * Kubelka and Munk's layer (1931) with coefficients that follow depth, albedo and way. They are
 * exact for a thin layer, and without scattering; without absorption the sum is 1.
 */
static void layer(const double *p, const struct cell *cell, double *reflected, double *transmitted)
{
    double a = cell->albedo, t = cell->depth, x = cell->way, u = t / (1.0 + t);
    double s = 0.5 * a * x
               * (1.0
                  + u
                        * (p[0] + u * (p[1] + a * p[2]) + a * (p[3] + a * p[4])
                           + (x - 1.0) * (p[5] + a * p[6])));
    double k =
        (1.0 - a) * x
        * (1.0
           + a * u
                 * (p[7] + u * (p[8] + a * p[9]) + a * (p[10] + a * p[11])
                    + (x - 1.0) * (p[12] + a * p[13]) + a * a * a * a * (p[14] + u * p[15])));
    double g = sqrt(k * (k + 2.0 * s)), e = exp(-g * t);
    /* (1 - e²) / g, which is 2 t where nothing absorbs */
    double ways = g * t > 1e-4 ? (1.0 - e * e) / g : 2.0 * t * (1.0 - g * t);
    double below = (k + s) * ways + 1.0 + e * e;
    *reflected = s * ways / below;
    *transmitted = 2.0 * e / below;
}

static void residuals(const double *p, double *out, void *user_data)
{
    const struct cell *cells = user_data;
    for (int i = 0; i < CELLS; ++i) {
        double reflected, transmitted;
        layer(p, &cells[i], &reflected, &transmitted);
        bool good = isfinite(reflected + transmitted);
        out[2 * i] = good ? reflected - cells[i].reflected : 1e3;
        out[2 * i + 1] = good ? transmitted - cells[i].transmitted : 1e3;
    }
}

int main(void)
{
    static struct cell cells[CELLS];
    double p[FIT_PARAMETERS] = {0.0};
    for (int d = 0; d < DEPTHS; ++d)
        for (int w = 0; w < ANGLES; ++w) {
            struct cell *first = &cells[(d * ANGLES + w) * ALBEDOS];
            double outside = (double)w / (ANGLES - 1); /* cosine; the index inside is 1.5 */
            double cosine = sqrt(1.0 - (1.0 - outside * outside) / 2.25);
            for (int a = 0; a < ALBEDOS; ++a)
                first[a] =
                    (struct cell){.albedo = albedos[a], .depth = depths[d], .way = 1.0 / cosine};
            for (int i = 0; i < WALKS; ++i)
                walk(first);
        }
    printf("// within %.4f\n",
           fit_minimax(p, FIT_PARAMETERS, residuals, 2 * CELLS, cells, FIT_ROUNDS));
    for (int i = 0; i < FIT_PARAMETERS; ++i)
        printf("%.4f%s", p[i], i == FIT_PARAMETERS - 1 ? "\n" : ", ");
    return 0;
}
