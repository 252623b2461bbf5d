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
/*
 * Requires what pictures.def lists, which lavapipe draws. Other devices have other derivatives, and
 * with them other glints, so their pictures need LIMIT_FLOAT or LIMIT_ROUNDED.
 */
enum { LIMIT_FLOAT = 45, LIMIT_ROUNDED = 38 };
void picture_require(const struct bench *b, double db, int expected, int limit);
/* Draws an element by storages, a bit for each, and requires what pictures.def lists. */
enum { ALL_STORAGES = (1 << NUM_STORAGES) - 1 };
void picture_test(struct bench *b, const char *element, const int expected[NUM_STORAGES],
                  unsigned storages);

#endif
