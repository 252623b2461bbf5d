// SPDX-License-Identifier: Apache-2.0
/*
 * Pictures in records. A signature is a picture reduced to 16 x 16 cells of 8-bit sRGB, in base64:
 * small enough to keep in a baseline, and good enough to see that a material looks different.
 */
#ifndef MXG_CHECK_PICTURE_H
#define MXG_CHECK_PICTURE_H

#include "cli/store.h"

#include <stdint.h>

/*
 * What an observer just notices: M. Mahy et al., Evaluation of uniform color spaces, Color Research
 * & Application 19 (1994).
 */
#define PICTURE_NOTICEABLE 2.3

char *picture_base64(struct store *store, const void *data, size_t size);

/* The signature of a picture in the form PPM (P6, 8 bits); NULL where it is none. */
char *picture_sign(struct store *store, const char *ppm, size_t size);

/*
 * The largest difference of two cells, as CIE 1976 delta E; negative where one of them is no
 * signature.
 */
double picture_difference(const char *a, const char *b);

#endif
