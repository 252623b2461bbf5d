// SPDX-License-Identifier: Apache-2.0
#include "lobe.h"

#include "fit.h"

#include <math.h>
#include <stdio.h>

enum { STEPS = 24, CELLS = STEPS * STEPS, SAMPLES = 1 << 13 };
/* of anisotropic lobes: roughness, anisotropy, turns and cosines of the viewer */
enum { WIDTHS = 9, SHAPES = 11, TURNS = 7, SLANTS = 16 };
enum { LOBES = WIDTHS * SHAPES * TURNS * SLANTS, LIKE_TERMS = 26 };

static const double pi = 3.14159265358979323846;
#define LEAST_COSINE 0.03 /* the fit extrapolates below, where a surface is hardly visible */
#define SLACK 7e-4        /* maximum error below the albedo */

struct cell {
    double alpha, across;      /* roughness along x and y */
    double cosine, turn;       /* of the viewer, around the normal from x */
    double albedo, at_grazing; /* the total, and the part weighted by (1 - cosine)^5 */
};

/* cos (1 + 2 Lambda) of a direction. */
static double masking(const struct distribution *d, const struct cell *cell, const double v[3])
{
    return d->masking(hypot(v[0] * cell->alpha, v[1] * cell->across), v[2]);
}

/* Samples visible normals, with the weight G2 / G1. */
static void measure(const struct distribution *d, struct cell *cell)
{
    double c = cell->cosine, sine = sqrt(1.0 - c * c);
    double v[3] = {sine * cos(cell->turn), sine * sin(cell->turn), c}, length = masking(d, cell, v);
    double stretched[3] = {cell->alpha * v[0], cell->across * v[1], c};
    for (int i = 0; i < SAMPLES; ++i) {
        double h[3];
        d->draw(stretched, (i + 0.5) / SAMPLES, fmod((i + 0.5) * 0.6180339887498949, 1.0), h);
        h[0] *= cell->alpha;
        h[1] *= cell->across;
        double square = h[0] * h[0] + h[1] * h[1] + h[2] * h[2],
               vh = v[0] * h[0] + v[1] * h[1] + v[2] * h[2], mirror = 2.0 * vh / square;
        double l[3] = {mirror * h[0] - v[0], mirror * h[1] - v[1], mirror * h[2] - c};
        if (l[2] <= 0.0)
            continue;
        double weight = l[2] * (c + length) / (c * masking(d, cell, l) + l[2] * length),
               x = pow(1.0 - vh / sqrt(square), 5.0);
        cell->albedo += weight / SAMPLES;
        cell->at_grazing += weight * x / SAMPLES;
    }
}

/* A variable for the limit of light that grazes the facets. */
static double grazing(const struct cell *cell)
{
    return cell->alpha / (cell->alpha + cell->cosine);
}

static double albedo(const struct distribution *d, const double *p, const struct cell *cell)
{
    double v[3];
    d->variables(cell->alpha, cell->cosine, v);
    return 1.0 - v[2] * fit_form(p, v[0], v[1]);
}

static double effective_cosine(const double *p, const struct cell *cell)
{
    return fmin(fmax(cell->cosine + cell->alpha * fit_form(p, grazing(cell), cell->alpha), 0.0),
                1.0);
}

struct round_lobes {
    const struct distribution *distribution;
    struct cell cells[CELLS];
};

static void albedo_residuals(const double *p, double *out, void *user_data)
{
    const struct round_lobes *lobes = user_data;
    for (int i = 0; i < CELLS; ++i)
        out[i] = albedo(lobes->distribution, p, &lobes->cells[i]) / lobes->cells[i].albedo - 1.0;
}

static void cosine_residuals(const double *p, double *out, void *user_data)
{
    const struct cell *cells = ((const struct round_lobes *)user_data)->cells;
    for (int i = 0; i < CELLS; ++i)
        out[i] =
            pow(1.0 - effective_cosine(p, &cells[i]), 5.0) * cells[i].albedo - cells[i].at_grazing;
}

/* ---- Anisotropic lobes ---- */

/*
 * Divided by the roughness, visible normals are those of a unit sphere, whatever the roughness is.
 * So a round lobe has the same ones if its viewer has the same cosine after that division. What
 * remains is its roughness: the square of the mean of both times a factor.
 */
struct like {
    double mean, shape; /* of both widths: mean, and difference over sum */
    double turned;      /* shape times x^2 - y^2 of the stretched viewer */
    double up, slope;   /* its cosine, and its length along the surface before normalisation */
    double x, y;
};

static struct like compare(const struct cell *cell)
{
    double c = cell->cosine, sine = sqrt(1.0 - c * c), x = sine * cos(cell->turn) * cell->alpha,
           y = sine * sin(cell->turn) * cell->across, square = x * x + y * y + c * c;
    double shape = (cell->alpha - cell->across) / (cell->alpha + cell->across);
    return (struct like){.mean = 0.5 * (cell->alpha + cell->across),
                         .shape = shape,
                         .turned = shape * (x * x - y * y) / square,
                         .up = c / sqrt(square),
                         .slope = sqrt(x * x + y * y)};
}

/* A polynomial of the second degree. */
static double second_degree(const double *p, double z, double m)
{
    return p[0] + z * (p[1] + p[2] * z + p[3] * m) + m * (p[4] + p[5] * m);
}

/* The round cell. `p` begins with the parameters of this form. */
static struct cell round_like(const double *p, const struct cell *cell)
{
    struct like l = compare(cell);
    double d = l.shape * l.shape, w = l.turned, z = l.up, m = l.mean;
    double by_shape =
        second_degree(p, z, m) + d * (p[6] + p[7] * z + p[8] * m + p[9] * w + p[10] * d);
    double by_turn = second_degree(p + 11, z, m) + p[17] * z * z * z
                     + d * (p[18] + p[19] * z + p[20] * m)
                     + w * (p[21] + p[22] * z + p[23] * m + p[24] * d + p[25] * w);
    double square = 1.0 + d * by_shape + w * by_turn;
    double a = m * sqrt(fmax(square, 0.05)), reach = hypot(a * cell->cosine, l.slope);
    return (struct cell){.alpha = a, .across = a, .cosine = a * cell->cosine / reach};
}

struct lobes {
    const struct distribution *distribution;
    const struct cell *cells;
    const double *albedo, *cosine; /* parameters of round lobes */
    double bound;                  /* factor of that albedo */
};

static double like_error(const struct lobes *lobes, const double *p, const struct cell *cell)
{
    struct cell round = round_like(p, cell);
    return fmin(lobes->bound * albedo(lobes->distribution, lobes->albedo, &round), 1.0)
               / cell->albedo
           - 1.0;
}

/* A lobe that is hardly visible counts less. */
static void like_residuals(const double *p, double *out, void *user_data)
{
    const struct lobes *lobes = user_data;
    for (int i = 0; i < LOBES; ++i)
        out[i] =
            like_error(lobes, p, &lobes->cells[i]) * fmin(1.0, 0.5 + 5.0 * lobes->cells[i].cosine);
}

/* A facet's cosine grows with the length of the stretched viewer. */
static double error_at_grazing(const struct lobes *lobes, const double *p, const struct cell *cell)
{
    struct cell round = round_like(p, cell);
    double mean = effective_cosine(lobes->cosine, &round) * cell->cosine / round.cosine;
    return pow(fmax(1.0 - mean, 0.0), 5.0) * cell->albedo - cell->at_grazing;
}

static void measure_lobes(const struct distribution *d, struct cell *cells)
{
    for (int i = 0; i < LOBES; ++i) {
        double r = (double)(i % WIDTHS + 1) / WIDTHS,
               s = 0.95 * (i / WIDTHS % SHAPES) / (SHAPES - 1),
               turn = 0.5 * pi * (i / (WIDTHS * SHAPES) % TURNS) / (TURNS - 1),
               c = (i / (WIDTHS * SHAPES * TURNS) + 1.0) / SLANTS;
        cells[i] =
            (struct cell){.alpha = fmin(r * r * (1.0 + s), 1.0),
                          .across = r * r * (1.0 - s),
                          .cosine = LEAST_COSINE + (1.0 - LEAST_COSINE) * c * (0.5 + 0.5 * c),
                          .turn = turn};
        measure(d, &cells[i]);
    }
}

static void fit_lobes(const struct distribution *d, const double *reflected, double bound,
                      const double *cosine)
{
    static struct cell cells[LOBES];
    struct lobes lobes = {d, cells, reflected, cosine, bound};
    double p[FIT_MOST_PARAMETERS] = {0.4}, grazing_most = 0.0, grazing_mean = 0.0, least = 1.0,
           most = -1.0;
    measure_lobes(d, cells);
    fit_minimax(p, LIKE_TERMS, like_residuals, LOBES, &lobes, 3 * FIT_ROUNDS);
    for (int i = 0; i < LOBES; ++i) {
        double error = like_error(&lobes, p, &cells[i]),
               at_grazing = fabs(error_at_grazing(&lobes, p, &cells[i]));
        least = fmin(least, error);
        most = fmax(most, error);
        grazing_most = fmax(grazing_most, at_grazing);
        grazing_mean += at_grazing / LOBES;
    }
    printf("// anisotropic: albedo from %.4f to %.4f, relatively\n", least, most);
    printf("// (1 - cosine)^5 of the lobe within %.4f, %.4f in the mean\n", grazing_most,
           grazing_mean);
    for (int i = 0; i < LIKE_TERMS; ++i)
        printf("%.4f%s", p[i], i == LIKE_TERMS - 1 ? "\n" : ", ");
}

void lobe_fit(const struct distribution *d)
{
    static struct round_lobes lobes;
    struct cell *cells = lobes.cells;
    double reflected[FIT_PARAMETERS] = {0.1}, cosine[FIT_PARAMETERS] = {0.1};
    lobes.distribution = d;
    for (int i = 0; i < CELLS; ++i) {
        double a = (i % STEPS + 0.5) / (STEPS - 0.5),
               c = (i / STEPS + 0.5) / (STEPS - 0.5); /* to 1 */
        cells[i] = (struct cell){
            .alpha = a * a, .across = a * a, .cosine = LEAST_COSINE + (1.0 - LEAST_COSINE) * c};
        measure(d, &cells[i]);
    }
    double error =
               fit_minimax(reflected, FIT_PARAMETERS, albedo_residuals, CELLS, &lobes, FIT_ROUNDS),
           bound = 1.0 + error - SLACK;
    printf("// albedo times %.4f, so that it is never too small; within %.4f, relatively\n", bound,
           error);
    fit_print_form("LOST", reflected, bound);
    error = fit_minimax(cosine, FIT_PARAMETERS, cosine_residuals, CELLS, &lobes, FIT_ROUNDS);
    printf("// (1 - cosine)^5 of the lobe within %.4f\n", error);
    fit_print_form("COSINE", cosine, 1.0);
    fit_lobes(d, reflected, bound, cosine);
}
