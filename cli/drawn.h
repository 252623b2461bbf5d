// SPDX-License-Identifier: Apache-2.0
/* Pictures of one material with and without a budget of slabs, and how much they differ. */
#ifndef MXG_CLI_DRAWN_H
#define MXG_CLI_DRAWN_H

#include "cli/cli.h"

/*
 * The mean CIEDE2000 between two PPM pictures (P6, 8 bits, sRGB) of a ball that fills the middle,
 * over its pixels. Below 0: they are no pictures of one size.
 */
double drawn_difference(const char *a, size_t size_a, const char *b, size_t size_b);

/*
 * Draws the element of a document by mxgen-render, full and after each step of its budget, and
 * appends "STEPS=ERROR" to *out for each step, separated by commas. False after a message: there is
 * no renderer, or it makes no picture.
 */
bool drawn_errors(struct cli *cli, const mxg_document *document, const char *file,
                  const char *element, char **out);

#endif
