// SPDX-License-Identifier: Apache-2.0
#include "generators/osl/lobes.h"

#include <math.h>

#define PI 3.14159265358979324

/* Roughness of facets in steps of the root of 2: a sum of two neighbours is close to any between.
 */
const struct lobe osl_lobes[OSL_NUM_LOBES] = {
    {LOBE_DIFFUSE, 0.0f},   {LOBE_ROUGH_DIFFUSE, 1.0f}, {LOBE_THROUGH, 0.0f},
    {LOBE_MIRROR, 0.02f},   {LOBE_MIRROR, 0.03f},       {LOBE_MIRROR, 0.044f},
    {LOBE_MIRROR, 0.0625f}, {LOBE_MIRROR, 0.088f},      {LOBE_MIRROR, 0.125f},
    {LOBE_MIRROR, 0.177f},  {LOBE_MIRROR, 0.25f},       {LOBE_MIRROR, 0.354f},
    {LOBE_MIRROR, 0.5f},    {LOBE_MIRROR, 0.707f},      {LOBE_MIRROR, 1.0f},
    {LOBE_RETRO, 0.0625f},  {LOBE_RETRO, 0.125f},       {LOBE_RETRO, 0.25f},
    {LOBE_RETRO, 0.4f},     {LOBE_SHEEN, 0.2f},         {LOBE_SHEEN, 0.35f},
    {LOBE_SHEEN, 0.6f},     {LOBE_SHEEN, 1.0f},
};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalize(double a[3])
{
    double length = sqrt(dot(a, a));
    for (unsigned i = 0; i < 3 && length > 0.0; i++)
        a[i] /= length;
}

static void half_way(const double v[3], const double l[3], double h[3])
{
    for (unsigned i = 0; i < 3; i++)
        h[i] = v[i] + l[i];
    normalize(h);
}

/* ---- Values ---- */

/* Density of facets (Walter and others 2007, "Microfacet Models for Refraction", eq. 33). */
static double ggx(double alpha, double cosine)
{
    double a2 = alpha * alpha, d = (a2 - 1.0) * cosine * cosine + 1.0;
    return a2 / (PI * d * d);
}

/* GGX with height-correlated masking (Heitz 2014), over 4 (n · v). */
static double facets(double alpha, double nv, double nl, double nh)
{
    double a2 = alpha * alpha;
    double v = nl * sqrt(a2 + (1.0 - a2) * nv * nv), l = nv * sqrt(a2 + (1.0 - a2) * nl * nl);
    return ggx(alpha, nh) * 2.0 * nl / (4.0 * (v + l));
}

/* Oren and Nayar 1994 with the angles as cosines: A + B max(cos phi, 0) sin alpha tan beta. */
static double rough_diffuse(const double v[3], const double l[3], double roughness)
{
    double s2 = roughness * roughness, s = dot(v, l) - v[2] * l[2];
    double sine = s > 0.0 ? s / fmax(fmax(v[2], l[2]), 1e-6) : 0.0;
    return (1.0 - 0.5 * s2 / (s2 + 0.33) + 0.45 * s2 / (s2 + 0.09) * sine) * l[2] / PI;
}

/* Conty and Kulla 2017, "Production Friendly Microfacet Sheen BRDF". */
static double sheen(double roughness, double nv, double nl, double nh)
{
    double sine = sqrt(fmax(1.0 - nh * nh, 0.0)), power = 1.0 / roughness;
    double d = (2.0 + power) * pow(sine, power) / (2.0 * PI);
    return d * nl / (4.0 * (nl + nv - nl * nv));
}

double osl_lobe_value(const struct lobe *lobe, const double v[3], const double l[3])
{
    double h[3], alpha = (double)lobe->roughness;
    if ((lobe->shape == LOBE_THROUGH) != (l[2] < 0.0))
        return 0.0;
    half_way(v, l, h);
    switch (lobe->shape) {
    case LOBE_ROUGH_DIFFUSE: return rough_diffuse(v, l, alpha);
    case LOBE_MIRROR: return facets(alpha, v[2], l[2], h[2]);
    case LOBE_RETRO: return dot(v, l) > 0.0 ? facets(alpha, 1.0, dot(v, l), dot(v, h)) : 0.0;
    case LOBE_SHEEN: return sheen(alpha, v[2], l[2], h[2]);
    default: return fabs(l[2]) / PI;
    }
}

bool osl_lobe_is_compensated(const struct lobe *lobe)
{
    return lobe->shape == LOBE_MIRROR || lobe->shape == LOBE_RETRO;
}

/* ---- Directions ---- */

/* A normal of GGX around the third axis (Walter and others 2007, eq. 35), turned around `axis`. */
static void draw_facet(double alpha, const double xi[2], const double axis[3], double h[3])
{
    double t2 = alpha * alpha * xi[0] / (1.0 - xi[0]), cosine = 1.0 / sqrt(1.0 + t2);
    double sine = sqrt(fmax(1.0 - cosine * cosine, 0.0)), turn = 2.0 * PI * xi[1];
    double across[3] = {axis[2], 0.0, -axis[0]}; /* the view has no second part */
    double other[3] = {0.0, 1.0, 0.0};
    normalize(across);
    for (unsigned i = 0; i < 3; i++)
        h[i] = sine * (cos(turn) * across[i] + sin(turn) * other[i]) + cosine * axis[i];
}

static void draw_diffuse(double height, double turn, double out[3])
{
    double sine = sqrt(fmax(1.0 - height * height, 0.0));
    out[0] = sine * cos(turn);
    out[1] = sine * sin(turn);
    out[2] = height;
}

void osl_lobe_draw(const struct lobe *lobe, const double v[3], const double xi[2], double out[3])
{
    const double up[3] = {0.0, 0.0, 1.0};
    double h[3], turn = 2.0 * PI * xi[1];
    switch (lobe->shape) {
    case LOBE_MIRROR:
    case LOBE_RETRO:
        draw_facet((double)lobe->roughness, xi, lobe->shape == LOBE_RETRO ? v : up, h);
        for (unsigned i = 0; i < 3; i++)
            out[i] = 2.0 * dot(v, h) * h[i] - v[i];
        break;
    case LOBE_SHEEN: draw_diffuse(xi[0], turn, out); break; /* all heights alike */
    case LOBE_THROUGH: draw_diffuse(-sqrt(xi[0]), turn, out); break;
    default: draw_diffuse(sqrt(xi[0]), turn, out); break;
    }
}

double osl_lobe_density(const struct lobe *lobe, const double v[3], const double l[3])
{
    double h[3], alpha = (double)lobe->roughness;
    if ((lobe->shape == LOBE_THROUGH) != (l[2] < 0.0))
        return 0.0; /* facets that mirror light into the surface are left out */
    half_way(v, l, h);
    switch (lobe->shape) {
    case LOBE_MIRROR: return h[2] > 0.0 ? ggx(alpha, h[2]) * h[2] / (4.0 * dot(v, h)) : 0.0;
    case LOBE_RETRO: return ggx(alpha, dot(v, h)) / 4.0;
    case LOBE_SHEEN: return 0.5 / PI;
    default: return fabs(l[2]) / PI;
    }
}
