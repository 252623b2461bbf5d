// SPDX-License-Identifier: Apache-2.0
/* Closed forms of library functions, fitted to what they stand for. */
#ifndef MXG_FITS_FIT_H
#define MXG_FITS_FIT_H

#include <stddef.h>

enum { FIT_TERMS = 4, FIT_PARAMETERS = FIT_TERMS * FIT_TERMS };

/*
 * Polynomial dot((1, u, u², u³), M · (1, v, v², v³)), what all functions are made of; parameters
 * row by row.
 */
double fit_form(const double parameters[FIT_PARAMETERS], double u, double v);

/* "const mat4 NAME = …" for a function, times `scale`. */
void fit_print_form(const char *name, const double parameters[FIT_PARAMETERS], double scale);

/* Writes what parameters leave over at each point. */
typedef void (*fit_residuals)(const double *parameters, double *residuals, void *user_data);

/*
 * Makes the largest residual small: least squares by Levenberg and Marquardt, in rounds that weigh
 * those points more where much is left (after Lawson 1961). Returns it.
 */
double fit_minimax(double parameters[FIT_PARAMETERS], fit_residuals residuals, size_t num_residuals,
                   void *user_data);

#endif
