// SPDX-License-Identifier: Apache-2.0
#include "slabs/difference.h"

#include <math.h>

#define PI 3.14159265358979323846

/* CIELAB of a linear colour of Rec. 709, white point D65 (IEC 61966-2-1, CIE 15). */
static void to_lab(const float color[3], double lab[3])
{
    static const double to_xyz[3][3] = {
        {0.4124564 / 0.95047, 0.3575761 / 0.95047, 0.1804375 / 0.95047},
        {0.2126729, 0.7151522, 0.0721750},
        {0.0193339 / 1.08883, 0.1191920 / 1.08883, 0.9503041 / 1.08883}};
    double f[3];
    for (int i = 0; i < 3; i++) {
        double t = 0.0;
        for (int k = 0; k < 3; k++)
            t += to_xyz[i][k] * fmin(fmax((double)color[k], 0.0), 1.0);
        f[i] = t > 216.0 / 24389.0 ? cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
    }
    lab[0] = 116.0 * f[1] - 16.0;
    lab[1] = 500.0 * (f[0] - f[1]);
    lab[2] = 200.0 * (f[1] - f[2]);
}

static double degrees(double angle)
{
    return angle * PI / 180.0;
}

/* 0 to 360 */
static double hue_of(double a, double b)
{
    double hue = a == 0.0 && b == 0.0 ? 0.0 : atan2(b, a) * 180.0 / PI;
    return hue < 0.0 ? hue + 360.0 : hue;
}

static double pow7(double x)
{
    double cube = x * x * x;
    return cube * cube * x;
}

/* How much a chroma weighs against 25. */
static double root_of_chroma(double chroma)
{
    return sqrt(pow7(chroma) / (pow7(chroma) + 6103515625.0)); /* 25^7 */
}

struct polar {
    double l, chroma, hue;
};

static struct polar polar_of(const double lab[3], double more)
{
    double a = lab[1] * (1.0 + more);
    return (struct polar){lab[0], hypot(a, lab[2]), hue_of(a, lab[2])};
}

/* From -180 to 180. */
static double hue_step(const struct polar *p, const struct polar *q)
{
    double step = q->hue - p->hue;
    if (p->chroma * q->chroma == 0.0)
        return 0.0;
    return step > 180.0 ? step - 360.0 : step < -180.0 ? step + 360.0 : step;
}

static double mean_hue(const struct polar *p, const struct polar *q)
{
    double sum = p->hue + q->hue;
    if (p->chroma * q->chroma == 0.0)
        return sum;
    if (fabs(p->hue - q->hue) <= 180.0)
        return sum / 2.0;
    return sum < 360.0 ? (sum + 360.0) / 2.0 : (sum - 360.0) / 2.0;
}

double lab_difference(const double a[3], const double b[3])
{
    double mean_chroma = (hypot(a[1], a[2]) + hypot(b[1], b[2])) / 2.0;
    double more = 0.5 * (1.0 - root_of_chroma(mean_chroma));
    struct polar p = polar_of(a, more), q = polar_of(b, more);
    double l = (p.l + q.l) / 2.0, chroma = (p.chroma + q.chroma) / 2.0, hue = mean_hue(&p, &q);
    double t = 1.0 - 0.17 * cos(degrees(hue - 30.0)) + 0.24 * cos(degrees(2.0 * hue))
               + 0.32 * cos(degrees(3.0 * hue + 6.0)) - 0.20 * cos(degrees(4.0 * hue - 63.0));
    double away = (hue - 275.0) / 25.0, square = (l - 50.0) * (l - 50.0);
    double turn = -sin(degrees(60.0 * exp(-away * away))) * 2.0 * root_of_chroma(chroma);
    double step = 2.0 * sqrt(p.chroma * q.chroma) * sin(degrees(hue_step(&p, &q) / 2.0));
    double dl = (q.l - p.l) / (1.0 + 0.015 * square / sqrt(20.0 + square));
    double dc = (q.chroma - p.chroma) / (1.0 + 0.045 * chroma);
    double dh = step / (1.0 + 0.015 * chroma * t);
    return sqrt(fmax(dl * dl + dc * dc + dh * dh + turn * dc * dh, 0.0));
}

double color_difference(const float a[3], const float b[3])
{
    double lab_a[3], lab_b[3];
    to_lab(a, lab_a);
    to_lab(b, lab_b);
    return lab_difference(lab_a, lab_b);
}
