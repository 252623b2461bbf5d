// SPDX-License-Identifier: Apache-2.0
#include "fit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_STEPS = 300 };

double fit_form(const double p[FIT_PARAMETERS], double u, double v)
{
    double sum = 0.0;
    for (int i = FIT_TERMS; i-- > 0;) {
        double row = 0.0;
        for (int j = FIT_TERMS; j-- > 0;)
            row = row * v + p[i * FIT_TERMS + j];
        sum = sum * u + row;
    }
    return sum;
}

/* One column per power of v. */
void fit_print_form(const char *name, const double p[FIT_PARAMETERS], double scale)
{
    printf("const mat4 %s = mat4(", name);
    for (int j = 0; j < FIT_TERMS; ++j)
        for (int i = 0; i < FIT_TERMS; ++i)
            printf("%.6f%s", scale * p[i * FIT_TERMS + j],
                   i == FIT_TERMS - 1 && j == FIT_TERMS - 1 ? ");\n" : ", ");
}

struct system {
    size_t n, m;
    double normal[FIT_MOST_PARAMETERS][FIT_MOST_PARAMETERS]; /* JᵀJ */
    double gradient[FIT_MOST_PARAMETERS];                    /* Jᵀr */
};

static double sum_of_squares(const double *values, size_t count)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        sum += values[i] * values[i];
    return isfinite(sum) ? sum : INFINITY;
}

/* The Jacobian by central differences; columns of m values. */
static void differentiate(double *p, size_t n, fit_residuals residuals, size_t m, void *user_data,
                          double *jacobian, double *work)
{
    for (size_t i = 0; i < n; ++i) {
        double at = p[i], step = 1e-5 * fmax(fabs(at), 1e-2);
        p[i] = at + step;
        residuals(p, jacobian + i * m, user_data);
        p[i] = at - step;
        residuals(p, work, user_data);
        p[i] = at;
        for (size_t k = 0; k < m; ++k)
            jacobian[i * m + k] = (jacobian[i * m + k] - work[k]) / (2.0 * step);
    }
}

static void multiply(struct system *s, const double *jacobian, const double *r)
{
    for (size_t i = 0; i < s->n; ++i) {
        const double *column = jacobian + i * s->m;
        s->gradient[i] = 0.0;
        for (size_t k = 0; k < s->m; ++k)
            s->gradient[i] += column[k] * r[k];
        for (size_t j = 0; j <= i; ++j) {
            double sum = 0.0;
            for (size_t k = 0; k < s->m; ++k)
                sum += column[k] * jacobian[j * s->m + k];
            s->normal[i][j] = s->normal[j][i] = sum;
        }
    }
}

/* (JᵀJ + damping · diag) step = -Jᵀr, by Gaussian elimination with pivots. */
static void solve(const struct system *s, double damping, double *step)
{
    double a[FIT_MOST_PARAMETERS][FIT_MOST_PARAMETERS + 1];
    for (size_t i = 0; i < s->n; ++i) {
        memcpy(a[i], s->normal[i], s->n * sizeof(double));
        a[i][i] *= 1.0 + damping;
        a[i][i] += 1e-15;
        a[i][s->n] = -s->gradient[i];
    }
    for (size_t c = 0; c < s->n; ++c) {
        size_t pivot = c;
        for (size_t i = c + 1; i < s->n; ++i)
            pivot = fabs(a[i][c]) > fabs(a[pivot][c]) ? i : pivot;
        for (size_t j = 0; j <= s->n; ++j) {
            double swap = a[c][j];
            a[c][j] = a[pivot][j];
            a[pivot][j] = swap;
        }
        for (size_t i = c + 1; i < s->n; ++i) {
            double factor = a[i][c] / a[c][c];
            for (size_t j = c; j <= s->n; ++j)
                a[i][j] -= factor * a[c][j];
        }
    }
    for (size_t i = s->n; i-- > 0;) {
        step[i] = a[i][s->n];
        for (size_t j = i + 1; j < s->n; ++j)
            step[i] -= a[i][j] * step[j];
        step[i] /= a[i][i];
    }
}

static double least_squares(double *p, size_t n, fit_residuals residuals, size_t m, void *user_data)
{
    double *jacobian = malloc((n + 2) * m * sizeof(double)), *r = jacobian + n * m, *work = r + m;
    double step[FIT_MOST_PARAMETERS], next[FIT_MOST_PARAMETERS], damping = 1e-3;
    struct system s = {.n = n, .m = m};
    residuals(p, r, user_data);
    double best = sum_of_squares(r, m);
    for (int i = 0; i < MAX_STEPS && damping < 1e12; ++i) {
        differentiate(p, n, residuals, m, user_data, jacobian, work);
        multiply(&s, jacobian, r);
        for (; damping < 1e12; damping *= 4.0) {
            solve(&s, damping, step);
            for (size_t k = 0; k < n; ++k)
                next[k] = p[k] + step[k];
            residuals(next, work, user_data);
            double sum = sum_of_squares(work, m);
            if (sum < best * (1.0 - 1e-9)) {
                memcpy(p, next, n * sizeof(double));
                memcpy(r, work, m * sizeof(double));
                best = sum;
                damping /= 8.0;
                break;
            }
        }
    }
    free(jacobian);
    return sqrt(best / (double)m);
}

/* Weighted residuals. */
struct weighted {
    fit_residuals residuals;
    void *user_data;
    const double *weights;
    size_t count;
};

static void weigh(const double *p, double *out, void *user_data)
{
    const struct weighted *w = user_data;
    w->residuals(p, out, w->user_data);
    for (size_t i = 0; i < w->count; ++i)
        out[i] *= w->weights[i];
}

static double largest(const double *values, size_t count)
{
    double most = 0.0;
    for (size_t i = 0; i < count; ++i)
        most = fmax(most, fabs(values[i]));
    return most;
}

double fit_minimax(double *parameters, size_t n, fit_residuals residuals, size_t m, void *user_data,
                   int num_rounds)
{
    double *weights = malloc(2 * m * sizeof(double)), *r = weights + m, p[FIT_MOST_PARAMETERS],
           best = INFINITY;
    struct weighted w = {residuals, user_data, weights, m};
    memcpy(p, parameters, n * sizeof(double));
    for (size_t i = 0; i < m; ++i)
        weights[i] = 1.0;
    for (int round = 0; round < num_rounds; ++round) {
        double sum = 0.0;
        least_squares(p, n, weigh, m, &w);
        residuals(p, r, user_data);
        double most = largest(r, m);
        if (most < best) {
            best = most;
            memcpy(parameters, p, n * sizeof(double));
        }
        for (size_t i = 0; i < m; ++i)
            sum += weights[i] *= 0.3 + 0.7 * sqrt(fabs(r[i]) / most);
        for (size_t i = 0; i < m; ++i)
            weights[i] *= (double)m / sum;
    }
    free(weights);
    return best;
}
