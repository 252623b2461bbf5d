// SPDX-License-Identifier: Apache-2.0
/*
 * Pictures in records. A signature is a picture, reduced to 16 x 16 cells of 8-bit sRGB, in base64:
 * small enough for a baseline, and detailed enough to show that a material looks different.
 */
#ifndef MXG_CHECK_SIGNATURE_H
#define MXG_CHECK_SIGNATURE_H

#include "program/store.h"

#include <stdint.h>

/*
 * The just noticeable difference: M. Mahy et al., Evaluation of uniform color spaces, Color
 * Research & Application 19 (1994).
 */
#define PICTURE_NOTICEABLE 2.3

char *picture_base64(struct store *store, const void *data, size_t size);

/* The signature of a PPM picture (P6, 8 bits); NULL if it is none. */
char *picture_sign(struct store *store, const char *ppm, size_t size);

/*
 * The largest CIE 1976 delta E between two cells; negative if an argument is no signature.
 */
double picture_difference(const char *a, const char *b);

#endif
