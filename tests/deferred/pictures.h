// SPDX-License-Identifier: Apache-2.0
/* Pictures of the deferred pipeline beside those of the forward pipeline. */
#ifndef MXG_TESTS_DEFERRED_PICTURES_H
#define MXG_TESTS_DEFERRED_PICTURES_H

#include "deferred/drawing.h"

enum { NUM_STORAGES = 3 }; /* whole floats, dithered, rounded */

/* A channel as a display shows it, 0 to 255. */
double picture_displayed(float linear);
/* In dB, of the colours as a display shows them. */
double picture_psnr(const float *a, const float *b);
/* Requires what pictures.def lists. */
void picture_require(double db, int expected);
/* Draws an element by each storage, and requires what pictures.def lists. */
void picture_test(struct bench *b, const char *element, const int expected[NUM_STORAGES]);

#endif
