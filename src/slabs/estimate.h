// SPDX-License-Identifier: Apache-2.0
/*
 * estimate.c: what a tree of slabs looks like, without a picture: the colours of fixed points of a
 * ball in a white environment of 0.5, with one light. The graph's evaluator computes them with the
 * document's values and texels; a texture that cannot be read counts as a few fixed colours.
 */
#ifndef MXG_SLABS_ESTIMATE_H
#define MXG_SLABS_ESTIMATE_H

#include "slabs/slabs.h"

/* Compares trees of one document. */
struct slab_eye;

/* For trees that are to look like the first one. It lives as long as the shader. */
struct slab_eye *slabs_open_eye(struct shader *shader, const struct slabs_host *host, ir_ref first);
/*
 * The estimated error of a tree: the mean CIEDE2000 of all surfaces below its root, and those of
 * the first tree, of the worst side of the ball. -1: unknown, because the evaluator cannot compute
 * a value.
 */
float slabs_estimate(struct slab_eye *eye, ir_ref root);
/* The work since the eye opened: steps of the evaluator, and of building trees and their colours.
 */
uint64_t slabs_num_steps(const struct slab_eye *eye);

/*
 * Returns what a closure lets through as a layer of this thickness, of light on the mean way
 * and goes out along the normal: a vec3 for slabs_brightness.
 */
ir_ref slabs_through(struct shader *shader, const struct slabs_host *host, ir_ref top,
                     ir_ref thickness);
/* The mean of the channels, seen along the normal; below 0: unknown. */
float slabs_brightness(struct shader *shader, const struct slabs_host *host, ir_ref color);

#endif
